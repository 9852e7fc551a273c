"""Statics of a robot, as numbers or as a picture of the lever arms."""

from dataclasses import dataclass
from typing import Any

import numpy as np

from gelenk.contract.common import Vectors
from gelenk.contract.statics import StaticsRequest
from gelenk.errors import InvalidField, TooLarge, counted
from gelenk.ik.search.task import Task
from gelenk.ik.search.words import DIRECTIONS
from gelenk.kinematics.dynamics.mechanism import mechanism
from gelenk.kinematics.force.statics import (
    NearestWrench,
    Statics,
    balance,
    certify_statics,
    components,
    overloaded_joints,
    statics,
)
from gelenk.kinematics.judge.words import StaticsCertificate
from gelenk.kinematics.velocity.subspaces import Subspaces
from gelenk.operations.chains import check_numbers, check_worked, head, positions, task_of
from gelenk.operations.loads import (
    MECHANISM,
    chain_of,
    gravity_of,
    has_few_bodies,
    is_quick,
    load_of,
    one_each,
    unused_frame,
    weight_notes,
    wrench_frame,
    wrench_rows,
)
from gelenk.operations.outcome import Limits, Outcome, PictureFormat
from gelenk.operations.velocity_steps import worked_statics
from gelenk.robot.arrays import Array
from gelenk.robot.chain import Chain
from gelenk.robot.configuration import configurations
from gelenk.store.records import LoadedRobot

_FLAT = 1e-9


def levers_picture(
    chain: Chain, call: StaticsRequest, q: Array, task: Task, wrenches: Array | None, torques: Array,
    kind: PictureFormat,
) -> bytes:  # fmt: skip
    """Draw the lever arms of a force; raises InvalidField for what such a picture cannot show.

    `q` and `torques` have one row per configuration, `wrenches` one number per direction of the task.
    """
    from gelenk.kinematics.ellipsoids.manipulability import space_of  # noqa: PLC0415
    from gelenk.plots.arm import arm_line  # noqa: PLC0415
    from gelenk.plots.course.planar_arm import levers_figure  # noqa: PLC0415
    from gelenk.plots.figure import as_bytes  # noqa: PLC0415

    _check(call, len(q), wrenches)
    points, slides = arm_line(chain, q[0])
    space = space_of(chain, (0, 1, 2))
    if not space.is_plane or len(slides) != len(chain):
        raise InvalidField("Accept", "an image shows the lever arms of a planar arm without mimic joints")
    wrench = np.zeros(6)
    wrench[[DIRECTIONS.index(direction) for direction in task.directions]] = wrenches[0] if wrenches is not None else 0
    plane = space.spread(space.basis.T)
    force, size = plane @ wrench[:3], float(np.abs(wrench).max())
    if np.abs(plane.T @ force - wrench[:3]).max() > _FLAT * size or np.abs(wrench[3:]).max() > _FLAT * size:
        raise InvalidField("wrenches", "an image shows a force in the plane of the arm, without a moment")
    return as_bytes(levers_figure(points[1:] @ plane.T, force.tolist(), torques[0].tolist(), slides.tolist()), kind)


def _check(call: StaticsRequest, count: int, wrenches: Array | None) -> None:
    if count != 1:
        raise InvalidField("joint_positions", f"an image shows one configuration; these are {count}")
    if call.gravity is not False:
        raise InvalidField("gravity", "an image shows the lever arms of the force at the tip, and not the weight")
    if wrenches is None:
        raise InvalidField("wrenches", "an image needs a force at the tip")
    for field in ("expressed_in", "point_frame", "point"):
        if getattr(call, field) is not None:
            raise InvalidField(field, "an image shows a force at the tip, in the base's axes")
    if call.reference != "local_world_aligned":
        raise InvalidField("reference", "an image shows a force at the tip, in the base's axes, `local_world_aligned`")


_MOST_SPLITS = 20_000
"""Maximum number of configurations whose subspaces one call needs: each takes a decomposition."""
_OF_THE_TIP = frozenset({"twists", "wrenches"})
"""Vectors with one number per direction of the task; the others have one per joint."""


def run(loaded: LoadedRobot, call: StaticsRequest, limits: Limits) -> Outcome:
    """Compute the joint torques of wrenches and gravity, or the wrenches that balance torques, and the subspaces."""
    robot = loaded.robot
    chain = chain_of(robot, call)
    load, gravity = load_of(call.payload), gravity_of(call.gravity)
    task = task_of(call.task)
    _check_options(call, task, chain, weighs=gravity is not None)
    qs = positions(chain, call)
    _check_size(call, len(qs), len(task), len(chain), limits)
    check_worked(call, len(qs))
    wrenches = torques = None
    if call.wrenches is not None:
        hint = ", in the order of `task`" if call.task else "; `task` can name fewer"
        wrenches = wrench_rows(call.wrenches, len(qs), task.directions, hint)
    if call.torques is not None:
        torques = one_each(configurations(chain, call.torques, "torques"), len(qs), "torques")
    rows = np.array([DIRECTIONS.index(direction) for direction in task.directions])
    still = statics(robot, chain, qs, wrench_frame(call), rows=rows, gravity=gravity, load=load)
    found = _solved(still, call, wrenches, torques)
    detailed = _wants_subspaces(call) or call.steps
    array = found.torques if found.balance is None else found.balance.wrenches
    return Outcome(
        lambda: _content(loaded, call, found),
        None if detailed else lambda: (array, {}),
        lambda kind: levers_picture(chain, call, qs, task, found.wrenches, found.torques, kind),
    )


def is_heavy(call: StaticsRequest) -> bool:
    """Check whether a request takes the event loop more than about a millisecond."""
    return not is_quick(call) or _wants_subspaces(call) or call.steps


def attempt(loaded: LoadedRobot, call: StaticsRequest, limits: Limits) -> Outcome | None:
    """Run the operation if the chain has few bodies; return None if it has many."""
    return run(loaded, call, limits) if has_few_bodies(loaded, call) else None


WARM_UP = MECHANISM


@dataclass(frozen=True, slots=True, eq=False)
class _Results:
    """Results of a call: `wrenches` is None if there are none, `balance` if not requested."""

    still: Statics
    wrenches: Array | None
    torques: Array
    balance: NearestWrench | None
    certificate: StaticsCertificate


def _tests(call: StaticsRequest) -> dict[str, Vectors]:
    """Return the vectors to split, by the field of the answer that reports them."""
    given = {
        "twists": call.test_twists,
        "wrenches": call.test_wrenches,
        "torques": call.test_torques,
        "joint_velocities": call.test_joint_velocities,
    }
    return {name: vectors for name, vectors in given.items() if vectors is not None}


def _wants_subspaces(call: StaticsRequest) -> bool:
    return call.subspaces or bool(_tests(call))


def _check_options(call: StaticsRequest, task: Task, chain: Chain, *, weighs: bool) -> None:
    if call.wrenches is not None and call.torques is not None:
        raise InvalidField("torques", "they are given instead of `wrenches`, not beside them")
    if call.payload is not None and not weighs:
        raise InvalidField("payload", "it weighs only where there is `gravity`")
    wrench_frame(call)
    if call.wrenches is None and call.torques is None and not _wants_subspaces(call):
        if not weighs:
            raise InvalidField("wrenches", "nothing acts on the robot: give `wrenches`, `torques` or `gravity`")
        field = "task" if call.task is not None else unused_frame(call)
        if field is not None:
            raise InvalidField(field, "only allowed with `wrenches`, `torques` or `subspaces`")
    for name, vectors in _tests(call).items():
        size = len(task) if name in _OF_THE_TIP else len(chain)
        for i, vector in enumerate(vectors):
            if len(vector) != size:
                raise InvalidField(f"test_{name}", f"entry {i} has {counted(len(vector), 'number')}, not {size}")


def _check_size(call: StaticsRequest, count: int, m: int, n: int, limits: Limits) -> None:
    splits = _wants_subspaces(call) or call.torques is not None
    numbers = count * (12 + 10 * n + m)
    if splits:
        tests = sum(2 * len(vector) for vectors in _tests(call).values() for vector in vectors)
        numbers += count * (m * m + n * n + tests)
    check_numbers(numbers, limits)
    if splits and count > _MOST_SPLITS:
        raise TooLarge("configurations whose subspaces are needed", count, _MOST_SPLITS)


def _solved(still: Statics, call: StaticsRequest, wrenches: Array | None, torques: Array | None) -> _Results:
    found = None
    acting = np.zeros((len(still.qs), len(still.rows))) if wrenches is None else wrenches
    if torques is None:
        torques = held = still.wrench_torques(acting) + still.gravity_torques
    else:
        found = balance(still, torques, call.rank_tolerance)
        wrenches = acting = found.wrenches
        held = torques - found.residuals
    return _Results(still, wrenches, torques, found, certify_statics(still, acting, held))


def _content(loaded: LoadedRobot, call: StaticsRequest, found: _Results) -> dict[str, Any]:
    still = found.still
    robot, chain, weighs = still.robot, still.chain, still.gravity is not None
    splits: list[Subspaces] = []
    steps: dict[str, Any] = {}
    if call.steps:
        solved, tolerance = found.balance is not None, call.rank_tolerance
        steps = {"steps": worked_statics(still, found.wrenches, found.torques, tolerance, solved=solved)}
    if _wants_subspaces(call):
        splits = still.subspaces(call.rank_tolerance) if found.balance is None else found.balance.splits
    return {
        **head(chain),
        "root_frame": robot.description.root,
        "gravity": still.gravity,
        "task": task_of(call.task).directions,
        "rank_tolerance": call.rank_tolerance,
        "membership_tolerance": call.membership_tolerance,
        "wrenches": found.wrenches,
        "torques": found.torques,
        "gravity_torques": still.gravity_torques if weighs else None,
        "balance": None if found.balance is None else _balance_content(call, found, found.balance),
        "overloaded_joints": overloaded_joints(robot, chain, found.torques),
        "subspaces": [_subspaces_content(call, split) for split in splits] if _wants_subspaces(call) else None,
        "notes": weight_notes(loaded, mechanism(robot, chain), still.load) if weighs else [],
        **steps,
        "certificate": found.certificate,
    }


def _balance_content(call: StaticsRequest, found: _Results, of_torques: NearestWrench) -> dict[str, Any]:
    lengths = np.linalg.norm(found.torques - found.still.gravity_torques, axis=1)
    left = np.linalg.norm(of_torques.residuals, axis=1)
    return {
        "is_balanced": (left <= call.membership_tolerance * lengths).tolist(),
        "is_unique": [split.rank == len(found.still.rows) for split in of_torques.splits],
        "residual_torques": of_torques.residuals,
        "free_wrenches": [split.left_kernel.T.tolist() for split in of_torques.splits],
    }


def _subspaces_content(call: StaticsRequest, split: Subspaces) -> dict[str, Any]:
    names = ("range", "left_kernel", "row_space", "kernel")
    bases: dict[str, Array] = {name: getattr(split, name) for name in names}
    entry: dict[str, Any] = {
        "rank": split.rank,
        "singular_values": split.sigmas.tolist(),
        "dimensions": {name: basis.shape[1] for name, basis in bases.items()},
        **{name: basis.T.tolist() for name, basis in bases.items()},
    }
    for field, vectors in _tests(call).items():
        pair = names[:2] if field in _OF_THE_TIP else names[2:]
        inside, outside = (bases[name] for name in pair)
        entry[field] = []
        for vector in vectors:
            *parts, lies_in = components(inside, outside, np.array(vector), call.membership_tolerance)
            entry[field].append(
                {
                    "components": {name: part.tolist() for name, part in zip(pair, parts, strict=True)},
                    "member_of": [name for name, member in zip(pair, lies_in, strict=True) if member],
                }
            )
    return entry
