"""The only process that talks to Ray: it checks which machines of a cluster compute, and sends parts to them.

Ray's head lists a machine for a minute after it has failed, and sends parts to machines that hang. So this process
itself assigns each part, and only to machines that have computed something recently. Every result proves that; a
machine that sends no results gets a probe, a task that takes no processor from a part.
"""

import hashlib
import math
import os
import queue
import socket
import threading
import time
from collections import deque
from collections.abc import Callable
from concurrent.futures import Future
from contextlib import suppress
from dataclasses import dataclass, field
from functools import cache, partial
from pathlib import Path
from typing import Any, TypeAlias

from gelenk.jobs.workers import ATTEMPTS, DIED
from gelenk.processes import wire

SIZE = -1
"""Marks the message, sent every second, with the number of processors that compute now; no part has this number."""

_QUIET_SECONDS, _PROBE_SECONDS = 5.0, 12.0
"""Silence after which to probe a machine, and how long a probe may take, as it may have to start a process, [s]."""
_LIST_SECONDS, _REPORT_SECONDS = 5.0, 1.0
"""Interval at which to list the machines, and interval at which to check and report them, [s]."""

_ENVIRONMENT = {
    "RAY_USAGE_STATS_ENABLED": "0",
    "RAY_DISABLE_IMPORT_WARNING": "1",
    "RAY_ENABLE_UV_RUN_RUNTIME_ENV": "0",
    "RAY_ACCEL_ENV_VAR_OVERRIDE_ON_ZERO": "0",
}
"""Turns off Ray's usage reports and warnings, and its changes to the environment of its processes."""

_Task: TypeAlias = tuple[Callable[[Any], Any], Any]


@dataclass(eq=False)
class _Machine:
    """A machine of the cluster; it gets parts only while `is_proven`: it has answered since its last failure.

    `parts` are the numbers of those that it has not finished; `heard` is the time of its last answer, on the clock of
    `time.monotonic`, [s].
    """

    processors: int
    parts: set[int] = field(default_factory=set)
    heard: float = -math.inf
    is_being_probed: bool = False
    is_proven: bool = False

    @property
    def is_lost(self) -> bool:
        """Whether it has been silent for so long that its parts must move to other machines."""
        return time.monotonic() > self.heard + _QUIET_SECONDS + _PROBE_SECONDS

    def hear(self) -> None:
        self.heard, self.is_proven = time.monotonic(), True


@dataclass(eq=False)
class _QueuedPart:
    """A submitted part: its task, how often its process has died, its machine, and Ray's reference to its result."""

    task: _Task
    deaths: int = 0
    place: str = ""
    reference: Any = None


@dataclass(frozen=True, slots=True)
class Driver:
    """Main function of the process that talks to Ray; an instance can be pickled."""

    address: str

    def __call__(self, connection: socket.socket) -> None:
        """Send the number of processors, or why the cluster is unreachable; dispatch parts until the pipe closes."""
        _silence()
        try:
            import ray  # noqa: PLC0415 - optional, and slow to import
            from ray.util.scheduling_strategies import NodeAffinitySchedulingStrategy  # noqa: PLC0415

            ray.init(self.address, configure_logging=False, log_to_driver=False, namespace="gelenk")
        except Exception as error:
            reason = (str(error).strip() or type(error).__name__).splitlines()[0]
            wire.send(connection, f"the Ray cluster at {self.address} cannot be reached: {reason}")
            return
        with suppress(EOFError, OSError):
            _Dispatcher(ray, NodeAffinitySchedulingStrategy, connection).run()


class _Dispatcher:
    """Sends parts to machines and returns results, in one thread: if Ray hangs, the service notices the silence."""

    def __init__(self, ray: Any, pinned: Any, connection: socket.socket) -> None:
        self._ray, self._pinned, self._connection, self._code = ray, pinned, connection, code_digest()
        self._compute = ray.remote(max_retries=0, num_cpus=1)(_computed)
        self._probe = ray.remote(max_retries=0, num_cpus=0)(_probed)
        self._events: queue.SimpleQueue[Callable[[], None]] = queue.SimpleQueue()
        self._machines: dict[str, _Machine] = {}
        self._parts: dict[int, _QueuedPart] = {}
        self._waiting: deque[int] = deque()
        self._started = self._reported = time.monotonic()

    def run(self) -> None:
        for target in (self._receive, self._list):
            threading.Thread(target=target, daemon=True).start()
        while True:
            with suppress(queue.Empty):
                self._events.get(timeout=_REPORT_SECONDS)()
            if time.monotonic() > self._reported + _REPORT_SECONDS:
                self._check_machines()
            self._place()

    def _receive(self) -> None:
        while True:
            try:
                number, task = wire.receive(self._connection)
            except (OSError, EOFError):
                os._exit(0)
            self._events.put(partial(self._handle_message, number, task))

    def _list(self) -> None:
        """List the machines at regular intervals; this hangs if the cluster's head hangs."""
        while True:
            with suppress(Exception):
                listed = {
                    node["NodeID"]: processors
                    for node in self._ray.nodes()
                    if node["Alive"] and (processors := int(node["Resources"].get("CPU", 0)))
                }
                self._events.put(partial(self._update_machines, listed))
            time.sleep(_LIST_SECONDS)

    def _update_machines(self, listed: dict[str, int]) -> None:
        for name in self._machines.keys() - listed.keys():
            self._give_up(self._machines.pop(name))
        for name in listed.keys() - self._machines.keys():
            self._machines[name] = _Machine(listed[name])
        self._check_machines()

    def _check_machines(self) -> None:
        """Probe silent machines, requeue the parts of lost ones, and report the number of processors."""
        self._reported = now = time.monotonic()
        for name, machine in self._machines.items():
            if machine.is_lost:
                self._give_up(machine)
            if not machine.is_being_probed and (not machine.is_proven or now > machine.heard + _QUIET_SECONDS):
                machine.is_being_probed = True
                self._run_on(self._probe, name, partial(self._confirm, machine))
        count = sum(machine.processors for machine in self._machines.values() if not machine.is_lost)
        if count == 0:
            self._parts.clear()  # the service lets them fail
            self._waiting.clear()
        if count or now > self._started + _PROBE_SECONDS:
            wire.send(self._connection, (SIZE, True, count))

    def _confirm(self, machine: _Machine, _: Any, error: BaseException | None, __: Any) -> None:
        machine.is_being_probed = False
        if error is None:
            machine.hear()

    def _give_up(self, machine: _Machine) -> None:
        """Move the parts of a machine back to the queue, and send it no more until it answers."""
        machine.is_proven = False
        for number in machine.parts:
            self._requeue(number, self._parts[number])
        machine.parts.clear()

    def _requeue(self, number: int, part: _QueuedPart) -> None:
        self._ray.cancel(part.reference, force=True)
        part.reference = None
        self._waiting.append(number)

    def _handle_message(self, number: int, task: _Task | None) -> None:
        """Queue a part; if the task is None, cancel the part instead."""
        if task is not None:
            self._parts[number] = _QueuedPart(task)
            self._waiting.append(number)
        elif (part := self._parts.pop(number, None)) is not None and part.reference is not None:
            self._ray.cancel(part.reference, force=True)
            self._leave(part.place, number)

    def _leave(self, place: str, number: int) -> _Machine | None:
        machine = self._machines.get(place)
        if machine is not None:
            machine.parts.discard(number)
        return machine

    def _place(self) -> None:
        """Send each waiting part to the machine with the fewest parts per processor."""
        proven = {name: machine for name, machine in self._machines.items() if machine.is_proven}
        while self._waiting and proven:
            number = self._waiting.popleft()
            if (part := self._parts.get(number)) is not None:
                part.place = min(proven, key=lambda name: len(proven[name].parts) / proven[name].processors)
                proven[part.place].parts.add(number)
                call = self._code, *part.task
                part.reference = self._run_on(self._compute, part.place, partial(self._finish, number), *call)

    def _run_on(self, function: Any, place: str, then: Callable[..., None], *call: Any) -> Any:
        """Start a function on a machine; queue its outcome as an event that calls `then`."""
        pinned = self._pinned(place, soft=False)
        reference = function.options(scheduling_strategy=pinned).remote(*call)

        def report(future: "Future[Any]") -> None:
            error = future.exception()
            self._events.put(partial(then, reference, error, None if error else future.result()))

        reference.future().add_done_callback(report)
        return reference

    def _finish(self, number: int, reference: Any, error: BaseException | None, result: Any) -> None:
        """Send the result of a part; if its process or machine failed, queue it again, up to `ATTEMPTS` deaths."""
        part, lost = self._parts.get(number), self._ray.exceptions
        if part is None or part.reference is not reference:
            return
        machine = self._leave(part.place, number)
        if isinstance(error, lost.RayError) and not isinstance(error, lost.RayTaskError):
            part.deaths += not isinstance(error, lost.TaskUnschedulableError)
            if machine is not None:
                machine.is_proven = False
            if part.deaths < ATTEMPTS:
                self._requeue(number, part)
                return
            error = ChildProcessError(DIED)
        elif machine is not None:
            machine.hear()
        if isinstance(error, lost.RayTaskError):
            error = error.cause if isinstance(error.cause, Exception) else ChildProcessError(str(error.cause))
        del self._parts[number]
        wire.send(self._connection, (number, error is None, result if error is None else error))


def _silence() -> None:
    """Turn off Ray's usage reports, and its output, which would corrupt the service's JSON log."""
    os.environ.update(_ENVIRONMENT)
    nowhere = os.open(os.devnull, os.O_WRONLY)
    for stream in (1, 2):
        os.dup2(nowhere, stream)
    os.close(nowhere)


def _probed() -> None:
    """Do nothing: the answer alone proves that the machine computes."""


def _computed(code: str, function: Callable[[Any], Any], argument: Any) -> Any:
    """Compute a part on a machine of the cluster; ChildProcessError if that has another version of the service."""
    if code != code_digest():
        raise ChildProcessError("a machine of the Ray cluster has another version of the service")
    return function(argument)


@cache
def code_digest() -> str:
    """Return a digest of the package's source code, which differs between versions."""
    digest, root = hashlib.blake2b(digest_size=16), Path(__file__).resolve().parent.parent
    for path in sorted(root.rglob("*.py")):
        digest.update(f"{path.relative_to(root)}\0".encode())
        digest.update(path.read_bytes())
    return digest.hexdigest()
