"""Takes jobs in and up again, has them done part by part, and cancels them."""

import contextlib
import logging
import threading
import time
from collections.abc import Callable, Mapping
from pathlib import Path
from typing import Any, TypeAlias

from gelenk.errors import (
    JobCancelled,
    JobFailed,
    JobFinished,
    JobInterrupted,
    JobNotFinished,
    JobTookTooLong,
    KinematicsError,
    ServiceStopping,
    UnknownJob,
)
from gelenk.jobs.job import Failure, JobRecord
from gelenk.jobs.run import Executor, Files, Run
from gelenk.jobs.store import JobStore, write_result
from gelenk.jobs.workers import Cancelled, Order, OutOfTime, Unavailable, Workers
from gelenk.processes.turns import Turns

_RENDERING_SECONDS = 60.0
_LOOK_SECONDS = 0.5
"""How often to check whether a job may start that waited for clients who have left, [s]."""
_GOODBYE_SECONDS = 2.0
"""How long the jobs' threads are waited for at the end, [s]."""
_LOOK_FOR_LEFT = 5.0
"""How often the jobs of processes that are gone are looked for, [s]."""
_ATTEMPTS = 3
"""How often a job is started without progress: one that brings the service down does so at most this often."""

logger = logging.getLogger("gelenk")

Work: TypeAlias = Callable[[Run], Files]
"""Does a job: all that it computes it hands out part by part."""

Kind: TypeAlias = Callable[[Path], Work]
"""What does a job of some kind, by the folder that its request is kept in: the same at any time, in any process."""


class Runner:
    """The jobs of this process of the service, and the results of all.

    Args:
        store: Where jobs are kept.
        kinds: What does a job, by its kind.
        workers: Processes of this machine, which put results together and draw pictures of them.
        running: How many jobs are done at a time; see `Turns` for when there are more.
        seconds: How long a job may take from when it is started.
        executor: Computes their parts; the processes of this machine if left out.
        is_local: Whether these compute if the executor is lost; jobs wait otherwise.
    """

    def __init__(
        self,
        store: JobStore,
        kinds: Mapping[str, Kind],
        workers: Workers,
        running: int,
        seconds: float,
        executor: Executor | None = None,
        is_local: bool = False,
    ) -> None:
        self.store, self.workers, self._kinds = store, workers, kinds
        self._executor, self._is_local = executor or workers, is_local
        self._seconds = seconds
        self._turns: Turns[JobRecord] = Turns(running)
        self._turned = threading.Condition()
        self._threads: list[threading.Thread] = []
        self._lock = threading.Lock()
        self._orders: dict[str, Order] = {}
        self._unsaid: dict[str, tuple[JobRecord, Failure]] = {}
        self._waiting: list[JobRecord] = []
        self._closed = threading.Event()

    def start(self) -> None:
        """Take up what was left by processes that are gone, now and whenever there is something."""
        self.store.prepare()
        thread = threading.Thread(target=self._take_up, name="jobs-left", daemon=True)
        thread.start()
        self._threads.append(thread)

    @property
    def failure(self) -> str | None:
        """Why no job can be done at present, where that is so."""
        return None if self._is_local else self._executor.failure

    def submit(
        self, kind: str, digest: str, request: Mapping[str, bytes], job_id: str | None = None, client: str = ""
    ) -> JobRecord:
        """Start a job, or find the same one submitted before.

        Args:
            kind: One of the kinds.
            digest: Of the request.
            request: Files that describe the request to the kind of job.
            job_id: Its name; one is made up if left out.
            client: The client that requests it.

        Raises:
            JobExists: A job with another request uses the name.
            TooManyJobs: Too many wait.
            ServiceStopping: It takes no more jobs.
            StorageFailed: It cannot be kept.
        """
        if self._closed.is_set():
            raise ServiceStopping
        job, is_new = self.store.add(kind, digest, request, job_id, client)
        if is_new:
            self._do_later(job)
        return job

    def cancel(self, job_id: str, *, remove: bool = False) -> JobRecord:
        """End a job that is not finished, in whichever process it is.

        Args:
            job_id: Its name.
            remove: Whether one that is finished goes, with its result.

        Returns:
            The job: cancelled, or as it was before it was removed.

        Raises:
            UnknownJob: There is none of this name.
            JobFinished: It is finished, if only in this moment, and stays.
        """
        was_final = self.store.get(job_id).is_final
        job = self.store.change(job_id, state="cancelled")
        if was_final or job.state != "cancelled":
            if not remove:
                raise JobFinished(job_id, job.state)
            self.store.remove(job_id)
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
        job = self.store.get(job_id)
        match job.state:
            case "queued" | "running":
                raise JobNotFinished(job_id, job.state, job.progress)
            case "cancelled":
                raise JobCancelled(job_id)
            case "failed":
                raise (job.failure or Failure.because("the job failed")).error_again()
        return self.store.folder(job_id) / name

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
        """End all that is under way; what is not finished waits for the next process of the service."""
        with self._lock:
            self._closed.set()
        for executor in {self._executor, self.workers}:
            executor.close()
        with self._turned:
            self._turned.notify_all()
        ends = time.monotonic() + _GOODBYE_SECONDS
        for thread in self._threads:
            thread.join(max(0.0, ends - time.monotonic()))
        self.store.close()

    def _take_up(self) -> None:
        while True:
            self._executor.prepare()
            try:
                # Where none can be done now, another process may, or this one later.
                if self.failure is None:
                    for job in self.store.take_up():
                        logger.warning("job %s resumes: the service process that ran it has ended", job.id)
                        self._do_later(job)
                    while self._waiting:
                        self._do_later(self._waiting.pop(0))
                self._say_again()
                self.store.tidy()
            except (KinematicsError, OSError) as error:
                logger.warning("unfinished jobs cannot be resumed: %s", error)
            if self._closed.wait(_LOOK_FOR_LEFT):
                return

    def _do_later(self, job: JobRecord) -> None:
        with self._turned:
            self._turns.add(job.client, job)
            self._turned.notify_all()
        with self._lock:
            if self._closed.is_set() or any(thread.name == "job-0" for thread in self._threads):
                return
            most = self._turns.size + self._turns.half
            threads = [threading.Thread(target=self._serve, name=f"job-{i}", daemon=True) for i in range(most)]
            self._threads += threads
            for thread in threads:
                thread.start()

    def _serve(self) -> None:
        while (found := self._next()) is not None:
            client, job = found
            self._do(job)
            with self._turned:
                self._turns.give_back(client)
                self._turned.notify_all()

    def _next(self) -> tuple[str, JobRecord] | None:
        """The job whose turn it is, once there is one; None at the end."""
        with self._turned:
            while not self._closed.is_set():
                if (found := self._turns.take()) is not None:
                    return found
                self._turned.wait(_LOOK_SECONDS if self._turns else None)
        return None

    def _do(self, job: JobRecord) -> None:
        """A job from where it is to its end; nothing that goes wrong in it leaves it."""
        order = Order(time.monotonic() + self._seconds)
        self._orders[job.id] = order
        try:
            self._done(job, order)
        except Unavailable as reason:
            self._postpone(job, reason)
        except (Cancelled, UnknownJob):
            if self._closed.is_set():
                self._leave(job)
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
            self._clear(job)

    def _done(self, job: JobRecord, order: Order) -> None:
        if self.failure is not None:
            raise Unavailable(self.failure)
        job = self.store.start(job)
        if job.is_final:
            return
        if job.attempts > _ATTEMPTS:
            raise JobInterrupted(
                f"it was started {_ATTEMPTS} times, and each time the service ended before it made progress"
            )
        request = self.store.request(job.id)
        if not request.is_dir():
            raise JobInterrupted("its request is no longer there")
        executor = self.workers if self._is_local and self._executor.failure else self._executor
        run = Run(job, order, executor, self.workers, self.store, self.store.parts(job))
        for name, content in self._kinds[job.kind](request)(run).items():
            write_result(self.store.folder(job.id), name, content)
        self.store.change(job, state="succeeded", progress=1.0)

    def _clear(self, job: JobRecord) -> None:
        """Remove what a job needs no more, if it is over."""
        with contextlib.suppress(KinematicsError, OSError):
            now = self.store.get(job.id)
            if now.is_final and now.created == job.created:
                self.store.clear(job)

    def _postpone(self, job: JobRecord, reason: Unavailable) -> None:
        """Put a job back into the queue: its remaining parts cannot be computed now."""
        logger.warning("job %s %s: %s", job.id, "continues here" if self._is_local else "waits", reason)
        self._leave(job)
        if self._is_local:
            self._do_later(job)
        else:
            self._waiting.append(job)

    def _leave(self, job: JobRecord) -> None:
        """Leave a job to the next process of the service; this shutdown does not count as a failed attempt."""
        with contextlib.suppress(KinematicsError):
            self.store.change(job, state="queued", attempts=0)

    def _fail(self, job: JobRecord, failure: Failure) -> None:
        """Say that a job has failed; where the disk does not even take that, as soon as it does."""
        with contextlib.suppress(KinematicsError, OSError):
            self.store.parts(job).clear()  # it is room that may be lacking
        try:
            self.store.change(job, state="failed", failure=failure)
        except UnknownJob:
            return
        except KinematicsError as error:
            logger.warning("job %s: %s", job.id, error.detail)
            self._unsaid[job.id] = job, failure

    def _say_again(self) -> None:
        """Say of those jobs that they have failed of which it could not be said before."""
        for job, failure in list(self._unsaid.values()):
            with contextlib.suppress(UnknownJob):
                self.store.change(job, state="failed", failure=failure)
            del self._unsaid[job.id]
            self._clear(job)
