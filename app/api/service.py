"""About the service itself: whether it lives, and whether it is ready."""

import asyncio
import gc
import threading
from collections.abc import Callable
from http import HTTPStatus

from fastapi import APIRouter, Request
from pydantic import BaseModel
from starlette.responses import PlainTextResponse, Response

from app.api.access.metrics import Metrics
from app.api.openapi import problem_responses
from app.api.payloads import json_response
from app.api.problems import problem
from app.kinematics.warm import warm_up


class Health(BaseModel):
    """The process lives."""

    status: str


class Readiness:
    """Whether requests are quick yet: the kernels are compiled, or read from their cache, and the crew is there."""

    def __init__(self) -> None:
        self.waiting_for: list[str] = ["kernels", "crew"]
        self.failure: str | None = None

    def begin(self) -> None:
        """Get ready in a thread of its own, so that the process answers meanwhile."""
        threading.Thread(target=self._prepare, name="warm-up", daemon=True).start()

    def _prepare(self) -> None:
        try:
            warm_up()
            # What stands now stays: the collector of garbage need not look through it again and again.
            gc.collect()
            gc.freeze()
            self.waiting_for.remove("kernels")
        except Exception as error:
            self.failure = f"{type(error).__name__}: {error}"
            raise


def service_router(readiness: Readiness, metrics: Metrics, jobs_failure: Callable[[], str | None]) -> APIRouter:
    """Health, readiness and metrics.

    Args:
        readiness: Of the kernels.
        metrics: What is told.
        jobs_failure: Why jobs cannot be done, where that is so.
    """
    router = APIRouter(tags=["Service"])

    @router.get("/healthz", operation_id="health", summary="Does the process live?", response_model=Health)
    async def health() -> Response:
        """Answers as long as the process does."""
        return json_response({"status": "alive"})

    @router.get(
        "/readyz",
        operation_id="readiness",
        summary="Is it ready for work?",
        response_model=Health,
        responses=problem_responses(503),
    )
    async def ready(request: Request) -> Response:
        """503 with `waiting_for`: `crew` and `kernels` until these are there, `jobs` while no cluster computes them.

        `failure` says what has gone wrong with them.
        """
        no_jobs = jobs_failure()
        if not readiness.waiting_for and no_jobs is None:
            return json_response({"status": "ready"})
        waiting_for = [*readiness.waiting_for, *(["jobs"] if no_jobs else [])]
        facts = {"waiting_for": waiting_for, "failure": readiness.failure or no_jobs}
        response = problem(
            request, HTTPStatus.SERVICE_UNAVAILABLE, "not-ready", "the service is still getting ready", facts
        )
        if readiness.failure is None:
            response.headers["Retry-After"] = "1"
        return response

    @router.get(
        "/metrics",
        operation_id="metrics",
        summary="What it does, in numbers",
        response_class=PlainTextResponse,
        responses={200: {"description": "Prometheus's text format"}},
    )
    async def tell_metrics() -> Response:
        """Latencies and batch sizes by operation and robot, verdicts and iterations of inverse kinematics, queues.

        Of all worker processes together, in the text format of Prometheus.
        """
        metrics.publish()
        return Response(await asyncio.to_thread(metrics.text), media_type="text/plain; version=0.0.4; charset=utf-8")

    return router
