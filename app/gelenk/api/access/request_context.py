"""A request and its answer so far: input of the checks and of the log."""

import re
import time
from dataclasses import dataclass, field, replace
from random import getrandbits

from starlette.requests import Request
from starlette.types import Scope as AsgiScope

from gelenk.api.access.route_table import Operation
from gelenk.api.access.scopes import AS_JOBS, Scope
from gelenk.api.preference import wants_answer_later
from gelenk.operations.request_counts import RequestCounts

_WELL_FORMED = re.compile(rb"[A-Za-z0-9_.-]{1,64}")


@dataclass(slots=True)
class RequestContext:
    """A request and its answer.

    Attributes:
        scope: As the server has it.
        operation: The requested operation.
        robot: The robot that the path names.
        headers: Of the request; of a repeated one the last.
        request_id: The caller's own if it is valid, else a new one.
        started: On the monotonic clock, [s].
        key: Name of the key that allowed it; "" without a key.
        answer_headers: What its answer carries beside the headers that all have.
        status: Of the answer; 0 until there is one.
        was_let_in: Whether it has passed all checks.
        seconds: How long it took, once it is over.
        tally: What else is counted of it.
    """

    scope: AsgiScope
    operation: Operation
    robot: str | None
    headers: dict[bytes, bytes]
    request_id: str
    started: float
    key: str = ""
    answer_headers: list[tuple[bytes, bytes]] = field(default_factory=list)
    status: int = 0
    was_let_in: bool = False
    seconds: float = 0.0
    counts: RequestCounts | None = None

    @classmethod
    def of(cls, scope: AsgiScope, operation: Operation, robot: str | None) -> "RequestContext":
        """A request that has just come in; problems find its id in the scope."""
        headers = dict(scope["headers"])
        given = headers.get(b"x-request-id", b"")
        request_id = given.decode("ascii") if _WELL_FORMED.fullmatch(given) else f"{getrandbits(128):032x}"
        scope["request_id"] = request_id
        if b"prefer" in headers and operation.name in AS_JOBS and wants_answer_later(scope["headers"]):
            operation = replace(operation, scope=Scope.WRITE)
        return cls(scope, operation, robot, headers, request_id, time.perf_counter())

    @property
    def request(self) -> Request:
        """The request, for a problem that answers it."""
        return Request(self.scope)

    @property
    def is_audited(self) -> bool:
        """Whether it writes, and was allowed or has a known key."""
        return self.operation.scope is Scope.WRITE and (self.was_let_in or self.key != "")

    @property
    def is_safe(self) -> bool:
        """Whether its method changes nothing."""
        return self.scope["method"] in {"GET", "HEAD", "OPTIONS"}

    @property
    def client(self) -> str:
        """The address it came from."""
        client = self.scope.get("client")
        return client[0] if client else ""
