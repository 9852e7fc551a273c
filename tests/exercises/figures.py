"""How often grading is right: `python -m tests.exercises.figures [variants of each exercise]` prints it.

A variant counts if the oracle agrees. A right answer in another form must earn all points, and nothing may be said
about it. A mistake is what a wrong model answers to a field, the other fields answered by this model too, or rightly if
it does not affect them; what is within the tolerance of the right answer is none. It is named if grading tells its
code: not if it says nothing, nor if it tells that of another model which leads to the same.
"""

import sys
from collections import Counter
from importlib import import_module
from random import Random
from typing import Any

from gelenk.exercises.answer_field import AnswerField
from gelenk.exercises.exercise import Exercise, Variant, exercises
from gelenk.exercises.grading import FieldGrade, graded
from tests.exercises.forms import same, sent

OF_FORMS = 12
"""Variants of each exercise whose answers are given in other forms, and with mistakes."""


def agrees(variant: Variant[Any]) -> bool:
    """Whether the oracle has the same answers, to a fiftieth of the tolerances."""
    solutions = import_module(f"tests.oracles.exercises.{variant.exercise.lecture}").SOLUTIONS
    solution = solutions[variant.exercise.id](variant.numbers)
    return all(
        one.distance(one.read(sent(variant.answers[one.name])), one.read(sent(solution[one.name]))) <= 0.02
        for one in variant.fields
    )


def grade_of(variant: Variant[Any], one: AnswerField, answer: Any) -> FieldGrade:
    return next(grade for grade in graded(variant, {one.name: answer}).fields if grade.name == one.name)


def counted(exercise: Exercise[Any], variants: int) -> Counter[str]:
    """What grading does with the first variants of an exercise."""
    found: Counter[str] = Counter()
    for seed in range(variants):
        variant = exercise.variant(seed)
        found["variants"] += 1
        found["agreed"] += agrees(variant)
        if seed < OF_FORMS:
            found += of_mistakes(variant)
            for one in variant.fields:
                found += of_forms(variant, one, Random(seed))
    return found


def of_forms(variant: Variant[Any], one: AnswerField, random: Random) -> Counter[str]:
    grades = [grade_of(variant, one, form) for form in same(one, sent(variant.answers[one.name]), random)]
    wronged = sum(not grade.correct or grade.mistake is not None for grade in grades)
    return Counter(forms=len(grades), accused=wronged)


def of_mistakes(variant: Variant[Any]) -> Counter[str]:
    found: Counter[str] = Counter()
    for code, answers in variant.wrong.items():
        given = {name: sent(answer) for name, answer in {**variant.answers, **answers}.items()}
        for one, grade in zip(variant.fields, graded(variant, given).fields, strict=True):
            right = variant.answers[one.name]
            if one.distance(answers.get(one.name, right), right) > 1.0:
                found["mistakes"] += 1
                told = grade.mistake and grade.mistake.code
                found["named" if told == code else "another" if told else "silent"] += 1
                found[f"{code} in {variant.exercise.id}"] += told != code
    return found


def main(variants: int) -> None:
    found = sum((counted(one, variants) for one in exercises().values()), Counter[str]())
    print(f"variants solved by service and oracle: {found['agreed']} of {found['variants']}")
    print(f"right answers in other forms: {found['forms']}, accused {found['accused']}")
    print(
        f"mistakes: {found['mistakes']}, named {found['named']} ({found['named'] / found['mistakes']:.2%}), "
        f"another one's name {found['another']}, nothing said {found['silent']}"
    )


if __name__ == "__main__":
    main(int(sys.argv[1]) if len(sys.argv) > 1 else 143)
