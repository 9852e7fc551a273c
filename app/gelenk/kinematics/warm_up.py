"""Warm-up: compile every kernel, or load it from the cache, before the first request needs it."""

import math
from collections.abc import Sequence
from concurrent.futures import ProcessPoolExecutor
from dataclasses import replace
from functools import cache
from multiprocessing import get_context

import numpy as np

from gelenk.collision.cell import cell_in
from gelenk.collision.contact.gradient import pair_gradients, soft_clearances
from gelenk.collision.contact.kernels import (
    all_contacts,
    always_in_contact,
    first_contacts,
    first_free,
    nearest_pairs,
    pair_distances,
)
from gelenk.collision.contact.world import build_world
from gelenk.collision.robot_bodies import RobotBodies
from gelenk.collision.scene import Obstacle
from gelenk.collision.shapes.covers import covered_body
from gelenk.collision.shapes.planes import best_plane
from gelenk.collision.shapes.surfaces import parts_of, surface_of
from gelenk.dh.tables.convert import describe_dh
from gelenk.ik.closed.closed_form import closed_form
from gelenk.ik.closed.nearest_branch import nearest_branch
from gelenk.ik.count.continuation import continuation
from gelenk.ik.quick import quick_search
from gelenk.ik.search.bounds import mid_range, target_rows
from gelenk.ik.search.problem import TargetProblem
from gelenk.ik.search.restarts import solutions_by_distance
from gelenk.ik.search.search import search, start_of
from gelenk.ik.solve import Options, inverse_kinematics
from gelenk.ik.verdict.branches import all_branches
from gelenk.kinematics.dynamics.mechanism import mechanism
from gelenk.kinematics.dynamics.torques import torque_limits
from gelenk.kinematics.judge.judge import recomputed_poses
from gelenk.kinematics.poses.forward import forward_kinematics
from gelenk.kinematics.poses.quick import quick_pose
from gelenk.kinematics.simd.kernels import chain_measures
from gelenk.kinematics.velocity.jacobian import jacobians
from gelenk.robot.arrays import Array
from gelenk.robot.chain import Chain
from gelenk.robot.compilation import is_stored, note_stored
from gelenk.robot.configuration import configurations
from gelenk.robot.dh import DhJoint, DhTable
from gelenk.robot.notations import (
    quaternions_xyzw_from_rotations,
    rotations_from_quaternions_xyzw,
    rotations_from_vectors,
    rotations_from_zyz,
    turn_by_quaternions_xyzw,
    vectors_from_rotations,
)
from gelenk.robot.poses import Poses
from gelenk.robot.robot import RobotModel
from gelenk.trajectory.audit.contact.search import least_slack
from gelenk.trajectory.audit.deviations import deviations
from gelenk.trajectory.audit.pieces import pieces_of
from gelenk.trajectory.batch import plan_batch
from gelenk.trajectory.follow.kernels.nearest import nearest
from gelenk.trajectory.follow.ladder import Metric, Rungs, way_up
from gelenk.trajectory.laws.jerk_limited import jerk_limited
from gelenk.trajectory.motion.polynomial import PiecewisePolynomial
from gelenk.trajectory.paths.corners import blended_lines
from gelenk.trajectory.paths.rotation_splines import rotation_spline
from gelenk.trajectory.plan import plan
from gelenk.trajectory.problem.problem import Segment, SegmentLimits, TrajectoryProblem
from gelenk.trajectory.tool.singularity import regular


@cache
def warm_up() -> None:
    """Run every kernel once, so that all are compiled or loaded; nothing is left to do for a second call."""
    quick()
    _contacts()
    note_stored()


@cache
def quick() -> None:
    """Run the kernels of answers that the event loop computes itself: those about contacts come from workers."""
    basics()
    for part in PARTS:
        if part is not _contacts:
            part()
    _answers()


def basics() -> None:
    """Run the kernels that most requests and all `PARTS` need: poses, Jacobians, notations, iterative methods."""
    robot, chain, qs = _small_arm()
    poses = forward_kinematics(robot, chain, qs).poses
    quick_pose(robot, chain)(qs[0].tolist())
    jacobians(robot, chain, qs)
    inverse_kinematics(robot, chain, poses, qs, Options(method="damped_least_squares"))
    Rs = poses.rotations
    quaternions = quaternions_xyzw_from_rotations(Rs)
    turn_by_quaternions_xyzw(quaternions, rotations_from_quaternions_xyzw(quaternions))
    rotations_from_vectors(vectors_from_rotations(Rs))
    rotations_from_zyz(np.zeros((1, 3)))
    chain_measures(chain.flat, qs, np.arange(3))
    recomputed_poses(robot, chain, qs)


def _arm(rows: Sequence[tuple[float, float, float, float]]) -> tuple[RobotModel, Chain]:
    """Example robot from a DH table of revolute joints, and its chain."""
    joints = tuple(DhJoint(f"joint_{i}", "revolute", *row) for i, row in enumerate(rows, start=1))
    robot = RobotModel(describe_dh("warm-up", DhTable("standard", joints)))
    return robot, robot.chain(None, None)


@cache
def _small_arm() -> tuple[RobotModel, Chain, Array]:
    """Example robot with three joints, its chain, and a configuration; shape (1, 3), [rad]."""
    robot, chain = _arm([(0.3, 1.0, 0.1, 0.5)] * 3)
    return robot, chain, configurations(chain, [[0.1, 0.2, 0.3]])


def _searches() -> None:
    """Run iterative and continuation solvers, and derivatives of Jacobians; no closed form."""
    robot, chain, qs = _small_arm()
    for representation in ("zyz", "rpy"):
        poses = jacobians(robot, chain, qs, representation=representation, derivatives=True).poses
    problem = TargetProblem(robot, chain, poses, qs, Options(most=1))
    search(problem, max_iterations=100)
    quick_search(robot, chain, problem.task, problem.tolerances, True, 1, 0).of_each(poses, qs)
    solutions_by_distance(chain.flat, problem.goal(2), target_rows(poses), qs, qs, 0, 1)
    all_branches(problem, 0)
    start_of(problem, 0, 1)
    continuation(_six_joints()[1])


@cache
def _six_joints() -> tuple[RobotModel, Chain]:
    """Example arm that needs continuation: three parallel axes, the others skew; once, as recognising it takes time."""
    return _arm([(0.3, 1.0 if i > 2 else 0.0, 0.1, 0.5) for i in range(1, 7)])


def _closed_forms() -> None:
    """Solve an arm with a free elbow, which uses the kernels of every closed form."""
    alphas = (-0.5, 0.5, 0.5, -0.5, -0.5, 0.5, 0.0)
    lengths = (0.3, 0.0, 0.3, 0.0, 0.3, 0.0, 0.3)
    robot, chain = _arm([(0.0, math.pi * alpha, d, 0.0) for alpha, d in zip(alphas, lengths, strict=True)])
    qs = np.full((1, 7), 0.4)
    poses = forward_kinematics(robot, chain, qs).poses
    for every in (False, True):
        inverse_kinematics(robot, chain, poses, qs, Options(every=every, method="analytic"))
    wrist = ((0.5, 0.0, 0.3), (0.0, 0.4, 0.0), (0.5, 0.0, 0.0), (-0.5, 0.0, 0.3), (0.5, 0.0, 0.0), (0.0, 0.0, 0.1))
    form = closed_form(_arm([(a, math.pi * alpha, d, 0.0) for alpha, a, d in wrist])[1])
    if form is not None:
        nearest_branch(form)(np.eye(4), np.zeros(6))


def _motions() -> None:
    """Plan and audit a movement of the joints and the fastest motions along a spline; find a point of a path."""
    robot, chain, qs = _small_arm()
    torque = torque_limits(mechanism(robot, chain), np.full(3, 1e3), np.zeros(3), None)
    limits, start = replace(SegmentLimits(*np.ones((3, 3))), torque=torque), qs[0]
    move = Segment("joint", "jerk_limited", limits, configuration=start + 0.5)
    points = start + np.array([[0.2], [0.3]])
    way = Segment("spline", "time_optimal", limits, configurations=points, stated_jerk=limits.jerk)
    free = replace(way, limits=replace(limits, torque=None))
    plan(robot, chain, TrajectoryProblem(start, (move, way, free))).motion.rates_at(np.zeros(1))
    plan_batch(robot, chain, qs, qs + 0.5, move)
    jerk_limited(np.zeros((3, 3)), np.eye(3), np.ones((3, 3)))
    robot_6, six = _six_joints()
    poses, along = forward_kinematics(robot_6, six, np.full((1, 6), 0.4)).poses, SegmentLimits(*np.ones((3, 6)))
    goal = poses.matrices()[0]
    goal[:3, 3] += 0.05
    line = Segment("line", "time_optimal", along, pose=goal)
    plan(robot_6, six, TrajectoryProblem(np.full(6, 0.4), (line,)))
    nearest(six.flat, np.zeros(3), np.eye(3), *np.zeros((3, 6)))
    samples = np.zeros((1, 3)), np.eye(3)[None]
    deviations(*samples, *samples)
    rotation_spline(rotations_from_vectors(0.1 * np.arange(12.0).reshape(4, 3)), np.arange(4.0)).at(np.zeros(1))
    corner = Poses(np.eye(3), np.array([np.eye(3)] * 3))
    for path in (sequence := blended_lines(corner, [0.1]), *sequence.parts):
        path.at(np.zeros(1))
    metric = Metric(np.ones(3), np.ones(3), np.zeros(3, dtype=bool))
    way_up(Rungs(np.zeros((2, 3)), np.arange(3)), metric, np.zeros(1))
    regular(chain.flat, qs, 0.0)


def _contacts() -> None:
    """Find the contacts of an arm with a ball on its tip and a box at its base, and cut a mesh."""
    robot, chain, qs = _small_arm()
    held = (covered_body("held", chain.tip_frame, "sphere", (0.1,), np.eye(4)),)
    near = (covered_body("near", chain.base_frame, "box", (0.1, 0.1, 0.1), np.eye(4)),)
    scene = Obstacle("held", held, chain.tip_frame), Obstacle("near", near)
    world = build_world(robot, chain, RobotBodies((), (), ()), scene).flat
    first_contacts(world, qs)
    first_free(world, qs, *np.arange(2)[:, None])
    nearest_pairs(world, qs)
    pair_distances(world, qs, np.zeros(1, dtype=np.int64))
    all_contacts(world, qs[0])
    pair_gradients(world, qs, np.zeros(1, dtype=np.int64))
    soft_clearances(world, qs, 0.01)
    always_in_contact(world, qs, np.zeros(1, dtype=np.int64), 1)
    least_slack(world, pieces_of(PiecewisePolynomial(np.arange(2.0), qs[None])), 1.0)
    (triangle,) = parts_of(surface_of(np.eye(3)[None]))
    best_plane(triangle, np.eye(3))


def _answers() -> None:
    robot, chain, qs = _small_arm()
    poses, start = forward_kinematics(robot, chain, qs).poses, mid_range(chain)[None]
    for options in (Options(), Options(every=True), Options(trace=True, max_iterations=1)):
        inverse_kinematics(robot, chain, poses, start, options)
    cell = cell_in(build_world(robot, chain, RobotBodies((), (), ())))
    move = Segment("joint", "trapezoidal", SegmentLimits(*np.ones((3, 3))))
    plan_batch(robot, chain, qs, qs + 0.5, move, cell)
    (robot, chain), qs = _six_joints(), np.full((1, 6), 0.4)
    inverse_kinematics(robot, chain, forward_kinematics(robot, chain, qs).poses, qs, Options(every=True))


PARTS = (_closed_forms, _searches, _motions, _contacts)
"""Parts that separate processes can compile after `basics`; the rest takes seconds."""

if __name__ == "__main__" and not is_stored():
    basics()
    with ProcessPoolExecutor(mp_context=get_context("fork")) as processes:
        for compiled in [processes.submit(part) for part in PARTS]:
            compiled.result()
    warm_up()
