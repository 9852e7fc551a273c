"""The calculators of actuators: POST /v1/course/dc-motor, /gear and /pwm."""

from dataclasses import asdict
from typing import Any

import numpy as np

from gelenk.api.course import course_route
from gelenk.api.course_encoder import encoder_route
from gelenk.api.course_planar import workspace_route
from gelenk.api.remote import Remote
from gelenk.api.routes import DocumentedRoute
from gelenk.contract.course_components import (
    EXAMPLE_GEAR,
    EXAMPLE_MOTOR,
    EXAMPLE_PWM,
    DcMotorAnswer,
    DcMotorRequest,
    GearAnswer,
    GearRequest,
    PwmAnswer,
    PwmRequest,
)
from gelenk.course import pwm
from gelenk.course.dc_motor import (
    Motor,
    balance,
    modes,
    motor_steps,
    motor_warnings,
    operating_point,
    torque_speed_line,
)
from gelenk.course.gear import Gear, Sides, back_driving_note, gear_steps, inertias, sides
from gelenk.course.motor_response import step_response
from gelenk.model.arrays import Array
from gelenk.model.errors import InvalidField

_SAMPLES = 101
_QUICK_SAMPLES = 1000
_SAME_VOLTAGE = 1e-6
"""Relative difference of two back-EMFs that are one, but for the digits they were written with."""
_OF_A_SPEED = ("torque_constant", "back_emf_constant", "viscous_friction", "load_torque")


def component_routes(remote: Remote, max_body_bytes: int) -> list[DocumentedRoute]:
    """Motor, gear, pulse width modulation, encoder and planar workspace."""

    def dc_motor(call: DcMotorRequest) -> DcMotorAnswer:
        """A DC motor under a constant voltage and load: v = R i + L i̇ + k_e ω, J ω̇ + b ω = k_t i - τ_L.

        Steady state, no load and stall, powers and efficiency, exact poles beside the usual time constants, and the
        exact response to the step from any initial state, by the matrix exponential in closed form: real, double or
        complex poles, first order where L = 0. The load torque keeps its direction: beyond the stall torque it drives
        the motor backwards, which `regime` names. `back_emf_constant` is `torque_constant` unless given; in SI units
        they are equal, and two different values produce a warning.

        The lecture describes the motor in words; these are the equations behind it.
        """
        raise NotImplementedError

    def gear(call: GearRequest) -> GearAnswer:
        """A gear of ratio N = ω_motor / ω_load and efficiency η, from the motor's side or from the load's.

        Speed ω_L = ω_m / N, torque τ_L = η N τ_m, inertias across the gear by N², the ratio √(J_L / J_m) with which a
        given motor torque accelerates the load most. Where speed and torque have different signs the load drives:
        then friction helps to hold it, with the efficiency 2 - 1/η; at η ≤ 1/2 the gear locks itself.
        """
        raise NotImplementedError

    def pulse_width_modulation(call: PwmRequest) -> PwmAnswer:
        """A supply switched with a duty D: V_avg = D V_s, V_rms = √D V_s, and the ripple of the current.

        Give `duty`, or a wanted `average_voltage`, or a wanted `angular_velocity` of a motor: the duty is found. A
        negative average needs an H-bridge, and `direction` is -1. The ripple V_s D (1 - D) / (L f) leaves out the
        resistance; with R and L the current's extremes are exact, in the steady state, with a constant back-EMF.
        """
        raise NotImplementedError

    return [
        course_route(
            "dc-motor",
            dc_motor,
            DcMotorRequest,
            _dc_motor,
            remote,
            max_body_bytes,
            example=EXAMPLE_MOTOR,
            is_heavy=lambda call: (call.samples or 0) > _QUICK_SAMPLES,
            operation_id="dc_motor",
            summary="DC motor: steady state and step response",
        ),
        course_route(
            "gear",
            gear,
            GearRequest,
            _gear,
            remote,
            max_body_bytes,
            example=EXAMPLE_GEAR,
            operation_id="gear",
            summary="Gear: both sides",
        ),
        course_route(
            "pwm",
            pulse_width_modulation,
            PwmRequest,
            _pwm,
            remote,
            max_body_bytes,
            example=EXAMPLE_PWM,
            operation_id="pulse_width_modulation",
            summary="Pulse width modulation: averages and ripple",
        ),
        encoder_route(remote, max_body_bytes),
        workspace_route(remote, max_body_bytes),
    ]


def _dc_motor(call: DcMotorRequest) -> dict[str, Any]:
    motor, times = call.motor(), _times(call)
    if motor.inductance == 0.0 and call.initial_current != 0.0:
        raise InvalidField("initial_current", "without inductance the current follows at once and has no initial value")
    point = operating_point(motor, call.voltage, call.load_torque)
    left = balance(motor, call.voltage, call.load_torque, point)
    found = modes(motor)
    start = (call.initial_current, call.initial_angular_velocity)
    exact = None if times is None else step_response(motor, call.voltage, call.load_torque, times, *start)
    return {
        "steady_state": asdict(point),
        "torque_speed_line": asdict(torque_speed_line(motor, call.voltage)),
        "dynamics": {
            "poles": [{"real": pole.real, "imaginary": pole.imag} for pole in found.poles],
            "damping": found.damping,
            "time_constants": [-1.0 / pole.real for pole in found.poles],
            "mechanical_time_constant": motor.mechanical_time_constant,
            "electrical_time_constant": motor.electrical_time_constant,
        },
        "response": None
        if exact is None
        else {"times": times, "currents": exact.currents, "angular_velocities": exact.angular_velocities},
        "steps": [asdict(step) for step in motor_steps(motor, call.voltage, call.load_torque, point)],
        "warnings": motor_warnings(motor, call.voltage, call.load_torque, point),
        "certificate": {
            "voltage_residual": left.voltage,
            "torque_residual": left.torque,
            "samples": 0 if exact is None else exact.samples,
            "max_current_difference": None if exact is None else exact.current_difference,
            "max_angular_velocity_difference": None if exact is None else exact.angular_velocity_difference,
        },
    }


def _times(call: DcMotorRequest) -> Array | None:
    if call.duration is None:
        if call.samples is not None:
            raise InvalidField("samples", "needs `duration`, which is missing")
        return None if call.times is None else np.array(call.times)
    if call.times is not None:
        raise InvalidField("duration", "give it instead of `times`, not with them")
    return np.linspace(0.0, call.duration, call.samples or _SAMPLES)


def _gear(call: GearRequest) -> dict[str, Any]:
    for quantity in ("angular_velocity", "torque"):
        if getattr(call, f"motor_{quantity}") is not None and getattr(call, f"load_{quantity}") is not None:
            raise InvalidField(f"load_{quantity}", f"follows from `motor_{quantity}`: give one of the two")
    if (call.motor_inertia is None) != (call.load_inertia is None):
        missing = "motor_inertia" if call.motor_inertia is None else "load_inertia"
        raise InvalidField(missing, "is needed beside the other inertia")
    train = Gear(call.ratio, call.efficiency)
    found = sides(train, call.motor_angular_velocity, call.load_angular_velocity, call.motor_torque, call.load_torque)
    inertia = None
    if call.motor_inertia is not None and call.load_inertia is not None:
        inertia = inertias(call.ratio, call.motor_inertia, call.load_inertia)
    return {
        **_gear_sides(found),
        "inertia": None if inertia is None else asdict(inertia),
        "back_driving": {
            "efficiency": None if train.is_self_locking else train.back_driving_efficiency,
            "self_locking": train.is_self_locking,
            "note": back_driving_note(train),
        },
        "steps": [asdict(step) for step in gear_steps(train, found, inertia)],
    }


def _gear_sides(found: Sides) -> dict[str, Any]:
    motor, load = found.motor_power, found.load_power
    return {
        "motor": {"angular_velocity": found.motor_velocity, "torque": found.motor_torque, "power": motor},
        "load": {"angular_velocity": found.load_velocity, "torque": found.load_torque, "power": load},
        "power_loss": None if motor is None or load is None else motor - load,
        "power_flow": found.power_flow,
    }


def _pwm(call: PwmRequest) -> dict[str, Any]:
    motor = _motor_for_speed(call)
    pulses = _pulses(call, motor)
    back_emf = _back_emf(call, motor)
    ripple = None
    if call.resistance is not None and call.inductance is not None:
        ripple = pwm.exact_ripple(pulses, call.resistance, call.inductance, back_emf)
    wanted = [] if motor is None else [pwm.speed_step(motor, call.angular_velocity or 0.0, call.load_torque or 0.0)]
    return {
        "duty": pulses.duty,
        "direction": pulses.direction,
        "needs_h_bridge": pulses.direction < 0,
        "average_voltage": pulses.average_voltage,
        "rms_voltage": pulses.rms_voltage,
        "on_time": pulses.on_time,
        "off_time": pulses.off_time,
        "approximate_ripple": pwm.approximate_ripple(pulses, call.inductance) if call.inductance else None,
        "current": None if ripple is None else asdict(ripple),
        "steps": [asdict(step) for step in (*wanted, *pwm.pwm_steps(pulses, call.inductance, ripple))],
        "warnings": pwm.pwm_warnings(pulses, ripple),
    }


def _back_emf(call: PwmRequest, motor: Motor | None) -> float:
    """E through the period, [V]; of a wanted speed no other than its own."""
    if motor is None:
        return call.back_emf or 0.0
    of_speed = motor.back_emf_constant * (call.angular_velocity or 0.0)
    given = of_speed if call.back_emf is None else call.back_emf
    if abs(given - of_speed) > _SAME_VOLTAGE * max(abs(given), abs(of_speed)):
        raise InvalidField("back_emf", f"is {of_speed:g} V at this `angular_velocity`, not {given:g} V: leave it out")
    return of_speed


def _motor_for_speed(call: PwmRequest) -> Motor | None:
    """The motor whose speed is wanted; None where another quantity is."""
    if call.angular_velocity is None:
        for field in _OF_A_SPEED:
            if getattr(call, field) is not None:
                raise InvalidField(field, "needs `angular_velocity`, which is missing")
        return None
    if call.torque_constant is None:
        raise InvalidField("torque_constant", "is needed for a wanted `angular_velocity`")
    if call.resistance is None:
        raise InvalidField("resistance", "is needed for a wanted `angular_velocity`")
    back_emf = call.torque_constant if call.back_emf_constant is None else call.back_emf_constant
    # Neither inductance nor inertia counts in a steady state.
    return Motor(call.resistance, 0.0, call.torque_constant, back_emf, call.viscous_friction or 0.0, 1.0)


def _pulses(call: PwmRequest, motor: Motor | None) -> pwm.Pulses:
    wanted = {name: getattr(call, name) for name in ("duty", "average_voltage", "angular_velocity")}
    given = [name for name, value in wanted.items() if value is not None]
    if len(given) != 1:
        last = given[-1] if given else "duty"
        raise InvalidField(last, f"exactly one of {', '.join(wanted)} is given; here are {len(given)}")
    if call.duty is not None:
        return pwm.Pulses(call.supply_voltage, call.duty, call.frequency)
    voltage = call.average_voltage or 0.0
    if motor is not None:
        voltage = pwm.voltage_for_speed(motor, call.angular_velocity or 0.0, call.load_torque or 0.0)
    if abs(voltage) > call.supply_voltage:
        raise InvalidField(
            given[0], f"takes {voltage:g} V on average; the supply has {call.supply_voltage:g} V in either direction"
        )
    return pwm.Pulses(call.supply_voltage, abs(voltage) / call.supply_voltage, call.frequency, -1 if voltage < 0 else 1)
