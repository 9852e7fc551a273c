"""The Inverse panel: the robot follows a target that is moved, and walks along the course's methods."""

import math
from typing import Any

import numpy as np
import pytest
from playwright.sync_api import Route

from tests.studio.browser import Studio
from tests.studio.inverse import GHOSTS, IS_THERE, SOLVED, START, TARGET, TIP_HEIGHT, open_at, pose_of, sent, texts
from tests.test_serve import get


@pytest.mark.slow
def test_the_arrow_keys_take_the_robot_along(studio: Studio) -> None:
    posture = [0.3, -0.4, 0.5, 0.2, 0.6, 0.1]
    studio.open("ik", robot="puma560", q=",".join(map(str, posture)))
    studio.until(SOLVED)
    before = np.array(studio.state("target")["position"])
    studio.field("Target z").press("ArrowUp")
    studio.field("Target z").press("Shift+ArrowDown")
    target = studio.state("target")
    assert np.abs(np.array(target["position"]) - before - [0, 0, -0.09]).max() < 1e-12
    studio.until(f"Math.abs({TIP_HEIGHT} - {target['position'][2]}) < 1e-9")
    positions = list(studio.state("positions").values())
    tip = studio.fk("puma560", {"joint_positions": [positions]})["poses"][0]["position"]
    assert np.abs(np.array(tip) - target["position"]).max() < 1e-9
    assert np.abs(np.subtract(positions, posture)).max() < 0.5  # the same branch


HANDLE = """([axis, along]) => {
  const {view, store} = studio;
  const handle = view.scene.getObjectByName("target handle");
  handle.updateMatrixWorld();
  const size = handle.position.distanceTo(view.camera.position) * Math.tan(view.camera.fov * Math.PI / 360) * 0.75 / 4;
  const point = handle.position.clone().set(0, 0, 0);
  point.setComponent(axis, 1.9 * size * 0.4 + along).applyMatrix4(handle.matrixWorld).project(view.camera);
  const {left, top, width, height} = view.canvas.getBoundingClientRect();
  return [left + (point.x + 1) / 2 * width, top + (1 - point.y) / 2 * height];
}"""
"""Where the arrow of an axis is on the screen, or how far to drag it."""


def drag(studio: Studio, axis: int, along: float) -> None:
    """Take the arrow of an axis with the mouse and drag it so many metres."""
    start, end = studio.run(HANDLE, [axis, 0]), studio.run(HANDLE, [axis, along])
    mouse = studio.page.mouse
    mouse.move(*start)
    mouse.down()
    for step in range(1, 6):
        mouse.move(*np.array(start) + (np.array(end) - start) * step / 5)
    mouse.up()


@pytest.mark.slow
@pytest.mark.parametrize("robot", ["panda", "anthropomorphic"])
def test_the_robot_follows_what_is_dragged(studio: Studio, robot: str) -> None:
    start = {"panda": START, "anthropomorphic": "0.3,0.6,-1.2"}[robot]
    studio.open("ik", robot=robot, q=start)
    studio.until(SOLVED)
    before, camera = studio.state("target"), studio.run("studio.view.camera.position.toArray()")
    drag(studio, 2, 0.08)
    studio.until(f"Math.abs({TIP_HEIGHT} - studio.store.value.target.position[2]) < 1e-5")
    target = studio.state("target")
    moved = np.subtract(target["position"], before["position"])
    assert moved[2] == pytest.approx(0.08, abs=0.01)
    assert np.abs(moved[:2]).max() < 1e-12
    assert np.abs(np.subtract(target["rpy"], before["rpy"])).max() < 1e-12
    assert studio.run("studio.view.camera.position.toArray()") == camera
    positions = list(studio.state("positions").values())[: 7 if robot == "panda" else 3]
    pose = studio.fk(robot, {"joint_positions": [positions], "pose_format": "matrix"})["poses"][0]["matrix"]
    assert np.abs(np.array(pose)[:3, 3] - target["position"]).max() < 1e-6
    assert np.abs(np.subtract(positions, [float(text) for text in start.split(",")][: len(positions)])).max() < 0.6
    # At rest it is solved as wanted: every branch of an arm that has finitely many.
    studio.until(f"document.querySelectorAll('.solution').length === {1 if robot == 'panda' else 4}")
    assert studio.button("Turn").is_disabled() == (robot == "anthropomorphic")


FINGER = """(way) => {
  const {canvas} = studio.view;
  canvas.setPointerCapture = canvas.releasePointerCapture = () => {}; // of a pointer that no hand moves
  const say = (kind, [clientX, clientY]) => canvas.dispatchEvent(new PointerEvent(kind, {
    pointerId: 7, isPrimary: true, pointerType: "touch", button: kind === "pointermove" ? -1 : 0, buttons: 1,
    bubbles: true, clientX, clientY,
  }));
  say("pointerdown", way[0]);
  say("pointermove", way[1]);
  say("pointerup", way[1]);
}"""


@pytest.mark.slow
@pytest.mark.parametrize("axis", [0, 2])
def test_a_finger_takes_hold_of_the_target_where_it_is(studio: Studio, axis: int) -> None:
    """It presses before there is a picture of the handle that it is on: the target follows it, and does not jump."""
    studio.open("ik", robot="anthropomorphic", q="0.3,0.6,-1.2")
    studio.until(SOLVED)
    before = studio.state("target")["position"]
    studio.run(FINGER, [studio.run(HANDLE, [axis, along]) for along in (0, 0.08)])
    moved = np.subtract(studio.state("target")["position"], before)
    assert moved[axis] == pytest.approx(0.08, abs=0.005)
    assert np.abs(np.delete(moved, axis)).max() < 1e-12


HELD = """async (answers) => {
  const {view} = studio, frames = async (count) => { while (count--) await new Promise(requestAnimationFrame); };
  const clock = performance.now;
  let drawn = 0, answer;
  const count = () => drawn++;
  while (view.canvas.width !== 2 * view.canvas.clientWidth) await frames(1); // the last one before is to be smoothed
  view.before.add(count);
  if (answers) performance.now = () => 1e3;
  view.hold(new Promise((done) => (answer = done)));
  view.draw();
  await frames(5);
  const before = drawn;
  if (answers) answer();
  else while (!drawn) await frames(1);
  await frames(5);
  performance.now = clock;
  view.before.delete(count);
  return answers ? [before, drawn] : [0, drawn];
}"""
"""How many pictures were drawn before an answer, and in all; where none comes, until the page has lost its patience."""


@pytest.mark.slow
@pytest.mark.parametrize("answers", [True, False])
def test_one_picture_shows_what_was_dragged_and_the_answer(studio: Studio, answers: bool) -> None:
    studio.open("ik", robot="puma560", q="0.3,-0.4,0.5,0.2,0.6,0.1")
    studio.until(SOLVED)
    before, drawn = studio.run(HELD, answers)
    assert before == 0
    assert drawn


@pytest.mark.slow
def test_the_target_is_turned_about_its_own_axes(studio: Studio) -> None:
    studio.open("ik", robot="puma560", q="0.3,-0.4,0.5,0.2,0.6,0.1")
    studio.until(SOLVED)
    studio.button("Turn").click()
    before = pose_of(studio.state("target")).rotations[0]
    ring = studio.run(HANDLE.replace("1.9 * size * 0.4", "1.9 * size * 0.5"), [0, 0])
    studio.page.mouse.move(*ring)
    studio.page.mouse.down()
    studio.page.mouse.move(ring[0] + 12, ring[1] - 12, steps=4)
    studio.page.mouse.up()
    after = pose_of(studio.state("target")).rotations[0]
    turn = before.T @ after
    angle = math.acos((np.trace(turn) - 1) / 2)
    assert 0.02 < angle < 1
    axis = np.array([turn[2, 1] - turn[1, 2], turn[0, 2] - turn[2, 0], turn[1, 0] - turn[0, 1]]) / (2 * math.sin(angle))
    assert sorted(np.abs(axis).round(9).tolist()) == [0, 0, 1]


PLAYED_TO = """(least) => new Promise((done) => {
  const slider = document.querySelector(".stepper input");
  const play = [...document.querySelectorAll(".stepper button")].find((each) => each.textContent === "Play");
  const seen = new MutationObserver(() => {
    if (Number(slider.value) < least) return;
    seen.disconnect();
    play.click();
    done();
  });
  seen.observe(document.querySelector(".stepper-count"), {childList: true});
  play.click();
})"""
"""Play until an iteration is reached, and pause there: a walk is over before a busy machine would press, or draw."""


def way(studio: Studio, method: str, index: int) -> tuple[float, float]:
    """Distance and angle that the panel shows of a method at an iteration."""
    studio.field("Iteration").fill(str(index))
    now = studio.page.locator(f"[data-method={method}] .way-now")
    return float(now.get_attribute("data-position") or "nan"), float(now.get_attribute("data-orientation") or "nan")


def trace(studio: Studio, robot: str, method: str) -> Any:
    call = {**sent(studio), "method": method}
    status, answer = get(f"{studio.url}/v1/robots/{robot}/ik", "POST", call)
    assert status == 200, answer
    return answer["results"][0]


@pytest.mark.slow
@pytest.mark.parametrize("robot", ["panda", "anthropomorphic"])
def test_newton_and_the_gradient_walk_to_the_target(studio: Studio, robot: str) -> None:
    """The errors at each step are the service's, and the ghosts stand where its iterates are."""
    open_at(studio, robot, TARGET, q={"panda": START, "anthropomorphic": "0.9,0.3,0.4"}[robot])
    studio.until(SOLVED)
    studio.button("Compare").click()
    studio.until("document.querySelectorAll('.way').length === 2")
    said = texts(studio, ".way > span:first-child")
    posture = studio.state("positions")
    lengths = []
    for method in ("newton", "gradient"):
        result = trace(studio, robot, method)
        steps = result["trace"]
        lengths.append(len(steps))
        found = result["solutions"][0]
        end = f"{found['position_error']:.1e}"  # the service's own figure, at the end and not at the start
        digits, power = end.split("e")
        raised = "".join("⁰¹²³⁴⁵⁶⁷⁸⁹"[int(c)] if c.isdigit() else "⁻" for c in str(int(power)))
        assert f"converged after {len(steps) - 1} iterations, {digits}·10{raised} m" in said[len(lengths) - 1]
        assert said[len(lengths) - 1].endswith(" off at the end")
        for k in (1, len(steps) // 2, len(steps) - 1):
            distance, angle = way(studio, method, k)
            now = studio.page.locator(f"[data-method={method}] .way-now").inner_text()
            assert now.startswith(f"Iteration {k}: ")
            # The service mixes metres and radians into one number; the browser has them apart.
            mixed = math.hypot(distance, angle) if robot == "panda" else distance
            assert mixed == pytest.approx(steps[k]["error"], rel=1e-6, abs=1e-13)
            names = [joint["name"] for joint in studio.run("studio.store.value.model.joints")]
            at = {**posture, **dict(zip(names, steps[k]["joint_positions"], strict=False))}
            studio.run("(at) => studio.store.value.model.place(at)", at)
            assert studio.run(IS_THERE, f"way {method}") < 1e-12
            studio.run("studio.store.value.model.place(studio.store.value.positions)")
    assert lengths[1] > 2 * lengths[0]  # linear against quadratic convergence
    assert studio.state("positions") == posture
    assert not any(studio.run(GHOSTS))
    # Played from the start: the ghosts walk by themselves, to the end.
    studio.field("Iteration").fill("0")
    studio.run(PLAYED_TO, min(5, lengths[0]))
    reached = int(studio.field("Iteration").input_value())
    studio.button("+ one iteration").click()
    assert texts(studio, ".stepper-count") == [f"{reached + 1} of {lengths[1] - 1}"]
    studio.page.locator(".errors-plot .u-over").click(position={"x": 1, "y": 20})
    assert studio.field("Iteration").input_value() == "0"
    studio.button("Close").click()
    assert studio.page.locator(".errors-plot").is_hidden()
    assert all(studio.run(GHOSTS))


@pytest.mark.slow
def test_the_methods_start_elsewhere_and_change_over(studio: Studio) -> None:
    open_at(studio, "planar_2r", {"position": [0.4, 0.3, 0], "rpy": [0, 0, 0]}, q="0.2,0.3")
    studio.until(SOLVED)
    studio.button("Gradient, then Newton").click()
    studio.button("Compare").click()
    studio.until("document.querySelectorAll('.way').length === 2")
    assert sent(studio)["seeds"] == [[0.2, 0.3]]
    assert {step["method"] for step in trace(studio, "planar_2r", "gradient_then_newton")["trace"][:-1]} == {
        "gradient",
        "newton",
    }
    studio.button("Middle of ranges").click()
    studio.until("!document.querySelector('.request code').textContent.includes('seeds')")
    # Newton does not start from the stretched arm, which is singular.
    studio.until("document.querySelector('.way')?.textContent.includes('singular')")
    assert way(studio, "newton", 0)[0] == pytest.approx(math.dist((1.7, 0), (0.4, 0.3)), abs=1e-12)
    # Another target takes the comparison away, and a comparison that takes long is cancelled.
    studio.run("globalThis.earlier = document.querySelector('.solution')")
    studio.type("Target x", "0.5")
    assert studio.page.locator(".errors-plot").is_hidden()
    studio.until(f"{SOLVED} && document.querySelector('.solution') !== earlier")
    waiting: list[Route] = []

    def hold(route: Route) -> None:
        waiting.append(route)

    studio.page.route("**/ik", hold)
    studio.button("Compare").click()
    studio.hear(waiting, 2)
    studio.button("Cancel").click()
    assert len(waiting) == 2
    assert studio.button("Compare").is_visible()
    assert studio.page.locator(".errors-plot").is_hidden()
