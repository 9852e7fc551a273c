"""Elbows where two circles meet, in complex numbers; turns of the wrist by the rotations of scipy."""

from cmath import exp, phase, rect
from math import atan2, pi, radians, sin, sqrt
from typing import Any

from scipy.spatial.transform import Rotation

from tests.oracles.exercises.poses import both, of


def elbows(first: float, second: float, tip: complex) -> list[tuple[float, float]]:
    """Both pairs of angles of two links that end at a point."""
    r = abs(tip)
    along = (r**2 + first**2 - second**2) / (2 * r)
    across = sqrt(first**2 - along**2)
    found = []
    for side in (across, -across):
        elbow = complex(along, side) * tip / r
        assert abs(abs(tip - elbow) - second) < 1e-12
        found.append((phase(elbow), phase((tip - elbow) / elbow)))
    return found


def triangle(one: Any) -> dict[str, Any]:
    _base, second = max(elbows(one.first, one.second, complex(one.distance)))
    elbow = rect(one.first, elbows(one.first, one.second, complex(one.distance))[0][0])
    return {"alpha": abs(phase((one.distance - elbow) / -elbow)), "beta": abs(phase(elbow)), "bend": abs(second)}


def two_links(one: Any) -> dict[str, Any]:
    return {"solutions": elbows(one.first, one.second, complex(one.x, one.y))}


def three_links(one: Any) -> dict[str, Any]:
    phi = radians(one.phi)
    axis = complex(one.x, one.y) - one.third * exp(1j * phi)
    return {"solutions": [(a, b, phi - a - b) for a, b in elbows(one.first, one.second, axis)]}


def scara(one: Any) -> dict[str, Any]:
    pairs = elbows(one.first, one.second, complex(one.x, one.y))
    angles = [(a, b, a + b - radians(one.phi)) for a, b in pairs]
    return {"slide": one.height - one.tool - one.z, "angles": angles}


def upright(height: float, first: float, second: float, place: Any) -> list[tuple[float, float, float]]:
    """All four solutions for a point: in the vertical plane the point is before the first axis, or behind it."""
    x, y, z = place
    out = abs(complex(x, y))
    front = [(atan2(y, x), *pair) for pair in elbows(first, second, complex(out, z - height))]
    back = [(atan2(y, x) + pi, *pair) for pair in elbows(first, second, complex(-out, z - height))]
    return front + back


def anthropomorphic(one: Any) -> dict[str, Any]:
    return {"solutions": upright(one.height, one.upper, one.lower, (one.x, one.y, one.z))}


def behind(arm: Any, R: Rotation) -> dict[str, Any]:
    """What is left of a rotation behind the third joint, and the angles for it."""
    front = Rotation.from_euler("ZX", [arm[0], pi / 2]) * Rotation.from_euler("ZX", [arm[1] + arm[2], pi / 2])
    relative = front.inv() * R
    return {"relative": relative.as_matrix(), "wrist": both(relative, "ZYZ")}


def wrist(one: Any) -> dict[str, Any]:
    return behind([radians(q) for q in (one.q1, one.q2, one.q3)], of(one.rotation))


def decoupling(one: Any) -> dict[str, Any]:
    """The second link, along z3, is at a right angle behind x3."""
    R = of(one.rotation)
    centre = (one.x, one.y, one.z) - R.apply([0, 0, one.tool])
    arm = [(a, b, c + pi / 2) for a, b, c in upright(one.height, one.upper, one.lower, centre)]
    chosen = max(arm[:2], key=lambda q: sin(q[1]))
    return {"centre": centre, "arm": arm, **behind(chosen, R)}


SOLUTIONS = {
    "inverse_kinematics.triangle": triangle,
    "inverse_kinematics.two_links": two_links,
    "inverse_kinematics.three_links": three_links,
    "inverse_kinematics.scara": scara,
    "inverse_kinematics.anthropomorphic": anthropomorphic,
    "inverse_kinematics.wrist": wrist,
    "inverse_kinematics.decoupling": decoupling,
}
DIGESTS = {
    "inverse_kinematics.triangle:1": "63602a1491d68041",
    "inverse_kinematics.two_links:1": "345fcf7510519bd9",
    "inverse_kinematics.scara:1": "e476fcabb451a423",
    "inverse_kinematics.three_links:1": "3a4ea751cee756f2",
    "inverse_kinematics.wrist:1": "0c24a39665292877",
    "inverse_kinematics.anthropomorphic:1": "b3fa1091f36671bd",
    "inverse_kinematics.decoupling:1": "006305e5c64d51be",
}
