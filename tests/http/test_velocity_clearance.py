"""Velocities of a robot among objects: how fast the nearest ones come nearer, and a null space that leads away."""

from typing import Any

import numpy as np
import pytest
from starlette.testclient import TestClient

from tests.http.test_velocity import READY, refusal, velocity

POST = {"name": "post", "shape": {"type": "sphere", "radius": 0.1}, "pose": {"position": [0.1, 0.25, 0.6]}}
SCENE = {"objects": [{**POST, "clearance": 0.02}]}
STILL: dict[str, Any] = {
    "joint_positions": [READY],
    "twists": [[0.0] * 3],
    "task": ["x", "y", "z"],
    "null_space": {"objective": "clearance"},
}
STEP = 1e-4


def clearance(client: TestClient, qs: Any, **call: Any) -> list[dict[str, Any]]:
    call = {"joint_positions": np.asarray(qs).tolist(), "scene": SCENE, "clearance": True, **call}
    answer = client.post("/v1/robots/panda/collisions", json=call)
    assert answer.status_code == 200, answer.text
    return list(answer.json()["results"])


def test_the_null_space_leads_away_from_what_is_nearest(client: TestClient) -> None:
    answer = velocity(client, scene=SCENE, **STILL)
    (found,), (q_dot,) = answer["results"], np.array(answer["joint_velocities"])
    here, there = clearance(client, [READY, READY + STEP * q_dot])
    about = found["clearance"]
    assert (about["value"], about["pair"]) == (pytest.approx(here["clearance"]), here["pairs"][0])
    assert about["pair"]["distance"] == pytest.approx(about["value"] + 0.02)
    assert about["rate"] == pytest.approx((there["clearance"] - here["clearance"]) / STEP, rel=1e-2)
    assert about["rate"] == pytest.approx(np.array(about["gradient"]) @ q_dot)
    assert about["rate"] > 0.01
    assert answer["root_frame"] == "panda_link0"
    assert answer["clearance_certificate"]["max_gradient_error"] < 1e-3


def test_a_contact_has_a_rate_too_and_without_a_scene_there_is_nothing(client: TestClient) -> None:
    call: dict[str, Any] = {"joint_positions": [READY], "joint_velocities": [[0.1] * 7]}
    inside = {"objects": [{**POST, "pose": {"position": [0.3, 0.05, 0.55]}}]}
    about = velocity(client, **call, scene=inside)["results"][0]["clearance"]
    here, there = clearance(client, [READY, READY + STEP * np.full(7, 0.1)], scene=inside)
    assert about["in_collision"]
    assert about["value"] == pytest.approx(here["clearance"])
    assert about["value"] < 0.0
    assert about["rate"] == pytest.approx((there["clearance"] - here["clearance"]) / STEP, abs=1e-4)
    assert not velocity(client, **call, min_clearance=0.01)["results"][0]["clearance"]["in_collision"]
    assert velocity(client, **call, min_clearance=0.5)["results"][0]["clearance"]["in_collision"]
    plain = velocity(client, **call)
    assert {"root_frame", "warnings", "clearance_certificate"}.isdisjoint(plain)
    assert "clearance" not in plain["results"][0]


def test_the_steps_say_which_pair_and_what_its_gradient_is(client: TestClient) -> None:
    answer = velocity(client, scene=SCENE, **STILL, steps=True)
    (result,), (steps,) = answer["results"], answer["steps"]
    derived = result["derivation"]
    assert derived["objective"] == pytest.approx(-result["clearance"]["value"])
    assert derived["objective_gradient"] == pytest.approx([-value for value in result["clearance"]["gradient"]])
    (objective,) = (step for step in steps if step["title"] == "Objective")
    assert "panda_link5 and post" in objective["text"]
    assert objective["latex"][1].startswith("d = 0.0623")


def test_two_links_that_nothing_moves_have_no_clearance(client: TestClient) -> None:
    still: dict[str, Any] = {
        "joint_positions": [[]],
        "base_frame": "panda_hand",
        "tip_frame": "panda_link8",
        "twists": [[0.0] * 6],
    }
    answer = velocity(client, **still, min_clearance=0.0, null_space={"objective": "clearance"})
    about = answer["results"][0]["clearance"]
    assert about == {"value": None, "in_collision": False, "pair": None, "gradient": [], "rate": 0.0}


@pytest.mark.parametrize(
    ("call", "place"),
    [
        (STILL, "null_space/objective"),
        ({**STILL, "scene": "nowhere"}, "scene"),
        ({**STILL, "min_clearance": -0.1}, "min_clearance"),
        ({**STILL, "scene": {"objects": [{**POST, "attached_to": "nose"}]}}, "scene/objects/0/attached_to"),
    ],
)
def test_what_cannot_be_looked_at_is_refused(client: TestClient, call: dict[str, Any], place: str) -> None:
    problem = refusal(client, call, status=404 if call.get("scene") == "nowhere" else 422)
    places = [error["pointer"][2:] for error in problem.get("errors", [])] or [problem.get("field")]
    assert place in places, problem
