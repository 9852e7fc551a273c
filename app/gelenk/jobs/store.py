"""The jobs of all processes of the service: one table, and for each job a folder with its request and results.

A process that cancels a job writes this to the table, and the process that runs the job reads it at its next step. Each
process of the service locks a file of its own for as long as it lives; if it ends, another one takes up its jobs. A job
exists while it has both a row and a folder: removing the folder by hand removes the job.
"""

import logging
import os
import re
import shutil
import time
import uuid
from collections import Counter
from collections.abc import Callable, Mapping
from contextlib import suppress
from dataclasses import replace
from pathlib import Path
from typing import IO, Any

from gelenk.errors import JobExists, JobInterrupted, StorageFailed, TooManyJobs, UnknownJob
from gelenk.jobs.database import NAMED, Database, import_earlier
from gelenk.jobs.job import JobRecord, Owners
from gelenk.jobs.limits import JobLimits
from gelenk.jobs.parts import Parts
from gelenk.jobs.robot_files import robot_digest
from gelenk.store import folders

_NAME = re.compile(r"[A-Za-z0-9][A-Za-z0-9_.-]{0,63}")
_OWNERS, _DATABASE = ".owners", ".database"
_ALL = "SELECT * FROM jobs ORDER BY number"
_FINISHED = "SELECT * FROM jobs WHERE finished IS NOT NULL ORDER BY number"
_UNFINISHED = "SELECT * FROM jobs WHERE finished IS NULL ORDER BY number"
_OWN = "SELECT * FROM jobs WHERE client = ? AND number < ? ORDER BY number DESC"
_REQUEST = "request"
_SURE_SECONDS = 24 * 3600.0
"""How long a job must have been too old, by the monotonic clock, before it is removed for its age, [s]."""
_AT_REST = 60.0
"""How long after the end of a job other processes than its owner may tidy its folder, [s]."""
_PAUSE = 5
"""Delay after which a client should retry if too many jobs are unfinished, [s]."""

logger = logging.getLogger("gelenk")


class JobStore:
    """All jobs below a folder on a local disk, created on the first write; safe in many threads and processes."""

    def __init__(self, root: Path, limits: JobLimits) -> None:
        self._root, self._limits = root, limits
        self._owners = Owners(root / _OWNERS)
        self._database = Database(root / _DATABASE)
        self._too_old: dict[tuple[str, float], float] = {}

    def prepare(self) -> None:
        """Remove what interrupted writers and dead processes left behind, and import jobs of earlier versions."""
        if not self._root.is_dir():
            return
        try:
            with folders.exclusive(self._root):
                folders.sweep(self._root)
                import_earlier(self._root, self._database)
                self._owners.sweep()
        except StorageFailed as error:
            logger.warning("jobs cannot be written: %s", error.reason)

    def close(self) -> None:
        """Close the table, and release the lock that shows that this process is alive."""
        self._database.close()
        self._owners.release()

    def add(
        self, kind: str, digest: str, request: Mapping[str, bytes], job_id: str | None = None, client: str = ""
    ) -> tuple[JobRecord, bool]:
        """Add a job, or find the one with the same id and request; return it, and whether it is new.

        A new job is on disk when this returns, with the files of its request by name, from which it can be run at any
        time. It replaces one that failed with `JobInterrupted`; its id is random if omitted. Raises JobExists if a job
        with another request has the id, TooManyJobs if too many are unfinished, and StorageFailed.
        """
        with folders.exclusive(self._root):
            folders.sweep(self._root)
            self._owners.register()
            found = None if job_id is None else self._find(job_id)
            if found is not None and found.digest != digest:
                raise JobExists(found.id)
            if found is not None and not (found.failure and found.failure.error == JobInterrupted.__name__):
                return self._as_seen(found), False
            self.check_room(client)
            self._remove_oldest()
            name = job_id or uuid.uuid4().hex
            job = JobRecord(name, kind, digest, self._owners.own_name, time.time(), client=client)
            with self._database.transaction():
                job = self._database.put(replace(job, robot_digest=robot_digest(request)))
            with suppress(FileNotFoundError):
                folders.remove_folder(self._root, name)
            folders.create_folder(self._root, name, {f"{_REQUEST}/{file}": request[file] for file in request})
        return job, True

    def take_up(self) -> list[JobRecord]:
        """Take over the unfinished jobs of processes that have ended, and return them, the oldest first."""
        if not any(self._is_left(job) for job in self._jobs(_UNFINISHED)):
            return []
        with folders.exclusive(self._root):
            self._owners.register()
            with self._database.transaction():
                left = [job for job in self._jobs(_UNFINISHED) if self._is_left(job)]
                return [self._database.put(replace(job, owner=self._owners.own_name, state="queued")) for job in left]

    def tidy(self) -> None:
        """Remove finished jobs that are too old, and files that other finished jobs no longer need.

        A clock set forward by mistake would make all jobs too old at once. So a job is removed only after it has been
        too old for a day, which leaves time to correct the clock.
        """
        now, since = time.time(), self._too_old
        self._too_old = {}
        for job in self._jobs(_FINISHED):
            age = now - (job.finished or now)
            with suppress(UnknownJob):
                if age > self._limits.kept_seconds:
                    which = job.id, job.created
                    self._too_old[which] = since.get(which, time.monotonic())
                    if time.monotonic() >= self._too_old[which] + _SURE_SECONDS:
                        self.remove(job.id)
                if age > _AT_REST:
                    self.clear(job)
        self._forget_removed()

    def clear(self, job: JobRecord) -> None:
        """Remove the request and the parts of a job that has ended; its results stay."""
        self.parts(job).clear()
        shutil.rmtree(self.request(job.id), ignore_errors=True)

    def get(self, job_id: str) -> JobRecord:
        """Return the current record of a job; raises UnknownJob if no job has this id."""
        return self._as_seen(self._same(job_id))

    def newest(self, client: str, limit: int, before: int) -> list[JobRecord]:
        """Return the latest jobs of a client whose `number` is below a number, the newest first."""
        return [self._as_seen(job) for job in self._jobs(_OWN, client, str(before))[:limit]]

    def start(self, job: JobRecord) -> JobRecord:
        """Record the start of a job; see `change`."""
        started = job.started or max(time.time(), job.created)
        return self.change(job, state="running", started=started, attempts=job.attempts + 1)

    def change(self, which: JobRecord | str, **changes: Any) -> JobRecord:
        """Change fields of an unfinished job, and return it; a finished job is not changed.

        A new state is on disk when this returns; a crash of the machine may lose other changes. A record in place of an
        id excludes a new job that has the same id. Raises UnknownJob if the job does not exist or another process owns
        it now, and StorageFailed.
        """
        job = self._same(which)
        if job.is_final or job == replace(job, **changes):
            return job
        with self._database.transaction(is_durable="state" in changes):
            job = self._same(which)
            if not job.is_final:
                job = replace(job, **changes)
                finished = max(time.time(), job.started or job.created) if job.is_final else None
                job = self._database.put(replace(job, finished=finished))
        return job

    def remove(self, job_id: str) -> None:
        """Remove a job and its results; raises UnknownJob if no job has this id."""
        with folders.exclusive(self._root):
            self._remove(self._same(job_id))

    def folder(self, job_id: str) -> Path:
        """Return the folder with a job's results."""
        return self._root / job_id

    def request(self, job_id: str) -> Path:
        """Return the folder with a job's request; it exists until the job has ended."""
        return self.folder(job_id) / _REQUEST

    def parts(self, job: JobRecord) -> Parts:
        """Return the finished parts of a job."""
        return Parts(self.folder(job.id), job.digest, self._limits.job_bytes)

    def states(self) -> Counter[str]:
        """Count the jobs by state."""
        return Counter(self._as_seen(job).state for job in self._jobs())

    def check_room(self, client: str) -> None:
        """Raise TooManyJobs unless a client may submit another job; called before any costly work for it.

        If no other client has unfinished jobs, the client may have `unfinished` of them, otherwise half as many. All
        clients together may have one and a half times `unfinished`, which leaves room for clients that come later.
        """
        clients = [job.client for job in self._jobs(_UNFINISHED)]
        own, half = clients.count(client), max(1, self._limits.unfinished // 2)
        most = self._limits.unfinished if own == len(clients) else half
        if own >= most:
            raise TooManyJobs(own, most, _PAUSE, "client")
        if len(clients) >= self._limits.unfinished + half:
            raise TooManyJobs(len(clients), self._limits.unfinished + half, _PAUSE, "service")

    def _as_seen(self, job: JobRecord) -> JobRecord:
        """Return a job as others see it: queued if its process has ended."""
        return replace(job, state="queued") if self._is_left(job) else job

    def _is_left(self, job: JobRecord) -> bool:
        return not (job.is_final or self._owners.is_alive(job.owner))

    def _jobs(self, query: str = _ALL, *values: str) -> list[JobRecord]:
        """Return the jobs that a query finds, except those without a folder or with a damaged id."""
        found = self._database.read(query, *values)
        return [job for job in found if _NAME.fullmatch(job.id) and self.folder(job.id).is_dir()]

    def _find(self, job_id: str) -> JobRecord | None:
        return next(iter(self._jobs(NAMED, job_id)), None) if _NAME.fullmatch(job_id) else None

    def _same(self, which: JobRecord | str) -> JobRecord:
        """Return the current record of a job; UnknownJob if it is missing or, given a record, is not the same job."""
        job_id, known = (which, None) if isinstance(which, str) else (which.id, which)
        found = self._find(job_id)
        if found is None or (known and (found.owner, found.created) != (known.owner, known.created)):
            raise UnknownJob(job_id)
        return found

    def _remove(self, job: JobRecord) -> None:
        """Remove a job, even on a full disk: without its folder it no longer exists, whatever happens to its row."""
        folders.remove_folder(self._root, job.id)
        with suppress(StorageFailed), self._database.transaction(is_durable=False):
            self._database.delete(job.id)

    def _remove_oldest(self) -> None:
        """Remove the oldest finished jobs until the limits allow one more job."""
        jobs = self._jobs()
        sizes = {job.id: _size(self.folder(job.id)) for job in jobs}
        count, total = len(jobs), sum(sizes.values())
        for job in jobs:
            if count < self._limits.kept and total <= self._limits.kept_bytes:
                return
            if job.is_final:
                self._remove(job)
                count, total = count - 1, total - sizes[job.id]

    def _forget_removed(self) -> None:
        """Delete the rows of jobs whose folders were removed by hand."""
        for job in self._database.read(_ALL):
            if not self.folder(job.id).is_dir():
                with folders.exclusive(self._root), self._database.transaction(is_durable=False):
                    if not self.folder(job.id).is_dir():  # else `add` was just creating it
                        self._database.delete(job.id)


def write_result(folder: Path, name: str, content: Callable[[IO[bytes]], object]) -> None:
    """Write a result file, on disk when this returns; it is not read before the job has succeeded.

    Raises UnknownJob if the job has been removed, and StorageFailed.
    """
    with folders.writing():
        try:
            with (folder / name).open("wb") as target:
                content(target)
                target.flush()
                os.fsync(target.fileno())
            folders.sync(folder)
        except FileNotFoundError:
            raise UnknownJob(folder.name) from None
        except OSError:
            (folder / name).unlink(missing_ok=True)
            raise


def _size(folder: Path) -> int:
    total = 0
    for parent, _, names in os.walk(folder):  # tolerates folders that are removed meanwhile
        for name in names:
            with suppress(OSError):
                total += (Path(parent) / name).stat().st_size
    return total
