"""Jobs on disk: one truth for all processes, bounded, and honest about jobs whose process is gone."""

import subprocess
import sys
import time
from collections.abc import Iterator
from contextlib import contextmanager
from dataclasses import replace
from pathlib import Path

import pytest

from gelenk.jobs import shelf as shelf_module
from gelenk.jobs.job import Failure
from gelenk.jobs.shelf import JOB_FILE, Limits, Shelf
from gelenk.model import errors
from gelenk.model.errors import JobExists, TooManyJobs, UnknownJob
from tests.model.test_errors import CONCRETE, example


@contextmanager
def opened(root: Path, limits: Limits = Limits()) -> Iterator[Shelf]:  # noqa: B008 - frozen
    shelf = Shelf(root, limits)
    try:
        yield shelf
    finally:
        shelf.close()


@pytest.fixture
def shelf(tmp_path: Path) -> Iterator[Shelf]:
    with opened(tmp_path / "jobs") as shelf:
        yield shelf


def test_a_job_is_what_it_was_made(shelf: Shelf) -> None:
    job, is_new = shelf.add("workspace", "digest", {})
    assert is_new
    assert shelf.get(job.id) == job
    assert (job.state, job.progress, job.started, job.finished, job.failure) == ("queued", 0.0, None, None, None)
    assert abs(job.created - time.time()) < 5.0
    running = shelf.change(job.id, state="running", started=time.time(), progress=0.25)
    assert shelf.get(job.id) == running
    assert (running.state, running.progress) == ("running", 0.25)


def test_a_final_state_stays(shelf: Shelf) -> None:
    job, _ = shelf.add("workspace", "digest", {})
    cancelled = shelf.change(job.id, state="cancelled")
    assert cancelled.finished is not None
    assert shelf.change(job.id, state="succeeded", progress=1.0) == cancelled == shelf.get(job.id)


def test_a_job_that_has_anothers_name_by_now_is_left_alone(shelf: Shelf) -> None:
    old, _ = shelf.add("workspace", "digest", {}, "mine")
    shelf.remove("mine")
    new, _ = shelf.add("workspace", "digest", {}, "mine")
    with pytest.raises(UnknownJob):
        shelf.change(old, state="succeeded")
    assert shelf.get("mine") == new


def test_a_name_is_one_request(shelf: Shelf) -> None:
    job, _ = shelf.add("workspace", "digest", {}, "mine")
    assert shelf.add("workspace", "digest", {}, "mine") == (job, False)
    with pytest.raises(JobExists):
        shelf.add("workspace", "another", {}, "mine")


@pytest.mark.parametrize("name", ["nobody", "", "..", ".owners", "a/b", "x" * 300, "a\0b", "ü"])
def test_unknown_names(shelf: Shelf, name: str) -> None:
    shelf.add("workspace", "digest", {}, "mine")
    for ask in (shelf.get, shelf.remove, shelf.change):
        with pytest.raises(UnknownJob):
            ask(name)


def test_another_process_sees_a_job_and_cancels_it(shelf: Shelf, tmp_path: Path) -> None:
    job, _ = shelf.add("workspace", "digest", {})
    code = (
        "import sys; from pathlib import Path; from gelenk.jobs.shelf import *\n"
        "shelf = Shelf(Path(sys.argv[1]), Limits())\n"
        "assert shelf.get(sys.argv[2]).state == 'queued'\n"
        "shelf.change(sys.argv[2], state='cancelled')"
    )
    subprocess.run([sys.executable, "-c", code, str(tmp_path / "jobs"), job.id], check=True)
    assert shelf.get(job.id).state == "cancelled"


LEAVES = (
    "import os, sys; from pathlib import Path; from gelenk.jobs.shelf import *\n"
    "shelf = Shelf(Path(sys.argv[1]), Limits())\n"
    "job, _ = shelf.add('workspace', 'digest', {'call.json': b'{}'}, 'left')\n"
    "shelf.change(shelf.begin(job), progress=0.5)\n"
    "os.kill(os.getpid(), 9)"
)
TAKES = (
    "import sys, time; from pathlib import Path; from gelenk.jobs.shelf import *\n"
    "shelf = Shelf(Path(sys.argv[1]), Limits())\n"
    "print('ready', flush=True); sys.stdin.readline()\n"
    "print(len(shelf.take_up()), flush=True); sys.stdin.readline()"
)


def test_a_job_whose_process_is_gone_waits_to_be_taken_up(shelf: Shelf, tmp_path: Path) -> None:
    root = tmp_path / "jobs"
    subprocess.run([sys.executable, "-c", LEAVES, str(root)], check=False)
    job = shelf.get("left")
    assert (job.state, job.progress, job.attempts) == ("queued", 0.5, 1)
    assert shelf.states() == {"queued": 1}
    assert shelf.add("workspace", "digest", {}, "left") == (job, False)
    assert len(list((root / ".owners").iterdir())) == 2
    shelf.prepare()
    assert len(list((root / ".owners").iterdir())) == 1
    taken = shelf.take_up()
    assert [(one.id, one.state, one.progress, one.attempts) for one in taken] == [("left", "queued", 0.5, 1)]
    assert shelf.take_up() == []
    assert (shelf.request("left") / "call.json").read_bytes() == b"{}"
    begun = shelf.begin(taken[0])
    assert (begun.state, begun.attempts, begun.started) == ("running", 2, job.started)


@pytest.mark.slow
def test_of_many_processes_one_takes_a_job_up(tmp_path: Path) -> None:
    root = tmp_path / "jobs"
    subprocess.run([sys.executable, "-c", LEAVES, str(root)], check=False)
    pipes = {"stdin": subprocess.PIPE, "stdout": subprocess.PIPE, "text": True}
    runs = [subprocess.Popen([sys.executable, "-c", TAKES, str(root)], **pipes) for _ in range(4)]  # type: ignore[call-overload]
    for run in runs:
        assert run.stdout.readline() == "ready\n"
    for run in runs:
        run.stdin.write("\n")
        run.stdin.flush()
    counts = [int(run.stdout.readline()) for run in runs]
    for run in runs:
        run.communicate("\n")
    assert sorted(counts) == [0, 0, 0, 1]


def test_two_shelves_of_one_folder_know_that_the_other_lives(tmp_path: Path) -> None:
    with opened(tmp_path) as other:
        with opened(tmp_path) as one:
            job, _ = one.add("workspace", "digest", {})
            other.add("workspace", "digest", {})
            running = one.begin(job)
            other.prepare()
            assert other.take_up() == []
            assert other.get(job.id).state == "running"
        assert other.get(job.id).state == "queued"
        assert [taken.id for taken in other.take_up()] == [job.id]
        with pytest.raises(UnknownJob):
            one.change(running, progress=0.7)


class Clocks:
    """The clock on the wall, which may be set, and the one that nobody sets."""

    def __init__(self) -> None:
        self.wall, self.steady = 1.7e9, 5000.0

    def time(self) -> float:
        return self.wall

    def monotonic(self) -> float:
        return self.steady

    def pass_by(self, seconds: float) -> None:
        self.wall, self.steady = self.wall + seconds, self.steady + seconds


YEAR, DAY, HOUR = 365 * 86400.0, 86400.0, 3600.0


def test_a_clock_that_is_set_costs_no_job(tmp_path: Path, monkeypatch: pytest.MonkeyPatch) -> None:
    """Set forward by a year and right again within the day, or set back: what is too old goes, and nothing else."""
    clocks = Clocks()
    monkeypatch.setattr(shelf_module, "time", clocks)
    with opened(tmp_path, Limits(kept=3, kept_seconds=30 * DAY)) as shelf:

        def done(name: str) -> None:
            shelf.change(shelf.add("workspace", "x", {}, name)[0].id, state="cancelled")

        def kept() -> list[str]:
            shelf.tidy()
            return [name for name in "abcd" if (tmp_path / name).exists()]

        done("a")
        for jump in (YEAR, -YEAR, DAY, -DAY, -YEAR, YEAR):
            clocks.wall += jump
            for _ in range(23):
                clocks.pass_by(HOUR)
                assert kept() == ["a"]
        clocks.wall -= YEAR
        done("b")
        job = shelf.add("workspace", "x", {}, "c")[0]
        clocks.wall -= YEAR
        shelf.begin(job)
        job = shelf.change("c", state="cancelled")
        assert job.started is not None
        assert job.finished is not None
        assert job.created <= job.started <= job.finished
        done("d")  # one too many: the first that came goes, though the last ones seem to be older by years
        assert kept() == ["b", "c", "d"]
        clocks.wall += 2 * YEAR
        clocks.pass_by(31 * DAY)
        assert kept() == ["b", "c", "d"]
        clocks.pass_by(25 * HOUR)
        assert kept() == []


def test_what_is_over_is_put_in_order(tmp_path: Path, monkeypatch: pytest.MonkeyPatch) -> None:
    with opened(tmp_path, Limits(kept_seconds=100.0)) as shelf:
        old, rested, new = (shelf.add("workspace", "x", {"call.json": b"{}"}, name)[0] for name in ("a", "b", "c"))
        for job in (old, rested, new):
            shelf.parts(job).write("all-0", b"part")
            shelf.change(job, state="cancelled")
        for job, age in ((old, 101.0), (rested, 99.0)):
            aged = replace(shelf.get(job.id), finished=time.time() - age)
            (tmp_path / job.id / JOB_FILE).write_bytes(aged.as_bytes())
        shelf.tidy()
        assert shelf.get(old.id)
        monkeypatch.setattr(shelf_module, "_SURE_SECONDS", 0.0)
        shelf.tidy()
        with pytest.raises(UnknownJob):
            shelf.get(old.id)
        assert [path.name for path in (tmp_path / rested.id).iterdir()] == [JOB_FILE]
        assert len(list((tmp_path / new.id).iterdir())) == 3


def test_no_more_wait_than_may(tmp_path: Path) -> None:
    with opened(tmp_path, Limits(unfinished=2)) as shelf:
        first, _ = shelf.add("workspace", "1", {})
        shelf.add("workspace", "2", {})
        with pytest.raises(TooManyJobs) as refused:
            shelf.add("workspace", "3", {})
        assert (refused.value.unfinished, refused.value.allowed) == (2, 2)
        shelf.change(first.id, state="cancelled")
        shelf.add("workspace", "3", {})


def test_a_client_has_at_most_half_of_the_places_beside_others(tmp_path: Path) -> None:
    """Alone it has all; and who comes then is let in, up to half as many more."""
    with opened(tmp_path, Limits(unfinished=4)) as shelf:

        def refused_to(client: str) -> tuple[int, int, str]:
            with pytest.raises(TooManyJobs) as refused:
                shelf.add("workspace", "x", {}, client=client)
            return refused.value.unfinished, refused.value.allowed, refused.value.limit

        first, *_ = (shelf.add("workspace", "x", {}, client="one")[0] for _ in range(4))
        assert refused_to("one") == (4, 4, "client")
        shelf.add("workspace", "x", {}, client="two")
        assert refused_to("one") == (4, 2, "client")
        shelf.change(first.id, state="cancelled")
        assert refused_to("one") == (3, 2, "client")
        shelf.add("workspace", "x", {}, client="two")
        assert refused_to("two") == (2, 2, "client")
        shelf.add("workspace", "x", {}, client="three")
        assert refused_to("three") == (6, 6, "service")


def test_the_oldest_finished_jobs_make_room(tmp_path: Path) -> None:
    with opened(tmp_path, Limits(kept=3, kept_bytes=10_000, unfinished=10)) as shelf:
        names = [shelf.add("workspace", "x", {}, f"job-{i}")[0].id for i in range(3)]
        for name in names[1:]:
            shelf.change(name, state="succeeded")
        shelf.add("workspace", "x", {}, "job-3")
        assert shelf.get("job-0").state == "queued", "what is not finished stays"
        assert shelf.get("job-2").state == "succeeded"
        with pytest.raises(UnknownJob):
            shelf.get("job-1")
        shelf.write("job-3", "result.npy", lambda target: target.write(b"x" * 20_000))
        shelf.change("job-3", state="succeeded")
        shelf.add("workspace", "x", {}, "job-4")
        assert sorted(path.name for path in tmp_path.iterdir() if not path.name.startswith(".")) == ["job-0", "job-4"]


def test_what_is_no_job_is_left_aside(shelf: Shelf, tmp_path: Path) -> None:
    job, _ = shelf.add("workspace", "digest", {})
    (tmp_path / "jobs" / job.id / JOB_FILE).write_text("{")
    (tmp_path / "jobs" / "stray").mkdir()
    (tmp_path / "jobs" / "file").touch()
    for name in (job.id, "stray", "file"):
        with pytest.raises(UnknownJob):
            shelf.get(name)
    shelf.add("workspace", "digest", {})


@pytest.mark.parametrize("cls", CONCRETE, ids=lambda cls: cls.__name__)
def test_a_failure_is_raised_again_as_it_was(shelf: Shelf, cls: type[errors.KinematicsError]) -> None:
    error = example(cls)
    job, _ = shelf.add("workspace", "digest", {})
    failure = shelf.change(job.id, state="failed", failure=Failure.of(error)).failure
    again = shelf.get(job.id).failure
    assert failure is not None
    assert again is not None
    raised = again.error_again()
    assert raised.detail == error.detail
    assert type(raised) is cls
