"""The planar arm of two links under a force at its tip or a weight, and the force of given torques."""

from typing import NamedTuple

import numpy as np
from numpy.typing import ArrayLike

from gelenk.course.steps import Step, step
from gelenk.course.velocity.geometry import ChainGeometry
from gelenk.course.velocity.statics_steps import StaticsQuestion, statics_steps
from gelenk.course.velocity.writing import number, row
from gelenk.exercises.arms import angles_not_summed, at, planar, planar_picture, radians
from gelenk.exercises.draw import Draw
from gelenk.exercises.exercise import Answers, Exercise
from gelenk.exercises.fields import quantity, vector
from gelenk.language import marked
from gelenk.language import translated as _
from gelenk.robot.arrays import Array

_GRAVITY = 9.81
PLANE = np.array([0, 1])
"""Rows of the forces in the plane."""


class TwoLinkForce(NamedTuple):
    """An arm under a force or with torques; angles in degrees, the load in N or N m."""

    l1: float
    l2: float
    q1: float
    q2: float
    first: float
    second: float

    @property
    def load(self) -> Array:
        """The force, or the torques."""
        return np.array([self.first, self.second])


class TwoLinkPayload(NamedTuple):
    """An arm in a vertical plane that holds a mass, [kg]; angles in degrees."""

    l1: float
    l2: float
    q1: float
    q2: float
    mass: float

    @property
    def weight(self) -> Array:
        """The force of the tip on the payload, [N]."""
        return np.array([0.0, self.mass * _GRAVITY])


def _geometry(task: TwoLinkForce | TwoLinkPayload, *, calculator: bool = False) -> ChainGeometry:
    q = np.array([task.q1, task.q2])
    return at(planar(task.l1, task.l2), q if calculator else radians(*q))


def _jacobian(task: TwoLinkForce | TwoLinkPayload, *, calculator: bool = False) -> Array:
    return _geometry(task, calculator=calculator).jacobian()[:2]


def _not_summed(task: TwoLinkForce | TwoLinkPayload) -> Array:
    return angles_not_summed((task.l1, task.l2), radians(task.q1, task.q2))


def _own_link(J: Array) -> Array:
    return np.column_stack((J[:, 0] - J[:, 1], J[:, 1]))


def worked(geometry: ChainGeometry, force: Array, *, wants_wrench: bool = False) -> list[Step]:
    """Return the derivation of torques, or of the force that leads to them."""
    J = geometry.jacobian()[:2]
    rank = int(np.linalg.matrix_rank(J))
    return statics_steps(
        StaticsQuestion(
            geometry, J, rank, geometry.position, np.eye(3), PLANE, force, J.T @ force, wants_wrench=wants_wrench
        )
    )


def _draw_posture(draw: Draw) -> tuple[float, float, float, float]:
    return (
        draw.decimal(0.3, 1.0, 0.1),
        draw.decimal(0.3, 0.8, 0.1),
        draw.decimal(10.0, 80.0, 5.0),
        draw.signed(30.0, 120.0, 5.0),
    )


TORQUES = Exercise(
    id="statics.torques",
    title=marked("Torques under a force at the tip"),
    difficulty=1,
    draw=lambda draw: TwoLinkForce(*_draw_posture(draw), draw.signed(5.0, 50.0, 5.0), draw.signed(5.0, 50.0, 5.0)),
    is_degenerate=lambda one: float(np.abs(_jacobian(one).T @ one.load).max()) < 2.0,
    text=lambda one: _(
        "A planar arm has two revolute joints and links of l₁ = {l1:g} m and l₂ = {l2:g} m. It stands at ϑ₁ = "
        "{q1:g}°, ϑ₂ = {q2:g}° (counted from the first link), and its tip pushes against its surroundings with the "
        "force F = ({first:g}, {second:g}) N. Which torques do the motors need? The plane is horizontal: no weight "
        "acts."
    ).format(**one._asdict()),
    fields=lambda _one: (vector("torques", _("Torques of the motors"), 2, "N m"),),
    solve=lambda one: {"torques": _jacobian(one).T @ one.load},
    steps=lambda one: worked(_geometry(one), one.load),
    wrong={
        "jacobian_for_transpose": lambda one: {"torques": _jacobian(one) @ one.load},
        "components_exchanged": lambda one: {"torques": _jacobian(one).T @ one.load[::-1]},
        "angle_not_summed": lambda one: {"torques": _not_summed(one).T @ one.load},
        "own_link_only": lambda one: {"torques": _own_link(_jacobian(one)).T @ one.load},
        "calculator_mode": lambda one: {"torques": _jacobian(one, calculator=True).T @ one.load},
    },
    picture=lambda one: planar_picture((one.l1, one.l2), (one.q1, one.q2)),
)


def _payload_answers(task: TwoLinkPayload, J: Array) -> Answers:
    return {"levers": J[1], "torques": J.T @ task.weight}


PAYLOAD = Exercise(
    id="statics.payload",
    title=marked("Holding a payload"),
    difficulty=2,
    draw=lambda draw: TwoLinkPayload(*_draw_posture(draw), draw.decimal(1.0, 10.0, 0.5)),
    is_degenerate=lambda one: float(np.abs(_jacobian(one)[1]).min()) < 0.1,
    text=lambda one: _(
        "A planar arm has two revolute joints and links of l₁ = {l1:g} m and l₂ = {l2:g} m whose own weight is "
        "negligible. The plane is vertical, x points horizontally and y upwards. At ϑ₁ = {q1:g}°, ϑ₂ = {q2:g}° "
        "(counted from the first link) its tip holds a payload of {mass:g} kg; g = 9.81 m/s². How far is the payload "
        "from each joint, horizontally (negative to the left of the joint)? Which torques do the motors need?"
    ).format(**one._asdict()),
    fields=lambda _one: (
        vector("levers", _("Horizontal lever arms of the payload"), 2, "m"),
        vector("torques", _("Torques of the motors"), 2, "N m"),
    ),
    solve=lambda one: _payload_answers(one, _jacobian(one)),
    steps=lambda one: worked(_geometry(one), one.weight),
    wrong={
        "vertical_lever": lambda one: _payload_answers(one, -_jacobian(one)[::-1]),
        "own_link_only": lambda one: _payload_answers(one, _own_link(_jacobian(one))),
        "mass_for_weight": lambda one: {"torques": _jacobian(one).T @ [0.0, one.mass]},
        "angle_not_summed": lambda one: _payload_answers(one, _not_summed(one)),
        "calculator_mode": lambda one: _payload_answers(one, _jacobian(one, calculator=True)),
    },
    picture=lambda one: planar_picture((one.l1, one.l2), (one.q1, one.q2)),
)


def _force_answers(inverse: ArrayLike, torques: Array) -> Answers:
    """Return the force that a matrix makes of torques, and its size."""
    force = np.asarray(inverse, np.float64) @ torques
    return {"force": force, "size": float(np.linalg.norm(force))}


def _force_steps(task: TwoLinkForce) -> list[Step]:
    force = _force_answers(np.linalg.inv(_jacobian(task).T), task.load)["force"]
    size = step(
        _("The size of the force"),
        _("The root of the sum of the squares."),
        rf"\lVert F \rVert = \lVert {row(force)} \rVert = {number(float(np.linalg.norm(force)), 'N')}",
    )
    return [*worked(_geometry(task), force, wants_wrench=True), size]


FORCE = Exercise(
    id="statics.force",
    title=marked("The force of given torques"),
    difficulty=3,
    draw=lambda draw: TwoLinkForce(*_draw_posture(draw), draw.signed(2.0, 30.0, 1.0), draw.signed(2.0, 30.0, 1.0)),
    text=lambda one: _(
        "A planar arm has two revolute joints and links of l₁ = {l1:g} m and l₂ = {l2:g} m. Its tip touches a wall, "
        "and at ϑ₁ = {q1:g}°, ϑ₂ = {q2:g}° (counted from the first link) all is at rest while the motors have the "
        "torques τ = ({first:g}, {second:g}) N m. Which force F = (F_x, F_y) does the tip exert on the wall, and how "
        "large is it? The plane is horizontal."
    ).format(**one._asdict()),
    fields=lambda _one: (
        vector("force", _("Force of the tip"), 2, "N", 2.0),
        quantity("size", _("Size of the force"), "N"),
    ),
    solve=lambda one: _force_answers(np.linalg.inv(_jacobian(one).T), one.load),
    steps=_force_steps,
    wrong={
        "inverse_without_transpose": lambda one: _force_answers(np.linalg.inv(_jacobian(one)), one.load),
        "transpose_for_its_inverse": lambda one: _force_answers(_jacobian(one).T, one.load),
        "angle_not_summed": lambda one: _force_answers(np.linalg.inv(_not_summed(one).T), one.load),
        "sum_for_norm": lambda one: {"size": float(np.abs(np.linalg.solve(_jacobian(one).T, one.load)).sum())},
        "calculator_mode": lambda one: _force_answers(np.linalg.inv(_jacobian(one, calculator=True).T), one.load),
    },
    picture=lambda one: planar_picture((one.l1, one.l2), (one.q1, one.q2)),
)

EXERCISES = (TORQUES, PAYLOAD, FORCE)
