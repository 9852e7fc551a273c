"""One application for the tests of all modules; a module that changes more than robots of its own makes another."""

import time
from collections.abc import Iterator
from pathlib import Path

import pytest
from starlette.testclient import TestClient

from gelenk.kinematics.warm_up import warm_up
from gelenk.main import create_app
from gelenk.settings import Settings


@pytest.fixture(scope="session", autouse=True)
def kernels() -> None:
    """Compiled before the first request: on a machine without a cache that takes longer than one may wait."""
    warm_up()


@pytest.fixture(scope="session")
def client(tmp_path_factory: pytest.TempPathFactory) -> Iterator[TestClient]:
    """A client of an application that is ready."""
    yield from ready_client(tmp_path_factory.mktemp("data"))


def ready_client(data_dir: Path) -> Iterator[TestClient]:
    """A client of an application over a data folder, once it is ready."""
    app = create_app(Settings(data_dir=data_dir))
    with TestClient(app, raise_server_exceptions=False) as client:
        deadline = time.monotonic() + 300
        while client.get("/readyz").status_code != 200:
            assert time.monotonic() < deadline, "the service does not get ready"
            time.sleep(0.05)
        yield client
