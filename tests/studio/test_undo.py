"""Undo and redo of what a person changes, whichever panel it is done in."""

import contextlib
import json
import math
import time
from typing import Any

import pytest
from playwright.sync_api import Error, FloatRect, Request, Response, Route

from tests.oracles import catalogue
from tests.studio.browser import PATIENCE, Studio
from tests.studio.inverse import SOLVED
from tests.studio.pure import values
from tests.studio.test_cell import TETRAHEDRON
from tests.studio.test_figure import CAMERA, COUNTS, ON_SCREEN
from tests.studio.test_robot import DROP

START = [0.3, 0.6]
DOC = """{robot: "scara", draft: null, base: null, tip: null, positions: {a: 0, b: 0}, target: null, inverse: null,
  motion: null, scene: {name: null, objects: [], origin: null}, writing: {part: "pose"}, options: {}}"""


def names_of(changes: list[str]) -> list[Any]:
    """What the steps from the document above are called, `to` being the document that is changed."""
    return values("history/doc.ts", [f"((d) => m.step(d, {{...d, {change}}}))({DOC})" for change in changes])


def test_a_step_is_called_by_what_differs() -> None:
    table = "draft: {convention: 'standard', joints: [{a: 1, d: 0}, {a: 2, d: 0}]}"
    box = "{name: 'box 1', shape: {type: 'sphere', radius: 1}}"
    scene = f"scene: {{name: null, origin: null, objects: [{box}]}}"
    found = names_of(
        [
            "robot: 'panda', positions: {c: 1}",
            "positions: {a: 1, b: 0}",
            "positions: {a: 1, b: 2}",
            table,
            scene,
            "tip: 'tool'",
            "inverse: {solutions: 'one'}",
            "writing: {part: 'jacobian'}",
            "options: {'workspace.section': 'xz'}",
        ]
    )
    assert [(step["name"], step["panel"]) for step in found] == [
        ("Show panda", None),
        ("Move a", None),
        ("Move the robot", None),
        ("Change the table", None),
        ("Add box 1", None),
        ("Choose the chain", None),
        ("Change what the inverse looks for", "ik"),
        ("Change the worked solution", "worked"),
        ("Change a setting", "workspace"),
    ]
    pairs = [
        (table, "draft: {...d.draft, joints: [{a: 1, d: 0}, {a: 2.5, d: 0}]}", "Change a of row 2"),
        (table, "draft: {...d.draft, joints: [...d.draft.joints, {a: 0, d: 0}]}", "Add a row"),
        (table, "draft: {...d.draft, joints: [{a: 1, d: 0}]}", "Remove a row"),
        (scene, "scene: {...d.scene, objects: []}", "Remove box 1"),
        (scene, "scene: {...d.scene, objects: [{...d.scene.objects[0], pose: {}}]}", "Change box 1"),
        ("target: {position: [0, 0, 1]}", "target: {position: [0, 1, 1]}, positions: {a: 1, b: 1}", "Move the target"),
    ]
    named = [f"((d) => m.step(d, {{...d, {to}}}).name)({{...{DOC}, {start}}})" for start, to, _ in pairs]
    assert values("history/doc.ts", named) == [name for _, _, name in pairs]


def test_what_nobody_has_done_is_no_step() -> None:
    """A target and a motion that a panel begins with, objects that arrive, a scene that is stored, an exercise."""
    motion = "{robot: 'r', base_frame: 'b', tip_frame: 't', start: [0]}"
    assert (
        names_of(
            [
                "target: {position: [0, 0, 1]}",
                f"motion: {motion}",
                "positions: {c: 1}",
                "positions: {a: 0, b: 0}",
                "scene: {name: 'kept', objects: [], origin: 'kept'}",
                "options: {'exercises.task': 'x', 'workspace.job': '1'}",
            ]
        )
        == [None] * 6
    )
    start = f"{{...{DOC}, motion: {motion}, scene: {{name: null, origin: null, objects: [{{name: 'box'}}]}}}}"
    changes = ["motion: {...d.motion, robot: 's'}", "scene: {...d.scene, name: 'kept', origin: 'kept'}"]
    assert values("history/doc.ts", [f"((d) => m.step(d, {{...d, {to}}}))({start})" for to in changes]) == [None, None]


def test_a_scene_that_comes_back_is_not_taken_for_the_one_the_service_keeps_now() -> None:
    kept = "{name: 'kept', objects: [{name: 'box'}], origin: 'kept'}"
    before = "{'jacobian.part': 'linear', 'exercises.task': 'old'}"
    now = "{'exercises.task': 'new', 'jacobian.form': 'body'}"
    found = values(
        "history/doc.ts",
        [
            f"m.restored({{...{DOC}, scene: {kept}}}, {DOC}).scene",
            f"m.restored({{...{DOC}, scene: {kept}}}, {{...{DOC}, scene: {kept}}}).scene",
            f"m.restored({{...{DOC}, options: {before}}}, {{...{DOC}, options: {now}}}).options",
        ],
    )
    assert [scene["name"] for scene in found[:2]] == [None, "kept"]
    assert found[0]["origin"] == "kept"
    assert found[2] == {"exercises.task": "new", "jacobian.part": "linear"}


def test_the_past_is_bounded_and_what_was_undone_is_lost_by_a_new_step() -> None:
    walk = """((past) => { for (const n of [1, 2, 3, 4]) past.push(n); past.go(-1); past.go(-1);
      const middle = [past.before, past.present, past.after]; past.push(9); past.amend(10);
      return [middle, past.before, past.present, past.after, past.row.states, past.go(1), past.present]; })"""
    bounded = "((past) => { for (let n = 1; n < 500; n += 1) past.push(n); return past.row; })(new m.Past(0))"
    found, data = values("history/past.ts", [f"{walk}(new m.Past(0, 3))", bounded])
    assert found == [[1, 2, 3], 2, 10, None, [1, 2, 10], None, 10]
    assert data == {"states": list(range(399, 500)), "at": 100}
    assert values("history/past.ts", ["((p) => [p.before, p.after])(m.Past.of({states: [1, 2, 3], at: 1}))"]) == [
        [1, 3]
    ]


def undo(studio: Studio) -> Any:
    return studio.page.locator("button.undo").first


def redo(studio: Studio) -> Any:
    return studio.page.locator("button.undo").last


def joints(studio: Studio) -> list[float]:
    return list(studio.state("positions").values())


def box_of(studio: Studio, label: str) -> FloatRect:
    box = studio.field(label).bounding_box()
    assert box
    return box


def drag_slider(studio: Studio, label: str, share: float) -> None:
    """By the mouse, in several moves."""
    box = box_of(studio, label)
    y = box["y"] + box["height"] / 2
    studio.page.mouse.move(box["x"] + box["width"] / 2, y)
    studio.page.mouse.down()
    studio.page.mouse.move(box["x"] + share * box["width"], y, steps=6)
    studio.page.mouse.up()


def untouched(studio: Studio) -> None:
    """Have the focus in no field."""
    studio.run("document.activeElement.blur()")


@pytest.mark.slow
def test_a_drag_is_a_step_and_its_name_is_on_the_button_and_read_out(studio: Studio) -> None:
    studio.open("pose", robot="planar_2r", q="0.3,0.6", show="dh,dimensions")
    assert undo(studio).get_attribute("aria-disabled") == "true"
    studio.drawn()
    x, y = studio.run(ON_SCREEN, ["DH theta 2", 0.5])
    studio.page.mouse.move(x, y)
    studio.page.mouse.down()
    studio.page.keyboard.down("Shift")  # in the midst of a drag begins nothing
    studio.page.mouse.move(x + 30, y - 40, steps=8)
    studio.page.keyboard.up("Shift")
    studio.page.mouse.up()
    turned = joints(studio)
    assert abs(turned[1] - 0.6) > 0.05
    drag_slider(studio, "joint_1", 0.7)
    moved = joints(studio)
    assert moved[0] != 0.3
    assert undo(studio).get_attribute("aria-label") == "Undo: Move joint_1"
    studio.page.keyboard.press("Control+z")
    assert joints(studio) == turned
    assert studio.page.locator(".told").text_content() == "Undone: Move joint_1"
    assert undo(studio).get_attribute("aria-label") == "Undo: Move joint_2"
    undo(studio).click()
    assert joints(studio) == START
    assert undo(studio).get_attribute("aria-disabled") == "true"
    studio.page.keyboard.press("Control+z")
    assert studio.page.locator(".told").text_content() == "There is nothing to undo."
    studio.page.keyboard.press("Control+Shift+Z")
    assert joints(studio) == turned
    studio.page.keyboard.press("Control+y")
    assert joints(studio) == moved
    redo(studio).press("Enter")
    assert studio.page.locator(".told").text_content() == "There is nothing to redo."
    studio.page.keyboard.press("Control+z")
    studio.button("Home").click()
    assert redo(studio).get_attribute("aria-disabled") == "true", "lost after a new change"
    studio.page.keyboard.press("Control+z")
    assert joints(studio) == turned
    studio.until("location.hash.includes('q=' + Object.values(studio.store.value.positions).join(','))")


@pytest.mark.slow
def test_keys_in_one_field_are_a_step_and_buttons_are_one_each(studio: Studio) -> None:
    studio.open("pose", robot="planar_2r", q="0.3,0.6")
    studio.field("joint_1").focus()
    for _ in range(5):
        studio.page.keyboard.press("ArrowRight")
    studio.field("joint_2").focus()
    studio.page.keyboard.press("ArrowLeft")
    studio.button("Random").focus()
    studio.page.keyboard.press("Space")
    first = joints(studio)
    studio.page.keyboard.press("Space")
    assert joints(studio) != first
    found = []
    while undo(studio).get_attribute("aria-disabled") == "false":
        found.append(undo(studio).get_attribute("aria-label"))
        studio.page.keyboard.press("Control+z")
    assert found == ["Undo: Move the robot", "Undo: Move the robot", "Undo: Move joint_2", "Undo: Move joint_1"]
    assert joints(studio) == START


@pytest.mark.slow
def test_the_browser_undoes_what_is_being_typed_and_the_page_what_has_been_taken(studio: Studio) -> None:
    studio.open("pose", robot="planar_2r", q="0.3,0.6")
    studio.button("Zero").click()
    field = studio.field("joint_1, number")
    field.click()
    studio.page.keyboard.type("1.5")
    studio.page.keyboard.press("Control+z")
    assert joints(studio) == [0, 0], "Zero is not undone"
    assert field.input_value() != "1.5"
    field.fill("1.5")
    studio.page.keyboard.press("Enter")
    assert joints(studio) == [1.5, 0]
    studio.page.keyboard.press("Control+z")
    assert joints(studio) == [0, 0]
    assert field.input_value() == "0"
    field.fill("1")
    studio.button("Random").click()  # takes what is typed, and then moves: two steps
    studio.page.keyboard.press("Control+z")
    assert joints(studio) == [1, 0]
    studio.page.keyboard.press("Control+z")
    assert joints(studio) == [0, 0]
    studio.page.keyboard.press("Control+z")
    assert joints(studio) == START


@pytest.mark.slow
def test_another_robot_comes_back_as_it_stood_and_a_panel_is_no_step(studio: Studio) -> None:
    studio.open("robot", robot="planar_2r", q="0.3,0.6")
    studio.page.locator('[data-robot="scara"]').click()
    studio.wait_for_robot("scara")
    studio.page.get_by_role("tab", name="Pose").click()
    studio.button("Random").click()
    there = joints(studio)
    studio.page.get_by_role("tab", name="Jacobian").click()
    assert undo(studio).get_attribute("aria-label") == "Undo: Move the robot"
    studio.page.keyboard.press("Control+z")
    assert studio.state("panel") == "jacobian", "the picture shows what is undone"
    assert undo(studio).get_attribute("aria-label") == "Undo: Show scara"
    studio.page.keyboard.press("Control+z")
    studio.wait_for_robot("planar_2r")
    assert joints(studio) == START
    for name in ("scara", "planar_2r", "scara"):  # the last one before the first one is there
        studio.page.keyboard.press("Control+y" if name == "scara" else "Control+z")
    studio.wait_for_robot("scara")
    studio.page.keyboard.press("Control+y")
    assert joints(studio) == there
    studio.until("location.hash.includes('robot=scara') && location.hash.includes('jacobian')")
    studio.page.go_back()
    studio.until("studio.store.value.robot === 'planar_2r' || studio.store.value.panel !== 'jacobian'")


@pytest.mark.slow
def test_a_cell_of_a_table_and_a_drag_of_its_piece(studio: Studio) -> None:
    table = catalogue.dh_table("planar_2r")
    studio.open("robot", dh_table=json.dumps(table), q="0.3,0.6", show="dh,dimensions")
    studio.page.get_by_role("button", name="DH table").click()
    label = studio.page.locator(".dh input").first.get_attribute("aria-label")
    assert label
    studio.drawn()
    drawn = "!studio.store.value.loading && studio.store.value.draft.joints"

    def drafts() -> list[Any]:
        studio.until("!studio.store.value.loading")
        return [row["a"] for row in studio.state("draft")["joints"]]

    before = drafts()
    x, y = studio.run(ON_SCREEN, ["DH a 2", 0.5])
    studio.page.mouse.move(x, y)
    studio.page.mouse.down()
    studio.page.mouse.move(x + 60, y - 40, steps=8)
    studio.page.mouse.up()
    studio.until(f"{drawn}[1].a !== {before[1]}")
    studio.drawn()
    dragged = drafts()
    cell = studio.page.locator(".dh input[aria-label*='a']").first
    cell.fill("0.9")
    cell.press("Enter")
    typed = drafts()
    assert typed != dragged
    untouched(studio)
    studio.page.keyboard.press("Control+z")
    assert drafts() == dragged
    assert joints(studio) == START
    undo(studio).click()
    assert drafts() == before
    redo(studio).click()
    redo(studio).click()
    assert drafts() == typed
    shown = [float(studio.page.locator(".dh input[aria-label*='a']").first.input_value())]
    assert shown == [0.9]


HANDLE = """(name) => {
  const {view} = studio;
  const node = view.scene.getObjectByName(name);
  const at = node.getWorldPosition(node.position.clone()).project(view.camera);
  const {left, top, width, height} = view.canvas.getBoundingClientRect();
  return [left + (at.x + 1) / 2 * width, top + (1 - at.y) / 2 * height];
}"""


def drag_handle(studio: Studio, name: str) -> None:
    """In the plane of the screen, by the middle of the handles; the camera stays, wherever it would go otherwise."""
    studio.drawn()
    x, y = studio.run(HANDLE, name)
    studio.page.mouse.move(x, y)
    studio.drawn()
    camera = studio.run(CAMERA)
    studio.page.mouse.down()
    studio.page.mouse.move(x + 40, y - 20, steps=5)
    assert studio.run(CAMERA) == pytest.approx(camera)
    studio.page.mouse.up()


@pytest.mark.slow
def test_a_target_that_is_dragged_takes_the_robot_back_with_it(studio: Studio) -> None:
    studio.open("ik", robot="ur5e", q="0.3,-1.1,1.2,0.4,0.5,0.2")
    studio.until("studio.store.value.target")
    assert undo(studio).get_attribute("aria-disabled") == "true", "what the panel begins with is no step"
    start, target = joints(studio), studio.state("target")
    drag_handle(studio, "target handle")
    moved = studio.state("target")
    assert math.dist(moved["position"], target["position"]) > 0.01
    studio.until(f"JSON.stringify(Object.values(studio.store.value.positions)) !== {json.dumps(json.dumps(start))}")
    studio.until(SOLVED)
    assert undo(studio).get_attribute("aria-label") == "Undo: Move the target"
    studio.page.get_by_role("tab", name="Pose").click()
    studio.page.keyboard.press("Control+z")
    assert studio.state("panel") == "ik", "the target is shown where it is undone"
    assert studio.state("target") == target
    assert joints(studio) == pytest.approx(start, abs=1e-15)
    studio.page.keyboard.press("Control+y")
    assert studio.state("target") == moved


@pytest.mark.slow
def test_an_object_is_moved_and_removed_and_comes_back(studio: Studio) -> None:
    studio.open("cell", robot="ur5e")
    studio.button("Box").click()
    studio.until("studio.store.value.scene.objects.length === 1")
    added = studio.state("scene")["objects"]
    drag_handle(studio, "object handle")
    dragged = studio.state("scene")["objects"]
    assert dragged != added
    studio.button("Remove").click()
    nothing: list[Any] = []
    assert studio.state("scene")["objects"] == nothing
    said = []
    for expected in (dragged, added, nothing):
        said.append(undo(studio).get_attribute("aria-label"))
        studio.page.keyboard.press("Control+z")
        assert studio.state("scene")["objects"] == expected
    assert said == ["Undo: Remove box 1", "Undo: Change box 1", "Undo: Add box 1"]
    for expected in (added, dragged, nothing):
        studio.page.keyboard.press("Control+Shift+Z")
        assert studio.state("scene")["objects"] == expected


@pytest.mark.slow
def test_steps_outlast_a_reload_and_no_other_link(studio: Studio) -> None:
    studio.open("pose", robot="planar_2r", q="0.3,0.6")
    for name in ("Zero", "Random"):
        studio.button(name).click()
    studio.page.keyboard.press("Control+z")
    studio.until("location.hash.includes('q=0,0')")
    studio.page.reload()
    studio.wait_for_robot("planar_2r")
    assert joints(studio) == [0, 0]
    studio.page.keyboard.press("Control+y")
    assert joints(studio) != [0, 0]
    for _ in range(2):
        studio.page.keyboard.press("Control+z")
    assert joints(studio) == START
    assert undo(studio).get_attribute("aria-disabled") == "true"
    studio.open("pose", robot="planar_2r", q="0.1,0.1")
    assert redo(studio).get_attribute("aria-disabled") == "true"


@pytest.mark.slow
@pytest.mark.parametrize("kept", ["null", "7", "{", '{"hash": "#", "states": [{}], "at": 0}', '{"states": 3, "at": 9}'])
def test_steps_that_make_no_sense_are_left(studio: Studio, kept: str) -> None:
    studio.page.goto(f"{studio.url}/healthz")
    studio.run("(kept) => sessionStorage.setItem('gelenk.steps', kept)", kept)
    studio.page.goto(f"{studio.url}/#robot=planar_2r&panel=pose")
    studio.wait_for_robot("planar_2r")
    assert undo(studio).get_attribute("aria-disabled") == "true"


@pytest.mark.slow
def test_sixty_times_back_and_forth_leave_nothing(studio: Studio) -> None:
    """Through two robots, their tables' frames and a scene."""
    studio.open("robot", robot="planar_2r", q="0.3,0.6", show="dh,dimensions")
    studio.page.locator('[data-robot="scara"]').click()
    studio.wait_for_robot("scara")
    studio.page.get_by_role("tab", name="Cell").click()
    studio.button("Sphere").click()
    studio.button("Box").click()
    studio.page.get_by_role("tab", name="Pose").click()
    studio.button("Random").click()
    untouched(studio)
    end = joints(studio)
    under_way: set[Request] = set()
    studio.page.on("request", lambda request: under_way.add(request))  # noqa: PLW0108 - it takes no built-in
    for event in ("requestfinished", "requestfailed"):
        studio.page.on(event, lambda request: under_way.discard(request))  # noqa: PLW0108

    def visit(key: str, robot: str) -> list[int]:
        button = undo(studio) if key == "z" else redo(studio)
        while button.get_attribute("aria-disabled") == "false":
            studio.page.keyboard.press(f"Control+{key}")
        studio.wait_for_robot(robot)
        studio.until("studio.store.value.table")
        studio.until("!studio.store.value.scene.objects.length || studio.store.value.contacts")
        return settled(studio, under_way)

    first, *others = [[visit("z", "planar_2r"), visit("y", "scara")] for _ in range(7)]
    assert first[0] != first[1]
    for found in others:
        for (on_card, *drawn), (on_card_first, *drawn_first) in zip(found, first, strict=True):
            assert drawn == drawn_first
            assert on_card < on_card_first + 6, "but for what was out of the picture then; a leak each time adds more"
    assert joints(studio) == end


def settled(studio: Studio, under_way: set[Request]) -> list[int]:
    """What is drawn, when for a while nothing is asked for any more: answers about contacts follow the robot."""
    calm, reading, deadline = 0, list[int](), time.monotonic() + PATIENCE
    while calm < 5:
        assert time.monotonic() < deadline, f"{len(under_way)} requests are under way, {reading} drawn"
        before, reading = reading, studio.run(COUNTS)
        calm = calm + 1 if reading == before and not under_way else 0
    return reading


def is_of_all_solutions(response: Response) -> bool:
    return response.url.endswith("/ik") and json.loads(response.request.post_data or "{}").get("solutions") != "one"


@pytest.mark.slow
def test_the_answer_to_a_target_that_was_undone_moves_nothing(studio: Studio) -> None:
    """The robot follows a target that is moved by keys; the last answer comes after undo."""
    studio.open("ik", robot="ur5e", q="0.3,-1.1,1.2,0.4,0.5,0.2")
    studio.until(SOLVED)
    start, target = joints(studio), studio.state("target")
    waiting: list[Route] = []
    studio.page.route("**/v1/robots/ur5e/ik", lambda route: waiting.append(route))  # noqa: PLW0108 - playwright takes functions alone
    studio.field("Target z").press("ArrowUp")
    assert studio.state("target") != target
    untouched(studio)
    studio.page.keyboard.press("Control+z")
    assert studio.state("target") == target
    studio.page.unroute("**/v1/robots/ur5e/ik")
    with studio.page.expect_response(is_of_all_solutions):
        for route in waiting:
            with contextlib.suppress(Error):  # the page has given up the first one
                route.continue_()
    assert studio.state("target") == target
    assert joints(studio) == start


@pytest.mark.slow
def test_an_object_of_a_file_comes_back_with_it(studio: Studio) -> None:
    """The service keeps the files of a scene's objects alone, and has them still when the object is back."""
    stored = "studio.store.value.scene.name !== null && studio.store.value.scene.objects.length"
    studio.open("cell", robot="ur5e")
    for count, file in enumerate(("one.obj", "two.obj"), 1):
        studio.run(DROP, [file, list(TETRAHEDRON)])
        studio.until(f"{stored} === {count}")
    studio.button("Remove").click()
    studio.until(f"{stored} === 1")
    untouched(studio)
    studio.page.keyboard.press("Control+z")
    assert len(studio.state("scene")["objects"]) == 2
    studio.until(f"{stored} === 2")
    name = studio.state("scene")["name"]
    for file in ("one.obj", "two.obj"):
        assert studio.page.request.get(f"{studio.url}/v1/scenes/{name}/files/{file}").body() == TETRAHEDRON
    assert undo(studio).get_attribute("aria-label") == "Undo: Add two 1"
