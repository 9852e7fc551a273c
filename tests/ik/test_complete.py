"""`complete` is a proof: no answer that claims it lacks a configuration that is known to solve its target."""

import numpy as np
import pytest

from gelenk.ik.solve import Options, inverse_kinematics
from gelenk.ik.verdict.result import InverseKinematics
from gelenk.robot.arrays import Array, Flags
from tests.ik import six_joint_arms
from tests.ik.arm_classes import Arm
from tests.ik.arms import limited, poses

CLOSE = 1e-3
OFFSETS = tuple(10.0**-k for k in range(1, 10))


def drawn(arm: Arm, each: int, seed: int) -> Array:
    """Configurations far from, at and beside singularities; shape (k, 6)."""
    beside = [six_joint_arms.beside_singular(arm, offset, each, seed + 10 * k) for k, offset in enumerate(OFFSETS)]
    return np.concatenate((arm.configurations(each, seed), six_joint_arms.singular(arm, each, seed), *beside))


def every(arm: Arm, qs: Array) -> InverseKinematics:
    targets = poses(arm.robot, arm.chain, qs)
    options = Options(every=True, respect_limits=False, most=200)
    return inverse_kinematics(arm.robot, arm.chain, targets, np.full((1, 6), 0.1), options)


def missed(arm: Arm, qs: Array, answer: InverseKinematics) -> Flags:
    """Of which targets the configuration that made them is not listed; shape (k,)."""
    lists = np.split(answer.qs, answer.firsts[1:-1])
    apart = [np.abs(arm.differences(found, q)).max(axis=1, initial=0.0) for found, q in zip(lists, qs, strict=True)]
    return np.array([distances.min(initial=np.inf) > CLOSE for distances in apart])


def doubts_of(answer: InverseKinematics) -> Flags:
    """Which answers do not claim to be complete, each of which says why; shape (k,)."""
    doubtful = ~np.array(answer.complete)
    reasons = {**answer.doubts, **{i: failure.reason for i, failure in answer.failures.items()}}
    assert all(reasons[i] for i in np.flatnonzero(doubtful).tolist())
    assert not set(answer.doubts) - set(np.flatnonzero(doubtful).tolist())
    return doubtful


@pytest.mark.quick(1)
@pytest.mark.parametrize(
    "name", ["crx 0", "jaco 2, 60 degrees", "gen3 lite", "axes 1 2 3 parallel, 0", "general RRRPPR"]
)
def test_regular_targets_of_arms_without_a_closed_form_are_proved(name: str) -> None:
    arm = six_joint_arms.arm(name)
    qs = arm.configurations(10, seed=11)
    answer = every(arm, qs)
    assert not missed(arm, qs, answer).any()
    assert answer.complete is not None
    assert sum(answer.complete) >= 9
    assert pose_errors(arm, qs, answer) < 1e-9


def pose_errors(arm: Arm, qs: Array, answer: InverseKinematics) -> float:
    """How far the solutions are from the targets that configurations make, by Pinocchio [m, rad]."""
    owners = np.repeat(np.arange(len(qs)), np.diff(answer.firsts))
    reached, wanted = poses(arm.robot, arm.chain, answer.qs), poses(arm.robot, arm.chain, qs)
    apart = reached.positions - wanted.positions[owners], reached.rotations - wanted.rotations[owners]
    return float(max(np.abs(apart[0]).max(), np.abs(apart[1]).max()))


def test_limits_leave_an_answer_complete() -> None:
    arm = six_joint_arms.arm("crx 0")
    chain = limited(arm.chain, [-2.0] * 6, [2.0] * 6)
    qs = np.random.default_rng(5).uniform(-2.0, 2.0, (5, 6))
    targets = poses(arm.robot, chain, qs)
    free = inverse_kinematics(arm.robot, chain, targets, np.zeros((1, 6)), Options(every=True, respect_limits=False))
    bound = inverse_kinematics(arm.robot, chain, targets, np.zeros((1, 6)), Options(every=True))
    assert bound.complete == free.complete == [True] * 5
    assert (np.abs(bound.qs) <= 2.0).all()
    assert len(bound.qs) == (np.abs(free.qs) <= 2.0).all(axis=1).sum()
    assert not missed(arm, qs, bound).any()


def test_so_many_as_are_asked_for_are_not_all() -> None:
    arm = six_joint_arms.arm("crx 0")
    q = arm.configurations(1, seed=11)
    whole = every(arm, q)
    targets = poses(arm.robot, arm.chain, q)
    options = Options(every=True, respect_limits=False, most=len(whole.qs) - 1)
    answer = inverse_kinematics(arm.robot, arm.chain, targets, np.full((1, 6), 0.1), options)
    assert (whole.complete, answer.complete) == ([True], [False])
    np.testing.assert_array_equal(answer.qs, whole.qs[:-1])
    assert "requested number" in answer.doubts[0]


@pytest.mark.quick(1)
@pytest.mark.parametrize("name", ["xarm6", "general 1"])
def test_a_count_proves_what_elimination_leaves_in_doubt(name: str) -> None:
    """Beside singularities, where two of its roots nearly meet."""
    arm = six_joint_arms.arm(name)
    qs = six_joint_arms.beside_singular(arm, 1e-3, 12, seed=3)
    answer = every(arm, qs)
    assert not missed(arm, qs, answer).any()
    assert answer.complete is not None
    assert sum(answer.complete) >= 10


@pytest.mark.slow
def test_an_arm_that_is_only_nearly_of_a_closed_form_keeps_its_own_branches() -> None:
    """As far beside the form's own folds as the geometry is off: there the form has lost a branch that the arm has."""
    arm = six_joint_arms.arm("square wrist off by 1e-06 m")
    qs = np.concatenate([six_joint_arms.beside_singular(arm, offset, 30, 310) for offset in (1e-1, 1e-6)])
    answer = every(arm, qs)
    assert not missed(arm, qs, answer).any()


@pytest.mark.slow
@pytest.mark.parametrize("name", six_joint_arms.TABLES)
def test_targets_of_all_arms(name: str) -> None:
    arm = six_joint_arms.arm(name)
    qs = drawn(arm, 2, 1000)
    answer = every(arm, qs)
    lost = missed(arm, qs, answer)
    assert not (lost & ~doubts_of(answer)).any()
    # Of infinitely many solutions there is but a sample, and next to these the nearest may be within the tolerances.
    isolated = np.array(["infinitely many" not in answer.doubts.get(i, "") for i in range(len(qs))])
    assert (lost & isolated).mean() <= 1e-3


@pytest.mark.parametrize(
    ("name", "offset", "seed"), [("arc welder", 1e-3, 6020), ("square wrist off by 0.001 m", 1e-4, 3030)]
)
def test_what_elimination_loses_is_counted(name: str, offset: float, seed: int) -> None:
    """Targets of which it finds 11 of 14 solutions, and 4 of 6, all of them regular enough to look like all."""
    arm = six_joint_arms.arm(name)
    qs = six_joint_arms.beside_singular(arm, offset, 4, seed)
    answer = every(arm, qs)
    assert not missed(arm, qs, answer).any()
