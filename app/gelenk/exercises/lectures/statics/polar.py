"""An arm that turns and slides: a torque and a thrust."""

from typing import NamedTuple

import numpy as np

from gelenk.course.velocity.geometry import ChainGeometry
from gelenk.exercises.arms import at, polar, radians
from gelenk.exercises.draw import Draw
from gelenk.exercises.exercise import Answers, Exercise
from gelenk.exercises.fields import quantity
from gelenk.exercises.lectures.statics.two_links import worked
from gelenk.language import marked
from gelenk.language import translated as _
from gelenk.robot.arrays import Array


class PolarForce(NamedTuple):
    """An arm of a revolute and a prismatic joint under a force, [N]; the angle in degrees, the length in metres."""

    q1: float
    length: float
    x_force: float
    y_force: float

    @property
    def force(self) -> Array:
        """Force of the tip on its surroundings."""
        return np.array([self.x_force, self.y_force])

    def geometry(self, *, calculator: bool = False) -> ChainGeometry:
        """Return axes and lever arms; `calculator` takes the degrees for radians."""
        angle = self.q1 if calculator else float(radians(self.q1)[0])
        return at(polar(), np.array([angle, self.length]))

    def efforts(self, *, calculator: bool = False) -> Answers:
        """Return the torque and the thrust."""
        torque, thrust = self.geometry(calculator=calculator).jacobian()[:2].T @ self.force
        return {"torque": float(torque), "thrust": float(thrust)}


def _draw_polar(draw: Draw) -> PolarForce:
    return PolarForce(
        draw.signed(20.0, 70.0, 5.0),
        draw.decimal(0.3, 1.8, 0.1),
        draw.signed(10.0, 60.0, 5.0),
        draw.signed(10.0, 60.0, 5.0),
    )


POLAR = Exercise(
    id="statics.polar",
    title=marked("Torque and thrust of a polar arm"),
    difficulty=2,
    draw=_draw_polar,
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
        "components_exchanged": lambda one: PolarForce(one.q1, one.length, one.y_force, one.x_force).efforts(),
        "calculator_mode": lambda one: one.efforts(calculator=True),
    },
)

EXERCISES = (POLAR,)
