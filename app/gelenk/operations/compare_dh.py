"""Comparison of a Denavit-Hartenberg table with a chain of a robot."""

from dataclasses import asdict
from typing import Any

import numpy as np

from gelenk.contract.compare_dh import CompareRequest
from gelenk.contract.pose import PoseFormat
from gelenk.dh.compare.alignment import Freedom
from gelenk.dh.compare.compare import Comparison, compare
from gelenk.dh.compare.numbers import Difference
from gelenk.dh.compare.screws import PARAMETERS
from gelenk.dh.compare.trials import Diagnosis
from gelenk.operations.chains import head
from gelenk.operations.outcome import Limits, Outcome, always
from gelenk.operations.pose_arrays import pose_list
from gelenk.robot.arrays import Array
from gelenk.robot.chain import Chain
from gelenk.robot.poses import Poses
from gelenk.robot.robot import RobotModel
from gelenk.store.records import LoadedRobot


def run(robot: LoadedRobot, call: CompareRequest, _: Limits) -> Outcome:
    """Compare a DH table with a chain of a robot; find the first difference and diagnose mistakes."""
    return Outcome(lambda: _compared(robot.robot, call))


is_heavy = always  # a comparison takes tens of milliseconds, and more if it looks for mistakes


def _compared(robot: RobotModel, call: CompareRequest) -> dict[str, Any]:
    chain = robot.chain(call.base_frame, call.tip_frame)
    tolerances = call.position_tolerance, call.orientation_tolerance
    freedom = _freedom(call)
    comparison = compare(robot, chain, call.dh.table(), freedom, tolerances, seed=call.random_seed)
    return _content(chain, call, freedom, comparison)


def _freedom(call: CompareRequest) -> Freedom:
    if call.find is None:
        return Freedom(base=call.dh.base is None, tool=call.dh.tool is None, offsets=False, signs=False)
    return Freedom(*(name in call.find for name in Freedom._fields))


def _content(chain: Chain, call: CompareRequest, freedom: Freedom, comparison: Comparison) -> dict[str, Any]:
    placement = comparison.placement
    content: dict[str, Any] = dict.fromkeys(
        ("base", "tool", "offsets", "signs", "max_position_error", "max_orientation_error")
    )
    if placement is not None:
        content = {
            "base": _pose(placement.table.base, call.pose_format),
            "tool": _pose(placement.table.tool, call.pose_format),
            "offsets": placement.offsets,
            "signs": placement.signs.astype(int),
            "max_position_error": placement.position_error,
            "max_orientation_error": placement.orientation_error,
        }
    first = comparison.first_difference
    return {
        "equivalent": comparison.equivalent,
        **content,
        "first_difference": None if first is None else _difference(first),
        "found": [name for name in Freedom._fields if getattr(freedom, name)],
        "held": [name for name in Freedom._fields if not getattr(freedom, name)],
        "diagnoses": [_diagnosis(each) for each in comparison.diagnoses],
        "unverified": comparison.unverified,
        "notes": [*_replaced(call), *comparison.notes],
        **head(chain),
        "samples": comparison.samples,
        "random_seed": call.random_seed,
    }


def _replaced(call: CompareRequest) -> list[str]:
    """Return notes on the poses in `dh` that `find` replaces."""
    given = [place for place in ("base", "tool") if getattr(call.dh, place) is not None and place in (call.find or ())]
    return [f"`find` asks for {place}: that of `dh` is ignored" for place in given]


def _pose(T: Array, pose_format: PoseFormat) -> dict[str, object]:
    batch = Poses(np.ascontiguousarray(T[None, :3, 3]), np.ascontiguousarray(T[None, :3, :3]))
    return pose_list(batch, pose_format)[0]


def _diagnosis(diagnosis: Diagnosis) -> dict[str, Any]:
    differences = [_difference(each) for each in diagnosis.differences]
    mistakes = list(diagnosis.mistakes)
    return {"mistake": mistakes[0], "mistakes": mistakes, "detail": diagnosis.detail, "differences": differences}


def _difference(each: Difference) -> dict[str, Any]:
    return {**asdict(each), "difference": each.difference, "pointer": _pointer(each)}


def _pointer(each: Difference) -> str | None:
    if each.row is None:
        return "#/dh" if each.parameter == "joints" else f"#/dh/{each.parameter}"
    if each.joint is None:
        return "#/dh/joints"
    written = each.parameter in {*PARAMETERS, "type", "mimic"}
    return f"#/dh/joints/{each.row - 1}" + (f"/{each.parameter}" if written else "")
