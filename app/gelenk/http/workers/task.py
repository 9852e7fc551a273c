"""Tasks for the worker pool: each is a function that answers a whole request in a worker process.

It must be a module-level function, because it is sent by name.
"""

from collections.abc import Callable, Sequence
from dataclasses import dataclass
from functools import lru_cache
from pickle import PickleBuffer
from typing import TypeAlias

from starlette.responses import Response

from gelenk.http.messages.payloads import JSON
from gelenk.http.workers.context import Context, ContextSetup
from gelenk.operations.request_counts import REQUEST_COUNTS, RequestCounts
from gelenk.processes.wire import pieces_of


@dataclass(frozen=True, slots=True)
class TaskRequest:
    """Parts of a request that its answer depends on.

    Attributes:
        pieces: Body, in the pieces in which it arrived.
        robot: Name of the robot in the path, or empty.
        query: Query string of the URL.
        npy: Whether the body is an array in the NPY format.
        wanted: Media type of the answer.
        endpoint: Name of the operation, if it is in the table of endpoints.
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


def answered(order: tuple[ContextSetup, WorkerTask, TaskRequest]) -> Reply:
    """Run a task in this worker process and return the parts of its response."""
    setup, task, task_request = order
    REQUEST_COUNTS.set(None)
    response = task(_context(setup), task_request)
    return response.status_code, response.raw_headers, pieces_of(bytes(response.body)), REQUEST_COUNTS.get()


@lru_cache(maxsize=1)
def _context(setup: ContextSetup) -> Context:
    return setup.context()
