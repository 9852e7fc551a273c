"""A nearly stretched arm: fast across, strong along."""

from typing import NamedTuple

import numpy as np

from gelenk.course.steps import Step, step
from gelenk.course.velocity.geometry import ChainGeometry
from gelenk.course.velocity.writing import number, row
from gelenk.exercises.arms import at, planar, planar_picture, radians
from gelenk.exercises.exercise import Answers, Exercise
from gelenk.exercises.fields import ChoiceField, quantity
from gelenk.exercises.lectures.manipulability.two_links import worked
from gelenk.language import marked
from gelenk.language import translated as _
from gelenk.robot.arrays import Array


class NearlyStretched(NamedTuple):
    """A planar arm whose second angle is small; angles in degrees."""

    l1: float
    l2: float
    q1: float
    q2: float

    @property
    def geometry(self) -> ChainGeometry:
        """Axes and lever arms."""
        return at(planar(self.l1, self.l2), radians(self.q1, self.q2))

    @property
    def jacobian(self) -> Array:
        """J of v_x and v_y; shape (2, 2)."""
        return self.geometry.jacobian()[:2]

    @property
    def along(self) -> Array:
        """Unit vector from the base to the tip; shape (2,)."""
        tip = self.geometry.position[:2]
        return np.asarray(tip / np.linalg.norm(tip))


def _side(task: NearlyStretched, axis: Array) -> str:
    return "along" if abs(float(axis @ task.along)) > np.sqrt(0.5) else "across"


def _stretched_answers(task: NearlyStretched) -> Answers:
    left, sigmas, _right = np.linalg.svd(task.jacobian)
    return {
        "fast": _side(task, left[:, 0]),
        "strong": _side(task, left[:, 1]),
        "isotropy": float(sigmas[1] / sigmas[0]),
    }


def _exchanged(task: NearlyStretched) -> Answers:
    found = _stretched_answers(task)
    return {"fast": found["strong"], "strong": found["fast"]}


def _stretched_steps(task: NearlyStretched) -> list[Step]:
    left, _sigmas, _right = np.linalg.svd(task.jacobian)
    compared = step(
        _("Along or across"),
        _("The cosines between the arm and both axes: the tip is fast across the arm, and strong along it."),
        rf"u = \frac{{p}}{{\lVert p \rVert}} = {row(task.along)}",
        rf"\lvert u^{{\mathsf T}} u_1 \rvert = {number(abs(float(task.along @ left[:, 0])))},\quad "
        rf"\lvert u^{{\mathsf T}} u_2 \rvert = {number(abs(float(task.along @ left[:, 1])))}",
    )
    return [*worked(task.jacobian), compared]


def _direction(name: str, label: str) -> ChoiceField:
    options = {"along": _("along the line from the base to the tip"), "across": _("across that line")}
    return ChoiceField(name=name, label=label, options=options)


STRETCHED = Exercise(
    id="manipulability.stretched",
    title=marked("A nearly stretched arm"),
    difficulty=2,
    draw=lambda draw: NearlyStretched(
        draw.decimal(0.5, 1.2, 0.1),
        draw.decimal(0.4, 1.0, 0.1),
        draw.decimal(10.0, 80.0, 5.0),
        draw.signed(2.0, 12.0, 1.0),
    ),
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
    picture=lambda one: planar_picture((one.l1, one.l2), (one.q1, one.q2)),
)

EXERCISES = (STRETCHED,)
