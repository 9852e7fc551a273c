"""A straight line of a planar 2R arm's tip, on one branch of its inverse kinematics.

Along a line that does not pass through the base the direction of the tip turns by less than π, so that q(s) follows
without counting turns: cos q_2 = c_2 and q_1 = ψ - β, with the differences of ψ and β from the start. Points are
complex numbers x + iy here; links are l_1 e^{iq_1} and l_2 e^{i(q_1 + q_2)}.

With a time law the joints are one piecewise polynomial: q(s(t)) to within rounding. Pieces are septics with the exact
position, velocity, acceleration and jerk at both ends, and are divided until they agree with q(s(t)) in between. So
the peaks of the polynomial are those of the motion.
"""

import itertools
import math
from dataclasses import dataclass
from functools import cached_property

import numpy as np
import numpy.typing as npt

from gelenk.course.steps import Step, step, tex
from gelenk.course.writing import matrix, vector
from gelenk.errors import InvalidField, certify
from gelenk.language import translated as _
from gelenk.robot.arrays import Array
from gelenk.trajectory.laws.time_scaling import Bound
from gelenk.trajectory.motion.polynomial import PiecewisePolynomial, derivatives
from gelenk.trajectory.motion.time_laws import hermite_pieces

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


_FIRST_PARTS, _MOST_PARTS = 16, 512
_AGREES = 1e-10
"""Error of position, velocity and acceleration between the ends of a piece, in fractions of the largest of each."""
_PROBES = (0.25, 0.5, 0.75)
_CHECKED = 257
_ON_LINE = 1e-9


def along_planar_line(line: PlanarLine, law: PiecewisePolynomial) -> PiecewisePolynomial:
    """Return the joints along a line whose s(t), of one piece, is given.

    Raises InvalidField where the line leads out of reach, through a singularity, or too near to one to be exact.
    """
    if line.beyond is not None:
        raise InvalidField("line", f"leaves what the arm reaches at s = {line.beyond:.6g}: choose another `target`")
    breaks = np.linspace(law.breaks[0], law.breaks[-1], _FIRST_PARTS + 1)
    while len(breaks) <= _MOST_PARTS:
        ends = rates(line, law, breaks)
        motion = PiecewisePolynomial(breaks, hermite_pieces(ends[:, :-1], ends[:, 1:], np.diff(breaks)))
        wrong = _errors(line, law, motion) > _AGREES
        if not wrong.any():
            _check(line, law, motion)
            return motion
        breaks = np.sort(np.concatenate((breaks, 0.5 * (breaks[:-1] + breaks[1:])[wrong])))
    raise InvalidField("line", "leads so near to a singularity that the joints turn too fast to be computed exactly")


def rates(line: PlanarLine, law: PiecewisePolynomial, times: Array) -> Array:
    """Return q, q̇, q̈ and q⃛ by the chain rule from those by s; shape (4, N, 2), [rad per sᵏ]."""
    s, v, a, j = derivatives(law.coefficients, (times - law.breaks[0])[:, None])
    q, first, second, third = line.derivatives(s[:, 0])
    return np.array((q, first * v, first * a + second * v**2, first * j + 3.0 * second * v * a + third * v**3))


def _errors(line: PlanarLine, law: PiecewisePolynomial, motion: PiecewisePolynomial) -> Array:
    """Return the largest error between the ends of each piece, as a fraction of the largest value; shape (M,)."""
    widths, worst = np.diff(motion.breaks), np.zeros(len(motion.coefficients))
    for share in _PROBES:
        wanted = rates(line, law, motion.breaks[:-1] + share * widths)[:3]
        found = np.array(derivatives(motion.coefficients, share * widths[:, None], 2))
        sizes = np.maximum(np.abs(wanted).max(axis=(1, 2)), np.finfo(float).tiny)
        worst = np.maximum(worst, (np.abs(found - wanted).max(axis=2) / sizes[:, None]).max(axis=0))
    return worst


def _check(line: PlanarLine, law: PiecewisePolynomial, motion: PiecewisePolynomial) -> None:
    """See by forward kinematics whether the tip is where the law says; raises CertificationFailed."""
    times = np.linspace(motion.breaks[0], motion.breaks[-1], _CHECKED)
    away = tips(line.lengths, motion.at(times)) - line.points(law.at(times)[:, 0])
    error, allowed = float(np.abs(away).max()), _ON_LINE * sum(line.lengths)
    certify("the tip on its line", error, allowed)


def planar_motion_steps(line: PlanarLine, law: PiecewisePolynomial, bound: Bound) -> tuple[Step, ...]:
    """Return how the line's derivatives become those of the joints, with numbers at the time of a bound."""
    s, v, a = (float(values[0, 0]) for values in law.rates_at(np.array([bound.time])))
    q, first, second, _third = (values[0] for values in line.derivatives(np.array([s])))
    J = _jacobian(line, q)
    way = np.array([(line.target - line.start).real, (line.target - line.start).imag])
    by_path = step(
        _("Joints along the line"),
        _("Derivatives by s, with p'' = 0 on a line; numbers where the limit is reached."),
        rf"s = {tex(s)},\quad q = {vector(q)}",
        rf"J = {matrix(J)},\quad p_f - p_i = {vector(way)}",
        rf"p' = J q' \Rightarrow q' = J^{{-1}} (p_f - p_i) = {vector(first)}",
        rf"p'' = J q'' + J' q' = 0 \Rightarrow q'' = -J^{{-1}} J' q' = {vector(second)}",
    )
    in_time = step(
        _("In time"),
        _("The chain rule with the time law."),
        rf"t = {tex(bound.time, 's')}:\quad \dot s = {tex(v)},\quad \ddot s = {tex(a)}",
        rf"\dot q = q'\,\dot s = {vector(first * v)}",
        rf"\ddot q = q'\,\ddot s + q''\,\dot s^2 = {vector(first * a + second * v**2)}",
    )
    return by_path, in_time


def _jacobian(line: PlanarLine, q: Array) -> Array:
    (l1, l2), (a, b) = line.lengths, np.cumsum(q)
    first, second = np.array([-np.sin(a), np.cos(a)]) * l1, np.array([-np.sin(b), np.cos(b)]) * l2
    return np.column_stack((first + second, second))
