"""The calculator of gears."""

from dataclasses import asdict
from typing import Any

from gelenk.contract.gear import GearRequest
from gelenk.course.actuators.gear import Gear, Sides, back_driving_note, gear_steps, inertias, sides
from gelenk.errors import InvalidField
from gelenk.operations.outcome import Outcome


def run(call: GearRequest) -> Outcome:
    """Compute speeds, torques and powers on both sides of a gear, inertias, and back-driving."""
    return Outcome(lambda: _gear(call))


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
