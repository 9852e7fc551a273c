"""SCARA and the anthropomorphic arm."""

import math
from typing import Annotated, NamedTuple

import numpy as np

from gelenk.exercises import sketches
from gelenk.exercises.draw import Draw, drawn
from gelenk.exercises.exercise import Answers, Exercise
from gelenk.exercises.fields import angles, quantity, solution_set
from gelenk.exercises.lectures.inverse_kinematics.by_hand import POSITION, revolute, solutions, steps_by_hand
from gelenk.exercises.lectures.inverse_kinematics.planar import inner_elbows, level_pose, swapped_elbows
from gelenk.exercises.table_field import table_of
from gelenk.language import marked, translated as _
from gelenk.robot.arrays import Array
from gelenk.robot.dh import DhTable
from gelenk.robot.poses import transform

_SQUARE = 0.5 * math.pi


class Scara(NamedTuple):
    """A SCARA whose tool points down: lengths and position in metres, direction φ of its x axis in degrees."""

    height: Annotated[float, Draw.decimal, 0.4, 0.7, 0.05]
    first: Annotated[float, Draw.decimal, 0.2, 0.6, 0.05]
    second: Annotated[float, Draw.decimal, 0.2, 0.6, 0.05]
    tool: Annotated[float, Draw.decimal, 0.05, 0.15, 0.05]
    x: Annotated[float, Draw.signed, 0.1, 0.7, 0.05]
    y: Annotated[float, Draw.signed, 0.1, 0.7, 0.05]
    z: Annotated[float, Draw.decimal, 0.05, 0.4, 0.05]
    phi: Annotated[float, Draw.signed, 10.0, 170.0, 5.0]

    @property
    def table(self) -> DhTable:
        """The arm."""
        rows = [[self.first, 0.0, self.height, 0.0], [self.second, math.pi, 0.0, 0.0], [0.0] * 4]
        return table_of(np.array([*rows, [0.0, 0.0, self.tool, 0.0]]), (False, False, True, False))

    @property
    def pose(self) -> Array:
        """Pose of frame 4."""
        down = np.diag([1.0, -1.0, -1.0, 1.0])
        return transform(np.array([0.0, 0.0, self.z]), np.eye(3)) @ self.level() @ down

    def level(self) -> Array:
        """Return the pose without its height, z up."""
        return level_pose(self.x, self.y, math.radians(self.phi))

    def angles(self) -> list[Array]:
        """Return ϑ1, ϑ2 and ϑ4 of both solutions."""
        return [q[[0, 1, 3]] for q in solutions(self.table, self.pose)]


def _is_awkward_scara(one: Scara) -> bool:
    cosine = (one.x**2 + one.y**2 - one.first**2 - one.second**2) / (2.0 * one.first * one.second)
    slide = one.height - one.tool - one.z
    return not 0.15 < abs(cosine) < 0.9 or one.first == one.second or not 0.05 <= slide <= 0.4 or slide == one.z


SCARA = Exercise(
    id="inverse_kinematics.scara",
    title=marked("Inverse kinematics of a SCARA"),
    difficulty=3,
    draw=drawn(Scara),
    is_degenerate=_is_awkward_scara,
    text=lambda one: _(
        "A SCARA has the standard DH rows (a, α, d, ϑ): ({first:g} m, 0, {height:g} m, ϑ1), ({second:g} m, 180°, 0, "
        "ϑ2), (0, 0, d3, 0), (0, 0, {tool:g} m, ϑ4). Frame 4 is to be at ({x:g}, {y:g}, {z:g}) m with its z axis down "
        "and its x axis in the direction φ = {phi:g}° against x of the base. Which d3 does that take, and which angles "
        "(ϑ1, ϑ2, ϑ4), in radians? Give all solutions."
    ).format(**one._asdict()),
    fields=lambda _one: (
        quantity("slide", "d3", "m", within=0.002),
        solution_set(angles("angles", _("All (ϑ1, ϑ2, ϑ4)"), 3), 3.0),
    ),
    solve=lambda one: {"slide": float(solutions(one.table, one.pose)[0][2]), "angles": one.angles()},
    steps=lambda one: steps_by_hand(one.table, one.pose),
    wrong={
        "tool_left_out": lambda one: {"slide": one.height - one.z},
        "base_height_left_out": lambda one: {"slide": -one.z - one.tool},
        "counted_upwards": lambda one: {"angles": [np.array([*q[:2], -q[2]]) for q in one.angles()]},
        "other_elbow": lambda one: {"angles": swapped_elbows(one.angles())},
        "inner_for_outer": lambda one: {"angles": inner_elbows(one.angles())},
    },
    sketch=sketches.scara,
)


# The anthropomorphic arm


class ShoulderArm(NamedTuple):
    """An anthropomorphic arm and a point, [m]."""

    height: Annotated[float, Draw.decimal, 0.2, 0.6, 0.05]
    upper: Annotated[float, Draw.decimal, 0.3, 0.7, 0.05]
    lower: Annotated[float, Draw.decimal, 0.2, 0.6, 0.05]
    x: Annotated[float, Draw.signed, 0.1, 0.7, 0.05]
    y: Annotated[float, Draw.signed, 0.1, 0.7, 0.05]
    z: Annotated[float, Draw.decimal, 0.1, 0.9, 0.05]

    @property
    def table(self) -> DhTable:
        """The arm."""
        return revolute((0.0, _SQUARE, self.height, 0.0), (self.upper, 0.0, 0.0, 0.0), (self.lower, 0.0, 0.0, 0.0))

    @property
    def pose(self) -> Array:
        """The point as a pose."""
        return transform(np.array([self.x, self.y, self.z]), np.eye(3))

    def answers(self) -> list[Array]:
        """Return the four solutions, those that face the point first."""
        return solutions(self.table, self.pose, POSITION)


def is_awkward_reach(upper: float, lower: float, out: float, up: float) -> bool:
    """Check whether two links do not reach a point in their plane, or nearly stretched, folded or square."""
    cosine = (out**2 + up**2 - upper**2 - lower**2) / (2.0 * upper * lower)
    return not 0.15 < abs(cosine) < 0.9 or out < 0.2


def _is_awkward_shoulder(arm: ShoulderArm) -> bool:
    up = arm.z - arm.height
    return arm.upper == arm.lower or abs(up) < 0.1 or is_awkward_reach(arm.upper, arm.lower, math.hypot(*arm[3:5]), up)


def not_mirrored(found: list[Array]) -> list[Array]:
    """Return the solutions that face the point, and these turned by half a turn alone."""
    return [*found[:2], *(q + np.array([math.pi, 0.0, 0.0]) for q in found[:2])]


def _only_x(arm: ShoulderArm) -> Answers:
    """Take x for the distance from the first axis."""
    found = arm._replace(x=abs(arm.x), y=0.0).answers()
    turn = math.atan2(arm.y, arm.x)
    return {"solutions": [q + np.array([turn, 0.0, 0.0]) for q in found]}


def _tangent_alone(arm: ShoulderArm) -> Answers:
    turn = math.atan(arm.y / arm.x)
    near, far = arm.answers()[:2], arm.answers()[2:]
    turned = [np.array([turn, *q[1:]]) for q in near] + [np.array([turn + math.pi, *q[1:]]) for q in far]
    return {"solutions": turned}


ANTHROPOMORPHIC = Exercise(
    id="inverse_kinematics.anthropomorphic",
    title=marked("Four solutions of an anthropomorphic arm"),
    difficulty=4,
    draw=drawn(ShoulderArm),
    is_degenerate=_is_awkward_shoulder,
    text=lambda arm: _(
        "An anthropomorphic arm has the standard DH rows (a, α, d, ϑ): (0, 90°, {height:g} m, ϑ1), ({upper:g} m, 0, 0, "
        "ϑ2), ({lower:g} m, 0, 0, ϑ3). With which joint angles (ϑ1, ϑ2, ϑ3), in radians, is its tip, the origin of "
        "frame 3, at ({x:g}, {y:g}, {z:g}) m? Give all solutions: shoulder to the front and to the back, elbow up and "
        "down."
    ).format(**arm._asdict()),
    fields=lambda _arm: (solution_set(angles("solutions", _("All (ϑ1, ϑ2, ϑ3)"), 3), 4.0),),
    solve=lambda arm: {"solutions": arm.answers()},
    steps=lambda arm: steps_by_hand(arm.table, arm.pose, POSITION),
    wrong={
        "base_height_left_out": lambda arm: arm._replace(height=0.0),
        "shoulder_not_mirrored": lambda arm: {"solutions": not_mirrored(arm.answers())},
        "projection_for_distance": _only_x,
        "quadrant": _tangent_alone,
        "other_elbow": lambda arm: {"solutions": [q * [1.0, 1.0, -1.0] for q in arm.answers()]},
        "inner_for_outer": lambda arm: {"solutions": inner_elbows(arm.answers(), 2)},
    },
    sketch=sketches.anthropomorphic,
)
