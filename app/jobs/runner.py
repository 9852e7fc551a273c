"""Takes jobs in, does them part by part in other processes, tells how far they are, and cancels them."""

import logging
import queue
import threading
import time
from collections import deque
from collections.abc import Callable, Iterable, Iterator, Mapping
from concurrent.futures import Future
from concurrent.futures import TimeoutError as NotYet
from dataclasses import dataclass, field
from pathlib import Path
from typing import IO, Any, TypeAlias, TypeVar

from app.jobs.job import Failure, Job
from app.jobs.shelf import Shelf
from app.jobs.workers import Cancelled, Order, OutOfTime, Workers
from app.model.errors import (
    JobCancelled,
    JobFailed,
    JobInterrupted,
    JobNotFinished,
    JobTookTooLong,
    KinematicsError,
    ServiceStopping,
    UnknownJob,
)

_Argument = TypeVar("_Argument")
_Result = TypeVar("_Result")

_LOOK = 0.1
"""How often a job looks whether it was cancelled, and says how far it is, [s]."""
_AHEAD = 2
"""Parts a process that are handed out at once: while one is computed the next one waits."""
_RENDERING_SECONDS = 60.0
_SHUTTING_DOWN = "the service was shutting down"

logger = logging.getLogger("gelenk")

Files: TypeAlias = Mapping[str, Callable[[IO[bytes]], object]]
"""What a job leaves behind: what writes each file, by its name."""


@dataclass(eq=False)
class Run:
    """A job while it is done: hands out its parts, and says how far they are.

    Attributes:
        job: As it was when it was begun.
        order: What its parts have in common.
        workers: Who does them.
        shelf: Where it is kept.
    """

    job: Job
    order: Order
    workers: Workers
    shelf: Shelf
    _looked: float = field(default=0.0)
    _progress: float = field(default=0.0)

    def map(
        self,
        function: Callable[[_Argument], _Result],
        arguments: Iterable[_Argument],
        count: int,
        span: tuple[float, float] = (0.0, 1.0),
    ) -> Iterator[_Result]:
        """The results of a function, in the order of its arguments; progress goes from one end of a span to the other.

        Raises:
            Cancelled: The job is no longer wanted.
            OutOfTime: It has taken too long.
            Exception: Whatever the function raises.
        """
        waiting: deque[Future[_Result]] = deque()
        rest, done = iter(arguments), 0
        while done < count:
            while len(waiting) < _AHEAD * self.workers.count and done + len(waiting) < count:
                waiting.append(self.workers.submit(function, next(rest), self.order))
            result = self._waited(waiting.popleft())
            done += 1
            self.report(span[0] + (span[1] - span[0]) * done / count)
            yield result

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
            job = self.shelf.change(self.job, progress=self._progress)
        except UnknownJob:
            raise Cancelled from None
        if job.is_final:
            raise Cancelled
        if self._looked > self.order.until:
            raise OutOfTime


Work: TypeAlias = Callable[[Run], Files]
"""Does a job: all that it computes it hands to other processes, part by part."""


class Runner:
    """The jobs of this process of the service, and the results of all.

    Args:
        shelf: Where jobs are kept.
        workers: Processes that do their parts.
        running: How many jobs share these at a time.
        seconds: How long a job may take from when it is begun.
    """

    def __init__(self, shelf: Shelf, workers: int, running: int, seconds: float) -> None:
        self.shelf, self.workers = shelf, Workers(workers)
        self._running, self._seconds = running, seconds
        self._queue: queue.SimpleQueue[tuple[Job, Work] | None] = queue.SimpleQueue()
        self._threads: list[threading.Thread] = []
        self._lock = threading.Lock()
        self._orders: dict[str, Order] = {}
        self._closed = False

    def submit(self, kind: str, digest: str, work: Work, job_id: str | None = None) -> Job:
        """Have a job done, or find that it was asked for already.

        Raises:
            JobExists: The name stands for another request.
            TooManyJobs: Too many wait.
            ServiceStopping: It takes no more jobs.
            StorageFailed: It cannot be kept.
        """
        if self._closed:
            raise ServiceStopping
        job, is_new = self.shelf.add(kind, digest, job_id)
        if is_new:
            self._queue.put((job, work))
            with self._lock:
                if not self._threads and not self._closed:
                    self._threads = [
                        threading.Thread(target=self._serve, name=f"job-{i}", daemon=True) for i in range(self._running)
                    ]
                    for thread in self._threads:
                        thread.start()
        return job

    def cancel(self, job_id: str) -> Job:
        """End a job that is not finished, in whichever process it is; remove one that is.

        Returns:
            The job: cancelled, or as it was before it was removed.

        Raises:
            UnknownJob: There is none of this name.
        """
        job = self.shelf.get(job_id)
        if job.is_final:
            self.shelf.remove(job_id)
            return job
        job = self.shelf.change(job_id, state="cancelled")
        order = self._orders.get(job_id)
        if order is not None:
            order.cancelled.set()
        return job

    def result(self, job_id: str, name: str) -> Path:
        """A file that a job has left behind.

        Raises:
            UnknownJob: There is none of this name.
            JobNotFinished: It is not done.
            JobCancelled: It never will be.
            KinematicsError: It failed: what it has failed with.
        """
        job = self.shelf.get(job_id)
        match job.state:
            case "queued" | "running":
                raise JobNotFinished(job_id, job.state, job.progress)
            case "cancelled":
                raise JobCancelled(job_id)
            case "failed":
                raise (job.failure or Failure.because("the job failed")).error_again()
        return self.shelf.file(job_id, name)

    def rendered(self, function: Callable[[Any], bytes], argument: Any) -> bytes:
        """What a function makes of a result, in another process because it takes long.

        Raises:
            JobTookTooLong: It takes very long.
            JobFailed: The process has died.
            ServiceStopping: The service is shutting down.
        """
        order = Order(time.monotonic() + _RENDERING_SECONDS)
        try:
            found: bytes = self.workers.submit(function, argument, order).result()
        except OutOfTime:
            raise JobTookTooLong(_RENDERING_SECONDS) from None
        except Cancelled:
            raise ServiceStopping from None
        except ChildProcessError as error:
            raise JobFailed(str(error)) from None
        return found

    def close(self) -> None:
        """End all that is under way; what is not finished has failed."""
        with self._lock:
            self._closed = True
        self.workers.close()
        for _ in self._threads:
            self._queue.put(None)
        for thread in self._threads:
            thread.join(2.0)
        self._give_up_waiting()
        self.shelf.close()

    def _give_up_waiting(self) -> None:
        while True:
            try:
                entry = self._queue.get_nowait()
            except queue.Empty:
                return
            if entry is not None:
                self._fail(entry[0], Failure.of(JobInterrupted(_SHUTTING_DOWN)))

    def _serve(self) -> None:
        while (entry := self._queue.get()) is not None:
            self._do(*entry)

    def _do(self, job: Job, work: Work) -> None:
        """A job from its beginning to its end; nothing that goes wrong in it leaves it."""
        order = Order(time.monotonic() + self._seconds)
        self._orders[job.id] = order
        try:
            if self._closed:
                raise Cancelled
            if self.shelf.change(job, state="running", started=time.time()).is_final:
                return
            for name, content in work(Run(job, order, self.workers, self.shelf)).items():
                self.shelf.write(job.id, name, content)
            self.shelf.change(job, state="succeeded", progress=1.0)
        except (Cancelled, UnknownJob):
            if self._closed:
                self._fail(job, Failure.of(JobInterrupted(_SHUTTING_DOWN)))
        except OutOfTime:
            self._fail(job, Failure.of(JobTookTooLong(self._seconds)))
        except KinematicsError as error:
            self._fail(job, Failure.of(error))
        except ChildProcessError as error:
            self._fail(job, Failure.because(str(error)))
        except Exception as error:
            logger.exception("job %s failed", job.id)
            self._fail(job, Failure.because(f"something went wrong in the service: {type(error).__name__}"))
        finally:
            order.cancelled.set()
            if self._orders.get(job.id) is order:
                del self._orders[job.id]

    def _fail(self, job: Job, failure: Failure) -> None:
        try:
            self.shelf.change(job, state="failed", failure=failure)
        except KinematicsError as error:
            logger.warning("job %s: %s", job.id, error.detail)
