"""An exam: the ellipses of a redundant arm."""

from typing import NamedTuple

import numpy as np

from gelenk.course.steps import Step
from gelenk.exercises.arms import angles_not_summed, in_plane, planar, planar_picture, radians
from gelenk.exercises.draw import Draw
from gelenk.exercises.exercise import Answers, Exercise
from gelenk.exercises.fields import basis, matrix, quantity
from gelenk.exercises.lectures.manipulability.two_links import (
    ratios,
    ratios_by_shadow,
    ratios_exchanged,
    unit,
    worked,
)
from gelenk.language import marked
from gelenk.language import translated as _
from gelenk.robot.arrays import Array


class ThreeLinkPosture(NamedTuple):
    """A planar arm of three links, and a direction by its angle from the x axis; angles in degrees."""

    l1: float
    l2: float
    l3: float
    q1: float
    q2: float
    q3: float
    towards: float

    def jacobian(self, *, calculator: bool = False) -> Array:
        """Return J of v_x and v_y; `calculator` takes the degrees for radians. Shape (2, 3)."""
        q = np.array([self.q1, self.q2, self.q3])
        return in_plane(planar(self.l1, self.l2, self.l3), q if calculator else radians(*q))


def _draw_three(draw: Draw) -> ThreeLinkPosture:
    return ThreeLinkPosture(
        draw.decimal(0.3, 0.7, 0.1),
        draw.decimal(0.3, 0.6, 0.1),
        draw.decimal(0.2, 0.5, 0.1),
        draw.decimal(10.0, 80.0, 5.0),
        draw.signed(20.0, 100.0, 5.0),
        draw.signed(20.0, 100.0, 5.0),
        draw.signed(10.0, 80.0, 5.0),
    )


def _ellipse_answers(task: ThreeLinkPosture, J: Array) -> Answers:
    left, sigmas, _right = np.linalg.svd(J)
    return {
        "gram": J @ J.T,
        "measure": float(np.prod(sigmas)),
        "major": float(sigmas[0]),
        "minor": float(sigmas[1]),
        "axis": left[:, :1],
        "strongest": left[:, 1:],
        **ratios(J, unit(task.towards)),
    }


def _exchanged_axes(task: ThreeLinkPosture) -> Answers:
    found = _ellipse_answers(task, task.jacobian())
    return {"axis": found["strongest"], "strongest": found["axis"]}


def _not_summed(task: ThreeLinkPosture) -> Array:
    return angles_not_summed((task.l1, task.l2, task.l3), radians(task.q1, task.q2, task.q3))


def _ellipse_steps(task: ThreeLinkPosture) -> list[Step]:
    return worked(task.jacobian(), unit(task.towards)[None])


ELLIPSES = Exercise(
    id="manipulability.three_links",
    title=marked("Exam: the ellipses of three links"),
    difficulty=5,
    draw=_draw_three,
    is_degenerate=lambda one: not 1.5 < float(np.linalg.cond(one.jacobian())) < 15.0,
    text=lambda one: _(
        "A planar arm has three revolute joints and links of {l1:g} m, {l2:g} m and {l3:g} m. It stands at ϑ = "
        "({q1:g}°, {q2:g}°, {q3:g}°), each counted from the link before; J is the Jacobian of the position (x, y) of "
        "its tip. Joint velocities have the norm 1 rad/s, torques the norm 1 N m.\n\nFind the product of J with its "
        "transpose, Yoshikawa's measure, the semi-axes of the velocity ellipse, and the directions in which the tip "
        "is fastest and in which it is strongest. How fast can it move along the direction at {towards:g}° from the "
        "x axis alone, and which force can it exert along it alone?"
    ).format(**one._asdict()),
    fields=lambda _one: (
        matrix("gram", _("Product of J with its transpose"), (2, 2), "m²", 2.0),
        quantity("measure", _("Measure w"), "m²"),
        quantity("major", _("Major semi-axis"), "m/s"),
        quantity("minor", _("Minor semi-axis"), "m/s"),
        basis("axis", _("Direction in which it is fastest, as a column"), (2, 1)),
        basis("strongest", _("Direction in which it is strongest, as a column"), (2, 1)),
        quantity("velocity", _("Velocity along the direction"), "m/s"),
        quantity("force", _("Force along the direction"), "N"),
    ),
    solve=lambda one: _ellipse_answers(one, one.jacobian()),
    steps=_ellipse_steps,
    wrong={
        "last_joint_forgotten": lambda one: _ellipse_answers(one, one.jacobian()[:, :2]),
        "axes_exchanged": _exchanged_axes,
        "shadow_for_reach": lambda one: ratios_by_shadow(one.jacobian(), unit(one.towards)),
        "ratios_exchanged": lambda one: ratios_exchanged(one.jacobian(), unit(one.towards)),
        "angle_not_summed": lambda one: _ellipse_answers(one, _not_summed(one)),
        "calculator_mode": lambda one: _ellipse_answers(one, one.jacobian(calculator=True)),
    },
    picture=lambda one: planar_picture((one.l1, one.l2, one.l3), (one.q1, one.q2, one.q3)),
)

EXERCISES = (ELLIPSES,)
