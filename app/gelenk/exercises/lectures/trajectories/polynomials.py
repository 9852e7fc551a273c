"""Cubic and quintic time laws between two positions, and the velocities at the knots of a cubic spline."""

import math
from typing import Annotated, NamedTuple

import numpy as np

from gelenk.course.motion.spline_steps import spline_steps
from gelenk.course.motion.time_law_steps import peak_step, two_point_steps
from gelenk.course.steps import Step
from gelenk.exercises.draw import Draw, drawn
from gelenk.exercises.exercise import Answers, Exercise
from gelenk.exercises.fields import angle, quantity, vector
from gelenk.language import marked, number_list, translated as _
from gelenk.robot.arrays import Array
from gelenk.trajectory.motion.extremes import peaks
from gelenk.trajectory.motion.polynomial import PiecewisePolynomial
from gelenk.trajectory.motion.splines import Boundary, Spline, cubic_spline
from gelenk.trajectory.motion.time_laws import between, normalised


class RestToRest(NamedTuple):
    """A joint that turns by an angle in degrees, from rest to rest, in a time in seconds."""

    angle: Annotated[float, Draw.decimal, 30.0, 150.0, 5.0]
    time: Annotated[float, Draw.decimal, 0.6, 3.0, 0.2]

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
    draw=drawn(RestToRest),
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

    q0: Annotated[float, Draw.signed, 0.1, 0.8, 0.1]
    q1: Annotated[float, Draw.signed, 0.2, 1.6, 0.1]
    v0: Annotated[float, Draw.signed, 0.1, 0.6, 0.1]
    v1: Annotated[float, Draw.signed, 0.1, 0.6, 0.1]
    time: Annotated[float, Draw.decimal, 1.5, 4.0, 0.5]

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


CUBIC = Exercise(
    id="trajectories.cubic",
    title=marked("A cubic with velocities at both ends"),
    difficulty=2,
    draw=drawn(CubicTask),
    is_degenerate=lambda one: (
        abs(one.q1 - one.q0) < 0.3 or abs(one.v0 - one.v1) < 0.15 or abs(abs(one.q1 - one.q0) - 1.0) < 0.05
    ),
    text=lambda one: _(
        "A joint moves from q0 = {q0:g} rad to q1 = {q1:g} rad in T = {time:g} s. At the beginning it has the velocity "
        "v0 = {v0:g} rad/s, at the end v1 = {v1:g} rad/s. In λ = t/T the cubic is q = q0 + Δq (a λ³ + b λ² + c λ). "
        "What are (a, b, c), and position and velocity in the middle, at T/2?"
    ).format(**one._asdict()),
    fields=lambda _one: (
        vector("coefficients", _("Coefficients a, b, c"), 3, points=3.0, within=0.01),
        angle("middle", _("Position at T/2")),
        quantity("speed", _("Velocity at T/2"), "rad/s", within=0.005),
    ),
    solve=lambda one: one.answers(),
    steps=lambda one: polynomial_steps(one.law, *one.ends),
    wrong={
        "time_forgotten": lambda one: one._replace(v0=one.v0 / one.time, v1=one.v1 / one.time),
        "ends_exchanged": lambda one: one._replace(v0=one.v1, v1=one.v0),
        "rest_at_ends": lambda one: one._replace(v0=0.0, v1=0.0),
        "start_at_rest": lambda one: one._replace(v0=0.0, v1=one.v1),
        "displacement_forgotten": lambda one: one._replace(
            v0=one.v0 * (one.q1 - one.q0), v1=one.v1 * (one.q1 - one.q0)
        ),
    },
)


class SplineTask(NamedTuple):
    """Four knots of a joint: times in seconds, positions in degrees; at rest at both ends."""

    times: tuple[float, ...]
    knots: tuple[float, ...]

    def spline(self, boundary: Boundary = "clamped") -> Spline:
        """Return the spline of the core."""
        return cubic_spline(np.array(self.times), np.array(self.knots)[:, None], boundary)

    @property
    def spans(self) -> Array:
        """h; shape (3,), [s]."""
        return np.diff(self.times)

    @property
    def slopes(self) -> Array:
        """Mean velocities between the knots; shape (3,), [°/s]."""
        return np.diff(self.knots) / self.spans

    @property
    def system(self) -> tuple[Array, Array]:
        """A and b."""
        (h1, h2, h3), (s1, s2, s3) = self.spans, self.slopes
        A = np.array([[2.0 * (h1 + h2), h1], [h3, 2.0 * (h2 + h3)]])
        return A, 3.0 * np.array([h2 * s1 + h1 * s2, h3 * s2 + h2 * s3])

    def answers(self, inner: Array) -> Answers:
        """Return the answers from the velocities at the two inner knots, [°/s]."""
        (h1, h2, _h3), (q1, q2, q3, _q4) = self.spans, self.knots
        return {
            "velocities": inner,
            "start": float(6.0 * (q2 - q1) / h1**2 - 2.0 * inner[0] / h1),
            "middle": float(0.5 * (q2 + q3) + h2 * (inner[0] - inner[1]) / 8.0),
        }


def _draw_knots(draw: Draw) -> SplineTask:
    times = [0.0]
    for _span in range(3):
        times.append(times[-1] + draw.decimal(0.5, 2.0, 0.5))
    return SplineTask(tuple(times), tuple(draw.decimal(-90.0, 150.0, 15.0) for _knot in times))


def _is_useless_spline(one: SplineTask) -> bool:
    spans, knots = one.spans, np.diff(one.knots)
    if len(set(spans.tolist())) < 2 or spans[1] in {spans[0], spans[2]} or np.abs(knots).min() < 10.0:
        return True
    motion = one.spline()
    return float(np.abs(motion.velocities[1:3]).min()) < 5.0 or abs(float(motion.motion.coefficients[0, 2, 0])) < 10.0


def _spline_answers(one: SplineTask) -> Answers:
    found = one.spline()
    middle = found.motion.at(np.array([0.5 * (one.times[1] + one.times[2])]))
    return {
        "velocities": found.velocities[1:3, 0],
        "start": 2.0 * float(found.motion.coefficients[0, 2, 0]),
        "middle": float(middle[0, 0]),
    }


def _spans_exchanged(one: SplineTask) -> Answers:
    A, b = one.system
    A[0, 1] = A[1, 0] = one.spans[1]
    return one.answers(np.asarray(np.linalg.solve(A, b), float))


def _two_forgotten(one: SplineTask) -> Answers:
    A, b = one.system
    return one.answers(np.asarray(np.linalg.solve(A - 0.5 * np.diag(np.diag(A)), b), float))


def _free_ends(one: SplineTask) -> Answers:
    found = one.spline("natural")
    middle = found.motion.at(np.array([0.5 * (one.times[1] + one.times[2])]))
    return {"velocities": found.velocities[1:3, 0], "start": 0.0, "middle": float(middle[0, 0])}


SPLINE = Exercise(
    id="trajectories.spline",
    title=marked("A cubic spline through four knots"),
    difficulty=4,
    draw=_draw_knots,
    is_degenerate=_is_useless_spline,
    text=lambda one: _(
        "A joint passes four knots at the times {times} s, at {knots} degrees, by a cubic spline; it begins and ends "
        "at rest. What are the velocities at the two inner knots, the acceleration at the start, and the position "
        "halfway in time between the inner knots?"
    ).format(times=number_list(one.times), knots=number_list(one.knots)),
    fields=lambda _one: (
        vector("velocities", _("Velocities at the inner knots"), 2, "°/s", 4.0, within=0.3),
        quantity("start", _("Acceleration at the start"), "°/s²", 2.0),
        quantity("middle", _("Position halfway"), "°", 2.0, within=0.3),
    ),
    solve=_spline_answers,
    steps=lambda one: spline_steps(one.spline(), "clamped"),
    wrong={
        "spans_exchanged": _spans_exchanged,
        "two_of_diagonal": _two_forgotten,
        "three_forgotten": lambda one: one.answers(np.asarray(np.linalg.solve(*one.system), float) / 3.0),
        "mean_of_slopes": lambda one: one.answers(0.5 * (one.slopes[:2] + one.slopes[1:])),
        "ends_free": _free_ends,
        "knots_as_stops": lambda one: one.answers(np.zeros(2)),
    },
)  # fmt: skip
