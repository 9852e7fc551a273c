"""The real `dev` installs a project of one small wheel in a folder with a space, also where there is no network."""

import ast
import base64
import hashlib
import os
import runpy
import shutil
import subprocess
import sys
import tempfile
import time
import zipfile
from collections.abc import Callable
from pathlib import Path
from typing import Any

import pytest

LOCKS = ("requirements", "requirements-tracing", "requirements-ray", "requirements-dev", "requirements-bench")
WHEEL = "gelenk_probe-1.0-py3-none-any.whl"
INFO = "gelenk_probe-1.0.dist-info"
PROJECT = """
[project]
name = "probe"
version = "1.0"
[build-system]
requires = []
build-backend = "backend"
backend-path = ["app"]
"""
BACKEND = """
import zipfile

import time
from pathlib import Path

def build_editable(folder, config_settings=None, metadata_directory=None):
    while Path("wait").exists():
        Path("waits").touch()
        time.sleep(0.05)
    info, name = "probe-1.0.dist-info", "probe-1.0-py3-none-any.whl"
    with zipfile.ZipFile(f"{folder}/{name}", "w") as wheel:
        wheel.writestr(f"{info}/METADATA", "Metadata-Version: 2.1\\nName: probe\\nVersion: 1.0\\n")
        wheel.writestr(f"{info}/WHEEL", "Wheel-Version: 1.0\\nRoot-Is-Purelib: true\\nTag: py3-none-any\\n")
        wheel.writestr(f"{info}/RECORD", "")
    return name
"""
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
    index, project = tmp_path / "index", tmp_path / "a project"
    index.mkdir()
    (project / "app" / "gelenk").mkdir(parents=True)
    (project / "pyproject.toml").write_text(PROJECT)
    (project / "app" / "backend.py").write_text(BACKEND)
    digest = make_wheel(index)
    for lock in LOCKS:
        (project / f"{lock}.lock").write_text(f"gelenk-probe==1.0 \\\n    --hash=sha256:{digest}\n")
    shutil.copy("dev", project)
    (project / "app" / "gelenk" / "__init__.py").touch()
    (project / "app" / "gelenk" / "__pycache__").mkdir()
    (project / "docs" / "handbook").mkdir(parents=True)
    (project / "docs" / "index.md").touch()
    return project


def begin(folder: Path, *arguments: str, index: Path | None = None, **variables: str) -> subprocess.Popen[str]:
    """`dev` where pip knows no other index than a folder, or none at all."""
    environment = {name: value for name, value in os.environ.items() if not name.startswith(("PIP_", "PYTHON"))}
    environment |= {"PIP_CONFIG_FILE": os.devnull, "PIP_NO_INDEX": "1", **variables}
    if index is not None:
        environment["PIP_FIND_LINKS"] = str(index)
    command = [sys.executable, str(folder / "dev"), *arguments]
    return subprocess.Popen(
        command, cwd=folder.parent, env=environment, stdout=subprocess.PIPE, stderr=subprocess.PIPE, text=True
    )


def dev(folder: Path, *arguments: str, index: Path | None = None, **variables: str) -> subprocess.CompletedProcess[str]:
    """The same to its end."""
    with begin(folder, *arguments, index=index, **variables) as run:
        out, err = run.communicate(timeout=600)
    return subprocess.CompletedProcess(run.args, run.returncode, out, err)


@pytest.mark.slow
def test_what_was_carried_over_is_installed(project: Path) -> None:
    (project / "build" / "handbook").mkdir(parents=True)
    (project / "build" / "handbook" / "index.html").touch()
    made = dev(project, "wheelhouse", "carried", index=project.parent / "index")
    carried = project.parent / "carried"
    assert made.returncode == 0, made.stderr
    assert {path.name for path in (carried / "wheels").iterdir()} == {WHEEL}
    assert not (carried / "app" / "gelenk" / "__pycache__").exists()
    assert [path.name for path in (carried / "docs").iterdir()] == ["index.md"], "the handbook is built elsewhere"
    assert [path.name for path in (carried / "build" / "handbook").iterdir()] == ["index.html"]
    run = dev(carried, "install")
    assert run.returncode == 0, run.stderr
    code = "import gelenk_probe; print(gelenk_probe.ANSWER)"
    answer = subprocess.run(
        [carried / ".venv" / "bin" / "python", "-c", code], capture_output=True, text=True, check=True
    )
    assert answer.stdout == "42\n"
    assert dev(project, "wheelhouse", "carried", index=project.parent / "index").returncode != 0, "it is there already"


@pytest.mark.slow
def test_a_wheel_that_is_another_one_is_not_installed(project: Path) -> None:
    wheels = project / "wheels"
    shutil.copytree(project.parent / "index", wheels)
    with zipfile.ZipFile(wheels / WHEEL, "a") as wheel:
        wheel.writestr("evil.py", "")
    run = dev(project, "install")
    assert run.returncode != 0
    assert "DO NOT MATCH THE HASHES" in run.stderr
    assert not list((project / ".venv").glob("lib/*/site-packages/evil.py"))


@pytest.mark.slow
def test_nothing_is_left_of_one_that_could_not_be_made(project: Path) -> None:
    run = dev(project, "wheelhouse", "carried")
    assert run.returncode != 0
    assert {path.name for path in project.parent.iterdir()} == {"index", "a project"}


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


@pytest.mark.slow
def test_a_killed_installation_starts_over(project: Path) -> None:
    """What it leaves may be half of a package, and its pip may go on: the next one waits for that, and begins anew."""
    index, environment, wait = project.parent / "index", project / ".venv", project / "wait"
    wait.touch()
    try:
        with begin(project, "install", index=index) as killed:
            wait_for((project / "waits").exists)
            killed.kill()
        (environment / "left over").touch()
        second = begin(project, "install", index=index)
        assert second.stderr is not None
        first = second.stderr.readline()
    finally:
        wait.unlink()
    told = second.communicate(timeout=600)[1]
    assert first.startswith("waiting for another installation")
    assert second.returncode == 0, told
    assert told.startswith("making .venv")
    assert not (environment / "left over").exists()
    assert list(environment.glob("lib/*/site-packages/gelenk_probe.py"))
    assert dev(project, "install").stderr == "", "it is installed, and needs no index"


def wait_for(is_so: Callable[[], bool]) -> None:
    deadline = time.monotonic() + 300
    while not is_so():
        assert time.monotonic() < deadline
        time.sleep(0.05)


@pytest.mark.quick(3)
@pytest.mark.parametrize(
    ("machine", "words"),
    [
        ("sys.version_info = (3, 10, 2, 'final', 0)", "Python 3.11 to 3.14 is needed"),
        ("sys.version_info = (3, 15, 0, 'final', 0)", "Python 3.11 to 3.14 is needed"),
        ("platform.machine = lambda: 'armv7l'", "Linux with glibc 2.28 or newer on x86_64 and aarch64"),
        ("platform.libc_ver = lambda: ('', '')", "Linux with glibc 2.28 or newer on x86_64 and aarch64"),
        ("platform.libc_ver = lambda: ('glibc', '2.17')", "glibc 2.17"),
        ("sys.platform = 'win32'", "Linux with glibc 2.28 or newer on x86_64 and aarch64"),
        ("importlib.util.find_spec = lambda name: None", "apt-get install python3-pip"),
    ],
)
def test_a_machine_that_will_not_do_is_told_in_one_line(project: Path, machine: str, words: str) -> None:
    (project / "sitecustomize.py").write_text(f"import importlib.util, platform, sys\n{machine}\n")
    run = dev(project, "serve", PYTHONPATH=str(project))
    assert (run.returncode, run.stdout, run.stderr.count("\n")) == (1, "", 1), run.stderr
    assert words in run.stderr
    assert not (project / ".venv").exists()


def test_an_old_python_can_read_far_enough_to_say_so() -> None:
    """Python 3.6 has no `:=`, and no `list[str]`, which it does not evaluate before it ends."""
    text = Path("dev").read_text()
    ast.parse(text, feature_version=(3, 6))
    assert text.index("sys.version_info") < text.index("def ")


@pytest.mark.slow
def test_a_home_that_cannot_be_written_is_not_needed(project: Path) -> None:
    run = dev(project, "install", index=project.parent / "index", HOME="/proc/no home")
    assert run.returncode == 0, run.stderr
