"""The pool for a thread that waits: results, ends that are in time, and a request that nobody waits for."""

import asyncio
import time
from collections.abc import Awaitable, Callable
from typing import Any

import pytest

from gelenk.errors import ServiceBusy
from gelenk.http.workers.blocking_pool_client import BlockingPoolClient
from gelenk.pool.pool import WorkerPool
from tests.pool import calls
from tests.pool.test_pool import LONG, at_work, with_pool


def of_a_thread(
    test: Callable[[WorkerPool, Callable[..., Awaitable[Any]], BlockingPoolClient], Awaitable[None]], waiting: int = 5
) -> None:
    async def run(pool: WorkerPool) -> None:
        blocking_client = BlockingPoolClient(pool)

        def ask(function: Callable[[Any], Any], argument: Any, seconds: float = LONG) -> Awaitable[Any]:
            return asyncio.to_thread(blocking_client.run, function, argument, seconds)

        await test(pool, ask, blocking_client)

    with_pool(run, count=1, waiting=waiting)


def test_results_and_errors_are_the_function_s() -> None:
    async def test(_: WorkerPool, ask: Callable[..., Awaitable[Any]], _elsewhere: BlockingPoolClient) -> None:
        assert await ask(calls.double, 21) == 42
        with pytest.raises(ValueError, match="wrong"):
            await ask(calls.fail, "wrong")
        with pytest.raises(ChildProcessError, match="died"):
            await ask(calls.leave, 3)
        assert await ask(calls.double, 4) == 8

    of_a_thread(test)


def test_what_takes_too_long_is_ended_in_time() -> None:
    async def test(_: WorkerPool, ask: Callable[..., Awaitable[Any]], _elsewhere: BlockingPoolClient) -> None:
        began = time.monotonic()
        with pytest.raises(TimeoutError):
            await ask(calls.sleep, LONG, 0.3)
        with pytest.raises(TimeoutError):
            await ask(calls.double, 1, -1.0)
        assert time.monotonic() - began < 10
        assert await ask(calls.double, 4) == 8

    of_a_thread(test)


def test_a_full_crew_says_so() -> None:
    async def test(pool: WorkerPool, ask: Callable[..., Awaitable[Any]], blocking_client: BlockingPoolClient) -> None:
        at_it = asyncio.ensure_future(ask(calls.sleep, LONG))
        await at_work(pool, 1)
        with pytest.raises(ServiceBusy):
            await asyncio.to_thread(BlockingPoolClient(pool).run, calls.double, 1, LONG)
        blocking_client.end()
        with pytest.raises(ChildProcessError):
            await at_it

    of_a_thread(test, waiting=0)


def test_what_nobody_waits_for_is_broken_off() -> None:
    async def test(pool: WorkerPool, ask: Callable[..., Awaitable[Any]], blocking_client: BlockingPoolClient) -> None:
        at_it = asyncio.ensure_future(ask(calls.sleep, LONG))
        await at_work(pool, 1)
        blocking_client.end()
        with pytest.raises(ChildProcessError, match="no longer waits"):
            await at_it
        with pytest.raises(ChildProcessError, match="no longer waits"):
            await ask(calls.double, 1)
        assert await pool.run(calls.double, 21, LONG) == 42

    of_a_thread(test)
