"""Conversions of tables over HTTP, each answer against the text that was sent and a product of its own."""

import json
import time
from io import BytesIO
from math import pi
from typing import Any

import numpy as np
import pinocchio as pin
import pytest
import yourdfpy
from starlette.testclient import TestClient

from gelenk.contract.common import Answer
from gelenk.contract.convert_dh import ConvertAnswer
from gelenk.contract.dh import EXAMPLE_TABLE, EXAMPLE_URDF, DhTablePayload, table_content
from gelenk.contract.dh_from_urdf import FromUrdfAnswer
from gelenk.contract.dh_to_urdf import ToUrdfAnswer
from gelenk.robot.arrays import Array
from tests.corpus.dh import REFUSED_DH, TABLE, RefusedDh
from tests.corpus.urdf import ODD, REFUSED, VALID, Odd, Refused, Valid
from tests.dh.test_convert import random_table
from tests.dh.test_from_chain import distance, textbook_poses
from tests.oracles import catalogue
from tests.oracles.urdf_product import UrdfProduct
from tests.speed import is_within

JSON = {"content-type": "application/json"}
CALLS = ("to-urdf", "from-urdf", "convert")


def good(client: TestClient, call: str, **body: Any) -> dict[str, Any]:
    answer = client.post(f"/v1/dh/{call}", json=body)
    assert answer.status_code == 200, answer.text
    content: dict[str, Any] = answer.json()
    models: dict[str, type[Answer]] = {"to-urdf": ToUrdfAnswer, "from-urdf": FromUrdfAnswer, "convert": ConvertAnswer}
    models[call].model_validate_json(answer.content)
    return content


def poses(dh: dict[str, Any], qs: Array) -> Array:
    """By the textbook, of a table as it travelled."""
    return textbook_poses(DhTablePayload.model_validate_json(json.dumps(dh)).table(), qs)


def configurations(dh: dict[str, Any], count: int = 20) -> Array:
    return np.random.default_rng(0).uniform(-1, 1, (count, len(dh["joints"])))


def urdf_poses(text: str, base: str, tip: str, names: list[str], qs: Array) -> Array:
    return UrdfProduct(text).poses(base, tip, dict(zip(names, qs.T, strict=True)))


@pytest.mark.quick(1)
@pytest.mark.parametrize("convention", ["standard", "modified"])
@pytest.mark.parametrize("seed", range(6))
def test_to_urdf_from_urdf_and_back(client: TestClient, convention: str, seed: int) -> None:
    dh = table_content(random_table(convention, 3000 + seed))  # type: ignore[arg-type]
    qs = configurations(dh)
    written = good(client, "to-urdf", name="my.arm", dh=dh)
    names = [row["name"] for row in dh["joints"]]
    assert written["joint_names"] == names
    assert np.abs(urdf_poses(written["urdf"], "base", "tool", names, qs) - poses(dh, qs)).max() < 1e-12
    assert max(written["certificate"][f"max_{what}_error"] for what in ("position", "orientation")) < 1e-12
    other = yourdfpy.URDF.load(BytesIO(written["urdf"].encode()))
    assert other.actuated_joint_names == names
    assert pin.buildModelFromXML(written["urdf"]).nq == len(names)
    for wanted in ("standard", "modified"):
        found = good(client, "from-urdf", urdf=written["urdf"], convention=wanted, tip_frame="tool")
        assert (found["dh"]["convention"], found["joint_names"]) == (wanted, names)
        assert np.abs(poses(found["dh"], qs) - poses(dh, qs)).max() < 1e-9
        converted = good(client, "convert", dh=dh, convention=wanted)
        assert np.abs(poses(converted["dh"], qs) - poses(dh, qs)).max() < 1e-13
        assert converted["dh"]["convention"] == wanted


BOUNDS: dict[str, dict[str, float]] = {
    "none": {},
    "velocity": {"velocity": 2.0},
    "effort": {"effort": 30.0},
    "both": {"velocity": 2.0, "effort": 30.0},
    "zero": {"velocity": 0.0, "effort": 0.0},
}


@pytest.mark.parametrize("bounds", BOUNDS.values(), ids=BOUNDS)
@pytest.mark.parametrize("kind", ["revolute", "prismatic"])
def test_no_limit_is_written_as_one_that_forbids_to_move(
    client: TestClient, kind: str, bounds: dict[str, float]
) -> None:
    """Other readers want both attributes, and take zero at its word; ours gives again what was given."""
    row = {"name": "only", "type": kind, "a": 0.3, "alpha": 0.1, "d": 0.2, "theta": 0.4, "lower": -1, "upper": 1}
    written = good(client, "to-urdf", name="arm", dh={"convention": "standard", "joints": [{**row, **bounds}]})
    given = {key: value for key, value in bounds.items() if value}
    model = pin.buildModelFromXML(written["urdf"])
    (limit,) = [
        joint.limit for joint in yourdfpy.URDF.load(BytesIO(written["urdf"].encode())).robot.joints if joint.limit
    ]
    for key, other in (("velocity", model.velocityLimit[0]), ("effort", model.effortLimit[0])):
        assert getattr(limit, key) == other == given.get(key, 1e16)
    (found,) = good(client, "from-urdf", urdf=written["urdf"])["dh"]["joints"]
    assert {key: found[key] for key in ("velocity", "effort") if key in found} == given
    told = [note for note in written["notes"] if "1e+16" in note]
    assert len(told) == 2 - len(given)
    assert all("'only'" in note for note in told)


def test_to_urdf_says_that_its_masses_are_invented(client: TestClient) -> None:
    joint = {"a": 1.0, "alpha": 0.0, "d": 0.0, "theta": 0.0, "type": "revolute"}
    written = good(client, "to-urdf", name="two", dh={"convention": "modified", "joints": [joint, {**joint, "a": 0.7}]})
    assert any("masses" in note and "3 kg" in note for note in written["notes"])
    assert not any("0.0" in line for line in written["urdf"].splitlines() if "<limit" in line)


def test_an_answer_is_a_request_and_loses_nothing(client: TestClient) -> None:
    """Base and tool as matrices come back to the last bit, whatever the orientation."""
    for seed in range(20):
        table = random_table("standard", 4000 + seed)
        content = json.loads(json.dumps(table_content(table)))
        again = DhTablePayload.model_validate_json(json.dumps(content)).table()
        assert again.joints == table.joints
        assert np.abs(again.base - table.base).max() == 0.0
        assert np.abs(again.tool - table.tool).max() == 0.0
    found = good(client, "from-urdf", urdf=catalogue.urdf_text("xarm7"), base_frame="link_eef", tip_frame="link_base")
    same = good(client, "convert", dh=found["dh"], convention="standard")
    assert same["dh"] == found["dh"]
    assert same["certificate"]["max_position_error"] == 0.0


@pytest.mark.quick(2)
@pytest.mark.parametrize("convention", ["standard", "modified"])
@pytest.mark.parametrize("name", ["panda", "ur5", "baxter", "icub", "talos_full"])
def test_a_robot_of_the_catalogue_as_a_table(client: TestClient, name: str, convention: str) -> None:
    answer = client.get(f"/v1/robots/{name}/dh", params={"convention": convention})
    assert answer.status_code == 200, answer.text
    FromUrdfAnswer.model_validate_json(answer.content)
    found = answer.json()
    ends = catalogue.entry(name)["default_chain"]
    assert {key: found[key] for key in ("base_frame", "tip_frame")} == ends
    names = client.get(f"/v1/robots/{name}").json()["joint_names"]
    assert found["joint_names"] == names
    qs = np.random.default_rng(1).uniform(-1, 1, (50, len(names)))
    judge = urdf_poses(catalogue.urdf_text(name), found["base_frame"], found["tip_frame"], names, qs)
    assert max(distance(poses(found["dh"], qs), judge)) < 1e-9
    assert found["notes"]
    text = client.get(f"/v1/robots/{name}/urdf").text
    assert good(client, "from-urdf", urdf=text, convention=convention, **ends)["dh"] == found["dh"]


def test_the_certificate_is_what_is_measured_also_when_snapped(client: TestClient) -> None:
    for tolerance in (0.0, 1e-4):
        found = good(client, "from-urdf", urdf=EXAMPLE_URDF, tip_frame="hand", snap_tolerance=tolerance)
        certificate = found["certificate"]
        r = np.random.default_rng(certificate["seed"]).random((certificate["samples"], 2))
        limits = np.array([(-2.0, 2.0), (-2.5, 2.5)])
        half = certificate["samples"] // 2
        within = limits[:, 0] + r[:half] * (limits[:, 1] - limits[:, 0])
        qs = np.vstack((within, -pi + r[half:] * 2 * pi))
        judge = urdf_poses(EXAMPLE_URDF, "foot", "hand", ["shoulder", "elbow"], qs)
        measured = distance(poses(found["dh"], qs), judge)
        stated = certificate["max_position_error"], certificate["max_orientation_error"]
        assert stated == pytest.approx(measured, abs=2e-15)
        # It writes π/2 as 1.5708.
        assert (1e-7 < max(stated) < 1e-5) if tolerance else max(stated) < 1e-15
        assert any("snapped" in note for note in found["notes"]) == bool(tolerance)


def test_a_table_with_followers_travels(client: TestClient) -> None:
    found = client.get("/v1/robots/panda/dh", params={"tip_frame": "panda_rightfinger"}).json()
    mimics = [row["mimic"] for row in found["dh"]["joints"] if "mimic" in row]
    assert mimics == [{"joint": "panda_finger_joint1", "multiplier": 1.0, "offset": 0.0}]
    assert found["joint_names"][-1] == "panda_finger_joint1"
    written = good(client, "to-urdf", name="fingers", dh=found["dh"])
    assert written["joint_names"] == found["joint_names"]
    assert any("'panda_finger_joint1' is not a row" in warning for warning in written["warnings"])
    converted = good(client, "convert", dh=found["dh"], convention="modified")
    assert converted["joint_names"] == found["joint_names"]
    added = client.post("/v1/robots", json={"name": "fingers", "dh": found["dh"]})
    assert added.status_code == 201, added.text
    assert added.json()["joint_names"] == found["joint_names"]
    q = [0.1, 0.2, 0.3, -1.0, 0.5, 0.6, 0.7, 0.02]
    ours, judge = (
        client.post(f"/v1/robots/{name}/fk", json={"joint_positions": [q], "pose_format": "matrix", **ends}).json()
        for name, ends in (("fingers", {}), ("panda", {"tip_frame": "panda_rightfinger"}))
    )
    assert np.abs(np.subtract(ours["poses"][0]["matrix"], judge["poses"][0]["matrix"])).max() < 1e-15
    assert client.delete("/v1/robots/fingers").status_code == 204


def test_limits_left_out_are_a_warning(client: TestClient) -> None:
    warnings = good(client, "to-urdf", name="arm", dh=TABLE)["warnings"]
    assert len(warnings) == 1
    assert "'shoulder'" in warnings[0]
    assert good(client, "to-urdf", name="arm", dh=EXAMPLE_TABLE)["warnings"] == []


def test_the_largest_table_within_a_second(client: TestClient) -> None:
    """In processor time, in which the service runs too."""
    row = {"type": "revolute", "a": 0.1, "alpha": 1.1, "d": 0.2, "theta": 0.3}
    dh = {"convention": "standard", "joints": [row] * 64}
    started = time.process_time()
    written = good(client, "to-urdf", name="snake", dh=dh)
    assert is_within(time.process_time() - started, 1.0)
    started = time.process_time()
    good(client, "from-urdf", urdf=written["urdf"])
    assert is_within(time.process_time() - started, 1.0)
    started = time.process_time()
    good(client, "convert", dh=dh, convention="modified")
    assert is_within(time.process_time() - started, 1.0)


# What is refused


def refused(client: TestClient, call: str, body: dict[str, Any], status: int = 422) -> dict[str, Any]:
    answer = client.post(f"/v1/dh/{call}", content=json.dumps(body).encode(), headers=JSON)
    assert answer.status_code == status, answer.text[:500]
    assert answer.headers["content-type"] == "application/problem+json"
    content: dict[str, Any] = answer.json()
    return content


@pytest.mark.quick(30)
@pytest.mark.parametrize("case", REFUSED_DH, ids=lambda case: case.name)
def test_a_table_that_is_none(client: TestClient, case: RefusedDh) -> None:
    for call, more in (("to-urdf", {"name": "arm"}), ("convert", {"convention": "modified"})):
        detail = json.dumps(refused(client, call, {"dh": case.table, **more})).lower()
        assert all(word in detail for word in case.mentions), detail


@pytest.mark.parametrize("case", REFUSED[::20], ids=lambda case: case.name)
def test_a_urdf_that_is_none(client: TestClient, case: Refused) -> None:
    """Some: the reader is that of `POST /v1/robots`, where all of them are refused for the right reason."""
    answer = client.post("/v1/dh/from-urdf", content=json.dumps({"urdf": case.text}), headers=JSON)
    assert answer.status_code in {400, 422}
    assert answer.headers["content-type"] == "application/problem+json"


@pytest.mark.quick(19)
@pytest.mark.parametrize("case", [*VALID, *ODD], ids=lambda case: case.name)
def test_an_odd_urdf_is_answered_or_refused_for_a_reason(client: TestClient, case: Odd | Valid) -> None:
    answer = client.post("/v1/dh/from-urdf", json={"urdf": case.text})
    if answer.status_code == 200:
        assert answer.json()["certificate"]["max_position_error"] < 1e-9
        return
    assert answer.status_code == 422, answer.text
    assert "no joint moves" in answer.json()["detail"]


SLIP = EXAMPLE_URDF.replace('xyz="0.5 0 0"', 'xyz="0.5 2e4 0" rpy="9e-3 0 0"')


@pytest.mark.parametrize(
    ("call", "body", "status", "word"),
    [
        ("from-urdf", {"urdf": EXAMPLE_URDF, "base_frame": "hand", "tip_frame": "fore"}, 422, "no joint moves"),
        ("from-urdf", {"urdf": EXAMPLE_URDF, "tip_frame": "finger"}, 404, "finger"),
        ("from-urdf", {"urdf": EXAMPLE_URDF, "convention": "craig"}, 422, "convention"),
        ("from-urdf", {"urdf": EXAMPLE_URDF, "snap_tolerance": -1e-9}, 422, "snap_tolerance"),
        ("from-urdf", {"urdf": EXAMPLE_URDF, "snap_tolerance": 0.2}, 422, "snap_tolerance"),
        ("from-urdf", {"urdf": EXAMPLE_URDF, "snap_tolerance": "1e-6"}, 422, "snap_tolerance"),
        ("from-urdf", {"urdf": SLIP}, 422, "tolerance of 0.02"),
        ("from-urdf", {"urdf": EXAMPLE_URDF, "robot": "panda"}, 422, "robot"),
        ("from-urdf", {}, 422, "urdf"),
        ("to-urdf", {"name": "../arm", "dh": TABLE}, 422, "name"),
        ("to-urdf", {"dh": TABLE}, 422, "name"),
        ("convert", {"dh": TABLE}, 422, "convention"),
        ("convert", {"dh": TABLE, "convention": "modified", "snap_tolerance": 0.0}, 422, "snap_tolerance"),
    ],
)
def test_a_call_that_cannot_be_answered(
    client: TestClient, call: str, body: dict[str, Any], status: int, word: str
) -> None:
    problem = refused(client, call, body, status)
    assert word in json.dumps(problem)


@pytest.mark.parametrize(
    ("query", "status", "word"),
    [
        ("convention=craig", 422, "convention"),
        ("snap_tolerance=nan", 422, "snap_tolerance"),
        ("snap_tolerance=1", 422, "snap_tolerance"),
        ("tip_frame=finger", 404, "finger"),
        ("tip=panda_link8", 422, "tip"),
        ("base_frame=panda_link7&tip_frame=panda_link8", 422, "no joint moves"),
    ],
)
def test_a_robot_that_is_asked_wrongly(client: TestClient, query: str, status: int, word: str) -> None:
    answer = client.get(f"/v1/robots/panda/dh?{query}")
    assert answer.status_code == status, answer.text
    assert answer.headers["content-type"] == "application/problem+json"
    assert word in answer.text


def test_media_types_methods_and_queries(client: TestClient) -> None:
    for call in CALLS:
        path = f"/v1/dh/{call}"
        assert client.post(path, content=b"<robot/>", headers={"content-type": "application/xml"}).status_code == 415
        assert client.post(path, content=b"{", headers=JSON).status_code == 400
        assert client.get(path).status_code == 405
        assert client.post(f"{path}?convention=modified", json={}).status_code == 422
    assert client.get("/v1/robots/nobody/dh").status_code == 404
    assert client.post("/v1/robots/panda/dh", json={}).status_code == 405
