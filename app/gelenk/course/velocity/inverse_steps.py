"""The worked solution of an inverse velocity: the equation, its inverse by cases, J#, damping, null space, residual."""

import numpy as np

from gelenk.course.steps import Step, step
from gelenk.course.velocity.inverse_question import InverseQuestion
from gelenk.course.velocity.inverses import LectureInverse
from gelenk.course.velocity.null_space_steps import wish_steps
from gelenk.course.velocity.writing import largest, matrix, number, row
from gelenk.language import localised, translated as _


def pseudo_inverse_steps(inverse: LectureInverse) -> list[Step]:
    """Return the steps from J to J#, checked."""
    return [_inverse(inverse), _conditions(inverse)]


def _inverse(inverse: LectureInverse) -> Step:
    weighted = inverse.is_weighted and inverse.case in {"wide", "rank_deficient"}
    lines = [f"W = {matrix(np.diag(inverse.weights))}"] if weighted else []
    if inverse.by_singular_values:
        text, formulas = _by_singular_values(inverse, weighted=weighted)
    elif inverse.case == "square":
        text = _("The pseudo-inverse of a regular square matrix is its inverse.")
        formulas = [rf"\det J = {number(float(np.linalg.det(inverse.J)))}", r"J^{\#} = J^{-1}"]
    elif inverse.case == "wide":
        text, formulas = _right_inverse(inverse, weighted=weighted)
    else:
        text = _("The left inverse: of all joint motions the one with the least residual.")
        gram = rf"J^{{\mathsf T}} J = {matrix(inverse.J.T @ inverse.J)}"
        formulas = [gram, r"J^{\#} = (J^{\mathsf T} J)^{-1} J^{\mathsf T}"]
    formulas[-1] += f" = {matrix(inverse.pseudo_inverse)}"
    return step(_("The pseudo-inverse"), text, *lines, *formulas)


def _by_singular_values(inverse: LectureInverse, *, weighted: bool) -> tuple[str, list[str]]:
    text = _("By singular values: those that count are inverted, the others stay 0.")
    if inverse.case != "rank_deficient":
        text += " " + _("The matrix is so nearly singular that the formula of the case would lose digits.")
    scaled, front = (r"J W^{-\frac{1}{2}}", r"W^{-\frac{1}{2}} ") if weighted else ("J", "")
    return text, [
        rf"{scaled} = U \Sigma V^{{\mathsf T}},\quad \Sigma^{{\#}} = \mathrm{{diag}}{row(inverse.inverted_values)}",
        rf"J^{{\#}} = {front}V \Sigma^{{\#}} U^{{\mathsf T}}",
    ]


def _right_inverse(inverse: LectureInverse, *, weighted: bool) -> tuple[str, list[str]]:
    gram = inverse.J / inverse.weights @ inverse.J.T
    shown = rf"{matrix(gram)},\quad \det = {number(float(np.linalg.det(gram)))}"
    if not weighted:
        text = _("The right inverse: of all solutions the one with the least norm.")
        return text, [rf"J J^{{\mathsf T}} = {shown}", r"J^{\#} = J^{\mathsf T} (J J^{\mathsf T})^{-1}"]
    text = _("With weights: least is the sum of the weighted squares, so that a joint of larger weight moves less.")
    return text, [
        rf"J W^{{-1}} J^{{\mathsf T}} = {shown}",
        r"J^{\#}_W = W^{-1} J^{\mathsf T} (J W^{-1} J^{\mathsf T})^{-1}",
    ]


def _conditions(inverse: LectureInverse) -> Step:
    left = r"W J^{\#} J" if inverse.is_weighted else r"J^{\#} J"
    names = (
        r"J J^{\#} J - J",
        r"J^{\#} J J^{\#} - J^{\#}",
        rf"({left})^{{\mathsf T}} - {left}",
        r"(J J^{\#})^{\mathsf T} - J J^{\#}",
    )
    lines = [
        rf"\max \lvert {name} \rvert = {number(value)}"
        for name, value in zip(names, inverse.moore_penrose, strict=True)
    ]
    text = _("The four conditions of Moore and Penrose, which have one solution: what is left of each is rounding.")
    if inverse.is_weighted:
        text += " " + _("With weights the third one holds of W times the product.")
    return step(_("Check: Moore-Penrose"), text, *lines)


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


_B = ("v", r"\ddot r - \dot J \dot q", r"r^{(3)} - 2 \dot J \ddot q - \ddot J \dot q")
_V = ("v", r"\ddot r", "r^{(3)}")


def inverse_steps(question: InverseQuestion) -> list[Step]:
    """Return the worked solution."""
    steps = [_equation(question), _case(question)]
    if question.without_solution:
        return steps
    if not question.is_damped or question.wish is not None:
        steps += pseudo_inverse_steps(question.inverse)
        if question.inverse.J.shape[1] > question.inverse.rank:
            steps.append(_null_space(question))
    if question.is_damped:
        steps += damping_steps(question)
    if question.wish is not None:
        steps += wish_steps(question.wish, question.inverse.projector, question.inverse.J)
    return [*steps, _result(question)]


def _equation(question: InverseQuestion) -> Step:
    k, (x, v) = question.order - 1, question.symbols
    lines = [f"J = {matrix(question.inverse.J)}", f"{_V[k]} = {row(question.target)}", *question.known[1]]
    if k:
        lines.append(f"b = {_B[k]} = {row(question.b)}")
    lines.append(f"J {x} = {v}")
    text = (
        _("The tip's velocity is linear in the joint velocities.")
        if k == 0
        else _("What the known rates already make of it goes to the other side; the matrix is the same.")
    )
    if question.length is not None:
        scaled = _("Angular rows are multiplied by the length L = {length} m, so that all rows are in metres.")
        text += " " + scaled.format(length=localised(f"{question.length:.6g}"))
    elif question.mixes_units:
        text += " " + _(
            "Metres and radians are mixed: the lengths that are made least, and so the pseudo-inverse, depend on the "
            "unit of length."
        )
    return step(_("The equation"), text, *lines)


def _case(question: InverseQuestion) -> Step:
    inverse = question.inverse
    m, n = inverse.J.shape
    text = {
        "square": _("J is square and regular: there is exactly one solution."),
        "wide": _(
            "Fewer directions than joints, and full rank: there are infinitely many solutions, and the pseudo-inverse "
            "gives the shortest."
        ),
        "tall": _(
            "More directions than joints, and full rank: in general there is no solution, and the pseudo-inverse gives "
            "the least residual."
        ),
        "rank_deficient": _(
            "The rank is less than both numbers: a singular configuration. Of the least residual the pseudo-inverse "
            "gives the shortest solution, by the singular values that count."
        ),
    }[inverse.case]
    if question.without_solution:
        text = _("J⁻¹ does not exist: the matrix is singular here. The pseudo-inverse and damping give an answer.")
    matrix_name = r"J W^{-\frac{1}{2}}" if inverse.is_weighted else "J"
    shape = rf"m = {m},\quad n = {n},\quad \rho = \mathrm{{rank}}\, J = {inverse.rank}"
    return step(_("Which case"), text, shape, rf"\sigma({matrix_name}) = {row(inverse.factors[1])}")


def _null_space(question: InverseQuestion) -> Step:
    inverse, (x, v) = question.inverse, question.symbols
    n = inverse.J.shape[1]
    lines = [
        rf"\dim \ker J = n - \rho = {n - inverse.rank}",
        rf"P = I - J^{{\#}} J = {matrix(inverse.projector)}",
        rf"J P = 0,\quad {x} = J^{{\#}} {v} + P\, \xi",
    ]
    text = _("The projector onto the kernel of J: it lets through the joint motions that leave the tip as it is.")
    return step(_("Null space"), text, *lines)


def _result(question: InverseQuestion) -> Step:
    x, v = question.symbols
    found = question.solution()
    size = max(largest(question.target), largest(question.inverse.J) * largest(found))
    if question.wish is not None:
        text = _("The sum of both motions; the second one does not move the tip.")
    elif question.is_damped:
        text = _("The damped solution, and what the tip does not do of the wish.")
    else:
        text = _("The solution, and what the tip does not do of the wish.")
    name = r"J^{\#}" if not question.is_damped else r"J^{\#}_\lambda"
    first = (question.inverse.damped_inverse if question.is_damped else question.inverse.pseudo_inverse) @ question.b
    if question.wish is None:
        lines = [f"{x} = {name} {v} = {matrix(found)}"]
    else:
        added = question.wish.share * (question.inverse.projector @ question.wish.xi)
        lines = [rf"{x} = {name} {v} + P\, \xi = {matrix(first)} + {matrix(added, largest(first))} = {matrix(found)}"]
    lines.append(f"{v} - J {x} = {row(question.b - question.inverse.J @ found, size)}")
    return step(_("Result"), text, *lines)
