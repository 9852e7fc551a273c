"""Time laws along blended lines: constant speed through each blend, a law of its own on each line, as fast as possible.

On a line the law is the cubic from one speed to another, the quintic or septic whose acceleration (and jerk) vanish at
both ends, or a jerk-limited profile without acceleration at both ends. Speeds in blends are the largest that the
limits allow there, reduced where a line between two blends could not connect them.
"""

from dataclasses import dataclass

import numpy as np

from gelenk.errors import InvalidField
from gelenk.robot.arrays import Array
from gelenk.trajectory.laws.jerk_limited import jerk_limited
from gelenk.trajectory.motion.polynomial import PiecewisePolynomial, derivatives, joined
from gelenk.trajectory.motion.time_laws import hermite_pieces
from gelenk.trajectory.paths.path_geometry import ORDERS, LimitedPath, Slopes, of_order, ratios

_TABLE, _LEAST_SAMPLES = 400, 8
_PLACES, _INSTANTS = 33, 49
"""Samples of a line or blend: places, and instants of a law."""
_DURATIONS, _ZOOMS = 24, 3
_CRUISES, _SLOWEST, _CAPS, _HALVINGS = 3, 32.0, 11, 4
"""Jerk-limited profiles: cruise speeds and slower caps that are tried, and the bisections between caps."""
_STEP = 2.0
"""Largest factor by which the speeds at both ends are lowered in one round, if no law connects them."""
_ROUNDS = 60
_EXCESS = 1e-6
"""Excess over a limit that a final uniform scaling removes."""
_ENOUGH = 1.0 + _EXCESS
_NO_LENGTH = 1e-9
"""Least length of a line between two blends, in fractions of the path."""


@dataclass(frozen=True, slots=True)
class _Chain:
    """The limits along blended lines.

    Attributes:
        middles: Midpoints between the places at which slopes are known; shape (N - 1,).
        slopes: Shape (N, …).
        count: That of `chain_law`.
    """

    geometry: LimitedPath
    middles: Array
    slopes: Slopes
    count: int | None

    def factors(self, s: Array, v: Array, a: Array, j: Array) -> Array:
        rows = self.slopes.take(np.searchsorted(self.middles, s.ravel()))
        found = ratios(rows, self.geometry.limits, v.ravel(), a.ravel(), j.ravel()) ** (1.0 / ORDERS)
        if self.count == 2:  # The cubic's acceleration jumps: jerk limits do not count.
            found[:, of_order(3)] = 0.0
        factors: Array = found.max(axis=1).reshape(s.shape)
        return factors

    def even_speeds(self, begin: float, end: float) -> Array:
        """Return the largest constant ṡ at places between two."""
        s = np.linspace(begin, end, _PLACES)
        speeds: Array = 1.0 / self.factors(s, np.ones_like(s), np.zeros_like(s), np.zeros_like(s))
        return speeds

    def line(self, begin: float, end: float, speeds: Array) -> tuple[PiecewisePolynomial | None, float]:
        """Return the law of a line between two speeds, not both zero, and the k that must still slow it down."""
        if self.count is None:
            return self._least_jerk(begin, end, speeds)
        return self._shortest(begin, end, speeds, self.count)

    def _least_jerk(self, begin: float, end: float, speeds: Array) -> tuple[PiecewisePolynomial | None, float]:
        """Return the shortest jerk-limited profile within limits, of several cruise speeds and caps, and its k."""
        s = np.linspace(begin, end, _PLACES)
        one, none = np.ones_like(s), np.zeros_like(s)
        even = np.maximum(self.even_speeds(begin, end), speeds.max())
        acceleration = self.factors(s, none, one, none).max() ** -2
        jerk = self.factors(s, none, none, one).max() ** -3
        start, stop = (np.array([[s[i]], [speeds[i]], [0.0]]) for i in (0, -1))
        found = []
        for cruise in np.unique(np.geomspace(even.min(), even.max(), _CRUISES)):
            slower = np.geomspace(1.0, _SLOWEST, _CAPS)
            tried = []
            for _ in range(1 + _HALVINGS):
                for k in slower:
                    limits = np.array([[cruise], [acceleration / k**2], [jerk / k**3]])
                    tried.append((k, *self._under(start, stop, limits)))
                    if tried[-1][2] <= _ENOUGH:
                        break
                # Bisect between the last that is too fast and the first that is not.
                good = min((k for k, _, factor in tried if factor <= _ENOUGH), default=np.inf)
                bad = max((k for k, _, factor in tried if factor > _ENOUGH and k < good), default=good)
                slower = np.array([np.sqrt(bad * good)])
                if bad == good or not np.isfinite(good):
                    break
            found += [(law, factor) for _, law, factor in tried if law is not None]
        good_laws = [law for law, factor in found if factor <= _ENOUGH]
        if good_laws:
            return min(good_laws, key=lambda law: law.duration), 1.0
        return None, float(np.clip(min((factor for _, factor in found), default=_STEP), 1.0 + 2.0 * _EXCESS, _STEP))

    def _under(self, start: Array, end: Array, limits: Array) -> tuple[PiecewisePolynomial | None, float]:
        """Return the jerk-limited profile from one state to another, if any, and its k; ∞ if it turns back."""
        try:
            law = jerk_limited(start, end, limits)
        except InvalidField:
            return None, np.inf
        factors = self._needed(law.coefficients, np.diff(law.breaks), _INSTANTS // 4, limits[0, 0])
        return law, float(factors.max())

    def _shortest(self, begin: float, end: float, speeds: Array, count: int) -> tuple[PiecewisePolynomial, float]:
        starts, ends = np.zeros((2, count, 1, 1))
        starts[:2, 0, 0], ends[:2, 0, 0] = (begin, speeds[0]), (end, speeds[1])
        low, high = (end - begin) / self.even_speeds(begin, end).max(), 3.0 * (end - begin) / speeds.max()
        for _ in range(_ZOOMS):
            durations = np.geomspace(min(low, high), high, _DURATIONS)
            pieces = hermite_pieces(starts, ends, durations)
            factors = self._needed(pieces, durations, _INSTANTS, speeds.max())
            good = np.flatnonzero(factors <= 1.0)
            i = int(good[0]) if len(good) else int(factors.argmin())
            low, high = durations[max(i - 1, 0)], durations[i if len(good) else min(i + 1, _DURATIONS - 1)]
        law = PiecewisePolynomial(np.array([0.0, durations[i]]), hermite_pieces(starts, ends, durations[i : i + 1]))
        return law, max(1.0, float(factors[i]))

    def _needed(self, pieces: Array, durations: Array, count: int, speed: float) -> Array:
        """Return the k that must slow down each polynomial, ∞ if it turns back, from `count` instants; shape (K,)."""
        t = durations[:, None] * np.linspace(0.0, 1.0, count)
        rows = np.repeat(pieces, count, axis=0)
        law = [values.reshape(t.shape) for values in derivatives(rows, t.reshape(-1, 1))]
        factors: Array = self.factors(*law).max(axis=1)
        factors[law[1].min(axis=1) < -_EXCESS * speed] = np.inf
        return factors


def chain_law(geometry: LimitedPath, count: int | None) -> PiecewisePolynomial | None:
    """Return s(t) along blended lines; None for a single line, if a line is too short, or if no law is found.

    `count` is that of the derivatives fixed at both ends of each line, 2 to 4 with the position; None for jerk-limited
    profiles.
    """
    begin, end = geometry.ends
    corners = np.array([corner for corner in geometry.corners if corner[0] < end and corner[1] > begin])
    if not len(corners):
        return None
    edges = np.concatenate(([begin], corners.ravel(), [end]))
    lines = edges.reshape(-1, 2)
    if (np.diff(lines) <= _NO_LENGTH * (end - begin)).any():
        return None
    piece, s = geometry.samples(_TABLE, _LEAST_SAMPLES)
    chain = _Chain(geometry, 0.5 * (s[:-1] + s[1:]), geometry.at(piece, s), count)
    speeds = np.array([0.0, *(chain.even_speeds(*corner).min() for corner in corners), 0.0])
    for _ in range(_ROUNDS):
        before, laws = speeds.copy(), []
        for i, (first, last) in enumerate(lines.tolist()):
            law, factor = chain.line(first, last, speeds[i : i + 2])
            laws.append(law)
            if factor > 1.0 + _EXCESS:
                speeds[i : i + 2] /= factor
        if (speeds == before).all():
            break
    else:
        return None
    parts = laws[:1]
    for (first, last), speed, law in zip(corners.tolist(), speeds[1:-1], laws[1:], strict=True):
        even = PiecewisePolynomial(np.array([0.0, (last - first) / speed]), np.array([[[first], [speed]]]))
        parts += [even, law]
    return joined([part for part in parts if part is not None]) if all(laws) else None
