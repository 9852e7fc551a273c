"""Exercises over HTTP: listed, drawn, solved and graded."""

from typing import Any

import pytest
from starlette.testclient import TestClient

from gelenk.contract.exercises import ExerciseGrade, ExerciseList, ExerciseSolution, ExerciseVariant
from gelenk.exercises.exercise import exercises
from tests.http.access.asking import HOST, application, ask, bearer, keys_for

PATH = "/v1/course/exercises"
LINKAGE = f"{PATH}/mobility.linkage"
RIGHT = {"constraints": 8, "mobility": 1, "verdict": "mechanism"}


def post(client: TestClient, path: str, **body: Any) -> Any:
    answer = client.post(path, json=body)
    assert answer.status_code == 200, answer.text
    return answer.json()


def test_all_exercises_are_listed_by_lectures(client: TestClient) -> None:
    listed = ExerciseList.model_validate_json(client.get(PATH).content).exercises
    assert [one.id for one in listed] == list(exercises())
    assert all(one.id.startswith(f"{one.lecture}.") for one in listed)
    lectures = [one.lecture for one in listed]
    assert lectures == sorted(lectures, key=lectures.index)
    assert lectures[0] == "mobility"


@pytest.mark.quick(1)
@pytest.mark.parametrize("exercise", list(exercises()))
def test_a_variant_is_drawn_solved_and_graded(client: TestClient, exercise: str) -> None:
    drawn = post(client, f"{PATH}/{exercise}", seed=3)
    variant = ExerciseVariant.model_validate(drawn)
    assert drawn == post(client, f"{PATH}/{exercise}", seed=3)
    assert (variant.picture is None) == (not exercises()[exercise].is_drawn)
    solved = post(client, f"{PATH}/{exercise}/solution", seed=3)
    solution = ExerciseSolution.model_validate(solved)
    assert solution.answers.keys() == {field.name for field in variant.fields}
    assert [step.title for step in solution.steps] == variant.hints
    grade = ExerciseGrade.model_validate(post(client, f"{PATH}/{exercise}/grade", seed=3, answers=solved["answers"]))
    assert grade.points == grade.max_points == sum(field.points for field in variant.fields)
    assert all(field.correct and field.mistake is None for field in grade.fields)


def test_texts_are_in_the_language_asked_for(client: TestClient) -> None:
    """Without compiled catalogues the texts stay English; they are the same in no other respect."""
    german = post(client, LINKAGE, seed=3, language="de")
    assert german["fields"][0]["name"] == "constraints"
    assert client.get(PATH, params={"language": "fr"}).status_code == 422


def test_answers_of_the_wrong_form_are_explained(client: TestClient) -> None:
    answers = {"constraints": "eight", "mobility": [1], "verdict": "perhaps"}
    grade = post(client, f"{LINKAGE}/grade", seed=3, answers=answers)
    assert grade["points"] == 0.0
    assert [one["mistake"]["code"] for one in grade["fields"]] == ["not_a_number", "not_a_number", "not_a_choice"]
    (pairs,) = post(client, f"{PATH}/mobility.pairs/grade", seed=3, answers={"constraints": [1, 2]})["fields"]
    assert pairs["mistake"] == {"code": "wrong_shape", "text": "The answer has this shape: 5 numbers."}
    grade = post(client, f"{LINKAGE}/grade", seed=3, answers={})
    assert {one["mistake"]["code"] for one in grade["fields"]} == {"missing"}


@pytest.mark.parametrize("value", [None, True, 1e308, "nan", "1e999", {}, {"a": []}, [[[]]], "x" * 3000])
def test_no_answer_is_an_error(client: TestClient, value: Any) -> None:
    grade = post(client, f"{LINKAGE}/grade", seed=3, answers=dict.fromkeys(RIGHT, value))
    assert not any(one["correct"] for one in grade["fields"])


@pytest.mark.parametrize("value", ["NaN", "-Infinity", "1e400", "9" * 400, "[1, [NaN]]", '{"joints": [{"a": NaN}]}'])
def test_numbers_are_finite(client: TestClient, value: str) -> None:
    body = f'{{"seed": 3, "answers": {{"mobility": {value}}}}}'
    answer = client.post(f"{LINKAGE}/grade", content=body, headers={"Content-Type": "application/json"})
    assert answer.status_code == 422
    assert "answers/mobility" in answer.text


def test_a_decimal_comma_is_read(client: TestClient) -> None:
    right = post(client, f"{PATH}/actuators.motor/solution", seed=3)["answers"]
    answers = {name: f" {value:.6f} ".replace(".", ",") for name, value in right.items()}
    grade = post(client, f"{PATH}/actuators.motor/grade", seed=3, answers=answers)
    assert grade["points"] == grade["max_points"]


def test_what_does_not_exist_is_named(client: TestClient) -> None:
    answer = client.post(f"{PATH}/mobility.nothing", json={"seed": 3})
    assert answer.status_code == 404
    assert answer.json()["type"] == "urn:gelenk:unknown-exercise"
    assert "mobility.linkage" in answer.json()["detail"]
    answer = client.post(f"{LINKAGE}/grade", json={"seed": 3, "answers": {"speed": 1.0}})
    assert answer.status_code == 422
    assert "'answers/speed'" in answer.json()["detail"]
    for body in ({}, {"seed": -1}, {"seed": 2**53}, {"seed": 1.5}):
        assert client.post(LINKAGE, json=body).status_code == 422


def test_a_large_body_is_graded_by_a_worker(client: TestClient) -> None:
    answers = RIGHT | {"verdict": "m" * 20_000}
    grade = post(client, f"{LINKAGE}/grade", seed=3, answers=answers)
    assert grade["fields"][2]["mistake"]["code"] == "not_a_choice"


def test_solutions_are_for_teachers() -> None:
    entries, keys = keys_for("read", "teach", "read+write+admin")
    app = application(api_keys=entries)
    path = f"{LINKAGE}/solution"
    assert ask(app, path, "POST", (HOST, bearer(keys["read"]))).status == 403
    refused = ask(app, path, "POST", (HOST, bearer(keys["read+write+admin"])))
    assert refused.problem["missing_scope"] == "teach"
    assert ask(app, path, "POST", (HOST, bearer(keys["teach"]))).status not in {401, 403}
    assert ask(app, LINKAGE, "POST", (HOST, bearer(keys["teach"]))).status == 403
