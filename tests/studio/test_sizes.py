"""The page in windows of each size: nothing is out of sight, covered, or torn."""

from collections.abc import Callable

import pytest

from tests.studio.browser import Studio

WRIST = {"robot": "anthropomorphic_wrist", "q": "0.4,0.9,-1.2,0.3,0.7,0.2"}

OUT_OF_SIGHT = """[...document.querySelectorAll(".tab")].filter((tab) => {
  const {left, right, top, height} = tab.getBoundingClientRect();
  const seen = [left + 2, right - 2].map((x) => document.elementFromPoint(x, top + height / 2));
  return seen.some((element) => element?.closest(".tab") !== tab);
}).map((tab) => tab.textContent)"""


@pytest.mark.slow
@pytest.mark.parametrize("width", [720, 1024, 1152, 1440])
def test_every_tab_is_in_sight(another: Callable[..., Studio], width: int) -> None:
    studio = another(width=width, height=768)
    studio.open("pose", robot="planar_2r")
    assert studio.run(OUT_OF_SIGHT) == []


@pytest.mark.slow
@pytest.mark.parametrize("size", [(720, 450), (844, 390)])
def test_a_wide_and_low_window_has_picture_and_panel_beside_each_other(
    another: Callable[..., Studio], size: tuple[int, int]
) -> None:
    """A laptop at 200 %, and a telephone on its side."""
    studio = another(width=size[0], height=size[1])
    studio.open("pose", robot="planar_2r")
    view, panel = (
        studio.run("(place) => document.querySelector(place).getBoundingClientRect().toJSON()", place)
        for place in (".view", "#panel")
    )
    assert view["height"] == panel["height"] > 0.7 * size[1]
    assert view["right"] <= panel["left"]
    assert panel["right"] == size[0]
    assert view["width"] > 0.4 * size[0]


@pytest.mark.slow
def test_a_label_never_covers_a_button(another: Callable[..., Studio]) -> None:
    studio = another(width=1024, height=768)
    studio.open("pose", **WRIST, show="dh,dimensions")
    studio.until("[...document.querySelectorAll('.label.dimension')].some(({offsetWidth}) => offsetWidth > 0)")
    front = studio.run("""() => {
      const button = document.querySelector(".marks .toggle");
      const label = [...document.querySelectorAll(".label.dimension")].find(({offsetWidth}) => offsetWidth > 0);
      const {left, top, width, height} = button.getBoundingClientRect();
      Object.assign(label.style, {pointerEvents: "auto", transform: "none", translate: "none"});
      Object.assign(label.style, {position: "fixed", zIndex: 100});
      Object.assign(label.style, {left: `${left}px`, top: `${top}px`, width: `${width}px`, height: `${height}px`});
      return document.elementFromPoint(left + width / 2, top + height / 2).className;
    }""")
    assert front == "toggle"


@pytest.mark.slow
def test_the_chain_above_the_picture_leaves_undo_alone(another: Callable[..., Studio]) -> None:
    studio = another(width=390, height=844)
    studio.open("pose", robot="panda")
    chain, undo = (
        studio.run("(place) => document.querySelector(place).getBoundingClientRect().toJSON()", place)
        for place in (".chain select:last-of-type", ".undoing")
    )
    assert chain["right"] <= undo["left"]
    assert chain["width"] > 30


@pytest.mark.slow
def test_options_of_a_choice_stay_on_one_line(another: Callable[..., Studio]) -> None:
    studio = another(width=390, height=844)
    studio.open("worked", robot="planar_2r")
    heights = studio.run("[...document.querySelectorAll('.choice-option')].map((option) => option.offsetHeight)")
    assert len(heights) > 5
    assert max(heights) < 36


@pytest.mark.slow
def test_a_motion_and_its_audit_fit_a_small_window(another: Callable[..., Studio]) -> None:
    studio = another(width=720, height=450)
    studio.open("trajectory", robot="panda", q="0.1,-0.5,0.2,-2,0.1,1.5,0.7,0.02")
    studio.button("Joint target").click()
    studio.button("Plan").click()
    studio.page.locator(".findings .of", has_text="joint1").first.wait_for()
    parts = "[...document.querySelectorAll('.panel .part')]"
    wide = f"{parts}.filter((one) => one.scrollWidth > one.clientWidth + 1).length"
    assert studio.run(wide) == 0


@pytest.mark.slow
def test_names_are_written_out_where_there_is_room(another: Callable[..., Studio]) -> None:
    """Of a robot that is presented, and of the branches of a target."""
    cut = "(name) => [...document.querySelectorAll(name)].filter((one) => one.scrollWidth > one.clientWidth).length"
    studio = another(width=1440, height=900)
    studio.open("pose", **WRIST)
    studio.button("Present").click()
    assert studio.run(cut, "h1") == 0
    studio.button("Leave").click()
    studio.run("studio.store.set({inverse: {solutions: 'all'}, panel: 'ik'})")
    studio.until("document.querySelectorAll('.solution').length > 4")
    assert studio.run(cut, ".solution-name") == 0


@pytest.mark.slow
@pytest.mark.parametrize("size", [(720, 450), (1024, 768), (390, 844)])
def test_a_high_dialog_can_be_closed_without_scrolling(another: Callable[..., Studio], size: tuple[int, int]) -> None:
    studio = another(width=size[0], height=size[1])
    studio.page.emulate_media(reduced_motion="reduce")
    studio.open("robot", **WRIST)
    studio.button("DH table").click()
    studio.until("studio.store.value.table")
    studio.button("Construction").click()
    studio.page.locator(".construction-build").nth(1).wait_for()
    tops = studio.run("[...document.querySelectorAll('.construction-build')].map((one) => one.offsetTop)")
    assert (tops[0] == tops[1]) == (size[0] >= 720), "both conventions beside each other"
    box = studio.button("Close").bounding_box()
    assert box is not None
    assert box["y"] + box["height"] <= size[1]
    studio.run("document.querySelector('dialog[open]').scrollTo(0, 0)")
    x, y = box["x"] + box["width"] / 2, box["y"] + box["height"] / 2
    assert studio.run("([x, y]) => document.elementFromPoint(x, y).textContent", [x, y]) == "Close"
