"""What the metrics count is what was asked, over all processes; their number is bounded, whatever names come in."""

import os
import signal
import time
import urllib.request
from collections.abc import Iterator
from pathlib import Path

import pytest
from prometheus_client.parser import text_string_to_metric_families
from starlette.testclient import TestClient

from gelenk.http.access import metrics
from gelenk.pool.pool import WorkerPool
from tests.http.access.asking import HOST, application, ask, bearer, keys_for
from tests.http.conftest import ready_client
from tests.test_faults import called, wait_for
from tests.test_serve import get, service

Numbers = dict[tuple[str, frozenset[tuple[str, str]]], float]
CALL = {"joint_positions": [[0.1, 0.2], [0.3, 0.4], [0.5, 0.6]]}


@pytest.fixture(scope="module")
def client(tmp_path_factory: pytest.TempPathFactory) -> Iterator[TestClient]:
    yield from ready_client(tmp_path_factory.mktemp("metrics"))


def numbers(text: str) -> Numbers:
    return {
        (sample.name, frozenset(sample.labels.items())): sample.value
        for family in text_string_to_metric_families(text)
        for sample in family.samples
    }


def number(found: Numbers, name: str, **labels: str) -> float:
    return found.get((f"gelenk_{name}", frozenset(labels.items())), 0.0)


def told(client: TestClient) -> Numbers:
    answer = client.get("/metrics")
    assert answer.headers["content-type"].startswith("text/plain; version=0.0.4")
    return numbers(answer.text)


def test_calls_are_counted_with_their_batches_and_times(client: TestClient) -> None:
    labels = {"operation": "forward_kinematics", "robot": "planar_2r"}
    before = told(client)
    started = time.perf_counter()
    for _ in range(5):
        assert client.post("/v1/robots/planar_2r/fk", json=CALL).status_code == 200
    assert client.post("/v1/robots/planar_2r/fk", json={"joint_positions": [[1]]}).status_code == 422
    elapsed = time.perf_counter() - started
    after = told(client)

    def more(name: str, **labels: str) -> float:
        return number(after, name, **labels) - number(before, name, **labels)

    assert more("request_seconds_count", **labels) == 6
    assert 0.0 < more("request_seconds_sum", **labels) < elapsed
    assert more("request_seconds_bucket", le="+Inf", **labels) == 6
    assert more("batch_size_count", **labels) == 5
    assert more("batch_size_sum", **labels) == 15
    assert more("batch_size_bucket", le="1.0", **labels) == 0
    assert more("batch_size_bucket", le="10.0", **labels) == 5
    assert more("answers_total", operation="forward_kinematics", status="200") == 5
    assert more("answers_total", operation="forward_kinematics", status="422") == 1


@pytest.mark.quick(1)
@pytest.mark.parametrize("count", [1, 200])
def test_the_solve_rate_is_that_of_the_answers(client: TestClient, count: int) -> None:
    """A few targets are solved on the event loop, many by the pool."""
    near = {"position": [0.5, 0.5, 0.0], "rpy": [0.0, 0.0, 0.0]}
    far = {"position": [50.0, 0.0, 0.0], "rpy": [0.0, 0.0, 0.0]}
    call = {"targets": [near, far] * count, "task": ["x", "y"]}
    before = told(client)
    answer = client.post("/v1/robots/planar_2r/ik", json=call).json()["results"]
    after = told(client)
    solutions = [solution for result in answer for solution in result["solutions"]]
    assert len(solutions) == count
    for name, labels, expected in (
        ("ik_targets_total", {"status": "solved"}, count),
        ("ik_targets_total", {"status": "unreachable"}, count),
        ("ik_solutions_total", {}, count),
        ("ik_iterations_total", {}, sum(solution["iterations"] for solution in solutions)),
    ):
        labels = {"robot": "planar_2r", **labels}  # noqa: PLW2901
        assert number(after, name, **labels) - number(before, name, **labels) == expected
    labels = {"operation": "inverse_kinematics", "robot": "planar_2r"}
    sizes = [number(each, "batch_size_sum", **labels) for each in (before, after)]
    assert sizes[1] - sizes[0] == 2 * count


def test_what_is_under_way_is_told(client: TestClient) -> None:
    found = told(client)
    assert number(found, "requests_in_flight") == 1.0  # the one that asks
    resident = number(found, "resident_bytes")
    assert 5e7 < resident < 5e9
    assert number(found, "cpu_seconds_total") > 0.1
    assert number(found, "crew_processes") >= 2
    assert (number(found, "crew_busy"), number(found, "queue_length")) == (0, 0)
    job = {"kind": "cloud", "samples": 1000, "job_id": "counted"}
    assert client.post("/v1/robots/planar_2r/workspace", json=job).status_code == 202
    found = told(client)
    assert sum(number(found, "jobs", state=state) for state in ("queued", "running", "succeeded")) == 1


@pytest.mark.slow
def test_names_from_outside_cannot_multiply_the_numbers(monkeypatch: pytest.MonkeyPatch) -> None:
    monkeypatch.setattr(metrics, "MOST_ROBOTS", 3)
    made = metrics.Metrics(["panda", "ur5"], WorkerPool(2, 1, 1), dict)
    app = application()
    monkeypatch.setattr(app.entry, "metrics", made)  # type: ignore[attr-defined]
    for i in range(50):
        assert ask(app, f"/v1/robots/robot{i}").status == 404
        assert ask(app, f"/nothing/{i}", method="BREW").status in {404, 405}
    for robot in ("panda", "ur5", "planar_2r", "planar_3r"):
        assert ask(app, f"/v1/robots/{robot}").status == 200
    made.publish()
    found = numbers(made.text().decode())
    assert {dict(labels)["robot"] for _, labels in found if "robot" in dict(labels)} == {
        *("", "panda", "ur5", "planar_2r", "other"),
    }
    assert number(found, "request_seconds_count", operation="get_robot", robot="other") == 51
    assert {dict(labels)["operation"] for _, labels in found if "operation" in dict(labels)} == {"get_robot", "unknown"}


def test_refusals_are_counted_and_metrics_need_the_admin_scope() -> None:
    entries, keys = keys_for("admin", "read+write")
    app = application(api_keys=entries)
    for _ in range(3):
        assert ask(app, "/v1/robots").status == 401
    assert ask(app, "/metrics", headers=(HOST, bearer(keys["read+write"]))).status == 403
    answer = ask(app, "/metrics", headers=(HOST, bearer(keys["admin"])))
    found = numbers(answer.body.decode())
    assert number(found, "answers_total", operation="list_robots", status="401") == 3
    assert number(found, "answers_total", operation="metrics", status="403") == 1


@pytest.mark.slow
def test_several_processes_are_counted_together_and_a_killed_one_takes_nothing_away(tmp_path: Path) -> None:
    def counted() -> Numbers:
        with urllib.request.urlopen(f"{url}/metrics", timeout=60) as answer:
            return numbers(answer.read().decode())

    def calls(found: Numbers) -> float:
        return number(found, "request_seconds_count", operation="forward_kinematics", robot="planar_2r")

    with service(tmp_path, "--workers", "2", GELENK_CREW_PROCESSES="3") as (run, url):
        for _ in range(40):  # each on a new connection, so that both workers get some
            assert get(f"{url}/v1/robots/planar_2r/fk", "POST", CALL)[0] == 200
        wait_for(lambda: calls(counted()) == 40.0)  # each process tells every second
        assert {calls(counted()) for _ in range(8)} == {40.0}
        assert number(counted(), "crew_processes") == 6.0
        (folder,) = {
            Path(line.removeprefix("PROMETHEUS_MULTIPROC_DIR="))
            for line in Path(f"/proc/{called('worker', run.pid)[0]}/environ").read_text().split("\0")
            if line.startswith("PROMETHEUS_MULTIPROC_DIR=")
        }
        victim = called("worker", run.pid)[0]
        os.kill(victim, signal.SIGKILL)
        wait_for(lambda: victim not in called("worker", run.pid) and len(called("worker", run.pid)) == 2)
        for _ in range(10):
            assert get(f"{url}/v1/robots/planar_2r/fk", "POST", CALL)[0] == 200
        wait_for(lambda: calls(counted()) == 50.0)
        (folder / "counter_1.db").touch()  # a process that has just begun
        assert calls(counted()) == 50.0
    assert not folder.exists()
