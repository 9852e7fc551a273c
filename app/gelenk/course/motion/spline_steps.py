"""Worked solution of a cubic spline: the system A(h) v = b, and the pieces of the spline."""

import numpy as np

from gelenk.course.motion.time_law_steps import SHOWN_JOINTS, of_joint, tex_polynomial, tex_row
from gelenk.course.steps import Step, step, tex
from gelenk.course.writing import matrix
from gelenk.language import marked, translated as _
from gelenk.trajectory.motion.splines import Boundary, Spline

_SHOWN_UNKNOWNS = 8
_SHOWN_PIECES = 8

_BOUNDARIES: dict[Boundary, tuple[str, ...]] = {
    "clamped": (
        marked(
            "The velocities at both ends are given; what they add to the first and the last row goes to the right side."
        ),
        r"\dot q(t_1) = v_1,\quad \dot q(t_N) = v_N",
    ),
    "natural": (
        marked("No acceleration at both ends: a row more at the top and at the bottom."),
        r"2 v_1 + v_2 = \frac{3 (q_2 - q_1)}{h_1}",
        r"v_{N-1} + 2 v_N = \frac{3 (q_N - q_{N-1})}{h_{N-1}}",
    ),
    "not_a_knot": (
        marked(
            "The jerk is continuous across the second and the last but one knot. The row of that knot eliminates the "
            "third unknown."
        ),
        r"h_2 v_1 + (h_1 + h_2) v_2 = \frac{h_2 (3 h_1 + 2 h_2) s_1 + h_1^2 s_2}{h_1 + h_2}",
        r"s_k = \frac{q_{k+1} - q_k}{h_k}",
    ),
    "periodic": (
        marked("v_N = v_1, a_N = a_1: the row of the first knot has the last segment before it, and A has corners."),
        r"h_1 v_{N-1} + 2 (h_{N-1} + h_1) v_1 + h_{N-1} v_2 = 3 (h_{N-1} s_1 + h_1 s_{N-1})",
    ),
    "assigned": (
        marked(
            "Velocity and acceleration at both ends are two conditions too many: two fictitious knots bring two free "
            "positions. Such a position follows from the velocity there, so that A stays tridiagonal."
        ),
        r"q_f = q_1 + \frac{h_1}{3} (2 v_1 + v_f) + \frac{h_1^2}{6} a_1",
    ),
}
"""What each boundary adds: its text and its formulas."""


def spline_steps(spline: Spline, boundary: Boundary) -> tuple[Step, ...]:
    """Return the worked steps: conditions, system, velocities at the knots, pieces."""
    segments, joints = len(spline.times) - 1, spline.knots.shape[1]
    N, inner = segments + 1 - len(spline.fictitious), segments - 1
    conditions = _(
        "{knots} knots and 1 cubic have {all} coefficients; {positions} positions and {continuous} continuities of "
        "velocity and acceleration leave two free."
        if N == 2
        else "{knots} knots and {cubics} cubics have {all} coefficients; {positions} positions and {continuous} "
        "continuities of velocity and acceleration leave two free."
    )
    rows = _("There is no inner knot.")
    if inner:
        rows = _("The acceleration is continuous at each inner knot, {inner} in all.").format(inner=inner)
    steps = [
        step(
            _("Conditions"),
            conditions.format(knots=N, cubics=N - 1, all=4 * (N - 1), positions=2 * (N - 1), continuous=2 * (N - 2)),
            r"4(N-1) - [2(N-1) + 2(N-2)] = 2",
        ),
        step(
            _("Rows of A(h) v = b"),
            rows,
            r"h_{k+1} v_k + 2 (h_k + h_{k+1}) v_{k+1} + h_k v_{k+2} = \frac{3}{h_k h_{k+1}} "
            r"\left[h_k^2 (q_{k+2} - q_{k+1}) + h_{k+1}^2 (q_{k+1} - q_k)\right]",
            rf"h = ({tex_row(np.diff(spline.times))})",
        ),
        _boundary_step(spline, boundary),
    ]
    if spline.matrix is not None and len(spline.matrix) <= _SHOWN_UNKNOWNS:
        shown = rf"A = {matrix(spline.matrix.dense(), tex)}"
        steps.append(step("A", _("It depends on the times alone, and is the same for all joints."), shown))
    for j in range(min(joints, SHOWN_JOINTS)):
        steps += [of_joint(_velocities(spline, j), j, joints), of_joint(_pieces(spline, j), j, joints)]
    return tuple(steps)


def _boundary_step(spline: Spline, boundary: Boundary) -> Step:
    text, *formulas = _BOUNDARIES[boundary]
    if boundary == "not_a_knot" and len(spline.times) <= 3:
        text, formulas = marked("With 2 knots nothing is left to choose: the line through them."), []
        if len(spline.times) == 3:
            text = marked("With 3 knots nothing is left to choose: the parabola through them.")
    return step(_("Both ends"), _(text), *formulas)


def _velocities(spline: Spline, joint: int) -> Step:
    formulas = []
    if spline.matrix is not None and len(spline.matrix) <= _SHOWN_UNKNOWNS:
        unknown = spline.velocities[list(spline.unknowns), joint]
        formulas += [rf"b = {matrix(spline.right_side[:, joint], tex)}", rf"A^{{-1}} b = {matrix(unknown, tex)}"]
    formulas.append(rf"v = ({tex_row(spline.velocities[:, joint])})")
    if spline.fictitious:
        formulas.append(rf"q_f = ({', '.join(map(tex, spline.knots[list(spline.fictitious), joint].tolist()))})")
    return step(_("Velocities at the knots"), _("The solution, with the ends that were given."), *formulas)


def _pieces(spline: Spline, joint: int) -> Step:
    rows = spline.motion.coefficients[:_SHOWN_PIECES, ::-1, joint].tolist()
    formulas = (rf"q_{{{k}}}(t) = {tex_polynomial(row)}" for k, row in enumerate(rows, start=1))
    return step(_("Pieces"), _("Each in the time since its segment begins."), *formulas)
