"""A robot that is replaced or removed while others ask for it: each has its answer, or is told that it is not there."""

import threading
from pathlib import Path
from typing import Any

import pytest
from starlette.testclient import TestClient

from tests.http.conftest import ready_client

ROUNDS = 12


@pytest.fixture
def own(tmp_path: Path) -> Any:
    yield from ready_client(tmp_path)


def arm(height: float) -> dict[str, Any]:
    row = {"type": "revolute", "a": 1.0, "alpha": 0.0, "d": height, "theta": 0.0}
    return {"dh": {"convention": "standard", "joints": [row]}}


def heights(answer: Any) -> set[float]:
    return {pose["position"][2] for pose in answer.json()["poses"]}


@pytest.mark.slow
def test_a_robot_that_goes_meanwhile_is_the_old_one_or_unknown(own: TestClient) -> None:
    seen: dict[str, set[int]] = {}
    found: set[float] = set()
    is_over = threading.Event()
    target = {"position": [1.0, 0.0, 1.0], "quaternion_xyzw": [0.0, 0.0, 0.0, 1.0]}
    many = {"joint_positions": [[0.1]] * 2000}
    calls: dict[str, tuple[str, str, Any, dict[str, str]]] = {
        "fk": ("POST", "/fk", {"joint_positions": [[0.1]]}, {}),
        "fk of many": ("POST", "/fk", many, {}),
        "ik": ("POST", "/ik", {"targets": [target]}, {}),
        "job": ("POST", "/ik", {"targets": [target]}, {"Prefer": "respond-async"}),
        "trajectory": ("POST", "/trajectory", {"start": [0.0], "segments": [{"type": "joint", "target": [1.0]}]}, {}),
        "about": ("GET", "", None, {}),
        "urdf": ("GET", "/urdf", None, {}),
    }

    def ask(name: str) -> None:
        method, path, body, headers = calls[name]
        while not is_over.is_set():
            answer = own.request(method, f"/v1/robots/mine{path}", json=body, headers=headers)
            seen.setdefault(name, set()).add(answer.status_code)
            if answer.status_code >= 500:
                print("BODY", name, answer.text[:600])
            if name.startswith("fk") and answer.status_code == 200:
                assert len(heights(answer)) == 1  # one robot from its first configuration to its last
                found.update(heights(answer))

    askers = [threading.Thread(target=ask, args=(name,)) for name in calls]
    for asker in askers:
        asker.start()
    try:
        for height in range(ROUNDS):
            assert own.post("/v1/robots", json={"name": "mine", **arm(height)}).status_code == 201
            for change in (0.25, 0.5):
                assert own.put("/v1/robots/mine", json=arm(height + change)).status_code == 200
            assert own.delete("/v1/robots/mine").status_code == 204
    finally:
        is_over.set()
        for asker in askers:
            asker.join()
    assert set(seen) == set(calls)
    for name, statuses in seen.items():
        assert statuses <= {200, 202, 404, 429}, f"{name}: {statuses}"
    assert found <= {height + change for height in range(ROUNDS) for change in (0, 0.25, 0.5)}
