"""The angles of a spherical wrist, and an exam: an arm of six joints with such a wrist, solved by decoupling."""

import math
from dataclasses import replace
from typing import NamedTuple

import numpy as np

from gelenk.course.inverse.wrist import wrist_formulas, wrist_numbers, wrist_text, zyz_angles
from gelenk.course.steps import Step, step
from gelenk.course.writing import matrix
from gelenk.exercises import sketches
from gelenk.exercises.draw import Draw, RationalRotation, drawn_rotation
from gelenk.exercises.exercise import Answers, Exercise
from gelenk.exercises.fields import angles, solution_set
from gelenk.exercises.lectures.inverse_kinematics.by_hand import POSITION, revolute, solutions, steps_by_hand
from gelenk.exercises.lectures.inverse_kinematics.spatial import is_awkward_reach, not_mirrored
from gelenk.exercises.lectures.poses.frames import point_field, rotation_field
from gelenk.exercises.lectures.poses.triples import flipped_without_last, is_plain, without_quadrant
from gelenk.language import marked, translated as _
from gelenk.robot.arrays import Array
from gelenk.robot.dh import DhTable
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
        solution_set(angles("wrist", _("All (ϑ4, ϑ5, ϑ6)"), 3), 2.0),
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
    sketch=sketches.six_joints,
)


class DecouplingTask(NamedTuple):
    """An arm and the pose of its frame 6, lengths in metres."""

    height: float
    upper: float
    lower: float
    tool: float
    x: float
    y: float
    z: float
    rotation: RationalRotation

    @property
    def table(self) -> DhTable:
        """All six rows."""
        return revolute(
            (0.0, _SQUARE, self.height, 0.0),
            (self.upper, 0.0, 0.0, 0.0),
            (0.0, _SQUARE, 0.0, 0.0),
            (0.0, -_SQUARE, self.lower, 0.0),
            (0.0, _SQUARE, 0.0, 0.0),
            (0.0, 0.0, self.tool, 0.0),
        )

    @property
    def position(self) -> Array:
        """Origin of frame 6; shape (3,)."""
        return np.array([self.x, self.y, self.z])

    def centre(self, approach: Array | None = None) -> Array:
        """Return the wrist's centre, back along the approach, which is the third column of R if it is not given."""
        return np.asarray(self.position - self.tool * (self.rotation.matrix[:, 2] if approach is None else approach))

    def arm(self, centre: Array) -> list[Array]:
        """Return the four (ϑ1, ϑ2, ϑ3) that bring the wrist's centre to a point, those that face it first."""
        end = transform(np.array([0.0, 0.0, self.lower]), np.eye(3))
        front = replace(self.table, joints=self.table.joints[:3], tool=end)
        return solutions(front, transform(centre, np.eye(3)), POSITION)

    def relative(self, arm: Array) -> Array:
        """Return R^3_6 for angles of the arm; shape (3, 3)."""
        return np.asarray(self.turned(arm).T @ self.rotation.matrix)

    def turned(self, arm: Array) -> Array:
        """Return R^0_3; shape (3, 3)."""
        return self.table.frames([*arm.tolist(), 0.0, 0.0, 0.0])[3][:3, :3]


def _elbows(arm: list[Array]) -> list[Array]:
    """Return the two solutions that face the point, the one with the higher elbow first."""
    return sorted(arm[:2], key=lambda q: -math.sin(q[1]))


def _answers(one: DecouplingTask, centre: Array) -> Answers:
    arm = one.arm(centre)
    return {"centre": centre, "arm": arm, **answers_of(one.relative(_elbows(arm)[0]))}


def _draw_arm(draw: Draw) -> DecouplingTask:
    lengths = draw.decimal(0.3, 0.6, 0.05), draw.decimal(0.4, 0.7, 0.05), draw.decimal(0.3, 0.6, 0.05)
    tool = draw.decimal(0.1, 0.2, 0.05)
    place = draw.signed(0.1, 0.8, 0.05), draw.signed(0.1, 0.8, 0.05), draw.decimal(0.1, 1.0, 0.05)
    return DecouplingTask(*lengths, tool, *place, drawn_rotation(draw))


def _is_awkward(one: DecouplingTask) -> bool:
    x, y, z = one.centre().tolist()
    if is_awkward_reach(one.upper, one.lower, math.hypot(x, y), z - one.height):
        return True
    up, down = _elbows(one.arm(one.centre()))
    return is_plain(one.relative(up)) or math.sin(up[1]) - math.sin(down[1]) < 0.1


def _best(one: DecouplingTask) -> Array:
    return _elbows(one.arm(one.centre()))[0]


DECOUPLING = Exercise(
    id="inverse_kinematics.decoupling",
    title=marked("Exam: six joints by decoupling"),
    difficulty=5,
    draw=_draw_arm,
    is_degenerate=_is_awkward,
    text=lambda one: _(
        "An arm of six revolute joints has the standard DH rows (a, α, d, ϑ): (0, 90°, {height:g} m, ϑ1), ({upper:g} "
        "m, 0, 0, ϑ2), (0, 90°, 0, ϑ3), (0, -90°, {lower:g} m, ϑ4), (0, 90°, 0, ϑ5), (0, 0, {tool:g} m, ϑ6). Frame 6 "
        "is to be at p = ({x:g}, {y:g}, {z:g}) m with R = {matrix}, rows separated by semicolons.\n\n"
        "Where is the centre of the wrist? Which angles (ϑ1, ϑ2, ϑ3), in radians, bring it there, all solutions? Take "
        "the one with ϑ1 = atan2(p_wy, p_wx), so that the arm faces the centre, and with the higher elbow: which "
        "rotation R^3_6 is left for the wrist? Which angles (ϑ4, ϑ5, ϑ6), in radians, give it, all solutions?"
    ).format(**{**one._asdict(), "matrix": one.rotation.text}),
    fields=lambda _one: (
        point_field("centre", _("Centre of the wrist p_w"), 2.0),
        solution_set(angles("arm", _("All (ϑ1, ϑ2, ϑ3)"), 3), 4.0),
        rotation_field("relative", _("Rotation R^3_6"), 2.0),
        solution_set(angles("wrist", _("All (ϑ4, ϑ5, ϑ6)"), 3), 3.0),
    ),
    solve=lambda one: _answers(one, one.centre()),
    steps=lambda one: steps_by_hand(one.table, transform(one.position, one.rotation.matrix)),
    wrong={
        "hand_left_out": lambda one: _answers(one, one.position),
        "centre_beyond": lambda one: _answers(one, one.centre(-one.rotation.matrix[:, 2])),
        "row_for_approach": lambda one: _answers(one, one.centre(one.rotation.matrix[2])),
        "shoulder_not_mirrored": lambda one: {"arm": not_mirrored(one.arm(one.centre()))},
        "lower_elbow": lambda one: answers_of(one.relative(_elbows(one.arm(one.centre()))[1])),
        "arm_not_transposed": lambda one: answers_of(one.turned(_best(one)) @ one.rotation.matrix),
        "arm_left_out": lambda one: answers_of(one.rotation.matrix),
        "quadrant": lambda one: {"wrist": without_quadrant(one.relative(_best(one)))},
        "flip_incomplete": lambda one: {"wrist": flipped_without_last(one.relative(_best(one)))},
    },
    sketch=sketches.six_joints,
)
