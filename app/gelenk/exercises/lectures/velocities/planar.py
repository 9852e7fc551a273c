"""Planar arms: the Jacobian of two links, its inverse and damped inverse, and the pseudo-inverse of three links."""

from typing import Annotated, NamedTuple

import numpy as np

from gelenk.course.steps import Step, step
from gelenk.course.velocity.inverse_question import InverseQuestion
from gelenk.course.velocity.inverse_steps import inverse_steps
from gelenk.course.velocity.inverses import LectureInverse
from gelenk.course.velocity.jacobian_steps import JacobianQuestion, jacobian_steps
from gelenk.course.velocity.null_space_steps import NullSpaceWish, wish_steps
from gelenk.course.velocity.tip_motion_steps import tip_motion_steps
from gelenk.course.velocity.writing import matrix as written, number
from gelenk.exercises.arms import angles_not_summed, jacobian, misread, own_links, planar_picture, posture
from gelenk.exercises.draw import Draw, drawn
from gelenk.exercises.exercise import Answers, Exercise
from gelenk.exercises.fields import basis, matrix, quantity, vector
from gelenk.language import marked, translated as _
from gelenk.robot.arrays import Array


class TwoLinkRates(NamedTuple):
    """An arm whose joints move; angles in degrees, velocities in rad/s."""

    l1: Annotated[float, Draw.decimal, 0.3, 1.0, 0.1]
    l2: Annotated[float, Draw.decimal, 0.2, 0.8, 0.1]
    q1: Annotated[float, Draw.signed, 10.0, 80.0, 5.0]
    q2: Annotated[float, Draw.signed, 30.0, 130.0, 5.0]
    rate1: Annotated[float, Draw.signed, 0.2, 2.0, 0.1]
    rate2: Annotated[float, Draw.signed, 0.2, 2.0, 0.1]


class TwoLinkWish(NamedTuple):
    """An arm whose tip is to move, angles in degrees, velocities in m/s."""

    l1: Annotated[float, Draw.decimal, 0.3, 1.0, 0.1]
    l2: Annotated[float, Draw.decimal, 0.2, 0.8, 0.1]
    q1: Annotated[float, Draw.signed, 10.0, 80.0, 5.0]
    q2: Annotated[float, Draw.signed, 30.0, 130.0, 5.0]
    x_rate: Annotated[float, Draw.signed, 0.1, 0.5, 0.05]
    y_rate: Annotated[float, Draw.signed, 0.1, 0.5, 0.05]

    @property
    def velocity(self) -> Array:
        """Velocity of the tip."""
        return np.array([self.x_rate, self.y_rate])


def picked_steps(arm: NamedTuple) -> list[Step]:
    """Return the derivation of J of a planar arm, and the rows that count in the plane."""
    geometry, J = posture(arm), jacobian(arm)
    lines = [f"J = {written(J)}"]
    if J.shape == (2, 2):
        lines.append(rf"\det J = l_1 l_2 \sin\vartheta_2 = {number(float(np.linalg.det(J)))}")
    text = _("In the plane the tip has two components of velocity; of the angular velocity only ω_z is not zero.")
    plane = step(_("The rows of the plane"), text, *lines)
    return [*jacobian_steps(JacobianQuestion(geometry, "local_world_aligned", np.zeros(3), 1e-10)), plane]


def _jacobian_answers(one: TwoLinkRates, J: Array) -> Answers:
    return {"jacobian": J, "determinant": float(np.linalg.det(J)), "velocity": J @ one[4:]}


JACOBIAN = Exercise(
    id="velocities.two_links",
    title=marked("The Jacobian of two links"),
    difficulty=1,
    draw=drawn(TwoLinkRates),
    is_degenerate=lambda one: float(np.abs(jacobian(one) @ one[4:]).max()) < 0.1,
    text=lambda one: _(
        "A planar arm has two revolute joints and links of l₁ = {l1:g} m and l₂ = {l2:g} m. It stands at ϑ₁ = "
        "{q1:g}°, ϑ₂ = {q2:g}° (standard DH: ϑ₂ is counted from the first link). Find the Jacobian of the position "
        "(x, y) of the tip, its determinant, and the velocity of the tip when the joints turn at {rate1:g} rad/s and "
        "{rate2:g} rad/s."
    ).format(**one._asdict()),
    fields=lambda _one: (
        matrix("jacobian", _("Jacobian J of (x, y)"), (2, 2), "m"),
        quantity("determinant", _("Determinant of J"), "m²"),
        vector("velocity", _("Velocity of the tip (v_x, v_y)"), 2, "m/s"),
    ),
    solve=lambda one: _jacobian_answers(one, jacobian(one)),
    steps=lambda one: [*picked_steps(one), *tip_motion_steps([jacobian(one)], np.array([one[4:]]))],
    wrong={
        "angle_not_summed": lambda one: _jacobian_answers(one, angles_not_summed(one)),
        "calculator_mode": misread,
        "own_link_only": lambda one: {"jacobian": own_links(one), "velocity": own_links(one) @ one[4:]},
        "minus_of_cosine": lambda one: _jacobian_answers(one, np.diag([-1.0, 1.0]) @ jacobian(one)),
        "transpose_for_jacobian": lambda one: {"velocity": jacobian(one).T @ one[4:]},
    },
    picture=planar_picture,
)


def _inverse_answers(one: TwoLinkWish, J: Array) -> Answers:
    return {"determinant": float(np.linalg.det(J)), "rates": np.linalg.solve(J, one.velocity)}


def _by_adjugate(one: TwoLinkWish, *, is_signed: bool, is_divided: bool) -> Answers:
    """Return the joint velocities by the exchanged elements, with or without the changed signs and the division."""
    J = jacobian(one)
    (a, b), (c, d) = J.tolist()
    adjugate = np.array([[d, -b], [-c, a]] if is_signed else [[d, b], [c, a]])
    return {"rates": adjugate @ one.velocity / (np.linalg.det(J) if is_divided else 1.0)}


def question_of(J: Array, v: Array, damping: float = 0.0) -> InverseQuestion:
    """Return the question how the joints have to move, exactly or damped; J has full rank."""
    inverse = LectureInverse(J, min(J.shape), np.ones(J.shape[1]), damping)
    return InverseQuestion(inverse, "damped" if damping else "pseudo_inverse", v, (np.zeros(len(v)), []))


INVERSE = Exercise(
    id="velocities.inverse",
    title=marked("Joint velocities of two links"),
    difficulty=2,
    draw=drawn(TwoLinkWish),
    text=lambda one: _(
        "A planar arm has two revolute joints and links of l₁ = {l1:g} m and l₂ = {l2:g} m, and stands at ϑ₁ = "
        "{q1:g}°, ϑ₂ = {q2:g}° (counted from the first link). Its tip is to move at v = ({x_rate:g}, {y_rate:g}) "
        "m/s. Find the determinant of the Jacobian of (x, y), and the joint velocities."
    ).format(**one._asdict()),
    fields=lambda _one: (
        quantity("determinant", _("Determinant of J"), "m²"),
        vector("rates", _("Joint velocities"), 2, "rad/s", 2.0),
    ),
    solve=lambda one: _inverse_answers(one, jacobian(one)),
    steps=lambda one: [*picked_steps(one), *inverse_steps(question_of(jacobian(one), one.velocity))],
    wrong={
        "angle_not_summed": lambda one: _inverse_answers(one, angles_not_summed(one)),
        "calculator_mode": misread,
        "transpose_for_inverse": lambda one: {"rates": jacobian(one).T @ one.velocity},
        "direct_for_inverse": lambda one: {"rates": jacobian(one) @ one.velocity},
        "determinant_forgotten": lambda one: _by_adjugate(one, is_signed=True, is_divided=False),
        "cofactor_signs": lambda one: _by_adjugate(one, is_signed=False, is_divided=True),
    },
    picture=planar_picture,
)


class DampedWish(NamedTuple):
    """A nearly stretched arm whose tip is to move; angles in degrees, velocities in m/s."""

    l1: float
    l2: float
    q1: float
    q2: float
    x_rate: float
    y_rate: float
    damping: float

    @property
    def velocity(self) -> Array:
        """Velocity of the tip."""
        return np.array([self.x_rate, self.y_rate])


def _draw_damped(draw: Draw) -> DampedWish:
    lengths = draw.decimal(0.3, 1.0, 0.1), draw.decimal(0.2, 0.8, 0.1)
    first, _unused = draw.signed(10.0, 80.0, 5.0), draw.signed(30.0, 130.0, 5.0)  # drawn, so that numbers stay the same
    bend, wish = draw.signed(1.0, 8.0, 0.5), (draw.signed(0.1, 0.5, 0.05), draw.signed(0.1, 0.5, 0.05))
    return DampedWish(*lengths, first, bend, *wish, draw.choice((0.01, 0.02, 0.04, 0.05)))


def _damped_answers(one: DampedWish, J: Array) -> Answers:
    question = question_of(J, one.velocity, one.damping)
    return {"rates": question.solution(), "error": question.b - J @ question.solution()}


DAMPED = Exercise(
    id="velocities.damped",
    title=marked("Damped least squares near a singularity"),
    difficulty=3,
    draw=_draw_damped,
    is_degenerate=lambda one: any(
        float(np.abs(answer).max()) < 0.02 for answer in _damped_answers(one, jacobian(one)).values()
    ),
    text=lambda one: _(
        "A planar arm of two revolute joints, with links of l₁ = {l1:g} m and l₂ = {l2:g} m, is nearly stretched: ϑ₁ "
        "= {q1:g}°, ϑ₂ = {q2:g}°. Its tip is to move at v = ({x_rate:g}, {y_rate:g}) m/s. Find the joint velocities "
        "that make λ‖q̇‖² + ‖J q̇ - v‖² least, with λ = {damping:g}, and the error e = v - J q̇ that remains."
    ).format(**one._asdict()),
    fields=lambda _one: (
        vector("rates", _("Joint velocities"), 2, "rad/s", 2.0),
        vector("error", _("Error e of the tip's velocity"), 2, "m/s"),
    ),
    solve=lambda one: _damped_answers(one, jacobian(one)),
    steps=lambda one: inverse_steps(question_of(jacobian(one), one.velocity, one.damping)),
    wrong={
        "damping_squared": lambda one: one._replace(damping=one.damping**2),
        "root_of_damping": lambda one: one._replace(damping=one.damping**0.5),
        "undamped": lambda one: {"rates": np.linalg.solve(jacobian(one), one.velocity)},
        "calculator_mode": misread,
        "angle_not_summed": lambda one: _damped_answers(one, angles_not_summed(one)),
        "transpose_for_inverse": lambda one: {"rates": jacobian(one).T @ one.velocity},
    },
    picture=planar_picture,
)


class ThreeLinkWish(NamedTuple):
    """A planar arm of three links whose tip is to move; angles in degrees, velocities in m/s and rad/s."""

    l1: Annotated[float, Draw.decimal, 0.3, 0.6, 0.1]
    l2: Annotated[float, Draw.decimal, 0.3, 0.6, 0.1]
    l3: Annotated[float, Draw.decimal, 0.2, 0.5, 0.1]
    q1: Annotated[float, Draw.signed, 10.0, 80.0, 5.0]
    q2: Annotated[float, Draw.signed, 20.0, 90.0, 5.0]
    q3: Annotated[float, Draw.signed, 20.0, 90.0, 5.0]
    x_rate: Annotated[float, Draw.signed, 0.1, 0.5, 0.05]
    y_rate: Annotated[float, Draw.signed, 0.1, 0.5, 0.05]
    xi1: Annotated[float, Draw.signed, 0.2, 1.0, 0.1]
    xi2: Annotated[float, Draw.signed, 0.2, 1.0, 0.1]
    xi3: Annotated[float, Draw.signed, 0.2, 1.0, 0.1]

    @property
    def velocity(self) -> Array:
        """Velocity of the tip."""
        return np.array([self.x_rate, self.y_rate])

    @property
    def xi(self) -> Array:
        """The second wish."""
        return np.array([self.xi1, self.xi2, self.xi3])


def _redundant_answers(task: ThreeLinkWish, J: Array) -> Answers:
    inverse = LectureInverse(J, 2, np.ones(3))
    least = inverse.pseudo_inverse @ task.velocity
    _left, _sigmas, right = np.linalg.svd(J)
    return {"least": least, "kernel": right[2:].T, "both": least + inverse.projector @ task.xi}


def _is_nearly_singular(one: ThreeLinkWish) -> bool:
    J = jacobian(one)
    found = _redundant_answers(one, J)
    apart = float(np.abs(found["both"] - found["least"]).max())
    return bool(np.linalg.svd(J, compute_uv=False)[1] < 0.15 or apart < 0.1)


def _range_projected(one: ThreeLinkWish) -> Array:
    J = jacobian(one)
    return np.asarray(np.linalg.pinv(J) @ (one.velocity + J @ one.xi))


def _redundant_steps(one: ThreeLinkWish) -> list[Step]:
    question = question_of(jacobian(one), one.velocity)
    second = wish_steps(NullSpaceWish(one.xi), question.inverse.projector, jacobian(one))
    return [*picked_steps(one), *inverse_steps(question), *second]


REDUNDANT = Exercise(
    id="velocities.redundant",
    title=marked("Three links for two directions: the pseudo-inverse"),
    difficulty=4,
    draw=drawn(ThreeLinkWish),
    is_degenerate=_is_nearly_singular,
    text=lambda one: _(
        "A planar arm has three revolute joints and links of {l1:g} m, {l2:g} m and {l3:g} m. It stands at ϑ = "
        "({q1:g}°, {q2:g}°, {q3:g}°), each counted from the link before. Its tip is to move at v = ({x_rate:g}, "
        "{y_rate:g}) m/s; its orientation does not matter.\n\nFind the joint velocities of the least norm, the joint "
        "velocities that leave the tip at rest, and the joint velocities that come nearest to ξ = ({xi1:g}, {xi2:g}, "
        "{xi3:g}) rad/s without disturbing the tip: J# v + (I - J# J) ξ."
    ).format(**one._asdict()),
    fields=lambda _one: (
        vector("least", _("Joint velocities of the least norm"), 3, "rad/s", 2.0),
        basis("kernel", _("Kernel of J, as a column"), (3, 1)),
        vector("both", _("Joint velocities with ξ"), 3, "rad/s"),
    ),
    solve=lambda one: _redundant_answers(one, jacobian(one)),
    steps=_redundant_steps,
    wrong={
        "joint_locked": lambda one: {"least": [*np.linalg.solve(jacobian(one)[:, :2], one.velocity), 0.0]},
        "transpose_for_inverse": lambda one: {"least": jacobian(one).T @ one.velocity},
        "projector_forgotten": lambda one: {"both": _redundant_answers(one, jacobian(one))["least"] + one.xi},
        "wrong_projector": lambda one: {"both": _range_projected(one)},
        "row_for_kernel": lambda one: {"kernel": jacobian(one)[:1].T},
        "calculator_mode": misread,
    },
    picture=planar_picture,
)
