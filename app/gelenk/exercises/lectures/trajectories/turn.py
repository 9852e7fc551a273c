"""An orientation that turns about one axis."""

import math
from typing import Annotated, NamedTuple

import numpy as np

from gelenk.course.cartesian.turn import Turn, turn_steps
from gelenk.course.orientation.rotations import elementary
from gelenk.exercises.draw import Draw, drawn
from gelenk.exercises.exercise import Answers, Exercise
from gelenk.exercises.fields import quantity, vector
from gelenk.language import marked, translated as _
from gelenk.robot.arrays import Array
from gelenk.trajectory.motion.polynomial import PiecewisePolynomial
from gelenk.trajectory.motion.time_laws import rest_to_rest


class TurnTask(NamedTuple):
    """From Rz(first) to Rz(second) Rx(tilt), in degrees, by a cubic in a time in seconds."""

    first: Annotated[float, Draw.signed, 10.0, 90.0, 10.0]
    second: Annotated[float, Draw.signed, 10.0, 180.0, 10.0]
    tilt: Annotated[float, Draw.signed, 20.0, 150.0, 10.0]
    time: Annotated[float, Draw.decimal, 1.0, 4.0, 0.5]

    @property
    def turn(self) -> Turn:
        """Both orientations."""
        first, second, tilt = map(math.radians, (self.first, self.second, self.tilt))
        return Turn(elementary("z", first), elementary("z", second) @ elementary("x", tilt))

    @property
    def between(self) -> float:
        """Angle about z from the first orientation to the second one, [°]."""
        return math.remainder(self.second - self.first, 360.0)

    @property
    def share(self) -> PiecewisePolynomial:
        """s(t)."""
        return rest_to_rest(0.0, 1.0, 2).lasting(self.time)

    def answers(self, angle: float, axis: Array, base_axis: Array, peak: float = 1.5) -> Answers:
        """Return answers from θ, [rad], and r in the first orientation's frame and in the base."""
        return {"angle": angle, "axis": axis, "velocity": peak * angle / self.time * base_axis}


def _turn_answers(one: TurnTask) -> Answers:
    path = one.turn.by_axis
    return one.answers(path.angle, path.axis, one.turn.base_axis)


def _as_vector(one: TurnTask) -> Answers:
    vector = np.radians([one.tilt, 0.0, one.between])
    angle = float(np.linalg.norm(vector))
    return one.answers(angle, vector / angle, one.turn.start @ vector / angle)


def _arc_sine(one: TurnTask) -> Answers:
    path = one.turn.by_axis
    return one.answers(math.asin(math.sin(path.angle)), path.axis, one.turn.base_axis)


def _difference_reversed(one: TurnTask) -> Answers:
    """R_f R_iᵀ in place of R_iᵀ R_f, whose axis is already in the base."""
    path, base = one.turn.by_axis, one.turn.base_axis
    return one.answers(path.angle, base, one.turn.start @ base)


TURN = Exercise(
    id="trajectories.turn",
    title=marked("A turn about one axis"),
    difficulty=4,
    draw=drawn(TurnTask),
    is_degenerate=lambda one: not 0.5 < one.turn.by_axis.angle < 2.9 or abs(one.between) < 15.0,
    text=lambda one: _(
        "A hand has the orientation R_i = Rz({first:g}°) and has to reach R_f = Rz({second:g}°) Rx({tilt:g}°) in "
        "{time:g} s, by turning about one axis; the angle is a cubic of time from rest to rest. With R_i^T R_f = "
        "Rot(r, θ) and 0 < θ < π: what are θ, the axis r in the frame of R_i, and the angular velocity in the base "
        "frame when it is largest?"
    ).format(**one._asdict()),
    fields=lambda _one: (
        quantity("angle", _("Angle θ"), "rad", 2.0, within=0.005),
        vector("axis", _("Axis r in the frame of R_i"), 3, points=2.0, within=0.005),
        vector("velocity", _("Largest angular velocity in the base frame"), 3, "rad/s", 2.0, within=0.01),
    ),
    solve=_turn_answers,
    steps=lambda one: turn_steps(one.turn, one.share),
    wrong={
        "axis_of_other_frame": _difference_reversed,
        "axis_not_in_base": lambda one: {
            "velocity": 1.5 * one.turn.by_axis.angle / one.time * one.turn.by_axis.axis
        },
        "angles_as_vector": _as_vector,
        "arc_sine": _arc_sine,
        "mean_for_peak": lambda one: {"velocity": one.turn.by_axis.angle / one.time * one.turn.base_axis},
        "peaks_exchanged": lambda one: {
            "velocity": 15.0 / 8.0 * one.turn.by_axis.angle / one.time * one.turn.base_axis
        },
        "axis_not_normalised": lambda one: {
            "axis": 2.0 * math.sin(one.turn.by_axis.angle) * one.turn.by_axis.axis
        },
    },
)  # fmt: skip
