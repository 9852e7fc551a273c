"""Closed forms over HTTP: branches and their names, what a singularity leaves free, the elbow's angle, refusals."""

from io import BytesIO
from typing import Any

import numpy as np
import pytest
from starlette.testclient import TestClient

from tests.http.test_inverse import ik, poses, positions, refused, result, within
from tests.http.test_kinematics import NPY, Array, npy
from tests.ik import six_joint_arms
from tests.robots import robot

SEVEN = "simple_humanoid"
NAMES = {
    "ur5": "three parallel axes",
    "z1": "three parallel axes",
    "kinova": "spherical wrist",
    "puma560": "spherical wrist",
    "stanford": "spherical wrist",
    "talos_left_arm": "spherical wrist",
    "centauro": "spherical shoulder",
    SEVEN: "spherical shoulder and wrist",
}


def table(entry: dict[str, Any]) -> Array:
    """All solutions of one target."""
    return np.array([solution["joint_positions"] for solution in entry["solutions"]])


def same_turn(differences: Array) -> Array:
    return np.asarray(differences - 2.0 * np.pi * np.rint(differences / (2.0 * np.pi)))


def holds(qs: Array, q: Array, close: float = 1e-7) -> bool:
    return bool((np.abs(same_turn(qs - q)).max(axis=1) < close).any())


def reached(client: TestClient, name: str, qs: Array) -> Array:
    """Poses by forward kinematics."""
    return np.array([pose["matrix"] for pose in poses(client, name, qs)])


@pytest.mark.quick(3)
@pytest.mark.parametrize("name", NAMES)
def test_one_solution_by_closed_form(client: TestClient, name: str) -> None:
    qs = within(name, 30)
    targets = poses(client, name, qs)
    answer = ik(client, name, targets=targets, method="analytic")
    assert answer["closed_form"] == NAMES[name]
    for entry in answer["results"]:
        assert entry["status"] == "solved"
        (solution,) = entry["solutions"]
        assert solution["method"] == "analytic"
        assert solution["iterations"] == 0
        assert solution["branch"]
        assert set(solution["branch"]) <= {"shoulder", "elbow", "wrist", "arm"}
        assert "free_joints" not in solution or solution["free_joints"] is None
        assert max(solution["position_error"], solution["orientation_error"]) < 1e-10
    expected = np.array([target["matrix"] for target in targets])
    assert np.abs(reached(client, name, positions(answer)) - expected).max() < 1e-10
    if name != SEVEN:
        assert positions(ik(client, name, targets=targets)).tolist() == positions(answer).tolist()


@pytest.mark.quick(1)
@pytest.mark.parametrize("name", [name for name in NAMES if name != SEVEN])
def test_all_branches_each_with_a_name_of_its_own(client: TestClient, name: str) -> None:
    qs = within(name, 20)
    targets = poses(client, name, qs)
    answer = ik(client, name, targets=targets, method="analytic", solutions="all")
    chain = robot(name).chain(None, None)
    slides = chain.flat.joints[:, 0] == 1
    for q, target, entry in zip(qs, targets, answer["results"], strict=True):
        assert entry["complete"] is True
        found = table(entry)
        assert holds(np.where(slides, found - q, same_turn(found - q)), np.zeros(len(q)))
        named = [tuple(sorted(solution["branch"].items())) for solution in entry["solutions"]]
        assert len(set(named)) == len(named)
        assert ((found >= chain.lower - 1e-9) & (found <= chain.upper + 1e-9)).all()
        assert np.abs(reached(client, name, found) - np.array(target["matrix"])).max() < 1e-10
        # Nearest to the seed first, which is the middle of the ranges.
        both = np.isfinite(chain.lower) & np.isfinite(chain.upper)
        seed = np.where(both, 0.5 * (np.where(both, chain.lower, 0) + np.where(both, chain.upper, 0)), 0.0)
        assert (np.diff(np.linalg.norm(found - seed, axis=1)) >= -1e-9).all()
    whole = ik(client, name, targets=targets, solutions="all")
    assert [len(entry["solutions"]) for entry in whole["results"]] == [
        len(entry["solutions"]) for entry in answer["results"]
    ]


def test_the_eight_of_the_ur5(client: TestClient) -> None:
    q = np.array([[0.1, -1.2, 1.4, -0.7, 0.5, 0.3]])
    entry = result(client, "ur5_dh", poses(client, "ur5_dh", q)[0], method="analytic", solutions="all")
    assert len(entry["solutions"]) == 8
    named = {tuple(sorted(solution["branch"].items())) for solution in entry["solutions"]}
    assert named == {
        (("elbow", elbow), ("shoulder", shoulder), ("wrist", wrist))
        for elbow in ("up", "down")
        for shoulder in ("front", "back")
        for wrist in ("flip", "no_flip")
    }


@pytest.mark.parametrize("method", ["analytic", "auto"])
def test_every_full_turn_within_the_limits(client: TestClient, method: str) -> None:
    q = np.array([[0.1, -1.2, 1.4, -0.7, 0.5, 0.3]])
    target = poses(client, "ur5", q)[0]
    chain = robot("ur5").chain(None, None)
    plain = table(result(client, "ur5", target, method=method, solutions="all"))
    entry = result(client, "ur5", target, method=method, solutions="all", windings=True, max_solutions=1000)
    found = table(entry)
    turns = [np.floor((chain.upper - p) / (2 * np.pi)) - np.ceil((chain.lower - p) / (2 * np.pi)) + 1 for p in plain]
    assert len(found) == sum(int(np.prod(count)) for count in turns)
    assert entry["complete"] is True
    assert all(holds(plain, row) for row in found)
    assert len(np.unique(np.round(found, 7), axis=0)) == len(found)
    few = result(client, "ur5", target, method=method, solutions="all", windings=True, max_solutions=5)
    assert len(few["solutions"]) == 5
    assert few["complete"] is False


@pytest.mark.parametrize(("name", "free"), [("puma560", 3), ("anthropomorphic_wrist", 3), ("ur5_dh", 5)])
def test_a_straight_wrist_names_its_free_joint(client: TestClient, name: str, free: int) -> None:
    q = within(name, 1, seed=8)
    chain = robot(name).chain(None, None)
    if name == "ur5_dh":
        q[0] = [0.4, -1.3, 0.8, -0.5, 0.0, -0.7]
    q[0, 4] = 0.0
    seed = q[0].copy()
    seed[free] += 0.1
    target = poses(client, name, q)[0]
    entry = result(client, name, target, method="analytic", seeds=[seed.tolist()])
    (solution,) = entry["solutions"]
    assert solution["free_joints"] == [chain.joint_names[free]]
    assert abs(solution["joint_positions"][free] - seed[free]) < 1e-9
    assert np.abs(reached(client, name, table(entry))[0] - np.array(target["matrix"])).max() < 1e-9
    every = result(client, name, target, method="analytic", solutions="all", seeds=[seed.tolist()])
    assert every["complete"] is False
    sampled = result(client, name, target, solutions="all", seeds=[seed.tolist()])
    assert sampled["complete"] is False
    # A search takes samples of the continuum.
    assert len(sampled["solutions"]) > len(every["solutions"])
    assert np.abs(reached(client, name, table(sampled)) - np.array(target["matrix"])).max() < 3e-6


def test_the_elbow_is_put_where_it_is_asked_to_be(client: TestClient) -> None:
    q = within(SEVEN, 1, seed=5)
    target = poses(client, SEVEN, q)[0]
    (own,) = result(client, SEVEN, target, method="analytic", seeds=q.tolist())["solutions"]
    np.testing.assert_allclose(own["joint_positions"], q[0], atol=1e-7)
    call: dict[str, Any] = {"method": "analytic", "respect_limits": False}
    # The shoulder and the wrist stay where they are, and the elbow goes round.
    for angle in own["elbow_angle"] + np.array([0.0, 0.4, 2.0, -2.5]):
        entry = result(client, SEVEN, target, elbow_angle=float(angle), solutions="all", **call)
        assert entry["complete"] is True
        assert len(entry["solutions"]) in {2, 4, 8}
        for solution in entry["solutions"]:
            assert abs(same_turn(np.array(solution["elbow_angle"] - angle))) < 1e-9
            assert solution["branch"].keys() == {"shoulder", "elbow", "wrist"}
        assert np.abs(reached(client, SEVEN, table(entry)) - np.array(target["matrix"])).max() < 1e-10
        one = result(client, SEVEN, target, elbow_angle=float(angle), **call)
        assert one["solutions"][0]["joint_positions"] == pytest.approx(entry["solutions"][0]["joint_positions"])
    whole = result(client, SEVEN, target, solutions="all", **call)
    assert whole["complete"] is False
    assert len(whole["solutions"]) > 50


def test_an_elbow_that_the_limits_do_not_allow(client: TestClient) -> None:
    q = within(SEVEN, 1, seed=5)
    target = poses(client, SEVEN, q)[0]
    verdicts = set()
    for angle in np.linspace(-3.0, 3.0, 13):
        entry = result(client, SEVEN, target, method="analytic", elbow_angle=float(angle))
        verdicts.add(entry["status"])
        if entry["status"] != "solved":
            assert "elbow" in entry["reason"]
            assert entry["nearest"]
    assert verdicts == {"solved", "outside_limits"}
    # Left to itself it goes where the limits let it.
    seed = q[0] + 0.5
    assert result(client, SEVEN, target, method="analytic", seeds=[seed.tolist()])["status"] == "solved"


def test_limits_that_no_branch_keeps(client: TestClient) -> None:
    chain = robot("go2").chain(None, None)
    q = 0.5 * (chain.lower + chain.upper)
    # A knee straighter than it goes.
    q[2] = chain.upper[2] + 0.3
    target = poses(client, "go2", q[None])[0]
    entry = result(client, "go2", target, method="analytic")
    assert entry["status"] == "outside_limits"
    assert entry["solutions"] == []
    assert chain.joint_names[2] in {joint["name"] for joint in entry["blocking_joints"]}
    loose = result(client, "go2", target, method="analytic", respect_limits=False, solutions="all")
    assert holds(table(loose), q)


def test_what_is_out_of_reach(client: TestClient) -> None:
    far = {"position": [3.0, 0.0, 0.0], "quaternion_xyzw": [0.0, 0.0, 0.0, 1.0]}
    for solutions in ("one", "all"):
        entry = result(client, "ur5", far, method="analytic", solutions=solutions)
        assert entry["status"] == "unreachable"
        assert entry["nearest"]["position_error"] > 1.5


@pytest.mark.parametrize("name", ["panda", "tiago", "baxter", "xarm7"])
def test_an_arm_without_closed_form_is_refused(client: TestClient, name: str) -> None:
    targets = poses(client, name, within(name, 1))
    for solutions in ("one", "all"):
        problem = refused(client, name, targets=targets, method="analytic", solutions=solutions)
        assert "closed form" in problem["detail"]
        assert problem["pointer"] == "#/method"
    assert ik(client, name, targets=targets)["closed_form"] is None


@pytest.mark.slow
@pytest.mark.parametrize("name", ["crx 0", "jaco 2, 60 degrees", "gen3 lite", "axes 1 2 3 parallel, 0"])
def test_six_joints_without_a_closed_form_are_solved_by_continuation(client: TestClient, name: str) -> None:
    arm = six_joint_arms.arm(name)
    numbers = ("a", "alpha", "d", "theta")
    joints = [{"type": "revolute", **dict(zip(numbers, row, strict=True))} for row in arm.table.rows]
    stored = {"name": "counted", "dh": {"convention": "standard", "joints": joints}}
    assert client.post("/v1/robots", json=stored).status_code == 201
    qs = arm.configurations(4, seed=3)
    call = {"targets": [{"matrix": arm.table.pose(q).tolist()} for q in qs], "respect_limits": False}
    one = ik(client, "counted", seeds=qs.tolist(), method="analytic", **call)
    np.testing.assert_allclose(positions(one), qs, atol=1e-9)
    every = ik(client, "counted", method="analytic", solutions="all", **call)
    assert every["results"] == ik(client, "counted", solutions="all", **call)["results"]
    for answer in (one, every):
        assert answer["closed_form"] == "six joints, by continuation"
        assert {s["method"] for entry in answer["results"] for s in entry["solutions"]} == {"continuation"}
    for q, entry in zip(qs, every["results"], strict=True):
        assert entry["complete"]
        assert holds(table(entry), q)
    assert client.delete("/v1/robots/counted").status_code == 204


@pytest.mark.parametrize(
    ("call", "pointer"),
    [
        ({"task": ["x", "y", "z"]}, "#/method"),
        ({"trace": True}, "#/trace"),
        ({"objective": "posture"}, "#/objective"),
        ({"elbow_angle": 0.3}, "#/elbow_angle"),
        ({"elbow_angle": 0.3, "method": "auto"}, "#/elbow_angle"),
        ({"step_size": 0.3}, "#/step_size"),
    ],
)
def test_what_does_not_go_with_a_closed_form(client: TestClient, call: dict[str, Any], pointer: str) -> None:
    targets = poses(client, "ur5", within("ur5", 1))
    problem = refused(client, "ur5", **{"targets": targets, "method": "analytic", **call})
    assert problem["pointer"] == pointer


def test_two_links_in_the_plane(client: TestClient) -> None:
    target = {"position": [0.9, 0.8, 0.0], "quaternion_xyzw": [0.0, 0.0, 0.0, 1.0]}
    call: dict[str, Any] = {"method": "analytic", "solutions": "all", "task": ["x", "y"]}
    entry = result(client, "planar_2r", target, **call)
    found = table(entry)
    expected = [[0.106585970938, 1.599371644064], [1.346698710425, -1.599371644064]]
    assert len(found) == 2
    assert all(holds(found, np.array(q), close=1e-11) for q in expected)
    assert {solution["branch"]["elbow"] for solution in entry["solutions"]} == {"up", "down"}


@pytest.mark.parametrize(
    ("name", "task", "count"),
    [
        ("planar_3r", ["x", "y", "rz"], 2),
        ("anthropomorphic", ["x", "y", "z"], 4),
        ("scara", ["x", "y", "z", "rz"], 2),
        ("spherical_wrist", ["rx", "ry", "rz"], 2),
    ],
)
def test_parts_of_a_pose(client: TestClient, name: str, task: list[str], count: int) -> None:
    qs = within(name, 20, seed=4)
    targets = poses(client, name, qs)
    call: dict[str, Any] = {"method": "analytic", "task": task, "respect_limits": False}
    answer = ik(client, name, targets=targets, solutions="all", **call)
    assert answer["task"] == task
    slides = robot(name).chain(None, None).flat.joints[:, 0] == 1
    full = 0
    for q, target, entry in zip(qs, targets, answer["results"], strict=True):
        found = table(entry)
        assert holds(np.where(slides, found - q, same_turn(found - q)), np.zeros(len(q)))
        full += len(found) == count
        assert len(found) <= count
        positions_reached = reached(client, name, found)[:, :3, 3]
        if "x" in task:
            assert (
                np.abs(positions_reached - np.array(target["matrix"])[:3, 3])[:, : 3 if "z" in task else 2].max()
                < 1e-10
            )
        else:
            assert np.abs(reached(client, name, found)[:, :3, :3] - np.array(target["matrix"])[:3, :3]).max() < 1e-10
    assert full >= 10
    one = ik(client, name, targets=targets, **call)
    assert [len(entry["solutions"]) for entry in one["results"]] == [1] * 20


def test_arrays_in_and_out(client: TestClient) -> None:
    qs = within("ur5", 300)
    targets = poses(client, "ur5", qs)
    matrices = np.array([target["matrix"] for target in targets])
    matrices[11, :3, 3] = [0.0, 4.0, 0.0]
    targets[11]["matrix"] = matrices[11].tolist()
    path = "/v1/robots/ur5/ik?method=analytic"
    answer = client.post(path, content=npy(matrices), headers={"content-type": NPY, "accept": NPY})
    assert answer.headers["gelenk-unsolved"] == "1"
    assert answer.headers["gelenk-unsolved-rows"] == "11"
    rows = np.load(BytesIO(answer.content))
    listed = ik(client, "ur5", targets=targets, method="analytic")
    for i, entry in enumerate(listed["results"]):
        if i == 11:
            assert entry["status"] == "unreachable"
        else:
            np.testing.assert_allclose(rows[i], entry["solutions"][0]["joint_positions"], atol=1e-12)
    assert np.abs(np.delete(reached(client, "ur5", rows) - matrices, 11, axis=0)).max() < 1e-10


def test_an_answer_does_not_depend_on_the_batch(client: TestClient) -> None:
    targets = poses(client, "puma560", within("puma560", 2500))
    whole = ik(client, "puma560", targets=targets, method="analytic")
    for i in (0, 1023, 1024, 2499):
        assert result(client, "puma560", targets[i], method="analytic") == whole["results"][i]


def test_seeds_far_away(client: TestClient) -> None:
    qs = within("ur5", 10)
    chain = robot("ur5").chain(None, None)
    targets = poses(client, "ur5", qs)
    seeds = np.random.default_rng(2).uniform(-100.0, 100.0, (10, 6))
    answer = ik(client, "ur5", targets=targets, seeds=seeds.tolist(), method="analytic")
    found = positions(answer)
    assert ((found >= chain.lower) & (found <= chain.upper)).all()
    own = positions(ik(client, "ur5", targets=targets, seeds=qs.tolist(), method="analytic"))
    np.testing.assert_allclose(own, qs, atol=1e-7)
