"""Worked solutions of inverse kinematics: only where they are requested, and one for each target."""

from typing import Any

import pytest
from starlette.testclient import TestClient

from tests.http.test_inverse import ik, refused
from tests.http.test_kinematics import NPY

PLANAR: dict[str, Any] = {"targets": [{"position": [0.9, 0.8, 0.0], "rpy": [0, 0, 0]}], "task": ["x", "y"]}


def test_steps_come_only_where_they_are_requested(client: TestClient) -> None:
    (without,) = ik(client, "planar_2r", **PLANAR)["results"]
    (worked,) = ik(client, "planar_2r", **PLANAR, steps=True)["results"]
    assert "steps" not in without or without["steps"] is None
    assert worked.pop("steps")
    assert worked == {name: value for name, value in without.items() if name != "steps"}


@pytest.mark.parametrize("method", ["auto", "newton"])
def test_each_target_has_its_own_steps(client: TestClient, method: str) -> None:
    targets = PLANAR["targets"] * 3
    results = ik(client, "planar_2r", **{**PLANAR, "targets": targets}, method=method, steps=True)["results"]
    assert all(result["steps"] for result in results)


def test_a_table_holds_no_steps(client: TestClient) -> None:
    answer = client.post("/v1/robots/planar_2r/ik", json={**PLANAR, "steps": True}, headers={"accept": NPY})
    assert answer.status_code == 422


def test_few_targets_can_be_worked_out_in_one_call(client: TestClient) -> None:
    problem = refused(client, "planar_2r", status=413, **{**PLANAR, "targets": PLANAR["targets"] * 1001}, steps=True)
    assert "worked out step by step" in problem["detail"]
