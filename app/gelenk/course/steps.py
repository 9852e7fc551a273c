"""A worked solution: formulas as the lecture writes them, each with the numbers put in."""

import math
from dataclasses import dataclass

_SHOWN_DIGITS = 10


@dataclass(frozen=True, slots=True)
class Step:
    """A section of a worked solution.

    Attributes:
        title: What is found here.
        text: Why so, in a sentence or two.
        latex: Formulas, each to stand on a line of its own.
    """

    title: str
    text: str
    latex: tuple[str, ...]


def tex(value: float) -> str:
    """A number for a formula, to ten digits, with a power of ten where it is very large or small."""
    mantissa, _, exponent = f"{value:.{_SHOWN_DIGITS}g}".partition("e")
    if not exponent:
        return mantissa
    return f"{mantissa} \\cdot 10^{{{int(exponent)}}}"


def tex_factor(value: float) -> str:
    """A number for a product: in brackets where it is negative."""
    return tex(value) if math.copysign(1.0, value) > 0 else f"({tex(value)})"
