"""Solutions by virtual work on differences of positions, and by lever arms that a picture shows."""

from typing import Any

import numpy as np

from tests.oracles.exercises.velocities import planar_jacobian, turned


def torques(lengths: Any, degrees: Any, force: Any, moment: float = 0.0) -> Any:
    """Cross products of the way from each joint to the tip with the force."""
    links = np.array(lengths) * np.exp(1j * np.cumsum(turned(degrees)))
    ways = np.cumsum(links[::-1])[::-1]
    return np.array([way.real * force[1] - way.imag * force[0] + moment for way in ways])


def pushed(task: Any) -> dict[str, Any]:
    return {"torques": torques((task.l1, task.l2), (task.q1, task.q2), (task.first, task.second))}


def payload(task: Any) -> dict[str, Any]:
    lengths, angles = (task.l1, task.l2), (task.q1, task.q2)
    levers = torques(lengths, angles, (0.0, 1.0))
    return {"levers": levers, "torques": levers * task.mass * 9.81}


def force(task: Any) -> dict[str, Any]:
    lengths, angles = (task.l1, task.l2), (task.q1, task.q2)
    a, b = (torques(lengths, angles, unit) for unit in ((1.0, 0.0), (0.0, 1.0)))
    found = np.linalg.lstsq(np.column_stack((a, b)), [task.first, task.second], rcond=None)[0]
    return {"force": found, "size": np.hypot(*found)}


def polar(task: Any) -> dict[str, Any]:
    size, towards = np.hypot(task.x_force, task.y_force), np.arctan2(task.y_force, task.x_force)
    between = towards - turned(task.q1)
    return {"torque": task.length * size * np.sin(between), "thrust": size * np.cos(between)}


def subspaces(task: Any) -> dict[str, Any]:
    along = turned(task.q1)
    reach = task.l2 * np.cos(turned(task.q2))
    c, s = np.cos(along), np.sin(along)
    return {
        "range": [[-s], [c]],
        "unfelt": [[c], [s]],
        "torques": [[task.l1 + reach], [reach]],
        "kernel": [[-reach], [task.l1 + reach]],
    }


def load(task: Any) -> dict[str, Any]:
    lengths, angles = (task.l1, task.l2, task.l3), (task.q1, task.q2, task.q3)
    found = torques(lengths, angles, (task.x_force, task.y_force), task.moment)
    joint = max((1, 2, 3), key=lambda i: abs(found[i - 1]))
    return {
        "jacobian": [*planar_jacobian(lengths, turned(angles)), np.ones(3)],
        "torques": found,
        "power": found[0] * task.rate1 + found[1] * task.rate2 + found[2] * task.rate3,
        "joint": joint,
        "factor": task.limit / abs(found[joint - 1]),
    }


SOLUTIONS = {
    "statics.torques": pushed,
    "statics.payload": payload,
    "statics.force": force,
    "statics.polar": polar,
    "statics.subspaces": subspaces,
    "statics.load": load,
}
DIGESTS = {
    "statics.torques:1": "e171b3910d391217",
    "statics.payload:1": "8688b7cf295bedc3",
    "statics.polar:1": "3bcfbf35f554f76e",
    "statics.force:1": "77e5bc881dd6000b",
    "statics.subspaces:1": "4160f1b4a22a29f1",
    "statics.load:1": "d55b114a76341695",
}
