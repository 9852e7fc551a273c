"""The process that others are copies of: what may come to it in one turn."""

import contextlib
import selectors
import signal
import socket
import subprocess
import sys
import time
from collections.abc import Iterator
from pathlib import Path

import pytest

from gelenk.processes.fork_server import COPY, LOAD, NUMBER, SELDOM_NEEDED, WARM_UP, Original


@contextlib.contextmanager
def original_of(copy: "subprocess.Popen[bytes]") -> Iterator[tuple[Original, socket.socket]]:
    """One that takes a process for a copy of its own, and the other end of that one's lifeline."""
    (far, control), (ours, theirs) = socket.socketpair(), socket.socketpair()
    original = Original(control, None)
    original._lifelines[copy.pid] = theirs
    original._selector.register(theirs, selectors.EVENT_READ)
    try:
        yield original, ours
    finally:
        original._selector.close()
        for one in (far, control, ours, theirs, original._wakes, original._woken):
            one.close()


def test_a_copy_that_ends_while_its_lifeline_is_closed_is_no_trouble() -> None:
    """Both are seen in one turn: what comes second finds the copy gone."""
    copy = subprocess.Popen([sys.executable, "-c", "pass"])
    with original_of(copy) as (original, ours):
        original._wakes.send(b".")
        until = time.monotonic() + 20.0
        while original._lifelines and time.monotonic() < until:
            time.sleep(0.1)
            original._wakes.send(b".")
            original._reap()
        assert NUMBER.unpack(ours.recv(NUMBER.size)) == (0,)
        original._let_go(copy.pid)
    copy.returncode = 0  # it was waited for by `_reap`


def test_a_copy_whose_lifeline_is_closed_is_killed() -> None:
    command = [sys.executable, "-c", "input()"]
    with subprocess.Popen(command, stdin=subprocess.PIPE) as copy, original_of(copy) as (original, _):
        original._let_go(copy.pid)
        assert copy.wait(20) == -signal.SIGKILL


@contextlib.contextmanager
def running(is_compiled: bool, part: str, tmp_path: Path) -> Iterator[tuple["subprocess.Popen[bytes]", socket.socket]]:
    """One in a process of its own, which does something for a part of its warming up, and the socket it is asked on."""
    ours, theirs = socket.socketpair(socket.AF_UNIX, socket.SOCK_SEQPACKET)
    program = f"""
import os, socket, time
from pathlib import Path
from types import SimpleNamespace
from gelenk.processes.fork_server import Original
def note(what):
    with Path({str(tmp_path / "worked")!r}).open("a") as file: file.write(f"{{os.getpid()}} {{what}}\\n")
def first():
    note("first part")
    {part}
loaded = SimpleNamespace(
    is_compiled=lambda: {is_compiled},
    basics=lambda: note("basics"),
    PARTS=(first, lambda: note("second part")),
    warm_up=lambda: note("all"),
    load=note,
)
Original(socket.socket(fileno={theirs.fileno()}), loaded).run()
"""
    command, descriptors = [sys.executable, "-c", program], [theirs.fileno()]
    with ours, theirs, subprocess.Popen(command, stdin=subprocess.PIPE, pass_fds=descriptors) as original:
        try:
            yield original, ours
        finally:
            original.kill()


def told_when_warm(control: socket.socket) -> socket.socket:
    """What ends when the original has warmed up."""
    ours, theirs = socket.socketpair()
    with theirs:
        socket.send_fds(control, [WARM_UP], [theirs.fileno()])
    ours.settimeout(60.0)
    return ours


def steps(tmp_path: Path) -> list[tuple[int, str]]:
    """Who did what, in its order."""
    worked = tmp_path / "worked"
    lines = worked.read_text().splitlines() if worked.exists() else []
    return [(int(pid), what) for pid, what in (line.split(" ", 1) for line in lines)]


def test_where_all_is_compiled_nobody_waits_for_another_process(tmp_path: Path) -> None:
    with running(True, "pass", tmp_path) as (original, control):
        for _ in range(2):
            with told_when_warm(control) as told:
                assert told.recv(1) == b""
    assert steps(tmp_path) == [(original.pid, "all")] * 2


def test_what_must_be_compiled_is_compiled_by_other_processes_before(tmp_path: Path) -> None:
    """So that the memory that this takes is not kept: the basics first, then the parts side by side."""
    with running(False, "pass", tmp_path) as (original, control), told_when_warm(control) as told:
        assert told.recv(1) == b""
    first, second, *parts, last = steps(tmp_path)
    assert (first[1], second, last) == ("basics", (original.pid, "basics"), (original.pid, "all"))
    assert sorted(what for _, what in parts) == ["first part", "second part"]
    assert len({pid for pid, _ in (first, *parts, last)}) == 4, "each in a process of its own"


def test_what_a_copy_has_needed_is_loaded_for_those_after_it(tmp_path: Path) -> None:
    with running(True, "pass", tmp_path) as (original, control):
        control.send(LOAD)
        with told_when_warm(control) as told:
            assert told.recv(1) == b""
    assert steps(tmp_path) == [(original.pid, what) for what in (*SELDOM_NEEDED, "all")]


def test_copies_are_made_as_soon_as_the_basics_are_there(tmp_path: Path) -> None:
    """While the parts are compiled, which takes a minute."""
    with running(False, "time.sleep(600)", tmp_path) as (_, control), told_when_warm(control) as told:
        (ours, theirs), (way, end) = socket.socketpair(), socket.socketpair()
        with ours, theirs, way, end:
            socket.send_fds(control, [COPY], [way.fileno(), theirs.fileno()])
            ours.settimeout(60.0)
            assert NUMBER.unpack(ours.recv(NUMBER.size))[0] > 0
        assert "all" not in {what for _, what in steps(tmp_path)}
        told.settimeout(0.1)
        with pytest.raises(TimeoutError):
            told.recv(1)


def test_nobody_compiles_on_for_a_service_that_has_ended(tmp_path: Path) -> None:
    with running(False, "time.sleep(600)", tmp_path) as (original, control), told_when_warm(control) as told:
        until = time.monotonic() + 60.0
        while "first part" not in {what for _, what in steps(tmp_path)} and time.monotonic() < until:
            time.sleep(0.1)
        assert original.stdin is not None
        original.stdin.close()
        assert original.wait(60.0) == 0
        assert told.recv(1) == b"", "the compiler held the other end as long as it lived"
