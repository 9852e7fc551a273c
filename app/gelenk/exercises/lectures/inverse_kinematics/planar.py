"""Arms in a plane: the triangle of two links by the law of cosines, then two and three links."""

import math
from typing import TYPE_CHECKING, Annotated, NamedTuple

import numpy as np

from gelenk.course.steps import Step, step, tex
from gelenk.course.triangle.triangle import SolvedTriangle, solved_triangle
from gelenk.course.triangle.triangle_steps import triangle_steps
from gelenk.exercises.draw import Draw, drawn
from gelenk.exercises.exercise import Answers, Exercise
from gelenk.exercises.fields import angles, quantity, solution_set
from gelenk.exercises.lectures.inverse_kinematics.by_hand import revolute, solutions, steps_by_hand
from gelenk.language import marked, translated as _
from gelenk.robot.arrays import Array
from gelenk.robot.dh import DhTable
from gelenk.robot.poses import transform

if TYPE_CHECKING:
    from matplotlib.figure import Figure

_DIRECTION = math.radians(20.0)


class TwoLinkTriangle(NamedTuple):
    """Two links, and the distance of the tip from the base, [m]."""

    first: Annotated[float, Draw.decimal, 0.3, 0.8, 0.05]
    second: Annotated[float, Draw.decimal, 0.2, 0.7, 0.05]
    distance: Annotated[float, Draw.decimal, 0.3, 1.3, 0.05]

    @property
    def parts(self) -> dict[str, float]:
        """The sides as those of a triangle with the elbow at A, the base at B and the tip at C."""
        return {"a": self.distance, "b": self.second, "c": self.first}

    def solved(self) -> SolvedTriangle:
        """Return the triangle."""
        return solved_triangle(self.parts)


def _is_slender(one: TwoLinkTriangle) -> bool:
    longest = max(one)
    if 2.0 * longest > 0.97 * sum(one) or one.first == one.second:
        return True
    alpha, beta, _gamma = one.solved().triangles[0].angles
    return abs(alpha - 0.5 * math.pi) < 0.15 or beta < 0.15


def _answers(one: TwoLinkTriangle) -> Answers:
    alpha, beta, _gamma = one.solved().triangles[0].angles
    return {"alpha": alpha, "beta": beta, "bend": math.pi - alpha}


def _by_cosine(one: TwoLinkTriangle, factor: float) -> Answers:
    """Return what a wrong factor before 2 l₁ l₂ cos α and 2 l₁ r cos β leads to."""
    squares = [length**2 for length in one]
    alpha = math.acos((squares[0] + squares[1] - squares[2]) / (factor * one.first * one.second))
    beta = math.acos((squares[0] + squares[2] - squares[1]) / (factor * one.first * one.distance))
    return {"alpha": alpha, "beta": beta, "bend": math.pi - alpha}


def _steps(one: TwoLinkTriangle) -> list[Step]:
    sides = _("The links and the line from the base to the tip are the sides: a = r, b = l2, c = l1.")
    lines = [f"a = {tex(one.distance, 'm')}", f"b = {tex(one.second, 'm')}", f"c = {tex(one.first, 'm')}"]
    bend = _("The second joint is at 0 where the arm is stretched, and α is π.")
    return [
        step(_("The triangle of the arm"), sides, *lines),
        *triangle_steps(one.solved(), one.parts),
        step(_("Second joint"), bend, rf"|\vartheta_2| = \pi - \alpha = {tex(_answers(one)['bend'], 'rad')}"),
    ]


def _picture(one: TwoLinkTriangle) -> "Figure":
    from gelenk.plots.course.planar_arm import elbows_figure  # noqa: PLC0415

    x, y = one.distance * np.array([math.cos(_DIRECTION), math.sin(_DIRECTION)])
    return elbows_figure((one.first, one.second), (float(x), float(y)))


TRIANGLE = Exercise(
    id="inverse_kinematics.triangle",
    title=marked("The triangle of two links"),
    difficulty=1,
    draw=drawn(TwoLinkTriangle),
    is_degenerate=_is_slender,
    text=lambda one: _(
        "A planar arm has two links, l1 = {first:g} m and l2 = {second:g} m; its tip is at the distance r = "
        "{distance:g} m from its base. Which angle α is between the links at the elbow, which angle β at the base "
        "between the first link and the line to the tip, and how large is |ϑ2|, the angle of the second joint, which "
        "is 0 when the arm is stretched?"
    ).format(**one._asdict()),
    fields=lambda _one: (
        quantity("alpha", _("Angle α at the elbow"), "rad", within=0.005),
        quantity("beta", _("Angle β at the base"), "rad", within=0.005),
        quantity("bend", "|ϑ2|", "rad", within=0.005),
    ),
    solve=_answers,
    steps=_steps,
    wrong={
        "inner_for_outer": lambda one: {"alpha": _answers(one)["bend"], "bend": _answers(one)["alpha"]},
        "two_of_cosines_forgotten": lambda one: _by_cosine(one, 1.0),
        "cosine_sign": lambda one: {"beta": _by_cosine(one, -2.0)["beta"]},
        "angle_at_tip": lambda one: {"beta": one.solved().triangles[0].angles[2]},
    },
    picture=_picture,
)


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

    first: Annotated[float, Draw.decimal, 0.3, 0.8, 0.05]
    second: Annotated[float, Draw.decimal, 0.2, 0.7, 0.05]
    x: Annotated[float, Draw.signed, 0.1, 0.9, 0.05]
    y: Annotated[float, Draw.signed, 0.1, 0.9, 0.05]

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
    draw=drawn(TwoLinks),
    is_degenerate=lambda one: one.first == one.second or _is_awkward(*one),
    text=lambda one: _(
        "A planar arm has two revolute joints and the links l1 = {first:g} m and l2 = {second:g} m; at ϑ = 0 it is "
        "stretched along x. With which joint angles (ϑ1, ϑ2), in radians, is its tip at ({x:g}, {y:g}) m? Give all "
        "solutions."
    ).format(**one._asdict()),
    fields=lambda _one: (solution_set(angles("solutions", _("All (ϑ1, ϑ2)"), 2), 2.0),),
    solve=lambda one: {"solutions": one.answers()},
    steps=lambda one: steps_by_hand(one.table, level_pose(one.x, one.y), _XY),
    wrong={
        "other_elbow": lambda one: {"solutions": swapped_elbows(one.answers())},
        "inner_for_outer": lambda one: {"solutions": inner_elbows(one.answers())},
        "quadrant": _without_quadrant,
        "lengths_exchanged": lambda one: one._replace(first=one.second, second=one.first),
        "y_before_x": lambda one: one._replace(x=one.y, y=one.x),
    },
    picture=lambda one: _pictured(one.first, one.second),
)


# Three links


class ThreeLinks(NamedTuple):
    """Three links and a point, [m], and the direction of the last link, in degrees."""

    first: Annotated[float, Draw.decimal, 0.4, 0.8, 0.05]
    second: Annotated[float, Draw.decimal, 0.3, 0.7, 0.05]
    third: Annotated[float, Draw.decimal, 0.1, 0.3, 0.05]
    x: Annotated[float, Draw.signed, 0.1, 0.9, 0.05]
    y: Annotated[float, Draw.signed, 0.1, 0.9, 0.05]
    phi: Annotated[float, Draw.signed, 10.0, 170.0, 5.0]

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


def _absolute(one: ThreeLinks) -> list[Array]:
    return [np.array([q[0], q[1], math.radians(one.phi)]) for q in one.answers()]


def _one_taken_off(one: ThreeLinks) -> list[Array]:
    return [np.array([q[0], q[1], math.radians(one.phi) - q[1]]) for q in one.answers()]


THREE_LINKS = Exercise(
    id="inverse_kinematics.three_links",
    title=marked("A planar arm of three links and its orientation"),
    difficulty=3,
    draw=drawn(ThreeLinks),
    is_degenerate=lambda one: len(set(one[:3])) < 3 or _is_awkward(one.first, one.second, *one.wrist()),
    text=lambda one: _(
        "A planar arm has three revolute joints and the links l1 = {first:g} m, l2 = {second:g} m and l3 = {third:g} "
        "m; at ϑ = 0 it is stretched along x. Its tip is to be at ({x:g}, {y:g}) m, and its last link in the direction "
        "φ = {phi:g}° against x. With which joint angles (ϑ1, ϑ2, ϑ3), in radians? Give all solutions."
    ).format(**one._asdict()),
    fields=lambda _one: (solution_set(angles("solutions", _("All (ϑ1, ϑ2, ϑ3)"), 3), 3.0),),
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
