"""Values as a reader sees them, and whether a value that a page states is the one that a call gives."""

import math
import re
from collections.abc import Iterator, Mapping, Sequence
from dataclasses import asdict
from decimal import Decimal
from typing import Any

import numpy as np
from pydantic import BaseModel

from gelenk.robot.result import Result

DIGITS = 5
_ROUNDING = 1e-12
"""Beside the largest number of a list, what is smaller by this factor is written as 0."""
_NUMBER = re.compile(r"(?<![\w.^])[-−+]?\d+(?:\.\d+)?(?:[eE][-+]?\d+)?")

_SIGNED = re.compile(r"-?\d+(?:\.\d+)?(?:e[-+]?\d+)?")
_PEAK = re.compile(r'("value":\s*([-+\d.e]+)),(?:\s*"joint":\s*"[^"]*",)?\s*"time":\s*[-+\d.e]+')
"""The largest of a quantity over a motion, as an answer has it."""


def written(value: Any, digits: int = DIGITS) -> str:
    """A value in lines of text: numbers to significant digits, matrices in columns, an answer by its fields.

    Args:
        value: A number, a text, a list, an array, an object, or an answer of the client.
        digits: Significant ones of each number.
    """
    return "\n".join(_lines(_plain(value), digits))


def in_line(value: Any, digits: int = DIGITS) -> str:
    """The same in one line."""
    match _plain(value):
        case dict() as fields:
            return f"{{{', '.join(f'{key}: {in_line(item, digits)}' for key, item in fields.items())}}}"
        case list() as items if any(isinstance(item, dict | list) for item in items):
            return f"[{', '.join(in_line(item, digits) for item in items)}]"
        case list() as items:
            return f"[{', '.join(_row(items, digits))}]"
        case leaf:
            return _leaf(leaf, digits)


def disagreement(stated: str, value: Any) -> str | None:
    """How what a page states differs from a value; None where it does not.

    Numbers in the text count by their written digits: 0.50 is any number from 0.495 to 0.505. Without a number the text
    must be that of the value. A list in either must have as many numbers as the other has.
    """
    plain = _plain(value)
    numbers = list(_numbers(plain))
    if not numbers or any(isinstance(leaf, str) for leaf in _leaves(plain)):
        found = written(plain)
        return None if found == stated else f"stated is {stated!r}, and the call gives {found!r}"
    tokens = [token.replace("−", "-") for token in _NUMBER.findall(stated)]
    if len(tokens) == len(numbers) and all(_is_rounded(*pair) for pair in zip(tokens, numbers, strict=True)):
        return None
    return f"stated is {stated!r}, and the call gives {written(plain, 12)}"


def same(committed: str, made: str, apart: float = 1e-9) -> bool:
    """Whether two texts have the same words, and the same numbers but for what differs between processors.

    Args:
        committed: The one.
        made: The other.
        apart: How far numbers may differ in any case, beside a thousandth of themselves.
    """
    one, other = (_PEAK.sub(lambda peak: _settled(peak, apart), text) for text in (committed, made))
    if _SIGNED.sub("#", one).split() != _SIGNED.sub("#", other).split():
        return False
    pairs = zip(_SIGNED.findall(one), _SIGNED.findall(other), strict=True)
    return all(math.isclose(float(a), float(b), rel_tol=1e-3, abs_tol=apart) for a, b in pairs)


def _settled(peak: re.Match[str], apart: float) -> str:
    """A peak without its joint and time if it is nothing but rounding, which is largest elsewhere on each processor."""
    return peak[1] if float(peak[2]) < apart else peak[0]


def _is_rounded(token: str, number: float) -> bool:
    """Whether a number rounds to what is written: half a unit of its last digit, and the rounding of that half."""
    unit = 10.0 ** int(Decimal(token).as_tuple().exponent)
    return abs(number - float(token)) <= 0.5 * unit * (1.0 + 1e-6)


def _plain(value: Any) -> Any:
    """As lists, mappings, numbers and texts."""
    match value:
        case BaseModel():
            return _plain(value.model_dump(exclude_unset=True, exclude_none=True))
        case Result():
            return _plain({name: item for name, item in asdict(value).items() if item is not None})  # type: ignore[call-overload]
        case np.ndarray() | np.generic():
            return _plain(value.tolist())
        case Mapping():
            return {str(key): _plain(item) for key, item in value.items()}
        case str():
            return value
        case Sequence():
            return [_plain(item) for item in value]
    return value


def _lines(value: Any, digits: int) -> Iterator[str]:
    match value:
        case dict():
            for key, item in value.items():
                yield from _labelled(f"{key}:", item, digits)
        case list() if _is_matrix(value):
            yield from _matrix(value, digits)
        case list() if all(not isinstance(item, dict | list) for item in value):
            yield f"[{', '.join(_row(value, digits))}]"
        case list():
            for item in value:
                yield from _labelled("-", item, digits)
        case _:
            yield _leaf(value, digits)


def _labelled(label: str, value: Any, digits: int) -> Iterator[str]:
    """A label, and on its line what has one line, else below it."""
    lines = list(_lines(value, digits))
    if len(lines) == 1 and not isinstance(value, dict) and not lines[0].startswith("- "):
        yield f"{label} {lines[0]}"
        return
    if label != "-":
        yield label
    elif lines:
        yield f"- {lines.pop(0)}"
    yield from (f"  {line}" for line in lines)


def _is_matrix(value: list[Any]) -> bool:
    rows = [row for row in value if isinstance(row, list) and row and all(_is_number(item) for item in row)]
    return len(value) > 1 and len(rows) == len(value) and len({len(row) for row in rows}) == 1


def _matrix(value: list[list[Any]], digits: int) -> Iterator[str]:
    largest = max(abs(number) for row in value for number in row)
    places = _places(largest, digits) if any(isinstance(number, float) for row in value for number in row) else 0
    cells = [["0" if _is_rounding(number, largest) else f"{number:z.{places}f}" for number in row] for row in value]
    widths = [max(len(cell) for cell in column) for column in zip(*cells, strict=True)]
    for row in cells:
        yield f"[{'  '.join(cell.rjust(width) for cell, width in zip(row, widths, strict=True))}]"


def _places(largest: float, digits: int) -> int:
    """Behind the point, so that the largest number has its digits and columns stand in line."""
    return max(0, digits - 1 - math.floor(math.log10(largest))) if largest > 0.0 else 0


def _row(value: list[Any], digits: int) -> Iterator[str]:
    largest = max((abs(item) for item in value if _is_number(item)), default=0.0)
    return (_number(item, digits, largest) if _is_number(item) else _leaf(item, digits) for item in value)


def _leaf(value: Any, digits: int) -> str:
    return _number(value, digits, 0.0) if _is_number(value) else str(value)


def _number(value: float, digits: int, largest: float) -> str:
    if isinstance(value, int):
        return str(value)
    return "0" if _is_rounding(value, largest) else f"{value:.{digits}g}"


def _is_rounding(value: float, largest: float) -> bool:
    return abs(value) <= _ROUNDING * largest


def _is_number(value: Any) -> bool:
    return isinstance(value, int | float) and not isinstance(value, bool)


def _leaves(value: Any) -> Iterator[Any]:
    if isinstance(value, dict):
        value = list(value.values())
    if isinstance(value, list):
        for item in value:
            yield from _leaves(item)
    else:
        yield value


def _numbers(value: Any) -> Iterator[float]:
    return (float(leaf) for leaf in _leaves(value) if _is_number(leaf))
