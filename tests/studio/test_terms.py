"""The "i" beside a term: one sentence, a page of the handbook that there is, and a keyboard that reaches both."""

from collections.abc import Callable
from pathlib import Path
from urllib.parse import unquote

import pytest
from playwright.sync_api import expect

from tests.studio.browser import Studio
from tests.studio.pure import values
from tests.studio.tables import open_editor
from tests.studio.test_page import axe

DOCS = Path(__file__).parents[2] / "docs"


def test_each_term_has_one_sentence_and_a_page() -> None:
    terms = values("ui/terms.ts", ["m.TERMS"])[0]
    assert len(terms) > 15
    for title, term in terms.items():
        assert term["text"].endswith("."), title
        assert ". " not in term["text"], f"{title}: one sentence"
        assert (DOCS / term["page"]).with_suffix(".md").is_file(), f"{title}: {term['page']}"


@pytest.mark.slow
def test_a_term_is_explained_where_it_stands(studio: Studio) -> None:
    studio.open("jacobian", robot="planar_2r")
    asking = studio.button("What is: Singularity")
    asking.focus()
    studio.page.keyboard.press("Enter")
    bubble = studio.page.locator(".info-bubble:popover-open")
    expect(bubble).to_contain_text("J loses rank.")
    expect(bubble.get_by_role("link", name="Handbook")).to_have_attribute(
        "href", "handbook/course/inverse-velocities.html"
    )
    place = bubble.bounding_box()
    assert place is not None
    assert 0 <= place["x"] <= place["x"] + place["width"] <= 1024
    assert 0 <= place["y"] <= place["y"] + place["height"] <= 640
    assert axe(studio) == []
    studio.page.keyboard.press("Tab")
    assert studio.run("document.activeElement.textContent") == "Handbook"
    studio.page.keyboard.press("Escape")
    expect(bubble).to_have_count(0)
    assert studio.run("document.activeElement.getAttribute('aria-label')") == "What is: Singularity"


@pytest.mark.slow
def test_every_panel_that_has_terms_explains_them(studio: Studio) -> None:
    wanted = {"pose": "Tip", "ik": "Target", "trajectory": "Law of time", "workspace": "Workspace", "cell": "Contact"}
    studio.open("pose", robot="planar_2r")
    for panel, term in wanted.items():
        studio.run("(panel) => studio.store.set({panel})", panel)
        expect(studio.page.locator(f"[aria-label='What is: {term}']")).to_have_count(1)


@pytest.mark.slow
@pytest.mark.parametrize("width", [1024, 390])
def test_each_column_of_a_table_is_explained(another: Callable[..., Studio], width: int) -> None:
    studio = another(width=width, height=844)
    open_editor(studio)
    terms = ["Length a", "Twist α", "Offset d", "Angle θ", "Lower limit", "Upper limit"]
    heads = studio.page.locator("table.dh thead th:has(.info)")
    asked = [heads.nth(i).locator(".info") for i in range(heads.count())]
    assert [button.get_attribute("aria-label") for button in asked] == [f"What is: {term}" for term in terms]
    asked[3].click()
    expect(studio.page.locator(".info-bubble:popover-open")).to_contain_text("revolute joint it is the variable.")
    assert axe(studio) == []
    assert studio.run("document.documentElement.scrollWidth") == width


@pytest.mark.slow
def test_what_few_need_is_folded_until_it_is_used(studio: Studio) -> None:
    studio.open("ik", robot="planar_2r")
    expect(studio.field("Position tolerance")).to_be_hidden()
    studio.page.get_by_text("Directions and tolerances").click()
    studio.type("Position tolerance", "1e-4")
    assert "position_tolerance" in unquote(studio.address())
    studio.page.reload()
    studio.wait_for_robot("planar_2r")
    expect(studio.field("Position tolerance")).to_be_visible()
