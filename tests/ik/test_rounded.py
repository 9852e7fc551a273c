"""Arms whose description is rounded: nothing is dropped where two solutions nearly meet, or `complete` is false."""

import numpy as np
import pytest

from gelenk.ik.solve import Options, inverse_kinematics
from gelenk.robot.arrays import Array, Flags
from tests.ik import rounded_arms
from tests.ik.arm_classes import Arm
from tests.ik.arms import poses

CLOSE = 1e-3
WITH_A_WRIST = ("puma", "staubli", "shoulder and elbow offset", "gantry")


def nearest_of_all(arm: Arm, qs: Array) -> tuple[Array, Flags]:
    """How far the configuration that made a target is from the nearest listed; and which lists are complete."""
    targets = poses(arm.robot, arm.chain, qs)
    options = Options(every=True, respect_limits=False, most=200)
    answer = inverse_kinematics(arm.robot, arm.chain, targets, np.full((1, 6), 0.1), options)
    lists = np.split(answer.qs, answer.firsts[1:-1])
    apart = [np.abs(arm.differences(found, q)).max(axis=1, initial=0.0) for found, q in zip(lists, qs, strict=True)]
    return np.array([far.min(initial=np.inf) for far in apart]), np.array(answer.complete)


def from_seeds(arm: Arm, qs: Array) -> Array:
    """How far the answer of a seed that solves its target is from the seed."""
    answer = inverse_kinematics(
        arm.robot, arm.chain, poses(arm.robot, arm.chain, qs), qs, Options(respect_limits=False)
    )
    assert len(answer.qs) == len(qs)
    return np.asarray(np.abs(answer.qs - qs).max(axis=1))


def beside(arm: Arm, count: int, seed: int, joint_5: float, off: float) -> Array:
    qs = arm.configurations(count, seed)
    qs[:, 4] = joint_5 + off
    return qs


@pytest.mark.slow
@pytest.mark.parametrize("digits", rounded_arms.DIGITS)
@pytest.mark.parametrize("name", ["ur10e", *WITH_A_WRIST])
@pytest.mark.parametrize("middle", [0.0, np.pi])
def test_beside_a_singular_wrist_both_of_its_solutions_are_found(name: str, digits: int | None, middle: float) -> None:
    arm = rounded_arms.arm(name, digits)
    qs = np.concatenate([beside(arm, 4, 3, middle, off) for off in (1e-9, -1e-8, 1e-7)])
    far, _ = nearest_of_all(arm, qs)
    assert far.max() < CLOSE
    assert from_seeds(arm, qs).max() < CLOSE


@pytest.mark.slow
@pytest.mark.parametrize("digits", rounded_arms.DIGITS)
@pytest.mark.parametrize("name", ["ur10e", "puma", "scara and a wrist"])
def test_a_complete_list_of_a_rounded_arm_has_the_configuration_that_made_its_target(
    name: str, digits: int | None
) -> None:
    arm = rounded_arms.arm(name, digits)
    special = [beside(arm, 3, 3, middle, off) for middle in (0.0, np.pi) for off in (0.0, 1e-12, 1e-10)]
    far, complete = nearest_of_all(arm, np.concatenate([rounded_arms.configurations(arm, 10, 1), *special]))
    assert not (complete & (far > CLOSE)).any()


@pytest.mark.parametrize("digits", [4, 9, None])
@pytest.mark.parametrize("name", ["ur10e", "staubli", "no offsets reversed"])
def test_a_seed_that_solves_its_target_is_the_answer_at_any_singularity(name: str, digits: int | None) -> None:
    arm = rounded_arms.arm(name, digits)
    qs = np.concatenate([rounded_arms.configurations(arm, 300, 1), beside(arm, 30, 3, np.pi, 0.0)])
    assert from_seeds(arm, qs).max() < CLOSE


@pytest.mark.slow
@pytest.mark.parametrize("name", rounded_arms.TABLES)
def test_arms_of_every_class_at_and_beside_their_special_values(name: str) -> None:
    for digits in rounded_arms.DIGITS:
        arm = rounded_arms.arm(name, digits)
        qs = rounded_arms.configurations(arm, 10, 2)
        far, complete = nearest_of_all(arm, qs)
        assert not (complete & (far > CLOSE)).any(), digits
        assert from_seeds(arm, qs).max() < CLOSE, digits
