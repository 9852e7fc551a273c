"""The outcome of an operation, its counts for the metrics, and the limits of its computation."""

from collections.abc import Callable, Mapping, Sequence
from contextvars import ContextVar
from dataclasses import dataclass
from functools import partial, wraps
from typing import Any, Generic, Literal, NamedTuple, TypeAlias, TypeVar

from gelenk.contract.common import Payload
from gelenk.jobs.limits import JobLimits
from gelenk.language import Language, language
from gelenk.robot.arrays import Array
from gelenk.store.records import LoadedRobot


class RequestCounts(NamedTuple):
    """Counts of one call: its configurations or targets, and all iterations that led to the solutions."""

    batch: int
    verdicts: Mapping[str, int] = {}
    solutions: int = 0
    iterations: int = 0


REQUEST_COUNTS: ContextVar[RequestCounts | None] = ContextVar("request_counts", default=None)
"""Counts of the current request; None if there is nothing to count."""


PictureFormat: TypeAlias = Literal["svg", "png", "pdf"]
R = TypeVar("R")


@dataclass(frozen=True, slots=True)
class Limits:
    """Limits on the work for an answer, set by the operator.

    Attributes:
        answer_numbers: Maximum count of numbers in one answer.
        seconds: Time limit of a request, [s]; a search with a time limit of its own ends before.
        job_bytes: Maximum disk space of the parts of a job.
        job_samples: Maximum number of configurations of a workspace.
    """

    answer_numbers: int
    seconds: float
    job_bytes: int = JobLimits().job_bytes
    job_samples: int = 10_000_000


class Outcome(NamedTuple):
    """The result of a computation in the forms that it can be sent in; each is made on demand.

    Attributes:
        content: Returns the content for JSON.
        array: Returns the array for npy, and headers for what it cannot say; None if one array cannot hold the answer.
        picture: Draws the image, as `svg`, `png` or `pdf`.
        columns: Names of the array's columns, for CSV.
        programs: What makes the bytes of each further form, by media type.
        solved: Returns what the metrics count of inverse kinematics, by the number of targets.
    """

    content: Callable[[], Any]
    array: Callable[[], tuple[Array, dict[str, str]]] | None = None
    picture: Callable[[PictureFormat], bytes] | None = None
    columns: Sequence[str] | None = None
    solved: Callable[[int], RequestCounts] | None = None
    programs: Mapping[str, Callable[[], bytes]] = {}

    def spoken(self, code: Language) -> "Outcome":
        """Return the outcome with the texts of content and picture in a language."""
        if code == "en":
            return self
        picture = self.picture and language(code)(self.picture)
        return self._replace(content=language(code)(self.content), picture=picture)


def always(_: object) -> bool:
    """Return True: the `is_heavy` of an operation that never takes less than a millisecond."""
    return True


def json_only(content: Callable[[R], Any]) -> Callable[[R], Outcome]:
    """Return an operation that answers with nothing but the JSON content that a function makes of the request."""

    @wraps(content)
    def run(request: R) -> Outcome:
        return Outcome(partial(content, request))

    return run


_Request = TypeVar("_Request", bound=Payload)


@dataclass(frozen=True, slots=True)
class WarmUp(Generic[_Request]):
    """A fact to find out about a robot.

    Attributes:
        is_known: Checks whether this process knows it.
        find: Finds it, in another process, because that may take long or fail; the result must be picklable.
        keep: Stores it in this process; runs in a thread.
    """

    is_known: Callable[[LoadedRobot, _Request], bool]
    find: Callable[[LoadedRobot, _Request], object]
    keep: Callable[[LoadedRobot, _Request, Any], object]
