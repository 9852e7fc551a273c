"""Cubic and quintic time laws between two positions."""

import math
from typing import NamedTuple

import numpy as np

from gelenk.course.motion.time_law_steps import peak_step, two_point_steps
from gelenk.course.steps import Step
from gelenk.exercises.draw import Draw
from gelenk.exercises.exercise import Answers, Exercise
from gelenk.exercises.fields import NumberField, VectorField, quantity
from gelenk.language import marked
from gelenk.language import translated as _
from gelenk.robot.arrays import Array
from gelenk.trajectory.motion.extremes import peaks
from gelenk.trajectory.motion.polynomial import PiecewisePolynomial
from gelenk.trajectory.motion.time_laws import between, normalised


class RestToRest(NamedTuple):
    """A joint that turns by an angle in degrees, from rest to rest, in a time in seconds."""

    angle: float
    time: float

    @property
    def radians(self) -> float:
        """The angle, [rad]."""
        return math.radians(self.angle)

    def law(self, conditions: int) -> PiecewisePolynomial:
        """Return the cubic for 2 conditions at each end, the quintic for 3."""
        return between(*self.ends(conditions), self.time)

    def ends(self, conditions: int) -> tuple[Array, Array]:
        """Return position, velocity, … at both ends; shape (conditions, 1) each."""
        starts, ends = np.zeros((2, conditions, 1))
        ends[0] = self.radians
        return starts, ends

    def answers(self, cubic: float, bend: float, quintic: float) -> Answers:
        """Return answers from the factors of both peak velocities and of the acceleration."""
        mean = self.radians / self.time
        return {"velocity": cubic * mean, "acceleration": bend * mean / self.time, "quintic": quintic * mean}


def _peak(law: PiecewisePolynomial, order: int) -> float:
    return float(np.abs(peaks(law, order).values[0]))


def polynomial_steps(law: PiecewisePolynomial, starts: Array, ends: Array) -> tuple[Step, ...]:
    """Return the steps of a polynomial between two points, with its peaks; arrays of shape (m, 1)."""
    found = two_point_steps(law, starts, ends, normalised(law, ends[0] - starts[0]))
    return (*found, peak_step(peaks(law, 1), peaks(law, 2)))


REST = Exercise(
    id="trajectories.rest",
    title=marked("Peaks of a cubic and a quintic"),
    difficulty=1,
    draw=lambda draw: RestToRest(draw.decimal(30.0, 150.0, 5.0), draw.decimal(0.6, 3.0, 0.2)),
    is_degenerate=lambda one: one.time == 1.0,
    text=lambda one: _(
        "A joint has to turn by {angle:g}° in {time:g} s, from rest to rest. What are its largest velocity and its "
        "largest acceleration with a cubic, and its largest velocity with a quintic that begins and ends without "
        "acceleration?"
    ).format(**one._asdict()),
    fields=lambda _one: (
        quantity("velocity", _("Largest velocity of the cubic"), "rad/s"),
        quantity("acceleration", _("Largest acceleration of the cubic"), "rad/s²"),
        quantity("quintic", _("Largest velocity of the quintic"), "rad/s"),
    ),
    solve=lambda one: {
        "velocity": _peak(one.law(2), 1),
        "acceleration": _peak(one.law(2), 2),
        "quintic": _peak(one.law(3), 1),
    },
    steps=lambda one: [
        *polynomial_steps(one.law(2), *one.ends(2)),
        *polynomial_steps(one.law(3), *one.ends(3)),
    ],
    wrong={
        "mean_for_peak": lambda one: one.answers(1.0, 1.0, 1.0),
        "peaks_exchanged": lambda one: one.answers(15.0 / 8.0, 10.0 / math.sqrt(3.0), 1.5),
        "peaks_of_triangle": lambda one: one.answers(2.0, 4.0, 2.0),
        "time_not_squared": lambda one: {"acceleration": 6.0 * one.radians / one.time},
    },
)


class CubicTask(NamedTuple):
    """A cubic with given velocities at both ends; radians and seconds."""

    q0: float
    q1: float
    v0: float
    v1: float
    time: float

    @property
    def ends(self) -> tuple[Array, Array]:
        """Position and velocity at both ends; shape (2, 1) each."""
        return np.array([[self.q0], [self.v0]]), np.array([[self.q1], [self.v1]])

    @property
    def law(self) -> PiecewisePolynomial:
        """The cubic."""
        return between(*self.ends, self.time)

    def answers(self) -> Answers:
        """Return the answers for these numbers."""
        law = self.law
        q, speed, _change = law.rates_at(np.array([0.5 * self.time]))
        found = normalised(law, np.array([self.q1 - self.q0]))[0] or []
        return {"coefficients": np.array(found[:3]), "middle": float(q[0, 0]), "speed": float(speed[0, 0])}

    def with_rates(self, v0: float, v1: float) -> Answers:
        """Return the answers with other velocities at the ends."""
        return self._replace(v0=v0, v1=v1).answers()


def _draw_cubic(draw: Draw) -> CubicTask:
    ends = draw.signed(0.1, 0.8, 0.1), draw.signed(0.2, 1.6, 0.1)
    return CubicTask(*ends, draw.signed(0.1, 0.6, 0.1), draw.signed(0.1, 0.6, 0.1), draw.decimal(1.5, 4.0, 0.5))


def _is_useless_cubic(one: CubicTask) -> bool:
    return abs(one.q1 - one.q0) < 0.3 or abs(one.v0 - one.v1) < 0.15 or abs(abs(one.q1 - one.q0) - 1.0) < 0.05


CUBIC = Exercise(
    id="trajectories.cubic",
    title=marked("A cubic with velocities at both ends"),
    difficulty=2,
    draw=_draw_cubic,
    is_degenerate=_is_useless_cubic,
    text=lambda one: _(
        "A joint moves from q0 = {q0:g} rad to q1 = {q1:g} rad in T = {time:g} s. At the beginning it has the velocity "
        "v0 = {v0:g} rad/s, at the end v1 = {v1:g} rad/s. In λ = t/T the cubic is q = q0 + Δq (a λ³ + b λ² + c λ). "
        "What are (a, b, c), and position and velocity in the middle, at T/2?"
    ).format(**one._asdict()),
    fields=lambda _one: (
        VectorField(name="coefficients", label=_("Coefficients a, b, c"), tolerance=0.01, size=3, points=3.0),
        NumberField(name="middle", label=_("Position at T/2"), unit="rad", tolerance=0.005, is_angle=True),
        NumberField(name="speed", label=_("Velocity at T/2"), unit="rad/s", tolerance=0.005),
    ),
    solve=lambda one: one.answers(),
    steps=lambda one: polynomial_steps(one.law, *one.ends),
    wrong={
        "time_forgotten": lambda one: one.with_rates(one.v0 / one.time, one.v1 / one.time),
        "ends_exchanged": lambda one: one.with_rates(one.v1, one.v0),
        "rest_at_ends": lambda one: one.with_rates(0.0, 0.0),
        "start_at_rest": lambda one: one.with_rates(0.0, one.v1),
        "displacement_forgotten": lambda one: one.with_rates(one.v0 * (one.q1 - one.q0), one.v1 * (one.q1 - one.q0)),
    },
)

EXERCISES = (REST, CUBIC)
