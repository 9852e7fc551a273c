"""A job while it is done: its parts handed out, kept when they are finished, and never done twice."""

import time
from collections import deque
from collections.abc import Callable, Iterator, Mapping
from concurrent.futures import Future
from concurrent.futures import TimeoutError as NotYet
from dataclasses import dataclass, field
from typing import IO, Any, Protocol, TypeAlias, TypeVar

from app.jobs.job import Job
from app.jobs.parts import Parts
from app.jobs.shelf import Shelf
from app.jobs.workers import Cancelled, Order, OutOfTime
from app.model.errors import JobFailed, UnknownJob

_Argument = TypeVar("_Argument")

_LOOK = 0.1
"""How often a job looks whether it was cancelled, and says how far it is, [s]."""
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
        """Have a part done; see `Workers.submit`. One that is cancelled is not begun, or is ended."""

    def close(self) -> None:
        """End whatever is under way; later parts are refused."""


@dataclass(eq=False)
class Run:
    """A job while it is done: hands out its parts, and says how far they are.

    Attributes:
        job: As it was when it was begun.
        order: What its parts have in common.
        executor: Who does them.
        shelf: Where the job is kept.
        parts: Those that are finished.
    """

    job: Job
    order: Order
    executor: Executor
    shelf: Shelf
    parts: Parts
    _looked: float = field(default=0.0)
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
    ) -> Iterator[bytes]:
        """The parts of a stage in their order: those that are kept already as they are, the others computed.

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
        waiting: deque[bytes | Future[bytes]] = deque()
        try:
            yield from self._mapped(waiting, stage, function, argument, count, span, size)
        finally:
            for part in waiting:
                if not isinstance(part, bytes):
                    part.cancel()

    def _mapped(
        self,
        waiting: deque["bytes | Future[bytes]"],
        stage: str,
        function: Callable[[_Argument], bytes],
        argument: Callable[[int], _Argument],
        count: int,
        span: tuple[float, float],
        size: int,
    ) -> Iterator[bytes]:
        """See `map`; what is handed out is in `waiting`."""
        for k in range(count):
            while len(waiting) < _AHEAD * self.executor.count and k + len(waiting) < count:
                number = k + len(waiting)
                kept = self.parts.read(f"{stage}-{number}")
                waiting.append(self.executor.submit(function, argument(number), self.order) if kept is None else kept)
            part = waiting[0]
            if not isinstance(part, bytes):
                try:
                    part = self._waited(part)
                except ChildProcessError as error:
                    which = f"part {k + 1} of {count} ({stage} from {k * size:,} on)"
                    raise JobFailed(f"{which}: {error}") from error
                self.parts.write(f"{stage}-{k}", part)
                self._is_further = True
            waiting.popleft()
            self.report(span[0] + (span[1] - span[0]) * (k + 1) / count)
            yield part

    def finished(self, stage: str, count: int) -> Iterator[bytes]:
        """The parts of a stage once more, after `map` has come to their end.

        Raises:
            OSError: One of them is not there any more.
        """
        for k in range(count):
            part = self.parts.read(f"{stage}-{k}")
            if part is None:
                raise FileNotFoundError(f"{stage}-{k}")
            yield part

    def report(self, progress: float) -> None:
        """Say how far the job is, and look whether it is still wanted.

        Raises:
            Cancelled: It is not.
        """
        self._progress = max(self._progress, progress)
        if time.monotonic() > self._looked + _LOOK:
            self._look()

    def _waited(self, future: "Future[bytes]") -> bytes:
        while True:
            try:
                return future.result(timeout=_LOOK)
            except NotYet:
                self._look()

    def _look(self) -> None:
        self._looked = time.monotonic()
        try:
            job = self.shelf.change(self.job, **self._news())
        except UnknownJob:
            raise Cancelled from None
        if job.is_final:
            raise Cancelled
        if self._looked > self.order.until:
            raise OutOfTime

    def _news(self) -> dict[str, Any]:
        """What has changed since the job was begun; once it gets further, the times before do not count."""
        further = {"attempts": 1} if self._is_further else {}
        return {"progress": max(self._progress, self.job.progress), **further}
