"""Jacobians of arms in space by their columns, and the singularities of the anthropomorphic arm."""

import math
from collections.abc import Sequence
from functools import partial
from typing import Annotated, NamedTuple

import numpy as np

from gelenk.course.steps import Step, step
from gelenk.course.velocity.geometry import ChainGeometry
from gelenk.course.velocity.jacobian_steps import JacobianQuestion, jacobian_steps
from gelenk.course.velocity.tip_motion_steps import tip_motion_steps
from gelenk.course.velocity.writing import number, row
from gelenk.exercises import sketches
from gelenk.exercises.arms import anthropomorphic, at, lever_from_base, misread, radians, scara
from gelenk.exercises.draw import Draw, drawn
from gelenk.exercises.exercise import Answers, Exercise
from gelenk.exercises.fields import angle, basis, matrix, quantity, solution_set, vector
from gelenk.language import marked, translated as _
from gelenk.robot.arrays import Array

_DIGITS = 12
"""Of entries, so that zeros are not written as rounding."""


class ScaraTask(NamedTuple):
    """A SCARA whose joints move; lengths in metres, angles in degrees, velocities in rad/s, the third in m/s."""

    a1: Annotated[float, Draw.decimal, 0.2, 0.6, 0.05]
    a2: Annotated[float, Draw.decimal, 0.2, 0.5, 0.05]
    d1: Annotated[float, Draw.decimal, 0.3, 0.6, 0.1]
    d4: Annotated[float, Draw.decimal, 0.05, 0.15, 0.05]
    q1: Annotated[float, Draw.signed, 10.0, 80.0, 5.0]
    q2: Annotated[float, Draw.signed, 30.0, 130.0, 5.0]
    q3: Annotated[float, Draw.decimal, 0.1, 0.25, 0.05]
    q4: Annotated[float, Draw.signed, 10.0, 90.0, 10.0]
    rate1: Annotated[float, Draw.signed, 0.5, 2.0, 0.1]
    rate2: Annotated[float, Draw.signed, 0.5, 2.0, 0.1]
    rate3: Annotated[float, Draw.signed, 0.1, 0.6, 0.1]
    rate4: Annotated[float, Draw.signed, 0.5, 2.0, 0.1]

    def geometry(self) -> ChainGeometry:
        """Return axes and lever arms."""
        q1, q2, q4 = radians(self.q1, self.q2, self.q4)
        return at(scara(self.a1, self.a2, self.d1, self.d4), np.array([q1, q2, self.q3, q4]))

    @property
    def rates(self) -> Array:
        """Joint velocities."""
        return np.array([self.rate1, self.rate2, self.rate3, self.rate4])


def _scara_answers(task: ScaraTask, J: Array) -> Answers:
    return {"jacobian": J.round(_DIGITS), "twist": (J @ task.rates).round(_DIGITS)}


def _next_axes(task: ScaraTask) -> Array:
    """J with z_i and the lever arms of frame i in place of those of frame i-1."""
    geometry = task.geometry()
    tip = geometry.tip
    origins = [*(joint.origin for joint in geometry.joints[1:]), tip[:3, 3]]
    axes = [*(joint.axis for joint in geometry.joints[1:]), tip[:3, 2]]
    turning = [np.concatenate((np.cross(z, geometry.position - p), z)) for z, p in zip(axes, origins, strict=True)]
    turning[2] = np.concatenate((axes[2], np.zeros(3)))
    return np.array(turning).T


def _with_column(task: ScaraTask, i: int, column: Sequence[float]) -> Array:
    J = task.geometry().jacobian()
    J[:, i] = column
    return J


def _scara_up(task: ScaraTask) -> Array:
    J = task.geometry().jacobian()
    return J * [1.0, 1.0, -1.0, -1.0]


def _derivation(geometry: ChainGeometry) -> list[Step]:
    return jacobian_steps(JacobianQuestion(geometry, "local_world_aligned", np.zeros(3), 1e-10))


SCARA = Exercise(
    id="velocities.scara",
    title=marked("The columns of a SCARA's Jacobian"),
    difficulty=2,
    draw=drawn(ScaraTask),
    text=lambda one: _(
        "A SCARA has these rows of a standard DH table, each as (a, α, d, ϑ) with lengths in metres: ({a1:g}, 0, "
        "{d1:g}, ϑ₁), ({a2:g}, 180°, 0, ϑ₂), (0, 0, d₃, 0), (0, 0, {d4:g}, ϑ₄). It stands at ϑ₁ = {q1:g}°, ϑ₂ = "
        "{q2:g}°, d₃ = {q3:g} m, ϑ₄ = {q4:g}°. Find the geometric Jacobian of its tip in the base's axes, linear "
        "rows above angular ones, and the twist (v; ω) when the joints move at {rate1:g} rad/s, {rate2:g} rad/s, "
        "{rate3:g} m/s and {rate4:g} rad/s."
    ).format(**one._asdict()),
    fields=lambda _one: (
        matrix("jacobian", _("Jacobian J, linear rows above angular ones"), (6, 4), points=2.0),
        vector("twist", _("Twist (v; ω) of the tip"), 6),
    ),
    solve=lambda one: _scara_answers(one, one.geometry().jacobian()),
    steps=lambda one: [
        *_derivation(one.geometry()),
        *tip_motion_steps([one.geometry().jacobian()], one.rates[None]),
    ],
    wrong={
        "angular_first": lambda one: _scara_answers(one, np.roll(one.geometry().jacobian(), 3, axis=0)),
        "slide_as_turn": lambda one: _scara_answers(one, _with_column(one, 2, (0.0, 0.0, 0.0, 0.0, 0.0, -1.0))),
        "next_axis": lambda one: _scara_answers(one, _next_axes(one)),
        "lever_from_base": lambda one: _scara_answers(one, lever_from_base(one.geometry())),
        "axis_not_turned": lambda one: _scara_answers(one, _scara_up(one)),
        "calculator_mode": lambda one: misread(one, "q1", "q2", "q4"),
    },
    sketch=sketches.scara,
)


class AnthropomorphicTask(NamedTuple):
    """An anthropomorphic arm; angles in degrees."""

    a2: Annotated[float, Draw.decimal, 0.3, 0.8, 0.05]
    a3: Annotated[float, Draw.decimal, 0.3, 0.8, 0.05]
    q1: Annotated[float, Draw.signed, 10.0, 80.0, 5.0]
    q2: Annotated[float, Draw.signed, 10.0, 80.0, 5.0]
    q3: Annotated[float, Draw.signed, 30.0, 140.0, 5.0]

    def geometry(self) -> ChainGeometry:
        """Return axes and lever arms."""
        return at(anthropomorphic(self.a2, self.a3), radians(self.q1, self.q2, self.q3))

    @property
    def factors(self) -> tuple[float, float]:
        """The sine of the third angle, and the distance of the tip from the first axis."""
        _first, second, third = radians(self.q1, self.q2, self.q3)
        return math.sin(third), self.a2 * math.cos(second) + self.a3 * math.cos(second + third)


def _linear_answers(J: Array) -> Answers:
    return {"jacobian": J[:3].round(_DIGITS), "determinant": float(np.linalg.det(J[:3]))}


def _factored(task: AnthropomorphicTask) -> Step:
    sine, reach = task.factors
    return step(
        _("The determinant in factors"),
        _("It vanishes where the elbow is stretched or folded, and where the tip is on the first axis."),
        rf"\det J_L = -a_2 a_3 s_3 (a_2 c_2 + a_3 c_{{23}}) = {number(-task.a2 * task.a3 * sine * reach)}",
    )


ANTHROPOMORPHIC = Exercise(
    id="velocities.anthropomorphic",
    title=marked("The Jacobian of an anthropomorphic arm"),
    difficulty=3,
    draw=drawn(AnthropomorphicTask),
    is_degenerate=lambda one: abs(one.factors[1]) < 0.15,
    text=lambda one: _(
        "An anthropomorphic arm has the standard DH rows (a, α, d, ϑ) = (0, 90°, 0, ϑ₁), ({a2:g} m, 0, 0, ϑ₂), "
        "({a3:g} m, 0, 0, ϑ₃) and stands at ϑ₁ = {q1:g}°, ϑ₂ = {q2:g}°, ϑ₃ = {q3:g}°. Find the linear part J_L of "
        "its Jacobian, three rows in the base's axes, and the determinant of that."
    ).format(**one._asdict()),
    fields=lambda _one: (
        matrix("jacobian", _("Linear part J_L"), (3, 3), "m", 2.0),
        quantity("determinant", _("Determinant of J_L"), "m³"),
    ),
    solve=lambda one: _linear_answers(one.geometry().jacobian()),
    steps=lambda one: [*_derivation(one.geometry()), _factored(one)],
    wrong={
        "lever_from_base": lambda one: {"jacobian": lever_from_base(one.geometry())[:3]},
        "angle_not_summed": lambda one: one._replace(q3=one.q3 - one.q2),
        "calculator_mode": misread,
        "own_link_only": lambda one: {
            "jacobian": one.geometry().jacobian()[:3] @ np.array([[1.0, 0.0, 0.0], [0.0, 1.0, 0.0], [0.0, -1.0, 1.0]])
        },
        "elbow_factor_only": lambda one: {"determinant": -one.a2 * one.a3 * one.factors[0]},
    },
    sketch=partial(sketches.anthropomorphic, 0.0),
)


class ShoulderTask(NamedTuple):
    """An anthropomorphic arm whose third angle is asked for; angles in degrees."""

    a2: Annotated[float, Draw.decimal, 0.3, 0.6, 0.05]
    a3: Annotated[float, Draw.decimal, 0.4, 0.8, 0.05]
    q1: Annotated[float, Draw.signed, 10.0, 80.0, 5.0]
    q2: Annotated[float, Draw.signed, 20.0, 70.0, 5.0]

    @property
    def cosine(self) -> float:
        """Of the angle of the last link, where the tip is on the first axis."""
        return -self.a2 * math.cos(math.radians(self.q2)) / self.a3

    def bends(self, angle: float) -> list[float]:
        """Return the third angles for an angle of the last link with either sign, [°]."""
        return [math.degrees(sign * angle) - self.q2 for sign in (1.0, -1.0)]

    def lost(self) -> Array:
        """Return the direction that is lost on the first axis, as a column; shape (3, 1)."""
        posture = AnthropomorphicTask(*self, self.bends(math.acos(self.cosine))[0])
        left, _sigmas, _right = np.linalg.svd(posture.geometry().jacobian()[:3])
        return np.asarray(left[:, 2:].round(_DIGITS))


def _meets_elbow(task: ShoulderTask) -> bool:
    return any(abs(math.sin(math.radians(bend))) < 0.1 for bend in task.bends(math.acos(task.cosine)))


def _shoulder_steps(task: ShoulderTask) -> list[Step]:
    angle = math.degrees(math.acos(task.cosine))
    lost = rf"u = (s_1,\; -c_1,\; 0) = {row(task.lost()[:, 0])}"
    return [
        step(
            _("Where the determinant vanishes"),
            _("One factor belongs to the elbow, the other to the shoulder."),
            r"\det J_L = -a_2 a_3 s_3 (a_2 c_2 + a_3 c_{23})",
            r"s_3 = 0 \;\Leftrightarrow\; \vartheta_3 = 0^\circ \text{ , } 180^\circ",
        ),
        step(
            _("The tip on the first axis"),
            _("The distance from the first axis is zero; the angle of the last link has two solutions."),
            rf"c_{{23}} = -\frac{{a_2 c_2}}{{a_3}} = {number(task.cosine)}",
            rf"\vartheta_2 + \vartheta_3 = \pm {number(angle)}^\circ",
            rf"\vartheta_3 = \pm {number(angle)}^\circ - ({number(task.q2)}^\circ)",
        ),
        step(
            _("The lost direction"),
            _(
                "The first joint does not move the tip, and the others move it in the vertical plane of the arm: "
                "along the normal of that plane there is no velocity. Any multiple of it is as good."
            ),
            r"u^{\mathsf T} J_L = 0",
            lost,
        ),
    ]


SINGULARITIES = Exercise(
    id="velocities.singularities",
    title=marked("Singularities of an anthropomorphic arm"),
    difficulty=4,
    draw=drawn(ShoulderTask),
    is_degenerate=lambda one: abs(one.cosine) > 0.9 or _meets_elbow(one),
    text=lambda one: _(
        "An anthropomorphic arm has the standard DH rows (a, α, d, ϑ) = (0, 90°, 0, ϑ₁), ({a2:g} m, 0, 0, ϑ₂), "
        "({a3:g} m, 0, 0, ϑ₃) and stands at ϑ₁ = {q1:g}°, ϑ₂ = {q2:g}°. For which ϑ₃ is it singular because of its "
        "elbow? For which because its tip is on the first axis? In which direction, in the base's axes, can the tip "
        "not move in the second case?"
    ).format(**one._asdict()),
    fields=lambda _one: (
        solution_set(angle("elbow", _("All ϑ₃ of elbow singularities"), unit="°")),
        solution_set(angle("shoulder", _("All ϑ₃ with the tip on the first axis"), unit="°")),
        basis("lost", _("The lost direction, as a column"), (3, 1)),
    ),
    solve=lambda one: {
        "elbow": [0.0, 180.0],
        "shoulder": one.bends(math.acos(one.cosine)),
        "lost": one.lost(),
    },
    steps=_shoulder_steps,
    wrong={
        "cosine_of_elbow": lambda _one: {"elbow": [90.0, -90.0]},
        "minus_forgotten": lambda one: {"shoulder": one.bends(math.acos(-one.cosine))},
        "angle_not_summed": lambda one: {"shoulder": [bend + one.q2 for bend in one.bends(math.acos(one.cosine))]},
        "sum_the_wrong_way": lambda one: {
            "shoulder": [bend + 2.0 * one.q2 for bend in one.bends(math.acos(one.cosine))]
        },
        "moving_direction": lambda one: {
            "lost": [[math.cos(math.radians(one.q1))], [math.sin(math.radians(one.q1))], [0.0]]
        },
        "axis_for_direction": lambda _one: {"lost": [[0.0], [0.0], [1.0]]},
    },
    sketch=partial(sketches.anthropomorphic, 0.0),
)
