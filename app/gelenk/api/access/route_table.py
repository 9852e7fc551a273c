"""Which operation of the application a path and a method are, found with one regular expression.

It is made of the expressions that the routes themselves match with, so that what is checked is what is answered.
"""

import re
from collections.abc import Iterable
from dataclasses import dataclass
from functools import lru_cache

from fastapi.routing import RouteContext

from gelenk.api.access.scopes import Scope, scope_of

_MOST_REMEMBERED = 1024
_LONGEST_REMEMBERED = 128
_NAMED_GROUP = re.compile(r"\(\?P<(\w+)>")


@dataclass(frozen=True, slots=True)
class Operation:
    """A request to the service.

    Attributes:
        name: Its operation id; of a page its path.
        scope: What a key must be good for; None where none is needed.
    """

    name: str
    scope: Scope | None

    @property
    def is_open(self) -> bool:
        """Whether it needs no key at all."""
        return self.scope is None and self is not UNKNOWN


UNKNOWN = Operation("unknown", None)
"""A path or a method that there is not: where keys are on, any key may learn that."""


class RouteTable:
    """The operations of an application.

    Args:
        routes: All of its routes.
    """

    def __init__(self, routes: Iterable[RouteContext]) -> None:
        self._operations: dict[str, dict[str, Operation]] = {}
        for route in routes:
            methods = self._operations.setdefault(route.path_regex.pattern, {})
            operation = _operation(route)
            for method in route.methods or ("GET", "HEAD"):
                methods.setdefault(method, operation)
        self._methods = list(self._operations.values())
        self._pattern = re.compile("|".join(map(_numbered, range(len(self._methods)), self._operations)))
        self._remembered = lru_cache(_MOST_REMEMBERED)(self._found)

    def find(self, path: str, method: str) -> tuple[Operation, str | None]:
        """The operation, and the robot that the path names."""
        return (self._remembered if len(path) <= _LONGEST_REMEMBERED else self._found)(path, method)

    def _found(self, path: str, method: str) -> tuple[Operation, str | None]:
        match = self._pattern.match(path)
        if match is None or match.lastgroup is None:
            return UNKNOWN, None
        number = match.lastgroup[1:]
        operation = self._methods[int(number)].get("GET" if method == "HEAD" else method, UNKNOWN)
        return operation, match.groupdict().get(f"robot{number}")


def _operation(route: RouteContext) -> Operation:
    operation_id, tags = getattr(route, "operation_id", None), getattr(route, "tags", None)
    path, methods = route.path or "", frozenset(route.methods or ("GET",))
    return Operation(operation_id or path, scope_of(operation_id, path, methods, frozenset(tags or ())))


def _numbered(number: int, pattern: str) -> str:
    """A route's expression as one of many: its robot is `robot7`, the whole is `_7`, other groups have no name."""
    plain = _NAMED_GROUP.sub(lambda group: f"(?P<robot{number}>" if group[1] == "robot" else "(?:", pattern)
    return f"(?P<_{number}>{plain})"
