"""Vectors as tuples of three numbers, for compiled code that handles lines and points one at a time."""

import math
from typing import TypeAlias

from gelenk.robot.arrays import Array
from gelenk.robot.compilation import inlined

Vector: TypeAlias = tuple[float, float, float]


@inlined
def row(rows: Array, i: int) -> Vector:
    """Return row i of an array of vectors."""
    return rows[i, 0], rows[i, 1], rows[i, 2]


@inlined
def dot(a: Vector, b: Vector) -> float:
    """Compute the scalar product a·b."""
    return a[0] * b[0] + a[1] * b[1] + a[2] * b[2]


@inlined
def cross(a: Vector, b: Vector) -> Vector:
    """Compute the cross product a × b."""
    return a[1] * b[2] - a[2] * b[1], a[2] * b[0] - a[0] * b[2], a[0] * b[1] - a[1] * b[0]


@inlined
def minus(a: Vector, b: Vector) -> Vector:
    """Compute a - b."""
    return a[0] - b[0], a[1] - b[1], a[2] - b[2]


@inlined
def plus(a: Vector, factor: float, b: Vector) -> Vector:
    """Compute a + factor · b."""
    return a[0] + factor * b[0], a[1] + factor * b[1], a[2] + factor * b[2]


@inlined
def scaled(factor: float, a: Vector) -> Vector:
    """Compute factor · a."""
    return factor * a[0], factor * a[1], factor * a[2]


@inlined
def turned(axis: Vector, angle: float, a: Vector) -> Vector:
    """Rotate a vector about a unit axis by an angle, [rad], with Rodrigues' formula [Rodrigues]."""
    c, s = math.cos(angle), math.sin(angle)
    return plus(plus(scaled(c, a), (1.0 - c) * dot(axis, a), axis), s, cross(axis, a))
