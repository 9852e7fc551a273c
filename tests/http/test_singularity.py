"""Singularity reports over HTTP: the lecture's numbers, the nearest singularity, paths, npy, and what is refused."""

import time
from io import BytesIO
from typing import Any

import numpy as np
import pytest
from starlette.testclient import TestClient

from gelenk.contract.singularities import SingularityAnswer
from tests.speed import is_within

NPY = "application/x-npy"
Q = [0.1, -1.2, 1.4, -0.7, 0.5, 0.3]
WRIST = [0.1, -1.2, 1.4, -0.7, 0.0, 0.3]
READY = [0.0, -0.785, 0.0, -2.356, 0.0, 1.571, 0.785]


def ask(client: TestClient, robot: str = "ur5_dh", **call: Any) -> dict[str, Any]:
    answer = client.post(f"/v1/robots/{robot}/singularities", json=call)
    assert answer.status_code == 200, answer.text
    SingularityAnswer.model_validate_json(answer.content)
    return dict(answer.json())


def refusal(client: TestClient, status: int, robot: str = "planar_2r", **call: Any) -> dict[str, Any]:
    started = time.process_time()
    answer = client.post(f"/v1/robots/{robot}/singularities", json={"joint_positions": [[0.3, 0.0]], **call})
    assert is_within(time.process_time() - started, 1.0)
    assert answer.status_code == status, answer.text
    assert answer.headers["content-type"] == "application/problem+json"
    return dict(answer.json())


def npy(array: Any) -> bytes:
    buffer = BytesIO()
    np.save(buffer, np.asarray(array, dtype=float))
    return buffer.getvalue()


def test_the_wrist_of_the_ur5(client: TestClient) -> None:
    answer = ask(client, joint_positions=[WRIST, Q])
    first, second = answer["singularities"]
    expected = [2.073079224, 1.450502321, 0.545464331, 0.489296516, 0.247862652, 0.0]
    assert first["singular_values"] == pytest.approx(expected, abs=5e-10)
    assert (first["singular"], first["rank"], first["structural_rank"], first["kinds"]) == (True, 5, 6, ["wrist"])
    names = answer["joint_names"]
    assert first["dependent_joints"] == [names[i] for i in (1, 2, 3, 5)]
    (lost,) = first["lost_directions"]
    assert lost["lost_here"]
    assert np.linalg.norm(lost["twist"]) == pytest.approx(1.0)
    (motion,) = first["internal_motions"]
    assert motion["only_here"]
    assert first["exit"]["joint"] == names[4]
    assert (second["singular"], second["lost_directions"], second["internal_motions"]) == (False, [], [])
    assert second["smallest_singular_value"] == second["singular_values"][-1] > 0.1
    assert "nearest" not in first
    assert "path" not in answer
    assert answer["certificate"]["samples"] == 2
    assert answer["certificate"]["max_error"] < 1e-12
    assert answer["certificate"]["max_internal_motion"] < 1e-14
    assert answer["certificate"]["max_lost_direction"] < 1e-14
    assert answer["rank_tolerance"] == first["rank_tolerance"] == 1e-10


def test_what_tolerance_lets_pass_is_in_the_certificate(client: TestClient) -> None:
    answer = ask(client, joint_positions=[Q], rank_tolerance=0.2)
    (entry,) = answer["singularities"]
    counted, passed = entry["rank"], answer["certificate"]["max_internal_motion"]
    assert counted < 6
    assert 1e-3 < passed <= entry["singular_values"][counted] + 1e-12


def test_the_wrench_is_what_no_joint_feels(client: TestClient) -> None:
    """By the Jacobian of another operation."""
    J = client.post("/v1/robots/ur5_dh/jacobian", json={"joint_positions": [WRIST]}).json()["jacobians"][0]
    (entry,) = ask(client, joint_positions=[WRIST])["singularities"]
    np.testing.assert_allclose(np.array(J).T @ entry["lost_directions"][0]["wrench"], 0.0, atol=1e-14)
    np.testing.assert_allclose(J @ np.array(entry["internal_motions"][0]["joint_velocities"]), 0.0, atol=1e-14)


def test_of_a_planar_arm_only_the_plane_is_lost(client: TestClient) -> None:
    whole = ask(client, "planar_2r", joint_positions=[[0.3, 0.0]])
    (entry,) = whole["singularities"]
    assert (entry["rank"], entry["singular"], whole["units_mixed"]) == (2, False, True)
    assert [direction["lost_here"] for direction in entry["lost_directions"]] == [False] * 4
    plane = ask(client, "planar_2r", joint_positions=[[0.3, 0.0]], task=["y", "x"])
    (entry,) = plane["singularities"]
    assert (plane["task"], plane["units_mixed"]) == (["y", "x"], False)
    assert (entry["rank"], entry["kinds"]) == (1, ["elbow"])


def test_the_units_are_mixed_unless_a_length_is_given_or_joints_slide(client: TestClient) -> None:
    assert ask(client, joint_positions=[Q])["units_mixed"]
    scaled = ask(client, joint_positions=[Q], characteristic_length=0.5)
    assert (scaled["units_mixed"], scaled["characteristic_length"]) == (False, 0.5)
    assert not ask(client, joint_positions=[Q], task=["x", "y", "z"])["units_mixed"]
    assert ask(client, "scara", joint_positions=[[0.1, 0.2, 0.1, 0.3]], task=["x", "y", "z"])["units_mixed"]


def test_every_task_has_the_axes_of_the_reference(client: TestClient) -> None:
    J = {
        reference: np.array(
            client.post("/v1/robots/ur5_dh/jacobian", json={"joint_positions": [Q], "reference": reference}).json()[
                "jacobians"
            ][0]
        )
        for reference in ("local_world_aligned", "local", "world")
    }
    for task, rows in ((["ry", "x", "rx"], [4, 0, 3]), (["z", "rx", "ry"], [2, 3, 4]), (["y"], [1])):
        for reference, whole in J.items():
            answer = ask(client, joint_positions=[Q], task=task, reference=reference)
            assert (answer["task"], answer["reference"]) == (task, reference)
            expected = np.linalg.svd(whole[rows], compute_uv=False)
            assert answer["singularities"][0]["singular_values"] == pytest.approx(expected, abs=1e-14)
        assert ask(client, joint_positions=[Q], task=task) == ask(
            client, joint_positions=[Q], task=task, reference="local_world_aligned"
        )


def test_internal_motions_of_a_human(client: TestClient) -> None:
    frames: dict[str, Any] = {"base_frame": "middle_pelvis", "tip_frame": "right_hand"}
    q = (0.1 + 0.1 * np.arange(13)).tolist()
    J = client.post("/v1/robots/human/jacobian", json={"joint_positions": [q], **frames}).json()["jacobians"][0]
    answer = ask(client, "human", joint_positions=[q], task=["z"], **frames)
    motions = [motion["joint_velocities"] for motion in answer["singularities"][0]["internal_motions"]]
    assert len(motions) == 12
    np.testing.assert_allclose(np.array(motions) @ J[2], 0.0, atol=1e-14)
    assert answer["certificate"]["max_internal_motion"] < 1e-14


def test_redundancy_is_no_singularity(client: TestClient) -> None:
    (entry,) = ask(client, "panda", joint_positions=[READY])["singularities"]
    assert (entry["singular"], entry["rank"], entry["dependent_joints"]) == (False, 6, [])
    assert [motion["only_here"] for motion in entry["internal_motions"]] == [False]
    (entry,) = ask(client, "panda", joint_positions=[[0.0] * 7])["singularities"]
    assert [motion["only_here"] for motion in entry["internal_motions"]] == [True, False]


def test_the_nearest_singularity_is_one(client: TestClient) -> None:
    answer = ask(client, "panda", joint_positions=[READY, [0.1] * 7], nearest=True)
    assert answer["certificate"]["samples"] == 4
    found = [entry["nearest"] for entry in answer["singularities"]]
    for nearest, q in zip(found, (READY, [0.1] * 7), strict=True):
        assert nearest["distance"] == pytest.approx(np.linalg.norm(nearest["displacement"]), abs=1e-14)
        np.testing.assert_allclose(np.array(q) + nearest["displacement"], nearest["joint_positions"], atol=1e-14)
    there = ask(client, "panda", joint_positions=[nearest["joint_positions"] for nearest in found])
    assert [entry["singular"] for entry in there["singularities"]] == [True, True]


def test_the_nearest_singularity_of_the_ur5_is_its_elbow_or_wrist(client: TestClient) -> None:
    (entry,) = ask(client, joint_positions=[[0.1, -1.2, 1.4, -0.7, 0.05, 0.3]], nearest=True)["singularities"]
    nearest = entry["nearest"]
    assert nearest["distance"] == pytest.approx(0.05, abs=1e-12)
    assert (nearest["kinds"], nearest["joints"]) == (["wrist"], [ask(client, joint_positions=[Q])["joint_names"][4]])
    assert nearest["within_limits"]


def test_limits_keep_the_nearest_singularity_away(client: TestClient) -> None:
    """The Panda's fifth joint does not reach half a turn."""
    call: dict[str, Any] = {"joint_positions": [[1.9, 1.0, -1.5, -0.4, -2.6, 1.2, -2.0]], "nearest": True}
    near = ask(client, "panda", **call)["singularities"][0]["nearest"]
    kept = ask(client, "panda", **call, respect_limits=True)["singularities"][0]["nearest"]
    assert near["distance"] < kept["distance"]
    assert (near["within_limits"], kept["within_limits"]) == (False, True)


def test_where_there_is_none_the_answer_says_why(client: TestClient) -> None:
    call = {"joint_positions": [[0.3, 1.0]], "nearest": True, "task": ["x", "y"]}
    (entry,) = ask(client, "planar_2r", **call, search_radius=0.5)["singularities"]
    assert entry["nearest"] is None
    assert entry["nearest_reason"].endswith("radius of 0.5")
    (entry,) = ask(client, "planar_2r", **call)["singularities"]
    assert entry["nearest"]["distance"] == pytest.approx(1.0, abs=1e-10)
    assert "nearest_reason" not in entry


def test_where_nothing_can_be_lost_the_answer_says_what_to_ask_for(client: TestClient) -> None:
    call: dict[str, Any] = {"joint_positions": [[0.3, 1.0]], "nearest": True}
    (entry,) = ask(client, "planar_2r", **call)["singularities"]
    assert "6 directions the tip has 2 at most" in entry["nearest_reason"]
    assert "`task` x y" in entry["nearest_reason"]
    (entry,) = ask(client, "planar_2r", **call, task=["z"])["singularities"]
    assert entry["nearest_reason"].startswith("nothing can be lost: the tip has none")
    (entry,) = ask(client, "planar_2r", **call, task=["rz"])["singularities"]
    assert entry["nearest_reason"].startswith("nothing can be lost: of these directions")


def test_a_path_through_a_singularity(client: TestClient) -> None:
    answer = ask(client, joint_positions=[Q, [*Q[:4], -0.3, 0.3], [*Q[:4], -1.0, 0.3]], path=True)
    assert [entry["singular"] for entry in answer["singularities"]] == [False, False, False]
    (place,) = answer["path"]["places"]
    assert (place["segment"], place["fraction"], place["end"]) == (0, pytest.approx(0.625), pytest.approx(0.625))
    assert place["joint_positions"] == pytest.approx(WRIST, abs=1e-12)
    assert place["report"]["kinds"] == ["wrist"]
    assert answer["path"]["omitted"] == 0
    assert ask(client, joint_positions=[Q, Q], path=True)["path"]["places"] == []


def test_npy_in_and_out(client: TestClient) -> None:
    path = "/v1/robots/ur5_dh/singularities"
    answer = client.post(
        f"{path}?task=x&task=y&task=z", content=npy([WRIST, Q]), headers={"content-type": NPY, "accept": NPY}
    )
    entries = ask(client, joint_positions=[WRIST, Q], task=["x", "y", "z"])["singularities"]
    np.testing.assert_allclose(np.load(BytesIO(answer.content)), [e["singular_values"] for e in entries], atol=1e-15)
    refused = client.post(f"{path}?nearest=true", content=npy([Q]), headers={"content-type": NPY, "accept": NPY})
    assert (refused.status_code, "array" in refused.json()["detail"]) == (422, True)


def test_chains_of_no_joint_and_of_many(client: TestClient) -> None:
    none: dict[str, Any] = {"tip_frame": "panda_link0", "joint_positions": [[]], "nearest": True, "path": True}
    (entry,) = ask(client, "panda", **none)["singularities"]
    assert (entry["rank"], entry["smallest_singular_value"], entry["nearest"]) == (0, None, None)
    many: dict[str, Any] = {"base_frame": "left_gripper", "tip_frame": "right_gripper"}
    (entry,) = ask(client, "baxter", **many, joint_positions=[[0.2] * 14], nearest=True)["singularities"]
    assert (entry["rank"], len(entry["internal_motions"])) == (6, 8)
    assert ask(client, "planar_2r", joint_positions=[])["singularities"] == []


@pytest.mark.parametrize(
    ("call", "place"),
    [
        ({"task": []}, "#/task"),
        ({"task": ["x", "w"]}, "#/task/1"),
        ({"task": "xy"}, "#/task"),
        ({"characteristic_length": 0.0}, "#/characteristic_length"),
        ({"characteristic_length": -1.0}, "#/characteristic_length"),
        ({"characteristic_length": 1e300}, "#/characteristic_length"),
        ({"rank_tolerance": 0.0}, "#/rank_tolerance"),
        ({"rank_tolerance": 1.0}, "#/rank_tolerance"),
        ({"reference": "tool"}, "#/reference"),
        ({"search_radius": 0.0}, "#/search_radius"),
        ({"search_radius": 11.0}, "#/search_radius"),
        ({"path_threshold": 0.0}, "#/path_threshold"),
        ({"path_threshold": 1.5}, "#/path_threshold"),
        ({"nearest": "yes"}, "#/nearest"),
        ({"path": 1}, "#/path"),
        ({"joint_positions": [0.3, 0.0]}, "#/joint_positions/0"),
        ({"damping": 1.0}, "#/damping"),
    ],
)
def test_what_cannot_be_is_refused_with_its_place(client: TestClient, call: dict[str, Any], place: str) -> None:
    assert refusal(client, 422, **call)["errors"][0]["pointer"] == place


def test_what_the_core_refuses(client: TestClient) -> None:
    assert refusal(client, 422, task=["x", "x"])["pointer"] == "#/task"
    assert refusal(client, 422, joint_positions=[[0.3]])["given"] == 1
    assert refusal(client, 422, joint_positions=[[0.3, 1e300]])["pointer"] == "#/joint_positions"
    assert refusal(client, 422, joint_positions=[{"joint_1": 0.0, "nose": 1.0}])["joint"] == "nose"
    assert refusal(client, 422, joint_positions=[[0.3, 4.0]], respect_limits=True)["value"] == 4.0
    assert refusal(client, 404, tip_frame="nose")["frame"] == "nose"


@pytest.mark.parametrize(
    ("call", "count", "allowed"), [({}, 2001, 2000), ({"path": True}, 1001, 1000), ({"nearest": True}, 101, 100)]
)
def test_more_than_can_be_told_at_once_is_refused(
    client: TestClient, call: dict[str, Any], count: int, allowed: int
) -> None:
    problem = refusal(client, 413, joint_positions=[[0.3, 0.5]] * count, **call)
    assert (problem["given"], problem["allowed"]) == (count, allowed)


@pytest.mark.parametrize("text", ["NaN", "Infinity", "1e400", "null", '"0"', "true"])
def test_numbers_that_are_none(client: TestClient, text: str) -> None:
    body = f'{{"joint_positions": [[0.3, {text}]]}}'.encode()
    answer = client.post(
        "/v1/robots/planar_2r/singularities", content=body, headers={"content-type": "application/json"}
    )
    assert answer.status_code in {400, 422}
    assert answer.headers["content-type"] == "application/problem+json"


@pytest.mark.slow
@pytest.mark.parametrize("robot", ["ur5_dh", "panda", "scara", "stanford", "planar_3r"])
def test_the_largest_numbers_give_numbers(client: TestClient, robot: str) -> None:
    names = ask(client, robot, joint_positions=[])["joint_names"]
    far = [[sign * 1e6] * len(names) for sign in (1.0, -1.0)]
    for length in (1e-6, 1e6):
        ask(client, robot, joint_positions=far, nearest=True, path=True, characteristic_length=length)
    for reference in ("local", "world"):
        ask(client, robot, joint_positions=far, nearest=True, path=True, reference=reference, rank_tolerance=1e-300)
