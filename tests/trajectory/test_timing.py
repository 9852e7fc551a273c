"""Time along a way: the lecture's numbers, closed forms, what is promised of each law, and what cannot be."""

import math

import numpy as np
import pytest
from numpy.polynomial import Polynomial
from scipy.interpolate import CubicSpline
from scipy.optimize import minimize_scalar
from scipy.spatial.transform import Rotation

from gelenk.errors import InvalidField
from gelenk.robot.arrays import Array
from gelenk.robot.poses import Poses, transform
from gelenk.trajectory.audit.demands import TipLimits
from gelenk.trajectory.audit.words import Law
from gelenk.trajectory.laws.jerk_limited import at_rest, jerk_limited
from gelenk.trajectory.motion.extremes import peaks
from gelenk.trajectory.motion.polynomial import PiecewisePolynomial, joined
from gelenk.trajectory.paths.corners import blended_lines
from gelenk.trajectory.paths.paths import circle, line
from gelenk.trajectory.problem.problem import SegmentLimits
from gelenk.trajectory.timing.averages import moving_average
from gelenk.trajectory.timing.path_laws import least_trapezoidal
from gelenk.trajectory.timing.timing import Timed
from tests.trajectory.timed_ways import (
    LAWS,
    SMOOTH,
    at_breaks,
    compared,
    gantry,
    joint_ratios,
    limits,
    planar_line,
    straight,
    timed,
)

# The lecture's numbers


def test_uniform_scaling_along_the_line_of_two_links() -> None:
    way = planar_line(1000)
    lasting, by_velocity, by_acceleration, _ = compared(None, way, "cubic", limits([3.0, 2.5], [5.0, 7.0]))
    assert by_velocity == pytest.approx(1.918966430, abs=6e-10)
    assert by_acceleration == pytest.approx(6.151971947, abs=6e-9)
    assert lasting == pytest.approx(2.480316904599, abs=1e-9)


def test_maxima_of_the_cubic_along_the_line_of_two_links() -> None:
    found = timed(None, planar_line(1000), "cubic", limits([3.0, 2.5], [5.0, 7.0]))
    unit = found.motion.scaled(1.0 / found.motion.duration)
    np.testing.assert_allclose(np.abs(peaks(unit, 1).values), [5.756899290, 3.004575851], rtol=3e-10)
    np.testing.assert_allclose(np.abs(peaks(unit, 2).values), [30.759859736, 20.114406054], rtol=3e-9)
    assert abs(peaks(found.motion, 2).values[0]) == pytest.approx(5.0, rel=1e-12)


@pytest.mark.parametrize(
    ("velocity", "acceleration", "by_velocity", "by_acceleration", "duration"),
    [
        ([1.0, 2.0], [8.0, 8.0], 1.5, 1.5, 1.5),
        ([10.0, 10.0], [100.0, 100.0], 0.3, 0.12, 0.346410161514),
    ],
)
def test_uniform_scaling_of_a_straight_line(
    velocity: list[float], acceleration: list[float], by_velocity: float, by_acceleration: float, duration: float
) -> None:
    found = compared(None, straight(1.0, -2.0), "cubic", limits(velocity, acceleration))
    assert found[:3] == pytest.approx((duration, by_velocity, by_acceleration), abs=1e-12)
    assert found[3] <= found[0]


# Closed forms


@pytest.mark.parametrize("law", ["trapezoidal", "time_optimal"])
@pytest.mark.parametrize(
    ("distances", "v", "a", "duration"),
    [
        ([2.0], [0.8], [1.6], 3.0),
        ([0.3], [0.8], [1.6], 0.866025403784),
        ([-0.4], [0.8], [1.6], 1.0),
        ([-1.0, 0.7], [0.5, 0.8], [0.8, 0.5], 2.7),  # In step: v = .5, a = .5/.7 along the first joint.
        ([1e3, 1.0], [1.0, 1.0], [1.0, 1.0], 1001.0),
        ([1e-9], [1.0], [1.0], 2.0 * 1e-9**0.5),
    ],
)
def test_bang_coast_bang_along_a_straight_line(
    distances: list[float], v: list[float], a: list[float], duration: float, law: Law
) -> None:
    found = timed(None, straight(*distances), law, limits(v, a))
    assert found.motion.duration == pytest.approx(duration, rel=1e-9, abs=1e-12)
    assert len(found.motion.breaks) in (3, 4)
    np.testing.assert_allclose(found.motion.at(found.motion.breaks[-1:])[0], distances, rtol=1e-14)


@pytest.mark.parametrize(("law", "count"), [("cubic", 2), ("quintic", 3), ("septic", 4)])
def test_polynomials_along_a_straight_line(law: Law, count: int) -> None:
    # s' ∝ (τ(1-τ))^(m-1), whose peaks are looked for among many samples.
    rate = Polynomial([0.0, 1.0, -1.0]) ** (count - 1)
    rate = rate / (rate.integ()(1.0) - rate.integ()(0.0))
    tau = np.linspace(0.0, 1.0, 200_001)
    v0, a0, j0 = (2.0 * np.abs(rate.deriv(order)(tau)).max() for order in range(3))
    for v, a, j in ((0.1, 100.0, 1e9), (100.0, 0.1, 1e9), (100.0, 1e9, 0.1)):
        jerk_factor = 0.0 if law == "cubic" else float(np.cbrt(j0 / j))
        expected = max(v0 / v, math.sqrt(a0 / a), jerk_factor)
        found = timed(None, straight(-2.0), law, limits(v, a, j))
        assert found.motion.duration == pytest.approx(expected, rel=1e-9)


@pytest.mark.parametrize(("v", "a", "j"), [(0.5, 1.0, 4.0), (5.0, 1.0, 4.0), (0.1, 5.0, 2.0), (50.0, 50.0, 2.0)])
def test_least_jerk_along_a_straight_line_is_that_of_ruckig(v: float, a: float, j: float) -> None:
    distances = np.array([1.5, -0.7])
    # The joint that goes furthest is the one at its limits.
    other = jerk_limited(at_rest(np.zeros(1)), at_rest(distances[:1]), np.array([[v], [a], [j]]))
    found = timed(None, straight(*distances), "jerk_limited", limits([v, v], a, j))
    assert found.motion.duration == pytest.approx(other.duration, rel=1e-9)
    times = np.linspace(0.0, other.duration, 101)
    np.testing.assert_allclose(found.motion.at(times), other.at(times) * distances / distances[0], atol=1e-9)


LEVEL = transform(np.array([0.1, 0.2, 0.3]), np.eye(3))
TURNED = transform(np.array([0.1, 1.2, 0.3]), Rotation.from_rotvec([0.0, 0.0, 0.8]).as_matrix())


@pytest.mark.parametrize(
    ("tip", "v", "a"),
    [
        (TipLimits(0.5, math.inf, 2.0, math.inf), 0.5, 2.0),
        (TipLimits(0.5, 0.2, 2.0, 0.4), 0.25, 0.5),  # It turns by .8 rad a metre.
        (TipLimits(9.0, 9.0, 0.4, 9.0), 9.0, 0.4),
    ],
)
@pytest.mark.parametrize("law", ["trapezoidal", "time_optimal"])
def test_bang_coast_bang_along_a_line_of_the_tip(tip: TipLimits, v: float, a: float, law: Law) -> None:
    path = line(LEVEL, TURNED)
    found = timed(path, gantry(path, 5), law, limits(tip=tip, joints=4))
    expected = 1.0 / v + v / a if v * v / a < 1.0 else 2.0 / math.sqrt(a)
    assert found.motion.duration == pytest.approx(expected, rel=3e-9)


def half_circle(radius: float) -> tuple[Array, Array, Array]:
    points = [(radius, 0.0, 0.0), (0.0, radius, 0.0), (-radius, 0.0, 0.0)]
    a, b, c = (transform(np.array(point), np.eye(3)) for point in points)
    return a, b, c


def test_time_optimal_round_half_a_circle() -> None:
    """At full acceleration ṡ² = a r sin(2s/r) as far as s = πr/4, then even motion; ∫ dθ/√sin θ up to π/2 is 2.622."""
    radius, a = 0.3, 2.0
    path = circle(*half_circle(radius))
    bounds = limits(tip=TipLimits(acceleration=a), joints=4)
    expected = math.sqrt(radius / a) * (2.622057554292119 + 0.5 * math.pi)
    found = timed(path, gantry(path, 8), "time_optimal", bounds)
    assert expected * (1.0 - 1e-6) < found.motion.duration < expected * 1.003


def test_trapezoid_round_half_a_circle() -> None:
    """At the end of a ramp of length d: a² (1 + (2d/r)²) is the limit squared; afterwards v² / r."""
    radius, limit = 0.3, 2.0
    path = circle(*half_circle(radius))
    length = math.pi * radius

    def lasting(d: float) -> float:
        a = limit / math.hypot(1.0, 2.0 * d / radius)
        return (length + 2.0 * d) / math.sqrt(2.0 * a * d)

    expected = minimize_scalar(lasting, bounds=(1e-3, 0.5 * length), method="bounded", options={"xatol": 1e-12}).fun
    found = timed(path, gantry(path, 12), "trapezoidal", limits(tip=TipLimits(acceleration=limit), joints=4))
    assert found.motion.duration == pytest.approx(expected, rel=1e-9)


def test_no_other_trapezoid_is_faster_along_the_line_of_two_links() -> None:
    way, bounds = planar_line(30), limits([3.0, 2.5], [5.0, 7.0])
    found = timed(None, way, "trapezoidal", bounds)
    length, s = way.breaks[-1], np.linspace(0.0, way.breaks[-1], 4001)
    slope, bend = way.derivative(1).at(s), way.derivative(2).at(s)
    for d in np.linspace(0.01, 0.5, 60) * length:
        x = np.minimum(np.minimum(s, length - s) / d, 1.0)[:, None]  # ṡ² at the cruise speed 1
        u = np.where(s < d, 0.5 / d, np.where(s > length - d, -0.5 / d, 0.0))[:, None]
        k = max(
            (np.abs(slope) * np.sqrt(x) / bounds.velocity).max(),
            math.sqrt((np.abs(slope * u + bend * x) / bounds.acceleration).max()),
        )
        assert found.motion.duration <= (length + 2.0 * d) * k * (1.0 + 1e-4)


def splines(seed: int) -> tuple[CubicSpline, SegmentLimits]:
    rng = np.random.default_rng(seed)
    knots = rng.uniform(-2.0, 2.0, (5, 7))
    return CubicSpline(np.linspace(0.0, 1.0, 5), knots), limits(rng.uniform(1.0, 3.0, 7), rng.uniform(3.0, 15.0, 7))


@pytest.mark.parametrize("seed", range(4))
def test_the_fastest_law_bounds_the_trapezoidal_one_from_below(seed: int) -> None:
    if seed == 0:
        way, bounds = straight(1.0, -0.5), limits([3.0, 2.5], [5.0, 7.0])
    else:
        spline, bounds = splines(seed)
        way = PiecewisePolynomial(spline.x, np.ascontiguousarray(spline.c[::-1].transpose(1, 0, 2)))
    fastest, trapezoidal = (timed(None, way, law, bounds).law for law in ("time_optimal", "trapezoidal"))
    bound = least_trapezoidal(fastest)
    assert 0.3 * trapezoidal.duration < bound < 1.03 * trapezoidal.duration
    assert least_trapezoidal(trapezoidal) <= trapezoidal.duration * (1.0 + 1e-9)


@pytest.mark.parametrize("seed", range(4))
def test_time_optimal_is_within_two_percent_of_another_implementation_on_a_finer_grid(seed: int) -> None:
    toppra = pytest.importorskip("toppra")
    if seed == 0:
        way, bounds = planar_line(30), limits([3.0, 2.5], [5.0, 7.0])
        s = np.linspace(0.0, way.breaks[-1], 400)
        path = toppra.SplineInterpolator(s, way.at(s))
    else:
        spline, bounds = splines(seed)
        way = PiecewisePolynomial(spline.x, np.ascontiguousarray(spline.c[::-1].transpose(1, 0, 2)))
        path = toppra.SplineInterpolator(spline.x, spline(spline.x), "not-a-knot")
    grid = np.linspace(0.0, way.breaks[-1], 2001)
    kind = toppra.constraint.DiscretizationType.Interpolation
    pair = [np.stack((-one, one), axis=1) for one in (bounds.velocity, bounds.acceleration)]
    asked = [
        toppra.constraint.JointVelocityConstraint(pair[0]),
        toppra.constraint.JointAccelerationConstraint(pair[1], discretization_scheme=kind),
    ]
    speeds = toppra.algorithm.TOPPRA(asked, path, gridpoints=grid).compute_parameterization(0.0, 0.0)[1]
    theirs = float((2.0 * np.diff(grid) / (speeds[1:] + speeds[:-1])).sum())
    assert theirs * 0.998 < timed(None, way, "time_optimal", bounds).motion.duration < theirs * 1.02


# What is promised


def example(law: Law) -> tuple[Timed, PiecewisePolynomial, SegmentLimits]:
    way, bounds = planar_line(20), limits([3.0, 2.5], [5.0, 7.0], [50.0, 70.0])
    return timed(None, way, law, bounds), way, bounds


def jumps(motion: PiecewisePolynomial, order: int) -> float:
    """The largest at an inner break, in fractions of the largest value."""
    before, after = at_breaks(motion, order)
    return float(np.abs(before - after).max() / max(np.abs(before).max(), np.abs(after).max()))


@pytest.mark.parametrize("law", LAWS)
def test_each_law_starts_and_ends_at_rest_on_the_way_and_is_as_smooth_as_it_says(law: Law) -> None:
    found, way, bounds = example(law)
    motion, places = found.motion, found.law
    assert motion.breaks[0] == places.breaks[0] == 0.0
    assert motion.duration == places.duration
    ends = motion.breaks[[0, -1]]
    np.testing.assert_allclose(motion.at(ends), way.at(way.breaks[[0, -1]]), atol=1e-14)
    np.testing.assert_allclose(motion.derivative().at(ends), 0.0, atol=1e-13)
    np.testing.assert_allclose(places.at(ends)[:, 0], way.breaks[[0, -1]], atol=1e-14)
    times = np.linspace(0.0, motion.duration, 2001)
    s = places.at(times)[:, 0]
    assert (np.diff(s) >= -1e-14).all()
    np.testing.assert_allclose(motion.at(times), way.at(s), atol=1e-8)
    smooth = law in SMOOTH
    assert (found.continuous, found.has_bounded_jerk) == ((2, True) if smooth else (1, False))
    for order in range(found.continuous + 1):
        assert jumps(motion, order) < 1e-10
    assert smooth or law == "cubic" or jumps(motion, 2) > 1e-3
    if smooth:
        np.testing.assert_allclose(motion.derivative(2).at(ends), 0.0, atol=1e-11)
    assert joint_ratios(found, bounds, with_jerk=smooth).max() == pytest.approx(1.0, abs=2e-3)


@pytest.mark.parametrize("law", LAWS)
def test_acceleration_jumps_where_the_curvature_does(law: Law) -> None:
    corners = Poses(np.array([[0.0, 0.0, 0.0], [0.5, 0.0, 0.0], [0.5, 0.4, 0.0]]), np.array([np.eye(3)] * 3))
    path = blended_lines(corners, [0.1])
    way, bounds = gantry(path, 12), limits(1.0, 3.0, 40.0, TipLimits(0.5, math.inf, 2.0, math.inf), joints=4)
    found = timed(path, way, law, bounds)
    assert (found.continuous, found.has_bounded_jerk) == (1, False)
    assert bool(found.notes) == (law in SMOOTH)
    assert joint_ratios(found, bounds, with_jerk=law in SMOOTH).max() <= 1.0 + 1e-9
    if law in SMOOTH:
        assert "0.4, " in found.notes[0]
        jump = np.abs(np.subtract(*at_breaks(found.motion, 2))).max(axis=1)
        places = found.law.at(found.motion.breaks[1:-1])[:, 0]
        ends = np.abs(places[:, None] - path.breaks).min(axis=1) < 1e-9
        assert ends.sum() == len(path.breaks) == 2
        assert jump[ends].min() > 1e-2
        assert jump[~ends].max() < 1e-9


def test_where_the_direction_jumps_it_stops() -> None:
    way = joined([straight(1.0, 0.0), straight(0.0, 2.0)])
    way.coefficients[1, 0] = [1.0, 0.0]
    for law in LAWS:
        bounds = limits([1.0, 0.5], [2.0, 1.0], [10.0, 10.0])
        found = timed(None, way, law, bounds)
        parts = [timed(None, straight(1.0, 0.0), law, bounds), timed(None, straight(0.0, 2.0), law, bounds)]
        assert found.motion.duration == pytest.approx(sum(part.motion.duration for part in parts), rel=1e-12)
        assert "the direction jumps at s = 1" in found.notes[0]
        middle = np.array([parts[0].motion.duration])
        np.testing.assert_allclose(found.motion.derivative().at(middle), 0.0, atol=1e-12)
        np.testing.assert_allclose(found.motion.at(middle), [[1.0, 0.0]], atol=1e-12)


@pytest.mark.parametrize("law", LAWS)
def test_slowing_down_locally_is_as_smooth_as_the_law_and_says_how(law: Law) -> None:
    way, bounds = planar_line(20), limits([3.0, 2.5], [5.0, 7.0], [60.0, 80.0])
    found, optimal = timed(None, way, law, bounds, slow_down=True), timed(None, way, "time_optimal", bounds)
    assert any(law in note for note in found.notes) == (law != "time_optimal")
    assert joint_ratios(found, bounds, with_jerk=law in SMOOTH).max() <= 1.0 + 1e-9
    if law not in SMOOTH:
        assert found.motion.duration == optimal.motion.duration
        return
    assert found.continuous == 2
    for order in range(4 if law == "septic" else 3):
        assert jumps(found.law, order) < 1e-8
    assert jumps(found.motion, 2) < 1e-8
    assert optimal.motion.duration < found.motion.duration < 1.3 * optimal.motion.duration
    assert found.motion.duration < timed(None, way, law, bounds).motion.duration


def test_the_average_of_a_trapezoid_is_the_jerk_limited_law() -> None:
    """A window of 1/4 s over ramps of 1 s and a coast of 2 s: jerks of 1/4 s, by another planner."""
    trapezoid = PiecewisePolynomial(
        np.array([0.0, 1.0, 3.0, 4.0]), np.array([[0.0, 0.0, 0.5], [0.5, 1.0, 0.0], [2.5, 1.0, -0.5]])[:, :, None]
    )
    average = moving_average(trapezoid, 128, 8, 1)
    wanted = jerk_limited(at_rest(np.zeros(1)), at_rest(np.array([3.0])), np.array([[1.0], [1.0], [4.0]]))
    assert average.duration == pytest.approx(wanted.duration, rel=1e-12) == 4.25
    times = np.linspace(0.0, 4.25, 200)
    for order in range(3):
        found, exact = (law.derivative(order).at(times) for law in (average, wanted))
        np.testing.assert_allclose(found, exact, atol=1e-12)


# Durations


@pytest.mark.parametrize("law", LAWS)
def test_a_given_duration_is_kept_to_the_last_digit(law: Law) -> None:
    fastest, way, bounds = example(law)
    for duration in (fastest.motion.duration, 7.1, 100.0 / 3.0, 1e4):
        if duration < fastest.motion.duration:
            continue
        found = timed(None, way, law, bounds, duration=duration)
        assert found.motion.breaks[-1] == found.law.breaks[-1] == duration
        k = duration / fastest.motion.duration
        shares = np.linspace(0.0, 1.0, 31)
        np.testing.assert_allclose(
            found.motion.at(shares * duration), fastest.motion.at(shares * duration / k), atol=1e-11
        )


@pytest.mark.parametrize("law", LAWS)
def test_too_short_a_duration_is_refused_and_the_least_is_named(law: Law) -> None:
    fastest, way, bounds = example(law)
    with pytest.raises(InvalidField) as refused:
        timed(None, way, law, bounds, duration=0.99 * fastest.motion.duration)
    assert refused.value.field == "duration"
    named = float(refused.value.reason.split("at least ")[1].split(" s")[0])
    assert named == pytest.approx(fastest.motion.duration, rel=1e-9)
    assert fastest.binding in refused.value.reason
    assert timed(None, way, law, bounds, duration=named).motion.duration == named


@pytest.mark.parametrize(
    ("bounds", "words"),
    [
        (limits([0.1, 9.0], 90.0, 900.0), "joint 1 reaches its limit of velocity, 0.1"),
        (limits([9.0, 9.0], [90.0, 0.2], 900.0), "joint 2 reaches its limit of acceleration, 0.2"),
        (limits([9.0, 9.0], 90.0, [900.0, 0.3]), "joint 2 reaches its limit of jerk, 0.3"),
    ],
)
def test_the_joint_that_binds_is_named(bounds: SegmentLimits, words: str) -> None:
    with pytest.raises(InvalidField, match=words):
        timed(None, straight(1.0, -1.0), "quintic", bounds, duration=1e-3)


def test_the_tip_s_limit_that_binds_is_named() -> None:
    path = line(LEVEL, TURNED)
    for name, words in (
        ("speed", "speed, 0.25"),
        ("angular_speed", "angular speed, 0.25"),
        ("acceleration", "acceleration, 0.25"),
        ("angular_acceleration", "angular acceleration, 0.25"),
    ):
        bounds = limits(tip=TipLimits(**{name: 0.25}), joints=4)
        with pytest.raises(InvalidField, match=f"the tip reaches its limit of {words}$"):
            timed(path, gantry(path, 4), "quintic", bounds, duration=1e-3)


@pytest.mark.parametrize("law", LAWS)
def test_what_does_not_move_takes_no_time_or_the_one_that_is_given(law: Law) -> None:
    at = np.array([1.0, -2.0])
    ways = (
        PiecewisePolynomial(np.array([0.0, 1e-12]), at[None, None]),
        PiecewisePolynomial(np.array([0.0, 1.0]), np.array([[at, [0.0, 0.0]]])),
    )
    for way in ways:
        found = timed(None, way, law, limits(joints=2))
        np.testing.assert_array_equal(found.motion.breaks, [0.0, 0.0])
        np.testing.assert_array_equal(found.law.breaks, [0.0, 0.0])
        np.testing.assert_array_equal(found.motion.coefficients[0, 0], at)
        resting = timed(None, way, law, limits(joints=2), duration=2.5)
        assert resting.motion.duration == resting.law.duration == 2.5
        np.testing.assert_array_equal(resting.motion.at(np.array([0.0, 1.0, 2.5])), [at] * 3)
    assert compared(None, ways[0], law, limits(joints=2)) == (0.0, 0.0, 0.0, 0.0)


@pytest.mark.parametrize("law", LAWS)
def test_no_joints_take_no_time(law: Law) -> None:
    way = PiecewisePolynomial(np.array([0.0, 1.0]), np.zeros((1, 6, 0)))
    assert timed(None, way, law, limits(joints=0)).motion.duration == 0.0


@pytest.mark.parametrize("law", LAWS)
def test_limits_of_any_size(law: Law) -> None:
    for v, a, j in ((1e-9, 1.0, 1e9), (1e9, 1e-9, 1.0), (1.0, 1e9, 1e-9), (1e9, 1e9, 1e9), (1e-9, 1e9, 1e9)):
        bounds = limits([v, v], a, j)
        for way in (planar_line(5), straight(1e-9, 0.0), straight(1.0, -2.0)):
            found = timed(None, way, law, bounds)
            assert (np.diff(found.motion.breaks) > 0.0).all()
            assert joint_ratios(found, bounds, with_jerk=law in SMOOTH).max() <= 1.0 + 1e-9
