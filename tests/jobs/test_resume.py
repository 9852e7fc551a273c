"""Jobs whose process of the service is killed: the next one goes on with them, and not for ever."""

import signal
import subprocess
import sys
import time
from collections import Counter
from collections.abc import Callable
from concurrent.futures import Future, ThreadPoolExecutor
from pathlib import Path
from typing import Any

import pytest

from gelenk.errors import JobInterrupted
from gelenk.jobs.limits import JobLimits
from gelenk.jobs.runner import Runner
from gelenk.jobs.store import JobStore
from tests.jobs.parts import fatal, made_by, of_parts
from tests.jobs.workers import Workers

PARTS = 16
SERVICE = """
import os, sys, time
from pathlib import Path
from tests.jobs.test_resume import opened
if __name__ == "__main__":
    runner = opened(Path(sys.argv[1]))
    runner.start()
    while runner.store.get("mine").progress < float(sys.argv[2]):
        time.sleep(0.01)
    os.kill(os.getpid(), 9)
"""


class Threads:
    """Computes parts in this very process, which is there sooner than others."""

    count, failure = 2, None

    def prepare(self) -> None:
        pass

    def __init__(self) -> None:
        self._pool = ThreadPoolExecutor(self.count)

    def submit(self, function: Callable[[Any], Any], argument: Any, _: float) -> "Future[Any]":
        return self._pool.submit(function, argument)

    def close(self) -> None:
        self._pool.shutdown(cancel_futures=True)


def opened(folder: Path) -> Runner:
    kinds = {"parts": of_parts, "fatal": fatal}
    return Runner(JobStore(folder, JobLimits()), kinds, Workers(1), running=1, seconds=60.0, executor=Threads())


def killed(folder: Path, progress: float) -> None:
    """A process of the service that goes on with the jobs there are, and is killed when the one has got so far."""
    command = [sys.executable, "-c", SERVICE, str(folder), str(progress)]
    assert subprocess.run(command, timeout=60, check=False).returncode == -signal.SIGKILL


def finished(folder: Path) -> Runner:
    """A process of the service that is let go on to the end of the job."""
    runner = opened(folder)
    runner.start()
    deadline = time.monotonic() + 60.0
    while not runner.store.get("mine").is_final:
        assert time.monotonic() < deadline
        time.sleep(0.02)
    runner.close()
    return runner


def opened_up_to(notes: Path, progress: float) -> None:
    """Let the parts that note something go on as far as this, and the others wait."""
    notes.with_name("gate").write_text(str(round(progress * PARTS)))


def left(folder: Path, kind: str, request: dict[str, bytes]) -> None:
    """A job that its process has not begun."""
    store = JobStore(folder, JobLimits())
    store.add(kind, "x", request, "mine")
    store.close()


@pytest.mark.slow
def test_a_job_goes_on_after_its_last_finished_part(tmp_path: Path) -> None:
    jobs, notes = tmp_path / "jobs", tmp_path / "notes"
    left(jobs, "parts", made_by("note", [f"{notes}:{k}" for k in range(PARTS)]))
    seen = []
    for progress in (0.25, 0.625):
        opened_up_to(notes, progress)
        killed(jobs, progress)
        job = JobStore(jobs, JobLimits()).get("mine")
        assert (job.state, job.attempts) == ("queued", 1)
        assert job.progress >= progress
        seen.append(job.progress)
    opened_up_to(notes, 1.0)
    runner = finished(jobs)
    job = runner.store.get("mine")
    assert (job.state, job.progress) == ("succeeded", 1.0)
    expected = "[" + ", ".join(repr(str(k)) for k in range(PARTS)) + "]"
    assert runner.result("mine", "result.txt").read_text() == expected
    assert sorted(path.name for path in (jobs / "mine").iterdir()) == ["result.txt"]
    counts = Counter(int(line) for line in notes.read_text().split())
    assert set(counts) == set(range(PARTS))
    assert {counts[k] for k in range(int(seen[0] * PARTS))} == {1}, "what is finished is not done again"
    assert max(counts.values()) <= 3


@pytest.mark.slow
def test_a_part_that_the_machine_has_lost_is_computed_again(tmp_path: Path) -> None:
    jobs, notes = tmp_path / "jobs", tmp_path / "notes"
    left(jobs, "parts", made_by("note", [f"{notes}:{k}" for k in range(PARTS)]))
    opened_up_to(notes, 0.5)
    killed(jobs, 0.5)
    lost, missing = (next((jobs / "mine").glob(f"part-*-all-{k}")) for k in (0, 2))
    lost.write_bytes(b"")
    missing.unlink()
    opened_up_to(notes, 1.0)
    runner = finished(jobs)
    assert runner.result("mine", "result.txt").read_text().startswith("['0', '1', '2', '3', ")
    counts = Counter(notes.read_text().split())
    assert [counts[str(k)] for k in range(4)] == [2, 1, 2, 1]


@pytest.mark.slow
def test_a_job_that_brings_the_service_down_is_given_up(tmp_path: Path) -> None:
    left(tmp_path, "fatal", {"call.json": b""})
    for attempt in (1, 2, 3):
        killed(tmp_path, 2.0)
        assert JobStore(tmp_path, JobLimits()).get("mine").attempts == attempt
    runner = finished(tmp_path)
    assert runner.store.get("mine").state == "failed"
    with pytest.raises(JobInterrupted, match="started 3 times"):
        runner.result("mine", "result.txt")
    assert list((tmp_path / "mine").iterdir()) == []
