"""A corner that is passed without a stop."""

import math
from typing import NamedTuple

import numpy as np

from gelenk.course.motion.fly_over import Blend, blended, corner_of
from gelenk.course.motion.fly_over_steps import fly_over_steps
from gelenk.exercises.draw import Draw
from gelenk.exercises.exercise import Answers, Exercise
from gelenk.exercises.fields import VectorField, quantity
from gelenk.language import marked
from gelenk.language import translated as _
from gelenk.robot.arrays import Array

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


def _point(values: tuple[float, float]) -> str:
    return f"({values[0]:g}, {values[1]:g})"


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
        VectorField(name="distances", label=_("Distances of A' and C' from B"), unit="m", tolerance=0.01, size=2),
        VectorField(name="entry", label="A'", unit="m", tolerance=0.01, size=2),
        VectorField(name="exit", label="C'", unit="m", tolerance=0.01, size=2),
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

EXERCISES = (CORNER,)
