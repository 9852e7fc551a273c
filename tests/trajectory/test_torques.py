"""Torques along a motion: two ways to them, the constraints and the factor that keep their limits, and the audit."""

from dataclasses import replace

import numpy as np
import pytest

from gelenk.kinematics.dynamics.bodies import Load
from gelenk.kinematics.dynamics.mechanism import STANDARD_GRAVITY, mechanism
from gelenk.kinematics.dynamics.torques import torque_limits
from gelenk.robot.arrays import Array
from gelenk.trajectory.audit.audit import audit
from gelenk.trajectory.audit.demands import Demands
from gelenk.trajectory.audit.torques import TorqueLimits
from gelenk.trajectory.audit.words import Law
from gelenk.trajectory.motion.polynomial import PiecewisePolynomial
from gelenk.trajectory.motion.splines import cubic_spline
from gelenk.trajectory.paths.path_geometry import geometry_of
from gelenk.trajectory.plan import plan
from gelenk.trajectory.problem.problem import Segment, SegmentLimits, Trajectory, TrajectoryProblem
from gelenk.trajectory.timing.torque_constraints import torque_factor, torque_rows
from tests.robots import robot
from tests.trajectory import figures_torques
from tests.trajectory.arms import LAWS, arm
from tests.trajectory.test_plan import ARM, LIMITS, PANDA, READY, moved, pose

GRAVITY = np.array(STANDARD_GRAVITY)
LOAD = Load(1.5, np.array([0.02, -0.03, 0.1]), np.diag([0.01, 0.02, 0.015]))
FAST = replace(LIMITS, acceleration=np.full(7, 20.0))


def limits_of(name: str, most: Array | float = np.inf, load: Load | None = LOAD) -> TorqueLimits:
    one = robot(name)
    chain = one.chain(None, None)
    return torque_limits(mechanism(one, chain), np.broadcast_to(most, len(chain)).astype(float), GRAVITY, load)


def largest_ratio(motion: PiecewisePolynomial, torque: TorqueLimits) -> float:
    """By Pinocchio, on a grid that has nothing to do with the pieces."""
    rates = motion.rates_at(np.linspace(0.0, motion.duration, 3001))
    return float((np.abs(torque.recomputed(*rates)) / torque.most).max())


@pytest.mark.parametrize("name", ["panda", "ur5_gripper", "scara", "talos_left_arm", "tiago"])
def test_both_ways_give_the_same_torques(name: str) -> None:
    torque = limits_of(name)
    q, v, a = np.random.default_rng(1).uniform(-2.0, 2.0, (3, 1005 if name == "panda" else 5, len(torque.most)))
    inertial, weight = torque.parts(q, v, a)
    assert inertial + weight == pytest.approx(torque.recomputed(q, v, a), rel=1e-9, abs=1e-9)
    assert weight == pytest.approx(torque.recomputed(q, 0.0 * v, 0.0 * a), rel=1e-9, abs=1e-9)


def test_where_the_rows_hold_the_torques_do_in_the_whole_interval() -> None:
    rng = np.random.default_rng(2)
    path = cubic_spline(np.arange(4.0), READY + rng.uniform(-0.5, 0.5, (4, 7)), "natural").motion
    torque = limits_of("panda", np.array([60.0, 80.0, 60.0, 60.0, 10.0, 10.0, 10.0]))
    nodes = np.union1d(np.linspace(0.0, 1.0, 61), path.breaks / path.duration)
    rows = torque_rows(geometry_of(None, path, replace(LIMITS, torque=torque)))
    assert rows is not None
    alpha, beta = rows(nodes)
    tight = 0
    for _ in range(20):
        u, x = rng.uniform(-1.0, 1.0, len(alpha)), rng.uniform(0.0, 1.0, len(alpha))
        u, x = np.array([u, x]) / (alpha * u[:, None] + beta * x[:, None]).max(axis=1)
        for share in (0.01, 0.3, 0.5, 0.7, 0.99):
            s = path.duration * (nodes[:-1] + share * np.diff(nodes))
            squared = x + 2.0 * share * np.diff(nodes) * u
            valid = (squared >= 0.0) & (u * u < 1e12)
            q, first, second = (row[valid] for row in path.rates_at(s))
            rate = path.duration * np.sqrt(squared[valid])[:, None]
            acceleration = first * path.duration * u[valid, None] + second * rate**2
            ratios = (np.abs(torque.recomputed(q, first * rate, acceleration)) / torque.most).max(axis=1)
            assert ratios.max() <= 1.0
            tight += int((ratios > 0.99).sum())
    assert tight > 100


def test_the_factor_just_keeps_the_limits() -> None:
    motion = cubic_spline(np.linspace(0.0, 0.5, 4), READY + np.linspace(0.0, 0.6, 4)[:, None], "clamped").motion
    torque = limits_of("panda", np.array([60.0, 40.0, 60.0, 40.0, 10.0, 10.0, 10.0]))
    factor = torque_factor(motion, torque)
    assert largest_ratio(motion, torque) > 1.0
    assert 0.999 < largest_ratio(motion.scaled(factor), torque) <= 1.0
    assert torque_factor(motion.scaled(1.001 * factor), torque) == 1.0


@pytest.mark.quick(3)
@pytest.mark.parametrize("law", LAWS)
@pytest.mark.parametrize("kind", ["joint", "spline", "line"])
def test_a_motion_keeps_torques_and_is_slower_for_them(law: Law, kind: str) -> None:
    target = READY + np.array([0.6, 0.4, -0.3, 0.5, 0.2, 0.3, 0.1])
    ends = {
        "joint": {"configuration": target},
        "spline": {"configurations": np.array([0.5 * (READY + target) + 0.1, target])},
        "line": {"pose": moved(pose(READY), 0.15, 0.25, -0.2)},
    }[kind]

    def planned(limits: SegmentLimits) -> tuple[float, PiecewisePolynomial, float]:
        segment = Segment("joint" if kind == "joint" else "spline" if kind == "spline" else "line", law, limits, **ends)
        found = plan(PANDA, ARM, TrajectoryProblem(READY, (segment,)))
        assert found.audit.joint_torque is not None
        return found.motion.duration, found.motion, found.audit.joint_torque.ratio or 0.0

    free, passed, _ = planned(replace(FAST, torque=limits_of("panda")))
    q = passed.at(np.linspace(0.0, free, 200))
    torque = limits_of("panda", 1.2 * np.abs(limits_of("panda").parts(q, 0.0 * q, 0.0 * q)[1]).max(axis=0) + 1.0)
    duration, motion, ratio = planned(replace(FAST, torque=torque))
    assert duration > free
    assert 0.99 < ratio <= 1.0 + 1e-9
    assert largest_ratio(motion, torque) <= 1.0 + 1e-9


@pytest.mark.quick(1)
@pytest.mark.parametrize("law", ["time_optimal", "jerk_limited"])
def test_of_blended_lines_each_keeps_its_own_torques(law: Law) -> None:
    corner = moved(pose(READY), 0.0, 0.25, 0.0)

    def planned(second: TorqueLimits) -> Trajectory:
        limits = [replace(FAST, torque=torque) for torque in (limits_of("panda"), second)]
        first = Segment("line", law, limits[0], pose=corner, blend_radius=0.05)
        lines = (first, Segment("line", law, limits[1], pose=moved(corner, 0.0, 0.0, -0.25)))
        return plan(PANDA, ARM, TrajectoryProblem(READY, lines))

    free = planned(limits_of("panda"))
    q = free.motion.at(np.linspace(0.0, free.motion.duration, 200))
    torque = limits_of("panda", 1.05 * np.abs(limits_of("panda").parts(q, 0.0 * q, 0.0 * q)[1]).max(axis=0) + 0.5)
    found = planned(torque)
    blend, audited = found.segments[0].blend, found.audit.joint_torque
    assert blend is not None
    assert audited is not None
    begin, end = blend.start_time, found.motion.duration
    ratios = []
    for part in (found.motion.between(0.0, begin), found.motion.between(begin, end)):
        rates = part.rates_at(np.linspace(part.breaks[0], part.breaks[-1], 2001))
        ratios.append(float((np.abs(torque.recomputed(*rates)) / torque.most).max()))
    assert ratios[0] > 1.1
    assert ratios[1] <= 1.0 + 1e-9
    assert audited.ratio == pytest.approx(1.0, abs=0.02)


def test_the_audit_finds_a_torque_beyond_its_limit_between_samples() -> None:
    motion = cubic_spline(np.array([0.0, 0.5, 0.9]), READY + np.array([[0.0], [0.2], [0.5]]), "clamped").motion
    free = audit(PANDA, ARM, motion, Demands(torque=limits_of("panda")))
    assert free.passed
    assert free.joint_torque is not None
    j, peak = ARM.joint_names.index(free.joint_torque.joint or ""), free.joint_torque
    q, v, a = motion.rates_at(np.array([peak.time - 1e-9]))
    assert limits_of("panda").recomputed(q, v, a)[0, j] == pytest.approx(peak.value, abs=1e-5)
    for excess, passes in ((1e-6, False), (-1e-6, True)):
        torque = limits_of("panda", np.where(np.arange(7) == j, abs(peak.value) / (1.0 + excess), np.inf))
        found = audit(PANDA, ARM, motion, Demands(torque=torque))
        assert found.passed is passes
        assert found.joint_torque is not None
        assert found.joint_torque.ratio == pytest.approx(1.0 + excess, abs=1e-9)
        assert {reason.check for reason in found.reasons} == (set() if passes else {"torque"})


@pytest.mark.slow
def test_it_takes_at_most_a_hundredth_longer_than_another_implementation() -> None:
    pytest.importorskip("toppra")
    rng = np.random.default_rng(5)
    for name in ("panda", "ur5", "z1"):
        one = figures_torques.case(arm(name), name, rng)
        motion = figures_torques.ours(one)
        assert 0.995 < motion.duration / figures_torques.theirs(one, 800) < 1.012
        assert figures_torques.worst(one, motion) <= 1.0
