"""Two joints under a force at the tip or a weight, and the force of given torques."""

import math
from typing import Annotated, NamedTuple

import numpy as np
from numpy.typing import ArrayLike

from gelenk.course.steps import Step, step
from gelenk.course.velocity.geometry import ChainGeometry
from gelenk.course.velocity.statics_steps import StaticsQuestion, statics_steps
from gelenk.course.velocity.writing import number, row
from gelenk.exercises.arms import angles_not_summed, at, jacobian, misread, own_links, planar_picture, polar, posture
from gelenk.exercises.draw import Draw, drawn
from gelenk.exercises.exercise import Answers, Exercise
from gelenk.exercises.fields import quantity, vector
from gelenk.language import marked, translated as _
from gelenk.robot.arrays import Array

_GRAVITY = 9.81
PLANE = np.array([0, 1])
"""Rows of the forces in the plane."""


class TwoLinkForce(NamedTuple):
    """An arm under a force or with torques; angles in degrees, the load in N or N m."""

    l1: Annotated[float, Draw.decimal, 0.3, 1.0, 0.1]
    l2: Annotated[float, Draw.decimal, 0.3, 0.8, 0.1]
    q1: Annotated[float, Draw.decimal, 10.0, 80.0, 5.0]
    q2: Annotated[float, Draw.signed, 30.0, 120.0, 5.0]
    first: Annotated[float, Draw.signed, 5.0, 50.0, 5.0]
    second: Annotated[float, Draw.signed, 5.0, 50.0, 5.0]

    @property
    def load(self) -> Array:
        """The force, or the torques."""
        return np.array([self.first, self.second])


class TwoLinkPayload(NamedTuple):
    """An arm in a vertical plane that holds a mass, [kg]; angles in degrees."""

    l1: Annotated[float, Draw.decimal, 0.3, 1.0, 0.1]
    l2: Annotated[float, Draw.decimal, 0.3, 0.8, 0.1]
    q1: Annotated[float, Draw.decimal, 10.0, 80.0, 5.0]
    q2: Annotated[float, Draw.signed, 30.0, 120.0, 5.0]
    mass: Annotated[float, Draw.decimal, 1.0, 10.0, 0.5]

    @property
    def weight(self) -> Array:
        """The force of the tip on the payload, [N]."""
        return np.array([0.0, self.mass * _GRAVITY])


def worked(geometry: ChainGeometry, force: Array, *, wants_wrench: bool = False) -> list[Step]:
    """Return the derivation of torques, or of the force that leads to them."""
    J = geometry.jacobian()[:2]
    rank = int(np.linalg.matrix_rank(J))
    return statics_steps(
        StaticsQuestion(
            geometry, J, rank, geometry.position, np.eye(3), PLANE, force, J.T @ force, wants_wrench=wants_wrench
        )
    )


TORQUES = Exercise(
    id="statics.torques",
    title=marked("Torques under a force at the tip"),
    difficulty=1,
    draw=drawn(TwoLinkForce),
    is_degenerate=lambda one: float(np.abs(jacobian(one).T @ one.load).max()) < 2.0,
    text=lambda one: _(
        "A planar arm has two revolute joints and links of l₁ = {l1:g} m and l₂ = {l2:g} m. It stands at ϑ₁ = "
        "{q1:g}°, ϑ₂ = {q2:g}° (counted from the first link), and its tip pushes against its surroundings with the "
        "force F = ({first:g}, {second:g}) N. Which torques do the motors need? The plane is horizontal: no weight "
        "acts."
    ).format(**one._asdict()),
    fields=lambda _one: (vector("torques", _("Torques of the motors"), 2, "N m"),),
    solve=lambda one: {"torques": jacobian(one).T @ one.load},
    steps=lambda one: worked(posture(one), one.load),
    wrong={
        "jacobian_for_transpose": lambda one: {"torques": jacobian(one) @ one.load},
        "components_exchanged": lambda one: one._replace(first=one.second, second=one.first),
        "angle_not_summed": lambda one: {"torques": angles_not_summed(one).T @ one.load},
        "own_link_only": lambda one: {"torques": own_links(one).T @ one.load},
        "calculator_mode": misread,
    },
    picture=planar_picture,
)


def _payload_answers(task: TwoLinkPayload, J: Array) -> Answers:
    return {"levers": J[1], "torques": J.T @ task.weight}


PAYLOAD = Exercise(
    id="statics.payload",
    title=marked("Holding a payload"),
    difficulty=2,
    draw=drawn(TwoLinkPayload),
    is_degenerate=lambda one: float(np.abs(jacobian(one)[1]).min()) < 0.1,
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
    solve=lambda one: _payload_answers(one, jacobian(one)),
    steps=lambda one: worked(posture(one), one.weight),
    wrong={
        "vertical_lever": lambda one: _payload_answers(one, -jacobian(one)[::-1]),
        "own_link_only": lambda one: _payload_answers(one, own_links(one)),
        "mass_for_weight": lambda one: {"torques": jacobian(one).T @ [0.0, one.mass]},
        "angle_not_summed": lambda one: _payload_answers(one, angles_not_summed(one)),
        "calculator_mode": misread,
    },
    picture=planar_picture,
)


def _force_answers(inverse: ArrayLike, torques: Array) -> Answers:
    """Return the force that a matrix makes of torques, and its size."""
    force = np.asarray(inverse, np.float64) @ torques
    return {"force": force, "size": float(np.linalg.norm(force))}


def _force_steps(task: TwoLinkForce) -> list[Step]:
    force = _force_answers(np.linalg.inv(jacobian(task).T), task.load)["force"]
    size = step(
        _("The size of the force"),
        _("The root of the sum of the squares."),
        rf"\lVert F \rVert = \lVert {row(force)} \rVert = {number(float(np.linalg.norm(force)), 'N')}",
    )
    return [*worked(posture(task), force, wants_wrench=True), size]


FORCE = Exercise(
    id="statics.force",
    title=marked("The force of given torques"),
    difficulty=3,
    draw=drawn(TwoLinkForce, first=(Draw.signed, 2.0, 30.0, 1.0), second=(Draw.signed, 2.0, 30.0, 1.0)),
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
    solve=lambda one: _force_answers(np.linalg.inv(jacobian(one).T), one.load),
    steps=_force_steps,
    wrong={
        "inverse_without_transpose": lambda one: _force_answers(np.linalg.inv(jacobian(one)), one.load),
        "transpose_for_its_inverse": lambda one: _force_answers(jacobian(one).T, one.load),
        "angle_not_summed": lambda one: _force_answers(np.linalg.inv(angles_not_summed(one).T), one.load),
        "sum_for_norm": lambda one: {"size": float(np.abs(np.linalg.solve(jacobian(one).T, one.load)).sum())},
        "calculator_mode": misread,
    },
    picture=planar_picture,
)


class PolarForce(NamedTuple):
    """An arm of a revolute and a prismatic joint under a force, [N]; the angle in degrees, the length in metres."""

    q1: Annotated[float, Draw.signed, 20.0, 70.0, 5.0]
    length: Annotated[float, Draw.decimal, 0.3, 1.8, 0.1]
    x_force: Annotated[float, Draw.signed, 10.0, 60.0, 5.0]
    y_force: Annotated[float, Draw.signed, 10.0, 60.0, 5.0]

    @property
    def force(self) -> Array:
        """Force of the tip on its surroundings."""
        return np.array([self.x_force, self.y_force])

    def geometry(self) -> ChainGeometry:
        """Return axes and lever arms."""
        return at(polar(), np.array([math.radians(self.q1), self.length]))

    def efforts(self) -> Answers:
        """Return the torque and the thrust."""
        torque, thrust = self.geometry().jacobian()[:2].T @ self.force
        return {"torque": float(torque), "thrust": float(thrust)}


POLAR = Exercise(
    id="statics.polar",
    title=marked("Torque and thrust of a polar arm"),
    difficulty=2,
    draw=drawn(PolarForce),
    is_degenerate=lambda one: min(map(abs, one.efforts().values())) < 2.0,
    text=lambda one: _(
        "The first joint of a planar arm is revolute and turns it about the base; the second one is prismatic and "
        "slides the tip along the arm. At ϑ₁ = {q1:g}° the tip is {length:g} m from the base and pushes with the "
        "force F = ({x_force:g}, {y_force:g}) N against its surroundings, in the base's axes. Which torque does the "
        "first motor need, and which thrust the second one? The plane is horizontal."
    ).format(**one._asdict()),
    fields=lambda _one: (
        quantity("torque", _("Torque of the first motor"), "N m"),
        quantity("thrust", _("Thrust of the second motor"), "N"),
    ),
    solve=lambda one: one.efforts(),
    steps=lambda one: worked(one.geometry(), one.force),
    wrong={
        "lever_for_thrust": lambda one: {"thrust": one.length * one.efforts()["thrust"]},
        "lever_forgotten": lambda one: {"torque": one.efforts()["torque"] / one.length},
        "along_and_across": lambda one: {
            "torque": one.length * one.efforts()["thrust"],
            "thrust": one.efforts()["torque"] / one.length,
        },
        "components_exchanged": lambda one: one._replace(x_force=one.y_force, y_force=one.x_force),
        "calculator_mode": misread,
    },
)
