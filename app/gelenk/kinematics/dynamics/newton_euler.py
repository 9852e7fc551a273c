"""Torques that move a body and hold its weight, by Newton's and Euler's equations in the axes of the root.

Velocities and accelerations are passed on along the chain from the root to the body (the forward half of
[Featherstone2008, 5.3]); force and moment at the body's centre of mass then act on each joint below it. Nothing here
uses Pinocchio, so each can check the other.
"""

from typing import TypeAlias

import numpy as np

from gelenk.kinematics.simd.vectors import Vector, cross, dot, plus
from gelenk.robot.arrays import Array, Indices
from gelenk.robot.chain import FlatChain
from gelenk.robot.compilation import compiled, inlined

_Matrix: TypeAlias = tuple[Vector, Vector, Vector]


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
        p = plus(p, 1.0, lever)
        acceleration = plus(acceleration, 1.0, _of_lever(omega, alpha, lever))
        about = _product(_product(R, inertia), _transposed(R))
        moment = plus(_turned(about, alpha), 1.0, cross(omega, _turned(about, omega)))
        for i in range(m):
            j, axis, slides = columns[flat.joints[i, 1]], _vector(axes[i], 0), flat.joints[i, 0] == 1
            # What a unit of the joint's motion does to the centre of mass.
            moved = axis if slides else cross(axis, plus(p, -1.0, _vector(origins[i], 0)))
            turned = 0.0 if slides else dot(axis, moment)
            inertial[k, j] += flat.drives[i, 0] * (mass * dot(moved, acceleration) + turned)
            weight[k, j] -= flat.drives[i, 0] * mass * dot(moved, down)


@inlined
def _motion(
    flat: FlatChain, columns: Indices, states: tuple[Array, Array, Array], k: int, axes: Array, origins: Array
) -> tuple[_Matrix, Vector, Vector, Vector, Vector]:
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
            lever = plus(_turned(R, offset), value, axis)
            acceleration = plus(plus(acceleration, change, axis), 2.0 * rate, cross(omega, axis))
        else:
            R = _about_z(R, value)
            lever = _turned(R, offset)
            alpha = plus(plus(alpha, change, axis), rate, cross(omega, axis))
            omega = plus(omega, rate, axis)
        acceleration = plus(acceleration, 1.0, _of_lever(omega, alpha, lever))
        p, R = plus(p, 1.0, lever), _product(R, turn)
    return R, p, omega, alpha, acceleration


@inlined
def _vector(values: Array, first: int) -> Vector:
    return values[first], values[first + 1], values[first + 2]


@inlined
def _placement(flat: FlatChain, i: int) -> tuple[_Matrix, Vector]:
    row = flat.placements[i]
    return (_vector(row, 0), _vector(row, 3), _vector(row, 6)), _vector(row, 9)


@inlined
def _turned(R: _Matrix, a: Vector) -> Vector:
    return dot(R[0], a), dot(R[1], a), dot(R[2], a)


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
def _of_lever(omega: Vector, alpha: Vector, lever: Vector) -> Vector:
    """Return the acceleration of the end of a lever against its beginning, α × r + ω × (ω × r)."""
    return plus(cross(alpha, lever), 1.0, cross(omega, cross(omega, lever)))
