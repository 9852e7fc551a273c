"""Optional OpenTelemetry: FastAPI's own spans, each with the id of its request.

Only the few names here are imported before tracing is switched on; the exporter is an optional extra.
"""

from collections.abc import Mapping
from dataclasses import dataclass

from fastapi.telemetry import TelemetryConfig
from starlette.types import ASGIApp, Receive, Scope, Send


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
