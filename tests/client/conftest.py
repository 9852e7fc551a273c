"""One service for all tests."""

from collections.abc import Iterator

import pytest

from gelenk.client import Client
from tests.test_serve import service


@pytest.fixture(scope="package")
def url(tmp_path_factory: pytest.TempPathFactory) -> Iterator[str]:
    """Where the service is."""
    with service(tmp_path_factory.mktemp("data")) as (_, url):
        yield url


@pytest.fixture
def gelenk(url: str) -> Iterator[Client]:
    """A client of it."""
    with Client(url) as client:
        yield client
