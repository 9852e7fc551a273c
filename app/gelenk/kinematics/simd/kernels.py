"""Compiled batches over the flat arrays of a chain; eight configurations at a time, without the GIL.

Each function walks the chain once: constant placement, then the joint about or along local z. The eight configurations
lie side by side in vector registers (`lanes`), for any number and type of joints; the last group of a batch is padded
with its last row. Nothing here uses Pinocchio, so each is an independent check of the other.
"""

from typing import TypeAlias

import numpy as np

from gelenk.kinematics.simd.lanes import LANES, Lanes, floor_lanes, lanes, load, rint_lanes, sqrt_lanes, store, where
from gelenk.robot.arrays import Array, Indices
from gelenk.robot.chain import FlatChain
from gelenk.robot.compilation import compiled, inlined, unmanaged

Frame: TypeAlias = tuple[Lanes, Lanes, Lanes, Lanes, Lanes, Lanes, Lanes, Lanes, Lanes, Lanes, Lanes, Lanes]
"""Eight poses in registers: rotation row by row, then position."""

COLUMN = 6
"""Rows of the work array per column of the Jacobian."""


@compiled
def chain_poses(flat: FlatChain, qs: Array) -> tuple[Array, Array]:
    """Compute T_base_tip at configurations (N, n): positions, shape (N, 3), [m], and rotations, shape (N, 3, 3)."""
    positions, rotations = np.empty((len(qs), 3)), np.empty((len(qs), 3, 3))
    work, pose = np.empty(max(qs.shape[1], 1) * LANES), np.empty(12 * LANES)
    for first in range(0, len(qs), LANES):
        gather_rows(qs, first, work)
        frame = first_frame(flat)
        for i in range(len(flat.joints)):
            value = flat.drives[i, 0] * load(work, flat.joints[i, 1]) + flat.drives[i, 1]
            frame = placed(moved(frame, flat.joints[i, 0], value), flat, i + 1)
        store_frame(frame, pose)
        for lane in range(min(LANES, len(qs) - first)):
            _scatter_pose(pose, lane, positions[first + lane], rotations[first + lane])
    return positions, rotations


@compiled
def chain_jacobians(flat: FlatChain, qs: Array) -> tuple[Array, Array, Array]:
    """Compute T_base_tip and the geometric Jacobian, in the base frame and at the tip, one column per variable.

    Of configurations (N, n), return positions (N, 3) [m], rotations (N, 3, 3) and Jacobians (N, 6, n), linear before
    angular.
    """
    count, n = qs.shape
    positions, rotations, Js = np.empty((count, 3)), np.empty((count, 3, 3)), np.empty((count, 6, n))
    work, pose = np.empty(max(n, 1) * LANES), np.empty(12 * LANES)
    columns, J = np.empty(COLUMN * len(flat.joints) * LANES), np.empty(COLUMN * n * LANES)
    for first in range(0, count, LANES):
        gather_rows(qs, first, work)
        store_frame(joint_columns(flat, work, columns), pose)
        variable_columns(flat, columns, J)
        for lane in range(min(LANES, count - first)):
            _scatter_pose(pose, lane, positions[first + lane], rotations[first + lane])
            rows = Js[first + lane]
            for k in range(6):
                for i in range(n):
                    rows[k, i] = J[(COLUMN * i + k) * LANES + lane]
    return positions, rotations, Js


@compiled
def chain_measures(flat: FlatChain, qs: Array, rows: Indices) -> tuple[Array, Array, Array]:
    """Compute T_base_tip and Yoshikawa's measure of some rows of the geometric Jacobian [Yoshikawa1985].

    The measure is the product of the singular values. Here it is computed as the product of the lengths that
    Gram-Schmidt orthogonalisation leaves of the rows (or of the columns, if fewer). Of configurations (N, n), return
    positions (N, 3) [m], rotations (N, 3, 3) and measures (N,).
    """
    count, n = qs.shape
    positions, rotations, measures = np.empty((count, 3)), np.empty((count, 3, 3)), np.empty(count)
    work, pose, measure = np.empty(max(n, 1) * LANES), np.empty(12 * LANES), np.empty(LANES)
    columns, J = np.empty(COLUMN * len(flat.joints) * LANES), np.empty(COLUMN * n * LANES)
    for first in range(0, count, LANES):
        gather_rows(qs, first, work)
        store_frame(joint_columns(flat, work, columns), pose)
        variable_columns(flat, columns, J)
        store(measure, 0, _measure(J, n, rows))
        for lane in range(min(LANES, count - first)):
            _scatter_pose(pose, lane, positions[first + lane], rotations[first + lane])
            measures[first + lane] = measure[lane]
    return positions, rotations, measures


@unmanaged
def _measure(J: Array, n: int, rows: Indices) -> Lanes:
    """Product of the lengths that Gram-Schmidt leaves of the rows (or columns, if fewer); overwrites those in `J`."""
    k = len(rows)
    few = n < k
    count, length = (n, k) if few else (k, n)
    product = lanes(1.0)
    for i in range(count):
        for j in range(i):
            shared, square = lanes(0.0), lanes(0.0)
            for m in range(length):
                a, b = _entry(J, rows, i, m, few), _entry(J, rows, j, m, few)
                shared, square = shared + a * b, square + b * b
            factor = where(square > 0.0, shared / where(square > 0.0, square, 1.0), 0.0)
            for m in range(length):
                left = _entry(J, rows, i, m, few) - factor * _entry(J, rows, j, m, few)
                store(J, _place(rows, i, m, few), left)
        square = lanes(0.0)
        for m in range(length):
            a = _entry(J, rows, i, m, few)
            square = square + a * a
        product = product * sqrt_lanes(square)
    return product


@inlined
def _place(rows: Indices, i: int, m: int, few: bool) -> int:
    """Row of lanes that holds entry m of the i-th row of J (of the i-th column if `few`)."""
    place: int = COLUMN * i + rows[m] if few else COLUMN * m + rows[i]
    return place


@inlined
def _entry(J: Array, rows: Indices, i: int, m: int, few: bool) -> Lanes:
    return load(J, _place(rows, i, m, few))


@compiled
def chain_hessians(flat: FlatChain, qs: Array) -> Array:
    """Compute H[:, k, i, j] = ∂J[k, i]/∂q_j of the geometric Jacobian in the base frame at the tip; shape (N, 6, n, n).

    With columns (v_i; w_i) in order from base to tip: ∂w_i/∂q_j = w_j × w_i for j before i, else 0;
    ∂v_i/∂q_j = w_j × v_i for j up to i, w_i × v_j for j after it [Hourtash2005].
    """
    count, n = qs.shape
    joints = len(flat.joints)
    Hs = np.zeros((count, 6, n, n))
    work, columns = np.empty(max(n, 1) * LANES), np.empty(COLUMN * joints * LANES)
    for first in range(0, count, LANES):
        gather_rows(qs, first, work)
        joint_columns(flat, work, columns)
        by_joint = columns.reshape((joints, COLUMN, LANES))
        for lane in range(min(LANES, count - first)):
            _add_hessian(flat, by_joint[:, :, lane], Hs[first + lane])
    return Hs


@compiled
def _add_hessian(flat: FlatChain, columns: Array, H: Array) -> None:
    """Add the derivatives of each joint's column by each joint to those of the variables; columns (m, 6)."""
    for i in range(len(columns)):
        for j in range(len(columns)):
            weight = flat.drives[i, 0] * flat.drives[j, 0]
            a, b = flat.joints[i, 1], flat.joints[j, 1]
            w, v = columns[min(i, j), 3:], columns[max(i, j), :3]
            H[0, a, b] += weight * (w[1] * v[2] - w[2] * v[1])
            H[1, a, b] += weight * (w[2] * v[0] - w[0] * v[2])
            H[2, a, b] += weight * (w[0] * v[1] - w[1] * v[0])
            if j < i:
                u = columns[i, 3:]
                H[3, a, b] += weight * (w[1] * u[2] - w[2] * u[1])
                H[4, a, b] += weight * (w[2] * u[0] - w[0] * u[2])
                H[5, a, b] += weight * (w[0] * u[1] - w[1] * u[0])


@inlined
def joint_columns(flat: FlatChain, work: Array, columns: Array) -> Frame:
    """Return the tip's frame, and fill in one Jacobian column per joint, mimic joints separately.

    The column is (z_i × (p - o_i); z_i) for a revolute joint and (z_i; 0) for a prismatic one; z_i is the joint's
    axis, o_i a point on it, p the tip. `work` holds a row of lanes per variable, `columns` `COLUMN` rows per joint.
    """
    frame = first_frame(flat)
    for i in range(len(flat.joints)):
        # The linear part holds the point on the axis until the tip is known.
        for k in range(3):
            store(columns, COLUMN * i + k, frame[9 + k])
            store(columns, COLUMN * i + 3 + k, frame[2 + 3 * k])
        value = flat.drives[i, 0] * load(work, flat.joints[i, 1]) + flat.drives[i, 1]
        frame = placed(moved(frame, flat.joints[i, 0], value), flat, i + 1)
    for i in range(len(flat.joints)):
        row = COLUMN * i
        z0, z1, z2 = load(columns, row + 3), load(columns, row + 4), load(columns, row + 5)
        if flat.joints[i, 0]:
            store(columns, row, z0)
            store(columns, row + 1, z1)
            store(columns, row + 2, z2)
            for k in range(3):
                store(columns, row + 3 + k, lanes(0.0))
        else:
            d0, d1, d2 = (
                frame[9] - load(columns, row), frame[10] - load(columns, row + 1), frame[11] - load(columns, row + 2)
            )  # fmt: skip
            store(columns, row, z1 * d2 - z2 * d1)
            store(columns, row + 1, z2 * d0 - z0 * d2)
            store(columns, row + 2, z0 * d1 - z1 * d0)
    return frame


@inlined
def variable_columns(flat: FlatChain, columns: Array, J: Array) -> None:
    """Sum the columns of the joints into those of their variables in `J`, `COLUMN` rows of lanes each."""
    J[:] = 0.0
    for i in range(len(flat.joints)):
        row = COLUMN * flat.joints[i, 1]
        for k in range(6):
            store(J, row + k, load(J, row + k) + flat.drives[i, 0] * load(columns, COLUMN * i + k))


@inlined
def gather_rows(qs: Array, first: int, work: Array) -> None:
    """Copy eight configurations from row `first` on into `work`: one row of lanes per variable."""
    last = len(qs) - 1
    for lane in range(LANES):
        row = min(first + lane, last)
        for i in range(qs.shape[1]):
            work[i * LANES + lane] = qs[row, i]


@inlined
def first_frame(flat: FlatChain) -> Frame:
    """Return the placement before the first joint."""
    A = flat.placements[0]
    return (
        lanes(A[0]), lanes(A[1]), lanes(A[2]), lanes(A[3]), lanes(A[4]), lanes(A[5]),
        lanes(A[6]), lanes(A[7]), lanes(A[8]), lanes(A[9]), lanes(A[10]), lanes(A[11]),
    )  # fmt: skip


@inlined
def moved(frame: Frame, prismatic: int, value: Lanes) -> Frame:
    """Translate a frame along its own z by `value` [m], or rotate it about z by `value` [rad]."""
    r00, r01, r02, r10, r11, r12, r20, r21, r22, p0, p1, p2 = frame
    if prismatic:
        return (
            r00, r01, r02, r10, r11, r12, r20, r21, r22,
            p0 + value * r02, p1 + value * r12, p2 + value * r22,
        )  # fmt: skip
    c, s = cosine_sine(value)
    return (
        c * r00 + s * r01, c * r01 - s * r00, r02,
        c * r10 + s * r11, c * r11 - s * r10, r12,
        c * r20 + s * r21, c * r21 - s * r20, r22,
        p0, p1, p2,
    )  # fmt: skip


@inlined
def placed(frame: Frame, flat: FlatChain, i: int) -> Frame:
    """Multiply a frame by the constant placement i."""
    r00, r01, r02, r10, r11, r12, r20, r21, r22, p0, p1, p2 = frame
    A = flat.placements[i]
    a00, a01, a02, a10, a11, a12, a20, a21, a22 = A[0], A[1], A[2], A[3], A[4], A[5], A[6], A[7], A[8]
    t0, t1, t2 = A[9], A[10], A[11]
    return (
        r00 * a00 + r01 * a10 + r02 * a20, r00 * a01 + r01 * a11 + r02 * a21, r00 * a02 + r01 * a12 + r02 * a22,
        r10 * a00 + r11 * a10 + r12 * a20, r10 * a01 + r11 * a11 + r12 * a21, r10 * a02 + r11 * a12 + r12 * a22,
        r20 * a00 + r21 * a10 + r22 * a20, r20 * a01 + r21 * a11 + r22 * a21, r20 * a02 + r21 * a12 + r22 * a22,
        p0 + r00 * t0 + r01 * t1 + r02 * t2, p1 + r10 * t0 + r11 * t1 + r12 * t2, p2 + r20 * t0 + r21 * t1 + r22 * t2,
    )  # fmt: skip


_TURNS = 0.6366197723675814
_QUARTER_1, _QUARTER_2, _QUARTER_3 = 1.5707962512969971, 7.549789415861596e-08, 5.390302858158119e-15
"""π/2 in three parts, the first two short enough that their products with an integer are exact [Cody1980]."""


@inlined
def cosine_sine(angle: Lanes) -> tuple[Lanes, Lanes]:
    """Compute cosine and sine by short polynomials on ±π/4, within 2e-16 + 1e-16 |angle| up to 1e6 rad.

    The coefficients are those of Moshier's Cephes library.
    """
    quarters = rint_lanes(angle * _TURNS)
    x = ((angle - quarters * _QUARTER_1) - quarters * _QUARTER_2) - quarters * _QUARTER_3
    y = x * x
    sine = x + x * y * (
        ((((1.58962301576546568060e-10 * y - 2.50507477628578072866e-8) * y + 2.75573136213857245213e-6) * y
           - 1.98412698295895385996e-4) * y + 8.33333333332211858878e-3) * y - 1.66666666666666307295e-1
    )  # fmt: skip
    cosine = 1.0 - 0.5 * y + y * y * (
        ((((-1.13585365213876817300e-11 * y + 2.08757008419747316778e-9) * y - 2.75573141792967388112e-7) * y
           + 2.48015872888517045348e-5) * y - 1.38888888888730564116e-3) * y + 4.16666666666665929218e-2
    )  # fmt: skip
    halves = floor_lanes(0.5 * quarters)
    odd = quarters - 2.0 * halves > 0.5
    sign = 1.0 - 2.0 * (halves - 2.0 * floor_lanes(0.5 * halves))
    return sign * where(odd, -sine, cosine), sign * where(odd, cosine, sine)


@inlined
def store_frame(frame: Frame, rows: Array) -> None:
    """Store a frame in twelve rows of lanes."""
    for k in range(12):
        store(rows, k, frame[k])


@inlined
def _scatter_pose(pose: Array, lane: int, position: Array, rotation: Array) -> None:
    for j in range(3):
        position[j] = pose[(9 + j) * LANES + lane]
        for k in range(3):
            rotation[j, k] = pose[(3 * j + k) * LANES + lane]
