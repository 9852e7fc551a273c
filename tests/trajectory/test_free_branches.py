"""A motion of the joints to a pose in a cell: it ends on the nearest branch that touches nothing there."""

import numpy as np
import pytest

from gelenk.collision.bodies import Body
from gelenk.collision.cell import Cell, Nearest, cell_in
from gelenk.collision.contact.world import build_world
from gelenk.collision.robot_bodies import RobotBodies
from gelenk.collision.scene import Obstacle
from gelenk.collision.shapes.covers import covered_body
from gelenk.errors import CertificationFailed
from gelenk.ik.search.problem import Options, TargetProblem
from gelenk.ik.solve import solve
from gelenk.kinematics.simd.kernels import chain_poses
from gelenk.robot.arrays import Array
from gelenk.robot.poses import Poses, transform
from gelenk.trajectory.plan import plan
from gelenk.trajectory.problem.problem import Segment, SegmentLimits, Trajectory, TrajectoryProblem
from tests.robots import robot as robot_of

START = {
    "ur5": np.array([0.4, -1.2, 1.4, -1.7, -1.4, 0.2]),
    "panda": np.array([0.0, -0.785, 0.0, -2.356, 0.0, 1.571, 0.785]),
}
ELBOW = {"ur5": "forearm_link", "panda": "panda_link4"}
BALL, SIDE = 0.03, 0.08
"""Radius of a ball on the elbow, and side of a cube in its way, [m]."""


def elbows(name: str, qs: Array) -> Array:
    """Return where the elbow is at each configuration, (N, n) → (N, 3)."""
    robot = robot_of(name)
    whole = robot.chain(None, None)
    part = robot.chain(whole.base_frame, ELBOW[name])
    positions: Array = chain_poses(part.flat, np.ascontiguousarray(qs[:, : len(part)]))[0]
    return positions


def goal(name: str) -> Array:
    """Return a pose near the start, which bends all joints a little; shape (4, 4)."""
    near = START[name][None] + 0.2
    T: Array = Poses(*chain_poses(robot_of(name).chain(None, None).flat, near)).matrices()[0]
    return T


def cell(name: str, at: Array, frame: str, min_clearance: float = 0.0) -> Cell:
    """Return a ball on a frame of an arm without other bodies, and a cube at a position of its base."""
    robot = robot_of(name)
    chain = robot.chain(None, None)
    ball: Body = covered_body("ball", frame, "sphere", (BALL,), np.eye(4))
    cube: Body = covered_body("cube", chain.base_frame, "box", (SIDE,) * 3, transform(at, np.eye(3)))
    around = Obstacle("ball", (ball,), frame), Obstacle("cube", (cube,), chain.base_frame)
    return cell_in(build_world(robot, chain, RobotBodies((), (), ()), around), min_clearance)


def planned(name: str, cell: Cell | None) -> Trajectory:
    robot = robot_of(name)
    chain = robot.chain(None, None)
    n = len(chain)
    limits = SegmentLimits(np.full(n, 3.0), np.full(n, 6.0), np.full(n, 60.0))
    move = Segment("joint", "quintic", limits, pose=goal(name))
    return plan(robot, chain, TrajectoryProblem(START[name], (move,), cell=cell))


def end(found: Trajectory) -> Array:
    return found.motion.at(found.motion.breaks[-1:])


def gaps(name: str, qs: Array, at: Array) -> Array:
    """Return the distance of the ball on the elbow from the cube, by the formula for the two; shape (N,), [m]."""
    outside = np.maximum(np.abs(elbows(name, qs) - at) - 0.5 * SIDE, 0.0)
    return np.asarray(np.linalg.norm(outside, axis=1) - BALL)


@pytest.mark.parametrize("name", ["ur5", "panda"])
def test_a_cube_that_blocks_nothing_changes_nothing(name: str) -> None:
    found, plain = planned(name, cell(name, np.array([0.0, 0.0, 3.0]), ELBOW[name])), planned(name, None)
    np.testing.assert_array_equal(found.motion.coefficients, plain.motion.coefficients)


@pytest.mark.parametrize("min_clearance", [0.0, 0.05])
def test_the_nearest_branch_that_keeps_clear_is_taken(min_clearance: float) -> None:
    name = "ur5"
    robot, chain = robot_of(name), robot_of(name).chain(None, None)
    T = goal(name)[None]
    target = TargetProblem(robot, chain, Poses(T[:, :3, 3], T[:, :3, :3]), START[name][None], Options(every=True))
    branches = solve(target).qs
    nearest = branches[np.argsort(np.linalg.norm(branches - START[name], axis=1))]
    at = elbows(name, nearest)[0] + [0.0, 0.06 + min_clearance, 0.0]  # beside the way to the other branch
    touches = gaps(name, nearest, at) <= min_clearance
    found = planned(name, cell(name, at, ELBOW[name], min_clearance))
    assert touches[0]
    np.testing.assert_allclose(end(found)[0], nearest[~touches][0], atol=1e-9)
    assert found.failure is None
    assert found.audit.passed
    assert found.audit.clearance is not None
    assert (found.audit.clearance.lower_bound or 0.0) >= min_clearance
    assert (gaps(name, found.motion.at(np.linspace(0.0, found.motion.duration, 500)), at) > min_clearance).all()


def test_an_elbow_that_can_go_round_does() -> None:
    name = "panda"
    at = elbows(name, end(planned(name, None)))[0] + [0.0, 0.0, 0.06]
    found = planned(name, cell(name, at, ELBOW[name]))
    assert gaps(name, end(planned(name, None)), at)[0] < 0.0 < gaps(name, end(found), at)[0]
    reached = Poses(*chain_poses(robot_of(name).chain(None, None).flat, end(found))).matrices()[0]
    np.testing.assert_allclose(reached, goal(name), atol=1e-5)


@pytest.mark.parametrize(("name", "words"), [("ur5", "all 8 solutions are"), ("panda", "solutions found are")])
def test_a_pose_without_a_free_branch_is_a_failure_with_pair_and_depth(name: str, words: str) -> None:
    tip = robot_of(name).chain(None, None).tip_frame
    found = planned(name, cell(name, goal(name)[:3, 3] + [0.01, 0.005, 0.002], tip))
    assert found.failure is not None
    assert (found.failure.reason, found.failure.segment, found.motion.duration) == ("collision", 0, 0.0)
    assert words in found.failure.detail
    assert "'ball' and 'cube' overlap by 0.06 m" in found.failure.detail
    assert found.failure.first_contact is None
    assert found.audit.passed


def test_a_contact_that_coal_does_not_see_is_withheld(monkeypatch: pytest.MonkeyPatch) -> None:
    here = cell("ur5", goal("ur5")[:3, 3] + [0.01, 0.005, 0.002], robot_of("ur5").chain(None, None).tip_frame)
    nearest = Cell.nearest

    def off(one: Cell, qs: Array) -> Nearest:
        found = nearest(one, qs)
        return found._replace(clearances=found.clearances + 1e-3)

    monkeypatch.setattr(Cell, "nearest", off)
    with pytest.raises(CertificationFailed):
        planned("ur5", here)
