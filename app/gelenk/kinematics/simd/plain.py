"""The kernels as plain Python, for a process that computes a few numbers and ends.

Loading Numba, and with it the compiled kernels, takes half a second; this takes a millisecond a configuration. Numbers
differ by rounding: the compiler contracts a product and a sum into one operation. Lanes are arrays of eight numbers.
"""

import sys
import time
from collections.abc import Callable
from typing import Any, TypeVar

import numpy as np

from gelenk.robot.arrays import Array

_Function = TypeVar("_Function", bound=Callable[..., Any])
_COMPILATION, _LANES = "gelenk.robot.compilation", "gelenk.kinematics.simd.lanes"

LANES = 8
Lanes = Array
sqrt_lanes, rint_lanes, floor_lanes, abs_lanes, where = np.sqrt, np.rint, np.floor, np.abs, np.where


def run_kernels_as_python() -> None:
    """Let the kernels run as plain Python for the rest of this process, unless compiled ones are already loaded.

    Then only what `gelenk.kinematics` computes of poses and Jacobians can be computed in this process.
    """
    if _COMPILATION not in sys.modules:
        sys.modules |= dict.fromkeys((_COMPILATION, _LANES), sys.modules[__name__])


def compiled(function: _Function) -> _Function:
    """Return the function unchanged."""
    return function


inlined = unmanaged = compiled
clock = time.monotonic


def lanes(x: float) -> Lanes:
    """Return lanes that all hold the same number."""
    return np.full(LANES, x)


def load(array: Array, row: int) -> Lanes:
    """Load lanes from row `row` of a flat work array, LANES numbers per row."""
    return array[LANES * row : LANES * (row + 1)].copy()


def store(array: Array, row: int, value: Lanes) -> None:
    """Store lanes in row `row` of a flat work array."""
    array[LANES * row : LANES * (row + 1)] = value


def min_lanes(a: Lanes, b: Lanes) -> Lanes:
    """Return the minimum of two, lane by lane; the second value where one is NaN."""
    return where(a < b, a, b)


def max_lanes(a: Lanes, b: Lanes) -> Lanes:
    """Return the maximum of two, lane by lane; the second value where one is NaN."""
    return where(a > b, a, b)


def bits(mask: Array) -> int:
    """Return a mask as an integer, with lane 0 as the lowest bit."""
    return sum(1 << lane for lane in range(LANES) if mask[lane])
