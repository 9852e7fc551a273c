"""Jobs as JSON and as responses."""

from typing import Any

import orjson
from fastapi import Response

from gelenk.errors import kind_of
from gelenk.http.messages.payloads import JSON
from gelenk.jobs.job import JobRecord
from gelenk.logs import moment

NO_STORE = {"Cache-Control": "no-store"}


def job_response(job: JobRecord, status: int = 200, headers: dict[str, str] | None = None) -> Response:
    """Return a job as a response."""
    return Response(orjson.dumps(job_content(job)), status, {**NO_STORE, **(headers or {})}, JSON)


def job_content(job: JobRecord) -> dict[str, Any]:
    """Return a job as JSON content."""
    failure = job.failure
    content: dict[str, Any] = {
        "id": job.id,
        "kind": job.kind,
        "state": job.state,
        "progress": job.progress,
        "created": moment(job.created),
        "started": None if job.started is None else moment(job.started),
        "finished": None if job.finished is None else moment(job.finished),
        "attempts": job.attempts,
        "robot_digest": job.robot_digest,
        "error": None,
    }
    if failure is not None:
        kind = f"urn:gelenk:{kind_of(type(failure.error_again()))}"
        content["error"] = {"type": kind, "detail": failure.detail, "facts": failure.facts}
    return content
