"""The service in Python: `Client` waits for its answers, `AsyncClient` awaits them.

    >>> with Client("http://127.0.0.1:8000") as gelenk:
    ...     answer = gelenk.fk("planar_2r", joint_positions=[[0.3, 0.8]])
    ...     poses = gelenk.arrays.fk("planar_2r", qs)  # NumPy in, NumPy out, for large batches
    ...     with gelenk.jobs.ik("panda", targets=targets) as job:  # for what takes long
    ...         found = job.result(lambda info: print(info.progress))

Every operation of the API is a method with its types (`app.calls.operations`). An array in the place of a list of
configurations or targets goes as npy by itself. What the service refuses is raised as the core's own exception; a call
is sent again where that is safe.
"""

import asyncio
import os
import random
import time
from collections.abc import AsyncIterator, Callable, Iterator
from http import HTTPStatus
from types import TracebackType
from typing import Any, Self, TypeVar

import httpx2
import orjson

from app.calls.arrays import Arrays, AsyncArrays
from app.calls.call import Call, Reply
from app.calls.exchange import segment
from app.calls.jobs import AsyncJobs, Jobs
from app.calls.operations import Operations
from app.calls.refusals import NotAnswering, refusal
from app.schemas.jobs import JobInfo

T = TypeVar("T")

URL_VARIABLE = "GELENK_SERVER"
KEY_VARIABLE = "GELENK_KEY"
DEFAULT_URL = "http://127.0.0.1:8000"

_TIMEOUT = httpx2.Timeout(5.0, read=120.0, write=120.0)
"""[s]; the service ends what takes too long by itself, and says so."""
_ATTEMPTS = 4
_FIRST_PAUSE = 0.2
_LONGEST_PAUSE = 30.0
_COME_AGAIN = {HTTPStatus.TOO_MANY_REQUESTS, HTTPStatus.SERVICE_UNAVAILABLE}
_NEVER_SENT = (httpx2.ConnectError, httpx2.ConnectTimeout, httpx2.PoolTimeout)
_BROKEN_OFF = (httpx2.ReadError, httpx2.WriteError, httpx2.RemoteProtocolError, httpx2.CloseError)


class _Settings:
    """Where the service is, and what every request carries."""

    def __init__(self, url: str | None, key: str | None) -> None:
        self.url = (url or os.environ.get(URL_VARIABLE) or DEFAULT_URL).rstrip("/")
        key = key or os.environ.get(KEY_VARIABLE)
        self.headers = {} if key is None else {"Authorization": f"Bearer {key}"}

    def options(self, transport: Any) -> dict[str, Any]:
        """For a client of httpx; what a laptop is set up to do with other hosts is not meant for a lab's service."""
        return {
            "base_url": f"{self.url}/",
            "headers": self.headers,
            "timeout": _TIMEOUT,
            "transport": transport,
            "trust_env": False,
        }


def _request(http: httpx2.Client | httpx2.AsyncClient, call: Call[Any]) -> httpx2.Request:
    content: dict[str, Any] = {"data": dict(call.form), "files": dict(call.files)} if call.files else {}
    if call.body:
        content["content"] = call.body
    return http.build_request(call.method, call.path, params=call.query or None, headers=call.headers, **content)


def _answer(call: Call[T], response: httpx2.Response) -> T:
    """What has come back, read.

    Raises:
        Refused: The service refuses the call.
    """
    if response.is_success:
        return call.read(Reply(response.content, response.headers))
    raise refusal(_problem(response))


def _problem(response: httpx2.Response) -> dict[str, Any]:
    """The problem; what is in front of the service may answer with something else."""
    try:
        problem = orjson.loads(response.content)
    except orjson.JSONDecodeError:
        problem = None
    if isinstance(problem, dict) and "detail" in problem:
        return problem
    return {"status": response.status_code, "detail": f"status {response.status_code} without a reason"}


class _Patience:
    """How long to wait before a call is sent again, and when to give up."""

    def __init__(self, call: Call[Any], url: str) -> None:
        self._call, self._url, self._tried = call, url, 0

    def after_answer(self, response: httpx2.Response) -> float | None:
        """Seconds, where the service asks to come again; None where its answer stands."""
        self._tried += 1
        wanted = response.headers.get("retry-after", "")
        if response.status_code not in _COME_AGAIN or not wanted.isdigit() or self._tried >= _ATTEMPTS:
            return None
        return min(float(wanted), _LONGEST_PAUSE)

    def after_failure(self, error: httpx2.TransportError) -> float:
        """Seconds.

        Raises:
            NotAnswering: It was tried often enough, or the call might have been done already.
        """
        self._tried += 1
        is_safe = isinstance(error, _NEVER_SENT) or (self._call.is_repeatable and isinstance(error, _BROKEN_OFF))
        if not is_safe or self._tried >= _ATTEMPTS:
            raise NotAnswering(self._url, str(error) or type(error).__name__) from error
        return _FIRST_PAUSE * 2.0**self._tried * random.uniform(0.5, 1.0)  # noqa: S311 - spreads clients, hides nothing


class Client(Operations):
    """The service, asked one call after the other; may be used by several threads.

    Args:
        url: Of the service, its path prefix included; else `GELENK_SERVER`, else this machine's port 8000.
        key: Where the service wants one; else `GELENK_KEY`.
        transport: Another way to the service than the network.
    """

    def __init__(
        self, url: str | None = None, key: str | None = None, transport: httpx2.BaseTransport | None = None
    ) -> None:
        settings = _Settings(url, key)
        self.url = settings.url
        self._http = httpx2.Client(**settings.options(transport))
        self.arrays, self.jobs = Arrays(self), Jobs(self)

    def __enter__(self) -> Self:
        return self

    def __exit__(self, kind: type[BaseException] | None, error: BaseException | None, at: TracebackType | None) -> None:
        self.close()

    def close(self) -> None:
        """End all connections."""
        self._http.close()

    def send(self, call: Call[T]) -> T:
        """The answer to a call.

        Raises:
            Refused: The service refuses it; an instance of the core's own exception where there is one.
            NotAnswering: The service cannot be reached, or breaks off.
        """
        patience = _Patience(call, self.url)
        while True:
            try:
                response = self._http.send(_request(self._http, call))
            except httpx2.TransportError as error:
                pause: float | None = patience.after_failure(error)
            else:
                pause = patience.after_answer(response)
            if pause is None:
                return _answer(call, response)
            time.sleep(pause)

    def watch(self, job: str) -> Iterator[JobInfo]:
        """A job, whenever it is further on, until it has come to its end."""
        last = None
        while True:
            try:
                with self._http.stream("GET", _events_path(job), timeout=_EVENTS) as response:
                    if not response.is_success:
                        response.read()
                        raise refusal(_problem(response))
                    for event in httpx2.EventSource(response):
                        info = JobInfo.model_validate_json(event.data, extra="ignore")
                        if info != last:  # a stream that was broken off begins with what is known
                            yield info
                        if event.event == "finished":
                            return
                        last = info
            except httpx2.TransportError:
                self.job(job)  # raises where the service is gone for good; else the stream goes on

    def wait(self, job: str, progress: Callable[[JobInfo], None] | None = None) -> JobInfo:
        """A job that has come to its end.

        Args:
            job: Its id.
            progress: Is told whenever it is further on.
        """
        for info in self.watch(job):
            if progress is not None:
                progress(info)
        return info


class AsyncClient(Operations):
    """The same, awaited: many calls may be under way at once. For its arguments see `Client`."""

    def __init__(
        self, url: str | None = None, key: str | None = None, transport: httpx2.AsyncBaseTransport | None = None
    ) -> None:
        settings = _Settings(url, key)
        self.url = settings.url
        self._http = httpx2.AsyncClient(**settings.options(transport))
        self.arrays, self.jobs = AsyncArrays(self), AsyncJobs(self)

    async def __aenter__(self) -> Self:
        return self

    async def __aexit__(
        self, kind: type[BaseException] | None, error: BaseException | None, at: TracebackType | None
    ) -> None:
        await self.close()

    async def close(self) -> None:
        """End all connections."""
        await self._http.aclose()

    async def send(self, call: Call[T]) -> T:
        """The answer to a call; raises as `Client.send` does."""
        patience = _Patience(call, self.url)
        while True:
            try:
                response = await self._http.send(_request(self._http, call))
            except httpx2.TransportError as error:
                pause: float | None = patience.after_failure(error)
            else:
                pause = patience.after_answer(response)
            if pause is None:
                return _answer(call, response)
            await asyncio.sleep(pause)

    async def watch(self, job: str) -> AsyncIterator[JobInfo]:
        """A job, whenever it is further on, until it has come to its end."""
        last = None
        while True:
            try:
                async with self._http.stream("GET", _events_path(job), timeout=_EVENTS) as response:
                    if not response.is_success:
                        await response.aread()
                        raise refusal(_problem(response))
                    async for event in httpx2.EventSource(response):
                        info = JobInfo.model_validate_json(event.data, extra="ignore")
                        if info != last:  # a stream that was broken off begins with what is known
                            yield info
                        if event.event == "finished":
                            return
                        last = info
            except httpx2.TransportError:
                await self.job(job)

    async def wait(self, job: str, progress: Callable[[JobInfo], None] | None = None) -> JobInfo:
        """A job that has come to its end; for its arguments see `Client.wait`."""
        async for info in self.watch(job):
            if progress is not None:
                progress(info)
        return info


_EVENTS = httpx2.Timeout(5.0, read=60.0)
"""[s]; a comment comes every few seconds."""


def _events_path(job: str) -> str:
    return f"v1/jobs/{segment(job)}/events"
