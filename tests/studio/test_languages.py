"""The page in German: nothing is left in English, nothing is cut off, and the service is asked in German too."""

import json
import re
from collections.abc import Callable
from pathlib import Path

import pytest
from playwright.sync_api import Request

from tests.studio.browser import Studio
from tests.studio.pure import values
from tests.studio.test_page import CUT_OFF, PANELS, axe, wait_for

GERMAN: dict[str, str] = json.loads(
    (Path(__file__).parents[2] / "app" / "studio" / "src" / "texts" / "de.json").read_text(encoding="utf-8")
)

SHOWN = """() => {
  const skipped = "code, pre, .katex, :not(html)[lang], script, style, select.plain, noscript";
  const found = [];
  const walker = document.createTreeWalker(document.body, NodeFilter.SHOW_TEXT);
  while (walker.nextNode()) {
    const {parentElement, data} = walker.currentNode;
    if (!parentElement.closest(skipped)) found.push(data.trim());
  }
  for (const element of document.querySelectorAll("[aria-label], [title], [placeholder]"))
    if (!element.closest(skipped))
      for (const name of ["aria-label", "title", "placeholder"]) found.push(element.getAttribute(name) ?? "");
  return [...new Set(found)].filter(Boolean);
}"""
"""All texts of the page, also those that are folded away, and what screen readers and the pointer get to know."""


def is_sentence(text: str) -> bool:
    """Whether it is no name that a link or joint may have too: `elbow`, `{a}: {b}`."""
    words = re.findall(r"[A-Za-z]{2,}", re.sub(r"\{\w+\}", "", text))
    return len(words) > 1 or bool(words and words[0][0].isupper())


ENGLISH = [
    re.compile(r"\{\w+\}".join(map(re.escape, re.split(r"\{\w+\}", key.strip()))).replace(r"\{\w+\}", "(.+)"))
    for key, german in GERMAN.items()
    if key != german and is_sentence(key)
]


def english(studio: Studio) -> list[str]:
    """The texts of the page that stand in the sources, as English, and have another German."""
    known = set(GERMAN.values())
    shown = [text for text in studio.run(SHOWN) if text not in known]
    return [text for text in shown if any(pattern.fullmatch(text) for pattern in ENGLISH)]


def in_german(studio: Studio) -> None:
    """Have the page in German, as one who has chosen it before."""
    studio.page.goto(f"{studio.url}/#robot=planar_2r&panel=pose")
    studio.run("localStorage.setItem('gelenk.preferences', JSON.stringify({language: 'de'}))")


@pytest.mark.slow
def test_what_nobody_reads_is_not_translated(another: Callable[..., Studio]) -> None:
    """The classes of elements are the same in both languages."""
    studio = another(width=1440, height=900)
    found: list[set[str]] = []
    for prepare in (lambda _: None, in_german):
        prepare(studio)
        studio.open("pose", robot="anthropomorphic", show="dh,dimensions")
        studio.page.locator(".label.dimension:visible").first.wait_for()
        studio.page.locator(".agreement[data-tone=good]").wait_for()
        found.append(set())
        for panel in ("pose", "jacobian"):
            studio.run("(panel) => studio.store.set({panel})", panel)
            wait_for(studio, panel)
            classes = studio.run("[...document.querySelectorAll('*')].flatMap(({classList}) => [...classList])")
            found[-1].update(f"{panel} {name}" for name in classes)
    assert found[0] == found[1]


@pytest.mark.slow
def test_no_panel_has_english_left(another: Callable[..., Studio]) -> None:
    studio = another(width=1440, height=900)
    in_german(studio)
    studio.open("robot", robot="anthropomorphic", show="dh")
    assert studio.run("document.documentElement.lang") == "de"
    assert studio.page.locator("#tab-trajectory").inner_text() == "Trajektorie"
    left = {}
    for panel in PANELS:
        studio.run("(panel) => studio.store.set({panel})", panel)
        wait_for(studio, panel)
        left[panel] = english(studio)
    assert {panel: texts for panel, texts in left.items() if texts} == {}


@pytest.mark.slow
def test_a_check_of_the_walk_finds_the_english_page(studio: Studio) -> None:
    studio.open("pose", robot="planar_2r")
    assert {"Joints", "Dark", "Each joint of the chain in the middle of its range"} <= set(english(studio))


@pytest.mark.slow
@pytest.mark.parametrize("panel", PANELS)
def test_german_words_have_room_on_a_narrow_page(another: Callable[..., Studio], panel: str) -> None:
    """Nothing is cut off that English has room for; axe finds nothing serious."""
    studio = another(width=390, height=844)
    cut = []
    for language in ("en", "de"):
        if language == "de":
            in_german(studio)
        studio.open(panel, robot="planar_3r")
        wait_for(studio, panel)
        assert studio.run("document.documentElement.lang") == language
        assert studio.run("document.documentElement.scrollWidth") == 390
        cut.append(set(studio.run(CUT_OFF)))
    assert cut[1] <= cut[0]
    assert [found for found in axe(studio) if found[1] in {"serious", "critical"}] == []


@pytest.mark.slow
def test_german_words_have_room_on_every_width(another: Callable[..., Studio]) -> None:
    studio = another(width=1920, height=1080)
    in_german(studio)
    studio.open("compare", robot="planar_2r")
    for width in (1920, 1500, 1480, 1479, 1440, 1366, 1280, 1152, 1151, 1024):
        studio.page.set_viewport_size({"width": width, "height": 900})
        assert studio.run("document.documentElement.scrollWidth") == width


@pytest.mark.slow
def test_the_language_is_chosen_kept_and_asked_for(studio: Studio) -> None:
    """It changes on the page, whose link stays, lasts over a reload, and goes with each request."""
    asked: list[str] = []
    studio.open("pose", robot="planar_2r", q="0.3,0.4")
    studio.page.locator(".agreement[data-tone=good]").wait_for()  # nothing more is asked in English

    def note(request: Request) -> None:
        if "/v1/" in request.url and "accept-language" in request.headers:  # a picture has the browser's own
            asked.append(request.headers["accept-language"])

    studio.page.on("request", note)
    studio.button("DE: die Seite auf Deutsch").click()
    studio.page.locator("html[lang=de]").wait_for()
    studio.wait_for_robot("planar_2r")
    assert studio.run("Object.values(studio.store.value.positions)") == [0.3, 0.4]
    assert studio.button("Dunkel").is_visible()
    assert set(asked) == {"de"}
    studio.page.reload()
    studio.wait_for_robot("planar_2r")
    assert studio.run("document.documentElement.lang") == "de"
    studio.button("EN: the page in English").click()
    studio.page.locator("html[lang=en]").wait_for()
    studio.wait_for_robot("planar_2r")
    assert studio.button("Dark").is_visible()
    assert asked[-1] == "en"
    studio.page.remove_listener("request", note)  # other tests have the same page


@pytest.mark.slow
def test_without_the_german_texts_the_page_works_in_english(studio: Studio) -> None:
    in_german(studio)
    studio.page.route("**/chunks/de-*.js", lambda route: route.fulfill(status=200, content_type="text/plain", body=""))
    studio.open("pose", robot="planar_2r")
    assert studio.button("Dark").is_visible()
    studio.complaints = [text for text in studio.complaints if "module script" not in text]


def test_values_are_put_into_texts() -> None:
    calls = [
        "m.t('{a} of {b}: {a}', {a: 1, b: '2.50 m'})",
        "m.t('{none}', {})",
        "m.t('{toString}')",
        "m.within('Line')",
    ]
    assert values("texts/index.ts", calls) == ["1 of 2.50 m: 1", "{none}", "{toString}", "line"]
