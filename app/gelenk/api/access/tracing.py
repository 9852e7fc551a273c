"""Optional OpenTelemetry: FastAPI's own spans, each with the id of its request.

Nothing but the few names here is imported before tracing is switched on; the exporter is an extra of its own.
"""

from collections.abc import Mapping

from fastapi.telemetry import TelemetryConfig
from starlette.types import ASGIApp, Receive, Scope, Send


def telemetry(is_wanted: bool) -> TelemetryConfig:
    """Tracing hooks for FastAPI: everything, sent where the environment says, or nothing."""
    return {"tracing": is_wanted, "metrics": is_wanted, "logs": is_wanted, "auto_configure": is_wanted}


def exporter_variables(endpoint: str, environment: Mapping[str, str]) -> dict[str, str]:
    """The standard variables that make the exporter send to an endpoint; variables already set are kept."""
    wanted = {"OTEL_EXPORTER_OTLP_ENDPOINT": endpoint, "OTEL_SERVICE_NAME": "gelenk"}
    return {name: value for name, value in wanted.items() if name not in environment}


class TracedId:
    """Puts the id of a request on its span, so that a trace leads to the log and back.

    Args:
        app: What answers.
    """

    def __init__(self, app: ASGIApp) -> None:
        self._app = app

    async def __call__(self, scope: Scope, receive: Receive, send: Send) -> None:
        """Answer a request."""
        from opentelemetry import trace  # noqa: PLC0415 - only where it is wanted

        if scope["type"] == "http":
            trace.get_current_span().set_attribute("gelenk.request_id", scope["request_id"])
        await self._app(scope, receive, send)
