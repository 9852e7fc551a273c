"""The worked solution of statics: torques by lever arms, virtual work, wrenches of torques, the four subspaces."""

from dataclasses import dataclass

import numpy as np

from gelenk.course.steps import Step, step
from gelenk.course.velocity.geometry import ChainGeometry
from gelenk.course.velocity.writing import largest, matrix, number, row, summand
from gelenk.language import translated as _
from gelenk.robot.arrays import Array, Indices


@dataclass(frozen=True, slots=True)
class StaticsQuestion:
    """A chain at rest under a wrench at its tip.

    Attributes:
        J: The rows that count, in the axes and at the point of the wrench; shape (m, n).
        rank: Of J.
        point: Where the wrench acts, in the base's axes; shape (3,), [m].
        axes: Axes of the wrench in the base, as columns; shape (3, 3).
        rows: Indices of the components that count, of six.
        wrench: γ, as given or found; shape (m,), [N] and [N m]. None without one.
        torques: τ of the motors; shape (n,), [N m or N].
        weight: g(q), None where the weight is left out; shape (n,).
        wants_wrench: Whether torques were given and γ found.
    """

    geometry: ChainGeometry
    J: Array
    rank: int
    point: Array
    axes: Array
    rows: Indices
    wrench: Array | None
    torques: Array
    weight: Array | None = None
    wants_wrench: bool = False

    @property
    def in_base(self) -> Array:
        """The wrench in the base's axes, all six components."""
        full = np.zeros(6)
        full[self.rows] = 0.0 if self.wrench is None else self.wrench
        return np.concatenate((self.axes @ full[:3], self.axes @ full[3:]))


def statics_steps(question: StaticsQuestion) -> list[Step]:
    """Return the worked solution; without a wrench that of the weight and the subspaces alone."""
    steps = []
    if question.wants_wrench:
        steps.append(_wrench(question))
    if question.wrench is not None:
        steps += [_levers(question), _torques(question), _virtual_work(question)]
    elif question.weight is not None:
        text = _("Without a wrench the motors hold the weight alone.")
        steps.append(step(_("Torques"), text, rf"\tau = g(q) = {row(question.weight)}"))
    return [*steps, _subspaces(question)]


def _levers(question: StaticsQuestion) -> Step:
    force, moment = np.split(question.in_base, 2)
    reach = 1.0 + largest(question.point)
    lines = [rf"F = {row(force)},\quad M = {row(moment)}"]
    for i, joint in enumerate(question.geometry.joints):
        name, factor = rf"\tau_{{{joint.variable + 1}}}", ""
        if joint.rate != 1.0:
            name, factor = rf"\Delta {name}", f"{number(joint.rate)} "
        if joint.slides:
            value = joint.rate * float(force @ joint.axis)
            lines.append(rf"{name} = {factor}F^{{\mathsf T}} z_{{{i}}} = {number(value)}")
            continue
        arm = np.cross(joint.axis, question.point - joint.origin)
        size = reach * largest(force, moment)
        first, second = _rounded(float(force @ arm), size), _rounded(float(moment @ joint.axis), size)
        product = rf"F^{{\mathsf T}} (z_{{{i}}} \times p_{{{i},EE}}) + M^{{\mathsf T}} z_{{{i}}}"
        numbers = rf"\left({number(first)} + {summand(second)}\right) = {number(joint.rate * (first + second))}"
        lines.append(rf"z_{{{i}}} \times p_{{{i},EE}} = {row(arm, reach)}")
        lines.append(rf"{name} = {factor}\left({product}\right) = {factor}{numbers}")
    text = _(
        "Each column of J is a lever arm: the torque about a joint is the force times the column's linear part and the "
        "moment times its angular part. The wrench is written in the base's axes, the arm leads to where it acts."
    )
    return step(_("Lever arms"), text, *lines)


def _rounded(value: float, beside: float) -> float:
    return 0.0 if abs(value) <= 1e-13 * beside else value


def _torques(question: StaticsQuestion) -> Step:
    torques = question.J.T @ _given(question)
    lines = [
        rf"J^{{\mathsf T}} = {matrix(question.J.T)}",
        rf"J^{{\mathsf T}} \gamma = J^{{\mathsf T}} {matrix(_given(question))} = {row(torques)}",
    ]
    text = _("The same for all joints at once.")
    if question.weight is not None:
        numbers = f"{row(torques)} + {row(question.weight)} = {row(torques + question.weight)}"
        lines.append(rf"\tau = J^{{\mathsf T}} \gamma + g(q) = {numbers}")
        text += " " + _("The motors hold the weight too.")
    return step(_("Torques"), text, *lines)


def _given(question: StaticsQuestion) -> Array:
    return np.zeros(len(question.rows)) if question.wrench is None else question.wrench


def _virtual_work(question: StaticsQuestion) -> Step:
    turn = np.ones(question.J.shape[1])
    moved = question.J @ turn
    torques, wrench = question.J.T @ _given(question), _given(question)
    text = _(
        "A small motion of the joints costs the motors the work that the tip does on its surroundings, dW = F dx. Here "
        "each joint moves by the same amount."
    )
    return step(
        _("Check: virtual work"),
        text,
        r"\tau^{\mathsf T} \delta q = \gamma^{\mathsf T} J\, \delta q",
        rf"\delta q = {row(turn)},\quad J\, \delta q = {row(moved)}",
        rf"(J^{{\mathsf T}} \gamma)^{{\mathsf T}} \delta q = {number(float(torques @ turn))},\quad "
        rf"\gamma^{{\mathsf T}} (J\, \delta q) = {number(float(wrench @ moved))}",
    )


def _wrench(question: StaticsQuestion) -> Step:
    weight = np.zeros_like(question.torques) if question.weight is None else question.weight
    wanted = question.torques - weight
    m, n = question.J.shape
    gamma = _given(question)
    left = wanted - question.J.T @ gamma
    difference = r"\tau" if question.weight is None else r"(\tau - g)"
    lines = [] if question.weight is None else [rf"\tau - g = {row(wanted)}"]
    if question.rank == m == n:
        text = _("J is square and regular: the torques determine the wrench.")
        lines.append(rf"\gamma = J^{{-\mathsf T}} {difference} = {row(gamma)}")
    else:
        text = _("J has no inverse here: the pseudo-inverse gives the least residual, and of those wrenches the least.")
        lines.append(rf"\gamma = (J^{{\mathsf T}})^{{\#}} {difference} = {row(gamma)}")
    lines.append(rf"{difference} - J^{{\mathsf T}} \gamma = {row(left, largest(wanted))}")
    return step(_("The wrench of given torques"), text, *lines)


def _subspaces(question: StaticsQuestion) -> Step:
    J, rank = question.J, question.rank
    m, n = J.shape
    left, sigmas, right = np.linalg.svd(J)
    names = (
        (r"\mathrm{range}(J)", left[:, :rank].T),
        (r"\ker(J^{\mathsf T})", left[:, rank:].T),
        (r"\mathrm{range}(J^{\mathsf T})", right[:rank]),
        (r"\ker(J)", right[rank:]),
    )
    spans = [rf"{name} = {_span(basis)},\quad \dim = {len(basis)}" for name, basis in names]
    dims = rf"{rank} + {m - rank} = {m}", rf"{rank} + {n - rank} = {n}"
    text = _(
        "By the singular vectors of J. Each pair is orthogonal, and its sum is direct: velocities that the tip can "
        "have and wrenches that need no torque; torques that a wrench balances and joint velocities that leave the tip "
        "at rest."
    )
    return step(
        _("The four subspaces"),
        text,
        rf"\sigma(J) = {row(sigmas)},\quad \rho = {rank}",
        *spans,
        rf"\mathrm{{range}}(J) \oplus \ker(J^{{\mathsf T}}) = \mathbb{{R}}^{{{m}}},\quad {dims[0]}",
        rf"\mathrm{{range}}(J^{{\mathsf T}}) \oplus \ker(J) = \mathbb{{R}}^{{{n}}},\quad {dims[1]}",
    )


def _span(basis: Array) -> str:
    return rf"\mathrm{{span}}\{{{', '.join(map(row, basis))}\}}" if len(basis) else r"\{0\}"
