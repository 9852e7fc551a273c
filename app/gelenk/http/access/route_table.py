"""Find the operation for a path and a method, with one regular expression.

It combines the expressions of the routes themselves, so that the operation that is checked is the one that runs.
"""

import re
from collections.abc import Iterable
from functools import lru_cache

from fastapi.routing import RouteContext

from gelenk.contract.endpoint import Route, Scope
from gelenk.contract.endpoints import ROUTES

OPEN_PATHS = frozenset(
    {"/", "/embed", "/studio", "/handbook", "/handbook/", "/docs", "/redoc", "/openapi.json"}
    | {"/documentation/bundles", "/documentation/own"}
)
"""Pages, their files and the schema: the same for everyone, and a browser sends no key for them."""
_MOST_REMEMBERED = 1024
_LONGEST_REMEMBERED = 128
_NAMED_GROUP = re.compile(r"\(\?P<(\w+)>")

UNKNOWN = Route(name="unknown", path="", tag="Service", summary="", scope=None)
"""A path or method that does not exist; where keys are on, any valid key may learn that."""


class RouteTable:
    """Table of the operations of an application."""

    def __init__(self, routes: Iterable[RouteContext]) -> None:
        self._operations: dict[str, dict[str, Route]] = {}
        for route in routes:
            methods = self._operations.setdefault(route.path_regex.pattern, {})
            operation = _operation(route)
            for method in route.methods or ("GET", "HEAD"):
                methods.setdefault(method, operation)
        self._methods = list(self._operations.values())
        self._pattern = re.compile("|".join(map(_numbered, range(len(self._methods)), self._operations)))
        self._remembered = lru_cache(_MOST_REMEMBERED)(self._found)

    def find(self, path: str, method: str) -> tuple[Route, str | None]:
        """Return the operation, and the name of the robot in the path, if any."""
        return (self._remembered if len(path) <= _LONGEST_REMEMBERED else self._found)(path, method)

    def _found(self, path: str, method: str) -> tuple[Route, str | None]:
        match = self._pattern.match(path)
        if match is None or match.lastgroup is None:
            return UNKNOWN, None
        number = match.lastgroup[1:]
        operation = self._methods[int(number)].get("GET" if method == "HEAD" else method, UNKNOWN)
        return operation, match.groupdict().get(f"robot{number}")


def _operation(route: RouteContext) -> Route:
    """Return the declaration of an operation; a page, which has none, needs a key unless it is one of `OPEN_PATHS`."""
    path = route.path or ""
    page = Route(name=path, path=path, tag="Service", summary="", scope=None if path in OPEN_PATHS else Scope.WRITE)
    return ROUTES.get(getattr(route, "operation_id", None) or "", page)


def _numbered(number: int, pattern: str) -> str:
    """Rewrite a route's expression as one of many: robot group `robot7`, whole match `_7`, other groups unnamed."""
    plain = _NAMED_GROUP.sub(lambda group: f"(?P<robot{number}>" if group[1] == "robot" else "(?:", pattern)
    return f"(?P<_{number}>{plain})"
