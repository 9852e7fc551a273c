"""The table of jobs: one SQLite file with a write-ahead log, which every process of the service reads and writes.

The file must be on a local disk, because the processes share memory through a file beside it. A damaged file is moved
aside when it is opened, and replaced by an empty one.
"""

import errno
import logging
import os
import sqlite3
import stat
import threading
import uuid
from collections.abc import Iterator
from contextlib import closing, contextmanager, suppress
from dataclasses import replace
from pathlib import Path

import orjson

from gelenk.errors import StorageFailed, StorageFull
from gelenk.jobs.job import JobRecord
from gelenk.store import folders

NAMED = "SELECT * FROM jobs WHERE id = ?"
_FILES = "jobs.sqlite", "jobs.sqlite-wal", "jobs.sqlite-shm", "jobs.sqlite-journal"
"""Names of the file, and of those that SQLite keeps beside it."""
_EARLIER = "job.json"
"""Name of the file of a job in earlier versions."""
_BUSY_SECONDS = 20.0
"""Longest wait for a transaction of another process, which normally takes milliseconds, [s]."""
_TABLE = """
CREATE TABLE IF NOT EXISTS jobs (
    number INTEGER PRIMARY KEY, id TEXT NOT NULL UNIQUE, kind TEXT NOT NULL, digest TEXT NOT NULL, owner TEXT NOT NULL,
    created REAL NOT NULL, state TEXT NOT NULL, progress REAL NOT NULL, started REAL, finished REAL, failure TEXT,
    attempts INTEGER NOT NULL, client TEXT NOT NULL, robot_digest TEXT
)
"""
_PUT = """
INSERT OR REPLACE INTO jobs VALUES (
    :number, :id, :kind, :digest, :owner, :created, :state, :progress, :started, :finished, :failure,
    :attempts, :client, :robot_digest
)
"""
_ERRORS = sqlite3.Error, TypeError, ValueError
"""Errors of SQLite, and of Python if damage has made values or messages unreadable."""
_DAMAGE = {sqlite3.SQLITE_CORRUPT, sqlite3.SQLITE_NOTADB, sqlite3.SQLITE_ERROR}

logger = logging.getLogger("gelenk")


class Database:
    """The table of jobs; safe to use from many threads and processes; its folder is created on the first write."""

    def __init__(self, folder: Path) -> None:
        self._folder, self._path = folder, folder / _FILES[0]
        self._lock = threading.RLock()
        self._connection: sqlite3.Connection | None = None
        self._inode: int | None = None

    def close(self) -> None:
        """Close the file; the next use opens it again."""
        with self._lock:
            if self._connection is not None:
                self._connection.close()
            self._connection = None

    def read(self, query: str, *values: str) -> list[JobRecord]:
        """Return the jobs that a SELECT finds, or raise StorageFailed; `values` replace its question marks."""
        if _inode(self._path) is None:
            return []
        with self._lock, self._translating():
            try:
                return _jobs(self._open(), query, values)
            except (StorageFailed, sqlite3.OperationalError):  # the disk is read-only or full
                with closing(self._open_read_only()) as connection:
                    return _jobs(connection, query, values)

    @contextmanager
    def transaction(self, is_durable: bool = True) -> Iterator[None]:
        """Run the context as one transaction, which excludes all other writers; if durable, it is then on disk.

        Raises StorageFailed, or StorageFull without room on the disk.
        """
        with self._lock, self._translating():
            connection = self._open()
            connection.execute(f"PRAGMA synchronous = {'FULL' if is_durable else 'NORMAL'}")
            with connection:
                connection.execute("BEGIN IMMEDIATE")
                yield

    def put(self, job: JobRecord) -> JobRecord:
        """Insert a job within a transaction, or replace the one with its id; return it with its number."""
        return replace(job, number=self._open().execute(_PUT, job.to_row()).lastrowid or 0)

    def delete(self, job_id: str) -> None:
        """Delete a job within a transaction."""
        self._open().execute("DELETE FROM jobs WHERE id = ?", (job_id,))

    def _open(self) -> sqlite3.Connection:
        """Return a connection to the file; create the file if missing, and reopen it if it was removed or moved."""
        if self._connection is not None and self._inode == _inode(self._path):
            return self._connection
        self.close()
        with folders.exclusive(self._folder):
            try:
                self._connection = self._connect()
            except _ERRORS as error:
                if _code(error) not in _DAMAGE:
                    raise
                self._set_aside(error)
                self._connection = self._connect()
            self._inode = _inode(self._path)
        return self._connection

    def _connect(self) -> sqlite3.Connection:
        """Open the file, create the table if missing, and check both for damage."""
        self._check_plain()
        connection = sqlite3.connect(self._path, _BUSY_SECONDS, isolation_level=None, check_same_thread=False)
        try:
            connection.execute("PRAGMA journal_mode = WAL")
            connection.execute(_TABLE)
            ((found,),) = connection.execute("PRAGMA integrity_check(1)")
            if found != "ok":
                raise sqlite3.DatabaseError(found)
            _jobs(connection, "SELECT * FROM jobs", ())
        except BaseException:
            connection.close()
            raise
        return connection

    def _open_read_only(self) -> sqlite3.Connection:
        """Open the file on a disk that is read-only or full; without a log, no shared memory is needed."""
        self._check_plain()
        log = self._folder / _FILES[1]
        how = "mode=ro" if log.exists() and log.stat().st_size else "immutable=1"
        return sqlite3.connect(f"{self._path.absolute().as_uri()}?{how}", uri=True)

    def _check_plain(self) -> None:
        """Raise an error if a pipe, a link or the like replaces one of the files: SQLite might block on it."""
        for name in _FILES:
            with suppress(FileNotFoundError):
                if not stat.S_ISREG((self._folder / name).lstat().st_mode):
                    raise sqlite3.DatabaseError(f"{name} is not a plain file")

    def _set_aside(self, error: Exception) -> None:
        """Move the files into a new folder; other processes that have them open notice this in `_open`."""
        aside = self._folder / f"damaged-{uuid.uuid4().hex}"
        logger.warning("the jobs in %s are lost, and the file is moved to %s: %s", self._path, aside, error)
        aside.mkdir()
        for name in _FILES:
            with suppress(FileNotFoundError):
                (self._folder / name).rename(aside / name)

    @contextmanager
    def _translating(self) -> Iterator[None]:
        """Convert errors to `StorageFailed` and close the file: the next use reopens it and checks it for damage."""
        try:
            yield
        except _ERRORS as error:
            self.close()
            if _code(error) == sqlite3.SQLITE_FULL:
                raise StorageFull(os.strerror(errno.ENOSPC)) from error
            folders.probe(self._folder)  # raises the system's more specific error if the disk is at fault
            raise StorageFailed(str(error)) from error


def import_earlier(root: Path, database: Database) -> None:
    """Move the records of jobs from earlier versions, each a file in its folder, into the table; other files stay."""
    jobs = [job for path in root.glob(f"*/{_EARLIER}") if (job := _earlier(path)) is not None]
    if jobs:
        with database.transaction():
            for job in sorted(jobs, key=lambda job: (job.number, job.created)):
                if not database.read(NAMED, job.id):  # else an earlier import ended before it removed the file
                    database.put(replace(job, number=0))
    for job in jobs:
        folders.sweep(root / job.id)
        folders.discard(root / job.id / _EARLIER)


def _earlier(path: Path) -> JobRecord | None:
    with suppress(OSError, ValueError, TypeError, KeyError):
        row = orjson.loads(folders.read_plain(path))
        job = JobRecord.from_row({**row, "failure": row["failure"] and orjson.dumps(row["failure"])})
        return job if job.id == path.parent.name else None
    return None


def _jobs(connection: sqlite3.Connection, query: str, values: tuple[str, ...]) -> list[JobRecord]:
    rows = connection.execute(query, values)
    names = [column[0] for column in rows.description]
    return [JobRecord.from_row(dict(zip(names, row, strict=True))) for row in rows]


def _code(error: Exception) -> int:
    """Return SQLite's primary code of an error; an error without a code means damage."""
    return getattr(error, "sqlite_errorcode", sqlite3.SQLITE_CORRUPT) & 0xFF


def _inode(path: Path) -> int | None:
    """Return the inode of a file, which differs from that of its replacement; None if the file is missing."""
    try:
        return path.lstat().st_ino
    except (FileNotFoundError, NotADirectoryError):
        return None
