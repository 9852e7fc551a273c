"""Parts of jobs on a Ray cluster: the very results of this machine's processes, whatever is killed meanwhile."""

import contextlib
import importlib.util
import os
import signal
import socket
import tempfile
import time
from collections.abc import Iterator
from concurrent.futures import Future
from io import BytesIO
from pathlib import Path
from typing import Any

import numpy as np
import pytest
from starlette.testclient import TestClient

from gelenk.errors import JobFailed
from gelenk.jobs import runner as runner_module
from gelenk.jobs.cluster import Cluster
from gelenk.jobs.driver import _computed, code_digest
from gelenk.jobs.job import JobRecord
from gelenk.jobs.limits import JobLimits
from gelenk.jobs.runner import Runner
from gelenk.jobs.store import JobStore
from gelenk.jobs.workers import Cancelled, Unavailable
from gelenk.main import create_app
from gelenk.settings import Settings
from tests.jobs.parts import gone, made_by, of_parts, told
from tests.jobs.ray_cluster import cluster, head, node, signalled
from tests.jobs.workers import Workers
from tests.speed import is_within
from tests.test_serve import HOST, free_port

NPY = "application/x-npy"
SOON = 180.0

with_ray = pytest.mark.skipif(importlib.util.find_spec("ray") is None, reason="there is no Ray for this Python")


@pytest.fixture(scope="module")
def address() -> Iterator[str]:
    with cluster() as address:
        yield address


@pytest.fixture
def runner(address: str, tmp_path: Path) -> Iterator[Runner]:
    kinds = {"parts": of_parts}
    made = Runner(JobStore(tmp_path / "jobs", JobLimits()), kinds, Workers(1), 1, 120.0, Cluster(address))
    made.start()
    yield made
    made.close()


def submitted(runner: Runner, function: str, values: list[Any]) -> JobRecord:
    return runner.submit("parts", "x", made_by(function, values))


def ended(runner: Runner, job: JobRecord) -> JobRecord:
    deadline = time.monotonic() + SOON
    while not (now := runner.store.get(job.id)).is_final:
        assert time.monotonic() < deadline
        time.sleep(0.02)
    return now


@pytest.mark.slow
def test_a_cluster_that_is_not_there_is_said_to_be_missing(tmp_path: Path) -> None:
    address = f"{HOST}:{free_port()}"
    reason = f"the Ray cluster at {address} cannot be reached: Connection refused"
    with TestClient(create_app(Settings(data_dir=tmp_path, ray_address=address))) as client:
        deadline = time.monotonic() + SOON
        while (answer := client.get("/readyz")).json().get("waiting_for") != ["jobs"]:
            assert time.monotonic() < deadline, answer.text
            time.sleep(0.05)
        while (answer := client.get("/readyz")).json()["failure"] != reason:
            assert time.monotonic() < deadline, answer.text
            time.sleep(0.05)
        assert answer.status_code == 503
        location = client.post("/v1/robots/panda/workspace", json={"samples": 10}).headers["location"]
        time.sleep(0.3)
        assert client.get(location).json()["state"] == "queued"
        assert client.get("/healthz").status_code == 200
        assert client.delete(location).json()["state"] == "cancelled"


@pytest.mark.slow
def test_a_cluster_that_is_not_there_is_done_without_where_that_is_wanted(tmp_path: Path) -> None:
    settings = Settings(data_dir=tmp_path, ray_address=f"{HOST}:{free_port()}", ray_lost="local")
    with TestClient(create_app(settings)) as client:
        location = client.post("/v1/robots/panda/workspace", json={"samples": 10}).headers["location"]
        deadline = time.monotonic() + SOON
        while (job := client.get(location).json())["state"] in {"queued", "running"}:
            assert time.monotonic() < deadline
            time.sleep(0.02)
        assert job["state"] == "succeeded"
        assert "jobs" not in client.get("/readyz").json().get("waiting_for", [])


class Scripted:
    """An executor that computes here until it is said to be lost; a part that is under way is lost with it."""

    count = 1

    def __init__(self) -> None:
        self.failure: str | None = None
        self.under_way: list[Future[Any]] = []

    def prepare(self) -> None:
        """It is found as soon as it is there."""

    def submit(self, function: Any, argument: Any, _: float) -> "Future[Any]":
        if self.failure is not None:
            raise Unavailable(self.failure)
        future: Future[Any] = Future()
        self.under_way.append(future)
        if argument[1] != "hangs":
            future.set_result(function(argument))
        return future

    def lose(self) -> None:
        self.failure = "its machine is lost"
        self.under_way[-1].set_exception(Unavailable(self.failure))

    def close(self) -> None:
        """There is nothing to end."""


@pytest.mark.quick(1)
@pytest.mark.parametrize("is_local", [False, True])
def test_what_is_lost_waits_or_goes_on_here(tmp_path: Path, monkeypatch: pytest.MonkeyPatch, is_local: bool) -> None:
    monkeypatch.setattr(runner_module, "_LOOK_FOR_LEFT", 0.05)
    executor, kinds = Scripted(), {"parts": of_parts}
    runner = Runner(JobStore(tmp_path, JobLimits()), kinds, Workers(1), 1, 60.0, executor, is_local)
    with contextlib.closing(runner):
        runner.start()
        job = submitted(runner, "echo", [1, 2, "hangs"])
        deadline = time.monotonic() + SOON
        while runner.store.get(job.id).progress < 0.6:
            assert time.monotonic() < deadline
            time.sleep(0.02)
        executor.lose()
        if not is_local:
            while runner.store.get(job.id).state != "queued":
                assert time.monotonic() < deadline
                time.sleep(0.02)
            assert runner.failure == executor.failure
            time.sleep(0.3)
            assert (left := runner.store.get(job.id)).state == "queued"
            assert (left.attempts, left.progress) == (0, 2 / 3)
            executor.submit = lambda function, argument, _: done(function(argument))  # type: ignore[method-assign]
            executor.failure = None
        assert ended(runner, job).state == "succeeded"
        assert runner.result(job.id, "result.txt").read_text() == "[1, 2, 'hangs']"
        assert runner.failure is None


def done(value: Any) -> "Future[Any]":
    future: Future[Any] = Future()
    future.set_result(value)
    return future


@pytest.mark.slow
@with_ray
def test_the_service_ends_at_once_while_a_head_takes_connections_and_says_nothing(tmp_path: Path) -> None:
    with socket.create_server((HOST, 0)) as head:
        address = f"{HOST}:{head.getsockname()[1]}"
        runner = Runner(JobStore(tmp_path, JobLimits()), {"parts": of_parts}, Workers(1), 1, 60.0, Cluster(address))
        runner.start()
        job = submitted(runner, "double", [1])
        head.accept()[0].close()  # the first look whether it is there; what comes next is Ray
        deadline = time.monotonic() + SOON
        while "not answered yet" not in (runner.failure or ""):
            assert time.monotonic() < deadline, runner.failure
            time.sleep(0.02)
        started = time.monotonic()
        runner.close()
        assert time.monotonic() - started < 30.0
        assert runner.store.get(job.id).state == "queued"


def test_a_job_that_was_left_waits_for_the_cluster(tmp_path: Path) -> None:
    with contextlib.closing(JobStore(tmp_path, JobLimits())) as store:
        job, _ = store.add("parts", "x", made_by("double", [1]))
    nowhere, kinds = Cluster(f"{HOST}:{free_port()}"), {"parts": of_parts}
    with contextlib.closing(Runner(JobStore(tmp_path, JobLimits()), kinds, Workers(1), 1, 9.0, nowhere)) as runner:
        runner.start()
        deadline = time.monotonic() + SOON
        while "refused" not in (runner.failure or ""):
            assert time.monotonic() < deadline
            time.sleep(0.02)
        time.sleep(0.2)
        left = runner.store.get(job.id)
        assert (left.state, left.owner, left.attempts) == ("queued", job.owner, 0)
    here = Runner(JobStore(tmp_path, JobLimits()), kinds, Workers(1), 1, 9.0)
    with contextlib.closing(here):
        here.start()
        assert ended(here, job).state == "succeeded"


def test_a_machine_with_another_release_computes_nothing() -> None:
    assert _computed(code_digest(), told, ("double", 2)) == b"4"
    with pytest.raises(ChildProcessError, match="another version"):
        _computed("other", told, ("double", 2))


@pytest.mark.slow
@with_ray
def test_results_are_those_of_this_machine_bit_for_bit(address: str, tmp_path: Path) -> None:
    """Many samples, a map of dexterity, whose second stage needs the first, and inverse kinematics."""
    rng, targets = np.random.default_rng(2), BytesIO()
    quaternions = rng.normal(size=(5_000, 4))
    quaternions /= np.linalg.norm(quaternions, axis=1, keepdims=True)
    np.save(targets, np.column_stack((rng.uniform(0.2, 0.5, (5_000, 3)), quaternions)))
    calls: list[tuple[str, dict[str, Any]]] = [
        ("workspace", {"json": {"samples": 200_000, "random_seed": 4}}),
        ("workspace", {"json": {"kind": "dexterity", "samples": 20_000, "voxel_size": 0.2, "orientations": 10}}),
        (
            "ik?max_iterations=200",
            {"content": targets.getvalue(), "headers": {"Content-Type": NPY, "Prefer": "respond-async"}},
        ),
    ]
    results: list[list[tuple[bytes, bytes]]] = []
    for place in ("", address):
        settings = Settings(data_dir=tmp_path / (place or "here"), ray_address=place)
        with TestClient(create_app(settings)) as client:
            results.append([answered(client, f"/v1/robots/panda/{path}", call) for path, call in calls])
    assert results[0] == results[1]


def answered(client: TestClient, url: str, call: dict[str, Any]) -> tuple[bytes, bytes]:
    """The result of a job in both forms."""
    answer = client.post(url, **call)
    assert answer.status_code == 202, answer.text
    location, deadline = answer.headers["location"], time.monotonic() + SOON
    while (job := client.get(location).json())["state"] in {"queued", "running"}:
        assert time.monotonic() < deadline, job
        time.sleep(0.05)
    assert job["state"] == "succeeded", job
    result = f"{location}/result"
    return client.get(result).content, client.get(result, headers={"Accept": NPY}).content


@pytest.mark.slow
@with_ray
def test_a_part_whose_process_is_killed_is_computed_again(runner: Runner, tmp_path: Path) -> None:
    marks = tmp_path / "marks"
    marks.mkdir()
    job = submitted(runner, "mark", [str(marks)] * 40)
    killed: set[int] = set()
    deadline = time.monotonic() + SOON
    while len(killed) < 2:
        assert time.monotonic() < deadline
        time.sleep(0.05)
        for pid in {int(path.name) for path in marks.iterdir()} - killed:
            assert "ray::" in Path(f"/proc/{pid}/cmdline").read_text()
            os.kill(pid, signal.SIGKILL)
            killed.add(pid)
    assert ended(runner, job).state == "succeeded"
    assert runner.result(job.id, "result.txt").read_text() == repr([7] * 40)
    assert len(list(marks.iterdir())) > len(killed), "other processes have taken their place"


@pytest.mark.slow
@with_ray
def test_what_goes_wrong_on_the_cluster_is_told_as_it_would_be_here(runner: Runner) -> None:
    assert runner.failure is not None
    assert ended(runner, submitted(runner, "double", [1, 2])).state == "succeeded"
    assert runner.failure is None
    for function, reason in (
        ("fail", "ValueError"),
        ("die", r"part 1 of 1 \(all from 0 on\): its process died 3 times"),
    ):
        job = ended(runner, submitted(runner, function, [3]))
        assert job.state == "failed"
        with pytest.raises(JobFailed, match=reason):
            runner.result(job.id, "result.txt")


@pytest.mark.slow
@with_ray
def test_a_cancelled_job_leaves_the_cluster_at_once(runner: Runner, tmp_path: Path) -> None:
    marks = tmp_path / "marks"
    marks.mkdir()
    job = submitted(runner, "linger", [str(marks)] * 8)
    deadline = time.monotonic() + SOON
    while len(pids := [int(path.name) for path in marks.iterdir()]) < 2:
        assert time.monotonic() < deadline
        time.sleep(0.05)
    assert runner.cancel(job.id).state == "cancelled"
    assert ended(runner, submitted(runner, "double", [4])).state == "succeeded"
    while not all(gone(pid) for pid in pids):
        assert time.monotonic() < deadline
        time.sleep(0.05)
    assert len(list(marks.iterdir())) == 2, "what was not begun never is"


@pytest.mark.slow
@with_ray
def test_the_end_of_the_driver_fails_what_is_under_way_and_nothing_else(address: str) -> None:
    computes = Cluster(address)
    until = time.monotonic() + SOON
    try:
        computes.prepare()
        assert computes.submit(told, ("double", 1), until).result(SOON) == b"2"
        under_way = computes.submit(told, ("sleep", 30.0), until)
        assert computes._process is not None
        os.kill(computes._process.pid, signal.SIGKILL)
        with pytest.raises(Unavailable, match="was lost"):
            under_way.result(SOON)
        assert computes.failure is not None
        computes.prepare()
        assert computes.submit(told, ("double", 2), until).result(SOON) == b"4"
        assert computes.failure is None
    finally:
        computes.close()
    with pytest.raises(Cancelled):
        computes.submit(told, ("double", 2), until)


@pytest.mark.slow
@with_ray
@pytest.mark.parametrize(
    ("what", "others", "how"),
    [
        ("node", 0, signal.SIGKILL),
        ("node", 1, signal.SIGSTOP),
        ("head", 0, signal.SIGSTOP),
    ],
)
def test_no_job_hangs_on_a_part_of_the_cluster_that_is_lost(
    tmp_path: Path, what: str, others: int, how: signal.Signals
) -> None:
    """Within half a minute it is done by what is left, or waits, and the service says which."""
    with tempfile.TemporaryDirectory(prefix="ray-") as folder, contextlib.ExitStack() as stack:
        ray_head, address = stack.enter_context(head(folder, 0))
        nodes = [stack.enter_context(node(folder, address, 1)) for _ in range(1 + others)]
        runner = Runner(JobStore(tmp_path, JobLimits()), {"parts": of_parts}, Workers(1), 1, 300.0, Cluster(address))
        stack.callback(runner.close)
        runner.start()
        job = submitted(runner, "sleep", [0.2] * 30)
        deadline = time.monotonic() + SOON
        while runner.store.get(job.id).progress < 0.1:
            assert time.monotonic() < deadline, runner.failure
            time.sleep(0.05)
        signalled(ray_head if what == "head" else nodes[0], how)
        lost = time.monotonic()
        while (now := runner.store.get(job.id)).state == "running":
            assert is_within(time.monotonic() - lost, 30.0), now
            time.sleep(0.05)
        assert now.state in {"succeeded", "queued"}
        assert (now.state == "queued") <= (runner.failure is not None)
        if what == "node":
            assert now.state == ("succeeded" if others else "queued")
        if (what, how, others) == ("node", signal.SIGSTOP, 0):
            signalled(nodes[0], signal.SIGCONT)
            assert ended(runner, job).state == "succeeded"
        started = time.monotonic()
        runner.close()
        assert time.monotonic() - started < 30.0
