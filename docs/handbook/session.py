"""The calls of the pages, run against the service in this very process while the handbook is built."""

import ast
import json
import time
from contextlib import redirect_stdout
from functools import cache
from io import StringIO
from typing import Any, TypeVar

import httpx2
import matplotlib.pyplot as plt
import numpy as np

from docs.handbook.written import DIGITS, in_line, written
from gelenk.cli.local import InProcess
from gelenk.client import Client
from gelenk.client.call import Call
from gelenk.client.refusals import Refused

T = TypeVar("T")

_READY_SECONDS = 900.0
"""How long kernels may take to compile, on a slow and busy machine."""


class Unexpected(Exception):
    """A call is not answered as its page says."""


class Recorder(Client):
    """A client that remembers its calls, in `sent`."""

    def __init__(self, transport: httpx2.BaseTransport) -> None:
        super().__init__(transport=transport)
        self.sent: list[Call[Any]] = []

    def send(self, call: Call[T]) -> T:
        """Send a call and return its answer, as a client does."""
        self.sent.append(call)
        return super().send(call)


@cache
def service() -> Recorder:
    """The one service of a build, started when it is first needed, and ready."""
    client = Recorder(InProcess())
    wait_until_ready(client)
    return client


def wait_until_ready(client: Client) -> None:
    """Begin no call while kernels are compiled: that takes longer than the time limit of some calls.

    Raises:
        Refused: It does not get ready, for the reason told.
    """
    deadline = time.monotonic() + _READY_SECONDS
    while True:
        try:
            client.readiness()
            return
        except Refused as error:
            if error.kind != "not-ready" or error.problem["failure"] is not None or time.monotonic() > deadline:
                raise


def schema() -> Any:
    """The service's description of itself (OpenAPI)."""
    return service().send(Call("GET", "openapi.json", lambda response: json.loads(response.content)))


def end_service() -> None:
    """Close it, if there is one."""
    if service.cache_info().currsize:
        service().close()
        service.cache_clear()


class Session:
    """One page: its pieces run one after the other and share their names, as in one Python session.

    Args:
        client: Stands in the page as `gelenk`.
    """

    def __init__(self, client: Client) -> None:
        self._names: dict[str, Any] = {"gelenk": client, "np": np, "pi": np.pi, "plt": plt, "print": self._print}
        self._digits = DIGITS

    def run(self, code: str, digits: int = DIGITS, refusal: str | None = None) -> str:
        """Run a piece: what it prints, and its last value.

        Args:
            code: Statements; the value of a last expression is written out.
            digits: Significant ones of the numbers that are written.
            refusal: The kind of problem that ends it, such as `unknown-frame`; None where there must be none.

        Raises:
            Unexpected: It is refused where it should not be, or not where it should, or fails.
        """
        self._digits = digits
        printed = StringIO()
        try:
            with redirect_stdout(printed):
                value = self._execute(code)
        except Exception as error:
            if not isinstance(error, Refused) or error.kind != refusal:
                raise Unexpected(_told(error)) from error
            value, refusal = f"{type(error).__name__}: {error.detail}", None
        if refusal is not None:
            raise Unexpected(f"it is answered where {refusal} should refuse it")
        output = printed.getvalue() + ("" if value is None else written(value, digits))
        return output.rstrip("\n")

    def value(self, expression: str) -> Any:
        """The value of an expression.

        Raises:
            Unexpected: It has none.
        """
        try:
            return eval(expression, self._names)  # noqa: S307 - the project's own pages
        except Exception as error:
            raise Unexpected(_told(error)) from error

    def last(self, code: str) -> Any:
        """The last value of a piece; raises as `value` does."""
        try:
            return self._execute(code)
        except Exception as error:
            raise Unexpected(_told(error)) from error

    def _execute(self, code: str) -> Any:
        statements = ast.parse(code).body
        match statements:
            case [*before, ast.Expr(last)]:
                pass
            case before:
                last = ast.Constant(None)
        exec(compile(ast.Module(before, []), "page", "exec"), self._names)  # noqa: S102 - the project's own pages
        return eval(compile(ast.fix_missing_locations(ast.Expression(last)), "page", "eval"), self._names)  # noqa: S307

    def _print(self, *values: Any, **options: Any) -> None:
        """`print` with numbers as the page writes them."""
        print(*(in_line(value, self._digits) for value in values), **options)


def _told(error: Exception) -> str:
    """What has gone wrong, for whoever writes the page."""
    if isinstance(error, Refused):
        return f"the service refuses it, {error.kind}: {error.detail}"
    return f"{type(error).__name__}: {error}"
