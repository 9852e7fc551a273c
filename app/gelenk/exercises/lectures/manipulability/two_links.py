"""The planar arm of two links: its measure, its velocity and force ellipses, and its transmission ratios."""

import math
from typing import Annotated, NamedTuple

import numpy as np

from gelenk.course.steps import Step, step
from gelenk.course.velocity.ellipsoid_steps import EllipsoidQuestion, ellipsoid_steps
from gelenk.course.velocity.writing import number
from gelenk.exercises.arms import angles_not_summed, jacobian, misread, planar_picture
from gelenk.exercises.draw import Draw, drawn
from gelenk.exercises.exercise import Answers, Exercise
from gelenk.exercises.fields import basis, quantity
from gelenk.language import marked, translated as _
from gelenk.robot.arrays import Array

NO_DIRECTION = np.zeros((0, 2))
_SINGULAR = 1e6
"""Condition number from which a wrong model is left out."""


class TwoLinkPosture(NamedTuple):
    """A planar arm at rest; angles in degrees."""

    l1: Annotated[float, Draw.decimal, 0.3, 1.2, 0.1]
    l2: Annotated[float, Draw.decimal, 0.3, 1.0, 0.1]
    q1: Annotated[float, Draw.decimal, 10.0, 80.0, 5.0]
    q2: Annotated[float, Draw.signed, 20.0, 150.0, 5.0]


class TwoLinkDirection(NamedTuple):
    """A planar arm, and a direction by its angle from the x axis; angles in degrees."""

    l1: Annotated[float, Draw.decimal, 0.3, 1.2, 0.1]
    l2: Annotated[float, Draw.decimal, 0.3, 1.0, 0.1]
    q1: Annotated[float, Draw.decimal, 10.0, 80.0, 5.0]
    q2: Annotated[float, Draw.signed, 20.0, 150.0, 5.0]
    towards: Annotated[float, Draw.signed, 10.0, 80.0, 5.0]


def worked(J: Array, directions: Array = NO_DIRECTION) -> list[Step]:
    """Return the derivation of the ellipses of a regular J with two rows."""
    return ellipsoid_steps(EllipsoidQuestion("translation", J, np.eye(2), 2, 2, directions))


def unit(degrees: float) -> Array:
    """Return the direction at an angle from the x axis; shape (2,)."""
    angle = math.radians(degrees)
    return np.array([math.cos(angle), math.sin(angle)])


def ratios(J: Array, u: Array) -> Answers:
    """Return how far the velocity and the force ellipse reach along u; raises ZeroDivisionError where J is singular."""
    if np.linalg.cond(J) > _SINGULAR:
        raise ZeroDivisionError
    inverse = np.linalg.inv(J @ J.T)
    return {"velocity": float(u @ inverse @ u) ** -0.5, "force": float(u @ J @ J.T @ u) ** -0.5}


def ratios_by_shadow(J: Array, u: Array) -> Answers:
    """Return how far the shadows of both ellipses reach along u."""
    found = ratios(J, u)
    return {"velocity": 1.0 / found["force"], "force": 1.0 / found["velocity"]}


def ratios_exchanged(J: Array, u: Array) -> Answers:
    """Return the ratios of velocity and force the wrong way round."""
    found = ratios(J, u)
    return {"velocity": found["force"], "force": found["velocity"]}


def _measure_answers(task: TwoLinkPosture, share: float) -> Answers:
    most = task.l1 * task.l2
    return {"measure": most * share, "area": math.pi * most * share}


def _measure_right(task: TwoLinkPosture) -> Answers:
    measure = float(np.prod(np.linalg.svd(jacobian(task), compute_uv=False)))
    return {"measure": measure, "area": math.pi * measure, "best": task.l1 * task.l2}


def _measure_steps(task: TwoLinkPosture) -> list[Step]:
    best = step(
        _("The best posture"),
        _("The measure is largest where the sine is one: at a right angle between the links."),
        rf"w = l_1 l_2 \lvert \sin\vartheta_2 \rvert = {number(_measure_right(task)['measure'])}",
        rf"\vartheta_2 = \pm 90^\circ:\quad w = l_1 l_2 = {number(task.l1 * task.l2)}",
    )
    return [*worked(jacobian(task)), best]


MEASURE = Exercise(
    id="manipulability.measure",
    title=marked("Yoshikawa's measure of two links"),
    difficulty=1,
    draw=drawn(TwoLinkPosture),
    is_degenerate=lambda one: abs(math.sin(math.radians(one.q2))) > 0.97,
    text=lambda one: _(
        "A planar arm has two revolute joints and links of l₁ = {l1:g} m and l₂ = {l2:g} m. It stands at ϑ₁ = "
        "{q1:g}°, ϑ₂ = {q2:g}° (counted from the first link). Find Yoshikawa's measure w of the position (x, y) of "
        "its tip, the area of the velocity ellipse for joint velocities of norm 1 rad/s, and the largest w in any "
        "posture."
    ).format(**one._asdict()),
    fields=lambda _one: (
        quantity("measure", _("Measure w"), "m²"),
        quantity("area", _("Area of the velocity ellipse"), "m²/s²"),
        quantity("best", _("Largest w in any posture"), "m²"),
    ),
    solve=_measure_right,
    steps=_measure_steps,
    wrong={
        "cosine_for_sine": lambda one: _measure_answers(one, abs(math.cos(math.radians(one.q2)))),
        "angle_of_both": lambda one: _measure_answers(one, abs(math.sin(math.radians(one.q1 + one.q2)))),
        "pi_forgotten": lambda one: {"area": _measure_right(one)["measure"]},
        "area_of_square": lambda one: {"area": math.pi * _measure_right(one)["measure"] ** 2},
        "stretched_for_best": lambda one: {"best": (one.l1 + one.l2) ** 2},
        "calculator_mode": lambda one: _measure_answers(one, abs(math.sin(one.q2))),
    },
    picture=planar_picture,
)


def _velocity_answers(J: Array) -> Answers:
    left, sigmas, _right = np.linalg.svd(J)
    return {"major": float(sigmas[0]), "minor": float(sigmas[1]), "axis": left[:, :1]}


def _axis(J: Array, which: int, *, of_joints: bool = False) -> Answers:
    left, _sigmas, right = np.linalg.svd(J)
    return {"axis": (right.T if of_joints else left)[:, which : which + 1]}


def _is_round(task: TwoLinkPosture | TwoLinkDirection) -> bool:
    return float(np.linalg.cond(jacobian(task))) < 1.5


def _reciprocals(J: Array) -> Answers:
    found = _velocity_answers(J)
    return {"major": 1.0 / found["minor"], "minor": 1.0 / found["major"]}


def _column_norms(J: Array) -> Answers:
    sizes = sorted(np.linalg.norm(J, axis=0).tolist())
    return {"major": sizes[1], "minor": sizes[0]}


VELOCITY = Exercise(
    id="manipulability.velocity",
    title=marked("The velocity ellipse"),
    difficulty=2,
    draw=drawn(TwoLinkPosture),
    is_degenerate=_is_round,
    text=lambda one: _(
        "A planar arm has two revolute joints and links of l₁ = {l1:g} m and l₂ = {l2:g} m. It stands at ϑ₁ = "
        "{q1:g}°, ϑ₂ = {q2:g}° (counted from the first link). Its joint velocities have the norm 1 rad/s. Find the "
        "semi-axes of the velocity ellipse of its tip, and the direction of the major axis."
    ).format(**one._asdict()),
    fields=lambda _one: (
        quantity("major", _("Major semi-axis"), "m/s"),
        quantity("minor", _("Minor semi-axis"), "m/s"),
        basis("axis", _("Direction of the major axis, as a column"), (2, 1)),
    ),
    solve=lambda one: _velocity_answers(jacobian(one)),
    steps=lambda one: worked(jacobian(one)),
    wrong={
        "force_for_velocity": lambda one: _reciprocals(jacobian(one)),
        "columns_for_axes": lambda one: _column_norms(jacobian(one)),
        "axis_of_joints": lambda one: _axis(jacobian(one), 0, of_joints=True),
        "minor_for_major": lambda one: _axis(jacobian(one), 1),
        "angle_not_summed": lambda one: _velocity_answers(angles_not_summed(one)),
        "calculator_mode": misread,
    },
    picture=planar_picture,
)


def _force_answers(J: Array) -> Answers:
    left, sigmas, _right = np.linalg.svd(J)
    reach = {"major": float(1.0 / sigmas[1]), "minor": float(1.0 / sigmas[0])}
    return {**reach, "axis": left[:, 1:], "condition": float(sigmas[0] / sigmas[1])}


FORCE_ELLIPSE = Exercise(
    id="manipulability.force",
    title=marked("The force ellipse"),
    difficulty=3,
    draw=drawn(TwoLinkPosture),
    is_degenerate=_is_round,
    text=lambda one: _(
        "A planar arm has two revolute joints and links of l₁ = {l1:g} m and l₂ = {l2:g} m. It stands at ϑ₁ = "
        "{q1:g}°, ϑ₂ = {q2:g}° (counted from the first link). Its torques have the norm 1 N m. Find the semi-axes of "
        "the force ellipse of its tip, the direction in which it is strongest, and the condition number of the "
        "Jacobian of (x, y)."
    ).format(**one._asdict()),
    fields=lambda _one: (
        quantity("major", _("Major semi-axis"), "N"),
        quantity("minor", _("Minor semi-axis"), "N"),
        basis("axis", _("Direction in which it is strongest, as a column"), (2, 1)),
        quantity("condition", _("Condition number")),
    ),
    solve=lambda one: _force_answers(jacobian(one)),
    steps=lambda one: worked(jacobian(one)),
    wrong={
        "velocity_for_force": lambda one: _velocity_answers(jacobian(one)),
        "joint_direction": lambda one: _axis(jacobian(one), 1, of_joints=True),
        "angle_not_summed": lambda one: _force_answers(angles_not_summed(one)),
        "isotropy_for_condition": lambda one: {"condition": 1.0 / _force_answers(jacobian(one))["condition"]},
        "calculator_mode": misread,
    },
    picture=planar_picture,
)

TRANSMISSION = Exercise(
    id="manipulability.transmission",
    title=marked("Transmission ratios along a direction"),
    difficulty=4,
    draw=drawn(TwoLinkDirection),
    is_degenerate=_is_round,
    text=lambda one: _(
        "A planar arm has two revolute joints and links of l₁ = {l1:g} m and l₂ = {l2:g} m. It stands at ϑ₁ = "
        "{q1:g}°, ϑ₂ = {q2:g}° (counted from the first link). How fast can its tip move along the direction at "
        "{towards:g}° from the x axis, and in no other direction, with joint velocities of norm 1 rad/s? Which force "
        "along it can it exert, and no other force, with torques of norm 1 N m?"
    ).format(**one._asdict()),
    fields=lambda _one: (
        quantity("velocity", _("Velocity along the direction"), "m/s"),
        quantity("force", _("Force along the direction"), "N"),
    ),
    solve=lambda one: ratios(jacobian(one), unit(one.towards)),
    steps=lambda one: worked(jacobian(one), unit(one.towards)[None]),
    wrong={
        "shadow_for_reach": lambda one: ratios_by_shadow(jacobian(one), unit(one.towards)),
        "ratios_exchanged": lambda one: ratios_exchanged(jacobian(one), unit(one.towards)),
        "angle_not_summed": lambda one: ratios(angles_not_summed(one), unit(one.towards)),
        "calculator_mode": lambda one: misread(one, "q1", "q2", "towards"),
        "joints_for_tip": lambda one: ratios(jacobian(one).T, unit(one.towards)),
    },
    picture=planar_picture,
)
