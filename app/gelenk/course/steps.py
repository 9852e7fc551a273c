"""Worked solutions: formulas as the lecture writes them, with the numbers substituted."""

import math
from dataclasses import dataclass

_SHOWN_DIGITS = 10


@dataclass(frozen=True, slots=True)
class Step:
    """A section of a worked solution.

    Attributes:
        title: Name of the quantity or the stage of the solution.
        text: Explanation in a sentence or two.
        latex: Formulas, each for a line of its own.
    """

    title: str
    text: str
    latex: tuple[str, ...]


def tex(value: float) -> str:
    """Format a number for a formula, to ten digits, with a power of ten if it is very large or small."""
    mantissa, _, exponent = f"{value:.{_SHOWN_DIGITS}g}".partition("e")
    if not exponent:
        return mantissa
    return f"{mantissa} \\cdot 10^{{{int(exponent)}}}"


def tex_factor(value: float) -> str:
    """Format a number as a factor in a product, in brackets if it is negative."""
    return tex(value) if math.copysign(1.0, value) > 0 else f"({tex(value)})"
