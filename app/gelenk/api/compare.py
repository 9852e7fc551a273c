"""Does a Denavit-Hartenberg table describe a chain of a robot."""

from typing import Any

import numpy as np

from gelenk.api.dh import dh_route
from gelenk.api.errand import RobotErrand
from gelenk.api.remote import Remote, json_handler
from gelenk.api.routes import DocumentedRoute
from gelenk.contract.compare import EXAMPLE_COMPARISON, CompareAnswer, CompareRequest
from gelenk.contract.pose import PoseFormat
from gelenk.contract.pose_arrays import pose_list
from gelenk.kinematics.compare import Comparison, compare
from gelenk.kinematics.comparison.alignment import Freedom
from gelenk.kinematics.comparison.numbers import Difference
from gelenk.kinematics.comparison.screws import PARAMETERS
from gelenk.kinematics.comparison.trials import Diagnosis
from gelenk.model.arrays import Array
from gelenk.model.chain import Chain
from gelenk.model.poses import Poses
from gelenk.store.library import Library


def compare_route(remote: Remote, max_body_bytes: int) -> DocumentedRoute:
    """The comparison: it takes tens of milliseconds, and more where mistakes are looked for."""

    def compare_table(call: CompareRequest) -> CompareAnswer:
        """Says whether a table describes a chain, and if not, which row and parameter are wrong and by how much.

        Many tables describe the same chain, so individual numbers are not compared: base · A_1 ⋯ A_n · tool must equal
        the chain's pose at random configurations, through Pinocchio. What `dh` gives is held, and a base or tool that
        it leaves out is found; `find` overrides this, and can add the joints' zeros (`offsets`) and senses (`signs`).

        A base that is found makes up for d and theta of the first row, a tool for the whole last row (Craig: the
        whole first row, and d and theta of the last): `unverified` lists such numbers. Give both to have everything
        checked, the identity included.

        Where the table does not describe the chain, mistakes are tried: each number by itself, signs, degrees, lengths
        off by a power of ten, columns and rows exchanged, a row missing or there twice, the other convention, a joint's
        sense or zero; and where none of them explains it, any two together. `diagnoses` has those that explain
        everything, the likeliest first, and `first_difference` is the first number of the likeliest; without a
        diagnosis it is the first difference from the base. A wrong number of rows or a joint of another type is also an
        answer, not an error.
        """
        raise NotImplementedError

    return dh_route(
        "/v1/dh/compare",
        compare_table,
        json_handler(RobotErrand(CompareRequest, _compared), remote),
        max_body_bytes,
        operation_id="compare_dh",
        summary="Does a table describe a chain?",
        example=EXAMPLE_COMPARISON,
    )


def _compared(call: CompareRequest, library: Library) -> dict[str, Any]:
    robot = library.get(call.robot).robot
    chain = robot.chain(call.base_frame, call.tip_frame)
    tolerances = call.position_tolerance, call.orientation_tolerance
    comparison = compare(robot, chain, call.dh.table(), _freedom(call), tolerances, seed=call.random_seed)
    return _content(chain, call, comparison)


def _freedom(call: CompareRequest) -> Freedom:
    if call.find is None:
        return Freedom(base=call.dh.base is None, tool=call.dh.tool is None, offsets=False, signs=False)
    return Freedom(*(name in call.find for name in Freedom._fields))


def _content(chain: Chain, call: CompareRequest, comparison: Comparison) -> dict[str, Any]:
    placement = comparison.placement
    content: dict[str, Any] = dict.fromkeys(
        ("base", "tool", "offsets", "signs", "max_position_error", "max_orientation_error")
    )
    if placement is not None:
        content["base"] = _pose(placement.table.base, call.pose_format)
        content["tool"] = _pose(placement.table.tool, call.pose_format)
        content["offsets"] = placement.offsets.tolist()
        content["signs"] = placement.signs.astype(int).tolist()
        content["max_position_error"] = placement.position_error
        content["max_orientation_error"] = placement.orientation_error
    first = comparison.first_difference
    return {
        "equivalent": comparison.equivalent,
        **content,
        "first_difference": None if first is None else _difference(first),
        "found": [name for name in Freedom._fields if getattr(comparison.freedom, name)],
        "held": [name for name in Freedom._fields if not getattr(comparison.freedom, name)],
        "diagnoses": [_diagnosis(each) for each in comparison.diagnoses],
        "unverified": [each._asdict() for each in comparison.unverified],
        "notes": [*_replaced(call), *comparison.notes],
        "joint_names": chain.joint_names,
        "base_frame": chain.base_frame,
        "tip_frame": chain.tip_frame,
        "samples": comparison.samples,
        "random_seed": comparison.seed,
    }


def _replaced(call: CompareRequest) -> list[str]:
    """What `dh` gives and `find` sets aside."""
    given = [place for place in ("base", "tool") if getattr(call.dh, place) is not None and place in (call.find or ())]
    return [f"`find` has {place} found: that of `dh` is set aside" for place in given]


def _pose(T: Array, pose_format: PoseFormat) -> dict[str, object]:
    batch = Poses(np.ascontiguousarray(T[None, :3, 3]), np.ascontiguousarray(T[None, :3, :3]))
    return pose_list(batch, pose_format)[0]


def _diagnosis(diagnosis: Diagnosis) -> dict[str, Any]:
    differences = [_difference(each) for each in diagnosis.differences]
    mistakes = list(diagnosis.mistakes)
    return {"mistake": mistakes[0], "mistakes": mistakes, "detail": diagnosis.detail, "differences": differences}


def _difference(each: Difference) -> dict[str, Any]:
    return {
        "row": each.row,
        "joint": each.joint,
        "parameter": each.parameter,
        "value": each.value,
        "expected": each.expected,
        "difference": each.difference,
        "pointer": _pointer(each),
    }


def _pointer(each: Difference) -> str | None:
    """JSON pointer into the request, or None."""
    if each.row is None:
        return "#/dh" if each.parameter == "joints" else f"#/dh/{each.parameter}"
    if each.joint is None:
        return "#/dh/joints"
    written = each.parameter in {*PARAMETERS, "type", "mimic"}
    return f"#/dh/joints/{each.row - 1}" + (f"/{each.parameter}" if written else "")
