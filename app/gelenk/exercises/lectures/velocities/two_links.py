"""The planar arm of two links: its Jacobian, and joint velocities for a velocity of the tip."""

from collections.abc import Mapping, Sequence
from typing import NamedTuple

import numpy as np

from gelenk.course.steps import Step, step
from gelenk.course.velocity.inverse_question import InverseQuestion
from gelenk.course.velocity.inverse_steps import inverse_steps
from gelenk.course.velocity.inverses import LectureInverse
from gelenk.course.velocity.jacobian_steps import JacobianQuestion, jacobian_steps
from gelenk.course.velocity.tip_motion_steps import tip_motion_steps
from gelenk.course.velocity.writing import matrix as written
from gelenk.course.velocity.writing import number
from gelenk.exercises.arms import angles_not_summed, at, in_plane, planar, planar_picture, radians
from gelenk.exercises.draw import Draw
from gelenk.exercises.exercise import Answers, Exercise
from gelenk.exercises.fields import matrix, quantity, vector
from gelenk.language import marked
from gelenk.language import translated as _
from gelenk.robot.arrays import Array


class TwoLinkRates(NamedTuple):
    """An arm whose joints move; angles in degrees, velocities in rad/s."""

    l1: float
    l2: float
    q1: float
    q2: float
    rate1: float
    rate2: float

    @property
    def rates(self) -> Array:
        """Joint velocities."""
        return np.array([self.rate1, self.rate2])


class TwoLinkWish(NamedTuple):
    """An arm whose tip is to move; angles in degrees, velocities in m/s."""

    l1: float
    l2: float
    q1: float
    q2: float
    x_rate: float
    y_rate: float

    @property
    def velocity(self) -> Array:
        """Velocity of the tip."""
        return np.array([self.x_rate, self.y_rate])


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


def jacobian_of(task: TwoLinkRates | TwoLinkWish | DampedWish, *, calculator: bool = False) -> Array:
    """Return J of v_x and v_y; `calculator` takes the degrees for radians. Shape (2, 2)."""
    q = np.array([task.q1, task.q2])
    return in_plane(planar(task.l1, task.l2), q if calculator else radians(*q))


def not_summed(task: TwoLinkRates | TwoLinkWish | DampedWish) -> Array:
    """Return J as it is if the angle of the second link is not the sum of both; shape (2, 2)."""
    return angles_not_summed((task.l1, task.l2), radians(task.q1, task.q2))


def picked_steps(lengths: Sequence[float], q: Array) -> list[Step]:
    """Return the derivation of J, and the rows that count in the plane."""
    geometry = at(planar(*lengths), q)
    J = geometry.jacobian()[:2]
    lines = [f"J = {written(J)}"]
    if len(lengths) == 2:
        lines.append(rf"\det J = l_1 l_2 \sin\vartheta_2 = {number(float(np.linalg.det(J)))}")
    text = _("In the plane the tip has two components of velocity; of the angular velocity only ω_z is not zero.")
    plane = step(_("The rows of the plane"), text, *lines)
    return [*jacobian_steps(JacobianQuestion(geometry, "local_world_aligned", np.zeros(3), 1e-10)), plane]


def _draw_posture(draw: Draw) -> tuple[float, float, float, float]:
    return (
        draw.decimal(0.3, 1.0, 0.1),
        draw.decimal(0.2, 0.8, 0.1),
        draw.signed(10.0, 80.0, 5.0),
        draw.signed(30.0, 130.0, 5.0),
    )


def _jacobian_answers(task: TwoLinkRates, J: Array) -> Answers:
    return {"jacobian": J, "determinant": float(np.linalg.det(J)), "velocity": J @ task.rates}


def _own_link(task: TwoLinkRates) -> Array:
    J = jacobian_of(task)
    return np.column_stack((J[:, 0] - J[:, 1], J[:, 1]))


JACOBIAN = Exercise(
    id="velocities.two_links",
    title=marked("The Jacobian of two links"),
    difficulty=1,
    draw=lambda draw: TwoLinkRates(*_draw_posture(draw), draw.signed(0.2, 2.0, 0.1), draw.signed(0.2, 2.0, 0.1)),
    is_degenerate=lambda one: float(np.abs(jacobian_of(one) @ one.rates).max()) < 0.1,
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
    solve=lambda one: _jacobian_answers(one, jacobian_of(one)),
    steps=lambda one: [
        *picked_steps((one.l1, one.l2), radians(one.q1, one.q2)),
        *tip_motion_steps([jacobian_of(one)], one.rates[None]),
    ],
    wrong={
        "angle_not_summed": lambda one: _jacobian_answers(one, not_summed(one)),
        "calculator_mode": lambda one: _jacobian_answers(one, jacobian_of(one, calculator=True)),
        "own_link_only": lambda one: {"jacobian": _own_link(one), "velocity": _own_link(one) @ one.rates},
        "minus_of_cosine": lambda one: _jacobian_answers(one, np.diag([-1.0, 1.0]) @ jacobian_of(one)),
        "transpose_for_jacobian": lambda one: {"velocity": jacobian_of(one).T @ one.rates},
    },
    picture=lambda one: planar_picture((one.l1, one.l2), (one.q1, one.q2)),
)


def _inverse_answers(task: TwoLinkWish, J: Array) -> Answers:
    return {"determinant": float(np.linalg.det(J)), "rates": np.linalg.solve(J, task.velocity)}


def _inverse_wrong(task: TwoLinkWish) -> Mapping[str, Array]:
    J = jacobian_of(task)
    (a, b), (c, d) = J.tolist()
    swapped = np.array([[d, -b], [-c, a]])
    return {
        "transpose_for_inverse": J.T,
        "direct_for_inverse": J,
        "determinant_forgotten": swapped,
        "cofactor_signs": np.abs(swapped) * np.sign([[d, b], [c, a]]) / np.linalg.det(J),
    }


def _rates_by(code: str, task: TwoLinkWish) -> Answers:
    return {"rates": _inverse_wrong(task)[code] @ task.velocity}


def question_of(J: Array, v: Array, damping: float = 0.0) -> InverseQuestion:
    """Return the question how the joints have to move, exactly or damped; J has full rank."""
    inverse = LectureInverse(J, min(J.shape), np.ones(J.shape[1]), damping)
    return InverseQuestion(inverse, "damped" if damping else "pseudo_inverse", v, (np.zeros(len(v)), []))


INVERSE = Exercise(
    id="velocities.inverse",
    title=marked("Joint velocities of two links"),
    difficulty=2,
    draw=lambda draw: TwoLinkWish(*_draw_posture(draw), draw.signed(0.1, 0.5, 0.05), draw.signed(0.1, 0.5, 0.05)),
    text=lambda one: _(
        "A planar arm has two revolute joints and links of l₁ = {l1:g} m and l₂ = {l2:g} m, and stands at ϑ₁ = "
        "{q1:g}°, ϑ₂ = {q2:g}° (counted from the first link). Its tip is to move at v = ({x_rate:g}, {y_rate:g}) "
        "m/s. Find the determinant of the Jacobian of (x, y), and the joint velocities."
    ).format(**one._asdict()),
    fields=lambda _one: (
        quantity("determinant", _("Determinant of J"), "m²"),
        vector("rates", _("Joint velocities"), 2, "rad/s", 2.0),
    ),
    solve=lambda one: _inverse_answers(one, jacobian_of(one)),
    steps=lambda one: [
        *picked_steps((one.l1, one.l2), radians(one.q1, one.q2)),
        *inverse_steps(question_of(jacobian_of(one), one.velocity)),
    ],
    wrong={
        "angle_not_summed": lambda one: _inverse_answers(one, not_summed(one)),
        "calculator_mode": lambda one: _inverse_answers(one, jacobian_of(one, calculator=True)),
        "transpose_for_inverse": lambda one: _rates_by("transpose_for_inverse", one),
        "direct_for_inverse": lambda one: _rates_by("direct_for_inverse", one),
        "determinant_forgotten": lambda one: _rates_by("determinant_forgotten", one),
        "cofactor_signs": lambda one: _rates_by("cofactor_signs", one),
    },
    picture=lambda one: planar_picture((one.l1, one.l2), (one.q1, one.q2)),
)


def _draw_damped(draw: Draw) -> DampedWish:
    return DampedWish(
        *_draw_posture(draw)[:3],
        draw.signed(1.0, 8.0, 0.5),
        draw.signed(0.1, 0.5, 0.05),
        draw.signed(0.1, 0.5, 0.05),
        draw.choice((0.01, 0.02, 0.04, 0.05)),
    )


def _damped_answers(task: DampedWish, J: Array, damping: float) -> Answers:
    question = question_of(J, task.velocity, damping)
    return {"rates": question.solution(), "error": question.b - J @ question.solution()}


def _loses_little(task: DampedWish) -> bool:
    found = _damped_answers(task, jacobian_of(task), task.damping)
    return bool(np.abs(found["error"]).max() < 0.02 or np.abs(found["rates"]).max() < 0.02)


DAMPED = Exercise(
    id="velocities.damped",
    title=marked("Damped least squares near a singularity"),
    difficulty=3,
    draw=_draw_damped,
    is_degenerate=_loses_little,
    text=lambda one: _(
        "A planar arm of two revolute joints, with links of l₁ = {l1:g} m and l₂ = {l2:g} m, is nearly stretched: ϑ₁ "
        "= {q1:g}°, ϑ₂ = {q2:g}°. Its tip is to move at v = ({x_rate:g}, {y_rate:g}) m/s. Find the joint velocities "
        "that make λ‖q̇‖² + ‖J q̇ - v‖² least, with λ = {damping:g}, and the error e = v - J q̇ that remains."
    ).format(**one._asdict()),
    fields=lambda _one: (
        vector("rates", _("Joint velocities"), 2, "rad/s", 2.0),
        vector("error", _("Error e of the tip's velocity"), 2, "m/s"),
    ),
    solve=lambda one: _damped_answers(one, jacobian_of(one), one.damping),
    steps=lambda one: inverse_steps(question_of(jacobian_of(one), one.velocity, one.damping)),
    wrong={
        "damping_squared": lambda one: _damped_answers(one, jacobian_of(one), one.damping**2),
        "root_of_damping": lambda one: _damped_answers(one, jacobian_of(one), one.damping**0.5),
        "undamped": lambda one: {"rates": np.linalg.solve(jacobian_of(one), one.velocity)},
        "calculator_mode": lambda one: _damped_answers(one, jacobian_of(one, calculator=True), one.damping),
        "angle_not_summed": lambda one: _damped_answers(one, not_summed(one), one.damping),
        "transpose_for_inverse": lambda one: {"rates": jacobian_of(one).T @ one.velocity},
    },
    picture=lambda one: planar_picture((one.l1, one.l2), (one.q1, one.q2)),
)

EXERCISES = (JACOBIAN, INVERSE, DAMPED)
