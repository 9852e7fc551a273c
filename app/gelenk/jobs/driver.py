"""The process that speaks to Ray, which nothing else does: which machines of a cluster compute, and parts sent to them.

Ray's head says for a minute that a machine is there which is not, and sends parts to one that hangs. So it is said here
where a part goes, and only where something was computed lately: whatever comes back is proof, and a machine of which
nothing comes gets a probe to compute, which takes no processor from a part.
"""

import hashlib
import math
import os
import pickle
import queue
import threading
import time
from collections import deque
from collections.abc import Callable
from concurrent.futures import Future
from contextlib import suppress
from dataclasses import dataclass, field
from functools import cache, partial
from multiprocessing.connection import Connection
from pathlib import Path
from typing import Any, TypeAlias

from gelenk.jobs.workers import ATTEMPTS, DIED

SIZE = -1
"""Instead of a part's number: how many processors compute by now. It is sent every second."""

_QUIET_SECONDS, _PROBE_SECONDS = 5.0, 12.0
"""After how long without news a machine is probed; and how long that may take, which may be to start a process, [s]."""
_LIST_SECONDS, _TELL_SECONDS = 5.0, 1.0
"""How often the machines are listed and checked, [s]."""

_ENVIRONMENT = {
    "RAY_USAGE_STATS_ENABLED": "0",
    "RAY_DISABLE_IMPORT_WARNING": "1",
    "RAY_ENABLE_UV_RUN_RUNTIME_ENV": "0",
    "RAY_ACCEL_ENV_VAR_OVERRIDE_ON_ZERO": "0",
}
"""Nothing is reported to anyone, and nothing is looked for."""

_Task: TypeAlias = tuple[Callable[[Any], Any], Any]


@dataclass(eq=False)
class _Machine:
    """A machine of the cluster.

    Attributes:
        processors: For parts.
        parts: Numbers of those that are there.
        heard: When something came back from it last, [s].
        is_asked: Whether a probe is under way.
        is_proven: Whether something came back since anything went wrong there: then it is sent parts.
    """

    processors: int
    parts: set[int] = field(default_factory=set)
    heard: float = -math.inf
    is_asked: bool = False
    is_proven: bool = False

    @property
    def is_lost(self) -> bool:
        """Whether it has been silent for so long that its parts should start elsewhere."""
        return time.monotonic() > self.heard + _QUIET_SECONDS + _PROBE_SECONDS

    def hear(self) -> None:
        """Note that something came back."""
        self.heard, self.is_proven = time.monotonic(), True


@dataclass(eq=False)
class _Part:
    """A requested part: what it is, how often its process has died, and where it runs."""

    task: _Task
    deaths: int = 0
    place: str = ""
    reference: Any = None


class Driver:
    """What the process that speaks to a cluster runs."""

    def __init__(self, address: str) -> None:
        self._address = address

    def __call__(self, connection: Connection) -> None:
        """Do parts until the other side is gone; first send why there are none, or how many processors there are."""
        _be_quiet()
        try:
            import ray  # noqa: PLC0415 - an extra, and half a second
            from ray.util.scheduling_strategies import NodeAffinitySchedulingStrategy  # noqa: PLC0415

            ray.init(self._address, configure_logging=False, log_to_driver=False, namespace="gelenk")
        except Exception as error:
            reason = (str(error).strip() or type(error).__name__).splitlines()[0]
            connection.send(f"the Ray cluster at {self._address} cannot be reached: {reason}")
            return
        with suppress(EOFError, OSError):
            _Dispatcher(ray, NodeAffinitySchedulingStrategy, connection).run()


class _Dispatcher:
    """Sends parts to machines and results back, all in one thread: where Ray hangs in that, the other side hears it."""

    def __init__(self, ray: Any, pinned: Any, connection: Connection) -> None:
        self._ray, self._pinned, self._connection, self._code = ray, pinned, connection, code_digest()
        self._compute = ray.remote(max_retries=0, num_cpus=1)(_computed)
        self._probe = ray.remote(max_retries=0, num_cpus=0)(_probed)
        self._events: queue.SimpleQueue[Callable[[], None]] = queue.SimpleQueue()
        self._machines: dict[str, _Machine] = {}
        self._parts: dict[int, _Part] = {}
        self._waiting: deque[int] = deque()
        self._began = self._told = time.monotonic()

    def run(self) -> None:
        """Until the other side is gone."""
        for target in (self._receive, self._list):
            threading.Thread(target=target, daemon=True).start()
        while True:
            with suppress(queue.Empty):
                self._events.get(timeout=_TELL_SECONDS)()
            if time.monotonic() > self._told + _TELL_SECONDS:
                self._look()
            self._place()

    def _receive(self) -> None:
        while True:
            try:
                number, task = pickle.loads(self._connection.recv_bytes())  # noqa: S301 - from the service
            except (OSError, EOFError):
                os._exit(0)
            self._events.put(partial(self._take, number, task))

    def _list(self) -> None:
        """Look which machines there are, which hangs where the head does."""
        while True:
            with suppress(Exception):
                listed = {
                    node["NodeID"]: processors
                    for node in self._ray.nodes()
                    if node["Alive"] and (processors := int(node["Resources"].get("CPU", 0)))
                }
                self._events.put(partial(self._know, listed))
            time.sleep(_LIST_SECONDS)

    def _know(self, listed: dict[str, int]) -> None:
        for name in self._machines.keys() - listed.keys():
            self._lose(self._machines.pop(name))
        for name in listed.keys() - self._machines.keys():
            self._machines[name] = _Machine(listed[name])
        self._look()

    def _look(self) -> None:
        """Ask machines that are not heard of, give up those that do not answer, and tell what there is."""
        self._told = now = time.monotonic()
        for name, machine in self._machines.items():
            if machine.is_lost:
                self._lose(machine)
            if not machine.is_asked and (not machine.is_proven or now > machine.heard + _QUIET_SECONDS):
                machine.is_asked = True
                self._begin(self._probe, name, partial(self._answered, machine))
        count = sum(machine.processors for machine in self._machines.values() if not machine.is_lost)
        if count == 0:
            self._parts.clear()  # the other side takes them as lost
            self._waiting.clear()
        if count or now > self._began + _PROBE_SECONDS:
            self._connection.send((SIZE, True, count))

    def _answered(self, machine: _Machine, _: Any, error: BaseException | None, __: Any) -> None:
        machine.is_asked = False
        if error is None:
            machine.hear()

    def _lose(self, machine: _Machine) -> None:
        """Take a machine's parts elsewhere."""
        machine.is_proven = False
        for number in machine.parts:
            self._again(number, self._parts[number])
        machine.parts.clear()

    def _again(self, number: int, part: _Part) -> None:
        self._ray.cancel(part.reference, force=True)
        part.reference = None
        self._waiting.append(number)

    def _take(self, number: int, task: _Task | None) -> None:
        """A part that is wanted, or no longer."""
        if task is not None:
            self._parts[number] = _Part(task)
            self._waiting.append(number)
        elif (part := self._parts.pop(number, None)) is not None and part.reference is not None:
            self._ray.cancel(part.reference, force=True)
            self._left(part.place, number)

    def _left(self, place: str, number: int) -> _Machine | None:
        machine = self._machines.get(place)
        if machine is not None:
            machine.parts.discard(number)
        return machine

    def _place(self) -> None:
        """Send parts to the machines that have the fewest for each processor."""
        proven = {name: machine for name, machine in self._machines.items() if machine.is_proven}
        while self._waiting and proven:
            number = self._waiting.popleft()
            if (part := self._parts.get(number)) is not None:
                part.place = min(proven, key=lambda name: len(proven[name].parts) / proven[name].processors)
                proven[part.place].parts.add(number)
                call = self._code, *part.task
                part.reference = self._begin(self._compute, part.place, partial(self._ended, number), *call)

    def _begin(self, function: Any, place: str, then: Callable[..., None], *call: Any) -> Any:
        """Run a function on a machine; the outcome becomes an event."""
        pinned = self._pinned(place, soft=False)
        reference = function.options(scheduling_strategy=pinned).remote(*call)

        def tell(future: "Future[Any]") -> None:
            error = future.exception()
            self._events.put(partial(then, reference, error, None if error else future.result()))

        reference.future().add_done_callback(tell)
        return reference

    def _ended(self, number: int, reference: Any, error: BaseException | None, result: Any) -> None:
        """Report the result of a part; if its process or machine failed, start it again."""
        part, lost = self._parts.get(number), self._ray.exceptions
        if part is None or part.reference is not reference:
            return
        machine = self._left(part.place, number)
        if isinstance(error, lost.RayError) and not isinstance(error, lost.RayTaskError):
            part.deaths += not isinstance(error, lost.TaskUnschedulableError)
            if machine is not None:
                machine.is_proven = False
            if part.deaths < ATTEMPTS:
                self._again(number, part)
                return
            error = ChildProcessError(DIED)
        elif machine is not None:
            machine.hear()
        if isinstance(error, lost.RayTaskError):
            error = error.cause if isinstance(error.cause, Exception) else ChildProcessError(str(error.cause))
        del self._parts[number]
        self._connection.send((number, error is None, result if error is None else error))


def _be_quiet() -> None:
    """Ray reports nothing to anyone, and its own lines do not go into the log, which is one of JSON."""
    os.environ.update(_ENVIRONMENT)
    nowhere = os.open(os.devnull, os.O_WRONLY)
    for stream in (1, 2):
        os.dup2(nowhere, stream)
    os.close(nowhere)


def _probed() -> None:
    """What a machine computes to show that it does."""


def _computed(code: str, function: Callable[[Any], Any], argument: Any) -> Any:
    """A part, on some machine of the cluster.

    Raises:
        ChildProcessError: Another release is installed there, which might compute something else.
    """
    if code != code_digest():
        raise ChildProcessError("a machine of the Ray cluster has another version of the service")
    return function(argument)


@cache
def code_digest() -> str:
    """What tells one release's code from another's."""
    digest, root = hashlib.blake2b(digest_size=16), Path(__file__).resolve().parent.parent
    for path in sorted(root.rglob("*.py")):
        digest.update(f"{path.relative_to(root)}\0".encode())
        digest.update(path.read_bytes())
    return digest.hexdigest()
