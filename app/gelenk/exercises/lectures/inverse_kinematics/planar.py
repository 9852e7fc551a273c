"""Two and three links in a plane."""

import math
from typing import TYPE_CHECKING, NamedTuple

import numpy as np

from gelenk.exercises.exercise import Answers, Exercise
from gelenk.exercises.lectures.inverse_kinematics.by_hand import joints_field, revolute, solutions, steps_by_hand
from gelenk.language import marked
from gelenk.language import translated as _
from gelenk.robot.arrays import Array
from gelenk.robot.dh import DhTable
from gelenk.robot.poses import transform

if TYPE_CHECKING:
    from matplotlib.figure import Figure

_XY = frozenset("xy")
_GENERIC = (0.6, 0.9, -0.5)
"""A configuration to show the names of lengths and angles, [rad]."""


def level_pose(x: float, y: float, phi: float = 0.0) -> Array:
    """Return a pose in the plane, turned by an angle [rad]."""
    c, s = math.cos(phi), math.sin(phi)
    return transform(np.array([x, y, 0.0]), np.array([[c, -s, 0.0], [s, c, 0.0], [0.0, 0.0, 1.0]]))


def swapped_elbows(found: list[Array]) -> list[Array]:
    """Return two solutions with the second angle of the other one each."""
    one, two = found
    return [np.array([one[0], two[1], *one[2:]]), np.array([two[0], one[1], *two[2:]])]


def inner_elbows(found: list[Array], k: int = 1) -> list[Array]:
    """Return solutions with the angle between the links in place of the joint's, joint `k` counted from 0."""
    changed = [q.copy() for q in found]
    for q in changed:
        q[k] = math.copysign(math.pi, q[k]) - q[k]
    return changed


def _is_awkward(first: float, second: float, x: float, y: float) -> bool:
    """Check whether a point is out of reach, or the arm nearly stretched, folded or square there."""
    cosine = (x * x + y * y - first**2 - second**2) / (2.0 * first * second)
    return not 0.15 < abs(cosine) < 0.9 or math.hypot(x, y) < 0.2


class TwoLinks(NamedTuple):
    """Two links and a point, [m]."""

    first: float
    second: float
    x: float
    y: float

    @property
    def table(self) -> DhTable:
        """The arm."""
        return revolute((self.first, 0.0, 0.0, 0.0), (self.second, 0.0, 0.0, 0.0))

    def answers(self) -> list[Array]:
        """Return both solutions."""
        return solutions(self.table, level_pose(self.x, self.y), _XY)


def _without_quadrant(one: TwoLinks) -> Answers:
    turn = math.atan(one.y / one.x) - math.atan2(one.y, one.x)
    return {"solutions": [q + np.array([turn, 0.0]) for q in one.answers()]}


def _pictured(*lengths: float) -> "Figure":
    """Draw an arm with the names of its lengths and angles, elsewhere than it is asked for."""
    from gelenk.plots.course.planar_arm import PlanarJoint, planar_arm_figure  # noqa: PLC0415

    pairs = zip(_GENERIC, lengths, strict=False)
    return planar_arm_figure([PlanarJoint("R", angle, length) for angle, length in pairs])


TWO_LINKS = Exercise(
    id="inverse_kinematics.two_links",
    title=marked("Both elbows of a planar arm"),
    difficulty=2,
    draw=lambda draw: TwoLinks(
        draw.decimal(0.3, 0.8, 0.05),
        draw.decimal(0.2, 0.7, 0.05),
        draw.signed(0.1, 0.9, 0.05),
        draw.signed(0.1, 0.9, 0.05),
    ),
    is_degenerate=lambda one: one.first == one.second or _is_awkward(*one),
    text=lambda one: _(
        "A planar arm has two revolute joints and the links l1 = {first:g} m and l2 = {second:g} m; at ϑ = 0 it is "
        "stretched along x. With which joint angles (ϑ1, ϑ2), in radians, is its tip at ({x:g}, {y:g}) m? Give all "
        "solutions."
    ).format(**one._asdict()),
    fields=lambda _one: (joints_field("solutions", _("All (ϑ1, ϑ2)"), 2, 2.0),),
    solve=lambda one: {"solutions": one.answers()},
    steps=lambda one: steps_by_hand(one.table, level_pose(one.x, one.y), _XY),
    wrong={
        "other_elbow": lambda one: {"solutions": swapped_elbows(one.answers())},
        "inner_for_outer": lambda one: {"solutions": inner_elbows(one.answers())},
        "quadrant": _without_quadrant,
        "lengths_exchanged": lambda one: {"solutions": one._replace(first=one.second, second=one.first).answers()},
        "y_before_x": lambda one: {"solutions": one._replace(x=one.y, y=one.x).answers()},
    },
    picture=lambda one: _pictured(one.first, one.second),
)


# Three links


class ThreeLinks(NamedTuple):
    """Three links and a point, [m], and the direction of the last link, in degrees."""

    first: float
    second: float
    third: float
    x: float
    y: float
    phi: float

    @property
    def table(self) -> DhTable:
        """The arm."""
        return revolute(*((length, 0.0, 0.0, 0.0) for length in self[:3]))

    @property
    def pose(self) -> Array:
        """Pose of the last frame."""
        return level_pose(self.x, self.y, math.radians(self.phi))

    def wrist(self, sign: float = -1.0) -> tuple[float, float]:
        """Return the third axis, a link back from the tip; with +1 a link on, which is wrong."""
        phi, length = math.radians(self.phi), sign * self.third
        return self.x + length * math.cos(phi), self.y + length * math.sin(phi)

    def answers(self) -> list[Array]:
        """Return both solutions."""
        return solutions(self.table, self.pose)

    def at(self, x: float, y: float) -> list[Array]:
        """Return both solutions with the third axis at a point."""
        phi = math.radians(self.phi)
        pairs = TwoLinks(self.first, self.second, x, y).answers()
        return [np.array([*q, phi - q[0] - q[1]]) for q in pairs]


def _is_useless(one: ThreeLinks) -> bool:
    return len(set(one[:3])) < 3 or _is_awkward(one.first, one.second, *one.wrist())


def _absolute(one: ThreeLinks) -> list[Array]:
    return [np.array([q[0], q[1], math.radians(one.phi)]) for q in one.answers()]


def _one_taken_off(one: ThreeLinks) -> list[Array]:
    return [np.array([q[0], q[1], math.radians(one.phi) - q[1]]) for q in one.answers()]


THREE_LINKS = Exercise(
    id="inverse_kinematics.three_links",
    title=marked("A planar arm of three links and its orientation"),
    difficulty=3,
    draw=lambda draw: ThreeLinks(
        draw.decimal(0.4, 0.8, 0.05),
        draw.decimal(0.3, 0.7, 0.05),
        draw.decimal(0.1, 0.3, 0.05),
        draw.signed(0.1, 0.9, 0.05),
        draw.signed(0.1, 0.9, 0.05),
        draw.signed(10.0, 170.0, 5.0),
    ),
    is_degenerate=_is_useless,
    text=lambda one: _(
        "A planar arm has three revolute joints and the links l1 = {first:g} m, l2 = {second:g} m and l3 = {third:g} "
        "m; at ϑ = 0 it is stretched along x. Its tip is to be at ({x:g}, {y:g}) m, and its last link in the direction "
        "φ = {phi:g}° against x. With which joint angles (ϑ1, ϑ2, ϑ3), in radians? Give all solutions."
    ).format(**one._asdict()),
    fields=lambda _one: (joints_field("solutions", _("All (ϑ1, ϑ2, ϑ3)"), 3, 3.0),),
    solve=lambda one: {"solutions": one.answers()},
    steps=lambda one: steps_by_hand(one.table, one.pose),
    wrong={
        "third_link_left_out": lambda one: {"solutions": one.at(one.x, one.y)},
        "third_axis_beyond": lambda one: {"solutions": one.at(*one.wrist(1.0))},
        "direction_for_angle": lambda one: {"solutions": _absolute(one)},
        "first_angle_not_taken_off": lambda one: {"solutions": _one_taken_off(one)},
        "other_elbow": lambda one: {"solutions": swapped_elbows(one.answers())},
        "inner_for_outer": lambda one: {"solutions": inner_elbows(one.answers())},
    },
    picture=lambda one: _pictured(*one[:3]),
)

EXERCISES = (TWO_LINKS, THREE_LINKS)
