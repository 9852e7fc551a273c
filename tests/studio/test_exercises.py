"""The Exercises panel: a variant is drawn, answered, graded and worked out, in both languages; and the pictures."""

import json
from collections.abc import Callable
from pathlib import Path
from typing import Any

import pytest
from playwright.sync_api import Request, expect

from gelenk.contract.endpoint import Scope
from gelenk.http.access.keyring import new_key
from tests.studio.browser import Studio
from tests.studio.test_page import AXE, CUT_OFF, loaded
from tests.test_serve import get, service

LINKAGE, JACOBIAN, ELBOWS = "mobility.linkage", "velocities.two_links", "inverse_kinematics.two_links"
EVERY_KIND = [LINKAGE, JACOBIAN, ELBOWS, "dh_tables.conventions", "statics.subspaces", "velocities.singularities"]
"""Numbers, choice; matrix, vector; a set; a table; bases; sets of numbers, too."""


def ask(studio: Studio, exercise: str, what: str = "", language: str = "en", seed: int = 1, **more: Any) -> Any:
    """What the service says of a variant, asked without the page."""
    path = f"{studio.url}/v1/course/exercises/{exercise}{what}"
    status, answer = get(path, "POST", {"seed": seed, "language": language, **more})
    assert status == 200, answer
    return answer


def open_exercise(studio: Studio, exercise: str, language: str = "en", seed: int = 1) -> None:
    place = {"exercises.task": exercise, "exercises.language": language, "exercises.seed": str(seed)}
    studio.open("exercises", robot="planar_2r", **place)
    studio.page.locator(".answer").first.wait_for()


def fill(studio: Studio, variant: dict[str, Any], answers: dict[str, Any]) -> None:
    """Type answers cell by cell, and choose words."""
    for field in variant["fields"]:
        answer = answers[field["name"]]
        host = studio.page.locator(".answer").nth(variant["fields"].index(field))
        if field["kind"] == "choice":
            host.locator(f"input[value='{answer}']").check()
            continue
        for _ in answer[1:] if field["kind"] == "set" else ():
            host.locator("button.small").click()
        for cell, number in zip(host.locator("input").all(), numbers(answer), strict=True):
            cell.fill(str(number))


def numbers(answer: Any) -> list[float]:
    """All numbers of an answer, row by row."""
    return [number for one in answer for number in numbers(one)] if isinstance(answer, list) else [answer]


def graded(studio: Studio) -> list[str]:
    """Have the answers graded by Enter in the last cell; what each field is told."""
    with studio.page.expect_response("**/grade"):
        studio.page.locator(".answer input").last.press("Enter")
    studio.page.locator(".earned:visible").first.wait_for()
    told: list[str] = studio.page.locator(".earned").all_text_contents()
    return told


@pytest.mark.slow
@pytest.mark.parametrize("exercise", EVERY_KIND)
def test_right_answers_of_every_kind_get_full_points(studio: Studio, exercise: str) -> None:
    variant, solution = ask(studio, exercise), ask(studio, exercise, "/solution")
    open_exercise(studio, exercise)
    fill(studio, variant, solution["answers"])
    assert graded(studio) == ["Right"] * len(variant["fields"])
    most = f"{sum(field['points'] for field in variant['fields']):g}"
    expect(studio.page.locator("form [role=status]")).to_have_text(f"{most} of {most} points")
    studio.button("Show the solution").click()
    expect(studio.page.locator(".steps li")).to_have_count(len(solution["steps"]))
    expect(studio.page.locator(".answer-right:visible")).to_have_count(len(variant["fields"]))


@pytest.mark.slow
def test_a_wrong_answer_gets_its_mistake_named(studio: Studio) -> None:
    variant, right = ask(studio, LINKAGE, seed=7), ask(studio, LINKAGE, "/solution", seed=7)["answers"]
    answers = {**right, "constraints": right["constraints"] + 1}
    mistake = ask(studio, LINKAGE, "/grade", seed=7, answers=answers)["fields"][0]["mistake"]
    open_exercise(studio, LINKAGE, seed=7)
    fill(studio, variant, answers)
    assert graded(studio) == [mistake["text"], "Right", "Right"]
    expect(studio.page.locator("form [role=status]")).to_have_text("2 of 3 points")
    wrong = studio.field(variant["fields"][0]["label"])
    expect(wrong).to_have_attribute("aria-invalid", "true")
    expect(wrong).to_have_accessible_description(mistake["text"])
    wrong.fill(str(right["constraints"]))
    expect(studio.page.locator(".earned").first).to_be_hidden()
    graded(studio)
    expect(studio.page.locator(".earned")).to_have_text(["Right"] * 3)


@pytest.mark.slow
def test_a_part_of_a_set_earns_a_part(studio: Studio) -> None:
    answers = ask(studio, ELBOWS, "/solution")["answers"]["solutions"]
    open_exercise(studio, ELBOWS, "de")
    studio.button("Lösung hinzufügen").click()
    assert studio.run("document.activeElement.ariaLabel").endswith(", Lösung 2, 1")
    studio.button("Lösung 2 entfernen").click()
    for cell, number in zip(studio.page.locator(".answer input").all(), answers[1], strict=True):
        cell.fill(str(number))
    (told,) = graded(studio)
    assert told.endswith(" (1 von 2 Punkten)")
    studio.button("Lösung zeigen").click()
    shown = "; ".join(f"({'; '.join(f'{number:.5g}' for number in pair)})" for pair in answers)
    expect(studio.page.locator(".answer-right")).to_have_text(
        f"Richtige Antwort:{shown} rad".replace("-", "−").replace(".", ",")
    )


@pytest.mark.slow
def test_numbers_are_sent_as_they_are_meant(studio: Studio) -> None:
    open_exercise(studio, "poses.degenerate")
    sent: list[dict[str, Any]] = []

    def note(request: Request) -> None:
        if request.url.endswith("/grade"):
            sent.append(json.loads(request.post_data or "{}")["answers"])

    studio.page.on("request", note)
    for i, text in enumerate(("90°", "-pi/2", "one")):
        studio.page.locator(".answer input.number").nth(i).fill(text)
    told = graded(studio)
    assert sent == [
        {"theta": pytest.approx(1.5707963267948966), "value": pytest.approx(-1.5707963267948966), "phi": "one"}
    ]
    assert len(set(told)) > 1
    for cell, text in zip(studio.page.locator(".answer input.number").all(), ("0,5", "3/4", ""), strict=True):
        cell.fill(text)
    graded(studio)
    assert sent[1] == {"theta": 0.5, "value": 0.75}


@pytest.mark.slow
def test_hints_come_one_step_at_a_time(studio: Studio) -> None:
    variant, solution = ask(studio, JACOBIAN), ask(studio, JACOBIAN, "/solution")
    open_exercise(studio, JACOBIAN)
    steps, count = studio.page.locator(".steps li"), len(variant["hints"])
    assert steps.count() == 0
    studio.button(f"Hint 1 of {count}").click()
    expect(steps).to_have_count(1)
    expect(steps.locator("strong")).to_have_text(variant["hints"][0])
    expect(steps.locator("p")).to_have_text(solution["steps"][0]["text"])
    assert studio.page.locator(".steps .katex").count() == 0, "numbers are for whoever opens them"
    steps.locator("summary").click()
    expect(steps.locator(".katex")).to_have_count(len(solution["steps"][0]["latex"]))
    for number in range(2, count + 1):
        studio.button(f"Hint {number} of {count}").click()
        expect(steps).to_have_count(number)
    expect(studio.button(f"Hint {count} of {count}")).to_be_disabled()


@pytest.mark.slow
def test_a_key_that_may_not_see_solutions_gets_titles_as_hints(another: Callable[..., Studio], tmp_path: Path) -> None:
    token, key = new_key("student", [Scope.READ])
    with service(tmp_path / "data", GELENK_API_KEYS=key.entry()) as (_, url):
        studio = another(at=url)
        studio.expected = {403}
        studio.page.goto(f"{url}/studio/icon.svg")
        studio.run("(token) => sessionStorage.setItem('gelenk.key', token)", token)
        open_exercise(studio, JACOBIAN)
        studio.page.get_by_role("button", name="Hint 1 of").click()
        expect(studio.page.locator(".steps ~ [role=status]")).to_contain_text("lacks the scope teach")
        assert studio.page.locator(".steps li").all_text_contents() == ["Axes and lever arms"]
        graded(studio)
        studio.button("Show the solution").click()
        studio.drawn()
        assert studio.page.locator(".answer-right:visible, .problem:visible").count() == 0


@pytest.mark.slow
def test_it_speaks_german_and_keeps_what_is_typed(studio: Studio) -> None:
    variant = ask(studio, LINKAGE, language="de")
    answers = ask(studio, LINKAGE, "/solution")["answers"]
    open_exercise(studio, LINKAGE)
    fill(studio, variant, {**answers, "mobility": 99})
    graded(studio)
    studio.button("Deutsch").click()
    expect(studio.page.locator(".prose p").first).to_have_text(variant["text"].split("\n\n")[0])
    expect(studio.page.locator("form [role=status]")).to_have_text("2 von 3 Punkten")
    expect(studio.page.locator(".earned").first).to_have_text("Richtig")
    expect(studio.field(variant["fields"][1]["label"])).to_have_value("99")
    assert studio.run("document.querySelector('.exercises').lang") == "de"
    assert studio.run("document.activeElement.textContent") == "Deutsch"
    studio.page.get_by_role("tab", name="Pose").click()
    studio.page.get_by_role("tab", name="Exercises").click()
    expect(studio.field(variant["fields"][1]["label"])).to_have_value("99")


@pytest.mark.slow
def test_new_numbers_and_the_way_back(studio: Studio) -> None:
    studio.open("exercises", robot="planar_2r")
    studio.field("Lecture").wait_for()
    assert any("chunks/exercises" in name for name in loaded(studio))
    studio.field("Lecture").select_option("velocities")
    studio.page.get_by_role("button", name="The Jacobian of two links").click()
    text = studio.page.locator(".prose p").first
    expect(text).to_have_text(ask(studio, JACOBIAN)["text"])
    image = "document.querySelector('.prose img')"
    studio.until(f"{image}.naturalWidth > 0")
    first = studio.run(f"{image}.src")
    studio.button("New numbers").click()
    expect(text).to_have_text(ask(studio, JACOBIAN, seed=2)["text"])
    assert studio.run("document.activeElement.textContent") == "New numbers"
    assert studio.run(f"{image}.src") != first
    studio.type("Variant", "17")
    expect(text).to_have_text(ask(studio, JACOBIAN, seed=17)["text"])
    studio.address()
    studio.page.reload()
    studio.wait_for_robot("planar_2r")
    expect(text).to_have_text(ask(studio, JACOBIAN, seed=17)["text"])
    studio.button("← All exercises").click()
    expect(studio.page.locator(".exercise:focus")).to_contain_text("The Jacobian of two links")
    assert studio.field("Lecture").input_value() == "velocities"
    studio.address()
    studio.page.go_back()
    expect(text).to_have_text(ask(studio, JACOBIAN, seed=17)["text"])


@pytest.mark.slow
def test_an_exercise_that_does_not_exist_says_so(studio: Studio, refusals: set[int]) -> None:
    refusals.add(404)
    studio.open("exercises", robot="planar_2r", **{"exercises.task": "poses.none"})
    expect(studio.page.locator(".problem:visible")).to_contain_text("poses.none")


@pytest.mark.slow
def test_the_pictures_of_the_course_and_of_the_robots_table(studio: Studio) -> None:
    studio.open("exercises", robot="anthropomorphic", **{"exercises.part": "pictures", "exercises.language": "de"})
    listed = get(f"{studio.url}/v1/course/pictures?language=de")[1]["pictures"]
    shown = "[...document.querySelectorAll('figure img')].filter((image) => image.naturalWidth > 0)"
    studio.until(f"{shown}.length === {len(listed) + 2}")
    assert [one["title"] for one in listed] == studio.run(f"{shown}.slice(2).map(({{alt}}) => alt)")
    (triangle,) = (one["title"] for one in listed if one["name"] == "triangle")
    with studio.page.expect_download() as download:
        studio.button(f"Als SVG speichern: {triangle}").click()
    assert download.value.suggested_filename == "triangle.svg"
    studio.page.get_by_role("tab", name="Robot").click()
    studio.button("Frames drawn").click()
    studio.until(f"{shown}.length === 1")
    with studio.page.expect_download() as download:
        studio.button("Save the frames as SVG").click()
    assert download.value.suggested_filename == "anthropomorphic-dh.svg"
    studio.page.get_by_role("tab", name="Jacobian").click()
    studio.button("Ellipses drawn").click()
    studio.until(f"{shown}.length === 1")


@pytest.mark.slow
@pytest.mark.parametrize("width", [390, 1440])
def test_a_page_of_exercises_has_one_title(another: Callable[..., Studio], width: int) -> None:
    """On a narrow page the robot's name is not there."""
    studio = another(width=width, height=844)
    studio.open("exercises", robot="planar_2r", **{"exercises.language": "de"})
    title = studio.page.get_by_role("heading", level=1)
    expect(title).to_have_text(["Aufgaben" if width < 1024 else "planar_2r"])


@pytest.mark.slow
@pytest.mark.parametrize(("scheme", "width"), [("light", 1024), ("dark", 390)])
def test_axe_finds_nothing_and_nothing_is_cut_off(another: Callable[..., Studio], scheme: str, width: int) -> None:
    if not AXE.exists():
        pytest.skip("axe-core is not there: ./dev studio installs it")
    studio = another(scheme=scheme, width=width, height=844)
    for exercise in (ELBOWS, "workspaces.secondary", "velocities.scara", "dh_tables.arm"):
        open_exercise(studio, exercise)
        graded(studio)
        studio.button("Show the solution").click()
        studio.page.locator(".steps .katex").first.wait_for()
        findings: list[Any] = studio.run(AXE.read_text() + "; axe.run().then(({violations}) => violations)")
        assert [one["id"] for one in findings if one["impact"] in {"serious", "critical"}] == []
        assert studio.run(CUT_OFF) == []
        assert studio.run("document.documentElement.scrollWidth") == width
