"""Axis and angle of a rotation matrix."""

import math

import numpy as np

from gelenk.course.orientation.orientation import notations
from gelenk.course.orientation.orientation_steps import axis_angle_step
from gelenk.course.orientation.rotations import about_axis
from gelenk.course.steps import Step, step
from gelenk.course.writing import matrix
from gelenk.exercises.exercise import Answers, Exercise
from gelenk.exercises.fields import VectorField
from gelenk.exercises.lectures.poses.triples import angle_field, given_matrix, is_plain
from gelenk.exercises.rational import RationalRotation, drawn_rotation
from gelenk.language import marked
from gelenk.language import translated as _
from gelenk.robot.arrays import Array


def axis_field(name: str, label: str) -> VectorField:
    """Return the field of a unit vector."""
    return VectorField(name=name, label=label, tolerance=0.003, size=3)


def turned_about(R: Array) -> tuple[float, Array]:
    """Return angle, between 0 and π, and axis of a rotation that has one."""
    found = notations(R).axis_angle
    return found.angle, np.array(found.axes[0])


def off_diagonal(R: Array, sign: float = -1.0) -> Array:
    """Return the differences of the entries across the diagonal, 2 sin ϑ r; with +1 their sums, which are wrong."""
    return np.array([R[2, 1] + sign * R[1, 2], R[0, 2] + sign * R[2, 0], R[1, 0] + sign * R[0, 1]])


def _answers(one: RationalRotation) -> Answers:
    angle, axis = turned_about(one.matrix)
    return {"angle": angle, "axis": axis}


def _steps(one: RationalRotation) -> list[Step]:
    angle, axis = turned_about(one.matrix)
    text = _("Rodrigues' formula leads back to the matrix.")
    again = matrix(about_axis(axis, angle))
    line = rf"I + \sin\vartheta\, [r]_{{\times}} + (1 - \cos\vartheta)\, [r]_{{\times}}^2 = {again}"
    return [given_matrix(one.matrix), axis_angle_step(notations(one.matrix)), step(_("Check"), text, line)]


def _sums(R: Array) -> Array:
    sums = off_diagonal(R, 1.0)
    return np.asarray(sums / max(float(np.linalg.norm(sums)), 1e-9))


AXIS = Exercise(
    id="poses.axis_angle",
    title=marked("Axis and angle of a rotation matrix"),
    difficulty=3,
    draw=drawn_rotation,
    is_degenerate=lambda one: is_plain(one.matrix),
    text=lambda one: _(
        "A rotation matrix is R = {matrix}, its rows separated by semicolons. About which axis, a unit vector, and by "
        "which angle between 0 and π does it turn?"
    ).format(matrix=one.text),
    fields=lambda _one: (angle_field("angle", _("Angle ϑ")), axis_field("axis", _("Unit vector r of the axis"))),
    solve=_answers,
    steps=_steps,
    wrong={
        "angle_from_sine": lambda one: {"angle": math.asin(0.5 * float(np.linalg.norm(off_diagonal(one.matrix))))},
        "trace_without_one": lambda one: {"angle": math.acos(0.5 * float(np.trace(one.matrix)))},
        "axis_not_normalized": lambda one: {"axis": off_diagonal(one.matrix)},
        "axis_from_sums": lambda one: {"axis": _sums(one.matrix)},
        "rows_for_columns": lambda one: {"axis": turned_about(one.matrix.T)[1]},
    },
)

EXERCISES = (AXIS,)
