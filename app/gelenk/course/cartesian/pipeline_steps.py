"""Worked solution of the four steps from points to a joint trajectory."""

import numpy as np

from gelenk.course.cartesian.pipeline import Deviation, Pipeline
from gelenk.course.cartesian.planar_line import PlanarLine
from gelenk.course.motion.formulas import tex_polynomial, tex_row
from gelenk.course.steps import Step, step, tex, tex_factor
from gelenk.course.writing import vector
from gelenk.language import translated as _
from gelenk.robot.arrays import Array

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
