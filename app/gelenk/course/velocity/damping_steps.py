"""The worked solution of damped least squares: λ, what is made least, and the gains of the singular directions."""

import numpy as np

from gelenk.course.steps import Step, step
from gelenk.course.velocity.inverse_question import InverseQuestion
from gelenk.course.velocity.writing import matrix, number, row
from gelenk.language import localised, translated as _


def damping_steps(question: InverseQuestion) -> list[Step]:
    """Return the steps of a damped solution."""
    return [_damping(question), _damped(question), _gains(question)]


def _damping(question: InverseQuestion) -> Step:
    damping, threshold = question.inverse.damping, question.threshold
    lines = [rf"\lambda = {number(damping)}"]
    text = _("λ is the factor itself; others write λ² or μ² for the same number.")
    if threshold is not None:
        least = max(0.0, threshold**2 - float(question.inverse.factors[1][-1]) ** 2)
        lines = [rf"\max(0,\; \sigma_0^2 - \sigma_{{min}}^2) = {number(least)}", *lines]
        grown = _("It grows as the smallest singular value falls below σ_0 = {threshold}.")
        text += " " + grown.format(threshold=localised(f"{threshold:.6g}"))
        if damping > least * (1.0 + 1e-9):
            text += " " + _("A velocity limit asks for more.")
    return step(_("Damping"), text, *lines)


def _damped(question: InverseQuestion) -> Step:
    inverse, b, (x, v) = question.inverse, question.b, question.symbols
    solution = inverse.damped_inverse @ b
    if inverse.is_weighted:
        norm = rf"{x}^{{\mathsf T}} W {x}"
        inner = inverse.J.T @ inverse.J + inverse.damping * np.diag(inverse.weights)
        left = rf"J^{{\mathsf T}} J + \lambda W = {matrix(inner)}"
        rule = rf"(J^{{\mathsf T}} J + \lambda W)^{{-1}} J^{{\mathsf T}} {v}"
        error = rf"\lambda (J W^{{-1}} J^{{\mathsf T}} + \lambda I)^{{-1}} {v}"
    else:
        norm = rf"\lVert {x} \rVert^2"
        inner = inverse.J @ inverse.J.T + inverse.damping * np.eye(len(inverse.J))
        left = rf"J J^{{\mathsf T}} + \lambda I = {matrix(inner)}"
        rule = rf"J^{{\mathsf T}} (J J^{{\mathsf T}} + \lambda I)^{{-1}} {v} = "
        rule += rf"(J^{{\mathsf T}} J + \lambda I)^{{-1}} J^{{\mathsf T}} {v}"
        error = rf"\lambda (J J^{{\mathsf T}} + \lambda I)^{{-1}} {v}"
    text = _("The least sum of joint motion and residual: it stays small near a singularity, at the price of e.")
    return step(
        _("Damped least squares"),
        text,
        rf"\min\; \lambda {norm} + \lVert J {x} - {v} \rVert^2",
        left,
        f"{x} = {rule} = {row(solution)}",
        f"e = {v} - J {x} = {error} = {row(b - inverse.J @ solution)}",
        rf"\lambda {norm} + \lVert e \rVert^2 = {number(question.cost(solution))}",
    )


def _gains(question: InverseQuestion) -> Step:
    sigmas, damping = question.inverse.factors[1], question.inverse.damping
    lines = []
    for i, (sigma, gain) in enumerate(zip(sigmas, question.inverse.gains, strict=True), start=1):
        undamped = number(1.0 / sigma) if i <= question.inverse.rank else r"\infty"
        lines.append(
            rf"\frac{{\sigma_{{{i}}}}}{{\sigma_{{{i}}}^2 + \lambda}} = {number(gain)},\quad "
            rf"\frac{{1}}{{\sigma_{{{i}}}}} = {undamped}"
        )
    text = _("Damped and undamped factor of each singular direction; no damped one exceeds 1/(2√λ).")
    bound = rf"\frac{{1}}{{2 \sqrt{{\lambda}}}} = {number(0.5 / damping**0.5)}"
    return step(_("Gains"), text, *lines, bound)
