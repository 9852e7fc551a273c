"""Endpoints about the service itself: health, readiness and metrics."""

import asyncio
import gc
import math
import threading
import time
from collections.abc import Callable
from http import HTTPStatus
from pathlib import Path

from fastapi import APIRouter, Request
from starlette.responses import Response

from gelenk.http.access.metrics import Metrics
from gelenk.http.messages.openapi import documentation
from gelenk.http.messages.payloads import JsonResponse
from gelenk.http.messages.problems import problem
from gelenk.kinematics.warm_up import quick
from gelenk.pool.pool import WorkerPool
from gelenk.robot.compilation import wait_for_others
from gelenk.store import folders

_LOOK_SECONDS = 1.0
"""How long a check of the disk stays valid, [s]."""


class Readiness:
    """Readiness of all that requests need: the kernels (compiled or from their cache), the pool, the disk.

    `jobs_failure` returns why jobs cannot run, or None; `failure` is why the kernels will never be ready, or None.
    """

    def __init__(self, pool: WorkerPool, data_dir: Path, jobs_failure: Callable[[], str | None]) -> None:
        self._pool, self._data_dir, self._jobs_failure = pool, data_dir, jobs_failure
        self._has_kernels = False
        self._looked = -math.inf
        self._storage: str | None = None
        self.failure: str | None = None

    async def missing(self) -> dict[str, str]:
        """Return what is not ready, each with the reason."""
        found = {}
        if not self._has_kernels:
            found["kernels"] = self.failure or "they are being compiled"
        if self._pool.requests.is_short:
            found["crew"] = "processes are being started"
        if no_jobs := self._jobs_failure():
            found["jobs"] = no_jobs
        if time.monotonic() > self._looked + _LOOK_SECONDS:
            self._looked = time.monotonic()
            self._storage = await asyncio.to_thread(folders.why_not, self._data_dir)
        if self._storage is not None:
            found["storage"] = f"the data folder cannot be written to: {self._storage}"
        return found

    def begin(self) -> None:
        """Prepare the kernels in a separate thread, so that the process answers meanwhile."""
        threading.Thread(target=self._prepare, name="warm-up", daemon=True).start()

    def _prepare(self) -> None:
        try:
            wait_for_others()
            quick()
            # What is loaded now stays: the garbage collector need not scan it repeatedly.
            gc.collect()
            gc.freeze()
            self._has_kernels = True
        except Exception as error:
            self.failure = f"{type(error).__name__}: {error}"
            raise


def service_router(readiness: Readiness, metrics: Metrics) -> APIRouter:
    """Return the router of health, readiness and metrics."""
    router = APIRouter()

    @router.api_route(**documentation("health"))
    async def health() -> Response:
        return JsonResponse({"status": "alive"})

    @router.api_route(**documentation("readiness"))
    async def ready(request: Request) -> Response:
        missing = await readiness.missing()
        if not missing:
            return JsonResponse({"status": "ready"})
        facts = {"waiting_for": list(missing), "reasons": missing, "failure": readiness.failure or missing.get("jobs")}
        sentences = "; ".join(f"{name}: {reason}" for name, reason in missing.items())
        response = problem(
            request, HTTPStatus.SERVICE_UNAVAILABLE, "not-ready", f"the service is not ready: {sentences}", facts
        )
        if readiness.failure is None:
            response.headers["Retry-After"] = "1"
        return response

    @router.api_route(**documentation("metrics"))
    async def tell_metrics() -> Response:
        metrics.publish()
        return Response(await asyncio.to_thread(metrics.text), media_type="text/plain; version=0.0.4; charset=utf-8")

    return router
