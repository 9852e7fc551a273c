"""The record of a job, and why it failed, in forms that can be stored."""

import dataclasses
from dataclasses import asdict, dataclass, field, replace
from typing import Any, Literal, TypeAlias

import orjson

from gelenk import errors
from gelenk.errors import JobFailed, KinematicsError

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
