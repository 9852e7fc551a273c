"""Processes for parts of jobs: warm, replaced when they die, killed when what they do is no longer wanted."""

import os
import time
from collections.abc import Iterator
from concurrent.futures import CancelledError
from dataclasses import replace
from pathlib import Path

import pytest

from gelenk.jobs.workers import Cancelled, OutOfTime
from gelenk.pool.pool import BACKGROUND
from tests.jobs.parts import double, fail, gone, killed, own_pid, sleep
from tests.jobs.workers import Workers

SOON = 60.0


@pytest.fixture(scope="module")
def workers() -> Iterator[Workers]:
    pool = Workers(2)
    yield pool
    pool.close()


def soon(seconds: float = SOON) -> float:
    return time.monotonic() + seconds


def at_work(workers: Workers, count: int) -> None:
    """Wait until so many processes have something to do."""
    deadline = soon()
    while workers.pool.background.busy < count:
        assert time.monotonic() < deadline
        time.sleep(0.01)


def test_nothing_runs_before_the_first_part_and_nothing_is_left_at_the_end() -> None:
    pool = Workers(2)
    assert pool.pids == []
    assert pool.submit(double, 21, soon()).result(SOON) == 42
    pids = [pool.submit(own_pid, 0, soon()).result(SOON), *pool.pids]
    slow, waiting = pool.submit(sleep, 600.0, soon(900.0)), [pool.submit(sleep, 600.0, soon(900.0)) for _ in range(3)]
    at_work(pool, 2)
    started = time.monotonic()
    pool.close()
    assert time.monotonic() - started < SOON
    for future in (slow, *waiting):
        with pytest.raises(Cancelled):
            future.result(SOON)
    assert all(gone(pid) for pid in pids)
    with pytest.raises(Cancelled):
        pool.submit(double, 1, soon())


@pytest.mark.slow
def test_parts_are_shared_by_the_processes_that_stay_warm(workers: Workers) -> None:
    mine = soon()
    for future in [workers.submit(sleep, 0.3, mine) for _ in range(4)]:
        future.result(SOON)
    deadline = soon()
    while len(first := set(workers.pids)) < 2:  # the second one may begin late
        assert time.monotonic() < deadline
        time.sleep(0.01)
    assert {workers.submit(own_pid, 0, mine).result(SOON) for _ in range(6)} <= first


def test_an_error_comes_back_as_it_was_raised(workers: Workers) -> None:
    with pytest.raises(ValueError, match="no such thing"):
        workers.submit(fail, "no such thing", soon()).result(SOON)


@pytest.mark.slow
def test_a_part_whose_process_is_killed_is_tried_three_times(workers: Workers, tmp_path: Path) -> None:
    for times in (1, 2):
        assert workers.submit(killed, (str(tmp_path / f"{times}"), times), soon()).result(SOON) == 1
    with pytest.raises(ChildProcessError, match="died 3 times"):
        workers.submit(killed, (str(tmp_path / "always"), 99), soon()).result(SOON)
    assert (tmp_path / "always").read_bytes() == b"..."
    assert workers.submit(double, 4, soon()).result(SOON) == 8


def test_a_process_that_is_killed_from_outside_is_replaced(workers: Workers) -> None:
    for _ in range(2):
        workers.submit(double, 1, soon()).result(SOON)
    for pid in workers.pids:
        os.kill(pid, 9)
    assert [workers.submit(double, i, soon()).result(SOON) for i in range(4)] == [0, 2, 4, 6]


@pytest.mark.slow
def test_what_hangs_is_killed_when_it_is_cancelled_and_nothing_else_is(workers: Workers) -> None:
    hanging, beside = workers.submit(sleep, 600.0, soon(900.0)), workers.submit(sleep, 5.0, soon())
    at_work(workers, 2)
    pids = workers.pids
    started = time.monotonic()
    hanging.cancel()
    with pytest.raises(CancelledError):
        hanging.result(SOON)
    while not any(gone(pid) for pid in pids):
        assert time.monotonic() < started + SOON
        time.sleep(0.02)
    assert time.monotonic() > started + 0.5, "it may finish within the grace time"
    assert beside.result(SOON) == 5.0
    assert sum(gone(pid) for pid in pids) == 1


@pytest.mark.slow
def test_what_is_cancelled_and_finishes_soon_costs_no_process(monkeypatch: pytest.MonkeyPatch) -> None:
    monkeypatch.setattr("gelenk.pool.pool.BACKGROUND", replace(BACKGROUND, grace_seconds=SOON))
    pool = Workers(1)
    try:
        pid = pool.submit(own_pid, 0, soon()).result(SOON)
        hanging, deadline = pool.submit(sleep, 0.5, soon()), soon()
        at_work(pool, 1)
        hanging.cancel()
        while pool.pool.background.busy:
            assert time.monotonic() < deadline
            time.sleep(0.01)
        assert pool.submit(own_pid, 0, soon()).result(SOON) == pid
    finally:
        pool.close()


def test_what_takes_too_long_is_killed(workers: Workers) -> None:
    with pytest.raises(OutOfTime):
        workers.submit(sleep, 60.0, soon(0.6)).result(SOON)
    assert workers.submit(double, 1, soon()).result(SOON) == 2


def test_a_process_without_work_is_let_go(monkeypatch: pytest.MonkeyPatch) -> None:
    monkeypatch.setattr("gelenk.pool.pool.BACKGROUND", replace(BACKGROUND, idle_seconds=0.2))
    pool = Workers(1)
    try:
        pid = pool.submit(own_pid, 0, soon()).result(SOON)
        deadline = soon()
        while not gone(pid):
            assert time.monotonic() < deadline
            time.sleep(0.02)
        assert pool.submit(own_pid, 0, soon()).result(SOON) != pid
    finally:
        pool.close()
