"""The Cell panel: objects around the arm, what they touch, and scenes that the service keeps."""

import json
from typing import Any

import pytest

from tests.studio.browser import Studio
from tests.studio.inverse import SOLVED
from tests.studio.test_robot import DROP
from tests.test_serve import get

READY = "0,-0.785,0,-2.356,0,1.571,0.785,0"
LINES = """(() => { const found = []; studio.view.scene.traverse((node) => {
  if (node.name === "nearest points") found.push(node.position.toArray()); }); return found; })()"""
KNOWN = "studio.store.value.contacts"


def said(studio: Studio) -> dict[str, Any]:
    """What the service says of the configuration and the scene on the screen."""
    call = {"joint_positions": [[float(value) for value in READY.split(",")[:7]]], "clearance": True}
    scene = {"objects": studio.state("scene")["objects"]}
    status, answer = get(f"{studio.url}/v1/robots/panda/collisions", "POST", {**call, "scene": scene})
    assert status == 200, answer
    return dict(answer["results"][0])


@pytest.mark.slow
def test_an_object_is_added_moved_into_the_arm_and_stored(studio: Studio) -> None:
    studio.open("cell", q=READY)
    studio.until(KNOWN)
    assert not studio.state("contacts")["inCollision"]
    studio.button("Box").click()
    studio.type("Size x", "0.3")
    for axis, value in zip("xyz", (0.5, 0.1, 0.6), strict=True):
        studio.type(f"Position {axis}", str(value))
    studio.until(f"{KNOWN}?.inCollision && studio.store.value.scene.objects[0].pose.position[2] === 0.6")
    result = said(studio)
    studio.until(f"{KNOWN}.clearance === {json.dumps(result['clearance'])}")
    assert result["in_collision"]
    pairs = studio.state("contacts")["pairs"]
    assert "box 1" in {pairs[0]["a"], pairs[0]["b"]}
    assert pairs[0]["distance"] == pytest.approx(result["clearance"])
    assert studio.run(LINES)[0] == pytest.approx(pairs[0]["point_a"])
    assert studio.page.locator(".verdict-text").text_content() == "In contact"
    assert studio.page.locator(".pairs tbody tr").count() == len(pairs)
    studio.field("Name of the scene").fill("my_box")
    studio.button("Store").click()
    studio.until("studio.store.value.scene.name === 'my_box'")
    kept = get(f"{studio.url}/v1/scenes/my_box")[1]["objects"]
    assert [one["pose"]["position"] for one in kept] == [[0.5, 0.1, 0.6]]
    studio.until("location.hash.includes('scene=my_box')")
    studio.page.reload()
    studio.wait_for_robot("panda")
    studio.until(f"{KNOWN}?.inCollision")
    studio.button("Clear").click()
    studio.until(f"{KNOWN} && !{KNOWN}.inCollision")


@pytest.mark.slow
def test_solutions_in_contact_are_told_apart(studio: Studio) -> None:
    target = {"position": [0.4, 0.25, 0.3], "rpy": [3.14, 0, 0]}
    wall = {"name": "wall", "shape": {"type": "box", "size": [0.6, 0.1, 0.8]}, "pose": {"position": [0.4, 0.45, 0.3]}}
    studio.open("ik", robot="ur5", target=json.dumps(target), objects=json.dumps([wall]))
    studio.until(SOLVED)
    found = studio.page.locator(".solution[data-tone=bad]")
    assert 0 < found.count() < studio.page.locator(".solution").count()
    assert "in contact: " in (found.first.text_content() or "")
    assert f"In contact: {found.count()} of them." in (studio.page.locator(".verdict-summary").text_content() or "")


@pytest.mark.slow
def test_a_motion_in_a_scene_has_its_clearance_as_a_curve(studio: Studio) -> None:
    start = [float(value) for value in READY.split(",")[:7]]
    ends = {"robot": "panda", "base_frame": "panda_link0", "tip_frame": "panda_hand_tcp"}
    motion = {**ends, "start": start, "segments": [{"type": "joint", "target": [1.2, *start[1:]]}]}
    post = {"name": "post", "shape": {"type": "sphere", "radius": 0.1}, "pose": {"position": [0.25, 0.17, 0.3]}}
    studio.open("trajectory", q=READY, motion=json.dumps(motion), objects=json.dumps([post]))
    studio.until("studio.store.value.plan && document.querySelector('.clearance canvas')")
    nearest = studio.run("studio.store.value.plan.answer.audit.clearance")
    assert "post" in {nearest["pair"]["a"], nearest["pair"]["b"]}
    assert "Clearance" in (studio.page.locator(".findings").first.text_content() or "")
    studio.field("Time in the motion").fill(str(nearest["time"]))
    said_then = studio.page.locator(".clearance").locator("xpath=..").text_content() or ""
    assert abs(float(said_then.split(": ")[1].split(" ")[0]) - nearest["value"]) < 1e-3
    blocked = {**post, "pose": {"position": [0.25, 0.17, 0.45]}}
    studio.run("(objects) => studio.store.set({scene: {name: null, objects, origin: null}})", [blocked])
    studio.button("Plan").click()
    studio.until("studio.store.value.plan.answer.failure?.reason === 'collision'")
    studio.button("Show the contact").click()
    studio.until("studio.store.value.contacts && Math.abs(studio.store.value.contacts.clearance) < 1e-4")


TETRAHEDRON = b"v 0 0 0\nv 0.2 0 0\nv 0 0.2 0\nv 0 0 0.2\nf 1 3 2\nf 1 2 4\nf 1 4 3\nf 2 3 4\n"


@pytest.mark.slow
def test_a_mesh_dropped_on_the_page_becomes_an_object_that_is_moved_and_removed(
    studio: Studio, refusals: set[int]
) -> None:
    studio.open("pose", q=READY)
    studio.run(DROP, ["my wedge.obj", list(TETRAHEDRON)])
    studio.until("studio.store.value.scene.objects.length === 1 && studio.store.value.panel === 'cell'")
    name = studio.state("scene")["name"]
    assert studio.page.request.get(f"{studio.url}/v1/scenes/{name}/files/my_wedge.obj").body() == TETRAHEDRON
    studio.until("studio.view.scene.getObjectByName('my wedge 1').getObjectByProperty('isMesh', true)")
    studio.type("Position z", "0.6")
    studio.type("Position x", "0.25")
    studio.until(f"{KNOWN}?.inCollision && studio.store.value.scene.name === {json.dumps(name)}")
    assert get(f"{studio.url}/v1/scenes/{name}")[1]["objects"][0]["pose"]["position"] == [0.25, 0, 0.6]
    refusals.add(422)
    studio.run(DROP, ["broken.stl", list(b"solid nothing")])
    problem = studio.page.locator(".problem:visible")
    problem.wait_for()
    assert "broken.stl" in (problem.text_content() or "")
    assert len(studio.state("scene")["objects"]) == 1
    studio.page.locator(".object").click()
    studio.button("Remove").click()
    studio.until(f"{KNOWN} && !{KNOWN}.inCollision && studio.store.value.scene.objects.length === 0")


@pytest.mark.slow
def test_every_panel_says_where_the_fingers_are_once_there_is_an_object(studio: Studio) -> None:
    start = [float(value) for value in READY.split(",")[:7]]
    (tip,) = studio.fk("panda", {"joint_positions": [start], "pose_format": "quaternion_xyzw"})["poses"]
    x, y, z = tip["position"]
    # The left finger reaches it when it is open, and no link does when it is closed.
    post = {"name": "post", "shape": {"type": "sphere", "radius": 0.01}, "pose": {"position": [x, y + 0.045, z]}}
    ends = {"robot": "panda", "base_frame": "panda_link0", "tip_frame": "panda_hand_tcp"}
    motion = {**ends, "start": start, "segments": [{"type": "joint", "target": [*start[:6], 0.9]}]}
    bodies: dict[str, dict[str, Any]] = {}

    def listen(request: Any) -> None:
        call = request.url.rsplit("/", 1)[1]
        if request.method == "POST" and call in ("ik", "trajectory", "workspace"):
            bodies[call] = json.loads(request.post_data)

    studio.page.on("request", listen)
    address = {"q": READY.removesuffix("0") + "0.04", "target": json.dumps(tip), "objects": json.dumps([post])}
    studio.open("ik", **address)
    studio.until("document.querySelector('.verdict-failure')?.textContent.includes('Only in contact')")
    studio.open("trajectory", motion=json.dumps(motion), **address)
    studio.until("studio.store.value.plan?.answer.failure?.reason === 'collision'")
    studio.run("(q) => studio.store.set({positions: {...studio.store.value.positions, panda_finger_joint1: q}})", 0.01)
    studio.until("document.querySelector('.plan-status').textContent.startsWith('A joint off the chain has moved')")
    studio.button("Plan").click()
    studio.until("studio.store.value.plan.answer.failure === null")
    assert bodies["trajectory"]["other_joints"] == {"panda_finger_joint1": 0.01}
    studio.open("workspace", **address, **{"workspace.samples": "1000"})
    studio.button("Compute").click()
    studio.until("document.querySelector('[data-points]')")
    studio.page.remove_listener("request", listen)
    assert bodies["ik"]["other_joints"] == bodies["workspace"]["other_joints"] == {"panda_finger_joint1": 0.04}
