"""Jobs, which the service runs in the background, as objects with their progress and results."""

import functools
import inspect
from collections.abc import AsyncGenerator, Callable, Coroutine, Iterator
from contextlib import aclosing, suppress
from dataclasses import replace
from typing import TYPE_CHECKING, Any, Generic, ParamSpec, Self, TypeVar, overload

from gelenk.client.arrays import ArrayOperations
from gelenk.client.call import Call, method_of
from gelenk.client.exchange import reader
from gelenk.client.operations import Operations
from gelenk.contract.jobs import Finished, JobInfo
from gelenk.errors import KinematicsError
from gelenk.robot.arrays import Array

if TYPE_CHECKING:
    from gelenk.client.client import AsyncClient, Client

P = ParamSpec("P")
A = TypeVar("A")
C = TypeVar("C")

Progress = Callable[[JobInfo], None]
"""Called with a job whenever it has progressed."""
_cancel = Operations.cancel_job.describe
_array = ArrayOperations.job_result.describe


class _JobOf(Generic[C, A]):
    """What both kinds of job share: the latest information from the service."""

    def __init__(self, client: C, info: JobInfo, result: Callable[[str], Call[A]]) -> None:
        self._client, self.info, self._result = client, info, result

    @property
    def id(self) -> str:
        """Id of the job at the service."""
        return self.info.id

    def __repr__(self) -> str:
        return f"{type(self).__name__}({self.id!r}, {self.info.kind}, {self.info.state}, {self.info.progress:.0%})"


class Job(_JobOf["Client", A]):
    """A job of the service. Iterate over it to see its progress; `result` waits for its result.

    Leaving it as a context manager cancels the job if it is unfinished, and removes its result.

    Attributes:
        info: Latest known progress.
    """

    def __iter__(self) -> Iterator[JobInfo]:
        for info in self._client.watch(self.id):
            self.info = info
            yield info

    def wait(self, progress: Progress | None = None) -> JobInfo:
        """Wait until the job has finished, whatever the outcome, and return it."""
        for info in self:
            if progress is not None:
                progress(info)
        return self.info

    def result(self, progress: Progress | None = None) -> A:
        """Wait until the job has finished, and return its result.

        Raises:
            Refused: The job failed (raised as the core's own exception), or was cancelled.
        """
        self.wait(progress)
        return self._client.send(self._result(self.id))

    def array(self, progress: Progress | None = None) -> Array:
        """Wait until the job has finished, and return its array; see `arrays` of the client for the content."""
        self.wait(progress)
        return self._client.send(_array(self.id))

    def cancel(self, finished: Finished = "keep") -> JobInfo:
        """Cancel the job, or with `finished="remove"` remove the result of a finished one.

        Raises:
            JobFinished: The job has finished, and `finished` is "keep".
        """
        self.info = self._client.send(_cancel(self.id, finished))
        return self.info

    def __enter__(self) -> Self:
        return self

    def __exit__(self, *_: object) -> None:
        with suppress(KinematicsError):  # someone else has removed it, or the service is away
            self.cancel("remove")


class AsyncJob(_JobOf["AsyncClient", A]):
    """A job of the service, awaited; see `Job`."""

    async def __aiter__(self) -> AsyncGenerator[JobInfo, None]:
        async with aclosing(self._client.watch(self.id)) as states:
            async for info in states:
                self.info = info
                yield info

    async def wait(self, progress: Progress | None = None) -> JobInfo:
        """Await the end of the job; see `Job.wait`."""
        async with aclosing(aiter(self)) as states:
            async for info in states:
                if progress is not None:
                    progress(info)
        return self.info

    async def result(self, progress: Progress | None = None) -> A:
        """Await the result of the job; see `Job.result`."""
        await self.wait(progress)
        return await self._client.send(self._result(self.id))

    async def array(self, progress: Progress | None = None) -> Array:
        """Await the array of the job; see `Job.array`."""
        await self.wait(progress)
        return await self._client.send(_array(self.id))

    async def cancel(self, finished: Finished = "keep") -> JobInfo:
        """Cancel or remove the job; see `Job.cancel`."""
        self.info = await self._client.send(_cancel(self.id, finished))
        return self.info

    async def __aenter__(self) -> Self:
        return self

    async def __aexit__(self, *_: object) -> None:
        with suppress(KinematicsError):
            await self.cancel("remove")


class Started(Generic[P, A]):
    """A method of both clients' jobs that starts one whose result answers a call."""

    def __init__(self, describe: Callable[P, Call[JobInfo]], result: Callable[[str], Call[A]]) -> None:
        self.describe, self._result = describe, result
        self.__doc__ = describe.__doc__

    def __set_name__(self, _: type, name: str) -> None:
        self.name = name

    @overload
    def __get__(self, jobs: None, owner: type) -> Self: ...
    @overload
    def __get__(self, jobs: "Jobs", owner: type) -> Callable[P, Job[A]]: ...
    @overload
    def __get__(self, jobs: "AsyncJobs", owner: type) -> Callable[P, Coroutine[object, None, AsyncJob[A]]]: ...

    def __get__(self, jobs: Any, owner: type) -> Any:
        """Return the descriptor itself for the class, or the method of a client's jobs."""
        if jobs is None:
            return self

        return method_of(self.name, self.describe, lambda call: jobs.start(call, self._result))


def _later(describe: Callable[P, Call[Any]]) -> Callable[P, Call[JobInfo]]:
    """Return the call that a job answers; not repeatable, since sending it twice would start two jobs."""

    @functools.wraps(describe)
    def described(*args: P.args, **kwargs: P.kwargs) -> Call[JobInfo]:
        call: Call[Any] = describe(*args, **kwargs)
        return replace(call, read=reader(JobInfo), is_later=True, is_repeatable=False)

    described.__signature__ = inspect.signature(describe)  # type: ignore[attr-defined]
    return described


class JobOperations:
    """Operations that may take long, as jobs; a job may be larger than a call that is answered at once."""

    ik = Started(_later(Operations.ik.describe), Operations.ik_result.describe)
    trajectory = Started(_later(Operations.trajectory.describe), Operations.trajectory_result.describe)
    trajectories = Started(_later(Operations.trajectories.describe), Operations.trajectories_result.describe)
    workspace = Started(Operations.workspace.describe, Operations.workspace_result.describe)


class Jobs(JobOperations):
    """Jobs of a client that waits."""

    def __init__(self, client: "Client") -> None:
        self._client = client

    def start(self, call: Call[JobInfo], result: Callable[[str], Call[A]]) -> Job[A]:
        """Start the job of a call."""
        return Job(self._client, self._client.send(call), result)


class AsyncJobs(JobOperations):
    """Jobs of a client that is awaited."""

    def __init__(self, client: "AsyncClient") -> None:
        self._client = client

    async def start(self, call: Call[JobInfo], result: Callable[[str], Call[A]]) -> AsyncJob[A]:
        """Start the job of a call."""
        return AsyncJob(self._client, await self._client.send(call), result)
