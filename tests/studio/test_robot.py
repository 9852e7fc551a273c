"""The Robot panel: the catalogue, a file from outside, and a table that is typed."""

import io
import json
import math
import re
import zipfile
from collections.abc import Callable
from typing import Any

import numpy as np
import pytest
from playwright.sync_api import expect

from tests.corpus.zips import zipped
from tests.oracles import catalogue
from tests.studio.browser import Studio
from tests.studio.tables import ANTHROPOMORPHIC, keep, open_editor, type_table
from tests.test_serve import get

URDF = """<robot name="two links">
  <link name="foot"><visual><geometry><mesh filename="meshes/foot.stl"/></geometry></visual></link>
  <link name="hand"/>
  <joint name="turn" type="revolute"><parent link="foot"/><child link="hand"/>
    <origin xyz="0 0 0.4"/><axis xyz="0 1 0"/><limit lower="-2" upper="2" velocity="1" effort="1"/></joint>
</robot>
"""
STL = b"solid\nfacet normal 0 0 1\nouter loop\nvertex 0 0 0\nvertex 1 0 0\nvertex 0 1 0\nendloop\nendfacet\nendsolid\n"

PLACES = """(link) => studio.store.value.model.link(link).children
    .filter(({type}) => type === "Mesh").map(({position}) => position.toArray())"""
DROP = """([name, bytes]) => {
  const transfer = new DataTransfer();
  transfer.items.add(new File([new Uint8Array(bytes)], name));
  for (const kind of ["dragover", "drop"]) {
    document.body.dispatchEvent(new DragEvent(kind, {dataTransfer: transfer, bubbles: true, cancelable: true}));
  }
}"""


def archive() -> bytes:
    content = io.BytesIO()
    with zipfile.ZipFile(content, "w") as made:
        made.writestr("arm/robot.urdf", URDF)
        made.writestr("arm/meshes/foot.stl", STL)
    return content.getvalue()


def download(studio: Studio, button: str) -> str:
    with studio.page.expect_download() as event:
        studio.button(button).click()
    return event.value.path().read_text()


@pytest.mark.slow
def test_a_robot_is_found_and_picked(studio: Studio) -> None:
    studio.open("robot")
    robots = studio.page.locator("button.robot")
    robots.first.wait_for()
    assert {entry.get_attribute("data-robot") for entry in robots.all()} >= set(catalogue.NAMES)
    studio.page.get_by_role("searchbox").fill("universal ur10 limit")
    assert [entry.get_attribute("data-robot") for entry in robots.all()] == ["ur10_joint_limited"]
    robots.first.click()
    studio.wait_for_robot("ur10_joint_limited")
    assert studio.page.get_by_role("heading", level=1).text_content() == "ur10_joint_limited"
    assert robots.first.get_attribute("aria-current") == "true"


@pytest.mark.slow
@pytest.mark.parametrize("panel", ["robot", "trajectory"])
def test_an_unknown_robot_says_what_to_do(studio: Studio, refusals: set[int], panel: str) -> None:
    refusals.add(404)
    studio.go(f"#robot=pandaa&panel={panel}")
    problem = studio.page.locator(".problem:visible")
    problem.wait_for()
    assert "pandaa" in (problem.text_content() or "")
    assert "Similar names: panda" in (problem.text_content() or "")
    studio.page.locator("button.robot[data-robot=panda]").click()
    studio.wait_for_robot("panda")
    assert studio.page.locator(".problem:visible").count() == 0


@pytest.mark.slow
@pytest.mark.parametrize("name", ["panda", "anthropomorphic"])
def test_a_robot_is_downloaded_as_urdf_and_as_dh(studio: Studio, name: str) -> None:
    studio.open("robot", robot=name)
    assert download(studio, "Download URDF") == studio.page.request.get(f"{studio.url}/v1/robots/{name}/urdf").text()
    table = json.loads(download(studio, "Download DH"))
    chain = {"robot": name, "dh": table}
    status, answer = get(f"{studio.url}/v1/dh/compare", "POST", chain)
    assert (status, answer["equivalent"]) == (200, True)


@pytest.mark.slow
def test_a_zip_dropped_on_the_page_becomes_a_robot(studio: Studio) -> None:
    studio.open("pose")
    studio.run(DROP, ["my arm.zip", list(archive())])
    studio.wait_for_robot("my_arm")
    assert studio.run("studio.store.value.model.meshes") == {"wanted": 1, "shown": 1, "failed": []}
    assert studio.run("studio.view.countMeshes()") == 2  # the hand has none: it is drawn as the body of its joint
    assert get(f"{studio.url}/v1/robots/my_arm")[1]["source"] == "uploaded"
    for answer, is_left in (("Cancel", True), ("Remove it", False)):
        studio.button("Remove").click()
        dialog = studio.page.get_by_role("dialog", name="Remove my_arm?")
        dialog.get_by_role("button", name=answer, exact=True).click()
        expect(dialog).to_have_count(0)
        studio.wait_for_robot("my_arm" if is_left else "panda")
    assert get(f"{studio.url}/v1/robots/my_arm")[0] == 404


XACRO = """<robot name="$(arg side)_arm" xmlns:xacro="http://www.ros.org/wiki/xacro">
  <!-- <xacro:arg name="old" default="0"/> -->
  <xacro:arg name="side" default="left"/>
  <xacro:arg name="reach" default="0.4"/>
  <xacro:arg name="load"/>
  <link name="foot"/><link name="hand"/>
  <joint name="turn" type="revolute"><parent link="foot"/><child link="hand"/>
    <origin xyz="0 0 $(arg reach)"/><axis xyz="0 1 0"/>
    <limit lower="-2" upper="2" velocity="1" effort="$(arg load)"/></joint>
</robot>
"""


@pytest.mark.slow
def test_arguments_of_a_xacro_are_fields(studio: Studio, refusals: set[int]) -> None:
    refusals.add(422)
    studio.open("robot")
    studio.run(DROP, ["arm.urdf.xacro", list(XACRO.encode())])
    labels = studio.page.locator(".arguments label")
    expect(labels).to_have_text(["side", "reach", "load"])
    presets = {"side": "left", "reach": "0.4", "load": ""}
    for name, preset in presets.items():
        expect(studio.field(name)).to_have_value(preset)
    add = studio.page.get_by_role("button", name="Add", exact=True)
    studio.page.locator("#robot-name").fill("by_xacro")
    add.click()  # `load` has no value
    load = studio.field("load")
    expect(load).to_have_attribute("aria-invalid", "true")
    expect(load).to_have_accessible_description(re.compile("the argument 'load' has no value"))
    expect(studio.field("side")).to_have_attribute("aria-invalid", "false")
    load.fill("7")
    studio.field("reach").fill("9" * 1001)
    add.click()
    expect(studio.field("reach")).to_have_attribute("aria-invalid", "true")
    expect(load).to_have_attribute("aria-invalid", "false")
    studio.field("reach").fill("0.9")
    add.click()
    studio.wait_for_robot("by_xacro")
    urdf = studio.page.request.get(f"{studio.url}/v1/robots/by_xacro/urdf").text()
    assert 'name="left_arm"' in urdf
    assert "0 0 0.9" in urdf
    assert 'effort="7"' in urdf
    expect(labels).to_have_count(0)


SIZES = """<robot xmlns:xacro="http://www.ros.org/wiki/xacro">
  <xacro:arg name="reach" default="0.5"/>
  <xacro:arg name="load" default="3"/>
</robot>
"""


def packed(**robots: str) -> dict[str, str | bytes]:
    """Return the files of a package whose xacros include one that declares arguments too."""
    line = '<xacro:include filename="$(find arm)/urdf/sizes.xacro"/>\n  <link name="foot"/>'
    files = {f"arm/urdf/{name}.urdf.xacro": text.replace('<link name="foot"/>', line) for name, text in robots.items()}
    return {"arm/package.xml": "<package><name>arm</name></package>", "arm/urdf/sizes.xacro": SIZES, **files}


@pytest.mark.slow
def test_arguments_of_the_xacro_in_a_zip_are_fields(studio: Studio, refusals: set[int]) -> None:
    """Also those of a file that it includes."""
    refusals.add(422)
    studio.open("robot")
    name = "packed"
    studio.run(DROP, ["packed.zip", list(zipped(packed(arm=XACRO.replace('<xacro:arg name="load"/>', ""))))])
    expect(studio.page.locator(".arguments label")).to_have_text(["side", "reach", "load"])
    for field, preset in {"side": "left", "reach": "0.4", "load": "3"}.items():
        expect(studio.field(field)).to_have_value(preset)
    add = studio.page.get_by_role("button", name="Add", exact=True)
    studio.field("reach").fill("x")
    add.click()
    expect(studio.page.locator(".problem:visible").first).to_contain_text("x")
    studio.field("reach").fill("0.9")
    studio.field("load").fill("8")
    add.click()
    studio.wait_for_robot(name)
    urdf = studio.page.request.get(f"{studio.url}/v1/robots/{name}/urdf").text()
    assert 'name="left_arm"' in urdf
    assert "0 0 0.9" in urdf
    assert 'effort="8"' in urdf


@pytest.mark.slow
def test_of_several_xacros_in_a_zip_the_chosen_one_has_its_fields(studio: Studio, refusals: set[int]) -> None:
    refusals.add(422)
    studio.open("robot")
    other = XACRO.replace("side", "colour").replace("left", "red")
    studio.run(DROP, ["two.zip", list(zipped(packed(plain=URDF, one=XACRO, two=other)))])
    which = studio.field("Description in the zip")
    expect(which.locator("option")).to_have_count(4)
    labels = studio.page.locator(".arguments label")
    which.select_option("arm/urdf/one.urdf.xacro")
    expect(labels).to_have_text(["side", "reach", "load"])
    which.select_option("arm/urdf/two.urdf.xacro")
    expect(labels).to_have_text(["colour", "reach", "load"])
    studio.field("colour").fill("blue")
    studio.field("load").fill("5")
    studio.page.get_by_role("button", name="Add", exact=True).click()
    studio.wait_for_robot("two")
    urdf = studio.page.request.get(f"{studio.url}/v1/robots/two/urdf").text()
    assert 'name="blue_arm"' in urdf
    assert 'effort="5"' in urdf
    expect(which).to_be_hidden()
    expect(labels).to_have_count(0)


@pytest.mark.slow
def test_of_a_workspace_one_description_is_chosen(studio: Studio, refusals: set[int]) -> None:
    refusals.add(422)
    studio.open("robot")
    files: dict[str, str | bytes] = {
        "ws/src/arm_description/urdf/left.urdf": URDF.replace("0.4", "0.7"),
        "ws/src/arm_description/urdf/right.urdf": URDF,
    }
    studio.run(DROP, ["ws.zip", list(zipped(files))])
    which = studio.field("Description in the zip")
    expect(which.locator("option")).to_have_text(["Choose one of 2", *files])
    which.select_option("ws/src/arm_description/urdf/left.urdf")
    studio.wait_for_robot("ws")
    assert "0 0 0.7" in studio.page.request.get(f"{studio.url}/v1/robots/ws/urdf").text()
    expect(which).to_be_hidden()


@pytest.mark.slow
def test_a_name_of_the_catalogue_is_followed_by_a_free_one(studio: Studio, refusals: set[int]) -> None:
    """What is wrong with the file comes first; a robot of the catalogue is not offered to be replaced."""
    refusals.update({409, 422})
    studio.open("robot", robot="planar_2r")
    studio.button("Upload").click()
    mine = URDF.replace('name="two links"', 'name="panda"')
    problem = studio.page.locator(".problem:visible")
    choose(studio, mine.replace("revolute", "revolut"))
    expect(problem).to_contain_text("revolut")
    choose(studio, mine)
    expect(problem).to_contain_text("catalogue")
    expect(problem).not_to_contain_text("PUT")
    expect(studio.field("Name")).to_have_value("panda_2")
    expect(studio.page.get_by_role("button", name="Replace")).to_have_count(0)
    studio.button("Add").click()
    studio.wait_for_robot("panda_2")


@pytest.mark.slow
def test_a_urdf_is_chosen_renamed_and_replaced(studio: Studio, refusals: set[int]) -> None:
    refusals.add(409)
    studio.open("robot")
    studio.button("Upload").click()
    choose(studio, URDF.replace("0.4", "0.7"))
    studio.wait_for_robot("two_links")
    studio.button("Upload").click()
    choose(studio, URDF)
    exchange = studio.button("Replace two_links")
    exchange.wait_for()
    exchange.click()
    studio.until("studio.store.value.model.urdf.includes('0 0 0.4')")
    assert "0 0 0.4" in studio.page.request.get(f"{studio.url}/v1/robots/two_links/urdf").text()


def choose(studio: Studio, urdf: str) -> None:
    file: Any = {"name": "arm.urdf", "mimeType": "text/xml", "buffer": urdf.encode()}
    studio.field("File").set_input_files(file)


@pytest.mark.slow
def test_a_malformed_urdf_shows_its_error(studio: Studio, refusals: set[int]) -> None:
    refusals.add(422)
    studio.open("robot", robot="planar_2r")
    studio.button("Upload").click()
    problem = studio.page.locator(".problem:visible")
    for urdf, reason in (
        (URDF.replace("revolute", "revolut"), "revolut"),
        (URDF.replace('<child link="hand"/>', '<child link="nothing"/>'), "nothing"),
        (URDF.replace("</robot>", ""), "line"),
        ("<html></html>", "robot"),
    ):
        choose(studio, urdf)  # what was said before goes with it
        problem.wait_for()
        assert reason in (problem.text_content() or "")
        assert studio.state("robot") == "planar_2r"
        assert studio.page.get_by_role("heading", level=1).text_content() == "planar_2r"


@pytest.mark.slow
def test_a_typed_table_is_on_the_screen_with_its_frames(studio: Studio) -> None:
    type_table(studio, ANTHROPOMORPHIC)
    studio.until("document.querySelectorAll('.label.z').length === 4")
    studio.drawn()
    shown = studio.page.locator(".label:visible")
    texts = set(" ".join(shown.all_text_contents()).split())
    assert {"x₀", "z₀", "x₃", "z₃", "a₂", "a₃"} <= texts
    assert not {"a₁", "d₁", "d₂"} & texts  # they are zero
    assert studio.run("studio.view.countMeshes()") > 0


@pytest.mark.slow
def test_the_other_convention_is_the_same_arm(studio: Studio) -> None:
    type_table(studio, ANTHROPOMORPHIC)
    studio.page.get_by_role("tab", name="Pose").click()
    for name, value in {"joint_1": "0.3", "joint_2": "-0.8", "joint_3": "1.1"}.items():
        studio.type(f"{name}, number", value)
    before = np.array(studio.tip())
    studio.page.get_by_role("tab", name="Robot").click()
    studio.button("Modified").click()
    studio.until("studio.store.value.draft?.convention === 'modified' && !studio.store.value.loading")
    assert studio.field("Row 2, α").input_value() == "π/2"
    studio.page.get_by_role("tab", name="Pose").click()
    assert np.abs(np.array(studio.tip()) - before).max() < 1e-12


@pytest.mark.slow
def test_rows_are_added_and_removed(studio: Studio) -> None:
    type_table(studio, ANTHROPOMORPHIC)
    studio.button("Remove row 2").click()
    studio.until("studio.store.value.model.joints.length === 2")
    studio.button("Add a row").click()
    studio.until("studio.store.value.model.joints.length === 3")
    names = [row["name"] for row in studio.state("draft")["joints"]]
    assert len(set(names)) == 3
    studio.field("Row 3, type").select_option("P")
    studio.until("studio.store.value.model.joints[2].type === 'prismatic'")


@pytest.mark.slow
def test_a_wrong_cell_shows_its_error(studio: Studio, refusals: set[int]) -> None:
    type_table(studio, ANTHROPOMORPHIC)
    studio.type("Row 2, upper limit", "3")
    studio.until("!studio.store.value.loading")
    error = studio.page.locator("tr.cell-error:visible")
    wrong = [("a", "abc", "Write a number"), ("α", "pi/x", "Write a number"), ("d", "1e9", "d:")]
    for cell, text, reason in [*wrong, ("lower limit", "4", "upper")]:
        studio.type(f"Row 2, {cell}", text)
        error.wait_for()
        assert reason in (error.text_content() or "")
        assert studio.field(f"Row 2, {cell}").get_attribute("aria-invalid") == "true"
        assert studio.page.locator("[aria-invalid=true]").count() == 1
        assert set(studio.refused) == (set() if "Write" in reason else {422}), "the page says it, or the service"
        studio.type(f"Row 2, {cell}", "0.2")
        error.wait_for(state="hidden")
        studio.until("!studio.store.value.loading && !studio.store.value.failure")
    refusals.add(422)


@pytest.mark.slow
def test_ninety_radians_ask_whether_degrees_are_meant(studio: Studio) -> None:
    """At the cell, taken with one click; not where the unit is typed too, nor of an angular velocity."""
    type_table(studio, ANTHROPOMORPHIC)
    question = studio.page.locator("tr.cell-question:visible")
    studio.type("Row 1, α", "90")
    assert "α = 90 rad is 14.3 turns" in question.inner_text()
    studio.type("Row 1, lower limit", "-170")
    studio.type("Row 1, upper limit", "170 deg")
    assert question.get_by_role("button").count() == 2
    studio.button("Take α as 90°").click()
    studio.button("Take lower limit as −170°").click()
    assert question.count() == 0
    studio.until("!studio.store.value.loading && !studio.store.value.failure")
    row = studio.state("draft")["joints"][0]
    assert row["alpha"] == math.pi / 2
    assert (row["lower"], row["upper"]) == pytest.approx((math.radians(-170), math.radians(170)))
    assert studio.field("Row 1, α").input_value() == "π/2"
    assert studio.run("document.activeElement.getAttribute('aria-label')") == "Row 1, lower limit"
    studio.type("Row 1, α", "90 rad")
    assert question.count() == 0
    studio.type("Row 1, α", "0.5")
    studio.button("Names, velocity, effort").click()
    studio.type("Row 1, velocity limit", "10")
    assert question.count() == 0
    # An effort is no length.
    studio.type("Row 1, effort limit", "5 m")
    assert studio.field("Row 1, effort limit").get_attribute("aria-invalid") == "true"
    studio.type("Row 1, effort limit", "5")
    studio.until("studio.store.value.draft.joints[0].effort === 5")


@pytest.mark.slow
def test_the_catalogue_is_current_when_somebody_comes_back(another: Callable[..., Studio]) -> None:
    """Another page has added and removed a robot meanwhile; the place in the list and the focus stay."""
    studio = another()
    studio.open("robot", robot="panda")
    listed = "[...document.querySelectorAll('.robot')].map((made) => made.dataset.robot)"
    studio.until(f"{listed}.length > 70")
    studio.page.locator("[data-robot=scara]").focus()
    place = studio.run("document.querySelector('.robots').scrollTop")
    dh = {"convention": "standard", "joints": [{"type": "revolute", "a": 0.5, "alpha": 0, "d": 0, "theta": 0}]}
    assert get(f"{studio.url}/v1/robots", "POST", {"name": "meanwhile", "dh": dh})[0] == 201
    try:
        assert "meanwhile" not in studio.run(listed)
        studio.run("document.dispatchEvent(new Event('visibilitychange'))")
        studio.until(f"{listed}.includes('meanwhile')")
        assert studio.run("document.activeElement.dataset.robot") == "scara"
        assert studio.run("document.querySelector('.robots').scrollTop") == place
    finally:
        assert get(f"{studio.url}/v1/robots/meanwhile", "DELETE")[0] == 204
    studio.run("window.dispatchEvent(new Event('focus'))")
    studio.until(f"!{listed}.includes('meanwhile')")


@pytest.mark.slow
def test_base_tool_names_and_limits_are_typed(studio: Studio) -> None:
    type_table(studio, ANTHROPOMORPHIC)
    studio.page.get_by_role("tab", name="Pose").click()
    studio.type("joint_2, number", "0.7")
    studio.page.get_by_role("tab", name="Robot").click()
    studio.button("Names, velocity, effort").click()
    for label, text in {"name": "shoulder", "velocity limit": "2.5", "effort limit": "40"}.items():
        studio.type(f"Row 2, {label}", text)
    studio.page.get_by_text("Base and tool").click()
    studio.type("Base, z", "0.3")
    studio.type("Tool, x", "0.1")
    studio.page.get_by_role("group", name="Orientation of the tool").get_by_text("Euler ZYZ").click()
    studio.type("Tool, ϑ", "pi/2")
    studio.until("studio.store.value.model.joints[1].name === 'shoulder' && !studio.store.value.loading")
    assert studio.state("positions")["shoulder"] == 0.7, "a joint moves when it gets another name"
    keep(studio, "with_tool")
    table = get(f"{studio.url}/v1/robots/with_tool")[1]["dh"]
    assert table["base"] == {"matrix": [[1, 0, 0, 0], [0, 1, 0, 0], [0, 0, 1, 0.3], [0, 0, 0, 1]]}
    assert [table["joints"][1][key] for key in ("name", "velocity", "effort")] == ["shoulder", 2.5, 40.0]
    studio.page.get_by_role("tab", name="Pose").click()
    q1, q2, q3 = (studio.state("positions")[name] for name in ("joint_1", "shoulder", "joint_3"))
    assert (q1, q2, q3) == (0.0, 0.7, 0.0)
    out, up = 0.5 * np.cos(q2) + 0.5 * np.cos(q2 + q3), 0.5 * np.sin(q2) + 0.5 * np.sin(q2 + q3)
    tip = np.array(studio.tip())
    assert tip[:3, 3] == pytest.approx([out, 0.0, 0.3 + up], abs=1e-12)
    assert tip[:3, 2] == pytest.approx([np.cos(q2), 0.0, np.sin(q2)], abs=1e-12), "z of the tool along x of frame 3"


@pytest.mark.slow
def test_wrong_names_limits_and_places_show_their_error(studio: Studio, refusals: set[int]) -> None:
    refusals.add(422)
    type_table(studio, ANTHROPOMORPHIC)
    studio.button("Names, velocity, effort").click()
    studio.page.get_by_text("Base and tool").click()
    wrong = {
        "Row 2, name": ("joint_1", "name: 'joint_1' is used twice", "joint_2"),
        "Row 1, velocity limit": ("-2", "velocity limit: ", ""),
        "Tool, x": ("1e9", "Tool, x: ", "0"),
        "Base, pitch": ("up", "Base, pitch: Write a number", "0"),
    }
    alert = studio.page.locator("[role=alert]:visible")
    for label, (text, reason, right) in wrong.items():
        studio.type(label, text)
        alert.wait_for()
        assert reason in (alert.text_content() or "")
        assert studio.field(label).get_attribute("aria-invalid") == "true"
        studio.type(label, right)
        alert.wait_for(state="hidden")
        studio.until("!studio.store.value.loading && !studio.store.value.failure")
    assert studio.state("draft").keys() == {"convention", "joints"}, "nothing is left of the places"


@pytest.mark.slow
def test_a_name_that_is_taken(studio: Studio, refusals: set[int]) -> None:
    refusals.add(409)
    type_table(studio, ANTHROPOMORPHIC[1:])
    keep(studio, "taken")
    studio.type("Row 1, a", "0.9")
    studio.wait_for_robot(None)
    studio.field("Name at the service").fill("taken")
    studio.button("Add to the robots").click()
    studio.button("Replace taken").click()
    studio.until("studio.store.value.model.name === 'taken' && !studio.store.value.loading")
    assert get(f"{studio.url}/v1/robots/taken/fk", "POST", {"joint_positions": [[0.0, 0.0]]})[1]["poses"][0][
        "position"
    ][0] == pytest.approx(1.3)


@pytest.mark.slow
def test_the_table_of_a_robot_that_is_kept_stands_in_the_editor(studio: Studio) -> None:
    studio.open("robot", robot="anthropomorphic")
    studio.button("DH table").click()
    studio.until("studio.store.value.table && document.querySelector('.product .katex')")
    assert studio.page.locator("table.dh tbody tr:has(> th)").count() == 3
    assert studio.button("Standard").get_attribute("aria-pressed") == "true"
    studio.page.get_by_text("Base and tool").click()
    assert studio.field("Base, x").input_value() == "0"


@pytest.mark.slow
def test_a_table_of_the_course_is_started_from(studio: Studio) -> None:
    open_editor(studio)
    tables = [catalogue.dh_table(name)["joints"] for name in catalogue.TABLES]
    presets = studio.field("Start from a table of the course")
    titles = presets.locator("option").all_text_contents()[2:]
    found = []
    for preset in range(len(titles)):
        presets.select_option(str(preset))
        studio.until("studio.store.value.draft.joints.length > 1 && !studio.store.value.loading")
        assert studio.state("failure") is None
        rows = studio.state("draft")["joints"]
        found.append(tables.index(rows))
        assert studio.page.locator("table.dh tbody tr:has(> th)").count() == len(rows)
    assert len(set(found)) == len(titles) == 9


@pytest.mark.slow
@pytest.mark.parametrize("name", ["panda", "ur5"])
def test_a_robot_without_meshes_is_drawn_as_its_joints(studio: Studio, name: str) -> None:
    """In the place of each shape that the service offers one is drawn there, and moves with its link."""
    urdf = catalogue.urdf_text(name)
    assert get(f"{studio.url}/v1/robots", "POST", {"name": f"bare_{name}", "urdf": urdf})[0] == 201
    studio.open("robot", robot=f"bare_{name}")
    skeleton = get(f"{studio.url}/v1/robots/bare_{name}")[1]["skeleton"]
    assert studio.run("studio.view.countMeshes()") == len(skeleton) > 8
    for one in skeleton:
        assert any(np.allclose(place, one["pose"]["position"]) for place in studio.run(PLACES, one["link"])), one
    assert download(studio, "Download URDF") == urdf
