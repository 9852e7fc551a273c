"""Arrays in one piece of memory: in compiled code each is what it was, in its place."""

from typing import Any

import numpy as np
from numba import njit

from gelenk.kinematics.simd.block import ArrayBlock
from gelenk.kinematics.simd.lanes import part


@njit
def _doubled(numbers: Any, at: Any, n: int) -> float:
    matrix, counts, cube = part(numbers, at[0], (2, n)), part(at, at[2], (n,)), part(numbers, at[3], (1, 2, n))
    total = 0.0
    for i in range(2):
        for j in range(n):
            total += matrix[i, j] * counts[j]
            cube[0, i, j] = 2.0 * matrix[i, j]
    return total


def test_compiled_code_reads_and_writes_each_array() -> None:
    matrix, counts = np.arange(6.0).reshape(2, 3), np.array([1, 0, 2**60])
    block = ArrayBlock([matrix, np.empty((0, 2)), counts, np.zeros((1, 2, 3)), np.array([np.nan])])
    assert [view.shape for view in block.views] == [(2, 3), (0, 2), (3,), (1, 2, 3), (1,)]
    assert _doubled(block.numbers, block.integers, 3) == float((matrix * counts).sum())
    np.testing.assert_array_equal(block.views[3][0], 2.0 * matrix)
    np.testing.assert_array_equal(block.views[0], matrix)
    assert block.views[2].tolist() == counts.tolist()
    assert np.isnan(block.views[4][0])
    matrix[:] = 0.0
    assert block.views[0].any()
