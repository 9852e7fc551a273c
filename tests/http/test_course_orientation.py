"""Orientations over HTTP: every notation in and out, and everything that is refused."""

import json
from math import pi
from typing import Any

import numpy as np
import pytest
from scipy.spatial.transform import Rotation
from starlette.testclient import TestClient

from gelenk.contract.orientation import OrientationAnswer
from gelenk.contract.pose import ORIENTATIONS

PATH = "/v1/course/orientation"
PRINTED = 5e-13
NO_TURN = [[1, 0, 0], [0, 1, 0], [0, 0, 1]]
REFLECTION = [[1, 0, 0], [0, 1, 0], [0, 0, -1]]
STRETCHED = [[2, 0, 0], [0, 1, 0], [0, 0, 1]]


def converted(client: TestClient, **body: Any) -> dict[str, Any]:
    answer = client.post(PATH, json=body)
    assert answer.status_code == 200, answer.text
    content: dict[str, Any] = answer.json()
    OrientationAnswer.model_validate_json(answer.content, strict=True)
    assert content["certificate"]["max_rotation_error"] < 1e-13
    return content


@pytest.mark.parametrize("seed", range(5))
def test_what_goes_out_in_any_notation_comes_back_in(client: TestClient, seed: int) -> None:
    R = Rotation.random(rng=np.random.default_rng(seed)).as_matrix()
    found = converted(client, rotation=R.tolist())
    for name in ORIENTATIONS:
        again = converted(client, **{name: found[name]})
        for other in ORIENTATIONS:
            assert np.array(again[other]) == pytest.approx(np.array(found[other]), abs=1e-13), (name, other)
    turn = {key: found["axis_angle"][key] for key in ("axis", "angle")}
    assert np.array(converted(client, axis_angle=turn)["rotation"]) == pytest.approx(R, abs=1e-14)
    for name in ("zyz", "rpy"):
        for solution in found[f"{name}_solutions"]:
            assert np.array(converted(client, **{name: solution})["rotation"]) == pytest.approx(R, abs=1e-14)


def test_the_lectures_zyz_has_both_branches(client: TestClient) -> None:
    found = converted(client, zyz=[0.3, 0.7, -1.1])
    assert found["rotation"][0] == pytest.approx([0.594804145631, 0.517142044740, 0.615444663558], abs=PRINTED)
    assert found["zyz"] == found["zyz_solutions"][0] == pytest.approx([0.3, 0.7, -1.1], abs=PRINTED)
    assert found["zyz_solutions"][1] == pytest.approx([-2.841592653590, -0.7, 2.041592653590], abs=PRINTED)
    assert found["degenerate"] == []


@pytest.mark.parametrize(
    ("body", "notation", "determined", "value"),
    [
        ({"zyz": [0.4, 0.0, 0.5]}, "zyz", "phi + psi", 0.9),
        ({"zyz": [0.4, pi, 0.5]}, "zyz", "phi - psi", -0.1),
        ({"rpy": [0.2, pi / 2, 0.9]}, "rpy", "yaw - roll", 0.7),
        ({"rpy": [0.2, -pi / 2, 0.9]}, "rpy", "yaw + roll", 1.1),
    ],
)
def test_what_degenerates_is_named(
    client: TestClient, body: dict[str, Any], notation: str, determined: str, value: float
) -> None:
    found = converted(client, **body)
    (named,) = [one for one in found["degenerate"] if one["notation"] == notation]
    assert named["determined"] == determined
    assert named["value"] == pytest.approx(value, abs=PRINTED)
    assert len(found[f"{notation}_solutions"]) == 1
    assert found["degenerate_threshold"] == 1e-14


def test_no_turn_has_no_axis_and_half_a_turn_has_two(client: TestClient) -> None:
    assert converted(client, rpy=[0, 0, 0])["axis_angle"] == {"axis": None, "other_axis": None, "angle": 0.0}
    found = converted(client, axis_angle={"axis": [1, 2, 2], "angle": pi})
    assert np.array(found["rotation"]) * 9 == pytest.approx(np.array([[-7, 4, 4], [4, -1, 8], [4, 8, -1]]), abs=1e-14)
    assert found["axis_angle"]["axis"] == pytest.approx([1 / 3, 2 / 3, 2 / 3])
    assert found["axis_angle"]["other_axis"] == pytest.approx([-1 / 3, -2 / 3, -2 / 3])


def test_a_nearly_degenerate_triple_is_warned_of(client: TestClient) -> None:
    found = converted(client, zyz=[0.4, 1e-8, 0.5])
    assert found["degenerate"] == []
    assert found["warnings"][0].startswith("ZYZ is nearly degenerate, sin θ = 1e-08")
    assert sum(found["zyz"]) - found["zyz"][1] == pytest.approx(0.9, abs=1e-15)


def test_frames_are_composed_inverted_and_applied(client: TestClient) -> None:
    first = {"elementary": {"axis": "z", "angle": 0.3}}
    found = converted(client, **first, then=[{"elementary": {"axis": "x", "angle": 0.4}}], points=[[1, 2, 3]])
    assert found["points"][0] == pytest.approx([0.756195185525, 0.939289903397, 3.542019666626], abs=PRINTED)
    assert [len(found["frames"]), found["validations"]] == [2, [None, None]]
    found = converted(client, **first, position=[1, 2, 3], then=[{"elementary": {"axis": "x", "angle": 0.2}}])
    assert found["inverse"]["position"] == pytest.approx(
        [-1.546376902448, -2.178965241928, -2.619318413260], abs=PRINTED
    )


def test_fixed_axes_are_not_moving_ones(client: TestClient) -> None:
    turns = [{"elementary": {"axis": "y", "angle": 0.5}}, {"elementary": {"axis": "z", "angle": 0.9}}]
    first = {"elementary": {"axis": "x", "angle": -0.2}}
    fixed = converted(client, **first, then=[{**turn, "about": "fixed"} for turn in turns])
    assert fixed["rpy"] == pytest.approx([-0.2, 0.5, 0.9], abs=1e-15)
    assert converted(client, **first, then=turns)["rpy"] != pytest.approx([-0.2, 0.5, 0.9], abs=1e-3)


def test_a_matrix_that_is_nearly_a_rotation_is_taken_and_its_distance_told(client: TestClient) -> None:
    R = Rotation.from_rotvec([0.1, 0.2, 0.3]).as_matrix()
    found = converted(client, rotation=(R * (1 + 1e-8)).tolist())
    (validation,) = found["validations"]
    assert validation["distance"] == pytest.approx(3**0.5 * 1e-8, rel=1e-6)
    assert validation["determinant"] == pytest.approx(1 + 3e-8, abs=1e-12)
    assert not validation["projected"]
    assert np.array(found["rotation"]) == pytest.approx(R, abs=1e-14)


def test_the_nearest_rotation_is_taken_on_request(client: TestClient) -> None:
    R = Rotation.from_rotvec([0.1, 0.2, 0.3]).as_matrix()
    found = converted(client, rotation=(1.1 * R).tolist(), project=True)
    (validation,) = found["validations"]
    assert validation["projected"]
    assert validation["distance"] == pytest.approx(0.1 * 3**0.5)
    assert validation["orthogonality_error"] == pytest.approx(0.21 * 3**0.5)
    assert np.array(found["rotation"]) == pytest.approx(R, abs=1e-14)


def test_a_reflection_can_be_projected_and_is_called_one(client: TestClient) -> None:
    found = converted(client, rotation=REFLECTION, project=True)
    assert found["validations"][0]["is_reflection"]
    assert not found["validations"][0]["is_unique"]
    assert "one of the nearest was taken" in found["warnings"][0]


REFUSED: dict[str, tuple[dict[str, Any], str, str]] = {
    "nothing": ({}, "#", "exactly one orientation of quaternion_xyzw"),
    "two orientations": ({"rpy": [0, 0, 0], "zyz": [0, 0, 0]}, "#", "2 are given"),
    "a position alone": ({"position": [0, 0, 0]}, "#", "0 are given"),
    "project without a matrix": ({"rpy": [0, 0, 0], "project": True}, "#", "`project` is only allowed with `rotation`"),
    "a reflection": ({"rotation": REFLECTION}, "#/rotation", "a reflection: ‖RᵀR - I‖ = 0, det R = -1"),
    "a stretched matrix": ({"rotation": STRETCHED}, "#/rotation", "not a rotation: ‖RᵀR - I‖ = 3, det R = 2"),
    "the zero matrix": ({"rotation": [[0, 0, 0]] * 3}, "#/rotation", "not a rotation"),
    "the zero matrix to be projected": (
        {"rotation": [[0, 0, 0]] * 3, "project": True},
        "#/rotation",
        "the matrix is zero: no rotation is nearer",
    ),
    "a huge matrix": ({"rotation": [[1e6, 0, 0]] * 3}, "#/rotation", "not a rotation"),
    "a matrix of two rows": ({"rotation": NO_TURN[:2]}, "#/rotation", "at least 3"),
    "a quaternion of length 2": ({"quaternion_xyzw": [0, 0, 0, 2]}, "#/quaternion_xyzw", "length 2"),
    "a zero quaternion": ({"quaternion_wxyz": [0, 0, 0, 0]}, "#/quaternion_wxyz", "length 0"),
    "three numbers for a quaternion": ({"quaternion_xyzw": [0, 0, 1]}, "#/quaternion_xyzw", "at least 4"),
    "no direction": ({"axis_angle": {"axis": [0, 0, 0], "angle": 1}}, "#/axis_angle/axis", "an axis has a direction"),
    "no angle": ({"axis_angle": {"axis": [0, 0, 1]}}, "#/axis_angle/angle", "required"),
    "another axis": ({"elementary": {"axis": "w", "angle": 1}}, "#/elementary/axis", "'x', 'y' or 'z'"),
    "a huge angle": ({"rpy": [1e300, 0, 0]}, "#/rpy/0", "less than or equal to 1000000"),
    "a number as text": ({"rpy": ["0", 0, 0]}, "#/rpy/0", "valid number"),
    "one more field": ({"rpy": [0, 0, 0], "degrees": True}, "#/degrees", "not permitted"),
    "a bad further motion": ({"rpy": [0, 0, 0], "then": [{"rpy": [0, 0, 0]}, {}]}, "#/then/1", "0 are given"),
    "a further reflection": (
        {"rpy": [0, 0, 0], "then": [{"rotation": [[-1, 0, 0], [0, -1, 0], [0, 0, -1]]}]},
        "#/then/0/rotation",
        "a reflection",
    ),
    "a further quaternion of length 0": (
        {"rpy": [0, 0, 0], "then": [{"quaternion_xyzw": [0, 0, 0, 0]}]},
        "#/then/0/quaternion_xyzw",
        "length 0",
    ),
    "about nothing": (
        {"rpy": [0, 0, 0], "then": [{"rpy": [0, 0, 0], "about": "me"}]},
        "#/then/0/about",
        "'moving' or 'fixed'",
    ),
    "too many motions": ({"rpy": [0, 0, 0], "then": [{"rpy": [0, 0, 0]}] * 65}, "#/then", "at most 64"),
    "too many points": ({"rpy": [0, 0, 0], "points": [[0, 0, 0]] * 10_001}, "#/points", "at most 10000"),
    "a flat point": ({"rpy": [0, 0, 0], "points": [[0, 0]]}, "#/points/0", "at least 3"),
    "a far point": ({"rpy": [0, 0, 0], "points": [[1e7, 0, 0]]}, "#/points/0/0", "less than or equal to 1000000"),
}


@pytest.mark.parametrize("name", REFUSED)
def test_a_bad_request_is_refused_at_its_place(client: TestClient, name: str) -> None:
    body, pointer, reason = REFUSED[name]
    answer = client.post(PATH, json=body)
    problem = answer.json()
    assert answer.status_code == 422, answer.text
    assert problem.get("pointer", problem.get("errors", [{}])[0].get("pointer")) == pointer
    assert reason in problem["detail"]
    assert len(answer.content) < 16_000


@pytest.mark.parametrize("number", ["NaN", "Infinity", "-Infinity", "1e400", "1e300", "null", "true"])
@pytest.mark.parametrize("name", ["rpy", "zyz", "rotation_vector", "position"])
def test_numbers_that_are_none(client: TestClient, name: str, number: str) -> None:
    fields = {"rpy": "[0, 0, 0]"} if name == "position" else {}
    fields[name] = f"[{number}, 0, 0]"
    body = "{" + ", ".join(f"{json.dumps(key)}: {value}" for key, value in fields.items()) + "}"
    answer = client.post(PATH, content=body, headers={"content-type": "application/json"})
    assert answer.status_code in {400, 422}, answer.text


@pytest.mark.quick(4)
@pytest.mark.parametrize("size", [1e-300, 1e-17, 1e-9, 1.0, 1e6])
@pytest.mark.parametrize("name", ["rpy", "zyz", "rotation_vector"])
def test_angles_of_any_size_give_numbers(client: TestClient, name: str, size: float) -> None:
    for signs in ([1, 1, 1], [-1, 1, -1], [0, 1, 0], [1, 0, 0], [0, 0, -1]):
        found = converted(client, **{name: [sign * size for sign in signs]})
        assert len(found["rotation"]) == 3


def test_many_motions_and_far_positions_are_certified(client: TestClient) -> None:
    rng = np.random.default_rng(0)
    then = [
        {
            "rotation_vector": rng.normal(size=3).tolist(),
            "position": rng.uniform(-1e6, 1e6, 3).tolist(),
            "about": "fixed" if i % 3 else "moving",
        }
        for i in range(64)
    ]
    found = converted(client, rpy=[0, 0, 0], then=then, points=rng.uniform(-1e6, 1e6, (1000, 3)).tolist())
    assert found["certificate"]["max_point_error"] < 1e-13
    assert len(found["frames"]) == 65


def test_what_is_no_json_body(client: TestClient) -> None:
    assert client.post(PATH, content=b"x", headers={"content-type": "text/plain"}).status_code == 415
    assert client.post(PATH, content=b"{", headers={"content-type": "application/json"}).status_code == 400
    assert client.post(PATH + "?rpy=0", json={"rpy": [0, 0, 0]}).status_code == 422
    assert client.get(PATH).status_code == 405
