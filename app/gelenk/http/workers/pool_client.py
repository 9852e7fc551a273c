"""Sends requests to the worker pool, with a deadline; a request is cancelled when its client disconnects."""

import asyncio
from collections import Counter
from collections.abc import Coroutine
from typing import Any, TypeVar

from starlette.requests import ClientDisconnect, Request
from starlette.responses import Response
from starlette.types import Receive, Scope, Send

from gelenk.errors import ServiceStopping, TooManyRequests
from gelenk.http.workers.task import Context, Reply, TaskRequest, WorkerTask, answered
from gelenk.operations.outcome import REQUEST_COUNTS
from gelenk.pool.pool import WorkerPool
from gelenk.store.library import Library
from gelenk.store.records import LoadedRobot

INLINE_BYTES = 4096
"""Size of the largest body that the event loop parses: it does nothing that takes longer than about 2 ms.

For the same reason it compiles nothing: while the pool is starting, every request goes to the pool.
"""

_LONG = 5e-4
"""Duration of an answer after which the event loop computes no other one in the same turn, [s]."""

PARSED_HERE_BYTES = 512 * 1024
"""Size of the largest body that a thread of this process parses, [bytes]: parsing delays the event loop."""

_OWN_ADDRESSES = frozenset({"127.0.0.1", "::1"})

_WITHOUT_KEY = "clients without a key"
"""Owner of uploads without a key: addresses change, and where no key is needed all clients share one machine."""

_Result = TypeVar("_Result")


class PoolClient:
    """Sends requests to the worker pool and returns the responses.

    A request waits for a worker, and then runs, for at most `seconds` each; of one client, at most `share` wait or run.
    """

    def __init__(self, pool: WorkerPool, context: Context, library: Library, seconds: float, share: int) -> None:
        self.pool, self._context, self._library, self._seconds = pool, context, library, seconds
        self._share = share
        self._requests: Counter[str] = Counter()
        self._has_computed = False

    @property
    def may_compute_here(self) -> bool:
        """Whether the event loop may answer a quick request itself.

        In each of its turns it computes for less than `_LONG`, or one answer; of a crowd, the others go to the pool.
        """
        return not (self._has_computed or self.pool.is_starting)

    def note_computation(self, seconds: float) -> bool:
        """Note that the event loop has computed for so long, [s]; if that is long, as the last of its turn.

        Return whether it was long.
        """
        took_long = seconds > _LONG
        if took_long:
            self._has_computed = True
            asyncio.get_running_loop().call_soon(self._begin_turn)
        return took_long

    def _begin_turn(self) -> None:
        self._has_computed = False

    async def answer(self, request: Request, task: WorkerTask, task_request: TaskRequest) -> Response:
        """Run a task in a worker and return its response; raises as `WorkerPool.run` and `while_wanted`."""
        reply = await self._reply(request, task, task_request)
        REQUEST_COUNTS.set(reply[3])
        return Passed(reply)

    async def content(self, request: Request, task: WorkerTask, task_request: TaskRequest) -> bytes:
        """Run a task in a worker and return the body of its response; raise the same errors as `answer`."""
        return b"".join((await self._reply(request, task, task_request))[2])

    def loaded(self, name: str) -> LoadedRobot | None:
        """Return a robot that is in the memory of this process, and up to date."""
        return self._library.loaded(name)

    async def resident(self, request: Request, name: str) -> LoadedRobot:
        """Load a robot into this process, for quick calls; if it was uploaded, a worker tries first: it may crash."""
        found = self._library.loaded(name)
        if found is not None:
            return found
        if not self._library.is_ours(name):
            await self._reply(request, load, TaskRequest(robot=name))
        return await asyncio.to_thread(self._library.get, name)

    async def _reply(self, request: Request, task: WorkerTask, task_request: TaskRequest) -> Reply:
        client = client_of(request)
        if client and self._requests[client] >= self._share:
            raise TooManyRequests(self._share, self.pool.retry_after)
        self.pool.check_room(client)
        work = self.pool.run(answered, (self._context, task, task_request), self._seconds, client)
        self._requests[client] += 1
        try:
            return await while_wanted(request.receive, work)
        finally:
            self._requests[client] -= 1
            if not self._requests[client]:
                del self._requests[client]


def client_of(request: Request) -> str:
    """Return the client of a request: its key or, without a key, its address.

    Requests without a key from this machine, perhaps from a proxy, count as one nameless client without a share.
    """
    key: str | None = request.scope.get("gelenk.key")
    if key is not None:
        return f"key {key}"
    address = request.client.host if request.client else ""
    return "" if address in _OWN_ADDRESSES else address


def owner_of(request: Request) -> str:
    """Return the owner of what a request uploads, against whose quota it counts."""
    key: str | None = request.scope.get("gelenk.key")
    return _WITHOUT_KEY if key is None else f"key {key}"


def load(context: Context, task_request: TaskRequest) -> Response:
    """Load a robot in a worker, to check that this is possible; the response is empty."""
    context.library.get(task_request.robot)
    return Response()


async def while_wanted(receive: Receive, work: Coroutine[Any, Any, _Result]) -> _Result:
    """Await work and return its result; if the client disconnects, cancel the work and raise ClientDisconnect.

    Raises ServiceStopping if the server has cancelled the work because its shutdown can wait no longer.
    """
    doing, leaving = asyncio.ensure_future(work), asyncio.ensure_future(_left(receive))
    try:
        await asyncio.wait({doing, leaving}, return_when=asyncio.FIRST_COMPLETED)
        if doing.done():
            return doing.result()
        raise ClientDisconnect
    except asyncio.CancelledError:
        raise ServiceStopping from None
    finally:
        doing.cancel()
        leaving.cancel()


async def _left(receive: Receive) -> None:
    while (await receive())["type"] != "http.disconnect":
        pass


class Passed(Response):
    """A response from the pool, sent piece by piece as fast as the client reads; other requests run in between."""

    def __init__(self, reply: Reply) -> None:
        self.status_code, self.raw_headers, pieces, _ = reply
        self.body, self.background = b"", None
        self._pieces = [memoryview(piece) for piece in pieces] or [memoryview(b"")]

    async def __call__(self, scope: Scope, receive: Receive, send: Send) -> None:  # noqa: ARG002
        """Send the response."""
        await send({"type": "http.response.start", "status": self.status_code, "headers": self.raw_headers})
        pieces = self._pieces[::-1]
        self._pieces.clear()
        while pieces:
            await send({"type": "http.response.body", "body": pieces.pop(), "more_body": bool(pieces)})
            if pieces:  # `send` does not yield while the system accepts data
                await asyncio.sleep(0)
