"""The robot's shadow on the floor: where it is, and that nobody can take hold of it."""

import math
from collections.abc import Callable

import pytest

from tests.studio.browser import Studio

DARKER = """async (points) => {
  const {view} = studio;
  const shadow = view.scene.getObjectByName("shadow");
  const read = async () => {
    const picture = await createImageBitmap(await view.picture());
    const context = new OffscreenCanvas(picture.width, picture.height).getContext("2d", {willReadFrequently: true});
    context.drawImage(picture, 0, 0);
    return ([x, y]) => {
      const at = shadow.position.clone().set(x, y, view.level).project(view.camera);
      const [i, j] = [(at.x + 1) / 2 * picture.width, (1 - at.y) / 2 * picture.height];
      return context.getImageData(i, j, 1, 1).data[1];
    };
  };
  const after = await read();
  shadow.visible = false;
  const before = await read();
  shadow.visible = true;
  return points.map((point) => before(point) - after(point));
}"""
"""By how much the shadow darkens points of the floor, of 255."""

AT_REST = "studio.view.canvas.width === 2 * studio.view.canvas.clientWidth"
SEEN = "studio.view.scene.getObjectByName('shadow').visible"
NOTED = f"globalThis.moving = []; studio.view.before.add(() => {AT_REST} || moving.push({SEEN}))"
"""Whether the shadow was in each of the coarse pictures, which on a busy machine nobody sees."""


def darker(studio: Studio, *directions: float) -> list[float]:
    """Below the forearm of the anthropomorphic arm as it would stand in some directions."""
    studio.until(f"{AT_REST} && {SEEN}")
    found: list[float] = studio.run(DARKER, [[0.65 * math.cos(q), 0.65 * math.sin(q)] for q in directions])
    return found


@pytest.mark.slow
@pytest.mark.parametrize("scheme", ["light", "dark"])
def test_the_floor_is_darker_below_the_arm(another: Callable[..., Studio], scheme: str) -> None:
    """Links of 0.5 and 0.4 m, the second one level: from above it is 0.44 to 0.84 m off the axis.

    As the arm turns, so does its shadow. In the picture that is saved it is too.
    """
    studio = another(scheme=scheme)
    studio.open("pose", robot="anthropomorphic", q="-1.2,0.5,-0.5")
    first, second = -1.2, -0.4
    below, beside = darker(studio, first, second)
    assert below > (15 if scheme == "light" else 2)
    assert abs(beside) <= 1
    studio.run(NOTED)
    studio.run("(q) => studio.store.set({positions: {...studio.store.value.positions, joint_1: q}})", second)
    studio.until("moving.length")
    beside, below = darker(studio, first, second)
    assert not any(studio.run("moving")), "where software draws it waits until the robot is at rest"
    assert below > (15 if scheme == "light" else 2)
    assert abs(beside) <= 1


@pytest.mark.slow
def test_a_shadow_is_not_measured_and_ends_with_the_robot(studio: Studio) -> None:
    studio.open("pose", robot="anthropomorphic", q="-1.2,0.5,-0.5")
    darker(studio, 0.0)
    x, y = studio.run("""() => {
      const {view} = studio;
      const at = view.controls.target.clone().set(0.65 * Math.cos(-1.2), 0.65 * Math.sin(-1.2), view.level);
      at.project(view.camera);
      const {left, top, width, height} = view.canvas.getBoundingClientRect();
      return [left + (at.x + 1) / 2 * width, top + (1 - at.y) / 2 * height];
    }""")
    studio.button("Measure").click()
    studio.page.mouse.click(x, y)
    assert studio.field("Measure from").input_value() == "", "there is only the floor"
    studio.run("studio.store.set({robot: 'planar_2r'})")
    studio.wait_for_robot("planar_2r")
    studio.until(f"{AT_REST} && {SEEN}")
    assert studio.run("studio.view.scene.getObjectByName('shadow').position.x") == pytest.approx(0.5, abs=0.4)
    found = studio.run("studio.view.scene.children.filter(({name}) => name === 'shadow').length")
    assert found == 1
