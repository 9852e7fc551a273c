"""The package as others install it: what is in the wheel, that it works in any folder, and how small a client stays."""

import json
import os
import re
import subprocess
import sys
import time
import tomllib
import urllib.error
import zipfile
from collections.abc import Iterator
from importlib import metadata
from pathlib import Path

import pytest
from packaging.requirements import Requirement

from tests.test_serve import free_port, get

ROOT = Path(__file__).parents[2]
PROJECT = tomllib.loads((ROOT / "pyproject.toml").read_text())["project"]
CLIENT_BYTES = 120e6
COMPUTING = {"pin", "numba", "llvmlite", "scipy", "sympy", "matplotlib", "example-robot-data"}
SERVING = {"fastapi", "starlette", "uvicorn", "uvloop", "prometheus-client"}
CLIENT_ALONE = """
import sys

class NotInstalled:
    def find_spec(self, name, path=None, target=None):
        if name.partition(".")[0] in {blocked}:
            raise ModuleNotFoundError(f"No module named {{name!r}}", name=name)

sys.meta_path.insert(0, NotInstalled())
"""


def closure(requirements: list[str]) -> set[str]:
    """The distributions that these requirements pull in here, by their normal names."""
    found: set[str] = set()
    waiting = [(Requirement(text), "") for text in requirements]
    while waiting:
        requirement, extra = waiting.pop()
        name = re.sub(r"[-_.]+", "-", requirement.name).lower()
        if name in found or (requirement.marker and not requirement.marker.evaluate({"extra": extra})):
            continue
        found.add(name)
        extras = requirement.extras or {""}
        waiting += [(Requirement(text), one) for text in metadata.requires(name) or [] for one in extras]
    return found


@pytest.fixture(scope="module")
def client_alone() -> str:
    """Lines of Python after which only what a client installs can be imported."""
    kept = closure(PROJECT["dependencies"])
    owners = metadata.packages_distributions()
    normal = {module: {re.sub(r"[-_.]+", "-", name).lower() for name in names} for module, names in owners.items()}
    blocked = sorted(module for module, names in normal.items() if not names & {*kept, "gelenk"})
    in_prefix = ["coal", "eigenpy", "pinocchio"]  # whose distributions list no module
    return CLIENT_ALONE.format(blocked=[*blocked, *in_prefix])


def python(code: str, **environment: str) -> subprocess.CompletedProcess[str]:
    own = {name: value for name, value in os.environ.items() if not name.startswith("GELENK_")}
    command = [sys.executable, "-c", code]
    return subprocess.run(command, env={**own, **environment}, capture_output=True, text=True, timeout=120, check=False)


def test_a_client_installs_nothing_that_computes_or_serves() -> None:
    pulled = closure(PROJECT["dependencies"])
    assert {"httpx2", "numpy", "pyyaml"} <= pulled
    assert not pulled & (COMPUTING | SERVING)
    files = [Path(str(file.locate())) for name in pulled for file in metadata.distribution(name).files or ()]
    assert sum(file.stat().st_size for file in files if file.is_file()) < CLIENT_BYTES


def test_the_library_brings_no_server() -> None:
    extras = PROJECT["optional-dependencies"]
    library = closure(PROJECT["dependencies"] + extras["engine"])
    assert library >= COMPUTING - {"scipy"}
    assert not library & SERVING


@pytest.mark.slow
def test_a_client_loads_and_converts_poses_without_what_computes(client_alone: str) -> None:
    code = """
import numpy as np
from gelenk.client import AsyncClient, Client
from gelenk.contract.pose import Pose
import gelenk.cli.main, gelenk.cli.files.inputs, gelenk.robot.formats.reading
turns = dict(quaternion_xyzw=[0, 0, 0, 1], quaternion_wxyz=[1, 0, 0, 0], rpy=[0, 0, 0], zyz=[0, 0, 0],
             rotation_vector=[0, 0, 0], rotation=np.eye(3).tolist())
for name, value in turns.items():
    assert (np.array(Pose(position=[0, 0, 0], **{name: value})) == np.eye(4)).all(), name
"""
    run = python(client_alone + code)
    assert run.returncode == 0, run.stderr


@pytest.mark.slow
@pytest.mark.parametrize("command", [["fk", "panda", "-q", "0 0 0 0 0 0 0"], ["robots"], ["serve"]])
def test_what_a_client_cannot_do_it_says_in_one_line(client_alone: str, command: list[str]) -> None:
    run = python(f"{client_alone}sys.argv = {['gelenk', *command]}\nimport gelenk.__main__")
    assert (run.returncode, run.stdout, run.stderr.count("\n")) == (3, "", 1), run.stderr
    assert "install gelenk[server] (in a checkout: pip install '.[server]')" in run.stderr
    assert "--server" in run.stderr


@pytest.mark.slow
def test_the_library_without_its_engine_says_what_to_install(client_alone: str) -> None:
    run = python(f"{client_alone}import gelenk\nprint(gelenk.__version__)\ngelenk.Robot")
    assert run.stdout == f"{PROJECT['version']}\n"
    assert re.search(r"^ImportError: .*install gelenk\[engine\]", run.stderr, re.MULTILINE), run.stderr


@pytest.fixture(scope="module")
def wheel(tmp_path_factory: pytest.TempPathFactory) -> Path:
    folder = tmp_path_factory.mktemp("wheel")
    pip("wheel", "--no-build-isolation", "--no-deps", "--wheel-dir", str(folder), str(ROOT))
    (built,) = folder.iterdir()
    return built


def pip(*arguments: str) -> None:
    command = [sys.executable, "-m", "pip", "--disable-pip-version-check", *arguments]
    environment = {**os.environ, "PIP_NO_INDEX": "1", "PIP_CONFIG_FILE": os.devnull}
    subprocess.run(command, env=environment, capture_output=True, text=True, timeout=300, check=True)


@pytest.mark.slow
def test_the_wheel_holds_the_package_the_robots_and_the_page(wheel: Path) -> None:
    with zipfile.ZipFile(wheel) as archive:
        names = set(archive.namelist())
    tracked = subprocess.run(
        ["git", "ls-files", "app/gelenk", "robots"], cwd=ROOT, capture_output=True, text=True, check=True
    ).stdout.splitlines()
    built = [path.relative_to(ROOT / "build").as_posix() for path in (ROOT / "build" / "handbook").rglob("*")]
    files = {f"gelenk/{path}" for path in built if (ROOT / "build" / path).is_file()}
    files |= {path.removeprefix("app/") if path.startswith("app/") else f"gelenk/{path}" for path in tracked}
    files = {name for name in files if not name.endswith(".po")}  # compiled into what is there
    assert {name for name in names if not re.match(r"gelenk-[^/]*\.dist-info/", name)} == files
    assert {"gelenk/py.typed", "gelenk/robots/panda/robot.json", "gelenk/studio/index.html"} <= names
    assert "gelenk/texts/de/LC_MESSAGES/gelenk.mo" in names
    assert ("gelenk/handbook/index.html" in names) == bool(built)
    # The package itself has 3.54 MB, with the page as text and by Brotli: one more folder of pictures is noticed.
    assert wheel.stat().st_size < (6.7e6 if built else 3.7e6)


@pytest.fixture(scope="module")
def installed(wheel: Path, tmp_path_factory: pytest.TempPathFactory) -> Path:
    """An environment with the wheel, in a folder with spaces; what the wheel needs it borrows from this one."""
    folder = tmp_path_factory.mktemp("any folder") / "an environment"
    subprocess.run([sys.executable, "-m", "venv", "--without-pip", str(folder)], check=True)
    pip("--python", str(folder / "bin" / "python"), "install", "--no-deps", str(wheel))
    (packages,) = folder.glob("lib/python*/site-packages")
    borrowed = [path for path in sys.path if Path(path).name == "site-packages"]
    (packages / "borrowed.pth").write_text("\n".join(borrowed))
    return folder


@pytest.fixture
def environment(installed: Path) -> dict[str, str]:
    own = {name: value for name, value in os.environ.items() if not name.startswith(("GELENK_", "PYTHON", "NUMBA_"))}
    return {**own, "GELENK_DATA_DIR": str(installed.parent / "data"), "COLUMNS": "200"}


@pytest.mark.slow
def test_the_commands_work_in_any_folder(installed: Path, environment: dict[str, str]) -> None:
    def ran(*arguments: str) -> str:
        command = [str(installed / "bin" / arguments[0]), *arguments[1:]]
        run = subprocess.run(
            command, cwd=installed.parent, env=environment, capture_output=True, text=True, timeout=600, check=False
        )
        assert run.returncode == 0, run.stderr
        return run.stdout

    where = ran("python", "-c", "import gelenk; print(gelenk.__file__)")
    assert Path(where.strip()).is_relative_to(installed), "not the wheel is tested but the checkout"
    assert ran("gelenk", "--version") == ran("python", "-m", "gelenk", "--version") == f"gelenk {PROJECT['version']}\n"
    assert len(json.loads(ran("gelenk", "-f", "json", "robots"))["robots"]) == len(list((ROOT / "robots").glob("*/")))
    (pose,) = json.loads(ran("gelenk", "-f", "json", "fk", "planar_2r", "-q", "0 0"))["poses"]
    assert pose["position"] == [1.7, 0.0, 0.0]
    assert ran("python", "-c", "import gelenk; print(gelenk.Robot.load('panda').joint_names[0])") == "panda_joint1\n"


@pytest.mark.slow
def test_the_service_answers_in_any_folder(installed: Path, environment: dict[str, str]) -> None:
    url = f"http://127.0.0.1:{(port := free_port())}"
    command = [str(installed / "bin" / "gelenk"), "serve", "--port", str(port)]
    with subprocess.Popen(command, cwd=installed.parent, env=environment, stdout=subprocess.DEVNULL) as run:
        try:
            body = {"joint_positions": [[0.0, 0.0]]}
            for _ in polls(run, seconds=300):
                status, answer = get_or_wait(f"{url}/v1/robots/planar_2r/fk", body)
                if status == 200:
                    break
            assert answer["poses"][0]["position"] == [1.7, 0.0, 0.0]
        finally:
            run.terminate()
            run.wait(timeout=60)


def polls(run: subprocess.Popen[bytes], seconds: float) -> Iterator[None]:
    deadline = time.monotonic() + seconds
    while time.monotonic() < deadline:
        assert run.poll() is None, "the service has ended"
        yield
        time.sleep(0.2)
    raise TimeoutError("it does not answer")


def get_or_wait(url: str, body: object) -> tuple[int, dict[str, list[dict[str, object]]]]:
    try:
        return get(url, "POST", body)
    except (urllib.error.URLError, OSError):
        return 0, {}
