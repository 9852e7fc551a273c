"""One service and one browser for all tests of the page, and no longer; every test has a page of its own."""

from collections.abc import Callable, Iterator
from pathlib import Path

import pytest
from playwright.sync_api import Browser, sync_playwright

from tests.studio.browser import ARGUMENTS, Pages, Studio, chromium
from tests.test_serve import service


@pytest.fixture(scope="package")
def browser() -> Iterator[Browser]:
    """Chromium: that of the variable CHROMIUM, which must be there, or one that is installed."""
    found = chromium()
    if found is None:
        pytest.skip("there is no Chromium to show the studio in: apt-get install chromium")
    with sync_playwright() as playwright:
        launched = playwright.chromium.launch(executable_path=found, args=ARGUMENTS)
        yield launched
        launched.close()


@pytest.fixture(scope="package")
def url(browser: Browser, tmp_path_factory: pytest.TempPathFactory) -> Iterator[str]:  # noqa: ARG001 - none, no service
    """A running service with no robots but the catalogue's."""
    data_dir: Path = tmp_path_factory.mktemp("data")
    with service(data_dir) as (_, address):
        yield address


@pytest.fixture
def refusals() -> set[int]:
    """The statuses that the service is to refuse something with; a test adds to them."""
    return set()


@pytest.fixture(scope="package")
def pages(browser: Browser) -> Pages:
    """The pages of this process."""
    return Pages(browser)


@pytest.fixture
def another(pages: Pages, url: str) -> Iterator[Callable[..., Studio]]:
    """Pages of another size, colour scheme or service; at the end they must have complained of nothing."""
    made: list[Studio] = []

    def make(at: str = url, **options: object) -> Studio:
        made.append(Studio(pages.take(), at))
        made[-1].begin(**options)  # type: ignore[arg-type]
        return made[-1]

    yield make
    try:
        for studio in made:
            studio.end()
    finally:
        for studio in made:
            pages.give_back(studio.page)


@pytest.fixture
def studio(another: Callable[..., Studio], refusals: set[int]) -> Studio:
    """A page of the usual size."""
    made = another()
    made.expected = refusals
    return made
