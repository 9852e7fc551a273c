"""An arm that is a table, drawn as a textbook draws it: links, dimensions, and what the pointer does to them."""

import itertools
import math
from collections.abc import Callable
from typing import Any

import numpy as np
import pytest

from tests.oracles import catalogue
from tests.robots import described
from tests.studio.browser import Studio

PATHS = """([part, count]) => {
  const {view, store} = studio;
  const paths = [...Array(count).keys()].map((i) => view.scene.getObjectByName(`DH ${part} ${i + 1}`).userData.path);
  const frames = [...Array(count + 1).keys()].map((i) => store.value.model.link(`frame_${i}`).matrixWorld.elements);
  return [paths.map((path) => path.map((point) => point.toArray())), frames];
}"""
"""What is drawn of a parameter of every row, and the frames of the robot's own description, column by column."""

FRAMES = """(count) => {
  const {view, store} = studio;
  view.scene.updateMatrixWorld(true);
  const all = [...Array(count).keys()];
  const drawn = all.map((i) => view.scene.getObjectByName(`DH frame ${i}`).matrixWorld.elements);
  return [drawn, all.map((i) => store.value.model.link(`frame_${i}`).matrixWorld.elements)];
}"""
"""The frames as they are drawn, and as the robot's own description has them."""

ON_SCREEN = """([name, share]) => {
  const {view} = studio;
  const path = view.scene.getObjectByName(name).userData.path;
  const at = path[Math.round(share * (path.length - 1))].clone();
  if (path.length === 2) at.copy(path[0]).lerp(path[1], share);
  at.project(view.camera);
  const {left, top, width, height} = view.canvas.getBoundingClientRect();
  return [left + (at.x + 1) / 2 * width, top + (1 - at.y) / 2 * height];
}"""
"""Where a share of a piece is on the page."""

COUNTS = """new Promise((done) => requestAnimationFrame(() => requestAnimationFrame(() => {
  let geometries = new Set(), materials = new Set();
  studio.view.scene.traverse((node) => {
    if (node.geometry) geometries.add(node.geometry);
    for (const made of [node.material].flat().filter(Boolean)) materials.add(made);
  });
  const [labels, shown] = [new Set(), [...document.querySelectorAll(".labels > *")]];
  studio.view.scene.traverse((node) => node.isCSS2DObject && labels.add(node.element));
  const orphans = shown.filter((label) => !labels.has(label)).length;
  done([studio.view.memory(), geometries.size, materials.size, labels.size, orphans]);
})))"""
"""What is on the graphics card, what is in the scene, its labels, and labels on the page that belong to none of these.

A label is on the page from the first time on that it is to be seen, so how many are there depends on what was drawn.
"""

CAMERA = "[...studio.view.camera.position, ...studio.view.controls.target]"

LIT = "[...document.querySelectorAll('.dh td.lit input')].map((input) => input.getAttribute('aria-label'))"


def frames_of(answer: list[Any]) -> np.ndarray[Any, Any]:
    return np.array(answer).reshape(-1, 4, 4).transpose(0, 2, 1)


@pytest.mark.slow
def test_links_are_slim_and_in_the_colours_of_their_joints(studio: Studio) -> None:
    studio.open(robot="anthropomorphic")
    table = catalogue.dh_table("anthropomorphic")
    typical = np.median([abs(row[key]) for row in table["joints"] for key in ("a", "d") if row[key]])
    drawn = studio.run("""[...studio.store.value.model.drawnBy()].map(([joint, parts]) => [joint, parts.map((mesh) =>
        [mesh.scale.toArray(), "#" + mesh.material.color.getHexString(), mesh.children.length])])""")
    joints = {name: parts for name, parts in drawn if name}
    assert list(joints) == ["joint_1", "joint_2", "joint_3"]
    tints = {name: {colour for _, colour, _ in parts} for name, parts in joints.items()}
    assert [len(found) for found in tints.values()] == [1, 1, 1], "one tint a link"
    assert len(set.union(*tints.values())) == 3
    for parts in joints.values():
        assert max(scale[0] for scale, _, _ in parts) < 0.11 * typical
        assert all(edges == 1 for _, _, edges in parts)
    assert min(scale[0] for parts in joints.values() for scale, _, _ in parts) < 0.05 * typical
    longest = [max(scale[1] for scale, _, _ in parts) for name, parts in joints.items() if name != "joint_1"]
    assert longest == pytest.approx([0.5, 0.4], abs=1e-9), "as long as they are"
    before = tints["joint_1"]
    studio.button("Dark").click()
    studio.until(f"!{list(before)!r}.includes('#' + studio.store.value.model.drawnBy().get('joint_1')[0]"
                 ".material.color.getHexString())")  # fmt: skip
    colours = studio.run("""[...document.querySelectorAll(".joint-name")].map((name) =>
        getComputedStyle(name).borderLeftColor)""")
    assert len(set(colours)) == 3, "the list has them too"


@pytest.mark.slow
@pytest.mark.parametrize("name", ["ur10e", "kr210_r2700_2", "panda_dh"])
def test_an_arm_of_a_maker_is_drawn_as_it_is_built(studio: Studio, name: str) -> None:
    """As thick as the service says, with neither edges nor the colours of joints."""
    studio.open(robot=name)
    drawn = studio.run("""[...studio.store.value.model.drawnBy()].map(([joint, parts]) => [joint, parts.map((mesh) =>
        [mesh.scale.x, mesh.material.color.getHexString(), mesh.children.length])])""")
    links = {link.name: sorted(shape.size[0] for shape in link.shapes) for link in described(name).links if link.shapes}
    found = {"base" if joint is None else joint.replace("joint", "link"): parts for joint, parts in drawn}
    assert {link: sorted(radius for radius, *_ in parts) for link, parts in found.items()} == {
        link: pytest.approx(radii) for link, radii in links.items()
    }
    assert len({colour for parts in found.values() for _, colour, _ in parts}) == 1
    assert not any(children for parts in found.values() for *_, children in parts)


@pytest.mark.slow
def test_frames_and_dimensions_are_those_of_the_description(studio: Studio) -> None:
    """The picture's own product of rows against the links `frame_i` of the URDF that the service writes.

    Each arc goes from an axis of the frame before to that of its own, as that URDF has these frames.
    """
    studio.open("pose", robot="planar_2r", show="dh,dimensions")
    for name in sorted(catalogue.TABLES, key=lambda name: name == "planar_2r"):
        studio.show(name)
        studio.button("Random").click()
        studio.drawn()
        table = catalogue.dh_table(name)
        rows, positions = table["joints"], studio.state("positions")
        drawn, written = np.array(studio.run(FRAMES, len(rows) + 1))
        assert np.abs(drawn - written).max() < 1e-12, name
        for part, axis, about in (("theta", 0, 2), ("alpha", 2, 0)):
            paths, found = studio.run(PATHS, [part, len(rows)])
            T = frames_of(found)
            for i, path in enumerate(paths):
                home = i if (table["convention"] == "standard") == (part == "theta") else i + 1
                arms = np.array([path[0], path[-1]]) - T[home][:3, 3]
                radius = np.linalg.norm(arms[0])
                expected = [T[i][:3, axis], T[i + 1][:3, axis]]
                assert np.abs(arms / radius - expected).max() < 1e-9, (name, part, i)
                assert turned(path - T[home][:3, 3], T[home][:3, about]) == pytest.approx(
                    value_of(positions, rows, i, part), abs=1e-9
                )
        for part in ("a", "d"):
            paths, _ = studio.run(PATHS, [part, len(rows)])
            lengths = [math.dist(*path) for path in paths]
            wanted = [abs(value_of(positions, rows, i, part)) for i in range(len(rows))]
            assert lengths == pytest.approx(wanted, abs=1e-9)


def turned(arms: np.ndarray[Any, Any], axis: np.ndarray[Any, Any]) -> float:
    """The whole angle that a sequence of arms turns about an axis."""
    pairs = itertools.pairwise(arms)
    return sum(math.atan2(float(np.cross(one, other) @ axis), float(one @ other)) for one, other in pairs)


def value_of(positions: dict[str, float], rows: list[dict[str, Any]], i: int, part: str) -> float:
    """A parameter of a row at the configuration on the screen."""
    row = rows[i]
    value = float(row[part])
    if part == ("theta" if row["type"] == "revolute" else "d"):
        value += positions[row.get("name", f"joint_{i + 1}")]
    return value


@pytest.mark.slow
def test_values_are_shown_for_the_row_pointed_at_and_for_all_on_a_switch(studio: Studio) -> None:
    studio.open("pose", robot="anthropomorphic", show="dh", q="0.3,0.6,-0.8")
    studio.until("document.querySelectorAll('.label.z').length === 4")
    shown = studio.page.locator(".label.dimension:visible")
    studio.drawn()
    assert set(shown.all_text_contents()) == {"a₂", "a₃"}
    studio.page.locator(".joint").nth(1).hover()
    studio.drawn()
    assert set(shown.all_text_contents()) == {"a₂ = 0.5 m", "θ₂ = 0.6 rad", "a₃"}
    studio.button("Dimensions").click()
    studio.page.mouse.move(5, 5)
    studio.drawn()
    texts = {"α₁ = π/2 rad", "a₂ = 0.5 m", "a₃ = 0.4 m", "θ₁ = 0.3 rad", "θ₂ = 0.6 rad", "θ₃ = −0.8 rad"}
    assert set(shown.all_text_contents()) == texts
    studio.button("deg").click()
    studio.drawn()
    assert "θ₂ = 34.4°" in shown.all_text_contents()


@pytest.mark.slow
def test_a_cell_and_its_piece_light_up_together(studio: Studio) -> None:
    studio.open("robot", robot="anthropomorphic")
    studio.button("DH table").click()
    studio.until("studio.store.value.table")
    lit = studio.page.locator(".label.lit:visible")
    for label, text in (("Row 2, a", "a₂ = 0.5 m"), ("Row 1, α", "α₁ = π/2 rad"), ("Row 1, d", "d₁ = 0 m")):
        studio.field(label).hover()
        studio.drawn()
        assert lit.all_text_contents() == [text]
        assert studio.run(LIT) == [label]
    studio.page.mouse.move(5, 5)
    studio.field("Row 3, a").focus()
    studio.drawn()
    assert lit.all_text_contents() == ["a₃ = 0.4 m"]
    studio.run("document.activeElement.blur()")
    studio.drawn()
    assert lit.count() == 0
    studio.page.mouse.move(*studio.run(ON_SCREEN, ["DH a 3", 0.7]))
    studio.drawn()
    assert studio.run(LIT) == ["Row 3, a"]


@pytest.mark.slow
def test_a_dragged_piece_changes_its_number(studio: Studio) -> None:
    studio.open("robot", robot="anthropomorphic", show="dimensions", q="0.3,0.6,-0.8")
    studio.button("DH table").click()
    studio.until("studio.store.value.table")
    studio.drawn()
    drag(studio, "DH a 2", 0.5, 1.0)
    found = studio.state("draft")["joints"][1]["a"]
    assert found == pytest.approx(0.75, abs=0.02), "half as long again"
    assert found == pytest.approx(round(found, 2), abs=0), "whole steps"
    assert studio.field("Row 2, a").input_value() == str(found)
    assert studio.run("studio.store.value.model.link('frame_2').matrixWorld.elements.slice(12, 15)") == pytest.approx(
        [found * math.cos(0.3) * math.cos(0.6), found * math.sin(0.3) * math.cos(0.6), found * math.sin(0.6)]
    ), "the arm follows, and the joints stay where they are"
    drag(studio, "DH alpha 1", 1.0, 0.5)
    assert studio.state("draft")["joints"][0]["alpha"] == pytest.approx(math.pi / 4), "half of it, in whole steps"
    drag(studio, "DH theta 2", 1.0, 0.5)
    assert studio.state("positions")["joint_2"] == pytest.approx(0.3, abs=0.02), "the variable is the joint's"
    assert studio.state("draft")["joints"][1]["theta"] == 0


def drag(studio: Studio, name: str, start: float, end: float) -> None:
    """Drag a piece by way of places between, each of which is waited for: it is a robot of its own."""
    mouse = studio.page.mouse
    at = [np.array(studio.run(ON_SCREEN, [name, share])) for share in (start, end)]
    camera = studio.run(CAMERA)
    mouse.move(*at[0])
    mouse.down()
    for share in (0.3, 0.7, 1.0):
        mouse.move(*at[0] + share * (at[1] - at[0]))
        studio.until("!studio.store.value.loading")
        assert studio.run(CAMERA) == pytest.approx(camera), "the camera does not move under the pointer"
    mouse.up()
    studio.drawn()


@pytest.mark.slow
def test_a_camera_that_has_been_chosen_stays_for_the_table_that_is_made_of_a_robot(studio: Studio) -> None:
    studio.open("robot", robot="anthropomorphic", show="dimensions", q="0.3,0.6,-0.8", camera="1.6,-2,1.4,0.1,0,0.3")
    studio.button("DH table").click()
    studio.until("studio.store.value.table")
    studio.drawn()
    chosen = studio.run(CAMERA)
    drag(studio, "DH a 2", 0.5, 1.0)
    assert studio.state("robot") == ""
    assert studio.state("camera") is not None
    assert studio.run(CAMERA) == pytest.approx(chosen)


@pytest.mark.slow
@pytest.mark.parametrize("robot", ["anthropomorphic", "panda", "scara"])
def test_a_dragged_link_moves_its_joint(another: Callable[..., Studio], robot: str) -> None:
    """What has been taken stays under the pointer, and only one joint moves."""
    studio = another(width=1024, height=768)
    studio.open("pose", robot=robot)
    studio.drawn()
    joint, start = studio.run(
        """() => {
          const {view, store: {value: {model}}} = studio;
          const {left, top, width, height} = view.canvas.getBoundingClientRect();
          for (const [leader, parts] of [...model.drawnBy()].reverse())
            for (const mesh of leader ? parts : []) {
              const at = mesh.position.clone().setFromMatrixPosition(mesh.matrixWorld).project(view.camera);
              const place = [left + (at.x + 1) / 2 * width, top + (1 - at.y) / 2 * height];
              if (!leader.includes("finger") && document.elementFromPoint(...place) === view.canvas)
                return [leader, place];
            }
        }"""
    )
    before = studio.state("positions")
    camera = studio.run("studio.view.camera.position.toArray()")
    mouse = studio.page.mouse
    mouse.move(*start)
    taken = studio.state("joint")
    assert taken is not None, joint
    mouse.down()
    mouse.move(start[0] + 40, start[1] - 30, steps=6)
    mouse.up()
    after = studio.state("positions")
    moved = {name for name in after if after[name] != before[name]}
    assert moved <= {taken}
    assert studio.run("studio.view.camera.position.toArray()") == camera, "the camera stays"
    own = next(j for j in studio.run("studio.store.value.model.joints") if j["name"] == taken)
    assert (own["lower"] or -9) <= after[taken] <= (own["upper"] or 9)


@pytest.mark.slow
def test_a_planar_arm_is_seen_in_its_plane(studio: Studio) -> None:
    sight = "studio.view.camera.getWorldDirection(studio.view.camera.position.clone()).toArray()"
    studio.open("pose", robot="planar_3r")
    assert studio.run(sight) == pytest.approx([0, 0, -1], abs=2e-3)
    studio.open("pose", robot="anthropomorphic")
    assert abs(studio.run(sight)[2]) < 0.6
    studio.button("Iso").click()
    assert np.abs(studio.run(sight)) == pytest.approx([3**-0.5] * 3, abs=1e-3)


@pytest.mark.slow
def test_a_parallel_projection_is_one(studio: Studio) -> None:
    """Lengths of equal size are equally long wherever they are; what is looked at stays as large; a link has it."""
    studio.open("pose", robot="scara")
    length = """([at, along]) => {
      const {view} = studio;
      const [one, other] = [0, 1].map((t) =>
        view.controls.target.clone().set(...at.map((x, i) => x + t * along[i])).project(view.camera));
      return Math.hypot((one.x - other.x) * view.canvas.clientWidth, (one.y - other.y) * view.canvas.clientHeight) / 2;
    }"""
    here = studio.run("studio.view.controls.target.toArray()")
    up = [0.0, 0.0, 0.01]
    eye = np.array(studio.run("studio.view.camera.position.toArray()"))
    behind = list(here + (here - eye) * 0.5)
    before = studio.run(length, [here, up])
    assert studio.run(length, [behind, up]) < 0.8 * before
    studio.button("Parallel").click()
    studio.drawn()
    assert studio.run(length, [here, up]) == pytest.approx(before, rel=0.01)
    assert studio.run(length, [behind, up]) == pytest.approx(studio.run(length, [here, up]), rel=1e-9)
    x, y = 300, 300
    studio.page.mouse.move(x, y)
    studio.page.mouse.wheel(0, -200)
    studio.until(f"studio.view.camera.position.distanceTo(studio.view.controls.target) < {0.99 * math.dist(eye, here)}")
    assert studio.run(length, [here, up]) > 1.02 * before
    studio.until("location.hash.includes('parallel') && location.hash.includes('camera=')")
    closer = studio.run(length, [here, up])
    studio.page.reload()
    studio.wait_for_robot("scara")
    studio.drawn()
    assert studio.run("studio.view.camera.isOrthographicCamera")
    assert studio.run(length, [here, up]) == pytest.approx(closer, rel=1e-3)
    assert studio.button("Parallel").get_attribute("aria-pressed") == "true"


@pytest.mark.slow
def test_nothing_of_a_drawing_stays(studio: Studio) -> None:
    """Robots that come and go, and angles that change, leave nothing on the graphics card, nor labels."""
    studio.open("pose", robot="anthropomorphic", show="dh,dimensions")

    def visit() -> list[int]:
        for name in ("scara", "planar_2r", "anthropomorphic"):
            studio.run("(robot) => studio.store.set({robot})", name)
            studio.wait_for_robot(name)
            count = len(catalogue.dh_table(name)["joints"]) + 1
            studio.until(f"studio.view.scene.getObjectByName('DH frame {count - 1}')")
            for angle in (0.1, 0.5, 0.9):
                studio.run("(q) => studio.store.set({positions: {...studio.store.value.positions, joint_1: q}})", angle)
                studio.drawn()
        found: list[int] = studio.run(COUNTS)
        return found

    first = visit()
    for _ in range(2):
        assert visit() == first


@pytest.mark.slow
def test_a_second_finger_neither_moves_nor_lets_go_what_the_first_one_holds(studio: Studio) -> None:
    studio.open("pose", robot="planar_2r", q="0.3,0.6", show="dh,dimensions")
    studio.drawn()
    x, y = studio.run(ON_SCREEN, ["DH theta 2", 0.5])
    touch = """([kind, pointerId, x, y]) => {
      const {canvas} = studio.view;
      canvas.setPointerCapture = () => {}; // of a pointer that no hand moves
      const {left, top} = canvas.getBoundingClientRect();
      canvas.dispatchEvent(new PointerEvent(kind, {
        pointerId, isPrimary: pointerId === 7, pointerType: "touch", button: 0, buttons: 1, bubbles: true,
        clientX: x, clientY: y,
      }));
      return studio.store.value.positions.joint_2;
    }"""

    def say(kind: str, pointer: int, by: float) -> float:
        angle: float = studio.run(touch, [kind, pointer, x + by, y - by])
        return angle

    camera = studio.run("studio.view.camera.position.toArray()")
    say("pointerdown", 7, 0)
    held = say("pointermove", 7, 20)
    assert held != 0.6
    say("pointerdown", 8, 60)
    assert say("pointermove", 8, 90) == held
    say("pointerup", 8, 90)
    moved = say("pointermove", 7, 40)
    assert moved != held
    say("pointerup", 7, 40)
    assert studio.run("studio.view.camera.position.toArray()") == camera


@pytest.mark.slow
def test_a_draft_that_waits_does_not_replace_a_robot_that_is_chosen_meanwhile(studio: Studio) -> None:
    studio.open("pose", robot="planar_2r", q="0.3,0.6", show="dh,dimensions")
    studio.drawn()
    x, y = studio.run(ON_SCREEN, ["DH a 2", 0.5])
    studio.page.mouse.move(x, y)
    studio.page.mouse.down()
    studio.run("studio.store.set({loading: true})")
    end = studio.run(ON_SCREEN, ["DH a 1", 0.5])
    studio.page.mouse.move(*end)
    studio.page.mouse.up()
    studio.run("studio.store.set({robot: 'scara'})")
    studio.wait_for_robot("scara")
    assert studio.state("draft") is None
    assert studio.state("robot") == "scara"
