"""An exam: from the Jacobian to the jerk, and joint accelerations for a tip that moves uniformly."""

from typing import Annotated, NamedTuple

import numpy as np

from gelenk.course.steps import Step, step
from gelenk.course.velocity.tip_motion_steps import tip_motion_steps
from gelenk.course.velocity.writing import number, row
from gelenk.exercises.arms import angles, angles_not_summed, lengths, misread, planar, planar_picture
from gelenk.exercises.draw import Draw, drawn
from gelenk.exercises.exercise import Answers, Exercise
from gelenk.exercises.fields import matrix, quantity, vector
from gelenk.exercises.lectures.velocities.planar import picked_steps
from gelenk.kinematics.velocity.velocity import jacobian_derivatives
from gelenk.language import marked, translated as _
from gelenk.robot.arrays import Array


class TwoLinkMotion(NamedTuple):
    """A planar arm in motion; angles in degrees, derivatives in rad/s, rad/s² and rad/s³."""

    l1: Annotated[float, Draw.decimal, 0.4, 1.0, 0.1]
    l2: Annotated[float, Draw.decimal, 0.3, 0.8, 0.1]
    q1: Annotated[float, Draw.signed, 10.0, 80.0, 5.0]
    q2: Annotated[float, Draw.signed, 40.0, 120.0, 5.0]
    rate1: Annotated[float, Draw.signed, 0.4, 1.5, 0.1]
    rate2: Annotated[float, Draw.signed, 0.4, 1.5, 0.1]
    acceleration1: Annotated[float, Draw.signed, 0.4, 1.5, 0.1]
    acceleration2: Annotated[float, Draw.signed, 0.4, 1.5, 0.1]
    jerk1: Annotated[float, Draw.signed, 0.4, 1.5, 0.1]
    jerk2: Annotated[float, Draw.signed, 0.4, 1.5, 0.1]

    @property
    def rates(self) -> Array:
        """The first, second and third derivative of the angles; shape (3, 2)."""
        return np.reshape(self[4:], (3, 2))

    def jacobians(self) -> tuple[Array, ...]:
        """Return J and its first two derivatives in the plane; shape (2, 2) each."""
        series = jacobian_derivatives(planar(*lengths(self)), angles(self)[None], self.rates[:2, None])
        return tuple(np.asarray(each[0, :2]) for each in series)


def _motion_answers(task: TwoLinkMotion, Js: tuple[Array, ...]) -> Answers:
    first, second, third = task.rates
    J, dJ, ddJ = Js
    return {
        "jacobian": J,
        "determinant": float(np.linalg.det(J)),
        "velocity": J @ first,
        "jacobian_rate": dJ,
        "acceleration": J @ second + dJ @ first,
        "jerk": J @ third + 2.0 * dJ @ second + ddJ @ first,
        "uniform": -np.linalg.solve(J, dJ @ first),
    }


def _cancels(task: TwoLinkMotion) -> bool:
    """Check whether an answer is the small difference of large terms."""
    found = _motion_answers(task, task.jacobians())
    names = ("velocity", "acceleration", "jerk", "uniform")
    return min(float(np.abs(found[name]).max()) for name in names) < 0.4


def _without(task: TwoLinkMotion, *factors: float) -> Answers:
    """Acceleration and jerk with other factors of J̇q̇, J̇q̈ and J̈q̇."""
    first, second, third = task.rates
    J, dJ, ddJ = task.jacobians()
    return {
        "acceleration": J @ second + factors[0] * dJ @ first,
        "jerk": J @ third + factors[1] * dJ @ second + factors[2] * ddJ @ first,
    }


def _second_rate_only(task: TwoLinkMotion) -> Answers:
    """J̇ if the angle of the second link turns at q̇₂ alone."""
    J, (first, second) = task.jacobians()[0], task.rates[0]
    upper, lower = J[:, 0] - J[:, 1], J[:, 1]
    quarter = np.array([[0.0, -1.0], [1.0, 0.0]])
    columns = (quarter @ (first * upper + second * lower), quarter @ (second * lower))
    return {"jacobian_rate": np.column_stack(columns)}


def _motion_steps(task: TwoLinkMotion) -> list[Step]:
    Js, found = task.jacobians(), _motion_answers(task, task.jacobians())
    uniform = step(
        _("The tip without acceleration"),
        _("The joints have to make up for what the change of J does."),
        r"0 = J \ddot q + \dot J \dot q",
        rf"\det J = {number(found['determinant'])},\quad \dot J \dot q = {row(Js[1] @ task.rates[0])}",
        rf"\ddot q = -J^{{-1}} \dot J \dot q = {row(found['uniform'])}",
    )
    return [*picked_steps(task), *tip_motion_steps(Js, task.rates), uniform]


def _not_summed(task: TwoLinkMotion) -> Answers:
    J = angles_not_summed(task)
    return {"jacobian": J, "determinant": float(np.linalg.det(J)), "velocity": J @ task.rates[0]}


MOTION = Exercise(
    id="velocities.motion",
    title=marked("Exam: from velocity to jerk"),
    difficulty=5,
    draw=drawn(TwoLinkMotion),
    is_degenerate=_cancels,
    text=lambda one: _(
        "A planar arm has two revolute joints and links of l₁ = {l1:g} m and l₂ = {l2:g} m. At this moment ϑ = "
        "({q1:g}°, {q2:g}°), ϑ₂ counted from the first link, and the joints have the velocities ({rate1:g}, "
        "{rate2:g}) rad/s, the accelerations ({acceleration1:g}, {acceleration2:g}) rad/s² and the jerks ({jerk1:g}, "
        "{jerk2:g}) rad/s³.\n\nFind the Jacobian J of the position (x, y) of the tip, its determinant and the "
        "velocity of the tip; then dJ/dt, the acceleration of the tip and its jerk. Which joint accelerations would "
        "the tip need at these velocities to move without acceleration?"
    ).format(**one._asdict()),
    fields=lambda _one: (
        matrix("jacobian", _("Jacobian J of (x, y)"), (2, 2), "m"),
        quantity("determinant", _("Determinant of J"), "m²"),
        vector("velocity", _("Velocity of the tip"), 2, "m/s"),
        matrix("jacobian_rate", _("dJ/dt"), (2, 2), "m/s", 2.0),
        vector("acceleration", _("Acceleration of the tip"), 2, "m/s²", 2.0),
        vector("jerk", _("Jerk of the tip"), 2, "m/s³", 2.0),
        vector("uniform", _("Joint accelerations without acceleration of the tip"), 2, "rad/s²", 2.0),
    ),
    solve=lambda one: _motion_answers(one, one.jacobians()),
    steps=_motion_steps,
    wrong={
        "two_forgotten": lambda one: {"jerk": _without(one, 1.0, 1.0, 1.0)["jerk"]},
        "change_forgotten": lambda one: _without(one, 0.0, 0.0, 0.0),
        "second_change_forgotten": lambda one: {"jerk": _without(one, 1.0, 2.0, 0.0)["jerk"]},
        "angle_not_summed": _not_summed,
        "rates_not_summed": _second_rate_only,
        "transpose_for_inverse": lambda one: {"uniform": -one.jacobians()[0].T @ one.jacobians()[1] @ one.rates[0]},
        "calculator_mode": misread,
    },
    picture=planar_picture,
)
