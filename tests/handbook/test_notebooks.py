"""Every notebook runs from top to bottom against a service, and what it asserts holds."""

import json
import os
import subprocess
import sys
from collections.abc import Iterator
from pathlib import Path
from typing import Any

import pytest

from tests.test_serve import service

ROOT = Path(__file__).resolve().parent.parent.parent
NOTEBOOKS = sorted((ROOT / "docs" / "notebooks").glob("*.ipynb"))


def cells(notebook: Path, kind: str) -> list[dict[str, Any]]:
    return [cell for cell in json.loads(notebook.read_text())["cells"] if cell["cell_type"] == kind]


def code(notebook: Path) -> str:
    """The cells of a notebook as one program."""
    return "\n\n".join("".join(cell["source"]) for cell in cells(notebook, "code"))


@pytest.fixture(scope="module")
def url(tmp_path_factory: pytest.TempPathFactory) -> Iterator[str]:
    with service(tmp_path_factory.mktemp("data")) as (_, address):
        yield address


def run(program: str, url: str) -> subprocess.CompletedProcess[str]:
    environment = {**os.environ, "GELENK_SERVER": url, "PYTHONPATH": str(ROOT)}
    command = [sys.executable, "-W", "error", "-c", program]
    return subprocess.run(command, env=environment, capture_output=True, text=True, check=False, timeout=600)


@pytest.mark.slow
@pytest.mark.parametrize("notebook", NOTEBOOKS, ids=lambda notebook: notebook.stem)
def test_what_a_notebook_asserts_holds(notebook: Path, url: str) -> None:
    done = run(code(notebook), url)
    assert done.returncode == 0, done.stderr


@pytest.mark.slow
def test_what_does_not_hold_fails(url: str) -> None:
    (poses,) = (notebook for notebook in NOTEBOOKS if notebook.stem == "poses")
    wrong = code(poses).replace("0.7 * np.cos", "0.8 * np.cos")
    assert wrong != code(poses)
    assert "AssertionError" in run(wrong, url).stderr


@pytest.mark.parametrize("notebook", NOTEBOOKS, ids=lambda notebook: notebook.stem)
def test_a_notebook_can_be_opened_and_is_kept_without_outputs(notebook: Path) -> None:
    content = json.loads(notebook.read_text())
    assert (content["nbformat"], content["nbformat_minor"]) == (4, 5)
    ids = [cell["id"] for cell in content["cells"]]
    assert len(ids) == len(set(ids))
    assert all(cell["outputs"] == [] and cell["execution_count"] is None for cell in cells(notebook, "code"))
    assert code(notebook).count("assert ") >= 4
    assert cells(notebook, "markdown")[0]["source"][0].startswith("# ")


def test_every_notebook_is_named_where_it_is_told_how_to_open_them() -> None:
    page = (ROOT / "docs" / "how-to" / "notebooks.md").read_text()
    assert len(NOTEBOOKS) == 6
    assert [notebook.name for notebook in NOTEBOOKS if f"(../notebooks/{notebook.name})" not in page] == []
