"""Builds the application from its parts; the only place that knows them all."""

import asyncio
import os
import sys
import threading
from collections.abc import AsyncIterator
from contextlib import asynccontextmanager
from functools import partial

import orjson
from fastapi import FastAPI
from fastapi.routing import iter_route_contexts

from gelenk import __version__
from gelenk.contract.endpoints import ENDPOINTS
from gelenk.http import dispatch, pages
from gelenk.http.access.audit_log import AuditLog
from gelenk.http.access.keyring import Keyring
from gelenk.http.access.keys import KeyCheck
from gelenk.http.access.metrics import Metrics
from gelenk.http.access.middleware import AccessRule, Middleware, TracedId, exporter_variables, telemetry
from gelenk.http.access.origins import Origins, TrustedHosts, repeated
from gelenk.http.access.route_table import RouteTable
from gelenk.http.exercises import exercise_routes, exercises_router
from gelenk.http.jobs.jobs import jobs_router
from gelenk.http.jobs.long_works import LONG_WORK
from gelenk.http.messages import openapi, problems
from gelenk.http.messages.payloads import Bodies
from gelenk.http.messages.routes import Application
from gelenk.http.pictures import picture_route, pictures_router
from gelenk.http.robots.exports import export_routes
from gelenk.http.robots.pairs import pair_routes
from gelenk.http.robots.robots import documented_routes, robots_router
from gelenk.http.scenes import scene_routes, scenes_router
from gelenk.http.service import Readiness, service_router
from gelenk.http.sheets import sheet_routes
from gelenk.http.workers.pool_client import PARSED_HERE_BYTES, PoolClient
from gelenk.http.workers.task import Context
from gelenk.jobs.cluster import Cluster
from gelenk.jobs.limits import JobLimits
from gelenk.jobs.runner import Runner
from gelenk.jobs.store import JobStore
from gelenk.jobs.workers import PoolExecutor
from gelenk.operations.outcome import Limits
from gelenk.pool.pool import WorkerPool
from gelenk.processes.memory import keep_freed_memory
from gelenk.settings import Settings
from gelenk.store.library import Library
from gelenk.store.quota import Quota
from gelenk.store.scenes import Scenes

DESCRIPTION = """
Takes a URDF or a Denavit-Hartenberg table, converts each into the other, and computes forward and inverse kinematics,
velocities, forces, singularities, dynamics, trajectories and workspaces. Every answer is recomputed before it is sent
(a sample of a large batch). The course's calculators are here too.

Metres, radians, seconds. Twists and Jacobian rows are linear before angular. A pose `T_a_b` is the pose of b in a; a
quaternion's name gives its order. A call addresses a chain, `base_frame` → `tip_frame`; a configuration lists the
chain's joints from base to tip. Errors are `application/problem+json`.
"""

_SWITCH_SECONDS = 5e-4
"""Longest time that a computing thread may keep the event loop waiting for the interpreter, [s]."""


def create_app(settings: Settings, pool: WorkerPool | None = None) -> Application:
    """Build the application; unless it gets a worker pool, it creates one for long requests and parts of jobs."""
    seconds = settings.request_seconds
    quota = Quota("robot", settings.client_robots, settings.client_robot_bytes)
    limits = Limits(settings.max_answer_numbers, seconds, settings.job_bytes, settings.max_job_samples)
    scenes = Scenes(settings.data_dir / "scenes", Quota("scene", settings.client_scenes, settings.client_scene_bytes))
    context = Context(settings.catalogue_dir, settings.data_dir / "robots", limits, scenes, quota)
    library = Library(context.catalogue, context.uploads, quota)
    pool = pool or WorkerPool(
        settings.crew_processes, settings.crew_waiting, settings.crew_memory_bytes, settings.job_processes
    )
    pool_client = PoolClient(pool, context, library, seconds, settings.client_requests)
    runner = _runner(settings, limits, pool)
    audit = AuditLog(settings.data_dir / "audit")
    metrics = Metrics(library.catalogue_names, pool, runner.store.states)
    readiness = Readiness(pool, settings.data_dir, lambda: runner.failure)

    @asynccontextmanager
    async def lifespan(_: FastAPI) -> AsyncIterator[None]:
        for prepare in (library.prepare, scenes.prepare):
            threading.Thread(target=prepare, name="sweep", daemon=True).start()
        runner.workers.start()
        runner.start()
        starting = asyncio.create_task(_start(readiness, pool))
        async with metrics.publishing():
            yield
        starting.cancel()
        await asyncio.to_thread(runner.close)
        pool.close()
        audit.close()

    app = Application(
        Bodies(max(settings.held_body_bytes, settings.max_body_bytes)),
        is_traced=bool(settings.otlp_endpoint),
        telemetry=telemetry(bool(settings.otlp_endpoint)),
        title="Gelenk",
        version=__version__,
        summary="Robot kinematics over HTTP, with every answer certified",
        description=DESCRIPTION,
        openapi_url=None,
        docs_url=None,
        redoc_url=None,
        redirect_slashes=False,
        lifespan=lifespan,
        openapi_tags=[
            {"name": "Robots", "description": "The catalogue and your own robots."},
            {"name": "Scenes", "description": "What stands around a robot or hangs on it."},
            {"name": "DH tables", "description": "Denavit-Hartenberg tables: to and from URDF, compared, derived."},
            {"name": "Kinematics", "description": "Computations for a robot."},
            {"name": "Course", "description": "The course's calculators, which store nothing."},
            {"name": "Jobs", "description": "Long-running work: its progress and results."},
            {"name": "Service", "description": "About the service itself."},
        ],
    )
    app.root_path = settings.root_path
    app.state.pool = pool
    if settings.otlp_endpoint:
        app.add_middleware(TracedId)
    problems.install(app)
    size = settings.max_body_bytes
    app.include_router(robots_router(library, pool_client))
    for endpoint in ENDPOINTS:
        handler = dispatch.handler(endpoint, pool_client, runner, limits)
        most_body = min(size, PARSED_HERE_BYTES) if endpoint.is_job else size
        app.operations[endpoint.id] = dispatch.route(endpoint, handler, most_body)
    app.router.routes.extend(app.operations.values())
    app.router.routes.extend(
        [
            *documented_routes(pool_client, size),
            *export_routes(pool_client, size),
            *pair_routes(pool_client, size),
            *scene_routes(pool_client, size),
            picture_route(pool_client, size),
        ]
    )
    app.include_router(scenes_router(scenes))
    app.include_router(exercises_router())
    app.router.routes.extend(exercise_routes(pool_client, size))
    app.router.routes.extend(sheet_routes(pool_client, size, settings.course_secret, settings.data_dir))
    app.include_router(jobs_router(runner))
    app.include_router(pictures_router(pool_client))
    app.include_router(service_router(readiness, metrics))
    pages.install(app, settings.frame_ancestors)
    openapi.describe(app, bool(settings.api_keys))
    openapi.publish(app, lambda: pool.run(document, settings, seconds))
    app.entry = _middleware(app, settings, metrics, audit)
    return app


def document(settings: Settings) -> bytes:
    """Return the OpenAPI document of the service as JSON; a worker does, because that takes seconds."""
    return orjson.dumps(create_app(settings).openapi())


def _runner(settings: Settings, limits: Limits, pool: WorkerPool) -> Runner:
    kept = JobLimits(
        kept=settings.kept_jobs,
        kept_bytes=settings.kept_job_bytes,
        unfinished=settings.unfinished_jobs,
        job_bytes=settings.job_bytes,
        kept_seconds=settings.kept_job_days * 24 * 3600.0,
    )
    kinds = {name: partial(long.work, limits) for name, long in LONG_WORK.items()}
    store = JobStore(settings.data_dir / "jobs", kept)
    workers = PoolExecutor(pool)
    executor = Cluster(settings.ray_address) if settings.ray_address else workers
    is_local = settings.ray_lost == "local"
    return Runner(store, kinds, workers, settings.running_jobs, settings.job_seconds, executor, is_local)


def _middleware(app: Application, settings: Settings, metrics: Metrics, audit: AuditLog) -> Middleware:
    """Wrap the application in the checks that a request must pass."""
    checks: list[AccessRule] = [repeated, TrustedHosts(settings.trusted_hosts), Origins(settings.allowed_origins)]
    if settings.api_keys:
        checks.append(KeyCheck(Keyring(settings.api_keys)))
    directory = RouteTable(iter_route_contexts(app.routes))
    return Middleware(app, directory, settings.root_path, checks, metrics, audit)


async def _start(readiness: Readiness, pool: WorkerPool) -> None:
    """Start the pool, then prepare: the process that the pool is copied from compiles the kernels into the cache."""
    await pool.start()
    readiness.begin()


def from_environment() -> FastAPI:
    """Build the application as the environment configures it; each worker process starts from it."""
    sys.setswitchinterval(_SWITCH_SECONDS)
    keep_freed_memory()
    settings = Settings.from_environment(os.environ)
    if settings.otlp_endpoint:
        os.environ.update(exporter_variables(settings.otlp_endpoint, os.environ))
    return create_app(settings)
