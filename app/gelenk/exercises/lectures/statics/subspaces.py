"""The four subspaces of a stretched or folded arm."""

from typing import NamedTuple

import numpy as np

from gelenk.course.velocity.geometry import ChainGeometry
from gelenk.course.velocity.statics_steps import StaticsQuestion, statics_steps
from gelenk.exercises.arms import at, planar, radians
from gelenk.exercises.draw import Draw
from gelenk.exercises.exercise import Answers, Exercise
from gelenk.exercises.fields import basis
from gelenk.exercises.lectures.statics.two_links import PLANE
from gelenk.language import marked
from gelenk.language import translated as _
from gelenk.robot.arrays import Array


class SingularArm(NamedTuple):
    """An arm whose second angle is 0 or 180 degrees."""

    l1: float
    l2: float
    q1: float
    q2: float

    def geometry(self, *, calculator: bool = False) -> ChainGeometry:
        """Return axes and lever arms; `calculator` takes the degrees of the first angle for radians."""
        q1, q2 = radians(self.q1, self.q2)
        return at(planar(self.l1, self.l2), np.array([self.q1 if calculator else q1, q2]))


def _draw_singular(draw: Draw) -> SingularArm:
    return SingularArm(
        draw.decimal(0.3, 1.0, 0.1),
        draw.decimal(0.2, 0.8, 0.1),
        draw.signed(10.0, 80.0, 5.0),
        draw.choice((0.0, 180.0)),
    )


def _spaces(J: Array) -> dict[str, Array]:
    """Return range(J), ker(Jᵀ), range(Jᵀ) and ker(J) of a matrix of rank 1, as columns; shape (2, 1) each."""
    left, _sigmas, right = np.linalg.svd(J)
    return {"range": left[:, :1], "unfelt": left[:, 1:], "torques": right[:1].T, "kernel": right[1:].T}


def _exchanged(task: SingularArm, *order: str) -> Answers:
    found = _spaces(task.geometry().jacobian()[:2])
    return {name: found[other] for name, other in zip(found, order, strict=True)}


def _own_links(task: SingularArm) -> Answers:
    J = task.geometry().jacobian()[:2]
    found = _spaces(np.column_stack((J[:, 0] - J[:, 1], J[:, 1])))
    return {"torques": found["torques"], "kernel": found["kernel"]}


def _subspace_question(task: SingularArm) -> StaticsQuestion:
    geometry = task.geometry()
    J = geometry.jacobian()[:2]
    return StaticsQuestion(geometry, J, 1, geometry.position, np.eye(3), PLANE, None, np.zeros(2))


SUBSPACES = Exercise(
    id="statics.subspaces",
    title=marked("The four subspaces of a singular arm"),
    difficulty=4,
    draw=_draw_singular,
    is_degenerate=lambda one: one.l1 == one.l2,
    text=lambda one: _(
        "A planar arm has two revolute joints and links of l₁ = {l1:g} m and l₂ = {l2:g} m, and stands at ϑ₁ = "
        "{q1:g}°, ϑ₂ = {q2:g}°. J is the Jacobian of the position (x, y) of its tip. Which velocities can the tip "
        "have, which forces at the tip need no torque, which torques can a force at the tip balance, and which joint "
        "velocities leave the tip at rest? Give a basis of each space, as a column."
    ).format(**one._asdict()),
    fields=lambda _one: (
        basis("range", _("Velocities of the tip: range of J"), (2, 1)),
        basis("unfelt", _("Forces without torque: kernel of the transpose of J"), (2, 1)),
        basis("torques", _("Torques that a force balances: range of the transpose of J"), (2, 1)),
        basis("kernel", _("Joint velocities without motion: kernel of J"), (2, 1)),
    ),
    solve=lambda one: _spaces(one.geometry().jacobian()[:2]),
    steps=lambda one: statics_steps(_subspace_question(one)),
    wrong={
        "complement": lambda one: _exchanged(one, "unfelt", "range", "kernel", "torques"),
        "joints_for_tip": lambda one: _exchanged(one, "torques", "kernel", "range", "unfelt"),
        "own_link_only": _own_links,
        "calculator_mode": lambda one: _spaces(one.geometry(calculator=True).jacobian()[:2]),
    },
)

EXERCISES = (SUBSPACES,)
