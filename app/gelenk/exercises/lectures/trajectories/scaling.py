"""How far a motion has to be slowed down for its limits."""

from typing import Annotated, NamedTuple

import numpy as np

from gelenk.course.motion.time_law_steps import scaling_steps
from gelenk.exercises.draw import Draw, drawn
from gelenk.exercises.exercise import Answers, Exercise
from gelenk.exercises.fields import quantity
from gelenk.language import marked, translated as _
from gelenk.robot.arrays import Array
from gelenk.trajectory.laws.time_scaling import Scaling, ScalingLimits, uniform_scaling
from gelenk.trajectory.motion.polynomial import PiecewisePolynomial
from gelenk.trajectory.motion.time_laws import between


class ScalingTask(NamedTuple):
    """Two joints by a cubic, from rest to rest: displacements, time, limits; radians and seconds."""

    d1: Annotated[float, Draw.signed, 0.4, 2.4, 0.1]
    d2: Annotated[float, Draw.signed, 0.4, 2.4, 0.1]
    time: Annotated[float, Draw.decimal, 0.6, 2.0, 0.2]
    v1: Annotated[float, Draw.decimal, 0.5, 4.0, 0.5]
    v2: Annotated[float, Draw.decimal, 0.5, 4.0, 0.5]
    a1: Annotated[float, Draw.decimal, 1.0, 12.0, 1.0]
    a2: Annotated[float, Draw.decimal, 1.0, 12.0, 1.0]

    @property
    def motion(self) -> PiecewisePolynomial:
        """Both cubics."""
        ends = np.zeros((2, 2))
        ends[0] = self.d1, self.d2
        return between(np.zeros((2, 2)), ends, self.time)

    @property
    def scaling(self) -> Scaling:
        """The factors of the core."""
        return uniform_scaling(self.motion, ScalingLimits(*self.limits))

    @property
    def limits(self) -> tuple[Array, Array]:
        """Limits of velocity and acceleration, (2,) each."""
        return np.array([self.v1, self.v2]), np.array([self.a1, self.a2])

    def answers(self, velocity: Array, acceleration: Array, *, joint: slice = slice(None)) -> Answers:
        """Return the answers from the ratios of both joints."""
        k_vel, k_acc = float(velocity[joint].max()), float(acceleration[joint].max())
        k = max(1.0, k_vel, k_acc**0.5)
        return {"k_vel": k_vel, "k_acc": k_acc, "k": k, "time": k * self.time}

    @property
    def ratios(self) -> tuple[Array, Array]:
        """|q̇|/v and |q̈|/a of both joints."""
        d, (v, a) = np.abs([self.d1, self.d2]), self.limits
        return 1.5 * d / self.time / v, 6.0 * d / self.time**2 / a


def _is_useless_scaling(one: ScalingTask) -> bool:
    velocity, acceleration = (float(ratios.max()) for ratios in one.ratios)
    k = max(velocity, acceleration**0.5)
    return not 0.5 < k < 3.0 or abs(k - 1.0) < 0.12 or one.time == 1.0 or abs(velocity - acceleration) < 0.12


def _scaling_answers(one: ScalingTask) -> Answers:
    found = one.scaling
    k_vel, k_acc = (bound.ratio for bound in found.bounds)
    k = found.course_factor
    return {"k_vel": k_vel, "k_acc": k_acc, "k": k, "time": k * one.time}


def _no_root(one: ScalingTask) -> Answers:
    k = max(1.0, *(float(ratios.max()) for ratios in one.ratios))
    return {"k": k, "time": k * one.time}


def _sped_up(one: ScalingTask) -> Answers:
    k = one.scaling.factor or 1.0
    return {"k": k, "time": k * one.time}


def _limits_exchanged(one: ScalingTask) -> Answers:
    (velocity, acceleration), (v, a) = one.ratios, one.limits
    return one.answers(velocity * v / a, acceleration * a / v)


SCALING = Exercise(
    id="trajectories.scaling",
    title=marked("Slowing a motion down for its limits"),
    difficulty=3,
    draw=drawn(ScalingTask),
    is_degenerate=_is_useless_scaling,
    text=lambda one: _(
        "Two joints move by {d1:g} rad and {d2:g} rad in T = {time:g} s, each by a cubic from rest to rest. They allow "
        "{v1:g} rad/s and {v2:g} rad/s, {a1:g} rad/s² and {a2:g} rad/s². What is the largest ratio of a peak velocity "
        "to its limit, what that of a peak acceleration, by which factor k = max{{1, k_vel, √k_acc}} is the time "
        "scaled, and how long does the motion take then?"
    ).format(**one._asdict()),
    fields=lambda _one: (
        quantity("k_vel", _("Largest ratio of a velocity to its limit, k_vel")),
        quantity("k_acc", _("Largest ratio of an acceleration to its limit, k_acc")),
        quantity("k", _("Factor k")),
        quantity("time", _("Time of the scaled motion"), "s"),
    ),
    solve=_scaling_answers,
    steps=lambda one: scaling_steps(one.scaling, one.time),
    wrong={
        "root_of_ratio_forgotten": _no_root,
        "sped_up": _sped_up,
        "limits_exchanged": _limits_exchanged,
        "mean_for_peak": lambda one: one.answers(one.ratios[0] / 1.5, one.ratios[1] / 6.0),
        "first_joint_alone": lambda one: one.answers(*one.ratios, joint=slice(0, 1)),
        "time_divided": lambda one: {"time": one.time / one.scaling.course_factor},
    },
)
