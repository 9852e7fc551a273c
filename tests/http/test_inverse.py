"""Inverse kinematics over HTTP: what a caller asks and gets, formats, batches, verdicts, refusals."""

import time
from io import BytesIO
from pathlib import Path
from typing import Any

import numpy as np
import pytest
from starlette.testclient import TestClient

from gelenk.contract.ik import InverseAnswer
from gelenk.contract.pose import ORIENTATIONS
from gelenk.ik import quick
from gelenk.ik.closed import branch_kernels
from gelenk.ik.closed.closed_form import closed_form
from gelenk.ik.search import kernels, restarts, task
from gelenk.ik.verdict import branches, judge
from gelenk.main import create_app
from gelenk.robot import configuration
from gelenk.settings import Settings
from tests.http.test_kinematics import NPY, Array, fk, npy
from tests.robots import robot
from tests.speed import is_within

IDENTITY = [0.0, 0.0, 0.0, 1.0]


def ik(client: TestClient, name: str = "panda", **call: Any) -> dict[str, Any]:
    answer = client.post(f"/v1/robots/{name}/ik", json=call)
    assert answer.status_code == 200, answer.text
    InverseAnswer.model_validate_json(answer.content)
    return dict(answer.json())


def result(client: TestClient, name: str, target: dict[str, Any], **call: Any) -> dict[str, Any]:
    (only,) = ik(client, name, targets=[target], **call)["results"]
    return dict(only)


def refused(client: TestClient, name: str = "panda", status: int = 422, **call: Any) -> dict[str, Any]:
    answer = client.post(f"/v1/robots/{name}/ik", json=call)
    assert answer.status_code == status, answer.text
    assert answer.headers["content-type"] == "application/problem+json"
    return dict(answer.json())


def within(name: str, count: int, seed: int = 3) -> Array:
    """Configurations within the limits of the default chain."""
    chain = robot(name).chain(None, None)
    lower, upper = np.maximum(chain.lower, -np.pi), np.minimum(chain.upper, np.pi)
    return np.random.default_rng(seed).uniform(lower, upper, (count, len(chain)))


def poses(client: TestClient, name: str, qs: Array, pose_format: str = "matrix") -> list[dict[str, Any]]:
    return list(fk(client, name, joint_positions=qs.tolist(), pose_format=pose_format)["poses"])


def positions(answer: dict[str, Any]) -> Array:
    """The first solution of each target."""
    return np.array([entry["solutions"][0]["joint_positions"] for entry in answer["results"]])


def planar(x: float, y: float) -> dict[str, Any]:
    return {"position": [x, y, 0.0], "quaternion_xyzw": IDENTITY}


@pytest.mark.quick(1)
@pytest.mark.parametrize("name", ["panda", "ur5", "puma560", "tiago", "scara", "stanford", "baxter"])
def test_what_is_reached_is_what_was_asked_for(client: TestClient, name: str) -> None:
    targets = poses(client, name, within(name, 40))
    options: dict[str, Any] = {"task": ["x", "y", "z", "rz"]} if name == "scara" else {}
    answer = ik(client, name, targets=targets, **options)
    assert [entry["status"] for entry in answer["results"]] == ["solved"] * 40
    qs = positions(answer)
    chain = robot(name).chain(None, None)
    assert answer["joint_names"] == list(chain.joint_names)
    assert ((qs >= chain.lower - 1e-9) & (qs <= chain.upper + 1e-9)).all()
    reached = np.array([pose["matrix"] for pose in poses(client, name, qs)])
    assert np.abs(reached - np.array([target["matrix"] for target in targets])).max() < 3e-6
    for entry in answer["results"]:
        (solution,) = entry["solutions"]
        assert solution["position_error"] <= 1e-6
        assert solution["orientation_error"] <= 1e-6
        assert solution["method"] == ("damped_least_squares" if closed_form(chain) is None else "analytic")
        assert (solution["branch"] is None) == (closed_form(chain) is None)


@pytest.mark.parametrize("pose_format", [*ORIENTATIONS, "matrix"])
def test_a_target_may_have_any_notation(client: TestClient, pose_format: str) -> None:
    qs = within("ur5", 5)
    expected = positions(ik(client, "ur5", targets=poses(client, "ur5", qs)))
    given = positions(ik(client, "ur5", targets=poses(client, "ur5", qs, pose_format)))
    np.testing.assert_allclose(given, expected, atol=1e-6)


def test_an_answer_depends_on_neither_the_batch_nor_the_format(client: TestClient) -> None:
    targets = poses(client, "panda", within("panda", 600), "quaternion_xyzw")
    whole = ik(client, targets=targets)
    for i in (0, 17, 599):
        assert result(client, "panda", targets[i]) == whole["results"][i]
    assert ik(client, targets=targets[100:140])["results"] == whole["results"][100:140]
    array = np.array([pose["position"] + pose["quaternion_xyzw"] for pose in targets])
    headers = {"content-type": NPY, "accept": NPY}
    answer = client.post("/v1/robots/panda/ik", content=npy(array), headers=headers)
    assert answer.headers["gelenk-unsolved"] == "0"
    assert answer.headers["gelenk-unsolved-rows"] == ""
    np.testing.assert_allclose(np.load(BytesIO(answer.content)), positions(whole), atol=1e-12)


def test_the_random_seed_decides(client: TestClient) -> None:
    targets = poses(client, "g1", within("g1", 200))
    first = ik(client, "g1", targets=targets, random_seed=5)
    assert ik(client, "g1", targets=targets, random_seed=5) == first
    other = ik(client, "g1", targets=targets, random_seed=6)
    restarted = [entry["solutions"][0]["restarts"] > 0 for entry in first["results"]]
    assert any(restarted)
    assert other != first


def test_matrices_as_npy_and_options_in_the_query(client: TestClient) -> None:
    matrices = np.array([pose["matrix"] for pose in poses(client, "panda", within("panda", 30))])
    matrices[7, :3, 3] = [3.0, 0.0, 0.0]
    path, headers = "/v1/robots/panda/ik", {"content-type": NPY}
    query = "?task=x&task=y&task=z&random_seed=4&position_tolerance=1e-9"
    answer = client.post(path + query, content=npy(matrices), headers=headers).json()
    targets = [{"matrix": T} for T in matrices.tolist()]
    call: dict[str, Any] = {"task": ["x", "y", "z"], "random_seed": 4, "position_tolerance": 1e-9}
    expected = ik(client, targets=targets, **call)
    assert [entry["status"] for entry in answer["results"]].count("unreachable") == 1
    assert answer["task"] == ["x", "y", "z"]
    np.testing.assert_allclose(
        positions({"results": answer["results"][8:]}), positions({"results": expected["results"][8:]}), atol=1e-7
    )
    as_array = client.post(path + query, content=npy(matrices), headers={**headers, "accept": NPY})
    assert (as_array.headers["gelenk-unsolved"], as_array.headers["gelenk-unsolved-rows"]) == ("1", "7")
    table = np.load(BytesIO(as_array.content))
    np.testing.assert_array_equal(table[7], answer["results"][7]["nearest"]["joint_positions"])


def test_no_targets_and_no_joints(client: TestClient) -> None:
    assert ik(client, targets=[])["results"] == []
    headers = {"content-type": NPY, "accept": NPY}
    answer = client.post("/v1/robots/panda/ik", content=npy(np.zeros((0, 7))), headers=headers)
    assert answer.status_code == 200
    stuck = ik(client, targets=[planar(0, 0), planar(1, 0)], tip_frame="panda_link0")
    assert [entry["status"] for entry in stuck["results"]] == ["solved", "unreachable"]
    assert stuck["results"][0]["solutions"][0]["joint_positions"] == []
    every = ik(client, targets=[planar(0, 0), planar(1, 0)], tip_frame="panda_link0", solutions="all")
    assert [entry["status"] for entry in every["results"]] == ["solved", "unreachable"]


def test_newton_of_the_course_digit_for_digit(client: TestClient) -> None:
    call: dict[str, Any] = {"task": ["x", "y"], "seeds": [[0.3, 1.2]], "trace": True, "position_tolerance": 1e-12}
    answer = result(client, "planar_2r", planar(0.9, 0.8), method="newton", **call)
    errors = [entry["error"] for entry in answer["trace"]]
    assert errors[:4] == pytest.approx([2.203170127e-1, 3.397687680e-2, 4.742096728e-4, 9.258881658e-8], rel=1e-8)
    assert answer["stop_reason"] == "converged"
    assert answer["solutions"][0]["iterations"] == 4
    assert answer["solutions"][0]["joint_positions"] == pytest.approx([0.106585970938, 1.599371644064], abs=1e-11)
    assert answer["trace"][0]["joint_positions"] == [0.3, 1.2]
    assert answer["trace"][0]["step_length"] == pytest.approx(np.hypot(0.2153324755, 0.4566335494), rel=1e-6)
    assert answer["trace"][-1]["step_length"] is None


def test_the_gradient_of_the_course(client: TestClient) -> None:
    call: dict[str, Any] = {"task": ["x", "y"], "seeds": [[0.3, 1.2]], "trace": True}
    target = planar(0.9, 0.8)
    answer = result(client, "planar_2r", target, method="gradient", step_size=0.3, **call)
    expected = [0.2203170127, 0.2048157232, 0.1924963978, 0.1809979782]
    assert [entry["error"] for entry in answer["trace"][:4]] == pytest.approx(expected, abs=1e-9)
    assert answer["solutions"][0]["iterations"] == 137
    both = result(client, "planar_2r", target, method="gradient_then_newton", step_size=0.3, **call)
    methods = [entry["method"] for entry in both["trace"]]
    assert (methods.count("gradient"), methods[38], methods[-1]) == (38, "newton", None)
    stuck = result(
        client, "planar_2r", planar(0.5, 0), method="gradient", task=["x", "y"], seeds=[{"joint_1": 0, "joint_2": 0}]
    )
    assert (stuck["status"], stuck["stop_reason"], stuck["solutions"]) == ("singular", "stagnated", [])
    assert "ker" in stuck["reason"]
    assert "trace" not in stuck


def test_a_trace_of_the_search_ends_at_its_solution(client: TestClient) -> None:
    for target in poses(client, "panda", within("panda", 5)):
        answer = result(client, "panda", target, trace=True)
        end, solution = answer["trace"][-1], answer["solutions"][0]
        difference = np.array(end["joint_positions"]) - solution["joint_positions"]
        assert np.abs(difference - 2 * np.pi * np.rint(difference / (2 * np.pi))).max() < 1e-4
        assert answer["stop_reason"] == "converged"


def test_out_of_reach_is_told_at_once_with_the_nearest_pose(client: TestClient) -> None:
    answer = result(client, "planar_2r", planar(2.0, 1.0), task=["x", "y"], pose_format="rpy")
    assert (answer["status"], answer["solutions"]) == ("unreachable", [])
    nearest = answer["nearest"]
    assert nearest["joint_positions"] == pytest.approx([0.463647609001, 0.0], abs=1e-6)
    assert nearest["position_error"] == pytest.approx(np.sqrt(5) - 1.7, abs=1e-12)
    assert nearest["pose"]["position"][:2] == pytest.approx(1.7 * np.array([2.0, 1.0]) / np.sqrt(5), abs=1e-6)
    assert "the tip would be 2.23607 m from the first joint, 0.536 m more than the links allow" in answer["reason"]
    (direction,) = answer["unserved_directions"]
    assert np.abs(direction) == pytest.approx([2 / np.sqrt(5), 1 / np.sqrt(5), 0, 0, 0, 0], abs=1e-6)


def test_a_limit_in_the_way_is_named(client: TestClient) -> None:
    joints = [
        {"type": "revolute", "a": 1.0, "alpha": 0, "d": 0, "theta": 0, "lower": -1.0, "upper": 1.0},
        {"type": "revolute", "a": 0.7, "alpha": 0, "d": 0, "theta": 0, "lower": 0.0, "upper": 1.0},
    ]
    table = {"convention": "standard", "joints": joints}
    assert client.post("/v1/robots", json={"name": "narrow", "dh": table}).status_code == 201
    (pose,) = fk(client, "narrow", joint_positions=[[0.5, 1.3]])["poses"]
    answer = result(client, "narrow", pose, task=["x", "y"])
    assert answer["status"] == "outside_limits"
    (joint,) = answer["blocking_joints"]
    assert (joint["name"], joint["upper"]) == ("joint_2", 1.0)
    assert joint["position"] == pytest.approx(1.3, abs=1e-6)
    assert joint["excess"] == pytest.approx(0.3, abs=1e-6)
    assert "joint_2" in answer["reason"]
    free = result(client, "narrow", pose, task=["x", "y"], respect_limits=False)
    assert free["solutions"][0]["joint_positions"] == pytest.approx([0.5, 1.3], abs=1e-6)


def test_five_joints_say_which_directions_they_cannot_serve(client: TestClient) -> None:
    target = {"position": [0.1, -0.2, 0.15], "rpy": [np.pi, 0.0, 0.0]}
    answer = result(client, "so100", target)
    assert answer["status"] == "unreachable"
    jacobian = client.post(
        "/v1/robots/so100/jacobian", json={"joint_positions": [answer["nearest"]["joint_positions"]]}
    )
    for direction in answer["unserved_directions"]:
        # Joints that their limits hold do not count: what is left is square to the others' columns.
        products = np.abs(np.array(direction) @ np.array(jacobian.json()["jacobians"][0]))
        assert np.sum(products < 1e-3) >= 3
    assert result(client, "so100", target, task=["x", "y", "z"])["status"] == "solved"


@pytest.mark.slow
def test_a_budget_that_is_too_small_says_so(client: TestClient) -> None:
    targets = poses(client, "panda", within("panda", 60))
    short = ik(client, "panda", targets=targets, max_iterations=1)["results"]
    unsolved = [entry for entry in short if entry["status"] != "solved"]
    assert unsolved
    assert {entry["status"] for entry in unsolved} <= {"not_converged", "outside_limits"}
    timed = ik(client, "panda", targets=targets * 40, time_limit=1e-6)["results"]
    assert {"not_converged"} < {entry["status"] for entry in timed} | {"solved"}
    assert any("time limit" in (entry["reason"] or "") for entry in timed)
    assert all(entry["stop_reason"] == "time_limit" for entry in timed if entry["status"] == "not_converged")


@pytest.mark.slow
def test_a_long_trace_is_told_evenly_thinned(client: TestClient) -> None:
    """From the first configuration to the last, in an answer of bounded size; a short one is told as a whole."""
    call = {"method": "gradient", "step_size": 1e-3, "seeds": [[0.1, 0.2]], "trace": True, "position_tolerance": 1e-12}
    target = {"position": [0.9, 0.8, 0.0], "rotation_vector": [0.0, 0.0, 0.0]}
    whole = result(client, "planar_2r", target, **call, max_iterations=900)
    assert len(whole["trace"]) == 901
    assert "note" not in whole
    long = result(client, "planar_2r", target, **call, max_iterations=2500)
    told = long["trace"]
    assert long["note"] == "the trace reports 1 in 3 of 2501 configurations, and the last"
    assert told[: len(whole["trace"][::3])] == whole["trace"][::3][:-1] + told[300:301]
    assert len(told) == 835
    assert (told[-1]["step_length"], told[-1]["method"]) == (None, None)


def test_traces_count_among_the_numbers_of_an_answer(tmp_path: Path) -> None:
    with TestClient(create_app(Settings(data_dir=tmp_path, max_answer_numbers=11_000))) as small:
        call = {"targets": [planar(0.5, 0)], "method": "newton", "trace": True}
        assert small.post("/v1/robots/planar_2r/ik", json=call).status_code == 200
        refused = small.post("/v1/robots/planar_2r/ik", json={**call, "targets": [planar(0.5, 0)] * 2})
        assert (refused.status_code, refused.json()["allowed"]) == (413, 11_000)


def test_time_is_kept_within_a_single_descent(client: TestClient) -> None:
    call: dict[str, Any] = {"method": "gradient", "step_size": 1e-300, "max_iterations": 1_000_000, "time_limit": 0.2}
    started = time.monotonic()
    answer = result(client, "ur5", {"position": [0.3, 0.2, 0.3], "rpy": [0, 0, 0]}, **call)
    assert is_within(time.monotonic() - started, 2.0)
    assert (answer["status"], answer["stop_reason"]) == ("not_converged", "time_limit")
    assert "time limit" in answer["reason"]


def test_no_damping_at_all_is_the_pseudo_inverse(client: TestClient) -> None:
    target = {"position": [0.3, 0.2, 0], "rpy": [0, 0, 0]}
    answer = result(client, "planar_2r", target, method="damped_least_squares", damping=0.0)
    assert answer["status"] != "solved"
    assert result(client, "planar_2r", planar(1.2, 0.3), method="damped_least_squares", damping=0.0, task=["x", "y"])


def test_all_solutions_of_a_decoupled_arm(client: TestClient) -> None:
    q = [0.3, 0.6, 0.7, 0.2, 0.9, -0.5]
    (pose,) = poses(client, "anthropomorphic_wrist", np.array([q]))
    answer = result(client, "anthropomorphic_wrist", pose, solutions="all", seeds=[q])
    assert (len(answer["solutions"]), answer["complete"]) == (8, True)
    assert answer["solutions"][0]["joint_positions"] == pytest.approx(q, abs=1e-9)
    distances = [np.linalg.norm(np.subtract(entry["joint_positions"], q)) for entry in answer["solutions"]]
    assert distances == sorted(distances)
    (again,) = ik(client, "ur5", targets=poses(client, "ur5", within("ur5", 1)), solutions="all")["results"]
    wound = ik(
        client,
        "ur5",
        targets=poses(client, "ur5", within("ur5", 1)),
        solutions="all",
        windings=True,
        max_solutions=10_000,
    )["results"][0]
    # UR joints turn twice round, but for the elbow: two positions each.
    assert len(wound["solutions"]) == 32 * len(again["solutions"])


def test_a_redundant_arm_gives_a_sample_and_follows_an_objective(client: TestClient) -> None:
    q = within("panda", 1)
    (pose,) = poses(client, "panda", q)
    sample = result(client, "panda", pose, solutions="all", max_solutions=20, seeds=q.tolist())
    assert (len(sample["solutions"]), sample["complete"]) == (20, False)
    assert sample["solutions"][0]["joint_positions"] == pytest.approx(q[0].tolist(), abs=1e-5)
    chain = robot("panda").chain(None, None)
    middle = 0.5 * (chain.lower + chain.upper)
    plain = np.array(result(client, "panda", pose)["solutions"][0]["joint_positions"])
    centred = np.array(result(client, "panda", pose, objective="mid_range")["solutions"][0]["joint_positions"])
    spans = chain.upper - chain.lower
    assert np.linalg.norm((centred - middle) / spans) <= np.linalg.norm((plain - middle) / spans) + 1e-9
    near = result(client, "panda", pose, objective="posture", posture=q[0].tolist(), seeds=q.tolist())
    assert near["solutions"][0]["joint_positions"] == pytest.approx(q[0].tolist(), abs=1e-5)


@pytest.mark.parametrize(
    ("call", "pointer", "mention"),
    [
        ({"targets": [planar(0.5, 0)], "method": "analytic"}, "#/method", "closed form"),
        ({"targets": [planar(0.5, 0)], "task": []}, "#/task", "at least 1"),
        ({"targets": [planar(0.5, 0)], "task": ["x", "x"]}, "#/task", "may appear only once"),
        ({"targets": [planar(0.5, 0)], "task": ["x", "roll"]}, "#/task/1", "'rz'"),
        ({"targets": [planar(0.5, 0)], "seeds": [[0.0] * 7] * 2}, "#/seeds", "one each"),
        ({"targets": [planar(0.5, 0)], "seeds": []}, "#/seeds", "one each"),
        ({"targets": [planar(0.5, 0)], "seeds": [[0.0] * 6]}, "#/seeds/0", "7"),
        ({"targets": [planar(0.5, 0)], "posture": [0.0] * 3, "objective": "posture"}, "#/posture", "7"),
        ({"targets": [planar(0.5, 0)], "solutions": "all", "trace": True}, "#/solutions", "trace"),
        ({"targets": [planar(0.5, 0)], "solutions": "all", "method": "newton"}, "#/solutions", "auto"),
        ({"targets": [planar(0.5, 0)], "method": "newton", "objective": "limits"}, "#/objective", "auto"),
        ({"targets": [planar(0.5, 0)], "windings": True}, "#/windings", "all"),
        (
            {"targets": [planar(0.5, 0)], "windings": True, "solutions": "all", "respect_limits": False},
            "#/windings",
            "limits",
        ),
        ({"targets": [planar(0.5, 0)], "posture": [0.0] * 7}, "#/posture", "objective"),
        ({"targets": [planar(0.5, 0)], "step_size": 0.1}, "#/step_size", "gradient"),
        ({"targets": [planar(0.5, 0)], "damping": 0.1, "method": "newton"}, "#/damping", "damped"),
        ({"targets": [planar(0.5, 0)], "position_tolerance": 0.0}, "#/position_tolerance", "0.000000000001"),
        ({"targets": [planar(0.5, 0)], "max_iterations": 0}, "#/max_iterations", "1"),
        ({"targets": [planar(0.5, 0)], "time_limit": 1e9}, "#/time_limit", "60"),
        ({"targets": [planar(0.5, 0)], "random_seed": -1}, "#/random_seed", "0"),
        ({"targets": [{"position": [0, 0, 0]}]}, "#/targets/0", "orientation"),
        (
            {"targets": [planar(0, 0), {"position": [0, 0, 0], "quaternion_xyzw": [0, 0, 0, 0]}]},
            "#/targets/1",
            "length",
        ),
        ({"targets": [{"matrix": np.diag([1.0, 1.0, -1.0, 1.0]).tolist()}]}, "#/targets/0", "reflection"),
        ({}, "#/targets", "required"),
    ],
)
def test_what_cannot_be_asked(client: TestClient, call: dict[str, Any], pointer: str, mention: str) -> None:
    problem = refused(client, **call)
    assert mention in problem["detail"]
    assert problem.get("pointer", problem.get("errors", [{}])[0].get("pointer")) == pointer


def test_too_many_targets_for_a_method_in_steps(client: TestClient) -> None:
    problem = refused(client, status=413, targets=[planar(0.5, 0)] * 1001, method="newton")
    assert "1000" in problem["detail"]


@pytest.mark.parametrize(
    ("array", "mention"),
    [
        (np.zeros((3, 6)), "(N, 7)"),
        (np.zeros(7), "(N, 7)"),
        (np.zeros(()), "single number"),
        (np.zeros((2, 3, 3)), "(N, 7)"),
        (np.array([[0.0, 0, 0, 0, 0, 0, 2.0]]), "length"),
        (np.array([[0.0, 0, 0, 0, 0, 0, 1.0], [np.nan, 0, 0, 0, 0, 0, 1.0]]), "entry 1"),
        (np.array([[1e300, 0, 0, 0, 0, 0, 1.0]]), "magnitude"),
        (np.diag([1.0, 1.0, -1.0, 1.0])[None], "not a rotation"),
        (np.diag([1.0, 1.0, 1.001, 1.0])[None], "not a rotation"),
        (np.full((1, 4, 4), 0.5), "last row"),
    ],
)
def test_arrays_that_are_no_targets(client: TestClient, array: Array, mention: str) -> None:
    answer = client.post("/v1/robots/panda/ik", content=npy(array), headers={"content-type": NPY})
    assert answer.status_code == 422, answer.text
    assert mention in answer.json()["detail"]


def test_a_matrix_that_is_nearly_a_rotation_is_projected(client: TestClient) -> None:
    (pose,) = poses(client, "ur5", within("ur5", 1))
    T = np.array(pose["matrix"])
    rough = T.copy()
    rough[:3, :3] += 2e-7 * np.random.default_rng(1).uniform(-1, 1, (3, 3))
    answer = client.post("/v1/robots/ur5/ik", content=npy(rough[None]), headers={"content-type": NPY}).json()
    by_json = ik(client, "ur5", targets=[{"matrix": rough.tolist()}])
    np.testing.assert_allclose(positions(answer), positions(by_json), atol=1e-9)


def test_callers_never_wait_for_a_compilation(client: TestClient) -> None:
    """Another signature would be one; other tests of the same process may have caused some before."""
    compiled: list[Any] = [
        kernels._search, quick._searched, restarts._follow, task.task_errors, judge.accept, branches.thin_out,
        configuration._beyond, branch_kernels._branches, branch_kernels._elbow_angles,
    ]  # fmt: skip
    before = [len(kernel.signatures) for kernel in compiled]
    assert min(before) >= 1
    ik(client, targets=[planar(0.5, 0), planar(5, 0)])
    ik(client, targets=[planar(0.5, 0)], solutions="all", seeds=[[0.1] * 7])
    array = npy(np.tile([0.4, 0, 0.4, *IDENTITY], (300, 1)))
    client.post("/v1/robots/panda/ik", content=array, headers={"content-type": NPY})
    for solutions in ("one", "all"):
        ik(client, "ur5", targets=poses(client, "ur5", within("ur5", 3)), solutions=solutions, seeds=[[0.1] * 6] * 3)
    client.post("/v1/robots/ur5/ik", content=array, headers={"content-type": NPY})
    assert [len(kernel.signatures) for kernel in compiled] == before


@pytest.mark.parametrize("name", ["panda", "ur5"])
def test_many_results_are_encoded_as_few_are(client: TestClient, name: str) -> None:
    """Many at once are encoded by columns, few one by one: by search and by a closed form, some out of reach."""
    chain = robot(name).chain(None, None)
    qs = np.random.default_rng(3).uniform(np.maximum(chain.lower, -3.0), np.minimum(chain.upper, 3.0), (80, len(chain)))
    poses = client.post(f"/v1/robots/{name}/fk", json={"joint_positions": qs.tolist()}).json()["poses"]
    for i in (0, 40, 41, 79):
        poses[i]["position"][0] += 9.0

    def results(targets: list[Any]) -> list[Any]:
        found: list[Any] = client.post(f"/v1/robots/{name}/ik", json={"targets": targets}).json()["results"]
        return found

    assert results(poses) == [one for i in range(0, 80, 40) for one in results(poses[i : i + 40])]
