"""Motor, gear, pulse width modulation and encoder."""

import math
from typing import NamedTuple

from gelenk.course.actuators.dc_motor import Motor, motor_steps, operating_point, torque_speed_line
from gelenk.course.actuators.encoders import required, required_step, resolution, resolution_steps
from gelenk.course.actuators.gear import gear_steps, inertias, sides
from gelenk.course.actuators.pwm import Pulses, approximate_ripple, pwm_steps, speed_step, voltage_for_speed
from gelenk.course.steps import Step, step, tex
from gelenk.exercises.draw import Draw
from gelenk.exercises.exercise import Answers, Exercise
from gelenk.exercises.fields import NumberField
from gelenk.language import marked
from gelenk.language import translated as _


def _quantity(name: str, label: str, unit: str = "", points: float = 1.0) -> NumberField:
    return NumberField(name=name, label=label, unit=unit, tolerance=0.01, is_relative=True, points=points)


def _count(name: str, label: str) -> NumberField:
    return NumberField(name=name, label=label)


# A motor in the steady state


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
        _quantity("speed", _("Speed ω"), "rad/s"),
        _quantity("current", _("Current i"), "A"),
        _quantity("no_load", _("Speed without load ω₀"), "rad/s"),
        _quantity("stall", _("Stall torque"), "N m"),
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


# A gear


class GearTask(NamedTuple):
    """A gear between a motor and a load that turns and resists."""

    ratio: float
    efficiency: float
    load_speed: float
    load_torque: float
    motor_inertia: float
    load_inertia: float


def _draw_gear(draw: Draw) -> GearTask:
    return GearTask(
        draw.decimal(20.0, 150.0, 5.0),
        draw.decimal(0.6, 0.85, 0.05),
        draw.decimal(0.5, 4.0, 0.1),
        draw.decimal(10.0, 80.0, 1.0),
        draw.decimal(0.0001, 0.0006, 0.0001),
        draw.decimal(0.5, 4.0, 0.1),
    )


def _gear_text(task: GearTask) -> str:
    return _(
        "A motor drives a joint through a gear of ratio N = {ratio:g} and efficiency η = {efficiency:g}. The joint "
        "turns at {load_speed:g} rad/s against a torque of {load_torque:g} N m. The rotor has the inertia J_m = "
        "{motor_inertia:g} kg m², the load J_L = {load_inertia:g} kg m². What are speed and torque of the motor, the "
        "inertia that the motor feels, and the ratio with which a given torque would accelerate the load most?"
    ).format(**task._asdict())


def _gear_answers(task: GearTask) -> Answers:
    motor, _load, _flow = sides(task.ratio, task.efficiency, None, task.load_speed, None, task.load_torque)
    felt = inertias(task.ratio, task.motor_inertia, task.load_inertia)
    return {
        "speed": motor.angular_velocity,
        "torque": motor.torque,
        "inertia": felt.at_motor,
        "optimal": felt.optimal_ratio,
    }


def _gear_steps(task: GearTask) -> tuple[Step, ...]:
    felt = inertias(task.ratio, task.motor_inertia, task.load_inertia)
    found = sides(task.ratio, task.efficiency, None, task.load_speed, None, task.load_torque)
    return gear_steps(task.ratio, task.efficiency, *found, felt)


GEAR = Exercise(
    id="actuators.gear",
    title=marked("A gear between motor and joint"),
    difficulty=2,
    draw=_draw_gear,
    text=_gear_text,
    fields=lambda _task: (
        _quantity("speed", _("Speed of the motor"), "rad/s"),
        _quantity("torque", _("Torque of the motor"), "N m"),
        _quantity("inertia", _("Inertia at the motor"), "kg m²"),
        _quantity("optimal", _("Optimal ratio N*")),
    ),
    solve=_gear_answers,
    steps=_gear_steps,
    wrong={
        "ratio_inverted": lambda task: {
            "speed": task.load_speed / task.ratio,
            "torque": task.load_torque * task.ratio / task.efficiency,
        },
        "efficiency_forgotten": lambda task: {"torque": task.load_torque / task.ratio},
        "efficiency_inverted": lambda task: {"torque": task.load_torque * task.efficiency / task.ratio},
        "ratio_not_squared": lambda task: {"inertia": task.motor_inertia + task.load_inertia / task.ratio},
        "inertia_at_load": lambda task: {"inertia": task.ratio**2 * task.motor_inertia + task.load_inertia},
        "inertia_without_rotor": lambda task: {"inertia": task.load_inertia / task.ratio**2},
        "root_forgotten": lambda task: {"optimal": task.load_inertia / task.motor_inertia},
        "inertias_exchanged": lambda task: {"optimal": math.sqrt(task.motor_inertia / task.load_inertia)},
    },
)


# Pulse width modulation


class PulseTask(NamedTuple):
    """A switched supply at a winding."""

    supply: float
    voltage: float
    kilohertz: float
    millihenry: float

    @property
    def pulses(self) -> Pulses:
        """The pulses with the wanted average."""
        return Pulses(self.supply, self.voltage / self.supply, 1e3 * self.kilohertz)

    @property
    def inductance(self) -> float:
        """L in H."""
        return 1e-3 * self.millihenry


def _draw_pulses(draw: Draw) -> PulseTask:
    supply = draw.choice((12.0, 24.0, 36.0, 48.0))
    return PulseTask(
        supply, draw.decimal(2.0, supply - 1.0, 0.5), draw.decimal(5.0, 30.0, 5.0), draw.decimal(0.5, 4.0, 0.5)
    )


def _pulses_text(task: PulseTask) -> str:
    return _(
        "A supply of {supply:g} V is switched at {kilohertz:g} kHz, so that a motor sees {voltage:g} V on average. Its "
        "winding has L = {millihenry:g} mH; its resistance may be neglected. What are the duty D, the root mean square "
        "of the voltage, the duration of a pulse, and the ripple of the current from peak to peak?"
    ).format(**task._asdict())


PULSES = Exercise(
    id="actuators.pwm",
    title=marked("Pulse width modulation"),
    difficulty=2,
    draw=_draw_pulses,
    is_degenerate=lambda task: not 0.15 <= task.voltage / task.supply <= 0.8,
    text=_pulses_text,
    fields=lambda _task: (
        _quantity("duty", _("Duty D")),
        _quantity("rms", _("Root mean square of the voltage"), "V"),
        _quantity("on_time", _("Duration of a pulse"), "s"),
        _quantity("ripple", _("Ripple of the current"), "A", 2.0),
    ),
    solve=lambda task: {
        "duty": task.pulses.duty,
        "rms": task.pulses.rms_voltage,
        "on_time": task.pulses.on_time,
        "ripple": approximate_ripple(task.pulses, task.inductance),
    },
    steps=lambda task: pwm_steps(task.pulses, task.inductance, None),
    wrong={
        "duty_of_pause": lambda task: {"duty": 1.0 - task.pulses.duty, "on_time": task.pulses.off_time},
        "ratio_upside_down": lambda task: {"duty": task.supply / task.voltage},
        "mean_for_rms": lambda task: {"rms": task.voltage},
        "duty_for_rms": lambda task: {"rms": task.pulses.duty**2 * task.supply},
        "frequency_forgotten": lambda task: {"on_time": task.pulses.duty},
        "whole_period": lambda task: {"on_time": 1e-3 / task.kilohertz},
        "ripple_without_pause": lambda task: {"ripple": task.voltage * 1e-3 / task.kilohertz / task.inductance},
        "ripple_of_pause": lambda task: {"ripple": task.supply * task.pulses.off_time / task.inductance},
    },
)


# An encoder behind a gear


class EncoderTask(NamedTuple):
    """An incremental encoder with quadrature on the motor of a geared joint."""

    lines: int
    ratio: float
    milliseconds: float

    @property
    def counts(self) -> int:
        """Counts per turn of the motor."""
        return 4 * self.lines


def _encoder_text(task: EncoderTask) -> str:
    return _(
        "An incremental encoder of {lines} lines is on the motor shaft of a joint; its two channels are decoded with "
        "quadrature (x4). The gear ratio is N = {ratio:g}. The counter is read every {milliseconds:g} ms. How many "
        "counts has a turn of the motor, which angle is a count at the motor and at the joint, and which step of the "
        "joint's speed is one count in a period?"
    ).format(**task._asdict())


def _encoder_with(task: EncoderTask, counts: float) -> Answers:
    motor = 2.0 * math.pi / counts
    joint = motor / task.ratio
    return {"counts": counts, "motor": motor, "joint": joint, "quantum": joint / (1e-3 * task.milliseconds)}


def _encoder_answers(task: EncoderTask) -> Answers:
    found = resolution(task.counts, task.ratio, 1e-3 * task.milliseconds)
    return {"counts": task.counts, "motor": found.motor, "joint": found.load, "quantum": found.load_velocity_quantum}


def _encoder_steps(task: EncoderTask) -> tuple[Step, ...]:
    found = resolution(task.counts, task.ratio, 1e-3 * task.milliseconds)
    at_joint = step(
        _("At the joint"),
        _("Behind the gear both are smaller by its ratio."),
        rf"\Delta\varphi_L = {tex(found.load, 'rad')}",
        rf"\Delta\omega_L = {tex(found.load_velocity_quantum or 0.0, 'rad/s')}",
    )
    how = rf"4 \cdot {task.lines}"
    return (*resolution_steps(task.counts, task.ratio, how, 1e-3 * task.milliseconds), at_joint)


ENCODER = Exercise(
    id="actuators.encoder",
    title=marked("An encoder behind a gear"),
    difficulty=2,
    draw=lambda draw: EncoderTask(
        draw.choice((256, 360, 500, 512, 1000, 1024, 2000)), draw.decimal(20.0, 160.0, 5.0), draw.decimal(1.0, 5.0, 1.0)
    ),
    text=_encoder_text,
    fields=lambda _task: (
        _count("counts", _("Counts of a turn")),
        _quantity("motor", _("Angle of a count at the motor"), "rad"),
        _quantity("joint", _("Angle of a count at the joint"), "rad"),
        _quantity("quantum", _("Step of the joint's speed"), "rad/s"),
    ),
    solve=_encoder_answers,
    steps=_encoder_steps,
    wrong={
        "quadrature_forgotten": lambda task: _encoder_with(task, task.lines),
        "quadrature_halved": lambda task: _encoder_with(task, 2 * task.lines),
        "gear_forgotten": lambda task: {
            "joint": 2.0 * math.pi / task.counts,
            "quantum": 2e3 * math.pi / task.counts / task.milliseconds,
        },
        "gear_multiplied": lambda task: {"joint": 2.0 * math.pi / task.counts * task.ratio},
        "period_multiplied": lambda task: {
            "quantum": 2.0 * math.pi / task.counts / task.ratio * 1e-3 * task.milliseconds
        },
    },
)


# An exam: the drive of a joint


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
        _quantity("speed", _("Speed of the motor"), "rad/s"),
        _quantity("torque", _("Torque of the motor"), "N m"),
        _quantity("current", _("Current of the motor"), "A"),
        _quantity("voltage", _("Voltage of the motor"), "V", 2.0),
        _quantity("duty", _("Duty D")),
        _count("counts", _("Counts of a turn")),
        _count("bits", _("Bits")),
        _count("lines", _("Lines")),
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

EXERCISES = (MOTOR, GEAR, PULSES, ENCODER, DRIVE)
