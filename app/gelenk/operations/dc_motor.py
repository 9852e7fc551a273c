"""The calculator of DC motors."""

from dataclasses import asdict
from typing import Any

import numpy as np

from gelenk.contract.dc_motor import DcMotorRequest
from gelenk.course.actuators.dc_motor import (
    balance,
    modes,
    motor_steps,
    motor_warnings,
    operating_point,
    torque_speed_line,
)
from gelenk.course.actuators.motor_response import step_response
from gelenk.errors import InvalidField
from gelenk.operations.outcome import Outcome
from gelenk.robot.arrays import Array

_SAMPLES = 101
_QUICK_SAMPLES = 1000


def run(call: DcMotorRequest) -> Outcome:
    """Compute a DC motor's steady state, torque-speed line, poles and step response."""
    return Outcome(lambda: _dc_motor(call))


def is_heavy(call: DcMotorRequest) -> bool:
    """Check whether a request takes the event loop more than about a millisecond."""
    return (call.samples or 0) > _QUICK_SAMPLES


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
