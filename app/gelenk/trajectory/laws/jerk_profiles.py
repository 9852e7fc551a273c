"""Jerk-limited profiles of one joint between any two states: its least time, and its reach in a given time.

With everything else given, the motions of duration T form a convex set, and the distances that they cover an interval.
Its upper end belongs to the profile that goes up as far as it can: jerk +, 0 (at the largest acceleration), -, 0 (at
the largest velocity), -, 0, + [Berscheid2021]. The mirror image gives the lower end. Hence

- T is possible if the distance is between the two; between them a mixture of both profiles covers it exactly;
- the least T, and each end of a gap in the possible ones, is a T at which one of the two ends is the distance.

Units here make the jerk 1. Extended back and on to acceleration 0 by jerk +1, a profile goes from velocity w_0 to w_1
by way of a peak v_p. Up to it the acceleration rises to x and stays there for h, with v_p = w_0 + x (x + h); after it,
it falls to -y and stays there for k, with v_p = w_1 + y (y + k).
"""

import math

import numpy as np

from gelenk.robot.arrays import Array
from gelenk.robot.compilation import compiled

JERKS = np.array([1.0, 0.0, -1.0, 0.0, -1.0, 0.0, 1.0])
"""Jerk of each phase of a profile that goes up as far as it can."""
_ROUNDING = 1e-9
"""Error of distances and times, in the units in which the largest number of the states is 1."""
_FLAT = 1e-13
"""Value of a polynomial that counts as zero where its slope is, in fractions of its largest term."""
_CANCELLED = 1e-12
"""Share of two numbers below which their difference is rounding."""
_STEPS = 200


@compiled
def least_times(start: Array, end: Array, limits: Array) -> tuple[Array, Array]:
    """Return the least time of each joint, and all times at which its possible ones may begin or end.

    Args:
        start, end: Position, velocity and acceleration, which the limits allow; shape (3, n), [rad or m per sᵏ].
        limits: Of velocity, acceleration and jerk; shape (3, n).

    Returns:
        Shape (n,), ∞ where no time was found, and (n, 24), ∞ behind the last one; [s].
    """
    n = start.shape[1]
    least, times = np.empty(n), np.full((n, 24), np.inf)
    for j in range(n):
        unit, task = _in_units(start[:, j], end[:, j], limits[:, j])
        if unit > 0.0:
            count = _boundaries(task, times[j], 0)
            task[:5] *= -1.0
            _boundaries(task, times[j], count)
            times[j] *= unit
        else:
            times[j, 0] = 0.0
        least[j] = times[j].min()
    return least, times


@compiled
def profiles(start: Array, end: Array, limits: Array, duration: float) -> tuple[Array, Array, bool]:
    """Return how each joint goes as far up and down as it can in a given time, [s], and how to mix the two.

    Returns:
        Durations of the phases of both, shape (2, n, 7), [s]; the share of the first, shape (n,); and whether all
        joints can take this time.
    """
    n = start.shape[1]
    phases, shares = np.zeros((2, n, 7)), np.ones(n)
    for j in range(n):
        unit, task = _in_units(start[:, j], end[:, j], limits[:, j])
        if unit == 0.0:
            phases[:, j, 3] = duration
            shares[j] = 0.5
            continue
        up = _furthest(task, duration / unit, phases[0, j])
        distance = task[0]
        task[:5] *= -1.0
        down = -_furthest(task, duration / unit, phases[1, j])
        phases[:, j] *= unit
        allowed = _ROUNDING * (1.0 + abs(up) + abs(down))
        if not (down - allowed <= distance <= up + allowed):
            return phases, shares, False
        if up > down:
            shares[j] = min(max((distance - down) / (up - down), 0.0), 1.0)
    return phases, shares, True


@compiled
def _in_units(start: Array, end: Array, limits: Array) -> tuple[float, Array]:
    """Return a unit of time that makes the jerk limit 1 and the largest number of the states too, and the task in it.

    The task is d, v_0, a_0, v_1, a_1, and the limits of velocity and acceleration; the unit 0 if nothing moves.
    """
    jerk = limits[2]
    fastest, hardest = max(abs(start[1]), abs(end[1])), max(abs(start[2]), abs(end[2]))
    unit = max(np.cbrt(abs(end[0] - start[0]) / jerk), math.sqrt(fastest / jerk), hardest / jerk)
    task = np.array([end[0] - start[0], start[1], start[2], end[1], end[2], limits[0], limits[1]]) / jerk
    if unit > 0.0:
        task /= unit ** np.array([3.0, 2.0, 1.0, 2.0, 1.0, 2.0, 1.0])
    return unit, task


@compiled
def _ramp(rise: float, most: float) -> tuple[float, float]:
    """Return x and h of the shortest change of velocity by `rise` between two states of acceleration 0."""
    x = math.sqrt(max(rise, 0.0))
    return (x, 0.0) if x <= most else (most, rise / most - most)


@compiled
def _root_of_difference(a: float, b: float) -> float:
    """Return √(a - b); 0 where rounding alone makes it negative, as of a state on the way to rest, else NaN."""
    return 0.0 if 0.0 > a - b > -_CANCELLED * (abs(a) + abs(b)) else math.sqrt(a - b)


@compiled
def _in_time(total: float, rise: float, most: float) -> tuple[float, float, float, float]:
    """Return x, h, y, k of the profile from w_0 to w_1 = w_0 + rise without a coast; y is NaN if there is none."""
    half = 0.5 * total
    x = 0.5 * (half + (rise / half if rise != 0.0 else 0.0))
    y = half - x
    if x <= most and y <= most:
        return x, 0.0, y, 0.0
    if x > y:
        y = _root_of_difference(most * total, rise) - most
        if not y > most:
            return most, (rise + y * y) / most - most, y, 0.0
    else:
        x = _root_of_difference(most * total, -rise) - most
        if not x > most:
            return x, 0.0, most, (x * x - rise) / most - most
    rest = 0.5 * total - 2.0 * most
    return most, rest + 0.5 * rise / most, most, rest - 0.5 * rise / most


@compiled
def _furthest(task: Array, duration: float, phases: Array) -> float:
    """Return the largest distance in a given time, and write the phases of its profile; NaN if none takes this time."""
    _, v0, a0, v1, a1, v_max, a_max = task
    w0, w1 = v0 - 0.5 * a0 * a0, v1 - 0.5 * a1 * a1
    total = duration + a0 - a1
    (x, h), (y, k) = _ramp(v_max - w0, a_max), _ramp(v_max - w1, a_max)
    coast = total - (2.0 * x + h + 2.0 * y + k)
    if coast < 0.0:
        x, h, y, k = _in_time(total, w1 - w0, a_max)
        coast = 0.0
    before, after = (x, y) if coast > 0.0 or (x >= 0.0 and y >= 0.0) else (x + y, 0.0)
    least = -_ROUNDING
    if not (x - a0 >= least and h >= least and x + y >= least and k >= least and y + a1 >= least):
        return np.nan
    phases[:] = x - a0, h, before, coast, after, k, y + a1
    np.maximum(phases, 0.0, phases)
    peak = w0 + x * (x + h)
    covered = (w0 + peak) * (x + 0.5 * h) + (w1 + peak) * (y + 0.5 * k) + peak * coast
    distance: float = covered - a0 * (v0 - a0 * a0 / 3.0) + a1 * (v1 - a1 * a1 / 3.0)
    return distance


@compiled
def _boundaries(task: Array, times: Array, count: int) -> int:
    """Write the times in which a profile that goes up as far as it can covers the distance; return their count."""
    d, v0, a0, v1, a1, v_max, a_max = task
    virtual = d + a0 * (v0 - a0 * a0 / 3.0) - a1 * (v1 - a1 * a1 / 3.0)
    phases = np.empty(7)
    for total in _totals(virtual, v0 - 0.5 * a0 * a0, v1 - 0.5 * a1 * a1, v_max, a_max):
        duration = total - a0 + a1
        if duration >= -_ROUNDING:
            duration = max(duration, 0.0)
            reached = _furthest(task, duration, phases)
            if abs(reached - d) <= _ROUNDING * (1.0 + abs(reached)):
                times[count] = duration
                count += 1
    return count


@compiled
def _totals(d: float, w0: float, w1: float, v_max: float, a_max: float) -> Array:
    """Return the times from w_0 to w_1 over a distance, of profiles of every form, whether or not they exist."""
    totals, both, c, A = np.empty(16), w0 + w1, w1 - w0, a_max
    # With a coast.
    (x, h), (y, k) = _ramp(v_max - w0, A), _ramp(v_max - w1, A)
    covered = (w0 + v_max) * (x + 0.5 * h) + (w1 + v_max) * (y + 0.5 * k)
    totals[0] = 2.0 * x + h + 2.0 * y + k + (d - covered) / v_max
    # With x and y at the limit of acceleration, by v_p.
    square = max(0.25 * A**4 + A * d - 0.5 * (A * A * both - w0 * w0 - w1 * w1), 0.0)
    for i, root in enumerate((math.sqrt(square), -math.sqrt(square))):
        totals[1 + i] = 2.0 * A + (2.0 * root - A * A - both) / A
    count = 3
    # With x at the limit, by y; with y at the limit, by x.
    for last, rise in ((w1, c), (w0, -c)):
        quartic = np.array([both * (A * A + rise) - 2.0 * A * d, 4.0 * A * last, A * A + 2.0 * last, 2.0 * A, 1.0])
        for y in _roots(quartic, -A, A):
            totals[count] = A + (rise + y * y) / A + 2.0 * y
            count += 1
    # With neither, by s = x + y.
    for s in _roots(np.array([-c * c, -4.0 * d, 4.0 * both, 0.0, 1.0]), 0.0, 2.0 * A):
        totals[count] = 2.0 * s
        count += 1
    return totals[:count]


@compiled
def _roots(c: Array, low: float, high: float) -> Array:
    """Return the real roots of a polynomial, lowest power first, between two places; those of its derivatives first.

    Between two roots of its derivative a polynomial is monotonic.
    """
    degree = len(c) - 1
    places, count = np.empty(degree + 2), 2
    places[0], places[1] = low, high
    found = np.empty(degree + 2)
    for order in range(degree - 1, -1, -1):
        d = c[order:].copy()
        for k in range(len(d)):
            for i in range(order):
                d[k] *= k + order - i
        number = 0
        for i in range(count - 1):
            root = _root_between(d, places[i], places[i + 1])
            if not math.isnan(root) and (number == 0 or root > found[number - 1]):
                found[number] = root
                number += 1
        if order > 0:
            places[1 : number + 1] = found[:number]
            places[number + 1] = high
            count = number + 2
    return found[:number]


@compiled
def _root_between(c: Array, low: float, high: float) -> float:
    """Return the root of a polynomial that is monotonic between two places, NaN if there is none: Newton, bisected."""
    at_low, slope, size = _value(c, low)
    if abs(at_low) <= _FLAT * size:
        return low
    at_high, slope, size = _value(c, high)
    if abs(at_high) <= _FLAT * size:
        return high
    if (at_low > 0.0) == (at_high > 0.0):
        return np.nan
    at = 0.5 * (low + high)
    for _ in range(_STEPS):
        value, slope, size = _value(c, at)
        if (value > 0.0) == (at_low > 0.0):
            low = at
        else:
            high = at
        next_one = at - value / slope if slope != 0.0 else low
        if not low < next_one < high:
            next_one = 0.5 * (low + high)
        if abs(next_one - at) <= 2e-16 * abs(at) or high - low <= 4e-16 * abs(high):
            return next_one
        at = next_one
    return at


@compiled
def _value(c: Array, x: float) -> tuple[float, float, float]:
    """Return a polynomial's value and slope, and the sum of the magnitudes of its terms."""
    value, slope, size = 0.0, 0.0, 0.0
    for k in range(len(c) - 1, -1, -1):
        slope = slope * x + value
        value = value * x + c[k]
        size = size * abs(x) + abs(c[k])
    return value, slope, size
