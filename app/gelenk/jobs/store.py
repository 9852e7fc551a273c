"""Jobs as folders, which every process of the service reads and writes.

What stands in a folder's `job.json` is the truth: a process that cancels a job writes so there, and the one that does
it finds that out at its next step. Beside it are the request and the finished parts. Each process of the
service holds a locked file as long as it lives; a job whose process is gone waits until another one takes it up.
"""

import logging
import os
import re
import shutil
import time
import uuid
from collections import Counter
from collections.abc import Callable, Mapping, Sequence
from contextlib import suppress
from dataclasses import dataclass, replace
from pathlib import Path
from typing import IO, Any

from gelenk.errors import JobExists, JobInterrupted, StorageFailed, TooManyJobs, UnknownJob
from gelenk.jobs.job import Job
from gelenk.jobs.owners import Owners
from gelenk.jobs.parts import Parts
from gelenk.jobs.robot_files import robot_digest
from gelenk.store import folders

JOB_FILE = "job.json"
_NAME = re.compile(r"[A-Za-z0-9][A-Za-z0-9_.-]{0,63}")
_OWNERS = ".owners"
_REQUEST = "request"
_SURE_SECONDS = 24 * 3600.0
"""How long a job must have seemed to be too old, by a clock that cannot be set, before it is removed for that, [s]."""
_AT_REST = 60.0
"""How long a job must be over before others than the process that did it put its folder in order, [s]."""
_PAUSE = 5
"""After how many seconds it is worth while to ask again where too many jobs wait."""

logger = logging.getLogger("gelenk")


@dataclass(frozen=True, slots=True)
class Limits:
    """How much is kept, and waits.

    Attributes:
        kept: Jobs, finished ones included; the oldest finished ones go first.
        kept_bytes: Of all of them.
        unfinished: Jobs of one client that wait or run; see `JobStore.check_room` where there are several.
        job_bytes: Of the finished parts of one job.
        kept_seconds: How long a finished job is kept, [s].
    """

    kept: int = 100
    kept_bytes: int = 2 * 1024**3
    unfinished: int = 16
    job_bytes: int = 1024**3
    kept_seconds: float = 30 * 24 * 3600.0


class JobStore:
    """All jobs below a folder; safe to use from many threads and processes.

    Args:
        root: The folder; made when first written to.
        limits: How much it holds.
    """

    def __init__(self, root: Path, limits: Limits) -> None:
        self._root, self._limits = root, limits
        self._owners = Owners(root / _OWNERS)
        self._too_old: dict[tuple[str, float], float] = {}

    def prepare(self) -> None:
        """Remove what interrupted writers, and processes that are gone, have left; what is read-only stays."""
        if not self._root.is_dir():
            return
        try:
            with folders.exclusive(self._root):
                for folder in (self._root, *(path.parent for path in self._root.glob(f"*/{JOB_FILE}"))):
                    folders.sweep(folder)
                self._owners.sweep()
        except StorageFailed as error:
            logger.warning("jobs cannot be written: %s", error.reason)

    def close(self) -> None:
        """Give up what says that this process lives."""
        self._owners.close()

    def add(
        self, kind: str, digest: str, request: Mapping[str, bytes], job_id: str | None = None, client: str = ""
    ) -> tuple[Job, bool]:
        """A new job, or the existing one with the same name and request.

        One that was given up because its service kept ending starts afresh.

        Args:
            kind: What it computes.
            digest: Of the request.
            request: Files of the job's folder, from which it can be done at any time.
            job_id: Its name; one is made up if left out.
            client: The client that requests it.

        Returns:
            The job, and whether it is new.

        Raises:
            JobExists: A job with another request uses the name.
            TooManyJobs: The queue is full.
            StorageFailed: It cannot be written.
        """
        with folders.exclusive(self._root):
            folders.sweep(self._root)
            self._owners.say_alive()
            if job_id is not None and (found := self._read(job_id)) is not None:
                if found.digest != digest:
                    raise JobExists(job_id)
                if not _was_interrupted(found):
                    return self._as_it_is(found), False
            self._make_room(client)
            if job_id is not None and self._read(job_id) is not None:
                folders.remove_folder(self._root, job_id)
            number = 1 + max((job.number for job in self._jobs()), default=0)
            name, owner = job_id or uuid.uuid4().hex, self._owners.own_name
            job = Job(name, kind, digest, owner, time.time(), number=number, client=client)
            job = replace(job, robot_digest=robot_digest(request))
            files = {f"{_REQUEST}/{name}": content for name, content in request.items()}
            folders.create_folder(self._root, job.id, {**files, JOB_FILE: job.as_bytes()})
        return job, True

    def take_up(self) -> list[Job]:
        """The unfinished jobs whose process is gone, the oldest first; from now on they are this process's.

        Raises:
            StorageFailed: Nothing can be written.
        """
        if not any(self._is_left(job) for job in self._jobs()):
            return []
        with folders.exclusive(self._root):
            self._owners.say_alive()
            left = [job for job in self._jobs() if self._is_left(job)]
            taken = [replace(job, owner=self._owners.own_name, state="queued") for job in left]
            for job in taken:
                folders.replace_file(self._root / job.id, JOB_FILE, job.as_bytes())
        return taken

    def tidy(self) -> None:
        """Remove finished jobs that are older than they may be, and what others no longer need.

        A clock that is set forward by mistake makes all jobs old in a moment: none goes before they have been so for a
        day, during which the clock may be set right.
        """
        now, since = time.time(), self._too_old
        self._too_old = {}
        for job in self._jobs():
            age = now - (job.finished or job.created)
            with suppress(UnknownJob):
                if job.is_final and age > self._limits.kept_seconds:
                    which = job.id, job.created
                    self._too_old[which] = since.get(which, time.monotonic())
                    if time.monotonic() >= self._too_old[which] + _SURE_SECONDS:
                        self.remove(job.id)
                if job.is_final and age > _AT_REST and (self.request(job.id).exists() or self.parts(job).bytes):
                    self.clear(job)

    def clear(self, job: Job) -> None:
        """Remove the request and the parts of a job that is over; its results stay."""
        self.parts(job).clear()
        shutil.rmtree(self.request(job.id), ignore_errors=True)

    def get(self, job_id: str) -> Job:
        """The current state of a job.

        Raises:
            UnknownJob: There is none of this name.
        """
        job = self._read(job_id)
        if job is None:
            raise UnknownJob(job_id)
        return self._as_it_is(job)

    def begin(self, job: Job) -> Job:
        """Count that a job is started, on disk before this returns; a finished one stays as it is.

        Raises:
            UnknownJob: It was removed meanwhile, or is another process's.
            StorageFailed: It cannot be written.
        """
        return self.change(
            job, state="running", started=job.started or max(time.time(), job.created), attempts=job.attempts + 1
        )

    def change(self, which: Job | str, **changes: Any) -> Job:
        """Change fields of a job that is not finished; a finished one stays as it is.

        Args:
            which: The job by its name; or that very job, and not one that has its name by now.
            changes: The fields.

        Returns:
            The job after that.

        Raises:
            UnknownJob: It was removed meanwhile.
            StorageFailed: It cannot be written.
        """
        with folders.exclusive(self._root):
            job_id = which if isinstance(which, str) else which.id
            job = self._read(job_id)
            if job is None or (isinstance(which, Job) and (job.owner, job.created) != (which.owner, which.created)):
                raise UnknownJob(job_id)
            if job.is_final:
                return job
            job, before = replace(job, **changes), job
            if job.is_final:
                job = replace(job, finished=max(time.time(), job.started or job.created))
            if job != before:
                # How far a job is need not outlive the machine.
                durable = job.state != before.state
                folders.replace_file(self._root / job_id, JOB_FILE, job.as_bytes(), is_durable=durable)
        return job

    def write(self, job_id: str, name: str, content: Callable[[IO[bytes]], object]) -> None:
        """Write a result; on disk when this returns, and not read before the job has the state `succeeded`.

        Raises:
            UnknownJob: The job was removed meanwhile.
            StorageFailed: It cannot be written.
        """
        write_result(self._root / job_id, name, content)

    def remove(self, job_id: str) -> None:
        """Remove a job and its results.

        Raises:
            UnknownJob: There is none of this name.
            StorageFailed: It cannot be removed.
        """
        with folders.exclusive(self._root):
            if self._read(job_id) is None:
                raise UnknownJob(job_id)
            folders.remove_folder(self._root, job_id)

    def request(self, job_id: str) -> Path:
        """The folder with a job's request; it exists until the job is over."""
        return self._root / job_id / _REQUEST

    def file(self, job_id: str, name: str) -> Path:
        """Where a result of a job is, or will be."""
        return self._root / job_id / name

    def parts(self, job: Job) -> Parts:
        """The finished parts of a job."""
        return Parts(self._root / job.id, job.digest, self._limits.job_bytes)

    def states(self) -> Counter[str]:
        """How many jobs there are, by state."""
        return Counter(self._as_it_is(job).state for job in self._jobs())

    def _as_it_is(self, job: Job) -> Job:
        """The current state of a job: one that no process runs is queued."""
        return replace(job, state="queued") if self._is_left(job) else job

    def _is_left(self, job: Job) -> bool:
        """Whether a job is not finished and the process that was to do it is gone."""
        return not (job.is_final or self._owners.lives(job.owner))

    def _read(self, job_id: str) -> Job | None:
        if not _NAME.fullmatch(job_id):
            return None
        try:
            return Job.from_bytes(folders.read_plain(self._root / job_id / JOB_FILE))
        except (FileNotFoundError, NotADirectoryError, ValueError, TypeError):
            return None

    def _jobs(self) -> list[Job]:
        """All jobs, the oldest first, whatever the clock said."""
        if not self._root.is_dir():
            return []
        found = [self._read(path.name) for path in self._root.iterdir() if not path.name.startswith(".")]
        return sorted((job for job in found if job is not None), key=lambda job: (job.number, job.created))

    def check_room(self, client: str) -> None:
        """Refuse a client another job where too many are unfinished, before much is done for it.

        A client alone may have as many unfinished ones as there may be, beside others half as many; there may be half
        as many more for those who came later.

        Raises:
            TooManyJobs: There are too many.
        """
        self._check_room(self._jobs(), client)

    def _check_room(self, jobs: Sequence[Job], client: str) -> None:
        """See `check_room`; `jobs` are all."""
        unfinished = [job for job in jobs if not job.is_final]
        own, half = sum(job.client == client for job in unfinished), max(1, self._limits.unfinished // 2)
        most = self._limits.unfinished if own == len(unfinished) else half
        if own >= most:
            raise TooManyJobs(own, most, _PAUSE, "client")
        if len(unfinished) >= self._limits.unfinished + half:
            raise TooManyJobs(len(unfinished), self._limits.unfinished + half, _PAUSE, "service")

    def _make_room(self, client: str) -> None:
        """Drop the oldest finished jobs beyond what is kept.

        Raises:
            TooManyJobs: There are too many unfinished ones.
        """
        jobs = self._jobs()
        self._check_room(jobs, client)
        sizes = {job.id: _size(self._root / job.id) for job in jobs}
        count, total = len(jobs), sum(sizes.values())
        for job in jobs:
            if count < self._limits.kept and total <= self._limits.kept_bytes:
                return
            if job.is_final:
                folders.remove_folder(self._root, job.id)
                count, total = count - 1, total - sizes[job.id]


def write_result(folder: Path, name: str, content: Callable[[IO[bytes]], object]) -> None:
    """Write a result into the folder of a job, which is its name; see `JobStore.write`."""
    with folders.writing():
        try:
            with (folder / name).open("wb") as target:
                content(target)
                target.flush()
                os.fsync(target.fileno())
        except FileNotFoundError:
            raise UnknownJob(folder.name) from None
        except OSError:
            (folder / name).unlink(missing_ok=True)
            raise


def _was_interrupted(job: Job) -> bool:
    """Whether it was given up because the processes that did it came to their end before it did."""
    return job.failure is not None and job.failure.error == JobInterrupted.__name__


def _size(folder: Path) -> int:
    """Bytes of the files below a folder."""
    total = 0
    for parent, _, names in os.walk(folder):  # takes no harm where a folder is removed meanwhile
        for name in names:
            with suppress(OSError):
                total += (Path(parent) / name).stat().st_size
    return total
