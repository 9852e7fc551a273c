"""The construction of a DH table: motion by motion, in both conventions."""

import json
import math
from collections.abc import Callable
from typing import Any

import numpy as np
import pytest

from tests.oracles import catalogue
from tests.studio.browser import Studio
from tests.studio.test_page import AXE
from tests.test_serve import get

FRAMES = "[...Array({count} + 1).keys()].map((i) => studio.store.value.model.link(`frame_${{i}}`).matrixWorld.elements)"
STEP = "Number(document.querySelector('dialog input[aria-label=Step]').value)"


def open_construction(studio: Studio, robot: str, **address: str) -> None:
    studio.page.emulate_media(reduced_motion="reduce")
    studio.open("robot", robot=robot, **address)
    studio.button("DH table").click()
    studio.until("studio.store.value.table")
    studio.button("Construction").click()
    studio.page.locator(".construction-build").nth(1).wait_for()


def so_far(studio: Studio, convention: str) -> np.ndarray[Any, Any]:
    build = studio.page.locator(f".construction-build[data-convention={convention}]")
    return np.array(json.loads(build.get_attribute("data-transform") or ""))


def factor(part: str, value: float) -> np.ndarray[Any, Any]:
    """One motion, written out."""
    c, s = math.cos(value), math.sin(value)
    return np.array(
        {
            "theta": [[c, -s, 0, 0], [s, c, 0, 0], [0, 0, 1, 0], [0, 0, 0, 1]],
            "alpha": [[1, 0, 0, 0], [0, c, -s, 0], [0, s, c, 0], [0, 0, 0, 1]],
            "d": [[1, 0, 0, 0], [0, 1, 0, 0], [0, 0, 1, value], [0, 0, 0, 1]],
            "a": [[1, 0, 0, value], [0, 1, 0, 0], [0, 0, 1, 0], [0, 0, 0, 1]],
        }[part]
    )


ORDER = {"standard": ("theta", "d", "a", "alpha"), "modified": ("alpha", "a", "theta", "d")}


@pytest.mark.slow
@pytest.mark.parametrize("robot", ["scara", "panda_dh"])
def test_every_step_multiplies_one_motion(studio: Studio, robot: str) -> None:
    """Against products of the service's tables, written here; each row ends at a frame of the service's URDF."""
    open_construction(studio, robot)
    table = catalogue.dh_table(robot)
    count = len(table["joints"])
    frames = np.array(studio.run(FRAMES.format(count=count))).reshape(-1, 4, 4).transpose(0, 2, 1)
    q = studio.state("positions")
    for convention, order in ORDER.items():
        studio.button("First").click()
        status, answer = get(f"{studio.url}/v1/dh/convert", "POST", {"dh": table, "convention": convention})
        assert status == 200
        T = so_far(studio, convention)
        step = 0
        for i, row in enumerate(answer["dh"]["joints"]):
            values = {part: float(row[part]) for part in order}
            values["theta" if row["type"] == "revolute" else "d"] += q[row["name"]]
            for part in order:
                studio.button("Next").click()
                step += 1
                assert studio.run(STEP) == step
                T = T @ factor(part, values[part])
                assert np.abs(so_far(studio, convention) - T).max() < 1e-12, (convention, step)
            if convention == table["convention"]:
                assert np.abs(T - frames[i + 1]).max() < 1e-12
        assert studio.page.locator(".construction-place").text_content() == f"Step {4 * count} of {4 * count}"


@pytest.mark.slow
def test_keys_step_and_play(studio: Studio) -> None:
    open_construction(studio, "anthropomorphic", q="0.3,0.6,-0.8")
    keyboard = studio.page.keyboard
    said = studio.page.locator("[data-convention=standard] .construction-step")
    assert "Frame 0" in (said.text_content() or "")
    for key, step, text in (
        ("ArrowRight", 1, "Row 1: turn about z₀ by θ₁ = 0.3 rad."),
        ("End", 12, "Row 3: turn about x₃ by α₃ = 0 rad. This is frame 3."),
        ("ArrowLeft", 11, "Row 3: move along x₃ by a₃ = 0.4 m."),
        ("Home", 0, "Frame 0"),
    ):
        keyboard.press(key)
        assert studio.run(STEP) == step
        assert text in (said.text_content() or "")
    assert studio.page.locator("[data-convention=modified] .construction-table thead").text_content() == "iαᵢaᵢθᵢdᵢ"
    studio.page.get_by_label("Step", exact=True).focus()
    keyboard.press(" ")
    studio.until(f"{STEP} === 12")
    studio.button("Play").wait_for()  # once the last motion has been shown
    before = studio.page.locator("[data-convention=standard] svg polyline.moving").first.get_attribute("points")
    studio.page.get_by_label("Turn the pictures", exact=True).focus()
    keyboard.press("ArrowRight")
    assert studio.run(STEP) == 12, "these arrows are the slider's own"
    after = studio.page.locator("[data-convention=standard] svg polyline.moving").first.get_attribute("points")
    assert before != after
    keyboard.press("Escape")
    studio.until("document.querySelector('dialog') === null")


@pytest.mark.slow
def test_a_motion_is_seen_on_its_way(studio: Studio) -> None:
    """Where motion is welcome, the frame goes through what lies between two steps."""
    open_construction(studio, "planar_2r", q="1.2,0.5")
    studio.page.emulate_media(reduced_motion="no-preference")
    studio.run("""() => {
      const now = requestAnimationFrame.bind(globalThis);
      let time = performance.now();  // of frames that none is late of, however busy the machine is
      globalThis.requestAnimationFrame = (draw) => now(() => draw((time += 50)));
      const build = document.querySelector(".construction-build");
      globalThis.seen = [];
      const note = () => seen.push(JSON.parse(build.dataset.transform)[0][0]);
      new MutationObserver(note).observe(build, {attributes: true});
    }""")
    studio.button("Next").click()
    studio.until(f"Math.abs(seen.at(-1) - {math.cos(1.2)}) < 1e-12")
    seen = studio.run("seen")
    assert sorted(seen, reverse=True) == seen, "it turns one way"
    assert any(math.cos(1.2) + 1e-6 < value < 1 - 1e-6 for value in seen)


@pytest.mark.slow
def test_without_motion_it_plays_step_by_step(studio: Studio) -> None:
    open_construction(studio, "planar_2r")
    studio.run("""() => {
      globalThis.places = [];
      const place = document.querySelector(".construction-place");
      new MutationObserver(() => places.push(place.textContent)).observe(place, {childList: true});
    }""")
    studio.button("Play").click()
    assert studio.button("Pause").is_visible()
    last = studio.run("Number(document.querySelector('dialog input[aria-label=Step]').max)")
    studio.button("Play").wait_for()
    assert studio.run("places") == [f"Step {i} of {last}" for i in range(1, last + 1)]


@pytest.mark.slow
def test_two_presses_open_one_dialog(studio: Studio) -> None:
    open_construction(studio, "planar_2r")
    studio.page.keyboard.press("Escape")
    studio.until("document.querySelector('dialog') === null")
    studio.run("""[...document.querySelectorAll("button")].filter((e) => e.textContent === "Construction")
      .forEach((e) => { e.click(); e.click(); })""")
    studio.page.locator(".construction-build").nth(1).wait_for()
    at = "new Promise((done) => setTimeout(() => done(document.querySelectorAll('dialog').length), 500))"
    assert studio.run(at) == 1


@pytest.mark.slow
@pytest.mark.parametrize("scheme", ["light", "dark"])
@pytest.mark.parametrize("size", [(1440, 900), (390, 844)])
def test_it_can_be_read(another: Callable[..., Studio], scheme: str, size: tuple[int, int]) -> None:
    """Side by side where there is room, else one above the other; nothing that axe objects to."""
    studio = another(scheme=scheme, width=size[0], height=size[1])
    open_construction(studio, "scara")
    for _ in range(6):
        studio.page.keyboard.press("ArrowRight")
    boxes = [build.bounding_box() for build in studio.page.locator(".construction-build").all()]
    one, other = boxes
    assert one
    assert other
    assert (one["y"] == other["y"]) == (size[0] > 1000)
    assert studio.run("(({scrollWidth, clientWidth}) => scrollWidth <= clientWidth)(document.querySelector('dialog'))")
    if AXE.exists():
        found: list[Any] = studio.run(AXE.read_text() + "; axe.run('dialog').then(({violations}) => violations)")
        assert [(entry["id"], entry["nodes"][0]["html"]) for entry in found] == []
