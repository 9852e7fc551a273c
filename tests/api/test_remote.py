"""Heavy requests of one client leave room for those of others; whose a request is."""

import threading
import time
from pathlib import Path
from typing import Any

import pytest
from starlette.requests import Request
from starlette.testclient import TestClient

from app.api.remote import client_of
from app.main import create_app
from app.settings import Settings

SLOW = {"targets": [{"position": [9.0, 0.0, 0.0], "rotation_vector": [0, 0, 0]}] * 2000, "solutions": "all"}


def scope(**more: Any) -> Request:
    return Request({"type": "http", "headers": [], **more})


@pytest.mark.parametrize(
    ("more", "client"),
    [
        ({"client": ("10.0.0.7", 1)}, "10.0.0.7"),
        ({"client": ("127.0.0.1", 1)}, None),
        ({"client": ("::1", 1)}, None),
        ({"client": None}, None),
        ({"client": ("127.0.0.1", 1), "gelenk.key": "lab"}, "key lab"),
        ({"client": ("10.0.0.7", 1), "gelenk.key": "lab"}, "key lab"),
    ],
)
def test_a_client_is_its_key_or_its_address(more: dict[str, Any], client: str | None) -> None:
    assert client_of(scope(**more)) == client


def test_a_client_with_its_share_at_work_is_told_so(tmp_path: Path) -> None:
    settings = Settings(data_dir=tmp_path, client_requests=1, crew_processes=2)
    answers: list[Any] = []
    with TestClient(create_app(settings), client=("10.0.0.7", 50000)) as one:
        slow = threading.Thread(
            target=lambda: answers.append(one.post("/v1/robots/panda/ik", json={**SLOW, "time_limit": 3.0}))
        )
        slow.start()
        until = time.monotonic() + 60
        while not one.app.state.crew.busy:  # type: ignore[attr-defined]
            assert time.monotonic() < until
            time.sleep(0.01)
        refused = one.post("/v1/robots/panda/ik", json={**SLOW, "time_limit": 0.1})
        assert refused.status_code == 429, refused.text
        assert refused.json()["type"] == "urn:gelenk:too-many-requests"
        assert int(refused.headers["retry-after"]) >= 1
        assert one.get("/healthz").status_code == 200
        slow.join(60)
        assert answers[0].status_code == 200
        assert one.post("/v1/robots/panda/ik", json={**SLOW, "time_limit": 0.1}).status_code == 200
