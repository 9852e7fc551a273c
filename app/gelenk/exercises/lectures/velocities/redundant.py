"""The pseudo-inverse of a redundant arm, and what its null space lets through."""

from typing import NamedTuple

import numpy as np

from gelenk.course.steps import Step
from gelenk.course.velocity.inverse_steps import inverse_steps
from gelenk.course.velocity.inverses import LectureInverse
from gelenk.course.velocity.null_space_steps import NullSpaceWish, wish_steps
from gelenk.exercises.arms import in_plane, planar, planar_picture, radians
from gelenk.exercises.draw import Draw
from gelenk.exercises.exercise import Answers, Exercise
from gelenk.exercises.fields import basis, vector
from gelenk.exercises.lectures.velocities.two_links import picked_steps, question_of
from gelenk.language import marked
from gelenk.language import translated as _
from gelenk.robot.arrays import Array


class ThreeLinkWish(NamedTuple):
    """A planar arm of three links whose tip is to move; angles in degrees, velocities in m/s and rad/s."""

    l1: float
    l2: float
    l3: float
    q1: float
    q2: float
    q3: float
    x_rate: float
    y_rate: float
    xi1: float
    xi2: float
    xi3: float

    @property
    def lengths(self) -> tuple[float, float, float]:
        """All links."""
        return self.l1, self.l2, self.l3

    def jacobian(self, *, calculator: bool = False) -> Array:
        """Return J of v_x and v_y; shape (2, 3)."""
        q = np.array([self.q1, self.q2, self.q3])
        return in_plane(planar(*self.lengths), q if calculator else radians(*q))

    @property
    def velocity(self) -> Array:
        """Velocity of the tip."""
        return np.array([self.x_rate, self.y_rate])

    @property
    def xi(self) -> Array:
        """The second wish."""
        return np.array([self.xi1, self.xi2, self.xi3])


def _draw_three(draw: Draw) -> ThreeLinkWish:
    return ThreeLinkWish(
        draw.decimal(0.3, 0.6, 0.1),
        draw.decimal(0.3, 0.6, 0.1),
        draw.decimal(0.2, 0.5, 0.1),
        draw.signed(10.0, 80.0, 5.0),
        draw.signed(20.0, 90.0, 5.0),
        draw.signed(20.0, 90.0, 5.0),
        draw.signed(0.1, 0.5, 0.05),
        draw.signed(0.1, 0.5, 0.05),
        draw.signed(0.2, 1.0, 0.1),
        draw.signed(0.2, 1.0, 0.1),
        draw.signed(0.2, 1.0, 0.1),
    )


def _redundant_answers(task: ThreeLinkWish, J: Array) -> Answers:
    inverse = LectureInverse(J, 2, np.ones(3))
    least = inverse.pseudo_inverse @ task.velocity
    _left, _sigmas, right = np.linalg.svd(J)
    return {"least": least, "kernel": right[2:].T, "both": least + inverse.projector @ task.xi}


def _is_nearly_singular(task: ThreeLinkWish) -> bool:
    J = task.jacobian()
    sigmas, found = np.linalg.svd(J, compute_uv=False), _redundant_answers(task, J)
    apart = float(np.abs(found["both"] - found["least"]).max())
    return bool(sigmas[1] < 0.15 or apart < 0.1)


def _range_projected(task: ThreeLinkWish) -> Array:
    J = task.jacobian()
    return np.asarray(np.linalg.pinv(J) @ (task.velocity + J @ task.xi))


def _redundant_steps(task: ThreeLinkWish) -> list[Step]:
    question = question_of(task.jacobian(), task.velocity)
    q = radians(task.q1, task.q2, task.q3)
    wish = NullSpaceWish(task.xi)
    second = wish_steps(wish, question.inverse.projector, task.jacobian())
    return [*picked_steps(task.lengths, q), *inverse_steps(question), *second]


REDUNDANT = Exercise(
    id="velocities.redundant",
    title=marked("Three links for two directions: the pseudo-inverse"),
    difficulty=4,
    draw=_draw_three,
    is_degenerate=_is_nearly_singular,
    text=lambda one: _(
        "A planar arm has three revolute joints and links of {l1:g} m, {l2:g} m and {l3:g} m. It stands at ϑ = "
        "({q1:g}°, {q2:g}°, {q3:g}°), each counted from the link before. Its tip is to move at v = ({x_rate:g}, "
        "{y_rate:g}) m/s; its orientation does not matter.\n\nFind the joint velocities of the least norm, the joint "
        "velocities that leave the tip at rest, and the joint velocities that come nearest to ξ = ({xi1:g}, {xi2:g}, "
        "{xi3:g}) rad/s without disturbing the tip: J# v + (I - J# J) ξ."
    ).format(**one._asdict()),
    fields=lambda _one: (
        vector("least", _("Joint velocities of the least norm"), 3, "rad/s", 2.0),
        basis("kernel", _("Kernel of J, as a column"), (3, 1)),
        vector("both", _("Joint velocities with ξ"), 3, "rad/s"),
    ),
    solve=lambda one: _redundant_answers(one, one.jacobian()),
    steps=_redundant_steps,
    wrong={
        "joint_locked": lambda one: {"least": [*np.linalg.solve(one.jacobian()[:, :2], one.velocity), 0.0]},
        "transpose_for_inverse": lambda one: {"least": one.jacobian().T @ one.velocity},
        "projector_forgotten": lambda one: {"both": _redundant_answers(one, one.jacobian())["least"] + one.xi},
        "wrong_projector": lambda one: {"both": _range_projected(one)},
        "row_for_kernel": lambda one: {"kernel": one.jacobian()[:1].T},
        "calculator_mode": lambda one: _redundant_answers(one, one.jacobian(calculator=True)),
    },
    picture=lambda one: planar_picture(one.lengths, (one.q1, one.q2, one.q3)),
)

EXERCISES = (REDUNDANT,)
