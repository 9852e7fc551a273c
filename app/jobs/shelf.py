"""Jobs as folders, which every process of the service reads and writes.

What stands in a folder's `job.json` is the truth: a process that cancels a job writes so there, and the one that does
it finds that out at its next step. Each process of the service holds a locked file as long as it lives; a job whose
process is gone has failed, and whoever looks at it first says so. Results stay over a restart, unfinished jobs do not.
"""

import fcntl
import logging
import os
import re
import time
import uuid
from collections import Counter
from collections.abc import Callable
from contextlib import suppress
from dataclasses import dataclass, replace
from pathlib import Path
from typing import IO, Any

from app.jobs.job import Failure, Job
from app.model.errors import JobExists, JobInterrupted, StorageFailed, TooManyJobs, UnknownJob
from app.store import folders

JOB_FILE = "job.json"
_NAME = re.compile(r"[A-Za-z0-9][A-Za-z0-9_.-]{0,63}")
_OWNERS = ".owners"
_PAUSE = 5
"""After how many seconds it is worth while to ask again where too many jobs wait."""

logger = logging.getLogger("gelenk")


@dataclass(frozen=True, slots=True)
class Limits:
    """How much is kept, and waits.

    Attributes:
        kept: Jobs, finished ones included; the oldest finished ones go first.
        kept_bytes: Of all of them.
        unfinished: Jobs that wait or run.
    """

    kept: int = 100
    kept_bytes: int = 2 * 1024**3
    unfinished: int = 16


class Shelf:
    """All jobs below a folder; safe to use from many threads and processes.

    Args:
        root: The folder; made when first written to.
        limits: How much it holds.
    """

    def __init__(self, root: Path, limits: Limits) -> None:
        self._root, self._limits = root, limits
        self._owner = uuid.uuid4().hex
        self._lock: IO[str] | None = None

    def prepare(self) -> None:
        """Remove what interrupted writers, and processes that are gone, have left; what is read-only stays."""
        if not self._root.is_dir():
            return
        try:
            with folders.exclusive(self._root):
                for folder in (self._root, *(path.parent for path in self._root.glob(f"*/{JOB_FILE}"))):
                    folders.sweep(folder)
                for lock in (self._root / _OWNERS).glob("*"):
                    if not self._lives(lock.name):
                        lock.unlink(missing_ok=True)
        except StorageFailed as error:
            logger.warning("jobs cannot be written: %s", error.reason)

    def close(self) -> None:
        """Give up what says that this process lives."""
        if self._lock is not None:
            self._lock.close()
            (self._root / _OWNERS / self._owner).unlink(missing_ok=True)
            self._lock = None

    def add(self, kind: str, digest: str, job_id: str | None = None) -> tuple[Job, bool]:
        """A new job, or the one that stands under its name already for the same request.

        One that the end of its service has interrupted begins anew.

        Returns:
            The job, and whether it is new.

        Raises:
            JobExists: The name stands for another request.
            TooManyJobs: So many wait that this one has to be asked for later.
            StorageFailed: It cannot be written.
        """
        with folders.exclusive(self._root):
            folders.sweep(self._root)
            self._say_alive()
            if job_id is not None and (found := self._read(job_id)) is not None:
                if found.digest != digest:
                    raise JobExists(job_id)
                if not self._was_interrupted(found):
                    return found, False
            self._make_room()
            if job_id is not None and self._read(job_id) is not None:
                folders.remove_folder(self._root, job_id)
            job = Job(job_id or uuid.uuid4().hex, kind, digest, self._owner, time.time())
            folders.create_folder(self._root, job.id, {JOB_FILE: job.as_bytes()})
        return job, True

    def get(self, job_id: str) -> Job:
        """A job as it stands.

        Raises:
            UnknownJob: There is none of this name.
        """
        job = self._read(job_id)
        if job is None:
            raise UnknownJob(job_id)
        if job.is_final or self._lives(job.owner):
            return job
        lost = Failure.of(JobInterrupted("the process of the service that did it has ended"))
        return self.change(job_id, state="failed", failure=lost)

    def change(self, which: Job | str, **changes: Any) -> Job:
        """Change fields of a job that is not finished; a finished one stays as it is.

        Args:
            which: The job by its name; or that very job, and not one that has its name by now.
            changes: The fields.

        Returns:
            The job as it stands then.

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
            job = replace(job, **changes)
            if job.is_final:
                job = replace(job, finished=time.time())
            # How far a job is need not outlive the machine.
            folders.replace_file(self._root / job_id, JOB_FILE, job.as_bytes(), is_durable=job.is_final)
        return job

    def write(self, job_id: str, name: str, content: Callable[[IO[bytes]], object]) -> None:
        """Write a result; on disk when this returns, and read by nobody before the job says that it has succeeded.

        Raises:
            UnknownJob: The job was removed meanwhile.
            StorageFailed: It cannot be written.
        """
        with folders.writing():
            try:
                with (self._root / job_id / name).open("wb") as target:
                    content(target)
                    target.flush()
                    os.fsync(target.fileno())
            except FileNotFoundError:
                raise UnknownJob(job_id) from None

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

    def file(self, job_id: str, name: str) -> Path:
        """Where a result of a job is, or will be."""
        return self._root / job_id / name

    def states(self) -> Counter[str]:
        """How many jobs there are, by state."""
        try:
            return Counter(job.state for job in self._jobs())
        except FileNotFoundError:
            return Counter()

    def _read(self, job_id: str) -> Job | None:
        if not _NAME.fullmatch(job_id):
            return None
        try:
            return Job.from_bytes((self._root / job_id / JOB_FILE).read_bytes())
        except (FileNotFoundError, NotADirectoryError, ValueError, TypeError):
            return None

    def _jobs(self) -> list[Job]:
        """All jobs, the oldest first."""
        found = [self._read(path.name) for path in self._root.iterdir() if not path.name.startswith(".")]
        return sorted((job for job in found if job is not None), key=lambda job: job.created)

    def _make_room(self) -> None:
        """Drop the oldest finished jobs beyond what is kept.

        Raises:
            TooManyJobs: There are too many unfinished ones.
        """
        jobs = self._jobs()
        unfinished = [job for job in jobs if not job.is_final and self._lives(job.owner)]
        if len(unfinished) >= self._limits.unfinished:
            raise TooManyJobs(len(unfinished), self._limits.unfinished, _PAUSE)
        sizes = {job.id: _size(self._root / job.id) for job in jobs}
        count, total = len(jobs), sum(sizes.values())
        waiting = {job.id for job in unfinished}
        for job in jobs:
            if count < self._limits.kept and total <= self._limits.kept_bytes:
                return
            if job.id not in waiting:
                folders.remove_folder(self._root, job.id)
                count, total = count - 1, total - sizes[job.id]

    def _say_alive(self) -> None:
        if self._lock is None:
            owners = self._root / _OWNERS
            owners.mkdir(exist_ok=True)
            self._lock = (owners / self._owner).open("w")
            fcntl.flock(self._lock, fcntl.LOCK_EX)

    def _was_interrupted(self, job: Job) -> bool:
        """Whether it has no result because its process of the service came to its end before it did."""
        if job.is_final:
            return job.failure is not None and job.failure.error == JobInterrupted.__name__
        return not self._lives(job.owner)

    def _lives(self, owner: str) -> bool:
        """Whether a process of the service is there: the system lets go of its lock when it ends."""
        if owner == self._owner:
            return self._lock is not None
        try:
            with (self._root / _OWNERS / owner).open() as lock:
                fcntl.flock(lock, fcntl.LOCK_SH | fcntl.LOCK_NB)
        except BlockingIOError:
            return True
        except OSError:
            return False
        return False


def _size(folder: Path) -> int:
    """Bytes of the files in a folder."""
    total = 0
    for path in folder.iterdir():
        with suppress(OSError):
            total += path.stat().st_size
    return total
