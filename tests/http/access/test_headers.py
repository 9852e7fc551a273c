"""Every answer carries the same strict headers and the id of its request; a page keeps the policy it has."""

from pathlib import Path

import pytest
from starlette.testclient import TestClient
from starlette.websockets import WebSocketDisconnect

from gelenk.http import pages
from gelenk.http.access.middleware import COMMON
from tests.http.access.asking import HOST, application, ask, bearer, keys_for

ENTRIES, KEYS = keys_for("read")
APP = application(api_keys=ENTRIES)
OWN_POLICIES = {"/", "/studio/index.html", "/docs", "/v1/robots/panda/urdf"}
ANSWERS = [
    ("GET", "/v1/robots", 200),
    ("GET", "/v1/robots/panda/urdf", 200),
    ("GET", "/v1/robots/nobody", 404),
    ("GET", "/nothing", 404),
    ("PATCH", "/v1/robots", 405),
    ("POST", "/v1/robots/panda/fk", 415),
    ("POST", "/v1/robots/nobody/fk", 415),
    ("DELETE", "/v1/robots/panda", 403),
    ("GET", "/healthz", 200),
    ("GET", "/readyz", 503),
    ("GET", "/", 200),
    ("GET", "/studio/index.html", 200),
    ("GET", "/studio/none.js", 404),
    ("GET", "/docs", 200),
    ("GET", "/documentation/own/redoc.js", 200),
    ("GET", "/openapi.json", 200),
]


@pytest.mark.quick(2)
@pytest.mark.parametrize(("method", "path", "status"), ANSWERS, ids=[f"{m} {p}" for m, p, _ in ANSWERS])
def test_every_answer_carries_them_once(method: str, path: str, status: int) -> None:
    answer = ask(APP, path, method, (HOST, bearer(KEYS["read"])))
    assert answer.status == status
    for name, value in COMMON:
        (found,) = answer.all(name.decode())
        assert found == value.decode() or (name == b"content-security-policy" and path in OWN_POLICIES)
    assert answer.all("set-cookie") == []
    assert len(answer.all("x-request-id")) == 1


@pytest.mark.parametrize(
    ("headers", "status"),
    [((HOST,), 401), ((HOST, bearer("gelenk.x")), 401), (((b"host", b"page.example"),), 421), ((), 400)],
)
def test_refusals_carry_them_too(headers: tuple[tuple[bytes, bytes], ...], status: int) -> None:
    answer = ask(APP, "/v1/robots", headers=headers)
    assert answer.status == status
    assert [answer.header(name.decode()) for name, _ in COMMON] == [value.decode() for _, value in COMMON]
    assert answer.header("x-request-id") == answer.problem["request_id"]


def test_pages_keep_their_own_policies() -> None:
    assert ask(APP, "/").header("content-security-policy") == pages.STUDIO_POLICY
    assert "script-src 'self'" in (ask(APP, "/docs").header("content-security-policy") or "")
    urdf = ask(APP, "/v1/robots/panda/urdf", headers=(HOST, bearer(KEYS["read"])))
    assert "sandbox" in (urdf.header("content-security-policy") or "")


@pytest.mark.parametrize(
    ("origins", "named"),
    [((), "'none'"), (("http://localhost:8888", "*"), "http://localhost:8888 *")],
)
def test_only_pages_of_named_origins_may_frame_the_picture(origins: tuple[str, ...], named: str) -> None:
    app = application(frame_ancestors=origins)
    policy = ask(app, "/embed").header("content-security-policy") or ""
    assert policy == pages.STUDIO_POLICY.replace("frame-ancestors 'none'", f"frame-ancestors {named}")
    assert ask(app, "/").header("content-security-policy") == pages.STUDIO_POLICY


def test_an_unexpected_error_carries_them(tmp_path: Path, monkeypatch: pytest.MonkeyPatch) -> None:
    def fail(*_: object) -> None:
        raise RuntimeError("boom")

    monkeypatch.setattr("gelenk.http.workers.pool_client.PoolClient.answer", fail)
    with TestClient(application(data_dir=tmp_path), raise_server_exceptions=False) as client:
        answer = client.get("/v1/robots/panda")
    assert answer.status_code == 500
    assert answer.headers["x-request-id"] == answer.json()["request_id"]
    assert "boom" not in answer.text
    assert all(answer.headers[name.decode()] == value.decode() for name, value in COMMON)


@pytest.mark.parametrize("given", [b"a", b"4f1c-0.B_z", b"x" * 64])
def test_a_callers_id_is_kept(given: bytes) -> None:
    answer = ask(APP, "/nothing", headers=(HOST, (b"x-request-id", given)))
    assert answer.header("x-request-id") == answer.problem["request_id"] == given.decode()


@pytest.mark.parametrize("given", [b"", b" ", b"a b", b"x" * 65, b"a\nb", b"\x1b[2J", b"\xff", b"a,b", b'"', b"a\n"])
def test_an_ill_formed_id_is_replaced(given: bytes) -> None:
    one, other = (ask(APP, "/nothing", headers=(HOST, (b"x-request-id", given))) for _ in range(2))
    assert one.header("x-request-id") == one.problem["request_id"]
    assert len(one.problem["request_id"]) == 32
    assert one.problem["request_id"] != other.problem["request_id"]


def test_sockets_of_another_kind_are_closed(tmp_path: Path) -> None:
    with (
        TestClient(application(data_dir=tmp_path)) as client,
        pytest.raises(WebSocketDisconnect) as caught,
        client.websocket_connect("/v1/robots"),
    ):
        pass
    assert caught.value.code == 1008
