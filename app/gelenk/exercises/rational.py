"""Rotations whose entries are fractions: R = (whole numbers) / divisor, exact in a text."""

import math
from typing import NamedTuple, TypeAlias

import numpy as np

from gelenk.exercises.draw import Draw
from gelenk.robot.arrays import Array

_Row: TypeAlias = tuple[int, int, int]


class RationalRotation(NamedTuple):
    """A rotation as whole numbers over a common divisor."""

    rows: tuple[_Row, _Row, _Row]
    divisor: int

    @property
    def matrix(self) -> Array:
        """The rotation; shape (3, 3)."""
        return np.array(self.rows) / self.divisor

    @property
    def text(self) -> str:
        """The matrix row by row, as in "1/3 (2, -1, 2; 2, 2, -1; -1, 2, 2)"."""
        rows = "; ".join(", ".join(map(str, row)) for row in self.rows)
        return f"1/{self.divisor} ({rows})"


def drawn_rotation(draw: Draw) -> RationalRotation:
    """Return the rotation of a quaternion of small whole numbers, none of them 0."""
    w, x, y, z = (draw.choice((-1, 1)) * draw.integer(1, 3) for _ in range(4))
    rows = (
        (w * w + x * x - y * y - z * z, 2 * (x * y - w * z), 2 * (x * z + w * y)),
        (2 * (x * y + w * z), w * w - x * x + y * y - z * z, 2 * (y * z - w * x)),
        (2 * (x * z - w * y), 2 * (y * z + w * x), w * w - x * x - y * y + z * z),
    )
    size = w * w + x * x + y * y + z * z
    common = math.gcd(size, *(entry for row in rows for entry in row))
    (a, b, c), (d, e, f), (g, h, i) = (tuple(entry // common for entry in row) for row in rows)
    return RationalRotation(((a, b, c), (d, e, f), (g, h, i)), size // common)
