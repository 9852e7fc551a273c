"""Random numbers that are the same for ever: from a name, with the one method of `random` whose stream is documented.

Numbers are round, so that a text states exactly what is computed with; entries of rotations are fractions.
"""

import math
import random
from collections.abc import Callable, Sequence
from typing import Annotated, Any, NamedTuple, TypeAlias, TypeVar, get_origin, get_type_hints

import numpy as np

from gelenk.robot.arrays import Array

T = TypeVar("T")
_DIGITS = 10


class Draw:
    """A stream of random numbers that depends on nothing but a name."""

    def __init__(self, name: str) -> None:
        self._next = random.Random(name).random  # noqa: S311 - nobody gains by guessing an exercise

    def integer(self, low: int, high: int) -> int:
        """Return a whole number between two others, which may be drawn too."""
        return low + int(self._next() * (high - low + 1))

    def decimal(self, low: float, high: float, step: float) -> float:
        """Return one of low, low + step, … high, as short a decimal number as these are."""
        return round(low + step * self.integer(0, round((high - low) / step)), _DIGITS)

    def signed(self, low: float, high: float, step: float) -> float:
        """Return a decimal number as `decimal` does, with either sign."""
        return self.choice((1.0, -1.0)) * self.decimal(low, high, step)

    def choice(self, options: Sequence[T]) -> T:
        """Return one of the options."""
        return options[self.integer(0, len(options) - 1)]

    def sample(self, options: Sequence[T], count: int) -> list[T]:
        """Return different options, in random order."""
        left = list(options)
        return [left.pop(self.integer(0, len(left) - 1)) for _ in range(count)]


def drawn(numbers: type[T], **other: tuple[Any, ...]) -> Callable[[Draw], T]:
    """Return what draws the fields of a class in their order: each by a method of Draw and its arguments.

    These are what follows the type in `Annotated`, or `other` by name; a field without them has its default.
    """
    hints = get_type_hints(numbers, include_extras=True)
    given = {name: hint.__metadata__ for name, hint in hints.items() if get_origin(hint) is Annotated} | other
    return lambda draw: numbers(**{name: method(draw, *within) for name, (method, *within) in given.items()})


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
