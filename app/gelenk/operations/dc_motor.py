"""The calculator of DC motors."""

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
from gelenk.operations.outcome import Outcome, PictureFormat
from gelenk.robot.arrays import Array

_SAMPLES = 101
_QUICK_SAMPLES = 1000


def run(call: DcMotorRequest) -> Outcome:
    """Compute a DC motor's steady state, torque-speed line, poles and step response."""
    return Outcome(lambda: _content(call), picture=lambda kind: _picture(call, kind))


def _picture(call: DcMotorRequest, kind: PictureFormat) -> bytes:
    from gelenk.plots.course.motor import motor_figure  # noqa: PLC0415
    from gelenk.plots.figure import as_bytes  # noqa: PLC0415

    return as_bytes(motor_figure(call.motor(), call.voltage, call.load_torque), kind)


def _content(call: DcMotorRequest) -> dict[str, Any]:
    motor, times = call.motor(), _times(call)
    if motor.inductance == 0.0 and call.initial_current != 0.0:
        raise InvalidField("initial_current", "without inductance the current follows at once and has no initial value")
    supply = (motor, call.voltage, call.load_torque)
    point, found = operating_point(*supply), modes(motor)
    voltage_residual, torque_residual = balance(*supply, point)
    start = (call.initial_current, call.initial_angular_velocity)
    exact = None if times is None else step_response(*supply, times, *start)
    response = exact and {"times": times, "currents": exact.currents, "angular_velocities": exact.angular_velocities}
    return {
        "steady_state": point,
        "torque_speed_line": torque_speed_line(motor, call.voltage),
        "dynamics": {
            "poles": [{"real": pole.real, "imaginary": pole.imag} for pole in found.poles],
            "damping": found.damping,
            "time_constants": [-1.0 / pole.real for pole in found.poles],
            "mechanical_time_constant": motor.mechanical_time_constant,
            "electrical_time_constant": motor.electrical_time_constant,
        },
        "response": response,
        "steps": motor_steps(*supply, point),
        "warnings": motor_warnings(*supply, point),
        "certificate": {
            "voltage_residual": voltage_residual,
            "torque_residual": torque_residual,
            "samples": exact.samples if exact else 0,
            "max_current_difference": exact and exact.current_difference,
            "max_angular_velocity_difference": exact and exact.angular_velocity_difference,
        },
    }


def is_heavy(call: DcMotorRequest) -> bool:
    """Check whether a request takes the event loop more than about a millisecond."""
    return (call.samples or 0) > _QUICK_SAMPLES


def _times(call: DcMotorRequest) -> Array | None:
    if call.duration is None:
        if call.samples is not None:
            raise InvalidField("samples", "needs `duration`, which is missing")
        return None if call.times is None else np.array(call.times)
    if call.times is not None:
        raise InvalidField("duration", "give it instead of `times`, not with them")
    return np.linspace(0.0, call.duration, call.samples or _SAMPLES)
