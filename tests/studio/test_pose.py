"""The Pose panel: sliders, numbers, the pose of the tip, and that browser and service agree."""

import json
import math
import random
import subprocess
import sys
from collections.abc import Callable
from typing import Any

import numpy as np
import pytest
from playwright.sync_api import Route

from tests.studio.browser import PATIENCE, Studio
from tests.studio.tables import ANTHROPOMORPHIC, keep, type_table

TOLERANCE = 1e-9


def slide_to_random(studio: Studio, seed: int) -> list[float]:
    """Move every slider of the chain somewhere; where they stand then."""
    picked = random.Random(seed)
    positions = []
    for slider in studio.page.locator(".joints > .joint input[type=range]").all():
        lower, upper = (float(slider.get_attribute(end) or "nan") for end in ("min", "max"))
        slider.fill(str(picked.uniform(lower, upper)))
        positions.append(float(slider.input_value()))
    return positions


def agrees(studio: Studio, robot: str, positions: list[float]) -> None:
    """What the panel shows is the service's pose at these positions, and the panel says so."""
    answer = studio.fk(robot, {"joint_positions": [positions], "pose_format": "matrix"})
    assert np.abs(np.array(studio.tip()) - answer["poses"][0]["matrix"]).max() < TOLERANCE
    studio.until("document.querySelector('.agreement').dataset.tone === 'good'")
    shown = studio.page.locator(".agreement")
    assert float(shown.get_attribute("data-position") or "nan") < TOLERANCE
    assert float(shown.get_attribute("data-angle") or "nan") < TOLERANCE


@pytest.mark.slow
@pytest.mark.parametrize("seed", range(3))
def test_the_sliders_pose_is_the_services(studio: Studio, seed: int) -> None:
    studio.open(robot="panda")
    positions = slide_to_random(studio, seed)
    assert len(positions) == 7
    agrees(studio, "panda", positions)


@pytest.mark.slow
def test_the_sliders_pose_of_a_typed_arm_is_the_services(studio: Studio) -> None:
    type_table(studio, ANTHROPOMORPHIC)
    keep(studio, "typed_arm")
    studio.page.get_by_role("tab", name="Pose").click()
    for seed in range(3):
        positions = slide_to_random(studio, seed)
        assert len(positions) == 3
        agrees(studio, "typed_arm", positions)
        # The lecture's closed form of the anthropomorphic arm.
        first, second, third = positions
        reach = 0.5 * math.cos(second) + 0.4 * math.cos(second + third)
        height = 0.5 * math.sin(second) + 0.4 * math.sin(second + third)
        expected = [reach * math.cos(first), reach * math.sin(first), height]
        assert np.abs(np.array(studio.tip())[:3, 3] - expected).max() < 1e-12


ROWS = {
    "quaternion_xyzw": 1,
    "quaternion_wxyz": 1,
    "rpy": 1,
    "zyz": 1,
    "rotation_vector": 1,
    "rotation": 3,
    "matrix": 4,
}


@pytest.mark.slow
def test_every_notation_is_the_services(studio: Studio) -> None:
    studio.open(robot="ur5_dh")
    positions = slide_to_random(studio, 7)
    for form, count in ROWS.items():
        answer = studio.fk("ur5_dh", {"joint_positions": [positions], "pose_format": form})
        expected = np.atleast_2d(np.array(answer["poses"][0][form]))
        lines = studio.page.locator(f"[data-format={form}] .row").all()
        assert len(lines) == count
        for line, numbers in zip(lines, expected, strict=True):
            cells = line.locator("span:not(.unit)").all()
            shown = [float((cell.text_content() or "").replace("−", "-")) for cell in cells]
            assert np.abs(np.array(shown) - numbers).max() < 6e-6, form


@pytest.mark.slow
def test_a_number_is_typed_in_many_ways(studio: Studio) -> None:
    studio.open(robot="planar_2r")
    for text, value in {
        "0.5": 0.5,
        "pi/4": math.pi / 4,
        "-3π/4": -3 * math.pi / 4,
        "30°": math.pi / 6,
        "0,25": 0.25,
        "1e-3": 1e-3,
        "−0.5": -0.5,
        "2*pi/6": math.pi / 3,
        "45 deg": math.pi / 4,
        " 2 rad ": 2.0,
    }.items():
        studio.type("joint_1, number", text)
        assert studio.state("positions")["joint_1"] == pytest.approx(value, abs=1e-15), text
        assert float(studio.field("joint_1").input_value()) == pytest.approx(value, abs=1e-12), text


@pytest.mark.slow
def test_what_is_no_number_says_so_and_moves_nothing(studio: Studio) -> None:
    studio.open(robot="planar_2r", q="0.1,0.2")
    field = studio.field("joint_1, number")
    for text in ("abc", "", "1..2", "1e400", "pi/0", "--1", "1 2", "0x10"):
        studio.type("joint_1, number", text)
        assert field.get_attribute("aria-invalid") == "true", text
        assert "Write a number such as" in (field.get_attribute("title") or "")
        assert studio.state("positions") == {"joint_1": 0.1, "joint_2": 0.2}
        field.press("Escape")
        assert field.get_attribute("aria-invalid") == "false"


@pytest.mark.slow
def test_degrees_are_shown_and_typed(studio: Studio) -> None:
    studio.open(robot="planar_2r")
    studio.button("deg").click()
    studio.type("joint_1, number", "90")
    assert studio.state("positions")["joint_1"] == math.pi / 2
    studio.type("joint_1, number", "0.5 rad")
    assert studio.state("positions")["joint_1"] == 0.5
    studio.button("rad").click()
    studio.field("joint_2, number").focus()
    assert studio.field("joint_1, number").input_value() == "0.5"


@pytest.mark.slow
def test_home_zero_and_random(studio: Studio) -> None:
    studio.open(robot="panda")
    limits = {joint["name"]: joint for joint in studio.run("studio.store.value.model.joints")}
    studio.button("Random").click()
    somewhere = studio.state("positions")
    assert len({value for name, value in somewhere.items() if "finger" not in name}) == 7
    for name, value in somewhere.items():
        assert limits[name]["lower"] <= value <= limits[name]["upper"]
    studio.button("Zero").click()
    assert set(studio.state("positions").values()) == {0}
    # Zero is beyond the limits of the fourth joint, and is shown as such.
    assert studio.page.locator(".joint.beyond .joint-name").all_text_contents() == ["panda_joint4"]
    studio.button("Home").click()
    middle = (limits["panda_joint4"]["lower"] + limits["panda_joint4"]["upper"]) / 2
    assert studio.state("positions")["panda_joint4"] == middle


@pytest.mark.slow
def test_a_mimic_joint_follows_its_leader(studio: Studio) -> None:
    """The Panda's second finger has no slider: it does what the first one does."""
    studio.open(robot="panda", tip="panda_rightfinger")
    studio.page.locator("details.others summary").click() if studio.page.locator("details.others").count() else None
    studio.type("panda_finger_joint1, number", "0.03")
    assert studio.field("panda_finger_joint2").count() == 0
    answer = studio.fk(
        "panda", {"joint_positions": [studio.run(CHAIN)], "tip_frame": "panda_rightfinger", "pose_format": "matrix"}
    )
    assert "panda_finger_joint1" in answer["joint_names"]
    assert np.abs(np.array(studio.tip()) - answer["poses"][0]["matrix"]).max() < TOLERANCE


CHAIN = """(({model, base, tip, positions}) =>
  model.chain(base ?? model.ends.base_frame, tip ?? model.ends.tip_frame).map(({name}) => positions[name])
)(studio.store.value)"""


@pytest.mark.slow
def test_another_chain_is_chosen(studio: Studio) -> None:
    studio.open(robot="panda")
    studio.field("Base frame").select_option("panda_hand")
    studio.field("Tip frame").select_option("panda_link3")
    studio.button("Random").click()
    call: dict[str, Any] = {
        "joint_positions": [studio.run(CHAIN)],
        "base_frame": "panda_hand",
        "tip_frame": "panda_link3",
    }
    answer = studio.fk("panda", {**call, "pose_format": "matrix"})
    assert answer["joint_names"] == [f"panda_joint{i}" for i in (7, 6, 5, 4)]
    assert np.abs(np.array(studio.tip()) - answer["poses"][0]["matrix"]).max() < TOLERANCE


MARKS = """(() => {
  let count = 0;
  studio.view.scene.traverse((node) => (count += node.isMesh && node.material.depthTest === false ? 1 : 0));
  return count;
})()"""
"""How many meshes are drawn over the robot: an arrow has two."""


@pytest.mark.slow
def test_marks_are_switched(studio: Studio) -> None:
    studio.open(robot="panda")
    before = studio.run(MARKS)
    links = len(studio.run("studio.store.value.model.links"))
    studio.button("Frames").click()
    with_frames = studio.run(MARKS)
    assert with_frames == before + (links - 2) * 6  # three arrows of two meshes; base and tip had theirs
    studio.button("Axes").click()
    assert studio.run(MARKS) == with_frames + 9 * 3  # nine joints move, the second finger too
    studio.button("Names").click()
    studio.until(f"document.querySelectorAll('.label.link').length === {links}")
    for name in ("Names", "Axes", "Frames"):
        studio.button(name).click()
    assert studio.run(MARKS) == before
    studio.until("document.querySelectorAll('.label.link').length === 0")


@pytest.mark.slow
@pytest.mark.parametrize("language", ["curl", "Python"])
def test_the_request_runs_as_it_stands(studio: Studio, language: str) -> None:
    studio.open(robot="panda", q="0.1,-0.7,0.2,-2.1,0.3,1.5,0.7,0.02")
    studio.page.get_by_text("As request").click()
    studio.button(language).click()
    code = studio.page.locator(".request code").text_content() or ""
    command = ["sh", "-c", code] if language == "curl" else [sys.executable, "-c", code]
    output = subprocess.run(command, capture_output=True, text=True, timeout=PATIENCE, check=True).stdout
    assert np.abs(np.array(json.loads(output)["poses"][0]["matrix"]) - studio.tip()).max() < TOLERANCE


@pytest.mark.slow
def test_the_request_as_json_is_what_was_sent(studio: Studio) -> None:
    studio.open(robot="planar_2r", q="0.1,0.2")
    studio.page.get_by_text("As request").click()
    studio.button("JSON").click()
    sent = json.loads(studio.page.locator(".request code").text_content() or "")
    assert sent["joint_positions"] == [[0.1, 0.2]]
    assert studio.fk("planar_2r", sent)["poses"]


SLIDE = """() => {
  const slider = document.querySelector('[aria-label="joint_1"]');
  for (let i = 1; i <= 50; i += 1) {
    slider.value = i / 100;
    slider.dispatchEvent(new Event("input"));
  }
}"""


@pytest.mark.slow
def test_a_slider_that_moves_asks_no_more_than_is_answered(studio: Studio) -> None:
    studio.open(robot="planar_2r", q="0,0")
    studio.until("document.querySelector('.agreement').dataset.tone === 'good'")
    asked: list[Any] = []
    studio.page.on("request", lambda request: asked.append(request.post_data_json) if "/fk" in request.url else None)
    studio.run(SLIDE)
    while not (asked and asked[-1]["joint_positions"] == [[0.5, 0.0]]):
        studio.page.wait_for_timeout(20)
    studio.until("document.querySelector('.agreement').dataset.tone === 'good'")
    assert len(asked) == 2, "the first position and the last"


@pytest.mark.slow
def test_the_arrow_keys_move_a_slider_and_turn_the_view(studio: Studio) -> None:
    studio.open(robot="planar_2r", q="0,0")
    studio.field("joint_1").press("ArrowRight")
    assert studio.state("positions")["joint_1"] == pytest.approx(2 * math.pi / 100)
    turned = "(studio.view.camera.updateMatrixWorld(), studio.view.camera.matrixWorld.toArray())"
    before = studio.run(turned)
    studio.page.locator("canvas").press("ArrowLeft")
    assert np.abs(np.array(studio.run(turned)) - before).max() > 0.01


BY_HAND = """() => {
  const later = setTimeout;
  globalThis.setTimeout = (act, after, ...more) => after === 2000 ? 0 : later(act, after, ...more);
}"""
"""Have the page look whether the service is back only when it is told to, however late somebody presses."""


@pytest.mark.slow
def test_a_service_that_is_away_is_told_and_asked_again(another: Callable[..., Studio]) -> None:
    studio = another()
    studio.open(robot="planar_2r")
    studio.page.route("**/fk", lambda route: route.abort())
    studio.page.route("**/healthz", lambda route: route.abort())
    studio.run(BY_HAND)
    studio.field("joint_1").fill("0.4")
    lost = studio.page.get_by_role("alert").filter(has_text="does not answer")
    lost.wait_for()
    studio.page.unroute_all()
    lost.get_by_role("button", name="Try now").click()
    lost.wait_for(state="hidden")
    studio.until("document.querySelector('.agreement').dataset.tone === 'good'")
    assert studio.page.locator(".problem:visible").count() == 0
    studio.complaints.clear()  # the console tells of the connection too


@pytest.mark.slow
def test_meshes_that_a_service_away_did_not_send_come_when_it_is_back(another: Callable[..., Studio]) -> None:
    """A proxy in front of it may answer in its place."""
    studio = another()
    studio.expected.add(502)
    studio.page.route("**/meshes/**", lambda route: route.abort())
    studio.go("#panel=pose&robot=talos_left_arm")
    studio.wait_for_robot("talos_left_arm")
    assert studio.run("studio.store.value.model.meshes.shown") == 0
    studio.page.unroute_all()
    studio.page.route("**/fk", lambda route: route.fulfill(status=502, body="Bad Gateway"), times=1)
    studio.page.locator(".number").first.fill("0.4")
    studio.page.locator(".number").first.press("Enter")
    studio.until("!studio.store.value.loading && studio.store.value.model.meshes.shown > 0")
    studio.wait_for_robot("talos_left_arm")
    assert studio.run("studio.store.value.model.meshes.failed") == []
    studio.complaints.clear()  # the console tells of the connection too


@pytest.mark.slow
def test_a_robot_is_not_uploaded_twice(another: Callable[..., Studio]) -> None:
    """Only its answer may have been lost; so the page asks whoever uploads it."""
    studio = another()
    studio.open("robot", robot="planar_2r")
    asked: list[str] = []

    def lose(route: Route) -> None:
        asked.append(route.request.method)
        route.abort()

    studio.page.route("**/v1/robots", lose)
    sent = "studio.api.call({method: 'POST', path: 'v1/robots', body: {}}).catch(({title}) => title)"
    assert studio.run(sent) == "No answer"
    lost = studio.page.get_by_role("alert").filter(has_text="does not answer")
    lost.wait_for(state="hidden")
    assert asked == ["POST"]
    studio.complaints.clear()
