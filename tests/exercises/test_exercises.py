"""All exercises: right answers are right in every form, mistakes get their names, numbers stay the same for ever."""

import hashlib
import pkgutil
import re
from collections import Counter
from importlib import import_module
from random import Random
from typing import Any

import pytest

from gelenk.exercises import mistakes
from gelenk.exercises.exercise import LECTURES, Exercise, Variant, exercises
from gelenk.exercises.grading import graded
from gelenk.exercises.mistakes.catalogue import catalogue
from gelenk.exercises.mistakes.general import OF_FORM
from gelenk.language import language
from tests.exercises.figures import OF_FORMS, counted
from tests.exercises.forms import same, sent

EXERCISES = list(exercises().values())
IDS = [one.id for one in EXERCISES]
each = pytest.mark.parametrize("exercise", EXERCISES, ids=IDS)
QUICK = 20
MANY = 10
"""Ten thousand in all are tried by `python -m tests.exercises.figures 150`."""


def oracle(exercise: Exercise[Any]) -> Any:
    return import_module(f"tests.oracles.exercises.{exercise.lecture}")


def leaves(numbers: Any) -> list[Any]:
    return [leaf for one in numbers for leaf in leaves(one)] if isinstance(numbers, tuple) else [numbers]


def check(exercise: Exercise[Any], seed: int) -> set[str]:
    """Check one variant, and return the codes of the mistakes that it offers."""
    variant, random = exercise.variant(seed), Random(seed)
    right = {name: sent(answer) for name, answer in variant.answers.items()}
    grade = graded(variant, right)
    assert grade.points == grade.max_points
    for one in variant.fields:
        for form in same(one, right[one.name], random):
            assert graded(variant, {**right, one.name: form}).points == grade.max_points, (one.name, form)
    return check_mistakes(variant, right) | check_oracle(variant)


def check_mistakes(variant: Variant[Any], right: dict[str, Any]) -> set[str]:
    found = set()
    for i, one in enumerate(variant.fields):
        for code, wrong in variant.mistakes(one).items():
            told = graded(variant, {**right, one.name: sent(wrong)}).fields[i]
            assert not told.correct
            assert told.mistake is not None
            assert told.mistake.code == code
            found.add(code)
    return found


def check_oracle(variant: Variant[Any]) -> set[str]:
    solution = oracle(variant.exercise).SOLUTIONS[variant.exercise.id](variant.numbers)
    assert solution.keys() == variant.answers.keys() == {one.name for one in variant.fields}
    for one in variant.fields:
        expected = one.read(sent(solution[one.name]))
        assert one.distance(one.read(sent(variant.answers[one.name])), expected) <= 0.02, one.name
    return set()


@pytest.mark.quick(1)
@each
def test_variants_are_graded_as_they_should_be(exercise: Exercise[Any]) -> None:
    offered = set().union(*(check(exercise, seed) for seed in range(QUICK)))
    assert exercise.wrong.keys() <= offered


@pytest.mark.slow
@each
def test_many_variants_are_graded_as_they_should_be(exercise: Exercise[Any]) -> None:
    for seed in range(QUICK, QUICK + MANY):
        check(exercise, seed)


@pytest.mark.slow
def test_grading_is_right_as_often_as_the_page_says() -> None:
    found = sum((counted(one, OF_FORMS) for one in EXERCISES), Counter[str]())
    assert found["agreed"] == found["variants"]
    assert found["forms"] >= 5000
    assert found["mistakes"] >= 2000
    assert (found["accused"], found["another"]) == (0, 0)
    assert found["named"] >= 0.97 * found["mistakes"]


@each
def test_numbers_are_the_same_for_ever(exercise: Exercise[Any]) -> None:
    digest = hashlib.sha256(repr(tuple(leaves(exercise.variant(1).numbers))).encode()).hexdigest()[:16]
    assert oracle(exercise).DIGESTS.get(f"{exercise.id}:{exercise.version}") == digest


@each
def test_the_text_has_all_numbers(exercise: Exercise[Any]) -> None:
    if exercise.picture is not None:
        return
    for seed in range(QUICK):
        numbers = exercise.variant(seed).numbers
        written = set(re.findall(r"\d+(?:\.\d+)?(?:e-?\d+)?", exercise.text(numbers)))
        numeric = {f"{abs(leaf):.12g}" for leaf in leaves(numbers) if isinstance(leaf, int | float)}
        assert numeric <= written


@each
def test_german_has_decimal_commas(exercise: Exercise[Any]) -> None:
    """In the text, the same numbers; in the formulas of the solution {,}, which sets no space."""
    numbers = exercise.variant(1).numbers
    with language("de"):
        text, steps = exercise.text(numbers), exercise.steps(numbers)
    formulas = [line for step in steps for line in (step.text, *step.latex, *step.plain)]
    assert not re.search(r"\d\.\d", " ".join((text, *formulas)))
    english = re.findall(r"\d+\.\d+", exercise.text(numbers))
    assert sorted(re.findall(r"\d+,\d+", text)) == sorted(one.replace(".", ",") for one in english)


def test_mistakes_of_two_lectures_have_different_codes() -> None:
    modules = [
        import_module(f"gelenk.exercises.mistakes.{one.name}") for one in pkgutil.iter_modules(mistakes.__path__)
    ]
    assert sum(len(getattr(one, "MISTAKES", ())) for one in modules) == len(catalogue())


@each
def test_it_is_described(exercise: Exercise[Any]) -> None:
    assert re.fullmatch(r"[a-z_]+\.[a-z0-9_]+", exercise.id)
    assert exercise.lecture in LECTURES
    assert 1 <= exercise.difficulty <= 5
    numbers = exercise.variant(0).numbers
    steps = exercise.steps(numbers)
    assert all(one.title and one.text and one.latex for one in steps)
    names = [one.name for one in exercise.fields(numbers)]
    assert len(set(names)) == len(names)


def test_every_mistake_has_a_text_and_is_made_somewhere() -> None:
    made = {code for one in EXERCISES for code in one.wrong}
    for one in EXERCISES:
        for seed in range(5):
            variant = one.variant(seed)
            made |= {code for field in variant.fields for code, _ in field.slips(variant.answers[field.name])}
    assert made <= catalogue().keys()
    assert catalogue().keys() - made - OF_FORM.keys() <= {"radians_for_degrees", "transposed"}
    assert len(catalogue()) >= 40
