"""Arms by their ellipses: nearly stretched, isotropic, and an exam about three links."""

import math
from typing import Annotated, NamedTuple

import numpy as np

from gelenk.course.steps import Step, step
from gelenk.course.velocity.writing import number, row
from gelenk.exercises.arms import angles_not_summed, at, jacobian, misread, planar, planar_picture, posture, radians
from gelenk.exercises.draw import Draw, drawn
from gelenk.exercises.exercise import Answers, Exercise
from gelenk.exercises.fields import ChoiceField, angle, basis, matrix, quantity, solution_set
from gelenk.exercises.lectures.manipulability.two_links import ratios, ratios_by_shadow, ratios_exchanged, unit, worked
from gelenk.language import marked, translated as _
from gelenk.robot.arrays import Array


class NearlyStretched(NamedTuple):
    """A planar arm whose second angle is small; angles in degrees."""

    l1: Annotated[float, Draw.decimal, 0.5, 1.2, 0.1]
    l2: Annotated[float, Draw.decimal, 0.4, 1.0, 0.1]
    q1: Annotated[float, Draw.decimal, 10.0, 80.0, 5.0]
    q2: Annotated[float, Draw.signed, 2.0, 12.0, 1.0]

    @property
    def along(self) -> Array:
        """Unit vector from the base to the tip; shape (2,)."""
        tip = posture(self).position[:2]
        return np.asarray(tip / np.linalg.norm(tip))


def _side(task: NearlyStretched, axis: Array) -> str:
    return "along" if abs(float(axis @ task.along)) > np.sqrt(0.5) else "across"


def _stretched_answers(task: NearlyStretched) -> Answers:
    left, sigmas, _right = np.linalg.svd(jacobian(task))
    return {
        "fast": _side(task, left[:, 0]),
        "strong": _side(task, left[:, 1]),
        "isotropy": float(sigmas[1] / sigmas[0]),
    }


def _exchanged(task: NearlyStretched) -> Answers:
    found = _stretched_answers(task)
    return {"fast": found["strong"], "strong": found["fast"]}


def _stretched_steps(task: NearlyStretched) -> list[Step]:
    left, _sigmas, _right = np.linalg.svd(jacobian(task))
    compared = step(
        _("Along or across"),
        _("The cosines between the arm and both axes: the tip is fast across the arm, and strong along it."),
        rf"u = \frac{{p}}{{\lVert p \rVert}} = {row(task.along)}",
        rf"\lvert u^{{\mathsf T}} u_1 \rvert = {number(abs(float(task.along @ left[:, 0])))},\quad "
        rf"\lvert u^{{\mathsf T}} u_2 \rvert = {number(abs(float(task.along @ left[:, 1])))}",
    )
    return [*worked(jacobian(task)), compared]


def _direction(name: str, label: str) -> ChoiceField:
    options = {"along": _("along the line from the base to the tip"), "across": _("across that line")}
    return ChoiceField(name=name, label=label, options=options)


STRETCHED = Exercise(
    id="manipulability.stretched",
    title=marked("A nearly stretched arm"),
    difficulty=2,
    draw=drawn(NearlyStretched),
    text=lambda one: _(
        "A planar arm has two revolute joints and links of l₁ = {l1:g} m and l₂ = {l2:g} m. It is nearly stretched: "
        "ϑ₁ = {q1:g}°, ϑ₂ = {q2:g}° (counted from the first link). In which direction can its tip move fast, and in "
        "which one can it bear a large force? What is the isotropy of the velocity ellipse, the smaller semi-axis "
        "divided by the larger one?"
    ).format(**one._asdict()),
    fields=lambda _one: (
        _direction("fast", _("The tip is fast")),
        _direction("strong", _("The tip is strong")),
        quantity("isotropy", _("Isotropy")),
    ),
    solve=_stretched_answers,
    steps=_stretched_steps,
    wrong={
        "axes_exchanged": _exchanged,
        "condition_for_isotropy": lambda one: {"isotropy": 1.0 / _stretched_answers(one)["isotropy"]},
        "sine_for_isotropy": lambda one: {"isotropy": abs(float(np.sin(radians(one.q2)[0])))},
        "eigenvalues_for_axes": lambda one: {"isotropy": _stretched_answers(one)["isotropy"] ** 2},
    },
    picture=planar_picture,
)


class FirstLink(NamedTuple):
    """The first link of an arm to be designed, [m]."""

    l1: Annotated[float, Draw.decimal, 0.2, 1.5, 0.02]


def _isotropic_answers(task: FirstLink) -> Answers:
    second = task.l1 / math.sqrt(2.0)
    sigmas = np.linalg.svd(at(planar(task.l1, second), radians(0.0, 135.0)).jacobian()[:2], compute_uv=False)
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


ISOTROPIC = Exercise(
    id="manipulability.isotropic",
    title=marked("An isotropic arm"),
    difficulty=3,
    draw=drawn(FirstLink),
    is_degenerate=lambda one: abs(one.l1 - 1.0) < 0.15,
    text=lambda one: _(
        "The first link of a planar arm of two revolute joints is l₁ = {l1:g} m long. How long must the second one "
        "be, and for which ϑ₂ between -180° and 180° is then the velocity ellipse of its tip a circle? How large is "
        "its radius for joint velocities of norm 1 rad/s?"
    ).format(**one._asdict()),
    fields=lambda _one: (
        quantity("second", _("Length of the second link"), "m"),
        solution_set(angle("bends", _("All such ϑ₂"), unit="°")),
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


class ThreeLinkPosture(NamedTuple):
    """A planar arm of three links, and a direction by its angle from the x axis; angles in degrees."""

    l1: Annotated[float, Draw.decimal, 0.3, 0.7, 0.1]
    l2: Annotated[float, Draw.decimal, 0.3, 0.6, 0.1]
    l3: Annotated[float, Draw.decimal, 0.2, 0.5, 0.1]
    q1: Annotated[float, Draw.decimal, 10.0, 80.0, 5.0]
    q2: Annotated[float, Draw.signed, 20.0, 100.0, 5.0]
    q3: Annotated[float, Draw.signed, 20.0, 100.0, 5.0]
    towards: Annotated[float, Draw.signed, 10.0, 80.0, 5.0]


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
    found = _ellipse_answers(task, jacobian(task))
    return {"axis": found["strongest"], "strongest": found["axis"]}


ELLIPSES = Exercise(
    id="manipulability.three_links",
    title=marked("Exam: the ellipses of three links"),
    difficulty=5,
    draw=drawn(ThreeLinkPosture),
    is_degenerate=lambda one: not 1.5 < float(np.linalg.cond(jacobian(one))) < 15.0,
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
    solve=lambda one: _ellipse_answers(one, jacobian(one)),
    steps=lambda one: worked(jacobian(one), unit(one.towards)[None]),
    wrong={
        "last_joint_forgotten": lambda one: _ellipse_answers(one, jacobian(one)[:, :2]),
        "axes_exchanged": _exchanged_axes,
        "shadow_for_reach": lambda one: ratios_by_shadow(jacobian(one), unit(one.towards)),
        "ratios_exchanged": lambda one: ratios_exchanged(jacobian(one), unit(one.towards)),
        "angle_not_summed": lambda one: _ellipse_answers(one, angles_not_summed(one)),
        "calculator_mode": misread,
    },
    picture=planar_picture,
)
