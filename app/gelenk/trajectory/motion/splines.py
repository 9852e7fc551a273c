"""C² cubic splines through knots, from the tridiagonal system A(h) v = b for the velocities at the knots.

Row k states that the acceleration is continuous at knot k + 1. The boundary condition determines both ends: clamped
(given velocities), natural (zero acceleration), not-a-knot (continuous jerk at the second and the second to last knot),
periodic, or assigned (given velocities and accelerations, which requires two fictitious knots).
"""

from dataclasses import dataclass
from typing import Literal, TypeAlias

import numpy as np

from gelenk.errors import InvalidField
from gelenk.robot.arrays import Array
from gelenk.trajectory.motion.polynomial import PiecewisePolynomial
from gelenk.trajectory.motion.time_laws import END_CONDITIONS, hermite_pieces
from gelenk.trajectory.motion.tridiagonal import Tridiagonal, solution

Boundary: TypeAlias = Literal["clamped", "natural", "not_a_knot", "periodic", "assigned"]

CLOSED = 1e-9
"""Largest gap between the ends of a periodic spline, as a fraction of its largest coordinate, or of 1 if larger."""


@dataclass(frozen=True, slots=True)
class EndRates:
    """Velocities [rad/s or m/s] and accelerations [rad/s² or m/s²] at both ends; shape (n,) each."""

    start_velocity: Array
    end_velocity: Array
    start_acceleration: Array
    end_acceleration: Array

    @classmethod
    def at_rest(cls, joints: int) -> "EndRates":
        """Return zero velocities and accelerations."""
        return cls(*(np.zeros(joints) for _ in range(4)))


@dataclass(frozen=True, slots=True)
class Spline:
    """A spline and the linear system that determines it.

    Attributes:
        times: Times of the knots, including fictitious ones; shape (N,), [s].
        knots, velocities: Positions and velocities v there; shape (N, n), [rad or m], [rad/s or m/s].
        matrix: A, for the unknown velocities; None if there is nothing to solve.
        right_side: b; shape (unknowns, n).
        unknowns: Indices of the knots whose velocities A determines, from 0; shape (unknowns,).
        fictitious: Indices of the fictitious knots, from 0.
    """

    motion: PiecewisePolynomial
    times: Array
    knots: Array
    velocities: Array
    matrix: Tridiagonal | None
    right_side: Array
    unknowns: range
    fictitious: tuple[int, ...] = ()


def cubic_spline(
    times: Array,
    knots: Array,
    boundary: Boundary,
    ends: EndRates | None = None,
    fictitious_times: tuple[float, float] | None = None,
) -> Spline:
    """Return the cubic spline through knots.

    Args:
        times: Increasing times; shape (N,), N ≥ 2, [s].
        knots: Positions; shape (N, n), [rad or m].
        ends: Velocities of a clamped boundary; velocities and accelerations of an assigned one; zero by default.
        fictitious_times: Times of the two fictitious knots of an assigned boundary, in the first and the last segment,
            [s]; by default the midpoints of these segments, or the thirds of a single one.

    Raises:
        InvalidField: The times do not increase, the ends of a periodic spline differ, or a fictitious knot lies outside
            its segment.
    """
    checked_times(times, "times")
    ends = ends or EndRates.at_rest(knots.shape[1])
    if boundary == "periodic":
        return _periodic(times, knots)
    if boundary == "assigned":
        return _assigned(times, knots, ends, fictitious_times)
    if boundary == "clamped":
        return _clamped(times, knots, ends)
    if boundary == "not_a_knot" and len(times) <= 3:
        return _parabola(times, knots)
    h, slopes = np.diff(times), np.diff(knots, axis=0) / np.diff(times)[:, None]
    A, b = _inner_rows(h, slopes)
    first, last = _natural_rows(slopes) if boundary == "natural" else _smooth_rows(h, slopes)
    lower, diagonal, upper = np.append(A.lower, last[0]), A.diagonal, np.insert(A.upper, 0, first[1])
    A = Tridiagonal(np.insert(lower, 0, 0.0), np.concatenate([[first[0]], diagonal, [last[1]]]), np.append(upper, 0.0))
    b = np.concatenate([first[2][None], b, last[2][None]])
    return _spline(times, knots, solution(A, b), A, b, range(len(times)))


def _inner_rows(h: Array, slopes: Array) -> tuple[Tridiagonal, Array]:
    """Return the N - 2 rows of A(h) v = b at the inner knots, with the velocities at both ends still on the left.

    h_{k+1} v_k + 2 (h_k + h_{k+1}) v_{k+1} + h_k v_{k+2} = 3 (h_k s_{k+1} + h_{k+1} s_k), with the slopes s = Δq/h: the
    course's right side with the fraction 3/(h_k h_{k+1}) multiplied out.
    """
    A = Tridiagonal(h[1:], 2.0 * (h[:-1] + h[1:]), h[:-1])
    return A, 3.0 * (h[:-1, None] * slopes[1:] + h[1:, None] * slopes[:-1])


def _clamped(times: Array, knots: Array, ends: EndRates) -> Spline:
    """Solve with both end velocities known, which moves them to the right side."""
    from gelenk.trajectory.motion.evaluation import clamped  # noqa: PLC0415 - a client has no compiler

    t, q, first, last = map(_numbers, (times, knots, ends.start_velocity, ends.end_velocity))
    *diagonals, b, velocities, pieces = clamped(t, q, first, last, END_CONDITIONS[2])
    A = Tridiagonal(*diagonals) if len(b) else None
    return Spline(PiecewisePolynomial(times, pieces), times, knots, velocities, A, b, range(1, len(b) + 1))


def _numbers(array: Array) -> Array:
    return np.ascontiguousarray(array, dtype=float)


def _without_corners(A: Tridiagonal) -> Tridiagonal:
    lower, upper = A.lower.copy(), A.upper.copy()
    lower[0] = upper[-1] = 0.0
    return Tridiagonal(lower, A.diagonal, upper)


_EndRow: TypeAlias = tuple[float, float, Array]


def _natural_rows(slopes: Array) -> tuple[_EndRow, _EndRow]:
    """Return the end rows for zero acceleration: 2 v_1 + v_2 = 3 s_1, and the mirrored one at the end."""
    return (2.0, 1.0, 3.0 * slopes[0]), (1.0, 2.0, 3.0 * slopes[-1])


def _smooth_rows(h: Array, slopes: Array) -> tuple[_EndRow, _EndRow]:
    """Return the end rows for one cubic on both sides of knot 2, v_3 eliminated by its row; likewise at the end."""
    rows = []
    for h1, h2, s1, s2 in ((h[0], h[1], slopes[0], slopes[1]), (h[-1], h[-2], slopes[-1], slopes[-2])):
        both = h1 + h2
        rows.append((h2, both, (h2 * (h1 + 2.0 * both) * s1 + h1**2 * s2) / both))
    (near, far, b), (last_near, last_far, last_b) = rows
    return (near, far, b), (last_far, last_near, last_b)


def _parabola(times: Array, knots: Array) -> Spline:
    """Solve not-a-knot for two or three knots, where the result is a line or a parabola."""
    slopes = np.diff(knots, axis=0) / np.diff(times)[:, None]
    if len(times) == 2:
        return _spline(times, knots, np.repeat(slopes, 2, axis=0), None, slopes[:0], range(0))
    h1, h2 = np.diff(times)
    middle = (h2 * slopes[0] + h1 * slopes[1]) / (h1 + h2)
    velocities = np.array([2.0 * slopes[0] - middle, middle, 2.0 * slopes[1] - middle])
    return _spline(times, knots, velocities, None, slopes[:0], range(0))


def _periodic(times: Array, knots: Array) -> Spline:
    """Solve with continuous velocity and acceleration from the end to the start: A gains a row and two corners."""
    scale = max(1.0, float(np.abs(knots).max()))
    if float(np.abs(knots[-1] - knots[0]).max()) > CLOSED * scale:
        raise InvalidField("waypoints", "a periodic spline ends where it starts: the last one must equal the first")
    h, slopes = np.diff(times), np.diff(knots, axis=0) / np.diff(times)[:, None]
    A, b = _inner_rows(np.insert(h, 0, h[-1]), np.concatenate([slopes[-1:], slopes]))
    around = solution(A, b)
    return _spline(times, knots, np.concatenate([around, around[:1]]), A, b, range(len(times) - 1))


def _assigned(times: Array, knots: Array, ends: EndRates, fictitious: tuple[float, float] | None) -> Spline:
    """Solve with velocities and accelerations given at both ends, using two fictitious knots with free positions.

    The position of such a knot follows from its velocity, q_f = q_1 + h (2 v_1 + v_f)/3 + h² a_1/6, which is inserted
    into the rows: A stays tridiagonal and depends only on the times.
    """
    first, last = _fictitious_times(times, fictitious)
    t = np.concatenate([times[:1], [first], times[1:-1], [last], times[-1:]])
    h = np.diff(t)
    h1, h2, g1, g2 = h[0], h[1], h[-1], h[-2]
    # Offsets of the fictitious knots from the adjacent ends if v_f = 0; the contribution of v_f is in A.
    near = h1 * (2.0 * ends.start_velocity / 3.0 + h1 * ends.start_acceleration / 6.0)
    far = -g1 * (2.0 * ends.end_velocity / 3.0 - g1 * ends.end_acceleration / 6.0)
    A, b = _inner_rows(h, _assigned_steps(knots, near, far) / h[:, None])
    b[0] -= A.lower[0] * ends.start_velocity
    b[-1] -= A.upper[-1] * ends.end_velocity
    A = _without_corners(A)
    # In 3 (h_k s_{k+1} + h_{k+1} s_k), v_f changes Δq by ± h v_f / 3; these terms move to the left.
    A.diagonal[0] -= (h2**2 - h1**2) / h2
    A.diagonal[-1] -= (g2**2 - g1**2) / g2
    A.lower[1] += h[2] * h1 / h2
    A.upper[-2] += h[-3] * g1 / g2
    velocities = np.concatenate([ends.start_velocity[None], solution(A, b), ends.end_velocity[None]])
    near, far = near + h1 * velocities[1] / 3.0, far - g1 * velocities[-2] / 3.0
    q = np.concatenate([knots[:1], [knots[0] + near], knots[1:-1], [knots[-1] + far], knots[-1:]])
    steps = _assigned_steps(knots, near, far)
    return Spline(_pieces(t, q, steps, velocities), t, q, velocities, A, b, range(1, len(t) - 1), (1, len(t) - 2))


def _assigned_steps(knots: Array, near: Array, far: Array) -> Array:
    """Return Δq of each segment from the offsets of the fictitious knots to the ends, which loses no digits."""
    steps = np.diff(knots, axis=0)
    steps[0] -= near
    steps[-1] += far
    return np.concatenate([near[None], steps, -far[None]])


def _fictitious_times(times: Array, given: tuple[float, float] | None) -> tuple[float, float]:
    if given is None:
        if len(times) == 2:
            third = (times[1] - times[0]) / 3.0
            return float(times[0] + third), float(times[1] - third)
        return float(0.5 * (times[0] + times[1])), float(0.5 * (times[-2] + times[-1]))
    first, last = given
    whole = np.concatenate([times[:1], [first], times[1:-1], [last], times[-1:]])
    if not (times[0] < first < times[1] and times[-2] < last < times[-1] and first < last):
        raise InvalidField("fictitious_times", "the first is within the first segment, the second within the last one")
    checked_times(whole, "fictitious_times")
    return first, last


def _spline(
    times: Array, knots: Array, velocities: Array, matrix: Tridiagonal | None, right_side: Array, unknowns: range
) -> Spline:
    motion = _pieces(times, knots, np.diff(knots, axis=0), velocities)
    return Spline(motion, times, knots, velocities, matrix, right_side, unknowns)


def _pieces(times: Array, knots: Array, steps: Array, velocities: Array) -> PiecewisePolynomial:
    starts, ends = np.array([np.zeros_like(steps), velocities[:-1]]), np.array([steps, velocities[1:]])
    rows = hermite_pieces(starts, ends, np.diff(times))
    rows[:, 0] = knots[:-1]
    return PiecewisePolynomial(times, rows)


def through_samples(
    times: Array, positions: Array, velocities: Array, accelerations: Array | None = None
) -> PiecewisePolynomial:
    """Return a motion through samples and their derivatives: C¹ with cubic pieces, or C² with quintic ones.

    Args:
        times: Increasing, else `InvalidField`; shape (N,), N ≥ 2, [s].
        positions, velocities: Shape (N, n), [rad or m], [rad/s or m/s].
        accelerations: If given, the pieces are quintic; shape (N, n), [rad/s² or m/s²].
    """
    checked_times(times, "times")
    known = [positions, velocities] if accelerations is None else [positions, velocities, accelerations]
    both = np.array(known)
    return PiecewisePolynomial(times, hermite_pieces(both[:, :-1], both[:, 1:], np.diff(times)))


NEAREST = 1e-6
"""Least time between two knots, as a fraction of the time from the first to the last."""
RESOLVED = 1e-9
"""The same as a fraction of the largest absolute time, because a double resolves less far from zero."""


def checked_times(times: Array, field: str) -> None:
    """Check that times increase by more than rounding; if not, `InvalidField` names the first two that are wrong."""
    from gelenk.trajectory.motion.evaluation import are_apart  # noqa: PLC0415 - a client has no compiler

    if are_apart(_numbers(times), NEAREST, RESOLVED):
        return
    gaps = np.diff(times)
    least = max(NEAREST * float(np.ptp(times)), RESOLVED * float(np.abs(times).max()))
    k = int(np.flatnonzero(~(gaps > least))[0])
    if gaps[k] == 0.0:
        reason = f"{times[k]:.10g} s is there twice (entries {k} and {k + 1}): two knots at one time"
    elif gaps[k] < 0.0:
        reason = f"{times[k + 1]:.10g} s comes after {times[k]:.10g} s (entry {k + 1}): times have to increase"
    else:
        reason = f"entries {k} and {k + 1} are {gaps[k]:.3g} s apart, of a least distance of {least:.3g} s"
    raise InvalidField(field, reason)
