"""Metres and millimetres: what is shown follows the switch, other numbers stay, and the service hears metres."""

import json
import math
import re
from typing import Any

import pytest
from playwright.sync_api import Request

from tests.studio.browser import Studio
from tests.studio.pure import values

LENGTHS = re.compile(
    r"joint_3, (number|velocity|acceleration|jerk|start velocity|start acceleration|end velocity|end acceleration)"
    r"|Row \d, [ad]|Row 3, (lower|upper|velocity) limit|(Base|Tool), [xyz]|Target [xyz]|Position( tolerance| [xyz])"
    r"|(Start|Segment \d, (target|via|waypoint \d)), (joint_3|[xyz])|Segment \d, blend|Size [xyz]|Clearance"
    r"|Tip (velocity|acceleration)|Path tolerance|Payload, centre [xyz]|Edge of a voxel"
)
"""The fields of the SCARA that hold a length or a rate of one, its third joint slides; written without the page."""

FIELDS = """() => Object.fromEntries([...document.querySelectorAll("input.number")].map((input) =>
  [input.getAttribute("aria-label"), input.value || input.placeholder]))"""
MIXED = """() => {
  const found = [];
  const texts = document.createTreeWalker(document.body, NodeFilter.SHOW_TEXT);
  for (let node = texts.nextNode(); node; node = texts.nextNode())
    if (node.parentElement.checkVisibility() && !node.parentElement.closest(".request, .about, .axes, .katex, button"))
      if (/(^|[\\d)] |\\[)m(\\/s[²³]?)?(\\]|$|[ ,.;])/.test(node.data)) found.push(node.data);
  return found;
}"""
"""Texts that have a number, or a title, of metres. The ellipsoids are those of joints that move a radian or a metre a
second, and what a robot's maker says of it stays."""
GIVEN = ("A row for each pose of the tip", "In the picture 1 m/s")
MOTION = {
    "robot": "scara",
    "base_frame": "base",
    "tip_frame": "tool",
    "start": [0.4, 0.8, 0.1, 0.4],
    "segments": [
        {"type": "line", "target": {"position": [0.45, 0.35, 0.24], "rpy": [math.pi, 0, 0.8]}, "blend_radius": 0.01},
        {"type": "line", "target": {"position": [0.45, 0.32, 0.26], "rpy": [math.pi, 0, 0.8]}},
        {"type": "joint", "target": [0.1, 0.2, 0.05, 0.3], "duration": 3.5},
    ],
    "limits": {"tip_velocity": 0.25, "tip_angular_velocity": 1.5, "joint_velocity": {"joint_3": 0.2}},
    "payload": {"mass": 1.5, "center": [0, 0, 0.02]},
    "velocity_scale": 0.9,
    "task": ["x", "y", "z", "rz"],
}
OBJECT = [
    {"name": "box 1", "shape": {"type": "box", "size": [0.2, 0.1, 0.05]}, "pose": {"position": [1.5, 0, 0.1]}},
]
Q = "0.4,0.8,0.1,0.4"


def number(text: str) -> float | None:
    """What a field shows; null for words."""
    try:
        return float(text.replace("−", "-"))
    except ValueError:
        return None


def switched(studio: Studio, *, millimetres: bool) -> dict[str, float | None]:
    """The numbers of all fields after the switch."""
    studio.run("(millimetres) => studio.store.set({millimetres})", millimetres)
    return {label: number(text) for label, text in studio.run(FIELDS).items()}


def opened(studio: Studio, panel: str) -> None:
    """A panel with something in all of its fields."""
    more: dict[str, str] = {}
    if panel == "trajectory":
        more = {"motion": json.dumps(MOTION)}
    if panel == "cell":
        more = {"objects": json.dumps(OBJECT)}
    if panel == "ik":
        more = {"target": json.dumps({"position": [0.5, 0.3, 0.2], "rpy": [0.1, 0.2, 0.3]})}
    studio.open(panel, robot="scara", q=Q, **more)
    if panel == "robot":
        studio.button("DH table").click()
        studio.until("document.querySelectorAll('.dh input').length > 20")
        studio.button("Names, velocity, effort").click()
    if panel == "cell":
        studio.page.locator(".object").click()
    studio.run("document.querySelectorAll('details').forEach((one) => (one.open = true))")
    if panel == "trajectory":
        studio.until("studio.store.value.plan")
        studio.page.locator(".segment-head").nth(1).click()


@pytest.mark.slow
@pytest.mark.parametrize("panel", ["robot", "pose", "ik", "jacobian", "trajectory", "workspace", "cell"])
def test_only_lengths_change_with_their_unit(studio: Studio, panel: str) -> None:
    """Every number field of every panel: times, scales, efforts, forces, quaternions and angles stay as they are."""
    opened(studio, panel)
    before = switched(studio, millimetres=False)
    after = switched(studio, millimetres=True)
    assert len(before) >= {"workspace": 1, "pose": 4, "jacobian": 3}.get(panel, 6)
    assert before.keys() == after.keys()
    for label, value in before.items():
        factor = 1000 if LENGTHS.fullmatch(label) else 1
        expected = None if value is None else pytest.approx(value * factor, abs=0.05 if factor == 1000 else 0)
        assert after[label] == expected, label
    assert any(LENGTHS.fullmatch(label) for label in before)
    # The labels in the picture follow with its next frame.
    studio.until(f"({MIXED})().every((text) => {json.dumps(GIVEN)}.some((given) => text.startsWith(given)))")
    assert switched(studio, millimetres=False) == before


@pytest.mark.slow
def test_a_quaternion_is_no_length(studio: Studio) -> None:
    turned = {"position": [0.5, 0.3, 0.2], "quaternion_xyzw": [0.5, 0.5, 0.5, 0.5]}
    studio.open("ik", robot="scara", q=Q, target=json.dumps(turned))
    shown = switched(studio, millimetres=True)
    assert [shown[f"Target {name}"] for name in ("x", "y", "z")] == [500, 300, 200]
    assert [shown[f"Target {name}"] for name in ("qx", "qy", "qz", "qw")] == [0.5] * 4
    studio.field("Notation of the orientation").select_option("matrix")
    shown = switched(studio, millimetres=True)
    assert [shown[f"Target row 1, column {j}"] for j in (1, 2, 3, 4)] == [0, 0, 1, 500]


@pytest.mark.slow
def test_millimetres_are_typed_and_metres_sent(studio: Studio) -> None:
    """And back: what the service gives in metres is read in millimetres, to the last digit, after a reload too."""
    studio.open("cell", robot="scara", q=Q, objects=json.dumps(OBJECT))
    studio.page.locator(".object").click()
    switched(studio, millimetres=True)
    for text, metres in {"350": 0.35, "0.35 m": 0.35, "123.4": 0.1234, "35 mm": 0.035, "-1e2": -0.1}.items():
        studio.type("Size x", "200")
        studio.type("Position y", text)
        studio.until(f"studio.store.value.scene.objects[0].pose.position[1] === {metres}")
        assert studio.state("scene")["objects"][0]["shape"]["size"] == [0.2, 0.1, 0.05]
    with studio.page.expect_request(lambda request: places_of(request) == [[1.5, 0.35, 0.1]]):
        studio.type("Position y", "350")
    assert "0.35" in studio.address()
    studio.until("studio.store.value.contacts")
    shown, distance = studio.run(
        "[document.querySelector('.pairs .value').textContent, studio.store.value.contacts.pairs[0].distance]"
    )
    assert shown == f"{distance * 1000:.1f} mm".replace("-", "−")


def places_of(request: Request) -> list[Any]:
    """Where the objects of a call are."""
    if not request.url.endswith("/collisions"):
        return []
    return [one["pose"]["position"] for one in json.loads(request.post_data or "{}")["scene"]["objects"]]


@pytest.mark.slow
def test_the_unit_of_lengths_stays(studio: Studio) -> None:
    """For the next visit, and in a link; the tip, the dimensions and what is measured follow it at once."""
    studio.open("pose", robot="scara", q=Q)
    studio.button("mm").click()
    studio.button("DH frames").click()
    studio.button("Dimensions").click()
    x, y, z = (row[3] for row in studio.tip()[:3])
    position = studio.page.locator("[data-format=position]")
    assert position.locator(".unit").text_content() == "mm"
    assert [number(text) for text in position.locator("span > span:not(.unit)").all_text_contents()] == [
        pytest.approx(value * 1000, abs=0.005) for value in (x, y, z)
    ]
    studio.until("studio.store.value.table")
    a = studio.run("studio.store.value.table.dh.joints[0].a")
    studio.until(f"[...document.querySelectorAll('.label')].some((one) => one.textContent === 'a₁ = {a * 1000:g} mm')")
    assert studio.run("JSON.parse(localStorage['gelenk.preferences']).millimetres")
    assert "show=millimetres" in studio.address()
    studio.open("pose", robot="scara", q=Q)
    assert studio.button("mm").get_attribute("aria-pressed") == "true"
    assert number(studio.field("joint_3, number").input_value()) == 100
    studio.field("joint_3, number").press("ArrowUp")
    studio.type("joint_3, number", "50")
    assert studio.state("positions")["joint_3"] == 0.05
    studio.button(
        "m",
    ).click()
    assert studio.field("joint_3, number").input_value() == "0.05"


def test_the_point_moves_without_rounding() -> None:
    """0.1234 m is 123.4 mm, and 123.4 mm is 0.1234 m, which products of doubles are not always."""
    metres = [0.35, 0.1234, 0.0003, 1e-9, 12.345, -0.07, 0.3, 1 / 3, 0]
    mm = "{millimetres: true, degrees: false}"
    texts = values("ui/quantity.ts", [f"m.exact({value}, 'length', {mm})" for value in metres])
    assert texts[:7] == ["350", "123.4", "0.3", "0.000001", "12345", "-70", "300"]
    back = values("ui/quantity.ts", [f"m.parse('{text}', 'length', {mm})" for text in texts])
    assert back == pytest.approx(metres, rel=1e-15)
    assert back[:7] == metres[:7]


def test_a_unit_that_is_typed_counts() -> None:
    """Whatever the switch says."""
    for millimetres in ("true", "false"):
        units = f"{{millimetres: {millimetres}, degrees: false}}"
        typed = [f"m.parse('{text}', 'length', {units})" for text in ("35 mm", "0.035 m", "3.5e1mm", "5 cm", "m", "mm")]
        assert values("ui/quantity.ts", typed) == [0.035, 0.035, 0.035, None, None, None]
    shown = [
        f"m.shownUnit('{unit}', {{millimetres: true, degrees: true}})" for unit in ("m/s²", "rad/s", "N m", "s", "")
    ]
    assert values("ui/quantity.ts", shown) == ["mm/s²", "°/s", "N m", "s", ""]
