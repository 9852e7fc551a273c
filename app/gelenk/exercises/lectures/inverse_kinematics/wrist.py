"""The angles of a spherical wrist, from what the arm leaves of the rotation."""

import math
from typing import NamedTuple

import numpy as np

from gelenk.course.inverse.wrist import wrist_formulas, wrist_numbers, wrist_text, zyz_angles
from gelenk.course.steps import Step, step
from gelenk.course.writing import matrix
from gelenk.exercises.draw import Draw
from gelenk.exercises.exercise import Answers, Exercise
from gelenk.exercises.lectures.inverse_kinematics.by_hand import joints_field, revolute, solutions
from gelenk.exercises.lectures.poses.frames import rotation_field
from gelenk.exercises.lectures.poses.triples import flipped_without_last, is_plain, without_quadrant
from gelenk.exercises.rational import RationalRotation, drawn_rotation
from gelenk.language import marked
from gelenk.language import translated as _
from gelenk.robot.arrays import Array
from gelenk.robot.poses import transform

_SQUARE = 0.5 * math.pi
WRIST = revolute((0.0, -_SQUARE, 0.0, 0.0), (0.0, _SQUARE, 0.0, 0.0), (0.0, 0.0, 0.0, 0.0))
"""Rows 4 to 6 without lengths: R^3_6 = Rz(ϑ4) Ry(ϑ5) Rz(ϑ6)."""
_FRONT = revolute((0.0, _SQUARE, 0.0, 0.0), (0.0, 0.0, 0.0, 0.0), (0.0, _SQUARE, 0.0, 0.0))


def wrist_angles(R36: Array) -> list[Array]:
    """Return both solutions (ϑ4, ϑ5, ϑ6) of a rotation."""
    return solutions(WRIST, transform(np.zeros(3), R36))


class WristTask(NamedTuple):
    """Angles of the arm in degrees, and the rotation that frame 6 is to have."""

    q1: float
    q2: float
    q3: float
    rotation: RationalRotation

    @property
    def arm(self) -> Array:
        """R^0_3; shape (3, 3)."""
        return np.asarray(_FRONT.pose(np.radians(self[:3]).tolist())[:3, :3])

    @property
    def relative(self) -> Array:
        """R^3_6; shape (3, 3)."""
        return np.asarray(self.arm.T @ self.rotation.matrix)


def answers_of(relative: Array) -> Answers:
    """Return the wrist's answers for a R^3_6."""
    return {"relative": relative, "wrist": wrist_angles(relative)}


def _draw(draw: Draw) -> WristTask:
    angles = draw.signed(10.0, 150.0, 5.0), draw.signed(10.0, 80.0, 5.0), draw.signed(10.0, 130.0, 5.0)
    return WristTask(*angles, drawn_rotation(draw))


def _steps(one: WristTask) -> list[Step]:
    name = r"R^{3}_{6} = (R^{0}_{3})^T R"
    angles, sign = zyz_angles(one.relative)
    lines = [*wrist_formulas(3, "R^{3}_{6}"), *wrist_numbers(3, name, one.relative, angles, sign)]
    text = _("The first three joints turn frame 3; both last turns are about parallel axes, so their angles add up.")
    rule = r"R^{0}_{3} = R_z(\vartheta_1)\, R_x(\frac{\pi}{2})\, R_z(\vartheta_2 + \vartheta_3)\, R_x(\frac{\pi}{2})"
    return [
        step(_("Frame 3"), text, rule, rf"R^{{0}}_{{3}} = {matrix(one.arm)}"),
        step(_("Angles of the wrist"), wrist_text(False), *lines),
    ]


WRIST_ANGLES = Exercise(
    id="inverse_kinematics.wrist",
    title=marked("Angles of a spherical wrist"),
    difficulty=3,
    draw=_draw,
    is_degenerate=lambda one: is_plain(one.relative),
    text=lambda one: _(
        "An arm of six joints has a spherical wrist. Its standard DH rows turn by α = 90°, 0, 90°, -90°, 90°, 0, so "
        "that R^3_6 = Rz(ϑ4) Ry(ϑ5) Rz(ϑ6). The first three joints are at ϑ1 = {q1:g}°, ϑ2 = {q2:g}°, ϑ3 = {q3:g}°. "
        "Frame 6 is to have the rotation matrix R = {matrix} in frame 0, its rows separated by semicolons. Which "
        "rotation R^3_6 is left for the wrist, and which angles (ϑ4, ϑ5, ϑ6), in radians, give it? Give all solutions."
    ).format(q1=one.q1, q2=one.q2, q3=one.q3, matrix=one.rotation.text),
    fields=lambda _one: (
        rotation_field("relative", _("Rotation R^3_6"), 2.0),
        joints_field("wrist", _("All (ϑ4, ϑ5, ϑ6)"), 3, 2.0),
    ),
    solve=lambda one: answers_of(one.relative),
    steps=_steps,
    wrong={
        "arm_not_transposed": lambda one: answers_of(one.arm @ one.rotation.matrix),
        "arm_from_the_right": lambda one: answers_of(one.rotation.matrix @ one.arm.T),
        "relative_inverted": lambda one: answers_of(one.relative.T),
        "arm_left_out": lambda one: answers_of(one.rotation.matrix),
        "quadrant": lambda one: {"wrist": without_quadrant(one.relative)},
        "flip_incomplete": lambda one: {"wrist": flipped_without_last(one.relative)},
    },
)

EXERCISES = (WRIST_ANGLES,)
