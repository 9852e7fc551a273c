"""Jobs on disk: one truth for all processes, bounded, and honest about jobs whose process is gone."""

import os
import shutil
import sqlite3
import subprocess
import sys
import time
from collections.abc import Iterator
from contextlib import contextmanager
from pathlib import Path

import pytest

from gelenk import errors
from gelenk.errors import JobExists, TooManyJobs, UnknownJob
from gelenk.jobs import store as shelf_module
from gelenk.jobs.job import Failure
from gelenk.jobs.limits import JobLimits
from gelenk.jobs.store import JobStore, write_result
from tests.test_errors import CONCRETE, example


@contextmanager
def opened(root: Path, limits: JobLimits = JobLimits()) -> Iterator[JobStore]:  # noqa: B008 - frozen
    store = JobStore(root, limits)
    try:
        yield store
    finally:
        store.close()


@pytest.fixture
def store(tmp_path: Path) -> Iterator[JobStore]:
    with opened(tmp_path / "jobs") as store:
        yield store


def test_a_job_is_what_it_was_made(store: JobStore) -> None:
    began = time.time()
    job, is_new = store.add("workspace", "digest", {})
    assert is_new
    assert store.get(job.id) == job
    assert (job.state, job.progress, job.started, job.finished, job.failure) == ("queued", 0.0, None, None, None)
    assert began <= job.created <= time.time()
    running = store.change(job.id, state="running", started=time.time(), progress=0.25)
    assert store.get(job.id) == running
    assert (running.state, running.progress) == ("running", 0.25)


def test_a_final_state_stays(store: JobStore) -> None:
    job, _ = store.add("workspace", "digest", {})
    cancelled = store.change(job.id, state="cancelled")
    assert cancelled.finished is not None
    assert store.change(job.id, state="succeeded", progress=1.0) == cancelled == store.get(job.id)


def test_a_job_that_has_anothers_name_by_now_is_left_alone(store: JobStore) -> None:
    old, _ = store.add("workspace", "digest", {}, "mine")
    store.remove("mine")
    new, _ = store.add("workspace", "digest", {}, "mine")
    with pytest.raises(UnknownJob):
        store.change(old, state="succeeded")
    assert store.get("mine") == new


def test_a_name_is_one_request(store: JobStore) -> None:
    job, _ = store.add("workspace", "digest", {}, "mine")
    assert store.add("workspace", "digest", {}, "mine") == (job, False)
    with pytest.raises(JobExists):
        store.add("workspace", "another", {}, "mine")


@pytest.mark.parametrize("name", ["nobody", "", "..", ".owners", "a/b", "x" * 300, "a\0b", "ü"])
def test_unknown_names(store: JobStore, name: str) -> None:
    store.add("workspace", "digest", {}, "mine")
    for ask in (store.get, store.remove, store.change):
        with pytest.raises(UnknownJob):
            ask(name)


@pytest.mark.slow
def test_another_process_sees_a_job_and_cancels_it(store: JobStore, tmp_path: Path) -> None:
    job, _ = store.add("workspace", "digest", {})
    code = (
        "import sys; from pathlib import Path; from gelenk.jobs.store import *\n"
        "store = JobStore(Path(sys.argv[1]), JobLimits())\n"
        "assert store.get(sys.argv[2]).state == 'queued'\n"
        "store.change(sys.argv[2], state='cancelled')"
    )
    subprocess.run([sys.executable, "-c", code, str(tmp_path / "jobs"), job.id], check=True)
    assert store.get(job.id).state == "cancelled"


LEAVES = (
    "import os, sys; from pathlib import Path; from gelenk.jobs.store import *\n"
    "store = JobStore(Path(sys.argv[1]), JobLimits())\n"
    "job, _ = store.add('workspace', 'digest', {'call.json': b'{}'}, 'left')\n"
    "store.change(store.start(job), progress=0.5)\n"
    "os.kill(os.getpid(), 9)"
)
TAKES = (
    "import sys, time; from pathlib import Path; from gelenk.jobs.store import *\n"
    "store = JobStore(Path(sys.argv[1]), JobLimits())\n"
    "print('ready', flush=True); sys.stdin.readline()\n"
    "print(len(store.take_up()), flush=True); sys.stdin.readline()"
)


@pytest.mark.slow
def test_a_job_whose_process_is_gone_waits_to_be_taken_up(store: JobStore, tmp_path: Path) -> None:
    root = tmp_path / "jobs"
    subprocess.run([sys.executable, "-c", LEAVES, str(root)], check=False)
    job = store.get("left")
    assert (job.state, job.progress, job.attempts) == ("queued", 0.5, 1)
    assert store.states() == {"queued": 1}
    assert store.add("workspace", "digest", {}, "left") == (job, False)
    assert len(list((root / ".owners").iterdir())) == 2
    store.prepare()
    assert len(list((root / ".owners").iterdir())) == 1
    taken = store.take_up()
    assert [(one.id, one.state, one.progress, one.attempts) for one in taken] == [("left", "queued", 0.5, 1)]
    assert store.take_up() == []
    assert (store.request("left") / "call.json").read_bytes() == b"{}"
    begun = store.start(taken[0])
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
            running = one.start(job)
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
    with opened(tmp_path, JobLimits(kept=3, kept_seconds=30 * DAY)) as store:

        def done(name: str) -> None:
            store.change(store.add("workspace", "x", {}, name)[0].id, state="cancelled")

        def kept() -> list[str]:
            store.tidy()
            return [name for name in "abcd" if (tmp_path / name).exists()]

        done("a")
        for jump in (YEAR, -YEAR, DAY, -DAY, -YEAR, YEAR):
            clocks.wall += jump
            for _ in range(23):
                clocks.pass_by(HOUR)
                assert kept() == ["a"]
        clocks.wall -= YEAR
        done("b")
        job = store.add("workspace", "x", {}, "c")[0]
        clocks.wall -= YEAR
        store.start(job)
        job = store.change("c", state="cancelled")
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
    with opened(tmp_path, JobLimits(kept_seconds=100.0)) as store:
        old, rested, new = (store.add("workspace", "x", {"call.json": b"{}"}, name)[0] for name in ("a", "b", "c"))
        for job in (old, rested, new):
            store.parts(job).write("all-0", b"part")
            store.change(job, state="cancelled")
        for job, age in ((old, 101.0), (rested, 61.0)):
            with sqlite3.connect(tmp_path / ".database" / "jobs.sqlite") as table:
                table.execute("UPDATE jobs SET finished = ? WHERE id = ?", (time.time() - age, job.id))
            table.close()
        store.tidy()
        assert store.get(old.id)
        monkeypatch.setattr(shelf_module, "_SURE_SECONDS", 0.0)
        store.tidy()
        with pytest.raises(UnknownJob):
            store.get(old.id)
        assert list((tmp_path / rested.id).iterdir()) == []
        assert len(list((tmp_path / new.id).iterdir())) == 2


def test_no_more_wait_than_may(tmp_path: Path) -> None:
    with opened(tmp_path, JobLimits(unfinished=2)) as store:
        first, _ = store.add("workspace", "1", {})
        store.add("workspace", "2", {})
        with pytest.raises(TooManyJobs) as refused:
            store.add("workspace", "3", {})
        assert (refused.value.unfinished, refused.value.allowed) == (2, 2)
        store.change(first.id, state="cancelled")
        store.add("workspace", "3", {})


def test_a_client_has_at_most_half_of_the_places_beside_others(tmp_path: Path) -> None:
    """Alone it has all; and who comes then is let in, up to half as many more."""
    with opened(tmp_path, JobLimits(unfinished=4)) as store:

        def refused_to(client: str) -> tuple[int, int, str]:
            with pytest.raises(TooManyJobs) as refused:
                store.add("workspace", "x", {}, client=client)
            return refused.value.unfinished, refused.value.allowed, refused.value.limit

        first, *_ = (store.add("workspace", "x", {}, client="one")[0] for _ in range(4))
        assert refused_to("one") == (4, 4, "client")
        store.add("workspace", "x", {}, client="two")
        assert refused_to("one") == (4, 2, "client")
        store.change(first.id, state="cancelled")
        assert refused_to("one") == (3, 2, "client")
        store.add("workspace", "x", {}, client="two")
        assert refused_to("two") == (2, 2, "client")
        store.add("workspace", "x", {}, client="three")
        assert refused_to("three") == (6, 6, "service")


def test_the_oldest_finished_jobs_make_room(tmp_path: Path) -> None:
    with opened(tmp_path, JobLimits(kept=3, kept_bytes=10_000, unfinished=10)) as store:
        names = [store.add("workspace", "x", {}, f"job-{i}")[0].id for i in range(3)]
        for name in names[1:]:
            store.change(name, state="succeeded")
        store.add("workspace", "x", {}, "job-3")
        assert store.get("job-0").state == "queued", "what is not finished stays"
        assert store.get("job-2").state == "succeeded"
        with pytest.raises(UnknownJob):
            store.get("job-1")
        write_result(tmp_path / "job-3", "result.npy", lambda target: target.write(b"x" * 20_000))
        store.change("job-3", state="succeeded")
        store.add("workspace", "x", {}, "job-4")
        assert sorted(path.name for path in tmp_path.iterdir() if not path.name.startswith(".")) == ["job-0", "job-4"]


def test_a_result_is_on_disk_with_its_name(store: JobStore, tmp_path: Path, monkeypatch: pytest.MonkeyPatch) -> None:
    folder = tmp_path / "jobs" / store.add("workspace", "digest", {}, "mine")[0].id
    synced = {}

    def noted(descriptor: int) -> None:
        path = Path(f"/proc/self/fd/{descriptor}").readlink()
        synced[path] = path.stat().st_size if path.is_file() else 0

    monkeypatch.setattr(os, "fsync", noted)
    write_result(folder, "result.npy", lambda target: target.write(b"x" * 20_000))
    assert synced == {folder / "result.npy": 20_000, folder: 0}


def test_what_is_no_job_is_left_aside(store: JobStore, tmp_path: Path) -> None:
    store.add("workspace", "digest", {}, "job")
    shutil.rmtree(tmp_path / "jobs" / "job")  # by a person
    (tmp_path / "jobs" / "stray").mkdir()
    (tmp_path / "jobs" / "file").touch()
    for name in ("job", "stray", "file"):
        for ask in (store.get, store.remove, store.change):
            with pytest.raises(UnknownJob):
                ask(name)
    assert store.states() == {}
    for name in ("job", "stray", "file"):
        assert store.add("workspace", "another", {}, name)[1]
    assert store.states() == {"queued": 3}


@pytest.mark.quick(14)
@pytest.mark.parametrize("cls", CONCRETE, ids=lambda cls: cls.__name__)
def test_a_failure_is_raised_again_as_it_was(store: JobStore, cls: type[errors.KinematicsError]) -> None:
    error = example(cls)
    job, _ = store.add("workspace", "digest", {})
    failure = store.change(job.id, state="failed", failure=Failure.of(error)).failure
    again = store.get(job.id).failure
    assert failure is not None
    assert again is not None
    raised = again.error_again()
    assert raised.detail == error.detail
    assert type(raised) is cls


def test_the_newest_jobs_of_a_client_come_in_pieces(store: JobStore) -> None:
    mine = [store.add("workspace", str(i), {}, client="key me")[0] for i in range(3)]
    store.add("workspace", "theirs", {}, client="key they")
    first = store.newest("key me", 2, 2**53)
    assert [job.id for job in first] == [mine[2].id, mine[1].id]
    assert [job.id for job in store.newest("key me", 2, first[-1].number)] == [mine[0].id]
    assert store.newest("key nobody", 2, 2**53) == []
    store.remove(mine[1].id)
    assert [job.id for job in store.newest("key me", 9, 2**53)] == [mine[2].id, mine[0].id]
