"""The tour: offered, never forced; each step does live what it speaks of, and the keyboard is enough."""

from collections.abc import Callable

import pytest
from playwright.sync_api import expect

from tests.studio.browser import Studio
from tests.studio.test_page import axe
from tests.studio.test_start import begin

STEPS = [
    ("Choose a robot", "robot", ".robots"),
    ("Move the joints", "pose", ".joints"),
    ("Its DH table", "robot", "table.dh"),
    ("Inverse kinematics", "ik", ".section:has(.solution)"),
    ("Worked solution", "worked", ".sheet"),
    ("Plan a motion", "trajectory", ".player"),
]


def stands(studio: Studio, step: int) -> None:
    """Wait for a step, with what it points at; the card has the focus."""
    title, panel, points = STEPS[step]
    expect(studio.page.get_by_role("dialog", name=title)).to_be_visible()
    studio.until(f"document.querySelector('[data-toured]')?.matches({points!r})")
    assert studio.state("panel") == panel
    assert studio.run("document.querySelectorAll('[data-toured]').length") == 1
    assert studio.run("document.activeElement.closest('.tour') !== null")


@pytest.mark.slow
def test_the_tour_shows_six_things_by_the_keys(studio: Studio) -> None:
    begin(studio)
    studio.button("New here? Take the tour").press("Enter")
    studio.wait_for_robot("anthropomorphic_wrist")
    stands(studio, 0)
    studio.page.keyboard.press("ArrowRight")
    stands(studio, 1)
    studio.until("studio.store.value.positions[studio.store.value.model.joints[1].name] === 0.9")
    studio.page.keyboard.press("ArrowRight")
    stands(studio, 2)
    assert studio.state("lit") == {"row": 1, "part": "a"}
    studio.page.keyboard.press("ArrowLeft")
    stands(studio, 1)
    for step in (2, 3):
        studio.page.keyboard.press("ArrowRight")
        stands(studio, step)
    studio.until("document.querySelectorAll('.solution').length === 8")
    studio.page.keyboard.press("ArrowRight")
    stands(studio, 4)
    studio.until("document.querySelector('.sheet .katex')")
    studio.page.keyboard.press("ArrowRight")
    stands(studio, 5)
    studio.page.keyboard.press("ArrowRight")  # held too long, it does not end it
    studio.until("studio.store.value.plan")
    assert studio.run("studio.store.value.plan.answer.duration") > 0
    expect(studio.button("Back to where I was")).to_be_hidden()
    studio.page.keyboard.press("Enter")
    expect(studio.page.locator(".tour")).to_have_count(0)
    expect(studio.page.locator("[data-toured]")).to_have_count(0)
    assert studio.run("document.activeElement.id") == "panel"

    studio.page.get_by_role("link", name="Gelenk").click()
    expect(studio.page.get_by_role("heading", name="Which robot?")).to_be_visible()
    expect(studio.button("New here? Take the tour")).to_be_hidden()
    expect(studio.button("Tour")).to_be_visible()


@pytest.mark.slow
def test_the_tour_brings_back_what_was_there(studio: Studio) -> None:
    studio.open("jacobian", robot="planar_2r", q="0.3,0.7")
    before = studio.address()
    studio.button("Tour").click()
    stands(studio, 0)
    for step in range(1, 6):
        studio.button("Next").click()
        stands(studio, step)
    studio.button("Back to where I was").click()
    studio.wait_for_robot("planar_2r")
    assert studio.run("document.activeElement.textContent") == "Tour"
    assert studio.address() == before
    assert list(studio.state("positions").values()) == [0.3, 0.7]
    studio.button("Tour").click()
    stands(studio, 0)
    studio.page.keyboard.press("Escape")
    expect(studio.page.locator(".tour")).to_have_count(0)
    assert studio.run("document.activeElement.textContent") == "Tour"


@pytest.mark.slow
def test_who_goes_through_it_quicker_than_the_address_follows_comes_back_too(studio: Studio) -> None:
    studio.open("jacobian", robot="planar_2r", q="0.3,0.7")
    before = studio.address()
    at_the_end = studio.run(
        """async () => {
          const card = new Promise((done) => {
            const seen = new MutationObserver(() => document.querySelector(".tour") && done());
            seen.observe(document.body, {childList: true});
          });
          for (const tool of document.querySelectorAll("#tools button"))
            if (tool.textContent === "Tour") tool.click();
          await card;
          for (let step = 1; step < 6; step++) document.querySelector(".tour .primary").click();
          const hash = location.hash;
          for (const found of document.querySelectorAll(".tour button"))
            if (found.textContent === "Back to where I was") found.click();
          return hash;
        }"""
    )
    assert before.endswith(at_the_end), "the address has not followed yet"
    studio.wait_for_robot("planar_2r")
    assert studio.address() == before
    assert studio.state("panel") == "jacobian"
    assert list(studio.state("positions").values()) == [0.3, 0.7]


@pytest.mark.slow
@pytest.mark.parametrize(("size", "scheme"), [((1440, 900), "light"), ((390, 844), "dark")])
def test_everyone_can_take_the_tour(another: Callable[..., Studio], size: tuple[int, int], scheme: str) -> None:
    """What a step points at is in sight, and the card covers no more than a part of it."""
    studio = another(width=size[0], height=size[1], scheme=scheme)
    studio.open("pose", robot="planar_2r")
    studio.button("Tour").click()
    for step in range(6):
        stands(studio, step)
        assert [found for found in axe(studio) if found[1] in {"serious", "critical"}] == []
        assert studio.run("document.documentElement.scrollWidth") == size[0]
        seen = studio.run(
            """(() => {
              const {top} = document.querySelector("[data-toured]").getBoundingClientRect();
              const card = document.querySelector(".tour").getBoundingClientRect();
              return {top, card: {top: card.top, bottom: card.bottom, left: card.left, right: card.right}};
            })()"""
        )
        assert 0 <= seen["top"] < size[1] - 20
        assert 0 <= seen["card"]["left"] < seen["card"]["right"] <= size[0]
        assert 0 < seen["card"]["top"] < seen["card"]["bottom"] <= size[1]
        if size[0] < 900:
            assert seen["top"] + 20 < seen["card"]["top"]
        if step < 5:
            studio.button("Next").click()
