"""The client of the service in Python: `Client` waits for answers, those of `AsyncClient` are awaited.

    >>> with Client("http://127.0.0.1:8000") as gelenk:
    ...     answer = gelenk.fk("planar_2r", joint_positions=[[0.3, 0.8]])
    ...     poses = gelenk.arrays.fk("planar_2r", qs)  # NumPy in, NumPy out, for large batches
    ...     with gelenk.jobs.ik("panda", targets=targets) as job:  # for what takes long
    ...         found = job.result(lambda info: print(info.progress))

Every operation of the API is a method with its types (`gelenk.client.operations`). An array in the place of a list of
configurations or targets is sent as npy automatically. If the service refuses a call, the core's own exception is
raised; a call is retried where that is safe.
"""

import asyncio
import contextlib
import os
import re
import threading
import time
from collections.abc import AsyncGenerator, Callable, Iterator
from typing import Any, Self, TypeVar

import httpx2

from gelenk.client.arrays import Arrays, AsyncArrays
from gelenk.client.call import Call
from gelenk.client.exchange import segment
from gelenk.client.jobs import AsyncJobs, Jobs
from gelenk.client.operations import Operations
from gelenk.client.responses import AT_ONCE, TIMEOUT, Patience, answer
from gelenk.contract.jobs import JobInfo
from gelenk.errors import InvalidField, quoted

T = TypeVar("T")

URL_VARIABLE = "GELENK_SERVER"
KEY_VARIABLE = "GELENK_KEY"
DEFAULT_URL = "http://127.0.0.1:8000"

_PAGES = re.compile(r"/*(/(docs|redoc|embed|v1)/*)?$")
"""The end of an address that was copied from a page of the service."""
_LAST_PORT = 65_535
_BETWEEN_STREAMS = 1.0
"""Pause before an interrupted stream of events is opened again, [s]."""


class _Service(Operations):
    """Address of the service, and what every request to it needs."""

    def __init__(self, url: str | None, key: str | None, transport: Any) -> None:
        self.url = service_url(url)
        key = (key or os.environ.get(KEY_VARIABLE) or "").strip()
        if not (key.isascii() and key.isprintable()):
            raise InvalidField("key", "it has characters that a key cannot contain")
        self._options: dict[str, Any] = {
            "base_url": f"{self.url}/",
            "headers": {"Authorization": f"Bearer {key}"} if key else {},
            "timeout": TIMEOUT,
            "limits": httpx2.Limits(max_keepalive_connections=AT_ONCE),
            "transport": transport,
            "trust_env": False,  # proxies set up on a laptop do not apply to a lab's service
        }

    def __repr__(self) -> str:
        return f"{type(self).__name__}({self.url!r})"


def _request(http: httpx2.Client | httpx2.AsyncClient, call: Call[Any]) -> httpx2.Request:
    content: dict[str, Any] = {"data": dict(call.form), "files": list(call.files)} if call.files else {}
    if call.body:
        content["content"] = call.body
    return http.build_request(call.method, call.path, params=call.query or None, headers=call.headers, **content)


def service_url(url: str | None) -> str:
    """Return the address of the service, without the page that it was copied from; raises InvalidField for none."""
    url = _PAGES.sub("", (url or os.environ.get(URL_VARIABLE) or DEFAULT_URL).strip())
    try:
        parsed = httpx2.URL(url)
    except httpx2.InvalidURL:
        parsed = httpx2.URL()
    if parsed.scheme not in {"http", "https"} or not parsed.host or (parsed.port or 1) > _LAST_PORT:
        raise InvalidField("url", f"{quoted(url)} is not the address of a service, such as {DEFAULT_URL}")
    return url


class _Track:
    def __init__(self) -> None:
        self._last: JobInfo | None = None

    def is_new(self, info: JobInfo) -> bool:
        """Check whether the job has advanced: a reopened stream begins with the known state."""
        last, self._last = self._last, info
        return info != last


class Client(_Service):
    """The service, called synchronously; safe to use from several threads.

    Args:
        url: Address of the service, path prefix included; else `GELENK_SERVER`, else this machine's port 8000.
        key: Key, if the service wants one; else `GELENK_KEY`.
        transport: How to reach the service, if not over the network.
    """

    def __init__(
        self, url: str | None = None, key: str | None = None, transport: httpx2.BaseTransport | None = None
    ) -> None:
        super().__init__(url, key, transport)
        self._http = httpx2.Client(**self._options)
        self._turns = threading.BoundedSemaphore(AT_ONCE)
        self.arrays, self.jobs = Arrays(self), Jobs(self)

    def __enter__(self) -> Self:
        return self

    def __exit__(self, *_: object) -> None:
        self.close()

    def close(self) -> None:
        """Close all connections."""
        self._http.close()

    def send(self, call: Call[T]) -> T:
        """Send a call and return its answer.

        Raises:
            Refused: The service refuses the call; the error is also of the core's own class if there is one.
            NotAnswering: The service cannot be reached, or the connection breaks.
        """
        patience = Patience(call, self.url)
        while True:
            try:
                with self._turns:
                    response = self._http.send(_request(self._http, call))
            except httpx2.TransportError as error:
                pause: float | None = patience.after_failure(error)
            else:
                pause = patience.after_answer(response)
            if pause is None:
                return answer(call, response, self.url)
            time.sleep(pause)

    def watch(self, job: str) -> Iterator[JobInfo]:
        """Yield the state of a job whenever it has advanced, until it has ended.

        Raises:
            Refused: There is no such job.
            NotAnswering: The service cannot be reached any more.
        """
        track = _Track()
        while True:
            stream = self._http.stream("GET", _events_path(job), timeout=_EVENTS)
            with contextlib.suppress(httpx2.TransportError), stream as response:
                for event in httpx2.EventSource(response):
                    info = JobInfo.model_validate_json(event.data, extra="ignore")
                    if track.is_new(info):
                        yield info
                    if event.event == "finished":
                        return
            # The stream was refused or interrupted, or a proxy lets none through.
            info = self.job(job)
            if track.is_new(info):
                yield info
            if info.finished is not None:
                return
            time.sleep(_BETWEEN_STREAMS)

    def wait(self, job: str, progress: Callable[[JobInfo], None] | None = None) -> JobInfo:
        """Wait until a job has ended, and return it.

        Args:
            job: Id of the job.
            progress: Called whenever it has advanced.
        """
        for info in self.watch(job):
            if progress is not None:
                progress(info)
        return info


class AsyncClient(_Service):
    """The service for `async` code: many calls may run at once. For its arguments see `Client`."""

    def __init__(
        self, url: str | None = None, key: str | None = None, transport: httpx2.AsyncBaseTransport | None = None
    ) -> None:
        super().__init__(url, key, transport)
        self._http = httpx2.AsyncClient(**self._options)
        self._turns = asyncio.BoundedSemaphore(AT_ONCE)
        self.arrays, self.jobs = AsyncArrays(self), AsyncJobs(self)

    async def __aenter__(self) -> Self:
        return self

    async def __aexit__(self, *_: object) -> None:
        await self.close()

    async def close(self) -> None:
        """Close all connections."""
        await self._http.aclose()

    async def send(self, call: Call[T]) -> T:
        """Send a call and return its answer; raises as `Client.send` does."""
        patience = Patience(call, self.url)
        while True:
            try:
                async with self._turns:
                    response = await self._http.send(_request(self._http, call))
            except httpx2.TransportError as error:
                pause: float | None = patience.after_failure(error)
            else:
                pause = patience.after_answer(response)
            if pause is None:
                return answer(call, response, self.url)
            await asyncio.sleep(pause)

    async def watch(self, job: str) -> AsyncGenerator[JobInfo, None]:
        """Yield the state of a job whenever it has advanced, until it has ended."""
        track = _Track()
        while True:
            stream = self._http.stream("GET", _events_path(job), timeout=_EVENTS)
            with contextlib.suppress(httpx2.TransportError):
                async with stream as response:
                    async for event in httpx2.EventSource(response):
                        info = JobInfo.model_validate_json(event.data, extra="ignore")
                        if track.is_new(info):
                            yield info
                        if event.event == "finished":
                            return
            # The stream was refused or interrupted, or a proxy lets none through.
            info = await self.job(job)
            if track.is_new(info):
                yield info
            if info.finished is not None:
                return
            await asyncio.sleep(_BETWEEN_STREAMS)

    async def wait(self, job: str, progress: Callable[[JobInfo], None] | None = None) -> JobInfo:
        """Wait until a job has ended, and return it; for its arguments see `Client.wait`."""
        async with contextlib.aclosing(self.watch(job)) as states:
            async for info in states:
                if progress is not None:
                    progress(info)
        return info


_EVENTS = httpx2.Timeout(5.0, read=60.0)
"""Timeouts, [s]; the service sends a comment every few seconds."""


def _events_path(job: str) -> str:
    return f"v1/jobs/{segment(job)}/events"
