"""Torques that move a body and hold its weight, by Newton's and Euler's equations in the axes of the root.

Velocities and accelerations are passed on along the chain from the root to the body (the forward half of
[Featherstone2008, 5.3]); force and moment at the body's centre of mass then act on each joint below it. Eight states
are computed at a time. Nothing here uses Pinocchio, so each can check the other.
"""

from typing import TypeAlias

import numpy as np

from gelenk.kinematics.simd.kernels import Frame, first_frame, moved, placed
from gelenk.kinematics.simd.lanes import LANES, Lanes, lanes, load, store
from gelenk.kinematics.simd.vectors import cross, dot, minus, plus, scaled
from gelenk.robot.arrays import Array, Indices
from gelenk.robot.chain import FlatChain
from gelenk.robot.compilation import compiled, inlined, unmanaged

_Vector: TypeAlias = tuple[Lanes, Lanes, Lanes]
_LINE = 6
"""Rows of lanes for a joint's axis and a point on it."""


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
    n, count = len(columns), len(inertial)
    work, lines, found = np.empty(3 * n * LANES), np.empty(_LINE * len(flat.joints) * LANES), np.empty(2 * n * LANES)
    for first in range(0, count, LANES):
        for order, rows in enumerate(states):
            for lane in range(LANES):
                for j in range(n):
                    work[(order * n + j) * LANES + lane] = rows[min(first + lane, count - 1), columns[j]]
        _store_torques(flat, n, weights, gravity, work, lines, found)
        for lane in range(min(LANES, count - first)):
            for j in range(n):
                inertial[first + lane, columns[j]] += found[j * LANES + lane]
                weight[first + lane, columns[j]] += found[(n + j) * LANES + lane]


@unmanaged
def _store_torques(
    flat: FlatChain, n: int, weights: Array, gravity: Array, work: Array, lines: Array, found: Array
) -> None:
    """Store M q̈ + C q̇ and g of the n variables of a chain for one body."""
    frame, omega, alpha, acceleration = _motion(flat, n, work, lines)
    mass, down = weights[0], (gravity[0], gravity[1], gravity[2])
    lever = _turned(frame, weights, 1)
    p = plus((frame[9], frame[10], frame[11]), 1.0, lever)
    acceleration = plus(acceleration, 1.0, _of_lever(omega, alpha, lever))
    moment = plus(_about(frame, weights, alpha), 1.0, cross(omega, _about(frame, weights, omega)))
    found[:] = 0.0
    for i in range(len(flat.joints)):
        j, ratio, slides = flat.joints[i, 1], flat.drives[i, 0], flat.joints[i, 0]
        axis, origin = _row(lines, _LINE * i), _row(lines, _LINE * i + 3)
        # What a unit of the joint's motion does to the centre of mass.
        shift = axis if slides else cross(axis, minus(p, origin))
        torque = mass * dot(shift, acceleration) + (lanes(0.0) if slides else dot(axis, moment))
        store(found, j, load(found, j) + ratio * torque)
        store(found, n + j, load(found, n + j) - (ratio * mass) * dot(shift, down))


@inlined
def _motion(flat: FlatChain, n: int, work: Array, lines: Array) -> tuple[Frame, _Vector, _Vector, _Vector]:
    """Return pose, ω, α and the acceleration of the end of a chain; write the joints' axes and origins."""
    zero, frame = lanes(0.0), first_frame(flat)
    omega, alpha, acceleration = (zero, zero, zero), (zero, zero, zero), (zero, zero, zero)
    for i in range(len(flat.joints)):
        slides, j, ratio = flat.joints[i, 0], flat.joints[i, 1], flat.drives[i, 0]
        rate, change = ratio * load(work, n + j), ratio * load(work, 2 * n + j)
        axis, origin = (frame[2], frame[5], frame[8]), (frame[9], frame[10], frame[11])
        for k in range(3):
            store(lines, _LINE * i + k, axis[k])
            store(lines, _LINE * i + 3 + k, origin[k])
        turning = cross(omega, axis)
        if slides:
            acceleration = plus(plus(acceleration, change, axis), 2.0 * rate, turning)
        else:
            alpha, omega = plus(plus(alpha, change, axis), rate, turning), plus(omega, rate, axis)
        frame = placed(moved(frame, slides, ratio * load(work, j) + flat.drives[i, 1]), flat, i + 1)
        lever = minus((frame[9], frame[10], frame[11]), origin)
        acceleration = plus(acceleration, 1.0, _of_lever(omega, alpha, lever))
    return frame, omega, alpha, acceleration


@inlined
def _row(rows: Array, first: int) -> _Vector:
    return load(rows, first), load(rows, first + 1), load(rows, first + 2)


@inlined
def _turned(frame: Frame, values: Array, first: int) -> _Vector:
    """Return a constant vector of a frame in the axes of the root."""
    a = values[first], values[first + 1], values[first + 2]
    return dot(frame[0:3], a), dot(frame[3:6], a), dot(frame[6:9], a)


@inlined
def _about(frame: Frame, weights: Array, a: _Vector) -> _Vector:
    """Return R I Rᵀ a for the inertia I of a body."""
    x, y, z = frame[0:3], frame[3:6], frame[6:9]
    own = plus(plus(scaled(a[0], x), a[1], y), a[2], z)
    b = (
        weights[4] * own[0] + weights[5] * own[1] + weights[6] * own[2],
        weights[7] * own[0] + weights[8] * own[1] + weights[9] * own[2],
        weights[10] * own[0] + weights[11] * own[1] + weights[12] * own[2],
    )
    return dot(x, b), dot(y, b), dot(z, b)


@inlined
def _of_lever(omega: _Vector, alpha: _Vector, lever: _Vector) -> _Vector:
    """Return the acceleration of the end of a lever against its beginning, α × r + ω × (ω × r)."""
    return plus(cross(alpha, lever), 1.0, cross(omega, cross(omega, lever)))
