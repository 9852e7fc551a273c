"""Turns a problem from the service back into the core's own exception."""

from collections.abc import Mapping, Sequence
from dataclasses import MISSING, fields
from difflib import get_close_matches
from functools import cache
from typing import Any

from gelenk.errors import KinematicsError, kinds

KIND_PREFIX = "urn:gelenk:"
_STANDARD = frozenset({"type", "title", "status", "detail", "instance", "request_id"})


class Refused(KinematicsError):
    """The service refuses a call.

    An error of the core is an instance of the core's class too, with its data: `except UnknownFrame as error` gives
    `error.known`.

    Attributes:
        problem: Problem as received (RFC 9457).
    """

    def __init__(self, problem: Mapping[str, Any]) -> None:
        self.problem = dict(problem)
        facts = self.facts()
        for field in fields(self):
            absent = None if field.default is MISSING else field.default  # an older service sends less
            setattr(self, field.name, _frozen(facts.get(field.name, absent)))

    @property
    def detail(self) -> str:
        """Sentence of the service."""
        return str(self.problem.get("detail", "the service refuses the call without a reason"))

    @property
    def status(self) -> int:
        """HTTP status."""
        return int(self.problem.get("status", 0))

    @property
    def kind(self) -> str:
        """Kind of the problem, such as `unknown-frame`."""
        return str(self.problem.get("type", "")).removeprefix(KIND_PREFIX)

    def facts(self) -> dict[str, object]:
        """Return the data of the problem besides its standard members."""
        return {name: value for name, value in self.problem.items() if name not in _STANDARD}

    def __reduce__(self) -> tuple[object, ...]:
        return refusal, (self.problem,)


class NotAnswering(KinematicsError):
    """The service cannot be reached, or breaks the connection."""

    url: str
    reason: str
    template = "no answer from {url}: {reason}"


class UnknownKeyword(TypeError):
    """A method of the client has no argument of this name; nothing was sent."""

    def __init__(self, method: str, name: str, known: Sequence[str]) -> None:
        near = get_close_matches(name, known, n=1)
        hint = f"did you mean {near[0]!r}?" if near else f"it has {', '.join(known)}"
        super().__init__(f"{method} has no argument {name!r}: {hint}")


def refusal(problem: Mapping[str, Any]) -> Refused:
    """Return the exception for a problem."""
    kind = str(problem.get("type", "")).removeprefix(KIND_PREFIX)
    return _classes().get(kind, Refused)(problem)


@cache
def _classes() -> dict[str, type[Refused]]:
    """Return each class of the core as a refusal, by kind."""
    own = {"__init__": Refused.__init__}
    return {kind: type(core.__name__, (Refused, core), own) for kind, core in kinds().items()}


def _frozen(value: Any) -> Any:
    return tuple(_frozen(item) for item in value) if isinstance(value, list) else value
