"""Solutions by differences of positions, by Cramer's rule and by least squares of stacked equations."""

from collections.abc import Callable
from typing import Any

import numpy as np
from scipy.optimize import brentq

STEP = 1e-5


def tip(lengths: Any, angles: Any) -> Any:
    """The tip of a planar arm."""
    at = np.sum(np.array(lengths) * np.exp(1j * np.cumsum(angles)))
    return np.array([at.real, at.imag])


def slope(f: Callable[[Any], Any], q: Any) -> Any:
    """Derivatives of a vector by each variable, as columns."""
    q = np.array(q, float)
    moves = STEP * np.eye(len(q))
    return np.array([(f(q + move) - f(q - move)) / (2 * STEP) for move in moves]).T


def planar_jacobian(lengths: Any, angles: Any) -> Any:
    return slope(lambda q: tip(lengths, q), angles)


def turned(degrees: Any) -> Any:
    return np.array(degrees) * np.pi / 180.0


def two(task: Any) -> Any:
    return planar_jacobian((task.l1, task.l2), turned((task.q1, task.q2)))


def two_links(task: Any) -> dict[str, Any]:
    J = two(task)
    area = task.l1 * task.l2 * np.sin(turned(task.q2))
    return {"jacobian": J, "determinant": area, "velocity": task.rate1 * J[:, 0] + task.rate2 * J[:, 1]}


def inverse(task: Any) -> dict[str, Any]:
    (a, b), (c, d) = two(task)
    x, y = task.x_rate, task.y_rate
    det = a * d - b * c
    return {"determinant": det, "rates": [(x * d - b * y) / det, (a * y - c * x) / det]}


def damped(task: Any) -> dict[str, Any]:
    J, v = two(task), np.array([task.x_rate, task.y_rate])
    stacked = np.vstack((J, np.sqrt(task.damping) * np.eye(2)))
    rates = np.linalg.lstsq(stacked, np.append(v, [0, 0]), rcond=None)[0]
    return {"rates": rates, "error": v - J @ rates}


def row(a: float, alpha: float, d: float, theta: float) -> Any:
    c, s, ca, sa = np.cos(theta), np.sin(theta), np.cos(alpha), np.sin(alpha)
    return np.array([[c, -s * ca, s * sa, a * c], [s, c * ca, -c * sa, a * s], [0, sa, ca, d], [0, 0, 0, 1]])


def spatial_jacobian(pose: Callable[[Any], Any], q: Any) -> Any:
    R = pose(np.array(q))[:3, :3]
    J = []
    for i in range(len(q)):
        move = np.zeros(len(q))
        move[i] = STEP
        change = (pose(q + move) - pose(q - move)) / (2 * STEP)
        spin = change[:3, :3] @ R.T
        J.append([*change[:3, 3], spin[2, 1], spin[0, 2], spin[1, 0]])
    return np.array(J).T


def scara(task: Any) -> dict[str, Any]:
    def pose(q: Any) -> Any:
        first = row(task.a1, 0, task.d1, q[0]) @ row(task.a2, np.pi, 0, q[1])
        return first @ row(0, 0, q[2], 0) @ row(0, 0, task.d4, q[3])

    q = np.array([*turned((task.q1, task.q2)), task.q3, turned(task.q4)])
    J = spatial_jacobian(pose, q)
    return {"jacobian": J, "twist": J @ [task.rate1, task.rate2, task.rate3, task.rate4]}


def elbow_arm(a2: float, a3: float, q: Any) -> Any:
    """The tip of an anthropomorphic arm, in cylindrical coordinates first."""
    reach = a2 * np.cos(q[1]) + a3 * np.cos(q[1] + q[2])
    return np.array([reach * np.cos(q[0]), reach * np.sin(q[0]), a2 * np.sin(q[1]) + a3 * np.sin(q[1] + q[2])])


def anthropomorphic(task: Any) -> dict[str, Any]:
    J = slope(lambda q: elbow_arm(task.a2, task.a3, q), turned((task.q1, task.q2, task.q3)))
    return {"jacobian": J, "determinant": np.cross(J[:, 0], J[:, 1]) @ J[:, 2]}


def singularities(task: Any) -> dict[str, Any]:
    def det(bend: float) -> Any:
        return np.linalg.det(slope(lambda q: elbow_arm(task.a2, task.a3, q), turned((task.q1, task.q2, bend))))

    starts = np.arange(-181.3, 180.0, 2.0)
    values = [det(bend) for bend in starts]
    zeros = [
        brentq(det, low, high)
        for low, high, a, b in zip(starts[:-1], starts[1:], values[:-1], values[1:], strict=True)
        if a * b < 0
    ]
    shoulder = [bend for bend in zeros if abs(np.sin(turned(bend))) > 1e-6]
    q1 = turned(task.q1)
    return {"elbow": [-180, 0], "shoulder": shoulder, "lost": [[np.sin(q1)], [-np.cos(q1)], [0]]}


def redundant(task: Any) -> dict[str, Any]:
    J = planar_jacobian((task.l1, task.l2, task.l3), turned((task.q1, task.q2, task.q3)))
    least = np.linalg.lstsq(J, [task.x_rate, task.y_rate], rcond=None)[0]
    kernel = np.cross(J[0], J[1])
    kernel /= np.linalg.norm(kernel)
    both = least + kernel * (kernel @ [task.xi1, task.xi2, task.xi3])
    return {"least": least, "kernel": kernel[:, None], "both": both}


def motion(task: Any) -> dict[str, Any]:
    q = turned((task.q1, task.q2))
    rates = np.reshape(task[4:], (3, 2))
    u, w, h = np.cumsum(rates, axis=1)  # of the directions of the links
    links = np.array([task.l1, task.l2]) * np.exp(1j * np.cumsum(q))
    velocity, acceleration, jerk = (
        complex(np.sum(factor * links)) for factor in (1j * u, 1j * w - u**2, 1j * h - 3 * u * w - 1j * u**3)
    )
    J = planar_jacobian((task.l1, task.l2), q)
    later, before = (planar_jacobian((task.l1, task.l2), q + h * rates[0]) for h in (1e-4, -1e-4))
    dJ = (later - before) / 2e-4
    left = np.array([acceleration.real, acceleration.imag]) - J @ rates[1]
    return {
        "jacobian": J,
        "determinant": task.l1 * task.l2 * np.sin(q[1]),
        "velocity": [velocity.real, velocity.imag],
        "jacobian_rate": dJ,
        "acceleration": [acceleration.real, acceleration.imag],
        "jerk": [jerk.real, jerk.imag],
        "uniform": np.linalg.inv(J) @ -left,
    }


SOLUTIONS = {
    "velocities.two_links": two_links,
    "velocities.inverse": inverse,
    "velocities.scara": scara,
    "velocities.damped": damped,
    "velocities.anthropomorphic": anthropomorphic,
    "velocities.singularities": singularities,
    "velocities.redundant": redundant,
    "velocities.motion": motion,
}
DIGESTS = {
    "velocities.two_links:1": "0ddf2b45759c934e",
    "velocities.inverse:1": "791be04ad901aa83",
    "velocities.scara:1": "9dfbee489a3b7a61",
    "velocities.anthropomorphic:1": "932ce74115c91439",
    "velocities.damped:1": "9106b9de81c8a78a",
    "velocities.redundant:1": "04d857953469366c",
    "velocities.singularities:1": "454ac07293f4606f",
    "velocities.motion:1": "8177591e24f2ff32",
}
