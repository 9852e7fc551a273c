"""URDFs whose angles are rounded as exporters round them: nothing that is said to be complete lacks a solution."""

import warnings
from collections.abc import Iterator, Sequence

import numpy as np
import pytest
from scipy.spatial.transform import Rotation

from gelenk.ik.closed.closed_form import closed_form
from gelenk.ik.solve import Options, inverse_kinematics
from gelenk.robot.arrays import Array, Flags
from gelenk.robot.robot import RobotModel
from gelenk.robot.urdf import read_urdf
from tests.ik import rounded_arms
from tests.ik.arm_classes import Arm, Row, seven
from tests.ik.arms import poses
from tests.ik.test_rounded import CLOSE, from_seeds, nearest_of_all

DIGITS = (2, 4, 7)
"""1.57 and 3.14, 1.5708 and 3.1416, 1.5707963 and 3.1415927."""
NAMES = ("ur5e", "ur10e", "puma", "staubli", "no offsets", "shoulder and elbow offset")
SEVEN = seven(np.random.default_rng(5), 0.0)


class Exported(Arm):
    """A table as a URDF whose frames lie along any axes and whose angles are rounded."""

    def __init__(self, parameters: Sequence[Row], digits: int, seed: int) -> None:
        super().__init__(list(parameters), "R" * len(parameters))
        self.robot = RobotModel(read_urdf("".join(_urdf(parameters, digits, np.random.default_rng(seed)))))
        self.chain = self.robot.chain(None, None)


def _urdf(parameters: Sequence[Row], digits: int, rng: np.random.Generator) -> Iterator[str]:
    yield '<robot name="exported"><link name="link_0"/>'
    before, R, p = np.eye(3), np.eye(3), np.zeros(3)
    for i, (a, alpha, d, theta) in enumerate([*parameters, (0.0, 0.0, 0.0, 0.0)]):
        # The joint's axis is one of the frame's own, forwards.
        frame = Rotation.from_euler("zyx", 0.5 * np.pi * rng.integers(0, 4, 3)).as_matrix()
        with warnings.catch_warnings(action="ignore"):  # of angles that are not unique
            rpy = np.round(Rotation.from_matrix(before.T @ R @ frame).as_euler("xyz"), digits)
        xyz, axis = before.T @ p, np.rint(frame.T[:, 2])
        moves = i < len(parameters)
        yield f'<link name="link_{i + 1}"/><joint name="joint_{i + 1}" type="{"continuous" if moves else "fixed"}">'
        yield f'<parent link="link_{i}"/><child link="link_{i + 1}"/><axis xyz="{_words(axis)}"/>'
        yield f'<origin xyz="{_words(xyz)}" rpy="{_words(rpy)}"/></joint>'
        turn = Rotation.from_euler("z", theta).as_matrix()
        before, R = frame, turn @ Rotation.from_euler("x", alpha).as_matrix()
        p = turn @ [a, 0.0, d]
    yield "</robot>"


def _words(numbers: Array) -> str:
    return " ".join(f"{number:.12g}" for number in numbers + 0.0)


def with_elbow(arm: Arm, qs: Array) -> tuple[Array, Flags]:
    """As `nearest_of_all`, of seven joints with the elbow where each configuration has it."""
    form, far, complete = closed_form(arm.chain), np.empty(len(qs)), np.zeros(len(qs), dtype=bool)
    assert form is not None
    for i, target in enumerate(qs):
        angle = float(form.elbow_angles(target[None])[0])
        options = Options(every=True, respect_limits=False, elbow_angle=angle)
        there = poses(arm.robot, arm.chain, target[None])
        answer = inverse_kinematics(arm.robot, arm.chain, there, np.full((1, 7), 0.1), options)
        assert answer.complete is not None
        far[i] = np.abs(arm.differences(answer.qs, target)).max(axis=1, initial=0.0).min(initial=np.inf)
        complete[i] = answer.complete[0]
    return far, complete


def check(name: str, digits: int, seed: int, count: int) -> None:
    arm = Exported(rounded_arms.TABLES[name][0], digits, seed)
    qs = rounded_arms.configurations(arm, count, 1)
    far, complete = nearest_of_all(arm, qs)
    assert not (complete & (far > CLOSE)).any()
    assert from_seeds(arm, qs).max() < CLOSE


@pytest.mark.quick(1)
@pytest.mark.parametrize(
    ("name", "digits", "seed"), [("ur5e", 4, 1), ("ur10e", 7, 1), ("puma", 2, 1), ("staubli", 4, 2)]
)
def test_an_exported_arm_of_six_joints(name: str, digits: int, seed: int) -> None:
    check(name, digits, seed, 12)


@pytest.mark.parametrize("digits", DIGITS)
def test_an_exported_arm_with_a_free_elbow(digits: int) -> None:
    arm = Exported(SEVEN, digits, seed=1)
    qs = rounded_arms.configurations(arm, 8, 1)
    far, complete = with_elbow(arm, qs)
    assert not (complete & (far > CLOSE)).any()
    assert from_seeds(arm, qs).max() < CLOSE


@pytest.mark.slow
@pytest.mark.parametrize("digits", DIGITS)
@pytest.mark.parametrize("name", NAMES)
def test_exported_arms_at_and_beside_their_special_values(name: str, digits: int) -> None:
    check(name, digits, seed=3, count=40)
