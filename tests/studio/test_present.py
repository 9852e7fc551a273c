"""Presenting: type that the last row reads, what is left out, and the keys of a presenter."""

from collections.abc import Callable

import pytest
from playwright.sync_api import expect

from tests.studio.browser import Studio
from tests.studio.test_page import axe

SIZES = """(() => {
  const walker = document.createTreeWalker(document.body, NodeFilter.SHOW_TEXT);
  const found = [];
  while (walker.nextNode()) {
    const {parentElement: parent, data} = walker.currentNode;
    if (!data.trim() || !parent.checkVisibility() || parent.closest(".unseen, .katex, option")) continue;
    found.push([data.trim(), parseFloat(getComputedStyle(parent).fontSize) * parent.currentCSSZoom]);
  }
  return found;
})()"""
"""Each text in sight, and how large it is on the screen, [px]."""


@pytest.mark.slow
def test_type_is_large_and_only_what_matters_stays(another: Callable[..., Studio]) -> None:
    studio = another(width=1920, height=1080)
    studio.open("pose", robot="scara", show="names")
    studio.button("Present").click()
    expect(studio.page.get_by_role("tablist")).to_be_hidden()
    expect(studio.page.get_by_text("As request")).to_be_hidden()
    sizes = studio.run(SIZES)
    assert len(sizes) > 20
    assert [(text, size) for text, size in sizes if size < 24] == []
    assert studio.run("document.documentElement.scrollWidth") == 1920
    assert axe(studio) == []
    studio.button("Leave").click()
    expect(studio.page.get_by_role("tablist")).to_be_visible()
    assert studio.run("document.activeElement.textContent") == "Present"


@pytest.mark.slow
def test_keys_step_through_the_panels_and_hide_them(another: Callable[..., Studio]) -> None:
    studio = another(width=1440, height=900)
    studio.open("pose", robot="planar_2r")
    studio.button("Present").click()
    studio.page.keyboard.press("PageDown")
    assert studio.state("panel") == "ik"
    studio.page.keyboard.press("PageUp")
    studio.page.keyboard.press("PageUp")
    assert studio.state("panel") == "robot"
    studio.page.keyboard.press("PageUp")
    assert studio.state("panel") == "exercises", "the last one is before the first"
    studio.page.keyboard.press("PageDown")
    studio.page.keyboard.press("PageDown")
    studio.page.keyboard.press("h")
    expect(studio.page.locator("#panel")).to_be_hidden()
    assert studio.run("document.querySelector('.view').clientWidth") == 1440
    studio.button("Show panel").click()
    assert studio.run("document.querySelector('#panel').getBoundingClientRect().width") == 720
    studio.field("joint_1, number").focus()
    studio.page.keyboard.type("h")
    expect(studio.page.locator("#panel")).to_be_visible()
    studio.page.keyboard.press("Escape")
    studio.button("Next panel").focus()
    studio.page.keyboard.press("Escape")
    expect(studio.page.get_by_role("tablist")).to_be_visible()


@pytest.mark.slow
def test_who_leaves_before_the_screen_is_full_is_not_left_with_a_full_one(studio: Studio) -> None:
    studio.open("pose", robot="planar_2r")
    studio.run("""() => {
      globalThis.left = 0;
      document.documentElement.requestFullscreen = () => new Promise((done) => (globalThis.fill = done));
      document.exitFullscreen = () => Promise.resolve((left += 1));
    }""")
    for kept in (True, False):
        studio.button("Present").click()
        if not kept:
            studio.button("Leave").click()
        studio.run("fill()")
        studio.drawn()
        assert studio.run("left") == (0 if kept else 1)
        if kept:
            studio.button("Leave").click()
