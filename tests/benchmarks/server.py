"""The service in a process of its own, with an empty endpoint beside it; and a bare application with nothing else."""

import os
import subprocess
import sys
import tempfile
import time
import urllib.request
from collections.abc import Iterator
from contextlib import contextmanager
from typing import NamedTuple

from fastapi import FastAPI

from gelenk.main import from_environment
from tests.test_serve import HOST, free_port


class Running(NamedTuple):
    """A server that answers."""

    port: int
    pid: int


def service() -> FastAPI:
    """The service, with the endpoint it is measured against."""
    app = from_environment()
    _add_empty(app)
    return app


def bare() -> FastAPI:
    """FastAPI with nothing but the endpoint."""
    app = FastAPI()
    _add_empty(app)
    return app


def _add_empty(app: FastAPI) -> None:
    @app.get("/empty")
    async def empty() -> dict[str, str]:
        return {}


@contextmanager
def running(factory: str, ready_path: str, **settings: str) -> Iterator[Running]:
    """Serve one of the applications above just as the service is served, with further variables in its environment."""
    port = free_port()
    with tempfile.TemporaryDirectory() as data_dir:
        command = [
            *(sys.executable, "-m", "uvicorn", "--factory", f"tests.benchmarks.server:{factory}", "--port", str(port)),
            *("--loop", "uvloop", "--http", "httptools", "--no-access-log", "--no-server-header"),
            *("--log-level", "warning"),
        ]
        with subprocess.Popen(command, env={**os.environ, "GELENK_DATA_DIR": data_dir, **settings}) as process:
            try:
                wait_for(f"http://{HOST}:{port}{ready_path}")
                yield Running(port, process.pid)
            finally:
                process.terminate()
                process.wait(timeout=20)


def wait_for(url: str, seconds: float = 120.0) -> None:
    """Return when a page answers 200."""
    deadline = time.monotonic() + seconds
    while True:
        try:
            with urllib.request.urlopen(url, timeout=5):
                return
        except OSError:
            if time.monotonic() > deadline:
                raise
            time.sleep(0.02)
