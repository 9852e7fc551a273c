"""The operations that can run as jobs, by the names of their endpoints."""

from typing import Any

from gelenk.http.jobs import inverse_job, motions_job, trajectory_job, workspace
from gelenk.http.jobs.long_work import LongWork

LONG_WORK: dict[str, LongWork[Any]] = {
    "ik": inverse_job.WORK,
    "trajectories": motions_job.WORK,
    "trajectory": trajectory_job.WORK,
    "workspace": workspace.WORK,
}
