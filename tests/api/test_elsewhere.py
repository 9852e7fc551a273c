"""The crew for a thread that waits: results, ends that are in time, and a request that nobody waits for."""

import asyncio
import time
from collections.abc import Awaitable, Callable
from typing import Any

import pytest

from gelenk.api.elsewhere import Elsewhere
from gelenk.crew.crew import Crew
from gelenk.model.errors import ServiceBusy
from tests.crew import calls
from tests.crew.test_crew import LONG, at_work, with_crew


def of_a_thread(
    test: Callable[[Crew, Callable[..., Awaitable[Any]], Elsewhere], Awaitable[None]], waiting: int = 5
) -> None:
    async def run(crew: Crew) -> None:
        elsewhere = Elsewhere(crew)

        def ask(function: Callable[[Any], Any], argument: Any, seconds: float = LONG) -> Awaitable[Any]:
            return asyncio.to_thread(elsewhere.run, function, argument, seconds)

        await test(crew, ask, elsewhere)

    with_crew(run, count=1, waiting=waiting)


def test_results_and_errors_are_the_function_s() -> None:
    async def test(_: Crew, ask: Callable[..., Awaitable[Any]], _elsewhere: Elsewhere) -> None:
        assert await ask(calls.double, 21) == 42
        with pytest.raises(ValueError, match="wrong"):
            await ask(calls.fail, "wrong")
        with pytest.raises(ChildProcessError, match="died"):
            await ask(calls.leave, 3)
        assert await ask(calls.double, 4) == 8

    of_a_thread(test)


def test_what_takes_too_long_is_ended_in_time() -> None:
    async def test(_: Crew, ask: Callable[..., Awaitable[Any]], _elsewhere: Elsewhere) -> None:
        began = time.monotonic()
        with pytest.raises(TimeoutError):
            await ask(calls.sleep, LONG, 0.3)
        with pytest.raises(TimeoutError):
            await ask(calls.double, 1, -1.0)
        assert time.monotonic() - began < 10
        assert await ask(calls.double, 4) == 8

    of_a_thread(test)


def test_a_full_crew_says_so() -> None:
    async def test(crew: Crew, ask: Callable[..., Awaitable[Any]], elsewhere: Elsewhere) -> None:
        at_it = asyncio.ensure_future(ask(calls.sleep, LONG))
        await at_work(crew, 1)
        with pytest.raises(ServiceBusy):
            await asyncio.to_thread(Elsewhere(crew).run, calls.double, 1, LONG)
        elsewhere.end()
        with pytest.raises(ChildProcessError):
            await at_it

    of_a_thread(test, waiting=0)


def test_what_nobody_waits_for_is_broken_off() -> None:
    async def test(crew: Crew, ask: Callable[..., Awaitable[Any]], elsewhere: Elsewhere) -> None:
        at_it = asyncio.ensure_future(ask(calls.sleep, LONG))
        await at_work(crew, 1)
        elsewhere.end()
        with pytest.raises(ChildProcessError, match="no longer waits"):
            await at_it
        with pytest.raises(ChildProcessError, match="no longer waits"):
            await ask(calls.double, 1)
        assert await crew.run(calls.double, 21, LONG) == 42

    of_a_thread(test)
