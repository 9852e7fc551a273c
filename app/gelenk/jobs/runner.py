"""Accepts jobs, runs them part by part, resumes them after a restart, and cancels them."""

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
from gelenk.jobs.workers import Cancelled, OutOfTime, PoolExecutor, Unavailable
from gelenk.processes.turns import Turns

_RENDERING_SECONDS = 60.0
_LOOK_SECONDS = 0.5
"""How often to check whether a waiting job may start because other clients have left, [s]."""
_GOODBYE_SECONDS = 2.0
"""Longest wait for the threads of the jobs at shutdown, [s]."""
_LOOK_FOR_LEFT = 5.0
"""How often to look for jobs of processes that have ended, [s]."""
_ATTEMPTS = 3
"""How often a job may start without progress: a job that crashes the service does so at most this often."""

logger = logging.getLogger("gelenk")

Work: TypeAlias = Callable[[Run], Files]
"""Function that runs a job, handing out all computation as parts, and returns its result files."""

Kind: TypeAlias = Callable[[Path], Work]
"""Function that returns the work of a job, given the folder of its request; the same at any time, in any process."""


class Runner:
    """Runs the jobs of this process of the service, and gives access to the results of all jobs.

    Args:
        workers: The pool of this process, which puts results together and draws pictures of them.
        running: Number of jobs that run at a time; see `Turns` for when there are more.
        seconds: Longest run time of a job, [s].
        executor: Computes their parts; the processes of this machine if left out.
        is_local: Whether these compute if the executor is lost; jobs wait otherwise.
    """

    def __init__(
        self,
        store: JobStore,
        kinds: Mapping[str, Kind],
        workers: PoolExecutor,
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
        self._unrecorded: dict[str, tuple[JobRecord, KinematicsError]] = {}
        self._waiting: list[JobRecord] = []
        self._closed = threading.Event()

    def start(self) -> None:
        """Start a thread that resumes the jobs of processes that have ended, now and later."""
        self.store.prepare()
        thread = threading.Thread(target=self._take_up, name="jobs-left", daemon=True)
        thread.start()
        self._threads.append(thread)

    @property
    def failure(self) -> str | None:
        """Reason why no job can run at present, or None."""
        return None if self._is_local else self._executor.failure

    def submit(
        self, kind: str, digest: str, request: Mapping[str, bytes], job_id: str | None = None, client: str = ""
    ) -> JobRecord:
        """Submit a job, or find it; see `JobStore.add`. Raises ServiceStopping during shutdown."""
        if self._closed.is_set():
            raise ServiceStopping
        job, is_new = self.store.add(kind, digest, request, job_id, client)
        if is_new:
            self._do_later(job)
        return job

    def cancel(self, job_id: str, *, remove: bool = False) -> JobRecord:
        """Cancel an unfinished job, whichever process runs it; if `remove`, remove a finished one with its results.

        Return the job as it is now, or was before its removal. Raises UnknownJob, and JobFinished if it finished before
        or at this moment and stays.
        """
        was_final = self.store.get(job_id).is_final
        job = self.store.change(job_id, state="cancelled")
        if was_final or job.state != "cancelled":
            if not remove:
                raise JobFinished(job_id, job.state)
            self.store.remove(job_id)
        return job

    def result(self, job_id: str, name: str) -> Path:
        """Return the path of a result file; raises UnknownJob, JobNotFinished, JobCancelled, or why the job failed."""
        job = self.store.get(job_id)
        match job.state:
            case "queued" | "running":
                raise JobNotFinished(job_id, job.state, job.progress)
            case "cancelled":
                raise JobCancelled(job_id)
            case "failed":
                raise job.failure.error_again() if job.failure else JobFailed("the job failed")
        return self.store.folder(job_id) / name

    def rendered(self, function: Callable[[Any], bytes], argument: Any) -> bytes:
        """Render a result by a module-level function in another process, because that takes long.

        Raises JobTookTooLong, JobFailed if the process died, and ServiceStopping.
        """
        try:
            found: bytes = self.workers.submit(function, argument, time.monotonic() + _RENDERING_SECONDS).result()
        except OutOfTime:
            raise JobTookTooLong(_RENDERING_SECONDS) from None
        except Cancelled:
            raise ServiceStopping from None
        except ChildProcessError as error:
            raise JobFailed(str(error)) from None
        return found

    def close(self) -> None:
        """Stop all work; unfinished jobs wait for the next process of the service."""
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
                # If no job can run here now, another process may run them, or this one later.
                if self.failure is None:
                    for job in self.store.take_up():
                        logger.warning("job %s resumes: the service process that ran it has ended", job.id)
                        self._do_later(job)
                    while self._waiting:
                        self._do_later(self._waiting.pop(0))
                for job, failure in list(self._unrecorded.values()):
                    self._record_failure(job, failure)
                    self._clear(job)
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
        """Wait for the next job that may run, and return it with its client; None at shutdown."""
        with self._turned:
            while not self._closed.is_set():
                if (found := self._turns.take()) is not None:
                    return found
                self._turned.wait(_LOOK_SECONDS if self._turns else None)
        return None

    def _do(self, job: JobRecord) -> None:
        """Run a job to its end; record any error in the job instead of raising it."""
        try:
            self._run(job, time.monotonic() + self._seconds)
        except Unavailable as reason:
            self._postpone(job, reason)
        except (Cancelled, UnknownJob):
            if self._closed.is_set():
                self._leave(job)
        except OutOfTime:
            self._fail(job, JobTookTooLong(self._seconds))
        except KinematicsError as error:
            self._fail(job, error)
        except ChildProcessError as error:
            self._fail(job, JobFailed(str(error)))
        except Exception as error:
            logger.exception("job %s failed", job.id)
            self._fail(job, JobFailed(f"internal error: {type(error).__name__}"))
        finally:
            self._clear(job)

    def _run(self, job: JobRecord, until: float) -> None:
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
            raise JobInterrupted("its request is missing")
        executor = self.workers if self._is_local and self._executor.failure else self._executor
        run = Run(job, until, executor, self.workers, self.store, self.store.parts(job))
        for name, content in self._kinds[job.kind](request)(run).items():
            write_result(self.store.folder(job.id), name, content)
        self.store.change(job, state="succeeded", progress=1.0)

    def _clear(self, job: JobRecord) -> None:
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
        """Set a job back to queued; the interrupted run does not count as an attempt."""
        with contextlib.suppress(KinematicsError):
            self.store.change(job, state="queued", attempts=0)

    def _fail(self, job: JobRecord, failure: KinematicsError) -> None:
        """Mark a job as failed; if the disk cannot store even that, `_take_up` tries again."""
        with contextlib.suppress(KinematicsError, OSError):
            self.store.parts(job).clear()  # the disk may be full
        try:
            self._record_failure(job, failure)
        except KinematicsError as error:
            logger.warning("job %s: %s", job.id, error.detail)
            self._unrecorded[job.id] = job, failure

    def _record_failure(self, job: JobRecord, failure: KinematicsError) -> None:
        with contextlib.suppress(UnknownJob):
            self.store.change(job, state="failed", failure=Failure.of(failure))
        self._unrecorded.pop(job.id, None)
