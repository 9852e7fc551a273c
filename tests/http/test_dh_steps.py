"""Steps of DH tables over HTTP: only where they are asked for, with the columns in the order asked for."""

from typing import Any

import pytest
from starlette.testclient import TestClient

from gelenk.contract.dh import EXAMPLE_TABLE, EXAMPLE_URDF

CALLS: dict[str, tuple[str, dict[str, Any]]] = {
    "from-urdf": ("/v1/dh/from-urdf", {"urdf": EXAMPLE_URDF, "tip_frame": "hand"}),
    "convert": ("/v1/dh/convert", {"dh": EXAMPLE_TABLE, "convention": "standard"}),
}
ORDER = ["a", "d", "alpha", "theta"]


@pytest.mark.parametrize("name", CALLS)
def test_steps_are_there_if_asked_for(client: TestClient, name: str) -> None:
    path, call = CALLS[name]
    assert client.post(path, json=call).json()["steps"] is None
    usual = client.post(path, json={**call, "steps": True}).json()["steps"]
    other = client.post(path, json={**call, "steps": True, "column_order": ORDER}).json()["steps"]
    assert [step["title"] for step in usual] == [step["title"] for step in other]
    link = "i" if name == "from-urdf" else "i-1"
    table = usual[-1 if name == "from-urdf" else 0]["latex"][0]
    assert rf"i & a_{{{link}}} & \alpha_{{{link}}} & d_{{i}} & \vartheta_{{i}}" in table
    assert r"& d_{i} & \alpha_{i} &" in other[-1]["latex"][0]


@pytest.mark.parametrize("order", [["a", "a", "d", "theta"], ["a", "d", "alpha"], ["a", "d", "alpha", "beta"]])
def test_an_order_has_each_column_once(client: TestClient, order: list[str]) -> None:
    path, call = CALLS["convert"]
    refused = client.post(path, json={**call, "steps": True, "column_order": order})
    assert refused.status_code == 422
    assert "column_order" in str(refused.json())


def test_a_robot_s_table_tells_how_its_frames_are_placed(client: TestClient) -> None:
    path = "/v1/robots/ur5/dh"
    assert client.get(path).json()["steps"] is None
    query: dict[str, Any] = {"steps": True, "column_order": ORDER}
    steps = client.get(path, params=query).json()["steps"]
    assert len(steps) == 9
    assert "d_{i} & \\alpha_{i}" in steps[-1]["latex"][0]
    assert client.get(path, params={**query, "language": "fr"}).status_code == 422
