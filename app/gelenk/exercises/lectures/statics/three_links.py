"""The four subspaces of a stretched or folded arm, and an exam: three links under a force and a moment."""

from typing import Annotated, NamedTuple

import numpy as np

from gelenk.course.steps import Step, step
from gelenk.course.velocity.statics_steps import StaticsQuestion, statics_steps
from gelenk.course.velocity.writing import number, row
from gelenk.exercises.arms import angles_not_summed, jacobian, misread, own_links, planar_picture, posture
from gelenk.exercises.draw import Draw, drawn
from gelenk.exercises.exercise import Answers, Exercise
from gelenk.exercises.fields import basis, matrix, quantity, vector, whole
from gelenk.exercises.lectures.statics.two_links import PLANE
from gelenk.language import marked, translated as _
from gelenk.robot.arrays import Array


class SingularArm(NamedTuple):
    """An arm whose second angle is 0 or 180 degrees."""

    l1: Annotated[float, Draw.decimal, 0.3, 1.0, 0.1]
    l2: Annotated[float, Draw.decimal, 0.2, 0.8, 0.1]
    q1: Annotated[float, Draw.signed, 10.0, 80.0, 5.0]
    q2: Annotated[float, Draw.choice, (0.0, 180.0)]


def _spaces(J: Array) -> dict[str, Array]:
    """Return range(J), ker(Jᵀ), range(Jᵀ) and ker(J) of a matrix of rank 1, as columns; shape (2, 1) each."""
    left, _sigmas, right = np.linalg.svd(J)
    return {"range": left[:, :1], "unfelt": left[:, 1:], "torques": right[:1].T, "kernel": right[1:].T}


def _exchanged(one: SingularArm, *order: str) -> Answers:
    found = _spaces(jacobian(one))
    return {name: found[other] for name, other in zip(found, order, strict=True)}


def _own_links(one: SingularArm) -> Answers:
    found = _spaces(own_links(one))
    return {"torques": found["torques"], "kernel": found["kernel"]}


def _question(one: SingularArm) -> StaticsQuestion:
    geometry = posture(one)
    return StaticsQuestion(geometry, jacobian(one), 1, geometry.position, np.eye(3), PLANE, None, np.zeros(2))


SUBSPACES = Exercise(
    id="statics.subspaces",
    title=marked("The four subspaces of a singular arm"),
    difficulty=4,
    draw=drawn(SingularArm),
    is_degenerate=lambda one: one.l1 == one.l2,
    text=lambda one: _(
        "A planar arm has two revolute joints and links of l₁ = {l1:g} m and l₂ = {l2:g} m, and stands at ϑ₁ = "
        "{q1:g}°, ϑ₂ = {q2:g}°. J is the Jacobian of the position (x, y) of its tip. Which velocities can the tip "
        "have, which forces at the tip need no torque, which torques can a force at the tip balance, and which joint "
        "velocities leave the tip at rest? Give a basis of each space, as a column."
    ).format(**one._asdict()),
    fields=lambda _one: (
        basis("range", _("Velocities of the tip: range of J"), (2, 1)),
        basis("unfelt", _("Forces without torque: kernel of the transpose of J"), (2, 1)),
        basis("torques", _("Torques that a force balances: range of the transpose of J"), (2, 1)),
        basis("kernel", _("Joint velocities without motion: kernel of J"), (2, 1)),
    ),
    solve=lambda one: _spaces(jacobian(one)),
    steps=lambda one: statics_steps(_question(one)),
    wrong={
        "complement": lambda one: _exchanged(one, "unfelt", "range", "kernel", "torques"),
        "joints_for_tip": lambda one: _exchanged(one, "torques", "kernel", "range", "unfelt"),
        "own_link_only": _own_links,
        "calculator_mode": lambda one: misread(one, "q1"),
    },
)


_ROWS = np.array([0, 1, 5])


class ThreeLinkLoad(NamedTuple):
    """Three links under a force and a moment, with motors of equal limits; angles in degrees."""

    l1: Annotated[float, Draw.decimal, 0.3, 0.6, 0.1]
    l2: Annotated[float, Draw.decimal, 0.3, 0.6, 0.1]
    l3: Annotated[float, Draw.decimal, 0.1, 0.3, 0.1]
    q1: Annotated[float, Draw.decimal, 10.0, 80.0, 5.0]
    q2: Annotated[float, Draw.signed, 20.0, 90.0, 5.0]
    q3: Annotated[float, Draw.signed, 20.0, 90.0, 5.0]
    x_force: Annotated[float, Draw.signed, 10.0, 50.0, 5.0]
    y_force: Annotated[float, Draw.signed, 10.0, 50.0, 5.0]
    moment: Annotated[float, Draw.signed, 2.0, 8.0, 0.5]
    rate1: Annotated[float, Draw.signed, 0.2, 1.0, 0.1]
    rate2: Annotated[float, Draw.signed, 0.2, 1.0, 0.1]
    rate3: Annotated[float, Draw.signed, 0.2, 1.0, 0.1]
    limit: Annotated[float, Draw.choice, (40.0, 50.0, 60.0)]

    @property
    def wrench(self) -> Array:
        """Force and moment of the tip on its surroundings."""
        return np.array([self.x_force, self.y_force, self.moment])

    @property
    def rates(self) -> Array:
        """Joint velocities."""
        return np.array([self.rate1, self.rate2, self.rate3])

    @property
    def jacobian(self) -> Array:
        """J of (x, y, φ); shape (3, 3)."""
        return np.asarray(posture(self).jacobian()[_ROWS])


def _load_answers(task: ThreeLinkLoad, J: Array, wrench: Array | None = None) -> Answers:
    torques = J.T @ (task.wrench if wrench is None else wrench)
    return {"jacobian": J, **_of_torques(task, torques)}


def _of_torques(task: ThreeLinkLoad, torques: Array) -> Answers:
    worst = int(np.argmax(np.abs(torques)))
    return {
        "torques": torques,
        "power": float(torques @ task.rates),
        "joint": worst + 1,
        "factor": task.limit / float(np.abs(torques[worst])),
    }


def _right(task: ThreeLinkLoad) -> Answers:
    return _load_answers(task, task.jacobian)


def _is_unclear(task: ThreeLinkLoad) -> bool:
    found = _right(task)
    sizes = sorted(np.abs(found["torques"]))
    return bool(sizes[2] < 1.2 * sizes[1] or sizes[0] < 1.0 or found["factor"] < 1.2 or abs(found["power"]) < 2.0)


def _smallest(task: ThreeLinkLoad) -> Answers:
    sizes = np.abs(_right(task)["torques"])
    return {"joint": int(np.argmin(sizes)) + 1, "factor": task.limit / float(sizes.min())}


def _load_steps(task: ThreeLinkLoad) -> list[Step]:
    geometry, found = posture(task), _right(task)
    J, torques = found["jacobian"], found["torques"]
    question = StaticsQuestion(geometry, J, 3, geometry.position, np.eye(3), _ROWS, task.wrench, torques)
    twist = J @ task.rates
    power = step(
        _("Power"),
        _("What the motors give is what the tip does on its surroundings."),
        rf"P = \tau^{{\mathsf T}} \dot q = {row(torques)} \cdot {row(task.rates)} = {number(found['power'], 'W')}",
        rf"P = \gamma^{{\mathsf T}} J \dot q = {row(task.wrench)} \cdot {row(twist)} = "
        f"{number(float(task.wrench @ twist), 'W')}",
    )
    factor = step(
        _("The first joint at its limit"),
        _("The torques grow with the load in proportion; the largest one reaches the limit first."),
        rf"\max_i \lvert \tau_i \rvert = \lvert \tau_{{{found['joint']}}} \rvert = "
        f"{number(float(np.abs(torques).max()), 'N m')}",
        rf"k = \frac{{\tau_{{max}}}}{{\lvert \tau_{{{found['joint']}}} \rvert}} = {number(found['factor'])}",
    )
    return [*statics_steps(question), power, factor]


LOAD = Exercise(
    id="statics.load",
    title=marked("Exam: three links under a load"),
    difficulty=5,
    draw=drawn(ThreeLinkLoad),
    is_degenerate=_is_unclear,
    text=lambda one: _(
        "A planar arm has three revolute joints and links of {l1:g} m, {l2:g} m and {l3:g} m. It stands at ϑ = "
        "({q1:g}°, {q2:g}°, {q3:g}°), each counted from the link before. Its tip loads its surroundings with the "
        "force F = ({x_force:g}, {y_force:g}) N and the moment M = {moment:g} N m; the plane is horizontal.\n\nFind "
        "the Jacobian of (x, y, φ), φ being the orientation of the last link, and the torques of the motors. Which "
        "power do they give when the joints turn at ({rate1:g}, {rate2:g}, {rate3:g}) rad/s under this load? Each "
        "motor can bear {limit:g} N m: which joint reaches its limit first if the load grows, and by which factor "
        "may it grow?"
    ).format(**one._asdict()),
    fields=lambda _one: (
        matrix("jacobian", _("Jacobian J of (x, y, φ)"), (3, 3), points=2.0),
        vector("torques", _("Torques of the motors"), 3, "N m", 2.0),
        quantity("power", _("Power of the motors together"), "W"),
        whole("joint", _("Joint that reaches its limit first, from 1")),
        quantity("factor", _("Factor by which the load may grow")),
    ),
    solve=_right,
    steps=_load_steps,
    wrong={
        "moment_forgotten": lambda one: _load_answers(one, one.jacobian, one.wrench * [1.0, 1.0, 0.0]),
        "jacobian_for_transpose": lambda one: _of_torques(one, one.jacobian @ one.wrench),
        "components_exchanged": lambda one: _load_answers(one, one.jacobian, one.wrench[[1, 0, 2]]),
        "angle_not_summed": lambda one: _load_answers(one, np.vstack((angles_not_summed(one), np.ones(3)))),
        "signs_of_power": lambda one: {"power": float(np.abs(_right(one)["torques"] * one.rates).sum())},
        "smallest_torque": _smallest,
        "calculator_mode": misread,
    },
    picture=planar_picture,
)
