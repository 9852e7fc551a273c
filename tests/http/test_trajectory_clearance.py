"""Trajectories in a cell over HTTP: how near they come, where they end before a contact, every way to ask wrongly."""

from io import BytesIO
from typing import Any

import numpy as np
import pytest
from starlette.testclient import TestClient

from gelenk.contract.trajectories import MotionsAnswer
from gelenk.contract.trajectory_answer import TrajectoryAnswer
from tests.http.test_jobs import ended

READY = [0.0, -0.785, 0.0, -2.356, 0.0, 1.571, 0.785]
LEFT, RIGHT = ([base, -0.2, 0.0, -2.2, 0.0, 2.0, 0.785] for base in (-0.5, 1.4))
POST = {
    "name": "post",
    "shape": {"type": "cylinder", "radius": 0.03, "length": 0.8},
    "pose": {"position": [0.45, 0.35, 0.4]},
    "clearance": 0.02,
}
TABLE = {"name": "table", "shape": {"type": "box", "size": [1.0, 1.4, 0.04]}, "pose": {"position": [0.6, 0.0, -0.02]}}
SCENE = {"objects": [TABLE, POST]}
DOWN = {"position": [0.4, 0.1, -0.1], "rpy": [3.14159265, 0.0, 0.0]}
PATH = "/v1/robots/panda/trajectory"


def turn(target: list[float], **fields: Any) -> dict[str, Any]:
    return {"start": LEFT, "segments": [{"type": "joint", "target": target}], "scene": SCENE, **fields}


def lowered(**fields: Any) -> dict[str, Any]:
    """A blended motion into the table, after one of the joints."""
    over = {"type": "line", "target": {**DOWN, "position": [0.4, 0.1, 0.4]}, "blend_radius": 0.05}
    segments = [{"type": "joint", "target": [0.1, *READY[1:]]}, over, {"type": "line", "target": DOWN}]
    return {"start": READY, "segments": segments, "scene": SCENE, "tip_frame": "panda_hand_tcp", **fields}


def ask(client: TestClient, body: dict[str, Any]) -> dict[str, Any]:
    """The answer, which is what its model says."""
    answer = client.post(PATH, json=body)
    assert answer.status_code == 200, answer.text[:1000]
    TrajectoryAnswer.model_validate_json(answer.content)
    content: dict[str, Any] = answer.json()
    return content


def ended_result(client: TestClient, job: str) -> dict[str, Any]:
    assert ended(lambda: client.get(job).json())["state"] == "succeeded"
    content: dict[str, Any] = client.get(f"{job}/result").json()
    return content


def clearances(client: TestClient, answer: dict[str, Any], scene: Any = SCENE) -> list[float]:
    """What `collisions` finds at the samples of a motion."""
    body = {"joint_positions": answer["joint_positions"], "scene": scene, "clearance": True, "pairs": "none"}
    found = client.post("/v1/robots/panda/collisions", json=body).json()["results"]
    return [result["clearance"] for result in found]


def test_a_free_motion_says_how_near_it_comes(client: TestClient) -> None:
    answer = ask(client, turn([0.2, *LEFT[1:]]))
    found = answer["audit"]["clearance"]
    assert answer["failure"] is None
    assert found["continuous"] is True
    least = min(clearances(client, answer))
    assert found["value"] - found["resolution"] == pytest.approx(found["lower_bound"])
    assert found["lower_bound"] <= least <= found["value"] + 1e-3
    assert {found["pair"]["a"], found["pair"]["b"]} == {"panda_link5", "post"}
    at = {"joint_positions": [found["joint_positions"]]}
    assert clearances(client, at) == pytest.approx([found["value"]], abs=1e-9)
    assert found["certificate"]["samples"] == 17
    without = ask(client, {**turn([0.2, *LEFT[1:]]), "scene": None})
    assert without["audit"]["clearance"] is None
    assert without["joint_positions"] == answer["joint_positions"]


def test_a_segment_that_would_touch_does_not_begin(client: TestClient) -> None:
    there, through = {"type": "joint", "target": [0.2, *LEFT[1:]]}, {"type": "joint", "target": RIGHT}
    answer = ask(client, {**turn(RIGHT), "segments": [there, through, there]})
    failure, clearance = answer["failure"], answer["audit"]["clearance"]
    assert (failure["reason"], failure["segment"], len(answer["segments"])) == ("collision", 1, 1)
    assert answer["completed_fraction"] == pytest.approx(1.0 / 3.0)
    assert answer["joint_positions"][-1] == pytest.approx([0.2, *LEFT[1:]])
    assert clearance["lower_bound"] > 0.0
    first, nearest = failure["first_contact"], failure["nearest"]
    assert answer["duration"] < first["time"] < nearest["time"]
    assert first["value"] == pytest.approx(0.0, abs=1e-5)
    assert nearest["value"] == pytest.approx(
        min(clearances(client, nearest | {"joint_positions": [nearest["joint_positions"]]}))
    )
    assert nearest["value"] < -0.01
    assert "'post'" in failure["detail"]


def test_a_path_of_the_tip_ends_shortly_before_a_contact(client: TestClient) -> None:
    for law in ("trapezoidal", "quintic"):
        answer = ask(client, lowered(law=law))
        assert answer["failure"]["reason"] == "collision"
        assert answer["failure"]["segment"] == 2
        assert answer["completed_fraction"] == pytest.approx(0.926, abs=0.01)
        assert np.allclose(answer["joint_velocities"][-1], 0.0)
        assert 0.0 < answer["audit"]["clearance"]["value"] < 3e-4
        assert min(clearances(client, answer)) > 0.0
    away = ask(client, lowered(min_clearance=0.1))
    assert away["audit"]["clearance"]["lower_bound"] >= 0.1
    assert min(clearances(client, away)) >= 0.1


def test_a_start_in_contact_is_an_answer_with_the_pair(client: TestClient) -> None:
    inside = {"objects": [{**TABLE, "pose": {"position": [0.5, 0.0, 0.5]}}]}
    answer = ask(client, {**turn(RIGHT), "scene": inside})
    failure, clearance = answer["failure"], answer["audit"]["clearance"]
    assert (failure["reason"], failure["time"], failure["first_contact"]["time"]) == ("collision", 0.0, 0.0)
    assert answer["duration"] == answer["completed_fraction"] == 0.0
    assert failure["first_contact"]["pair"]["b"] == "table"
    assert clearance["value"] == failure["first_contact"]["value"] < 0.0
    assert failure["detail"].startswith("at the start ")
    assert answer["audit"]["passed"] is False
    assert [reason["check"] for reason in answer["audit"]["reasons"]] == ["clearance"]


def test_links_alone_are_enough_for_a_clearance(client: TestClient) -> None:
    answer = ask(client, {**turn([0.2, *LEFT[1:]], min_clearance=0.05), "scene": None})
    assert answer["audit"]["clearance"]["lower_bound"] >= 0.05
    near = ask(client, {**turn([0.2, *LEFT[1:]], min_clearance=0.5), "scene": None})
    assert near["failure"]["first_contact"]["time"] == 0.0


def test_a_stored_scene_a_table_of_samples_and_a_job_say_the_same(client: TestClient) -> None:
    client.post("/v1/scenes", json={"name": "with_post", **SCENE}).raise_for_status()
    body = turn(RIGHT, scene="with_post")
    here = ask(client, body)
    table = client.post(PATH, json=body, headers={"Accept": "application/x-npy"})
    assert table.headers["Gelenk-Failure"] == "collision"
    job = client.post(PATH, json=body, headers={"Prefer": "respond-async"})
    assert job.status_code == 202, job.text
    client.delete("/v1/scenes/with_post").raise_for_status()
    later = ended_result(client, job.headers["Location"])
    for one in (here, later):  # Coal begins each search at the end of the one before.
        assert one["audit"]["clearance"]["certificate"].pop("max_distance_error") < 1e-6
    assert later == here


@pytest.mark.parametrize(
    ("fields", "pointer"),
    [
        ({"min_clearance": -0.1}, "/min_clearance"),
        ({"min_clearance": "near"}, "/min_clearance"),
        ({"scene": "nowhere"}, "/scene"),
        ({"scene": {"objects": [{**TABLE, "attached_to": "hand"}]}}, "/scene/objects/0/attached_to"),
        ({"scene": {"objects": [{**TABLE, "name": "panda_hand"}]}}, "/scene/objects/0/name"),
        ({"start": None, "at": {"trajectory": turn(RIGHT), "time": 0.1}}, "/at/trajectory/scene"),
    ],
)
def test_a_cell_that_is_none_is_refused_by_field(client: TestClient, fields: dict[str, Any], pointer: str) -> None:
    body = {key: value for key, value in {**turn(RIGHT), **fields}.items() if value is not None}
    answer = client.post(PATH, json=body)
    assert answer.status_code in {404, 422}, answer.text
    assert pointer in answer.text


def test_a_batch_leaves_out_what_would_touch(client: TestClient) -> None:
    body = {"starts": [LEFT], "targets": [[0.2, *LEFT[1:]], RIGHT, [9.0, *LEFT[1:]]], "scene": SCENE}
    url = "/v1/robots/panda/trajectories"
    answer = client.post(url, json=body).json()
    MotionsAnswer.model_validate(answer)
    free, touching, beyond = answer["results"]
    single = ask(client, turn([0.2, *LEFT[1:]]))
    assert free["passed"]
    assert free["clearance"] == pytest.approx(single["audit"]["clearance"]["value"], abs=1e-4)
    blocked = ask(client, turn(RIGHT))["failure"]["nearest"]
    assert (touching["passed"], touching["duration"], beyond["clearance"]) == (False, None, None)
    assert touching["clearance"] == pytest.approx(blocked["value"], abs=1e-4)
    assert "'post'" in touching["reason"]
    assert answer["contact_certificate"]["samples"] == 2
    rows = np.load(BytesIO(client.post(url, json=body, headers={"Accept": "application/x-npy"}).content))
    assert rows.shape == (3, 12)
    np.testing.assert_allclose(rows[:2, 11], [free["clearance"], touching["clearance"]])
    job = client.post(url, json=body, headers={"Prefer": "respond-async"})
    later = ended_result(client, job.headers["Location"])
    assert [later[name] for name in ("results", "notes")] == [answer[name] for name in ("results", "notes")]
