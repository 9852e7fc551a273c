"""A job while it is done: its parts handed out, kept when they are finished, and never done twice."""

import time
from collections import deque
from collections.abc import Callable, Mapping
from concurrent.futures import Future
from concurrent.futures import TimeoutError as NotYet
from dataclasses import dataclass, field
from typing import IO, Any, Protocol, TypeAlias, TypeVar

from gelenk.errors import JobFailed, UnknownJob
from gelenk.jobs.job import JobRecord
from gelenk.jobs.parts import Parts, computed
from gelenk.jobs.store import JobStore
from gelenk.jobs.workers import Cancelled, Order, OutOfTime, Workers

_Argument = TypeVar("_Argument")
_Result = TypeVar("_Result")

_LOOK = 0.1
"""How often to check whether a job was cancelled, [s]."""
_WRITE = 0.3
"""How often to write how far a job is, [s]."""
_AHEAD = 2
"""Parts a process that are handed out at once: while one is computed the next one waits."""

Files: TypeAlias = Mapping[str, Callable[[IO[bytes]], object]]
"""What a job leaves behind: what writes each file, by its name."""


class Executor(Protocol):
    """Where parts are computed."""

    @property
    def count(self) -> int:
        """How many at once."""

    @property
    def failure(self) -> str | None:
        """Why none can be computed, where that is so."""

    def prepare(self) -> None:
        """Be ready for parts, if that is possible now."""

    def submit(self, function: Callable[[Any], Any], argument: Any, order: Order) -> "Future[Any]":
        """Compute a part; see `Workers.submit`. A cancelled part is not started, or is ended."""

    def close(self) -> None:
        """End whatever is under way; later parts are refused."""


@dataclass(eq=False)
class Run:
    """A job while it is done: hands out its parts, and says how far they are.

    Attributes:
        job: As it was when it was started.
        order: What its parts have in common.
        executor: Computes them.
        workers: The processes of this machine.
        store: Where the job is kept.
        parts: Those that are finished.
    """

    job: JobRecord
    order: Order
    executor: Executor
    workers: Workers
    store: JobStore
    parts: Parts
    _looked: float = field(default=0.0)
    _written: float = field(default=0.0)
    _progress: float = field(default=0.0)
    _is_further: bool = field(default=False)

    def map(
        self,
        stage: str,
        function: Callable[[_Argument], bytes],
        argument: Callable[[int], _Argument],
        count: int,
        span: tuple[float, float] = (0.0, 1.0),
        size: int = 1,
    ) -> None:
        """Compute the parts of a stage, all that are not kept already; `parts.of` has them then.

        Args:
            stage: The name of the stage; a job has each but once.
            function: Of a module, what computes a part; its result depends on the argument alone.
            argument: Of each part, by its number.
            count: How many parts there are.
            span: From where to where the job's progress goes meanwhile.
            size: What the stage is about comes so many a part; for the name of one that fails.

        Raises:
            Cancelled: The job is no longer wanted.
            OutOfTime: It has taken too long.
            TooLarge: The parts take more room than a job may.
            StorageFailed: A part cannot be kept.
            JobFailed: The processes that computed a part have died.
            Exception: Whatever the function raises.
        """
        waiting: deque[Future[bytes | int] | None] = deque()
        try:
            for k in range(count):
                while len(waiting) < _AHEAD * self.executor.count and k + len(waiting) < count:
                    number = k + len(waiting)
                    name = f"{stage}-{number}"
                    kept = self.parts.read(name) is not None
                    waiting.append(None if kept else self._submit(function, argument(number), name))
                if (part := waiting[0]) is not None:
                    try:
                        found: bytes | int = self._waited(part)
                    except ChildProcessError as error:
                        which = f"part {k + 1} of {count} ({stage} from {k * size:,} on)"
                        raise JobFailed(f"{which}: {error}") from error
                    self.parts.bytes += self.parts.write(f"{stage}-{k}", found) if isinstance(found, bytes) else found
                    self._is_further = True
                waiting.popleft()
                self.report(span[0] + (span[1] - span[0]) * (k + 1) / count)
        finally:
            for part in waiting:
                if part is not None:
                    part.cancel()

    def _submit(self, function: Callable[[_Argument], bytes], argument: _Argument, name: str) -> "Future[bytes | int]":
        """A part that is handed out: where the disk is at hand it is written there, and only its size comes back."""
        if self.executor is self.workers:
            return self.workers.submit(computed, (function, argument, self.parts, name), self.order)
        return self.executor.submit(function, argument, self.order)

    def apart(self, function: Callable[[_Argument], _Result], argument: _Argument) -> _Result:
        """What a function of a module makes of its argument, in a process of this machine.

        It has the disk, and it does not take turns with the event loop, as a thread of the service would.

        Raises:
            Cancelled: The job is no longer wanted.
            OutOfTime: It has taken too long.
            JobFailed: The process has died.
            Exception: Whatever the function raises.
        """
        future = self.workers.submit(function, argument, self.order)
        try:
            result: _Result = self._waited(future)
        except ChildProcessError as error:
            raise JobFailed(str(error)) from error
        return result

    def report(self, progress: float) -> None:
        """Say how far the job is, and look whether it is still wanted.

        Raises:
            Cancelled: It is not.
        """
        self._progress = max(self._progress, progress)
        if time.monotonic() > self._looked + _LOOK:
            self._look()

    def _waited(self, future: "Future[_Result]") -> _Result:
        while True:
            try:
                return future.result(timeout=_LOOK)
            except NotYet:
                self._look()

    def _look(self) -> None:
        self._looked = time.monotonic()
        try:
            job = self.store.change(self.job, **self._news())
        except UnknownJob:
            raise Cancelled from None
        if job.is_final:
            raise Cancelled
        if self._looked > self.order.until:
            raise OutOfTime

    def _news(self) -> dict[str, Any]:
        """What to write of the job, from time to time; once it gets further, the attempts before do not count."""
        if self._looked < self._written + _WRITE:
            return {}
        self._written = self._looked
        further = {"attempts": 1} if self._is_further else {}
        return {"progress": max(self._progress, self.job.progress), **further}
