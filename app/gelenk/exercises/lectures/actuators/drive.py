"""A gear between motor and joint, an encoder behind it, and an exam: the whole drive."""

import math
from typing import Annotated, NamedTuple

from gelenk.course.actuators.dc_motor import Motor
from gelenk.course.actuators.encoders import required, required_step, resolution, resolution_steps
from gelenk.course.actuators.gear import gear_steps, inertias, sides
from gelenk.course.actuators.pwm import speed_step, voltage_for_speed
from gelenk.course.steps import Step, step, tex
from gelenk.exercises.draw import Draw, drawn
from gelenk.exercises.exercise import Answers, Exercise
from gelenk.exercises.fields import quantity, whole
from gelenk.language import marked, translated as _


class GearTask(NamedTuple):
    """A gear between a motor and a load that turns and resists."""

    ratio: Annotated[float, Draw.decimal, 20.0, 150.0, 5.0]
    efficiency: Annotated[float, Draw.decimal, 0.6, 0.85, 0.05]
    load_speed: Annotated[float, Draw.decimal, 0.5, 4.0, 0.1]
    load_torque: Annotated[float, Draw.decimal, 10.0, 80.0, 1.0]
    motor_inertia: Annotated[float, Draw.decimal, 0.0001, 0.0006, 0.0001]
    load_inertia: Annotated[float, Draw.decimal, 0.5, 4.0, 0.1]


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
    draw=drawn(GearTask),
    text=lambda one: _(
        "A motor drives a joint through a gear of ratio N = {ratio:g} and efficiency η = {efficiency:g}. The joint "
        "turns at {load_speed:g} rad/s against a torque of {load_torque:g} N m. The rotor has the inertia J_m = "
        "{motor_inertia:g} kg m², the load J_L = {load_inertia:g} kg m². What are speed and torque of the motor, the "
        "inertia that the motor feels, and the ratio with which a given torque would accelerate the load most?"
    ).format(**one._asdict()),
    fields=lambda _task: (
        quantity("speed", _("Speed of the motor"), "rad/s"),
        quantity("torque", _("Torque of the motor"), "N m"),
        quantity("inertia", _("Inertia at the motor"), "kg m²"),
        quantity("optimal", _("Optimal ratio N*")),
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


class EncoderTask(NamedTuple):
    """An incremental encoder with quadrature on the motor of a geared joint."""

    lines: Annotated[int, Draw.choice, (256, 360, 500, 512, 1000, 1024, 2000)]
    ratio: Annotated[float, Draw.decimal, 20.0, 160.0, 5.0]
    milliseconds: Annotated[float, Draw.decimal, 1.0, 5.0, 1.0]

    @property
    def counts(self) -> int:
        """Counts per turn of the motor."""
        return 4 * self.lines


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
    draw=drawn(EncoderTask),
    text=lambda one: _(
        "An incremental encoder of {lines} lines is on the motor shaft of a joint; its two channels are decoded with "
        "quadrature (x4). The gear ratio is N = {ratio:g}. The counter is read every {milliseconds:g} ms. How many "
        "counts has a turn of the motor, which angle is a count at the motor and at the joint, and which step of the "
        "joint's speed is one count in a period?"
    ).format(**one._asdict()),
    fields=lambda _task: (
        whole("counts", _("Counts of a turn")),
        quantity("motor", _("Angle of a count at the motor"), "rad"),
        quantity("joint", _("Angle of a count at the joint"), "rad"),
        quantity("quantum", _("Step of the joint's speed"), "rad/s"),
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


class DriveTask(NamedTuple):
    """A joint with gear, motor and encoder; the speed in rad/s, the resolution in degrees."""

    ratio: Annotated[float, Draw.decimal, 40.0, 160.0, 2.0]
    efficiency: Annotated[float, Draw.decimal, 0.6, 0.85, 0.05]
    joint_speed: Annotated[float, Draw.decimal, 1.0, 3.0, 0.1]
    joint_torque: Annotated[float, Draw.decimal, 10.0, 60.0, 2.0]
    resolution: Annotated[float, Draw.decimal, 0.001, 0.01, 0.001]
    resistance: Annotated[float, Draw.decimal, 0.4, 1.6, 0.1]
    constant: Annotated[float, Draw.decimal, 0.04, 0.1, 0.01]
    supply: float = 48.0

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
    draw=drawn(DriveTask),
    is_degenerate=lambda task: not 0.2 <= _drive_answers(task)["duty"] <= 0.9,
    text=lambda one: _(
        "A joint has to turn at {joint_speed:g} rad/s against a torque of {joint_torque:g} N m. Its gear has the ratio "
        "N = {ratio:g} and the efficiency η = {efficiency:g}; its motor has R = {resistance:g} Ω, k_t = k_e = "
        "{constant:g} N m/A and no friction. The supply has {supply:g} V and is switched.\n\n"
        "What are speed and torque of the motor, its current, its voltage, and the duty of the pulses? On the motor "
        "shaft there is an encoder, and the joint's angle is to be resolved to {resolution:g}°. How many counts of a "
        "turn does that take at least, how many bits of an absolute encoder, how many lines of an incremental one with "
        "quadrature (x4)?"
    ).format(**one._asdict()),
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
        "efficiency_forgotten": lambda one: one._replace(efficiency=1.0),
        "efficiency_inverted": lambda one: one._replace(efficiency=1.0 / one.efficiency),
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
