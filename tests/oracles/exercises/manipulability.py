"""Solutions by turning unit joint velocities and torques once around, and by the formulas of two links."""

from typing import Any

import numpy as np
from scipy.optimize import minimize_scalar

from tests.oracles.exercises.velocities import planar_jacobian, turned


def direction(angle: Any) -> Any:
    return np.array([np.cos(angle), np.sin(angle)])


def jacobian(task: Any) -> Any:
    return planar_jacobian((task.l1, task.l2), turned((task.q1, task.q2)))


def ellipse(J: Any) -> tuple[float, float, Any]:
    """Semi-axes and major axis, by turning a direction until the shadow of the ellipse is the longest."""
    (a, b), (_, d) = J @ J.T
    angle = np.arctan2(2 * b, a - d) / 2
    found = minimize_scalar(
        lambda x: -np.linalg.norm(J.T @ direction(x)),
        bounds=(angle - 0.3, angle + 0.3),
        method="bounded",
        options={"xatol": 1e-10},
    )
    across = direction(found.x + np.pi / 2)
    return -found.fun, float(np.linalg.norm(J.T @ across)), direction(found.x)


def reach(J: Any, u: Any) -> dict[str, Any]:
    """A tip velocity and a force of unit size, divided by the joint velocities and torques that they need."""
    rates = np.linalg.lstsq(J, u, rcond=None)[0]
    return {"velocity": 1 / np.linalg.norm(rates), "force": 1 / np.linalg.norm(J.T @ u)}


def measure(task: Any) -> dict[str, Any]:
    w = abs(task.l1 * task.l2 * np.sin(turned(task.q2)))
    return {"measure": w, "area": np.pi * w, "best": task.l1 * task.l2}


def velocity(task: Any) -> dict[str, Any]:
    major, minor, axis = ellipse(jacobian(task))
    return {"major": major, "minor": minor, "axis": axis[:, None]}


def force(task: Any) -> dict[str, Any]:
    fast, slow, axis = ellipse(jacobian(task))
    strongest = [[-axis[1]], [axis[0]]]
    return {"major": 1 / slow, "minor": 1 / fast, "axis": strongest, "condition": fast / slow}


def transmission(task: Any) -> dict[str, Any]:
    return reach(jacobian(task), direction(turned(task.towards)))


def stretched(task: Any) -> dict[str, Any]:
    J = jacobian(task)
    major, minor, _ = ellipse(J)
    way = task.l1 * direction(turned(task.q1)) + task.l2 * direction(turned(task.q1 + task.q2))
    along, across = (np.linalg.norm(J.T @ u) for u in (way, [-way[1], way[0]]))
    fast, strong = ("along", "across") if along > across else ("across", "along")
    return {"fast": fast, "strong": strong, "isotropy": minor / major}


def isotropic(task: Any) -> dict[str, Any]:
    second = task.l1 * np.sin(np.pi / 4)
    bend = np.degrees(np.arccos(-second / task.l1))
    J = planar_jacobian((task.l1, second), turned((20, bend)))
    assert np.allclose(J.T @ J, second**2 * np.eye(2), atol=1e-8)
    return {"second": second, "bends": [-bend, bend], "semi_axis": np.linalg.norm(J[:, 0])}


def three_links(task: Any) -> dict[str, Any]:
    J = planar_jacobian((task.l1, task.l2, task.l3), turned((task.q1, task.q2, task.q3)))
    major, minor, axis = ellipse(J)
    minors = [J[0, i] * J[1, j] - J[0, j] * J[1, i] for i, j in ((0, 1), (0, 2), (1, 2))]  # by Cauchy and Binet
    return {
        "gram": sum(np.outer(column, column) for column in J.T),
        "measure": np.linalg.norm(minors),
        "major": major,
        "minor": minor,
        "axis": axis[:, None],
        "strongest": [[-axis[1]], [axis[0]]],
        **reach(J, direction(turned(task.towards))),
    }


SOLUTIONS = {
    "manipulability.measure": measure,
    "manipulability.velocity": velocity,
    "manipulability.force": force,
    "manipulability.transmission": transmission,
    "manipulability.stretched": stretched,
    "manipulability.isotropic": isotropic,
    "manipulability.three_links": three_links,
}
DIGESTS = {
    "manipulability.stretched:1": "2e13c60eb4b6478d",
    "manipulability.measure:1": "3c1b472be844819a",
    "manipulability.velocity:1": "10fb7e54977348ea",
    "manipulability.force:1": "f355a59c40cfedc9",
    "manipulability.isotropic:1": "8ecedef33e4251fa",
    "manipulability.transmission:1": "52f246c2889b864f",
    "manipulability.three_links:1": "5dd832e3d6dfa579",
}
