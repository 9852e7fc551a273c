"""The process that others are copies of: what may come to it in one turn."""

import contextlib
import selectors
import signal
import socket
import subprocess
import sys
import time
from collections.abc import Iterator

from app.processes.original import NUMBER, Original


@contextlib.contextmanager
def original_of(copy: "subprocess.Popen[bytes]") -> Iterator[tuple[Original, socket.socket]]:
    """One that takes a process for a copy of its own, and the other end of that one's lifeline."""
    (far, control), (ours, theirs) = socket.socketpair(), socket.socketpair()
    original = Original(control, lambda: None, lambda _: None)
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
