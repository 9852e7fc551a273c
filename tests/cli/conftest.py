"""One service, one application in this process, and a shell for both."""

import io
import json
from collections.abc import Iterator
from typing import Any

import pytest

from gelenk.cli import local
from gelenk.cli.main import main
from gelenk.kinematics.warm_up import warm_up
from tests.test_serve import service


@pytest.fixture(scope="package")
def url(tmp_path_factory: pytest.TempPathFactory) -> Iterator[str]:
    with service(tmp_path_factory.mktemp("data")) as (_, url):
        yield url


@pytest.fixture(scope="package")
def own() -> Iterator[local.InProcess]:
    """One application in this process for all tests here: it takes a second to begin."""
    warm_up()  # what it compiles would be told of
    transport = local.InProcess()
    yield transport
    transport.close()


class Shell:
    """Runs commands in this process."""

    def __init__(self, capfd: pytest.CaptureFixture[bytes], monkeypatch: pytest.MonkeyPatch) -> None:
        self._capfd, self._monkeypatch = capfd, monkeypatch

    def __call__(self, *arguments: object, code: int = 0, stdin: bytes = b"") -> tuple[str, str]:
        out, err = self.run(*arguments, code=code, stdin=stdin)
        return out.decode(), err

    def run(self, *arguments: object, code: int | None = 0, stdin: bytes = b"") -> tuple[bytes, str]:
        self._monkeypatch.setattr("sys.argv", ["gelenk", *map(str, arguments)])
        self._monkeypatch.setattr("sys.stdin", io.TextIOWrapper(io.BytesIO(stdin)))
        with pytest.raises(SystemExit) as end:
            main()
        out, err = self._capfd.readouterr()
        assert (end.value.code or 0) == (end.value.code or 0 if code is None else code), err + out
        return out, err.decode()

    def bytes(self, *arguments: object, code: int = 0) -> bytes:
        return self.run(*arguments, code=code)[0]

    def json(self, *arguments: object, code: int = 0) -> Any:
        return json.loads(self("--format", "json", *arguments, code=code)[0])

    def remove_added(self) -> None:
        """Remove the robots that a test has added to the application in this process: others list what is there."""
        for robot in self.json("robots")["robots"]:
            if robot["source"] == "uploaded":
                self("remove", robot["name"])


@pytest.fixture
def shell(own: local.InProcess, capfdbinary: pytest.CaptureFixture[bytes], monkeypatch: pytest.MonkeyPatch) -> Shell:
    monkeypatch.delenv("GELENK_SERVER", raising=False)
    monkeypatch.setattr("gelenk.cli.local.InProcess", lambda: own)
    monkeypatch.setattr(own, "close", lambda: None)
    return Shell(capfdbinary, monkeypatch)
