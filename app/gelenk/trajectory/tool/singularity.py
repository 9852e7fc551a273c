"""Configurations clear of singularities, by Cholesky's factorisation of eight matrices at a time."""

import numpy as np

from gelenk.kinematics.simd.kernels import COLUMN, gather_rows, joint_columns, variable_columns
from gelenk.kinematics.simd.lanes import LANES, bits, lanes, load, max_lanes, min_lanes, sqrt_lanes, store
from gelenk.robot.arrays import Array, Flags
from gelenk.robot.chain import FlatChain
from gelenk.robot.compilation import compiled, unmanaged

_DIRECTIONS = 6
_TINY = 1e-300


@compiled
def regular(flat: FlatChain, qs: Array, least: float) -> Flags:
    """Flag configurations whose Jacobian's smallest singular value is at least `least`; shape (N,)."""
    count, n = qs.shape
    flags = np.empty(count, np.bool_)
    work, columns = np.empty(n * LANES), np.empty(COLUMN * len(flat.joints) * LANES)
    J, L = np.empty(COLUMN * n * LANES), np.empty(_DIRECTIONS * _DIRECTIONS * LANES)
    for first in range(0, count, LANES):
        gather_rows(qs, first, work)
        joint_columns(flat, work, columns)
        variable_columns(flat, columns, J)
        good = _is_definite(J, n, least, L)
        for lane in range(min(LANES, count - first)):
            flags[first + lane] = (good >> lane) & 1
    return flags


@unmanaged
def _is_definite(J: Array, n: int, least: float, L: Array) -> int:
    """Return bits of the lanes in which J Jᵀ - least² I has a Cholesky factor; `L` holds it, its diagonal inverse."""
    smallest = lanes(np.inf)
    for k in range(_DIRECTIONS):
        for m in range(k + 1):
            entry = lanes(-least * least if k == m else 0.0)
            for j in range(n):
                entry = entry + load(J, COLUMN * j + k) * load(J, COLUMN * j + m)
            for j in range(m):
                entry = entry - load(L, _DIRECTIONS * k + j) * load(L, _DIRECTIONS * m + j)
            if k == m:
                smallest = min_lanes(smallest, entry)
                store(L, (_DIRECTIONS + 1) * k, 1.0 / sqrt_lanes(max_lanes(entry, _TINY)))
            else:
                store(L, _DIRECTIONS * k + m, entry * load(L, (_DIRECTIONS + 1) * m))
    good: int = bits(smallest > 0.0)
    return good
