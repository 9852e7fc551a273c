"""The studio by TLS, below a path prefix, behind nginx: it has all its files, and its calls are answered."""

from collections.abc import Iterator
from pathlib import Path

import pytest
from playwright.sync_api import Browser

from tests.deploy.nginx import in_front_of, nginx
from tests.studio.browser import Pages, Studio
from tests.test_serve import service

pytestmark = [
    pytest.mark.slow,
    pytest.mark.skipif(nginx() is None, reason="there is no nginx: apt-get install nginx-light openssl"),
]


@pytest.fixture
def studio(browser: Browser, tmp_path: Path) -> Iterator[Studio]:
    """A page that takes the certificate, which nobody has signed."""
    (tmp_path / "nginx").mkdir()
    with (
        service(tmp_path / "data", "--root-path", "/gelenk") as (_, url),
        in_front_of(url, tmp_path / "nginx") as (secure, _, _),
    ):
        pages = Pages(browser, is_certificate_checked=False)
        made = Studio(pages.take(), f"{secure}/gelenk")
        made.begin()
        yield made
        made.end()
        pages.give_back(made.page)


def test_the_studio_and_the_documentation(studio: Studio) -> None:
    """A pose, a job with its progress and its result as npy, and the pages behind the link; no other file is asked."""
    studio.open(robot="planar_2r", q="0.3,0.8")
    studio.until("document.querySelector('.agreement').dataset.tone === 'good'")
    studio.page.get_by_role("tab", name="Workspace").click()
    studio.button("Compute").click()
    studio.until("document.querySelector('[data-points]')")
    names: list[str] = studio.run("performance.getEntriesByType('resource').map(({name}) => name)")
    assert names
    assert [name for name in names if not name.startswith(f"{studio.url}/")] == []
    studio.page.get_by_role("link", name="API").click()
    studio.page.locator(".swagger-ui .opblock").first.wait_for()
    assert studio.page.url == f"{studio.url}/docs"
