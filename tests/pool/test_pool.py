"""The pool: calls that crash, hang, take too much or lose their caller fail alone, and the pool is whole again."""

import asyncio
import json
import os
import signal
import subprocess
import sys
import time
from collections.abc import Awaitable, Callable
from pathlib import Path
from pickle import PickleBuffer
from typing import Any

import pytest

from gelenk.errors import DeadlineExceeded, ServiceBusy, ServiceStopping, WorkerCrashed, WorkerOutOfMemory
from gelenk.pool.pool import WorkerPool
from gelenk.processes.wire import PIECE
from gelenk.processes.worker_process import WorkerProcess
from tests.jobs.parts import gone
from tests.pool import calls
from tests.speed import times_as_slow

LONG = 60.0
MEMORY = 300 * 1024**2


def with_pool(
    test: Callable[[WorkerPool], Awaitable[None]], count: int = 2, waiting: int = 10, memory: int = MEMORY
) -> None:
    async def run() -> None:
        pool = WorkerPool(count, waiting, memory)
        try:
            await pool.start()
            await test(pool)
        finally:
            pids = pool.pids
            pool.close()
        assert all(gone(pid) for pid in pids)

    asyncio.run(run())


async def at_work(pool: WorkerPool, count: int) -> None:
    async with asyncio.timeout(LONG):
        while pool.requests.busy < count:
            await asyncio.sleep(0.005)


async def seconds_to_whole(pool: WorkerPool) -> float:
    """How long it takes until every process is at work again, all of them at the same time."""
    began = time.monotonic()
    at_work_again = [asyncio.create_task(pool.run(calls.sleep, 1.0, LONG)) for _ in range(pool.size)]
    await at_work(pool, pool.size)
    seconds = time.monotonic() - began
    assert await asyncio.gather(*at_work_again) == [1.0] * pool.size
    return seconds


@pytest.mark.slow
def test_processes_have_everything_loaded_and_stay() -> None:
    async def test(pool: WorkerPool) -> None:
        assert len(pool.pids) == 2
        found = await pool.run(calls.loaded_modules, None, LONG)
        assert found >= {"gelenk.main", "numba", "pinocchio"}
        pids = {await pool.run(calls.own_pid, None, LONG) for _ in range(5)}
        assert pids <= set(pool.pids)
        assert os.getpid() not in pids
        assert pool.requests.restarts == 0

    with_pool(test)


@pytest.mark.slow
def test_processes_that_begin_later_have_what_is_seldom_needed_too() -> None:
    """All of it, once a call has loaded some of it; not while the service starts."""

    async def test(pool: WorkerPool) -> None:
        await pool.run(calls.load, "sympy", LONG)
        async with asyncio.timeout(LONG):
            while not await pool.run(calls.loaded_modules, None, LONG) >= {"sympy", "matplotlib.figure"}:
                await asyncio.sleep(3.0)
                with pytest.raises(WorkerCrashed):
                    await pool.run(calls.die, signal.SIGKILL, LONG)

    with_pool(test, count=1)


@pytest.mark.slow
def test_a_process_that_loaded_modules_of_its_own_makes_room_for_one_that_shares_them() -> None:
    """Some seconds later; in a service of its own, whose fork server has not loaded them yet."""
    program = (
        "import asyncio; from gelenk.pool.pool import WorkerPool; from tests.pool import calls\n"
        "async def run():\n"
        "    pool = WorkerPool(1, 1, 10**9)\n"
        "    await pool.run(calls.load, 'sympy', 60.0)\n"
        "    for seconds in (0.0, 25.0):\n"
        "        await asyncio.sleep(seconds)\n"
        "        print(await pool.run(calls.own_pid, None, 60.0), await pool.run(calls.loaded_modules, None, 60.0))\n"
        "    pool.close()\n"
        "asyncio.run(run())"
    )
    done = subprocess.run([sys.executable, "-c", program], capture_output=True, text=True, timeout=300, check=True)
    first, later = (line.split(maxsplit=1) for line in done.stdout.splitlines())
    assert first[0] == later[0], "its last call is the one after which it makes room"
    assert "sympy" in first[1]
    assert "matplotlib.figure" not in first[1]
    assert "matplotlib.figure" in later[1]


@pytest.mark.slow
def test_what_a_process_logs_is_a_line_of_json(tmp_path: Path) -> None:
    """On the standard error stream of a service, whose log it is part of."""
    program = (
        "import asyncio; from gelenk.pool.pool import WorkerPool; from tests.pool import calls\n"
        "async def run():\n"
        "    pool = WorkerPool(1, 1, 10**9)\n"
        "    await pool.run(calls.log, 'two\\nlines', 60.0)\n"
        "    pool.close()\n"
        "asyncio.run(run())"
    )
    environment = {**os.environ, "GELENK_DATA_DIR": str(tmp_path)}
    run = subprocess.run(
        [sys.executable, "-c", program], env=environment, capture_output=True, text=True, timeout=120, check=True
    )
    said, warned = (json.loads(line) for line in run.stderr.splitlines())
    assert (said["level"], said["logger"], said["message"]) == ("warning", "gelenk", "two\nlines")
    assert (warned["level"], warned["logger"]) == ("warning", "py.warnings")
    assert "beware two" in warned["message"]


@pytest.mark.parametrize("size", [0, 1, PIECE - 1, PIECE, 3 * PIECE + 5, 20_000_000])
def test_large_bytes_come_through(size: int) -> None:
    content = os.urandom(size)

    async def test(pool: WorkerPool) -> None:
        pieces = [PickleBuffer(content[: size // 3]), PickleBuffer(content[size // 3 :])]
        back = await pool.run(calls.reversed_bytes, pieces, LONG)
        assert b"".join(back) == content[::-1]
        assert all(len(memoryview(piece)) <= PIECE for piece in back)

    with_pool(test, 1)


@pytest.mark.quick(1)
@pytest.mark.parametrize("how", [signal.SIGKILL, signal.SIGSEGV, signal.SIGABRT])
def test_a_crash_fails_its_own_call_alone(how: signal.Signals) -> None:
    async def test(pool: WorkerPool) -> None:
        other = asyncio.create_task(pool.run(calls.sleep, 1.0, LONG))
        await at_work(pool, 1)
        with pytest.raises(WorkerCrashed, match=how.name):
            await pool.run(calls.die, how, LONG)
        assert await pool.run(calls.double, 4, LONG) == 8
        assert await other == 1.0
        assert pool.requests.restarts == 1

    with_pool(test)


def test_an_exit_is_a_crash() -> None:
    async def test(pool: WorkerPool) -> None:
        with pytest.raises(WorkerCrashed, match="exit code 3"):
            await pool.run(calls.leave, 3, LONG)

    with_pool(test, 1)


@pytest.mark.slow
def test_capacity_is_whole_within_a_second_whatever_happened() -> None:
    """The best of three of each: the machine that this runs on has other work too."""

    async def crash(pool: WorkerPool) -> None:
        found = await asyncio.gather(
            *(pool.run(calls.die, signal.SIGKILL, LONG) for _ in range(pool.size)), return_exceptions=True
        )
        assert all(isinstance(error, WorkerCrashed) for error in found)

    async def hang(pool: WorkerPool) -> None:
        found = await asyncio.gather(
            *(pool.run(calls.sleep, 60.0, 0.2) for _ in range(pool.size)), return_exceptions=True
        )
        assert all(isinstance(error, DeadlineExceeded) for error in found)

    async def exhaust(pool: WorkerPool) -> None:
        found = await asyncio.gather(
            *(pool.run(calls.take, 400, LONG) for _ in range(pool.size)), return_exceptions=True
        )
        assert all(isinstance(error, WorkerOutOfMemory) for error in found)

    async def test(pool: WorkerPool) -> None:
        for fault in (crash, hang, exhaust):
            seconds = []
            for _ in range(3):
                before = set(pool.pids)
                await fault(pool)
                seconds.append(await seconds_to_whole(pool) / times_as_slow())
                assert not before & set(pool.pids)
            assert min(seconds) < 1.0, (fault.__name__, seconds)

    with_pool(test)


def test_a_hang_is_ended_at_its_deadline() -> None:
    async def test(pool: WorkerPool) -> None:
        (pid,) = pool.pids
        began = time.monotonic()
        with pytest.raises(DeadlineExceeded):
            await pool.run(calls.sleep, 60.0, 0.3)
        assert 0.3 <= time.monotonic() - began < 30.0
        assert await pool.run(calls.double, 1, LONG) == 2
        assert gone(pid)

    with_pool(test, 1)


def test_a_stopped_process_is_ended_too() -> None:
    async def test(pool: WorkerPool) -> None:
        (pid,) = pool.pids
        os.kill(pid, signal.SIGSTOP)
        with pytest.raises(DeadlineExceeded):
            await pool.run(calls.double, 1, 0.3)
        assert await pool.run(calls.double, 1, LONG) == 2

    with_pool(test, 1)


def test_memory_is_bounded_and_what_fits_is_computed() -> None:
    async def test(pool: WorkerPool) -> None:
        assert await pool.run(calls.take, 100, LONG) == 100 * 125_000
        with pytest.raises(WorkerOutOfMemory):
            await pool.run(calls.take, 400, LONG)
        assert await pool.run(calls.take, 100, LONG) == 100 * 125_000

    with_pool(test, 1)


def test_a_process_that_has_grown_makes_room_for_a_fresh_one() -> None:
    async def test(pool: WorkerPool) -> None:
        first = await pool.run(calls.keep, 100, LONG)
        assert await pool.run(calls.keep, 100, LONG) == first
        assert await pool.run(calls.keep, 1, LONG) != first
        assert pool.requests.restarts == 0, "it was no fault"

    with_pool(test, 1)


def test_a_process_killed_between_calls_costs_no_call() -> None:
    async def test(pool: WorkerPool) -> None:
        killed = list(pool.pids)
        for pid in killed:
            os.kill(pid, signal.SIGKILL)
        async with asyncio.timeout(LONG):
            while not all(gone(pid) for pid in killed):
                await asyncio.sleep(0.005)
        assert await pool.run(calls.double, 1, LONG) == 2

    with_pool(test)


@pytest.mark.slow
def test_who_leaves_takes_the_work_along() -> None:
    async def test(pool: WorkerPool) -> None:
        (pid,) = pool.pids
        call = asyncio.create_task(pool.run(calls.sleep, 600.0, LONG))
        await at_work(pool, 1)
        call.cancel()
        with pytest.raises(asyncio.CancelledError):
            await call
        assert await pool.run(calls.own_pid, None, LONG) != pid
        async with asyncio.timeout(LONG):
            while not gone(pid):
                await asyncio.sleep(0.005)

    with_pool(test, 1)


def test_who_leaves_the_queue_costs_nothing(tmp_path: Path) -> None:
    mark = tmp_path / "mark"

    async def test(pool: WorkerPool) -> None:
        first = asyncio.create_task(pool.run(calls.wait, str(mark), LONG))
        await at_work(pool, 1)
        second = asyncio.create_task(pool.run(calls.sleep, 60.0, LONG))
        third = asyncio.create_task(pool.run(calls.double, 3, LONG))
        await asyncio.sleep(0.05)
        assert len(pool.requests.turns) == 2
        second.cancel()
        mark.touch()
        assert await third == 6
        await first
        assert (len(pool.requests.turns), pool.requests.restarts) == (0, 0)

    with_pool(test, 1)


@pytest.mark.slow
def test_a_full_queue_refuses_at_once_and_says_when(tmp_path: Path) -> None:
    mark = tmp_path / "mark"

    async def test(pool: WorkerPool) -> None:
        running = [asyncio.create_task(pool.run(calls.wait, str(mark), LONG)) for _ in range(3)]
        await at_work(pool, 1)
        with pytest.raises(ServiceBusy) as refused:
            await pool.run(calls.double, 1, LONG)
        assert not any(task.done() for task in running), "it has waited for none of them"
        assert refused.value.retry_after >= 1
        assert pool.refused == 1
        mark.touch()
        await asyncio.gather(*running)

    with_pool(test, 1, waiting=2)


@pytest.mark.slow
def test_a_crowd_is_told_to_come_back_over_a_longer_time_the_larger_it_is(tmp_path: Path) -> None:
    mark = tmp_path / "mark"

    async def test(pool: WorkerPool) -> None:
        pool.requests.seconds_a_call = 0.2
        running = [asyncio.create_task(pool.run(calls.wait, str(mark), LONG)) for _ in range(3)]
        await at_work(pool, 1)
        told = []
        for _ in range(200):
            with pytest.raises(ServiceBusy) as refused:
                pool.check_room()
            told.append(refused.value.retry_after)
        assert told[0] <= 2 < told[-1] <= 10
        assert told == sorted(told)
        mark.touch()
        await asyncio.gather(*running)

    with_pool(test, 1, waiting=2)


def test_whether_there_is_room_is_told_beforehand(tmp_path: Path) -> None:
    mark = tmp_path / "mark"

    async def test(pool: WorkerPool) -> None:
        pool.check_room()
        running = asyncio.create_task(pool.run(calls.wait, str(mark), LONG))
        await at_work(pool, 1)
        with pytest.raises(ServiceBusy):
            pool.check_room()
        mark.touch()
        await running
        pool.check_room()
        assert pool.refused == 1

    with_pool(test, 1, waiting=0)


def test_a_turn_that_does_not_come_in_time_is_given_up(tmp_path: Path) -> None:
    mark = tmp_path / "mark"

    async def test(pool: WorkerPool) -> None:
        running = asyncio.create_task(pool.run(calls.wait, str(mark), LONG))
        await at_work(pool, 1)
        with pytest.raises(ServiceBusy):
            await pool.run(calls.double, 1, 0.1)
        mark.touch()
        await running
        assert (len(pool.requests.turns), pool.requests.restarts) == (0, 0)

    with_pool(test, 1)


@pytest.mark.slow
def test_what_the_start_takes_is_no_part_of_the_wait_for_a_turn(monkeypatch: pytest.MonkeyPatch) -> None:
    """Where kernels are compiled it takes a minute or two."""
    start = WorkerProcess.start

    def slow(*arguments: Any) -> Any:
        time.sleep(4.0)
        return start(*arguments)

    monkeypatch.setattr(WorkerProcess, "start", slow)

    async def run() -> None:
        pool = WorkerPool(1, 10, MEMORY)
        starting = asyncio.create_task(pool.start())
        await asyncio.sleep(0.0)
        assert pool.is_starting
        assert await pool.run(calls.sleep, 0.0, 3.0) == 0.0
        await starting
        assert not pool.is_starting
        pool.close()

    asyncio.run(run())


def test_calls_get_their_turn_in_order() -> None:
    async def test(pool: WorkerPool) -> None:
        order: list[int] = []

        async def one(number: int) -> None:
            await pool.run(calls.double, number, LONG)
            order.append(number)

        await asyncio.gather(*(one(number) for number in range(8)))
        assert order == list(range(8))

    with_pool(test, 1)


def test_who_comes_late_need_not_wait_for_who_has_all_processes() -> None:
    async def test(pool: WorkerPool) -> None:
        pids = set(pool.pids)
        heavy = [asyncio.create_task(pool.run(calls.sleep, LONG, LONG, "heavy")) for _ in range(6)]
        await at_work(pool, 2)
        assert set(pool.pids) == pids, "one client alone has as many as there are"
        light = [await pool.run(calls.own_pid, None, LONG, "light") for _ in range(20)]
        assert not any(task.done() for task in heavy)
        assert len(set(light)) == 1, "it is not started anew for each call"
        assert not pids & {*light}
        for task in heavy:
            task.cancel()
        async with asyncio.timeout(LONG):
            while len(pool.pids) > pool.size:
                await asyncio.sleep(0.02)

    with_pool(test, 2)


@pytest.mark.slow
def test_a_process_that_is_kept_for_a_client_who_has_left_is_taken() -> None:
    async def test(pool: WorkerPool) -> None:
        assert await pool.run(calls.double, 1, LONG, "light") == 2
        heavy = [asyncio.create_task(pool.run(calls.sleep, LONG, LONG, "heavy")) for _ in range(2)]
        await at_work(pool, 1)
        assert len(pool.requests.turns) == 1
        await at_work(pool, 2)
        assert not any(task.done() for task in heavy)
        for task in heavy:
            task.cancel()

    with_pool(test, 2)


def test_an_error_comes_back_with_its_trace() -> None:
    async def test(pool: WorkerPool) -> None:
        with pytest.raises(ValueError, match="no such thing") as raised:
            await pool.run(calls.fail, "no such thing", LONG)
        assert "in fail" in raised.value.__notes__[0]
        with pytest.raises(RuntimeError, match="Unsendable: 1 and 2"):
            await pool.run(calls.fail_unsendably, None, LONG)
        assert pool.requests.restarts == 0

    with_pool(test, 1)


def test_the_end_breaks_off_what_runs_and_what_waits() -> None:
    async def test(pool: WorkerPool) -> None:
        (pid,) = pool.pids
        running = asyncio.create_task(pool.run(calls.sleep, 60.0, LONG))
        await at_work(pool, 1)
        waiting = asyncio.create_task(pool.run(calls.double, 1, LONG))
        await asyncio.sleep(0.05)
        began = time.monotonic()
        pool.close()
        for task in (running, waiting):
            with pytest.raises(ServiceStopping):
                await task
        assert time.monotonic() - began < 30.0
        assert gone(pid)
        with pytest.raises(ServiceStopping):
            await pool.run(calls.double, 1, LONG)

    with_pool(test, 1)
