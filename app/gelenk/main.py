"""The only place where the parts are wired together."""

import asyncio
import os
import sys
import threading
from collections.abc import AsyncIterator, Sequence
from concurrent.futures import ThreadPoolExecutor
from contextlib import asynccontextmanager

from fastapi import FastAPI
from fastapi.routing import iter_route_contexts

from gelenk import __version__
from gelenk.api import documentation, openapi, problems, studio
from gelenk.api.access.directory import Directory
from gelenk.api.access.door import Check, Door
from gelenk.api.access.hosts import TrustedHosts, repeated
from gelenk.api.access.journal import Audit
from gelenk.api.access.keyring import Keyring
from gelenk.api.access.keys import KeyCheck
from gelenk.api.access.metrics import Metrics
from gelenk.api.access.origins import Origins
from gelenk.api.access.tracing import TracedId, exporter_variables, telemetry
from gelenk.api.bodies import Bodies
from gelenk.api.compare import compare_route
from gelenk.api.course_components import component_routes
from gelenk.api.course_fly_over import fly_over_route
from gelenk.api.course_mobility import mobility_route
from gelenk.api.course_orientation import orientation_route
from gelenk.api.course_spline import spline_route
from gelenk.api.course_time_law import time_law_route
from gelenk.api.course_time_scaling import time_scaling_route
from gelenk.api.derive import derive_route
from gelenk.api.dh import dh_routes
from gelenk.api.jobs import jobs_router
from gelenk.api.operations import Setup
from gelenk.api.remote import Remote
from gelenk.api.robots import robots_router, upload_routes
from gelenk.api.routes import Application, Operation
from gelenk.api.service import Readiness, service_router
from gelenk.api.workspace import SampleLimits, workspace_route, workspace_work
from gelenk.crew.crew import Crew
from gelenk.jobs import workspace
from gelenk.jobs.cluster import Cluster
from gelenk.jobs.runner import Kind, Runner
from gelenk.jobs.shelf import Limits, Shelf
from gelenk.jobs.workers import Workers
from gelenk.settings import Settings
from gelenk.store.library import Quota

DESCRIPTION = """
Takes a URDF or a Denavit-Hartenberg table, converts each into the other, and computes forward and inverse kinematics,
velocities, forces, singularities, dynamics, trajectories and workspaces. Every answer is recomputed before it is sent
(a sample of a large batch). The course's calculators are here too.

Metres, radians, seconds. Twists and Jacobian rows are linear before angular. A pose `T_a_b` is the pose of b in a; a
quaternion's name gives its order. A call addresses a chain, `base_frame` → `tip_frame`; a configuration lists the
chain's joints from base to tip. Errors are `application/problem+json`.
"""

_SWITCH_SECONDS = 5e-4
"""The longest that a computing thread may keep the event loop waiting for the interpreter."""


def create_app(settings: Settings, crew: Crew | None = None) -> Application:
    """The application.

    Args:
        settings: What the operator has set.
        crew: The processes for long work; started by the application if left out.
    """
    most, seconds = settings.max_answer_numbers, settings.request_seconds
    quota = Quota(settings.client_robots, settings.client_robot_bytes)
    setup = Setup(settings.catalogue_dir, settings.data_dir / "robots", most, seconds, quota, settings.job_bytes)
    library = setup.library()
    crew = crew or Crew(settings.crew_processes, settings.crew_waiting, settings.crew_memory_bytes)
    remote = Remote(crew, setup, library, seconds, settings.client_requests)
    derivations = ThreadPoolExecutor(4, thread_name_prefix="derive")
    operations = setup.operations()
    runner = _runner(settings, operations)
    audit = Audit(settings.data_dir / "audit")
    metrics = Metrics(library.catalogue_names, crew, runner.shelf.states)
    readiness = Readiness(crew, settings.data_dir, lambda: runner.failure)

    @asynccontextmanager
    async def lifespan(_: FastAPI) -> AsyncIterator[None]:
        threading.Thread(target=library.prepare, name="sweep", daemon=True).start()
        runner.begin()
        starting = asyncio.create_task(_start(readiness, crew))
        async with metrics.publishing():
            yield
        starting.cancel()
        crew.close()
        runner.close()
        derivations.shutdown()
        audit.close()

    app = Application(
        settings.max_body_bytes,
        Bodies(max(settings.held_body_bytes, settings.max_body_bytes)),
        is_traced=bool(settings.otlp_endpoint),
        telemetry=telemetry(bool(settings.otlp_endpoint)),
        title="Gelenk",
        version=__version__,
        summary="Robot kinematics over HTTP, with every answer certified",
        description=DESCRIPTION,
        docs_url=None,
        redoc_url=None,
        redirect_slashes=False,
        lifespan=lifespan,
        openapi_tags=[
            {"name": "Robots", "description": "The catalogue and your own robots."},
            {"name": "DH tables", "description": "Denavit-Hartenberg tables: to and from URDF, compared, derived."},
            {"name": "Kinematics", "description": "Computations for a robot."},
            {"name": "Jobs", "description": "Long-running work: its progress and results."},
            {"name": "Course", "description": "The course's calculators, which store nothing."},
            {"name": "Service", "description": "About the service itself."},
        ],
    )
    app.root_path = settings.root_path
    app.state.crew = crew
    if settings.otlp_endpoint:
        app.add_middleware(TracedId)
    problems.install(app)
    size = settings.max_body_bytes
    app.include_router(robots_router(library, remote))
    app.router.routes.extend(upload_routes(remote, size))
    app.router.routes.extend(dh_routes(remote, size))
    app.router.routes.append(compare_route(remote, size))
    app.router.routes.append(derive_route(crew, derivations, size))
    app.router.routes.extend(component_routes(remote, size))
    for course_route in (
        *(fly_over_route, mobility_route, orientation_route),
        *(time_law_route, spline_route, time_scaling_route),
    ):
        app.router.routes.append(course_route(remote, size))
    for operation in operations:
        handler = operation.computation.handler(operation.name, remote, runner)
        app.operations[operation.name] = handler
        app.router.routes.append(operation.route(handler, size))
    samples = SampleLimits(settings.max_job_samples, most)
    app.router.routes.append(workspace_route(runner, remote, samples, size))
    app.include_router(jobs_router(runner))
    app.include_router(service_router(readiness, metrics))
    documentation.install(app)
    studio.install(app)
    queries = [operation.computation.options for operation in operations]
    openapi.describe(app, bool(settings.api_keys), [query for query in queries if query is not None])
    app.door = _door(app, settings, metrics, audit)
    return app


def _runner(settings: Settings, operations: Sequence[Operation]) -> Runner:
    """What does the jobs."""
    kept = Limits(
        kept=settings.kept_jobs,
        kept_bytes=settings.kept_job_bytes,
        unfinished=settings.unfinished_jobs,
        job_bytes=settings.job_bytes,
        kept_seconds=settings.kept_job_days * 24 * 3600.0,
    )
    kinds: dict[str, Kind] = {workspace.KIND: workspace_work}
    kinds |= {long.kind: long.work for operation in operations if (long := operation.computation.long) is not None}
    workers = Workers(settings.job_processes)
    shelf = Shelf(settings.data_dir / "jobs", kept)
    executor = Cluster(settings.ray_address) if settings.ray_address else workers
    is_local = settings.ray_lost == "local"
    return Runner(shelf, kinds, workers, settings.running_jobs, settings.job_seconds, executor, is_local)


def _door(app: Application, settings: Settings, metrics: Metrics, audit: Audit) -> Door:
    """The checks that a request must pass before the application answers it."""
    checks: list[Check] = [repeated, TrustedHosts(settings.trusted_hosts), Origins(settings.allowed_origins)]
    if settings.api_keys:
        checks.append(KeyCheck(Keyring(settings.api_keys)))
    directory = Directory(iter_route_contexts(app.routes))
    return Door(app.answer, directory, settings.root_path, checks, metrics, audit)


async def _start(readiness: Readiness, crew: Crew) -> None:
    """Get ready, the crew first: the process it is copied from compiles the kernels into the cache."""
    await crew.start()
    readiness.begin()


def from_environment() -> FastAPI:
    """The application configured by the environment; each worker process starts from it."""
    sys.setswitchinterval(_SWITCH_SECONDS)
    settings = Settings.from_environment(os.environ)
    if settings.otlp_endpoint:
        os.environ.update(exporter_variables(settings.otlp_endpoint, os.environ))
    return create_app(settings)
