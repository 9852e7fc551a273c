"""Torques that move a body and hold its weight, by Newton's and Euler's equations in the axes of the root.

Velocities and accelerations are passed on along the chain from the root to the body (the forward half of
[Featherstone2008, 5.3]); force and moment at the body's centre of mass then act on each joint below it. Nothing here
uses Pinocchio, so each can check the other.
"""

from typing import TypeAlias

import numpy as np

from gelenk.robot.arrays import Array, Indices
from gelenk.robot.chain import FlatChain
from gelenk.robot.compilation import compiled, inlined

_Vector: TypeAlias = tuple[float, float, float]
_Matrix: TypeAlias = tuple[_Vector, _Vector, _Vector]


@compiled
def add_torques(
    flat: FlatChain,
    columns: Indices,
    weights: Array,
    gravity: Array,
    states: tuple[Array, Array, Array],
    inertial: Array,
    weight: Array,
) -> None:
    """Add the torques that one body needs to those of N states: M q̈ + C q̇, and g; shape (N, n) each, [N m or N].

    Args:
        flat, columns: The chain from the root to the body's frame, and which variable each of its own is.
        weights: Mass [kg], centre [m], and inertia about it row by row [kg m²], in the body's frame; shape (13,).
        gravity: Shape (3,), [m/s²].
        states: q, q̇ and q̈; shape (N, n) each.
    """
    m = len(flat.joints)
    axes, origins = np.empty((m, 3)), np.empty((m, 3))
    mass, center, down = weights[0], _vector(weights, 1), _vector(gravity, 0)
    inertia = (_vector(weights, 4), _vector(weights, 7), _vector(weights, 10))
    for k in range(len(inertial)):
        R, p, omega, alpha, acceleration = _motion(flat, columns, states, k, axes, origins)
        lever = _turned(R, center)
        p = _sum(p, lever, 1.0)
        acceleration = _sum(acceleration, _of_lever(omega, alpha, lever), 1.0)
        about = _product(_product(R, inertia), _transposed(R))
        moment = _sum(_turned(about, alpha), _cross(omega, _turned(about, omega)), 1.0)
        for i in range(m):
            j, axis, slides = columns[flat.joints[i, 1]], _vector(axes[i], 0), flat.joints[i, 0] == 1
            # What a unit of the joint's motion does to the centre of mass.
            moved = axis if slides else _cross(axis, _sum(p, _vector(origins[i], 0), -1.0))
            turned = 0.0 if slides else _dot(axis, moment)
            inertial[k, j] += flat.drives[i, 0] * (mass * _dot(moved, acceleration) + turned)
            weight[k, j] -= flat.drives[i, 0] * mass * _dot(moved, down)


@inlined
def _motion(
    flat: FlatChain, columns: Indices, states: tuple[Array, Array, Array], k: int, axes: Array, origins: Array
) -> tuple[_Matrix, _Vector, _Vector, _Vector, _Vector]:
    """Return pose, ω, α and the acceleration of the end of a chain in a state; write the joints' axes and origins."""
    qs, vs, accelerations = states
    R, p = _placement(flat, 0)
    omega, alpha, acceleration = (0.0, 0.0, 0.0), (0.0, 0.0, 0.0), (0.0, 0.0, 0.0)
    for i in range(len(flat.joints)):
        j, ratio = columns[flat.joints[i, 1]], flat.drives[i, 0]
        value, rate, change = ratio * qs[k, j] + flat.drives[i, 1], ratio * vs[k, j], ratio * accelerations[k, j]
        axis = (R[0][2], R[1][2], R[2][2])
        axes[i], origins[i] = axis, p
        turn, offset = _placement(flat, i + 1)
        if flat.joints[i, 0] == 1:
            lever = _sum(_turned(R, offset), axis, value)
            acceleration = _sum(_sum(acceleration, axis, change), _cross(omega, axis), 2.0 * rate)
        else:
            R = _about_z(R, value)
            lever = _turned(R, offset)
            alpha = _sum(_sum(alpha, axis, change), _cross(omega, axis), rate)
            omega = _sum(omega, axis, rate)
        acceleration = _sum(acceleration, _of_lever(omega, alpha, lever), 1.0)
        p, R = _sum(p, lever, 1.0), _product(R, turn)
    return R, p, omega, alpha, acceleration


@inlined
def _vector(values: Array, first: int) -> _Vector:
    return values[first], values[first + 1], values[first + 2]


@inlined
def _placement(flat: FlatChain, i: int) -> tuple[_Matrix, _Vector]:
    row = flat.placements[i]
    return (_vector(row, 0), _vector(row, 3), _vector(row, 6)), _vector(row, 9)


@inlined
def _dot(a: _Vector, b: _Vector) -> float:
    return a[0] * b[0] + a[1] * b[1] + a[2] * b[2]


@inlined
def _cross(a: _Vector, b: _Vector) -> _Vector:
    return a[1] * b[2] - a[2] * b[1], a[2] * b[0] - a[0] * b[2], a[0] * b[1] - a[1] * b[0]


@inlined
def _sum(a: _Vector, b: _Vector, factor: float) -> _Vector:
    """Return a + factor b."""
    return a[0] + factor * b[0], a[1] + factor * b[1], a[2] + factor * b[2]


@inlined
def _turned(R: _Matrix, a: _Vector) -> _Vector:
    return _dot(R[0], a), _dot(R[1], a), _dot(R[2], a)


@inlined
def _transposed(R: _Matrix) -> _Matrix:
    return (R[0][0], R[1][0], R[2][0]), (R[0][1], R[1][1], R[2][1]), (R[0][2], R[1][2], R[2][2])


@inlined
def _product(R: _Matrix, S: _Matrix) -> _Matrix:
    columns = _transposed(S)
    return _turned(columns, R[0]), _turned(columns, R[1]), _turned(columns, R[2])


@inlined
def _about_z(R: _Matrix, angle: float) -> _Matrix:
    c, s = np.cos(angle), np.sin(angle)
    return _product(R, ((c, -s, 0.0), (s, c, 0.0), (0.0, 0.0, 1.0)))


@inlined
def _of_lever(omega: _Vector, alpha: _Vector, lever: _Vector) -> _Vector:
    """Return the acceleration of the end of a lever against its beginning, α × r + ω × (ω × r)."""
    return _sum(_cross(alpha, lever), _cross(omega, _cross(omega, lever)), 1.0)
