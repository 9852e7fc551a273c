"""Numbers to six digits; what is rounding beside the largest entry of a vector or matrix is written as 0."""

from collections.abc import Sequence

import numpy as np

from gelenk.course import writing
from gelenk.course.steps import tex
from gelenk.robot.arrays import Array

_DIGITS = 6
_ROUNDING = 1e-13


def number(value: float, unit: str = "") -> str:
    """Write a number to six digits."""
    return tex(float(value) + 0.0, unit, _DIGITS)


def row(values: Array | Sequence[float], beside: float = 0.0) -> str:
    """Write a vector as numbers in brackets; what is rounding `beside` a given size is 0 too."""
    return writing.vector(_clean(values, beside).tolist(), number)


def matrix(values: Array, beside: float = 0.0) -> str:
    """Write a matrix, or a vector as a column, likewise."""
    return writing.matrix(_clean(values, beside), number)


def summand(value: float) -> str:
    """Write a number behind a plus sign, in brackets if it is negative."""
    return number(value) if value >= 0.0 else f"({number(value)})"


def largest(*values: Array) -> float:
    """Return the largest magnitude in some arrays, 0 if there is none."""
    return max(float(np.abs(each).max(initial=0.0)) for each in values)


def _clean(values: Array | Sequence[float], beside: float) -> Array:
    numbers = np.asarray(values, dtype=np.float64)
    return np.where(np.abs(numbers) <= _ROUNDING * max(beside, largest(numbers)), 0.0, numbers)
