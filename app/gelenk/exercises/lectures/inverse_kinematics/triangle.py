"""The triangle of two links, by the law of cosines."""

import math
from typing import TYPE_CHECKING, NamedTuple

import numpy as np

from gelenk.course.steps import Step, step, tex
from gelenk.course.triangle.triangle import SolvedTriangle, solved_triangle
from gelenk.course.triangle.triangle_steps import triangle_steps
from gelenk.exercises.draw import Draw
from gelenk.exercises.exercise import Answers, Exercise
from gelenk.exercises.fields import NumberField
from gelenk.language import marked
from gelenk.language import translated as _

if TYPE_CHECKING:
    from matplotlib.figure import Figure

_DIRECTION = math.radians(20.0)


class TwoLinkTriangle(NamedTuple):
    """Two links, and the distance of the tip from the base, [m]."""

    first: float
    second: float
    distance: float

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


def _angle(name: str, label: str) -> NumberField:
    return NumberField(name=name, label=label, unit="rad", tolerance=0.005)


def _draw(draw: Draw) -> TwoLinkTriangle:
    return TwoLinkTriangle(draw.decimal(0.3, 0.8, 0.05), draw.decimal(0.2, 0.7, 0.05), draw.decimal(0.3, 1.3, 0.05))


TRIANGLE = Exercise(
    id="inverse_kinematics.triangle",
    title=marked("The triangle of two links"),
    difficulty=1,
    draw=_draw,
    is_degenerate=_is_slender,
    text=lambda one: _(
        "A planar arm has two links, l1 = {first:g} m and l2 = {second:g} m; its tip is at the distance r = "
        "{distance:g} m from its base. Which angle α is between the links at the elbow, which angle β at the base "
        "between the first link and the line to the tip, and how large is |ϑ2|, the angle of the second joint, which "
        "is 0 when the arm is stretched?"
    ).format(**one._asdict()),
    fields=lambda _one: (
        _angle("alpha", _("Angle α at the elbow")),
        _angle("beta", _("Angle β at the base")),
        _angle("bend", "|ϑ2|"),
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

EXERCISES = (TRIANGLE,)
