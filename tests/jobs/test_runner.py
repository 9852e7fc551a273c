"""Jobs from their beginning to their end: in order, cancelled, failed, out of time, and at the end of the service."""

import time
from collections.abc import Iterator
from dataclasses import replace
from pathlib import Path
from typing import Any

import pytest

from gelenk.errors import (
    InvalidField,
    JobCancelled,
    JobFailed,
    JobFinished,
    JobInterrupted,
    JobNotFinished,
    JobTookTooLong,
    ServiceStopping,
    TooLarge,
    UnknownJob,
)
from gelenk.jobs.job import JobRecord
from gelenk.jobs.limits import JobLimits
from gelenk.jobs.run import Files, Run
from gelenk.jobs.runner import Runner, Work
from gelenk.jobs.store import JobStore
from tests.jobs.parts import gone, made_by, of_parts
from tests.jobs.workers import Workers


def raised(folder: Path) -> Work:
    """The kind of jobs that fail of themselves."""
    wanted = (folder / "error").read_text()
    error = {"large": TooLarge("voxels", 5, 4), "field": InvalidField("voxel_size", "too small")}.get(wanted)

    def work(_: Run) -> Files:
        raise error or ZeroDivisionError

    return work


def opened(folder: Path, workers: int = 2, running: int = 2, seconds: float = 60.0) -> Runner:
    kinds = {"parts": of_parts, "raised": raised}
    return Runner(JobStore(folder, JobLimits()), kinds, Workers(workers), running, seconds)


@pytest.fixture(scope="module")
def runner(tmp_path_factory: pytest.TempPathFactory) -> Iterator[Runner]:
    made = opened(tmp_path_factory.mktemp("jobs"))
    yield made
    made.close()


def submitted(runner: Runner, function: str, values: list[Any], name: str | None = None) -> JobRecord:
    return runner.submit("parts", "x", made_by(function, values), name)


def watched(runner: Runner, job: JobRecord) -> list[JobRecord]:
    """Every state of a job until its end."""
    seen = [runner.store.get(job.id)]
    deadline = time.monotonic() + 60.0
    while not seen[-1].is_final:
        assert time.monotonic() < deadline
        time.sleep(0.02)
        now = runner.store.get(job.id)
        if now != seen[-1]:
            seen.append(now)
    return seen


def wait_until_running(runner: Runner, job: JobRecord) -> None:
    """Wait until a job is at work."""
    deadline = time.monotonic() + 60.0
    while runner.store.get(job.id).state != "running":
        assert time.monotonic() < deadline
        time.sleep(0.02)


def test_results_come_in_order_and_progress_only_grows(runner: Runner, tmp_path: Path) -> None:
    job = submitted(runner, "double", list(range(50)))
    end = watched(runner, job)[-1]
    assert (end.state, end.progress) == ("succeeded", 1.0)
    assert end.started is not None
    assert end.finished is not None
    assert end.created <= end.started <= end.finished
    assert runner.result(job.id, "result.txt").read_text() == repr([2 * i for i in range(50)])
    gate = tmp_path / "gate"
    gate.write_text("4")
    job = submitted(runner, "note", [f"{tmp_path / 'notes'}:{k}" for k in range(8)])
    deadline = time.monotonic() + 60.0
    while (half := runner.store.get(job.id).progress) < 0.5:
        assert time.monotonic() < deadline
        time.sleep(0.02)
    open_gate = tmp_path / "open gate"
    open_gate.write_text("8")
    open_gate.replace(gate)  # at once: a part may be reading it
    progress = [half, *(state.progress for state in watched(runner, job))]
    assert progress == sorted(progress)
    assert (progress[0], progress[-1]) == (0.5, 1.0)


@pytest.mark.slow
def test_progress_is_written_a_few_times_a_second(runner: Runner, monkeypatch: pytest.MonkeyPatch) -> None:
    times = []
    change = runner.store.change

    def counted(which: JobRecord | str, **changes: Any) -> JobRecord:
        if set(changes) & {"progress"} and "state" not in changes:
            times.append(time.monotonic())
        return change(which, **changes)

    monkeypatch.setattr(runner.store, "change", counted)
    started = time.monotonic()
    watched(runner, submitted(runner, "sleep", [0.02] * 100))
    assert 2 <= len(times) <= 1 + (times[-1] - started) / 0.3


def test_a_name_that_stands_is_not_done_again(runner: Runner) -> None:
    first = submitted(runner, "double", [1], "mine")
    watched(runner, first)
    again = submitted(runner, "fail", ["not again"], "mine")
    assert again.state == "succeeded"
    assert runner.result("mine", "result.txt").read_text() == "[2]"


@pytest.mark.slow
def test_a_cancelled_job_ends_at_once_and_the_next_one_runs(runner: Runner) -> None:
    hanging = submitted(runner, "sleep", [600.0] * 4)
    wait_until_running(runner, hanging)
    with pytest.raises(JobNotFinished):
        runner.result(hanging.id, "result.txt")
    started = time.monotonic()
    assert runner.cancel(hanging.id).state == "cancelled"
    with pytest.raises(JobCancelled):
        runner.result(hanging.id, "result.txt")
    assert watched(runner, submitted(runner, "double", [3]))[-1].state == "succeeded"
    assert time.monotonic() - started < 60.0
    assert runner.store.get(hanging.id).state == "cancelled"


def test_jobs_that_another_process_cancels_make_room_for_others(runner: Runner) -> None:
    jobs = [submitted(runner, "sleep", [0.2] * 1000) for _ in range(2)]
    for job in jobs:
        wait_until_running(runner, job)
        runner.store.change(job.id, state="cancelled")
    started = time.monotonic()
    assert watched(runner, submitted(runner, "double", [3]))[-1].state == "succeeded"
    assert time.monotonic() - started < 50.0, "those would have taken minutes"


def test_a_job_that_is_cancelled_before_its_turn_is_never_begun(runner: Runner) -> None:
    ahead = [submitted(runner, "sleep", [0.05] * 1000) for _ in range(2)]
    last = submitted(runner, "fail", ["never"])
    runner.cancel(last.id)
    for job in ahead:
        runner.cancel(job.id)
    watched(runner, submitted(runner, "double", [1]))  # whose turn is after that of the last one
    assert (runner.store.get(last.id).state, runner.store.get(last.id).started) == ("cancelled", None)


@pytest.mark.slow
def test_turns_go_round_the_clients(tmp_path: Path) -> None:
    runner = opened(tmp_path)

    def asked(client: str, parts: int) -> JobRecord:
        return runner.submit("parts", "x", made_by("sleep", [0.1] * parts), client=client)

    heavy = [asked("heavy", 1000) for _ in range(4)]
    deadline = time.monotonic() + 60.0
    while [runner.store.get(job.id).state for job in heavy] != ["running"] * 2 + ["queued"] * 2:
        assert time.monotonic() < deadline
        time.sleep(0.02)
    light = [watched(runner, asked("light", 1))[-1].state for _ in range(2)]
    assert light == ["succeeded"] * 2
    assert not any(runner.store.get(job.id).is_final for job in heavy)
    runner.close()


def test_a_job_that_comes_to_its_end_while_it_is_cancelled_keeps_its_result(
    runner: Runner, monkeypatch: pytest.MonkeyPatch
) -> None:
    job = submitted(runner, "double", [1])
    watched(runner, job)
    get = runner.store.get
    monkeypatch.setattr(runner.store, "get", lambda name: replace(get(name), state="running"))
    with pytest.raises(JobFinished):
        runner.cancel(job.id)
    monkeypatch.undo()
    assert runner.result(job.id, "result.txt").read_text() == "[2]"


def test_a_finished_job_is_removed(runner: Runner) -> None:
    job = submitted(runner, "double", [1])
    watched(runner, job)
    with pytest.raises(JobFinished):
        runner.cancel(job.id)
    assert runner.cancel(job.id, remove=True).state == "succeeded"
    for ask in (runner.store.get, runner.cancel, lambda job_id: runner.result(job_id, "result.txt")):
        with pytest.raises(UnknownJob):
            ask(job.id)


@pytest.mark.quick(3)
@pytest.mark.parametrize(
    ("kind", "request_files", "error"),
    [
        ("raised", {"error": b"large"}, TooLarge),
        ("raised", {"error": b"field"}, InvalidField),
        ("raised", {"error": b""}, JobFailed),
        ("raised", {"other": b""}, JobFailed),
        ("raised", {}, JobInterrupted),
        ("parts", made_by("die", [3] * 3), JobFailed),
        ("parts", made_by("fail", ["no"] * 3), JobFailed),
    ],
    ids=["too large", "invalid", "unforeseen", "request not whole", "request lost", "dying", "failing"],
)
def test_a_job_that_fails_says_why_and_harms_no_other(
    runner: Runner, kind: str, request_files: dict[str, bytes], error: type[Exception], caplog: pytest.LogCaptureFixture
) -> None:
    beside = submitted(runner, "sleep", [0.05] * 4)
    job = runner.submit(kind, "x", request_files)
    assert watched(runner, job)[-1].state == "failed"
    with pytest.raises(error):
        runner.result(job.id, "result.txt")
    assert watched(runner, beside)[-1].state == "succeeded"
    caplog.clear()


@pytest.mark.quick(1)
@pytest.mark.parametrize("times", [1, 2, 99])
def test_a_part_that_is_killed_is_tried_again_and_named_in_the_end(runner: Runner, tmp_path: Path, times: int) -> None:
    values = [(str(tmp_path / f"{k}"), times if k == 2 else 0) for k in range(4)]
    job = submitted(runner, "killed", values)
    end = watched(runner, job)[-1]
    if times < 3:
        assert end.state == "succeeded"
        assert runner.result(job.id, "result.txt").read_text() == repr([1] * 4)
        return
    with pytest.raises(JobFailed, match=r"part 3 of 4 \(all from 2 on\): its process died 3 times"):
        runner.result(job.id, "result.txt")
    assert (tmp_path / "2").read_bytes() == b"..."


def test_a_job_that_takes_too_long_is_ended(tmp_path: Path) -> None:
    runner = opened(tmp_path, workers=1, running=1, seconds=0.5)
    try:
        job = submitted(runner, "sleep", [600.0])
        assert watched(runner, job)[-1].state == "failed"
        with pytest.raises(JobTookTooLong):
            runner.result(job.id, "result.txt")
    finally:
        runner.close()


@pytest.mark.slow
def test_the_end_of_the_service_leaves_its_jobs_to_the_next_one(tmp_path: Path) -> None:
    runner = opened(tmp_path, running=1)
    first = submitted(runner, "sleep", [0.0, 0.0, 0.0, 0.0, 60.0])
    waiting = submitted(runner, "double", [7])
    deadline = time.monotonic() + 60.0
    while runner.store.get(first.id).progress < 0.8:
        assert time.monotonic() < deadline
        time.sleep(0.02)
    assert isinstance(runner.workers, Workers)
    pids = runner.workers.pids
    started = time.monotonic()
    runner.close()
    assert time.monotonic() - started < 30.0
    assert len(pids) == 2
    assert all(gone(pid) for pid in pids)
    with pytest.raises(ServiceStopping):
        submitted(runner, "sleep", [0.0])
    left = JobStore(tmp_path, JobLimits()).get(first.id)
    assert (left.state, left.progress, left.attempts, left.failure) == ("queued", 0.8, 0, None)
    following = opened(tmp_path)
    try:
        following.start()
        states = watched(following, waiting)
        assert states[-1].state == "succeeded"
        assert following.result(waiting.id, "result.txt").read_text() == "[14]"
        assert following.store.get(first.id).progress == 0.8
        assert following.cancel(first.id).state == "cancelled"
    finally:
        following.close()
