"""The Worked solution panel: formulas as the service writes them, numbers that follow the joints."""

import json
import math
from collections.abc import Callable
from typing import Any

import numpy as np
import pytest
from playwright.sync_api import Request

from gelenk.robot.arrays import Array
from tests.oracles import catalogue
from tests.studio.browser import Studio
from tests.studio.tables import ANTHROPOMORPHIC, keep, type_table
from tests.test_serve import get

ANTHROPOMORPHIC_TABLE = json.dumps(catalogue.dh_table("anthropomorphic"))
ROUNDING = 5.1e-5
"""Numbers are shown with four decimals."""

NUMBERS = """(name) => [...document.querySelectorAll(`[aria-label="${name} in numbers"] .matrix-row`)].map((row) =>
  [...row.children].map((cell) => Number(cell.textContent.replace("−", "-"))))"""
FORMULAS = "[...document.querySelectorAll('.sheet annotation')].map((e) => e.textContent)"
SLIDE = """() => {
  const slider = document.querySelector('[aria-label="joint_2"]');
  for (const value of [0.7, 0.8, 0.9]) {
    slider.value = value;
    slider.dispatchEvent(new Event("input"));
  }
}"""
AGREES = (
    "document.querySelector('section:not([hidden]) > .agreement')?.dataset.tone === 'good'"
    " && !document.querySelector('.formula:empty')"
)
"""What agreed before stays in the hidden section while the sheet is worked out anew."""


def part(studio: Studio, name: str) -> None:
    """Open a part of the solution, and wait until its formulas stand there."""
    studio.button(name).click()
    studio.until(f"document.querySelector('.sheet').textContent && {AGREES}")


def numbers(studio: Studio, name: str) -> Array:
    return np.array(studio.run(NUMBERS, name))


def derived(studio: Studio, dh: dict[str, Any], q: list[float], **options: Any) -> Any:
    status, answer = get(f"{studio.url}/v1/dh/derive", "POST", {"dh": dh, "joint_positions": [q], **options})
    assert status == 200, answer
    return answer


def arm_pose(q: Array) -> tuple[Array, Array]:
    """T_0_3 and the linear Jacobian of the anthropomorphic arm with links of 0.5 and 0.4 m, by hand."""
    (c1, c2, c23), (s1, s2, s23) = np.cos([q[0], q[1], q[1] + q[2]]), np.sin([q[0], q[1], q[1] + q[2]])
    out, up = 0.5 * c2 + 0.4 * c23, 0.5 * s2 + 0.4 * s23
    R = [[c1 * c23, -c1 * s23, s1], [s1 * c23, -s1 * s23, -c1], [s23, c23, 0.0]]
    T = np.block([[np.array(R), np.array([[c1 * out], [s1 * out], [up]])], [np.eye(4)[3:]]])
    J = np.array([[-s1 * out, -c1 * up, -0.4 * c1 * s23], [c1 * out, -s1 * up, -0.4 * s1 * s23], [0, out, 0.4 * c23]])
    return T, J


@pytest.mark.slow
def test_a_typed_table_is_worked_out_and_so_is_the_robot_it_becomes(studio: Studio) -> None:
    type_table(studio, ANTHROPOMORPHIC)
    studio.page.get_by_role("tab", name="Worked solution").click()
    studio.until(AGREES)
    q = [0.3, 0.6, -0.8]
    for name, value in zip(("joint_1", "joint_2", "joint_3"), q, strict=True):
        studio.type(f"{name}, number", str(value))
    answer = derived(studio, studio.state("draft"), q)
    T, J = arm_pose(np.array(q))
    written = set(studio.run(FORMULAS))
    for i, (matrix, A) in enumerate(zip(answer["A"], answer["numeric"][0]["A"], strict=True), start=1):
        assert f"A_{{{i}}} = {matrix['latex']}" in written
        assert numbers(studio, matrix["name"]) == pytest.approx(np.array(A), abs=ROUNDING)
    part(studio, "T⁰ᵢ")
    assert f"T^{{0}}_{{3}} = {answer['T_0'][2]['latex']}" in studio.run(FORMULAS)
    assert numbers(studio, "T_0_3") == pytest.approx(T, abs=ROUNDING)
    part(studio, "Jacobian")
    assert f"J = {answer['jacobian']['matrix']['latex']}" in studio.run(FORMULAS)
    assert numbers(studio, "J")[:3] == pytest.approx(J, abs=ROUNDING)
    part(studio, "Singularities")
    assert numbers(studio, "Determinant").item() == pytest.approx(np.linalg.det(J), abs=ROUNDING)
    studio.until("document.querySelector('.agreement').dataset.difference < 1e-12")
    studio.page.get_by_role("tab", name="Robot").click()
    keep(studio, "worked_arm")
    studio.page.get_by_role("tab", name="Worked solution").click()
    studio.until(AGREES)
    assert numbers(studio, "Determinant").item() == pytest.approx(np.linalg.det(J), abs=ROUNDING)


@pytest.mark.slow
def test_numbers_follow_the_slider_while_formulas_stay(studio: Studio) -> None:
    studio.open("worked", dh_table=ANTHROPOMORPHIC_TABLE, q="0.3,0.6,-0.8", worked="jacobian")
    studio.until(AGREES)
    studio.run("globalThis.before = document.querySelector('.sheet .katex')")
    calls = []

    def note(request: Request) -> None:
        if "/v1/" in request.url:
            calls.append(request.url)

    studio.page.on("request", note)
    studio.run(SLIDE)
    q = np.array([0.3, 0.9, -0.8])
    assert numbers(studio, "J")[:3] == pytest.approx(arm_pose(q)[1], abs=ROUNDING)
    studio.hear(calls)
    studio.until(AGREES)
    assert studio.run("before === document.querySelector('.sheet .katex')")
    assert calls == [f"{studio.url}/v1/dh/derive"]  # once, at rest


@pytest.mark.slow
def test_the_panda_is_worked_out_by_the_table_of_its_chain(studio: Studio) -> None:
    studio.open("worked", robot="panda", worked="jacobian", q="0.2,-0.785,0.1,-2.356,0.3,1.571,0.785,0")
    studio.until(AGREES)
    call = {"joint_positions": [[0.2, -0.785, 0.1, -2.356, 0.3, 1.571, 0.785]]}
    J = np.array(get(f"{studio.url}/v1/robots/panda/jacobian", "POST", call)[1]["jacobians"][0])
    assert numbers(studio, "J") == pytest.approx(J, abs=ROUNDING)
    assert not any(formula.startswith("J = \\begin{bmatrix} -") for formula in studio.run(FORMULAS))
    studio.button("Write it out").click()
    wide = studio.page.locator('.wide[aria-label="J"]')
    studio.until("document.querySelector('.wide[aria-label=J]').tabIndex === 0")
    wide.focus()
    for _ in range(3):
        wide.press("ArrowRight")
    studio.until("document.querySelector('.wide[aria-label=J]').scrollLeft > 40")
    part(studio, "Singularities")
    assert "remarks" in studio.page.locator(".sheet").inner_text()
    assert "there is no determinant" in studio.page.locator(".remarks").inner_text()
    part(studio, "T⁰ᵢ")
    studio.run("studio.store.set({robot: 'planar_2r'})")
    studio.wait_for_robot("planar_2r")
    studio.until("document.querySelector('.sheet .matrix')")
    assert numbers(studio, "T_0_2").shape == (4, 4)
    assert numbers(studio, "T_0_7").size == 0


@pytest.mark.slow
def test_a_singular_configuration_is_gone_to(studio: Studio) -> None:
    studio.open("worked", robot="anthropomorphic", worked="singular", q="0.3,0.6,-0.8")
    studio.until(AGREES)
    assert abs(numbers(studio, "Determinant").item()) > 0.1
    for button in studio.page.get_by_role("button", name="Go there").all():
        studio.type("joint_3, number", "-0.8")
        button.click()
        q = np.array([studio.state("positions")[f"joint_{i}"] for i in (1, 2, 3)])
        assert abs(np.linalg.det(arm_pose(q)[1])) < 1e-12
        assert numbers(studio, "Determinant").item() == 0.0


@pytest.mark.slow
def test_a_planar_arm_has_equations_of_motion(studio: Studio) -> None:
    studio.open("worked", robot="planar_2r", worked="motion")
    studio.until(f"{AGREES} && document.querySelectorAll('.sheet .step').length > 2")
    dh = catalogue.dh_table("planar_2r")
    steps = derived(studio, dh, [0.0, 0.0], dynamics={})["steps"]
    shown = set(studio.page.locator(".sheet h2").all_text_contents())
    for name in ("DH and Aᵢ", "T⁰ᵢ", "Jacobian", "Singularities"):
        part(studio, name)
        shown |= set(studio.page.locator(".sheet h2").all_text_contents())
    assert shown == {step["title"] for step in steps}, "a step of the service is in no part"


@pytest.mark.slow
def test_it_is_written_otherwise_copied_and_reopened(studio: Studio) -> None:
    studio.open("worked", dh_table=ANTHROPOMORPHIC_TABLE, q="0.3,0.6,-0.8")
    part(studio, "T⁰ᵢ")
    studio.button("cos(q₁ + q₂)").click()
    studio.button("Values").click()
    dh = json.loads(ANTHROPOMORPHIC_TABLE)
    answer = derived(studio, dh, [0.3, 0.6, -0.8], notation="full", symbolic=False)
    last = f"T^{{0}}_{{3}} = {answer['T_0'][2]['latex']}"
    studio.until(f"{FORMULAS}.includes({json.dumps(last)})")
    copied = studio.copied(studio.button("Copy Forward kinematics as LaTeX"))
    assert copied.startswith("\\paragraph{Forward kinematics}\nT\\_0\\_i")
    assert f"\\[ {last} \\approx \\begin{{bmatrix}}" in copied
    studio.address()
    studio.page.reload()
    studio.wait_for_robot(None)
    studio.until(f"{FORMULAS}.includes({json.dumps(last)})")
    call = studio.page.locator(".request code")
    assert '"notation": "full"' in (call.text_content() or "")


@pytest.mark.slow
def test_a_table_that_cannot_be_worked_out_says_why(studio: Studio, refusals: set[int]) -> None:
    refusals.add(422)
    rows: list[dict[str, Any]] = [{"type": "revolute", "a": 0.3, "alpha": 0, "d": 0, "theta": 0} for _ in range(2)]
    rows[1]["mimic"] = {"joint": "joint_1", "multiplier": -1, "offset": 0}
    studio.open("worked", dh_table=json.dumps({"convention": "standard", "joints": rows}))
    problem = studio.page.locator(".problem:visible")
    problem.wait_for()
    assert "follow no other joint" in (problem.text_content() or "")
    studio.run("(draft) => studio.store.set({draft})", json.loads(ANTHROPOMORPHIC_TABLE))
    studio.until(AGREES)
    problem.wait_for(state="hidden")


@pytest.mark.slow
def test_long_work_is_stopped(studio: Studio) -> None:
    studio.open("worked", dh_table=ANTHROPOMORPHIC_TABLE)
    studio.until(AGREES)
    studio.until("document.querySelector('.sheet annotation')")
    held: list[Callable[[], None]] = []
    studio.page.route("**/v1/dh/derive", lambda route: held.append(route.continue_))
    studio.button("Values").click()
    studio.hear(held)
    studio.run("studio.store.set({positions: {...studio.store.value.positions}})")
    studio.run("new Promise((done) => setTimeout(done, 400))")  # the joints have come to rest where they were
    studio.button("Stop").click()
    assert studio.page.get_by_role("status").all_text_contents().count("Working it out …") == 0
    assert "a_{2}" in " ".join(studio.run(FORMULAS))
    studio.page.unroute("**/v1/dh/derive")
    studio.button("Symbols").click()
    studio.until(AGREES)
    assert len(held) == 1


@pytest.mark.slow
def test_what_is_asked_for_no_more_does_not_come(studio: Studio) -> None:
    studio.open("worked", dh_table=ANTHROPOMORPHIC_TABLE)
    studio.until(AGREES)
    held: list[Callable[[], None]] = []
    studio.page.route("**/v1/dh/derive", lambda route: held.append(route.continue_))
    studio.button("Values").click()
    studio.hear(held)
    studio.button("Symbols").click()
    studio.until(
        "![...document.querySelectorAll('[role=status]')].some((one) => one.textContent.startsWith('Working'))"
    )
    assert "a_{2}" in " ".join(studio.run(FORMULAS))
    studio.page.unroute("**/v1/dh/derive")
    studio.button("Values").click()
    studio.until(f"{AGREES} && !{FORMULAS}.join().includes('a_{{2}}')")
    studio.button("Symbols").click()
    studio.until(f"{AGREES} && {FORMULAS}.join().includes('a_{{2}}')")


@pytest.mark.slow
def test_after_a_table_that_was_not_waited_for_another_choice_asks_for_it_again(studio: Studio) -> None:
    held: list[Callable[[], None]] = []
    studio.page.route("**/v1/robots/ur5/dh*", lambda route: held.append(route.continue_))
    studio.open("worked", robot="ur5")
    studio.hear(held)
    studio.button("Stop").click()
    studio.page.unroute("**/v1/robots/ur5/dh*")
    studio.button("Values").click()
    studio.until(f"{AGREES} && {FORMULAS}.length")


@pytest.mark.slow
def test_a_failure_does_not_stay_where_what_was_before_is_wanted_again(studio: Studio, refusals: set[int]) -> None:
    refusals.add(503)
    studio.open("worked", dh_table=ANTHROPOMORPHIC_TABLE)
    studio.until(AGREES)
    problem = {"title": "Overloaded", "status": 503, "detail": "later", "type": "about:blank"}
    studio.page.route(
        "**/v1/dh/derive",
        lambda route: route.fulfill(status=503, content_type="application/problem+json", body=json.dumps(problem)),
    )
    studio.button("Values").click()
    studio.page.locator(".problem:visible").wait_for()
    studio.page.unroute("**/v1/dh/derive")
    studio.button("Symbols").click()
    studio.until(f"{AGREES} && {FORMULAS}.join().includes('a_{{2}}')")


SLANTED = {
    "convention": "standard",
    "joints": [
        {"type": "revolute", "a": 0.5, "alpha": math.pi / 4, "d": 0.25, "theta": 0},
        {"type": "revolute", "a": 0.3, "alpha": math.pi / 3, "d": 0, "theta": 0},
        {"type": "prismatic", "a": 0, "alpha": 0, "d": 0, "theta": math.pi / 6, "lower": 0, "upper": 1},
    ],
}
"""Roots and fractions in the upper rows of its matrices, and none in the lowest."""

APART = """[...document.querySelectorAll(".line:has(.numeric)")].flatMap((line) => {
  const baseline = (host) => {
    const mark = document.createElement("span");
    mark.style.cssText = "display: inline-block; width: 0; height: 0";
    host.append(mark);
    const {bottom} = mark.getBoundingClientRect();
    mark.remove();
    return bottom;
  };
  const column = line.querySelector(".katex-html .mtable [class^=col-align] .vlist");
  const symbols = [...column.children].map((row) => baseline(row.lastElementChild));
  const numbers = [...line.querySelectorAll(".matrix-row")].map((row) => baseline(row.firstElementChild));
  const below = line.querySelector(".numeric").offsetTop > line.querySelector(".wide").offsetTop + 60;
  return below ? [] : [[line.querySelector(".wide").ariaLabel, numbers.map((y, i) => y - symbols[i])]];
})"""
"""By how much each row of numbers stands below that of the formula beside it, [px]."""


@pytest.mark.slow
@pytest.mark.parametrize("options", ["", ",full"])
def test_rows_of_numbers_stand_on_those_of_the_formula_beside_them(
    another: Callable[..., Studio], options: str
) -> None:
    studio = another(width=1920, height=1080)
    studio.open("worked", dh_table=json.dumps(SLANTED), worked=f"transforms{options}", q="0.3,0.6,0.2")
    studio.run("studio.store.set({width: 900})")
    studio.until(AGREES)
    for name in ("DH and Aᵢ", "T⁰ᵢ", "Jacobian"):
        part(studio, name)
        studio.typeset()
        rows = dict(studio.run(APART))
        assert len(rows) >= (1 if name == "T⁰ᵢ" else 3)
        assert np.abs(np.concatenate(list(rows.values()))).max() < 1, rows


TINTS = """[...document.querySelectorAll(".line.tinted")].map((line) => {
  const [symbol, matrix] = line.querySelectorAll(".katex-html > *");
  const colour = (element) => getComputedStyle(element).color;
  return [colour(symbol), getComputedStyle(line).borderLeftColor, matrix && colour(matrix)];
})"""
TONED = """[...document.querySelectorAll(".line:has(.toned)")].map((line) =>
  [...line.querySelectorAll(".toned")].map((column) => getComputedStyle(column).color))"""
NAMES = "[...document.querySelectorAll('.joint-name')].map((name) => getComputedStyle(name).borderLeftColor)"
CONTRASTS = """(() => {
  const probe = document.body.appendChild(document.createElement("span"));
  const canvas = document.createElement("canvas").getContext("2d", {willReadFrequently: true});
  const luminance = (name) => {
    probe.style.color = `var(--${name})`;
    canvas.fillStyle = getComputedStyle(probe).color;
    canvas.fillRect(0, 0, 1, 1);
    const [r, g, b] = [...canvas.getImageData(0, 0, 1, 1).data].map((value) => {
      const share = value / 255;
      return share <= 0.04045 ? share / 12.92 : ((share + 0.055) / 1.055) ** 2.4;
    });
    return 0.2126 * r + 0.7152 * g + 0.0722 * b + 0.05;
  };
  const found = ["panel", "view"].flatMap((ground) => [1, 2, 3, 4, 5, 6, 7, 8].map((i) => {
    const [low, high] = [luminance(ground), luminance(`joint-${i}`)].sort((a, b) => a - b);
    return high / low;
  }));
  probe.remove();
  return found;
})()"""
"""Contrast of each tint, by the rule of WCAG, on the panel and on the picture."""


@pytest.mark.slow
@pytest.mark.parametrize("scheme", ["light", "dark"])
def test_what_belongs_to_a_link_is_written_in_its_colour(another: Callable[..., Studio], scheme: str) -> None:
    studio = another(scheme=scheme)
    studio.open("worked", robot="anthropomorphic")
    studio.until(AGREES)
    colours = studio.run(NAMES)
    assert len(set(colours)) == 3
    ink = studio.run("getComputedStyle(document.body).color")
    expected = [[colour, colour, ink] for colour in colours]
    assert studio.run(TONED) == [colours * 5], "i, a, α, d and ϑ of each row"
    assert studio.run(TINTS) == expected
    part(studio, "T⁰ᵢ")
    assert studio.run(TINTS) == expected
    part(studio, "Jacobian")
    assert studio.run(TINTS) == [line for line in expected for _ in range(3)], "z, p and z × p of each joint"
    assert studio.run(TONED) == [colours, colours], "J by its columns, and J"
    assert min(studio.run(CONTRASTS)) >= 4.5


@pytest.mark.slow
def test_it_says_that_it_stays_in_metres_and_radians(studio: Studio) -> None:
    studio.open("worked", robot="anthropomorphic", q="0.3,0.6,-0.8")
    studio.until(AGREES)
    said = studio.page.get_by_text("in metres and radians, whatever")
    assert not said.is_visible()
    before = numbers(studio, "A_2")
    for unit in ("millimetres", "degrees"):
        studio.run("(unit) => studio.store.set({[unit]: true})", unit)
        assert said.is_visible()
        assert (numbers(studio, "A_2") == before).all()
        studio.run("(unit) => studio.store.set({[unit]: false})", unit)
