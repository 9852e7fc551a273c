"""The worked solution of J#: the formula of each case, and the four conditions of Moore and Penrose."""

import numpy as np

from gelenk.course.steps import Step, step
from gelenk.course.velocity.inverses import LectureInverse
from gelenk.course.velocity.writing import matrix, number, row
from gelenk.language import translated as _


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
