"""Worked solutions: formulas as the lecture writes them, with the numbers substituted."""

import math
import re
from collections.abc import Iterable
from dataclasses import dataclass

from gelenk.course.plain import plain
from gelenk.language import has_decimal_comma
from gelenk.robot.result import Result

_SHOWN_DIGITS = 10
_POINT = re.compile(r"(?<=\d)\.(?=\d)")


@dataclass(frozen=True, slots=True)
class Step(Result):
    """A section of the worked solution.

    Attributes:
        title: What the step computes.
        text: The step in a sentence or two.
        latex: Formulas, one per line.
        plain: The same formulas as plain text.
    """

    title: str
    text: str
    latex: tuple[str, ...]
    plain: tuple[str, ...]


def step(title: str, text: str, *latex: str) -> Step:
    """Return a step with any number of formulas, whose numbers get the decimal mark of the language."""
    latex = tuple(map(in_language, latex))
    return Step(title, text, latex, tuple(map(plain, latex)))


def in_language(latex: str) -> str:
    r"""Return a formula as the current language writes it: in German 0{,}25, and lists (a;\; b) instead of (a,\; b)."""
    if not has_decimal_comma():
        return latex
    return _POINT.sub("{,}", latex).replace(r",\;", r";\;")


def tex(value: float, unit: str = "", digits: int = _SHOWN_DIGITS) -> str:
    """Format a number, with a unit such as "kg m^2"; very large and small ones with a power of ten."""
    mantissa, _, exponent = f"{value:.{digits}g}".partition("e")
    number = rf"{mantissa} \cdot 10^{{{int(exponent)}}}" if exponent else mantissa
    return number + r"\,\mathrm{" + unit.replace(" ", r"\,") + "}" if unit else number


def tex_factor(value: float) -> str:
    """Format a number as a factor in a product, in brackets if it is negative."""
    return tex(value) if math.copysign(1.0, value) > 0 else f"({tex(value)})"


def bmatrix(rows: Iterable[Iterable[str]]) -> str:
    """Return a LaTeX `bmatrix` of entries that are already formulas."""
    return rf"\begin{{bmatrix}} {_lines(rows)} \end{{bmatrix}}"


def table(head: Iterable[str], rows: Iterable[Iterable[str]], columns: str) -> str:
    """Return a LaTeX `array` with a line below its head; `columns` such as `c|cc`."""
    return rf"\begin{{array}}{{{columns}}} {_lines([head])} \\ \hline {_lines(rows)} \end{{array}}"


def _lines(rows: Iterable[Iterable[str]]) -> str:
    """Return rows of cells; an empty one is `{}`, because some renderers drop a row that ends with nothing."""
    return r" \\ ".join(" & ".join(cell or "{}" for cell in row) for row in rows)
