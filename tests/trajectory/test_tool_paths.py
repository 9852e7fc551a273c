"""Paths of a tool that may turn about an axis: the choice against Dijkstra's algorithm, the motion against SciPy."""

from dataclasses import replace
from functools import cache

import numpy as np
import pytest
from scipy.interpolate import CubicSpline
from scipy.sparse import coo_array
from scipy.sparse.csgraph import dijkstra
from scipy.spatial.transform import Rotation, RotationSpline

from gelenk.errors import InvalidField
from gelenk.ik.search.bounds import mid_range
from gelenk.ik.solve import Options, inverse_kinematics
from gelenk.kinematics.simd.kernels import chain_jacobians, chain_poses
from gelenk.robot.arrays import Array
from gelenk.robot.chain import Chain
from gelenk.robot.poses import Poses
from gelenk.trajectory.motion.polynomial import PiecewisePolynomial
from gelenk.trajectory.paths.spline_paths import spline
from gelenk.trajectory.paths.turned_path import TurnedPath
from gelenk.trajectory.plan import plan
from gelenk.trajectory.problem.problem import FreeTool, Segment, SegmentLimits, Trajectory, TrajectoryProblem
from gelenk.trajectory.tool.sequence import tool_sequence
from gelenk.trajectory.tool.singularity import regular
from tests.robots import robot
from tests.trajectory.test_follow import pinocchio_poses

ARM = "ur5_joint_limited"
AT = np.array([0.3, -1.2, 1.3, -1.6, -1.2, 0.4])
X, Z, NONE = np.eye(3)[0], np.eye(3)[2], np.zeros(3)
VELOCITY = np.array([1.0, 1.0, 1.5, 2.0, 2.0, 3.0])


@cache
def chain_of(name: str = ARM) -> Chain:
    one = robot(name)
    return one.chain(*one.default_chain)


def velocity_of(chain: Chain) -> Array:
    return VELOCITY if len(chain) == 6 else np.append(VELOCITY, 2.0)


def seam(count: int = 12, turn: float = 1.0, rise: float = 0.03, q: Array = AT, name: str = ARM) -> Poses:
    """Poses along most of a circle of 30 cm from where the tip is at a configuration, leaning and turning about z."""
    position, rotation = (each[0] for each in chain_poses(chain_of(name).flat, q[None]))
    u = np.linspace(0.0, 1.0, count)
    offsets = np.column_stack((0.15 * (np.cos(5.6 * u) - 1.0), 0.15 * np.sin(5.6 * u), rise * np.sin(9.0 * u)))
    leaning = Rotation.from_rotvec(np.column_stack((0.2 * np.sin(5.0 * u), 0.1 * u, 0.0 * u)))
    turning = Rotation.from_rotvec(turn * u[:, None] * Z)
    rotations = (Rotation.from_matrix(rotation) * leaning * turning).as_matrix()
    return Poses(position + offsets, np.ascontiguousarray(rotations))


def planned(
    poses: Poses, axis: Array = Z, start: Array | None = None, law: str = "time_optimal", name: str = ARM
) -> Trajectory:
    velocity = velocity_of(chain_of(name))
    limits = SegmentLimits(velocity, 4.0 * velocity, 40.0 * velocity)
    path = Segment("spline", law, limits, poses=poses)  # type: ignore[arg-type]
    segments = (path,) if start is None else (replace(path, type="joint", poses=None), path)
    problem = TrajectoryProblem(
        mid_range(chain_of(name)) if start is None else start, segments, tool=FreeTool(axis, 24)
    )
    return plan(robot(name), chain_of(name), problem)


def test_derivatives_of_a_turned_path_are_its_differences() -> None:
    path = spline(seam(6))
    angle = PiecewisePolynomial(np.array([0.0, path.extent]), np.array([[[0.3], [2.0], [-1.5], [4.0]]]))
    turned, h, s = TurnedPath(path, X, angle), 1e-5, np.linspace(0.05, 0.7, 7)
    before, at, after = (turned.at(s + step) for step in (-h, 0.0, h))
    R = Rotation.from_matrix(after.poses.rotations) * Rotation.from_matrix(before.poses.rotations).inv()
    np.testing.assert_allclose(at.first[:, 3:], R.as_rotvec() / (2.0 * h), atol=1e-7)
    np.testing.assert_allclose(at.second, (after.first - before.first) / (2.0 * h), atol=1e-6)
    assert turned.extent == pytest.approx(path.extent)


def test_regular_configurations_are_those_of_the_singular_values() -> None:
    flat = chain_of().flat
    qs = np.random.default_rng(3).uniform(-3.0, 3.0, (400, 6))
    sizes = np.linalg.svd(chain_jacobians(flat, qs)[2], compute_uv=False)[:, -1]
    for least in (0.0, 0.02, float(np.median(sizes)), 10.0):
        assert (regular(flat, qs, least) == (sizes >= least)).all()


def _least_travel(poses: Poses, places: Array, name: str = ARM, fixed: dict[str, float] | None = None) -> float:
    """The least joint travel over all branches on the way, by Dijkstra's algorithm; margins of the planner's widths."""
    one, chain = robot(name), chain_of(name)
    at, velocity = spline(poses).at(places).poses, velocity_of(chain)
    options = Options(every=True, method="analytic", fixed_joints=fixed or {})
    found = inverse_kinematics(one, chain, at, mid_range(chain)[None], options)
    margin = np.minimum(0.01, 0.01 * (chain.upper - chain.lower))
    clear = ((found.qs >= chain.lower + margin) & (found.qs <= chain.upper - margin)).all(axis=1)
    rows, columns, costs = [], [], []
    size = len(found.qs)
    for i in range(len(places)):
        own = np.flatnonzero(clear & (found.owners == i))
        before = np.array([size]) if i == 0 else np.flatnonzero(clear & (found.owners == i - 1))
        for b in own:
            steps = np.zeros((1, len(chain))) if i == 0 else found.qs[b] - found.qs[before]
            short = (np.abs(steps) <= 0.5).all(axis=1)
            costs += (np.linalg.norm(steps / velocity, axis=1) + 1.0)[short].tolist()
            rows += before[short].tolist()
            columns += [b] * int(short.sum())
    graph = coo_array((costs, (rows, columns)), shape=(size + 1, size + 1)).tocsr()
    distances = dijkstra(graph, indices=size)[:size]
    return float(distances[found.owners == len(places) - 1].min(initial=np.inf)) - len(places)


def test_no_sequence_of_branches_travels_less_than_the_one_chosen() -> None:
    poses = seam(5)
    found = tool_sequence(chain_of(), poses, FreeTool(NONE, 36), VELOCITY, 0.0)
    assert found.failure is None
    assert len(found.turn.places) >= 200
    assert found.choice.joint_travel == pytest.approx(_least_travel(poses, found.turn.places), rel=1e-9)
    assert set(found.choice.turns) == {0.0}


def test_free_turns_travel_less_and_the_finer_ones_are_used() -> None:
    fixed, coarse, fine = (
        tool_sequence(chain_of(), seam(turn=turn), FreeTool(axis, steps), VELOCITY, 0.01).choice
        for turn, axis, steps in ((-2.0, NONE, 1), (-2.0, Z, 12), (-2.0, Z, 48))
    )
    assert coarse.joint_travel < 0.95 * fixed.joint_travel
    assert fine.joint_travel == pytest.approx(coarse.joint_travel, rel=0.02)
    tips = pinocchio_poses(robot(ARM), chain_of(), np.array(fine.joint_positions))
    turned = Rotation.from_matrix(seam(turn=-2.0).rotations) * Rotation.from_rotvec(np.outer(fine.turns, Z))
    np.testing.assert_allclose(tips.positions, seam().positions, atol=1e-9)
    np.testing.assert_allclose(tips.rotations, turned.as_matrix(), atol=1e-9)


@pytest.mark.parametrize("law", ["time_optimal", "quintic"])
def test_the_tool_stays_on_its_path_but_for_the_free_turn(law: str) -> None:
    poses = seam(turn=2.0)
    found = planned(poses, law=law)
    assert found.audit.passed
    assert found.failure is None
    times = np.linspace(0.0, found.motion.duration, 60)
    tips = pinocchio_poses(robot(ARM), chain_of(), found.motion.at(times))
    knots = np.append(0.0, np.cumsum(np.linalg.norm(np.diff(poses.positions, axis=0), axis=1)))
    curve = CubicSpline(knots, poses.positions, bc_type="natural")
    u = np.linspace(0.0, knots[-1], 20001)
    gaps = np.linalg.norm(curve(u)[:, None] - tips.positions, axis=2)
    assert gaps.min(axis=0).max() < 1e-4
    turns = RotationSpline(knots, Rotation.from_matrix(poses.rotations))
    axes = turns(u[gaps.argmin(axis=0)]).as_matrix()[:, :, 2]
    assert np.linalg.norm(np.cross(axes, tips.rotations[:, :, 2]), axis=1).max() < 1e-3
    assert np.abs(found.motion.derivative().at(times) / VELOCITY).max() <= 1.0 + 1e-9
    assert found.choice is not None
    ends = found.motion.at(times[[0, -1]])
    np.testing.assert_allclose(ends, np.array(found.choice.joint_positions)[[0, -1]], atol=1e-6)


def test_a_start_is_joined_by_a_motion_of_the_joints_to_the_nearest_sequence() -> None:
    poses, start = seam(), AT + 0.2
    found = planned(poses, start=start)
    assert [one.type for one in found.segments] == ["joint", "spline"]
    np.testing.assert_array_equal(found.motion.at(np.zeros(1))[0], start)
    assert found.choice is not None
    assert np.abs(np.array(found.choice.joint_positions[0]) - start).max() < 1.0
    assert found.audit.passed


def _raised(poses: Poses, first: int, by: float) -> Poses:
    """The poses, with those from `first` on higher."""
    positions = poses.positions.copy()
    positions[first:, 2] += by
    return Poses(positions, poses.rotations)


def test_what_blocks_the_path_is_named_with_the_pose_before_it() -> None:
    far = planned(_raised(seam(), 6, 1.2))
    assert far.failure is not None
    assert far.failure.reason == "out_of_reach"
    assert "between way-points 5 and 6" in far.failure.detail
    assert 0.1 < far.completed_fraction < 0.9
    assert far.audit.passed
    # The last joint turns by ±180° only, and a path about its axis without a free turn needs more.
    around = planned(seam(turn=9.0), NONE)
    assert around.failure is not None
    assert around.failure.reason == "branch_change"
    assert planned(seam(turn=9.0), Z).failure is None


def test_a_first_pose_out_of_reach_is_refused_or_leaves_the_joints_at_rest() -> None:
    away = _raised(seam(), 0, 2.0)
    with pytest.raises(InvalidField, match="way-point 0 is out of reach") as error:
        planned(away)
    assert error.value.field == "path.poses.0"
    still = planned(away, start=AT)
    assert still.failure is not None
    assert (still.motion.duration, still.completed_fraction, still.failure.segment) == (0.0, 0.0, 0)


PANDA = np.array([0.1, -0.4, 0.1, -2.0, 0.2, 1.8, 0.5])


@pytest.mark.slow
def test_one_of_seven_joints_is_held_where_the_others_travel_least() -> None:
    poses = seam(5, q=PANDA, name="panda")
    chain = chain_of("panda")
    found = tool_sequence(chain, poses, FreeTool(NONE, 36), velocity_of(chain), 0.0)
    qs = np.array(found.choice.joint_positions)
    (j,) = np.flatnonzero(np.ptp(qs, axis=0) == 0.0)
    name = chain.joint_names[j]
    least = _least_travel(poses, found.turn.places, "panda", {name: qs[0, j]})
    assert found.choice.joint_travel == pytest.approx(least, rel=1e-9)
    for value in np.linspace(chain.lower[j], chain.upper[j], 14)[[3, 8, 11]]:
        assert _least_travel(poses, found.turn.places, "panda", {name: float(value)}) >= least - 1e-9


@pytest.mark.quick(1)
@pytest.mark.parametrize("axis", [X, Z])
def test_seven_joints_lead_the_tool_as_they_were_chosen(axis: Array) -> None:
    found = planned(seam(5, q=PANDA, name="panda"), axis, PANDA if axis is Z else None, name="panda")
    assert found.audit.passed
    assert found.failure is None
    assert found.choice is not None
    chosen = np.array(found.choice.joint_positions)
    turned = Rotation.from_matrix(seam(5, q=PANDA, name="panda").rotations) * Rotation.from_rotvec(
        np.outer(found.choice.turns, axis)
    )
    tips = pinocchio_poses(robot("panda"), chain_of("panda"), chosen)
    np.testing.assert_allclose(tips.rotations, turned.as_matrix(), atol=1e-9)
    began = found.segments[-1].start_time
    motion = found.motion.at(np.linspace(began, found.motion.duration, 400))
    gaps = np.abs(motion[:, None] - chosen).max(axis=2).min(axis=0)
    assert gaps.max() < 0.05
    assert (np.ptp(motion, axis=0) < 1e-3).any()


def test_arms_without_a_closed_form_and_paths_that_stand_still_are_refused() -> None:
    for name, lacks in (("planar_2r", "has 2 joints"), ("baxter", "has none with one of its seven joints held")):
        count = len(chain_of(name))
        with pytest.raises(InvalidField, match=lacks):
            tool_sequence(chain_of(name), seam(), FreeTool(Z, 36), np.ones(count), 0.01)
    poses = seam(4)
    still = Poses(poses.positions[[0, 0, 1]], poses.rotations[:3])
    with pytest.raises(InvalidField, match="share one position") as error:
        tool_sequence(chain_of(), still, FreeTool(Z, 36), VELOCITY, 0.01)
    assert error.value.field == "path.poses"
