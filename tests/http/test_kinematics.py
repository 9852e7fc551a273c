"""Forward kinematics and Jacobians over HTTP: formats, batches, npy, frames, limits, certificates."""

from io import BytesIO
from typing import Any

import numpy as np
import numpy.typing as npt
import pytest
from scipy.spatial.transform import Rotation
from starlette.testclient import TestClient

from gelenk.contract.fk import ForwardAnswer
from gelenk.contract.jacobian import JacobianAnswer
from gelenk.contract.pose import ORIENTATIONS, Pose
from gelenk.kinematics.simd import kernels
from gelenk.robot import configuration

Array = npt.NDArray[np.float64]
NPY = "application/x-npy"
READY = [0.0, -0.785, 0.0, -2.356, 0.0, 1.571, 0.785]


def fk(client: TestClient, robot: str = "panda", **call: Any) -> dict[str, Any]:
    answer = client.post(f"/v1/robots/{robot}/fk", json=call)
    assert answer.status_code == 200, answer.text
    ForwardAnswer.model_validate_json(answer.content)
    return dict(answer.json())


def jacobian(client: TestClient, robot: str = "panda", **call: Any) -> dict[str, Any]:
    answer = client.post(f"/v1/robots/{robot}/jacobian", json=call)
    assert answer.status_code == 200, answer.text
    JacobianAnswer.model_validate_json(answer.content)
    return dict(answer.json())


def npy(array: npt.NDArray[Any]) -> bytes:
    buffer = BytesIO()
    np.save(buffer, array)
    return buffer.getvalue()


def refusal(client: TestClient, path: str, call: dict[str, Any], status: int) -> dict[str, Any]:
    answer = client.post(path, json=call)
    assert answer.status_code == status, answer.text
    assert answer.headers["content-type"] == "application/problem+json"
    return dict(answer.json())


def random_positions(count: int, joints: int) -> Array:
    return np.random.default_rng(7).uniform(-2.0, 2.0, (count, joints))


def test_the_planar_arm_of_the_blackboard(client: TestClient) -> None:
    q1, q2 = 0.3, 0.8
    answer = fk(client, "planar_2r", joint_positions=[[q1, q2]], pose_format="rpy")
    expected = [np.cos(q1) + 0.7 * np.cos(q1 + q2), np.sin(q1) + 0.7 * np.sin(q1 + q2), 0.0]
    assert answer["poses"][0]["position"] == pytest.approx(expected, abs=1e-15)
    assert answer["poses"][0]["rpy"] == pytest.approx([0, 0, q1 + q2], abs=1e-15)


@pytest.mark.parametrize("pose_format", [*ORIENTATIONS, "matrix"])
def test_every_format_tells_the_same_pose_and_comes_back_as_a_request(client: TestClient, pose_format: str) -> None:
    qs = random_positions(5, 7).tolist()
    expected = [np.array(pose["matrix"]) for pose in fk(client, joint_positions=qs, pose_format="matrix")["poses"]]
    for pose, T in zip(fk(client, joint_positions=qs, pose_format=pose_format)["poses"], expected, strict=True):
        assert set(pose) == ({"matrix"} if pose_format == "matrix" else {"position", pose_format})
        np.testing.assert_allclose(Pose.model_validate(pose).transform(), T, atol=1e-14)


def test_quaternions_are_scipys(client: TestClient) -> None:
    qs = random_positions(20, 7).tolist()
    matrices = [pose["rotation"] for pose in fk(client, joint_positions=qs, pose_format="rotation")["poses"]]
    ours = [pose["quaternion_xyzw"] for pose in fk(client, joint_positions=qs)["poses"]]
    theirs = Rotation.from_matrix(np.array(matrices)).as_quat(canonical=True)
    np.testing.assert_allclose(ours, theirs, atol=1e-14)


def test_by_name_is_by_order(client: TestClient) -> None:
    first = fk(client, joint_positions=[READY])
    by_name = dict(reversed(list(zip(first["joint_names"], READY, strict=True))))
    assert fk(client, joint_positions=[by_name, READY])["poses"] == first["poses"] * 2


def test_frames_on_the_chain(client: TestClient) -> None:
    answer = fk(client, joint_positions=[READY, [0.1] * 7], frames="all", pose_format="matrix")
    assert len(answer["frames"]) == 2
    names = set(answer["frames"][0])
    assert {"panda_link0", "panda_link4", "panda_link8", "panda_hand_tcp", "panda_hand"} <= names
    assert "panda_leftfinger" not in names  # moves with a joint that this chain does not have
    assert answer["frames"][1]["panda_hand_tcp"] == answer["poses"][1]
    assert answer["frames"][0]["panda_link0"]["matrix"] == np.eye(4).tolist()
    named = fk(client, joint_positions=[READY], frames=["panda_link4"], pose_format="matrix")
    assert named["frames"] == [{"panda_link4": answer["frames"][0]["panda_link4"]}]
    assert fk(client, joint_positions=[], frames=["panda_link4"])["frames"] == []


def test_the_frames_of_a_dh_robot_are_those_of_its_table(client: TestClient) -> None:
    frames = fk(client, "planar_2r", joint_positions=[[0.3, 0.8]], frames="all", pose_format="matrix")["frames"][0]
    c, s = np.cos(0.3), np.sin(0.3)
    np.testing.assert_allclose(
        frames["frame_1"]["matrix"], [[c, -s, 0, c], [s, c, 0, s], [0, 0, 1, 0], [0, 0, 0, 1]], atol=1e-15
    )
    assert {"base", "frame_0", "frame_1", "frame_2", "tool"} <= set(frames)


def test_base_and_tip_may_be_any_two_frames(client: TestClient) -> None:
    there = fk(client, "baxter", base_frame="left_gripper", tip_frame="right_gripper", joint_positions=[[0.2] * 14])
    back = fk(client, "baxter", base_frame="right_gripper", tip_frame="left_gripper", joint_positions=[[0.2] * 14])
    assert back["joint_names"] == there["joint_names"][::-1]
    T, T_back = (Pose.model_validate(answer["poses"][0]).transform() for answer in (there, back))
    np.testing.assert_allclose(T @ T_back, np.eye(4), atol=1e-14)


def test_npy_in_and_out_is_json_in_and_out(client: TestClient) -> None:
    qs = random_positions(1000, 7)
    headers = {"content-type": NPY, "accept": NPY}
    answer = client.post("/v1/robots/panda/fk?tip_frame=panda_link8", content=npy(qs), headers=headers)
    assert answer.headers["content-type"] == NPY
    array = np.load(BytesIO(answer.content))
    assert array.shape == (1000, 7)
    poses = fk(client, joint_positions=qs.tolist(), tip_frame="panda_link8")["poses"]
    np.testing.assert_array_equal(array, [pose["position"] + pose["quaternion_xyzw"] for pose in poses])
    answer = client.post("/v1/robots/panda/jacobian?reference=local", content=npy(qs[:3]), headers=headers)
    values = jacobian(client, joint_positions=qs[:3].tolist(), reference="local")["jacobians"]
    np.testing.assert_array_equal(np.load(BytesIO(answer.content)), values)
    for dtype in (">f8", "<f4", "<i8"):
        rounded = np.round(qs[:4] * 8) / 8 if dtype != "<i8" else np.round(qs[:4])
        stored = client.post("/v1/robots/panda/fk", content=npy(rounded.astype(dtype)), headers={"content-type": NPY})
        assert stored.json()["poses"] == fk(client, joint_positions=rounded.tolist())["poses"]
    fortran = client.post("/v1/robots/panda/fk", content=npy(np.asfortranarray(qs)), headers={"content-type": NPY})
    assert fortran.json()["poses"] == fk(client, joint_positions=qs.tolist())["poses"]


@pytest.mark.parametrize(
    ("pose_format", "shape"), [("matrix", (2, 4, 4)), ("rotation", (2, 4, 4)), ("rpy", (2, 6)), ("zyz", (2, 6))]
)
def test_shape_of_npy_poses(client: TestClient, pose_format: str, shape: tuple[int, ...]) -> None:
    call = {"joint_positions": [READY, READY], "pose_format": pose_format}
    answer = client.post("/v1/robots/panda/fk", json=call, headers={"accept": NPY})
    assert np.load(BytesIO(answer.content)).shape == shape


@pytest.mark.parametrize(
    "body",
    [
        b"",
        b"no array",
        npy(np.zeros((2, 7)))[:-8],
        npy(np.zeros((2, 7))) + b"\0",
        npy(np.array(["text"])),
        npy(np.zeros((2, 7), dtype=complex)),
        npy(np.zeros((2, 6))),
        npy(np.zeros(7)),
        npy(np.full((1, 7), np.nan)),
        npy(np.full((1, 7), 1e9)),
        npy(np.zeros((2, 7))).replace(b"(2, 7)", b"(9**9)"),
        npy(np.zeros((2, 7))).replace(b"(2, 7), ", b"(2, -7),"),
        npy(np.zeros((2, 7))).replace(b"'<f8'", b"'|O8'"),
        npy(np.zeros((2, 0))).replace(b"(2, 0), }" + b" " * 20, b"(9223372036854775808, 0), }  "),
        npy(np.zeros((2, 7))).replace(b"(2, 7)", b"(2, 7 "),
    ],
)
def test_bad_arrays_are_refused(client: TestClient, body: bytes) -> None:
    answer = client.post("/v1/robots/panda/fk", content=body, headers={"content-type": NPY})
    assert answer.status_code == 422
    assert answer.headers["content-type"] == "application/problem+json"


def test_unknown_query_parameters_of_an_npy_call_are_refused(client: TestClient) -> None:
    answer = client.post("/v1/robots/panda/fk?tip=x", content=npy(np.zeros((1, 7))), headers={"content-type": NPY})
    assert answer.status_code == 422
    assert "tip" in answer.json()["detail"]


def test_options_of_an_npy_call_are_those_of_json(client: TestClient) -> None:
    qs = random_positions(2, 7)
    headers = {"content-type": NPY}
    query = "frames=panda_link3&frames=panda_link4&pose_format=rpy&respect_limits=false"
    answer = client.post(f"/v1/robots/panda/fk?{query}", content=npy(qs), headers=headers)
    frames = ["panda_link3", "panda_link4"]
    assert answer.json() == fk(client, joint_positions=qs.tolist(), frames=frames, pose_format="rpy")
    query = "derivatives=hessian&representation=rpy&rank_tolerance=1e-6"
    answer = client.post(f"/v1/robots/panda/jacobian?{query}", content=npy(qs), headers=headers)
    call = {"joint_positions": qs.tolist(), "derivatives": ["hessian"], "representation": "rpy", "rank_tolerance": 1e-6}
    assert answer.json() == jacobian(client, "panda", **call)
    query = "derivatives=time_variation"
    answer = client.post(f"/v1/robots/panda/jacobian?{query}", content=npy(qs), headers=headers)
    assert (answer.status_code, answer.json()["field"]) == (422, "joint_velocities")
    many = "&".join(f"key{i}=1" for i in range(3000))
    assert client.post(f"/v1/robots/panda/fk?{many}", content=npy(qs), headers=headers).status_code == 413
    repeated = "&".join(["frames=panda_link3"] * 600 + ["frames=panda_link4"])
    answer = client.post(f"/v1/robots/panda/fk?{repeated}", content=npy(qs), headers=headers)
    assert set(answer.json()["frames"][0]) == {"panda_link3", "panda_link4"}
    answer = client.post("/v1/robots/panda/fk?pose_format=rpy", json={"joint_positions": [READY]})
    assert (answer.status_code, answer.json()["field"]) == (422, "query")


@pytest.mark.parametrize("query", ["frames=all&frames=panda_link4", "frames=panda_link4&frames=all"])
def test_all_frames_and_one_of_them_are_refused_in_any_order(client: TestClient, query: str) -> None:
    answer = client.post(f"/v1/robots/panda/fk?{query}", content=npy(np.zeros((1, 7))), headers={"Content-Type": NPY})
    assert (answer.status_code, answer.json()["type"]) == (404, "urn:gelenk:unknown-frame")


def test_json_and_npy_run_the_same_compiled_code(client: TestClient) -> None:
    """A second signature would be a compilation while somebody waits."""
    fk(client, joint_positions=[READY])
    client.post("/v1/robots/panda/fk", content=npy(np.zeros((2, 7))), headers={"content-type": NPY})
    compiled: list[Any] = [kernels.chain_poses, kernels.chain_jacobians, configuration._beyond]
    assert [len(kernel.signatures) for kernel in compiled] == [1, 1, 1]


def test_a_chain_without_joints_has_a_bounded_answer(client: TestClient) -> None:
    call: dict[str, Any] = {"tip_frame": "panda_link0", "joint_positions": [[]] * 3}
    assert fk(client, "panda", **call)["poses"][0]["position"] == [0, 0, 0]
    assert jacobian(client, "panda", **call)["jacobians"] == [[[]] * 6] * 3
    path, headers = "/v1/robots/panda/jacobian?tip_frame=panda_link0", {"content-type": NPY}
    refused = client.post(path, content=npy(np.zeros((3_000_000, 0))), headers=headers)
    assert refused.status_code in {413, 422}


def test_frames_do_not_fit_into_one_array(client: TestClient) -> None:
    call = {"joint_positions": [READY], "frames": "all"}
    answer = client.post("/v1/robots/panda/fk", json=call, headers={"accept": NPY})
    assert answer.status_code == 422
    assert "array" in answer.json()["detail"]


def test_jacobian_of_the_planar_arm(client: TestClient) -> None:
    answer = jacobian(client, "planar_2r", joint_positions=[[0.3, 0.8]])
    expected = np.zeros((6, 2))
    expected[:2] = [[-0.919365358704, -0.623845152043], [1.272853774124, 0.317517284998]]
    expected[5] = 1.0
    np.testing.assert_allclose(answer["jacobians"][0], expected, atol=5e-13)
    assert answer["ranks"] == [2]
    sigmas = np.linalg.svd(expected, compute_uv=False)
    assert answer["condition_numbers"][0] == pytest.approx(sigmas[0] / sigmas[1], rel=1e-9)


def test_condition_of_the_ur5_is_the_courses(client: TestClient) -> None:
    answer = jacobian(client, "ur5_dh", joint_positions=[[0.1, -1.2, 1.4, -0.7, 0.5, 0.3]])
    assert answer["condition_numbers"][0] == pytest.approx(12.135952466, abs=1e-9)


def test_a_singular_configuration_has_no_condition_number(client: TestClient) -> None:
    answer = jacobian(client, "ur5_dh", joint_positions=[[0.1, -1.2, 1.4, -0.7, 0.0, 0.3]])
    assert answer["ranks"] == [5]
    assert answer["condition_numbers"] == [None]
    expected = [2.073079224, 1.450502321, 0.545464331, 0.489296516, 0.247862652, 0.0]
    assert answer["singular_values"][0] == pytest.approx(expected, abs=1e-9)


def test_derivatives_on_request(client: TestClient) -> None:
    q, q_dot = [0.3, 0.8], [0.5, -0.4]
    derivatives = ["time_variation", "hessian"]
    answer = jacobian(client, "planar_2r", joint_positions=[q], joint_velocities=[q_dot], derivatives=derivatives)
    hessian = np.array(answer["hessians"][0])
    np.testing.assert_allclose(hessian @ q_dot, answer["time_variations"][0], atol=1e-15)
    # Of the blackboard: p = (cos q1 + 0.7 cos(q1 + q2), …), so ∂²p/∂q2² = -0.7 (cos(q1 + q2), sin(q1 + q2)).
    np.testing.assert_allclose(hessian[:2, 1, 1], [-0.7 * np.cos(1.1), -0.7 * np.sin(1.1)], atol=1e-15)
    assert "hessians" not in jacobian(client, "planar_2r", joint_positions=[q])


def test_certificates_are_measured(client: TestClient) -> None:
    few = fk(client, joint_positions=[READY] * 3)["certificate"]
    many = fk(client, joint_positions=random_positions(500, 7).tolist())["certificate"]
    assert few["samples"] == 3
    assert 3 < many["samples"] < 500
    assert 0.0 < many["max_position_error"] < 1e-14
    assert jacobian(client, joint_positions=[READY])["certificate"]["max_error"] < 1e-14


@pytest.mark.parametrize("operation", ["fk", "jacobian"])
def test_what_is_wrong_with_a_configuration_is_said(client: TestClient, operation: str) -> None:
    path = f"/v1/robots/panda/{operation}"
    wrong = refusal(client, path, {"joint_positions": [READY, [0.0] * 6]}, 422)
    assert wrong["expected"][0] == "panda_joint1"
    assert (wrong["given"], wrong["index"], len(wrong["expected"])) == (6, 1, 7)
    missing = refusal(client, path, {"joint_positions": [{"panda_joint1": 0.0}]}, 422)
    assert missing["joint"] == "panda_joint2"
    names = [f"panda_joint{i}" for i in range(1, 8)]
    finger = {**dict.fromkeys(names, 0.0), "panda_finger_joint1": 0.01}
    assert client.post(path, json={"joint_positions": [finger]}).status_code == 200  # of the robot, not of the chain
    stranger = {**dict.fromkeys(names, 0.0), "nose": 1.0}
    assert refusal(client, path, {"joint_positions": [stranger]}, 422)["joint"] == "nose"
    assert "1e+06" in refusal(client, path, {"joint_positions": [[1e7] * 7]}, 422)["detail"]
    flat = refusal(client, path, {"joint_positions": READY}, 422)
    assert flat["errors"][0]["pointer"] == "#/joint_positions/0"
    limits = refusal(client, path, {"joint_positions": [[3.0] * 7], "respect_limits": True}, 422)
    assert (limits["joint"], limits["upper"]) == ("panda_joint1", 2.8973)


def test_names_that_do_not_exist_are_404_with_those_that_do(client: TestClient) -> None:
    call = {"joint_positions": [READY]}
    assert "panda" in refusal(client, "/v1/robots/pandaa/fk", call, 404)["close"]
    for extra in ({"tip_frame": "nose"}, {"base_frame": "nose"}, {"frames": ["nose"]}):
        problem = refusal(client, "/v1/robots/panda/fk", {**call, **extra}, 404)
        assert problem["frame"] == "nose"
        assert "panda_link8" in problem["known"]


def test_a_frame_that_other_joints_move_is_refused_with_their_names(client: TestClient) -> None:
    call = {"joint_positions": [READY], "frames": ["panda_leftfinger"]}
    assert refusal(client, "/v1/robots/panda/fk", call, 422)["missing_joints"] == ["panda_finger_joint1"]


def test_euler_rates_do_not_exist_where_the_angles_degenerate(client: TestClient) -> None:
    call = {"joint_positions": [[0.3, 0.8]], "representation": "zyz"}
    problem = refusal(client, "/v1/robots/planar_2r/jacobian", call, 422)
    assert problem["type"] == "urn:gelenk:representation-singularity"
    call = {"joint_positions": [READY], "representation": "zyz", "reference": "local"}
    assert "local_world_aligned" in refusal(client, "/v1/robots/panda/jacobian", call, 422)["detail"]


def test_a_time_variation_needs_velocities(client: TestClient) -> None:
    call = {"joint_positions": [READY], "derivatives": ["time_variation"]}
    assert "joint_velocities" in refusal(client, "/v1/robots/panda/jacobian", call, 422)["detail"]
    call["joint_velocities"] = [READY, READY]
    assert "2 entries" in refusal(client, "/v1/robots/panda/jacobian", call, 422)["detail"]


@pytest.mark.slow
def test_an_answer_beyond_the_limit_is_refused_before_it_is_computed(client: TestClient) -> None:
    call = {"joint_positions": [[0.0] * 7] * 150_000, "frames": "all"}
    problem = refusal(client, "/v1/robots/panda/fk", call, 413)
    assert problem["given"] > problem["allowed"]
