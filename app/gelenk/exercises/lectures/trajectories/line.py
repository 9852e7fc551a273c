"""A straight line with its time law."""

import math
from typing import NamedTuple

import numpy as np

from gelenk.course.cartesian.line import LineLaw, LineMotion, along_line
from gelenk.course.cartesian.line_steps import line_steps
from gelenk.exercises.draw import Draw
from gelenk.exercises.exercise import Answers, Exercise
from gelenk.exercises.fields import VectorField, quantity
from gelenk.language import marked
from gelenk.language import translated as _
from gelenk.robot.arrays import Array

_WAYS = ((1, 2, 2), (2, 3, 6), (1, 4, 8), (2, 6, 9), (4, 4, 7), (6, 6, 7))
"""Differences in decimetres whose length is whole."""
_Point = tuple[float, float, float]


class LineTask(NamedTuple):
    """A line between two points, [m], limits of speed and acceleration, and a time, [s]."""

    start: _Point
    end: _Point
    velocity: float
    acceleration: float
    time: float

    @property
    def law(self) -> LineLaw:
        """Bang-coast-bang."""
        return LineLaw(self.velocity, self.acceleration)

    @property
    def motion(self) -> LineMotion:
        """The motion of the core."""
        return along_line(np.array(self.start), np.array(self.end), self.law)

    @property
    def way(self) -> Array:
        """p_f - p_i, (3,)."""
        way: Array = np.array(self.end) - np.array(self.start)
        return way

    @property
    def covered(self) -> float:
        """σ at the time, [m]."""
        return float(self.motion.law.at(np.array([self.time]))[0, 0])


def _draw_line(draw: Draw) -> LineTask:
    way = draw.sample(draw.choice(_WAYS), 3)
    start = tuple(draw.signed(0.1, 0.6, 0.1) for _axis in range(3))
    end = tuple(round(p + 0.1 * draw.choice((1, -1)) * d, 6) for p, d in zip(start, way, strict=True))
    limits = draw.decimal(0.2, 0.8, 0.1), draw.decimal(0.5, 2.0, 0.5)
    return LineTask((start[0], start[1], start[2]), (end[0], end[1], end[2]), *limits, draw.decimal(0.2, 4.0, 0.1))


def _is_useless_line(one: LineTask) -> bool:
    """Check whether it does not coast, or the time is not within the coast."""
    length = math.dist(one.start, one.end)
    ramp = one.velocity / one.acceleration
    total = length / one.velocity + ramp
    if length < 1.15 * one.velocity * ramp or not 1.1 * ramp < one.time < total - 1.1 * ramp:
        return True
    # In the middle every law has come half of the way.
    return abs(one.time - 0.5 * total) < 0.1 * total or math.hypot(*one.end) < 0.1


def _line_answers(one: LineTask) -> Answers:
    found, at = one.motion, np.array([one.time])
    place, velocity, _change = found.motion.rates_at(at)
    return {"length": found.length, "total": found.law.duration, "place": place[0], "velocity": velocity[0]}


def _with_length(one: LineTask, length: float) -> Answers:
    """Return what follows from a wrong length."""
    v, a = one.velocity, one.acceleration
    share = (v * one.time - v**2 / (2.0 * a)) / length
    return {
        "length": length,
        "total": length / v + v / a,
        "place": np.array(one.start) + share * one.way,
        "velocity": v * one.way / length,
    }


LINE = Exercise(
    id="trajectories.line",
    title=marked("A straight line with bang-coast-bang"),
    difficulty=2,
    draw=_draw_line,
    is_degenerate=_is_useless_line,
    text=lambda one: _(
        "The tip moves on a straight line from {start} to {end}, coordinates in metres, from rest to rest by "
        "bang-coast-bang with at most {velocity:g} m/s and {acceleration:g} m/s². How long is the line, how long does "
        "the motion take, and what are position and velocity {time:g} s after the start?"
    ).format(
        start=_point(one.start), end=_point(one.end), velocity=one.velocity, acceleration=one.acceleration,
        time=one.time,
    ),
    fields=lambda _one: (
        quantity("length", _("Length of the line"), "m"),
        quantity("total", _("Time in all"), "s"),
        VectorField(name="place", label=_("Position at that time"), unit="m", tolerance=0.003, size=3, points=2.0),
        VectorField(name="velocity", label=_("Velocity at that time"), unit="m/s", tolerance=0.003, size=3, points=2.0),
    ),
    solve=_line_answers,
    steps=lambda one: line_steps(one.motion, one.law),
    wrong={
        "lengths_added": lambda one: _with_length(one, float(np.abs(one.way).sum())),
        "length_not_divided": lambda one: {
            "place": np.array(one.start) + one.covered * one.way,
            "velocity": one.velocity * one.way,
        },
        "linear_in_time": lambda one: {
            "place": np.array(one.start) + one.time / one.motion.law.duration * one.way,
            "velocity": one.way / one.motion.law.duration,
        },
        "ramps_forgotten": lambda one: {"total": one.motion.length / one.velocity},
        "ramps_added": lambda one: {
            "total": one.motion.length / one.velocity + 2.0 * one.velocity / one.acceleration
        },
        "end_for_way": lambda one: {
            "place": np.array(one.start) + one.covered / one.motion.length * np.array(one.end)
        },
    },
)  # fmt: skip


def _point(values: _Point) -> str:
    return "(" + ", ".join(f"{value:g}" for value in values) + ")"


EXERCISES = (LINE,)
