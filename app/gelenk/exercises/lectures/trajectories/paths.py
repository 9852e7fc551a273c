"""Paths in space: a straight line with its time law, and a corner that is passed without a stop."""

import math
from collections.abc import Sequence
from typing import NamedTuple

import numpy as np

from gelenk.course.cartesian.line import LineLaw, LineMotion, along_line
from gelenk.course.cartesian.line_steps import line_steps
from gelenk.course.motion.fly_over import Blend, blended, corner_of
from gelenk.course.motion.fly_over_steps import fly_over_steps
from gelenk.exercises.draw import Draw
from gelenk.exercises.exercise import Answers, Exercise
from gelenk.exercises.fields import quantity, vector
from gelenk.language import marked, number_list, translated as _
from gelenk.robot.arrays import Array

_WAYS = ((1, 2, 2), (2, 3, 6), (1, 4, 8), (2, 6, 9), (4, 4, 7), (6, 6, 7))
"""Differences in decimetres whose length is whole."""
_Point = tuple[float, float, float]


def _point(values: Sequence[float]) -> str:
    return f"({number_list(values)})"


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
        vector("place", _("Position at that time"), 3, "m", 2.0, within=0.003),
        vector("velocity", _("Velocity at that time"), 3, "m/s", 2.0, within=0.003),
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


_DIRECTIONS = ((1.0, 0.0), (0.6, 0.8), (0.8, 0.6), (0.0, 1.0), (-0.6, 0.8), (0.8, -0.6), (0.6, -0.8), (-0.8, 0.6))


class CornerTask(NamedTuple):
    """A path A-B-C in the plane, [m], the speeds on both legs, [m/s], and the time of the blend, [s]."""

    start: tuple[float, float]
    corner: tuple[float, float]
    end: tuple[float, float]
    v1: float
    v2: float
    time: float

    @property
    def blend(self) -> Blend:
        """The fly-over of the core."""
        corner = corner_of(np.array(self.start), np.array(self.corner), np.array(self.end), self.v1, self.v2)
        return blended(corner, "blend_time", self.time)


def _draw_corner(draw: Draw) -> CornerTask:
    before, after = draw.sample(_DIRECTIONS, 2)
    lengths = [5.0 * draw.integer(1, 3), 5.0 * draw.integer(1, 3)]
    B = (float(draw.integer(1, 9)), float(draw.integer(1, 9)))
    A, C = (
        (round(B[0] + sign * length * way[0], 6), round(B[1] + sign * length * way[1], 6))
        for sign, length, way in ((-1.0, lengths[0], before), (1.0, lengths[1], after))
    )
    speeds = draw.decimal(0.5, 3.0, 0.5), draw.decimal(0.5, 3.0, 0.5)
    return CornerTask(A, B, C, *speeds, draw.decimal(1.0, 4.0, 0.5))


def _is_useless_corner(one: CornerTask) -> bool:
    """Check whether the blend does not fit, the speeds are equal, or the path turns back."""
    before, after = (math.dist(one.corner, point) for point in (one.start, one.end))
    if one.v1 == one.v2 or one.v1 * one.time > 1.8 * before or one.v2 * one.time > 1.8 * after:
        return True
    return one.blend.corner.angle > 3.0


def _answers_of(blend: Blend, entry: Array, exit_: Array) -> Answers:
    return {
        "distances": np.array([blend.distance_before, blend.distance_after]),
        "entry": entry,
        "exit": exit_,
        "acceleration": math.hypot(*blend.acceleration),
    }


def _at(one: CornerTask, before: float, after: float) -> Answers:
    corner = one.blend.corner
    return {
        "distances": np.array([before, after]),
        "entry": corner.corner - before * corner.direction_before,
        "exit": corner.corner + after * corner.direction_after,
    }


def _not_normalised(one: CornerTask) -> Answers:
    blend, corner = one.blend, one.blend.corner
    before, after = corner.corner - corner.start, corner.end - corner.corner
    return {
        "entry": corner.corner - blend.distance_before * before,
        "exit": corner.corner + blend.distance_after * after,
        "acceleration": float(np.linalg.norm(one.v2 * after - one.v1 * before)) / one.time,
    }


CORNER = Exercise(
    id="trajectories.corner",
    title=marked("A corner without a stop"),
    difficulty=3,
    draw=_draw_corner,
    is_degenerate=_is_useless_corner,
    text=lambda one: _(
        "The tip moves from A = {A} over B = {B} to C = {C}, coordinates in metres, at {v1:g} m/s on AB and at "
        "{v2:g} m/s on BC. It does not stop at B: within {time:g} s a parabola leads from A' on AB to C' on BC. How "
        "far are A' and C' from B, where are they, and how large is the constant acceleration between them?"
    ).format(A=_point(one.start), B=_point(one.corner), C=_point(one.end), v1=one.v1, v2=one.v2, time=one.time),
    fields=lambda _one: (
        vector("distances", _("Distances of A' and C' from B"), 2, "m", within=0.01),
        vector("entry", "A'", 2, "m", within=0.01),
        vector("exit", "C'", 2, "m", within=0.01),
        quantity("acceleration", _("Magnitude of the acceleration"), "m/s²", 2.0),
    ),
    solve=lambda one: _answers_of(one.blend, one.blend.entry, one.blend.exit),
    steps=lambda one: fly_over_steps(one.blend, "blend_time", one.time, None),
    wrong={
        "full_speed_to_corner": lambda one: _at(one, one.v1 * one.time, one.v2 * one.time),
        "legs_exchanged": lambda one: _at(one, 0.5 * one.v2 * one.time, 0.5 * one.v1 * one.time),
        "not_normalised": _not_normalised,
        "wrong_side_of_corner": lambda one: {
            "entry": 2.0 * np.array(one.corner) - one.blend.entry,
            "exit": 2.0 * np.array(one.corner) - one.blend.exit,
        },
        "speeds_subtracted": lambda one: {"acceleration": abs(one.v2 - one.v1) / one.time},
        "components_added": lambda one: {"acceleration": float(np.abs(one.blend.acceleration).sum())},
    },
)
