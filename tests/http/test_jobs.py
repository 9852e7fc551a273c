"""Jobs over HTTP: told of, watched, cancelled, removed; by any worker, and none of it left at the end."""

import asyncio
import json
import os
import signal
import threading
import time
import urllib.error
import urllib.request
from collections.abc import Callable
from pathlib import Path
from typing import Any, get_args

import pytest
from starlette.testclient import TestClient

from gelenk.contract.jobs import JobInfo
from gelenk.http.jobs import jobs as jobs_module
from gelenk.http.jobs.long_works import LONG_WORK
from gelenk.main import create_app
from gelenk.settings import Settings
from tests.http.access.asking import keys_for
from tests.test_faults import called
from tests.test_serve import get, service

SHORT = {"samples": 1000}
LONG = {"kind": "dexterity", "samples": 200_000, "voxel_size": 0.04, "orientations": 10}
"""Half a minute of inverse kinematics."""
PATH = "/v1/robots/panda/workspace"
REMOVE = {"finished": "remove"}


def posted(client: TestClient, call: dict[str, Any]) -> str:
    answer = client.post(PATH, json=call)
    assert answer.status_code == 202, answer.text
    return str(answer.headers["location"])


def ended(ask: Callable[[], dict[str, Any]], seconds: float = 120.0) -> dict[str, Any]:
    deadline = time.monotonic() + seconds
    while (job := ask())["state"] in {"queued", "running"}:
        assert time.monotonic() < deadline, job
        time.sleep(0.02)
    return job


def running(client: TestClient, location: str) -> dict[str, Any]:
    """The job, once some of it is done."""
    deadline = time.monotonic() + 120.0
    while (job := client.get(location).json())["progress"] == 0.0:
        assert time.monotonic() < deadline
        time.sleep(0.02)
    assert isinstance(job, dict)
    return job


def events(text: str) -> list[dict[str, str]]:
    blocks = [block for block in text.strip().split("\n\n") if not block.startswith(":")]
    return [dict(line.split(": ", 1) for line in block.split("\n")) for block in blocks]


def test_a_job_from_its_beginning_to_its_end(client: TestClient) -> None:
    answer = client.post(PATH, json=SHORT)
    assert answer.status_code == 202
    job = answer.json()
    assert answer.headers["location"] == f"/v1/jobs/{job['id']}"
    assert (job["kind"], job["state"], job["progress"]) == ("workspace", "queued", 0.0)
    assert (job["started"], job["finished"], job["error"]) == (None, None, None)
    job = ended(lambda: client.get(answer.headers["location"]).json())
    assert (job["state"], job["progress"]) == ("succeeded", 1.0)
    assert job["created"] <= job["started"] <= job["finished"]
    assert job["finished"].endswith("Z")


@pytest.mark.slow
@pytest.mark.parametrize("jump", [-365 * 86400.0, -86400.0, 86400.0, 365 * 86400.0])
def test_a_clock_that_is_set_disturbs_no_job(client: TestClient, monkeypatch: pytest.MonkeyPatch, jump: float) -> None:
    """In the middle of a job that is watched: it goes on, its events come, and its result stays."""
    right = time.time
    location = posted(client, {"kind": "dexterity", "samples": 5000, "voxel_size": 0.5, "orientations": 20})
    later = threading.Timer(0.1, lambda: monkeypatch.setattr(time, "time", lambda: right() + jump))
    later.start()
    told = events(client.get(f"{location}/events").text)
    later.join()
    assert told[-1]["event"] == "finished"
    job = client.get(location).json()
    assert job["state"] == "succeeded"
    assert job["created"] <= job["started"] <= job["finished"]
    assert client.get(f"{location}/result").status_code == 200
    call = {"targets": [{"position": [0.4, 0.1, 0.5], "rpy": [3.0, 0.2, 0.4]}], "time_limit": 30.0}
    answer = client.post("/v1/robots/panda/ik", json={**call, "tip_frame": "panda_link8"})
    assert answer.json()["results"][0]["status"] == "solved"


def test_the_same_name_is_the_same_job(client: TestClient) -> None:
    call = {**SHORT, "job_id": "mine"}
    location = posted(client, call)
    assert location == "/v1/jobs/mine"
    ended(lambda: client.get(location).json())
    again = client.post(PATH, json=call)
    assert (again.status_code, again.json()["state"]) == (202, "succeeded")
    other = client.post(PATH, json={**call, "samples": 1001})
    assert (other.status_code, other.json()["type"]) == (409, "urn:gelenk:job-exists")
    assert client.post("/v1/robots/ur5/workspace", json=call).status_code == 409


@pytest.mark.slow
def test_a_stream_tells_of_a_job_to_its_end(client: TestClient) -> None:
    location = posted(client, {"kind": "dexterity", "samples": 20_000, "voxel_size": 0.2, "orientations": 10})
    answer = client.get(f"{location}/events")
    assert answer.headers["content-type"].startswith("text/event-stream")
    told = events(answer.text)
    jobs = [json.loads(event["data"]) for event in told]
    progress = [job["progress"] for job in jobs]
    assert progress == sorted(progress)
    assert len(told) >= 2
    assert [event["event"] for event in told] == ["progress"] * (len(told) - 1) + ["finished"]
    assert jobs[-1] == client.get(location).json()
    assert jobs[-1]["state"] == "succeeded"
    again = events(client.get(f"{location}/events").text)
    assert [event["event"] for event in again] == ["finished"]
    last = {"Last-Event-ID": again[0]["id"]}
    assert client.get(f"{location}/events", headers=last).status_code == 204


@pytest.mark.slow
def test_a_stream_keeps_alive_and_ends_when_its_job_is_cancelled(
    client: TestClient, monkeypatch: pytest.MonkeyPatch
) -> None:
    monkeypatch.setattr(jobs_module, "HEARTBEAT_SECONDS", 0.0)
    monkeypatch.setattr(jobs_module, "LOOK_SECONDS", 0.02)
    location = posted(client, LONG)
    cancelled: list[str] = []

    def hear(told: list[str]) -> bool:
        if ": still there\n\n" in told and not cancelled:
            cancelled.append(client.delete(location).json()["state"])
        return True

    last = events("".join(streamed(client, location, hear)))[-1]
    assert cancelled == ["cancelled"]
    assert last["event"] == "finished"
    assert json.loads(last["data"])["state"] == "cancelled"


def test_a_stream_whose_client_leaves_ends(client: TestClient) -> None:
    """After the first event the client is gone, and so is what has served it."""
    location = posted(client, LONG)
    first, *rest = streamed(client, location, lambda told: not told)
    assert first.startswith("event: progress\n")
    assert len(rest) < 4
    assert client.delete(location).json()["state"] == "cancelled"


def streamed(client: TestClient, location: str, stays: Callable[[list[str]], bool]) -> list[str]:
    """What is told of a job, straight by the application, to a client that stays as long as it likes what was told."""
    told: list[str] = []
    scope = {"type": "http", "method": "GET", "path": f"{location}/events", "root_path": "", "query_string": b""}
    scope |= {
        "headers": [(b"host", b"127.0.0.1")],
        "scheme": "http",
        "server": ("test", 80),
        "client": ("test", 1),
        "http_version": "1.1",
    }

    async def watch() -> None:
        asked = False

        async def receive() -> dict[str, Any]:
            nonlocal asked
            if not asked:
                asked = True
                return {"type": "http.request", "body": b"", "more_body": False}
            while stays(told):
                await asyncio.sleep(0.01)
            return {"type": "http.disconnect"}

        async def send(message: Any) -> None:
            if "body" in message:
                told.append(message["body"].decode())

        await asyncio.wait_for(client.app(scope, receive, send), 60.0)

    asyncio.run(watch())
    return told


def test_a_cancelled_job_has_no_result_and_is_removed_the_second_time(client: TestClient) -> None:
    location = posted(client, LONG)
    assert running(client, location)["state"] == "running"
    early = client.get(f"{location}/result")
    assert (early.status_code, early.json()["type"]) == (409, "urn:gelenk:job-not-finished")
    assert 0.0 <= early.json()["progress"] < 1.0
    assert client.delete(location).json()["state"] == "cancelled"
    assert client.get(location).json()["state"] == "cancelled"
    late = client.get(f"{location}/result")
    assert (late.status_code, late.json()["type"]) == (409, "urn:gelenk:job-cancelled")
    assert client.delete(location, params=REMOVE).json()["state"] == "cancelled"
    assert client.get(location).status_code == 404
    after = posted(client, SHORT)
    assert ended(lambda: client.get(after).json())["state"] == "succeeded"


def test_cancelling_what_has_just_finished_keeps_its_result(client: TestClient) -> None:
    """It is removed only where that is said."""
    location = posted(client, SHORT)
    job = ended(lambda: client.get(location).json())
    late = client.delete(location)
    assert (late.status_code, late.json()["type"]) == (409, "urn:gelenk:job-finished")
    assert (late.json()["job"], late.json()["state"]) == (job["id"], job["state"])
    assert "finished=remove" in late.json()["detail"]
    assert client.get(location).json() == job
    assert client.get(f"{location}/result").status_code == 200
    assert client.delete(location, params={"finished": "gone"}).status_code == 422
    assert client.delete(location, params=REMOVE).json() == job
    assert client.get(location).status_code == 404


@pytest.mark.slow
def test_a_job_goes_on_when_a_process_is_killed(client: TestClient) -> None:
    location = posted(client, {"kind": "dexterity", "samples": 20_000, "voxel_size": 0.25, "orientations": 20})
    running(client, location)
    processes = called("jobs", os.getpid())
    assert len(processes) >= 1
    for process in processes:
        os.kill(process, signal.SIGKILL)
    assert ended(lambda: client.get(location).json())["state"] == "succeeded"


def test_each_operation_that_runs_as_a_job_is_a_kind_of_job() -> None:
    assert set(get_args(JobInfo.model_fields["kind"].annotation)) == set(LONG_WORK)


@pytest.mark.parametrize("method", ["GET", "DELETE"])
@pytest.mark.parametrize("name", ["nobody", "..%2f..", "%00", "x" * 300, "panda%0aworkspace"])
def test_unknown_jobs(client: TestClient, method: str, name: str) -> None:
    answer = client.request(method, f"/v1/jobs/{name}")
    assert answer.status_code == 404
    assert answer.headers["content-type"] == "application/problem+json"
    if method == "GET" and "%" not in name:
        for part in ("events", "result"):
            assert client.get(f"/v1/jobs/{name}/{part}").json()["type"] == "urn:gelenk:unknown-job"


@pytest.mark.slow
def test_a_failed_job_answers_with_its_problem(tmp_path: Path) -> None:
    with TestClient(create_app(Settings(data_dir=tmp_path, job_processes=1, job_bytes=1000))) as client:
        location = posted(client, {"kind": "cloud", "samples": 1000})
        job = ended(lambda: client.get(location).json())
        assert (job["state"], job["error"]["type"]) == ("failed", "urn:gelenk:too-large")
        answer = client.get(f"{location}/result")
        assert (answer.status_code, answer.json()["type"]) == (413, "urn:gelenk:too-large")
        assert answer.json()["detail"] == job["error"]["detail"]
        assert answer.json()["detail"].endswith("more than the 1000 allowed")


@pytest.mark.slow
def test_a_job_goes_on_after_the_end_of_the_service(tmp_path: Path) -> None:
    call = {**LONG, "job_id": "mine"}
    settings = Settings(data_dir=tmp_path, job_processes=1)
    with TestClient(create_app(settings)) as client:
        before = running(client, posted(client, call))["progress"]
    with TestClient(create_app(settings)) as client:
        assert client.get("/v1/jobs/mine").json()["progress"] >= before
        again = client.post("/v1/robots/panda/workspace", json=call)
        assert (again.status_code, again.json()["state"]) in {(202, "queued"), (202, "running")}
        assert client.delete("/v1/jobs/mine").json()["state"] == "cancelled"


def processes_of(data_dir: Path) -> set[int]:
    """Processes whose environment names a data folder."""
    found = set()
    for path in Path("/proc").glob("[0-9]*/environ"):
        try:
            if f"GELENK_DATA_DIR={data_dir}".encode() in path.read_bytes().split(b"\0"):
                found.add(int(path.parent.name))
        except OSError:
            continue
    return found


def refused(url: str) -> tuple[int, str]:
    """Status and Retry-After of a job that is not taken."""
    request = urllib.request.Request(url, json.dumps(LONG).encode(), {"Content-Type": "application/json"})
    try:
        with urllib.request.urlopen(request, timeout=60) as answer:
            return answer.status, ""
    except urllib.error.HTTPError as error:
        with error:
            return error.code, error.headers["Retry-After"]


@pytest.mark.slow
def test_every_worker_knows_every_job_and_the_service_leaves_nothing(tmp_path: Path) -> None:
    limits = {"GELENK_UNFINISHED_JOBS": "2", "GELENK_JOB_PROCESSES": "1"}
    with service(tmp_path, "--workers", "2", **limits) as (run, url):
        status, short = get(f"{url}{PATH}", "POST", SHORT)
        assert status == 202
        jobs = [get(f"{url}/v1/jobs/{short['id']}") for _ in range(12)]  # each on a new connection
        assert {(status, job["id"]) for status, job in jobs} == {(200, short["id"])}
        ended(lambda: get(f"{url}/v1/jobs/{short['id']}")[1])
        assert {get(f"{url}/v1/jobs/{short['id']}/result")[0] for _ in range(8)} == {200}
        long = [get(f"{url}{PATH}", "POST", LONG)[1]["id"] for _ in range(2)]
        assert refused(f"{url}{PATH}") == (429, "5")
        assert get(f"{url}/v1/jobs/{long[0]}", "DELETE")[1]["state"] == "cancelled"
        assert {get(f"{url}/v1/jobs/{long[0]}")[1]["state"] for _ in range(8)} == {"cancelled"}
        started = time.monotonic()
        run.send_signal(signal.SIGTERM)
        run.wait(timeout=60)
        assert time.monotonic() - started < 30.0
    deadline = time.monotonic() + 60.0
    while processes_of(tmp_path):
        assert time.monotonic() < deadline
        time.sleep(0.05)
    with TestClient(create_app(Settings(data_dir=tmp_path))) as again:
        assert again.get(f"/v1/jobs/{short['id']}").json()["state"] == "succeeded"
        assert again.get(f"/v1/jobs/{short['id']}/result").status_code == 200
        assert again.get(f"/v1/jobs/{long[1]}").json()["state"] in {"queued", "running"}
        assert again.delete(f"/v1/jobs/{long[1]}").json()["state"] == "cancelled"


def test_the_list_has_ones_own_jobs_in_pieces(client: TestClient) -> None:
    made = [posted(client, {**SHORT, "samples": 1001 + i}).removeprefix("/v1/jobs/") for i in range(3)]
    first = client.get("/v1/jobs?limit=2")
    assert first.headers["cache-control"] == "no-store"
    assert [job["id"] for job in first.json()["jobs"]] == [made[2], made[1]]
    rest = client.get(f"/v1/jobs?limit=2&before={first.json()['next']}").json()
    assert rest["jobs"][0]["id"] == made[0]
    listed = client.get("/v1/jobs?limit=1").json()["jobs"][0]
    assert set(listed) == set(client.get(f"/v1/jobs/{made[2]}").json())
    refused = client.get("/v1/jobs?limit=0")
    assert (refused.status_code, "limit" in refused.text) == (422, True)


def test_nobody_lists_the_jobs_of_another_key(tmp_path: Path) -> None:
    entries, keys = keys_for("read+write", "read+write+teach")
    with TestClient(create_app(Settings(data_dir=tmp_path, api_keys=entries))) as client:
        one, other = ({"Authorization": f"Bearer {key}"} for key in keys.values())
        assert client.post(PATH, json=SHORT, headers=one).status_code == 202
        counts = [len(client.get("/v1/jobs", headers=who).json()["jobs"]) for who in (one, other)]
        assert counts == [1, 0]
        assert client.get("/v1/jobs").status_code == 401


def test_nobody_lists_the_jobs_of_another_behind_a_proxy(tmp_path: Path) -> None:
    """Without a key all of them come from this machine: only who needs no proxy is alone there."""
    with TestClient(create_app(Settings(data_dir=tmp_path)), client=("127.0.0.1", 5000)) as client:
        assert client.post(PATH, json=SHORT).status_code == 202
        assert len(client.get("/v1/jobs").json()["jobs"]) == 1
        assert client.get("/v1/jobs", headers={"X-Forwarded-For": "10.0.0.7"}).json() == {"jobs": [], "next": None}
