"""A service that starts again when one of its files changes, also after one that does not even compile."""

import os
import shutil
import subprocess
import sys
from pathlib import Path

import pytest

from gelenk.robot.compilation import STORE
from tests.test_faults import wait_for
from tests.test_serve import HOST, free_port, get


@pytest.mark.slow
def test_a_change_starts_it_again_and_a_mistake_does_not_end_it(tmp_path: Path) -> None:
    package, port = tmp_path / "gelenk", free_port()
    shutil.copytree("app/gelenk", package, ignore=shutil.ignore_patterns("__pycache__"))
    shutil.copytree("robots", package / "robots")
    file = package / "contract" / "problem.py"
    right = file.read_text()
    environment = {**os.environ, "PYTHONPATH": str(tmp_path), "GELENK_DATA_DIR": str(tmp_path / "data")}
    if STORE is not None:
        environment["NUMBA_CACHE_DIR"] = str(STORE.parent)  # its kernels are the same
    command = [sys.executable, "-m", "gelenk.serve", "--port", str(port), "--reload"]

    def version() -> str:
        try:
            return str(get(f"http://{HOST}:{port}/openapi.json")[1]["info"]["title"])
        except (OSError, ValueError):  # not there, or cut off while it starts again
            return ""

    main = package / "main.py"
    with subprocess.Popen(command, cwd=tmp_path, env=environment) as run:
        try:
            wait_for(lambda: version() == "Gelenk", 300.0)
            file.write_text("def wrong(:\n")
            wait_for(lambda: version() == "", 60.0)
            assert run.poll() is None
            file.write_text(right)
            main.write_text(main.read_text().replace('title="Gelenk"', 'title="Another"'))
            wait_for(lambda: version() == "Another", 300.0)
        finally:
            run.terminate()
            assert run.wait(60) == 0
