"""What stays: preferences in the browser, theme and camera in the link."""

from collections.abc import Callable
from typing import Any

import pytest

from tests.studio.browser import Studio

DARK = "document.documentElement.dataset.theme"
WIDTH = "document.querySelector('#panel').getBoundingClientRect().width"
EYE = "[...studio.view.camera.position.toArray(), ...studio.view.controls.target.toArray()]"


def fresh(studio: Studio, robot: str = "planar_2r") -> None:
    """The page without anything of the address of before, as the next visit finds it."""
    studio.open(robot=robot)


def turn(studio: Studio) -> list[float]:
    """Turn the view by the keyboard and look closer; the camera then."""
    studio.page.locator("canvas[role=img]").focus()
    for key in ("ArrowLeft", "ArrowLeft", "ArrowUp", "+"):
        studio.page.keyboard.press(key)
    camera: list[float] = studio.run(EYE)
    return camera


@pytest.mark.slow
def test_the_next_visit_finds_theme_unit_and_divider_as_they_were(another: Callable[..., Studio]) -> None:
    studio = another(width=1440, height=900)
    fresh(studio)
    assert studio.run(WIDTH) == 480
    studio.button("Dark").click()
    studio.button("deg").click()
    divider = studio.page.get_by_role("separator", name="Width of the panel")
    place = divider.bounding_box()
    assert place is not None
    x, y = place["x"] + place["width"] / 2, place["y"] + 300
    studio.page.mouse.move(x, y)
    studio.page.mouse.down()
    studio.page.mouse.move(x - 60, y, steps=3)
    studio.page.mouse.move(x - 120, y, steps=3)
    studio.page.mouse.up()
    assert studio.run(WIDTH) == pytest.approx(600, abs=1)
    divider.press("ArrowRight")
    width = studio.run(WIDTH)
    assert width == pytest.approx(576, abs=1)
    assert divider.get_attribute("aria-valuenow") == str(round(width))
    fresh(studio)
    assert (studio.run(DARK), studio.state("degrees"), studio.run(WIDTH)) == ("dark", True, width)
    assert studio.button("deg").get_attribute("aria-pressed") == "true"
    divider.press("Home")
    studio.button("Light").click()
    studio.button("rad").click()
    fresh(studio)
    assert (studio.run(DARK), studio.state("degrees"), studio.run(WIDTH)) == (None, False, 480)


@pytest.mark.slow
def test_a_link_says_theme_and_camera_and_leaves_the_preferences_alone(studio: Studio) -> None:
    fresh(studio)
    first = studio.run(EYE)
    seen = turn(studio)
    assert seen != first
    studio.button("Dark").click()
    link = studio.address()
    studio.run("localStorage.clear()")
    studio.go("#" + link.split("#")[1])
    studio.wait_for_robot("planar_2r")
    assert studio.run(DARK) == "dark"
    assert studio.run(EYE) == pytest.approx(seen, rel=1e-4, abs=1e-4)
    unit = studio.run("studio.view.unit")
    fresh(studio)
    assert studio.run(DARK) is None
    assert studio.run(EYE) == pytest.approx(first)
    assert studio.run("studio.view.unit") == unit


@pytest.mark.slow
def test_the_camera_stays_with_its_robot(studio: Studio) -> None:
    """Another robot is looked at as a whole; Back returns to the first one as it was looked at; so does a reload."""
    fresh(studio)
    seen = turn(studio)
    studio.address()
    studio.page.reload()
    studio.wait_for_robot("planar_2r")
    assert studio.run(EYE) == pytest.approx(seen, rel=1e-4, abs=1e-4)
    studio.run("studio.store.set({robot: 'scara'})")
    studio.wait_for_robot("scara")
    assert studio.state("camera") is None
    assert "camera" not in studio.address()
    studio.page.go_back()
    studio.wait_for_robot("planar_2r")
    assert studio.run(EYE) == pytest.approx(seen, rel=1e-4, abs=1e-4)
    studio.button("Fit").click()
    assert "camera" not in studio.address()


@pytest.mark.slow
def test_a_click_is_no_choice_of_a_camera_but_a_drag_is(studio: Studio) -> None:
    fresh(studio)
    place = studio.page.locator("canvas[role=img]").bounding_box()
    assert place is not None
    # Beside the robot: a link that is dragged moves its joint.
    x, y = place["x"] + place["width"] / 2, place["y"] + place["height"] / 4
    studio.page.mouse.click(x, y)
    assert studio.state("camera") is None
    studio.page.mouse.move(x, y)
    studio.page.mouse.down()
    studio.page.mouse.move(x + 80, y, steps=4)
    studio.page.mouse.up()
    assert studio.state("camera") is not None


ON_SCREEN = """(axis) => {
  const {camera, controls} = studio.view;
  camera.updateMatrixWorld();
  const at = (by) => controls.target.clone().addScaledVector(controls.target.clone().set(...axis), by).project(camera);
  const [from, to] = [at(0), at(0.05)];
  return [to.x - from.x, to.y - from.y].map((value) => Math.round(value * 1000) / 1000);
}"""


@pytest.mark.slow
@pytest.mark.parametrize(
    ("side", "right", "up"),
    [("Top", [1, 0, 0], [0, 1, 0]), ("Front", [1, 0, 0], [0, 0, 1]), ("Side", [0, 1, 0], [0, 0, 1])],
)
def test_the_arm_is_looked_at_from_a_side(studio: Studio, side: str, right: list[int], up: list[int]) -> None:
    """Which axes are to the right and up is asked of the camera; a link has the side too."""
    fresh(studio, "scara")
    studio.button(side).click()
    for _ in range(2):
        (x, zero), (none, y) = studio.run(ON_SCREEN, right), studio.run(ON_SCREEN, up)
        assert x > 0.01 < y
        assert zero == pytest.approx(0, abs=1e-3) == none
        assert "camera=" in studio.address()
        studio.page.reload()
        studio.wait_for_robot("scara")
    studio.button("Fit").click()
    assert studio.state("camera") is None


@pytest.mark.slow
@pytest.mark.parametrize(
    ("kept", "fragment"),
    [
        ("{", "camera=1,2,3"),
        ('{"theme": 7, "degrees": "yes", "width": -3}', "camera=1,1,1,1,1,1&theme=pink"),
        ("[]", "camera=1e300,0,0,0,0,0"),
        ('{"width": 1e12}', "camera=a,b,c,d,e,f"),
    ],
)
def test_what_makes_no_sense_is_as_nothing(studio: Studio, kept: str, fragment: str) -> None:
    fresh(studio)
    usual: list[Any] = studio.run(EYE)
    studio.run("(kept) => localStorage.setItem('gelenk.preferences', kept)", kept)
    studio.go(f"#panel=pose&robot=planar_2r&{fragment}")
    studio.wait_for_robot("planar_2r")
    assert (studio.state("camera"), studio.state("theme"), studio.state("degrees")) == (None, "auto", False)
    assert studio.run(WIDTH) <= 1024 - 360
    if "1e12" not in kept:
        assert studio.run(EYE) == pytest.approx(usual)
