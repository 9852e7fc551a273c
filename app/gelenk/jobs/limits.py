"""The limits on jobs, which other limits refer to: apart from the store, with its database."""

from dataclasses import dataclass


@dataclass(frozen=True, slots=True)
class JobLimits:
    """Limits on the jobs of a store.

    Attributes:
        kept: Number of jobs, including finished ones; the oldest finished ones are removed first.
        kept_bytes, job_bytes: Sizes of the folders of all jobs, and of the finished parts of one job, [bytes].
        unfinished: Number of unfinished jobs of one client; see `JobStore.check_room` for several clients.
        kept_seconds: How long a finished job is kept, [s].
    """

    kept: int = 100
    kept_bytes: int = 2 * 1024**3
    unfinished: int = 16
    job_bytes: int = 1024**3
    kept_seconds: float = 30 * 24 * 3600.0
