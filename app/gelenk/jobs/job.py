"""The record of a job, and why it failed, in forms that can be stored."""

import dataclasses
import fcntl
import uuid
from dataclasses import asdict, dataclass, field, replace
from pathlib import Path
from typing import IO, Any, Literal, TypeAlias

import orjson

from gelenk import errors
from gelenk.errors import JobFailed, KinematicsError
from gelenk.store.folders import is_locked, open_plain

State: TypeAlias = Literal["queued", "running", "succeeded", "failed", "cancelled"]

FINAL: frozenset[State] = frozenset({"succeeded", "failed", "cancelled"})
"""States that a job never leaves."""


@dataclass(frozen=True, slots=True)
class Failure:
    """The error with which a job failed, in a form that can be stored: class name, message, typed fields by name."""

    error: str
    detail: str
    facts: dict[str, Any] = field(default_factory=dict)

    @classmethod
    def of(cls, error: KinematicsError) -> "Failure":
        """Create the failure of an error."""
        return cls(type(error).__name__, error.detail, error.facts())

    def error_again(self) -> KinematicsError:
        """Return the original error; a `JobFailed` with its message if its class or fields no longer exist."""
        cls = getattr(errors, self.error, None)
        if isinstance(cls, type) and issubclass(cls, KinematicsError):
            names = {entry.name for entry in dataclasses.fields(cls)}
            if names == set(self.facts):
                return cls(**self.facts)
        return JobFailed(self.detail)


@dataclass(frozen=True, slots=True)
class JobRecord:
    """The stored record of a job.

    Attributes:
        digest: Digest of the request, to recognize a repeated request with the same id.
        owner: Name of the process of the service that runs the job, see `Owners`.
        created, started, finished: Times of submission, first start and final state, [s] since 1970.
        progress: Completed share, from 0 to 1.
        attempts: Number of starts, counted from the last one that made progress.
        number: Position in the order of submission, from 1; times cannot give it, because clocks can be set back.
        client: Client that submitted the job; empty if clients are not distinguished.
        robot_digest: SHA-256 of the URDF of the job's robot, if it has one.
    """

    id: str
    kind: str
    digest: str
    owner: str
    created: float
    state: State = "queued"
    progress: float = 0.0
    started: float | None = None
    finished: float | None = None
    failure: Failure | None = None
    attempts: int = 0
    number: int = 0
    client: str = ""
    robot_digest: str | None = None

    @property
    def is_final(self) -> bool:
        """Whether the state is final."""
        return self.state in FINAL

    def to_row(self) -> dict[str, Any]:
        """Return the job's row in the table of jobs, by column."""
        failure = None if self.failure is None else orjson.dumps(asdict(self.failure), default=str).decode()
        return {**asdict(self), "number": self.number or None, "failure": failure}

    @classmethod
    def from_row(cls, row: dict[str, Any]) -> "JobRecord":
        """Create the job from a row made by `to_row`; any other row raises TypeError or ValueError."""
        job = cls(**row)
        return job if job.failure is None else replace(job, failure=Failure(**orjson.loads(row["failure"])))


class Owners:
    """The processes of the service that own jobs, as seen by one of them; `register` creates their folder."""

    def __init__(self, folder: Path) -> None:
        self._folder = folder
        self._lock: IO[str] | None = None
        self.own_name = uuid.uuid4().hex

    def register(self) -> None:
        """Lock the file of this process; call this before the process owns a job."""
        if self._lock is None:
            self._folder.mkdir(exist_ok=True)
            self._lock = open_plain(self._folder / self.own_name, "w")
            fcntl.flock(self._lock, fcntl.LOCK_EX)

    def is_alive(self, name: str) -> bool:
        """Return whether the process with a name is alive."""
        return self._lock is not None if name == self.own_name else is_locked(self._folder / name)

    def sweep(self) -> None:
        """Remove the files of processes that have ended."""
        for lock in self._folder.glob("*"):
            if not self.is_alive(lock.name):
                lock.unlink(missing_ok=True)

    def release(self) -> None:
        """Release the lock of this process and remove its file."""
        if self._lock is not None:
            self._lock.close()
            (self._folder / self.own_name).unlink(missing_ok=True)
            self._lock = None
