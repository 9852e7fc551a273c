"""The worked solution of manipulability: JJᵀ, its eigenvalues and axes, the ellipsoids and what is drawn from them."""

import math
from dataclasses import dataclass
from typing import Literal

import numpy as np

from gelenk.course.steps import Step, step
from gelenk.course.velocity.writing import matrix, number, row
from gelenk.language import translated as _
from gelenk.robot.arrays import Array


@dataclass(frozen=True, slots=True)
class EllipsoidQuestion:
    """The ellipsoids of one part of the tip's motion at one configuration.

    Attributes:
        J: The rows of the part, of which the angular ones are multiplied by a length in the combined part; (k, n).
        basis: Orthonormal directions in which the chain moves at all, as columns; shape (k, e).
        dimension: Number of axes of the ellipsoids.
        rank: Number of those that do not vanish.
        directions: Unit vectors u in these rows, for transmission ratios; shape (D, k).
    """

    part: Literal["translation", "rotation", "combined"]
    J: Array
    basis: Array
    dimension: int
    rank: int
    directions: Array

    @property
    def moving(self) -> Array:
        """J in the directions in which the chain moves at all; shape (e, n)."""
        return self.basis.T @ self.J

    def eigenvalues(self) -> tuple[Array, Array]:
        """Eigenvalues of JJᵀ, largest first, 0 where they vanish, and its axes as columns; shapes (d,), (k, d)."""
        values, vectors = np.linalg.eigh(self.moving @ self.moving.T)
        values, axes = values[::-1][: self.dimension], (self.basis @ vectors[:, ::-1])[:, : self.dimension]
        largest = axes[np.argmax(np.abs(axes), axis=0), np.arange(axes.shape[1])]
        counted = np.where(np.arange(len(values)) < self.rank, np.maximum(values, 0.0), 0.0)
        return counted, axes * np.where(largest < 0.0, -1.0, 1.0)


def ellipsoid_steps(question: EllipsoidQuestion) -> list[Step]:
    """Return the worked solution of one part."""
    if question.dimension == 0:
        text = _("The chain never moves in these directions: there is no ellipsoid.")
        return [step(_title(question), text, f"J = {matrix(question.J)}")]
    values, axes = question.eigenvalues()
    steps = [_matrix(question), _axes(values, axes), _measures(question, np.sqrt(values))]
    return steps + [_transmission(question, u) for u in question.directions]


def _title(question: EllipsoidQuestion) -> str:
    return {
        "translation": _("Translation: the matrix of the ellipsoid"),
        "rotation": _("Rotation: the matrix of the ellipsoid"),
        "combined": _("Both together: the matrix of the ellipsoid"),
    }[question.part]


def _matrix(question: EllipsoidQuestion) -> Step:
    J = question.J
    text = _(
        "Joint velocities of norm one fill the unit ball; J maps it to the velocity ellipsoid. By duality the force "
        "ellipsoid has the inverse matrix."
    )
    return step(
        _title(question),
        text,
        f"J = {matrix(J)}",
        rf"J J^{{\mathsf T}} = {matrix(J @ J.T)}",
        r"v^{\mathsf T} (J J^{\mathsf T})^{\#} v = 1,\quad F^{\mathsf T} J J^{\mathsf T} F = 1",
    )


def _axes(values: Array, axes: Array) -> Step:
    lines = []
    for i, (value, axis) in enumerate(zip(values.tolist(), axes.T, strict=True), start=1):
        sigma = math.sqrt(value)
        inverse = number(1.0 / sigma) if sigma > 0.0 else r"\infty"
        lines.append(
            rf"\lambda_{{{i}}} = {number(value)},\quad u_{{{i}}} = {row(axis)},\quad \sigma_{{{i}}} = "
            rf"\sqrt{{\lambda_{{{i}}}}} = {number(sigma)},\quad \frac{{1}}{{\sigma_{{{i}}}}} = {inverse}"
        )
    text = _(
        "The eigenvectors are the axes of both ellipsoids. The semi-axes of the velocity ellipsoid are the roots of "
        "the eigenvalues, those of the force ellipsoid their reciprocals: the tip is strong where it is slow."
    )
    if not all(values):
        text += " " + _("A velocity axis of 0 is a lost direction: a force along it needs no torque.")
    return step(_("Eigenvalues and axes"), text, r"\det(J J^{\mathsf T} - \lambda I) = 0", *lines)


def _measures(question: EllipsoidQuestion, sigmas: Array) -> Step:
    product = r" \cdot ".join(map(number, sigmas))
    w = float(np.prod(sigmas))
    whole = question.dimension == len(question.J)
    root = r"\sqrt{\det(J J^{\mathsf T})} = " if whole else ""
    lines = [rf"w = {root}\prod \sigma_i = {product}" + (f" = {number(w)}" if len(sigmas) > 1 else "")]
    if len(sigmas) == 2:
        lines.append(rf"A = \pi w = {number(math.pi * w)}")
    elif len(sigmas) == 3:
        lines.append(rf"V = \frac{{4}}{{3}} \pi w = {number(4.0 / 3.0 * math.pi * w)}")
    if sigmas[-1] > 0.0:
        ratio = rf"\frac{{{number(sigmas[0])}}}{{{number(sigmas[-1])}}} = {number(sigmas[0] / sigmas[-1])}"
        lines.append(rf"\mathrm{{cond}} = \frac{{\sigma_{{max}}}}{{\sigma_{{min}}}} = {ratio}")
    if sigmas[0] > 0.0:
        lines.append(rf"\frac{{\sigma_{{min}}}}{{\sigma_{{max}}}} = {number(sigmas[-1] / sigmas[0])}")
    text = _("Yoshikawa's measure, the size of the velocity ellipsoid, its condition number and its isotropy.")
    if not whole:
        text += " " + _("The product is over the directions in which the chain moves at all.")
    return step(_("Measures"), text, *lines)


def _transmission(question: EllipsoidQuestion, u: Array) -> Step:
    values, axes = question.eigenvalues()
    shares = axes.T @ u
    reached = bool(np.linalg.norm(u - axes[:, values > 0.0] @ shares[values > 0.0]) < 1e-9)
    needed = float(u @ question.J @ question.J.T @ u)
    lines = [rf"u = {row(u)}"]
    if reached:
        inner = float((np.square(shares[values > 0.0]) / values[values > 0.0]).sum())
        lines.append(
            rf"u^{{\mathsf T}} (J J^{{\mathsf T}})^{{\#}} u = {number(inner)},\quad \beta_v = \left( u^{{\mathsf T}} "
            rf"(J J^{{\mathsf T}})^{{\#}} u \right)^{{-\frac{{1}}{{2}}}} = {number(inner**-0.5)}"
        )
    else:
        lines.append(r"\beta_v = 0")
    if needed > 1e-28 * float(values[0]):
        lines.append(
            rf"u^{{\mathsf T}} J J^{{\mathsf T}} u = {number(needed)},\quad \beta_F = \left( u^{{\mathsf T}} "
            rf"J J^{{\mathsf T}} u \right)^{{-\frac{{1}}{{2}}}} = {number(needed**-0.5)}"
        )
    else:
        lines.append(r"\beta_F = \infty")
    text = _("How far the velocity ellipsoid (β_v) and the force ellipsoid (β_F) reach along u.")
    if not reached:
        text += " " + _("The tip cannot move along u alone.")
    return step(_("Transmission ratios"), text, *lines)
