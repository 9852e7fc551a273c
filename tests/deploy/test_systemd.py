"""systemd takes the unit as it is meant, and what it runs is the service with the settings that stand in it."""

import json
import shutil
import subprocess
import sys
import urllib.request
from pathlib import Path

import pytest

from gelenk.contract.endpoint import Scope
from gelenk.http.access.keyring import new_key
from tests.deploy import unit
from tests.test_serve import get, service

TABLE = {
    "convention": "standard",
    "joints": [{"type": "revolute", "a": 1.0, "alpha": 0.0, "d": 0.0, "theta": 0.0}],
}
MOST_EXPOSED = 2.0
"""Of systemd's own scale from 0 to 10, on which a unit without any bounds has 9.6."""


def analysed(*arguments: str) -> subprocess.CompletedProcess[str]:
    return subprocess.run(["systemd-analyze", *arguments], capture_output=True, text=True, timeout=60, check=False)


@pytest.fixture
def written(tmp_path: Path) -> Path:
    if shutil.which("systemd-analyze") is None:
        pytest.skip("there is no systemd-analyze: apt-get install systemd")
    file = tmp_path / "gelenk.service"
    file.write_text(unit.as_here(Path.cwd(), sys.executable), encoding="utf-8")
    return file


def test_systemd_has_nothing_to_say_against_it(written: Path) -> None:
    run = analysed("verify", str(written))
    assert (run.returncode, run.stdout + run.stderr) == (0, "")


def test_a_misspelt_bound_would_be_noticed(written: Path) -> None:
    written.write_text(written.read_text().replace("MemoryMax=8G", "MemoryMaximum=8G"))
    assert "MemoryMaximum" in analysed("verify", str(written)).stderr


def test_little_of_the_machine_is_exposed(written: Path) -> None:
    run = analysed("security", "--offline=true", f"--threshold={MOST_EXPOSED * 10:.0f}", str(written))
    assert run.returncode == 0, run.stdout[-200:]


@pytest.mark.slow
def test_what_it_runs_is_the_service_with_its_settings(tmp_path: Path) -> None:
    token, key = new_key("anna", [Scope.READ, Scope.WRITE])
    (tmp_path / "keys").write_text(key.entry() + "\n")
    found = unit.read(tmp_path, tmp_path / "state", tmp_path / "cache")
    assert found.command[:3] == [f"{unit.FOLDER}/.venv/bin/python", "-m", "gelenk.serve"]
    data_dir = Path(found.environment.pop("GELENK_DATA_DIR"))
    del found.environment["NUMBA_CACHE_DIR"]  # there are kernels already, which take a minute to compile
    with service(data_dir, *found.command[3:], **found.environment) as (_, url):
        where = f"{url}/gelenk/v1/robots"
        assert get(where)[0] == 401
        request = urllib.request.Request(where, json.dumps({"name": "arm", "dh": TABLE}).encode())
        request.headers = {
            "Authorization": f"Bearer {token}",
            "Host": "lab.example.org",
            "Content-type": "application/json",
        }
        with urllib.request.urlopen(request, timeout=60) as answer:
            assert (answer.status, answer.headers["Location"]) == (201, "/gelenk/v1/robots/arm")
    assert (data_dir / "robots" / "arm").is_dir()
