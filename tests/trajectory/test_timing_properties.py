"""Time along random ways: no limit is ever passed, the time-optimal law is the fastest, q(s(t)) is what it says."""

import math

import numpy as np
import pytest
from scipy.spatial.transform import Rotation

from gelenk.kinematics.simd.kernels import chain_poses
from gelenk.robot.arrays import Array
from gelenk.robot.chain import Chain
from gelenk.robot.poses import transform
from gelenk.trajectory.audit.audit import audit
from gelenk.trajectory.audit.demands import Demands, JointLimits, TipLimits
from gelenk.trajectory.laws.jerk_limited import at_rest, jerk_limited
from gelenk.trajectory.laws.s_curves import lasting, planned, profiles
from gelenk.trajectory.motion.composition import in_time, times_at
from gelenk.trajectory.motion.time_laws import between
from gelenk.trajectory.paths.path_geometry import geometry_of, tip_through
from gelenk.trajectory.paths.paths import circle
from gelenk.trajectory.problem.problem import SegmentLimits
from gelenk.trajectory.timing.time_optimal import time_optimal
from gelenk.trajectory.timing.timing import Timed
from gelenk.trajectory.timing.tip_constraints import tip_rows
from tests.robots import robot
from tests.trajectory.timed_ways import (
    LAWS,
    LOOSE,
    SMOOTH,
    compared,
    gantry,
    instants,
    joint_ratios,
    limits,
    planar_line,
    random_way,
    timed,
    tip_of_gantry,
)

PANDA = robot("panda")
ARM = PANDA.chain(None, None)


def random_limits(rng: np.random.Generator, joints: int, tip: TipLimits | None = None) -> SegmentLimits:
    v, a, j = (10.0 ** rng.uniform(-1.0, 2.0, joints) for _ in range(3))
    return limits(v, a, j, tip, joints)


def assert_at_rest(found: Timed) -> None:
    fastest = np.abs(found.motion.derivative().at(instants(found.motion, 3))).max()
    assert np.abs(found.motion.derivative().at(found.motion.breaks[[0, -1]])).max() <= 1e-11 * fastest


@pytest.mark.slow
@pytest.mark.parametrize("block", range(7))
def test_no_limit_is_passed_along_random_ways(block: int) -> None:
    for seed in range(30 * block, 30 * (block + 1)):
        rng = np.random.default_rng(seed)
        joints = int(rng.integers(1, 9))
        way, bounds = random_way(rng, joints), random_limits(rng, joints)
        durations = {}
        for law in LAWS:
            found = timed(None, way, law, bounds)
            durations[law] = found.motion.duration
            assert_at_rest(found)
            assert (np.diff(found.motion.breaks) > 0.0).all()
            largest = joint_ratios(found, bounds, with_jerk=law in SMOOTH, per_piece=12)
            assert largest.max() <= 1.0 + 1e-9, (seed, law)
            times = instants(found.motion, 3)
            expected = way.at(found.law.at(times)[:, 0])
            np.testing.assert_allclose(found.motion.at(times), expected, atol=2e-8)
        assert durations["time_optimal"] <= min(durations.values()) * (1.0 + 1e-9), seed


def tip_ratios(chain: Chain, found: Timed, tip: TipLimits) -> Array:
    """Speeds and accelerations of the tip by central differences of its poses in time, in fractions of the limits."""
    motion, h = found.motion, 1e-4 * found.motion.duration
    times = np.linspace(2.0 * h, motion.duration - 2.0 * h, 401)
    times = times[np.abs(times[:, None] - motion.breaks).min(axis=1) > 1.5 * h]
    before, at, after = (chain_poses(chain.flat, motion.at(times + step)) for step in (-h, 0.0, h))
    turns = [
        (Rotation.from_matrix(one) * Rotation.from_matrix(other).inv()).as_rotvec() / h
        for one, other in ((after[1], at[1]), (at[1], before[1]))
    ]
    rates = (
        (after[0] - before[0]) / (2.0 * h),
        0.5 * (turns[0] + turns[1]),
        (after[0] - 2.0 * at[0] + before[0]) / h**2,
        (turns[0] - turns[1]) / h,
    )
    bounds = (tip.speed, tip.angular_speed, tip.acceleration, tip.angular_acceleration)
    return np.array([np.linalg.norm(rate, axis=1).max(initial=0.0) / b for rate, b in zip(rates, bounds, strict=True)])


@pytest.mark.quick(5)
@pytest.mark.parametrize("seed", range(12))
def test_no_limit_of_the_tip_is_passed_where_the_joints_lead_it(seed: int) -> None:
    rng = np.random.default_rng(1000 + seed)
    way = random_way(rng, 7)
    tip = TipLimits(*np.where(rng.random(4) < 0.7, 10.0 ** rng.uniform(-1.0, 1.0, 4), math.inf))
    bounds = random_limits(rng, 7, tip)
    for law in LAWS:
        found = timed(None, way, law, bounds, tip_motion=tip_through(ARM))
        assert_at_rest(found)
        assert joint_ratios(found, bounds, with_jerk=law in SMOOTH).max() <= 1.0 + 1e-9
        assert tip_ratios(ARM, found, tip).max() <= 1.0 + 1e-3


@pytest.mark.parametrize("law", LAWS)
def test_the_audit_passes(law: str) -> None:
    for seed in range(3):
        rng = np.random.default_rng(2000 + seed)
        way = random_way(rng, 7)
        tip = TipLimits(*10.0 ** rng.uniform(-1.0, 1.0, 4))
        bounds = random_limits(rng, 7, tip)
        found = timed(None, way, law, bounds, tip_motion=tip_through(ARM))  # type: ignore[arg-type]
        jerk = bounds.jerk if found.has_bounded_jerk else None
        everywhere = np.full(7, 1e9)
        joints = JointLimits(bounds.velocity, bounds.acceleration, jerk, -everywhere, everywhere)
        judgement = audit(PANDA, ARM, found.motion, Demands(joints, tip, continuous=found.continuous))
        assert judgement.passed, [reason.detail for reason in judgement.reasons]


def test_the_tip_through_the_joints_by_differences() -> None:
    rng = np.random.default_rng(0)
    q, v, a = rng.uniform(-1.0, 1.0, (3, 5, 7))
    twists, changes = tip_through(ARM)(q, v, a)
    h = 1e-4

    def poses(t: float) -> tuple[Array, Rotation]:
        positions, rotations = chain_poses(ARM.flat, q + v * t + 0.5 * a * t**2)
        return positions, Rotation.from_matrix(rotations)

    (p0, r0), (p1, r1), (p2, r2) = poses(-h), poses(0.0), poses(h)
    np.testing.assert_allclose(twists[:, :3], (p2 - p0) / (2.0 * h), atol=1e-6)
    np.testing.assert_allclose(changes[:, :3], (p2 - 2.0 * p1 + p0) / h**2, atol=1e-5)
    after, before = (r2 * r1.inv()).as_rotvec() / h, (r1 * r0.inv()).as_rotvec() / h
    np.testing.assert_allclose(twists[:, 3:], 0.5 * (after + before), atol=1e-6)
    np.testing.assert_allclose(changes[:, 3:], (after - before) / h, atol=1e-5)


@pytest.mark.parametrize("seed", range(4))
def test_the_time_optimal_law_under_limits_of_the_tip_is_near_that_of_a_finer_grid(seed: int) -> None:
    rng = np.random.default_rng(seed)
    turns = Rotation.from_rotvec(rng.normal(0.0, 0.5, (3, 3))).as_matrix()
    start, via, end = (transform(rng.uniform(-0.4, 0.4, 3), turn) for turn in turns)
    path = circle(start, via, end)
    way = gantry(path, 20)
    velocity, acceleration, jerk = np.column_stack((random_limits(rng, 3).joints, np.full(3, LOOSE)))
    bounds = SegmentLimits(velocity, acceleration, jerk, TipLimits(0.5, 1.0, 1.5, 4.0))
    found = timed(path, way, "time_optimal", bounds)
    rows = tip_rows(geometry_of(path, way, bounds, tip_of_gantry(path)))
    finer = time_optimal(way, bounds.velocity, bounds.acceleration, intervals=1500, further=rows)
    assert 0.9999 * finer.motion.duration < found.motion.duration < 1.005 * finer.motion.duration
    # The sides of the polygon take no more than 1 - cos(π/32) of an acceleration.
    times = instants(found.motion, 5)
    s, v, u = (
        found.law.derivative(order).at(times)[:, 0] if order else found.law.at(times)[:, 0] for order in range(3)
    )
    samples = path.at(s)
    twists = samples.first * v[:, None]
    changes = samples.first * u[:, None] + samples.second * v[:, None] ** 2
    parts = (
        np.linalg.norm(twists[:, :3], axis=1) / 0.5,
        np.linalg.norm(twists[:, 3:], axis=1) / 1.0,
        np.linalg.norm(changes[:, :3], axis=1) / 1.5,
        np.linalg.norm(changes[:, 3:], axis=1) / 4.0,
        *(np.abs(found.motion.derivative(1).at(times)) / bounds.velocity).T,
        *(np.abs(found.motion.derivative(2).at(times)) / bounds.acceleration).T,
    )
    largest = np.max(parts, axis=0)
    assert largest.max() <= 1.0 + 1e-6
    lasting_each = np.repeat(np.diff(found.motion.breaks), 6)
    assert lasting_each[largest > 0.97].sum() > 0.9 * lasting_each.sum()


@pytest.mark.slow
def test_uniform_scaling_is_never_faster_than_time_optimal() -> None:
    for seed in range(10):
        rng = np.random.default_rng(3000 + seed)
        way, bounds = random_way(rng, 6), random_limits(rng, 6)
        for law in LAWS:
            uniform, by_velocity, by_acceleration, optimal = compared(None, way, law, bounds)
            assert optimal <= uniform * (1.0 + 1e-9)
            if law not in SMOOTH:
                assert uniform == pytest.approx(max(by_velocity, math.sqrt(by_acceleration)), rel=2e-9)


# Composition, and profiles of least jerk


@pytest.mark.parametrize("count", [2, 3, 4])
def test_a_composition_and_its_derivatives_are_those_of_the_chain_rule(count: int) -> None:
    way = planar_line(6)
    rows = np.zeros((2, count, 1))
    rows[1, 0] = way.breaks[-1]
    law = between(rows[0], rows[1], 2.0)
    found = in_time(way, law)
    times = instants(found, 7)
    s, v, a, j = (law.derivative(order).at(times) if order else law.at(times) for order in range(4))
    # Just inside of the piece, as the instants are.
    q, first, second, third = ((way.derivative(order) if order else way).at(s[:, 0]) for order in range(4))
    near = np.abs(s - way.breaks).min(axis=1) > 1e-9
    np.testing.assert_allclose(found.at(times), q, atol=2e-9)
    for order, expected, tolerance in (
        (1, first * v, 1e-8),
        (2, first * a + second * v**2, 1e-7),
        (3, first * j + 3.0 * second * v * a + third * v**3, 1e-5),
    ):
        scale = np.abs(expected).max(axis=0)
        off = np.abs(found.derivative(order).at(times) - expected) / scale
        assert off[near].max() < 3.0 * tolerance
    assert len(found.breaks) < 60


def test_when_a_law_is_where() -> None:
    for count in (2, 3, 4):
        rows = np.zeros((2, count, 1))
        rows[1, 0] = 3.0
        law = between(rows[0], rows[1], 5.0)
        s = np.array([1e-9, 0.3, 1.5, 2.999, 3.0 - 1e-12])
        np.testing.assert_allclose(law.at(times_at(law, s))[:, 0], s, rtol=1e-14, atol=1e-14)


@pytest.mark.parametrize("seed", range(30))
def test_profiles_of_least_jerk_are_those_of_ruckig(seed: int) -> None:
    rng = np.random.default_rng(seed)
    caps = 10.0 ** rng.uniform(-1.5, 1.5, 3)
    other = jerk_limited(at_rest(np.zeros(1)), at_rest(np.ones(1)), caps[:, None])
    found = planned(caps)
    assert found.duration == pytest.approx(other.duration, rel=1e-4)
    assert lasting(caps[None])[0] == pytest.approx(other.duration, rel=1e-9)
    places, speeds, accelerations, jerks = (values[0] for values in profiles(caps[None], 5))
    assert max(speeds.max() / caps[0], np.abs(accelerations).max() / caps[1]) <= 1.0 + 1e-9
    assert np.abs(jerks).max() == pytest.approx(caps[2], rel=1e-9)
    assert (np.diff(places) > -1e-15).all()
    for order in range(3):
        values = found.derivative(order) if order else found
        ends = values.at(found.breaks[[0, -1]])[:, 0]
        np.testing.assert_allclose(ends, [0.0, 1.0 if order == 0 else 0.0], atol=1e-9 * caps.max())
