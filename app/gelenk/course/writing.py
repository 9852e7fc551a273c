"""Numbers, vectors and matrices in formulas, without what rounding leaves of a zero."""

import math
from collections.abc import Callable, Iterable
from typing import TypeAlias

import numpy as np

from gelenk.course.steps import bmatrix, tex
from gelenk.robot.arrays import Array

ROUNDING = 1e-12
"""Numbers below this count as zero, [rad, m, no unit]."""

Write: TypeAlias = Callable[[float], str]


def number(value: float) -> str:
    """Format a number; rounding errors are 0."""
    return tex(0.0 if abs(value) < ROUNDING else value)


def term(value: float) -> str:
    """Format a number with its sign, to be added to something; nothing if it is 0."""
    return "" if abs(value) < ROUNDING else f" {'-' if value < 0.0 else '+'} {tex(abs(value))}"


def rounded(value: float, decimals: int = 9) -> float:
    """Return a number with some decimals; never -0."""
    return round(float(value), decimals) + 0.0


def decimal(value: float) -> str:
    """Format a number that is known to nine decimals."""
    return tex(rounded(value))


def vector(values: Iterable[float], write: Write = number) -> str:
    """Format the coordinates of a vector, in brackets."""
    return "(" + r",\; ".join(map(write, values)) + ")"


def matrix(values: Array, write: Write = number) -> str:
    """Format rows of numbers, or a column; 0 if there are none."""
    return bmatrix(map(write, row) for row in values.reshape(len(values), -1).tolist()) if values.size else "0"


def theta(index: int) -> str:
    """Name the angle of a joint, counted from 0."""
    return rf"\vartheta_{{{index + 1}}}"


def atan2(y: str, x: str) -> str:
    """Write the arc tangent of a point's two coordinates."""
    return rf"\mathrm{{atan2}}({y},\; {x})"


def wrapped(angle: float) -> float:
    """Return the same angle in (-π, π]."""
    reduced = math.remainder(angle, 2.0 * math.pi)
    return math.pi if reduced <= -math.pi + ROUNDING else reduced


def difference(a: Array, b: Array, slides: Iterable[bool]) -> Array:
    """Return a - b by joint, without full turns of revolute joints; NaN stays where a joint is free."""
    gap = a - b
    turned = np.array([not slide for slide in slides])
    return np.where(turned, np.remainder(gap + np.pi, 2.0 * np.pi) - np.pi, gap)
