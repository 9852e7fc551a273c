"""Ways to be timed: the lecture's line of the planar arm, gantries, splines in joint space, and how they are judged."""

from itertools import pairwise

import numpy as np
from scipy.interpolate import CubicSpline

from gelenk.robot.arrays import Array
from gelenk.trajectory.audit.demands import TipLimits
from gelenk.trajectory.audit.words import Law
from gelenk.trajectory.motion.polynomial import PiecewisePolynomial
from gelenk.trajectory.paths.path_geometry import TipMotion, geometry_of
from gelenk.trajectory.paths.paths import Path
from gelenk.trajectory.problem.problem import SegmentLimits
from gelenk.trajectory.timing import timing
from gelenk.trajectory.timing.timing import Timed, Timings

LAWS: tuple[Law, ...] = ("cubic", "quintic", "septic", "trapezoidal", "jerk_limited", "time_optimal")
SMOOTH = ("quintic", "septic", "jerk_limited")
LOOSE = 1e6


def timed(path: Path | None, joints: PiecewisePolynomial, law: Law, limits: SegmentLimits, **options: object) -> Timed:
    """The motion along a path, with options of the geometry and of the timing."""
    of_geometry = {name: options.pop(name) for name in ("tip_motion", "zones") if name in options}
    if path is not None:
        of_geometry.setdefault("tip_motion", tip_of_gantry(path))
    geometry = geometry_of(path, joints, limits, **of_geometry)  # type: ignore[arg-type]
    return timing.timed(geometry, law, **options)  # type: ignore[arg-type]


def compared(path: Path | None, joints: PiecewisePolynomial, law: Law, limits: SegmentLimits) -> Timings:
    return timing.compared(geometry_of(path, joints, limits), law)


def limits(
    velocity: float | list[float] | Array = LOOSE,
    acceleration: float | list[float] | Array = LOOSE,
    jerk: float | list[float] | Array = LOOSE,
    tip: TipLimits | None = None,
    joints: int = 1,
) -> SegmentLimits:
    """Limits of all joints alike, or of each."""
    given = [np.asarray(values, float) for values in (velocity, acceleration, jerk)]
    count = max(joints, *(values.size for values in given))
    rows = [np.broadcast_to(values, (count,)).copy() for values in given] if joints else [np.empty(0)] * 3
    return SegmentLimits(rows[0], rows[1], rows[2], tip or TipLimits())


def hermite(s: Array, q: Array, first: Array, second: Array) -> PiecewisePolynomial:
    """The quintic through values and two derivatives at both ends of each piece, by a linear system."""
    h = np.diff(s)[:, None]
    rows = (q[:-1], q[1:], h * first[:-1], h * first[1:], h**2 * second[:-1], h**2 * second[1:])
    powers = np.arange(6)
    matrix = [
        powers == 0,
        np.ones(6),
        powers == 1,
        powers,
        2.0 * (powers == 2),
        powers * (powers - 1.0),
    ]
    scaled = np.einsum("kr,rmn->mkn", np.linalg.inv(np.array(matrix, float)), np.array(rows))
    return PiecewisePolynomial(s, scaled / (h**powers)[:, :, None])


def straight(*displacements: float) -> PiecewisePolynomial:
    """A line in joint space, s from 0 to 1."""
    return PiecewisePolynomial(np.array([0.0, 1.0]), np.array([[np.zeros(len(displacements)), displacements]]))


def planar_line(pieces: int) -> PiecewisePolynomial:
    """q(s) of two unit links along the line from F(110°, 140°) to (.816, 1.4): the law of cosines, differentiated."""
    start, end = np.array([-0.684040287, 0.0]), np.array([0.816, 1.4])
    length = float(np.linalg.norm(end - start))
    s, d = np.linspace(0.0, length, pieces + 1), (end - start) / length
    p = start + s[:, None] * d
    square, along = (p**2).sum(axis=1), p @ d  # r² and its derivative by s halved.
    c = 0.5 * square - 1.0
    sine = np.sqrt(1.0 - c**2)
    elbow = np.arccos(c)
    elbow_1 = -along / sine
    elbow_2 = -(1.0 + c * along**2 / sine**2) / sine
    # The shoulder: the angle of p less half the elbow's, both links being equal; r² φ' = p × d.
    cross = p[:, 0] * d[1] - p[:, 1] * d[0]
    angle = np.unwrap(np.arctan2(p[:, 1], p[:, 0]))
    angle_1, angle_2 = cross / square, -2.0 * cross * along / square**2
    q = np.column_stack((angle - 0.5 * elbow, elbow))
    first = np.column_stack((angle_1 - 0.5 * elbow_1, elbow_1))
    second = np.column_stack((angle_2 - 0.5 * elbow_2, elbow_2))
    return hermite(s, q, first, second)


def gantry(path: Path, pieces: int) -> PiecewisePolynomial:
    """Three sliding joints that are the tip's coordinates along a path, and one that is s."""
    inner = [b for b in path.breaks if 0.0 < b < path.extent]
    edges = np.array([0.0, *inner, path.extent])
    parts = []
    for begin, end in pairwise(edges):
        s = np.linspace(begin, end, max(1, round(pieces * (end - begin) / path.extent)) + 1)
        inside = np.clip(s, begin + 1e-12, end - 1e-12)
        samples = path.at(inside)
        q = np.column_stack((path.at(s).poses.positions, s))
        first, second = samples.first.copy(), samples.second.copy()
        first[:, 3], second[:, 3] = 1.0, 0.0
        parts.append(hermite(s, q, first[:, :4], second[:, :4]))
    breaks = np.concatenate([edges[:1], *(part.breaks[1:] for part in parts)])
    return PiecewisePolynomial(breaks, np.concatenate([part.coefficients for part in parts]))


def tip_of_gantry(path: Path) -> TipMotion:
    """The tip's motion along a path, found from the joint of a gantry that is s."""

    def motion(q: Array, velocity: Array, acceleration: Array) -> tuple[Array, Array]:
        samples = path.at(np.clip(q[:, 3], 1e-9, path.extent - 1e-9))
        v, a = velocity[:, 3:], acceleration[:, 3:]
        return samples.first * v, samples.first * a + samples.second * v**2

    return motion


def random_way(rng: np.random.Generator, joints: int) -> PiecewisePolynomial:
    """A spline through some knots, of any size and over any s, in cubic or in quintic pieces."""
    count = int(rng.integers(2, 8))
    s = np.linspace(0.0, 10.0 ** rng.uniform(-1.0, 1.0), count)
    knots = 10.0 ** rng.uniform(-2.0, 0.5) * rng.uniform(-1.0, 1.0, (count, joints))
    spline = CubicSpline(s, knots, bc_type=("natural", "clamped")[int(rng.integers(2))])
    if rng.random() < 0.5:
        return PiecewisePolynomial(spline.x, np.ascontiguousarray(spline.c[::-1].transpose(1, 0, 2)))
    edges = np.linspace(0.0, s[-1], int(rng.integers(2, 30)))
    return hermite(edges, *(spline(edges, order) for order in range(3)))


def instants(motion: PiecewisePolynomial, per_piece: int) -> Array:
    """Times evenly spread over each piece, from its start to just before its end."""
    shares = np.append(np.linspace(0.0, 1.0, per_piece, endpoint=False), 1.0 - 1e-12)
    times: Array = (motion.breaks[:-1, None] + shares * np.diff(motion.breaks)[:, None]).ravel()
    return times


def joint_ratios(found: Timed, bounds: SegmentLimits, *, with_jerk: bool, per_piece: int = 10) -> Array:
    """The largest velocity, acceleration and jerk in fractions of their limits; shape (2,) or (3,)."""
    times = instants(found.motion, per_piece)
    each = (bounds.velocity, bounds.acceleration, bounds.jerk)[: 3 if with_jerk else 2]
    return np.array(
        [np.abs(found.motion.derivative(k).at(times) / limit).max() for k, limit in enumerate(each, start=1)]
    )


def at_breaks(motion: PiecewisePolynomial, order: int) -> tuple[Array, Array]:
    """A derivative just before and just after each inner break; shape (M - 1, n) both."""
    values = motion.derivative(order) if order else motion
    powers = np.diff(motion.breaks)[:, None] ** np.arange(values.coefficients.shape[1])
    ends: Array = np.einsum("mk,mkj->mj", powers, values.coefficients)
    return ends[:-1], values.coefficients[1:, 0]
