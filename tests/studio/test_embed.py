"""The picture in a frame of another page, and what is offered to put it there."""

import json
from collections.abc import Callable, Iterator
from contextlib import contextmanager
from functools import partial
from http.server import SimpleHTTPRequestHandler
from pathlib import Path

import pytest
from playwright.sync_api import expect

from tests.studio.browser import Studio
from tests.studio.proxy import answering
from tests.studio.test_page import AXE
from tests.test_serve import service


@contextmanager
def pages_of(folder: Path) -> Iterator[str]:
    """The origin of a server of some files."""

    class Quiet(SimpleHTTPRequestHandler):
        def log_message(self, *_: object) -> None:
            pass

    with answering(partial(Quiet, directory=str(folder))) as origin:
        yield origin


@pytest.mark.slow
def test_a_page_that_may_frame_it_shows_the_robot_alone(another: Callable[..., Studio], tmp_path: Path) -> None:
    """From the very text that the studio offers."""
    (tmp_path / "www").mkdir()
    with pages_of(tmp_path / "www") as origin, service(tmp_path / "data", GELENK_FRAME_ANCESTORS=origin) as (_, url):
        studio = another(at=url)
        studio.open("pose", robot="planar_2r", q="0.3,0.8")
        studio.button("Share").click()
        dialog = studio.page.get_by_role("dialog", name="Share")
        expect(dialog).to_contain_text(f"Pages of {origin} may show it.")
        text = next(text for text in dialog.locator("code").all_inner_texts() if text.startswith("<iframe"))
        (tmp_path / "www" / "index.html").write_text(f"<!doctype html><title>Course</title>{text}", encoding="utf-8")
        page = studio.page.context.new_page()
        page.goto(f"{origin}/index.html")
        inside = page.frame_locator("iframe")
        expect(inside.get_by_role("img", name="The robot in space")).to_be_visible()
        expect(inside.get_by_role("tablist")).to_have_count(0)
        frame = page.frames[1]
        expect(inside.get_by_role("status")).to_have_text("")
        assert frame.evaluate("studio.store.value.positions") == {"joint_1": 0.3, "joint_2": 0.8}
        with page.context.expect_page() as opened:
            inside.get_by_role("link", name="Open in Gelenk").click()
        opened.value.get_by_role("tab", name="Pose", exact=True).wait_for()
        assert opened.value.url.startswith(f"{url}/#robot=planar_2r")
        opened.value.close()
        page.close()


@pytest.mark.slow
def test_no_other_page_may_frame_it(studio: Studio, tmp_path: Path) -> None:
    studio.open("pose", robot="planar_2r")
    studio.button("Share").click()
    expect(studio.page.get_by_role("dialog")).to_contain_text("GELENK_FRAME_ANCESTORS")
    (tmp_path / "index.html").write_text(f'<iframe src="{studio.url}/embed#robot=planar_2r"></iframe>')
    with pages_of(tmp_path) as origin:
        page = studio.page.context.new_page()
        page.goto(f"{origin}/index.html")
        page.wait_for_load_state("networkidle")
        assert not page.frames[1].url.startswith(studio.url)
        page.close()


@pytest.mark.slow
@pytest.mark.parametrize("scheme", ["light", "dark"])
def test_everyone_can_use_the_dialog(another: Callable[..., Studio], scheme: str) -> None:
    studio = another(scheme=scheme)
    studio.open("pose", robot="panda", show="frames")
    studio.button("Share").click()
    expect(studio.page.get_by_role("dialog")).to_contain_text('gelenk.show("panda", [')
    if AXE.exists():
        found = studio.run(AXE.read_text() + "; axe.run().then(({violations}) => violations.map(({id}) => id))")
        assert found == []


@pytest.mark.slow
def test_numbers_of_the_chain_alone_are_enough(studio: Studio) -> None:
    wanted = [0.1, -0.2, 0.3, -1.4, 0.5, 1.6, 0.7]
    studio.go(f"embed#robot=panda&q={','.join(map(str, wanted))}")
    studio.wait_for_robot("panda")
    found = studio.run("Object.values(studio.store.value.positions)")
    assert found[:7] == wanted, json.dumps(found)


@pytest.mark.slow
def test_the_picture_is_saved_as_it_is_drawn(studio: Studio, tmp_path: Path) -> None:
    studio.open("pose", robot="planar_2r")
    studio.button("Share").click()
    with studio.page.expect_download() as saved:
        studio.button("Save the picture").click()
    saved.value.save_as(tmp_path / "picture.png")
    content = (tmp_path / "picture.png").read_bytes()
    assert content.startswith(b"\x89PNG")
    assert len(content) > 5_000, "more than one colour"
