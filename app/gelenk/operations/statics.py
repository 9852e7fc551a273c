"""Statics of a robot."""

from collections.abc import Sequence
from dataclasses import dataclass
from typing import Any

import numpy as np

from gelenk.contract.common import Vectors
from gelenk.contract.statics import StaticsRequest
from gelenk.errors import InvalidField, TooLarge, counted
from gelenk.ik.search.words import DIRECTIONS, Direction
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
from gelenk.operations.chains import check_numbers, positions
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
from gelenk.operations.outcome import Limits, Outcome
from gelenk.robot.arrays import Array
from gelenk.robot.chain import Chain
from gelenk.robot.configuration import configurations
from gelenk.store.records import LoadedRobot

_MOST_SPLITS = 20_000
"""Maximum number of configurations whose subspaces one call needs: each takes a decomposition."""
_OF_THE_TIP = frozenset({"twists", "wrenches"})
"""Vectors with one number per direction of the task; the others have one per joint."""


def run(loaded: LoadedRobot, call: StaticsRequest, limits: Limits) -> Outcome:
    """Compute the joint torques of wrenches and gravity, or the wrenches that balance torques, and the subspaces."""
    robot = loaded.robot
    chain = chain_of(robot, call)
    load, gravity = load_of(call.payload), gravity_of(call.gravity)
    _check_options(call, chain, weighs=gravity is not None)
    qs = positions(chain, call)
    _check_size(call, len(qs), len(chain), limits)
    wrenches = None if call.wrenches is None else wrench_rows(call.wrenches, len(qs), _task(call))
    torques = None
    if call.torques is not None:
        torques = one_each(configurations(chain, call.torques, "torques"), len(qs), "torques")
    rows = np.array([DIRECTIONS.index(direction) for direction in _task(call)])
    still = statics(robot, chain, qs, wrench_frame(call), rows=rows, gravity=gravity, load=load)
    found = _solved(still, call, wrenches, torques)
    array = found.torques if found.balance is None else found.balance.wrenches
    return Outcome(lambda: _content(loaded, call, found), None if _wants_subspaces(call) else lambda: (array, {}))


def is_heavy(call: StaticsRequest) -> bool:
    """Check whether a request takes the event loop more than about a millisecond."""
    return not is_quick(call) or _wants_subspaces(call)


def attempt(loaded: LoadedRobot, call: StaticsRequest, limits: Limits) -> Outcome | None:
    """Run the operation if the chain has few bodies; return None if it has many."""
    return run(loaded, call, limits) if has_few_bodies(loaded, call) else None


WARM_UP = MECHANISM


@dataclass(frozen=True, slots=True, eq=False)
class _Results:
    """Results of a call: `wrenches` is None if there are none, `balance` and `splits` if not requested."""

    still: Statics
    wrenches: Array | None
    torques: Array
    balance: NearestWrench | None
    splits: list[Subspaces] | None
    certificate: StaticsCertificate


def _task(call: StaticsRequest) -> Sequence[Direction]:
    return call.task or DIRECTIONS


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


def _check_options(call: StaticsRequest, chain: Chain, *, weighs: bool) -> None:
    """Refuse combinations of fields that exclude each other.

    Raises:
        InvalidField: A field needs another that is missing, or excludes one that is given.
    """
    if len(set(_task(call))) < len(_task(call)):
        raise InvalidField("task", "each direction may appear only once")
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
        size = len(_task(call)) if name in _OF_THE_TIP else len(chain)
        for i, vector in enumerate(vectors):
            if len(vector) != size:
                raise InvalidField(f"test_{name}", f"entry {i} has {counted(len(vector), 'number')}, not {size}")


def _check_size(call: StaticsRequest, count: int, n: int, limits: Limits) -> None:
    m = len(_task(call))
    splits = _wants_subspaces(call) or call.torques is not None
    numbers = count * (12 + 10 * n + m)
    if splits:
        tests = sum(2 * len(vector) for vectors in _tests(call).values() for vector in vectors)
        numbers += count * (m * m + n * n + tests)
    check_numbers(numbers, limits)
    if splits and count > _MOST_SPLITS:
        raise TooLarge("configurations whose subspaces are needed", count, _MOST_SPLITS)


def _solved(still: Statics, call: StaticsRequest, wrenches: Array | None, torques: Array | None) -> _Results:
    found = splits = None
    if torques is not None:
        found = balance(still, torques, call.rank_tolerance)
        wrenches, held = found.wrenches, torques - found.residuals
        splits = found.splits
    else:
        given = np.zeros((len(still.qs), len(still.rows))) if wrenches is None else wrenches
        torques = held = still.wrench_torques(given) + still.gravity_torques
        splits = still.subspaces(call.rank_tolerance) if _wants_subspaces(call) else None
    acting = np.zeros((len(still.qs), len(still.rows))) if wrenches is None else wrenches
    certificate = certify_statics(still, acting, held)
    return _Results(still, wrenches, torques, found, splits if _wants_subspaces(call) else None, certificate)


def _content(loaded: LoadedRobot, call: StaticsRequest, found: _Results) -> dict[str, Any]:
    still, splits = found.still, found.splits
    robot, chain, weighs = still.robot, still.chain, still.gravity is not None
    return {
        "joint_names": chain.joint_names,
        "base_frame": chain.base_frame,
        "tip_frame": chain.tip_frame,
        "root_frame": robot.description.root,
        "gravity": still.gravity,
        "task": _task(call),
        "rank_tolerance": call.rank_tolerance,
        "membership_tolerance": call.membership_tolerance,
        "wrenches": found.wrenches,
        "torques": found.torques,
        "gravity_torques": still.gravity_torques if weighs else None,
        "balance": None if found.balance is None else _balance_content(call, found, found.balance),
        "overloaded_joints": overloaded_joints(robot, chain, found.torques),
        "subspaces": None if splits is None else [_subspaces_content(call, split) for split in splits],
        "notes": weight_notes(loaded, mechanism(robot, chain), still.load) if weighs else [],
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
    bases = {
        "range": split.range,
        "left_kernel": split.left_kernel,
        "row_space": split.row_space,
        "kernel": split.kernel,
    }
    entry: dict[str, Any] = {
        "rank": split.rank,
        "singular_values": split.sigmas.tolist(),
        "dimensions": {name: basis.shape[1] for name, basis in bases.items()},
        **{name: basis.T.tolist() for name, basis in bases.items()},
    }
    for field, vectors in _tests(call).items():
        first, second = ("range", "left_kernel") if field in _OF_THE_TIP else ("row_space", "kernel")
        entry[field] = []
        for vector in vectors:
            *parts, lies_in = components(bases[first], bases[second], np.array(vector), call.membership_tolerance)
            entry[field].append(
                {
                    "components": {first: parts[0].tolist(), second: parts[1].tolist()},
                    "member_of": [name for name, member in zip((first, second), lies_in, strict=True) if member],
                }
            )
    return entry
