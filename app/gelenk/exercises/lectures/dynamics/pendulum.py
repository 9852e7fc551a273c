"""One link in a vertical plane."""

import math
from typing import Annotated, NamedTuple

import numpy as np

from gelenk.course.steps import Step, step, tex
from gelenk.dh.lagrangian.bodies import STANDARD_GRAVITY, LinkBody
from gelenk.dh.lagrangian.numeric import NumericMotion, numeric_motion
from gelenk.exercises.draw import Draw, drawn
from gelenk.exercises.exercise import Answers, Exercise
from gelenk.exercises.fields import quantity
from gelenk.exercises.table_field import table_of
from gelenk.language import marked, translated as _

FALL = np.array([0.0, -STANDARD_GRAVITY, 0.0])
"""Free fall in the plane x-y, [m/s²]."""


class PendulumTask(NamedTuple):
    """A link: mass, distance and inertia of its centre; its angle in degrees, its acceleration in rad/s²."""

    mass: Annotated[float, Draw.decimal, 1.0, 6.0, 0.5]
    center: Annotated[float, Draw.decimal, 0.2, 0.8, 0.05]
    inertia: Annotated[float, Draw.decimal, 0.05, 0.4, 0.05]
    angle: Annotated[float, Draw.decimal, 10.0, 80.0, 5.0]
    acceleration: Annotated[float, Draw.decimal, 2.0, 12.0, 0.5]

    @property
    def motion(self) -> NumericMotion:
        """The equation of motion of the core."""
        table = table_of(np.zeros((1, 4)), (False,))
        body = LinkBody(self.mass, self.center, self.inertia)
        return numeric_motion(table, (body,), FALL, np.radians([self.angle]), None)

    def answers(self, inertia: float, gravity: float) -> Answers:
        """Return the answers from both terms."""
        return {"inertia": inertia, "gravity": gravity, "torque": inertia * self.acceleration + gravity}

    @property
    def terms(self) -> tuple[float, float]:
        """Moment of inertia about the joint, and torque of gravity."""
        return float(self.motion.mass_matrix[0, 0]), float(self.motion.gravity_vector[0])


def _pendulum_steps(one: PendulumTask) -> list[Step]:
    inertia, gravity = one.terms
    return [
        step(
            _("Inertia about the joint"),
            _("Steiner's theorem: the centre of mass moves on a circle."),
            rf"M = m\,l_c^2 + I = {tex(inertia, 'kg m^2')}",
        ),
        step(
            _("Torque of gravity"),
            _("The slope of the potential energy."),
            r"U = m\,g\,l_c \sin q",
            rf"g(q) = \frac{{\partial U}}{{\partial q}} = m\,g\,l_c \cos q = {tex(gravity, 'N m')}",
        ),
        step(
            _("Torque of the joint"),
            _("Both together."),
            rf"\tau = M \ddot q + g(q) = {tex(inertia * one.acceleration + gravity, 'N m')}",
        ),
    ]


PENDULUM = Exercise(
    id="dynamics.pendulum",
    title=marked("The torque of one link"),
    difficulty=1,
    draw=drawn(PendulumTask),
    is_degenerate=lambda one: abs(one.angle - 45.0) < 5.0 or one.mass == 1.0,
    text=lambda one: _(
        "A link of {mass:g} kg turns about a horizontal axis. Its centre of mass is {center:g} m from the axis, its "
        "inertia about the centre is {inertia:g} kg m². It stands {angle:g}° above the horizontal and is accelerated "
        "upwards by {acceleration:g} rad/s²; g = 9.81 m/s². How large is its inertia about the axis, which torque "
        "balances gravity, and which torque must the joint exert?"
    ).format(**one._asdict()),
    fields=lambda _one: (
        quantity("inertia", _("Inertia about the axis"), "kg m²"),
        quantity("gravity", _("Torque against gravity"), "N m"),
        quantity("torque", _("Torque of the joint"), "N m"),
    ),
    solve=lambda one: one.answers(*one.terms),
    steps=_pendulum_steps,
    wrong={
        "steiner_forgotten": lambda one: one.answers(one.inertia, one.terms[1]),
        "own_inertia_forgotten": lambda one: one.answers(one.mass * one.center**2, one.terms[1]),
        "sine_for_cosine": lambda one: one.answers(
            one.terms[0], one.mass * STANDARD_GRAVITY * one.center * math.sin(math.radians(one.angle))
        ),
        "gravity_forgotten": lambda one: {"torque": one.terms[0] * one.acceleration},
        "gravity_helps": lambda one: {"torque": one.terms[0] * one.acceleration - one.terms[1]},
    },
)
