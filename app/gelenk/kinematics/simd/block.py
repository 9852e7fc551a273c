"""Many small arrays in one piece of memory, for a compiled function that Python calls often.

Each array among its arguments takes 50 ns, and half a kilobyte of machine code, which other calls push out
of the processor's cache.
"""

from collections.abc import Sequence
from typing import Any

import numpy as np

from gelenk.robot.arrays import Array, Indices


class ArrayBlock:
    """Copies of arrays, one after the other.

    Attributes:
        numbers, integers: All of the memory, as floating-point numbers and as integers; the first integers say where
            the copies begin.
        views: The copies.
    """

    def __init__(self, arrays: Sequence[Array | Indices]) -> None:
        starts = np.cumsum([len(arrays), *(one.size for one in arrays)])
        parts = [np.ravel(one).view(np.float64) for one in (starts[:-1], *arrays)]
        self.numbers = np.concatenate(parts)
        self.integers = self.numbers.view(np.int64)
        self.views: list[Any] = [
            self.numbers[start : start + one.size].view(one.dtype).reshape(one.shape)
            for start, one in zip(starts, arrays, strict=False)
        ]
