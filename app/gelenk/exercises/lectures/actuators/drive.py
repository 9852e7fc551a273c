"""An exam: the drive of a joint."""

import math
from typing import NamedTuple

from gelenk.course.actuators.dc_motor import Motor
from gelenk.course.actuators.encoders import required, required_step
from gelenk.course.actuators.gear import gear_steps, sides
from gelenk.course.actuators.pwm import speed_step, voltage_for_speed
from gelenk.course.steps import Step, step, tex
from gelenk.exercises.draw import Draw
from gelenk.exercises.exercise import Answers, Exercise
from gelenk.exercises.fields import quantity, whole
from gelenk.language import marked
from gelenk.language import translated as _


class DriveTask(NamedTuple):
    """A joint with gear, motor and encoder; the speed in rad/s, the resolution in degrees."""

    ratio: float
    efficiency: float
    joint_speed: float
    joint_torque: float
    resolution: float
    resistance: float
    constant: float
    supply: float

    @property
    def motor(self) -> Motor:
        """The motor, without friction; inertia and inductance do not matter in the steady state."""
        return Motor(self.resistance, 0.0, self.constant, self.constant, 0.0, 1e-4)

    @property
    def motor_speed(self) -> float:
        """Speed of the motor, [rad/s]."""
        return self.ratio * self.joint_speed

    @property
    def motor_torque(self) -> float:
        """Torque of the motor, [N m]."""
        return self.joint_torque / (self.ratio * self.efficiency)


def _draw_drive(draw: Draw) -> DriveTask:
    return DriveTask(
        draw.decimal(40.0, 160.0, 2.0),
        draw.decimal(0.6, 0.85, 0.05),
        draw.decimal(1.0, 3.0, 0.1),
        draw.decimal(10.0, 60.0, 2.0),
        draw.decimal(0.001, 0.01, 0.001),
        draw.decimal(0.4, 1.6, 0.1),
        draw.decimal(0.04, 0.1, 0.01),
        48.0,
    )


def _drive_text(task: DriveTask) -> str:
    return _(
        "A joint has to turn at {joint_speed:g} rad/s against a torque of {joint_torque:g} N m. Its gear has the ratio "
        "N = {ratio:g} and the efficiency η = {efficiency:g}; its motor has R = {resistance:g} Ω, k_t = k_e = "
        "{constant:g} N m/A and no friction. The supply has {supply:g} V and is switched.\n\n"
        "What are speed and torque of the motor, its current, its voltage, and the duty of the pulses? On the motor "
        "shaft there is an encoder, and the joint's angle is to be resolved to {resolution:g}°. How many counts of a "
        "turn does that take at least, how many bits of an absolute encoder, how many lines of an incremental one with "
        "quadrature (x4)?"
    ).format(**task._asdict())


def _drive_answers(task: DriveTask) -> Answers:
    shaft, _load, _flow = sides(task.ratio, task.efficiency, None, task.joint_speed, None, task.joint_torque)
    torque, speed = shaft.torque or 0.0, shaft.angular_velocity or 0.0
    voltage = voltage_for_speed(task.motor, speed, torque)
    encoder = required(math.radians(task.resolution), task.ratio, "x4")
    return {
        "speed": speed,
        "torque": torque,
        "current": torque / task.constant,
        "voltage": voltage,
        "duty": voltage / task.supply,
        "counts": encoder.counts_per_revolution,
        "bits": encoder.bits,
        "lines": encoder.pulses_per_revolution,
    }


def _drive_with(task: DriveTask, torque: float) -> Answers:
    """Return what follows from a wrong torque of the motor."""
    voltage = voltage_for_speed(task.motor, task.motor_speed, torque)
    return {"torque": torque, "current": torque / task.constant, "voltage": voltage, "duty": voltage / task.supply}


def _with_counts(counts: float) -> Answers:
    return {"counts": math.ceil(counts), "bits": math.ceil(math.log2(counts)), "lines": math.ceil(counts / 4.0)}


def _rounded_down(task: DriveTask) -> Answers:
    counts = 360.0 / (task.resolution * task.ratio)
    return {"counts": math.floor(counts), "bits": math.floor(math.log2(counts)), "lines": math.floor(counts / 4.0)}


def _drive_steps(task: DriveTask) -> tuple[Step, ...]:
    motor, load, flow = sides(task.ratio, task.efficiency, None, task.joint_speed, None, task.joint_torque)
    right = _drive_answers(task)
    pulses = step(
        _("Current and duty"),
        _("The current gives the torque; the duty is the share of the supply that the motor sees."),
        rf"i = \frac{{\tau_m}}{{k_t}} = {tex(right['current'], 'A')}",
        rf"D = \frac{{V}}{{V_s}} = {tex(right['duty'])}",
    )
    voltage = speed_step(task.motor, task.motor_speed, task.motor_torque)
    encoder = required_step(required(math.radians(task.resolution), task.ratio, "x4"), "x4")
    return (*gear_steps(task.ratio, task.efficiency, motor, load, flow, None), voltage, pulses, encoder)


DRIVE = Exercise(
    id="actuators.drive",
    title=marked("Exam: the drive of a joint"),
    difficulty=5,
    draw=_draw_drive,
    is_degenerate=lambda task: not 0.2 <= _drive_answers(task)["duty"] <= 0.9,
    text=_drive_text,
    fields=lambda _task: (
        quantity("speed", _("Speed of the motor"), "rad/s"),
        quantity("torque", _("Torque of the motor"), "N m"),
        quantity("current", _("Current of the motor"), "A"),
        quantity("voltage", _("Voltage of the motor"), "V", 2.0),
        quantity("duty", _("Duty D")),
        whole("counts", _("Counts of a turn")),
        whole("bits", _("Bits")),
        whole("lines", _("Lines")),
    ),
    solve=_drive_answers,
    steps=_drive_steps,
    wrong={
        "ratio_inverted": lambda task: {
            "speed": task.joint_speed / task.ratio,
            "torque": task.joint_torque * task.ratio / task.efficiency,
        },
        "efficiency_forgotten": lambda task: _drive_with(task, task.joint_torque / task.ratio),
        "efficiency_inverted": lambda task: _drive_with(task, task.joint_torque * task.efficiency / task.ratio),
        "back_emf_forgotten": lambda task: {
            "voltage": task.resistance * task.motor_torque / task.constant,
            "duty": task.resistance * task.motor_torque / task.constant / task.supply,
        },
        "load_forgotten": lambda task: {
            "voltage": task.constant * task.motor_speed,
            "duty": task.constant * task.motor_speed / task.supply,
        },
        "gear_forgotten": lambda task: _with_counts(360.0 / task.resolution),
        "gear_multiplied": lambda task: _with_counts(360.0 / task.resolution * task.ratio),
        "rounded_down": _rounded_down,
        "quadrature_forgotten": lambda task: {"lines": math.ceil(360.0 / (task.resolution * task.ratio))},
        "quadrature_halved": lambda task: {"lines": math.ceil(180.0 / (task.resolution * task.ratio))},
    },
)

EXERCISES = (DRIVE,)
