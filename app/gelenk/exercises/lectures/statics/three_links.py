"""An exam: three links under a force and a moment."""

from typing import NamedTuple

import numpy as np

from gelenk.course.steps import Step, step
from gelenk.course.velocity.geometry import ChainGeometry
from gelenk.course.velocity.statics_steps import StaticsQuestion, statics_steps
from gelenk.course.velocity.writing import number, row
from gelenk.exercises.arms import angles_not_summed, at, planar, planar_picture, radians
from gelenk.exercises.draw import Draw
from gelenk.exercises.exercise import Answers, Exercise
from gelenk.exercises.fields import matrix, quantity, vector, whole
from gelenk.language import marked
from gelenk.language import translated as _
from gelenk.robot.arrays import Array

_ROWS = np.array([0, 1, 5])


class ThreeLinkLoad(NamedTuple):
    """Three links under a force and a moment, with motors of equal limits; angles in degrees."""

    l1: float
    l2: float
    l3: float
    q1: float
    q2: float
    q3: float
    x_force: float
    y_force: float
    moment: float
    rate1: float
    rate2: float
    rate3: float
    limit: float

    @property
    def wrench(self) -> Array:
        """Force and moment of the tip on its surroundings."""
        return np.array([self.x_force, self.y_force, self.moment])

    @property
    def rates(self) -> Array:
        """Joint velocities."""
        return np.array([self.rate1, self.rate2, self.rate3])

    def geometry(self, *, calculator: bool = False) -> ChainGeometry:
        """Return axes and lever arms; `calculator` takes the degrees for radians."""
        q = np.array([self.q1, self.q2, self.q3])
        return at(planar(self.l1, self.l2, self.l3), q if calculator else radians(*q))


def _draw_load(draw: Draw) -> ThreeLinkLoad:
    return ThreeLinkLoad(
        draw.decimal(0.3, 0.6, 0.1),
        draw.decimal(0.3, 0.6, 0.1),
        draw.decimal(0.1, 0.3, 0.1),
        draw.decimal(10.0, 80.0, 5.0),
        draw.signed(20.0, 90.0, 5.0),
        draw.signed(20.0, 90.0, 5.0),
        draw.signed(10.0, 50.0, 5.0),
        draw.signed(10.0, 50.0, 5.0),
        draw.signed(2.0, 8.0, 0.5),
        draw.signed(0.2, 1.0, 0.1),
        draw.signed(0.2, 1.0, 0.1),
        draw.signed(0.2, 1.0, 0.1),
        draw.choice((40.0, 50.0, 60.0)),
    )


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
    return _load_answers(task, task.geometry().jacobian()[_ROWS])


def _is_unclear(task: ThreeLinkLoad) -> bool:
    found = _right(task)
    sizes = sorted(np.abs(found["torques"]))
    return bool(sizes[2] < 1.2 * sizes[1] or sizes[0] < 1.0 or found["factor"] < 1.2 or abs(found["power"]) < 2.0)


def _planar_not_summed(task: ThreeLinkLoad) -> Array:
    J = angles_not_summed((task.l1, task.l2, task.l3), radians(task.q1, task.q2, task.q3))
    return np.vstack((J, np.ones(3)))


def _smallest(task: ThreeLinkLoad) -> Answers:
    sizes = np.abs(_right(task)["torques"])
    return {"joint": int(np.argmin(sizes)) + 1, "factor": task.limit / float(sizes.min())}


def _load_steps(task: ThreeLinkLoad) -> list[Step]:
    geometry, found = task.geometry(), _right(task)
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
    draw=_draw_load,
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
        "moment_forgotten": lambda one: _load_answers(
            one, one.geometry().jacobian()[_ROWS], one.wrench * [1.0, 1.0, 0.0]
        ),
        "jacobian_for_transpose": lambda one: _of_torques(one, one.geometry().jacobian()[_ROWS] @ one.wrench),
        "components_exchanged": lambda one: _load_answers(one, one.geometry().jacobian()[_ROWS], one.wrench[[1, 0, 2]]),
        "angle_not_summed": lambda one: _load_answers(one, _planar_not_summed(one)),
        "signs_of_power": lambda one: {"power": float(np.abs(_right(one)["torques"] * one.rates).sum())},
        "smallest_torque": _smallest,
        "calculator_mode": lambda one: _load_answers(one, one.geometry(calculator=True).jacobian()[_ROWS]),
    },
    picture=lambda one: planar_picture((one.l1, one.l2, one.l3), (one.q1, one.q2, one.q3)),
)

EXERCISES = (LOAD,)
