"""Axis and angle of a rotation matrix, and an exam: a camera on a gripper, what it sees, and how it is turned."""

import math
from typing import NamedTuple

import numpy as np

from gelenk.course.orientation.orientation import notations
from gelenk.course.orientation.orientation_steps import (
    GivenMotion,
    axis_angle_step,
    composition_step,
    given_step,
    inverse_step,
    points_step,
    zyz_step,
)
from gelenk.course.orientation.rotations import Composition, about_axis, composed, elementary
from gelenk.course.steps import Step, step
from gelenk.course.writing import matrix
from gelenk.exercises.draw import Draw, RationalRotation, drawn_rotation
from gelenk.exercises.exercise import Answers, Exercise
from gelenk.exercises.fields import VectorField, angle, angles, solution_set
from gelenk.exercises.lectures.poses.frames import point_field, rotation_field
from gelenk.exercises.lectures.poses.triples import (
    flipped_without_last,
    given_matrix,
    is_plain,
    rpy_motion,
    rpy_rotation,
    without_quadrant,
    zyz_solutions,
)
from gelenk.language import marked, number_list, translated as _
from gelenk.robot.arrays import Array
from gelenk.robot.poses import inverse, transform


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


AXIS: Exercise[RationalRotation] = Exercise(
    id="poses.axis_angle",
    title=marked("Axis and angle of a rotation matrix"),
    difficulty=3,
    draw=drawn_rotation,
    is_degenerate=lambda one: is_plain(one.matrix),
    text=lambda one: _(
        "A rotation matrix is R = {matrix}, its rows separated by semicolons. About which axis, a unit vector, and by "
        "which angle between 0 and π does it turn?"
    ).format(matrix=one.text),
    fields=lambda _one: (angle("angle", _("Angle ϑ")), axis_field("axis", _("Unit vector r of the axis"))),
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


class CameraTask(NamedTuple):
    """Lengths in metres, angles in degrees.

    Attributes:
        gripper: Origin of the gripper in the base.
        rpy: Its roll, pitch and yaw.
        camera: Origin of the camera in the gripper's frame.
        tilt: Angle by which the camera is turned about the gripper's y axis.
        seen: A point in the camera's frame.
    """

    gripper: tuple[float, float, float]
    rpy: tuple[float, float, float]
    camera: tuple[float, float, float]
    tilt: float
    seen: tuple[float, float, float]

    @property
    def motions(self) -> tuple[GivenMotion, GivenMotion]:
        """The gripper in the base, and the camera in the gripper."""
        tilt = np.radians(self.tilt)
        turned = transform(np.array(self.camera), elementary("y", float(tilt)))
        given = GivenMotion("elementary", np.array([tilt]), "y", turned)
        return rpy_motion(np.radians(self.rpy), np.array(self.gripper)), given

    def path(self) -> Composition:
        """Return the camera in the base."""
        one, two = self.motions
        return composed(one.transform, [(two.transform, "moving")], np.array([self.seen]))

    def answers(self, T: Array) -> Answers:
        """Return what a pose of the camera leads to."""
        R = T[:3, :3]
        angle, axis = turned_about(R)
        found = {"rotation": R, "point": R @ self.seen + T[:3, 3], "base": inverse(T)[:3, 3]}
        return {**found, "angles": zyz_solutions(R), "angle": angle, "axis": axis}


def _draw_camera(draw: Draw) -> CameraTask:
    def around(low: float, high: float, step: float) -> tuple[float, float, float]:
        return draw.signed(low, high, step), draw.signed(low, high, step), draw.signed(low, high, step)

    rpy = (draw.signed(20.0, 150.0, 10.0), draw.signed(20.0, 60.0, 10.0), draw.signed(20.0, 150.0, 10.0))
    return CameraTask(
        around(0.3, 0.9, 0.1), rpy, around(0.05, 0.15, 0.05), draw.signed(20.0, 60.0, 10.0), around(0.1, 0.5, 0.1)
    )


def _solve(one: CameraTask) -> Answers:
    path = one.path()
    return {**one.answers(path.transforms[-1]), "point": path.points[0], "base": path.inverse[:3, 3]}


def _product_reversed(one: CameraTask) -> Answers:
    gripper, camera = (motion.transform for motion in one.motions)
    return one.answers(camera @ gripper)


def _moving_axes(one: CameraTask) -> Answers:
    gripper, camera = (motion.transform for motion in one.motions)
    return one.answers(transform(gripper[:3, 3], rpy_rotation(np.radians(one.rpy), reverse=True)) @ camera)


def _with_origin(one: CameraTask, origin: Array) -> Answers:
    found = one.answers(transform(origin, _solve(one)["rotation"]))
    return {"point": found["point"], "base": found["base"]}


def _camera_steps(one: CameraTask) -> list[Step]:
    path = one.path()
    found = notations(path.transforms[-1][:3, :3])
    given = [given_step(motion, i, 2) for i, motion in enumerate(one.motions, start=1)]
    composition = [composition_step(one.motions, path), points_step(path, one.motions), inverse_step(path)]
    return [*given, *composition, zyz_step(found), axis_angle_step(found)]


def _camera_text(one: CameraTask) -> str:
    roll, pitch, yaw = one.rpy
    return _(
        "A gripper has its origin at ({gripper}) m in frame 0, and is turned about the fixed axes of frame 0: first by "
        "{roll:g}° about x, then by {pitch:g}° about y, then by {yaw:g}° about z. A camera is fixed to it, with its "
        "origin at ({camera}) m in the gripper's frame and turned against it by {tilt:g}° about the gripper's y axis. "
        "In its own frame c the camera sees a point at ({seen}) m.\n\n"
        "Which rotation matrix R^0_c has the camera in frame 0? Where is the point in frame 0? Where does the camera "
        "have the origin of frame 0, in frame c? Which ZYZ angles (φ, ϑ, ψ) has the camera in frame 0, all solutions "
        "with angles between -π and π? About which axis, a unit vector, and by which angle between 0 and π is it "
        "turned against frame 0?"
    ).format(
        gripper=number_list(one.gripper),
        roll=roll,
        pitch=pitch,
        yaw=yaw,
        camera=number_list(one.camera),
        tilt=one.tilt,
        seen=number_list(one.seen),
    )


CAMERA = Exercise(
    id="poses.camera",
    title=marked("Exam: a camera on a gripper"),
    difficulty=5,
    draw=_draw_camera,
    is_degenerate=lambda one: is_plain(one.path().transforms[-1][:3, :3]),
    text=_camera_text,
    fields=lambda _one: (
        rotation_field("rotation", _("Rotation matrix R^0_c"), 3.0),
        point_field("point", _("Point in frame 0"), 2.0),
        point_field("base", _("Origin of frame 0 in frame c"), 2.0),
        solution_set(angles("angles", _("All (φ, ϑ, ψ)"), 3), 3.0),
        angle("angle", _("Angle ϑ")),
        axis_field("axis", _("Unit vector r of the axis")),
    ),
    solve=_solve,
    steps=_camera_steps,
    wrong={
        "product_reversed": _product_reversed,
        "moving_for_fixed": _moving_axes,
        "offset_not_turned": lambda one: _with_origin(one, np.add(one.gripper, one.camera)),
        "offset_left_out": lambda one: _with_origin(one, np.array(one.gripper)),
        "origin_only_negated": lambda one: {"base": -one.path().transforms[-1][:3, 3]},
        "quadrant": lambda one: {"angles": without_quadrant(_solve(one)["rotation"])},
        "flip_incomplete": lambda one: {"angles": flipped_without_last(_solve(one)["rotation"])},
    },
)
