"""A motor in the steady state, and its voltage by pulse width modulation."""

from typing import Annotated, NamedTuple

from gelenk.course.actuators.dc_motor import Motor, motor_steps, operating_point, torque_speed_line
from gelenk.course.actuators.pwm import Pulses, approximate_ripple, pwm_steps
from gelenk.exercises.draw import Draw, drawn
from gelenk.exercises.exercise import Answers, Exercise
from gelenk.exercises.fields import quantity
from gelenk.language import marked, translated as _


class MotorTask(NamedTuple):
    """A motor with its supply and load, in SI units."""

    resistance: Annotated[float, Draw.decimal, 0.5, 3.0, 0.1]
    inductance: Annotated[float, Draw.decimal, 0.001, 0.005, 0.001]
    constant: Annotated[float, Draw.decimal, 0.03, 0.12, 0.01]
    friction: Annotated[float, Draw.decimal, 0.0002, 0.002, 0.0002]
    voltage: Annotated[float, Draw.choice, (12.0, 24.0, 36.0, 48.0)]
    load: Annotated[float, Draw.decimal, 0.05, 0.4, 0.05]

    @property
    def motor(self) -> Motor:
        """The motor; its inertia does not matter in the steady state."""
        return Motor(self.resistance, self.inductance, self.constant, self.constant, self.friction, 2e-4)


def _is_useless_motor(task: MotorTask) -> bool:
    line = torque_speed_line(task.motor, task.voltage)
    return not 0.1 * line.stall_torque <= task.load <= 0.7 * line.stall_torque


def _motor_answers(task: MotorTask) -> Answers:
    point = operating_point(task.motor, task.voltage, task.load)
    line = torque_speed_line(task.motor, task.voltage)
    return {
        "speed": point.angular_velocity,
        "current": point.current,
        "no_load": line.no_load_angular_velocity,
        "stall": line.stall_torque,
    }


def _motor_without_emf(task: MotorTask) -> Answers:
    stall = task.constant * task.voltage / task.resistance
    speed = (stall - task.load) / task.friction
    return {"speed": speed, "current": task.voltage / task.resistance, "no_load": stall / task.friction}


def _motor_with_constant_once(task: MotorTask) -> Answers:
    """Return the speeds with k_t in place of k_t k_e, and the current that follows from the voltage equation."""
    stiffness = task.resistance * task.friction + task.constant
    no_load = task.constant * task.voltage / stiffness
    speed = no_load - task.resistance * task.load / stiffness
    return {"speed": speed, "current": (task.voltage - task.constant * speed) / task.resistance, "no_load": no_load}


MOTOR = Exercise(
    id="actuators.motor",
    title=marked("A DC motor under load"),
    difficulty=2,
    draw=drawn(MotorTask),
    is_degenerate=_is_useless_motor,
    text=lambda one: _(
        "A DC motor has R = {resistance:g} Ω, L = {inductance:g} H, k_t = k_e = {constant:g} N m/A and the viscous "
        "friction b = {friction:g} N m s/rad. At {voltage:g} V it drives a load of {load:g} N m against the motion. "
        "What are speed and current in the steady state, the speed without load, and the torque at which it stalls?"
    ).format(**one._asdict()),
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
        "load_forgotten": lambda one: one._replace(load=0.0),
        "load_helps": lambda one: one._replace(load=-one.load),
        "friction_forgotten": lambda one: one._replace(friction=0.0),
        "constant_once": _motor_with_constant_once,
        "back_emf_forgotten": _motor_without_emf,
        "voltage_for_torque": lambda task: {"stall": task.voltage / task.resistance},
    },
)


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


PULSES = Exercise(
    id="actuators.pwm",
    title=marked("Pulse width modulation"),
    difficulty=2,
    draw=_draw_pulses,
    is_degenerate=lambda task: not 0.15 <= task.voltage / task.supply <= 0.8,
    text=lambda one: _(
        "A supply of {supply:g} V is switched at {kilohertz:g} kHz, so that a motor sees {voltage:g} V on average. Its "
        "winding has L = {millihenry:g} mH; its resistance may be neglected. What are the duty D, the root mean square "
        "of the voltage, the duration of a pulse, and the ripple of the current from peak to peak?"
    ).format(**one._asdict()),
    fields=lambda _task: (
        quantity("duty", _("Duty D")),
        quantity("rms", _("Root mean square of the voltage"), "V"),
        quantity("on_time", _("Duration of a pulse"), "s"),
        quantity("ripple", _("Ripple of the current"), "A", 2.0),
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
