"""Solutions by elementary transforms, and a table from lines in space by their common normals."""

from math import atan2, cos, radians, sin
from typing import Any

import numpy as np

from tests.oracles.dh_columns import Table, shift, turn


def matrix(row: Any) -> dict[str, Any]:
    T = turn(2, radians(row.theta)) @ shift(2, row.d) @ shift(0, row.a) @ turn(0, radians(row.alpha))
    return {"matrix": T}


def entries(one: Any) -> dict[str, Any]:
    theta = np.angle(complex(one.cosine_theta, one.sine_theta))
    alpha = np.angle(complex(one.cosine_alpha, one.sine_alpha))
    return {"a": abs(complex(one.x, one.y)), "alpha": alpha, "d": one.d, "theta": theta}


def forward(arm: Any) -> dict[str, Any]:
    q1, q2, q3 = (radians(q) for q in (arm.q1, arm.q2, arm.q3))
    out = arm.upper * cos(q2) + arm.lower * cos(q2 + q3)
    up = arm.height + arm.upper * sin(q2) + arm.lower * sin(q2 + q3)
    return {"position": [out * cos(q1), out * sin(q1), up], "incline": q2 + q3}


def conventions(one: Any) -> dict[str, Any]:
    angles = [(a, radians(alpha), d, radians(theta)) for a, alpha, d, theta in one.rows]
    further = [*((a, alpha) for a, alpha, _, _ in angles[1:]), (0.0, 0.0)]
    return {"table": [(*x, d, theta) for x, (_, _, d, theta) in zip(further, angles, strict=True)]}


def arm(one: Any) -> dict[str, Any]:
    """Joints as screws about the axes that the text gives, then a table from those lines alone."""
    tip = Table(True, [tuple(row) for row in one.array], one.slides).pose([0.0] * 3)
    lines = [one.axis(i) for i in range(3)]
    pose = np.eye(4)
    for (point, axis), slides, q in zip(lines, one.slides, one.positions, strict=True):
        pose = pose @ (screw(point, axis, 0.0, q) if slides else screw(point, axis, q, 0.0))
    pose = pose @ tip
    return {"table": from_lines(lines, tip), "position": pose[:3, 3], "rotation": pose[:3, :3]}


def screw(point: Any, axis: Any, angle: float, way: float) -> Any:
    """Turn about a line, and move along it."""
    K = np.array([[0, -axis[2], axis[1]], [axis[2], 0, -axis[0]], [-axis[1], axis[0], 0]])
    R = np.eye(3) + sin(angle) * K + (1 - cos(angle)) * K @ K
    T = np.eye(4)
    T[:3, :3], T[:3, 3] = R, point - R @ point + way * axis
    return T


def from_lines(lines: Any, tip: Any) -> list[tuple[float, float, float, float]]:
    """Frame by frame: the next origin is where the common normal meets the next axis."""
    here, x, z = np.zeros(3), np.array([1.0, 0.0, 0.0]), np.array([0.0, 0.0, 1.0])
    rows: list[tuple[float, float, float, float]] = []
    for point, axis in [*lines[1:], (tip[:3, 3], tip[:3, 2])]:
        normal = np.cross(z, axis)
        if len(rows) == 2:  # the last frame is given
            x_there, there = tip[:3, 0], tip[:3, 3]
        elif np.linalg.norm(normal) > 1e-9:
            x_there = normal / np.linalg.norm(normal)
            s = np.dot(np.cross(here - point, z), np.cross(axis, z)) / np.dot(normal, normal)
            there = point + s * axis
        else:
            apart = (point - here) - np.dot(point - here, z) * z
            x_there, there = apart / np.linalg.norm(apart), here + apart
        theta = atan2(np.dot(np.cross(x, x_there), z), np.dot(x, x_there))
        alpha = atan2(np.dot(np.cross(z, axis), x_there), np.dot(z, axis))
        rows.append((float(np.dot(there - here, x_there)), alpha, float(np.dot(there - here, z)), theta))
        here, x, z = there, x_there, np.asarray(axis)
    return rows


SOLUTIONS = {
    "dh_tables.matrix": matrix,
    "dh_tables.entries": entries,
    "dh_tables.forward": forward,
    "dh_tables.conventions": conventions,
    "dh_tables.arm": arm,
}
DIGESTS = {
    "dh_tables.matrix:1": "8ccd6998794c775a",
    "dh_tables.entries:1": "0aed660e498f0570",
    "dh_tables.forward:1": "724c596722c725d1",
    "dh_tables.conventions:1": "dc46bcee4443e742",
    "dh_tables.arm:1": "cbbc3b63fcacf0aa",
}
