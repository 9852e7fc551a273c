"""Jobs from their beginning to their end: in order, cancelled, failed, out of time, and at the end of the service."""

import time
from collections.abc import Callable, Iterator
from pathlib import Path
from typing import Any

import pytest

from app.jobs.job import Job
from app.jobs.runner import Files, Run, Runner, Work
from app.jobs.shelf import Limits, Shelf
from app.model.errors import (
    InvalidField,
    JobCancelled,
    JobFailed,
    JobInterrupted,
    JobNotFinished,
    JobTookTooLong,
    ServiceStopping,
    TooLarge,
    UnknownJob,
)
from tests.jobs.parts import die, double, fail, gone, sleep


@pytest.fixture(scope="module")
def runner(tmp_path_factory: pytest.TempPathFactory) -> Iterator[Runner]:
    made = Runner(Shelf(tmp_path_factory.mktemp("jobs"), Limits()), workers=2, running=2, seconds=60.0)
    yield made
    made.close()


def doubled(values: list[int]) -> Work:
    def work(run: Run) -> Files:
        results = list(run.map(double, values, len(values)))
        return {"result.txt": lambda target: target.write(repr(results).encode())}

    return work


def slept(seconds: list[float]) -> Work:
    def work(run: Run) -> Files:
        list(run.map(sleep, seconds, len(seconds)))
        return {}

    return work


def raises(error: Exception) -> Work:
    def work(_: Run) -> Files:
        raise error

    return work


def parts_of(function: Callable[[Any], int], argument: Any) -> Work:
    def work(run: Run) -> Files:
        list(run.map(function, [argument] * 3, 3))
        return {}

    return work


def watched(runner: Runner, job: Job) -> list[Job]:
    """Every state of a job until its end, and that does not take long."""
    seen = [runner.shelf.get(job.id)]
    deadline = time.monotonic() + 20.0
    while not seen[-1].is_final:
        assert time.monotonic() < deadline
        time.sleep(0.02)
        now = runner.shelf.get(job.id)
        if now != seen[-1]:
            seen.append(now)
    return seen


def test_results_come_in_order_and_progress_only_grows(runner: Runner) -> None:
    job = runner.submit("workspace", "x", doubled(list(range(50))))
    end = watched(runner, job)[-1]
    assert (end.state, end.progress) == ("succeeded", 1.0)
    assert end.started is not None
    assert end.finished is not None
    assert end.created <= end.started <= end.finished
    assert runner.result(job.id, "result.txt").read_text() == repr([2 * i for i in range(50)])
    states = watched(runner, runner.submit("workspace", "x", slept([0.15] * 8)))
    progress = [state.progress for state in states]
    assert progress == sorted(progress)
    assert any(0.0 < value < 1.0 for value in progress)


def test_a_name_that_stands_is_not_done_again(runner: Runner) -> None:
    first = runner.submit("workspace", "x", doubled([1]), "mine")
    watched(runner, first)
    again = runner.submit("workspace", "x", raises(AssertionError("not again")), "mine")
    assert again.state == "succeeded"
    assert runner.result("mine", "result.txt").read_text() == "[2]"


def test_a_cancelled_job_ends_at_once_and_the_next_one_runs(runner: Runner) -> None:
    hanging = runner.submit("workspace", "x", slept([60.0] * 4))
    time.sleep(0.5)
    assert runner.shelf.get(hanging.id).state == "running"
    with pytest.raises(JobNotFinished):
        runner.result(hanging.id, "result.txt")
    started = time.monotonic()
    assert runner.cancel(hanging.id).state == "cancelled"
    with pytest.raises(JobCancelled):
        runner.result(hanging.id, "result.txt")
    assert watched(runner, runner.submit("workspace", "x", doubled([3])))[-1].state == "succeeded"
    assert time.monotonic() - started < 5.0
    assert runner.shelf.get(hanging.id).state == "cancelled"


def test_a_job_that_another_process_cancels_ends_too(runner: Runner) -> None:
    job = runner.submit("workspace", "x", slept([0.2] * 100))
    time.sleep(0.4)
    runner.shelf.change(job.id, state="cancelled")
    deadline = time.monotonic() + 5.0
    while runner._orders:
        assert time.monotonic() < deadline
        time.sleep(0.02)


def test_a_job_that_is_cancelled_before_its_turn_is_never_begun(runner: Runner) -> None:
    ahead = [runner.submit("workspace", "x", slept([0.3])) for _ in range(2)]
    last = runner.submit("workspace", "x", raises(AssertionError("never")))
    runner.cancel(last.id)
    for job in ahead:
        watched(runner, job)
    time.sleep(0.1)
    assert (runner.shelf.get(last.id).state, runner.shelf.get(last.id).started) == ("cancelled", None)


def test_a_finished_job_is_removed(runner: Runner) -> None:
    job = runner.submit("workspace", "x", doubled([1]))
    watched(runner, job)
    assert runner.cancel(job.id).state == "succeeded"
    for ask in (runner.shelf.get, runner.cancel, lambda job_id: runner.result(job_id, "result.txt")):
        with pytest.raises(UnknownJob):
            ask(job.id)


@pytest.mark.parametrize(
    ("work", "error"),
    [
        (raises(TooLarge("voxels", 5, 4)), TooLarge),
        (raises(InvalidField("voxel_size", "too small")), InvalidField),
        (raises(ZeroDivisionError()), JobFailed),
        (parts_of(die, 3), JobFailed),
        (parts_of(fail, "no"), JobFailed),
    ],
    ids=["too large", "invalid", "unforeseen", "dying", "failing"],
)
def test_a_job_that_fails_says_why_and_harms_no_other(
    runner: Runner, work: Work, error: type[Exception], caplog: pytest.LogCaptureFixture
) -> None:
    beside = runner.submit("workspace", "x", slept([0.05] * 4))
    job = runner.submit("workspace", "x", work)
    assert watched(runner, job)[-1].state == "failed"
    with pytest.raises(error):
        runner.result(job.id, "result.txt")
    assert watched(runner, beside)[-1].state == "succeeded"
    caplog.clear()


def test_a_job_that_takes_too_long_is_ended(tmp_path: Path) -> None:
    runner = Runner(Shelf(tmp_path, Limits()), workers=1, running=1, seconds=0.5)
    try:
        job = runner.submit("workspace", "x", slept([60.0]))
        started = time.monotonic()
        assert watched(runner, job)[-1].state == "failed"
        assert time.monotonic() - started < 3.0
        with pytest.raises(JobTookTooLong):
            runner.result(job.id, "result.txt")
    finally:
        runner.close()


def test_the_end_of_the_service_ends_its_jobs(tmp_path: Path) -> None:
    runner = Runner(Shelf(tmp_path, Limits()), workers=2, running=1, seconds=60.0)
    jobs = [runner.submit("workspace", "x", slept([60.0] * 4)) for _ in range(3)]
    time.sleep(0.6)
    pids = runner.workers.pids
    started = time.monotonic()
    runner.close()
    assert time.monotonic() - started < 2.0
    assert len(pids) == 2
    assert all(gone(pid) for pid in pids)
    shelf = Shelf(tmp_path, Limits())
    for job in jobs:
        end = shelf.get(job.id)
        assert end.state == "failed"
        assert end.failure is not None
        assert "shutting down" in end.failure.detail
        assert type(end.failure.error_again()) is JobInterrupted
    with pytest.raises(ServiceStopping):
        runner.submit("workspace", "x", slept([0.0]))
