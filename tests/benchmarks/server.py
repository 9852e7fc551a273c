"""The service in a process of its own, with an empty endpoint beside it; and a bare application with nothing else."""

import asyncio
import os
import subprocess
import sys
import tempfile
import time
import urllib.request
from collections.abc import Iterator
from contextlib import contextmanager
from functools import partial
from typing import NamedTuple, cast

import uvicorn
from fastapi import FastAPI

from gelenk.connections import BoundedProtocol, ConnectionLimits, Gate
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


def serve(factory: str, port: int) -> None:
    """Serve an application by the same server with the same options; the service over its own connections, as ever."""
    gate = Gate(ConnectionLimits())
    uvicorn.run(
        f"tests.benchmarks.server:{factory}",
        factory=True,
        port=port,
        loop="uvloop",
        http=cast(type[asyncio.Protocol], partial(BoundedProtocol, gate=gate)) if factory == "service" else "httptools",
        ws="none",
        access_log=False,
        log_level="warning",
        server_header=False,
        proxy_headers=False,
    )


@contextmanager
def running(factory: str, ready_path: str, **settings: str) -> Iterator[Running]:
    """Serve one of the applications above, with further variables in its environment; see `serve`."""
    port = free_port()
    with tempfile.TemporaryDirectory() as data_dir:
        command = [sys.executable, "-m", "tests.benchmarks.server", factory, str(port)]
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


if __name__ == "__main__":
    serve(sys.argv[1], int(sys.argv[2]))
