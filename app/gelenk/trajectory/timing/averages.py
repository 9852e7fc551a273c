"""Smooth laws along a path that bends: the time-optimal law, averaged over time.

The moving average of a trapezoidal velocity over w seconds is the seven-phase jerk-limited one [Biagiotti2008]; that of
the time-optimal law still slows down where the path bends, and only there. One average makes the acceleration
continuous, a second the jerk. Where an average exceeds a limit, the time-optimal law is slowed down around that place,
and averaged again.
"""

from math import factorial

import numpy as np
from numpy.lib.stride_tricks import sliding_window_view

from gelenk.robot.arrays import Array
from gelenk.trajectory.motion.polynomial import PiecewisePolynomial, derivatives
from gelenk.trajectory.paths.path_geometry import ORDERS, LimitedPath, ratios
from gelenk.trajectory.timing.time_optimal import Slower
from gelenk.trajectory.timing.torque_constraints import optimal_within

_PARTS, _PER_WINDOW, _MOST_PARTS = 128, 8, 1024
"""Into how many equal parts the time-optimal law is divided: in all, in a window, and in all at most."""
_PLACES = 200
_PROBES = np.array([0.0, 0.5, 1.0])
_TRIALS, _ROUNDS = 5, 8
"""Rounds of slowing down for each width of the window, and further ones for the best."""
_ENOUGH = 1.002
"""Excess over a limit that is left to a uniform scaling."""


def averaged(geometry: LimitedPath, times: int) -> PiecewisePolynomial:
    """Return s(t) that is continuous up to the derivative of order 1 + `times`, before its final uniform scaling.

    A window as long as a joint's limits take to reach the full acceleration is tried first, then ever shorter ones.
    """
    bounds = geometry.joint_bounds(np.arange(len(geometry.joints.coefficients)))
    width = float((bounds[:, 1] / bounds[:, 2]).max())
    fastest = _fastest(geometry)
    best = _Average(geometry, times, fastest, width).improved(_TRIALS)
    while not best.is_narrowest:
        narrower = _Average(geometry, times, fastest, 0.5 * best.width).improved(_TRIALS)
        if narrower.duration >= best.duration:
            break
        best = narrower
    return best.improved(_ROUNDS).law


class _Average:
    """The search for a law with one width of the window, [s].

    Attributes:
        fastest: The time-optimal law, slowed down so far.
        law: The best average found.
        duration: Its duration within all limits, [s].
        places, slowness: Factor of time, at least 1, at places of the path from 0 to 1; shape (N,) each.
    """

    def __init__(self, geometry: LimitedPath, times: int, fastest: PiecewisePolynomial, width: float) -> None:
        self.geometry, self.times = geometry, times
        share = min(width / fastest.duration, 1.0)
        self.parts = int(np.clip(np.ceil(_PER_WINDOW / share), _PARTS, _MOST_PARTS))
        self.steps = max(1, round(share * self.parts))
        self.width, self.is_narrowest = self.steps / self.parts * fastest.duration, self.parts == _MOST_PARTS
        self.places = np.union1d(np.linspace(0.0, 1.0, _PLACES), self._shares(fastest, _PLACES))
        self.slowness = np.ones(len(self.places))
        self.law, self.duration, self.excess = fastest, np.inf, np.inf
        self.fastest = fastest

    def improved(self, rounds: int) -> "_Average":
        """Slow the time-optimal law down where its average exceeds a limit, some times over."""
        for _ in range(rounds):
            if self.excess <= _ENOUGH:
                break
            law = moving_average(self.fastest, self.parts, self.steps, self.times)
            factors = self._factors(law)
            self.excess = float(factors.max())
            if self.excess * law.duration < self.duration:
                self.law, self.duration = law, self.excess * law.duration
            # An average takes part of the law up to its windows earlier.
            around = sliding_window_view(factors, self.times * self.steps + 1).max(axis=1)
            needed = np.interp(self.places, self._shares(self.fastest, len(around) - 1), around)
            self.slowness = np.maximum(self.slowness * np.where(needed > 1.0, needed, np.sqrt(needed)), 1.0)
            self.fastest = _fastest(self.geometry, self._slower)
        return self

    def _slower(self, nodes: Array) -> Array:
        factors = np.interp(nodes, self.places, self.slowness)
        return np.maximum(factors[:-1], factors[1:])

    def _shares(self, law: PiecewisePolynomial, count: int) -> Array:
        """Return where a law is at evenly spaced times, from 0 to 1; shape (count + 1,)."""
        begin, end = self.geometry.ends
        shares: Array = (law.at(_instants(law, count))[:, 0] - begin) / (end - begin)
        return shares

    def _factors(self, law: PiecewisePolynomial) -> Array:
        """Return the k by which each piece of a law exceeds the limits, at its ends and its middle; shape (M,)."""
        rows = np.repeat(law.coefficients, len(_PROBES), axis=0)
        local = (np.diff(law.breaks)[:, None] * _PROBES).reshape(-1, 1)
        s, *rates = (values[:, 0] for values in derivatives(rows, local))
        s = np.clip(s, *self.geometry.ends)
        slopes = self.geometry.at(self.geometry.piece_of(s), s)
        found = ratios(slopes, *rates) ** (1.0 / ORDERS)
        factors: Array = found.reshape(len(law.coefficients), -1).max(axis=1)
        return factors


def _fastest(geometry: LimitedPath, slower: Slower | None = None) -> PiecewisePolynomial:
    return optimal_within(geometry, slower).time_law


def _instants(law: PiecewisePolynomial, count: int) -> Array:
    """Return evenly spaced times of a law, both ends included; shape (count + 1,), [s]."""
    return np.linspace(float(law.breaks[0]), float(law.breaks[-1]), count + 1)


def moving_average(law: PiecewisePolynomial, parts: int, steps: int, times: int) -> PiecewisePolynomial:
    """Average a law from rest to rest over windows of `steps` of equal parts of its duration, `times` over.

    Its velocity is first taken as linear within each part, and scaled to lead to the same end.
    """
    h = law.duration / parts
    start, end = law.at(law.breaks[[0, -1]])[:, 0]
    speeds = law.rates_at(_instants(law, parts))[1][:, 0]
    speeds[[0, -1]] = 0.0
    highest = np.diff(speeds) * ((end - start) / (h * h * speeds.sum()))
    for _ in range(times):
        rest = np.zeros(steps)
        highest = (np.append(highest, rest) - np.append(rest, highest)) / (steps * h)
    return _integrated(start, highest, h, 2 + times)


def _integrated(start: float, highest: Array, h: float, order: int) -> PiecewisePolynomial:
    """Return s(t), from rest at `start`, from its derivative of an order, (M,), constant on pieces of h seconds."""
    rows = [highest]
    for _ in range(order):
        gains = np.array([row * h**i / factorial(i) for i, row in enumerate(rows, start=1)]).sum(axis=0)
        rows.insert(0, np.append(0.0, np.cumsum(gains)[:-1]))
    rows[0] += start
    c: Array = np.stack([row / factorial(k) for k, row in enumerate(rows)], axis=1)
    return PiecewisePolynomial(np.arange(len(c) + 1.0) * h, c[:, :, None])
