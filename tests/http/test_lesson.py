"""What the pool finds out of a robot once, the event loop knows from then on, and answers by itself."""

from collections.abc import Iterator
from pathlib import Path
from typing import Any

import pytest
from starlette.testclient import TestClient

from gelenk.errors import ServiceBusy
from gelenk.pool.pool import WorkerPool
from tests.http.conftest import ready_client

UR5 = [0.1, -1.2, 1.4, -0.6, 0.5, 0.2]
TARGET = {"position": [0.4, 0.2, 0.5], "rpy": [3.0, 0.1, 0.2]}


@pytest.fixture
def fresh_client(tmp_path: Path) -> Iterator[TestClient]:
    """Of a service that has not been asked for anything."""
    yield from ready_client(tmp_path)


@pytest.mark.quick(1)
@pytest.mark.parametrize(
    ("path", "content"),
    [
        ("ur5/ik", {"targets": [TARGET]}),
        ("panda/ik", {"targets": [TARGET]}),
        ("ur5/statics", {"joint_positions": [UR5], "gravity": True}),
        ("ur5/dynamics", {"joint_positions": [UR5]}),
    ],
)
def test_the_crew_is_needed_once(
    fresh_client: TestClient, monkeypatch: pytest.MonkeyPatch, path: str, content: dict[str, Any]
) -> None:
    first = fresh_client.post(f"/v1/robots/{path}", json=content)
    assert first.status_code == 200, first.text

    async def run(*_: object) -> None:
        raise ServiceBusy(1)

    monkeypatch.setattr(WorkerPool, "run", run)
    again = fresh_client.post(f"/v1/robots/{path}", json=content)
    assert (again.status_code, again.json()) == (200, first.json())
    robot, name = path.split("/")
    other_chain = {**content, "tip_frame": {"ur5": "wrist_2_link", "panda": "panda_link5"}[robot]}
    refused = fresh_client.post(f"/v1/robots/{robot}/{name}", json=other_chain)
    assert refused.status_code == 503, refused.text
