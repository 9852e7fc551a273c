"""Whether two outputs say the same: numbers up to rounding, which differs between processors, ids whatever they are."""

import json
import re
from typing import Any

_ROUNDING = 1e-12
_PRINTED = 2e-6
"""Of a table, which shows six digits."""
_ID = re.compile("[0-9a-f]{32}")
_NUMBER = re.compile(r"(?<![\w.])-?\d+(?:\.\d*)?(?:e[+-]?\d+)?(?![\w.])")


def agree(printed: str, said: str) -> bool:
    """Whether they do, be they JSON or text."""
    try:
        return _same(json.loads(printed), json.loads(said))
    except json.JSONDecodeError:
        return _same_text(printed, said)


def _same(one: Any, other: Any) -> bool:
    if isinstance(one, dict) and isinstance(other, dict):
        return list(one) == list(other) and all(_same(one[key], other[key]) for key in one)
    if isinstance(one, list) and isinstance(other, list):
        return len(one) == len(other) and all(_same(a, b) for a, b in zip(one, other, strict=True))
    if isinstance(one, float) and isinstance(other, float):
        return abs(one - other) < _ROUNDING
    if isinstance(one, str) and isinstance(other, str) and _ID.fullmatch(one) and _ID.fullmatch(other):
        return True
    return type(one) is type(other) and bool(one == other)


def _same_text(one: str, other: str) -> bool:
    words = [_NUMBER.sub("#", text).split() for text in (one, other)]
    numbers = [[float(number) for number in _NUMBER.findall(text)] for text in (one, other)]
    return words[0] == words[1] and all(abs(a - b) < _PRINTED for a, b in zip(*numbers, strict=True))
