"""The velocities at the knots of a cubic spline."""

from typing import NamedTuple

import numpy as np

from gelenk.course.motion.spline_steps import spline_steps
from gelenk.exercises.draw import Draw
from gelenk.exercises.exercise import Answers, Exercise
from gelenk.exercises.fields import NumberField, VectorField, quantity
from gelenk.language import marked
from gelenk.language import translated as _
from gelenk.robot.arrays import Array
from gelenk.trajectory.motion.splines import Boundary, Spline, cubic_spline


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


def _row(values: tuple[float, ...]) -> str:
    return ", ".join(f"{value:g}" for value in values)


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
    ).format(times=_row(one.times), knots=_row(one.knots)),
    fields=lambda _one: (
        VectorField(name="velocities", label=_("Velocities at the inner knots"), unit="°/s", tolerance=0.3, size=2,
                    points=4.0),
        quantity("start", _("Acceleration at the start"), "°/s²", 2.0),
        NumberField(name="middle", label=_("Position halfway"), unit="°", tolerance=0.3, points=2.0),
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

EXERCISES = (SPLINE,)
