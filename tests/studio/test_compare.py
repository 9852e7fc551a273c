"""A second robot or table beside the one on the screen: joints that are linked, and what is different."""

import json
import math
from collections.abc import Callable
from typing import Any

import numpy as np
import pytest
from playwright.sync_api import expect

from tests.studio.browser import Studio
from tests.studio.pure import values
from tests.studio.test_page import CUT_OFF, axe

LENGTHS = (0.5, 0.4, 0.3)
"""Of the catalogue's planar_3r."""
TWO = (1.0, 0.7)
"""Of its planar_2r."""
HERE = {"position": [0, 0, 0], "rpy": [0, 0, 0]}
MEASURED = ".agreement[data-position]"
SECOND = """(() => {
  const marks = studio.view.scene.getObjectByName("comparison");
  return marks ? marks.children.length : 0;
})()"""
ROBOTS = """studio.view.scene.children.filter((child) => child.isURDFRobot)
  .map((robot) => ({visible: robot.visible, at: robot.position.toArray(),
    tip: [12, 13, 14].map((i) => (robot.links.tool ?? robot.links.panda_hand_tcp).matrixWorld.elements[i])}))"""


def planar(*lengths: float, theta: float = 0.0, **more: Any) -> dict[str, Any]:
    """A table of a planar arm; `theta` is where its first joint has its zero."""
    rows = [
        {"name": f"joint_{i + 1}", "type": "revolute", "a": a, "alpha": 0.0, "d": 0.0, "theta": theta * (i == 0)}
        for i, a in enumerate(lengths)
    ]
    return {"convention": "standard", "joints": rows, **more}


def tip(lengths: tuple[float, ...], q: list[float]) -> Any:
    """Where the tip of a planar arm is."""
    angles = np.cumsum(q)
    return np.array([np.dot(lengths, np.cos(angles)), np.dot(lengths, np.sin(angles))])


def measured(studio: Studio) -> tuple[float, float]:
    """How far the tips are apart, to the last digit."""
    shown = studio.page.locator(MEASURED)
    return float(shown.get_attribute("data-position") or "nan"), float(shown.get_attribute("data-angle") or "nan")


def compared(studio: Studio, robot: str, **options: str) -> None:
    """Open a comparison, and wait for both and the verdict."""
    studio.open("compare", robot=robot, **options)
    studio.until("document.querySelectorAll('.compare [data-tone]').length === 2")


def says(studio: Studio, text: str) -> None:
    """Wait until the panel says this of the two."""
    expect(studio.page.locator("#panel")).to_contain_text(text)


def options(**chosen: Any) -> dict[str, str]:
    """As they stand in a link."""
    return {f"compare.{name}": each if isinstance(each, str) else json.dumps(each) for name, each in chosen.items()}


def test_base_and_tool_that_are_found_take_the_place_of_given_ones() -> None:
    """Against products of matrices; where nothing agrees they count only if somebody looks for them."""

    def placed(x: float, angle: float) -> Any:
        c, s = math.cos(angle), math.sin(angle)
        return np.array([[c, -s, 0, x], [s, c, 0, 0], [0, 0, 1, 0], [0, 0, 0, 1]])

    given, found, tool = placed(0.1, 0.4), placed(0.7, -0.3), placed(0.2, 1.1)
    dh = {"base": {"matrix": given.tolist()}}
    answer = {"found": ["base", "tool"], "base": {"matrix": found.tolist()}, "tool": {"matrix": tool.tolist()}}
    calls = [
        (equivalent, swapped, asked)
        for equivalent in (True, False)
        for swapped in (True, False)
        for asked in (True, False)
    ]
    tables = json.dumps({"first": {"dh": dh}, "second": {"dh": dh}})
    made = values(
        "panels/compare/pairs.ts",
        [
            f"m.alignment({tables}, {{answer: {{...{json.dumps(answer)}, equivalent: {json.dumps(equivalent)}}}, "
            f"isSwapped: {json.dumps(swapped)}}}, {json.dumps(asked)})"
            for equivalent, swapped, asked in calls
        ],
    )
    for (equivalent, swapped, asked), alignment in zip(calls, made, strict=True):
        base, last = (found @ np.linalg.inv(given), tool) if equivalent or asked else (np.eye(4), np.eye(4))
        if swapped:
            base, last = np.linalg.inv(base), np.linalg.inv(last)
        for name, wanted in (("base", base), ("tool", last)):
            matrix = np.array(alignment[name]["elements"]).reshape(4, 4).T
            np.testing.assert_allclose(matrix, wanted, atol=1e-12)


def test_options_that_are_no_comparison_are_left_out() -> None:
    made = values(
        "panels/compare/wanted.ts",
        [
            "m.wanted({options: {}})",
            """m.wanted({options: {"compare.with": "nonsense", "compare.q": "1,x", "compare.table": "{"}})""",
            """m.wanted({options: {"compare.with": "table", "compare.q": "1,2",
                "compare.table": '{"joints": [1]}'}})""",
        ],
    )
    usual = {"with": "convention", "robot": "", "table": None, "placing": "beside", "link": "linked", "find": "given"}
    assert made == [{**usual, "q": None}, {**usual, "q": None}, {**usual, "with": "table", "q": [1, 2]}]


@pytest.mark.slow
def test_the_other_convention_meets_at_the_tip_and_moves_with_it(studio: Studio) -> None:
    compared(studio, "anthropomorphic", q="0.3,0.6,-0.9")
    says(studio, "The tips meet here.")
    says(studio, "The same arm")
    lines = studio.page.locator(".pairs tbody tr")
    expect(lines).to_have_count(5)
    expect(lines.nth(1)).to_contain_text("first to differ")
    studio.type("joint_2, number", "-0.4")
    says(studio, "The tips meet here.")
    assert max(measured(studio)) < 1e-9
    first, second = studio.run(ROBOTS)
    shift = np.array(second["tip"]) - first["tip"]
    assert np.linalg.norm(shift) > 0.5, "beside each other"
    assert shift == pytest.approx(np.array(second["at"]) - first["at"], abs=1e-9)
    told = studio.fk("anthropomorphic", {"joint_positions": [[0.3, -0.4, -0.9]]})["poses"][0]["position"]
    assert np.array(second["tip"]) - shift == pytest.approx(told, abs=1e-9)


@pytest.mark.slow
def test_a_wrong_number_is_named_and_shown_where_it_is(studio: Studio) -> None:
    q = [0.5, 0.6, 0.4]
    lengths = (0.5, 0.45, 0.3)
    compared(studio, "planar_3r", q=",".join(map(str, q)), **options(**{"with": "table"}, table=planar(*lengths)))
    says(studio, "Another arm")
    says(studio, "First difference: a₂ (joint_2) is 0.45 m, 0.4 m is needed.")
    apart = tip(lengths, q) - tip(LENGTHS, q)
    assert measured(studio) == pytest.approx((np.linalg.norm(apart), 0.0), abs=1e-9)
    expect(studio.page.locator(".label.apart", has_text="a₂: 0.45 m ≠ 0.4 m")).to_be_visible()
    line = """studio.view.scene.getObjectByName("first difference").scale.y"""
    assert studio.run(line) == pytest.approx(0.45, abs=1e-9)
    lengths_of_lines = """studio.view.scene.getObjectByName("comparison").children
        .filter(({name, visible}) => name === "frames apart" && visible).map(({scale}) => scale.y)"""
    assert studio.run(lengths_of_lines) == pytest.approx([np.linalg.norm(apart)] * 3, abs=1e-9)
    studio.button("mm").first.click()
    says(studio, "is 450 mm, 400 mm is needed")
    studio.type("Row 2, a", "400")
    says(studio, "The same arm")
    assert studio.run("studio.view.scene.getObjectByName('first difference').visible") is False


@pytest.mark.slow
def test_the_link_the_frame_and_undo_have_the_comparison(another: Callable[..., Studio]) -> None:
    studio = another(width=1440, height=900)
    compared(studio, "planar_3r", q="0.5,0.6,0.4")
    studio.button("Another robot").click()
    studio.field("Robot").select_option("planar_2r")
    remark = "The first 2 joints are linked: the robot has 3, the second 2."
    says(studio, remark)
    studio.button("One over the other").click()
    studio.until("location.hash.includes('compare.placing=over') && location.hash.includes('compare.robot=planar_2r')")
    studio.page.reload()
    studio.wait_for_robot("planar_3r")
    says(studio, remark)
    expect(studio.field("Robot")).to_have_value("planar_2r")
    studio.until("studio.view.scene.children.filter((child) => child.isURDFRobot && !child.visible).length === 1")
    fragment = studio.run("location.hash")
    studio.page.keyboard.press("Control+z")
    studio.until("studio.view.scene.children.filter((child) => child.isURDFRobot && child.visible).length === 2")
    studio.page.keyboard.press("Control+z")
    studio.until("studio.store.value.options['compare.robot'] === undefined")
    studio.page.goto("about:blank")
    studio.page.goto(f"{studio.url}/embed{fragment}")
    studio.until("studio.view.scene.getObjectByName('comparison')?.children.length > 0")
    expect(studio.page.get_by_role("tablist")).to_have_count(0)
    expect(studio.page.locator(".label.compared")).to_have_text("planar_2r")


@pytest.mark.slow
def test_joints_that_are_not_linked_move_the_second_alone(studio: Studio) -> None:
    q = [0.3, 0.8]
    compared(studio, "planar_2r", q="0.3,0.8")
    studio.button("Linked joints").click()
    studio.page.get_by_label("joint_1, number", exact=True).nth(1).fill("1.1")
    studio.page.get_by_label("joint_1, number", exact=True).nth(1).press("Enter")
    wanted = np.linalg.norm(tip(TWO, [1.1, 0.8]) - tip(TWO, q))
    studio.until(f"Math.abs(document.querySelector('{MEASURED}').dataset.position - {wanted}) < 1e-9")
    assert list(studio.state("positions").values()) == q
    studio.until("location.hash.includes('compare.q=1.1,0.8')")
    studio.page.reload()
    studio.wait_for_robot("planar_2r")
    studio.until(f"Math.abs(document.querySelector('{MEASURED}')?.dataset.position - {wanted}) < 1e-9")
    studio.button("Linked joints").click()
    says(studio, "The tips meet here.")


@pytest.mark.slow
def test_zeros_that_the_service_finds_link_the_joints(studio: Studio) -> None:
    """A table whose first joint has its zero elsewhere."""
    table = planar(*TWO, theta=0.3, base=HERE, tool=HERE)
    compared(studio, "planar_2r", q="0.3,0.8", **options(**{"with": "table"}, table=table))
    wanted = np.linalg.norm(tip(TWO, [0.6, 0.8]) - tip(TWO, [0.3, 0.8]))
    assert measured(studio) == pytest.approx((wanted, 0.3), abs=1e-9)
    studio.run("studio.store.set({options: {...studio.store.value.options, 'compare.find': 'all'}})")
    says(studio, "The tips meet here.")
    says(studio, "The same arm")
    studio.type("joint_1, number", "-0.7")
    says(studio, "The tips meet here.")


@pytest.mark.slow
def test_a_typed_table_is_compared_with_a_robot_that_is_kept(studio: Studio) -> None:
    """The service is then asked whether the first describes the second."""
    table = json.dumps(planar(1.0, 0.75, tool=HERE, base=HERE))
    studio.open("compare", dh_table=table, q="0.3,0.8", **options(**{"with": "robot"}, robot="planar_2r"))
    says(studio, "Another arm: the first one's table does not describe the second.")
    says(studio, "a₂ (joint_2) is 0.75 m, 0.7 m is needed")
    studio.button("Other convention").click()
    says(studio, "Add this table")
    says(studio, "The tips meet here.")


@pytest.mark.slow
def test_what_cannot_be_compared_is_said(studio: Studio, refusals: set[int]) -> None:
    refusals |= {404, 422}
    studio.open("compare", robot="planar_2r", **options(**{"with": "robot"}, robot="nobody"))
    expect(studio.page.locator("#panel [role=alert]:visible")).to_contain_text("nobody")
    bad = planar(*TWO)
    bad["joints"][1]["type"] = "magnetic"
    studio.open("compare", robot="planar_2r", **options(**{"with": "table"}, table=bad))
    expect(studio.page.locator("#panel [role=alert]:visible").first).to_be_visible()
    studio.open("compare", robot="planar_2r", **options(**{"with": "robot"}, robot="panda"))
    says(studio, "First difference: the number of joints")


@pytest.mark.slow
def test_leaving_the_panel_leaves_nothing_behind(studio: Studio) -> None:
    studio.open("pose", robot="anthropomorphic")
    count = "[studio.view.scene.children.length, document.querySelectorAll('.labels > *').length]"
    before = studio.run(count)
    geometries = []
    for _ in range(4):
        studio.run("studio.store.set({panel: 'compare'})")
        studio.until(SECOND)
        studio.until("document.querySelectorAll('.compare [data-tone]').length === 2")
        studio.run("studio.store.set({panel: 'pose'})")
        assert studio.run(count) == before
        studio.drawn()
        geometries.append(studio.run("studio.view.memory()"))
    assert geometries[-1] == geometries[0]


@pytest.mark.slow
@pytest.mark.parametrize("scheme", ["light", "dark"])
def test_everything_can_be_read(another: Callable[..., Studio], scheme: str) -> None:
    studio = another(width=1024, height=768, scheme=scheme)
    wrong = options(**{"with": "table"}, table=planar(0.5, 0.45, 0.3), placing="over")
    for chosen in (wrong, options(link="free"), options(**{"with": "robot"}, robot="panda")):
        compared(studio, "planar_3r", **chosen)
        assert axe(studio) == []
        assert studio.run(CUT_OFF) == []
