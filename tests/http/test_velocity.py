"""Velocity kinematics over HTTP: forward and inverse, references, tasks, npy, and what is refused."""

from io import BytesIO
from typing import Any

import numpy as np
import numpy.typing as npt
import pytest
from starlette.testclient import TestClient

from gelenk.contract.velocity import VelocityAnswer

Array = npt.NDArray[np.float64]
NPY = "application/x-npy"
READY = [0.0, -0.785, 0.0, -2.356, 0.0, 1.571, 0.785]
PLANE = ["x", "y"]


def velocity(client: TestClient, robot: str = "panda", **call: Any) -> dict[str, Any]:
    answer = client.post(f"/v1/robots/{robot}/velocity", json=call)
    assert answer.status_code == 200, answer.text
    VelocityAnswer.model_validate_json(answer.content)
    return dict(answer.json())


def jacobian(client: TestClient, robot: str, **call: Any) -> Array:
    answer = client.post(f"/v1/robots/{robot}/jacobian", json=call)
    assert answer.status_code == 200, answer.text
    return np.array(answer.json()["jacobians"])


def npy(array: Array) -> bytes:
    buffer = BytesIO()
    np.save(buffer, array)
    return buffer.getvalue()


def refusal(client: TestClient, call: dict[str, Any], robot: str = "panda", status: int = 422) -> dict[str, Any]:
    answer = client.post(f"/v1/robots/{robot}/velocity", json=call)
    assert answer.status_code == status, answer.text
    assert answer.headers["content-type"] == "application/problem+json"
    return dict(answer.json())


# Forward


def test_the_motion_of_the_blackboards_arm(client: TestClient) -> None:
    answer = velocity(
        client,
        "planar_2r",
        joint_positions=[[0.3, 0.8]],
        joint_velocities=[[0.5, -0.4]],
        joint_accelerations=[[0.2, 0.9]],
        joint_jerks=[[-0.3, 0.6]],
        joint_snaps=[[0.0, 0.0]],
        task=PLANE,
    )
    assert answer["twists"][0][:2] == pytest.approx([-0.210144618535, 0.509419973063], abs=1e-12)
    assert answer["accelerations"][0][:2] == pytest.approx([-0.987343003711, 0.460217808137], abs=1e-12)
    assert answer["jerks"][0][:2] == pytest.approx([-0.452315263417, -0.605605301837], abs=1e-12)
    assert answer["snaps"][0][0] == pytest.approx(-0.542558179630, abs=1e-12)
    assert answer["results"][0]["singularity"]["singular_values"] == pytest.approx([1.693355501046, 0.296540958658])
    assert answer["certificate"]["max_snap_error"] < 1e-10
    v, w = np.split(np.array(answer["twists"][0]), 2)
    spatial = np.array(answer["accelerations"][0][:3]) - np.cross(w, v)
    assert answer["spatial_accelerations"][0][:3] == pytest.approx(spatial.tolist(), abs=1e-15)


def test_only_what_is_given_is_differentiated(client: TestClient) -> None:
    call: dict[str, Any] = {"joint_positions": [READY], "joint_velocities": [[0.1] * 7]}
    twist_alone = velocity(client, **call)
    derived = {"twists", "accelerations", "spatial_accelerations", "jerks", "snaps"}
    assert derived & set(twist_alone) == {"twists"}
    assert twist_alone["certificate"]["max_acceleration_error"] is None
    both = velocity(client, **call, joint_accelerations=[[0.0] * 7])
    assert derived & set(both) == {"twists", "accelerations", "spatial_accelerations"}


@pytest.mark.parametrize("reference", ["local_world_aligned", "local", "world"])
def test_twists_are_those_of_the_jacobian_in_every_reference(client: TestClient, reference: str) -> None:
    rng = np.random.default_rng(1)
    qs, speeds = rng.uniform(-2, 2, (3, 7)), rng.uniform(-1, 1, (3, 7))
    answer = velocity(client, joint_positions=qs.tolist(), joint_velocities=speeds.tolist(), reference=reference)
    Js = jacobian(client, "panda", joint_positions=qs.tolist(), reference=reference)
    np.testing.assert_allclose(answer["twists"], np.einsum("bki,bi->bk", Js, speeds), atol=1e-13)
    sigmas = [result["singularity"]["singular_values"] for result in answer["results"]]
    np.testing.assert_allclose(sigmas, np.linalg.svd(Js, compute_uv=False), atol=1e-12)


def test_the_jacobians_derivatives_on_request(client: TestClient) -> None:
    call: dict[str, Any] = {"joint_positions": [READY], "joint_velocities": [[0.3] * 7]}
    call["joint_accelerations"] = [[0.2] * 7]
    answer = velocity(client, **call, joint_jerks=[[0.1] * 7], jacobian_derivatives=True)
    J, J_dot, J_ddot = np.array(answer["jacobian_derivatives"][0])
    assert J.shape == (6, 7)
    np.testing.assert_allclose(J @ np.full(7, 0.2) + J_dot @ np.full(7, 0.3), answer["accelerations"][0], atol=1e-14)
    jerk = J @ np.full(7, 0.1) + 2 * J_dot @ np.full(7, 0.2) + J_ddot @ np.full(7, 0.3)
    np.testing.assert_allclose(jerk, answer["jerks"][0], atol=1e-14)


def test_speeding_joints_are_named(client: TestClient) -> None:
    answer = velocity(client, joint_positions=[READY], joint_velocities=[[0.0, -4.35, 0, 0, 0, 0, 2.6]])
    (joint,) = answer["results"][0]["velocity_limits_exceeded"]
    assert joint == {"joint": "panda_joint2", "velocity": -4.35, "limit": 2.175, "ratio": pytest.approx(2.0)}


def test_by_name_is_by_order(client: TestClient) -> None:
    names = [f"panda_joint{i}" for i in range(1, 8)]
    by_name = dict(zip(names, READY, strict=True))
    answer = velocity(client, joint_positions=[by_name], joint_velocities=[by_name])
    assert answer["twists"] == velocity(client, joint_positions=[READY], joint_velocities=[READY])["twists"]


# Inverse


@pytest.mark.parametrize(
    ("q", "options", "expected"),
    [
        ([0.3, 0.8], {"inverse": "exact"}, [0.435936662598, -0.802739372970]),
        ([0.3, 0.0], {"inverse": "damped", "damping": 0.01}, [0.128903591245, 0.053077949336]),
        ([0.3, 0.01], {"inverse": "damped", "damping": 0.01}, [0.155292411056, -0.012313177686]),
        ([0.3, 0.8], {"inverse": "damped", "damping": 0.01}, [0.400352039277, -0.717102790513]),
        ([0.3, 0.8], {"inverse": "damped"}, [0.435936662598, -0.802739372970]),
        ([0.3, 0.0], {"inverse": "pseudo_inverse"}, [0.129284962817, 0.053234984689]),
        ([0.3, 0.0], {}, [0.129284962817, 0.053234984689]),
    ],
)
def test_joint_velocities_of_the_blackboard(
    client: TestClient, q: list[float], options: dict[str, Any], expected: list[float]
) -> None:
    answer = velocity(client, "planar_2r", joint_positions=[q], twists=[[0.1, 0.3]], task=PLANE, **options)
    assert answer["joint_velocities"][0] == pytest.approx(expected, abs=1e-12)
    result = answer["results"][0]
    moved = jacobian(client, "planar_2r", joint_positions=[q])[0] @ answer["joint_velocities"][0]
    assert result["residual"] == pytest.approx((np.array([0.1, 0.3]) - moved[:2]).tolist(), abs=1e-14)
    assert result["residual_linear"] == pytest.approx(np.hypot(*result["residual"]), abs=1e-15)
    assert result["residual_angular"] == 0.0
    assert result["status"] == ("solved" if result["residual_linear"] < 1e-9 else "approximate")
    assert ("reason" in result) == (result["status"] == "approximate")


def test_where_there_is_no_inverse_there_is_a_reason(client: TestClient) -> None:
    call: dict[str, Any] = {"joint_positions": [[0.3, 0.8], [0.3, 0.0]], "twists": [[0.1, 0.3]] * 2, "task": PLANE}
    answer = velocity(client, "planar_2r", **call, inverse="exact")
    assert answer["joint_velocities"][1] is None
    regular, singular = answer["results"]
    assert (regular["status"], singular["status"]) == ("solved", "singular")
    assert "rank 1" in singular["reason"]
    assert (singular["singularity"]["singular"], regular["singularity"]["singular"]) == (True, False)
    lost = np.array(singular["singularity"]["lost_directions"])
    assert np.abs(lost) == pytest.approx(np.array([[0.955336489126, 0.295520206661]]), abs=1e-12)


def test_six_numbers_or_as_many_as_directions_count(client: TestClient) -> None:
    call: dict[str, Any] = {"joint_positions": [[0.3, 0.8]], "task": ["y", "x"]}
    short = velocity(client, "planar_2r", **call, twists=[[0.3, 0.1]])
    long = velocity(client, "planar_2r", **call, twists=[[0.1, 0.3, 9.0, 9.0, 9.0, 9.0]])
    assert short == long
    assert short["task"] == ["y", "x"]
    turned = velocity(client, "planar_2r", joint_positions=[[0.3, 0.8]], task=PLANE, twists=[[0.1, 0.3]])
    np.testing.assert_allclose(short["joint_velocities"], turned["joint_velocities"], atol=1e-14)
    six = ["rz", "y", "x", "z", "rx", "ry"]
    ordered = velocity(client, joint_positions=[READY], task=six, twists=[[0.1, 0.2, 0.3, 0.4, 0.5, 0.6]])
    plain = velocity(client, joint_positions=[READY], twists=[[0.3, 0.2, 0.4, 0.5, 0.6, 0.1]])
    np.testing.assert_allclose(ordered["joint_velocities"], plain["joint_velocities"], atol=1e-12)
    assert ordered["task"] == six


def test_rows_that_vanish_have_no_inverse_of_rounding(client: TestClient) -> None:
    """The folded arm along x: its speed along x is 2e-16 of rounding, which is nothing to divide by."""
    call: dict[str, Any] = {"joint_positions": [[np.pi, 0.0]], "twists": [[0.1]], "task": ["x"]}
    for options in ({}, {"inverse": "damped", "damping": 1e-30}, {"inverse": "damped"}):
        answer = velocity(client, "planar_2r", **call, **options)
        (result,) = answer["results"]
        assert (result["status"], result["singularity"]["rank"]) == ("approximate", 0)
        assert answer["joint_velocities"] == [[0.0, 0.0]]
        assert result["residual"] == pytest.approx([0.1])
    climbing = velocity(client, "planar_2r", **call, null_space={"objective": "manipulability"})
    assert climbing["joint_velocities"] == [[0.0, 0.0]]
    forward = velocity(client, "planar_2r", joint_positions=[[np.pi, 0.0]], joint_velocities=[[1.0, 0.0]], task=["x"])
    assert forward["results"][0]["singularity"]["rank"] == 0


@pytest.mark.parametrize("reference", ["local_world_aligned", "local", "world"])
def test_the_whole_report_is_of_the_rows_that_are_inverted(client: TestClient, reference: str) -> None:
    task = ["rx", "z", "y", "ry", "x"]
    call: dict[str, Any] = {"joint_positions": [READY], "joint_velocities": [[0.1] * 7], "singularity_reports": True}
    (result,) = velocity(client, **call, task=task, reference=reference)["results"]
    short, whole = result["singularity"], result["singularity_report"]
    assert whole["singular_values"] == pytest.approx(short["singular_values"], abs=1e-14)
    assert (whole["rank"], whole["structural_rank"]) == (short["rank"], short["structural_rank"])


def test_too_few_joints_leave_a_residual(client: TestClient) -> None:
    answer = velocity(client, "planar_2r", joint_positions=[[0.3, 0.8]], twists=[[0.1, 0.3, 0.2, 0, 0, 0]])
    result = answer["results"][0]
    assert result["status"] == "approximate"
    assert result["residual"][2] == pytest.approx(0.2)
    assert result["singularity"]["rank"] == result["singularity"]["structural_rank"] == 2
    assert not result["singularity"]["singular"]
    assert len(result["singularity"]["lost_directions"]) == 4


def test_adaptive_damping_keeps_the_limits(client: TestClient) -> None:
    call: dict[str, Any] = {"joint_positions": [READY], "twists": [[3.0, 0, 0, 0, 0, 5.0]]}
    fast = velocity(client, **call)["results"][0]
    assert fast["velocity_limits_exceeded"]
    assert (fast["status"], fast["damping"]) == ("solved", 0.0)
    slow = velocity(client, **call, inverse="damped", damping="adaptive")["results"][0]
    assert slow["velocity_limits_exceeded"] == []
    assert slow["damping"] > 0.0
    assert slow["status"] == "approximate"


def test_weights_slow_a_joint_down(client: TestClient) -> None:
    call: dict[str, Any] = {"joint_positions": [READY], "twists": [[0.1, 0, 0, 0, 0, 0.1]]}
    names = [f"panda_joint{i}" for i in range(1, 8)]
    weights = {**dict.fromkeys(names, 1.0), "panda_joint1": 1e6}
    plain = velocity(client, **call)["joint_velocities"][0]
    weighted = velocity(client, **call, weights=weights)
    assert abs(weighted["joint_velocities"][0][0]) < 1e-3 * abs(plain[0])
    assert weighted["results"][0]["status"] == "solved"


def test_the_null_space_moves_the_elbow_alone(client: TestClient) -> None:
    call: dict[str, Any] = {"joint_positions": [READY], "twists": [[0.0] * 6]}
    given = velocity(client, **call, null_space={"joint_velocities": [[1.0] + [0.0] * 6]})
    q_dot = np.array(given["joint_velocities"][0])
    assert np.abs(q_dot).max() > 0.1
    assert np.abs(jacobian(client, "panda", joint_positions=[READY])[0] @ q_dot).max() < 1e-12
    assert given["results"][0]["null_space_share"] == 1.0
    for objective in ("mid_range", "limits", "manipulability"):
        half, whole = (
            velocity(client, **call, null_space={"objective": objective, "gain": gain})["joint_velocities"][0]
            for gain in (0.5, 1.0)
        )
        np.testing.assert_allclose(np.array(whole), 2 * np.array(half), atol=1e-12)
    there = velocity(client, **call, null_space={"objective": "posture", "posture": READY})
    np.testing.assert_allclose(there["joint_velocities"], 0.0, atol=1e-12)


def test_accelerations_and_jerks_there_and_back(client: TestClient) -> None:
    names = ("joint_velocities", "joint_accelerations", "joint_jerks")
    rng = np.random.default_rng(5)
    rates = {name: rng.uniform(-1, 1, (2, 6)).tolist() for name in names}
    qs = rng.uniform(-2, 2, (2, 6)).tolist()
    forward = velocity(client, "ur5", joint_positions=qs, **rates)
    for known, (asked, given) in enumerate((("tip_accelerations", "accelerations"), ("tip_jerks", "jerks")), start=1):
        call: dict[str, Any] = {name: rates[name] for name in names[:known]}
        call |= {"joint_positions": qs, asked: forward[given], "inverse": "exact"}
        back = velocity(client, "ur5", **call)
        np.testing.assert_allclose(back[names[known]], rates[names[known]], atol=1e-10)
        assert [result["status"] for result in back["results"]] == ["solved"] * 2
    call = {"joint_positions": qs, "joint_velocities": rates["joint_velocities"]}
    still = velocity(client, "ur5", **call, tip_accelerations=[[0.0] * 6] * 2, inverse="damped", damping=0.1)
    assert still["results"][0]["residual_linear"] > 0.0


def test_whole_reports_of_singularities_on_request(client: TestClient) -> None:
    q = [0.1, -1.2, 1.4, -0.7, 0.0, 0.3]
    call: dict[str, Any] = {"joint_positions": [q], "twists": [[0.1] * 6]}
    plain, told = (velocity(client, "ur5_dh", **call, **more) for more in ({}, {"singularity_reports": True}))
    assert "singularity_report" not in plain["results"][0]
    short, report = told["results"][0]["singularity"], told["results"][0]["singularity_report"]
    assert short["singular"]
    assert (report["rank"], report["structural_rank"]) == (short["rank"], short["structural_rank"]) == (5, 6)
    assert short["condition_number"] is None
    assert short["singular_values"] == pytest.approx(report["singular_values"], abs=1e-12)
    assert np.abs(report["lost_directions"][0]["twist"]) == pytest.approx(np.abs(short["lost_directions"][0]), abs=1e-9)
    many = {"joint_positions": [q] * 1001, "joint_velocities": [q] * 1001, "singularity_reports": True}
    assert refusal(client, many, "ur5_dh", 413)["allowed"] == 1000


# npy, batches, chains


def test_npy_in_and_out_is_json_in_and_out(client: TestClient) -> None:
    stack = np.random.default_rng(3).uniform(-1, 1, (20, 3, 7))
    headers = {"content-type": NPY, "accept": NPY}
    path = "/v1/robots/panda/velocity"
    answer = velocity(
        client,
        joint_positions=stack[:, 0].tolist(),
        joint_velocities=stack[:, 1].tolist(),
        joint_accelerations=stack[:, 2].tolist(),
        reference="local",
    )
    both = np.load(BytesIO(client.post(f"{path}?reference=local", content=npy(stack), headers=headers).content))
    np.testing.assert_array_equal(both[:, 0], answer["twists"])
    np.testing.assert_array_equal(both[:, 1], answer["accelerations"])
    alone = np.load(BytesIO(client.post(f"{path}?reference=local", content=npy(stack[:, :2]), headers=headers).content))
    np.testing.assert_allclose(alone, answer["twists"], atol=1e-14)
    for wrong in (stack[:, 0], stack[:, :1], np.zeros((2, 6, 7)), stack[:, :, :6], np.full((1, 2, 7), np.nan)):
        assert client.post(path, content=npy(wrong), headers=headers).status_code == 422


def test_joint_velocities_as_npy(client: TestClient) -> None:
    call = {"joint_positions": [[0.3, 0.8], [0.3, 0.0]], "twists": [[0.1, 0.3]] * 2, "task": PLANE, "inverse": "exact"}
    answer = client.post("/v1/robots/planar_2r/velocity", json=call, headers={"accept": NPY})
    np.testing.assert_allclose(np.load(BytesIO(answer.content))[0], [0.435936662598, -0.802739372970], atol=1e-12)
    assert (answer.headers["gelenk-unsolved"], answer.headers["gelenk-unsolved-rows"]) == ("1", "1")


def test_a_batch_is_its_entries(client: TestClient) -> None:
    rng = np.random.default_rng(8)
    qs, vs = rng.uniform(-2, 2, (30, 7)).tolist(), rng.uniform(-1, 1, (30, 6)).tolist()
    many = velocity(client, joint_positions=qs, twists=vs, inverse="damped")
    for row in (0, 13, 29):
        one = velocity(client, joint_positions=[qs[row]], twists=[vs[row]], inverse="damped")
        np.testing.assert_allclose(many["joint_velocities"][row], one["joint_velocities"][0], atol=1e-9)


def test_chains_of_every_kind(client: TestClient) -> None:
    fixed = velocity(client, tip_frame="panda_link0", joint_positions=[[]], twists=[[1.0, 0, 0, 0, 0, 0]])
    assert fixed["joint_velocities"] == [[]]
    assert fixed["results"][0]["residual_linear"] == 1.0
    assert velocity(client, joint_positions=[], twists=[])["joint_velocities"] == []
    ends = {"base_frame": "left_gripper", "tip_frame": "right_gripper"}
    there = velocity(client, "baxter", **ends, joint_positions=[[0.2] * 14], twists=[[0.1] * 6])
    assert there["results"][0]["status"] == "solved"
    finger = {"base_frame": "panda_rightfinger", "tip_frame": "panda_leftfinger"}
    gap = velocity(client, "panda", **finger, joint_positions=[[0.02]], joint_velocities=[[0.1]])
    assert np.linalg.norm(gap["twists"][0][:3]) == pytest.approx(0.2)  # its follower moves as well


# What is refused


@pytest.mark.parametrize(
    ("call", "pointer"),
    [
        ({}, "#/joint_velocities"),
        ({"joint_velocities": [READY], "twists": [[0.0] * 6]}, "#/joint_velocities"),
        ({"twists": [[0.0] * 6], "tip_jerks": [[0.0] * 6]}, "#/tip_jerks"),
        ({"tip_accelerations": [[0.0] * 6]}, "#/joint_velocities"),
        ({"tip_jerks": [[0.0] * 6], "joint_velocities": [READY]}, "#/joint_accelerations"),
        (
            {"tip_accelerations": [[0.0] * 6], "joint_velocities": [READY], "joint_accelerations": [READY]},
            "#/joint_accelerations",
        ),
        ({"joint_accelerations": [READY]}, "#/joint_accelerations"),
        ({"joint_velocities": [READY], "joint_jerks": [READY]}, "#/joint_jerks"),
        ({"joint_velocities": [READY, READY]}, "#/joint_velocities"),
        ({"joint_velocities": [[0.0] * 6]}, "#/joint_velocities/0"),
        ({"joint_velocities": [[1e300] * 7]}, "#/joint_velocities"),
        ({"joint_velocities": [{"nose": 0.0}]}, "#/joint_velocities/0"),
        ({"joint_velocities": [READY], "inverse": "exact"}, "#/inverse"),
        ({"joint_velocities": [READY], "weights": [1.0] * 7}, "#/weights"),
        ({"joint_velocities": [READY], "reference": "tool"}, "#/reference"),
        ({"joint_velocities": [READY], "task": ["x", "x"]}, "#/task"),
        ({"joint_velocities": [READY], "task": []}, "#/task"),
        ({"joint_velocities": [READY], "task": ["yaw"]}, "#/task/0"),
        ({"joint_velocities": [READY], "rank_tolerance": 0.0}, "#/rank_tolerance"),
        ({"joint_velocities": [READY], "respect_limits": True, "joint_positions": [[3.0] * 7]}, "#/joint_positions/0"),
        ({"twists": [[0.0] * 5]}, "#/twists/0"),
        ({"twists": [[0.0] * 7]}, "#/twists/0"),
        ({"twists": [[]]}, "#/twists/0"),
        ({"twists": [[0.0] * 6] * 2}, "#/twists"),
        ({"twists": [[1e300] * 6]}, "#/twists/0/0"),
        ({"twists": [["0"] * 6]}, "#/twists/0/0"),
        ({"twists": [[0.0] * 6], "inverse": "transpose"}, "#/inverse"),
        ({"twists": [[0.0] * 6], "inverse": "exact"}, "#/inverse"),
        ({"twists": [[0.0] * 6], "damping": 0.1}, "#/damping"),
        ({"twists": [[0.0] * 6], "inverse": "damped", "damping": -0.1}, "#/damping"),
        ({"twists": [[0.0] * 6], "inverse": "damped", "damping": "little"}, "#/damping"),
        ({"twists": [[0.0] * 6], "inverse": "damped", "damping": 0.1, "damping_threshold": 0.1}, "#/damping_threshold"),
        ({"twists": [[0.0] * 6], "inverse": "damped", "damping_threshold": 0.0}, "#/damping_threshold"),
        ({"twists": [[0.0] * 6], "characteristic_length": 0.0}, "#/characteristic_length"),
        ({"twists": [[0.0] * 6], "weights": [1.0] * 6 + [0.0]}, "#/weights"),
        ({"twists": [[0.0] * 6], "weights": [1.0] * 6 + [-1.0]}, "#/weights"),
        ({"twists": [[0.0] * 6], "weights": [1.0] * 6 + [1e300]}, "#/weights"),
        ({"twists": [[0.0] * 6], "weights": [1.0] * 6}, "#/weights"),
        ({"twists": [[0.0] * 3], "task": ["x", "y", "z"], "inverse": "exact"}, "#/inverse"),
        ({"twists": [[0.0] * 6], "null_space": {}}, "#/null_space"),
        ({"twists": [[0.0] * 6], "null_space": {"objective": "beauty"}}, "#/null_space/objective"),
        ({"twists": [[0.0] * 6], "null_space": {"objective": "posture"}}, "#/null_space"),
        ({"twists": [[0.0] * 6], "null_space": {"objective": "limits", "gain": -1.0}}, "#/null_space/gain"),
        ({"twists": [[0.0] * 6], "null_space": {"joint_velocities": [[0.0] * 3]}}, "#/null_space/joint_velocities/0"),
        ({"twists": [[0.0] * 6], "null_space": {"joint_velocities": [READY] * 2}}, "#/null_space/joint_velocities"),
        ({"twists": [[0.0] * 6], "null_space": {"joint_accelerations": [READY]}}, "#/null_space"),
        (
            {"tip_accelerations": [[0.0] * 6], "joint_velocities": [READY], "null_space": {"objective": "limits"}},
            "#/null_space",
        ),
    ],
)
def test_what_is_no_question_is_refused_where_it_is_wrong(
    client: TestClient, call: dict[str, Any], pointer: str
) -> None:
    problem = refusal(client, {"joint_positions": [READY], **call})
    places = [error["pointer"] for error in problem.get("errors", [])] or [problem.get("pointer")]
    assert pointer in places, problem
    assert problem["detail"].isprintable()


def test_weights_and_motions_go_without_the_exact_inverse(client: TestClient) -> None:
    call = {"joint_positions": [[0.3, 0.8]], "twists": [[0.1, 0.3]], "task": PLANE, "inverse": "exact"}
    assert refusal(client, {**call, "weights": [1.0, 2.0]}, "planar_2r")["field"] == "weights"
    motion = {"null_space": {"joint_velocities": [[1.0, 0.0]]}}
    assert refusal(client, {**call, **motion}, "planar_2r")["field"] == "null_space"


def test_the_largest_numbers_give_numbers(client: TestClient) -> None:
    """At singular configurations too; an answer is valid JSON only where all its numbers are finite."""
    stretched = [0.0] * 7
    for extra in ({}, {"inverse": "damped"}, {"inverse": "damped", "damping": 0.0}, {"rank_tolerance": 1e-15}):
        twists = [[1e6] * 6, [-1e6] * 6]
        velocity(client, joint_positions=[stretched, [1e6] * 7], twists=twists, **extra)
    for size in (1e6, 1e-300):
        rates = [[size] * 7, [-size] * 7]
        call: dict[str, Any] = {"joint_velocities": rates, "joint_accelerations": rates, "joint_jerks": rates}
        velocity(client, joint_positions=[stretched, [1e6] * 7], **call, joint_snaps=rates)


def test_an_answer_beyond_the_limit_is_refused(client: TestClient) -> None:
    qs = np.zeros((200_000, 2, 7))
    path, headers = "/v1/robots/panda/velocity?jacobian_derivatives=true", {"content-type": NPY}
    answer = client.post(path, content=npy(qs), headers=headers)
    assert answer.status_code == 413
    assert answer.json()["given"] > answer.json()["allowed"]


@pytest.mark.parametrize("joint", [2.8973, 2.8973 - 1e-6, -2.8973, -3.3973])
def test_keeping_away_from_the_limits_stays_bounded_at_them(client: TestClient, joint: float) -> None:
    call: dict[str, Any] = {
        "joint_positions": [[joint, *READY[1:]]],
        "twists": [[0.1, 0.0, 0.0]],
        "task": ["x", "y", "z"],
    }
    null_space = {"objective": "limits", "gain": 0.5}
    answer = velocity(client, **call, null_space=null_space)
    assert np.abs(answer["joint_velocities"]).max() < 100.0
    assert answer["results"][0]["status"] == "solved"


def test_a_residual_of_rounding_is_not_blamed_on_the_arm(client: TestClient) -> None:
    call: dict[str, Any] = {
        "joint_positions": [[0.3, 1e-9]],
        "twists": [[0.1, 0.3]],
        "task": ["x", "y"],
        "inverse": "pseudo_inverse",
    }
    result = velocity(client, "planar_2r", **call)["results"][0]
    assert result["status"] == "approximate"
    assert "rounding" in result["reason"]
