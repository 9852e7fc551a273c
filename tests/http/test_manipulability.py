"""Manipulability over HTTP: the answer's shape and units, batches, npy, pictures by `Accept`, what is refused."""

import time
from io import BytesIO
from typing import Any
from unittest.mock import AsyncMock

import numpy as np
import pytest
from scipy.linalg import null_space
from starlette.testclient import TestClient

from gelenk.contract.manipulability import MAX_DETAILED, ManipulabilityAnswer
from gelenk.http.messages.payloads import JSON, NPY, PDF, PNG, SVG, Bodies, BoundedRequest, preferred_type
from tests.speed import is_within

READY = [0.0, -0.785, 0.0, -2.356, 0.0, 1.571, 0.785]
PATH = "/v1/robots/{}/manipulability"
LIMITS = {"joint_velocity": [2.0, 3.0], "joint_effort": {"joint_2": 5.0, "joint_1": 10.0}}


def ask(client: TestClient, robot: str = "panda", **call: Any) -> dict[str, Any]:
    answer = client.post(PATH.format(robot), json=call)
    assert answer.status_code == 200, answer.text
    ManipulabilityAnswer.model_validate_json(answer.content)
    return dict(answer.json())


def npy(array: Any) -> bytes:
    buffer = BytesIO()
    np.save(buffer, np.asarray(array))
    return buffer.getvalue()


def test_the_arm_of_the_blackboard(client: TestClient) -> None:
    answer = ask(client, "planar_2r", joint_positions=[[0.3, 0.8]], directions=[[2.0, 0.0, 0.0]], gradient=True)
    assert answer["joint_names"] == ["joint_1", "joint_2"]
    (entry,) = answer["results"]
    part = entry["translation"]
    assert (part["rank"], part["singular"]) == (2, False)
    assert part["velocity_ellipsoid"]["semi_axes"] == pytest.approx([1.693355501046, 0.296540958658], abs=5e-13)
    assert part["force_ellipsoid"]["semi_axes"] == pytest.approx([0.590543450198, 3.372215442091], abs=5e-13)
    assert part["force_ellipsoid"]["axes"] == part["velocity_ellipsoid"]["axes"]
    assert np.shape(part["velocity_ellipsoid"]["axes"]) == (2, 3)
    assert part["measure"] == pytest.approx(0.502149263630, abs=5e-13)
    assert part["volume"] == pytest.approx(1.577548437624, abs=5e-13)
    assert part["condition_number"] == pytest.approx(5.710359569578, abs=5e-12)
    assert part["isotropy"] == pytest.approx(0.175120320851, abs=5e-13)
    assert part["gradient"] == pytest.approx([0.0, 0.7 * np.cos(0.8)], abs=1e-15)
    (along,) = part["transmission"]
    assert along["direction"] == [1.0, 0.0, 0.0]
    assert along["velocity"] == pytest.approx(0.382776864892, abs=5e-13)
    assert along["force"] == pytest.approx(0.900055578539, abs=5e-13)
    assert entry["rotation"]["velocity_ellipsoid"] == {
        "axes": [[0.0, 0.0, 1.0]],
        "semi_axes": [pytest.approx(np.sqrt(2.0))],
        "unbounded": [False],
    }
    assert entry["combined"] is None
    translation, rotation = answer["spaces"]
    assert translation == {
        "part": "translation",
        "dimension": 2,
        "basis": [[1.0, 0.0, 0.0], [0.0, 1.0, 0.0]],
        "velocity_unit": "m/s per rad/s",
        "force_unit": "N per N m",
        "measure_unit": "(m/s per rad/s)^2",
    }
    assert (rotation["velocity_unit"], rotation["measure_unit"]) == ("rad/s per rad/s", "rad/s per rad/s")
    assert answer["certificate"]["samples"] == 1
    assert answer["certificate"]["max_error"] < 1e-12
    assert answer["certificate"]["max_ellipsoid_error"] < 1e-12


def test_a_singularity_is_named_and_nothing_is_infinite(client: TestClient) -> None:
    directions = [[np.cos(0.3), np.sin(0.3), 0.0], [0.0, 0.0, 1.0]]
    answer = ask(client, "planar_2r", joint_positions=[[0.3, 0.0]], directions=directions, gradient=True)
    part = answer["results"][0]["translation"]
    assert (part["rank"], part["singular"], part["measure"], part["isotropy"]) == (1, True, 0.0, 0.0)
    assert part["condition_number"] is None
    assert part["gradient"] is None
    assert part["velocity_ellipsoid"]["semi_axes"][1] == 0.0
    assert part["velocity_ellipsoid"]["unbounded"] == [False, False]
    assert part["force_ellipsoid"]["semi_axes"][1] is None
    assert part["force_ellipsoid"]["unbounded"] == [False, True]
    for along in part["transmission"]:
        assert (along["velocity"], along["force"], along["force_unbounded"]) == (0.0, None, True)


def test_a_batch_has_one_entry_a_configuration(client: TestClient) -> None:
    qs = np.random.default_rng(1).uniform(-1.0, 1.0, (12, 7)).tolist()
    together = ask(client, joint_positions=qs)["results"]
    assert together == [ask(client, joint_positions=[q])["results"][0] for q in qs]
    assert ask(client, joint_positions=[])["results"] == []


def test_the_task_selects_directions(client: TestClient) -> None:
    answer = ask(client, joint_positions=[READY], task=["y", "x"], directions=np.eye(3).tolist())
    assert answer["task"] == ["y", "x"]
    (entry,) = answer["results"]
    assert entry["rotation"] is None
    assert len(entry["translation"]["velocity_ellipsoid"]["semi_axes"]) == 2
    x, _, z = entry["translation"]["transmission"]
    assert x["velocity"] > 0.0
    assert (z["velocity"], z["force"], z["force_unbounded"]) == (None, None, False)


def test_a_characteristic_length_makes_metres_of_radians(client: TestClient) -> None:
    J = np.array(client.post("/v1/robots/panda/jacobian", json={"joint_positions": [READY]}).json()["jacobians"][0])
    answer = ask(client, joint_positions=[READY], characteristic_length=0.25)
    part = answer["results"][0]["combined"]
    J[3:] *= 0.25
    assert part["velocity_ellipsoid"]["semi_axes"] == pytest.approx(np.linalg.svd(J, compute_uv=False))
    axes = np.array(part["velocity_ellipsoid"]["axes"])
    assert axes @ axes.T == pytest.approx(np.eye(6), abs=1e-14)
    assert answer["spaces"][2]["velocity_unit"] == "m/s per rad/s"
    assert "transmission" not in part


@pytest.mark.parametrize("task", [["x", "y"], ["rz"], ["x", "rz"]])
def test_vectors_of_the_combined_part_have_six_numbers(client: TestClient, task: list[str]) -> None:
    answer = ask(client, "planar_2r", joint_positions=[[0.3, 0.8]], task=task, characteristic_length=0.5)
    assert {len(vector) for vector in answer["spaces"][-1]["basis"]} == {6}
    (entry,) = answer["results"]
    assert {len(axis) for axis in entry["combined"]["velocity_ellipsoid"]["axes"]} == {6}
    lone = answer["spaces"][0]["part"]
    assert {len(axis) for axis in entry[lone]["velocity_ellipsoid"]["axes"]} == {3}


def test_all_vectors_are_in_the_axes_of_the_reference(client: TestClient) -> None:
    call: dict[str, Any] = {"joint_positions": [[0.3, 0.8]], "polytopes": True, "limits": LIMITS}
    base = ask(client, "planar_2r", **call, directions=[[np.cos(1.1), np.sin(1.1), 0.0]])
    tip = ask(client, "planar_2r", **call, directions=[[1.0, 0.0, 0.0]], reference="local")
    assert (base["reference"], tip["reference"]) == ("local_world_aligned", "local")
    ours, theirs = tip["results"][0]["translation"], base["results"][0]["translation"]
    for name in ("velocity", "force"):
        assert ours["transmission"][0][name] == pytest.approx(theirs["transmission"][0][name])
        for size in ("alone", "component"):
            values = [part[f"{name}_polytope"]["along"][0][size] for part in (ours, theirs)]
            assert values[0] == pytest.approx(values[1])
    c, s = np.cos(1.1), np.sin(1.1)
    vertices = np.array(theirs["velocity_polytope"]["vertices"]) @ [[c, -s, 0], [s, c, 0], [0, 0, 1]]
    found = np.array(ours["velocity_polytope"]["vertices"])
    assert np.array(sorted(np.round(found, 9).tolist())) == pytest.approx(
        np.array(sorted(np.round(vertices, 9).tolist()))
    )


def test_an_image_is_in_the_bases_axes(client: TestClient) -> None:
    call = {"joint_positions": [[0.3, 0.8]], "reference": "local"}
    answer = client.post(PATH.format("planar_2r"), json=call, headers={"accept": SVG})
    assert (answer.status_code, answer.json()["pointer"]) == (422, "#/reference")


def test_a_vanished_row_has_an_unbounded_force(client: TestClient) -> None:
    answer = ask(client, "planar_2r", joint_positions=[[np.pi, 0.0]], task=["x"], directions=[[1.0, 0.0, 0.0]])
    part = answer["results"][0]["translation"]
    assert (part["rank"], part["singular"], part["measure"]) == (0, True, 0.0)
    assert part["force_ellipsoid"]["unbounded"] == [True]
    assert part["transmission"][0]["force_unbounded"]


@pytest.mark.parametrize(
    ("limits", "words"),
    [
        ({"joint_velocity": {"joint_1": 1.0}}, "limits/joint_velocity' gives no value for joint 'joint_2'"),
        ({"joint_effort": [1.0]}, "limits/joint_effort' has 1 number where the chain has 2 joints"),
        ({"joint_effort": {"nose": 1.0}}, "limits/joint_effort' gives a value for 'nose'"),
    ],
)
def test_limits_that_are_none_are_called_limits(client: TestClient, limits: dict[str, Any], words: str) -> None:
    call = {"joint_positions": [[0.3, 0.8]], "polytopes": True, "limits": limits}
    answer = client.post(PATH.format("planar_2r"), json=call)
    assert answer.status_code == 422
    assert words in answer.json()["detail"]
    assert "configuration" not in answer.json()["detail"]


def test_mixed_joints_say_that_their_units_are_mixed(client: TestClient) -> None:
    answer = ask(client, "scara", joint_positions=[[0.4, 0.8, 0.12, -0.3]])
    assert answer["spaces"][0]["velocity_unit"] == "m/s per rad/s or m/s"
    assert answer["spaces"][1]["force_unit"] == "N m per N m or N"


def test_polytopes_within_the_robots_own_limits(client: TestClient) -> None:
    answer = ask(client, joint_positions=[READY], polytopes=True)
    assert answer["joints_without_velocity_limit"] == []
    assert answer["joints_without_effort_limit"] == []
    part = answer["results"][0]["translation"]
    assert [along["direction"] for along in part["velocity_polytope"]["along"]] == np.eye(3).tolist()
    assert all(0.0 < along["alone"] <= along["component"] for along in part["velocity_polytope"]["along"])
    assert all(0.0 < along["alone"] <= along["component"] for along in part["force_polytope"]["along"])
    assert part["velocity_polytope"]["vertices"] is None
    assert "transmission" not in part


def test_polytopes_need_limits_which_a_call_may_give(client: TestClient) -> None:
    answer = ask(client, "planar_2r", joint_positions=[[0.3, 0.8]], polytopes=True)
    assert answer["joints_without_velocity_limit"] == ["joint_1", "joint_2"]
    assert answer["results"][0]["translation"]["velocity_polytope"] is None
    answer = ask(client, "planar_2r", joint_positions=[[0.3, 0.8]], polytopes=True, limits=LIMITS)
    assert answer["joints_without_effort_limit"] == []
    part = answer["results"][0]["translation"]
    J = np.array([[-0.919365358704, -0.623845152043], [1.272853774124, 0.317517284998]])
    x, _, z = part["velocity_polytope"]["along"]
    assert x["component"] == pytest.approx(np.abs(J[0]) @ [2.0, 3.0])
    # Along x alone J's second row is to vanish, so one ratio of joint velocities is left, as fast as its limits allow.
    rates = null_space(J[1:])[:, 0]
    assert x["alone"] == pytest.approx(np.abs(J[0] @ rates) * np.min([2.0, 3.0] / np.abs(rates)))
    assert (z["alone"], z["component"]) == (0.0, 0.0)
    force_x, _, force_z = part["force_polytope"]["along"]
    assert force_x["alone"] == pytest.approx(np.min([10.0, 5.0] / np.abs(J[0])))
    assert (force_z["alone"], force_z["component"]) == (None, None)
    assert np.shape(part["velocity_polytope"]["vertices"]) == (4, 3)
    assert np.shape(part["force_polytope"]["vertices"]) == (4, 3)
    only = ask(client, "planar_2r", joint_positions=[[0.3, 0.8]], polytopes=True, limits={"joint_velocity": [1.0, 1.0]})
    assert only["joints_without_effort_limit"] == ["joint_1", "joint_2"]
    assert only["results"][0]["translation"]["force_polytope"] is None


# npy


def test_npy_is_the_semi_axes(client: TestClient) -> None:
    qs = np.random.default_rng(2).uniform(-1.0, 1.0, (200, 7))
    headers = {"content-type": NPY, "accept": NPY}
    answer = client.post(PATH.format("panda") + "?task=x&task=y&task=rz", content=npy(qs), headers=headers)
    table = np.load(BytesIO(answer.content))
    assert table.shape == (200, 3)
    entries = ask(client, joint_positions=qs.tolist(), task=["x", "y", "rz"])["results"]
    assert table.tolist() == [
        entry["translation"]["velocity_ellipsoid"]["semi_axes"] + entry["rotation"]["velocity_ellipsoid"]["semi_axes"]
        for entry in entries
    ]


def test_a_large_batch_goes_as_npy_only(client: TestClient) -> None:
    qs = np.zeros((MAX_DETAILED + 1, 2))
    answer = client.post(PATH.format("planar_2r"), content=npy(qs), headers={"content-type": NPY})
    assert answer.status_code == 413
    assert "npy" in answer.json()["detail"]
    headers = {"content-type": NPY, "accept": NPY}
    answer = client.post(PATH.format("planar_2r"), content=npy(qs), headers=headers)
    assert np.load(BytesIO(answer.content)).shape == (MAX_DETAILED + 1, 3)


@pytest.mark.parametrize("options", [{"gradient": True}, {"polytopes": True}, {"directions": [[1, 0, 0]]}])
def test_what_is_no_array_does_not_go_as_npy(client: TestClient, options: dict[str, Any]) -> None:
    call = {"joint_positions": [READY], **options}
    assert client.post(PATH.format("panda"), json=call, headers={"accept": NPY}).status_code == 422


# Pictures


@pytest.mark.parametrize(
    ("accept", "wanted"),
    [
        ("", JSON),
        ("*/*", JSON),
        ("application/json", JSON),
        ("text/html, application/xhtml+xml, image/avif, */*;q=0.8", JSON),
        ("image/svg+xml", SVG),
        ("IMAGE/SVG+XML", SVG),
        ("image/png, image/svg+xml;q=0.5", PNG),
        ("image/png;q=0.4,image/svg+xml ; q=0.5", SVG),
        ("image/*", SVG),
        ("image/*;q=0.5, image/svg+xml;q=0", PNG),
        ("image/png, */*", PNG),
        ("image/png;q=0.1, */*;q=0.2", JSON),
        ("application/json, image/png", JSON),
        ("application/x-npy", NPY),
        ("application/x-npy;q=0", JSON),
        ("image/png;q=2", JSON),
        ("image/png;q=nan", JSON),
        ("image/png;q=", JSON),
        ("image/jpeg", JSON),
        (";;;,,q=1,/", JSON),
        ("image/png;version=1;q=1.000", PNG),
    ],
)
def test_the_media_type_by_weights(accept: str, wanted: str) -> None:
    assert preferred_type(accept, (JSON, NPY, SVG, PNG)) == wanted


@pytest.mark.parametrize("accept", [*(JSON, NPY, SVG, PNG), "*/*", ""])
def test_a_single_type_is_understood_at_once_as_a_list_would_be(accept: str) -> None:
    scope = {"type": "http", "headers": [(b"accept", accept.encode())]}
    for offered in ((JSON, NPY, SVG, PNG), (SVG, PNG)):
        request = BoundedRequest(scope, AsyncMock(), AsyncMock(), 0, Bodies(0))
        assert request.preferred(offered) == preferred_type(accept, offered)


def test_a_long_header_is_read_in_no_time() -> None:
    started = time.process_time()
    assert preferred_type(",".join(["image/png;q=0.1"] * 10_000), (JSON, NPY, SVG, PNG)) == PNG
    assert is_within(time.process_time() - started, 0.1)


@pytest.mark.slow
@pytest.mark.parametrize(("kind", "start"), [(SVG, b"<?xml"), (PNG, b"\x89PNG")])
@pytest.mark.parametrize(("robot", "q"), [("planar_2r", [0.3, 0.8]), ("panda", READY)])
def test_pictures(client: TestClient, robot: str, q: list[float], kind: str, start: bytes) -> None:
    answer = client.post(PATH.format(robot), json={"joint_positions": [q]}, headers={"accept": kind})
    assert answer.status_code == 200, answer.text
    assert answer.headers["content-type"] == kind
    assert answer.content.startswith(start)
    npy_call = client.post(
        PATH.format(robot), content=npy([q]), headers={"accept": f"{kind}, */*;q=0.1", "content-type": NPY}
    )
    assert npy_call.content == answer.content


@pytest.mark.parametrize(("field", "body"), [("joint_positions", {"joint_positions": []}), ("task", {"task": ["rx"]})])
def test_a_picture_needs_a_configuration_and_several_a_translation(
    client: TestClient, field: str, body: dict[str, Any]
) -> None:
    call = {"joint_positions": [READY, READY], **body}
    answer = client.post(PATH.format("panda"), json=call, headers={"accept": SVG})
    assert answer.status_code == 422
    assert f"#/{field}" in answer.text
    assert "one or more configurations" in answer.json()["detail"]


def test_postures_of_a_planar_arm_are_drawn(client: TestClient) -> None:
    body = {"joint_positions": [[0.3, 0.8], [0.3, 0.9], [0.5, 1.2]]}
    answer = client.post(PATH.format("planar_2r"), json=body, headers={"accept": PNG})
    assert answer.content.startswith(b"\x89PNG")


@pytest.mark.slow
def test_a_robot_with_names_that_are_no_latin_can_be_drawn(client: TestClient) -> None:
    urdf = (
        '<robot name="x"><link name="底座 $\\frac{$"/><link name="b"/><joint name="j" type="continuous">'
        '<parent link="底座 $\\frac{$"/><child link="b"/><axis xyz="0 0 1"/></joint></robot>'
    )
    added = client.post("/v1/robots", json={"name": "foreign", "urdf": urdf})
    assert added.status_code == 201, added.text
    answer = client.post(PATH.format("foreign"), json={"joint_positions": [[0.1]]}, headers={"accept": PNG})
    assert answer.content.startswith(b"\x89PNG")
    assert client.delete(added.headers["location"]).status_code == 204


def test_an_operation_without_pictures_answers_json(client: TestClient) -> None:
    answer = client.post("/v1/robots/panda/fk", json={"joint_positions": [READY]}, headers={"accept": SVG})
    assert answer.headers["content-type"] == JSON
    content = client.get("/openapi.json").json()["paths"]
    media = content["/v1/robots/{robot}/manipulability"]["post"]["responses"]["200"]["content"]
    assert {JSON, NPY, SVG, PNG, PDF} == set(media)
    assert SVG not in content["/v1/robots/{robot}/fk"]["post"]["responses"]["200"]["content"]


# What is refused

BAD: list[tuple[str, dict[str, Any]]] = [
    ("#/task", {"task": []}),
    ("#/task", {"task": ["x", "x"]}),
    ("#/task/0", {"task": ["up"]}),
    ("#/characteristic_length", {"characteristic_length": 0.0}),
    ("#/characteristic_length", {"characteristic_length": -1.0}),
    ("#/characteristic_length", {"characteristic_length": 1e300}),
    ("#/rank_tolerance", {"rank_tolerance": 0.0}),
    ("#/rank_tolerance", {"rank_tolerance": 1.0}),
    ("#/reference", {"reference": "world"}),
    ("#/directions", {"directions": []}),
    ("#/directions", {"directions": [[1.0, 0.0, 0.0]] * 65}),
    ("#/directions/1", {"directions": [[1.0, 0.0, 0.0], [0.0, 0.0, 0.0]]}),
    ("#/directions/0", {"directions": [[1.0, 0.0]]}),
    ("#/limits", {"limits": {"joint_velocity": [1.0] * 7}}),
    ("#/limits/joint_velocity", {"polytopes": True, "limits": {"joint_velocity": [1.0] * 6}}),
    ("#/limits/joint_velocity", {"polytopes": True, "limits": {"joint_velocity": [0.0] * 7}}),
    ("#/limits/joint_effort", {"polytopes": True, "limits": {"joint_effort": [-1.0] * 7}}),
    ("#/limits/joint_effort", {"polytopes": True, "limits": {"joint_effort": [1e300] * 7}}),
    ("#/limits/joint_effort", {"polytopes": True, "limits": {"joint_effort": {"nobody": 1.0}}}),
    ("#/limits/torque", {"polytopes": True, "limits": {"torque": [1.0] * 7}}),
    ("#/joint_positions/0", {"joint_positions": [[0.0] * 6]}),
    ("#/joint_positions", {"joint_positions": [[1e300] * 7]}),
    ("#/polytopes", {"polytopes": "yes"}),
    ("#/joint_positions/0", {"joint_positions": [[9.0] * 7], "respect_limits": True}),
]


@pytest.mark.parametrize(("place", "fields"), BAD, ids=[f"{i} {place}" for i, (place, _) in enumerate(BAD)])
def test_what_is_refused_names_its_field(client: TestClient, place: str, fields: dict[str, Any]) -> None:
    answer = client.post(PATH.format("panda"), json={"joint_positions": [READY], **fields})
    assert answer.status_code == 422, answer.text
    assert answer.headers["content-type"] == "application/problem+json"
    assert place in answer.text


@pytest.mark.parametrize("number", ["NaN", "Infinity", "1e400"])
@pytest.mark.parametrize("field", ["directions", "joint_positions"])
def test_what_is_no_number_is_refused(client: TestClient, field: str, number: str) -> None:
    values = [number, "0", "0"] if field == "directions" else [number, *["0"] * 6]
    others = "" if field == "joint_positions" else ', "joint_positions": [[0, 0, 0, 0, 0, 0, 0]]'
    body = f'{{"{field}": [[{", ".join(values)}]]{others}}}'
    answer = client.post(PATH.format("panda"), content=body, headers={"content-type": JSON})
    assert answer.status_code in {400, 422}


def test_extreme_numbers_never_leave_a_hole(client: TestClient) -> None:
    cases: list[dict[str, Any]] = [
        {"joint_positions": [[1e6] * 7, [-1e6] * 7]},
        {"directions": [[1e300, 1e300, -1e300], [5e-324, 0.0, 0.0]]},
        {"characteristic_length": 1e-6},
        {"characteristic_length": 1e6, "gradient": True},
        {"rank_tolerance": 0.999999, "gradient": True, "polytopes": True},
        {"rank_tolerance": 1e-300, "joint_positions": [[0.0] * 7], "gradient": True, "polytopes": True},
    ]
    for fields in cases:
        ask(client, **{"joint_positions": [READY], **fields})


@pytest.mark.quick(1)
@pytest.mark.parametrize("lengths", [(1e-300, 1e-300), (1e6, 1e-6), (1e-90, 1e-90), (1e6, 1e6), (0.0, 0.0)])
def test_arms_of_odd_lengths(client: TestClient, lengths: tuple[float, float]) -> None:
    row = {"type": "revolute", "alpha": 0.0, "d": 0.0, "theta": 0.0, "velocity": 1e18, "effort": 1e-18}
    table = {"convention": "standard", "joints": [{**row, "a": length} for length in lengths]}
    added = client.post("/v1/robots", json={"name": "odd", "dh": table})
    assert added.status_code == 201, added.text
    call = {"joint_positions": [[0.3, 0.8]], "directions": [[1, 2, 0]], "polytopes": True, "gradient": True}
    ask(client, "odd", **call)
    drawn = {**call, "polytopes": False}
    assert client.post(PATH.format("odd"), json=drawn, headers={"accept": SVG}).status_code == 200
    assert client.delete(added.headers["location"]).status_code == 204


def test_too_much_work_is_refused(client: TestClient) -> None:
    call = {"joint_positions": [READY] * 2000, "polytopes": True, "directions": [[1.0, 0.0, 0.0]] * 64}
    started = time.process_time()
    answer = client.post(PATH.format("panda"), json=call)
    assert answer.status_code == 413
    assert is_within(time.process_time() - started, 2.0)
