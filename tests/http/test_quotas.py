"""What a client may keep: told by its key, durable, the same for all processes; and the list of what is kept."""

import os
import re
import time
from collections.abc import Callable, Iterator
from contextlib import contextmanager
from pathlib import Path
from typing import Any

import pytest
from starlette.testclient import TestClient

from gelenk.contract.endpoint import Scope
from gelenk.http.access.keyring import new_key
from gelenk.main import create_app
from gelenk.settings import Settings
from gelenk.store.library import Library, RobotUpload
from tests.corpus.zips import URDF, zipped

CATALOGUE = Path("robots")
KEYS = {name: new_key(name, tuple(Scope)) for name in ("anna", "ben")}
Started = Callable[..., TestClient]


@contextmanager
def served(data_dir: Path, **more: Any) -> Iterator[TestClient]:
    with TestClient(create_app(Settings(data_dir=data_dir, **more)), raise_server_exceptions=False) as client:
        deadline = time.monotonic() + 120
        while client.get("/readyz").status_code != 200:
            assert time.monotonic() < deadline, "the service does not get ready"
            time.sleep(0.05)
        yield client


def urdf(height: float = 0.0) -> str:
    return URDF.replace("0 0 1", f"0 0 {height}", 1)


def status(client: TestClient, method: str, name: str, key: str | None, height: float = 0.0) -> int:
    headers = {} if key is None else {"Authorization": f"Bearer {KEYS[key][0]}"}
    path = "/v1/robots" if method == "POST" else f"/v1/robots/{name}"
    body = None if method == "DELETE" else {"urdf": urdf(height)} | ({"name": name} if method == "POST" else {})
    answer = client.request(method, path, json=body, headers=headers)
    if answer.status_code == 413:
        problem = answer.json()
        assert problem["type"] == "urn:gelenk:quota-exceeded"
        assert problem["used"] + problem["more"] > problem["allowed"]
        assert all(str(problem[fact]) in problem["detail"] for fact in ("client", "what", "used", "more", "allowed"))
        assert re.search("DELETE.*GELENK_CLIENT_ROBOTS", problem["detail"])
    return answer.status_code


@pytest.mark.slow
def test_each_key_has_its_own_room_and_a_restart_forgets_nothing(tmp_path: Path) -> None:
    (tmp_path / "robots" / "by_hand").mkdir(parents=True)
    (tmp_path / "robots" / "by_hand" / "r.urdf").write_text(urdf())
    settings: dict[str, Any] = {
        "api_keys": " ".join(key.entry() for _, key in KEYS.values()),
        "client_robots": 2,
    }
    with served(tmp_path, **settings) as client:
        assert [status(client, "POST", f"anna{n}", "anna") for n in range(3)] == [201, 201, 413]
        assert status(client, "POST", "anna0", "anna") == 200  # it is there, and takes no more room
        assert status(client, "PUT", "anna0", "anna", 2) == 200
        assert [status(client, "POST", f"ben{n}", "ben") for n in range(3)] == [201, 201, 413]
        assert status(client, "PUT", "anna0", "ben") == 413  # it would be ben's then
    with served(tmp_path, **settings) as client:
        assert status(client, "POST", "anna2", "anna") == 413
        assert status(client, "DELETE", "anna0", "ben") == 204
        assert status(client, "POST", "anna2", "anna") == 201
        assert status(client, "PUT", "by_hand", "ben") == 413
        assert not (tmp_path / "robots" / "anna3").exists()


@pytest.mark.slow
def test_without_keys_all_share_one_room_of_robots_and_bytes(tmp_path: Path) -> None:
    size = len(urdf().encode())
    with served(tmp_path, client_robots=3, client_robot_bytes=2 * size + 100) as client:
        assert [status(client, "POST", f"r{n}", None) for n in range(3)] == [201, 201, 413]
        form = {"name": "zip"}, {"archive": ("r.zip", zipped({"arm.urdf": urdf(), "meshes/arm.stl": b"x" * 200}))}
        assert status(client, "DELETE", "r1", None) == 204
        assert client.post("/v1/robots", data=form[0], files=form[1]).status_code == 413
        assert status(client, "POST", "r1", None) == 201


def names(client: TestClient) -> set[str]:
    return {robot["name"] for robot in client.get("/v1/robots").json()["robots"] if robot["source"] == "uploaded"}


@pytest.mark.slow
def test_the_list_is_that_of_the_folder_whoever_changes_it(tmp_path: Path) -> None:
    """Another process, of which a second library has the part, and the list's own, with the list kept between."""
    other = Library(CATALOGUE, tmp_path / "robots")

    def settled() -> set[str]:
        """The list once it has been kept."""
        if other.uploads.exists():
            long_ago = time.time() - 60
            os.utime(other.uploads, (long_ago, long_ago))
        return names(client) | names(client)

    with served(tmp_path) as client:
        assert settled() == set()
        other.add(RobotUpload("a", "urdf", urdf().encode()))
        assert names(client) == {"a"} == settled()
        assert status(client, "POST", "b", None) == 201
        assert names(client) == {"a", "b"} == settled()
        other.replace(RobotUpload("b", "urdf", urdf().encode(), description="another"))
        told = client.get("/v1/robots").json()["robots"]
        assert [robot["description"] for robot in told if robot["name"] == "b"] == ["another"]
        assert settled() == {"a", "b"}
        other.remove("a")
        assert names(client) == {"b"}
