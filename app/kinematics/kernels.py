"""Compiled batches over the flat arrays of a chain; one configuration a row, released from the GIL.

Each function walks the chain once: constant placement, then the joint about or along local z. Nothing here knows
Pinocchio, which makes the two honest judges of each other.
"""

import math
from typing import TypeAlias

import numpy as np

from app.model.arrays import Array, compiled
from app.model.chain import FlatChain

_Frame: TypeAlias = tuple[float, float, float, float, float, float, float, float, float, float, float, float]
"""A pose in registers: rotation row by row, then position."""


@compiled
def chain_poses(flat: FlatChain, qs: Array) -> tuple[Array, Array]:
    """T_base_tip of each configuration.

    Args:
        flat: The chain.
        qs: Configurations; shape (N, n), [rad or m].

    Returns:
        Positions, shape (N, 3), [m], and rotations, shape (N, 3, 3).
    """
    positions, rotations = np.empty((len(qs), 3)), np.empty((len(qs), 3, 3))
    for row in range(len(qs)):
        frame = _first(flat)
        for i in range(len(flat.prismatic)):
            value = flat.multipliers[i] * qs[row, flat.variables[i]] + flat.offsets[i]
            frame = _placed(_moved(frame, flat.prismatic[i], value), flat, i + 1)
        _store(frame, positions[row], rotations[row])
    return positions, rotations


@compiled
def chain_jacobians(flat: FlatChain, qs: Array) -> tuple[Array, Array, Array]:
    """T_base_tip and the geometric Jacobian, in the base frame and at the tip, one column a variable.

    Args:
        flat: The chain.
        qs: Configurations; shape (N, n), [rad or m].

    Returns:
        Positions, shape (N, 3), [m]; rotations, shape (N, 3, 3); Jacobians, shape (N, 6, n), linear before angular.
    """
    positions, rotations = np.empty((len(qs), 3)), np.empty((len(qs), 3, 3))
    Js = np.empty((len(qs), 6, qs.shape[1]))
    columns = np.empty((len(flat.prismatic), 6))
    for row in range(len(qs)):
        _store(_columns(flat, qs[row], columns), positions[row], rotations[row])
        J = Js[row]
        J[:] = 0.0
        for i in range(len(columns)):
            for k in range(6):
                J[k, flat.variables[i]] += flat.multipliers[i] * columns[i, k]
    return positions, rotations, Js


@compiled
def chain_hessians(flat: FlatChain, qs: Array) -> Array:
    """∂J/∂q of the geometric Jacobian in the base frame at the tip, one index a variable.

    With columns (v_i; w_i) in the order of the way: ∂w_i/∂q_j = w_j × w_i for j before i, else 0;
    ∂v_i/∂q_j = w_j × v_i for j up to i, w_i × v_j for j after it [Hourtash2005].

    Args:
        flat: The chain.
        qs: Configurations; shape (N, n), [rad or m].

    Returns:
        H[:, k, i, j] = ∂J[k, i]/∂q_j; shape (N, 6, n, n).
    """
    count = qs.shape[1]
    Hs = np.zeros((len(qs), 6, count, count))
    columns = np.empty((len(flat.prismatic), 6))
    for row in range(len(qs)):
        _columns(flat, qs[row], columns)
        H = Hs[row]
        for i in range(len(columns)):
            for j in range(len(columns)):
                weight = flat.multipliers[i] * flat.multipliers[j]
                a, b = flat.variables[i], flat.variables[j]
                w, v = columns[min(i, j), 3:], columns[max(i, j), :3]
                H[0, a, b] += weight * (w[1] * v[2] - w[2] * v[1])
                H[1, a, b] += weight * (w[2] * v[0] - w[0] * v[2])
                H[2, a, b] += weight * (w[0] * v[1] - w[1] * v[0])
                if j < i:
                    u = columns[i, 3:]
                    H[3, a, b] += weight * (w[1] * u[2] - w[2] * u[1])
                    H[4, a, b] += weight * (w[2] * u[0] - w[0] * u[2])
                    H[5, a, b] += weight * (w[0] * u[1] - w[1] * u[0])
    return Hs


@compiled
def _columns(flat: FlatChain, q: Array, columns: Array) -> _Frame:
    """The tip's frame at one configuration, and the Jacobian's column of each joint of the way, mimic ones apart.

    The column is (z_i × (p - o_i); z_i) of a revolute joint and (z_i; 0) of a prismatic one; z_i is the joint's
    axis, o_i a point on it, p the tip. `columns` (m, 6) is filled.
    """
    frame = _first(flat)
    for i in range(len(columns)):
        # The point on the axis waits in the linear part until the tip is known.
        columns[i, 0], columns[i, 1], columns[i, 2] = frame[9], frame[10], frame[11]
        columns[i, 3], columns[i, 4], columns[i, 5] = frame[2], frame[5], frame[8]
        value = flat.multipliers[i] * q[flat.variables[i]] + flat.offsets[i]
        frame = _placed(_moved(frame, flat.prismatic[i], value), flat, i + 1)
    for i in range(len(columns)):
        z0, z1, z2 = columns[i, 3], columns[i, 4], columns[i, 5]
        if flat.prismatic[i]:
            columns[i, 0], columns[i, 1], columns[i, 2] = z0, z1, z2
            columns[i, 3], columns[i, 4], columns[i, 5] = 0.0, 0.0, 0.0
        else:
            d0, d1, d2 = frame[9] - columns[i, 0], frame[10] - columns[i, 1], frame[11] - columns[i, 2]
            columns[i, 0] = z1 * d2 - z2 * d1
            columns[i, 1] = z2 * d0 - z0 * d2
            columns[i, 2] = z0 * d1 - z1 * d0
    return frame


@compiled
def _first(flat: FlatChain) -> _Frame:
    """The placement before the first joint."""
    R, p = flat.rotations[0], flat.translations[0]
    return (R[0, 0], R[0, 1], R[0, 2], R[1, 0], R[1, 1], R[1, 2], R[2, 0], R[2, 1], R[2, 2], p[0], p[1], p[2])


@compiled
def _moved(frame: _Frame, prismatic: int, value: float) -> _Frame:
    """A frame slid along its own z by `value` [m], or turned about it by `value` [rad]."""
    r00, r01, r02, r10, r11, r12, r20, r21, r22, p0, p1, p2 = frame
    if prismatic:
        return (
            r00, r01, r02, r10, r11, r12, r20, r21, r22,
            p0 + value * r02, p1 + value * r12, p2 + value * r22,
        )  # fmt: skip
    c, s = math.cos(value), math.sin(value)
    return (
        c * r00 + s * r01, c * r01 - s * r00, r02,
        c * r10 + s * r11, c * r11 - s * r10, r12,
        c * r20 + s * r21, c * r21 - s * r20, r22,
        p0, p1, p2,
    )  # fmt: skip


@compiled
def _placed(frame: _Frame, flat: FlatChain, i: int) -> _Frame:
    """A frame followed by the constant placement i."""
    r00, r01, r02, r10, r11, r12, r20, r21, r22, p0, p1, p2 = frame
    A, t = flat.rotations[i], flat.translations[i]
    t0, t1, t2 = t[0], t[1], t[2]
    a00, a01, a02 = A[0, 0], A[0, 1], A[0, 2]
    a10, a11, a12 = A[1, 0], A[1, 1], A[1, 2]
    a20, a21, a22 = A[2, 0], A[2, 1], A[2, 2]
    return (
        r00 * a00 + r01 * a10 + r02 * a20, r00 * a01 + r01 * a11 + r02 * a21, r00 * a02 + r01 * a12 + r02 * a22,
        r10 * a00 + r11 * a10 + r12 * a20, r10 * a01 + r11 * a11 + r12 * a21, r10 * a02 + r11 * a12 + r12 * a22,
        r20 * a00 + r21 * a10 + r22 * a20, r20 * a01 + r21 * a11 + r22 * a21, r20 * a02 + r21 * a12 + r22 * a22,
        p0 + r00 * t0 + r01 * t1 + r02 * t2, p1 + r10 * t0 + r11 * t1 + r12 * t2, p2 + r20 * t0 + r21 * t1 + r22 * t2,
    )  # fmt: skip


@compiled
def _store(frame: _Frame, position: Array, rotation: Array) -> None:
    """Write a frame into a row of the results."""
    for j in range(3):
        position[j] = frame[9 + j]
        for k in range(3):
            rotation[j, k] = frame[3 * j + k]
