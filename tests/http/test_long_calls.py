"""Operations asked for as jobs: checked at once, and answered in the very bytes that they answer with at once."""

import asyncio
import hashlib
import json
import time
from collections.abc import Mapping
from io import BytesIO
from pathlib import Path
from typing import Any

import httpx2 as httpx
import numpy as np
import pytest
from starlette.testclient import TestClient

from gelenk.contract.endpoint import Scope
from gelenk.contract.trajectory_request import TrajectoryRequest
from gelenk.http.access.keyring import new_key
from gelenk.http.messages.payloads import wants_answer_later
from gelenk.ik import solve
from gelenk.ik.search import problem
from gelenk.main import create_app
from gelenk.pool.pool import WorkerPool
from gelenk.robot.arrays import Array
from gelenk.settings import Settings

JSON, NPY, CSV = "application/json", "application/x-npy", "text/csv"
SVG, PNG, PDF = "image/svg+xml", "image/png", "application/pdf"
LATER = {"Prefer": "respond-async"}


def test_a_trajectory_s_call_reads_back_as_it_was_written() -> None:
    """A job keeps it so, be its targets poses or configurations; a warning would be an error here."""
    pose, other = ({"position": [0.5, y, 0.4], "rpy": [3.0, 0.0, 0.3]} for y in (0.1, -0.1))
    segments: list[dict[str, Any]] = [
        {"type": "joint", "target": [0.3, -0.5]},
        {"type": "joint", "target": {"position": 0.3, "elbow": -0.5}},
        {"type": "line", "target": pose},
        {"type": "circle", "via": pose, "target": other},
        {"type": "spline", "waypoints": [pose, other]},
        {"type": "spline", "waypoints": [[0.1, 0.2], {"position": 0.3, "elbow": -0.5}]},
    ]
    call = TrajectoryRequest.model_validate_json(json.dumps({"start": [0.0, 0.0], "segments": segments}))
    written = call.model_dump_json(exclude_unset=True)
    assert TrajectoryRequest.model_validate_json(written) == call
    assert json.loads(written)["segments"] == segments


def finished(client: TestClient, answer: httpx.Response, seconds: float = 60.0) -> str:
    """The address of the result that a call has been promised."""
    assert answer.status_code == 202, answer.text
    assert answer.headers["preference-applied"] == "respond-async"
    location = str(answer.headers["location"])
    assert location == f"/v1/jobs/{answer.json()['id']}"
    deadline = time.monotonic() + seconds
    while (job := client.get(location).json())["state"] in {"queued", "running"}:
        assert time.monotonic() < deadline, job
        time.sleep(0.02)
    assert (job["state"], job["progress"], job["error"]) == ("succeeded", 1.0, None)
    return f"{location}/result"


def told_by(answer: httpx.Response) -> dict[str, str]:
    return {name: value for name, value in answer.headers.items() if name.startswith(("gelenk-", "content-type"))}


def same(client: TestClient, url: str, accepted: tuple[str, ...], **call: Any) -> None:
    """A call answers with the same bytes and the same headers of its own, whether at once or by a job."""
    headers: Mapping[str, str] = call.pop("headers", {})
    result = finished(client, client.post(url, headers={**headers, **LATER}, **call))
    for media_type in accepted:
        wanted = {"Accept": media_type}
        now, then = client.post(url, headers={**headers, **wanted}, **call), client.get(result, headers=wanted)
        assert (now.status_code, then.status_code) == (200, 200), now.text + then.text
        assert then.content == now.content
        assert len(then.headers.pop("gelenk-robot-digest")) == 64
        own = [
            {k: v for k, v in a.headers.items() if k.startswith("gelenk-") or k == "content-type"} for a in (now, then)
        ]
        assert own[0] == own[1]


def poses(client: TestClient, robot: str, count: int, joints: int, tip: str | None) -> Array:
    """Targets of which most can be reached, as rows of position and quaternion."""
    qs = np.random.default_rng(5).uniform(-1.5, 1.5, (count, joints))
    body = BytesIO()
    np.save(body, qs)
    query = {} if tip is None else {"tip_frame": tip}
    url, kinds = f"/v1/robots/{robot}/fk", {"Content-Type": NPY, "Accept": NPY}
    answer = client.post(url, params=query, content=body.getvalue(), headers=kinds)
    assert answer.status_code == 200, answer.text
    Ts: Array = np.load(BytesIO(answer.content))
    Ts[::250, :3] *= 30.0
    return Ts


@pytest.mark.slow
@pytest.mark.parametrize(
    ("robot", "joints", "options"),
    [
        ("ur5", 6, {}),
        ("panda", 7, {"tip_frame": "panda_link8", "random_seed": 3}),
        ("panda", 7, {"tip_frame": "panda_link8", "task": ["x", "y", "z"], "max_iterations": 200}),
    ],
    ids=["closed form", "search", "search for positions"],
)
def test_many_targets_as_npy(client: TestClient, robot: str, joints: int, options: dict[str, Any]) -> None:
    """More than a part holds, so that the results of several are put together; one solution each, or none."""
    Ts = poses(client, robot, 4096 + 150, joints, options.get("tip_frame"))
    body = BytesIO()
    np.save(body, Ts)
    same(
        client,
        f"/v1/robots/{robot}/ik",
        (JSON, NPY),
        params=options,
        content=body.getvalue(),
        headers={"Content-Type": NPY},
    )


def test_targets_as_npy_of_another_form(client: TestClient) -> None:
    """A job reads them from the body as it was sent: here matrices, column by column, of the other byte order."""
    Ts = np.tile(np.eye(4), (70, 1, 1))
    Ts[:, :3, 3] = np.random.default_rng(8).uniform(-0.5, 0.5, (70, 3))
    body = BytesIO()
    np.save(body, np.asfortranarray(Ts).astype(">f8"))
    same(
        client,
        "/v1/robots/ur5/ik",
        (JSON, NPY),
        params={"max_iterations": 400},
        content=body.getvalue(),
        headers={"Content-Type": NPY},
    )


def told_poses(Ts: Array) -> list[dict[str, Any]]:
    return [{"position": row[:3], "quaternion_xyzw": row[3:]} for row in Ts.tolist()]


POSTURE = [0.1, -0.4, 0.2, -1.9, 0.1, 1.5, 0.3]


@pytest.mark.slow
@pytest.mark.parametrize(
    ("robot", "joints", "options"),
    [
        ("ur5", 6, {"solutions": "all"}),
        ("ur5", 6, {"method": "newton", "trace": True, "max_iterations": 20}),
        ("panda", 7, {"objective": "posture", "posture": POSTURE, "max_iterations": 400}),
        ("panda", 7, {"objective": "manipulability", "max_iterations": 400, "pose_format": "matrix"}),
        pytest.param(
            *("panda", 7, {"seeds": "each", "max_iterations": 40, "method": "damped_least_squares"}),
            marks=pytest.mark.slow,
        ),
        ("panda", 7, {"seeds": "each", "max_iterations": 400}),
    ],
    ids=["all", "newton", "posture", "manipulability", "steps from own seeds", "search from own seeds"],
)
def test_some_targets_as_json(client: TestClient, robot: str, joints: int, options: dict[str, Any]) -> None:
    """Whatever is asked of them: what takes longer comes in smaller parts, here of 128 targets and of one."""
    Ts = poses(client, robot, 129, joints, None)
    if options.get("seeds"):
        options = {**options, "seeds": np.random.default_rng(6).uniform(-1.0, 1.0, (len(Ts), joints)).tolist()}
    fits = (JSON,) if options.get("solutions") == "all" or options.get("trace") else (JSON, NPY)
    same(client, f"/v1/robots/{robot}/ik", fits, json={"targets": told_poses(Ts), **options})


PLANAR: dict[str, Any] = {
    "convention": "standard",
    "joints": [{"name": name, "type": "revolute", "a": 1.0, "alpha": 0.0, "d": 0.0, "theta": 0.0} for name in "ab"],
}
MOTION: dict[str, Any] = {
    "start": [0.0, -0.785, 0.0, -2.356, 0.0, 1.571, 0.785],
    "segments": [
        {"type": "joint", "target": [0.3, -0.5, 0.1, -2.2, 0.05, 1.8, 0.9]},
        {"type": "line", "target": {"position": [0.5, 0.2, 0.4], "rpy": [3.1, 0.0, 0.3]}, "blend_radius": 0.02},
        {"type": "line", "target": {"position": [0.5, -0.1, 0.4], "rpy": [3.1, 0.0, 0.0]}},
    ],
    "tip_frame": "panda_link8",
}


@pytest.mark.slow
@pytest.mark.parametrize(
    "options",
    [
        {"law": "trapezoidal", "sample_period": 0.0003, "pose_format": "rpy", "torques": True},
        {"law": "jerk_limited", "sample_period": 0.01, "coefficients": True, "compare_timing": True},
        pytest.param({"law": "quintic", "sample_period": 0.0004, "tip_poses": False}, marks=pytest.mark.slow),
        {"law": "cubic", "segments": [{"type": "line", "target": {"position": [3.0, 0.0, 0.0], "rpy": [0, 0, 0]}}]},
    ],
    ids=["several parts", "all there is to tell", "without poses", "out of reach"],
)
def test_trajectories(client: TestClient, options: dict[str, Any]) -> None:
    same(client, "/v1/robots/panda/trajectory", (JSON, NPY, CSV, SVG, PNG, PDF), json={**MOTION, **options})


@pytest.mark.slow
def test_a_trajectory_may_have_more_samples_and_no_more(client: TestClient) -> None:
    call = {**MOTION, "law": "quintic", "duration": 12.0, "sample_period": 1e-4, "tip_poses": False}
    refused = client.post("/v1/robots/panda/trajectory", json=call)
    assert (refused.status_code, refused.json()["field"]) == (422, "sample_period")
    answer = client.post("/v1/robots/panda/trajectory", json={**call, "sample_period": 2e-5}, headers=LATER)
    assert (answer.status_code, answer.json()["field"]) == (422, "sample_period")
    assert "500000 are allowed" in answer.json()["detail"]
    result = finished(client, client.post("/v1/robots/panda/trajectory", json=call, headers=LATER))
    rows = np.load(BytesIO(client.get(result, headers={"Accept": NPY}).content))
    assert rows.shape == (120_001, 22)
    assert rows[-1, 0] == pytest.approx(12.0, abs=1e-12)
    np.testing.assert_allclose(np.diff(rows[:, 1:8], axis=0), 1e-4 * rows[:-1, 8:15], atol=1e-7)


class Leap:
    """A clock on which an hour passes each time that it is looked at: the busiest machine of all.

    Args:
        first: How often it is looked at before.
    """

    def __init__(self, first: int = 0) -> None:
        self.now = -3600.0 * first

    def __call__(self) -> float:
        self.now += 3600.0
        return max(0.0, self.now)


class Here(WorkerPool):
    """A pool without processes."""

    async def run(self, function: Any, argument: Any, *_: Any) -> Any:
        return await asyncio.to_thread(function, argument)


@pytest.mark.slow
@pytest.mark.parametrize(
    "options",
    [{}, {"objective": "mid_range"}, {"solutions": "all"}, {"method": "newton", "max_iterations": 3}],
    ids=", ".join,
)
def test_the_answer_does_not_depend_on_how_busy_the_machine_is(
    tmp_path: Path, monkeypatch: pytest.MonkeyPatch, options: dict[str, Any]
) -> None:
    with TestClient(create_app(Settings(data_dir=tmp_path), Here(1, 1, 0))) as client:
        Ts = poses(client, "panda", 20, 7, None)
        call = {"targets": told_poses(Ts), "max_iterations": 400, **options}
        result = finished(client, client.post("/v1/robots/panda/ik", json=call, headers=LATER))
        for module in (problem, solve):
            monkeypatch.setattr(module, "clock", Leap())
        now = client.post("/v1/robots/panda/ik", json=call)
        assert now.content == client.get(result).content


@pytest.mark.quick(1)
@pytest.mark.parametrize("trace", [False, True])
def test_a_solution_that_time_kept_from_its_objective_says_so(
    tmp_path: Path, monkeypatch: pytest.MonkeyPatch, trace: bool
) -> None:
    with TestClient(create_app(Settings(data_dir=tmp_path), Here(1, 1, 0))) as client:
        targets = told_poses(poses(client, "panda", 2, 7, None)[1:])
        call = {"targets": targets, "objective": "mid_range", "time_limit": 60.0, "trace": trace}
        clock = Leap(first=2)
        for module in (problem, solve):
            monkeypatch.setattr(module, "clock", clock)
        (result,) = client.post("/v1/robots/panda/ik", json=call).json()["results"]
    assert (result["status"], result["stop_reason"]) == ("solved", "time_limit")


@pytest.mark.slow
@pytest.mark.parametrize("path", ["workspace", "ik", "trajectory"])
def test_a_job_and_its_result_say_for_which_version_of_a_robot(client: TestClient, path: str) -> None:
    """The digest of its description, as it was when the job was asked for; whatever stands under the name by now."""
    calls: dict[str, Any] = {
        "workspace": {"samples": 10},
        "ik": {"targets": [{"position": [1.0, 0.5, 0.0], "rpy": [0.0, 0.0, 0.0]}], "task": ["x", "y"]},
        "trajectory": {"start": [0.1, 0.2], "segments": [{"type": "joint", "target": [0.3, 0.4]}], "law": "cubic"},
    }
    tables = [{**PLANAR, "joints": [{**joint, "a": a} for joint in PLANAR["joints"]]} for a in (1.0, 1.5)]
    digests = []
    for table in tables:
        client.delete("/v1/robots/changing")
        assert client.post("/v1/robots", json={"name": "changing", "dh": table}).status_code == 201
        digests.append(hashlib.sha256(client.get("/v1/robots/changing/urdf").content).hexdigest())
        job = client.post(f"/v1/robots/changing/{path}", json=calls[path], headers=LATER)
        assert job.json()["robot_digest"] == digests[-1]
        client.delete("/v1/robots/changing")
        result, deadline = f"{job.headers['location']}/result", time.monotonic() + 60.0
        while client.get(result).status_code == 409:
            assert time.monotonic() < deadline
            time.sleep(0.02)
        assert client.get(job.headers["location"]).json()["robot_digest"] == digests[-1]
        for media_type in (JSON, NPY):
            answer = client.get(result, headers={"Accept": media_type})
            assert answer.headers["gelenk-robot-digest"] == digests[-1]
        if path == "workspace":
            assert client.get(result).json()["robot_digest"] == digests[-1]
    assert digests[0] != digests[1]


def test_no_targets(client: TestClient) -> None:
    same(client, "/v1/robots/ur5/ik", (JSON, NPY), json={"targets": []})


def test_what_does_not_fit_into_an_array_says_so(client: TestClient) -> None:
    call = {"targets": [{"position": [0.3, 0.2, 0.4], "rpy": [0.0, 0.0, 0.0]}], "solutions": "all"}
    result = finished(client, client.post("/v1/robots/ur5/ik", json=call, headers=LATER))
    for media_type in (NPY, "image/png"):
        answer = client.get(result, headers={"Accept": media_type})
        if media_type == NPY:
            assert (answer.status_code, answer.json()["type"]) == (422, "urn:gelenk:invalid-array")
        else:
            assert answer.headers["content-type"] == JSON


@pytest.mark.parametrize(
    ("path", "call", "field"),
    [
        ("ur5/ik", {"targets": [], "time_limit": 5.0}, "time_limit"),
        ("ur5/ik", {"targets": [], "solutions": "all", "trace": True}, "solutions"),
        ("ur5/ik", {"targets": [], "seeds": [[0.0]]}, "seeds"),
        ("ur5/ik", {"targets": [], "tip_frame": "nose"}, None),
        ("nobody/ik", {"targets": []}, None),
    ],
)
def test_what_is_wrong_is_said_at_once(client: TestClient, path: str, call: dict[str, Any], field: str | None) -> None:
    answer = client.post(f"/v1/robots/{path}", json=call, headers=LATER)
    assert answer.status_code in {404, 422}, answer.text
    assert answer.headers["content-type"] == "application/problem+json"
    assert "location" not in answer.headers
    assert answer.json().get("field") == field


@pytest.mark.slow
def test_a_job_may_have_more(client: TestClient) -> None:
    target = {"position": [0.3, 0.2, 0.4], "rpy": [0.0, 0.0, 0.0]}
    call = {"targets": [target] * 1001, "method": "newton", "max_iterations": 1}
    assert client.post("/v1/robots/planar_2r/ik", json=call).json()["type"] == "urn:gelenk:too-large"
    answer = client.post("/v1/robots/planar_2r/ik", json=call, headers=LATER)
    results = client.get(finished(client, answer)).json()["results"]
    assert len(results) == 1001


def test_a_preference_that_cannot_be_met_is_left_aside(client: TestClient) -> None:
    answer = client.post("/v1/robots/planar_2r/fk", json={"joint_positions": [[0.0, 0.0]]}, headers=LATER)
    assert answer.status_code == 200
    assert "preference-applied" not in answer.headers


@pytest.mark.slow
def test_a_job_is_kept_and_needs_the_scope_for_that(tmp_path: Path) -> None:
    keys = {scope: new_key(str(scope), [scope]) for scope in (Scope.READ, Scope.WRITE)}
    settings = Settings(data_dir=tmp_path, api_keys="\n".join(key.entry() for _, key in keys.values()))
    call = {"targets": [{"position": [0.3, 0.2, 0.4], "rpy": [0.0, 0.0, 0.0]}]}
    with TestClient(create_app(settings)) as client:
        for scope, headers, status in (
            (Scope.READ, {}, 200),
            (Scope.READ, LATER, 403),
            (Scope.READ, {"Prefer": "wait=1"}, 200),
            (Scope.WRITE, LATER, 202),
            (Scope.WRITE, {}, 403),
        ):
            allowed = {"Authorization": f"Bearer {keys[scope][0]}", **headers}
            assert client.post("/v1/robots/ur5/ik", json=call, headers=allowed).status_code == status, (scope, headers)
    audit = (tmp_path / "audit" / "audit.jsonl").read_text().splitlines()
    assert [json.loads(line)["status"] for line in audit] == [403, 202]


@pytest.mark.parametrize(
    ("values", "wanted"),
    [
        ([b"respond-async"], True),
        ([b"Respond-Async; x=1, wait=10"], True),
        ([b"wait=10", b"handling=lenient,respond-async"], True),
        ([b"wait=10"], False),
        ([b'"respond-async"'], False),
        ([b"x; respond-async"], False),
        ([b"respond-asynchronously"], False),
        ([], False),
    ],
)
def test_preferences(values: list[bytes], wanted: bool) -> None:
    headers = [(b"accept", b"respond-async"), *((b"prefer", value) for value in values)]
    assert wants_answer_later(headers) is wanted
