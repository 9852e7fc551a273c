"""Batches of joint motions over HTTP: as JSON and npy, what is refused, and as a job."""

from io import BytesIO
from typing import Any

import numpy as np
import pytest
from starlette.testclient import TestClient

from gelenk.contract.trajectories import COLUMNS, MAX_MOTIONS, MotionsAnswer
from tests.http.test_long_calls import same

JSON, NPY = "application/json", "application/x-npy"
START, TARGETS = [0.0, -0.4], [[0.5, 0.2], [-1.0, 0.8], [0.0, -0.4]]
URL = "/v1/robots/planar_2r/trajectories"


def packed(rows: Any) -> bytes:
    target = BytesIO()
    np.save(target, np.array(rows, dtype=float))
    return target.getvalue()


def test_each_result_is_that_of_a_trajectory(client: TestClient) -> None:
    answer = client.post(URL, json={"starts": [START], "targets": TARGETS, "law": "quintic"})
    assert answer.status_code == 200, answer.text
    MotionsAnswer.model_validate_json(answer.content)
    for target, result in zip(TARGETS[:2], answer.json()["results"], strict=False):
        move = {"start": START, "segments": [{"type": "joint", "target": target}], "law": "quintic"}
        single = client.post("/v1/robots/planar_2r/trajectory", json=move).json()
        assert result["duration"] == pytest.approx(single["duration"], rel=1e-12)
        for name in ("velocity", "acceleration", "jerk"):
            assert result[f"{name}_ratio"] == pytest.approx(single["audit"][name]["ratio"], rel=1e-12)
        for name, peak in single["audit"]["tip"].items():
            assert result[f"tip_{name}"] == pytest.approx(peak["value"], rel=1e-8)
    assert answer.json()["results"][2]["duration"] == 0.0


def test_the_array_has_the_fields_of_the_results(client: TestClient) -> None:
    call = {"starts": [START] * 3, "targets": TARGETS, "law": "jerk_limited"}
    results = client.post(URL, json=call).json()["results"]
    ends = packed([[START, target] for target in TARGETS])
    answer = client.post(
        URL, content=ends, headers={"content-type": NPY, "accept": NPY}, params={"law": "jerk_limited"}
    )
    rows = np.load(BytesIO(answer.content))
    wanted = [[np.nan if one[name] is None else float(one[name]) for name in COLUMNS] for one in results]
    np.testing.assert_array_equal(rows, wanted)


@pytest.mark.parametrize(
    ("changes", "pointer", "reason"),
    [
        ({"starts": [START] * 2}, "#/starts", "2 entries for 3 targets: give one each, or one for all"),
        ({"starts": None}, "#/starts", "is missing"),
        ({"starts": [[0.0]]}, "#/starts", "2"),
        ({"targets": [[0.0, 0.0, 0.0]]}, "#/targets", "2"),
        ({"limits": {"joint_torque": 5.0}}, "#/limits/joint_torque", "is of a single `trajectory`"),
        ({"law": "linear"}, "#/law", "trapezoidal"),
    ],
)
def test_what_is_wrong_is_named(client: TestClient, changes: dict[str, Any], pointer: str, reason: str) -> None:
    call = {
        key: value for key, value in ({"starts": [START], "targets": TARGETS} | changes).items() if value is not None
    }
    answer = client.post(URL, json=call)
    assert answer.status_code == 422
    assert pointer.removeprefix("#/").split("/")[-1] in answer.text
    assert reason in answer.text


@pytest.mark.parametrize("shape", [(3, 2), (3, 3, 2), (3, 2, 3), (3, 2, 2, 1)])
def test_an_array_of_another_shape_is_refused(client: TestClient, shape: tuple[int, ...]) -> None:
    answer = client.post(URL, content=packed(np.zeros(shape)), headers={"content-type": NPY})
    assert answer.status_code == 422
    assert "2" in answer.json()["detail"]


def test_too_many_are_for_a_job(client: TestClient) -> None:
    ends = packed(np.zeros((MAX_MOTIONS + 1, 2, 2)))
    answer = client.post(URL, content=ends, headers={"content-type": NPY, "accept": JSON})
    assert answer.status_code in {413, 422}
    assert f"{MAX_MOTIONS}" in answer.text.replace(",", "")


def test_a_job_answers_with_the_same_bytes(client: TestClient) -> None:
    same(client, URL, (JSON, NPY), json={"starts": [START], "targets": [*TARGETS, [9.0, 0.0]], "law": "septic"})
