"""A process of its own: warm between calls, killed when it takes too long, replaced when it dies, gone at the end."""

import os
import threading
import time
from collections.abc import Iterator
from pathlib import Path

import pytest

from app.api.isolated import Isolated

LONG = 30.0


@pytest.fixture
def isolated() -> Iterator[Isolated]:
    process = Isolated()
    yield process
    process.close()


def double(value: int) -> int:
    return 2 * value


def own_pid(_: int) -> int:
    return os.getpid()


def sleep(seconds: float) -> float:
    time.sleep(seconds)
    return seconds


def die(code: int) -> None:
    os._exit(code)


def fail(text: str) -> None:
    raise ValueError(text)


def wait_until_gone(pid: int) -> None:
    until = time.monotonic() + 5
    while Path(f"/proc/{pid}").exists():
        assert time.monotonic() < until, "the process is still there, or a zombie"
        time.sleep(0.01)


def test_nothing_runs_before_the_first_call_and_the_process_stays_warm(isolated: Isolated) -> None:
    assert isolated.pid is None
    assert isolated.run(double, 21, LONG) == 42
    first = isolated.run(own_pid, 0, LONG)
    assert first == isolated.pid != os.getpid()
    assert isolated.run(own_pid, 0, LONG) == first


def test_a_call_that_takes_too_long_is_ended_and_the_next_one_answered(isolated: Isolated) -> None:
    pid = isolated.run(own_pid, 0, LONG)
    started = time.monotonic()
    with pytest.raises(TimeoutError):
        isolated.run(sleep, 60.0, 0.5)
    assert time.monotonic() - started < 3
    wait_until_gone(pid)
    assert isolated.run(own_pid, 0, LONG) != pid


def test_a_process_that_dies_is_replaced(isolated: Isolated) -> None:
    with pytest.raises(ChildProcessError):
        isolated.run(die, 3, LONG)
    assert isolated.run(double, 1, LONG) == 2


def test_a_process_that_was_killed_between_calls_is_replaced(isolated: Isolated) -> None:
    pid = isolated.run(own_pid, 0, LONG)
    os.kill(pid, 9)
    time.sleep(0.2)
    assert isolated.run(own_pid, 0, LONG) != pid


def test_an_error_comes_back_as_it_was_raised(isolated: Isolated) -> None:
    with pytest.raises(ValueError, match="no such thing"):
        isolated.run(fail, "no such thing", LONG)
    assert isolated.run(double, 2, LONG) == 4


def test_one_call_runs_at_a_time_and_the_others_wait_within_their_own_time(isolated: Isolated) -> None:
    isolated.run(double, 0, LONG)
    slow = threading.Thread(target=isolated.run, args=(sleep, 1.0, LONG))
    slow.start()
    time.sleep(0.1)
    with pytest.raises(TimeoutError):
        isolated.run(double, 1, 0.2)
    assert isolated.run(double, 2, LONG) == 4
    slow.join()


def test_without_time_nothing_is_begun(isolated: Isolated) -> None:
    with pytest.raises(TimeoutError):
        isolated.run(double, 1, 0.0)
    assert isolated.pid is None


def test_a_process_that_is_still_starting_is_not_begun_anew(
    isolated: Isolated, monkeypatch: pytest.MonkeyPatch
) -> None:
    monkeypatch.setattr("app.api.isolated._SHORTEST", 0.0)
    with pytest.raises(TimeoutError, match="start"):
        isolated.run(double, 1, 0.001)
    pid = isolated.pid
    assert isolated.run(own_pid, 0, LONG) == pid


def test_closing_ends_a_call_in_flight_and_leaves_nothing_behind(isolated: Isolated) -> None:
    pid = isolated.run(own_pid, 0, LONG)
    outcome: list[BaseException] = []

    def call() -> None:
        try:
            isolated.run(sleep, 60.0, LONG)
        except ChildProcessError as error:
            outcome.append(error)

    thread = threading.Thread(target=call)
    thread.start()
    time.sleep(0.2)
    started = time.monotonic()
    isolated.close()
    thread.join(5)
    assert time.monotonic() - started < 2
    assert len(outcome) == 1
    wait_until_gone(pid)
    with pytest.raises(ChildProcessError):
        isolated.run(double, 1, LONG)
