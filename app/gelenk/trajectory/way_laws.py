"""Time laws s(t) along a whole path from rest to rest: polynomials, bang-coast-bang and the seven phases of least jerk.

What has to be known of a law is its shape; how long it takes follows by uniform scaling. A polynomial has one shape. Of
the others that one is looked for which takes the least time under the limits along this way: where joints bend much, a
high cruise speed leaves less for the acceleration.
"""

from collections.abc import Callable
from typing import Final

import numpy as np

from gelenk.model.arrays import Array, Indices
from gelenk.trajectory.polynomial import PiecewisePolynomial
from gelenk.trajectory.problem import MotionLimits
from gelenk.trajectory.s_curves import lasting, planned, profiles
from gelenk.trajectory.time_laws import between
from gelenk.trajectory.way_geometry import ORDERS, Geometry, Slopes, of_order, ratios

POLYNOMIALS: Final = {"cubic": 2, "quintic": 3, "septic": 4}
"""How many derivatives each has given at either end, the position counted as one."""

_SAMPLES = 600
_LEAST_SAMPLES = 4
_SHORTEST = 1e-8
"""Least length of a ramp, in fractions of the way: a double has no digits for less."""
_SAME = 1e-13
_ZOOMS = 6
_ZOOM_POINTS = 31

_TABLE = 400
_INSTANTS = 12
"""In each phase."""
_SEARCH = 5
"""Rounds of the search for a shape."""
_FIRST_STEP = 2.0
"""Of acceleration and jerk, as a power of two."""


def polynomial(name: str, geometry: Geometry) -> PiecewisePolynomial:
    """The cubic, quintic or septic from rest to rest, lasting 1 s."""
    count = POLYNOMIALS[name]
    rows = np.zeros((2, count, 1))
    rows[0, 0], rows[1, 0] = geometry.ends
    return between(rows[0], rows[1], 1.0)


def trapezoid(geometry: Geometry) -> PiecewisePolynomial:
    """Bang-coast-bang with the acceleration and the cruise speed that take the least time.

    A ramp of length d and a cruise speed v are to be chosen; the acceleration is v²/2d. At a distance m ≤ d from
    either end ṡ² = v² m/d, so that every limit there is a bound of v²/d, and between the ramps one of v². All bounds
    for all d at once are largest values so far, from the ends inwards and from the middle outwards. The best d on a
    grid is refined; the duration is (L + 2d)/v.
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
        # Each distance is there twice, from both ends, but for rounding.
        low = d[max(int(np.searchsorted(d, d[i] - _SAME * length)) - 1, 0)]
        high = d[min(int(np.searchsorted(d, d[i] + _SAME * length, side="right")), len(d) - 1)]
        inner = np.linspace(low, high, _ZOOM_POINTS + 2)[1:-1]
        s = np.concatenate((begin + inner, end - inner))
        rows = np.concatenate((rows, _bounds(geometry, geometry.piece_of(s), s)))
    d, speeds, durations = _ramps(rows, length)
    i = int(np.argmin(durations))
    return bang_coast_bang(geometry, float(d[i]), float(speeds[i]))


def bang_coast_bang(geometry: Geometry, ramp: float, speed: float) -> PiecewisePolynomial:
    """s(t) with ramps of a given length at both ends, and a cruise speed between them."""
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


def _bounds(geometry: Geometry, piece: Indices, s: Array) -> Array:
    """What a law demands at each place, in fractions of the limits.

    Returns:
        Its distance m from the nearer end, an acceleration per s̈ on a ramp, a velocity squared per ṡ²/m, and the larger
        one of a velocity squared and an acceleration per ṡ² on the coast; shape (N, 4).
    """
    begin, end = geometry.ends
    distance = np.minimum(s - begin, end - s)
    slopes = geometry.at(piece, s)
    one, none = np.ones_like(s), np.zeros_like(s)
    speeding = np.where(s - begin <= end - s, 1.0, -1.0)
    ramp = ratios(slopes, geometry.limits, np.sqrt(2.0 * np.maximum(distance, 0.0)), speeding, none)
    coast = ratios(slopes, geometry.limits, one, none, none)
    velocity = coast[:, of_order(1)].max(axis=1) ** 2
    bend = coast[:, of_order(2)].max(axis=1)
    columns = distance, ramp[:, of_order(2)].max(axis=1), distance * velocity, np.maximum(velocity, bend)
    return np.column_stack(columns)


def _ramps(rows: Array, length: float) -> tuple[Array, Array, Array]:
    """Lengths of ramps, the largest cruise speed with each, and how long the path then takes; shape (N,) each."""
    rows = rows[np.argsort(rows[:, 0], kind="stable")]
    d = rows[:, 0]
    on_ramp, gained = np.maximum.accumulate(rows[:, 1]), np.maximum.accumulate(rows[:, 2])
    on_coast = np.maximum.accumulate(rows[::-1, 3])[::-1]
    # Of places that are equally far the last one has seen all of them on the ramp, the first one on the coast.
    first, last = np.searchsorted(d, d, side="left"), np.searchsorted(d, d, side="right") - 1
    with np.errstate(divide="ignore", invalid="ignore"):
        squares = np.fmin(np.fmin(2.0 * d / on_ramp[last], d / gained[last]), 1.0 / on_coast[first])
        durations = np.where(d > _SHORTEST * length, (length + 2.0 * d) / np.sqrt(squares), np.inf)
    return d, np.sqrt(squares), durations


def s_curve(geometry: Geometry) -> PiecewisePolynomial:
    """The seven phases of least jerk, with the speed, acceleration and jerk along s that take the least time found.

    Searched from the largest that the limits allow each by itself: these are the best where the path is straight in
    joint space.
    """
    begin, end = geometry.ends
    length = end - begin
    piece, s = geometry.samples(_TABLE, _LEAST_SAMPLES)
    slopes = geometry.at(piece, s)
    middles = 0.5 * (s[:-1] + s[1:])
    most = _alone(slopes, geometry.limits)

    def durations(exponents: Array) -> Array:
        caps = most / length * 2.0 ** np.column_stack((np.zeros(len(exponents)), exponents))
        places, *rates = profiles(caps, _INSTANTS)
        rows = np.searchsorted(middles, begin + length * places.ravel())
        v, a, j = (length * rate.ravel() for rate in rates)
        found = ratios(slopes.take(rows), geometry.limits, v, a, j).reshape(*places.shape, -1).max(axis=1)
        slowed: Array = (found ** (1.0 / ORDERS)).max(axis=1) * lasting(caps)
        return slowed

    law = planned(most / length * 2.0 ** np.array([0.0, *_searched(durations)]))
    c = law.coefficients * length
    c[:, 0] += begin
    return PiecewisePolynomial(law.breaks, c)


def _searched(durations: Callable[[Array], Array]) -> Array:
    """The exponents of acceleration and jerk of the least duration, on grids ever finer; shape (2,)."""
    best, step = np.zeros(2), _FIRST_STEP
    offsets = np.array([(x, y) for x in range(-2, 3) for y in range(-2, 3)], dtype=np.float64)
    offsets = offsets[np.argsort(np.abs(offsets).sum(axis=1), kind="stable")]  # What does not matter stays.
    for _ in range(_SEARCH):
        grid = best + step * offsets
        best = grid[int(np.argmin(durations(grid)))]
        step *= 0.5
    return best


def _alone(slopes: Slopes, limits: MotionLimits) -> Array:
    """The largest ṡ, s̈ and s⃛ that the limits of each order allow where there is nothing else; shape (3,)."""
    count = len(slopes.first)
    largest = np.empty(3)
    for k in range(3):
        rates = np.zeros((3, count))
        rates[k] = 1.0
        largest[k] = 1.0 / ratios(slopes, limits, *rates)[:, of_order(k + 1)].max()
    return largest
