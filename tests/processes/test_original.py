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

from app.processes.original import NUMBER, WARM_UP, Original


@contextlib.contextmanager
def original_of(copy: "subprocess.Popen[bytes]") -> Iterator[tuple[Original, socket.socket]]:
    """One that takes a process for a copy of its own, and the other end of that one's lifeline."""
    (far, control), (ours, theirs) = socket.socketpair(), socket.socketpair()
    original = Original(control, lambda: True, lambda: None, lambda _: None)
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
def running(
    is_compiled: bool, warm_up: str, tmp_path: Path
) -> Iterator[tuple["subprocess.Popen[bytes]", socket.socket]]:
    """One in a process of its own, which does something for its warming up, and the socket that it is asked on."""
    ours, theirs = socket.socketpair(socket.AF_UNIX, socket.SOCK_SEQPACKET)
    program = f"""
import os, socket, time
from pathlib import Path
from app.processes.original import Original
def warm_up():
    with Path({str(tmp_path / "worked")!r}).open("a") as file: file.write(f"{{os.getpid()}}\\n")
    {warm_up}
Original(socket.socket(fileno={theirs.fileno()}), lambda: {is_compiled}, warm_up, lambda _: None).run()
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


@pytest.mark.parametrize("is_compiled", [False, True])
def test_what_must_be_compiled_is_compiled_by_another_process_before(is_compiled: bool, tmp_path: Path) -> None:
    """So that the memory that this takes is not kept; where all is compiled nobody waits for another process."""
    with running(is_compiled, "pass", tmp_path) as (original, control):
        with told_when_warm(control) as told:
            assert told.recv(1) == b""
        with told_when_warm(control) as told:
            assert told.recv(1) == b"", "requests are taken as before"
    processes = [int(line) for line in (tmp_path / "worked").read_text().splitlines()]
    others = [pid for pid in processes if pid != original.pid]
    assert processes == ([original.pid] * 2 if is_compiled else [others[0], original.pid, others[1], original.pid])


def test_nobody_compiles_on_for_a_service_that_has_ended(tmp_path: Path) -> None:
    with running(False, "time.sleep(600)", tmp_path) as (original, control), told_when_warm(control) as told:
        until = time.monotonic() + 60.0
        while not (tmp_path / "worked").exists() and time.monotonic() < until:
            time.sleep(0.1)
        assert original.stdin is not None
        original.stdin.close()
        assert original.wait(60.0) == 0
        assert told.recv(1) == b"", "the compiler held the other end as long as it lived"
