"""What the picture says in numbers: distances of points, which ghost is which, rows of a matrix beside each other."""

import json
import math
from collections.abc import Callable
from typing import Any

import numpy as np
import pytest

from tests.studio.browser import Studio
from tests.studio.test_page import AXE

PLACE = """(link) => {
  const {view, store} = studio;
  const at = view.controls.target.clone().setFromMatrixPosition(store.value.model.link(link).matrixWorld);
  const world = at.toArray();
  at.project(view.camera);
  const {left, top, width, height} = view.canvas.getBoundingClientRect();
  return [world, [left + (at.x + 1) / 2 * width, top + (1 - at.y) / 2 * height]];
}"""


def measured(studio: Studio) -> list[float]:
    found: list[float] = json.loads(studio.page.locator("[data-measured]").get_attribute("data-measured") or "[]")
    return found


@pytest.mark.slow
def test_two_frames_are_measured(studio: Studio) -> None:
    """By the keyboard; and as the service says, at another configuration too."""
    studio.open("pose", robot="scara", q="0.4,0.8,0.1,0.4")
    studio.button("Measure").focus()
    studio.page.keyboard.press("Enter")
    assert studio.run("document.activeElement.getAttribute('aria-label')") == "Measure from"
    studio.field("Measure from").select_option("base")
    studio.field("Measure to").select_option("tool")
    for q in ([0.4, 0.8, 0.1, 0.4], [-1.0, 0.2, 0.05, 0.0]):
        names = [f"joint_{i}" for i in (1, 2, 3, 4)]
        studio.run("(positions) => studio.store.set({positions})", dict(zip(names, q, strict=True)))
        pose = studio.fk("scara", {"joint_positions": [q], "pose_format": "matrix"})["poses"][0]
        x, y, z = np.array(pose["matrix"])[:3, 3]
        assert measured(studio) == pytest.approx([math.hypot(x, y, z), x, y, z], abs=1e-12)
        text = f"{round(math.hypot(x, y, z), 4)} m"
        studio.until(f"document.querySelector('.label.measured')?.textContent === '{text}'")
    studio.button("Clear").click()
    assert measured(studio) == []
    studio.button("Measure").click()
    assert studio.page.locator(".measure").is_hidden()


@pytest.mark.slow
def test_what_is_not_seen_is_not_measured(studio: Studio) -> None:
    """The plane that the target's handles are dragged along is in the way of every ray, and is no thing."""
    studio.open("ik", robot="scara", q="0.4,0.8,0.1,0.4")
    studio.until("studio.store.value.target && [...studio.view.handles].length")
    studio.button("Measure").click()
    studio.drawn()
    left, top, height = studio.run(
        "(({left, top, height}) => [left, top, height])(studio.view.canvas.getBoundingClientRect())"
    )
    studio.page.mouse.click(left + 12, top + height / 3)
    assert studio.field("Measure from").input_value() == "", "there is only the background"


@pytest.mark.slow
def test_two_points_of_the_picture_are_measured(studio: Studio) -> None:
    """A press near a frame means its origin, another one a point of the surface; nothing is dragged meanwhile."""
    studio.open("pose", robot="scara", q="0.4,0.8,0.1,0.4")
    studio.button("Measure").click()
    studio.drawn()  # what stands above the picture may have changed its size
    before = studio.state("positions")
    places = [studio.run(PLACE, link) for link in ("base", "frame_1")]
    for _, (x, y) in places:
        studio.page.mouse.click(x + 3, y)
    (start, _), (end, _) = places
    assert measured(studio)[0] == pytest.approx(math.dist(start, end), abs=1e-12)
    assert studio.field("Measure to").input_value() in {"frame_1", "link_2"}, "both have their origin there"
    # Half way along the first link: on its surface, a radius from its axis.
    (start, one), (elbow, other) = (studio.run(PLACE, link) for link in ("frame_1", "frame_2"))
    studio.page.mouse.click(*one)
    studio.page.mouse.click(*(np.array(one) + other) / 2)
    length, *way = measured(studio)
    along = np.array(elbow) - start
    direction = along / np.linalg.norm(along)
    share = float(np.array(way) @ direction) / np.linalg.norm(along)
    radius = np.linalg.norm(np.array(way) - (np.array(way) @ direction) * direction)
    assert 0.35 < share < 0.65
    scale = studio.run("Math.max(...studio.store.value.model.drawnBy().get('joint_2').map(({scale}) => scale.x))")
    assert 0 < radius <= scale + 1e-6
    assert length == pytest.approx(np.linalg.norm(way))
    assert studio.state("positions") == before


@pytest.mark.slow
def test_ghosts_are_told_apart(studio: Studio) -> None:
    """Each has a colour and a number, which its solution in the list has too."""
    target = {"position": [0.4, 0.1, 0.5], "rpy": [0, 0, 0]}
    studio.open("ik", robot="anthropomorphic", target=json.dumps(target), ik=json.dumps({"solutions": "all"}))
    studio.until("document.querySelectorAll('.label.ghost').length === 4")
    studio.drawn()
    colours = studio.run("""[0, 1, 2, 3].map((i) =>
        "#" + studio.view.scene.getObjectByName(`ghost ${i}`).children[0].material.color.getHexString())""")
    assert len(set(colours)) == 4
    of = "(all) => all.map((one) => [one.textContent, getComputedStyle(one).borderTopColor])"
    labels = dict(studio.page.locator(".label.ghost").evaluate_all(of))
    marks = dict(studio.page.locator(".solution-mark").evaluate_all(of))
    assert labels == marks
    assert list(marks) == ["1", "2", "3", "4"]
    rgb = [tuple(int(colour[i : i + 2], 16) for i in (1, 3, 5)) for colour in colours]
    assert [f"rgb({r}, {g}, {b})" for r, g, b in rgb] == list(marks.values())
    studio.page.get_by_role("tab", name="Pose").click()
    assert studio.page.locator(".label.ghost").count() == 0


@pytest.mark.slow
@pytest.mark.parametrize("part", ["transforms", "pose", "jacobian"])
def test_rows_of_symbols_and_numbers_are_beside_each_other(studio: Studio, part: str) -> None:
    studio.open("worked", robot="anthropomorphic", q="0.3,0.6,-0.8", worked=part)
    studio.until("document.querySelector('.sheet .katex .mtable')")
    studio.typeset()
    found = studio.run("""[...document.querySelectorAll(".line:not(.large)")].flatMap((line) => {
      const [, column] = [...line.querySelectorAll(".mtable")].map((table) => table.firstElementChild).slice(-2)
          .length > 1 ? [null, null] : [null, line.querySelector(".mtable > span")];
      const rows = [...line.querySelectorAll(".matrix-row")];
      if (!column || rows.length < 2) return [];
      const middle = (e) => (({top, bottom}) => (top + bottom) / 2)(e.getBoundingClientRect());
      const symbols = [...column.querySelectorAll(".vlist > span > .mord")].map(middle);
      return [[symbols, rows.map(middle)]];
    })""")
    assert found
    apart = [np.subtract(symbols, numbers) for symbols, numbers in found if len(symbols) == len(numbers)]
    assert apart
    assert all(np.ptp(steps) < 1.5 for steps in apart), "rows have the same heights"
    # Where there is no room beside a formula, its numbers are below.
    assert all(np.abs(steps).max() < 4 or np.abs(steps).min() > 60 for steps in apart)
    assert part != "transforms" or any(np.abs(steps).max() < 4 for steps in apart)
    spacing = studio.run("getComputedStyle(document.querySelector('.matrix')).fontVariantNumeric")
    assert spacing == "tabular-nums"


@pytest.mark.slow
@pytest.mark.parametrize("scheme", ["light", "dark"])
def test_axe_finds_nothing_in_a_measurement(another: Callable[..., Studio], scheme: str) -> None:
    if not AXE.exists():
        pytest.skip("axe-core is not there: ./dev studio installs it")
    studio = another(scheme=scheme)
    studio.open("jacobian", robot="scara", show="dh,dimensions,parallel")
    studio.page.locator(".axes .vanishing").wait_for()  # in its table, and not over the buttons below the picture
    studio.button("Measure").click()
    studio.field("Measure from").select_option("base")
    studio.field("Measure to").select_option("tool")
    found: list[Any] = studio.run(AXE.read_text() + "; axe.run().then(({violations}) => violations)")
    assert [(entry["id"], entry["nodes"][0]["html"]) for entry in found] == []
