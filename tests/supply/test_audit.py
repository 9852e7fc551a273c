"""The audit by pip-audit itself, against an advisory service of our own: found, not found, nobody there."""

import json
import threading
from collections.abc import Iterator
from contextlib import contextmanager
from http.server import BaseHTTPRequestHandler, HTTPServer
from pathlib import Path
from typing import Any

import pytest

from supply import audit
from tests.test_serve import free_port

ADVISORY = {
    "id": "PYSEC-2099-1",
    "summary": "An example.",
    "affected": [
        {
            "package": {"name": "idna", "ecosystem": "PyPI"},
            "ranges": [{"type": "ECOSYSTEM", "events": [{"introduced": "0"}, {"fixed": "99.1"}]}],
        }
    ],
}


@contextmanager
def advisories(*known: str) -> Iterator[str]:
    """Speaks the protocol of OSV: an advisory for each of these packages."""

    class Handler(BaseHTTPRequestHandler):
        def do_POST(self) -> None:
            asked = json.loads(self.rfile.read(int(self.headers["Content-Length"])))
            found = {"vulns": [ADVISORY]} if asked["package"]["name"] in known else {}
            body = json.dumps(found).encode()
            self.send_response(200)
            self.send_header("Content-Length", str(len(body)))
            self.end_headers()
            self.wfile.write(body)

        def log_message(self, *_: Any) -> None:
            pass

    with HTTPServer(("127.0.0.1", 0), Handler) as server:
        threading.Thread(target=server.serve_forever, daemon=True).start()
        try:
            yield f"http://127.0.0.1:{server.server_port}/v1/query"
        finally:
            server.shutdown()


@pytest.fixture
def lock(tmp_path: Path) -> Path:
    file = tmp_path / "lock"
    file.write_text("".join(f"{name}==1.0 --hash=sha256:{'0' * 64}\n" for name in ("idna", "click")))
    return file


def run(monkeypatch: pytest.MonkeyPatch, lock: Path, url: str, *arguments: str) -> None:
    service = ["--vulnerability-service", "osv", "--osv-url", url, "--timeout", "5"]
    monkeypatch.setattr("sys.argv", ["audit", "--lock", str(lock), *arguments, *service])
    audit.main()


def test_nothing_known(monkeypatch: pytest.MonkeyPatch, capsys: pytest.CaptureFixture[str], lock: Path) -> None:
    with advisories() as url:
        run(monkeypatch, lock, url)
    assert capsys.readouterr().out == "2 packages without known vulnerabilities\n"


@pytest.mark.parametrize("arguments", [[], ["--if-reachable"]])
def test_a_vulnerability_fails_with_the_version_that_mends_it(
    monkeypatch: pytest.MonkeyPatch, capsys: pytest.CaptureFixture[str], lock: Path, arguments: list[str]
) -> None:
    with advisories("idna") as url, pytest.raises(SystemExit, match="there are known vulnerabilities"):
        run(monkeypatch, lock, url, *arguments)
    assert capsys.readouterr().out == "idna 1.0: PYSEC-2099-1, fixed in 99.1\n"


def test_nobody_there_is_said_and_fails_unless_told_otherwise(
    monkeypatch: pytest.MonkeyPatch, capsys: pytest.CaptureFixture[str], lock: Path
) -> None:
    url = f"http://127.0.0.1:{free_port()}/v1/query"
    with pytest.raises(SystemExit, match="NOT AUDITED"):
        run(monkeypatch, lock, url)
    run(monkeypatch, lock, url, "--if-reachable")
    assert capsys.readouterr().out.startswith("NOT AUDITED")


def test_who_knows_no_package_has_audited_nothing(
    monkeypatch: pytest.MonkeyPatch, capsys: pytest.CaptureFixture[str], lock: Path
) -> None:
    """An index without advisories, such as a mirror, skips all of them; pip-audit itself calls that a success."""
    skipped = [{"name": name, "skip_reason": "not found"} for name in ("idna", "click")]
    monkeypatch.setattr(audit, "asked", lambda *_: skipped)
    with pytest.raises(SystemExit, match="NOT AUDITED"):
        run(monkeypatch, lock, "unused")
    monkeypatch.setattr(audit, "asked", lambda *_: [*skipped, {"name": "pin", "version": "4", "vulns": []}])
    run(monkeypatch, lock, "unused")
    assert capsys.readouterr().out == "1 packages without known vulnerabilities, 2 NOT AUDITED\n"
