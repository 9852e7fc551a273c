"""The Course panel: each calculator shows what the service answers, as numbers and as a picture."""

import json
import re
import time
from collections.abc import Callable
from pathlib import Path
from typing import Any

import numpy as np
import pytest
from playwright.sync_api import Locator, expect

from tests.studio.browser import PATIENCE, Studio
from tests.studio.pure import values
from tests.studio.test_page import CUT_OFF, axe
from tests.test_serve import get

ROOT = Path(__file__).parents[2]
FOUR_BAR = {
    "space": "planar",
    "links": ["frame", "crank", "coupler", "rocker"],
    "pairs": [
        {"link_a": "frame", "link_b": "crank", "type": "revolute"},
        {"link_a": "crank", "link_b": "coupler", "type": "revolute"},
        {"link_a": "coupler", "link_b": "rocker", "type": "revolute"},
        {"link_a": "rocker", "link_b": "frame", "type": "prismatic"},
    ],
}
CALCULATORS: dict[str, tuple[dict[str, Any], dict[str, Callable[[Any], Any]]]] = {
    "time-law": (
        {
            "law": "trapezoidal",
            "start": [0.0, 1.0],
            "target": [2.0, -0.5],
            "limits": {"joint_velocity": 0.8, "joint_acceleration": 1.6},
        },
        {"Duration T": lambda a: a["duration"], "Peak of q̇, joint 2": lambda a: a["peaks"]["velocity"][1]["value"]},
    ),
    "spline": (
        {"times": [0.0, 1.0, 2.5, 3.0], "waypoints": [0.0, 1.0, 0.5, 2.0], "boundary": "not_a_knot"},
        {"Peak of q̈": lambda a: a["peaks"]["acceleration"][0]["value"], "A": lambda a: a["system"]["matrix"]},
    ),
    "fly-over": (
        {"start": [0, 0], "corner": [2, 3], "end": [5, 3], "speed_before": 1, "speed_after": 1.5, "radius": 1.2},
        {"Blend time ΔT": lambda a: a["blend"]["blend_time"], "A′, where it begins": lambda a: a["blend"]["entry"]},
    ),
    "orientation": (
        {"elementary": {"axis": "x", "angle": 0.4}, "then": [{"rpy": [0.1, 0.2, 0.3], "about": "fixed"}]},
        {"R": lambda a: a["rotation"], "ZYZ φ, θ, ψ, too": lambda a: a["zyz_solutions"][1]},
    ),
    "triangle": (
        {"a": 3.0, "b": 4.0, "alpha": 0.7},
        {"a, b, c, triangle 2": lambda a: [a["triangles"][1][side] for side in "abc"]},
    ),
    "mobility": (
        FOUR_BAR,
        {"Mobility M": lambda a: a["mobility"], "Links n, pairs j": lambda a: [a["link_count"], a["pair_count"]]},
    ),
    "encoder": (
        {"type": "absolute", "bits": 5, "code": "gray", "gear_ratio": 20.0, "values": [6]},
        {
            "Resolution, load": lambda a: a["resolution"]["load"],
            "6 as an angle": lambda a: a["absolute"]["values"][0]["angle"],
        },
    ),
    "dc-motor": (
        {"resistance": 1.2, "inductance": 0.002, "torque_constant": 0.05, "inertia": 2e-4, "voltage": 12.0},
        {
            "Speed ω": lambda a: a["steady_state"]["angular_velocity"],
            "Poles": lambda a: [pole["real"] for pole in a["dynamics"]["poles"]],
        },
    ),
}
"""Of each calculator inputs of a link, and facts with where they are in the service's answer."""


def open_calculator(studio: Studio, task: str, inputs: Any = None) -> None:
    """Open a calculator by its link, and wait for its picture."""
    link = {"course.task": task} | ({} if inputs is None else {"course.inputs": json.dumps(inputs)})
    studio.open("course", robot="planar_2r", **link)
    studio.page.locator(".course-picture svg > *").first.wait_for(state="attached")


def ask(studio: Studio, task: str, inputs: Any) -> Any:
    status, answer = get(f"{studio.url}/v1/course/{task}", "POST", inputs)
    assert status == 200, answer
    return answer


def fact(studio: Studio, label: str) -> Locator:
    """What stands beside a label of the answer."""
    return studio.page.locator(".course-facts dt").get_by_text(label, exact=True).locator("+ dd")


def numbers(text: str) -> list[float]:
    """The numbers of a text, whatever stands between them."""
    powers = re.sub(
        r"·10([⁻⁰¹²³⁴⁵⁶⁷⁸⁹]+)", lambda m: "e" + m[1].translate(str.maketrans("⁻⁰¹²³⁴⁵⁶⁷⁸⁹", "-0123456789")), text
    )
    return [float(one) for one in re.findall(r"-?\d+(?:\.\d+)?(?:e-?\d+)?", powers.replace("−", "-"))]


def shown(place: Locator) -> list[float]:
    """The numbers of a fact; of a matrix those of its formula's source."""
    source = place.locator("annotation")
    text = source.text_content() if source.count() else place.text_content()
    return numbers(text or "")


def inputs_of(studio: Studio) -> Any:
    return json.loads(studio.state("options")["course.inputs"])


@pytest.mark.slow
@pytest.mark.parametrize("task", CALCULATORS)
def test_the_numbers_on_the_page_are_those_of_the_service(studio: Studio, task: str) -> None:
    inputs, facts = CALCULATORS[task]
    open_calculator(studio, task, inputs)
    answer = ask(studio, task, inputs)
    for label, of in facts.items():
        wanted = np.ravel(of(answer))
        expect(fact(studio, label)).to_contain_text(re.compile(r"\d"))
        assert shown(fact(studio, label))[: len(wanted)] == pytest.approx(wanted, rel=1e-5, abs=6e-5)
    studio.page.get_by_text("Worked solution", exact=True).last.click()
    expect(studio.page.locator(".course-answer .steps li")).to_have_count(len(answer["steps"]))
    studio.page.locator(".steps .katex").first.wait_for()


@pytest.mark.slow
@pytest.mark.parametrize(("scheme", "width"), [("light", 1440), ("dark", 390)])
def test_axe_finds_nothing_and_nothing_is_cut_off(another: Callable[..., Studio], scheme: str, width: int) -> None:
    studio = another(scheme=scheme, width=width, height=844)
    for task in CALCULATORS:
        open_calculator(studio, task)
        studio.page.get_by_text("Worked solution", exact=True).last.click()
        studio.page.locator(".steps .katex").first.wait_for()
        assert axe(studio) == [], task
        assert studio.run(CUT_OFF) == [], task
        assert studio.run("document.documentElement.scrollWidth") == width, task


@pytest.mark.slow
def test_what_is_typed_is_asked_drawn_and_in_the_link(studio: Studio) -> None:
    """By the keyboard alone."""
    open_calculator(studio, "time-law")
    before = studio.page.locator(".course-picture .curve").first.get_attribute("points")
    studio.field("Duration T").focus()
    studio.page.keyboard.press("Shift+ArrowUp")
    expect(fact(studio, "Duration T")).to_have_text("3 s")
    assert studio.page.locator(".course-picture .curve").first.get_attribute("points") != before
    studio.until("location.hash.includes('course.inputs=')")
    link = studio.run("location.hash")
    studio.go(link)
    expect(fact(studio, "Duration T")).to_have_text("3 s")
    studio.field("Law").select_option("trapezoidal")
    expect(fact(studio, "Phases")).to_have_text("0.5 + 2 + 0.5 s at 0.8 /s")


@pytest.mark.slow
def test_a_refusal_stands_at_its_field(studio: Studio, refusals: set[int]) -> None:
    refusals.add(422)
    open_calculator(studio, "time-law")
    studio.field("Duration T").fill("-1")
    wrong = studio.page.locator(".course-wrong:visible")
    expect(wrong).to_have_count(1)
    expect(studio.page.locator(".course-field", has=wrong)).to_contain_text("Duration T")
    expect(studio.page.locator(".course-inputs .problem")).to_be_hidden()
    studio.field("Duration T").fill("2")
    expect(wrong).to_have_count(0)
    open_calculator(studio, "triangle")
    studio.field("Side c").fill("9")
    expect(wrong).to_contain_text("exactly three")


@pytest.mark.slow
def test_a_link_with_anything_in_it_opens(studio: Studio, refusals: set[int]) -> None:
    refusals.add(422)
    for task in CALCULATORS:
        for inputs in (
            {"law": 1, "then": 3, "pairs": "x", "start": None, "times": {}},
            {},
            {"then": [1], "links": [{}]},
        ):
            link = f"#robot=planar_2r&panel=course&course.task={task}&course.inputs={json.dumps(inputs)}"
            studio.go(link)
            studio.page.locator(".course-inputs .problem:visible, .course-wrong:visible").first.wait_for()


@pytest.mark.slow
def test_a_knot_of_a_spline_is_dragged(studio: Studio) -> None:
    open_calculator(studio, "spline")
    drag(studio, "[data-handle='1'] .grip", 10, 30)
    inputs = inputs_of(studio)
    assert inputs["waypoints"][1] < 6.2
    assert inputs["times"][1] > 2.0
    peak = ask(studio, "spline", inputs)["peaks"]["velocity"][0]["value"]
    eventually(lambda: shown(fact(studio, "Peak of q̇"))[0] == pytest.approx(peak, rel=1e-5))


@pytest.mark.slow
def test_a_triad_is_turned_by_slider_and_by_dragging(studio: Studio) -> None:
    open_calculator(studio, "orientation")
    studio.field("Angle 2, slider").focus()
    studio.page.keyboard.press("ArrowRight")
    angle = inputs_of(studio)["then"][0]["elementary"]["angle"]
    assert angle == pytest.approx(0.7, abs=0.02)
    eventually(lambda: is_shown(studio))
    drag(studio, "[data-handle='1'] rect", 40, 0)
    assert inputs_of(studio)["then"][0]["elementary"]["angle"] == pytest.approx(angle + np.radians(40.0), abs=0.02)
    eventually(lambda: is_shown(studio))


def is_shown(studio: Studio) -> bool:
    """Whether the rotation on the page is the one that the service answers to what is typed."""
    R = ask(studio, "orientation", inputs_of(studio))["rotation"]
    return shown(fact(studio, "R")) == pytest.approx(np.ravel(R), abs=6e-5)


@pytest.mark.slow
def test_a_mechanism_is_built_by_the_keyboard(studio: Studio) -> None:
    """Grübler's count follows each link and joint."""
    open_calculator(studio, "mobility")
    count = fact(studio, "Mobility M")
    expect(count).to_have_text("1")
    studio.button("Add link").press("Enter")
    expect(count).to_have_text("4")
    studio.button("Add joint").press("Enter")
    expect(count).to_have_text("2")
    studio.field("Joint 5, kind").select_option("fixed")
    expect(count).to_have_text("1")
    studio.field("Joint 5, kind").select_option("prismatic")
    studio.field("Joint 5, direction").fill("1, 1")
    expect(count).to_have_text("2")
    assert ask(studio, "mobility", inputs_of(studio))["mobility"] == 2
    studio.button("Remove link rocker").press("Enter")
    expect(count).to_have_text("5")
    studio.button("In space, λ = 6").press("Enter")
    expect(count).to_have_text("8")
    studio.button("Remove joint 1").press("Enter")
    expect(count).to_have_text("13")
    assert [pair["link_a"] for pair in inputs_of(studio)["pairs"]] == ["crank"]


@pytest.mark.slow
def test_a_joint_of_a_mechanism_is_dragged(studio: Studio) -> None:
    open_calculator(studio, "mobility")
    drag(studio, "[data-handle='1'] .grip", 40, 0)
    eventually(lambda: inputs_of(studio)["pairs"][1]["point"][0] > 0.32)
    assert studio.field("Joint 2, x, y").input_value().startswith("0.")


MIDDLE = """(what) => {
  const {x, y, width, height} = document.querySelector(what).getBoundingClientRect();
  return [x + width / 2, y + height / 2];
}"""
"""Where the middle of an element is on the page."""


def drag(studio: Studio, what: str, dx: float, dy: float) -> None:
    """From the middle of what is there; an answer that has just come draws it anew."""
    studio.until(f"document.querySelector({json.dumps(what)})")
    x, y = studio.run(MIDDLE, what)
    studio.page.mouse.move(x, y)
    studio.page.mouse.down()
    studio.page.mouse.move(x + dx, y + dy)
    studio.page.mouse.up()


def eventually(is_true: Callable[[], bool]) -> None:
    """Wait until the page has caught up."""
    deadline = time.monotonic() + PATIENCE
    while not is_true():
        assert time.monotonic() < deadline
        time.sleep(0.02)


def test_lists_are_typed_as_people_write_them() -> None:
    texts = ["0, 2pi, π/2", "0,5; 1", "1 -2", "(0, 1) (2, 3)", "1, x", "", "(1) 2"]
    wanted = [[0, 2 * np.pi, np.pi / 2], [0.5, 1], [1, -2], [[0, 1], [2, 3]], None, None, None]
    assert values("panels/course/lists.ts", [f"m.parsedList({json.dumps(text)})" for text in texts]) == wanted
    lists = [[0.5, -2.0], [[0.0, 1.0], [2.0, 3.0]]]
    assert values("panels/course/lists.ts", [f"m.parsedList(m.writtenList({one}))" for one in lists]) == lists


def test_a_field_changes_its_place_in_the_request_alone() -> None:
    changes = [
        ('{a: 1}, "b/c", 2', {"a": 1, "b": {"c": 2}}),
        ('{a: 1, b: {c: 2}}, "b/c", null', {"a": 1}),
        ('{a: 1, b: {c: 2, d: 3}}, "b/c", null', {"a": 1, "b": {"d": 3}}),
        (
            '{then: [{x: {angle: 1}}, {x: {angle: 2}}]}, "then/1/x/angle", 3',
            {"then": [{"x": {"angle": 1}}, {"x": {"angle": 3}}]},
        ),
    ]
    found = values("panels/course/calculator.ts", [f"m.withValue({given})" for given, _ in changes])
    assert found == [wanted for _, wanted in changes]


def test_ticks_are_round_numbers_of_the_range() -> None:
    assert values("panels/course/chart.ts", ["m.ticks([0, 2])", "m.ticks([-1.9, 1.1])", "m.ticks([3, 3])"]) == [
        [0, 0.5, 1, 1.5, 2],
        [-1, 0, 1],
        [3],
    ]


def test_each_calculator_leads_to_a_section_of_its_chapter() -> None:
    sources = "".join(path.read_text("utf-8") for path in (ROOT / "app/studio/src/panels/course").glob("*.ts"))
    pages = re.findall(r'page: "([\w/-]+)\.html(?:#([\w-]+))?"', sources)
    assert len(pages) == len(CALCULATORS)
    for page, section in pages:
        titles = re.findall(r"^#+ (.+)$", (ROOT / "docs" / f"{page}.md").read_text("utf-8"), re.MULTILINE)
        assert not section or section in {re.sub(r"[^\w-]", "", title.lower().replace(" ", "-")) for title in titles}
