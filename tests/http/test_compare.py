"""Comparisons of tables with chains over HTTP: the wire, and what it refuses."""

import time
from copy import deepcopy
from typing import Any

import pytest
from starlette.testclient import TestClient

from gelenk.contract.compare_dh import EXAMPLE_COMPARISON, CompareAnswer
from tests.oracles import catalogue
from tests.speed import is_within

FIELDS = {
    "equivalent",
    "base",
    "tool",
    "offsets",
    "signs",
    "max_position_error",
    "max_orientation_error",
    "first_difference",
}
IDENTITY = {"position": [0.0, 0.0, 0.0], "quaternion_xyzw": [0.0, 0.0, 0.0, 1.0]}
HALF_TURN = {"position": [0.0, 0.0, 0.0], "quaternion_xyzw": [0.0, 0.0, 1.0, 0.0]}
ZEROS = [0.0] * 6


def table(name: str = "ur5_dh", **fields: Any) -> dict[str, Any]:
    """A table of the catalogue without base and tool, with other fields."""
    content = catalogue.dh_table(name)
    return {key: content[key] for key in ("convention", "joints")} | fields


def number(row: int, parameter: str, value: float, **fields: Any) -> dict[str, Any]:
    """UR5's table with another number in a row, from 1."""
    content = deepcopy(table(**fields))
    content["joints"][row - 1][parameter] = value
    return content


def ask(client: TestClient, dh: dict[str, Any], **fields: Any) -> dict[str, Any]:
    body = {"robot": "ur5", "base_frame": "base_link", "tip_frame": "tool0", "dh": dh, **fields}
    answer = client.post("/v1/dh/compare", json=body)
    assert answer.status_code == 200, answer.text
    content: dict[str, Any] = answer.json()
    CompareAnswer.model_validate_json(answer.text)
    assert set(content) >= FIELDS
    return content


def test_a_base_and_a_tool_that_are_left_out_are_found(client: TestClient) -> None:
    content = ask(client, table())
    assert content["equivalent"] is True
    assert content["first_difference"] is None
    assert content["base"] == HALF_TURN
    assert content["tool"] == IDENTITY
    assert content["offsets"] == ZEROS
    assert content["signs"] == [1] * 6
    assert content["found"] == ["base", "tool"]
    assert content["held"] == ["offsets", "signs"]
    assert content["max_position_error"] < 5.3e-12
    assert content["max_orientation_error"] < 1.6e-11
    assert {"row": 1, "joint": "joint_1", "parameter": "d", "absorbed_by": "base"} in content["unverified"]
    assert content["joint_names"][0] == "shoulder_pan_joint"
    assert content["samples"] == 200


def test_what_is_given_is_held(client: TestClient) -> None:
    assert ask(client, table(base=HALF_TURN, tool=IDENTITY))["equivalent"]
    assert ask(client, table(base=HALF_TURN, tool=IDENTITY))["unverified"] == []
    content = ask(client, table(base=IDENTITY))
    assert not content["equivalent"]
    assert content["base"] == IDENTITY
    assert content["held"] == ["base", "offsets", "signs"]
    assert [each["mistake"] for each in content["diagnoses"]] == ["number", "base"]


@pytest.mark.slow
def test_find_chooses_what_is_found(client: TestClient) -> None:
    nothing = ask(client, table(), find=[])
    assert not nothing["equivalent"]
    assert nothing["held"] == ["base", "tool", "offsets", "signs"]
    assert ask(client, table(), base_frame="base", find=[])["equivalent"]
    content = ask(client, table(base=IDENTITY), find=["tool", "base", "base"])
    assert content["equivalent"]
    assert content["base"] == HALF_TURN
    assert any("is ignored" in note for note in content["notes"])


@pytest.mark.slow
def test_zeros_and_senses_are_found_where_asked_for(client: TestClient) -> None:
    shifted = deepcopy(table())
    shifted["joints"][1]["theta"] = 0.4
    shifted["joints"][2]["theta"] = -0.3
    held = ask(client, shifted)
    assert not held["equivalent"]
    assert held["diagnoses"][0]["mistake"] == "joint_zero"
    free = ask(client, shifted, find=["base", "tool", "offsets", "signs"])
    assert free["equivalent"]
    assert free["offsets"] == pytest.approx([0, -0.4, 0.3, 0, 0, 0], abs=1e-9)
    assert free["signs"] == [1] * 6


@pytest.mark.slow
def test_the_first_difference_says_where_and_by_how_much(client: TestClient) -> None:
    content = ask(client, number(5, "d", 0.1))
    difference = content["first_difference"]
    assert difference["expected"] == pytest.approx(0.09465, abs=1e-9)
    assert difference["difference"] == pytest.approx(0.00535, abs=1e-9)
    assert {key: difference[key] for key in ("row", "joint", "parameter", "value", "pointer")} == {
        "row": 5,
        "joint": "joint_5",
        "parameter": "d",
        "value": 0.1,
        "pointer": "#/dh/joints/4/d",
    }


def test_the_shoulder_of_a_table_in_circulation(client: TestClient) -> None:
    content = client.post("/v1/dh/compare", json=EXAMPLE_COMPARISON).json()
    assert not content["equivalent"]
    difference = content["first_difference"]
    assert (difference["row"], difference["parameter"]) == (1, "d")
    assert difference["difference"] == pytest.approx(0.0003, abs=1e-9)
    absorbed = ask(client, number(1, "d", 0.089459))
    assert absorbed["equivalent"]
    assert absorbed["base"]["position"] == pytest.approx([0, 0, -0.0003], abs=1e-9)
    assert any("d = 0.089159 instead of 0.089459" in note for note in absorbed["notes"])


@pytest.mark.slow
def test_three_tenths_of_a_millimetre_are_within_a_tolerance_of_one(client: TestClient) -> None:
    wrong = number(1, "d", 0.089459, base=HALF_TURN, tool=IDENTITY)
    assert ask(client, wrong, position_tolerance=1e-3)["equivalent"]
    assert not ask(client, wrong, position_tolerance=2e-4)["equivalent"]


@pytest.mark.slow
def test_degrees_and_the_other_convention(client: TestClient) -> None:
    degrees = deepcopy(table())
    for joint in degrees["joints"]:
        joint["alpha"] = round(joint["alpha"] * 57.29577951308232, 9)
    assert ask(client, degrees)["diagnoses"][0]["mistake"] == "degrees"
    chain = {"robot": "panda", "base_frame": "panda_link0", "tip_frame": "panda_link8"}
    panda = ask(client, table("panda_dh", convention="standard"), **chain)
    assert panda["diagnoses"][0]["mistake"] == "convention"
    assert "modified" in panda["diagnoses"][0]["detail"]


def test_a_wrong_count_is_an_answer(client: TestClient) -> None:
    content = ask(client, table("panda_dh"))
    assert content["equivalent"] is False
    assert content["first_difference"] == {
        "row": 7,
        "joint": "joint_7",
        "parameter": "joints",
        "value": 7.0,
        "expected": 6.0,
        "difference": 1.0,
        "pointer": "#/dh/joints/6",
    }
    empty = ("base", "tool", "offsets", "signs", "max_position_error", "max_orientation_error")
    assert [content[name] for name in empty] == [None] * 6
    few = table()
    few["joints"] = few["joints"][:5]
    assert ask(client, few)["first_difference"]["pointer"] == "#/dh/joints"


@pytest.mark.parametrize("pose_format", ["rpy", "matrix", "zyz", "quaternion_wxyz"])
def test_the_answers_poses_are_valid_requests(client: TestClient, pose_format: str) -> None:
    content = ask(client, table(), tip_frame="ee_link", pose_format=pose_format)
    again = ask(client, table(base=content["base"], tool=content["tool"]), tip_frame="ee_link")
    assert again["equivalent"]
    assert again["found"] == []


@pytest.mark.slow
def test_a_tables_own_export_is_equivalent(client: TestClient) -> None:
    for robot in ("z1", "stanford", "kinova"):
        for convention in ("standard", "modified"):
            dh = client.get(f"/v1/robots/{robot}/dh?convention={convention}").json()["dh"]
            answer = client.post("/v1/dh/compare", json={"robot": robot, "dh": dh}).json()
            assert answer["equivalent"], (robot, convention, answer["first_difference"])


@pytest.mark.parametrize(
    ("fields", "status", "mention"),
    [
        ({"robot": "nobody"}, 404, "nobody"),
        ({"base_frame": "nowhere"}, 404, "nowhere"),
        ({"find": ["elbow"]}, 422, "find"),
        ({"find": "base"}, 422, "find"),
        ({"position_tolerance": 0.0}, 422, "position_tolerance"),
        ({"orientation_tolerance": -1.0}, 422, "orientation_tolerance"),
        ({"dh": None}, 422, "dh"),
        ({"dh": {"convention": "standard", "joints": []}}, 422, "joints"),
        ({"tolerance": 1.0}, 422, "tolerance"),
        ({"robot": "../x"}, 422, "robot"),
    ],
)
def test_what_is_refused(client: TestClient, fields: dict[str, Any], status: int, mention: str) -> None:
    answer = client.post("/v1/dh/compare", json={"robot": "ur5", "dh": table(), **fields})
    assert answer.status_code == status, answer.text
    assert answer.headers["content-type"] == "application/problem+json"
    assert mention in answer.text


@pytest.mark.slow
def test_an_answer_takes_less_than_a_second(client: TestClient) -> None:
    """Also where nothing explains the table, and everything has been tried."""
    wrong = table("xarm7_dh")
    chain = {"robot": "panda", "base_frame": "panda_link0", "tip_frame": "panda_link8"}
    ask(client, wrong, **chain)
    start = time.process_time()
    content = ask(client, wrong, **chain)
    assert is_within(time.process_time() - start, 1.0)
    assert content["first_difference"] is not None
