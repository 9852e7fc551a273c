"""The course's four steps from points to a joint trajectory: knots, path, samples with their configurations, spline.

The joints pass through the samples, and the tip only there through the line: its distance from the line in between is
what the interpolation costs. The second way: matrices of rotation and translation, and a finer grid.
"""

import math
from dataclasses import dataclass

import numpy as np

from gelenk.course.cartesian.planar_line import PlanarLine, tips
from gelenk.course.motion.check import MotionCertificate, MotionClaims, certified
from gelenk.course.motion.time_law_steps import tex_polynomial, tex_row
from gelenk.course.orientation.rotations import elementary
from gelenk.course.steps import Step, step, tex, tex_factor
from gelenk.course.writing import vector
from gelenk.errors import certify
from gelenk.language import translated as _
from gelenk.robot.arrays import Array
from gelenk.robot.result import Result
from gelenk.trajectory.motion.extremes import peaks_by_order
from gelenk.trajectory.motion.polynomial import PiecewisePolynomial
from gelenk.trajectory.motion.splines import Spline, cubic_spline

_PARTS = 24
"""Parts of a piece of the spline that are searched for an extreme deviation."""
_BISECTIONS = 60
_CHECKED_PARTS = 61
_TOLERANCE = 1e-9


@dataclass(frozen=True, slots=True)
class Deviation(Result):
    """Largest distance of the tip from the line.

    Attributes:
        value: To the left of the line positive, to its right negative, [m].
        time: When it is so large, [s].
    """

    value: float
    time: float


@dataclass(frozen=True, slots=True)
class PipelineCertificate(Result):
    """The four steps recomputed: tips as products of matrices, the spline from its control points.

    Attributes:
        max_position_error: Largest distance of a sample's tip from the line's point, [m].
        max_deviation_error: Of the largest deviation, from that on a finer grid and from its value at its time, [m].
        spline: Of the joint spline.
    """

    max_position_error: float
    max_deviation_error: float
    spline: MotionCertificate


@dataclass(frozen=True, slots=True)
class Pipeline:
    """Samples along a line, and the spline through their configurations.

    Attributes:
        times, shares: Of the samples; shape (N,), [s], no unit.
        configurations: Of the samples; shape (N, 2), [rad]; NaN out of reach.
        spline: Clamped, at rest at both ends; None if a sample is out of reach.
    """

    line: PlanarLine
    times: Array
    shares: Array
    configurations: Array
    spline: Spline | None

    def deviations(self, q: Array) -> Array:
        """Return the signed distances of the tip from the line at configurations; shape (N, 2) → (N,), [m]."""
        way = self.line.target - self.line.start
        found: Array = ((tips(self.line.lengths, q) - self.line.start) * way.conjugate()).imag / abs(way)
        return found

    def largest_deviation(self) -> Deviation:
        """Return the extreme of the deviation, exact to rounding: between samples its slope is bisected to zero."""
        motion = self.motion
        shares = np.linspace(0.0, 1.0, _PARTS + 1)[:-1]
        times = np.append(
            (motion.breaks[:-1, None] + np.diff(motion.breaks)[:, None] * shares).ravel(), motion.breaks[-1]
        )
        slopes = self._slopes(motion, times)
        turns = np.flatnonzero(slopes[:-1] * slopes[1:] < 0.0)
        low, high, sign = times[turns], times[turns + 1], np.sign(slopes[turns])
        for _halving in range(_BISECTIONS):
            middle = 0.5 * (low + high)
            is_before = self._slopes(motion, middle) * sign > 0.0
            low, high = np.where(is_before, middle, low), np.where(is_before, high, middle)
        found = np.concatenate((times, 0.5 * (low + high)))
        values = self.deviations(motion.at(found))
        i = int(np.abs(values).argmax())
        return Deviation(float(values[i]), float(found[i]))

    @property
    def motion(self) -> PiecewisePolynomial:
        """The joints over time; ValueError without a spline."""
        if self.spline is None:
            raise ValueError("a pipeline whose samples are not all reached has no spline")
        return self.spline.motion

    def _slopes(self, motion: PiecewisePolynomial, times: Array) -> Array:
        """Return the rate of the deviation; shape (N,), [m/s]."""
        q, rates, _ = motion.rates_at(times)
        first = self.line.lengths[0] * np.exp(1j * q[:, 0]) * rates[:, 0]
        velocity = 1j * (first + self.line.lengths[1] * np.exp(1j * q.sum(axis=1)) * rates.sum(axis=1))
        way = self.line.target - self.line.start
        found: Array = (velocity * way.conjugate()).imag / abs(way)
        return found

    def certificate(self, found: Deviation | None) -> PipelineCertificate | None:
        """Recompute samples, deviation and spline; None without one; raises CertificationFailed beyond rounding."""
        if self.spline is None or found is None:
            return None
        motion = self.spline.motion
        wanted = self.line.points(self.shares)
        errors = _by_matrices(self.line, self.configurations) - np.column_stack((wanted.real, wanted.imag))
        times = np.append(np.linspace(0.0, self.times[-1], _CHECKED_PARTS * len(self.times)), found.time)
        start, end = (np.array([p.real, p.imag]) for p in (self.line.start, self.line.target))
        away, along = _by_matrices(self.line, motion.at(times)) - start, (end - start) / math.dist(start, end)
        distances = along[0] * away[:, 1] - along[1] * away[:, 0]
        position = float(np.hypot(*errors.T).max())
        beyond = max(float(np.abs(distances).max()) - abs(found.value), abs(float(distances[-1]) - found.value))
        size = sum(self.line.lengths)
        for quantity, error in (("the samples' tips", position), ("the deviation from the line", beyond)):
            certify(quantity, error, _TOLERANCE * size)
        rest = np.zeros((1, 2))
        claims = MotionClaims(self.times, self.configurations, rest, rest, 2, peaks_by_order(motion))
        return PipelineCertificate(position, beyond, certified(motion, claims))


def pipeline(line: PlanarLine, shares: Array, duration: float) -> Pipeline:
    """Return samples at places s, (N,), evenly spaced in time, and the clamped spline through them."""
    times, q = np.linspace(0.0, duration, len(shares)), line.configurations(shares)
    spline = None if np.isnan(q).any() else cubic_spline(times, q, "clamped")
    return Pipeline(line, times, shares, q, spline)


def _by_matrices(line: PlanarLine, q: Array) -> Array:
    """Return tips as products of rotations and translations, A_1 A_2; shape (N, 2) → (N, 2), [m]."""
    found = []
    for configuration in q.tolist():
        T = np.eye(4)
        for angle, length in zip(configuration, line.lengths, strict=True):
            A = np.eye(4)
            A[:3, :3] = elementary("z", angle)
            A[:2, 3] = A[:2, 0] * length
            T = T @ A
        found.append(T[:2, 3])
    return np.array(found)


_SHOWN_SAMPLES = 12
_SHOWN_PIECES = 4


def pipeline_steps(found: Pipeline, deviation: Deviation | None) -> tuple[Step, ...]:
    """Return knots, path, samples with one of them solved in full, and the spline with its deviation."""
    reached = np.flatnonzero(~np.isnan(found.configurations[:, 0]))
    solved = (_solved(found, int(reached[len(reached) // 2])),) if len(reached) else ()
    steps = (_knots(found.line), _path(found.line), _sampled(found), *solved)
    if found.spline is None or deviation is None:
        return steps
    return (*steps, _spline(found), _missed(found.line, deviation))


def _point(p: complex) -> str:
    return vector(np.array([p.real, p.imag]))


def _knots(line: PlanarLine) -> Step:
    (l1, l2), (q1, q2) = line.lengths, line.angles.tolist()
    return step(
        _("1. Knots"),
        _("The line begins where the tip is, by forward kinematics, and ends at the target: two knots are enough."),
        r"p = (l_1 c_1 + l_2 c_{12},\; l_1 s_1 + l_2 s_{12})",
        rf"q_i = {vector(line.angles)}",
        rf"p_i = ({tex(l1)} \cos {tex_factor(q1)} + {tex(l2)} \cos {tex_factor(q1 + q2)},\; "
        rf"{tex(l1)} \sin {tex_factor(q1)} + {tex(l2)} \sin {tex_factor(q1 + q2)}) = {_point(line.start)}",
        rf"p_f = {_point(line.target)}",
    )


def _path(line: PlanarLine) -> Step:
    return step(
        _("2. Path"),
        _("A straight line, with s from 0 to 1."),
        rf"p(s) = p_i + s\,(p_f - p_i) = {_point(line.start)} + s\,{_point(line.target - line.start)}",
        rf"L = \lVert p_f - p_i \rVert = {tex(line.length, 'm')}",
    )


def _sampled(found: Pipeline) -> Step:
    q, shown = found.configurations, slice(0, _SHOWN_SAMPLES)
    text = _("At equal distances in time; each point on the branch on which the arm starts, without jumps by 2π.")
    return step(
        _("3. Samples and inverse kinematics"),
        text,
        rf"N = {len(found.times)},\quad s = ({tex_row(found.shares)})",
        rf"c_2 = \frac{{x^2 + y^2 - l_1^2 - l_2^2}}{{2\,l_1 l_2}},\quad "
        rf"q_2 = {'-' if found.line.elbow < 0.0 else ''}\arccos c_2",
        r"q_1 = \mathrm{atan2}(y, x) - \mathrm{atan2}(l_2 s_2,\ l_1 + l_2 c_2)",
        *(rf"q_{{{j + 1}}} = ({_numbers(q[shown, j], len(q))})" for j in range(2)),
    )


def _numbers(values: Array, count: int) -> str:
    texts = [r"\text{-}" if np.isnan(value) else tex(value) for value in values.tolist()]
    return ", ".join(texts if count <= len(values) else [*texts, r"\dots"])


def _solved(found: Pipeline, k: int) -> Step:
    line, p = found.line, complex(found.line.points(found.shares[k : k + 1])[0])
    (l1, l2), (q1, q2) = line.lengths, found.configurations[k].tolist()
    cosine = float(np.cos(q2))
    text = _("The other samples are solved in the same way.")
    if found.spline is None:
        text += " " + _(
            "Where |c₂| > 1 a sample is out of reach (-): no spline leads there, and the motion is not planned."
        )
    squares = rf"{tex_factor(p.real)}^2 + {tex_factor(p.imag)}^2 - {tex(l1)}^2 - {tex(l2)}^2"
    return step(
        _("Sample {number} in full").format(number=k + 1),
        text,
        rf"p({tex(float(found.shares[k]))}) = {_point(p)}",
        rf"c_2 = \frac{{{squares}}}{{2 \cdot {tex(l1)} \cdot {tex(l2)}}} = {tex(cosine)}",
        rf"q_2 = {tex(q2, 'rad')}",
        rf"q_1 = \mathrm{{atan2}}({tex(p.imag)}, {tex(p.real)}) - \mathrm{{atan2}}({tex(l2 * float(np.sin(q2)))},\ "
        rf"{tex(l1 + l2 * cosine)}) = {tex(q1, 'rad')}\ (\mathrm{{mod}}\ 2 \pi)",
    )


def _spline(found: Pipeline) -> Step:
    formulas = []
    if found.spline is not None:
        formulas += [rf"h = {tex(float(found.times[1] - found.times[0]), 's')}"]
        for j in range(2):
            formulas.append(rf"v_{{{j + 1}}} = ({tex_row(found.spline.velocities[:, j])})")
        for j in range(2):
            for k, c in enumerate(found.spline.motion.coefficients[:_SHOWN_PIECES, ::-1, j].tolist(), start=1):
                formulas.append(rf"q_{{{j + 1},{k}}}(t) = {tex_polynomial(c)}")
    text = _(
        "A clamped cubic spline through the samples of each joint: A(h) v = b for the velocities there, 0 at both "
        "ends. Each piece is in the time since it begins."
    )
    row = r"h_{k+1} v_k + 2 (h_k + h_{k+1}) v_{k+1} + h_k v_{k+2} = b_k"
    return step(_("4. Joint interpolation"), text, row, *formulas)


def _missed(line: PlanarLine, deviation: Deviation) -> Step:
    return step(
        _("Between the samples"),
        _("The tip passes through the samples, and beside the line between them: more samples, less deviation."),
        r"e(t) = \frac{(p_f - p_i) \times (F(q(t)) - p_i)}{L}",
        rf"\max |e| = {tex(abs(deviation.value), 'm')},\quad t = {tex(deviation.time, 's')},\quad "
        rf"\frac{{\max |e|}}{{L}} = {tex(abs(deviation.value) / line.length)}",
    )
