"""A straight line of a planar 2R arm's tip, on one branch of its inverse kinematics.

Along a line that does not pass through the base the direction of the tip turns by less than π, so that q(s) follows
without counting turns: cos q_2 = c_2 and q_1 = ψ - β, with the differences of ψ and β from the start. Points are
complex numbers x + iy here; links are l_1 e^{iq_1} and l_2 e^{i(q_1 + q_2)}.
"""

import itertools
import math
from dataclasses import dataclass
from functools import cached_property

import numpy as np
import numpy.typing as npt

from gelenk.errors import InvalidField
from gelenk.robot.arrays import Array

_ROUNDING = 1e-12
_SINGULAR = 1e-6
"""Sine of q_2 below which the arm counts as stretched or folded."""
Points = npt.NDArray[np.complex128]


@dataclass(frozen=True)
class PlanarLine:
    """A line from the tip's position at a configuration to a point.

    Attributes:
        lengths: l_1 and l_2 > 0, [m].
        angles: q_1 and q_2 at the start; shape (2,), [rad].
        target: p_f as x + iy, [m].
    """

    lengths: tuple[float, float]
    angles: Array
    target: complex

    @cached_property
    def start(self) -> complex:
        """p_i by forward kinematics, x + iy, [m]."""
        return complex(tips(self.lengths, self.angles[None])[0])

    @property
    def length(self) -> float:
        """L, [m]."""
        return abs(self.target - self.start)

    @property
    def elbow(self) -> float:
        """Sign of sin q_2 at the start, +1 where the arm is stretched or folded there."""
        return -1.0 if math.sin(self.angles[1]) < -_ROUNDING else 1.0

    def points(self, s: Array) -> Points:
        """Return p(s) = p_i + s (p_f - p_i); shape (N,), [m]."""
        found: Points = np.complex128(self.start) + s * np.complex128(self.target - self.start)
        return found

    def configurations(self, s: Array) -> Array:
        """Return q(s), continuous from the start on; shape (N, 2), [rad]; NaN out of reach."""
        l1, l2 = self.lengths
        p = self.points(np.append(0.0, s))
        r, outer, inner = np.abs(p), l1 + l2, abs(l1 - l2)
        # tan²(q_2/2), whose factors keep their digits near both ends of the reach, where acos c_2 loses half of them.
        above, below = (outer - r) * (outer + r), (r - inner) * (r + inner)
        rounding = -_ROUNDING * outer**2
        with np.errstate(invalid="ignore"):
            up, down = (np.sqrt(np.where(x < 0.0, np.where(x > rounding, 0.0, np.nan), x)) for x in (above, below))
        bend = self.elbow * 2.0 * np.arctan2(up, down)
        beta = np.angle(l1 + l2 * np.exp(1j * bend))
        turned = np.angle(p * np.conj(self.start))
        change = np.column_stack((turned - beta, bend))
        found: Array = self.angles + change[1:] - change[0]
        return found

    def determinants(self, q: Array) -> Array:
        """Return det J = l_1 l_2 sin q_2; shape (N, 2) → (N,), [m²]."""
        found: Array = math.prod(self.lengths) * np.sin(q[:, 1])
        return found

    def is_singular(self, q: Array) -> npt.NDArray[np.bool_]:
        """Check where the arm is stretched or folded; shape (N, 2) → (N,)."""
        found: npt.NDArray[np.bool_] = np.abs(np.sin(q[:, 1])) < _SINGULAR
        return found

    @cached_property
    def beyond(self) -> float | None:
        """The first s in [0, 1] at which the line leaves the ring that the arm reaches; None if it does not."""
        (l1, l2), way = self.lengths, self.target - self.start
        crossings = []
        for radius in (l1 + l2, abs(l1 - l2)):
            a, half, c = abs(way) ** 2, (self.start.conjugate() * way).real, abs(self.start) ** 2 - radius**2
            root = half**2 - a * c
            if a > 0.0 and root > 0.0:
                crossings += [(-half - math.sqrt(root)) / a, (-half + math.sqrt(root)) / a]
        ends = sorted([0.0, *(s for s in crossings if 0.0 < s < 1.0), 1.0])
        for first, last in itertools.pairwise(ends):
            distance = abs(complex(self.points(np.array([0.5 * (first + last)]))[0]))
            if not abs(l1 - l2) * (1.0 - _ROUNDING) <= distance <= (l1 + l2) * (1.0 + _ROUNDING):
                return first
        return None

    def derivatives(self, s: Array) -> tuple[Array, Array, Array, Array]:
        """Return q and three derivatives by s; shape (N, 2) each, [rad]; InvalidField where J has no inverse.

        From p' = J q', p'' = 0 = J q'' + J' q' and p''' = 0 = J q''' + 2 J' q'' + J'' q'.
        """
        q = self.configurations(s)
        if np.isnan(q).any() or self.is_singular(q).any():
            raise InvalidField(
                "line", "leads to a place that the arm does not reach, or where it is stretched or folded"
            )
        first, second = self.lengths[0] * np.exp(1j * q[:, 0]), self.lengths[1] * np.exp(1j * q.sum(axis=1))
        way = np.full(len(s), self.target - self.start)

        def solved(p: Points) -> Array:
            # J = [i (a + b), i b] of the links a and b: det J = Im(conj(i (a + b)) i b) = Im(conj(a) b).
            one, other = 1j * (first + second), 1j * second
            determinant = (one.conj() * other).imag
            found: Array = np.column_stack(((p.conj() * other).imag, (one.conj() * p).imag)) / determinant[:, None]
            return found

        def columns(rate: Points, other: Points, by: Array) -> Points:
            found: Points = 1j * ((rate + other) * by[:, 0] + other * by[:, 1])
            return found

        q1 = solved(way)
        turns = q1[:, 0], q1.sum(axis=1)
        rates = 1j * turns[0] * first, 1j * turns[1] * second
        q2 = solved(-columns(*rates, q1))
        bends = (1j * q2[:, 0] - turns[0] ** 2) * first, (1j * q2.sum(axis=1) - turns[1] ** 2) * second
        q3 = solved(-2.0 * columns(*rates, q2) - columns(*bends, q1))
        return q, q1, q2, q3


def tips(lengths: tuple[float, float], q: Array) -> Points:
    """Return the tip by forward kinematics, x + iy; shape (N, 2) → (N,), [m]."""
    found: Points = lengths[0] * np.exp(1j * q[:, 0]) + lengths[1] * np.exp(1j * q.sum(axis=1))
    return found


def planar_line(lengths: tuple[float, float], angles: Array, target: Array) -> PlanarLine:
    """Return the line; raises InvalidField if it begins with an arm that is stretched or folded, or has no length."""
    line = PlanarLine(lengths, angles, complex(*target.tolist()))
    if line.is_singular(angles[None])[0]:
        raise InvalidField("start", "the arm is stretched or folded: sin q_2 = 0, and its elbow may go either way")
    if line.length <= _ROUNDING * sum(lengths):
        raise InvalidField("target", "is where the tip already is: the line has no length")
    return line
