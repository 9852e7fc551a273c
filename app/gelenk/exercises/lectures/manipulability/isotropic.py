"""The arm of two links whose velocity ellipse is a circle."""

import math
from typing import NamedTuple

import numpy as np

from gelenk.course.steps import Step, step
from gelenk.course.velocity.writing import number
from gelenk.exercises.arms import in_plane, planar, radians
from gelenk.exercises.exercise import Answers, Exercise
from gelenk.exercises.fields import NumberField, SetField, quantity
from gelenk.language import marked
from gelenk.language import translated as _


class FirstLink(NamedTuple):
    """The first link of an arm to be designed, [m]."""

    l1: float


def _isotropic_answers(task: FirstLink) -> Answers:
    second = task.l1 / math.sqrt(2.0)
    sigmas = np.linalg.svd(in_plane(planar(task.l1, second), radians(0.0, 135.0)), compute_uv=False)
    return {"second": second, "bends": [135.0, -135.0], "semi_axis": float(sigmas[0])}


def _with_second(length: float) -> Answers:
    return {"second": length, "semi_axis": length}


def _isotropic_steps(task: FirstLink) -> list[Step]:
    found = _isotropic_answers(task)
    size = step(
        _("The radius"),
        _("Both semi-axes are the norm of a column."),
        rf"\sigma_1 = \sigma_2 = l_2 = {number(found['semi_axis'])}",
    )
    return [
        step(
            _("A circle"),
            _("The ellipse is a circle if the columns of J are orthogonal and of equal norm."),
            r"J^{\mathsf T} J = \sigma^2 I",
        ),
        step(
            _("Orthogonal columns"),
            _("The second column is across the second link; the first one is across the way from the base to the tip."),
            r"l_2 (l_2 + l_1 \cos\vartheta_2) = 0 \;\Rightarrow\; \cos\vartheta_2 = -\frac{l_2}{l_1}",
        ),
        step(
            _("Equal norms"),
            _("The tip is as far from the base as from the elbow."),
            r"l_1^2 + l_2^2 + 2 l_1 l_2 \cos\vartheta_2 = l_1^2 - l_2^2 = l_2^2",
            rf"l_2 = \frac{{l_1}}{{\sqrt{{2}}}} = {number(found['second'], 'm')},\quad \vartheta_2 = \pm 135^\circ",
        ),
        size,
    ]


def _bends() -> SetField:
    label = _("All such ϑ₂")
    item = NumberField(name="bends", label=label, unit="°", tolerance=0.5, is_angle=True)
    return SetField(name="bends", label=label, unit="°", item=item)


ISOTROPIC = Exercise(
    id="manipulability.isotropic",
    title=marked("An isotropic arm"),
    difficulty=3,
    draw=lambda draw: FirstLink(draw.decimal(0.2, 1.5, 0.02)),
    is_degenerate=lambda one: abs(one.l1 - 1.0) < 0.15,
    text=lambda one: _(
        "The first link of a planar arm of two revolute joints is l₁ = {l1:g} m long. How long must the second one "
        "be, and for which ϑ₂ between -180° and 180° is then the velocity ellipse of its tip a circle? How large is "
        "its radius for joint velocities of norm 1 rad/s?"
    ).format(**one._asdict()),
    fields=lambda _one: (
        quantity("second", _("Length of the second link"), "m"),
        _bends(),
        quantity("semi_axis", _("Radius of the circle"), "m/s"),
    ),
    solve=_isotropic_answers,
    steps=_isotropic_steps,
    wrong={
        "equal_links": lambda one: _with_second(one.l1),
        "root_inverted": lambda one: _with_second(one.l1 * math.sqrt(2.0)),
        "half_link": lambda one: _with_second(one.l1 / 2.0),
        "best_for_isotropic": lambda _one: {"bends": [90.0, -90.0]},
        "acute_for_obtuse": lambda _one: {"bends": [45.0, -45.0]},
    },
)

EXERCISES = (ISOTROPIC,)
