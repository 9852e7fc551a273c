"""What NumPy's users give a plain method, and what they get back."""

import collections
import gc
import json
from typing import Any

import httpx2
import numpy as np
import pytest

from gelenk.client import Client
from gelenk.client.exchange import packed, unpacked
from gelenk.client.operations import Operations
from gelenk.contract.fk import ForwardAnswer, ForwardRequest
from gelenk.contract.ik import InverseRequest
from gelenk.contract.pose import Pose
from gelenk.contract.statics import PayloadInfo, StaticsRequest
from gelenk.contract.trajectory_request import JointSegment
from gelenk.contract.velocity import NullSpace
from gelenk.errors import InvalidArray, InvalidField

QS = np.array([[0.3, 0.8], [-0.2, 0.1]])


def sent(array: Any) -> Any:
    """What the service would read."""
    return unpacked(httpx2.Response(200, content=packed(array)))


@pytest.mark.parametrize("dtype", ["<f2", "<f4", ">f8", "<i4", ">i2", "u1", "longdouble"])
def test_numbers_of_any_kind_arrive(dtype: str) -> None:
    array = (10 * QS + 3).astype(dtype)
    assert np.array_equal(sent(array), array.astype(float))
    assert np.array_equal(sent(array.T[::-1]), array.T[::-1].astype(float))
    call = Operations.jacobian.describe("arm", joint_positions=array, joint_velocities=array)
    assert json.loads(call.body)["joint_positions"] == array.astype(float).tolist()


@pytest.mark.parametrize(
    ("array", "what"),
    [
        (np.array([["a", "b"]]), "'<U1'"),
        (QS.astype(complex), "'complex128'"),
        (QS > 0.0, "'bool'"),
        (np.array([[1, None]], dtype=object), "'object'"),
        (np.ma.masked_greater(QS, 0.5), "masked entries"),
    ],
)
def test_what_holds_no_numbers_is_refused_before_it_is_sent(array: Any, what: str) -> None:
    sentence = f"the array holds {what}; allowed: integers and floats of up to 64 bits"
    as_npy: dict[str, Any] = {}
    as_json = {"joint_velocities": QS}
    for more in (as_npy, as_json):
        with pytest.raises(InvalidArray) as refused:
            Operations.jacobian.describe("arm", joint_positions=array, **more)
        assert str(refused.value) == sentence


def test_an_array_without_masked_entries_is_one_as_any_other() -> None:
    assert np.array_equal(sent(np.ma.masked_greater(QS, 9.0)), QS)


def test_what_json_has_no_word_for_is_refused_before_it_is_sent() -> None:
    bad = QS.copy()
    bad[1, 0] = np.inf
    with pytest.raises(InvalidField, match=r"'joint_velocities': the number at \[1, 0\] of the array is not finite"):
        Operations.jacobian.describe("arm", joint_positions=QS, joint_velocities=bad)
    with pytest.raises(TypeError, match="set"):
        Operations.fk.describe("arm", joint_positions=[{0.3, 0.8}])  # type: ignore[list-item]


def test_sequences_and_mappings_of_any_kind_are_sent() -> None:
    rows = [range(2), collections.deque([0.1, 0.2]), collections.ChainMap({"joint_1": 0.3}), (0.4, 0.5), QS[0]]
    call = Operations.fk.describe("arm", joint_positions=rows)
    assert json.loads(call.body) == {"joint_positions": [[0, 1], [0.1, 0.2], {"joint_1": 0.3}, [0.4, 0.5], [0.3, 0.8]]}


def test_a_request_is_made_of_arrays_too() -> None:
    Ts = np.repeat(np.eye(4)[None], 2, axis=0)
    assert ForwardRequest(joint_positions=QS) == ForwardRequest(joint_positions=QS.tolist())
    assert InverseRequest(targets=Ts, seeds=QS).targets == [Pose(matrix=T.tolist()) for T in Ts]
    twist = np.array([[1.0, 0.0, 0.0, 0.0, 0.0, 0.0]])
    statics = StaticsRequest(joint_positions=tuple(QS), wrenches=twist, payload=PayloadInfo(mass=1.0))
    assert statics.model_dump(include={"joint_positions", "wrenches"}) == {
        "joint_positions": QS.tolist(),
        "wrenches": twist.tolist(),
    }
    space = NullSpace(objective="posture", posture=QS[0])
    assert space == NullSpace(objective="posture", posture=[0.3, 0.8])
    segments = [JointSegment(type="joint", target=QS[0])]
    call = Operations.trajectory.describe("arm", start=QS[1], segments=segments)
    assert json.loads(call.body) == {
        "start": QS[1].tolist(),
        "segments": [{"type": "joint", "target": QS[0].tolist()}],
    }
    with pytest.raises(InvalidArray, match=r"targets form an array of shape \(N, 7\) or \(N, 4, 4\)"):
        InverseRequest(targets=QS)


@pytest.mark.slow
def test_poses_are_an_array_at_once(gelenk: Client) -> None:
    answer = gelenk.fk("planar_2r", joint_positions=QS)
    matrices = gelenk.arrays.fk("planar_2r", QS, pose_format="matrix")
    np.testing.assert_allclose(np.array(answer.poses), matrices, atol=1e-15)
    assert np.asarray(answer.poses[0], dtype=np.float32).dtype == np.float32
    found = gelenk.ik("planar_2r", targets=np.array(answer.poses), task=["x", "y"])
    assert {result.status for result in found.results} == {"solved"}


@pytest.mark.parametrize("is_on", [True, False])
def test_a_large_answer_is_read_without_the_collector_of_garbage(is_on: bool, monkeypatch: pytest.MonkeyPatch) -> None:
    pose = {"position": [0.1, 0.2, 0.3], "quaternion_xyzw": [0.0, 0.0, 0.0, 1.0]}
    certificate = {"samples": 1, "max_position_error": 0.0, "max_orientation_error": 0.0, "seed": 0}
    names = {"joint_names": ["a"], "base_frame": "base", "tip_frame": "tool", "certificate": certificate}
    during: list[bool] = []
    read = ForwardAnswer.model_validate_json

    def seen(*arguments: Any, **options: Any) -> ForwardAnswer:
        during.append(gc.isenabled())
        return read(*arguments, **options)

    monkeypatch.setattr(ForwardAnswer, "model_validate_json", seen)
    was = gc.isenabled()
    try:
        (gc.enable if is_on else gc.disable)()
        for count in (1, 20_000):
            answered = httpx2.MockTransport(
                lambda _, n=count: httpx2.Response(200, json={**names, "poses": [pose] * n})
            )
            with Client("http://gelenk.invalid", transport=answered) as client:
                assert len(client.fk("arm", joint_positions=[[0.1]]).poses) == count
            assert gc.isenabled() == is_on
    finally:
        (gc.enable if was else gc.disable)()
    assert during == [is_on, False]
