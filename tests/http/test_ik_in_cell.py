"""Inverse kinematics in a cell over HTTP: what the answer holds, and every way to ask wrongly."""

from collections.abc import Iterator
from io import BytesIO
from typing import Any

import numpy as np
import pytest
from starlette.testclient import TestClient

from gelenk.contract.ik import InverseAnswer
from tests.http.test_jobs import ended

ABOVE = {"position": [0.5, 0.0, 0.45], "rpy": [3.141592653589793, 0.0, 0.0]}
INSIDE = {"position": [0.5, 0.0, 0.15], "rpy": [3.141592653589793, 0.0, 0.0]}
FAR = {"position": [3.0, 0.0, 0.4], "rpy": [3.141592653589793, 0.0, 0.0]}
TABLE = {
    "name": "table",
    "shape": {"type": "box", "size": [0.6, 1.2, 0.1]},
    "pose": {"position": [0.6, 0.0, 0.2], "rpy": [0.0, 0.0, 0.0]},
}
SCENE = {"objects": [TABLE]}


def ask(client: TestClient, robot: str = "panda", **call: Any) -> dict[str, Any]:
    """The answer, which is what its model says."""
    answer = client.post(f"/v1/robots/{robot}/ik", json={"targets": [ABOVE, INSIDE, FAR], **call})
    assert answer.status_code == 200, answer.text
    InverseAnswer.model_validate_json(answer.content)
    content: dict[str, Any] = answer.json()
    return content


def test_a_solution_has_its_clearance_and_a_target_in_the_table_none(client: TestClient) -> None:
    answer = ask(client, scene=SCENE)
    free, hit, far = answer["results"]
    assert [one["status"] for one in answer["results"]] == ["solved", "in_collision", "unreachable"]
    (solution,) = free["solutions"]
    assert solution["in_collision"] is False
    assert 0.0 < solution["clearance"] == pytest.approx(solution["pair"]["distance"])
    assert (hit["solutions"], hit["nearest"]["pair"]["b"]) == ([], "table")
    assert 0.0 > hit["nearest"]["clearance"] == pytest.approx(hit["nearest"]["pair"]["distance"])
    assert "solutions found are in contact" in hit["reason"]
    assert "overlap by" in hit["reason"]
    assert "clearance" not in far["nearest"]
    assert (answer["certificate"]["samples"], answer["warnings"]) == (2, [])
    seen = client.post(
        "/v1/robots/panda/collisions",
        json={"joint_positions": [solution["joint_positions"]], "scene": SCENE, "clearance": True},
    ).json()
    assert seen["results"][0]["clearance"] == solution["clearance"]
    assert seen["results"][0]["pairs"] == [solution["pair"]]


def test_a_wider_clearance_leaves_less_room(client: TestClient) -> None:
    near = ask(client, scene=SCENE, targets=[ABOVE])["results"][0]["solutions"][0]["clearance"]
    wide = ask(client, scene=SCENE, targets=[ABOVE], min_clearance=near + 0.005)["results"][0]
    if wide["status"] == "solved":
        assert wide["solutions"][0]["clearance"] > near + 0.005
    blocked = ask(client, scene=SCENE, targets=[ABOVE], min_clearance=0.4)["results"][0]
    assert blocked["status"] == "in_collision"
    assert "apart, at most the 0.4 m demanded" in blocked["reason"]
    assert 0.0 < blocked["nearest"]["clearance"] <= 0.4


def test_all_branches_are_marked(client: TestClient) -> None:
    target = {"position": [0.45, 0.1, 0.4], "rpy": [3.141592653589793, 0.0, 0.0]}
    answer = ask(
        client, "ur5", targets=[target, {**target, "position": [0.45, 0.1, 0.1]}], scene=SCENE, solutions="all"
    )
    plain = ask(client, "ur5", targets=[target], solutions="all")["results"][0]
    some, none = answer["results"]
    marks = [one["in_collision"] for one in some["solutions"]]
    assert (some["status"], none["status"]) == ("solved", "in_collision")
    assert marks == sorted(marks)
    assert {True, False} == set(marks)
    assert len(marks) == len(plain["solutions"])
    assert all((one["clearance"] <= 0.0) == one["in_collision"] for one in some["solutions"] + none["solutions"])
    assert all(one["pair"]["distance"] == one["clearance"] for one in some["solutions"])
    assert none["complete"] is True
    assert none["reason"].startswith(f"all {len(none['solutions'])} solutions are in contact")
    assert (some["reason"], some["complete"]) == (plain["reason"], plain["complete"])


def test_npy_has_the_same_configurations(client: TestClient) -> None:
    rows = ask(client, scene=SCENE)["results"]
    content = client.post(
        "/v1/robots/panda/ik",
        json={"targets": [ABOVE, INSIDE, FAR], "scene": SCENE},
        headers={"Accept": "application/x-npy"},
    )
    best = [(one["solutions"] or [one["nearest"]])[0]["joint_positions"] for one in rows]
    np.testing.assert_array_equal(np.load(BytesIO(content.content)), best)
    assert (content.headers["gelenk-unsolved"], content.headers["gelenk-unsolved-rows"]) == ("2", "1,2")


def test_a_job_gives_the_same_answer(client: TestClient) -> None:
    call: dict[str, Any] = {"targets": [INSIDE, FAR] + [ABOVE] * 140, "scene": SCENE}
    answer = client.post("/v1/robots/panda/ik", json=call, headers={"Prefer": "respond-async"})
    assert answer.status_code == 202, answer.text
    assert ended(lambda: client.get(answer.headers["location"]).json())["state"] == "succeeded"
    later = client.get(f"{answer.headers['location']}/result")
    InverseAnswer.model_validate_json(later.content)
    now = ask(client, **call)
    assert [later.json()[name] for name in ("results", "warnings")] == [now[name] for name in ("results", "warnings")]
    assert later.json()["certificate"]["samples"] > now["certificate"]["samples"] == 16


def test_without_scene_and_clearance_nothing_is_different(client: TestClient) -> None:
    body = {"targets": [ABOVE, INSIDE, FAR]}
    plain = client.post("/v1/robots/panda/ik", json=body).json()
    assert set(plain) == {"joint_names", "base_frame", "tip_frame", "task", "closed_form", "results"}
    assert "in_collision" not in plain["results"][0]["solutions"][0]
    assert plain["results"][1]["status"] == "solved"


def test_the_robot_itself_counts_without_a_scene(client: TestClient) -> None:
    answer = ask(client, targets=[ABOVE], min_clearance=0.0)
    assert answer["results"][0]["solutions"][0]["pair"]["b"].startswith("panda_")


@pytest.fixture
def stored(client: TestClient) -> Iterator[str]:
    """The name of a stored scene."""
    assert client.post("/v1/scenes", json={"name": "cell", **SCENE}).status_code == 201
    yield "cell"
    client.delete("/v1/scenes/cell")


def test_a_stored_scene_is_known_by_its_name_also_beside_an_array(client: TestClient, stored: str) -> None:
    by_name, given = (ask(client, scene=scene)["results"] for scene in (stored, SCENE))
    assert by_name == given
    stream = BytesIO()
    np.save(stream, np.array([[0.5, 0.0, 0.45, 1.0, 0.0, 0.0, 0.0], [0.5, 0.0, 0.15, 1.0, 0.0, 0.0, 0.0]]))
    answer = client.post(
        f"/v1/robots/panda/ik?scene={stored}&min_clearance=0.01",
        content=stream.getvalue(),
        headers={"Content-Type": "application/x-npy", "Accept": "application/x-npy"},
    )
    assert (answer.status_code, answer.headers["gelenk-unsolved-rows"]) == (200, "1")


@pytest.mark.parametrize(
    ("call", "pointer", "words"),
    [
        ({"min_clearance": -0.1}, "/min_clearance", "greater than or equal to 0"),
        ({"min_clearance": 1e9}, "/min_clearance", "1000"),
        ({"min_clearance": "much"}, "/min_clearance", "number"),
        ({"scene": {"objects": [TABLE, TABLE]}}, "/scene", "both named 'table'"),
        ({"scene": {"objects": [{**TABLE, "attached_to": "hand"}]}}, "/scene/objects/0/attached_to", "no frame 'hand'"),
        ({"scene": {"objects": [{**TABLE, "shape": {"type": "cone"}}]}}, "/scene/objects/0/shape", "cone"),
        ({"objective": "clearance"}, "/objective", "needs a `scene`"),
    ],
)
def test_a_bad_request_is_refused_at_its_field(
    client: TestClient, call: dict[str, Any], pointer: str, words: str
) -> None:
    answer = client.post("/v1/robots/panda/ik", json={"targets": [ABOVE], **call})
    assert answer.status_code == 422, answer.text
    assert pointer in answer.text
    assert words in answer.text


def test_numbers_that_are_none_and_scenes_that_are_not_there_are_refused(client: TestClient) -> None:
    text = '{"targets": [{"position": [0.5, 0.0, 0.4], "rpy": [0, 0, 0]}], "min_clearance": NaN}'
    answer = client.post("/v1/robots/panda/ik", content=text, headers={"Content-Type": "application/json"})
    assert answer.status_code in {400, 422}
    answer = client.post("/v1/robots/panda/ik", json={"targets": [ABOVE], "scene": "nowhere"})
    assert (answer.status_code, answer.json()["pointer"]) == (404, "#/scene")


def test_a_seed_may_be_in_contact(client: TestClient) -> None:
    low = [0.0, 0.6, 0.0, -2.0, 0.0, 2.6, 0.785]
    assert ask(client, targets=[ABOVE], scene=SCENE, seeds=[low])["results"][0]["status"] == "solved"


def test_the_objective_clearance_keeps_away(client: TestClient) -> None:
    plain, away = (
        ask(client, targets=[ABOVE], scene=SCENE, **more)["results"][0]["solutions"][0]
        for more in ({}, {"objective": "clearance"})
    )
    assert away["clearance"] > plain["clearance"] - 1e-3


@pytest.mark.parametrize(("code", "words"), [("en", "is free of contact: they are no"), ("de", "ist kollisionsfrei")])
def test_steps_tell_contacts_in_both_languages(client: TestClient, code: str, words: str) -> None:
    free, hit, far = ask(client, scene=SCENE, steps=True, language=code, min_clearance=0.01)["results"]
    texts = ["".join(step["text"] for step in result["steps"]) for result in (free, hit, far)]
    assert [words in text for text in texts] == [False, True, False]
    assert "0.01 m" in texts[0].replace(",", ".")
    line = free["steps"][-1]["plain"][0]
    assert float(line.split()[2].replace(",", ".")) == pytest.approx(free["solutions"][0]["clearance"], abs=1e-4)
