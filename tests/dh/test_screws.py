"""Products of exponentials: against matrix exponentials and published screws, and robots given as screws."""

from typing import Any

import numpy as np
import pytest
from scipy.linalg import expm

from gelenk.dh.tables.from_screws import ScrewJoint, describe_screws, space_axes
from gelenk.dh.tables.screws import adjoint, exponentials, screws_of_chain
from gelenk.errors import InvalidField
from gelenk.kinematics.judge.tables import certify_screws
from gelenk.robot.arrays import Array
from gelenk.robot.poses import inverse
from gelenk.robot.robot import RobotModel
from gelenk.robot.urdf import read_urdf, write_urdf
from tests.oracles import catalogue
from tests.robots import robot, samples, swept

CHAINS = {
    "arm": ("ur5", None, None),
    "hand with a follower": ("panda", "panda_link0", "panda_leftfinger"),
    "from gripper to gripper": ("baxter", "left_gripper", "right_gripper"),
    "sliding joint": ("pr2", "base_footprint", "l_gripper_tool_frame"),
}


def bracket(screw: Array) -> Array:
    """[S] of a screw (ω, v), entry by entry; shape (4, 4)."""
    (x, y, z), v = screw[:3], screw[3:]
    return np.array([[0, -z, y, v[0]], [z, 0, -x, v[1]], [-y, x, 0, v[2]], [0, 0, 0, 0]])


def test_exponentials_are_those_of_matrices() -> None:
    rng = np.random.default_rng(4)
    angles = np.array([-7.0, -1e-9, 0.0, 0.3, 3.0])
    for _ in range(20):
        w = rng.normal(size=3)
        for axis in (np.append(w / np.linalg.norm(w), rng.normal(size=3)), np.append(np.zeros(3), rng.normal(size=3))):
            expected = np.array([expm(bracket(axis) * angle) for angle in angles])
            assert np.abs(exponentials(axis, angles) - expected).max() < 1e-13


@pytest.mark.parametrize("ends", CHAINS.values(), ids=CHAINS)
def test_both_products_are_the_poses_of_the_chain(ends: tuple[str, str | None, str | None]) -> None:
    machine = robot(ends[0])
    chain = machine.chain(ends[1], ends[2])
    found = screws_of_chain(chain.flat)
    certificate = certify_screws(machine, chain, found)
    assert certificate.samples == 100
    assert max(certificate.max_position_error, certificate.max_orientation_error) < 1e-12
    for q in samples(chain, 3):
        thetas = q[found.variables] * found.multipliers
        space, body = np.eye(4), found.home
        for S, B, theta in zip(found.space, found.body, thetas, strict=True):
            space, body = space @ expm(bracket(S) * theta), body @ expm(bracket(B) * theta)
        assert np.abs(space @ found.home - found.poses(q[None])[0]).max() < 1e-12
        assert np.abs(body - found.poses(q[None])[0]).max() < 1e-12


@pytest.mark.quick(1)
@pytest.mark.parametrize("name", swept(catalogue.NAMES))
def test_screws_of_every_robot_are_certified(name: str) -> None:
    machine = robot(name)
    chain = machine.chain(None, None)
    assert certify_screws(machine, chain, screws_of_chain(chain.flat)).max_position_error < 1e-11


def test_screws_of_the_book() -> None:
    """The UR5 of Modern Robotics, example 4.5: its six lengths in metres."""
    W1, W2, L1, L2, H1, H2 = 0.109, 0.082, 0.425, 0.392, 0.089, 0.095
    home = np.array([[-1, 0, 0, L1 + L2], [0, 0, 1, W1 + W2], [0, 1, 0, H1 - H2], [0, 0, 0, 1.0]])
    space = np.array(
        [
            [0, 0, 1, 0, 0, 0],
            [0, 1, 0, -H1, 0, 0],
            [0, 1, 0, -H1, 0, L1],
            [0, 1, 0, -H1, 0, L1 + L2],
            [0, 0, -1, -W1, L1 + L2, 0],
            [0, 1, 0, H2 - H1, 0, L1 + L2],
        ]
    )
    described = describe_screws("ur5", home, space, [ScrewJoint(f"joint_{i}") for i in range(6)])
    machine = RobotModel(read_urdf(write_urdf(described)))
    chain = machine.chain("base", "tool")
    found = screws_of_chain(chain.flat)
    assert found.space == pytest.approx(space, abs=1e-15)
    assert found.home == pytest.approx(home, abs=1e-15)
    # The pose that the book computes at θ2 = -π/2, θ5 = π/2.
    q = np.array([0, -np.pi / 2, 0, 0, np.pi / 2, 0])
    expected = [[0, -1, 0, 0.095], [1, 0, 0, 0.109], [0, 0, 1, 0.988], [0, 0, 0, 1]]
    assert found.poses(q[None])[0] == pytest.approx(np.array(expected), abs=1e-3)
    assert certify_screws(machine, chain, found).max_position_error < 1e-13


@pytest.mark.parametrize("ends", [CHAINS["arm"], CHAINS["sliding joint"]], ids=["arm", "sliding joint"])
def test_a_robot_becomes_screws_and_a_robot_again(ends: tuple[str, str | None, str | None]) -> None:
    """Its own screws and poses, whichever of the two lists is given."""
    machine = robot(ends[0])
    chain = machine.chain(ends[1], ends[2])
    found = screws_of_chain(chain.flat)
    axes = space_axes(found.home, None, found.body)
    assert axes == pytest.approx(found.space, abs=1e-12)
    joints = [ScrewJoint(name, lower=-3.0, upper=3.0) for name in chain.joint_names]
    again = RobotModel(describe_screws("again", found.home, axes, joints))
    assert screws_of_chain(again.chain("base", "tool").flat).space == pytest.approx(found.space, abs=1e-11)
    assert certify_screws(again, again.chain("base", "tool"), found).max_position_error < 1e-11


def test_a_follower_keeps_its_factor() -> None:
    space = np.array([[0, 0, 1, 0, 0, 0], [0, 0, 1, 0, -1.0, 0.0]])
    joints = [ScrewJoint("a"), ScrewJoint("b", variable="a", multiplier=-0.5)]
    machine = RobotModel(describe_screws("coupled", np.eye(4), space, joints))
    found = screws_of_chain(machine.chain("base", "tool").flat)
    assert (found.variables.tolist(), found.multipliers.tolist()) == ([0, 0], [1.0, -0.5])


TURN, SLIDE = [0, 0, 1, 0, 0, 0], [0, 0, 0, 1, 0, 0]
REFUSED: list[tuple[dict[str, Any], str, str]] = [
    ({"space": [[0, 0, 2, 0, 0, 0]]}, "screws/0", "length 1"),
    ({"space": [[0, 0, 0, 0, 3, 0]]}, "screws/0", "length 1"),
    ({"space": [[0, 0, 1, 0, 0, 0.1]]}, "screws/0", "ω · v"),
    ({"space": [TURN], "joints": [ScrewJoint("a"), ScrewJoint("b")]}, "screws/joints", "2 joints for 1 screw"),
    ({"space": [TURN, TURN], "joints": [ScrewJoint("a"), ScrewJoint("a")]}, "screws/joints/1/name", "twice"),
    ({"space": [TURN], "joints": [ScrewJoint("a", "prismatic")]}, "screws/joints/0/type", "revolute"),
    ({"space": [SLIDE], "joints": [ScrewJoint("a", lower=2.0, upper=1.0)]}, "screws/joints/0/lower", "greater"),
    ({"space": [TURN], "joints": [ScrewJoint("a", multiplier=2.0)]}, "screws/joints/0/multiplier", "must be 1"),
    ({"space": [TURN], "joints": [ScrewJoint("a", variable="x")]}, "screws/joints/0/variable", "moves by itself"),
]


@pytest.mark.parametrize(("given", "field", "reason"), REFUSED)
def test_what_is_no_robot_is_refused_with_its_place(given: dict[str, Any], field: str, reason: str) -> None:
    joints = given.get("joints", [ScrewJoint(f"joint_{i}") for i in range(len(given["space"]))])
    with pytest.raises(InvalidField) as refused:
        describe_screws("robot", np.eye(4), np.array(given["space"], dtype=float), joints)
    assert refused.value.field == field
    assert reason in refused.value.reason


def test_two_lists_of_axes_must_agree() -> None:
    home, space = np.eye(4), np.array([TURN], dtype=float)
    home[0, 3] = 1.0
    body = space @ adjoint(inverse(home)).T
    assert space_axes(home, space, body) == pytest.approx(space)
    for wrong in (space, np.tile(body, (2, 1))):
        with pytest.raises(InvalidField, match="give one of the two"):
            space_axes(home, space, wrong)
    with pytest.raises(InvalidField, match="or both"):
        space_axes(home, None, None)
