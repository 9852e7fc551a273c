"""The worked solution of a singularity: the determinant, the rank, and what is lost and gained where it drops."""

from dataclasses import dataclass

import numpy as np

from gelenk.course.steps import Step, step
from gelenk.course.writing import matrix, number, vector
from gelenk.language import marked, translated as _
from gelenk.robot.arrays import Array

_DIRECTIONS = {"x": "v_x", "y": "v_y", "z": "v_z", "rx": r"\omega_x", "ry": r"\omega_y", "rz": r"\omega_z"}
_KINDS = {
    "wrist": marked("Wrist: two of its axes lie on one line."),
    "elbow": marked("Elbow: the arm is stretched or folded, and cannot move along its own direction."),
    "shoulder": marked("Shoulder: the first joint cannot move the wrist out of the plane of the arm."),
}


@dataclass(frozen=True, slots=True)
class SingularityQuestion:
    """A configuration, and the rows of its Jacobian that count.

    Attributes:
        directions: Names of the rows, from `x y z rx ry rz`.
        J: Shape (m, n), [m or rad] per [rad or m].
        rank: Number of singular values that count here, and at nearly every configuration.
        structural_rank: The same at nearly every configuration.
        lost: Directions in the rows that the tip lacks, those that it lacks only here first; shape (m, m - rank).
        internal: Joint velocities that leave the tip at rest, those that do so only here first; shape (n, n - rank).
        kinds: Names of the singularity, from `wrist`, `elbow` and `shoulder`.
        length: What the angular rows of J were multiplied by, [m]; None if they were not.
    """

    directions: tuple[str, ...]
    J: Array
    rank: int
    structural_rank: int
    lost: Array
    internal: Array
    kinds: tuple[str, ...]
    length: float | None = None

    @property
    def defect(self) -> int:
        """Number of directions lost here that the arm has elsewhere."""
        return self.structural_rank - self.rank


def singularity_steps(question: SingularityQuestion, factored: list[Step]) -> list[Step]:
    """Return the worked solution; `factored` are the steps of the determinant in symbols, if there are any."""
    steps = [_jacobian(question), *factored, _determinant(question), _rank(question)]
    if question.rank < len(question.J):
        steps.append(_lost(question))
    if question.rank < question.J.shape[1]:
        steps.append(_internal(question))
    return steps


def _jacobian(question: SingularityQuestion) -> Step:
    rows = r",\; ".join(_DIRECTIONS[name] for name in question.directions)
    text = _("The rows that count, and a column for each joint. A configuration is singular where their rank drops.")
    lines = [rf"({rows})^{{\mathsf T}} = J(q)\, \dot q,\quad J = {matrix(question.J)}"]
    if question.length is not None:
        text += " " + _("The length L times an angle is a length: the angular rows are multiplied by it.")
        lines.append(f"L = {number(question.length)}")
    return step(_("The Jacobian"), text, *lines)


def _determinant(question: SingularityQuestion) -> Step:
    J, (m, n) = question.J, question.J.shape
    sigmas = np.linalg.svd(J, compute_uv=False)
    product = rf"\prod_i \sigma_i = {number(float(np.prod(sigmas)))}"
    if m == n:
        text = _("J is square: it is singular where its determinant vanishes, whose size is the product of the σ.")
        lines = [rf"\det J = {number(float(np.linalg.det(J)))},\quad \lvert\det J\rvert = {product}"]
    else:
        form, G = (r"J J^{\mathsf T}", J @ J.T) if m < n else (r"J^{\mathsf T} J", J.T @ J)
        text = _("J is not square: the smaller product with its transpose is, and has no inverse where the rank drops.")
        value = number(float(np.linalg.det(G)))
        lines = [f"{form} = {matrix(G)}", rf"\det({form}) = {value},\quad \sqrt{{\det({form})}} = {product}"]
    if question.structural_rank < min(m, n):
        text += " " + _("It vanishes at every configuration, as the arm never has all of these directions.")
    return step(_("Determinant at this configuration"), text, *lines)


def _rank(question: SingularityQuestion) -> Step:
    sigmas = np.linalg.svd(question.J, compute_uv=False)
    rank, most = question.rank, question.structural_rank
    lines = [rf"\sigma(J) = {vector(sigmas)}", rf"\rho = \mathrm{{rank}}\, J = {rank},\quad \rho_{{max}} = {most}"]
    if question.defect:
        text = _("The rank is below the one that the arm has at nearly every configuration: this one is singular.")
    elif most == 0:
        text = _("The arm moves in none of these directions at any configuration: there is nothing to lose.")
    else:
        text = _("The rank is the largest that the arm has anywhere: this configuration is regular.")
        lines.append(rf"\sigma_{{{most}}} = {number(float(sigmas[most - 1]))} > 0")
    return step(_("Rank"), " ".join((text, *(_(_KINDS[kind]) for kind in question.kinds))), *lines)


def _lost(question: SingularityQuestion) -> Step:
    text = _("Every column of J is orthogonal to such a direction: no joint moves the tip along it.")
    if question.defect == 0:
        text += " " + _("A direction like it is missing at every configuration.")
    elif question.defect < question.lost.shape[1]:
        more = _("Lost here: the first {here}; a direction like one of the others is missing at every configuration.")
        text += " " + more.format(here=question.defect)
    lines = [r"u^{\mathsf T} J = 0"]
    for k, u in enumerate(question.lost.T, start=1):
        product = rf"u_{{{k}}}^{{\mathsf T}} J = {vector(u @ question.J)}"
        lines.append(rf"u_{{{k}}} = {vector(u)},\quad {product}")
    return step(_("Lost directions"), text, *lines)


def _internal(question: SingularityQuestion) -> Step:
    text = _("These joint velocities leave the tip at rest: the columns of J are dependent.")
    if question.defect == 0:
        text += " " + _("The arm is redundant: it has as many everywhere.")
    elif question.defect < question.internal.shape[1]:
        more = _("Only here: the first {here}; the arm is redundant, and has as many as the others everywhere.")
        text += " " + more.format(here=question.defect)
    lines = [r"J\, \dot q = 0"]
    for k, motion in enumerate(question.internal.T, start=1):
        lines.append(rf"\dot q_{{({k})}} = {vector(motion)},\quad J\, \dot q_{{({k})}} = {vector(question.J @ motion)}")
    return step(_("Internal motions"), text, *lines)
