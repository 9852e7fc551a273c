"""A request and its response so far: input of the checks and of the log."""

import re
import time
from dataclasses import dataclass, field, replace
from random import getrandbits

from starlette.requests import Request
from starlette.types import Scope as AsgiScope

from gelenk.contract.endpoint import Endpoint, Route, Scope
from gelenk.http.messages.payloads import wants_answer_later
from gelenk.operations.outcome import RequestCounts

_WELL_FORMED = re.compile(rb"[A-Za-z0-9_.-]{1,64}")


@dataclass(slots=True)
class RequestContext:
    """A request and its response so far.

    Attributes:
        headers: Headers of the request; of a repeated one, the last value.
        has_single_fields: Whether no header field is repeated.
        request_id: The caller's own if it is valid, else a new one.
        started, seconds: Start time, by `time.perf_counter`, and duration once it is over, [s].
        key: Name of the caller's key; "" without a valid one.
        answer_headers: Headers of the response besides those common to all.
        status: HTTP status of the response; 0 until it starts.
        counts: Batch size and verdicts for the metrics, if any.
    """

    scope: AsgiScope
    operation: Route
    robot: str | None
    headers: dict[bytes, bytes]
    has_single_fields: bool
    request_id: str
    started: float
    key: str = ""
    answer_headers: list[tuple[bytes, bytes]] = field(default_factory=list)
    status: int = 0
    was_let_in: bool = False
    seconds: float = 0.0
    counts: RequestCounts | None = None

    @classmethod
    def of(cls, scope: AsgiScope, operation: Route, robot: str | None) -> "RequestContext":
        """Build the context of a request that has just arrived, and put its id in the scope, for problems."""
        headers = dict(scope["headers"])
        given = headers.get(b"x-request-id")
        request_id = (
            given.decode("ascii") if given and _WELL_FORMED.fullmatch(given) else getrandbits(128).to_bytes(16).hex()
        )
        scope["request_id"] = request_id
        can_be_job = b"prefer" in headers and isinstance(operation, Endpoint) and operation.job
        if can_be_job and wants_answer_later(scope["headers"]):
            operation = replace(operation, scope=Scope.WRITE)  # a job is stored
        are_single = len(headers) == len(scope["headers"])
        return cls(scope, operation, robot, headers, are_single, request_id, time.perf_counter())

    def values(self, name: bytes) -> list[bytes]:
        """Return all values of a header field."""
        if self.has_single_fields:
            return [self.headers[name]] if name in self.headers else []
        return [value for each, value in self.scope["headers"] if each == name]

    @property
    def request(self) -> Request:
        """The request, for building a problem response."""
        return Request(self.scope)

    @property
    def is_audited(self) -> bool:
        """Whether it belongs in the audit log: it writes, and was allowed or has a valid key."""
        return self.operation.scope is Scope.WRITE and (self.was_let_in or self.key != "")

    @property
    def is_safe(self) -> bool:
        """Whether its method changes nothing."""
        return self.scope["method"] in {"GET", "HEAD", "OPTIONS"}

    @property
    def client(self) -> str:
        """Address of the client."""
        client = self.scope.get("client")
        return client[0] if client else ""
