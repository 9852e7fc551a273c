"""What a job is, from its beginning to its end."""

import dataclasses
from dataclasses import asdict, dataclass, field, replace
from typing import Any, Literal, TypeAlias

import orjson

from gelenk import errors
from gelenk.errors import JobFailed, KinematicsError

State: TypeAlias = Literal["queued", "running", "succeeded", "failed", "cancelled"]

FINAL: frozenset[State] = frozenset({"succeeded", "failed", "cancelled"})
"""States that never change again."""


@dataclass(frozen=True, slots=True)
class Failure:
    """Why a job failed, as it can be kept on disk.

    Attributes:
        error: Name of the class of the error.
        detail: Its sentence.
        facts: Its typed data.
    """

    error: str
    detail: str
    facts: dict[str, Any] = field(default_factory=dict)

    @classmethod
    def of(cls, error: KinematicsError) -> "Failure":
        """Keep an error."""
        return cls(type(error).__name__, error.detail, error.facts())

    def error_again(self) -> KinematicsError:
        """The error as it was raised; only its sentence if its class no longer exists."""
        cls = getattr(errors, self.error, None)
        if isinstance(cls, type) and issubclass(cls, KinematicsError):
            names = {entry.name for entry in dataclasses.fields(cls)}
            if names == set(self.facts):
                return cls(**self.facts)
        return JobFailed(self.detail)

    @classmethod
    def because(cls, reason: str) -> "Failure":
        """A failure that no error of the core explains."""
        return cls.of(JobFailed(reason))


@dataclass(frozen=True, slots=True)
class JobRecord:
    """A job.

    Attributes:
        id: Its name.
        kind: What it computes.
        digest: Of the request, which tells whether another one of the same name is the same.
        owner: Which process of the service does it.
        created: When it was submitted, [s] since 1970.
        state: Where it is.
        progress: From 0 to 1.
        started: When it was started, [s] since 1970.
        finished: When it came to a final state, likewise.
        failure: Why it failed, where it did.
        attempts: How often it was started without getting further than the time before.
        robot_digest: SHA-256 of the description of the robot that it is about.
        number: Its place among all jobs in the order in which they came, from 1 on: clocks are set, also back.
        client: The client that requested it; empty where clients are not distinguished.
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
        """Whether it will never change again."""
        return self.state in FINAL

    def to_row(self) -> dict[str, Any]:
        """Return the job's row in the table of jobs, by column."""
        failure = None if self.failure is None else orjson.dumps(asdict(self.failure), default=str).decode()
        return {**asdict(self), "number": self.number or None, "failure": failure}

    @classmethod
    def from_row(cls, row: dict[str, Any]) -> "JobRecord":
        """Return the job of a row made by `to_row`; any other row raises TypeError or ValueError."""
        job = cls(**row)
        return job if job.failure is None else replace(job, failure=Failure(**orjson.loads(row["failure"])))
