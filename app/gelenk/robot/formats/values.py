"""Values of xacro's expressions and their bounds: no value grows beyond a size, and making one counts as steps."""

import re
from collections.abc import Callable, Iterable, Mapping
from dataclasses import dataclass
from typing import Any, Protocol, TypeAlias

from gelenk.errors import quoted
from gelenk.robot.formats.sources import Fault

MAX_STEPS = 1_000_000
"""Largest number of steps in one description: of expressions, elements and parameters."""
MAX_TEXT = 65_536
MAX_ITEMS = 10_000
"""Largest number of values in a list or dictionary, with those inside of it."""
MAX_CHARACTERS = 1_000_000
"""Largest number of characters of all texts in a value."""
MAX_BITS = 1024
"""Of an integer: what a double can hold."""

_HALF_PAIR = re.compile("[\ud800-\udfff]")

Value: TypeAlias = Any
"""None, a bool, int, float, text, list, tuple or dict of these; a function; or a `Namespace`."""


class Namespace(Protocol):
    """Names that an expression reaches by a dot."""

    def value(self, name: str) -> Value:
        """Return the value of a name; raises Fault if it is unknown."""


@dataclass(slots=True)
class Steps:
    """Counts the steps of an expansion."""

    left: int = MAX_STEPS

    def take(self, count: int = 1) -> None:
        """Count steps; raises Fault beyond the allowed number."""
        self.left -= count
        if self.left < 0:
            raise Fault(f"the expansion takes more than {MAX_STEPS} steps")


@dataclass(frozen=True, slots=True)
class Function:
    """A function that expressions may call; a call is as many steps as `cost`, and as its arguments are long."""

    name: str
    call: Callable[..., Value]
    cost: int = 1


@dataclass(frozen=True, slots=True)
class Names:
    """A namespace of fixed values."""

    values: Mapping[str, Value]

    def value(self, name: str) -> Value:
        """Return the value of a name; raises Fault if it is unknown."""
        if name not in self.values:
            raise Fault(f"there is no {quoted(name)}")
        return self.values[name]


def checked(value: Value, steps: Steps | None = None) -> Value:
    """Return a value within the bounds of this module; raises Fault for another one. Its size counts as steps."""
    count, characters = _measured(value)
    if steps is not None:
        steps.take(count - 1 + characters // 64)
    return value


def _measured(value: Value) -> tuple[int, int]:
    """Return the number of values in a value, with itself, and that of characters; raises Fault beyond the bounds."""
    waiting, count, characters = [value], 0, 0
    while waiting:
        part = waiting.pop()
        count += 1
        if isinstance(part, str):
            characters += len(part)
            _check_text(part)
        _check_size(count, characters)
        if isinstance(part, int) and part.bit_length() > MAX_BITS:
            raise Fault(f"a whole number of more than {MAX_BITS} bits")
        if isinstance(part, list | tuple):
            waiting += part
        elif isinstance(part, dict):
            waiting += part.keys()
            waiting += part.values()
        elif isinstance(part, complex):
            raise Fault("a complex number")
    return count, characters


def _check_text(text: str) -> None:
    if len(text) > MAX_TEXT:
        raise Fault(f"a text of more than {MAX_TEXT} characters")
    if not text.isascii() and _HALF_PAIR.search(text):
        raise Fault("half of a surrogate pair, which is no character")


def _check_size(count: int, characters: int) -> None:
    if count > MAX_ITEMS or characters > MAX_CHARACTERS:
        raise Fault(f"a value with more than {MAX_ITEMS} items or {MAX_CHARACTERS} characters")


def gathered(parts: Iterable[Value], steps: Steps | None = None) -> list[Value]:
    """Return values as a list; raises Fault as soon as it is too large, before the next one is made. Takes steps."""
    found: list[Value] = []
    count, characters = 1, 0
    for part in parts:
        more, longer = _measured(part)
        count, characters = count + more, characters + longer
        _check_size(count, characters)
        if steps is not None:
            steps.take(more + longer // 64)
        found.append(part)
    return found


def sequence(value: Value) -> list[Value]:
    """Return the items of a text, list or dictionary; raises Fault for another value."""
    if isinstance(value, str | list | tuple | dict):
        return list(value)
    raise Fault(f"a value of type {type(value).__name__} is not a list")
