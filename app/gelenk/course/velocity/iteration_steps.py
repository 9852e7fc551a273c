"""The worked solution of an iteration for inverse kinematics: the first turns by hand, all of them as a table."""

from collections.abc import Sequence
from dataclasses import dataclass

import numpy as np

from gelenk.course.steps import Step, step, table
from gelenk.course.velocity.writing import matrix, number, row
from gelenk.language import translated as _
from gelenk.robot.arrays import Array

_WORKED = 3
"""Iterations that are worked out; the table has all."""
_FAR = 1e-4
"""‖e‖ of an iteration that has not arrived, [m, rad]."""
_RESTING = 1e-6
"""Of ‖Jᵀe‖ / ‖e‖, [m]."""


@dataclass(frozen=True, slots=True)
class IterationTurn:
    """One configuration of an iteration.

    Attributes:
        number: Its place in the iteration, from 0.
        q: Configuration; shape (n,), [rad or m].
        e, J: Residual r - F(q) and Jacobian in the directions that count; shapes (m,) and (m, n).
        step: Δq from here; shape (n,), [rad or m]. None at the last, and where the next is not reported.
        method: `newton`, `gradient` or `damped_least_squares`, None at the last.
    """

    number: int
    q: Array
    e: Array
    J: Array
    step: Array | None
    method: str | None

    @property
    def error(self) -> float:
        """‖e‖."""
        return float(np.linalg.norm(self.e))


def iteration_steps(turns: Sequence[IterationTurn], total: int, *, given_step_size: bool) -> list[Step]:
    """Return the rule of each method, the first turns worked out, and the table of those given of all `total`."""
    methods = [method for method in dict.fromkeys(turn.method for turn in turns) if method is not None]
    rules = [_rule(method, turns[-1], given_step_size=given_step_size) for method in methods]
    worked = [_worked(turn, turn.step) for turn in turns[:_WORKED] if turn.step is not None]
    return [*rules, *worked, *_rest(turns[-1]), _table(turns, total)]


def _rule(method: str, last: IterationTurn, *, given_step_size: bool) -> Step:
    if method == "gradient":
        return _gradient_rule(last, given_step_size=given_step_size)
    if method == "damped_least_squares":
        rule = r"q_{k+1} = q_k + J^{\mathsf T} (J J^{\mathsf T} + \lambda I)^{-1} (r - F(q_k))"
        text = _("Newton's step with damping, which keeps it short near singularities.")
        return step(_("Damped least squares"), text, rule)
    square = last.J.shape[0] == last.J.shape[1]
    text = _(
        "F is replaced by its tangent: near the target the error is squared with every step, near a singularity a step "
        "grows beyond all bounds."
    )
    if not square:
        text += " " + _("J is not square, so that its pseudo-inverse takes the place of the inverse.")
    inverse = "-1" if square else r"\#"
    rule = rf"q_{{k+1}} = q_k + J^{{{inverse}}}(q_k) (r - F(q_k))"
    return step(_("Newton's method"), text, r"F(q) \approx F(q_k) + J(q_k) (q - q_k)", rule)


def _gradient_rule(last: IterationTurn, *, given_step_size: bool) -> Step:
    lines = [
        r"H(q) = \frac{1}{2} \lVert r - F(q) \rVert^2,\quad \nabla H = -J^{\mathsf T}(q) (r - F(q))",
        r"q_{k+1} = q_k + \alpha\, J^{\mathsf T}(q_k) (r - F(q_k))",
    ]
    text = _("Down the steepest slope of H, half the square of the residual. It rests wherever the slope is 0.")
    largest = float(np.linalg.svd(last.J, compute_uv=False)[:1].sum())
    if not given_step_size:
        text += " " + _("A line search chooses α so that the residual falls.")
    elif largest > 0.0:
        text += " " + _("With a constant α it converges only below a bound, taken here at the last configuration.")
        lines.append(rf"\alpha < \frac{{2}}{{\sigma_{{max}}^2(J)}} = {number(2.0 / largest**2)}")
    return step(_("Gradient method"), text, *lines)


def _worked(turn: IterationTurn, delta: Array) -> Step:
    k, slope = turn.number, turn.J.T @ turn.e
    lines = [
        rf"q_{{{k}}} = {row(turn.q)}",
        rf"e_{{{k}}} = r - F(q_{{{k}}}) = {row(turn.e)},\quad \lVert e_{{{k}}} \rVert = {number(turn.error)}",
        rf"J(q_{{{k}}}) = {matrix(turn.J)}",
    ]
    if turn.method == "gradient":
        alpha = float(slope @ delta) / max(float(slope @ slope), 1e-300)
        lines.append(rf"J^{{\mathsf T}} e_{{{k}}} = {row(slope)},\quad \alpha = {number(alpha)}")
    elif turn.method == "newton" and turn.J.shape[0] == turn.J.shape[1]:
        lines.append(rf"\det J(q_{{{k}}}) = {number(float(np.linalg.det(turn.J)))}")
    lines.append(rf"\Delta q_{{{k}}} = {row(delta)}")
    lines.append(rf"q_{{{k + 1}}} = q_{{{k}}} + \Delta q_{{{k}}} = {row(turn.q + delta)}")
    text = _("Residual, Jacobian and step at configuration {k}.").format(k=k)
    return step(_("Iteration {k}").format(k=k + 1), text, *lines)


def _rest(last: IterationTurn) -> list[Step]:
    """Return the step for an iteration that ends away from its target, where the error is in ker Jᵀ."""
    slope = last.J.T @ last.e
    if last.error <= _FAR or float(np.linalg.norm(slope)) > _RESTING * last.error:
        return []
    text = _(
        "Here the residual is in the kernel of Jᵀ: no motion of the joints makes it smaller, and every method that "
        "steps along Jᵀ e rests, though e is not 0."
    )
    k = last.number
    errors = rf"e_{{{k}}} = {row(last.e)},\quad J^{{\mathsf T}} e_{{{k}}} \approx 0"
    return [step(_("Where it rests"), text, rf"J(q_{{{k}}}) = {matrix(last.J)}", errors)]


def _table(turns: Sequence[IterationTurn], total: int) -> Step:
    head = ["k", *(f"q_{{{i + 1}}}" for i in range(len(turns[0].q))), r"\lVert e \rVert", r"\lVert \Delta q \rVert"]
    lines = []
    for turn in turns:
        length = "" if turn.step is None else number(float(np.linalg.norm(turn.step)))
        lines.append([str(turn.number), *map(number, turn.q), number(turn.error), length])
    text = _("All configurations of the iteration.")
    if len(turns) < total:
        text = _("The first configurations of the iteration, and the last one.")
    return step(_("Table of the iteration"), text, table(head, lines, "r" * len(head)))
