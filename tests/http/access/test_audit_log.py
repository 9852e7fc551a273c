"""What is told of a request in the log, and what is kept of a write: who, what, when, from where, and the result."""

import json
import logging
import subprocess
import sys
import time
import urllib.error
import urllib.request
from concurrent.futures import ThreadPoolExecutor
from datetime import UTC, datetime
from pathlib import Path
from typing import Any
from urllib.parse import quote

import pytest
from starlette.types import Message

from gelenk.contract.endpoints import ROUTES
from gelenk.errors import StorageFailed
from gelenk.http.access.audit_log import AuditLog
from gelenk.http.access.request_context import RequestContext
from gelenk.store import folders
from gelenk.supervisor import STILL_STARTING
from tests.http.access import asking
from tests.http.access.asking import HOST, application, ask, bearer, keys_for
from tests.test_serve import get, service

ROW = {"type": "revolute", "a": 1.0, "alpha": 0.0, "d": 0.0, "theta": 0.0}
ARM = json.dumps({"name": "arm", "dh": {"convention": "standard", "joints": [ROW]}}).encode()
JSON = (b"content-type", b"application/json")


def entries(data_dir: Path) -> list[dict[str, Any]]:
    return [json.loads(line) for line in (data_dir / "audit" / "audit.jsonl").read_text().splitlines()]


def test_every_write_is_kept_with_who_what_when_from_where_and_the_result(tmp_path: Path) -> None:
    text, keys = keys_for("read", "read+write")
    app = application(data_dir=tmp_path, api_keys=text)
    anna = (HOST, JSON, bearer(keys["read+write"]), (b"x-request-id", b"anna-1"))
    before = datetime.now(UTC)
    assert ask(app, "/v1/robots", "POST", anna, ARM).status == 201
    assert ask(app, "/v1/robots/arm", "DELETE", (HOST, bearer(keys["read"]))).status == 403
    assert ask(app, "/v1/robots/arm", "DELETE", (HOST, bearer(keys["read+write"]))).status == 204
    assert ask(app, "/v1/robots/panda", "DELETE", (HOST, bearer(keys["read+write"]))).status == 403
    added, refused, *others = entries(tmp_path)
    assert before.timestamp() - 0.001 <= datetime.fromisoformat(added.pop("time")).timestamp()
    assert added == {
        "request_id": "anna-1",
        "key": "read-write",
        "client": "192.0.2.7",
        "method": "POST",
        "path": "/v1/robots",
        "operation": "add_robot",
        "status": 201,
        "location": "/v1/robots/arm",
    }
    assert (refused["key"], refused["operation"], refused["status"]) == ("read", "remove_robot", 403)
    told = [(each["key"], each["operation"], each["path"], each["status"]) for each in others]
    assert told == [
        ("read-write", "remove_robot", "/v1/robots/arm", 204),
        ("read-write", "remove_robot", "/v1/robots/panda", 403),
    ]


def test_who_is_not_let_in_and_what_only_asks_is_not_kept(tmp_path: Path) -> None:
    text, keys = keys_for("read")
    app = application(data_dir=tmp_path, api_keys=text)
    assert ask(app, "/v1/robots", "POST", (HOST, JSON), ARM).status == 401
    assert ask(app, "/v1/robots", "POST", ((b"host", b"page.example"), JSON), ARM).status == 421
    assert ask(app, "/v1/robots", "POST", (HOST, JSON, (b"origin", b"https://page.example")), ARM).status == 403
    assert ask(app, "/v1/robots", "GET", (HOST, bearer(keys["read"]))).status == 200
    assert ask(app, "/v1/course/gear", "POST", (HOST, bearer(keys["read"]))).status == 415
    assert not (tmp_path / "audit").exists()


def test_refused_writes_are_summed_up_and_push_no_line_out(tmp_path: Path) -> None:
    text, keys = keys_for("read", "read+write")
    app = application(data_dir=tmp_path, api_keys=text)
    assert ask(app, "/v1/robots", "POST", (HOST, JSON, bearer(keys["read+write"])), ARM).status == 201
    for i in range(300):
        assert ask(app, f"/v1/robots/arm-{i}", "DELETE", (HOST, bearer(keys["read"]))).status == 403
    added, first = entries(tmp_path)
    assert added["status"] == 201
    assert (first["key"], first["status"], first["refused"], first["clients"]) == ("read", 403, 1, ["192.0.2.7"])
    app.entry.audit.close()  # type: ignore[attr-defined]
    *_, rest = entries(tmp_path)
    assert (rest["key"], rest["refused"], rest["clients"]) == ("read", 299, ["192.0.2.7"])
    assert first["since"] <= rest["since"] <= rest["time"]
    assert len(entries(tmp_path)) == 3


def test_refusals_of_many_addresses_are_summed_up_within_bounds(tmp_path: Path) -> None:
    audit = AuditLog(tmp_path)
    for i in range(1000):
        exchange = written_by("anna")
        exchange.status, exchange.was_let_in = 403, False
        exchange.scope["client"] = (f"192.0.2.{i % 256}", 1)
        audit.write(exchange, None)
    audit.close()
    audit.close()
    _, rest = (json.loads(line) for line in (tmp_path / "audit.jsonl").read_text().splitlines())
    assert rest["refused"] == 999
    assert len(rest["clients"]) == 8
    assert len(json.dumps(rest)) < 1000


@pytest.mark.slow
def test_what_was_counted_is_written_in_time_also_where_nothing_more_comes(tmp_path: Path) -> None:
    audit = AuditLog(tmp_path, sum_seconds=2.0)
    for _ in range(2):
        for _ in range(20):
            exchange = written_by("anna")
            exchange.status, exchange.was_let_in = 403, False
            audit.write(exchange, None)
        until = time.monotonic() + 60.0
        while len(lines := (tmp_path / "audit.jsonl").read_text().splitlines()) % 2 and time.monotonic() < until:
            time.sleep(0.02)
    assert [json.loads(line)["refused"] for line in lines] == [1, 19, 1, 19]


def test_a_write_is_kept_before_it_is_acknowledged(tmp_path: Path, monkeypatch: pytest.MonkeyPatch) -> None:
    kept_when_answered: list[bool] = []
    original = asking.Sent.append

    def append(sent: asking.Sent, message: Message) -> None:
        kept_when_answered.append((tmp_path / "audit" / "audit.jsonl").exists())
        original(sent, message)

    monkeypatch.setattr(asking.Sent, "append", append)
    assert ask(application(data_dir=tmp_path), "/v1/robots/nobody", "DELETE").status == 404
    assert kept_when_answered == [True, True]
    assert entries(tmp_path)[0]["status"] == 404


def test_a_disk_that_refuses_does_not_refuse_the_write(
    tmp_path: Path, monkeypatch: pytest.MonkeyPatch, caplog: pytest.LogCaptureFixture
) -> None:
    def refuse(_: Path) -> None:
        raise StorageFailed("Read-only file system")

    monkeypatch.setattr(folders, "exclusive", refuse)
    with caplog.at_level(logging.ERROR):
        AuditLog(tmp_path).write(written_by("anna"), "/v1/robots/arm")
    (record,) = caplog.records
    assert "the audit log cannot be written: Read-only file system" in record.message
    assert record.facts["location"] == "/v1/robots/arm"  # type: ignore[attr-defined]


def written_by(name: str) -> RequestContext:
    scope = {"type": "http", "method": "POST", "path": "/v1/robots", "headers": [], "client": ("192.0.2.7", 1)}
    exchange = RequestContext.of(scope, ROUTES["add_robot"], None)
    exchange.key, exchange.status, exchange.was_let_in = name, 201, True
    return exchange


def test_the_audit_log_is_bounded_and_the_newest_lines_stay(tmp_path: Path) -> None:
    audit = AuditLog(tmp_path, most_bytes=2000, kept=2)
    for i in range(100):
        audit.write(written_by(f"k{i}"), None)
    files = sorted(tmp_path.glob("*.jsonl"))
    assert [file.name for file in files] == ["audit.1.jsonl", "audit.2.jsonl", "audit.jsonl"]
    assert all(file.stat().st_size <= 2000 for file in files)
    oldest_first = [tmp_path / name for name in ("audit.2.jsonl", "audit.1.jsonl", "audit.jsonl")]
    found = [json.loads(line)["key"] for file in oldest_first for line in file.read_text().splitlines()]
    assert found == [f"k{i}" for i in range(100 - len(found), 100)]
    assert (tmp_path / "audit.jsonl").stat().st_mode & 0o077 == 0


@pytest.mark.slow
def test_many_writers_lose_no_line(tmp_path: Path) -> None:
    code = """
import sys
from pathlib import Path
from gelenk.http.access.audit_log import AuditLog
from tests.http.access.test_audit_log import written_by
for i in range(50):
    AuditLog(Path(sys.argv[1]), 4000, 100).write(written_by(f"{sys.argv[2]}-{i}"), None)
"""
    with ThreadPoolExecutor(3) as pool:
        commands = [[sys.executable, "-c", code, str(tmp_path), str(n)] for n in range(3)]
        assert [run.returncode for run in pool.map(subprocess.run, commands)] == [0, 0, 0]
    found = [json.loads(line)["key"] for file in tmp_path.glob("*.jsonl") for line in file.read_text().splitlines()]
    assert sorted(found) == sorted(f"{n}-{i}" for n in range(3) for i in range(50))


@pytest.mark.quick(1)
@pytest.mark.parametrize(
    ("path", "headers", "status", "level"),
    [
        ("/healthz", (HOST,), 200, "INFO"),
        ("/v1/robots/nobody", (HOST,), 404, "INFO"),
        ("/readyz", (HOST,), 503, "INFO"),
        ("/healthz", ((b"host", b"page.example"),), 421, "WARNING"),
        ("/healthz", (), 400, "WARNING"),
    ],
)
def test_a_request_is_told_with_its_level(
    path: str, headers: Any, status: int, level: str, caplog: pytest.LogCaptureFixture
) -> None:
    with caplog.at_level(logging.INFO, "gelenk.requests"):
        answer = ask(application(), path, headers=headers)
    (record,) = [each for each in caplog.records if each.name == "gelenk.requests"]
    assert (answer.status, record.levelname) == (status, level)
    facts = record.facts  # type: ignore[attr-defined]
    assert facts["request_id"] == answer.header("x-request-id")
    assert (facts["status"], facts["path"], facts["client"]) == (status, path, "192.0.2.7")
    assert 0.0 < facts["seconds"] < 10.0


@pytest.mark.slow
def test_a_hostile_client_leaves_no_control_character_in_the_log(tmp_path: Path) -> None:
    """Over real connections, each request logged: paths, hosts, ids, keys and names with control characters."""
    nasty = "\x1b[2J\x07\x9b31m\u202e\r\nlevel"
    quoted = quote(nasty)
    with service(tmp_path, GELENK_LOG_LEVEL="info") as (run, url):
        assert get(f"{url}/v1/robots/{quoted}")[0] in {404, 422}
        assert get(f"{url}/{quoted}")[0] == 404
        assert get(f"{url}/v1/robots/{quoted}/fk", "POST", {"joint_positions": [[0]], "tip_frame": nasty})[0] == 404
        assert get(f"{url}/v1/robots", "POST", {"name": nasty, "urdf": f"<robot name='{nasty}'/>"})[0] == 422
        assert get(f"{url}/v1/jobs/{quoted}")[0] in {404, 422}
        request = urllib.request.Request(f"{url}/healthz", headers={"X-Request-Id": "\x9b31m", "Host": "\x9b.example"})
        with pytest.raises(urllib.error.HTTPError, match="400"):
            urllib.request.urlopen(request, timeout=60)
        run.terminate()
        assert run.stdout is not None
        text = run.stdout.read()
    greeting, *lines = text.splitlines()
    assert greeting.startswith("Gelenk at")
    assert all(" " <= character <= "~" or character == "\n" for character in text)
    told = [json.loads(line) for line in lines if line.startswith("{")]
    assert len([each for each in told if each["logger"] == "gelenk.requests"]) >= 6
    assert {line for line in lines if not line.startswith("{")} <= {STILL_STARTING}
    assert any("\x1b[2J" in each.get("path", "") for each in told)
