"""Orientations by the rotations of scipy, and transforms by general inverses."""

from itertools import product
from math import atan2, pi, radians
from typing import Any

import numpy as np
from scipy.linalg import inv
from scipy.spatial.transform import Rotation


def of(one: Any) -> Rotation:
    return Rotation.from_matrix(np.array(one.rows) / one.divisor)


def both(R: Rotation, axes: str) -> list[Any]:
    """The triple that scipy finds, and of its eight flips by half turns the other one that is the same rotation."""
    first = R.as_euler(axes)
    flips = [first + np.array(turns) * pi for turns in product((0, 1), repeat=3)]
    mirrored = [one * [1, -1, 1] for one in flips]
    found = [one for one in [*flips[1:], *mirrored] if (Rotation.from_euler(axes, one) * R.inv()).magnitude() < 1e-9]
    return [first, found[0]]


def turns(one: Any) -> dict[str, Any]:
    axes = (one.first_axis + one.second_axis).upper()
    R = Rotation.from_euler(axes, [one.first, one.second], degrees=True)
    return {"rotation": R.as_matrix(), "point": R.apply([one.x, one.y, one.z])}


def inverse(one: Any) -> dict[str, Any]:
    T = np.eye(4)
    T[:3, :3] = Rotation.from_euler(one.axis, one.angle, degrees=True).as_matrix()
    T[:3, 3] = one.x, one.y, one.z
    return {"inverse": inv(T), "point": np.linalg.solve(T, [one.u, one.v, one.w, 1.0])[:3]}


def zyz(one: Any) -> dict[str, Any]:
    return {"angles": both(of(one), "ZYZ")}


def rpy(one: Any) -> dict[str, Any]:
    given = np.radians([one.roll, one.pitch, one.yaw])
    R = Rotation.from_euler("xyz", given)
    triples = both(R, "xyz")
    other = max(triples, key=lambda angles: abs(np.exp(1j * angles) - np.exp(1j * given)).max())
    return {"rotation": R.as_matrix(), "other": other}


def degenerate(one: Any) -> dict[str, Any]:
    """At ϑ = 0 the image of x is at φ + ψ; at ϑ = π the image of -x is at φ - ψ."""
    R, psi = of(one.rotation), radians(one.psi)
    theta, sign = (0.0, 1) if R.apply([0, 0, 1])[2] > 0 else (pi, -1)
    x, y, _ = R.apply([sign, 0, 0])
    value = atan2(y, x)
    phi = value - psi if sign > 0 else value + psi
    assert (Rotation.from_euler("ZYZ", [phi, theta, psi]) * R.inv()).magnitude() < 1e-9
    return {"theta": theta, "known": "sum" if sign > 0 else "difference", "value": value, "phi": phi}


def axis_angle(one: Any) -> dict[str, Any]:
    vector = of(one).as_rotvec()
    angle = np.linalg.norm(vector)
    return {"angle": angle, "axis": vector / angle}


def camera(one: Any) -> dict[str, Any]:
    gripper = Rotation.from_euler("xyz", one.rpy, degrees=True)
    R = gripper * Rotation.from_euler("y", one.tilt, degrees=True)
    origin = np.array(one.gripper) + gripper.apply(one.camera)
    vector = R.as_rotvec()
    angle = np.linalg.norm(vector)
    return {
        "rotation": R.as_matrix(),
        "point": origin + R.apply(one.seen),
        "base": R.inv().apply(-origin),
        "angles": both(R, "ZYZ"),
        "angle": angle,
        "axis": vector / angle,
    }


SOLUTIONS = {
    "poses.turns": turns,
    "poses.inverse": inverse,
    "poses.zyz": zyz,
    "poses.rpy": rpy,
    "poses.degenerate": degenerate,
    "poses.axis_angle": axis_angle,
    "poses.camera": camera,
}
DIGESTS = {
    "poses.inverse:1": "6ba4d6bf5cbd4b73",
    "poses.turns:1": "2e1798d87ba973dc",
    "poses.rpy:1": "8f55910b91f90df8",
    "poses.zyz:1": "e7c29883340d458a",
    "poses.axis_angle:1": "806e2cc043e3493a",
    "poses.degenerate:1": "822821febf3a50d3",
    "poses.camera:1": "753585de22a7261f",
}
