"""Solutions by solving the equations of a motor as linear ones, and by counting."""

from math import pi, sqrt
from typing import Any

import numpy as np


def motor(task: Any) -> dict[str, Any]:
    R, k, b = task.resistance, task.constant, task.friction
    equations = np.array([[R, k], [k, -b]])  # of current and speed: of the voltage, and of the torque
    current, speed = np.linalg.solve(equations, [task.voltage, task.load])
    _, free = np.linalg.solve(equations, [task.voltage, 0.0])
    return {"speed": speed, "current": current, "no_load": free, "stall": k * task.voltage / R}


def gear(task: Any) -> dict[str, Any]:
    speed = task.load_speed * task.ratio
    power = task.load_torque * task.load_speed / task.efficiency
    energy = 0.5 * task.motor_inertia * speed**2 + 0.5 * task.load_inertia * task.load_speed**2
    ratios = np.linspace(1.0, 400.0, 40_000)
    best = ratios[np.argmax(ratios / (ratios**2 * task.motor_inertia + task.load_inertia))]
    return {"speed": speed, "torque": power / speed, "inertia": 2 * energy / speed**2, "optimal": best}


def pwm(task: Any) -> dict[str, Any]:
    period = 1e-3 / task.kilohertz
    on = task.voltage / task.supply * period
    return {
        "duty": on / period,
        "rms": sqrt(task.supply**2 * on / period),
        "on_time": on,
        "ripple": (task.supply - task.voltage) * on / (1e-3 * task.millihenry),
    }


def encoder(task: Any) -> dict[str, Any]:
    edges = task.lines * 2 * 2  # two channels, two edges of each
    joint = 2 * pi / edges / task.ratio
    return {"counts": edges, "motor": 2 * pi / edges, "joint": joint, "quantum": joint / task.milliseconds * 1000}


def drive(task: Any) -> dict[str, Any]:
    speed = task.joint_speed * task.ratio
    torque = task.joint_torque * task.joint_speed / task.efficiency / speed
    current = torque / task.constant
    voltage = (torque * speed + task.resistance * current**2) / current
    counts = 1
    while counts * task.ratio * task.resolution < 360.0 * (1 - 1e-12):
        counts += 1
    bits = next(n for n in range(1, 40) if 2**n >= counts)
    lines = next(n for n in range(counts) if 4 * n >= counts)
    return {
        "speed": speed,
        "torque": torque,
        "current": current,
        "voltage": voltage,
        "duty": voltage / task.supply,
        "counts": counts,
        "bits": bits,
        "lines": lines,
    }


SOLUTIONS = {
    "actuators.motor": motor,
    "actuators.gear": gear,
    "actuators.pwm": pwm,
    "actuators.encoder": encoder,
    "actuators.drive": drive,
}
DIGESTS = {
    "actuators.encoder:1": "10eaf2a821a4727f",
    "actuators.gear:1": "1d671bcaca106caf",
    "actuators.motor:1": "3aac7034581f0728",
    "actuators.pwm:1": "2e342d8190669bfb",
    "actuators.drive:1": "1cbabd730e903387",
}
