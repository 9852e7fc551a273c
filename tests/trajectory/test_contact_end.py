"""Motions in a cell: a tool turns away from what it would touch, what blocks it is named, paths end before contacts."""

from functools import cache

import numpy as np

from gelenk.collision.bodies import Body
from gelenk.collision.cell import Cell, cell_in
from gelenk.collision.contact.world import build_world
from gelenk.collision.robot_bodies import RobotBodies
from gelenk.collision.scene import Obstacle
from gelenk.collision.shapes.covers import covered_body
from gelenk.robot.arrays import Array
from gelenk.robot.chain import Chain
from gelenk.robot.notations import rotations_from_vectors
from gelenk.robot.poses import Poses, transform
from gelenk.trajectory.audit.contact.clearance import RESOLUTION
from gelenk.trajectory.plan import plan
from gelenk.trajectory.problem.problem import FreeTool, Segment, SegmentLimits, Trajectory, TrajectoryProblem
from tests.robots import robot as robot_of

NAME = "ur5_dh"
ONES = np.ones(6)
LIMITS = SegmentLimits(ONES, 4.0 * ONES, 40.0 * ONES)
HOME = np.array([0.0, -1.5, 1.5, -1.5, -1.5, 0.0])


@cache
def chain_of() -> Chain:
    return robot_of(NAME).chain(None, None)


def box(name: str, link: str, size: tuple[float, float, float], position: tuple[float, float, float]) -> Body:
    return covered_body(name, link, "box", size, transform(np.array(position), np.eye(3)))


def cell(wall_at: float) -> Cell:
    """A bar across the tip, and a wall."""
    robot, chain = robot_of(NAME), chain_of()
    bar = Obstacle("bar", (box("bar", chain.tip_frame, (0.3, 0.02, 0.05), (0.15, 0.0, 0.05)),), chain.tip_frame)
    wall = Obstacle("wall", (box("wall", robot.description.root, (0.02, 2.0, 1.0), (wall_at, 0.0, 0.2)),))
    return cell_in(build_world(robot, chain, RobotBodies((), (), ()), (bar, wall)))


def seam() -> Poses:
    """A line across the front of the arm, with the tool downwards."""
    ys = np.linspace(-0.1, 0.1, 5)
    down = rotations_from_vectors(np.array([[np.pi, 0.0, 0.0]]))
    return Poses(np.column_stack((0.5 + 0.0 * ys, ys, 0.2 + 0.0 * ys)), np.repeat(down, 5, axis=0))


def welded(cell: Cell | None, start: Array | None = None) -> Trajectory:
    along, move = Segment("spline", "time_optimal", LIMITS, poses=seam()), Segment("joint", "trapezoidal", LIMITS)
    segments, begin = ((along,), HOME) if start is None else ((move, along), start)
    tool = FreeTool(np.array([0.0, 0.0, 1.0]), 12)
    return plan(robot_of(NAME), chain_of(), TrajectoryProblem(begin, segments, tool=tool, cell=cell))


def test_a_tool_turns_away_from_what_it_would_touch() -> None:
    plain = welded(None)
    touched = cell(0.55)
    assert touched.touching(plain.motion.at(np.linspace(0.0, plain.motion.duration, 100))).any()
    found = welded(touched)
    assert found.failure is None
    assert found.audit.clearance is not None
    assert (found.audit.clearance.lower_bound or 0.0) > 0.0
    assert not touched.touching(found.motion.at(np.linspace(0.0, found.motion.duration, 1000))).any()


def test_a_pose_at_which_every_turn_touches_is_named() -> None:
    found = welded(cell(0.5), HOME)
    assert found.failure is not None
    assert found.failure.reason == "collision"
    assert "'bar' and 'wall' overlap" in found.failure.detail
    assert found.motion.duration == 0.0


def test_a_line_ends_where_the_cell_ends() -> None:
    robot, chain = robot_of(NAME), chain_of()
    first = welded(None).motion.coefficients[0, 0]
    target = transform(np.array([0.5, 0.1, 0.2]), seam().rotations[0])
    to_wall = target + np.array([[0, 0, 0, 0.2], [0, 0, 0, -0.2], [0, 0, 0, 0.0], [0, 0, 0, 0.0]])
    here = cell(0.85)
    for law in ("quintic", "time_optimal"):
        line = Segment("line", law, LIMITS, pose=to_wall)
        found = plan(robot, chain, TrajectoryProblem(first, (line,), cell=here))
        clearance = found.audit.clearance
        assert found.failure is not None and clearance is not None and found.failure.first_contact is not None
        assert found.failure.reason == "collision"
        assert 0.3 < found.completed_fraction < 1.0
        assert 0.0 < (clearance.value or 0.0) < 3.0 * RESOLUTION
        last = found.motion.derivative().at(found.motion.breaks[-1:])
        np.testing.assert_allclose(last, 0.0, atol=1e-9)
