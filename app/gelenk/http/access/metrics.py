"""Metrics for Prometheus: what the service does, by operation and robot, over all of its processes.

Where several processes serve, each writes its numbers to a file in a shared folder (the multiprocess mode of
prometheus_client, switched on by the variable PROMETHEUS_MULTIPROC_DIR before the import), and the process that is
scraped adds them up. Only a limited number of robots get labels of their own: clients choose the names.
"""

import asyncio
import contextlib
import os
import time
from bisect import bisect_left
from collections import Counter as Tally, defaultdict
from collections.abc import AsyncIterator, Callable, Iterator, Mapping, Sequence
from functools import cache
from pathlib import Path

from prometheus_client import CollectorRegistry, Counter, Gauge, Histogram, generate_latest
from prometheus_client.metrics_core import GaugeMetricFamily, Metric
from prometheus_client.multiprocess import MultiProcessCollector, mark_process_dead
from prometheus_client.registry import Collector

from gelenk.http.access.request_context import RequestContext
from gelenk.operations.outcome import RequestCounts
from gelenk.pool.pool import WorkerPool

FOLDER = "PROMETHEUS_MULTIPROC_DIR"
MOST_ROBOTS = 128
"""Maximum number of robots with their own label, in each process; the others share the label `other`."""
OTHER = "other"

_SECONDS = (0.0005, 0.001, 0.0025, 0.005, 0.01, 0.025, 0.05, 0.1, 0.25, 0.5, 1.0, 2.5, 5.0, 10.0, 30.0, 60.0)
_SIZES = (1, 10, 100, 1000, 10_000, 100_000, 1_000_000)
_PUBLISH_SECONDS = 1.0
_GATHERED = 64
"""Requests that are counted together: each writes to a dozen of numbers, which takes longer than adding up first."""
_LEFT = 499


class _Sum(Counter):
    def add(self, amounts: Sequence[float]) -> None:
        """Count several amounts at once."""
        self.inc(sum(amounts))


class _Spread(Histogram):
    def add(self, amounts: Sequence[float]) -> None:
        """Observe several amounts at once; `observe` writes two numbers for each."""
        self._sum.inc(sum(amounts))
        for place, count in Tally(bisect_left(self._upper_bounds, amount) for amount in amounts).items():
            self._buckets[place].inc(count)


class Metrics:
    """The metrics of this process, and of all processes together; `robots` have a label from the start."""

    def __init__(self, robots: Sequence[str], pool: WorkerPool, jobs: Callable[[], Mapping[str, int]]) -> None:
        self._registry = CollectorRegistry()
        self._robots, self._pool, self._jobs = set(robots[:MOST_ROBOTS]), pool, jobs
        self._in_flight = 0
        self._over: list[RequestContext] = []
        self._bound = cache(_labelled)
        self._told: dict[Counter, float] = {}
        by_robot = "operation", "robot"
        self._seconds = self._histogram("request_seconds", "From the request's head to the answer's end.", by_robot)
        self._batch = self._histogram("batch_size", "Configurations or targets in a call.", by_robot, _SIZES)
        self._answers = self._counter(
            "answers", "Answers by status; 499 where the client left.", ("operation", "status")
        )
        self._targets = self._counter("ik_targets", "Targets of inverse kinematics by verdict.", ("robot", "status"))
        self._solutions = self._counter("ik_solutions", "Solutions of inverse kinematics.", ("robot",))
        self._iterations = self._counter("ik_iterations", "Iterations that led to these solutions.", ("robot",))
        self._open = self._gauge("requests_in_flight", "Requests that are being answered.")
        self._resident = self._gauge("resident_bytes", "Memory of the worker processes.")
        self._cpu = self._counter("cpu_seconds", "Processor time of the worker processes.")
        self._size = self._gauge("crew_processes", "Processes for what may take long, at most.")
        self._busy = self._gauge("crew_busy", "Those at work.")
        self._waiting = self._gauge("queue_length", "Requests that wait for one of them.")
        self._restarts = self._counter(
            "crew_restarts", "Those replaced after a crash, a deadline or a caller who left."
        )
        self._refused = self._counter("refused", "Requests for which there was no room.")

    def begin(self) -> None:
        """Count a request that has arrived."""
        self._in_flight += 1

    def end(self, exchange: RequestContext) -> None:
        """Count a finished request; several are collected and counted together, which costs less."""
        self._in_flight -= 1
        self._over.append(exchange)
        if len(self._over) >= _GATHERED:
            self._settle()

    def _settle(self) -> None:
        alike: defaultdict[tuple[str, str | None, int], list[RequestContext]] = defaultdict(list)
        for exchange in self._over:
            alike[exchange.operation.id, exchange.robot, exchange.status].append(exchange)
        self._over.clear()
        for (operation, name, status), exchanges in alike.items():
            robot = self._label(name, status)
            self._bound(self._seconds, operation, robot).add([exchange.seconds for exchange in exchanges])
            self._bound(self._answers, operation, status or _LEFT).add([len(exchanges)])
            counts = [exchange.counts for exchange in exchanges if exchange.counts is not None]
            if batches := [each.batch for each in counts if each.batch]:
                self._bound(self._batch, operation, robot).add(batches)
            if solved := [each for each in counts if each.verdicts]:
                self._count_solutions(solved, robot)

    def _count_solutions(self, counts: Sequence[RequestCounts], robot: str) -> None:
        verdicts: Tally[str] = Tally()
        for each in counts:
            verdicts.update(each.verdicts)
        for verdict, count in verdicts.items():
            self._bound(self._targets, robot, verdict).add([count])
        self._bound(self._solutions, robot).add([each.solutions for each in counts])
        self._bound(self._iterations, robot).add([each.iterations for each in counts])

    def publish(self) -> None:
        """Publish the counts of finished and current requests, and the state of this process."""
        self._settle()
        self._open.set(self._in_flight)
        self._resident.set(_resident_bytes())
        self._size.set(self._pool.size)
        self._busy.set(self._pool.requests.busy)
        self._waiting.set(len(self._pool.requests.turns))
        self._raise_to(self._restarts, self._pool.requests.restarts)
        self._raise_to(self._refused, self._pool.refused)
        self._raise_to(self._cpu, time.process_time())

    def _raise_to(self, counter: Counter, total: float) -> None:
        counter.inc(total - self._told.get(counter, 0.0))
        self._told[counter] = total

    @contextlib.asynccontextmanager
    async def publishing(self) -> AsyncIterator[None]:
        """Publish every second: Prometheus may scrape another process."""

        async def go_on() -> None:
            while True:
                self.publish()
                await asyncio.sleep(_PUBLISH_SECONDS)

        task = asyncio.create_task(go_on())
        try:
            yield
        finally:
            task.cancel()

    def text(self) -> bytes:
        """Return the metrics of all processes in Prometheus' text format; takes milliseconds. Call `publish` first."""
        registry = self._registry
        if folder := os.environ.get(FOLDER):
            _forget_the_dead(Path(folder))
            registry = CollectorRegistry()
            registry.register(_Together(Path(folder)))
        jobs = CollectorRegistry()
        jobs.register(_Jobs(self._jobs()))
        return generate_latest(registry) + generate_latest(jobs)

    def _label(self, robot: str | None, status: int) -> str:
        """Return the label of a robot: its own once it has answered a request, as long as labels are left."""
        if robot is None or robot in self._robots:
            return robot or ""
        if 200 <= status < 300 and len(self._robots) < MOST_ROBOTS:
            self._robots.add(robot)
            return robot
        return OTHER

    def _histogram(self, name: str, what: str, labels: Sequence[str], buckets: Sequence[float] = _SECONDS) -> _Spread:
        return _Spread(f"gelenk_{name}", what, labels, buckets=buckets, registry=self._registry)

    def _counter(self, name: str, what: str, labels: Sequence[str] = ()) -> _Sum:
        return _Sum(f"gelenk_{name}", what, labels, registry=self._registry)

    def _gauge(self, name: str, what: str, labels: Sequence[str] = ()) -> Gauge:
        return Gauge(f"gelenk_{name}", what, labels, registry=self._registry, multiprocess_mode="livesum")


class _Together(Collector):
    """Collects the metrics of all processes; skips files that are still empty."""

    def __init__(self, folder: Path) -> None:
        self._folder = folder

    def collect(self) -> Iterator[Metric]:
        files = [str(path) for path in self._folder.glob("*.db") if _size(path)]
        yield from MultiProcessCollector.merge(files)


class _Jobs(Collector):
    """Collects the number of jobs by state, which every process knows."""

    def __init__(self, states: Mapping[str, int]) -> None:
        self._states = states

    def collect(self) -> Iterator[Metric]:
        family = GaugeMetricFamily("gelenk_jobs", "Jobs that are kept, by state.", labels=["state"])
        for state, count in sorted(self._states.items()):
            family.add_metric([state], count)
        yield family


def _labelled(metric: _Sum | _Spread, *labels: str | int) -> _Sum | _Spread:
    """Return a metric under its labels; there is a bounded number of them, so results can be cached."""
    return metric.labels(*labels)


def _forget_the_dead(folder: Path) -> None:
    """Drop the requests in progress of processes that have ended; keep their counts."""
    for pid in {file.stem.rpartition("_")[2] for file in folder.glob("gauge_live*.db")}:
        if not Path(f"/proc/{pid}").exists():
            with contextlib.suppress(FileNotFoundError):  # another process was quicker
                mark_process_dead(int(pid), str(folder))


def _size(path: Path) -> int:
    try:
        return path.stat().st_size
    except FileNotFoundError:
        return 0


def _resident_bytes() -> int:
    try:
        return int(Path("/proc/self/statm").read_text(encoding="ascii").split()[1]) * os.sysconf("SC_PAGE_SIZE")
    except OSError:
        return 0
