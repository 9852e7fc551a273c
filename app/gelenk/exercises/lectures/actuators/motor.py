"""A motor in the steady state."""

from typing import NamedTuple

from gelenk.course.actuators.dc_motor import Motor, motor_steps, operating_point, torque_speed_line
from gelenk.exercises.draw import Draw
from gelenk.exercises.exercise import Answers, Exercise
from gelenk.exercises.fields import quantity
from gelenk.language import marked
from gelenk.language import translated as _


class MotorTask(NamedTuple):
    """A motor with its supply and load, in SI units."""

    resistance: float
    inductance: float
    constant: float
    friction: float
    voltage: float
    load: float

    @property
    def motor(self) -> Motor:
        """The motor; its inertia does not matter in the steady state."""
        return Motor(self.resistance, self.inductance, self.constant, self.constant, self.friction, 2e-4)


def _draw_motor(draw: Draw) -> MotorTask:
    return MotorTask(
        draw.decimal(0.5, 3.0, 0.1),
        draw.decimal(0.001, 0.005, 0.001),
        draw.decimal(0.03, 0.12, 0.01),
        draw.decimal(0.0002, 0.002, 0.0002),
        draw.choice((12.0, 24.0, 36.0, 48.0)),
        draw.decimal(0.05, 0.4, 0.05),
    )


def _is_useless_motor(task: MotorTask) -> bool:
    line = torque_speed_line(task.motor, task.voltage)
    return not 0.1 * line.stall_torque <= task.load <= 0.7 * line.stall_torque


def _motor_text(task: MotorTask) -> str:
    return _(
        "A DC motor has R = {resistance:g} Ω, L = {inductance:g} H, k_t = k_e = {constant:g} N m/A and the viscous "
        "friction b = {friction:g} N m s/rad. At {voltage:g} V it drives a load of {load:g} N m against the motion. "
        "What are speed and current in the steady state, the speed without load, and the torque at which it stalls?"
    ).format(**task._asdict())


def _motor_answers(task: MotorTask) -> Answers:
    point = operating_point(task.motor, task.voltage, task.load)
    line = torque_speed_line(task.motor, task.voltage)
    return {
        "speed": point.angular_velocity,
        "current": point.current,
        "no_load": line.no_load_angular_velocity,
        "stall": line.stall_torque,
    }


def _motor_with(task: MotorTask, drive: float, drag: float, denominator: float) -> Answers:
    """Return the speeds by a wrong formula, and the current that follows from the voltage equation."""
    speed = (drive - drag) / denominator
    current = (task.voltage - task.constant * speed) / task.resistance
    return {"speed": speed, "current": current, "no_load": drive / denominator}


def _motor_without_emf(task: MotorTask) -> Answers:
    stall = task.constant * task.voltage / task.resistance
    speed = (stall - task.load) / task.friction
    return {"speed": speed, "current": task.voltage / task.resistance, "no_load": stall / task.friction}


def _motor_parts(task: MotorTask) -> tuple[float, float, float]:
    return task.constant * task.voltage, task.resistance * task.load, task.motor.stiffness


def _motor_wrong(task: MotorTask, *, load: float = 1.0, friction: float = 1.0, square: bool = True) -> Answers:
    drive, drag, _stiffness = _motor_parts(task)
    constant = task.constant**2 if square else task.constant
    return _motor_with(task, drive, load * drag, friction * task.resistance * task.friction + constant)


MOTOR = Exercise(
    id="actuators.motor",
    title=marked("A DC motor under load"),
    difficulty=2,
    draw=_draw_motor,
    is_degenerate=_is_useless_motor,
    text=_motor_text,
    fields=lambda _task: (
        quantity("speed", _("Speed ω"), "rad/s"),
        quantity("current", _("Current i"), "A"),
        quantity("no_load", _("Speed without load ω₀"), "rad/s"),
        quantity("stall", _("Stall torque"), "N m"),
    ),
    solve=_motor_answers,
    steps=lambda task: motor_steps(
        task.motor, task.voltage, task.load, operating_point(task.motor, task.voltage, task.load)
    )[:3],
    wrong={
        "load_forgotten": lambda task: {
            name: value for name, value in _motor_wrong(task, load=0.0).items() if name != "no_load"
        },
        "load_helps": lambda task: {
            name: value for name, value in _motor_wrong(task, load=-1.0).items() if name != "no_load"
        },
        "friction_forgotten": lambda task: _motor_wrong(task, friction=0.0),
        "constant_once": lambda task: _motor_wrong(task, square=False),
        "back_emf_forgotten": _motor_without_emf,
        "voltage_for_torque": lambda task: {"stall": task.voltage / task.resistance},
    },
)

EXERCISES = (MOTOR,)
