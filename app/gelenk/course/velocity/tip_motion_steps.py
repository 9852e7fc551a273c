"""The worked solution of the tip's twist, acceleration, jerk and snap."""

import math
from collections.abc import Sequence

import numpy as np

from gelenk.course.steps import Step, step
from gelenk.course.velocity.writing import matrix, row
from gelenk.language import translated as _
from gelenk.robot.arrays import Array

_J = ("J", r"\dot J", r"\ddot J", "J^{(3)}")
_Q = (r"\dot q", r"\ddot q", "q^{(3)}", "q^{(4)}")
_R = (r"\dot r", r"\ddot r", "r^{(3)}", "r^{(4)}")


def tip_motion_steps(Js: Sequence[Array], rates: Array, sent: Sequence[Array] | None = None) -> list[Step]:
    """Return the worked solution of the derivatives of the tip's motion.

    Args:
        Js: J, J̇, … in the base's axes at the tip, one per rate; shape (m, n) each.
        rates: q̇, q̈, …; shape (K, n).
        sent: The same derivatives in another reference, if the answer has that one; shape (6,) each.
    """
    steps = [_derivative(k, Js, rates) for k in range(1, len(rates) + 1)]
    if sent is not None:
        lines = [f"{_R[k]} = {row(each)}" for k, each in enumerate(sent)]
        text = _("The same motion in the reference of the answer, whose axes or point are others.")
        steps.append(step(_("In the requested reference"), text, *lines))
    return steps


def known_part(order: int, Js: Sequence[Array], rates: Array) -> tuple[Array, list[str]]:
    """Return what the given rates alone contribute to the derivative of an order, shape (m,), and its formula."""
    value = np.zeros(Js[0].shape[0])
    lines, terms = [], []
    for j in range(1, order):
        part = math.comb(order - 1, j) * (Js[j] @ rates[order - 1 - j])
        terms.append(_term(order, j))
        lines += [f"{_J[j]} = {matrix(Js[j])}", f"{_term(order, j)} = {row(part)}"]
        value = value + part
    return value, [*lines, f"{' + '.join(terms)} = {row(value)}"] if len(terms) > 1 else lines


def _term(order: int, j: int) -> str:
    factor = math.comb(order - 1, j)
    return f"{factor if factor > 1 else ''}{_J[j]} {_Q[order - 1 - j]}"


def _derivative(order: int, Js: Sequence[Array], rates: Array) -> Step:
    sums = " + ".join(_term(order, j) for j in range(order))
    parts = [math.comb(order - 1, j) * (Js[j] @ rates[order - 1 - j]) for j in range(order)]
    lines = [f"{_Q[order - 1]} = {row(rates[order - 1])}"]
    lines += [f"{_J[order - 1]} = {matrix(Js[order - 1])}"]
    numbers = " + ".join(map(matrix, parts))
    lines.append(f"{_R[order - 1]} = {sums} = {numbers}" + (f" = {matrix(sum(parts))}" if order > 1 else ""))
    title, text = {
        1: (_("Twist"), _("The tip's linear and angular velocity are linear in the joint velocities.")),
        2: (_("Acceleration"), _("The product rule gives a second term: the Jacobian changes as the joints move.")),
        3: (
            _("Jerk"),
            _(
                "Differentiated once more. The middle term comes from both terms of the acceleration, so that its "
                "factor is 2."
            ),
        ),
        4: (_("Snap"), _("Once more: the factors are those of the binomial formula, 1, 3, 3, 1.")),
    }[order]
    return step(title, text, *lines)
