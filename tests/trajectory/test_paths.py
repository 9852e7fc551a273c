"""Paths by arc length: the lecture's line, circles, splines and blended corners against differences and brute force."""

import math
from collections.abc import Callable
from itertools import pairwise

import numpy as np
import pytest
from scipy.integrate import quad
from scipy.interpolate import CubicSpline
from scipy.spatial.transform import Rotation, Slerp

from gelenk.course.motion.fly_over import blended as flown_over, corner_of
from gelenk.errors import InvalidField
from gelenk.robot.arrays import Array
from gelenk.robot.poses import Poses, transform
from gelenk.trajectory.paths.corners import blended, blended_lines
from gelenk.trajectory.paths.paths import Path, PathSamples, PathSequence, circle, line
from gelenk.trajectory.paths.spline_paths import spline
from gelenk.trajectory.paths.zyz_paths import zyz_turns

RADII = [0.2, 0.1, 0.3]


def poses(count: int, seed: int, step: float = 0.7) -> Poses:
    """Poses at random positions, each turned a little further."""
    rng = np.random.default_rng(seed)
    turns = Rotation.from_rotvec(np.cumsum(rng.normal(0.0, step, (count, 3)), axis=0))
    return Poses(rng.normal(size=(count, 3)), np.ascontiguousarray(turns.as_matrix()))


def matrices(count: int, seed: int) -> Array:
    return poses(count, seed).matrices()


def example(kind: str, seed: int = 1) -> Path:
    Ts = matrices(3, seed)
    made: dict[str, Callable[[], Path]] = {
        "line": lambda: line(Ts[0], Ts[1]),
        "line by zyz": lambda: line(Ts[0], Ts[1], zyz_turns(Ts[:2, :3, :3], [False])[0]),
        "turn": lambda: line(Ts[0], transform(Ts[0, :3, 3], Ts[1, :3, :3])),
        "circle": lambda: circle(Ts[0], Ts[1], Ts[2]),
        "circle by zyz": lambda: circle(Ts[0], Ts[1], Ts[2], "zyz_other"),
        "spline": lambda: spline(poses(6, seed)),
        "spline by zyz": lambda: spline(poses(6, seed), "natural", "zyz"),
        "blended lines": lambda: blended_lines(poses(5, seed), RADII),
        "smooth corners": lambda: blended_lines(poses(5, seed), RADII, smooth=True),
        "smooth corners by zyz": lambda: by_zyz(poses(5, seed), smooth=True),
        "blended lines by zyz": lambda: by_zyz(poses(5, seed), smooth=False),
        "corners of arcs": lambda: of_arcs(matrices(7, seed)),
    }
    return made[kind]()


def columns(at: PathSamples) -> Array:
    """All numbers of samples side by side; shape (N, 24)."""
    return np.hstack((at.poses.positions, at.poses.rotations.reshape(-1, 9), at.first, at.second))


def by_zyz(waypoints: Poses, *, smooth: bool) -> PathSequence:
    turns = zyz_turns(waypoints.rotations, [False, True, False, False])
    legs = [line(*Ts, turn) for Ts, turn in zip(pairwise(waypoints.matrices()), turns, strict=True)]
    return blended(legs, RADII, [smooth] * 3)


def of_arcs(Ts: Array) -> PathSequence:
    """A line, an arc by each law of orientation, and a line."""
    arcs = circle(Ts[1], Ts[2], Ts[3]), circle(Ts[3], Ts[4], Ts[5], "zyz_other")
    return blended([line(Ts[0], Ts[1]), *arcs, line(Ts[5], Ts[6])], RADII, [True] * 3)


def angle_of(path: Path) -> float:
    """The angle by which the tip turns, from its rates."""
    s = np.linspace(0.0, path.extent, 20_001)
    return float(np.trapezoid(np.linalg.norm(path.at(s).first[:, 3:], axis=1), s))


def twists(samples: PathSamples, speeds: Array) -> Array:
    twist: Array = samples.first * speeds[:, None]
    return twist


KINDS = (
    *("line", "line by zyz", "turn", "circle", "circle by zyz"),
    *("spline", "spline by zyz", "blended lines", "blended lines by zyz"),
    *("smooth corners", "smooth corners by zyz", "corners of arcs"),
)


def away_from_breaks(path: Path, count: int, gap: float) -> Array:
    s = np.linspace(gap, path.extent - gap, count)
    ends = np.array(path.breaks)
    return s[(np.abs(s[:, None] - ends) > gap).all(axis=1)] if len(ends) else s


# All kinds


@pytest.mark.parametrize("kind", KINDS)
def test_derivatives_by_differences(kind: str) -> None:
    path = example(kind)
    step = 1e-5 * path.extent
    s = away_from_breaks(path, 60, 2.0 * step)
    before, at, after = (path.at(s + k * step) for k in (-1, 0, 1))
    scale, bend = float(np.abs(at.first).max()), float(np.abs(at.second).max()) + 1.0
    linear = (after.poses.positions - before.poses.positions) / (2.0 * step)
    turns = Rotation.from_matrix(after.poses.rotations) * Rotation.from_matrix(before.poses.rotations).inv()
    np.testing.assert_allclose(at.first[:, :3], linear, atol=1e-6 * bend)
    np.testing.assert_allclose(at.first[:, 3:], turns.as_rotvec() / (2.0 * step), atol=1e-6 * bend)
    np.testing.assert_allclose(at.second, (after.first - before.first) / (2.0 * step), atol=1e-4 * bend * scale)


@pytest.mark.quick(3)
@pytest.mark.parametrize("kind", KINDS)
def test_the_parameter_is_the_arc_length(kind: str) -> None:
    """The chords of many small steps add up to it, and the tangent has length one."""
    path = example(kind)
    samples = path.at(np.linspace(0.0, path.extent, 40_001))
    chords = np.linalg.norm(np.diff(samples.poses.positions, axis=0), axis=1)
    assert chords.sum() == pytest.approx(path.extent if path.unit == "m" else 0.0, rel=1e-6, abs=1e-12)
    if path.unit == "m":
        np.testing.assert_allclose(chords, path.extent / len(chords), rtol=1e-3)
        np.testing.assert_allclose(np.linalg.norm(samples.first[:, :3], axis=1), 1.0, rtol=1e-12)
    turns = Rotation.from_matrix(samples.poses.rotations)
    assert (turns[1:] * turns[:-1].inv()).magnitude().sum() == pytest.approx(angle_of(path), rel=1e-6)


@pytest.mark.parametrize("kind", KINDS)
def test_nothing_jumps_but_at_the_breaks(kind: str) -> None:
    path = example(kind)
    s = np.linspace(0.0, path.extent, 3001)
    for place in path.breaks:
        assert 0.0 < place < path.extent
        before, after = path.at(np.array([place - 1e-9])), path.at(np.array([place + 1e-9]))
        np.testing.assert_allclose(before.poses.positions, after.poses.positions, atol=1e-8)
        np.testing.assert_allclose(before.poses.rotations, after.poses.rotations, atol=1e-7)
    samples = path.at(s)
    assert np.isfinite(samples.first).all()
    assert np.isfinite(samples.second).all()
    assert np.abs(np.linalg.det(samples.poses.rotations) - 1.0).max() < 1e-12


@pytest.mark.parametrize("kind", KINDS)
def test_a_time_law_along_a_path(kind: str) -> None:
    """ξ = ξ_s ṡ and ξ̇ = ξ_s s̈ + ξ_s' ṡ², against differences in time."""
    path = example(kind)

    def s(t: Array) -> Array:
        return np.asarray(path.extent * (0.37 + 0.2 * t + 0.3 * t * t))

    h, t = 1e-4, np.array([0.1])
    assert not any(abs(place - float(s(t)[0])) < 1e-3 for place in path.breaks)
    speed, acceleration = path.extent * (0.2 + 0.6 * t), np.array([0.6 * path.extent])
    before, at, after = (path.at(s(t + k * h)) for k in (-1, 0, 1))
    velocity = (after.poses.positions - before.poses.positions) / (2.0 * h)
    scale = 1.0 + float(np.abs(at.second).max())
    np.testing.assert_allclose(twists(at, speed)[:, :3], velocity, atol=1e-5 * scale)
    p2 = (after.poses.positions - 2.0 * at.poses.positions + before.poses.positions) / h**2
    rates = at.first * acceleration + at.second * speed**2
    np.testing.assert_allclose(rates[:, :3], p2, atol=1e-3 * scale)
    before_twist, after_twist = (
        twists(samples, path.extent * (0.2 + 0.6 * (t + k * h))) for samples, k in ((before, -1), (after, 1))
    )
    change = (after_twist - before_twist) / (2.0 * h)
    np.testing.assert_allclose(rates, change, atol=1e-3 * scale)


# Lines


def test_the_line_of_the_lecture() -> None:
    """p_i = (.4, -.2, .3), p_f = (.6, .5, .1)."""
    path = line(transform(np.array([0.4, -0.2, 0.3]), np.eye(3)), transform(np.array([0.6, 0.5, 0.1]), np.eye(3)))
    assert path.extent == pytest.approx(0.754983443527, abs=5e-13)
    np.testing.assert_allclose(path.at(np.array([path.extent / 2])).poses.positions[0], [0.5, 0.15, 0.2], atol=1e-15)
    # With a trapezoid of v = .5, a = 1 it is there at t = .7: σ = v t - v² / 2a.
    at = path.at(np.array([0.5 * 0.7 - 0.125])).poses.positions[0]
    np.testing.assert_allclose(at, [0.459603956068, 0.008613846238, 0.240396043932], atol=5e-13)
    assert not path.at(np.array([0.1])).first[0, 3:].any()


def test_a_line_meets_both_ends_exactly() -> None:
    for seed in range(10):
        Ts = matrices(2, seed)
        path = line(Ts[0], Ts[1])
        ends = path.at(np.array([0.0, path.extent])).poses
        np.testing.assert_array_equal(ends.positions, Ts[:, :3, 3])
        np.testing.assert_allclose(ends.rotations, Ts[:, :3, :3], atol=2e-15)


def test_a_line_turns_as_slerp_does() -> None:
    Ts = matrices(2, 4)
    path, shares = line(Ts[0], Ts[1]), np.linspace(0.0, 1.0, 11)
    turned = Slerp([0.0, 1.0], Rotation.from_matrix(Ts[:, :3, :3]))(shares).as_matrix()
    np.testing.assert_allclose(path.at(shares * path.extent).poses.rotations, turned, atol=1e-14)
    rates = np.linalg.norm(path.at(shares * path.extent).first[:, 3:], axis=1)
    np.testing.assert_allclose(rates, path.orientation.angle / path.extent)


def test_a_line_of_no_length_turns_on_the_spot() -> None:
    T = matrices(2, 5)
    path = line(T[0], transform(T[0, :3, 3], T[1, :3, :3]))
    assert path.unit == "rad"
    assert path.extent > 0.1
    samples = path.at(np.linspace(0.0, path.extent, 7))
    np.testing.assert_allclose(np.linalg.norm(samples.first[:, 3:], axis=1), 1.0)
    assert not samples.first[:, :3].any()
    assert not samples.second.any()
    np.testing.assert_allclose(samples.poses.rotations[-1], T[1, :3, :3], atol=1e-15)


def test_a_line_from_a_pose_to_itself_is_there_already() -> None:
    T = matrices(1, 6)[0]
    path = line(T, T)
    samples = path.at(np.zeros(2))
    assert path.extent == 0.0
    np.testing.assert_array_equal(samples.poses.rotations, [T[:3, :3]] * 2)
    assert not samples.first.any()


# Circles


def test_a_circle_leads_through_its_via_pose_in_order() -> None:
    for seed in range(20):
        Ts = matrices(3, seed)
        path = circle(Ts[0], Ts[1], Ts[2])
        samples = path.at(np.linspace(0.0, path.extent, 4001)).poses
        for T, at in zip(Ts, (0, None, -1), strict=True):
            distances = np.linalg.norm(samples.positions - T[:3, 3], axis=1)
            i = int(distances.argmin()) if at is None else at
            assert distances[i] <= (path.extent / 4000 if at is None else 1e-12)
            turn = Rotation.from_matrix(samples.rotations[i].T @ T[:3, :3]).magnitude()
            assert turn <= (20.0 * angle_of(path) / 4000 if at is None else 1e-7)
        # All of one plane, and of one distance from its centre, which is that of the three points.
        centre, *_ = np.linalg.lstsq(
            np.vstack((2.0 * (Ts[1:, :3, 3] - Ts[0, :3, 3]), np.cross(*(Ts[1:, :3, 3] - Ts[0, :3, 3])))),
            np.append(
                np.sum(Ts[1:, :3, 3] ** 2, axis=1) - np.sum(Ts[0, :3, 3] ** 2),
                np.cross(*(Ts[1:, :3, 3] - Ts[0, :3, 3])) @ Ts[0, :3, 3],
            ),
        )
        radii = np.linalg.norm(samples.positions - centre, axis=1)
        np.testing.assert_allclose(radii, radii[0], rtol=1e-9)
        np.testing.assert_allclose(np.linalg.norm(path.at(np.array([0.0])).second[:, :3]), 1.0 / radii[0], rtol=1e-9)


def test_a_circle_takes_the_arc_on_which_the_via_pose_is() -> None:
    """A quarter of the unit circle, and the three quarters that remain."""

    def at(degrees: float) -> Array:
        angle = math.radians(degrees)
        return transform(np.array([math.cos(angle), math.sin(angle), 0.2]), np.eye(3))

    assert circle(at(0), at(45), at(90)).extent == pytest.approx(0.5 * math.pi)
    assert circle(at(0), at(180), at(90)).extent == pytest.approx(1.5 * math.pi)
    assert circle(at(0), at(-45), at(-90)).extent == pytest.approx(0.5 * math.pi)
    assert circle(at(0), at(180), at(359)).extent == pytest.approx(math.radians(359))


@pytest.mark.parametrize(
    ("points", "reason"),
    [
        ([(0, 0, 0), (1, 1, 1), (2, 2, 2)], "one line"),
        ([(0, 0, 0), (3, 0, 0), (2, 1e-7, 0)], "one line"),
        ([(1, 0, 0), (1, 0, 0), (2, 1, 0)], "start and via are the same point"),
        ([(1, 0, 0), (2, 1, 0), (2, 1, 0)], "via and target are the same point"),
        ([(1, 0, 0), (2, 1, 0), (1, 0, 0)], "start and target are the same point"),
        ([(1, 0, 0), (1, 0, 0), (1, 0, 0)], "same point"),
    ],
)
def test_three_points_that_make_no_circle_are_refused(points: list[tuple[float, float, float]], reason: str) -> None:
    Ts = [transform(np.array(point, dtype=float), np.eye(3)) for point in points]
    with pytest.raises(InvalidField, match=reason) as refused:
        circle(Ts[0], Ts[1], Ts[2])
    assert refused.value.field == "via"


# Splines


@pytest.mark.parametrize("boundary", ["natural", "not_a_knot"])
def test_a_spline_is_that_of_scipy_by_arc_length(boundary: str) -> None:
    waypoints = poses(6, 7)
    path = spline(waypoints, "natural" if boundary == "natural" else "not_a_knot")
    knots = np.concatenate(([0.0], np.cumsum(np.linalg.norm(np.diff(waypoints.positions, axis=0), axis=1))))
    theirs = CubicSpline(knots, waypoints.positions, bc_type=boundary.replace("_", "-"))

    def speed(u: float) -> float:
        return float(np.linalg.norm(theirs(u, 1)))

    u = np.array([0.3 * knots[1], knots[2], 0.5 * (knots[3] + knots[4]), knots[-1]])
    parts = np.concatenate(([0.0], u))
    steps = [quad(speed, a, b, points=knots[(knots > a) & (knots < b)], epsabs=1e-12)[0] for a, b in pairs(parts)]
    samples = path.at(np.cumsum(steps))
    np.testing.assert_allclose(samples.poses.positions, theirs(u), atol=1e-9)
    first, second = theirs(u, 1), theirs(u, 2)
    curvature = np.linalg.norm(np.cross(first, second), axis=1) / np.linalg.norm(first, axis=1) ** 3
    np.testing.assert_allclose(np.linalg.norm(samples.second[:, :3], axis=1), curvature, rtol=1e-6, atol=1e-9)


def pairs(values: Array) -> list[tuple[float, float]]:
    return list(zip(values[:-1].tolist(), values[1:].tolist(), strict=True))


def test_a_spline_passes_its_poses_and_is_smooth() -> None:
    waypoints = poses(6, 8)
    path = spline(waypoints)
    samples = path.at(np.linspace(0.0, path.extent, 20_001))
    for position, rotation in zip(waypoints.positions, waypoints.rotations, strict=True):
        distances = np.linalg.norm(samples.poses.positions - position, axis=1)
        i = int(distances.argmin())
        assert distances[i] <= path.extent / 20_000
        assert np.abs(samples.poses.rotations[i] - rotation).max() <= 40.0 * angle_of(path) / 20_000
    largest = np.abs(samples.second).max()
    assert np.abs(np.diff(samples.first, axis=0)).max() <= 1.1 * largest * path.extent / 20_000, "C¹ everywhere"
    assert np.abs(np.diff(samples.second, axis=0)).max() <= 0.02 * largest, "C² everywhere"


def test_a_periodic_spline_closes_smoothly() -> None:
    waypoints = poses(5, 9)
    waypoints.positions[-1] = waypoints.positions[0]
    path = spline(waypoints, "periodic")
    ends = path.at(np.array([0.0, path.extent]))
    np.testing.assert_allclose(ends.first[0, :3], ends.first[1, :3], atol=1e-9)
    np.testing.assert_allclose(ends.second[0, :3], ends.second[1, :3], atol=1e-7)


def test_a_spline_of_two_poses_is_a_line() -> None:
    waypoints = poses(2, 10)
    path, straight = spline(waypoints), line(*waypoints.matrices())
    s = np.linspace(0.0, straight.extent, 9)
    np.testing.assert_allclose(path.at(s).poses.matrices(), straight.at(s).poses.matrices(), atol=1e-13)


def test_waypoints_that_make_no_spline_are_refused() -> None:
    with pytest.raises(InvalidField, match="at least two"):
        spline(poses(1, 0))
    twice = poses(4, 0)
    twice.positions[2] = twice.positions[1]
    with pytest.raises(InvalidField, match="poses 1 and 2 share one position"):
        spline(twice)
    back = Poses(np.array([[0.0, 0, 0], [1, 0, 0], [0, 0, 0]]), np.tile(np.eye(3), (3, 1, 1)))
    with pytest.raises(InvalidField, match="no tangent"):
        spline(back)


# Blended corners


def test_a_blended_corner_is_the_fly_over() -> None:
    """At constant speed of the parameter, the parabola is the one that the lecture's formula gives with v₁ = v₂."""
    waypoints = poses(3, 11)
    path = blended_lines(waypoints, [0.25])
    begin, finish = path.breaks
    way = corner_of(waypoints.positions[0], waypoints.positions[1], waypoints.positions[2], 1.0, 1.0)
    blend = flown_over(way, "radius", 0.25)
    on_blend = blend.motion.at(np.linspace(0.0, blend.time, 4001))
    lengths = np.concatenate(([0.0], np.cumsum(np.linalg.norm(np.diff(on_blend, axis=0), axis=1))))
    assert finish - begin == pytest.approx(lengths[-1], rel=1e-6)
    np.testing.assert_allclose(path.at(begin + lengths).poses.positions, on_blend, atol=1e-6)
    distances = np.linalg.norm(path.at(np.linspace(begin, finish, 4001)).poses.positions - way.corner, axis=1)
    assert distances.min() == pytest.approx(blend.closest_distance, rel=1e-6)
    assert begin == pytest.approx(way.length_before - 0.25)


def test_the_parabola_has_the_arc_length_of_the_closed_form() -> None:
    """With u from the vertex, L = ∫ 2 √(c² u² + h²) du."""
    waypoints = poses(3, 12)
    path = blended_lines(waypoints, [0.3])
    way = corner_of(waypoints.positions[0], waypoints.positions[1], waypoints.positions[2], 1.0, 1.0)
    a, b = 0.3 * way.direction_before, 0.3 * way.direction_after
    c = float(np.linalg.norm(b - a))
    x0, x1 = float(a @ (b - a)) / c, float(b @ (b - a)) / c
    h = float(np.linalg.norm(a - x0 * (b - a) / c))

    def integral(x: float) -> float:
        return float(x * math.hypot(x, h) + h * h * math.asinh(x / h)) / c

    assert path.parts[1].extent == pytest.approx(integral(x1) - integral(x0), rel=1e-12)


@pytest.mark.parametrize("kind", ["blended lines", "corners of arcs"])
def test_places_in_any_order_are_those_one_by_one(kind: str) -> None:
    path = example(kind)
    s = np.random.default_rng(4).permutation(np.concatenate((np.linspace(0.0, path.extent, 40), path.breaks)))
    many, ones = columns(path.at(s)), [columns(path.at(place)) for place in s[:, None]]
    np.testing.assert_array_equal(many, np.concatenate(ones))
    assert len(path.at(np.empty(0)).first) == 0


def test_tangent_and_angular_rate_go_on_across_blends() -> None:
    path = blended_lines(poses(5, 13), RADII)
    places = np.array(path.breaks)
    assert len(places) == 6
    before, after = path.at(places - 1e-10), path.at(places + 1e-10)
    np.testing.assert_allclose(before.first, after.first, atol=1e-7)


@pytest.mark.parametrize("kind", ["smooth corners", "smooth corners by zyz", "corners of arcs"])
def test_curvature_and_angular_rates_go_on_across_smooth_corners(kind: str) -> None:
    path = example(kind, 13)
    places = np.array(path.breaks)
    assert len(places) == 6
    before, after = path.at(places - 1e-8), path.at(places + 1e-8)
    np.testing.assert_allclose(before.first, after.first, atol=1e-6)
    np.testing.assert_allclose(before.second, after.second, atol=1e-4)


def test_a_smooth_corner_passes_nearer_than_the_parabola() -> None:
    """At u = 1/2, 3/16 of the difference of both legs' ends from the corner, the parabola a quarter."""
    waypoints, radius = poses(3, 11), 0.25
    path = blended_lines(waypoints, [radius], smooth=True)
    begin, finish = path.breaks
    points = path.at(np.linspace(begin, finish, 4001)).poses.positions
    way = corner_of(waypoints.positions[0], waypoints.positions[1], waypoints.positions[2], 1.0, 1.0)
    middle = 0.1875 * radius * float(np.linalg.norm(way.direction_after - way.direction_before))
    distances = np.linalg.norm(points - way.corner, axis=1)
    assert distances.min() == pytest.approx(middle, rel=1e-6)
    assert distances.max() == pytest.approx(radius, rel=1e-12)
    # Beside a leg, the path stays in the triangle of the corner and both ends of the blend.
    within = np.linalg.lstsq(np.array([-way.direction_before, way.direction_after]).T, (points - way.corner).T)[0]
    assert within.min() > -1e-12
    assert within.sum(axis=0).max() < radius * (1.0 + 1e-9)


def test_blends_that_do_not_fit_are_refused() -> None:
    square = Poses(np.array([[0.0, 0, 0], [1, 0, 0], [1, 1, 0], [0, 1, 0]]), np.tile(np.eye(3), (4, 1, 1)))
    blended_lines(square, [0.5, 0.5])
    assert len(blended_lines(square, [0.5, 0.5]).parts) == 4, "nothing is left of the middle leg"
    with pytest.raises(InvalidField, match=r"leg 1 is 1 m long, and its blends take 1\.1 m"):
        blended_lines(square, [0.6, 0.5])
    with pytest.raises(InvalidField, match="leg 0"):
        blended_lines(square, [1.1, 0.1])
    back = Poses(np.array([[0.0, 0, 0], [1, 0, 0], [0.2, 0, 0]]), np.tile(np.eye(3), (3, 1, 1)))
    with pytest.raises(InvalidField, match="requires a stop"):
        blended_lines(back, [0.1])
