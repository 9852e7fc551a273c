"""Where joints cannot follow a way any further, against closed forms; and what damping makes of it."""

import math

import numpy as np
import pytest
from scipy.optimize import brentq

from gelenk.ik.search.task import FULL_POSE, Task
from gelenk.ik.solve import Options, inverse_kinematics
from gelenk.kinematics.simd.kernels import chain_jacobians
from gelenk.robot.arrays import Array
from gelenk.robot.chain import Chain
from gelenk.robot.robot import RobotModel
from gelenk.trajectory.audit.words import NearSingularity
from gelenk.trajectory.follow import follow as follow_module
from gelenk.trajectory.follow.follow import FollowedPath, follow
from gelenk.trajectory.follow.integrate import Trace, traced
from gelenk.trajectory.follow.rate_field import RateField
from gelenk.trajectory.paths.paths import Path, line
from gelenk.trajectory.problem.problem import Following
from tests.robots import of_table, robot, rows
from tests.trajectory.test_follow import XY, KnownWay, deviations, moved, pinocchio_poses, pose, smallest_sigma, starts

L1, L2 = 1.0, 0.7
"""Links of the catalogue's planar arm."""


def planar() -> tuple[RobotModel, Chain]:
    arm = robot("planar_2r")
    return arm, arm.chain(None, None)


def elbow(p: Array, side: float = 1.0) -> Array:
    """Joints of two links for a position; shape (2,)."""
    cosine = (float(p @ p) - L1**2 - L2**2) / (2.0 * L1 * L2)
    q2 = side * math.acos(min(1.0, max(-1.0, cosine)))
    q1 = math.atan2(p[1], p[0]) - math.atan2(L2 * math.sin(q2), L1 + L2 * math.cos(q2))
    return np.array([q1, q2])


def least_sigma(p: Array) -> float:
    """σ_min of two links there, by trace and determinant of JJᵀ."""
    q1, q2 = elbow(p)
    a = np.array([-L1 * math.sin(q1) - L2 * math.sin(q1 + q2), L1 * math.cos(q1) + L2 * math.cos(q1 + q2)])
    b = L2 * np.array([-math.sin(q1 + q2), math.cos(q1 + q2)])
    trace, determinant = float(a @ a + b @ b), L1 * L2 * math.sin(q2)
    return abs(determinant) / math.sqrt(0.5 * (trace + math.sqrt(trace**2 - 4.0 * determinant**2)))


def planar_line(begin: tuple[float, float], end: tuple[float, float], side: float = 1.0) -> tuple[Path, Array]:
    """A line of the planar arm's tip, and the joints at its beginning."""
    _, chain = planar()
    q = elbow(np.array(begin), side)
    T = pose(chain, q)
    return line(T, moved(T, np.array([*end, 0.0]) - np.array([*begin, 0.0]), np.zeros(3))), q


def where_sigma_is(path: Path, sigma: float, low: float, high: float) -> float:
    return float(
        brentq(lambda s: least_sigma(path.at(np.array([s])).poses.positions[0, :2]) - sigma, low, high, xtol=1e-14)
    )


def go(path: Path, q: Array, near: NearSingularity = "stop", least: float = 0.01) -> FollowedPath:
    arm, chain = planar()
    return follow(arm, chain, path, q, Following(task=XY, near_singularity=near, min_singular_value=least))


# Out of reach


@pytest.mark.quick(1)
@pytest.mark.parametrize(
    ("begin", "end", "radius"),
    [((1.2, 0.3), (1.9, 0.9), L1 + L2), ((0.9, 0.2), (-0.9, 0.1), L1 - L2)],
    ids=["outer circle", "hole around the base"],
)
@pytest.mark.parametrize("near", ["stop", "slow_down"])
def test_two_links_end_where_the_line_leaves_their_ring(
    begin: tuple[float, float], end: tuple[float, float], radius: float, near: NearSingularity
) -> None:
    path, q = planar_line(begin, end)
    p, u = np.array(begin), (np.array(end) - begin) / path.extent
    roots = np.roots([1.0, 2.0 * float(p @ u), float(p @ p) - radius**2])
    exit_ = float(min(root for root in roots if root > 0.0))
    way = go(path, q, near)
    assert way.stop is not None
    assert way.stop.reason == "out_of_reach"
    assert way.stop.joint is None
    assert way.stop.s == pytest.approx(exit_, abs=1e-6)
    np.testing.assert_allclose(way.stop.position[:2], p + exit_ * u, atol=1e-6)
    if near == "stop":
        assert way.reached == pytest.approx(where_sigma_is(path, 0.01, 0.9 * exit_, exit_), abs=1e-6)
        sigma, _ = smallest_sigma(planar()[1], XY, way.positions)
        assert 0.01 - 1e-9 <= sigma < 0.0100001
    else:
        assert exit_ - 1e-7 < way.reached < exit_
    s = np.linspace(0.0, way.reached, 300)
    wanted = np.unwrap(np.array([elbow(position[:2]) for position in path.at(s).poses.positions]), axis=0)
    np.testing.assert_allclose(way.positions.at(s), wanted, atol=5e-3)


def looked_ahead(path: Path, q: Array) -> tuple[Trace, Trace]:
    """The way until it is lost, as soon as that is known and up to the last nanometre."""
    _, chain = planar()
    field = RateField(chain, path, XY, (1e-4, 1e-3))
    return traced(field, q, until_above=10.0), traced(field, q)


def test_the_end_of_a_branch_is_told_before_it_is_reached() -> None:
    begin, end = (1.2, 0.3), (1.9, 0.9)
    path, q = planar_line(begin, end)
    p, u = np.array(begin), (np.array(end) - begin) / path.extent
    exit_ = float(np.roots([1.0, 2.0 * float(p @ u), float(p @ p) - (L1 + L2) ** 2]).max())
    soon, last = looked_ahead(path, q)
    assert soon.ending == last.ending == "lost"
    assert soon.crossing is not None
    assert soon.crossing.bad == pytest.approx(exit_, abs=3e-9)
    assert soon.crossing.bad > exit_ - 1e-10
    assert len(soon.pieces) < 0.75 * len(last.pieces)


@pytest.mark.parametrize("beside", [1e-4, 1e-6, 1e-8])
def test_a_near_miss_of_the_boundary_is_no_end_of_the_branch(beside: float) -> None:
    """The middle half of a chord of the outer circle, whose own middle is that far inside of it."""
    height = L1 + L2 - beside
    half = 0.5 * math.sqrt((L1 + L2) ** 2 - height**2)
    path, q = planar_line((-half, height), (half, height))
    soon, last = looked_ahead(path, q)
    assert soon.ending == last.ending == "complete"
    assert min(float(piece.sigmas.min()) for piece in soon.pieces) < 2.0 * math.sqrt(beside)


def test_an_arm_with_too_few_joints_names_the_directions() -> None:
    arm, chain = planar()
    path, q = planar_line((1.2, 0.3), (0.8, 0.9))
    way = follow(arm, chain, path, q, Following())
    assert way.stop is not None
    assert way.stop.reason == "out_of_reach"
    assert "rz" in way.stop.detail
    assert way.reached < 2e-3
    assert way.orientation_deviation <= 1e-3


def test_an_arm_with_too_few_joints_follows_what_it_can_do() -> None:
    arm, chain = planar()
    path = KnownWay(chain, np.array([0.3, 0.8]), np.array([0.7, -0.4]), np.array([0.1, 0.2]), 0.9)
    way = follow(arm, chain, path, path.q0, Following())
    assert way.stop is None
    s = np.linspace(0.0, 0.9, 100)
    np.testing.assert_allclose(way.positions.at(s), path.joints(s), atol=1e-3)


# Joint limits


def test_a_turning_joint_meets_its_limit() -> None:
    """The tip goes round behind the base: the first joint comes to π."""
    path, q = planar_line((0.2, 1.2), (-1.4, -0.5), -1.0)

    def angle(s: float) -> float:
        q1 = elbow(path.at(np.array([s])).poses.positions[0, :2], -1.0)[0]
        return float(q1 if q1 > 0.0 else q1 + 2.0 * math.pi)

    meets = float(brentq(lambda s: angle(s) - math.pi, 0.5, path.extent, xtol=1e-14))
    way = go(path, q)
    assert way.stop is not None
    assert (way.stop.reason, way.stop.joint) == ("joint_limit", "joint_1")
    assert way.stop.s == pytest.approx(meets, abs=1e-7)
    assert way.reached == pytest.approx(meets, abs=1e-7)
    assert "3.14159 rad" in way.stop.detail
    assert way.positions.at(np.array([way.reached]))[0, 0] <= math.pi + 1e-9


def test_a_sliding_joint_meets_its_limit() -> None:
    arm = robot("scara")
    chain = arm.chain(None, None)
    q = np.array([0.4, 0.8, 0.12, -0.3])
    task = Task(("x", "y", "z", "rz"))
    path = line(pose(chain, q), moved(pose(chain, q), np.array([0.0, 0.0, -0.2]), np.zeros(3)))
    way = follow(arm, chain, path, q, Following(task=task))
    assert way.stop is not None
    assert (way.stop.reason, way.stop.joint) == ("joint_limit", chain.joint_names[2])
    assert way.reached == pytest.approx(chain.upper[2] - 0.12, abs=1e-8)
    assert f"{chain.upper[2]:.6g} m" in way.stop.detail


def test_a_limit_passed_between_knots_is_found() -> None:
    """A joint that goes beyond its limit and comes back within one piece."""
    arm = robot("planar_2r")
    chain = arm.chain(None, None)
    # q_1 rises to π + 1e-4 at the middle of the way only.
    swing = math.pi + 1e-4 - 0.02
    path = KnownWay(chain, np.array([swing, 1.0]), np.zeros(2), np.array([0.02, 0.05]), 0.9)
    way = follow(arm, chain, path, path.q0, Following(task=XY))
    assert way.stop is not None
    assert (way.stop.reason, way.stop.joint) == ("joint_limit", "joint_1")
    meets = math.asin((math.pi - swing) / 0.02) / 3.0
    assert way.reached == pytest.approx(meets, abs=1e-3)
    assert way.positions.at(np.linspace(0.0, way.reached, 1000))[:, 0].max() <= math.pi + 1e-9


def test_joints_to_spare_look_ahead_to_keep_from_a_limit(monkeypatch: pytest.MonkeyPatch) -> None:
    arm = robot("xarm7")
    chain = arm.chain(None, None)
    rng = np.random.default_rng(8)
    q = starts(chain, FULL_POSE, 1, seed=8)[0]
    path = line(pose(chain, q), moved(pose(chain, q), 0.3 * rng.normal(size=3), np.zeros(3)))
    ahead = follow(arm, chain, path, q, Following())
    assert ahead.stop is None
    s = np.linspace(0.0, path.extent, 300)
    qs = ahead.positions.at(s)
    assert (qs >= chain.lower - 1e-9).all()
    assert (qs <= chain.upper + 1e-9).all()
    assert max(deviations(path.at(s).poses, pinocchio_poses(arm, chain, qs), FULL_POSE)) < 1e-3
    for order in range(3):
        one = ahead.positions.derivative(order) if order else ahead.positions
        knots = ahead.positions.breaks[1:-1]
        np.testing.assert_allclose(one.at(np.nextafter(knots, 0.0)), one.at(knots), atol=1e-6)
    monkeypatch.setattr(follow_module, "guides", lambda *_: ())
    plain = follow(arm, chain, path, q, Following())
    assert plain.stop is not None
    assert plain.stop.reason == "joint_limit"


def test_another_branch_that_does_the_whole_way_is_told() -> None:
    arm = robot("puma560")
    chain = arm.chain(None, None)
    rng = np.random.default_rng(9)
    q = starts(chain, FULL_POSE, 1, seed=9)[0]
    path = line(pose(chain, q), moved(pose(chain, q), 0.3 * rng.normal(size=3), np.zeros(3)))
    way = follow(arm, chain, path, q, Following())
    assert way.stop is not None
    assert way.stop.reason == "joint_limit"
    told = way.stop.detail.split("beginning at (")[1].rstrip(")")
    seed = np.array([float(number) for number in told.split(", ")])
    options = Options(position_tolerance=1e-10, orientation_tolerance=1e-10)
    other = inverse_kinematics(arm, chain, path.at(np.zeros(1)).poses, seed[None], options).qs[0]
    np.testing.assert_allclose(other, seed, atol=1e-4)
    assert follow(arm, chain, path, other, Following()).stop is None


# Singularities


@pytest.mark.slow
def test_a_way_past_a_singularity_stopped_damped_and_slowed_down() -> None:
    """Two links pass the hole around their base at a hundredth of a millimetre."""
    path, q = planar_line((0.8, 0.30001), (-0.8, 0.30001))
    middle = 0.5 * path.extent
    stopped, slowed, damped = (go(path, q, near) for near in ("stop", "slow_down", "damp"))
    assert stopped.stop is not None
    assert stopped.stop.reason == "singularity"
    expected = where_sigma_is(path, 0.01, 0.0, middle)
    assert stopped.reached == pytest.approx(expected, abs=1e-6)
    assert stopped.stop.s == pytest.approx(expected, abs=1e-6)
    assert "0.01" in stopped.stop.detail
    assert slowed.stop is None
    assert slowed.path_deviation <= 1e-4
    sigma = least_sigma(path.at(np.array([middle])).poses.positions[0, :2])
    found, place = smallest_sigma(planar()[1], XY, slowed.positions)
    assert found == pytest.approx(sigma, rel=0.05)
    assert place == pytest.approx(middle, abs=1e-3)
    assert damped.stop is None
    assert slowed.path_deviation < damped.path_deviation < 2e-2
    s = np.linspace(0.0, path.extent, 4000)
    arm, chain = planar()
    off = np.linalg.norm(
        path.at(s).poses.positions - pinocchio_poses(arm, chain, damped.positions.at(s)).positions, axis=1
    )
    assert damped.path_deviation == pytest.approx(off.max(), rel=0.05)
    assert off[s < expected - 1e-6].max() < 1e-4
    assert off[-1] < 1e-6


@pytest.mark.slow
def test_damping_bounds_joint_rates_beside_a_wrist_singularity() -> None:
    """A UR5's tip passes its wrist's singularity within a hair: exactly, the wrist whirls; damped, it hardly moves."""
    arm = robot("ur5")
    chain = arm.chain(None, None)
    q = np.array([0.1, -1.2, 1.4, -0.7, 0.3, 0.3])
    path = line(pose(chain, q), pose(chain, q + np.array([0.2, 0.1, 0.0, -0.2, -0.6, 0.0])))
    slowed = follow(arm, chain, path, q, Following(near_singularity="slow_down"))
    damped = follow(arm, chain, path, q, Following(near_singularity="damp"))
    assert slowed.stop is None
    assert damped.stop is None
    s = np.linspace(0.0, path.extent, 20_000)
    fastest = [float(np.abs(way.positions.derivative().at(s)).max()) for way in (slowed, damped)]
    assert fastest[0] > 2000.0
    assert fastest[1] < 100.0
    assert 1e-4 < damped.path_deviation < 5e-3
    end = path.at(np.array([path.extent])).poses
    last = pinocchio_poses(arm, chain, damped.positions.at(np.array([path.extent])))
    assert max(deviations(end, last, FULL_POSE)) < 1e-5


def test_damped_joints_go_on_smoothly() -> None:
    """No jump of q, q' or q'' at any knot, from the exact part into the damped one included."""
    path, q = planar_line((0.8, 0.30001), (-0.8, 0.30001))
    way = go(path, q, "damp")
    knots = way.positions.breaks[1:-1]
    for order in range(3):
        one = way.positions.derivative(order) if order else way.positions
        jumps = np.abs(one.at(np.nextafter(knots, 0.0)) - one.at(knots))
        assert jumps.max() <= 1e-6 * (1.0 + np.abs(one.at(knots)).max())


@pytest.mark.slow
def test_damped_joints_go_around_what_is_out_of_reach() -> None:
    """A line through the hole around the base: the tip goes along its edge, and returns to the line."""
    arm = of_table(rows("standard", [(L1, 0.0, 0.0, 0.0), (L2, 0.0, 0.0, 0.0)], "RR"))
    chain = arm.chain(None, None)
    q = elbow(np.array([0.8, 0.29]))
    path = line(pose(chain, q), moved(pose(chain, q), np.array([-1.6, 0.0, 0.0]), np.zeros(3)))
    following = Following(task=XY, near_singularity="damp", min_singular_value=0.05)
    way = follow(arm, chain, path, q, following)
    assert way.stop is None
    assert way.path_deviation >= 0.01 - 1e-6
    end = path.at(np.array([path.extent])).poses
    assert deviations(end, pinocchio_poses(arm, chain, way.positions.at(np.array([path.extent]))), XY)[0] <= 1e-4
    exact = follow(arm, chain, path, q, Following(task=XY, near_singularity="slow_down"))
    assert exact.stop is not None
    assert exact.stop.reason == "out_of_reach"


def test_a_damped_tip_that_does_not_come_back_ends_where_it_leaves() -> None:
    path, q = planar_line((1.2, 0.3), (1.9, 0.9))
    way = go(path, q, "damp")
    assert way.stop is not None
    assert way.stop.reason == "out_of_reach"
    assert way.path_deviation <= 1e-4 * (1.0 + 1e-6)
    p, u = np.array([1.2, 0.3]), np.array([0.7, 0.6]) / path.extent
    exit_ = float(max(np.roots([1.0, 2.0 * float(p @ u), float(p @ p) - (L1 + L2) ** 2])))
    assert abs(way.reached - exit_) < 1e-3
    tip = pinocchio_poses(*planar(), way.positions.at(np.array([way.reached]))).positions[0]
    assert np.linalg.norm(tip - path.at(np.array([way.reached])).poses.positions[0]) == pytest.approx(1e-4, rel=1e-3)


def test_a_start_near_a_singularity_may_leave_it() -> None:
    path, q = planar_line((1.699, 0.0), (1.0, 0.3))
    assert least_sigma(np.array([1.699, 0.0])) < 0.03
    assert go(path, q, least=0.05).stop is None
    outwards, q = planar_line((1.699, 0.0), (1.75, 0.0))
    way = go(outwards, q, least=0.05)
    assert way.stop is not None
    assert way.reached == 0.0
    assert way.positions.breaks.tolist() == [0.0, 1e-12]
    assert way.stop.reason == "out_of_reach"
    assert way.stop.s == pytest.approx(0.001, abs=1e-6)


def test_a_dip_of_sigma_between_knots_is_not_missed() -> None:
    """The wrist of a UR5 goes through its singularity within a ten-thousandth of a radian."""
    arm = robot("ur5")
    chain = arm.chain(None, None)
    q = np.array([0.1, -1.2, 1.4, -0.7, 0.31, 0.3])
    path = KnownWay(chain, q, np.array([0.2, 0.1, 0.1, 0.1, -1.0, 0.1]), np.zeros(6), 0.7)

    def sigma(s: float) -> float:
        J = chain_jacobians(chain.flat, path.joints(np.array([s])))[2][0]
        return float(np.linalg.svd(J, compute_uv=False)[-1])

    for least in (1e-2, 1e-4):
        way = follow(arm, chain, path, q, Following(min_singular_value=least))
        assert way.stop is not None
        assert way.stop.reason == "singularity"
        expected = float(brentq(lambda s, least=least: sigma(s) - least, 0.2, 0.31 - 1e-9, xtol=1e-13))
        assert way.reached == pytest.approx(expected, abs=1e-6)


def test_a_way_over_the_axis_of_the_shoulder() -> None:
    """The first joint of an anthropomorphic arm has nothing to do where the tip goes straight over its axis."""
    arm, task = robot("anthropomorphic"), Task(("x", "y", "z"))
    chain = arm.chain(None, None)
    q = np.array([0.0, 1.2, 0.6])
    T = pose(chain, q)
    path = line(T, moved(T, np.array([-2.0 * T[0, 3], 0.0, 0.0]), np.zeros(3)))
    over = follow(arm, chain, path, q, Following(task=task, near_singularity="slow_down"))
    assert over.stop is None
    np.testing.assert_allclose(over.positions.at(np.linspace(0.0, path.extent, 50))[:, 0], 0.0, atol=1e-9)
    before = follow(arm, chain, path, q, Following(task=task))
    assert before.stop is not None
    assert before.stop.reason == "singularity"
    # There q̇_1 moves the tip by its distance from the axis alone, which is the smallest singular value.
    assert before.reached == pytest.approx(abs(T[0, 3]) - 0.01, abs=1e-6)


# Branches


def test_a_branch_ends_while_another_goes_on() -> None:
    """The wrist of a UR5 folds up; beyond, all solutions are far from where it came to."""
    arm = robot("ur5")
    chain = arm.chain(None, None)
    q = np.array([0.1, -1.2, 1.4, -0.7, 0.5, 0.3])
    path = line(pose(chain, q), moved(pose(chain, q), np.array([0.0, 0.375, 0.0]), np.zeros(3)))
    way = follow(arm, chain, path, q, Following(near_singularity="slow_down"))
    assert way.stop is not None
    assert way.stop.reason == "branch_change"
    sigma, place = smallest_sigma(chain, FULL_POSE, way.positions)
    assert sigma < 1e-3
    assert place == pytest.approx(way.stop.s, abs=1e-6)
    beyond = path.at(np.array([way.stop.s + 1e-4])).poses
    found = inverse_kinematics(arm, chain, beyond, q[None], Options(every=True, respect_limits=False))
    assert len(found.qs)
    last = way.positions.at(np.array([way.reached]))[0]
    turns = np.abs((found.qs - last + np.pi) % (2.0 * np.pi) - np.pi)
    assert turns.max(axis=1).min() > 0.2
    threshold = follow(arm, chain, path, q, Following())
    assert threshold.stop is not None
    assert threshold.stop.reason == "branch_change"
    assert threshold.stop.s == pytest.approx(way.stop.s, abs=1e-6)
    assert threshold.reached < way.reached
