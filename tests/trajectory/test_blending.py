"""Fly-over: the lecture's numbers, each kind of corner, and the parabola against integration and brute force."""

import math
from typing import Any

import numpy as np
import pytest
from scipy.integrate import solve_ivp
from scipy.optimize import minimize_scalar

from gelenk.course.motion.blended_motion import BlendedMotion, rest_to_rest
from gelenk.course.motion.fly_over import Blend, Corner, Given, blended, corner_of
from gelenk.course.motion.fly_over_check import checked
from gelenk.errors import InvalidField
from gelenk.robot.arrays import Array


def corner(A: Any, B: Any, C: Any, v1: float, v2: float) -> Corner:
    return corner_of(np.array(A, dtype=float), np.array(B, dtype=float), np.array(C, dtype=float), v1, v2)


LECTURE = corner((3, 3), (1, 9), (8, 9), 1.0, 2.0)
SPACE = corner((0, 0, 0), (1, 0, 0), (1, 1, 0.5), 0.5, 0.5)
GIVEN: tuple[Given, ...] = ("blend_time", "distance_before", "distance_after", "radius", "max_acceleration")


# The lecture's numbers


def test_the_blend_of_the_lecture_by_its_time() -> None:
    """A = (3, 3), B = (1, 9), C = (8, 9), v = (1, 2), ΔT = 4."""
    blend = blended(LECTURE, "blend_time", 4.0)
    assert (blend.distance_before, blend.distance_after) == pytest.approx((2.0, 4.0))
    np.testing.assert_allclose(blend.entry, [1.632455532034, 7.102633403899], atol=5e-13)
    np.testing.assert_allclose(blend.exit, [5.0, 9.0], atol=1e-14)
    np.testing.assert_allclose(blend.acceleration, [0.579056941504, -0.237170824513], atol=5e-13)
    assert blend.closest_distance == pytest.approx(1.097563964535, abs=5e-13)
    assert blend.closest_time == pytest.approx(1.494067815, abs=5e-8)
    assert LECTURE.turn == "corner"


def test_the_blend_of_the_lecture_by_its_distance() -> None:
    blend = blended(LECTURE, "distance_before", 3.0)
    assert (blend.time, blend.distance_after) == pytest.approx((6.0, 6.0))
    assert math.hypot(*blend.acceleration) == pytest.approx(0.417163406036, abs=5e-13)


def test_the_blend_of_the_lecture_by_its_acceleration() -> None:
    blend = blended(LECTURE, "max_acceleration", 0.5)
    assert blend.time == pytest.approx(5.005960872427, abs=5e-13)
    assert math.hypot(*blend.acceleration) == pytest.approx(0.5)


def test_from_rest_to_rest_in_space() -> None:
    """A = 0, B = (1, 0, 0), C = (1, 1, .5), v = .5, a = 1: half a second less than with a stop in B."""
    blend = blended(SPACE, "max_acceleration", 1.0)
    assert blend.time == pytest.approx(0.707106781187, abs=5e-13)
    assert (blend.distance_before, blend.distance_after) == pytest.approx((0.176776695297,) * 2, abs=5e-13)
    whole = rest_to_rest(blend, 1.0)
    durations = {phase.name: phase.duration for phase in whole.phases}
    assert durations["coast_before"] == pytest.approx(1.396446609407, abs=5e-13)
    assert durations["coast_after"] == pytest.approx(1.632514586907, abs=5e-13)
    assert whole.duration == pytest.approx(4.736067977500, abs=5e-13)
    assert whole.stopping_duration == pytest.approx(5.236067977500, abs=5e-13)
    middle = blend.motion.at(np.array([0.5 * blend.time]))[0]
    np.testing.assert_allclose(middle, [0.955805826176, 0.039528470752, 0.019764235376], atol=5e-13)


# Each kind of corner


def test_a_blend_that_is_longer_than_a_leg_is_refused_with_what_fits() -> None:
    with pytest.raises(InvalidField, match=r"end 8 m after B, and BC is 7 m long; allowed: at most 7 s") as refused:
        blended(LECTURE, "blend_time", 8.0)
    assert refused.value.field == "blend_time"
    with pytest.raises(InvalidField, match=r"at most 3.5 m"):
        blended(LECTURE, "distance_before", 3.6)
    with pytest.raises(InvalidField, match=r"at most 7 m"):
        blended(LECTURE, "distance_after", 7.1)
    with pytest.raises(InvalidField, match=r"at least 0.357569 m/s²"):
        blended(LECTURE, "max_acceleration", 0.3)
    short = corner((0, 0), (1, 0), (1, 5), 1.0, 1.0)
    with pytest.raises(InvalidField, match=r"begin 1.5 m before B, and AB is 1 m long; allowed: at most 2 s"):
        blended(short, "blend_time", 3.0)
    with pytest.raises(InvalidField, match=r"at most 1 m"):
        blended(short, "radius", 1.1)


@pytest.mark.parametrize("given", GIVEN)
def test_a_blend_may_take_a_whole_leg(given: Given) -> None:
    longest = LECTURE.longest_blend_time
    value = by(blended(LECTURE, "blend_time", longest), given)
    blend = blended(LECTURE, given, value)
    assert blend.time == pytest.approx(7.0)
    np.testing.assert_allclose(blend.exit, LECTURE.end, atol=1e-13)


def test_straight_on_it_is_a_change_of_speed_through_the_corner() -> None:
    blend = blended(corner((0, 0, 0), (1, 1, 1), (3, 3, 3), 1.0, 0.5), "max_acceleration", 0.25)
    assert blend.corner.turn == "straight"
    assert blend.time == pytest.approx(2.0)
    assert math.hypot(*blend.acceleration) == pytest.approx(0.25)
    assert blend.closest_distance == pytest.approx(0.0, abs=1e-15)
    np.testing.assert_allclose(blend.motion.at(np.array([blend.closest_time]))[0], [1.0, 1.0, 1.0], atol=1e-14)


def test_straight_on_at_one_speed_nothing_changes() -> None:
    way = corner((0, 0), (1, 0), (2, 0), 0.5, 0.5)
    blend = blended(way, "max_acceleration", 1.0)
    assert (blend.time, blend.distance_before, blend.closest_distance) == (0.0, 0.0, 0.0)
    with pytest.raises(ValueError, match="zero time"):
        _ = blend.motion
    whole = rest_to_rest(blend, 1.0)
    assert whole.duration == pytest.approx(4.5), "the trapezoid of the whole way"
    assert checked(blend, whole.motion).steps == 0


def test_a_reversal_stops_before_the_corner_and_returns() -> None:
    way = corner((0, 0), (2, 0), (-1, 0), 1.0, 1.0)
    blend = blended(way, "blend_time", 2.0)
    assert (way.turn, blend.distance_before, blend.distance_after) == ("reversal", 1.0, 1.0)
    np.testing.assert_allclose(blend.acceleration, [-1.0, 0.0])
    assert (blend.closest_time, blend.closest_distance) == pytest.approx((1.0, 0.5))
    velocity = blend.motion.derivative().at(np.array([blend.closest_time]))[0]
    np.testing.assert_allclose(velocity, [0.0, 0.0], atol=1e-14)
    faster = blended(corner((0, 0), (2, 0), (-1, 0), 1.0, 2.0), "blend_time", 1.0)
    turning = 1.0 / 3.0
    assert faster.closest_time == pytest.approx(turning), "v = 1 - 3 t"
    assert faster.closest_distance == pytest.approx(0.5 - turning + 1.5 * turning**2)


def test_from_rest_in_the_corner_and_to_rest_in_it() -> None:
    leaving = blended(corner((0, 0), (1, 0), (1, 2), 0.0, 1.0), "blend_time", 1.0)
    np.testing.assert_allclose(leaving.entry, [1.0, 0.0])
    assert (leaving.distance_before, leaving.closest_time, leaving.closest_distance) == (0.0, 0.0, 0.0)
    arriving = blended(corner((0, 0), (1, 0), (1, 2), 1.0, 0.0), "blend_time", 1.0)
    np.testing.assert_allclose(arriving.exit, [1.0, 0.0])
    assert (arriving.closest_time, arriving.closest_distance) == (1.0, 0.0)
    with pytest.raises(InvalidField, match="the speed on this leg is 0"):
        blended(leaving.corner, "distance_before", 0.5)
    with pytest.raises(InvalidField, match="covers all of"):
        rest_to_rest(leaving, 1.0)


def test_points_and_speeds_that_make_no_corner_are_refused() -> None:
    with pytest.raises(InvalidField, match="A and B are the same point"):
        corner((1, 1), (1, 1), (2, 2), 1.0, 1.0)
    with pytest.raises(InvalidField, match="B and C are the same point"):
        corner((0, 1), (1, 1), (1, 1), 1.0, 1.0)
    with pytest.raises(InvalidField, match="nothing moves"):
        corner((0, 0), (1, 1), (2, 1), 0.0, 0.0)


@pytest.mark.parametrize(("leg", "end"), [("speed_before", (1, 5, 0)), ("speed_after", (1, 0.3, 0))])
def test_a_blend_that_overlaps_a_ramp_is_refused(leg: str, end: tuple[float, float, float]) -> None:
    """Each leg holds the blend alone; with the ramp from or to rest it is too short."""
    start = (0.7, 0, 0) if leg == "speed_before" else (-5, 0, 0)
    blend = blended(corner(start, (1, 0, 0), end, 0.5, 0.5), "max_acceleration", 0.8)
    with pytest.raises(InvalidField, match="the two overlap") as refused:
        rest_to_rest(blend, 0.8)
    assert refused.value.field == leg
    rest_to_rest(blended(blend.corner, "max_acceleration", 8.0), 8.0)


# Second ways


def some_corner(rng: np.random.Generator, dimensions: int) -> Corner:
    points = rng.normal(size=(3, dimensions))
    v1, v2 = 10.0 ** rng.uniform(-1.5, 1.5, 2)
    return corner(points[0], points[1], points[2], v1, v2)


def by(blend: Blend, given: Given) -> float:
    """The value of a blend that a quantity has."""
    return {
        "blend_time": blend.time,
        "distance_before": blend.distance_before,
        "distance_after": blend.distance_after,
        "radius": max(blend.distance_before, blend.distance_after),
        "max_acceleration": math.hypot(*blend.acceleration),
    }[given]


@pytest.mark.parametrize("dimensions", [2, 3])
def test_a_blend_solves_its_differential_equation(dimensions: int) -> None:
    """Constant acceleration from A' at v₁ K_AB, integrated by SciPy, ends in C' at v₂ K_BC."""
    rng = np.random.default_rng(dimensions)
    for _ in range(10):
        way = some_corner(rng, dimensions)
        blend = blended(way, "blend_time", rng.uniform(0.1, 1.0) * way.longest_blend_time)
        first = way.speed_before * way.direction_before

        def motion(_: float, state: Array, blend: Blend = blend) -> Array:
            return np.concatenate((state[len(blend.entry) :], blend.acceleration))

        end = solve_ivp(motion, (0.0, blend.time), np.concatenate((blend.entry, first)), rtol=1e-10, atol=1e-12).y[
            :, -1
        ]
        expected = np.concatenate((blend.exit, way.speed_after * way.direction_after))
        np.testing.assert_allclose(end, expected, rtol=1e-8, atol=1e-9)


@pytest.mark.parametrize("dimensions", [2, 3])
def test_the_nearest_point_by_brute_force(dimensions: int) -> None:
    rng = np.random.default_rng(10 + dimensions)
    for _ in range(30):
        way = some_corner(rng, dimensions)
        blend = blended(way, "blend_time", rng.uniform(0.1, 1.0) * way.longest_blend_time)
        motion, B = blend.motion, way.corner

        def distance(t: float, motion: Any = motion, B: Array = B) -> float:
            return float(np.linalg.norm(motion.at(np.array([t]))[0] - B))

        times = np.linspace(0.0, blend.time, 2001)
        i = int(np.linalg.norm(motion.at(times) - B, axis=1).argmin())
        bracket = (times[max(i - 1, 0)], times[min(i + 1, 2000)])
        nearest = minimize_scalar(distance, bounds=bracket, method="bounded", options={"xatol": 1e-12})
        assert blend.closest_distance == pytest.approx(nearest.fun, rel=1e-9, abs=1e-12)
        assert distance(blend.closest_time) == pytest.approx(blend.closest_distance, rel=1e-9, abs=1e-13)


@pytest.mark.parametrize("given", GIVEN)
def test_each_quantity_determines_the_others(given: Given) -> None:
    rng = np.random.default_rng(3)
    for _ in range(20):
        way = some_corner(rng, 3)
        blend = blended(way, "blend_time", rng.uniform(0.1, 0.99) * way.longest_blend_time)
        again = blended(way, given, by(blend, given))
        np.testing.assert_allclose(again.motion.coefficients, blend.motion.coefficients, rtol=1e-12)


def test_a_blend_stays_in_the_plane_of_its_points() -> None:
    rng = np.random.default_rng(4)
    for _ in range(10):
        way = some_corner(rng, 3)
        normal = np.cross(way.direction_before, way.direction_after)
        motion = blended(way, "blend_time", way.longest_blend_time).motion
        heights = (motion.at(np.linspace(0.0, motion.duration, 20)) - way.corner) @ normal
        np.testing.assert_allclose(heights, 0.0, atol=1e-13)


def random_motion(rng: np.random.Generator) -> tuple[BlendedMotion, float]:
    """A motion from rest to rest whose ramps and blend fit."""
    way = some_corner(rng, 3)
    share = rng.uniform(0.1, 0.9) * min(way.length_before, way.length_after)
    fastest = max(way.speed_before, way.speed_after)
    acceleration = fastest**2 / (2.0 * (min(way.length_before, way.length_after) - share)) * rng.uniform(1.0, 3.0)
    return rest_to_rest(blended(way, "radius", share), acceleration), acceleration


def test_a_motion_from_rest_to_rest_is_continuous_and_keeps_its_limits() -> None:
    rng = np.random.default_rng(5)
    for _ in range(50):
        whole, acceleration = random_motion(rng)
        motion, blend = whole.motion, whole.blend
        start, end = motion.breaks[[0]], motion.breaks[[-1]]
        np.testing.assert_allclose(motion.at(start)[0], blend.corner.start, atol=1e-12)
        np.testing.assert_allclose(motion.at(end)[0], blend.corner.end, atol=1e-9)
        np.testing.assert_allclose(motion.derivative().at(np.concatenate((start, end))), 0.0, atol=1e-9)
        inner = motion.breaks[1:-1]
        for order, scale in ((0, 1.0), (1, blend.corner.speed_before + blend.corner.speed_after)):
            part = motion.derivative(order) if order else motion
            step = 1e-12 * motion.duration
            np.testing.assert_allclose(part.at(inner - step), part.at(inner + step), atol=1e-8 * scale)
        sizes = np.linalg.norm(motion.derivative(2).at(np.linspace(0.0, motion.duration, 500)), axis=1)
        allowed = max(acceleration, math.hypot(*blend.acceleration))
        assert sizes.max() <= allowed * (1.0 + 1e-12)
        assert whole.duration < whole.stopping_duration
        check = checked(blend, motion)
        assert check.max_position_error < 1e-12
        assert check.steps == 400
