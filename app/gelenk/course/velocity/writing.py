"""Vectors and matrices in LaTeX, to six digits; what is rounding beside the largest entry is written as 0."""

from collections.abc import Iterable, Sequence

import numpy as np

from gelenk.course.steps import tex
from gelenk.robot.arrays import Array

_DIGITS = 6
_ROUNDING = 1e-13


def number(value: float, unit: str = "") -> str:
    """Write a number to six digits."""
    return tex(float(value) + 0.0, unit, _DIGITS)


def row(values: Array | Sequence[float], beside: float = 0.0) -> str:
    """Write a vector as numbers in brackets; what is rounding `beside` a given size is 0 too."""
    return "(" + r",\; ".join(map(number, _clean(values, beside).tolist())) + ")"


def matrix(values: Array, beside: float = 0.0) -> str:
    """Write a matrix likewise; one without rows or columns as 0."""
    lines = (" & ".join(map(number, line)) for line in _clean(values, beside).tolist())
    body = r" \\ ".join(lines)
    return rf"\begin{{bmatrix}} {body} \end{{bmatrix}}" if np.size(values) else "0"


def column(values: Array, beside: float = 0.0) -> str:
    """Write a vector as a column likewise."""
    return matrix(np.reshape(values, (-1, 1)), beside)


def summand(value: float) -> str:
    """Write a number behind a plus sign, in brackets if it is negative."""
    return number(value) if value >= 0.0 else f"({number(value)})"


def largest(*values: Array) -> float:
    """Return the largest magnitude in some arrays, 0 if there is none."""
    return max(float(np.abs(each).max(initial=0.0)) for each in values)


def table(head: Iterable[str], lines: Iterable[Iterable[str]]) -> str:
    """Write a table whose head stands above a line."""
    names = list(head)
    body = r" \\ ".join(" & ".join(line) for line in lines)
    return rf"\begin{{array}}{{{'r' * len(names)}}} {' & '.join(names)} \\ \hline {body} \end{{array}}"


def _clean(values: Array | Sequence[float], beside: float) -> Array:
    numbers = np.asarray(values, dtype=np.float64)
    return np.where(np.abs(numbers) <= _ROUNDING * max(beside, largest(numbers)), 0.0, numbers)
