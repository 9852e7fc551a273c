"""Numbers as a reader takes them out of a formula of a worked solution."""

import re

import numpy as np
import numpy.typing as npt

Array = npt.NDArray[np.float64]

_MATRIX = re.compile(r"\\begin\{bmatrix\}(.*?)\\end\{bmatrix\}")
_VECTOR = re.compile(r"\(([^()]*,\\;[^()]*)\)")


def with_points(latex: str) -> str:
    """A German formula with the decimal marks and lists of an English one."""
    return latex.replace("{,}", ".").replace(r";\;", r",\;")


def value(text: str) -> float:
    """A number, perhaps with a power of ten."""
    mantissa, _, power = text.partition(r"\cdot 10^{")
    return float(mantissa) * 10.0 ** int(power.rstrip("} ") or 0)


def matrix(line: str) -> Array:
    """The last matrix of a formula."""
    rows = _MATRIX.findall(line)[-1].split(r"\\")
    return np.array([[value(entry) for entry in row.split("&")] for row in rows])


def vector(line: str) -> Array:
    """The last vector of a formula."""
    return np.array([value(entry) for entry in _VECTOR.findall(line)[-1].split(r",\;")])
