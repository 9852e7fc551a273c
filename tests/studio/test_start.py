"""The first screen: what a person without a link finds, and how it is left."""

from collections.abc import Callable

import pytest
from playwright.sync_api import Route, expect

from tests.studio.browser import Studio
from tests.studio.pure import values
from tests.studio.test_load import BARE
from tests.studio.test_page import axe


def begin(studio: Studio) -> None:
    """Open the page at no address, as on the first day."""
    studio.go("")
    studio.until("document.querySelectorAll('.door').length === 6")


@pytest.mark.slow
def test_an_address_without_a_robot_offers_six_doors(studio: Studio) -> None:
    begin(studio)
    assert studio.state("model") is None
    assert (
        studio.run("performance.getEntriesByType('resource').filter(({name}) => name.includes('/meshes/')).length") == 0
    )
    expect(studio.page.get_by_role("tablist")).to_be_hidden()
    assert studio.run("[...document.querySelectorAll('.door img')].every((e) => e.alt === '' && e.loading === 'lazy')")
    studio.until("[...document.querySelectorAll('.door img')].every((e) => e.complete && e.naturalWidth > 0)")
    studio.page.get_by_role("link", name="Two links").click()
    studio.wait_for_robot("planar_2r")
    expect(studio.page.get_by_role("tab", name="Pose", exact=True)).to_be_visible()
    assert "robot=planar_2r" in studio.address()
    studio.page.go_back()
    expect(studio.page.get_by_role("heading", name="Which robot?")).to_be_visible()
    studio.page.get_by_role("link", name="Go on where you were: planar_2r").click()
    studio.wait_for_robot("planar_2r")
    studio.page.get_by_role("link", name="Gelenk").click()
    expect(studio.page.get_by_role("heading", name="Which robot?")).to_be_visible()


@pytest.mark.slow
def test_one_goes_on_where_one_was(studio: Studio) -> None:
    studio.open("jacobian", robot="scara", q="0.1,0.2,0.03,0.4")
    link = studio.address()
    studio.go("")
    studio.page.get_by_role("link", name="Go on where you were: scara").click()
    studio.wait_for_robot("scara")
    assert studio.address() == link
    assert list(studio.state("positions").values()) == [0.1, 0.2, 0.03, 0.4]


@pytest.mark.slow
def test_a_card_names_the_first_robot_that_the_service_has(studio: Studio) -> None:
    begin(studio)
    has = {robot["name"] for robot in studio.run("studio.api.get('v1/robots')")["robots"]}
    wanted = "ur5e" if "ur5e" in has else "ur5"
    studio.page.get_by_role("link", name=wanted.replace("ur", "UR")).first.click()
    studio.wait_for_robot(wanted)


@pytest.mark.slow
def test_ones_own_file_is_a_door(studio: Studio) -> None:
    begin(studio)
    with studio.page.expect_file_chooser() as chooser:
        studio.page.get_by_role("button", name="Your own file").click()
    text = BARE.replace('"r"', '"own_door"').encode()
    chooser.value.set_files({"name": "door.urdf", "mimeType": "application/xml", "buffer": text})
    studio.wait_for_robot("own_door")
    assert studio.state("panel") == "robot"


@pytest.mark.slow
def test_cards_that_are_made_anew_keep_the_focus(studio: Studio) -> None:
    """The list of robots comes while somebody is already on a card."""
    held: list[Route] = []

    def hold(route: Route) -> None:
        held.append(route)

    studio.page.route("**/v1/robots", hold)
    with studio.page.expect_request("**/v1/robots"):
        begin(studio)
    studio.page.get_by_role("link", name="SCARA").focus()
    studio.run("globalThis.card = document.activeElement")
    held[0].continue_()
    studio.until("!card.isConnected")
    assert studio.run("document.activeElement.textContent.startsWith('SCARA')")
    studio.page.keyboard.press("Enter")
    studio.wait_for_robot("scara")
    assert studio.run("document.activeElement.id") == "panel"


@pytest.mark.slow
@pytest.mark.parametrize("fragment", ["#panel=pose", "#robot=panda"])
def test_a_link_goes_straight_to_its_robot(studio: Studio, fragment: str) -> None:
    studio.go(fragment)
    studio.wait_for_robot("panda")
    expect(studio.page.locator("#start")).to_be_hidden()


@pytest.mark.slow
@pytest.mark.parametrize("scheme", ["light", "dark"])
@pytest.mark.parametrize("size", [(1440, 900), (390, 844)])
def test_everyone_can_use_the_first_screen(another: Callable[..., Studio], scheme: str, size: tuple[int, int]) -> None:
    studio = another(width=size[0], height=size[1], scheme=scheme)
    begin(studio)
    assert axe(studio) == []
    assert studio.run("document.documentElement.scrollWidth") == size[0]
    reached = set()
    for _ in range(20):
        studio.page.keyboard.press("Tab")
        reached.add(studio.run("document.activeElement.textContent.trim()"))
    for door in ("Two links", "SCARA", "Arm with a wrist", "UR5", "Panda", "Your own file", "Exercises"):
        assert any(text.startswith(door) for text in reached), door


@pytest.mark.slow
def test_what_stays_behind_the_first_screen_keeps_its_name(studio: Studio) -> None:
    """A robot, and a draft: the address names what is on the screen, and the keyboard goes on in the panel."""
    for draft in (False, True):
        studio.open("robot", robot="planar_2r")
        if draft:
            table = studio.run("studio.store.value.model.info.dh")
            studio.run("(draft) => studio.store.set({robot: '', draft})", table)
            studio.wait_for_robot(None)
        before = studio.address()
        assert ("dh-table=" in before) == draft
        studio.page.get_by_role("link", name="Gelenk").click()
        studio.page.get_by_role("button", name="Type a DH table").press("Enter")
        assert studio.run("document.activeElement.id") == "panel"
        studio.wait_for_robot(None if draft else "planar_2r")
        assert studio.state("robot") == ("" if draft else "planar_2r")
        assert studio.state("draft") == (table if draft else None)
        studio.until(f"location.hash.includes('{'dh-table=' if draft else 'robot=planar_2r'}')")


@pytest.mark.slow
def test_all_robots_are_those_of_the_catalogue(studio: Studio) -> None:
    """Also where the panel had another part open before."""
    studio.open("robot", robot="planar_2r")
    studio.button("Upload").click()
    studio.page.get_by_role("link", name="Gelenk").click()
    studio.page.get_by_role("link", name="All robots of the catalogue").click()
    expect(studio.button("Catalogue")).to_have_attribute("aria-pressed", "true")


def test_what_is_kept_of_another_edition_is_as_nothing() -> None:
    kept = ["null", "[]", "{hash: 1, title: ''}", "{hash: 'https://x', title: 'a'}", "{hash: '#robot=a', title: 'a'}"]
    assert values("start/last.ts", [f"m.asLast({text})" for text in kept]) == [
        *[None] * 4,
        {"hash": "#robot=a", "title": "a"},
    ]
