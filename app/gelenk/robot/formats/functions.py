"""Functions that xacro's expressions may call: of Python, of `math`, and the methods of texts, dictionaries and lists.

None of them reaches an object's inside, and the work of each is bounded by the length of its arguments.
"""

import math
from collections.abc import Callable

from gelenk.errors import counted
from gelenk.robot.formats.sources import Fault
from gelenk.robot.formats.values import MAX_ITEMS, MAX_TEXT, Function, Value, gathered, sequence


def _replaced(text: str, old: str, new: str) -> str:
    if (len(text) + 1) * (len(new) + 1) > MAX_TEXT * 16:
        raise Fault("a text that replacing would make too long")
    return text.replace(old, new)


def _joined(between: str, parts: Value) -> str:
    words = sequence(parts)
    if len(between) * len(words) + sum(map(len, words)) > MAX_TEXT:
        raise Fault(f"a text of more than {MAX_TEXT} characters")
    return between.join(words)


METHODS: dict[type, dict[str, Callable[..., Value]]] = {
    str: {
        **{name: getattr(str, name) for name in ("lower", "upper", "strip", "lstrip", "rstrip", "split")},
        **{name: getattr(str, name) for name in ("startswith", "endswith", "find", "count", "isdigit")},
        "replace": _replaced,
        "join": _joined,
    },
    dict: {
        "get": dict.get,
        "keys": list,
        "values": lambda of: list(of.values()),
        "items": lambda of: list(of.items()),
    },
    list: {"index": list.index, "count": list.count},
    tuple: {"index": tuple.index, "count": tuple.count},
}
"""Of the values of a type, the methods that expressions may call."""


def _range(*ends: int) -> list[int]:
    found = range(*ends)
    if len(found) > MAX_ITEMS:
        raise Fault(f"a range of {counted(len(found), 'number')}; at most {MAX_ITEMS} are allowed")
    return list(found)


def _rounded(number: float, digits: int | None = None) -> float:
    if digits is not None and abs(digits) > 300:
        raise Fault("rounding to more than 300 digits")
    return round(number, digits)


def _map(function: Value, values: Value) -> list[Value]:
    if not isinstance(function, Function):
        raise Fault("map takes a function and a list")
    return gathered(map(function.call, sequence(values)))


def _of_lists(function: Callable[..., Value]) -> Callable[..., Value]:
    return lambda *lists: list(function(*map(sequence, lists)))


_UNBOUNDED = {"factorial", "comb", "perm", "prod", "nextafter", "ulp", "sumprod"}
MATH: dict[str, Value] = {
    name: Function(name, value) if callable(value) else value
    for name, value in vars(math).items()
    if not name.startswith("_") and name not in _UNBOUNDED
}
"""Functions and constants of `math` whose work is bounded by the length of their arguments."""
_PYTHON: dict[str, Callable[..., Value]] = {
    "len": len,
    "str": str,
    "float": float,
    "int": int,
    "bool": bool,
    "round": _rounded,
    "abs": abs,
    "sum": sum,
    "min": min,
    "max": max,
    "all": all,
    "any": any,
    "dict": dict,
    "range": _range,
    "map": _map,
    "list": lambda values=(): sequence(values),
    "tuple": lambda values=(): tuple(sequence(values)),
    "sorted": _of_lists(sorted),
    "reversed": _of_lists(reversed),
    "enumerate": _of_lists(enumerate),
    "zip": _of_lists(zip),
}
PYTHON: dict[str, Value] = {name: Function(name, call) for name, call in _PYTHON.items()}
"""Functions of Python that expressions may call; none of them reaches an object's inside."""
