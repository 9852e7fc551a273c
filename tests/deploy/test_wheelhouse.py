"""A project of one small wheel is carried to where there is no network, and installed there: by the real `dev`."""

import base64
import hashlib
import os
import runpy
import shutil
import subprocess
import sys
import tempfile
import zipfile
from pathlib import Path
from typing import Any

import pytest

LOCKS = ("requirements", "requirements-tracing", "requirements-ray", "requirements-dev", "requirements-bench")
WHEEL = "gelenk_probe-1.0-py3-none-any.whl"
INFO = "gelenk_probe-1.0.dist-info"
FILES = {
    "gelenk_probe.py": "ANSWER = 42\n",
    f"{INFO}/METADATA": "Metadata-Version: 2.1\nName: gelenk-probe\nVersion: 1.0\n",
    f"{INFO}/WHEEL": "Wheel-Version: 1.0\nGenerator: tests\nRoot-Is-Purelib: true\nTag: py3-none-any\n",
}


def make_wheel(folder: Path) -> str:
    """Its hash."""
    with zipfile.ZipFile(folder / WHEEL, "w") as wheel:
        for name, text in FILES.items():
            wheel.writestr(name, text)
        digests = {name: hashlib.sha256(text.encode()).digest() for name, text in FILES.items()}
        lines = [f"{name},sha256={base64.urlsafe_b64encode(d).decode().rstrip('=')}," for name, d in digests.items()]
        wheel.writestr(f"{INFO}/RECORD", "\n".join([*lines, f"{INFO}/RECORD,,", ""]))
    return hashlib.sha256((folder / WHEEL).read_bytes()).hexdigest()


@pytest.fixture
def project(tmp_path: Path) -> Path:
    """A folder with `dev` and all that it looks for, and an index of packages beside it."""
    index, project = tmp_path / "index", tmp_path / "project"
    index.mkdir()
    (project / "app").mkdir(parents=True)
    digest = make_wheel(index)
    for lock in LOCKS:
        (project / f"{lock}.lock").write_text(f"gelenk-probe==1.0 \\\n    --hash=sha256:{digest}\n")
    shutil.copy("dev", project)
    (project / "app" / "__init__.py").touch()
    (project / "app" / "__pycache__").mkdir()
    (project / "docs" / "handbook").mkdir(parents=True)
    (project / "docs" / "index.md").touch()
    return project


def dev(folder: Path, *arguments: str, index: Path | None = None) -> subprocess.CompletedProcess[str]:
    """`dev` where pip knows no other index than a folder, or none at all."""
    environment = {name: value for name, value in os.environ.items() if not name.startswith("PIP_")}
    environment |= {"PIP_CONFIG_FILE": os.devnull, "PIP_NO_INDEX": "1"}
    if index is not None:
        environment["PIP_FIND_LINKS"] = str(index)
    command = [sys.executable, str(folder / "dev"), *arguments]
    return subprocess.run(
        command, cwd=folder.parent, env=environment, capture_output=True, text=True, timeout=600, check=False
    )


def test_what_was_carried_over_is_installed(project: Path) -> None:
    made = dev(project, "wheelhouse", "carried", index=project.parent / "index")
    carried = project.parent / "carried"
    assert made.returncode == 0, made.stderr
    assert {path.name for path in (carried / "wheels").iterdir()} == {WHEEL}
    assert not (carried / "app" / "__pycache__").exists()
    assert [path.name for path in (carried / "docs").iterdir()] == ["index.md"], "the handbook is built elsewhere"
    run = dev(carried, "install")
    assert run.returncode == 0, run.stderr
    code = "import gelenk_probe; print(gelenk_probe.ANSWER)"
    answer = subprocess.run(
        [carried / ".venv" / "bin" / "python", "-c", code], capture_output=True, text=True, check=True
    )
    assert answer.stdout == "42\n"
    assert dev(project, "wheelhouse", "carried", index=project.parent / "index").returncode != 0, "it is there already"


def test_a_wheel_that_is_another_one_is_not_installed(project: Path) -> None:
    wheels = project / "wheels"
    shutil.copytree(project.parent / "index", wheels)
    with zipfile.ZipFile(wheels / WHEEL, "a") as wheel:
        wheel.writestr("evil.py", "")
    run = dev(project, "install")
    assert run.returncode != 0
    assert "DO NOT MATCH THE HASHES" in run.stderr
    assert not list((project / ".venv").glob("lib/*/site-packages/evil.py"))


def test_nothing_is_left_of_one_that_could_not_be_made(project: Path) -> None:
    run = dev(project, "wheelhouse", "carried")
    assert run.returncode != 0
    assert {path.name for path in project.parent.iterdir()} == {"index", "project"}


def test_the_real_project_has_all_parts_that_are_carried() -> None:
    carried = runpy.run_path("dev")["CARRIED"]
    assert carried
    assert [part for part in carried if not Path(part).exists()] == []


@pytest.mark.parametrize("has_environment", [False, True])
def test_where_nothing_can_be_written_it_says_what_is_missing(project: Path, has_environment: bool) -> None:
    """As another user where this one may write everything, with a Python that others may run."""
    user: dict[str, Any] = {"user": 65534, "group": 65534, "extra_groups": []} if os.geteuid() == 0 else {}
    python = shutil.which("python3", path="/usr/bin:/bin") if user else sys.executable
    if python is None:
        pytest.skip("needs a Python of the system")
    with tempfile.TemporaryDirectory() as folder:
        tree = Path(folder, "project")
        shutil.copytree(project, tree)
        if has_environment:
            (tree / ".venv" / "bin").mkdir(parents=True)
            (tree / ".venv" / "bin" / "python").symlink_to(python)
        for path in (Path(folder), *tree.rglob("*/"), tree):
            path.chmod(0o555)
        command = [python, str(tree / "dev"), "serve"]
        run = subprocess.run(command, capture_output=True, text=True, timeout=60, check=False, **user)
        for path in (Path(folder), *tree.rglob("*/"), tree):
            path.chmod(0o755)
    assert run.returncode == 1
    assert run.stderr.count("\n") == 1
    missing = "requirements.lock is not installed in .venv" if has_environment else "there is no .venv"
    assert run.stderr.startswith(missing)
    assert f"{tree} cannot be written to: run ./dev install there" in run.stderr
