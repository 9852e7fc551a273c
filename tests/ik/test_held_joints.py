"""Arms of seven joints with one held: every branch of the six that remain."""

import numpy as np
import pytest

from gelenk.ik.solve import Options, inverse_kinematics
from tests.ik.arm_classes import QUARTER, Arm, Row
from tests.ik.arms import poses
from tests.ik.test_complete import doubts_of, missed

FR3: list[Row] = [
    (0.0, 0.0, 0.333, 0.0),
    (0.0, -QUARTER, 0.0, 0.0),
    (0.0, QUARTER, 0.316, 0.0),
    (0.0825, QUARTER, 0.0, 0.0),
    (-0.0825, -QUARTER, 0.384, 0.0),
    (0.0, QUARTER, 0.0, 0.0),
    (0.088, QUARTER, 0.107, 0.0),
]
"""Franka's table, by the modified convention."""
GEN3: list[Row] = [
    (0.0, QUARTER, -0.2848, 0.0),
    *((0.0, QUARTER, -d, np.pi) for d in (0.0118, 0.4208, 0.0128, 0.3143, 0.0)),
    (0.0, np.pi, -0.1674, np.pi),
]
"""Kinova's table of the arm with seven joints, its shoulder and elbow 12 mm off."""


def arm(name: str) -> Arm:
    return Arm(FR3, "RRRRRRR", "modified") if name == "fr3" else Arm(GEN3, "RRRRRRR")


def check(name: str, joint: int, value: float, count: int) -> tuple[int, int]:
    """How many generators are not listed, and how many lists are complete; none of these lacks its generator."""
    held = arm(name)
    qs = held.configurations(count, seed=joint)
    qs[:, joint] = value
    options = Options(every=True, respect_limits=False, most=200, fixed_joints={held.chain.joint_names[joint]: value})
    targets = poses(held.robot, held.chain, qs)
    answer = inverse_kinematics(held.robot, held.chain, targets, np.full((1, 7), 0.1), options)
    assert (answer.qs[:, joint] == value).all()
    lost, doubtful = missed(held, qs, answer), doubts_of(answer)
    assert not (lost & ~doubtful).any()
    return int(lost.sum()), int((~doubtful).sum())


@pytest.mark.quick(1)
@pytest.mark.parametrize("joint", range(7))
@pytest.mark.parametrize("name", ["fr3", "gen3"])
def test_every_branch_is_listed_whichever_joint_is_held(name: str, joint: int) -> None:
    lost, complete = check(name, joint, 0.6, 8)
    assert lost == 0
    assert complete >= 7


@pytest.mark.slow
@pytest.mark.parametrize("joint", range(7))
@pytest.mark.parametrize("name", ["fr3", "gen3"])
def test_nearly_all_generators_are_listed(name: str, joint: int) -> None:
    assert sum(check(name, joint, value, 100)[0] for value in (-1.9, 0.3, 2.4)) <= 1
