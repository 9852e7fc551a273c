"""Every call of the README and of the pages is made, of a running service, and gives what is printed there."""

import doctest
import os
import subprocess
from collections.abc import Iterator
from pathlib import Path
from typing import Any

import numpy as np
import pytest

from tests.documents.agreement import agree
from tests.documents.blocks import README, blocks, console, shell, with_blocks
from tests.test_serve import service

pytestmark = pytest.mark.slow
MORE = Path("docs/how-to/shell-and-python.md")
ADDRESSES = ("http://localhost:8000", "http://127.0.0.1:8000")


@pytest.fixture(scope="module")
def url(tmp_path_factory: pytest.TempPathFactory) -> Iterator[str]:
    with service(tmp_path_factory.mktemp("data")) as (_, address):
        yield address


def here(text: str, url: str) -> str:
    """A call as it is made here: the service has another port."""
    for address in ADDRESSES:
        text = text.replace(address, url)
    return text


def test_there_are_calls() -> None:
    assert [command for command in console(README) if command.line.startswith("curl")]
    assert len([command for command in console(MORE) if command.line.startswith("curl")]) == 5


@pytest.mark.parametrize("page", with_blocks("console"), ids=str)
def test_what_a_shell_prints(page: Path, url: str, tmp_path: Path) -> None:
    """In their order, because one uses the robot of the one before."""
    (tmp_path / "dev").symlink_to(Path("dev").resolve())
    environment = {name: value for name, value in os.environ.items() if not name.startswith("GELENK_")}
    environment["COLUMNS"] = "200"
    for line, printed in console(page):
        command = ["bash", "-c", here(line, url)]
        run = subprocess.run(
            command, cwd=tmp_path, env=environment, capture_output=True, text=True, timeout=300, check=False
        )
        assert run.returncode == 0, run.stderr
        assert agree(printed, run.stdout), f"{line}\n{run.stdout}"


@pytest.mark.parametrize("page", with_blocks("pycon"), ids=str)
def test_what_python_prints(page: Path, url: str) -> None:
    names: dict[str, object] = {}
    for block in blocks(page, "pycon"):
        test = doctest.DocTestParser().get_doctest(here(block, url), names, str(page), str(page), 0)
        assert test.examples
        told: list[str] = []
        result = doctest.DocTestRunner(_Agreement()).run(test, out=told.append, clear_globs=False)
        names = test.globs
        assert result.failed == 0, "".join(told)


def test_a_key_is_made_and_used(tmp_path: Path) -> None:
    """As the page on labs has it, but that the service is reached from this machine alone."""
    make, serve, ask, *_ = shell(Path("docs/how-to/run-it-for-a-lab.md"))
    (tmp_path / "dev").symlink_to(Path("dev").resolve())
    made = subprocess.run(["bash", "-c", make], cwd=tmp_path, capture_output=True, text=True, timeout=300, check=True)
    settings = dict(word.split("=") for word in serve.split() if word.startswith("GELENK_"))
    settings["GELENK_API_KEYS"] = str(tmp_path / settings["GELENK_API_KEYS"])
    with service(tmp_path / "data", **settings) as (_, url):
        there = f"--connect-to lab.example.org:8000:{url.removeprefix('http://')}"
        for key, status in ((made.stdout.strip(), "200"), ("gelenk.anna.0", "401")):
            line = f"{ask.replace('gelenk.anna.…', key)} --silent --output answer --write-out '%{{http_code}}' {there}"
            run = subprocess.run(["bash", "-c", line], cwd=tmp_path, capture_output=True, text=True, check=True)
            assert run.stdout == status


def test_a_map_is_asked_for_in_jobs(url: str) -> None:
    """As the page on many machines has it, with fewer targets."""
    (program,) = blocks(Path("docs/how-to/reachability-map-on-32-machines.md"), "python")
    names: dict[str, Any] = {}
    exec(program.replace("https://lab.example.org", url).replace("…", ""), names)  # noqa: S102 - our own page
    targets = np.tile([0.4, 0.1, 0.5, 1.0, 0.0, 0.0, 0.0], (50, 1))
    with names["service"]:
        assert names["finish"](names["begin"](targets)).shape == (50, 7)


class _Agreement(doctest.OutputChecker):
    def check_output(self, want: str, got: str, optionflags: int) -> bool:  # noqa: ARG002 - doctest's signature
        return agree(want, got)
