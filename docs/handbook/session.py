"""The calls of the pages, run against the service in this very process while the handbook is built."""

import ast
import json
import shlex
import time
from contextlib import redirect_stdout
from dataclasses import dataclass
from functools import cache
from io import StringIO
from typing import Any, TypeVar
from urllib.parse import urlencode

import matplotlib.pyplot as plt
import numpy as np

from app.calls.call import JSON, Call
from app.calls.refusals import Refused
from app.cli.local import InProcess
from app.client import DEFAULT_URL, Client
from docs.handbook.written import DIGITS, in_line, written

T = TypeVar("T")

_SHOWN_BYTES = 2000
"""Of a request in a command; a larger one would be in a file."""

_READY_SECONDS = 900.0
"""How long kernels may take to compile, on a slow and busy machine."""


class Unexpected(Exception):
    """A call is not answered as its page says."""


class RecordingClient(Client):
    """The service, and what it was asked."""

    def __init__(self) -> None:
        super().__init__(transport=InProcess())
        self.calls: list[Call[Any]] = []

    def send(self, call: Call[T]) -> T:
        """The answer to a call."""
        self.calls.append(call)
        return super().send(call)

    def schema(self) -> Any:
        """The service's description of itself (OpenAPI)."""
        return super().send(Call("GET", "openapi.json", lambda reply: json.loads(reply.body)))


@cache
def service() -> RecordingClient:
    """The one service of a build, started when it is first needed, and ready."""
    client = RecordingClient()
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


def end_service() -> None:
    """Close it, if there is one."""
    if service.cache_info().currsize:
        service().close()
        service.cache_clear()


@dataclass(frozen=True, slots=True)
class Ran:
    """What a piece of a page has done.

    Attributes:
        output: What it printed, and its last value.
        calls: What it has asked.
    """

    output: str
    calls: tuple[Call[Any], ...]


class Session:
    """One page: its pieces run one after the other and share their names, as in one Python session.

    Args:
        client: Stands in the page as `gelenk`.
    """

    def __init__(self, client: RecordingClient) -> None:
        self._client = client
        self._names: dict[str, Any] = {"gelenk": client, "np": np, "pi": np.pi, "plt": plt, "print": self._print}
        self._digits = DIGITS

    def run(self, code: str, digits: int = DIGITS, refusal: str | None = None) -> Ran:
        """Run a piece.

        Args:
            code: Statements; the value of a last expression is written out.
            digits: Significant ones of the numbers that are written.
            refusal: The kind of problem that ends it, such as `unknown-frame`; None where there must be none.

        Raises:
            Unexpected: It is refused where it should not be, or not where it should, or fails.
        """
        self._client.calls.clear()
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
        return Ran(output.rstrip("\n"), tuple(self._client.calls))

    def value(self, expression: str) -> Any:
        """The value of an expression.

        Raises:
            Unexpected: It has none.
        """
        try:
            return eval(expression, self._names)  # noqa: S307 - the project's own pages
        except Exception as error:
            raise Unexpected(_told(error)) from error

    def recorded(self, code: str) -> tuple[Any, tuple[Call[Any], ...]]:
        """The last value of a piece, and what it has asked; raises as `value` does."""
        self._client.calls.clear()
        try:
            value = self._execute(code)
        except Exception as error:
            raise Unexpected(_told(error)) from error
        return value, tuple(self._client.calls)

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


def curl(call: Call[Any]) -> str:
    """The same call in a shell."""
    query = f"?{urlencode(call.query, doseq=True)}" if call.query else ""
    words = ["curl", "-s", f"{DEFAULT_URL}/{call.path}{query}"]
    if call.method not in {"GET", "POST"}:
        words[1:1] = ["-X", call.method]
    if call.accept != JSON:
        words += ["-H", f"Accept: {call.accept}"]
    if call.accept.startswith("image/"):
        words += ["-o", f"picture.{call.accept.removeprefix('image/').partition('+')[0]}"]
    words += [word for name, text in call.form.items() for word in ("-F", f"{name}={text}")]
    words += [word for name in call.files for word in ("-F", f"{name}=@FILE")]
    if call.body:
        words += ["-H", f"Content-Type: {call.media_type}", *_content(call)]
    return shlex.join(words)


def _content(call: Call[Any]) -> list[str]:
    if call.media_type != JSON:
        return ["--data-binary", "@array.npy"]
    return ["-d", call.body.decode() if len(call.body) <= _SHOWN_BYTES else "@request.json"]
