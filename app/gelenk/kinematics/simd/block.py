"""Many small arrays in one piece of memory, for a compiled function that Python calls often.

Each array among its arguments takes 50 ns, and half a kilobyte of code that is not at hand if others ran meanwhile.
"""

from collections.abc import Sequence
from typing import Any

import numpy as np
from llvmlite import ir
from numba.core import cgutils, types
from numba.extending import intrinsic
from numba.np import arrayobj

from gelenk.robot.arrays import Array, Indices

_ITEM = 8
"""Size of a number, [bytes]."""
_ARRAYS: Any = arrayobj
_unpacked: Any = cgutils.unpack_tuple


class Block:
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


def _table(_: Any, memory: Any, start: Any, shape: Any) -> Any:
    kind = types.Array(memory.dtype, len(shape), "C")

    def emit(context: Any, builder: ir.IRBuilder, _: Any, arguments: Any) -> Any:
        whole, sizes = _ARRAYS.make_array(memory)(context, builder, arguments[0]), _unpacked(builder, arguments[2])
        steps = [context.get_constant(types.intp, _ITEM)]
        for size in reversed(sizes[1:]):
            steps.insert(0, builder.mul(steps[0], size))
        part = _ARRAYS.make_array(kind)(context, builder)
        _ARRAYS.populate_array(part, builder.gep(whole.data, [arguments[1]]), sizes, steps, steps[-1], None)
        return part._getvalue()

    return kind(memory, start, shape), emit


table: Any = intrinsic(_table)
"""`table(memory, start, shape)`: what begins at an index of a flat array; for compiled callers that hold the array."""
