"""Time laws s(t) along a whole path from rest to rest: trapezoidal and seven-phase jerk-limited profiles.

Only the shape of a law is chosen here; its duration follows by uniform scaling. The shape that takes the least time
under the limits on this path is searched for: where the joints' path bends strongly, a high cruise speed leaves less
for the acceleration.
"""

import math
from collections.abc import Callable

import numpy as np

from gelenk.robot.arrays import Array, Indices
from gelenk.robot.compilation import compiled
from gelenk.trajectory.laws.s_curves import lasting, planned, profiles
from gelenk.trajectory.motion.polynomial import PiecewisePolynomial
from gelenk.trajectory.paths.path_geometry import ORDERS, LimitedPath, Slopes, of_order, ratios

_SAMPLES = 600
_LEAST_SAMPLES = 4
_SHORTEST = 1e-8
"""Least length of a ramp, as a fraction of the path: a double cannot resolve less."""
_SAME = 1e-13
_ZOOMS = 6
_ZOOM_POINTS = 31

_TABLE = 400
_INSTANTS = 12
"""Instants sampled in each phase."""
_SEARCH = 5
"""Rounds of the search for a shape."""
_FIRST_STEP = 2.0
"""First step of the search for acceleration and jerk, as a power of two."""


def trapezoid(geometry: LimitedPath) -> PiecewisePolynomial:
    """Return the trapezoidal s(t) with the acceleration and the cruise speed that take the least time.

    The unknowns are the length d of a ramp and the cruise speed v; the acceleration is v²/2d. At a distance m ≤ d from
    either end, ṡ² = v² m/d, so every limit there bounds v²/d; between the ramps, every limit bounds v². The bounds for
    all d at once are running maxima, from the ends inwards and from the middle outwards. The best d on a grid is
    refined; the duration is (L + 2d)/v.
    """
    begin, end = geometry.ends
    length = end - begin
    piece, s = geometry.samples(_SAMPLES, _LEAST_SAMPLES)
    middle = np.array([0.5 * (begin + end)])
    s, piece = np.append(s, middle), np.append(piece, geometry.piece_of(middle))
    rows = _bounds(geometry, piece, s)
    for _ in range(_ZOOMS):
        d, _, durations = _ramps(rows, length)
        i = int(np.argmin(durations))
        # Up to rounding, each distance occurs twice, once from either end.
        low = d[max(int(np.searchsorted(d, d[i] - _SAME * length)) - 1, 0)]
        high = d[min(int(np.searchsorted(d, d[i] + _SAME * length, side="right")), len(d) - 1)]
        inner = np.linspace(low, high, _ZOOM_POINTS + 2)[1:-1]
        s = np.concatenate((begin + inner, end - inner))
        rows = np.concatenate((rows, _bounds(geometry, geometry.piece_of(s), s)))
    d, speeds, durations = _ramps(rows, length)
    i = int(np.argmin(durations))
    return bang_coast_bang(geometry, float(d[i]), float(speeds[i]))


def least_trapezoidal(fastest: PiecewisePolynomial) -> float:
    """Return a lower bound on the duration of the trapezoidal s(t) on a path, from the fastest s(t) there, [s].

    No law is faster at any place than the fastest one. With ramps of length d, between two of its breaks, this bounds
    v² at the breaks of the coast, and v² m/d at those of the ramps.
    """
    states = fastest.coefficients[:, :2, 0] - [fastest.coefficients[0, 0, 0], 0.0]
    length = float(fastest.at(fastest.breaks[-1:])[0, 0] - fastest.coefficients[0, 0, 0])
    least: float = _least_trapezoidal(states, length)
    return least


@compiled
def _least_trapezoidal(states: Array, length: float) -> float:
    """Return what `least_trapezoidal` does, from the way since the start and the speed at the breaks; shape (M, 2)."""
    count, low, high = len(states) - 1, 1, len(states) - 1
    d, squares, on_coast = np.empty(count + 1), np.empty(count), np.full(count + 1, np.inf)
    for k in range(count):  # From both ends inwards.
        is_near = states[low, 0] <= length - states[high, 0]
        i = low if is_near else high
        low, high = (low + 1, high) if is_near else (low, high - 1)
        d[k], squares[k] = min(states[i, 0], length - states[i, 0]), states[i, 1] ** 2
    d[count] = 0.5 * length
    for k in range(count - 1, -1, -1):
        on_coast[k] = min(on_coast[k + 1], squares[k])
    least, on_ramp, ramp = np.inf, np.inf, 0.0
    for k in range(count + 1):
        least = min(least, (length + 2.0 * ramp) / math.sqrt(min(on_coast[k], on_ramp * d[k])))
        if k < count:
            on_ramp, ramp = min(on_ramp, squares[k] / d[k]), d[k]
    return least


def bang_coast_bang(geometry: LimitedPath, ramp: float, speed: float) -> PiecewisePolynomial:
    """Return s(t) with ramps of a given length at both ends, and a given cruise speed between them."""
    begin, end = geometry.ends
    coast = (end - begin - 2.0 * ramp) / speed
    coasts = coast > _SHORTEST * 2.0 * ramp / speed
    if not coasts:
        ramp = 0.5 * (end - begin)
    rise = 2.0 * ramp / speed
    half_acceleration = 0.5 * speed / rise
    rows = [(begin, 0.0, half_acceleration), (begin + ramp, speed, 0.0), (end - ramp, speed, -half_acceleration)]
    lasting = [rise, coast, rise]
    if not coasts:
        del rows[1], lasting[1]
    return PiecewisePolynomial(np.concatenate(([0.0], np.cumsum(lasting))), np.array(rows)[:, :, None])


def _bounds(geometry: LimitedPath, piece: Indices, s: Array) -> Array:
    """Return what a law demands at each place, as fractions of the limits; shape (N, 4).

    The columns: distance m from the nearer end; on a ramp, acceleration per s̈ and squared velocity per ṡ²/m; on the
    coast, the larger of squared velocity and acceleration per ṡ².
    """
    begin, end = geometry.ends
    distance = np.minimum(s - begin, end - s)
    slopes = geometry.at(piece, s)
    one, none = np.ones_like(s), np.zeros_like(s)
    speeding = np.where(s - begin <= end - s, 1.0, -1.0)
    ramp = ratios(slopes, np.sqrt(2.0 * np.maximum(distance, 0.0)), speeding, none)
    coast = ratios(slopes, one, none, none)
    velocity = coast[:, of_order(1)].max(axis=1) ** 2
    bend = coast[:, of_order(2)].max(axis=1)
    columns = distance, ramp[:, of_order(2)].max(axis=1), distance * velocity, np.maximum(velocity, bend)
    return np.column_stack(columns)


def _ramps(rows: Array, length: float) -> tuple[Array, Array, Array]:
    """Return lengths of ramps, the largest cruise speed with each, and the duration; shape (N,) each."""
    rows = rows[np.argsort(rows[:, 0], kind="stable")]
    d = rows[:, 0]
    on_ramp, gained = np.maximum.accumulate(rows[:, 1]), np.maximum.accumulate(rows[:, 2])
    on_coast = np.maximum.accumulate(rows[::-1, 3])[::-1]
    # Of places at the same distance, the last includes all of them in the ramp, the first all of them in the coast.
    first, last = np.searchsorted(d, d, side="left"), np.searchsorted(d, d, side="right") - 1
    with np.errstate(divide="ignore", invalid="ignore"):
        squares = np.fmin(np.fmin(2.0 * d / on_ramp[last], d / gained[last]), 1.0 / on_coast[first])
        durations = np.where(d > _SHORTEST * length, (length + 2.0 * d) / np.sqrt(squares), np.inf)
    return d, np.sqrt(squares), durations


def s_curve(geometry: LimitedPath) -> PiecewisePolynomial:
    """Return the seven-phase s(t) with the speed, acceleration and jerk along s that take the least time found.

    The search starts from the largest values that the limits allow for each alone, which are best if the path is
    straight in joint space.
    """
    begin, end = geometry.ends
    length = end - begin
    piece, s = geometry.samples(_TABLE, _LEAST_SAMPLES)
    slopes = geometry.at(piece, s)
    middles = 0.5 * (s[:-1] + s[1:])
    most = _alone(slopes)

    def durations(exponents: Array) -> Array:
        caps = most / length * 2.0 ** np.column_stack((np.zeros(len(exponents)), exponents))
        places, *rates = profiles(caps, _INSTANTS)
        rows = np.searchsorted(middles, begin + length * places.ravel())
        v, a, j = (length * rate.ravel() for rate in rates)
        found = ratios(slopes.take(rows), v, a, j).reshape(*places.shape, -1).max(axis=1)
        slowed: Array = (found ** (1.0 / ORDERS)).max(axis=1) * lasting(caps)
        return slowed

    law = planned(most / length * 2.0 ** np.array([0.0, *_searched(durations)]))
    c = law.coefficients * length
    c[:, 0] += begin
    return PiecewisePolynomial(law.breaks, c)


def _searched(durations: Callable[[Array], Array]) -> Array:
    """Find the exponents of acceleration and jerk with the least duration on successively finer grids; shape (2,)."""
    best, step = np.zeros(2), _FIRST_STEP
    offsets = np.array([(x, y) for x in range(-2, 3) for y in range(-2, 3)], dtype=np.float64)
    offsets = offsets[np.argsort(np.abs(offsets).sum(axis=1), kind="stable")]  # Ties: the nearest.
    for _ in range(_SEARCH):
        grid = best + step * offsets
        best = grid[int(np.argmin(durations(grid)))]
        step *= 0.5
    return best


def _alone(slopes: Slopes) -> Array:
    """Return the largest ṡ, s̈ and s⃛ that the limits of each order allow if the other two are zero; shape (3,)."""
    count = len(slopes.first)
    largest = np.empty(3)
    for k in range(3):
        rates = np.zeros((3, count))
        rates[k] = 1.0
        largest[k] = 1.0 / ratios(slopes, *rates)[:, of_order(k + 1)].max()
    return largest
