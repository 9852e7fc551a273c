"""When two answers are the same, what is read as one, and which mistakes are offered."""

import math
from collections.abc import Callable
from dataclasses import replace
from functools import partial
from typing import Any

import numpy as np
import pytest

from gelenk.exercises.answer_field import AnswerField, Unreadable
from gelenk.exercises.exercise import Exercise
from gelenk.exercises.fields import BasisField, ChoiceField, MatrixField, NumberField, SetField, VectorField
from gelenk.exercises.grading import graded
from gelenk.exercises.table_field import DhTableField

NUMBER = NumberField(name="x", label="x", unit="m", tolerance=0.01)
ANGLE = NumberField(name="x", label="x", unit="rad", tolerance=0.01, is_angle=True)
VECTOR = VectorField(name="x", label="x", unit="rad", tolerance=0.01, size=2, is_angle=True)
MATRIX = MatrixField(name="x", label="x", tolerance=0.01, rows=2, columns=2)
BASIS = BasisField(name="x", label="x", tolerance=0.01, rows=3, columns=2)
SOLUTIONS = SetField(name="x", label="x", item=VECTOR, points=4.0)
CHOICE = ChoiceField(name="x", label="x", options={"up": "elbow up", "down": "elbow down"})
TABLE = DhTableField(name="x", label="x", tolerance=0.001, slides=(False, True))


def _model(model: Callable[[Any], Any], right: Any, _: None) -> dict[str, Any]:
    return {"x": model(right)}


def exercise(one: AnswerField, right: Any, wrong: dict[str, Callable[[Any], Any]] | None = None) -> Exercise[Any]:
    return Exercise(
        id="poses.test",
        title="A test",
        difficulty=1,
        draw=lambda _: None,
        text=lambda _: "",
        fields=lambda _: (one,),
        solve=lambda _: {"x": right},
        steps=lambda _: (),
        wrong={code: partial(_model, model, right) for code, model in (wrong or {}).items()},
    )


def graded_field(one: AnswerField, right: Any, given: Any, wrong: Any = None) -> tuple[float, str | None]:
    """Points of an answer, and the code of the mistake."""
    (grade,) = graded(exercise(one, right, wrong).variant(0), {"x": given}).fields
    return grade.points, grade.mistake.code if grade.mistake else None


@pytest.mark.parametrize(
    ("one", "right", "given"),
    [
        (NUMBER, 1.0, 1.0099),
        (NUMBER, -1.0, "−1,005"),
        (replace(NUMBER, is_relative=True), 200.0, 201.9),
        (ANGLE, 3.14, -3.14 + 4 * math.pi),
        (VECTOR, [0.1, -3.1], [0.1 - 2 * math.pi, 3.18]),
        (MATRIX, np.eye(2), [[1, 0], ["0,001", 1]]),
        (BASIS, [[1, 0], [0, 1], [0, 0]], [[1, 1], [2, -1], [0, 0]]),
        (CHOICE, "up", "elbow up"),
        (TABLE, [[0.3, 1.5, 0.1, 0], [0.2, 0, 0.5, 0.4]], {"joints": [
            {"a": -0.3, "alpha": -1.5, "d": 0.1, "theta": math.pi},
            {"a": 0.2, "alpha": 0, "d": 0.5, "theta": 0.4 - math.pi},
        ]}),
    ],
)  # fmt: skip
def test_it_is_the_same(one: AnswerField, right: Any, given: Any) -> None:
    assert graded_field(one, right, given) == (1.0, None)


@pytest.mark.parametrize(
    ("one", "right", "given", "code"),
    [
        (NUMBER, 1.0, 1.02, None),
        (NUMBER, 1.0, 1000.0, "thousand_too_large"),
        (NUMBER, 0.0, 0.1, None),
        (ANGLE, 0.5, 28.648, "degrees_for_radians"),
        (replace(ANGLE, unit="°", tolerance=0.5), 60.0, math.pi / 3, "radians_for_degrees"),
        (VECTOR, [0.1, 0.5], [0.5, 0.1], "reversed"),
        (MATRIX, [[1, 2], [3, 4]], [[1, 3], [2, 4]], "transposed"),
        (MATRIX, [[1, 2], [2, 4]], [[1, 2], [2, 5]], None),
        (BASIS, [[1, 0], [0, 1], [0, 0]], [[1, 0], [0, 1], [0, 0.1]], None),
        (BASIS, [[1, 0], [0, 1], [0, 0]], [[1, 2], [1, 2], [0, 0]], None),
        (CHOICE, "up", "down", None),
        (TABLE, [[0.3, 1.5, 0.1, 0], [0.2, 0, 0.5, 0.4]], [[0.3, -1.5, 0.1, 0], [0.2, 0, 0.5, 0.4]], "alpha_sign"),
    ],
)
def test_it_is_another_one(one: AnswerField, right: Any, given: Any, code: str | None) -> None:
    assert graded_field(one, right, given) == (0.0, code)


BRANCHES = [[0.1, 1.6], [1.3, -1.6], [-2.0, 0.4], [3.1, -0.4]]


@pytest.mark.parametrize(
    ("given", "points", "code"),
    [
        ([BRANCHES[2], BRANCHES[0], BRANCHES[1], [3.1 - 2 * math.pi, -0.4]], 4.0, None),
        ([*BRANCHES, BRANCHES[0]], 4.0, None),
        (BRANCHES[:3], 3.0, "solutions_missing"),
        ([*BRANCHES, [0.0, 0.0]], 3.0, "solutions_too_many"),
        ([*BRANCHES[:3], [0.0, 0.0]], 2.0, None),
        ([], 0.0, None),
        ([[-a, -b] for a, b in BRANCHES], 0.0, "sign"),
        ([[2 * a, 2 * b] for a, b in BRANCHES], 0.0, "twice"),
    ],
)
def test_a_set_earns_what_is_in_it(given: Any, points: float, code: str | None) -> None:
    assert graded_field(SOLUTIONS, BRANCHES, given) == (points, code)


@pytest.mark.parametrize(
    ("one", "given"),
    [
        (NUMBER, "about 3"),
        (NUMBER, 10**400),
        (NUMBER, True),
        (VECTOR, 1.0),
        (VECTOR, [1.0]),
        (VECTOR, "12"),
        (MATRIX, [1, 2]),
        (MATRIX, [[1, 2], [3]]),
        (SOLUTIONS, {}),
        (SOLUTIONS, [1.0]),
        (CHOICE, 1),
        (TABLE, [[1, 2, 3, 4]]),
        (TABLE, {"joints": [{"a": 1}, {}]}),
    ],
)
def test_it_is_no_answer(one: AnswerField, given: Any) -> None:
    with pytest.raises(Unreadable):
        one.read(given)


def test_solutions_of_a_wrong_model_that_coincide_count_once() -> None:
    right = [[0.3, math.pi / 2], [0.3 + math.pi, -math.pi / 2]]
    assert graded_field(SOLUTIONS, right, [[0.6, math.pi]]) == (0.0, "twice")


def test_a_wrong_model_is_offered_only_where_it_can_be_told_apart() -> None:
    wrong = {"alpha_sign": lambda x: x + 0.02, "quadrant": lambda x: x + 0.5, "copied_table": lambda x: x + 0.51}
    variant = exercise(NUMBER, 1.0, wrong).variant(0)
    offered = variant.mistakes(variant.fields[0])
    assert not offered.keys() & wrong.keys()  # one next to the right answer, two next to each other
    assert "sign" in offered


def test_other_answers_tell_which_of_two_models_it_was() -> None:
    both = (NUMBER, replace(NUMBER, name="y"))
    one = replace(
        exercise(NUMBER, 1.0),
        fields=lambda _: both,
        solve=lambda _: {"x": 1.0, "y": 1.0},
        wrong={"alpha_sign": lambda _: {"x": 3.0, "y": 5.0}, "quadrant": lambda _: {"x": 3.0, "y": 7.0}},
    ).variant(0)
    told = [
        [grade.mistake and grade.mistake.code for grade in graded(one, {"x": 3.0, "y": y}).fields] for y in (1, 5, 7)
    ]
    assert told == [[None, None], ["alpha_sign", "alpha_sign"], ["quadrant", "quadrant"]]


def test_a_model_of_the_exercise_comes_before_a_general_one() -> None:
    assert graded_field(NUMBER, 1.0, -1.0, {"alpha_sign": lambda x: -x}) == (0.0, "alpha_sign")


def test_a_model_that_does_not_exist_for_some_numbers_is_left_out() -> None:
    wrong = {"quadrant": lambda x: 1.0 / x, "alpha_sign": lambda x: x + 5.0}
    assert graded_field(NUMBER, 0.0, 5.0, wrong) == (0.0, "alpha_sign")
