"""Worked solution of a line: length, time law, p(s) with its derivatives, and why nothing is quicker."""

import numpy as np

from gelenk.course.cartesian.line import AxesComparison, AxisLimits, LineLaw, LineMotion, line_move
from gelenk.course.motion.time_law_steps import tex_polynomial
from gelenk.course.motion.trapezoid_steps import trapezoid_steps
from gelenk.course.steps import Step, step, tex, tex_factor
from gelenk.course.writing import vector
from gelenk.language import translated as _
from gelenk.robot.arrays import Array
from gelenk.trajectory.motion.extremes import peaks
from gelenk.trajectory.motion.polynomial import PiecewisePolynomial


def line_steps(found: LineMotion, law: LineLaw) -> tuple[Step, ...]:
    """Return the steps from the two points to p(t), ṗ and p̈."""
    length = _length(found)
    if found.planned is not None:
        laws = trapezoid_steps([line_move(found.length, law)], found.planned)
    else:
        laws = (_polynomial(found, law),)
    if found.length == 0.0:
        return (length, *laws[:1]) if found.planned is not None else (length,)
    pieces = step(_("σ(t) in numbers"), _("τ is the time since the piece begins."), *sigma_pieces(found.law))
    return (length, *laws, pieces, line_derivatives(found.start, found.end), _largest(found))


def _length(found: LineMotion) -> Step:
    delta = found.end - found.start
    squares = " + ".join(f"{tex_factor(part)}^2" for part in delta.tolist())
    text = _("The length of the line, and its unit vector.")
    formulas = [
        rf"p_f - p_i = {vector(found.end)} - {vector(found.start)} = {vector(delta)}",
        rf"L = \lVert p_f - p_i \rVert = \sqrt{{{squares}}} = {tex(found.length, 'm')}",
    ]
    if found.direction is None:
        text = _("Both points are the same: s = σ/L is not defined, and p stays where it is.")
    else:
        formulas.append(rf"K = \frac{{p_f - p_i}}{{L}} = {vector(found.direction)}")
    return step(_("The line"), text, *formulas)


def _polynomial(found: LineMotion, law: LineLaw) -> Step:
    count = 2 * (law.conditions or 0)
    text = _("{count} conditions, half of them at each end: a polynomial of degree {degree} for σ.")
    return step(
        _("Time law"),
        text.format(count=count, degree=count - 1),
        rf"\sigma(0) = 0,\quad \dot\sigma(0) = {tex(law.start_velocity)},\quad "
        rf"\sigma(T) = L = {tex(found.length)},\quad \dot\sigma(T) = {tex(law.end_velocity)}",
        rf"T = {tex(found.law.duration, 's')}",
    )


def sigma_pieces(law: PiecewisePolynomial) -> list[str]:
    """Return σ(t) piece by piece, each in the time τ since it begins."""
    formulas = []
    rows = zip(law.breaks[:-1].tolist(), law.breaks[1:].tolist(), law.coefficients, strict=True)
    for begin, end, c in rows:
        shifted = tex_polynomial(c[::-1, 0].tolist()).replace(r"\,t", r"\,\tau")
        since = r"\tau = t" if begin == 0.0 else rf"\tau = t - {tex(begin)}"
        formulas.append(rf"\sigma = {shifted},\quad {since},\quad {tex(begin)} \le t \le {tex(end)}")
    return formulas


def line_derivatives(start: Array, end: Array) -> Step:
    """Return p(s), ṗ and p̈ of a line that has a length."""
    direction = vector((end - start) / np.linalg.norm(end - start))
    return step(
        _("Along the line"),
        _("s = σ/L runs from 0 to 1. The line has no curvature, so of p̈ only the part along it is left."),
        r"s = \frac{\sigma}{L},\quad \dot s = \frac{\dot\sigma}{L},\quad \ddot s = \frac{\ddot\sigma}{L}",
        rf"p(s) = p_i + s\,(p_f - p_i) = {vector(start)} + s\,{vector(end - start)}",
        rf"\dot p = \frac{{dp}}{{ds}}\,\dot s = \frac{{p_f - p_i}}{{L}}\,\dot\sigma = {direction}\,\dot\sigma",
        r"\ddot p = \frac{d^2 p}{ds^2}\,\dot s^2 + \frac{dp}{ds}\,\ddot s,\quad \frac{d^2 p}{ds^2} = 0",
        rf"\ddot p = \frac{{p_f - p_i}}{{L}}\,\ddot\sigma = {direction}\,\ddot\sigma",
    )


def _largest(found: LineMotion) -> Step:
    formulas = []
    for order, dots, unit in ((1, r"\dot", "m/s"), (2, r"\ddot", "m/s^2")):
        peak = peaks(found.law, order)
        value, time = abs(float(peak.values[0])), float(peak.times[0])
        formulas.append(
            rf"\max \lVert {dots} p \rVert = \max |{dots}\sigma| = {tex(value, unit)} "
            rf",\quad t = {tex(time, 's')}"
        )
    return step(_("Largest speed and acceleration"), _("K is a unit vector: those of p are those of σ."), *formulas)


def optimal_step(found: LineMotion) -> Step:
    """Return why no path from rest to rest is quicker, with limits of the norms of ṗ and p̈."""
    return step(
        _("Nothing is quicker"),
        _(
            "Any motion from p_i to p_f, projected on K, covers L within the same limits of speed and acceleration: "
            "so it takes no less time than bang-coast-bang on L. For a PPP robot with limits of the norms, the "
            "straight line is one of the time-optimal paths; with a revolute joint that holds in joint space alone."
        ),
        r"|K^T \dot p| \le \lVert \dot p \rVert \le v,\quad |K^T \ddot p| \le \lVert \ddot p \rVert \le a",
        rf"T \ge T_{{\mathrm{{bcb}}}}(L) = {tex(found.law.duration, 's')}",
    )


def axes_steps(displacement: Array, limits: AxisLimits, compared: AxesComparison) -> tuple[Step, ...]:
    """Return how limits of the axes become limits of the line, and what each axis alone needs."""
    K = np.abs(displacement) / (float(np.linalg.norm(displacement)) or 1.0)
    formulas = []
    for letter, values, found in zip(
        "va", (limits.velocity, limits.acceleration), limits.along(displacement), strict=True
    ):
        if np.isfinite(found):
            quotients = [
                rf"\frac{{{tex(value)}}}{{{tex(part)}}}"
                for value, part in zip(values.tolist(), K.tolist(), strict=True)
                if part > 0.0 and np.isfinite(value)
            ]
            formulas.append(
                rf"{letter} = \min_j \frac{{{letter}_j}}{{|K_j|}} = "
                rf"\min\left({', '.join(quotients)}\right) = {tex(found)}"
            )
    limited = step(
        _("Limits along the line"),
        _("Each axis moves in proportion to σ, by its component of K; the tightest one counts."),
        *formulas,
    )
    text = _(
        "No axis arrives sooner than by itself. One axis limits both speed and acceleration: the line is as quick."
    )
    if not compared.is_time_optimal:
        text = _(
            "No axis arrives sooner than by itself. Different axes limit the speed and the acceleration on the line: "
            "it takes longer, and a curved path, each axis by itself, is quicker."
        )
    names = ",\\ ".join(rf"T_{{{j}}} = {tex(one)}" for j, one in enumerate(compared.durations, start=1))
    alone = step(
        _("Each axis alone"),
        text,
        names,
        rf"\max_j T_j = {tex(compared.lower_bound, 's')},\quad T = {tex(compared.line_duration, 's')}",
    )
    return limited, alone
