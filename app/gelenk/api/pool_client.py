"""From a request to the pool and back: with a deadline, and for as long as the client waits for the answer."""

import asyncio
from collections import Counter
from collections.abc import Coroutine
from typing import Any, TypeVar

from starlette.requests import ClientDisconnect, Request
from starlette.responses import Response
from starlette.types import Receive, Scope, Send

from gelenk.api.context import Context, ContextSetup
from gelenk.api.task import Reply, TaskRequest, WorkerTask, answered
from gelenk.model.errors import ServiceStopping, TooManyRequests
from gelenk.operations.request_counts import REQUEST_COUNTS
from gelenk.pool.pool import WorkerPool
from gelenk.store.library import Library
from gelenk.store.records import LoadedRobot

INLINE_BYTES = 4096
"""A larger body is parsed by the pool: the event loop does nothing that takes longer than about 2 ms.

So it compiles nothing either: while the pool is starting, every request goes to the pool.
"""

PARSED_HERE_BYTES = 512 * 1024
"""Most of a body that a thread of this process parses: it holds up the event loop."""

_OWN_ADDRESSES = frozenset({"127.0.0.1", "::1"})

_Result = TypeVar("_Result")


class PoolClient:
    """Has requests answered by the pool.

    Args:
        pool: The processes.
        setup: What they set their contexts up from.
        library: The robots of this process.
        seconds: How long a request may wait for its turn, and how long it may then take.
        share: Requests of one client that may wait or be worked on.
    """

    def __init__(self, pool: WorkerPool, setup: ContextSetup, library: Library, seconds: float, share: int) -> None:
        self.pool, self._setup, self._library, self._seconds = pool, setup, library, seconds
        self._share = share
        self._requests: Counter[str] = Counter()

    async def answer(self, request: Request, task: WorkerTask, task_request: TaskRequest) -> Response:
        """The answer of a task.

        Raises:
            ClientDisconnect: The caller has left; the task is broken off.
            KinematicsError: As `WorkerPool.run`, and whatever the task raises.
        """
        reply = await self._reply(request, task, task_request)
        REQUEST_COUNTS.set(reply[3])
        return Passed(reply)

    async def content(self, request: Request, task: WorkerTask, task_request: TaskRequest) -> bytes:
        """The body of a task's answer, for this process; raises as `answer` does."""
        return b"".join((await self._reply(request, task, task_request))[2])

    async def resident(self, request: Request, name: str) -> LoadedRobot:
        """A robot in this process, for quick calls; one from outside has been loaded by the pool before, which lived.

        Raises:
            KinematicsError: As `answer`, and as `Library.get`.
        """
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
        work = self.pool.run(answered, (self._setup, task, task_request), self._seconds, client)
        self._requests[client] += 1
        try:
            return await while_wanted(request.receive, work)
        finally:
            self._requests[client] -= 1
            if not self._requests[client]:
                del self._requests[client]


def client_of(request: Request) -> str:
    """The client of a request: its key, else its address.

    All requests without a key from this machine belong to one nameless client without a share of its own, because a
    proxy in front of the service may pass on those of others.
    """
    key: str | None = request.scope.get("gelenk.key")
    if key is not None:
        return f"key {key}"
    address = request.client.host if request.client else ""
    return "" if address in _OWN_ADDRESSES else address


def load(context: Context, task_request: TaskRequest) -> Response:
    """Load a robot, to see that it can be."""
    context.library.get(task_request.robot)
    return Response()


async def while_wanted(receive: Receive, work: Coroutine[Any, Any, _Result]) -> _Result:
    """The result of some work, which is broken off when the caller leaves.

    Raises:
        ClientDisconnect: The caller has left.
        ServiceStopping: The server has cancelled it, which it does when it can wait no longer to shut down.
        Exception: Whatever the work raises.
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
    """An answer from the pool, passed on piece by piece as fast as the caller takes it; others get a turn between."""

    def __init__(self, reply: Reply) -> None:
        self.status_code, self.raw_headers, pieces, _ = reply
        self.body, self.background = b"", None
        self._pieces = [memoryview(piece) for piece in pieces] or [memoryview(b"")]

    async def __call__(self, scope: Scope, receive: Receive, send: Send) -> None:  # noqa: ARG002
        """Send it."""
        await send({"type": "http.response.start", "status": self.status_code, "headers": self.raw_headers})
        pieces = self._pieces[::-1]
        self._pieces.clear()
        while pieces:
            await send({"type": "http.response.body", "body": pieces.pop(), "more_body": bool(pieces)})
            if pieces:  # while the system takes them, sending waits for nothing
                await asyncio.sleep(0)
