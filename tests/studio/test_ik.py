"""The Inverse panel: a pose typed or dragged, its solutions as a list and as ghosts, and the verdict where none is."""

import json
import math
from typing import Any

import numpy as np
import pytest
from playwright.sync_api import Route

from app.model.poses import Poses
from app.schemas.pose import Pose, poses_from
from tests.studio.browser import Studio
from tests.studio.tables import ANTHROPOMORPHIC, keep, type_table
from tests.test_serve import get

TARGET = {"position": [0.4, 0.1, 0.5], "rpy": [3.0, 0.2, 0.4]}
FAR = {"position": [0.9, 0.3, 0.5], "rpy": [3.0, 0.2, 0.4]}
START = "0,-0.785,0,-2.356,0,1.571,0.785,0"

SOLVED = "document.querySelector('.solution') !== null"
GHOSTS = """[...document.querySelectorAll('.solution')].map((_, i) =>
  studio.view.scene.getObjectByName(`ghost ${i}`)?.visible ?? false)"""
IS_THERE = """(name) => {
  const {model, base, tip} = studio.store.value;
  const chain = model.chain(base ?? model.ends.base_frame, tip ?? model.ends.tip_frame);
  const robot = model.moving(chain).map((mesh) => mesh.matrixWorld.elements);
  const ghost = studio.view.scene.getObjectByName(name).children.map((mesh) => mesh.matrix.elements);
  return Math.max(...ghost.flatMap((matrix, i) => matrix.map((number, k) => Math.abs(number - robot[i][k]))));
}"""
"""How far the ghost's parts are from the robot's, at most."""
TIP_HEIGHT = "(({model}) => model.pose(model.ends.base_frame, model.ends.tip_frame).elements[14])(studio.store.value)"


def open_at(studio: Studio, robot: str, target: dict[str, Any], **address: str) -> None:
    studio.open("ik", robot=robot, target=json.dumps(target), **address)


def sent(studio: Studio) -> dict[str, Any]:
    """The last call, as the panel shows it."""
    details = studio.page.locator("details.request")
    if details.get_attribute("open") is None:
        details.locator("summary").click()
    studio.button("JSON").click()
    call: dict[str, Any] = json.loads(studio.page.locator(".request code").text_content() or "")
    return call


def answered(studio: Studio, robot: str) -> Any:
    """What the service says to the last call, asked without the page."""
    status, answer = get(f"{studio.url}/v1/robots/{robot}/ik", "POST", sent(studio))
    assert status == 200, answer
    return answer


def chain_positions(studio: Studio, names: list[str]) -> list[float]:
    positions = studio.state("positions")
    return [positions[name] for name in names]


def texts(studio: Studio, selector: str) -> list[str]:
    return studio.page.locator(selector).all_text_contents()


def pose_of(target: dict[str, Any]) -> Poses:
    return poses_from([Pose.model_validate(target)], "targets")


def test_a_typed_pose_is_reached_by_the_panda(studio: Studio) -> None:
    open_at(studio, "panda", {"position": [0.5, 0.0, 0.4], "rpy": [math.pi, 0, 0]}, q=START)
    studio.until(SOLVED)
    for name, text in {"x": "0.4", "y": "0.1", "z": "0.5", "roll": "3", "pitch": "0.2", "yaw": "0.4"}.items():
        studio.type(f"Target {name}", text)
    assert studio.state("target") == TARGET
    studio.until("document.querySelector('.request code').textContent.includes('0.4, 0.1, 0.5')")
    studio.until(SOLVED)
    answer = answered(studio, "panda")
    (solution,) = answer["results"][0]["solutions"]
    before = chain_positions(studio, answer["joint_names"])
    apart = float(np.linalg.norm(np.subtract(solution["joint_positions"], before)))
    row = studio.page.locator(".solution")
    assert float(row.get_attribute("data-distance") or "nan") == pytest.approx(apart, abs=1e-9)
    assert f"{solution['iterations']} iterations" in (row.text_content() or "")
    row.click()
    positions = chain_positions(studio, answer["joint_names"])
    assert np.abs(np.subtract(positions, solution["joint_positions"])).max() < 1e-12
    reached = studio.fk("panda", {"joint_positions": [positions], "pose_format": "matrix"})["poses"][0]["matrix"]
    wanted = pose_of(TARGET)
    assert np.abs(np.array(reached)[:3, 3] - wanted.positions[0]).max() < 1e-6
    assert np.abs(np.array(reached)[:3, :3] - wanted.rotations[0]).max() < 2e-6
    assert row.get_attribute("aria-current") == "true"
    assert studio.run(GHOSTS) == [False]  # the robot is there itself


def test_all_branches_of_a_typed_arm_are_ghosts(studio: Studio) -> None:
    """The four configurations of the lecture, each where its ghost is."""
    type_table(studio, ANTHROPOMORPHIC)
    studio.page.get_by_role("tab", name="Inverse").click()
    keep(studio, "ik_arm")
    studio.field("Target x").wait_for()
    studio.run("studio.store.set({target: {position: [0.4, 0.1, 0.5], rpy: [0, 0, 0]}})")
    studio.until("document.querySelectorAll('.solution').length === 4")
    assert "4 solutions: these are all." in texts(studio, ".verdict-summary")[0]
    expected = lecture(0.4, 0.1, 0.5)
    found = []
    for i in range(4):
        row = studio.page.locator(".solution").nth(i)
        name = row.locator(".solution-name").text_content() or ""
        assert studio.run(GHOSTS)[i]
        row.click()
        assert studio.run(IS_THERE, f"ghost {i}") < 1e-12
        found.append(chain_positions(studio, ["joint_1", "joint_2", "joint_3"]))
        side, height = (name.split(f"{part} ")[1].split(" ")[0] for part in ("shoulder", "elbow"))
        assert (side, height) == branch(found[-1]), name
        shown = [float(text.replace("−", "-")) for text in row.locator(".solution-joints span").all_text_contents()]
        assert np.abs(np.subtract(shown, found[-1])).max() < 6e-4
    for q in expected:
        assert min(np.abs(np.subtract(q, other)).max() for other in found) < 1e-9


def lecture(x: float, y: float, z: float) -> list[list[float]]:
    """The anthropomorphic arm of links 0.5 and 0.4 in closed form."""
    solutions = []
    cos3 = (x * x + y * y + z * z - 0.41) / 0.4
    for side in (1, -1):
        reach = side * math.hypot(x, y)
        for third in (math.acos(cos3), -math.acos(cos3)):
            second = math.atan2(z, reach) - math.atan2(0.4 * math.sin(third), 0.5 + 0.4 * cos3)
            second = math.atan2(math.sin(second), math.cos(second))
            solutions.append([math.atan2(side * y, side * x), second, third])
    return solutions


def branch(q: list[float]) -> tuple[str, str]:
    """Which way the shoulder looks, and whether the elbow is above the line from shoulder to tip."""
    reach = 0.5 * math.cos(q[1]) + 0.4 * math.cos(q[1] + q[2])
    height = 0.5 * math.sin(q[1]) + 0.4 * math.sin(q[1] + q[2])
    above = 0.5 * math.sin(q[1]) > height * 0.5 * math.cos(q[1]) / reach
    return ("front" if reach > 0 else "back"), ("up" if above else "down")


def test_many_solutions_of_the_panda(studio: Studio) -> None:
    """A limit on the ghosts, a word that there are more, and each of them when it is pointed at."""
    open_at(studio, "panda", TARGET, q=START)
    studio.until(SOLVED)
    studio.button("All").click()
    studio.until("document.querySelectorAll('.solution').length > 8")
    count = studio.page.locator(".solution").count()
    summary = texts(studio, ".verdict-summary")[0]
    assert summary == (
        f"{count} solutions; there may be more. The first 8 are in the picture, and any that you point at."
    )
    assert studio.run(GHOSTS) == [True] * 8 + [False] * (count - 8)
    studio.page.mouse.move(300, 300)
    studio.page.locator(".solution").last.focus()
    assert studio.run(GHOSTS) == [True] * 8 + [False] * (count - 9) + [True]
    opacity = "(i) => studio.view.scene.getObjectByName(`ghost ${i}`).children[0].material.opacity"
    assert studio.run(opacity, count - 1) > 3 * studio.run(opacity, 0)
    studio.page.keyboard.press("Enter")
    assert studio.run(IS_THERE, f"ghost {count - 1}") < 1e-12
    studio.field("Target x").focus()
    assert studio.run(GHOSTS) == [True] * 8 + [False] * (count - 8)
    distances = [float(row.get_attribute("data-distance") or "nan") for row in studio.page.locator(".solution").all()]
    assert distances[-1] == 0 < min(distances[:-1])


def test_the_verdict_where_there_is_none(studio: Studio) -> None:
    open_at(studio, "panda", FAR, q=START)
    studio.until("document.querySelector('.verdict-failure').hidden === false")
    answer = answered(studio, "panda")
    result = answer["results"][0]
    said = texts(studio, ".verdict-failure")[0]
    assert result["status"] == "unreachable"
    assert "Out of reach" in said
    assert result["reason"][1:] in said
    assert f"{result['nearest']['position_error']:.4f} m" in said
    assert studio.page.locator(".solution").count() == 0
    studio.button("Move to nearest").click()
    assert chain_positions(studio, answer["joint_names"]) == result["nearest"]["joint_positions"]
    assert studio.run(IS_THERE, "nearest") < 1e-12
    assert not studio.run("studio.view.scene.getObjectByName('nearest').visible")
    # A joint in the way is named with its limit; without limits the target is reached.
    studio.run("studio.store.set({target: {position: [0, -0.1, 0.6], rpy: [1, 0, 0]}})")
    studio.until("document.querySelector('.verdict-failure').textContent.includes('outside the limits')")
    reason = answered(studio, "panda")["results"][0]["reason"]
    assert "'panda_joint2' at" in reason
    assert reason[1:] in texts(studio, ".verdict-failure")[0]
    studio.button("Within limits").click()
    studio.until(SOLVED)
    assert studio.page.locator(".verdict-failure").is_hidden()


FORMATS = ("quaternion_xyzw", "quaternion_wxyz", "rpy", "zyz", "rotation_vector", "rotation", "matrix")


def test_every_notation_is_the_same_target(studio: Studio, refusals: set[int]) -> None:
    open_at(studio, "puma560", TARGET)
    notation = studio.field("Notation of the orientation")
    wanted = pose_of(TARGET)
    for form in FORMATS:
        notation.select_option(form)
        target = studio.state("target")
        assert form in target
        same = pose_of(target)
        assert np.abs(same.positions - wanted.positions).max() < 1e-15
        assert np.abs(same.rotations - wanted.rotations).max() < 1e-14
    studio.type("Target row 2, column 4", "0.15")
    assert studio.state("target")["matrix"][1][3] == 0.15
    # What is no rotation is refused by the service; a press makes it one.
    notation.select_option("quaternion_wxyz")
    refusals.add(422)
    studio.type("Target qw", "0.9")
    straighten = studio.button("Make it a rotation")
    straighten.wait_for()
    assert "the quaternion has length" in texts(studio, ".problem:visible")[0]
    typed = np.array(studio.state("target")["quaternion_wxyz"])
    straighten.click()
    studio.until("document.querySelector('.problem').hidden")
    made = np.array(studio.state("target")["quaternion_wxyz"])
    assert np.abs(made - typed / np.linalg.norm(typed)).max() < 1e-14


def test_the_options_are_those_of_the_call(studio: Studio) -> None:
    open_at(studio, "puma560", {"position": [0.4, 0.1, 0.3], "quaternion_xyzw": [1, 0, 0, 0]})
    studio.until(SOLVED)
    assert sent(studio)["solutions"] == "all"
    assert "task" not in sent(studio)
    studio.field("Method").select_option("newton")
    studio.until("document.querySelector('.request code').textContent.includes('newton')")
    assert studio.button("All").is_disabled()
    assert sent(studio)["solutions"] == "one"
    studio.field("Method").select_option("auto")
    studio.button("rz").click()
    studio.button("Within limits").click()
    studio.type("Position tolerance", "1e-4")
    studio.until("document.querySelector('.request code').textContent.includes('position_tolerance')")
    call = sent(studio)
    assert call["task"] == ["x", "y", "z", "rx", "ry"]
    assert call["respect_limits"] is False
    assert call["position_tolerance"] == 1e-4
    # The link reopens all of it.
    studio.until("decodeURIComponent(location.hash).includes('position_tolerance')")
    studio.page.reload()
    studio.wait_for_robot("puma560")
    studio.until(SOLVED)
    assert sent(studio) == call
    assert studio.button("rz").get_attribute("aria-pressed") == "false"
    assert studio.button("Within limits").get_attribute("aria-pressed") == "false"


def test_the_arrow_keys_take_the_robot_along(studio: Studio) -> None:
    studio.open("ik", robot="panda", q=START)
    studio.until(SOLVED)
    before = np.array(studio.state("target")["position"])
    studio.field("Target z").press("ArrowUp")
    studio.field("Target z").press("Shift+ArrowDown")
    target = studio.state("target")
    assert np.abs(np.array(target["position"]) - before - [0, 0, -0.09]).max() < 1e-12
    studio.until(f"Math.abs({TIP_HEIGHT} - {target['position'][2]}) < 1e-5")
    positions = list(studio.state("positions").values())[:7]
    tip = studio.fk("panda", {"joint_positions": [positions]})["poses"][0]["position"]
    assert np.abs(np.array(tip) - target["position"]).max() < 1e-6
    assert np.abs(np.array(positions) - [float(text) for text in START.split(",")[:7]]).max() < 0.5  # the same branch


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


def test_the_target_is_turned_about_its_own_axes(studio: Studio) -> None:
    studio.open("ik", robot="panda", q=START)
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


def test_long_work_is_cancelled(studio: Studio) -> None:
    waiting: list[Route] = []

    def hold(route: Route) -> None:
        waiting.append(route)

    studio.page.route("**/ik", hold)
    open_at(studio, "planar_2r", {"position": [0.4, 0.1, 0], "rpy": [0, 0, 0]})
    studio.button("Cancel").click()
    assert waiting
    assert texts(studio, ".verdict-summary") == ["Cancelled."]
    studio.page.unroute("**/ik")
    studio.button("Solve again").click()
    studio.until("document.querySelectorAll('.solution').length === 2")
