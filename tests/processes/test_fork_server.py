"""The fork server: what may come to it in one turn."""

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

from gelenk.processes.fork_server import FORK, LOAD, NUMBER, SELDOM_NEEDED, WARM_UP, ForkServer


@contextlib.contextmanager
def fork_server_of(child: "subprocess.Popen[bytes]") -> Iterator[tuple[ForkServer, socket.socket]]:
    """One that takes a process for a child of its own, and the other end of that one's lifeline."""
    (far, control), (ours, theirs) = socket.socketpair(), socket.socketpair()
    fork_server = ForkServer(control, None)
    fork_server._lifelines[child.pid] = theirs
    fork_server._selector.register(theirs, selectors.EVENT_READ)
    try:
        yield fork_server, ours
    finally:
        fork_server._selector.close()
        for one in (far, control, ours, theirs, fork_server._wakes, fork_server._woken):
            one.close()


def test_a_child_that_ends_while_its_lifeline_is_closed_is_no_trouble() -> None:
    """Both are seen in one turn: what comes second finds the child gone."""
    child = subprocess.Popen([sys.executable, "-c", "pass"])
    with fork_server_of(child) as (fork_server, ours):
        fork_server._wakes.send(b".")
        until = time.monotonic() + 60.0
        while fork_server._lifelines and time.monotonic() < until:
            time.sleep(0.1)
            fork_server._wakes.send(b".")
            fork_server._reap()
        assert NUMBER.unpack(ours.recv(NUMBER.size)) == (0,)
        fork_server._kill_child(child.pid)
    child.returncode = 0  # it was waited for by `_reap`


def test_a_child_whose_lifeline_is_closed_is_killed() -> None:
    command = [sys.executable, "-c", "input()"]
    with subprocess.Popen(command, stdin=subprocess.PIPE) as child, fork_server_of(child) as (fork_server, _):
        fork_server._kill_child(child.pid)
        assert child.wait(60) == -signal.SIGKILL


@contextlib.contextmanager
def running(is_compiled: bool, part: str, tmp_path: Path) -> Iterator[tuple["subprocess.Popen[bytes]", socket.socket]]:
    """One in a process of its own, which does something for a part of its warming up, and the socket it is asked on."""
    ours, theirs = socket.socketpair(socket.AF_UNIX, socket.SOCK_SEQPACKET)
    program = f"""
import os, socket, time
from pathlib import Path
from types import SimpleNamespace
from gelenk.processes.fork_server import ForkServer
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
ForkServer(socket.socket(fileno={theirs.fileno()}), loaded).run()
"""
    command, descriptors = [sys.executable, "-c", program], [theirs.fileno()]
    with ours, theirs, subprocess.Popen(command, stdin=subprocess.PIPE, pass_fds=descriptors) as fork_server:
        try:
            yield fork_server, ours
        finally:
            fork_server.kill()


def told_when_warm(control: socket.socket) -> socket.socket:
    """What ends when the fork_server has warmed up."""
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
    with running(True, "pass", tmp_path) as (fork_server, control):
        for _ in range(2):
            with told_when_warm(control) as told:
                assert told.recv(1) == b""
    assert steps(tmp_path) == [(fork_server.pid, "all")] * 2


def test_what_must_be_compiled_is_compiled_by_other_processes_before(tmp_path: Path) -> None:
    """So that the memory that this takes is not kept: the basics first, then the parts side by side."""
    with running(False, "pass", tmp_path) as (fork_server, control), told_when_warm(control) as told:
        assert told.recv(1) == b""
    first, second, *parts, last = steps(tmp_path)
    assert (first[1], second, last) == ("basics", (fork_server.pid, "basics"), (fork_server.pid, "all"))
    assert sorted(what for _, what in parts) == ["first part", "second part"]
    assert len({pid for pid, _ in (first, *parts, last)}) == 4, "each in a process of its own"


def test_what_a_child_has_needed_is_loaded_for_those_after_it(tmp_path: Path) -> None:
    with running(True, "pass", tmp_path) as (fork_server, control):
        control.send(LOAD)
        with told_when_warm(control) as told:
            assert told.recv(1) == b""
    assert steps(tmp_path) == [(fork_server.pid, what) for what in (*SELDOM_NEEDED, "all")]


def test_processes_are_forked_as_soon_as_the_basics_are_there(tmp_path: Path) -> None:
    """While the parts are compiled, which takes a minute."""
    with running(False, "time.sleep(600)", tmp_path) as (_, control), told_when_warm(control) as told:
        (ours, theirs), (way, end) = socket.socketpair(), socket.socketpair()
        with ours, theirs, way, end:
            socket.send_fds(control, [FORK], [way.fileno(), theirs.fileno()])
            ours.settimeout(60.0)
            assert NUMBER.unpack(ours.recv(NUMBER.size))[0] > 0
        assert "all" not in {what for _, what in steps(tmp_path)}
        told.settimeout(0.1)
        with pytest.raises(TimeoutError):
            told.recv(1)


def test_nobody_compiles_on_for_a_service_that_has_ended(tmp_path: Path) -> None:
    with running(False, "time.sleep(600)", tmp_path) as (fork_server, control), told_when_warm(control) as told:
        until = time.monotonic() + 60.0
        while "first part" not in {what for _, what in steps(tmp_path)} and time.monotonic() < until:
            time.sleep(0.1)
        assert fork_server.stdin is not None
        fork_server.stdin.close()
        assert fork_server.wait(60.0) == 0
        assert told.recv(1) == b"", "the compiler held the other end as long as it lived"
