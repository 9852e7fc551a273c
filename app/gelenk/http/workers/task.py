"""Tasks for the worker pool: a whole request, and the function that answers it there.

A task is a function of a module, because it is sent by name.
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
from gelenk.pool.wire import pieces_of


@dataclass(frozen=True, slots=True)
class TaskRequest:
    """The parts of a request that an answer depends on.

    Attributes:
        pieces: The body in the pieces that it arrived in.
        robot: Robot that the path names, if any.
        query: The query string.
        npy: Whether the body is an array.
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
        """The whole body."""
        return b"".join(self.pieces)


def buffers(pieces: Sequence[bytes]) -> list[PickleBuffer]:
    """Wrap a body, so that it is sent without being copied."""
    return [PickleBuffer(piece) for piece in pieces]


WorkerTask: TypeAlias = Callable[[Context, TaskRequest], Response]
Reply: TypeAlias = tuple[int, list[tuple[bytes, bytes]], list[PickleBuffer], RequestCounts | None]
"""Status, headers, the body in pieces, and what the metrics count."""


def answered(order: tuple[ContextSetup, WorkerTask, TaskRequest]) -> Reply:
    """Run a task in a worker process."""
    setup, task, task_request = order
    REQUEST_COUNTS.set(None)
    response = task(_context(setup), task_request)
    return response.status_code, response.raw_headers, pieces_of(bytes(response.body)), REQUEST_COUNTS.get()


@lru_cache(maxsize=1)
def _context(setup: ContextSetup) -> Context:
    return setup.context()
