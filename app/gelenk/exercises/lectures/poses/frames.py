"""Two rotations composed, and a homogeneous transform inverted."""

import math
from typing import Annotated, NamedTuple

import numpy as np

from gelenk.course.orientation.orientation_steps import (
    GivenMotion,
    composition_step,
    given_step,
    inverse_step,
    points_step,
)
from gelenk.course.orientation.rotations import AxisName, Composition, composed, elementary
from gelenk.course.steps import Step, step
from gelenk.course.writing import vector
from gelenk.exercises.arms import misread
from gelenk.exercises.draw import Draw, drawn
from gelenk.exercises.exercise import Answers, Exercise
from gelenk.exercises.fields import MatrixField, VectorField, matrix
from gelenk.language import marked, translated as _
from gelenk.robot.arrays import Array
from gelenk.robot.poses import inverse, transform

AXES: tuple[AxisName, AxisName, AxisName] = ("x", "y", "z")


def turn(axis: AxisName, angle: float) -> GivenMotion:
    """Return an elementary rotation by an angle in degrees, as the steps need it."""
    turned = math.radians(angle)
    return GivenMotion("elementary", np.array([turned]), axis, transform(np.zeros(3), elementary(axis, turned)))


def point_field(name: str, label: str, points: float = 1.0) -> VectorField:
    """Return the field of a position, to 3 mm."""
    return VectorField(name=name, label=label, unit="m", tolerance=0.003, size=3, points=points)


def rotation_field(name: str, label: str, points: float = 1.0) -> MatrixField:
    """Return the field of a rotation matrix."""
    return MatrixField(name=name, label=label, tolerance=0.003, rows=3, columns=3, points=points)


class TwoTurns(NamedTuple):
    """Two rotations in degrees, and a point of frame 2, [m]."""

    first_axis: AxisName
    first: float
    second_axis: AxisName
    second: float
    x: float
    y: float
    z: float

    @property
    def point(self) -> Array:
        """The point in frame 2; shape (3,)."""
        return np.array([self.x, self.y, self.z])

    @property
    def motions(self) -> tuple[GivenMotion, GivenMotion]:
        """Both rotations."""
        return turn(self.first_axis, self.first), turn(self.second_axis, self.second)

    def path(self) -> Composition:
        """Return the composition about the moving axes."""
        one, two = self.motions
        return composed(one.transform, [(two.transform, "moving")], self.point[None])

    def answers(self) -> Answers:
        """Return what both rotations lead to."""
        path = self.path()
        return {"rotation": path.transforms[-1][:3, :3], "point": path.points[0]}


def _draw_turns(draw: Draw) -> TwoTurns:
    one, two = draw.sample(AXES, 2)
    angles = draw.signed(20.0, 150.0, 5.0), draw.signed(20.0, 150.0, 5.0)
    point = (draw.signed(0.1, 0.9, 0.1), draw.signed(0.1, 0.9, 0.1), draw.signed(0.1, 0.9, 0.1))
    return TwoTurns(one, angles[0], two, angles[1], *point)


def _turned(R: Array, point: Array) -> Answers:
    return {"rotation": R, "point": R @ point}


def _fixed_axes(one: TwoTurns) -> Answers:
    first, second = (motion.transform[:3, :3] for motion in one.motions)
    return _turned(second @ first, one.point)


def _minus_above(one: TwoTurns) -> Answers:
    """Take the matrix about y with the minus sign where those about x and z have it."""
    first, second = (
        R.T if axis == "y" else R
        for axis, R in zip(
            (one.first_axis, one.second_axis), (motion.transform[:3, :3] for motion in one.motions), strict=True
        )
    )
    return _turned(first @ second, one.point)


def _turn_steps(one: TwoTurns) -> list[Step]:
    path = one.path()
    motions = [given_step(motion, i, 2) for i, motion in enumerate(one.motions, start=1)]
    return [*motions, composition_step(one.motions, path), points_step(path, one.motions)]


TURNS = Exercise(
    id="poses.turns",
    title=marked("Two rotations about moving axes"),
    difficulty=1,
    draw=_draw_turns,
    text=lambda one: _(
        "Frame 1 is frame 0 turned about its {first_axis} axis by {first:g}°. Frame 2 is frame 1 turned about the "
        "{second_axis} axis of frame 1 by {second:g}°. Which rotation matrix R^0_2 has frame 2 in frame 0? A point has "
        "the coordinates ({x:g}, {y:g}, {z:g}) m in frame 2: which ones has it in frame 0?"
    ).format(**one._asdict()),
    fields=lambda _one: (
        rotation_field("rotation", _("Rotation matrix R^0_2"), 2.0),
        point_field("point", _("Point in frame 0")),
    ),
    solve=lambda one: one.answers(),
    steps=_turn_steps,
    wrong={
        "fixed_for_moving": _fixed_axes,
        "turned_clockwise": lambda one: one._replace(first=-one.first, second=-one.second),
        "degrees_in_radians": lambda one: misread(one, "first", "second"),
        "minus_of_y": _minus_above,
        "turned_back": lambda one: {"point": one.answers()["rotation"].T @ one.point},
        "second_turn_forgotten": lambda one: one._replace(second=0.0),
    },
)


# The inverse


class TurnedFrame(NamedTuple):
    """A frame that is turned by degrees and stands elsewhere, and a point of frame 0, [m]."""

    axis: Annotated[AxisName, Draw.choice, AXES]
    angle: Annotated[float, Draw.signed, 20.0, 160.0, 5.0]
    x: Annotated[float, Draw.signed, 0.2, 0.9, 0.1]
    y: Annotated[float, Draw.signed, 0.2, 0.9, 0.1]
    z: Annotated[float, Draw.signed, 0.2, 0.9, 0.1]
    u: Annotated[float, Draw.signed, 0.1, 0.9, 0.1]
    v: Annotated[float, Draw.signed, 0.1, 0.9, 0.1]
    w: Annotated[float, Draw.signed, 0.1, 0.9, 0.1]

    @property
    def rotation(self) -> Array:
        """R^0_1; shape (3, 3)."""
        return turn(self.axis, self.angle).transform[:3, :3]

    @property
    def origin(self) -> Array:
        """Origin of frame 1; shape (3,)."""
        return np.array([self.x, self.y, self.z])

    def through(self, R: Array, p: Array) -> Answers:
        """Return a transform, and what it makes of the point."""
        return {"inverse": transform(p, R), "point": R @ np.array([self.u, self.v, self.w]) + p}


def _inverse_answers(one: TurnedFrame) -> Answers:
    back = inverse(transform(one.origin, one.rotation))
    return one.through(back[:3, :3], back[:3, 3])


def _inverse_steps(one: TurnedFrame) -> list[Step]:
    path = composed(transform(one.origin, one.rotation), [], np.empty((0, 3)))
    line = rf"p^1 = R^T p^0 - R^T p^0_1 = {vector(_inverse_answers(one)['point'])}"
    return [
        given_step(turn(one.axis, one.angle), 1, 1),
        inverse_step(path),
        step(_("Point"), _("The inverse transform leads from coordinates in frame 0 to those in frame 1."), line),
    ]


INVERSE = Exercise(
    id="poses.inverse",
    title=marked("Inverse of a homogeneous transform"),
    difficulty=1,
    draw=drawn(TurnedFrame),
    text=lambda one: _(
        "Frame 1 has its origin at ({x:g}, {y:g}, {z:g}) m in frame 0, and is turned against it about the {axis} axis "
        "by {angle:g}°. Which matrix is the inverse of T^0_1, so that it leads from coordinates in frame 0 to those in "
        "frame 1? Which coordinates has the point ({u:g}, {v:g}, {w:g}) m of frame 0 in frame 1?"
    ).format(**one._asdict()),
    fields=lambda _one: (
        matrix("inverse", _("Inverse of T^0_1"), (4, 4), points=2.0, within=0.003),
        point_field("point", _("Point in frame 1")),
    ),
    solve=_inverse_answers,
    steps=_inverse_steps,
    wrong={
        "origin_only_negated": lambda one: one.through(one.rotation.T, -one.origin),
        "origin_not_negated": lambda one: one.through(one.rotation.T, one.rotation.T @ one.origin),
        "rotation_not_transposed": lambda one: one.through(one.rotation, -one.rotation @ one.origin),
        "inverse_transform": lambda one: one.through(one.rotation, one.origin),
    },
)
