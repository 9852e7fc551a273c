"""Middleware that every request and every response passes through; optional OpenTelemetry, FastAPI's own spans.

Only a few names are imported before tracing is switched on; the exporter is an optional extra.
"""

import asyncio
import time
from collections.abc import Callable, Iterable, Mapping, Sequence
from dataclasses import dataclass
from functools import lru_cache
from typing import TypeAlias

from fastapi.telemetry import TelemetryConfig
from starlette.responses import Response
from starlette.types import ASGIApp, Message, Receive, Scope, Send

from gelenk.http.access.audit_log import AuditLog, log_request
from gelenk.http.access.metrics import Metrics
from gelenk.http.access.request_context import RequestContext
from gelenk.http.access.route_table import RouteTable
from gelenk.http.messages.routes import Application
from gelenk.logs import REQUEST_ID
from gelenk.operations.outcome import REQUEST_COUNTS

AccessRule: TypeAlias = Callable[[RequestContext], Response | None]
"""Checks a request; returns the refusal, or None to let the request pass."""

Headers: TypeAlias = list[tuple[bytes, bytes]]

COMMON: Headers = [
    (b"content-security-policy", b"default-src 'none'; base-uri 'none'; form-action 'none'; frame-ancestors 'none'"),
    (b"x-content-type-options", b"nosniff"),
    (b"referrer-policy", b"no-referrer"),
    (b"x-frame-options", b"DENY"),
    (b"cross-origin-resource-policy", b"same-origin"),
]
"""Headers of every response that does not set them itself: pages have their own policies."""


@dataclass(eq=False, slots=True)
class Middleware:
    """Passes requests through the checks, in order, to the application; completes the headers of responses.

    The first refusal counts; the metrics count refused requests too. `root_path` is the path prefix of a proxy.
    """

    app: Application
    directory: RouteTable
    root_path: str
    checks: Sequence[AccessRule]
    metrics: Metrics
    audit: AuditLog

    async def __call__(self, scope: Scope, receive: Receive, send: Send) -> None:
        """Serve a request or the lifespan events; refuse a WebSocket."""
        if scope["type"] == "lifespan":
            await self.app.answer(scope, receive, send)
            return
        if scope["type"] != "http":
            await send({"type": "websocket.close", "code": 1008})
            return
        path: str = scope["path"].removeprefix(self.root_path)
        if self.root_path and not path:
            path = "/"  # the prefix alone is the root
        exchange = RequestContext.of(scope, *self.directory.find(path, scope["method"]))
        REQUEST_ID.set(exchange.request_id)
        REQUEST_COUNTS.set(None)

        self.metrics.begin()
        try:
            response = self._refusal(exchange)
            if response is None:
                route = self.app.route_of(exchange.operation.id, exchange.robot, scope)
                if route is None:
                    await self.app.answer(scope, receive, self._completing(exchange, send))
                    return
                response = await route.response(scope, receive, send)
            if response is not None:
                response.raw_headers = self._headers(exchange, response.status_code, response.raw_headers)
                if exchange.is_audited:
                    await self._audit(exchange, response.raw_headers)
                await response(scope, receive, send)
        finally:
            if exchange.is_audited and not exchange.status:
                # The client has left, or the request failed: what it wrote may remain.
                await asyncio.shield(asyncio.to_thread(self.audit.write, exchange, None))
            exchange.seconds = time.perf_counter() - exchange.started
            exchange.counts = REQUEST_COUNTS.get()
            self.metrics.end(exchange)
            log_request(exchange)

    def _completing(self, exchange: RequestContext, send: Send) -> Send:
        """Return a `send` that completes the headers of a response that FastAPI makes."""

        async def completed(message: Message) -> None:
            if message["type"] == "http.response.start":
                headers = self._headers(exchange, message["status"], message.get("headers", ()))
                if exchange.is_audited:
                    await self._audit(exchange, headers)
                # Without a body: FastAPI's traces end with the message that brings it.
                message = {"type": message["type"], "status": message["status"], "headers": headers}
            await send(message)

        return completed

    def _headers(self, exchange: RequestContext, status: int, own: Iterable[tuple[bytes, bytes]]) -> Headers:
        """Note that a response starts, and return all its headers."""
        exchange.status = status
        headers = [*own, (b"x-request-id", exchange.request_id.encode()), *exchange.answer_headers]
        return headers + _lacking(tuple([name for name, _ in headers]))

    async def _audit(self, exchange: RequestContext, headers: Headers) -> None:
        location = dict(headers).get(b"location", b"").decode("latin-1") or None
        await asyncio.to_thread(self.audit.write, exchange, location)

    def _refusal(self, exchange: RequestContext) -> Response | None:
        for check in self.checks:
            if (refusal := check(exchange)) is not None:
                return refusal
        exchange.was_let_in = True
        return None


@lru_cache(256)
def _lacking(names: tuple[bytes, ...]) -> Headers:
    """Return the common headers that are not among `names`; responses have few sets of names."""
    return [header for header in COMMON if header[0] not in {name.lower() for name in names}]


def telemetry(is_wanted: bool) -> TelemetryConfig:
    """Return FastAPI's telemetry configuration: everything, sent where the environment says, or nothing."""
    return {"tracing": is_wanted, "metrics": is_wanted, "logs": is_wanted, "auto_configure": is_wanted}


def exporter_variables(endpoint: str, environment: Mapping[str, str]) -> dict[str, str]:
    """Return the standard variables that make the exporter send to `endpoint`; variables already set are left out."""
    wanted = {"OTEL_EXPORTER_OTLP_ENDPOINT": endpoint, "OTEL_SERVICE_NAME": "gelenk"}
    return {name: value for name, value in wanted.items() if name not in environment}


@dataclass(frozen=True, slots=True)
class TracedId:
    """Puts the id of each request on its span, so that a trace leads to the log and back."""

    app: ASGIApp

    async def __call__(self, scope: Scope, receive: Receive, send: Send) -> None:
        """Put the request id on the current span, and pass the request on."""
        from opentelemetry import trace  # noqa: PLC0415 - only where it is wanted

        if scope["type"] == "http":
            trace.get_current_span().set_attribute("gelenk.request_id", scope["request_id"])
        await self.app(scope, receive, send)
