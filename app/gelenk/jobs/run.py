"""A job while it runs: it hands out its parts, keeps the finished ones, and does not compute them again."""

import time
from collections import deque
from collections.abc import Callable, Mapping
from concurrent.futures import Future, TimeoutError as NotYet
from dataclasses import dataclass
from typing import IO, Any, Protocol, TypeAlias, TypeVar

from gelenk.errors import JobFailed, UnknownJob
from gelenk.jobs.job import JobRecord
from gelenk.jobs.parts import Parts, computed
from gelenk.jobs.store import JobStore
from gelenk.jobs.workers import Cancelled, OutOfTime, PoolExecutor

_Argument = TypeVar("_Argument")
_Result = TypeVar("_Result")

_LOOK = 0.1
"""How often to check whether a job was cancelled, [s]."""
_WRITE = 0.3
"""How often to write the progress of a job, [s]."""
_AHEAD = 2
"""Number of parts handed out per process: the next one waits while one is computed."""

Files: TypeAlias = Mapping[str, Callable[[IO[bytes]], object]]
"""Result files of a job: for each file name, a function that writes the file."""


class Executor(Protocol):
    """A place that computes parts: the processes of this machine, or a cluster."""

    @property
    def count(self) -> int:
        """Number of parts that it computes at the same time."""

    @property
    def failure(self) -> str | None:
        """Reason why it cannot compute parts now, or None."""

    def prepare(self) -> None:
        """Become ready for parts, if that is possible now."""

    def submit(self, function: Callable[[Any], Any], argument: Any, until: float) -> "Future[Any]":
        """Compute a part; see `PoolExecutor.submit`. A cancelled part is not started, or is ended."""

    def close(self) -> None:
        """Stop all parts under way, and reject later ones."""


@dataclass(eq=False)
class Run:
    """A job while it runs: hands out its parts and reports its progress.

    `job` is as it was at the start. It is given up at the time `until`, on the clock of `time.monotonic`, [s].
    """

    job: JobRecord
    until: float
    executor: Executor
    workers: PoolExecutor
    store: JobStore
    parts: Parts
    _looked: float = 0.0
    _written: float = 0.0
    _progress: float = 0.0
    _is_further: bool = False

    def map(
        self,
        stage: str,
        function: Callable[[_Argument], bytes],
        argument: Callable[[int], _Argument],
        count: int,
        span: tuple[float, float] = (0.0, 1.0),
        size: int = 1,
    ) -> None:
        """Compute the parts of a stage that are not on disk yet; afterwards, `parts.of` yields them all.

        Raises TooLarge if they take more room than a job may use, StorageFailed, or as `apart`.

        Args:
            stage: Name of the stage, unique within the job.
            function: Module-level function that computes a part; its result must depend on the argument alone.
            argument: Returns the argument of a part, given the part's number.
            span: Progress of the job at the start and at the end of the stage.
            size: Number of items per part, such as samples; used in the message about a failed part.
        """
        waiting: deque[Future[bytes | int] | None] = deque()
        try:
            for k in range(count):
                while len(waiting) < _AHEAD * self.executor.count and k + len(waiting) < count:
                    number = k + len(waiting)
                    name = f"{stage}-{number}"
                    is_there = self.parts.read(name) is not None
                    waiting.append(None if is_there else self._submit(function, argument(number), name))
                if (part := waiting[0]) is not None:
                    try:
                        found: bytes | int = self._wait(part)
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
        """Submit a part; processes of this machine write its result to disk and return only the size."""
        if self.is_here:
            return self.workers.submit(computed, (function, argument, self.parts, name), self.until)
        return self.executor.submit(function, argument, self.until)

    @property
    def is_here(self) -> bool:
        """Whether processes of this machine compute the parts, which can read the job's files."""
        return self.executor is self.workers

    def apart(self, function: Callable[[_Argument], _Result], argument: _Argument) -> _Result:
        """Run a module-level function in a process of this machine, and return its result.

        The process has access to the disk and, unlike a thread of the service, does not delay the event loop. Besides
        the function's own exceptions, it raises JobFailed if the process died, Cancelled and OutOfTime.
        """
        future: Future[_Result] = self.workers.submit(function, argument, self.until)
        try:
            return self._wait(future)
        except ChildProcessError as error:
            raise JobFailed(str(error)) from error

    def report(self, progress: float) -> None:
        """Report the progress of the job; raise `Cancelled` or `OutOfTime` if it may not continue."""
        self._progress = max(self._progress, progress)
        if time.monotonic() > self._looked + _LOOK:
            self._look()

    def _wait(self, future: "Future[_Result]") -> _Result:
        try:
            while True:
                try:
                    return future.result(timeout=_LOOK)
                except NotYet:
                    self._look()
        finally:
            future.cancel()  # has no effect on one that is done

    def _look(self) -> None:
        self._looked = time.monotonic()
        news: dict[str, Any] = {}
        if self._looked >= self._written + _WRITE:
            self._written = self._looked
            news = {"progress": max(self._progress, self.job.progress)}
            if self._is_further:  # earlier attempts no longer count
                news["attempts"] = 1
        try:
            job = self.store.change(self.job, **news)
        except UnknownJob:
            raise Cancelled from None
        if job.is_final:
            raise Cancelled
        if self._looked > self.until:
            raise OutOfTime
