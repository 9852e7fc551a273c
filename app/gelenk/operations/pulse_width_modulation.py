"""The calculator of pulse width modulation."""

from typing import Any

from gelenk.contract.common import content_of
from gelenk.contract.pulse_width_modulation import PwmAnswer, PwmRequest
from gelenk.course.actuators import pwm
from gelenk.course.actuators.dc_motor import Motor
from gelenk.errors import InvalidField
from gelenk.operations.outcome import Outcome, PictureFormat

_SAME_VOLTAGE = 1e-6
"""Relative difference of two back-EMFs that differ only by the digits they were written with."""
_OF_A_SPEED = ("torque_constant", "back_emf_constant", "viscous_friction", "load_torque")


def run(call: PwmRequest) -> Outcome:
    """Compute duty, voltages, times and current ripple of pulse width modulation."""
    return Outcome(lambda: _content(call), picture=lambda kind: _picture(call, kind))


def _picture(call: PwmRequest, kind: PictureFormat) -> bytes:
    from gelenk.plots.course.pulses import pulses_figure  # noqa: PLC0415
    from gelenk.plots.figure import as_bytes  # noqa: PLC0415

    pulses = _pulses(call, _motor_for_speed(call))
    ripple, current, time_constant = _ripple(call, pulses), None, 0.0
    if ripple is not None and call.resistance and call.inductance is not None:
        back_emf = pulses.average_voltage - ripple.average * call.resistance
        settled = ((pulses.high_voltage - back_emf) / call.resistance, -back_emf / call.resistance)
        current, time_constant = (ripple.lowest, ripple.highest, *settled), call.inductance / call.resistance
    return as_bytes(pulses_figure(pulses, current, time_constant), kind)


def _ripple(call: PwmRequest, pulses: pwm.Pulses) -> pwm.Ripple | None:
    """Return the exact current in the steady state, if there are R and L."""
    back_emf = _back_emf(call, _motor_for_speed(call))
    if call.resistance is None or call.inductance is None:
        return None
    return pwm.exact_ripple(pulses, call.resistance, call.inductance, back_emf)


def _content(call: PwmRequest) -> dict[str, Any]:
    motor = _motor_for_speed(call)
    pulses = _pulses(call, motor)
    ripple = _ripple(call, pulses)
    wanted = [] if motor is None else [pwm.speed_step(motor, call.angular_velocity or 0.0, call.load_torque or 0.0)]
    return content_of(
        PwmAnswer,
        pulses,
        needs_h_bridge=pulses.direction < 0,
        approximate_ripple=pwm.approximate_ripple(pulses, call.inductance) if call.inductance else None,
        current=ripple,
        steps=[*wanted, *pwm.pwm_steps(pulses, call.inductance, ripple)],
        warnings=pwm.pwm_warnings(pulses, ripple),
    )


def _back_emf(call: PwmRequest, motor: Motor | None) -> float:
    """Return the back-EMF E during the period, [V]; for a wanted speed, that of this speed."""
    if motor is None:
        return call.back_emf or 0.0
    of_speed = motor.back_emf_constant * (call.angular_velocity or 0.0)
    given = of_speed if call.back_emf is None else call.back_emf
    if abs(given - of_speed) > _SAME_VOLTAGE * max(abs(given), abs(of_speed)):
        raise InvalidField("back_emf", f"is {of_speed:g} V at this `angular_velocity`, not {given:g} V: leave it out")
    return of_speed


def _motor_for_speed(call: PwmRequest) -> Motor | None:
    """Return the motor whose speed is wanted; None if another quantity is given."""
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
    # Neither inductance nor inertia matters in a steady state.
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
