"""Tasks for the worker pool: each is a function that answers a whole request in a worker process.

It must be a module-level function, because it is sent by name.
"""

from collections.abc import Callable, Sequence
from dataclasses import dataclass
from functools import lru_cache
from pathlib import Path
from pickle import PickleBuffer
from typing import TypeAlias

from starlette.responses import Response

from gelenk.http.messages.payloads import JSON
from gelenk.operations.outcome import REQUEST_COUNTS, Limits, RequestCounts
from gelenk.processes.wire import pieces_of
from gelenk.store.library import Library
from gelenk.store.quota import ROBOTS, Quota
from gelenk.store.scenes import Scenes


@dataclass(frozen=True, slots=True)
class Context:
    """What answers depend on besides the request; sent along with each task."""

    catalogue: Path
    uploads: Path
    limits: Limits
    scenes: Scenes
    quota: Quota = ROBOTS

    @property
    def library(self) -> Library:
        """All robots, in the one library of this process."""
        return _library(self.catalogue, self.uploads, self.quota)


_library = lru_cache(maxsize=1)(Library)


@dataclass(frozen=True, slots=True)
class TaskRequest:
    """Parts of a request that its answer depends on: its body in the pieces in which it arrived, and its query.

    `robot` is the name in the path, `wanted` the media type of the answer, `endpoint` the name of the operation if it
    is in the table of endpoints; `npy` says whether the body is an array.
    """

    pieces: Sequence[PickleBuffer] = ()
    robot: str = ""
    query: str = ""
    npy: bool = False
    wanted: str = JSON
    endpoint: str = ""

    @property
    def body(self) -> bytes:
        """Body as one byte string."""
        return b"".join(self.pieces)


def buffers(pieces: Sequence[bytes]) -> list[PickleBuffer]:
    """Wrap the pieces of a body so that they are sent without being copied."""
    return [PickleBuffer(piece) for piece in pieces]


WorkerTask: TypeAlias = Callable[[Context, TaskRequest], Response]
Reply: TypeAlias = tuple[int, list[tuple[bytes, bytes]], list[PickleBuffer], RequestCounts | None]
"""Status code, headers, body in pieces, and counts for the metrics."""


def answered(order: tuple[Context, WorkerTask, TaskRequest]) -> Reply:
    """Run a task in this worker process and return the parts of its response."""
    context, task, task_request = order
    REQUEST_COUNTS.set(None)
    response = task(context, task_request)
    return response.status_code, response.raw_headers, pieces_of(bytes(response.body)), REQUEST_COUNTS.get()
