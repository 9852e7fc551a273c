"""Commands that no test can run are at least such as there are, with options that there are and settings that count."""

import re
import runpy
import shlex
import tomllib
from itertools import takewhile
from pathlib import Path

import pytest

from gelenk import keys
from gelenk.settings import Settings
from supply import audit
from tests.documents.blocks import PAGES, console, shell
from tests.test_serve import started_with

DEV: set[str] = set(re.findall(r'^        "(\w+)": \w+,$', Path("dev").read_text(encoding="utf-8"), re.MULTILINE))
BENCHMARKS: set[str] = set(
    re.findall(r'^    "([\w-]+)": [\w.]+,$', Path("tests/benchmarks/__main__.py").read_text(), re.MULTILINE)
) | {"ik"}
DOCKERFILE = Path("Dockerfile").read_text(encoding="utf-8")
EXTRAS = set(tomllib.loads(Path("pyproject.toml").read_text())["project"]["optional-dependencies"])
DEBIAN = "python3,python3-pip,ca-certificates"
"""What the Dockerfile needs of its base."""
ALL = [(page, line) for page in PAGES for line in (*shell(page), *(command.line for command in console(page)))]
MENTIONED = [
    (page, words)
    for page in PAGES
    for words in re.findall(r"`(?:[A-Z_]+=\S+ )*\./dev ([^`\n]+)`", page.read_text(encoding="utf-8"))
]


def test_the_commands_are_found() -> None:
    assert {"serve", "test", "handbook", "wheelhouse"} <= DEV
    assert {"ik-all", "load", "batch"} <= BENCHMARKS
    assert len(ALL) >= 15
    assert len(MENTIONED) >= 25


@pytest.mark.parametrize(("page", "line"), ALL, ids=lambda part: str(part)[:40])
def test_a_command_is_one(page: Path, line: str, monkeypatch: pytest.MonkeyPatch, tmp_path: Path) -> None:
    words = shlex.split(line, comments=True)
    settings = dict(word.split("=", 1) for word in takewhile(lambda word: "=" in word, words))
    Settings.from_environment(settings)
    monkeypatch.chdir(tmp_path)
    match words[len(settings) :]:
        case ["./dev" | "gelenk", "serve", *arguments]:
            if "GELENK_API_KEYS" in settings:
                made = tmp_path / "keys"
                monkeypatch.setattr("sys.argv", ["keys", "anna", "--file", str(made)])
                keys.main()
                settings["GELENK_API_KEYS"] = str(made)
            monkeypatch.setattr("gelenk.serve.find_spec", lambda _: True)  # a package that ./dev serve installs
            started_with(monkeypatch, *arguments, **settings)
        case ["./dev", "keys", *arguments]:
            monkeypatch.setattr("sys.argv", ["keys", *arguments])
            keys.main()
        case ["./dev", "test"] | ["./dev", "gelenk", *_] | ["curl", *_]:
            pass  # what a page says of the last two is run in `test_calls`
        case ["./dev", "bench", name]:
            assert name in BENCHMARKS
        case ["ray", "start", *arguments]:
            assert "--disable-usage-stats" in arguments
        case ["debootstrap", *_]:
            assert f"--include={DEBIAN}" in words
        case ["docker", "build", *_]:
            assert re.search(rf"^ARG {words[words.index('--build-arg') + 1].split('=')[0]}=", DOCKERFILE, re.MULTILINE)
        case ["./dev", "audit", *arguments]:
            assert audit.parser().parse_known_args(arguments)[1] == []
        case ["docker", "compose" | "export", *_] | ["tar", *_] | ["wrk", *_] | ["pip", "install", _]:
            pass  # what the last one names is looked at below
        case ["python3", "-m", "pip", *_, "install", "jupyterlab"] | [".venv/bin/jupyter", "lab", *_]:
            pass  # Jupyter is the user's; `tests/handbook/test_notebooks` runs what is opened in it
        case _:
            pytest.fail(f"{page}: nobody knows the command {words[0]}")


@pytest.mark.parametrize(("page", "words"), MENTIONED, ids=lambda part: str(part)[:40])
def test_what_is_mentioned_is_there(page: Path, words: str) -> None:
    command, *arguments = words.split()
    assert command in DEV, page
    if command == "bench":
        assert set(arguments) <= BENCHMARKS
    if command == "test":
        assert all(Path(argument).exists() for argument in arguments if argument.startswith("tests/"))


@pytest.mark.parametrize("page", PAGES, ids=str)
def test_an_extra_that_is_named_is_one(page: Path) -> None:
    assert set(re.findall(r"(?:gelenk|'\.)\[(\w+)\]", page.read_text(encoding="utf-8"))) <= EXTRAS


def test_dev_tells_of_each_of_its_commands() -> None:
    told = runpy.run_path("dev")["__doc__"]
    assert {name for name in DEV if f"./dev {name} " not in told} == set()
