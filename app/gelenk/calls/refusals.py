"""A problem on the wire, turned back into the core's own exception."""

from collections.abc import Mapping
from dataclasses import MISSING, fields
from functools import cache
from typing import Any

from gelenk.model.errors import KinematicsError, kinds

KIND_PREFIX = "urn:gelenk:"
_STANDARD = frozenset({"type", "title", "status", "detail", "instance", "request_id"})


class Refused(KinematicsError):
    """The service refuses a call.

    What the core refuses is an instance of the core's class too, with its data: `except UnknownFrame as error` finds
    `error.known`.

    Attributes:
        problem: As it came (RFC 9457).
    """

    def __init__(self, problem: Mapping[str, Any]) -> None:
        self.problem = dict(problem)
        if type(self) is not Refused:
            facts = self.facts()
            for field in fields(self):
                absent = None if field.default is MISSING else field.default  # an older service tells less
                setattr(self, field.name, _frozen(facts.get(field.name, absent)))

    @property
    def detail(self) -> str:
        """The service's sentence."""
        return str(self.problem.get("detail", "the service refuses the call without a reason"))

    @property
    def status(self) -> int:
        """The status of HTTP."""
        return int(self.problem.get("status", 0))

    @property
    def kind(self) -> str:
        """Such as `unknown-frame`."""
        return str(self.problem.get("type", "")).removeprefix(KIND_PREFIX)

    def facts(self) -> dict[str, object]:
        """What the service tells beside the sentence."""
        return {name: value for name, value in self.problem.items() if name not in _STANDARD}

    def __reduce__(self) -> tuple[object, ...]:
        return refusal, (self.problem,)


class NotAnswering(KinematicsError):
    """The service cannot be reached, or breaks off."""

    def __init__(self, url: str, reason: str) -> None:
        self.url, self.reason = url, reason

    @property
    def detail(self) -> str:
        """Where it was looked for, and what went wrong."""
        return f"no answer from {self.url}: {self.reason}"

    def facts(self) -> dict[str, object]:
        """Both parts of the sentence."""
        return {"url": self.url, "reason": self.reason}

    def __reduce__(self) -> tuple[object, ...]:
        return type(self), (self.url, self.reason)


def refusal(problem: Mapping[str, Any]) -> Refused:
    """The exception for a problem."""
    kind = str(problem.get("type", "")).removeprefix(KIND_PREFIX)
    return _classes().get(kind, Refused)(problem)


@cache
def _classes() -> dict[str, type[Refused]]:
    """By kind: each class of the core as a refusal."""
    return {kind: type(core.__name__, (Refused, core), {}) for kind, core in kinds().items()}


def _frozen(value: Any) -> Any:
    return tuple(_frozen(item) for item in value) if isinstance(value, list) else value
