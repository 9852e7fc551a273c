"""Worked solution of a cubic spline: the system A(h) v = b, and the pieces of the spline."""

from collections.abc import Sequence

import numpy as np

from gelenk.course.motion.formulas import SHOWN_JOINTS, of_joint, tex_column, tex_matrix, tex_polynomial
from gelenk.course.steps import Step, tex
from gelenk.errors import counted
from gelenk.trajectory.motion.splines import Boundary, Spline

_SHOWN_UNKNOWNS = 8
_SHOWN_PIECES = 8

_BOUNDARIES: dict[Boundary, tuple[str, tuple[str, ...]]] = {
    "clamped": (
        "The velocities at both ends are given; what they add to the first and the last row goes to the right side.",
        (),
    ),
    "natural": (
        "No acceleration at both ends: a row more at the top and at the bottom.",
        (
            r"2 v_1 + v_2 = \frac{3 (q_2 - q_1)}{h_1}",
            r"v_{N-1} + 2 v_N = \frac{3 (q_N - q_{N-1})}{h_{N-1}}",
        ),
    ),
    "not_a_knot": (
        (
            "The jerk is continuous across the second and the last but one knot. The row of that knot eliminates the "
            "third unknown."
        ),
        (
            (
                r"h_2 v_1 + (h_1 + h_2) v_2 = \frac{h_2 (3 h_1 + 2 h_2) s_1 + h_1^2 s_2}{h_1 + h_2},"
                r"\quad s_k = \frac{q_{k+1} - q_k}{h_k}"
            ),
        ),
    ),
    "periodic": (
        "v_N = v_1, a_N = a_1: the row of the first knot has the last segment before it, and A has corners.",
        (r"h_1 v_{N-1} + 2 (h_{N-1} + h_1) v_1 + h_{N-1} v_2 = 3 (h_{N-1} s_1 + h_1 s_{N-1})",),
    ),
    "assigned": (
        (
            "Velocity and acceleration at both ends are two conditions too many: two fictitious knots bring two free "
            "positions. Such a position follows from the velocity there, so that A stays tridiagonal."
        ),
        (r"q_f = q_1 + \frac{h_1}{3} (2 v_1 + v_f) + \frac{h_1^2}{6} a_1",),
    ),
}


def spline_steps(spline: Spline, boundary: Boundary) -> tuple[Step, ...]:
    """Return the worked steps: conditions, system, velocities at the knots, pieces."""
    segments, joints = len(spline.times) - 1, spline.knots.shape[1]
    N = segments + 1 - len(spline.fictitious)
    inner = segments - 1
    steps = [
        Step(
            "Conditions",
            f"{N} knots and {counted(N - 1, 'cubic')} have {4 * (N - 1)} coefficients; {2 * (N - 1)} positions and "
            f"{2 * (N - 2)} continuities of velocity and acceleration leave two free.",
            (r"4(N-1) - [2(N-1) + 2(N-2)] = 2",),
        ),
        Step(
            "Rows of A(h) v = b",
            f"The acceleration is continuous at each inner knot, {inner} in all."
            if inner
            else "There is no inner knot.",
            (
                (
                    r"h_{k+1} v_k + 2 (h_k + h_{k+1}) v_{k+1} + h_k v_{k+2} = \frac{3}{h_k h_{k+1}} "
                    r"\left[h_k^2 (q_{k+2} - q_{k+1}) + h_{k+1}^2 (q_{k+1} - q_k)\right]"
                ),
                rf"h = ({_row(np.diff(spline.times).tolist())})",
            ),
        ),
        _boundary_step(spline, boundary),
    ]
    if spline.matrix is not None and len(spline.matrix) <= _SHOWN_UNKNOWNS:
        shown = rf"A = {tex_matrix(spline.matrix.dense().tolist())}"
        steps.append(Step("A", "It depends on the times alone, and is the same for all joints.", (shown,)))
    for j in range(min(joints, SHOWN_JOINTS)):
        steps.append(of_joint(_velocities(spline, j), j, joints))
        steps.append(of_joint(_pieces(spline, j), j, joints))
    return tuple(steps)


def _boundary_step(spline: Spline, boundary: Boundary) -> Step:
    if boundary == "not_a_knot" and len(spline.times) <= 3:
        name = "parabola" if len(spline.times) == 3 else "line"
        text = f"With {len(spline.times)} knots nothing is left to choose: the {name} through them."
        return Step("Both ends", text, ())
    text, formulas = _BOUNDARIES[boundary]
    return Step("Both ends", text, formulas)


def _velocities(spline: Spline, joint: int) -> Step:
    shown = rf"v = ({_row(spline.velocities[:, joint].tolist())})"
    formulas: tuple[str, ...] = (shown,)
    if spline.matrix is not None and len(spline.matrix) <= _SHOWN_UNKNOWNS:
        column = tex_column(spline.right_side[:, joint].tolist())
        formulas = (rf"b = {column}", rf"A^{{-1}} b = {tex_column(_unknown(spline, joint))}", shown)
    if spline.fictitious:
        positions = ", ".join(tex(float(spline.knots[i, joint])) for i in spline.fictitious)
        formulas = (*formulas, rf"q_f = ({positions})")
    return Step("Velocities at the knots", "The solution, with the ends that were given.", formulas)


def _unknown(spline: Spline, joint: int) -> list[float]:
    found: list[float] = spline.velocities[list(spline.unknowns), joint].tolist()
    return found


def _pieces(spline: Spline, joint: int) -> Step:
    rows = spline.motion.coefficients[:_SHOWN_PIECES, ::-1, joint].tolist()
    formulas = tuple(rf"q_{{{k}}}(t) = {tex_polynomial(row, 't')}" for k, row in enumerate(rows, start=1))
    return Step("Pieces", "Each in the time since its segment begins.", formulas)


def _row(values: Sequence[float]) -> str:
    shown = ", ".join(tex(value) for value in values[:12])
    return shown if len(values) <= 12 else shown + r", \dots"
