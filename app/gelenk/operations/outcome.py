"""What an operation returns, and within which limits it computes."""

from collections.abc import Callable, Sequence
from dataclasses import dataclass
from typing import Any, Literal, TypeAlias

from gelenk.jobs.store import Limits as JobLimits
from gelenk.model.arrays import Array
from gelenk.operations.request_counts import RequestCounts

PictureFormat: TypeAlias = Literal["svg", "png"]


@dataclass(frozen=True, slots=True)
class Limits:
    """What an answer may take; the operator sets it.

    Attributes:
        answer_numbers: Numbers in one answer.
        seconds: How long a request may take; a search with a time limit of its own ends before.
        job_bytes: What the parts of a job may take on disk.
    """

    answer_numbers: int
    seconds: float
    job_bytes: int = JobLimits().job_bytes


@dataclass(frozen=True, slots=True)
class Outcome:
    """The result of a computation in the shapes that it can be sent in; each is made on demand.

    Attributes:
        content: For JSON.
        array: For npy, with headers for what the array cannot say; None where one array cannot hold the answer.
        picture: For an image, as `svg` or `png`.
        columns: Names of the array's columns, for CSV.
        solved: What the metrics count of inverse kinematics, by the number of targets.
    """

    content: Callable[[], Any]
    array: Callable[[], tuple[Array, dict[str, str]]] | None = None
    picture: Callable[[PictureFormat], bytes] | None = None
    columns: Sequence[str] | None = None
    solved: Callable[[int], RequestCounts] | None = None
