"""A process of its own for each solver: one that crashes or hangs takes nobody along and is itself begun anew."""

import gc
import os
import time
from collections.abc import Callable
from functools import partial
from multiprocessing import get_context
from multiprocessing.connection import Connection
from typing import Any, NamedTuple
from unittest.mock import patch

import numpy as np

from gelenk.robot.arrays import Array
from tests.benchmarks.arms import Arm, Targets
from tests.benchmarks.peers import BatchPeer, Peer

PATIENCE = 300.0
"""After which a solver counts as hanging, [s]."""
WARM_UP = 10
BATCHES = 5
AGAIN, TRIES = 10, 3
"""How often a target is solved in one call to see what it costs inside, and how often that is tried."""
ONE_THREAD = {f"{library}_NUM_THREADS": "1" for library in ("OMP", "OPENBLAS", "MKL", "NUMBA")}


class Failed(Exception):
    """A solver has no answers for an arm; says why."""


class Run(NamedTuple):
    """What a solver did.

    Attributes:
        seconds: Of each solve; shape (N,).
        qs: Its answers, NaN where it gave none; shape (N, n).
        batch_seconds: Of one call with all targets, where there is such a call.
        batch_qs: The answers of that call.
        inside: Of each solve without the call around it: what a further one costs in the same call; shape (N,).
    """

    seconds: Array
    qs: Array
    batch_seconds: float | None = None
    batch_qs: Array | None = None
    inside: Array | None = None


class Attendant:
    """A process that answers whatever it is asked by one function, which begins anew when it has crashed or hangs.

    Args:
        answer: Called there with what is asked; returns the answer, or a string that says why there is none.
        one_core: Whether it is held on one core.
    """

    def __init__(self, answer: Callable[..., Any], one_core: bool) -> None:
        self._answer, self._one_core = answer, one_core
        self._start()

    def _start(self) -> None:
        context = get_context("spawn")
        self._pipe, theirs = context.Pipe()
        self._process = context.Process(target=serve, args=(self._answer, self._one_core, theirs), daemon=True)
        with patch.dict(os.environ, ONE_THREAD):
            self._process.start()
        theirs.close()

    def ask(self, *question: Any) -> Any:
        """Wait for the answer.

        Raises:
            Failed: There is none.
        """
        try:
            self._pipe.send(question)
            if not self._pipe.poll(PATIENCE):
                self._restart()
                raise Failed(f"no answer after {PATIENCE:.0f} s")
            answer = self._pipe.recv()
        except (EOFError, OSError):
            exit_code = self._restart()
            raise Failed(f"crashed, exit code {exit_code}") from None
        if isinstance(answer, str):
            raise Failed(answer)
        return answer

    def _restart(self) -> int | None:
        """Begin anew; returns with what the old process ended."""
        self._process.join(1.0)
        exit_code = self._process.exitcode
        self.stop()
        self._start()
        return exit_code

    def stop(self) -> None:
        """End the process."""
        self._process.kill()
        self._process.join()
        self._pipe.close()


class Worker(Attendant):
    """The process of one solver."""

    def __init__(self, peer: type[Peer]) -> None:
        self.peer = peer
        super().__init__(partial(solve_all, peer), peer.one_core)

    def run(self, arm: Arm, targets: Targets) -> Run:
        """Have all targets of an arm solved.

        Raises:
            Failed: There are no answers.
        """
        run = self.ask(arm, targets)
        assert isinstance(run, Run)
        return run


def serve(answer: Callable[..., Any], one_core: bool, pipe: Connection) -> None:
    """Answer until the other end is closed."""
    if one_core:
        os.sched_setaffinity(0, {min(os.sched_getaffinity(0))})
    while True:
        try:
            question = pipe.recv()
        except EOFError:
            return
        pipe.send(attempt(answer, question))


def attempt(answer: Callable[..., Any], question: tuple[Any, ...]) -> Any:
    """What a solver does, or why it does not."""
    try:
        return answer(*question)
    except ImportError as error:
        return f"missing: {error}"
    except BaseException as error:  # A panic in Rust is no Exception.
        return f"cannot: {(str(error) or repr(error)).splitlines()[0]}"


def solve_all(peer: type[Peer], arm: Arm, targets: Targets) -> Run:
    """What a solver does with all targets of an arm."""
    return measure(peer(arm), targets)


def measure(peer: Peer, targets: Targets) -> Run:
    """Time each solve by itself, after a few that do not count; then all of them in one call."""
    qs = np.full((len(targets.Ts), len(targets.seed)), np.nan)
    calls = [peer.ask(T, targets.seed) for T in targets.Ts]
    seconds, answers = timed([*calls[-WARM_UP:], *calls])
    for i, answer in enumerate(answers[-len(calls) :]):
        q = peer.read(answer)
        if q is not None:
            qs[i] = q
    seconds = seconds[-len(calls) :]
    if not isinstance(peer, BatchPeer):
        return Run(seconds, qs)
    batch_seconds, answers = timed([peer.ask_all(targets.Ts, targets.seed)] * BATCHES)
    return Run(seconds, qs, float(np.median(batch_seconds)), peer.read_all(answers[-1]), inside(peer, targets))


def inside(peer: BatchPeer, targets: Targets) -> Array:
    """Seconds of each solve without what it costs to call the solver, the least of a few tries."""
    tries = []
    for _ in range(TRIES):
        once = timed([peer.ask_again(T, targets.seed, 1) for T in targets.Ts])[0]
        often = timed([peer.ask_again(T, targets.seed, 1 + AGAIN) for T in targets.Ts])[0]
        tries.append((often - once) / AGAIN)
    least: Array = np.min(tries, axis=0)
    return least


def timed(calls: list[Callable[[], Any]]) -> tuple[Array, list[Any]]:
    """Seconds of each call, and what they returned; the collector of garbage waits."""
    nanoseconds, answers = [], []
    gc.collect()
    gc.disable()
    try:
        for call in calls:
            started = time.perf_counter_ns()
            answer = call()
            nanoseconds.append(time.perf_counter_ns() - started)
            answers.append(answer)
    finally:
        gc.enable()
    return np.array(nanoseconds) * 1e-9, answers
