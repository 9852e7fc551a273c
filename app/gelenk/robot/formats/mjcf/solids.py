"""Bodies of density 1 in closed form: primitives and meshes of MJCF, solid, or as shells of their surface."""

import math
from collections.abc import Iterator
from dataclasses import dataclass

import numpy as np

from gelenk.robot.arrays import Array
from gelenk.robot.formats.sources import Fault

_LEAST_VOLUME = 1e-15
"""Least volume [m³], or surface [m²], that has a mass; MuJoCo's."""


@dataclass(frozen=True, slots=True)
class MassBody:
    """A mass [kg], its centre, shape (3,), [m], and its inertia about that, (3, 3), [kg m²], in the same axes."""

    mass: float
    centre: Array
    inertia: Array

    def scaled(self, factor: float) -> "MassBody":
        """Return a body of the same extent that is so many times as heavy."""
        return MassBody(self.mass * factor, self.centre, self.inertia * factor)

    def placed(self, T: Array) -> "MassBody":
        """Return the body in another frame, in which its own has pose T; shape (4, 4)."""
        R = T[:3, :3]
        return MassBody(self.mass, R @ self.centre + T[:3, 3], R @ self.inertia @ R.T)


def primitive(kind: str, size: tuple[float, ...], is_shell: bool = False) -> MassBody:
    """Return a primitive about its middle, with the half lengths of MJCF; the axis of a capsule or cylinder is z.

    A shell's density is that of its surface, [kg/m²]. Raises Fault if it has no volume or surface.
    """
    x, y, z = (*size, 0.0, 0.0, 0.0)[:3]
    if kind == "sphere":
        kind, y, z = "ellipsoid", x, x
    parts = list((_shell_parts if is_shell else _solid_parts)(kind, x, y, z))
    mass = sum(amount for amount, _ in parts)
    _check(mass)
    squares = sum((amount * np.array(means) for amount, means in parts), np.zeros(3))
    return MassBody(mass, np.zeros(3), np.diag(squares.sum() - squares))


_Part = tuple[float, tuple[float, float, float]]
"""A volume or surface, and the means of x², y² and z² over it."""


def _solid_parts(kind: str, x: float, y: float, z: float) -> Iterator[_Part]:
    if kind == "ellipsoid":
        yield 4.0 / 3.0 * math.pi * x * y * z, (x * x / 5.0, y * y / 5.0, z * z / 5.0)
    elif kind == "box":
        yield 8.0 * x * y * z, (x * x / 3.0, y * y / 3.0, z * z / 3.0)
    else:
        yield 2.0 * math.pi * x * x * y, (x * x / 4.0, x * x / 4.0, y * y / 3.0)
    if kind == "capsule":
        yield 4.0 / 3.0 * math.pi * x**3, (x * x / 5.0, x * x / 5.0, x * x / 5.0 + y * y + 0.75 * x * y)


def _shell_parts(kind: str, x: float, y: float, z: float) -> Iterator[_Part]:
    if kind == "ellipsoid":
        yield _ellipsoid_shell(x, y, z)
    elif kind == "box":
        xx, yy, zz = x * x / 3.0, y * y / 3.0, z * z / 3.0
        yield 8.0 * y * z, (x * x, yy, zz)
        yield 8.0 * z * x, (xx, y * y, zz)
        yield 8.0 * x * y, (xx, yy, z * z)
    else:
        yield 4.0 * math.pi * x * y, (x * x / 2.0, x * x / 2.0, y * y / 3.0)
    if kind == "cylinder":
        yield 2.0 * math.pi * x * x, (x * x / 4.0, x * x / 4.0, y * y)
    elif kind == "capsule":
        yield 4.0 * math.pi * x * x, (x * x / 3.0, x * x / 3.0, x * x / 3.0 + y * y + x * y)


def _ellipsoid_shell(x: float, y: float, z: float) -> _Part:
    """Return the surface by Thomsen's formula, and the means over the layer that half axes longer by dx add.

    A surface of even density has no closed form. This is what MuJoCo takes, exact for a sphere.
    """
    pairs = x * y, y * z, z * x
    surface = 4.0 * math.pi * (sum(pair**1.6075 for pair in pairs) / 3.0) ** (1.0 / 1.6075)
    added = 0.4 * x * y * z / sum(pairs) if any(pairs) else 0.0
    return surface, (x * x / 5.0 + added * x, y * y / 5.0 + added * y, z * z / 5.0 + added * z)


def solid_within(triangles: Array, is_exact: bool = True) -> MassBody:
    """Return the body within triangles, shape (F, 3, 3).

    Unless it is exact, it is made of tetrahedra between the triangles and the middle, first that of the surface, then
    that of those tetrahedra, each counted as positive, as MuJoCo does by itself: the same for closed surfaces whose
    insides are seen from there, and some result for others.

    Raises:
        Fault: It has no volume.
    """
    normals, areas, middles = _faces(triangles)
    _check(float(areas.sum()))
    apex = areas @ middles / areas.sum()

    def volumes(apex: Array) -> Array:
        found: Array = np.einsum("ij,ij->i", middles - apex, normals) / 3.0
        return found if is_exact else np.abs(found)

    parts = volumes(apex)
    sign = math.copysign(1.0, parts.sum())  # a scale below zero, or a file, may turn the surface inside out
    volume = sign * float(parts.sum())
    _check(volume)
    centre = sign * parts @ (0.75 * middles + 0.25 * apex) / volume
    return _summed(triangles, sign * volumes(centre), centre, 20.0)


def shell_of(triangles: Array) -> MassBody:
    """Return the surface of triangles, shape (F, 3, 3), of which 1 m² weighs 1 kg; raises Fault if it has none."""
    _, areas, middles = _faces(triangles)
    _check(float(areas.sum()))
    return _summed(triangles, areas, areas @ middles / areas.sum(), 12.0)


def _faces(triangles: Array) -> tuple[Array, Array, Array]:
    """Return normals as long as the areas, (F, 3), areas, (F,), and middles, (F, 3), of triangles."""
    normals = np.cross(triangles[:, 1] - triangles[:, 0], triangles[:, 2] - triangles[:, 0]) / 2.0
    return normals, np.linalg.norm(normals, axis=1), triangles.mean(axis=1)


def _summed(triangles: Array, parts: Array, centre: Array, divisor: float) -> MassBody:
    """Return the sum of parts: triangles, with the divisor 12, or their tetrahedra with the centre, with 20."""
    corners = triangles - centre
    sums = corners.sum(axis=1)
    moments = np.einsum("f,fi,fj->ij", parts, sums, sums) + np.einsum("f,fki,fkj->ij", parts, corners, corners)
    moments /= divisor
    return MassBody(float(parts.sum()), centre, np.trace(moments) * np.eye(3) - moments)


def _check(amount: float) -> None:
    if amount < _LEAST_VOLUME:
        raise Fault("it has no volume")
