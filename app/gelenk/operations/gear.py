"""The calculator of gears."""

from typing import Any

from gelenk.contract.gear import GearRequest
from gelenk.course.actuators.gear import back_driving, gear_steps, inertias, sides
from gelenk.errors import InvalidField
from gelenk.operations.outcome import json_only


@json_only
def run(call: GearRequest) -> dict[str, Any]:
    """Compute speeds, torques and powers on both sides of a gear, inertias, and back-driving."""
    for quantity in ("angular_velocity", "torque"):
        if getattr(call, f"motor_{quantity}") is not None and getattr(call, f"load_{quantity}") is not None:
            raise InvalidField(f"load_{quantity}", f"follows from `motor_{quantity}`: give one of the two")
    if (call.motor_inertia is None) != (call.load_inertia is None):
        missing = "motor_inertia" if call.motor_inertia is None else "load_inertia"
        raise InvalidField(missing, "is needed beside the other inertia")
    gear = (call.ratio, call.efficiency)
    motor, load, flow = sides(
        *gear, call.motor_angular_velocity, call.load_angular_velocity, call.motor_torque, call.load_torque
    )
    inertia = None
    if call.motor_inertia is not None and call.load_inertia is not None:
        inertia = inertias(call.ratio, call.motor_inertia, call.load_inertia)
    return {
        "motor": motor,
        "load": load,
        "power_loss": None if motor.power is None or load.power is None else motor.power - load.power,
        "power_flow": flow,
        "inertia": inertia,
        "back_driving": back_driving(call.efficiency),
        "steps": gear_steps(*gear, motor, load, flow, inertia),
    }
