"""What the page asks for and tells in front of everything else: a key of the service, and what the keyboard does."""

from collections.abc import Callable
from pathlib import Path

import pytest
from playwright.sync_api import Request, expect

from gelenk.contract.endpoint import Scope
from gelenk.http.access.keyring import new_key
from tests.studio.browser import Studio
from tests.studio.test_page import AXE
from tests.studio.test_workspace import compute
from tests.test_serve import service


@pytest.mark.slow
def test_a_key_is_asked_for_where_the_service_wants_one(another: Callable[..., Studio], tmp_path: Path) -> None:
    """Once, however many calls are refused; it goes with calls and meshes, is kept over a reload and never shown."""
    token, key = new_key("lab", [Scope.READ, Scope.WRITE])
    with service(tmp_path / "data", GELENK_API_KEYS=key.entry()) as (_, url):
        studio = another(at=url)
        studio.expected = {401}
        sent: list[str | None] = []

        def note(request: Request) -> None:
            if "/v1/" in request.url:
                sent.append(request.headers.get("authorization"))

        studio.page.on("request", note)
        studio.go("#panel=workspace&robot=ur5")
        dialog = studio.page.get_by_role("dialog", name="This service wants a key")
        expect(dialog).to_have_count(1)
        expect(dialog).to_contain_text("can give you one")
        if AXE.exists():
            found = studio.run(AXE.read_text() + "; axe.run().then(({violations}) => violations.map(({id}) => id))")
            assert found == []
        studio.field("Key").fill("gelenk.lab.wrong")
        studio.button("Use it").click()
        expect(dialog).to_contain_text("key", ignore_case=True)
        expect(dialog).not_to_contain_text("can give you one")
        studio.field("Key").fill(token)
        studio.field("Key").press("Enter")
        studio.wait_for_robot("ur5")
        assert studio.run("studio.store.value.model.meshes.failed.length") == 0
        expect(dialog).to_have_count(0)

        before = len(sent)
        compute(studio)
        studio.page.locator(".request summary").first.click()
        shown = studio.page.locator(".request code").first.text_content() or ""
        assert "$GELENK_KEY" in shown
        assert token not in studio.page.content()
        studio.page.reload()
        studio.wait_for_robot("ur5")
        assert set(sent[before:]) == {f"Bearer {token}"}

        studio.button("Key").click()
        again = studio.page.get_by_role("dialog", name="This service wants a key")
        again.get_by_role("button", name="Cancel").click()
        expect(again).to_have_count(0)


@pytest.mark.slow
def test_who_has_no_key_is_told_so(another: Callable[..., Studio], tmp_path: Path) -> None:
    _, key = new_key("lab", [Scope.READ])
    with service(tmp_path / "data", GELENK_API_KEYS=key.entry()) as (_, url):
        studio = another(at=url)
        studio.expected = {401}
        studio.go("#panel=robot&robot=ur5")
        studio.page.get_by_role("dialog").get_by_role("button", name="Cancel").click()
        expect(studio.page.get_by_role("dialog")).to_have_count(0)
        studio.page.get_by_text("this needs a key").first.wait_for()
        expect(studio.button("Key")).to_be_visible()


@pytest.mark.slow
def test_the_keyboard_tells_what_it_does(studio: Studio) -> None:
    studio.open("pose", robot="planar_2r")
    assert not studio.button("Key").is_visible()
    studio.page.locator("canvas").first.focus()
    studio.page.keyboard.press("?")
    dialog = studio.page.get_by_role("dialog", name="Keyboard")
    for told in ("The panel beside", "The whole robot", "Play, pause"):
        expect(dialog).to_contain_text(told)
    studio.page.keyboard.press("?")
    expect(dialog).to_have_count(1)
    studio.page.keyboard.press("Escape")
    expect(dialog).to_have_count(0)
    studio.button("Help").click()
    if AXE.exists():
        found = studio.run(AXE.read_text() + "; axe.run().then(({violations}) => violations.map(({id}) => id))")
        assert found == []
    dialog.get_by_role("button", name="Close").click()
    expect(dialog).to_have_count(0)
    studio.run("document.querySelector('input.number')?.focus()")
    studio.page.keyboard.press("?")
    expect(dialog).to_have_count(0)
