"""The Inverse panel: a typed pose, its solutions as a list and as ghosts, and the verdict where none is."""

import json
import math
from urllib.parse import quote

import numpy as np
import pytest
from playwright.sync_api import Route

from tests.studio.browser import Studio
from tests.studio.inverse import (
    FAR,
    GHOSTS,
    IS_THERE,
    SOLVED,
    START,
    TARGET,
    answered,
    chain_positions,
    open_at,
    pose_of,
    sent,
    texts,
)
from tests.studio.tables import ANTHROPOMORPHIC, keep, type_table


@pytest.mark.slow
def test_a_typed_pose_is_reached_by_the_panda(studio: Studio) -> None:
    open_at(studio, "panda", {"position": [0.5, 0.1, 0.5], "rpy": [math.pi, 0.2, 0.4]}, q=START)
    studio.until(SOLVED)
    studio.type("Target x", "0.4")
    studio.type("Target roll", "3")
    assert studio.state("target") == TARGET
    studio.until("document.querySelector('.request code').textContent.includes('[3, 0.2, 0.4]')")
    answer = answered(studio, "panda")
    (solution,) = answer["results"][0]["solutions"]
    before = chain_positions(studio, answer["joint_names"])
    apart = float(np.linalg.norm(np.subtract(solution["joint_positions"], before)))
    studio.until(f"Math.abs(document.querySelector('.solution')?.dataset.distance - {apart}) < 1e-9")
    row = studio.page.locator(".solution")
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


@pytest.mark.slow
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


@pytest.mark.slow
def test_many_solutions_of_the_panda(studio: Studio) -> None:
    """A limit on the ghosts, a word that there are more, and each of them when it is pointed at."""
    open_at(studio, "panda", TARGET, q=START)
    studio.until(SOLVED)
    studio.button("All").click()
    studio.until("document.querySelectorAll('.solution').length > 8")
    count = studio.page.locator(".solution").count()
    summary = texts(studio, ".verdict-summary")[0]
    assert summary == (
        f"Infinitely many solutions, of which {count} are listed. "
        "The first 8 are in the picture, and any that you point at."
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


@pytest.mark.slow
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
    # The box no longer offers what has been done, until the robot has left again.
    assert studio.button("Move to nearest").count() == 0
    assert studio.button("The robot is there").get_attribute("aria-disabled") == "true"
    studio.run("studio.store.set({positions: {...studio.store.value.positions, panda_joint1: 0.5}})")
    assert studio.button("Move to nearest").get_attribute("aria-disabled") == "false"
    # One method from one start does not know what is nearest, only where it stopped.
    studio.field("Method").select_option("gradient")
    studio.until("document.querySelector('.verdict-failure').textContent.includes('the method stopped')")
    assert studio.button("Move to nearest").count() == 0
    assert studio.button("Move to where it stopped").is_visible()
    studio.field("Method").select_option("auto")
    studio.until("!document.querySelector('.verdict-failure').textContent.includes('the method stopped')")
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


@pytest.mark.slow
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


@pytest.mark.slow
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
    studio.page.get_by_text("Directions and tolerances").click()
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


@pytest.mark.slow
def test_long_work_is_cancelled(studio: Studio) -> None:
    waiting: list[Route] = []

    def hold(route: Route) -> None:
        waiting.append(route)

    studio.page.route("**/ik", hold)
    open_at(studio, "planar_2r", {"position": [0.4, 0.1, 0], "rpy": [0, 0, 0]})
    studio.hear(waiting)
    studio.button("Cancel").click()
    assert texts(studio, ".verdict-summary") == ["Cancelled."]
    studio.page.unroute("**/ik")
    studio.button("Solve again").click()
    studio.until("document.querySelectorAll('.solution').length === 2")


@pytest.mark.slow
def test_ghosts_that_are_there_before_the_meshes_get_them(studio: Studio) -> None:
    """The service answers before a large mesh has come: until then ghosts are of rods as the robot is."""
    meshes: list[Route] = []
    is_held = True

    def hold(route: Route) -> None:
        if is_held:
            meshes.append(route)
        else:
            route.continue_()

    studio.page.route("**/meshes/**", hold)
    target = quote(json.dumps(TARGET))
    studio.go(f"#panel=ik&robot=panda&q={quote(START)}&target={target}")
    studio.until("studio.store.value.model !== null && !studio.store.value.loading")
    studio.until(SOLVED)
    parts = "studio.view.scene.getObjectByName('ghost 0').children"
    assert studio.run(f"{parts}.length") > 0
    is_held = False
    for mesh in meshes:
        mesh.continue_()
    studio.wait_for_robot("panda")
    studio.until(f"{parts}.length > 5 && {parts}.every(({{geometry}}) => geometry.type !== 'CylinderGeometry')")


@pytest.mark.slow
def test_a_family_of_solutions_is_a_sweep(studio: Studio) -> None:
    """A straight wrist: ghosts all along the family, and a slider that takes the robot along it on the target."""
    q = [0.3, -1.1, 1.2, 0.4, 0.0, 0.2]
    pose = studio.fk("ur5_dh", {"joint_positions": [q]})["poses"][0]
    open_at(studio, "ur5_dh", {key: pose[key] for key in ("position", "quaternion_xyzw")})
    studio.until("document.querySelectorAll('.family').length > 0")  # a closed form is asked for all from the start
    assert texts(studio, ".verdict-summary")[0].startswith("Infinitely many solutions, of which ")
    family = studio.page.locator(".family").first
    assert "move together" in (family.text_content() or "")
    shown = "studio.view.scene.getObjectByName('sweep 3')?.visible ?? false"
    assert not studio.run(shown)
    slider = family.locator("input")
    slider.focus()
    assert studio.run(shown)
    empty = "[...document.querySelectorAll('.label.ghost')].filter((e) => !e.textContent && e.checkVisibility()).length"
    studio.drawn()
    assert studio.run(empty) == 0, "ghosts without a name have no label"
    poses = []
    for key in ("End", "Home"):
        studio.page.keyboard.press(key)
        positions = chain_positions(studio, [f"joint_{i}" for i in range(1, 7)])
        poses.append(
            studio.fk("ur5_dh", {"joint_positions": [positions], "pose_format": "matrix"})["poses"][0]["matrix"]
        )
    wanted = studio.fk("ur5_dh", {"joint_positions": [q], "pose_format": "matrix"})["poses"][0]["matrix"]
    assert np.abs(np.array(poses) - wanted).max() < 1e-6
    slider.blur()
    assert not studio.run(shown)
