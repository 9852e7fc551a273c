"""Joints through waypoints: the spline against SciPy's, the limits, the times, and what leaves the joints' ranges."""

import math
from dataclasses import replace

import numpy as np
import pytest
from scipy.interpolate import CubicSpline
from scipy.optimize import minimize_scalar

from gelenk.errors import InvalidField
from gelenk.robot.arrays import Array
from gelenk.trajectory.audit.words import Law
from gelenk.trajectory.joints.splines import JointSpline, promised
from gelenk.trajectory.motion.polynomial import PiecewisePolynomial
from gelenk.trajectory.motion.splines import Boundary
from gelenk.trajectory.problem.problem import Segment
from tests.trajectory.arms import (
    ARMS,
    BOUNDARIES,
    LAWS,
    SLOW,
    START,
    WAYPOINTS,
    arm,
    end_state,
    excess,
    free,
    jump,
    limits,
    spline_motion,
    through,
)

# The course


def test_the_spline_of_the_course_at_its_times() -> None:
    """Item 42: t = (0, 2, 3, 5), q = (0, 2π, π/2, π), at rest at both ends."""
    q = np.array([[2.0 * np.pi], [0.5 * np.pi], [np.pi]])
    segment = Segment("spline", "cubic", limits([99.0], [99.0]), configurations=q, times=np.array([2.0, 3.0, 5.0]))
    motion = spline_motion(np.zeros(1), segment, free(1))
    assert motion.derivative(1).at(np.array([0.0, 2.0, 3.0, 5.0]))[:, 0] == pytest.approx(
        [0.0, -1.914408023281, -3.681553890926, 0.0], abs=5e-13
    )
    assert motion.derivative(2).at(np.array([0.0, 2.0, 3.0, 5.0]))[:, 0] == pytest.approx(
        [11.339185984, -13.253594007, 9.719302272, -6.037748381], abs=5e-10
    )
    assert motion.at(np.ones(1))[0, 0] == pytest.approx(3.620194659410, abs=5e-13)


def test_the_exam_tells_by_how_much_its_times_are_too_short() -> None:
    """Item 42: t = (1, 2, 2.5, 4), q = (45, 90, -45, 45)°: 308.11 °/s at 2.27218, 972.86 °/s² at 2."""
    q = np.radians([[90.0], [-45.0], [45.0]])
    bound = limits([float(np.radians(200.0))], [float(np.radians(5000.0))])
    segment = Segment("spline", "cubic", bound, configurations=q, times=np.array([1.0, 1.5, 3.0]))
    with pytest.raises(
        InvalidField, match=r"joint 1 reaches 1\.54056 times its limit of velocity at 1\.27218 s"
    ) as refusal:
        spline_motion(np.radians([45.0]), segment, free(1))
    assert refusal.value.field == "times"
    assert float(refusal.value.reason.split()[-1]) == pytest.approx(308.111510782 / 200.0, abs=5e-10)
    slow_at = limits([float(np.radians(5000.0))], [float(np.radians(500.0))])
    with pytest.raises(InvalidField, match=r"limit of acceleration at 1 s") as refusal:
        spline_motion(np.radians([45.0]), replace(segment, limits=slow_at), free(1))
    assert float(refusal.value.reason.split()[-1]) == pytest.approx(math.sqrt(972.857142857 / 500.0), abs=5e-10)


# The way


@pytest.mark.parametrize("boundary", ["clamped", "natural", "not_a_knot", "periodic"])
def test_the_way_is_the_spline_that_scipy_finds(boundary: Boundary) -> None:
    waypoints = np.concatenate((WAYPOINTS, [START]))
    knots = np.concatenate(([START], waypoints))
    segment = through(boundary=boundary, configurations=waypoints, limits=limits([1.0, 0.4], [3.0, 3.0]))
    way = JointSpline.of(START, segment, free(2)).path
    steps = [max(abs(step[0]), abs(step[1]) / 0.4) for step in np.diff(knots, axis=0)]
    np.testing.assert_allclose(way.breaks, np.concatenate(([0.0], np.cumsum(steps))), rtol=1e-14)
    other = CubicSpline(way.breaks, knots, bc_type=boundary.replace("_", "-"))
    u = np.linspace(0.0, way.duration, 200)
    np.testing.assert_allclose(way.at(u), other(u), atol=1e-12)


# Real arms


@pytest.mark.quick(2)
@pytest.mark.parametrize("name", ARMS)
@pytest.mark.parametrize("boundary", BOUNDARIES)
def test_motions_through_waypoints_of_real_arms(name: str, boundary: Boundary) -> None:
    one, rng = arm(name), np.random.default_rng(3)
    for count in (2, 5):
        bound, qs = one.limits(rng), one.configurations(rng, count + 1, 0.4)
        if boundary == "periodic":
            qs[-1] = qs[0]
        durations = {}
        for law in LAWS:
            segment = Segment("spline", law, bound, configurations=qs[1:], boundary=boundary)
            motion = spline_motion(qs[0], segment, one.chain)
            durations[law] = motion.duration
            _assert_sound(motion, qs, segment)
            longer = spline_motion(qs[0], replace(segment, duration=1.3 * motion.duration), one.chain)
            assert longer.breaks[-1] == 1.3 * motion.duration
            np.testing.assert_allclose(longer.at(1.3 * motion.breaks), motion.at(motion.breaks), atol=1e-9)
        # Within 1.5 % of the optimum, as `time_optimal` says of itself.
        assert durations["time_optimal"] <= 1.015 * min(durations.values())


def _assert_sound(motion: PiecewisePolynomial, qs: Array, segment: Segment) -> None:
    continuous, keeps_jerk = promised(segment)
    assert keeps_jerk == (segment.law in {"quintic", "septic", "jerk_limited"})
    assert (np.diff(motion.breaks) > 0.0).all()
    for last in (False, True):
        assert np.abs(end_state(motion, 0, last=last) - qs[-1 if last else 0]).max() <= 1e-9
        assert np.abs(end_state(motion, 1, last=last)).max() <= 1e-9
        if keeps_jerk or (segment.boundary == "assigned" and continuous == 2):
            assert np.abs(end_state(motion, 2, last=last)).max() <= 1e-8
    assert excess(motion, segment.limits, jerk=keeps_jerk) <= 1e-9
    for order in range(continuous + 1):
        assert jump(motion, order) <= 1e-9
    for q in qs:
        assert _distance(motion, q) <= 1e-6


def _distance(motion: PiecewisePolynomial, q: Array) -> float:
    """From a configuration to the nearest one of a motion."""
    times = np.linspace(motion.breaks[0], motion.breaks[-1], 2001)
    k = int(np.linalg.norm(motion.at(times) - q, axis=1).argmin())
    bounds = times[max(k - 1, 0)], times[min(k + 1, 2000)]

    def off(t: float) -> float:
        return float(np.linalg.norm(motion.at(np.array([t])) - q))

    nearest = minimize_scalar(off, bounds=bounds, method="bounded", options={"xatol": 1e-12})
    return min(float(nearest.fun), *(off(t) for t in bounds))


@pytest.mark.parametrize("boundary", ["clamped", "assigned"])
@pytest.mark.parametrize("law", ["cubic", "quintic", "septic", "trapezoidal"])
def test_given_times_are_kept_exactly(law: Law, boundary: Boundary) -> None:
    times = np.array([2.0, 3.0, 6.0])
    segment = through(law, times=times, boundary=boundary)
    motion = spline_motion(START, segment, free(2))
    assert motion.breaks[-1] == 6.0
    np.testing.assert_allclose(motion.at(times), WAYPOINTS, atol=1e-14)
    assert promised(segment)[0] == 2
    assert max(jump(motion, 1), jump(motion, 2)) <= 1e-12
    for last in (False, True):
        assert np.abs(end_state(motion, 1, last=last)).max() <= 1e-14
        assert (np.abs(end_state(motion, 2, last=last)).max() <= 1e-13) == (boundary == "assigned")


def test_the_factor_that_is_told_for_times_is_enough_and_no_larger_than_needed() -> None:
    for boundary in ("clamped", "assigned"):
        segment = through("cubic", times=np.array([0.2, 0.5, 0.9]), boundary=boundary)
        with pytest.raises(InvalidField) as refusal:
            spline_motion(START, segment, free(2))
        assert segment.times is not None
        factor = float(refusal.value.reason.split()[-1])
        motion = spline_motion(START, replace(segment, times=factor * segment.times), free(2))
        assert abs(excess(motion, SLOW, jerk=False, per_piece=2001)) <= 1e-6
        with pytest.raises(InvalidField, match="multiply all times by"):
            spline_motion(START, replace(segment, times=0.999 * factor * segment.times), free(2))


def test_at_given_times_joints_may_wait() -> None:
    waypoints = np.array([START, WAYPOINTS[0], WAYPOINTS[0]])
    segment = through("cubic", configurations=waypoints, times=np.array([1.0, 3.0, 4.0]))
    np.testing.assert_allclose(
        spline_motion(START, segment, free(2)).at(np.array([1.0, 3.0, 4.0])), waypoints, atol=1e-14
    )
    still = through("cubic", configurations=np.array([START, START]), times=np.array([1.0, 2.0]))
    motion = spline_motion(START, still, free(2))
    assert motion.duration == 2.0
    np.testing.assert_array_equal(motion.at(np.linspace(0.0, 2.0, 9)), np.tile(START, (9, 1)))


@pytest.mark.parametrize("boundary", ["clamped", "natural", "not_a_knot", "assigned"])
@pytest.mark.parametrize("law", LAWS)
def test_one_waypoint_is_enough(law: Law, boundary: Boundary) -> None:
    segment = through(law, configurations=WAYPOINTS[:1], boundary=boundary)
    motion = spline_motion(START, segment, free(2))
    _assert_sound(motion, np.array([START, WAYPOINTS[0]]), segment)
    # On a straight line, and so never faster than the trapezoid along it.
    s = (motion.at(np.linspace(0.0, motion.duration, 30)) - START) / (WAYPOINTS[0] - START)
    assert np.abs(s[:, 0] - s[:, 1]).max() <= 1e-9
    assert motion.duration >= (0.6 / 1.0 + 1.0 * 0.6 / 3.0) * (1.0 - 1e-9)


def test_what_is_compared_is_what_is_answered() -> None:
    for boundary in ("clamped", "periodic"):
        for law in LAWS:
            waypoints = np.concatenate((WAYPOINTS, [START]))
            segment = through(law, configurations=waypoints, boundary=boundary)
            found = JointSpline.of(START, segment, free(2)).timings()
            assert found.uniform_duration == pytest.approx(spline_motion(START, segment, free(2)).duration, rel=1e-9)
            optimal = spline_motion(START, replace(segment, law="time_optimal"), free(2))
            assert found.time_optimal_duration == pytest.approx(optimal.duration, rel=1e-9)
            needed = max(found.velocity_factor, math.sqrt(found.acceleration_factor))
            assert needed <= found.uniform_duration * (1.0 + 1e-6)


# Refusals

_TIMES = np.array([1.0, 2.0, 3.0])


@pytest.mark.parametrize(
    ("segment", "field", "reason"),
    [
        (through(configurations=None), "waypoints", "at least one is needed"),
        (through(configurations=np.empty((0, 2))), "waypoints", "at least one is needed"),
        (through(configurations=WAYPOINTS[[0, 1, 1]]), "waypoints.2", "is the same as entry 1"),
        (through(configurations=np.array([START])), "waypoints.0", "is the same as the start"),
        (
            through(configurations=np.array([[0.6, 0.1], [0.6, 0.1 + 1e-9]])),
            "waypoints.1",
            "a millionth of the whole path",
        ),
        (through(configurations=np.array([[9.0, 0.1], [5.5, 0.2]])), "waypoints.0", "joint joint_0 at 9 is outside"),
        (through(configurations=np.array([[1.0, 0.1], [1.0, -9.0]])), "waypoints.1", "joint joint_1 at -9 is outside"),
        (through(configurations=np.array([[1.0, math.nan]])), "waypoints.0", "magnitude"),
        (through(configurations=np.array([[1.0, 1e300]])), "waypoints.0", "magnitude"),
        (through(boundary="periodic"), "waypoints.2", "ends where it starts, and joint 1 is 1 away"),
        (through(times=_TIMES, boundary="natural"), "boundary", "would neither start nor end at rest"),
        (through(times=_TIMES, boundary="not_a_knot"), "boundary", "would neither start nor end at rest"),
        (through(times=_TIMES, law="time_optimal"), "times", "not allowed with the law `time_optimal`"),
        (through(times=_TIMES, law="jerk_limited"), "boundary", "take `assigned`"),
        (through(times=_TIMES, duration=3.0), "duration", "not allowed beside `times`"),
        (through(times=_TIMES[:2]), "times", "2 entries for 3 waypoints"),
        (through(times=_TIMES[[0, 2, 1]]), "times", "times have to increase"),
        (through(times=_TIMES[[0, 1, 1]]), "times", "is there twice"),
        (through(times=np.array([0.0, 1.0, 2.0])), "times.0", "not after the start"),
        (through(times=np.array([-1.0, 1.0, 2.0])), "times.0", "not after the start"),
        (through(times=np.array([1.0, math.nan, 2.0])), "times", "at most 1e"),
        (through(times=np.array([1.0, 2.0, 1e300])), "times", "at most 1e"),
        (through(times=0.1 * _TIMES), "times", "multiply all times by"),
        (through(duration=0.01), "duration", "must be at least"),
        (through(duration=math.nan), "duration", "greater than 0 s"),
        (through(limits=limits([1.0, 0.0], [3.0, 3.0])), "limits.joint_velocity", "joint 2: must be a number from"),
    ],
)
def test_what_is_refused(segment: Segment, field: str, reason: str) -> None:
    chain = free(2, -5.0, 6.0)
    with pytest.raises(InvalidField, match=reason) as refusal:
        spline_motion(START, segment, chain)
    assert refusal.value.field == field


@pytest.mark.parametrize("law", LAWS)
def test_too_short_a_duration_tells_the_least(law: Law) -> None:
    with pytest.raises(InvalidField, match="must be at least") as refusal:
        spline_motion(START, through(law, duration=0.1), free(2))
    told = float(refusal.value.reason.split("at least ")[1].split(" s")[0])
    motion = spline_motion(START, through(law, duration=told), free(2))
    assert motion.breaks[-1] == told
    assert excess(motion, SLOW, jerk=promised(through(law))[1]) <= 1e-9
