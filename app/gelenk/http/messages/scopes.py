"""The one table of the scope that each operation needs.

No scope includes another: a key for the metrics needs `admin`, and `admin` alone can neither compute nor change
anything.
"""

from enum import StrEnum
from typing import Any

from gelenk.contract.endpoints import ROBOT_ENDPOINTS


class Scope(StrEnum):
    """A permission that a key grants."""

    READ = "read"
    WRITE = "write"
    ADMIN = "admin"


OPEN_OPERATIONS = frozenset({"health", "readiness"})
OPEN_PATHS = frozenset(
    {"/", "/studio", "/docs", "/redoc", "/documentation/bundles", "/documentation/own", "/openapi.json"}
)
"""Pages, their files and the schema: the same for everyone, and a browser sends no key for them."""
WRITING = frozenset({"add_robot", "replace_robot", "remove_robot", "workspace", "cancel_job"})
AS_JOBS = frozenset(endpoint.operation_id or endpoint.name for endpoint in ROBOT_ENDPOINTS if endpoint.job)
"""Operations that only query, unless run as a job: a job is stored and needs `write`."""
ADMINISTERING = frozenset({"metrics"})
QUESTIONS = frozenset({"Kinematics", "DH tables", "Course"})
"""Tags of operations that store nothing, whatever their method, unless they are named above."""

SCHEME = {
    "type": "http",
    "scheme": "bearer",
    "description": "A key of this service, if keys are switched on; create one with `gelenk.keys`. Scopes: `read` "
    "allows queries, `write` storing and removing robots and jobs, `admin` reading the metrics. No scope includes "
    "another.",
}


def scope_of(operation_id: str | None, path: str, methods: frozenset[str], tags: frozenset[str]) -> Scope | None:
    """Return the scope that an operation needs; None if it needs no key.

    Methods other than GET and HEAD need `write` unless known to store nothing: new operations are protected.
    """
    if operation_id in OPEN_OPERATIONS or path in OPEN_PATHS:
        return None
    if operation_id in ADMINISTERING:
        return Scope.ADMIN
    if operation_id in WRITING:
        return Scope.WRITE
    return Scope.READ if methods <= {"GET", "HEAD"} or tags & QUESTIONS else Scope.WRITE


def security_of(path: str, method: str, operation: dict[str, Any]) -> list[dict[str, list[str]]]:
    """Return the security requirement of an operation for the OpenAPI document."""
    tags = frozenset(operation.get("tags", ()))
    scope = scope_of(operation.get("operationId"), path, frozenset({method.upper()}), tags)
    return [] if scope is None else [{"key": [scope.value]}]
