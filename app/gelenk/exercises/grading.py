"""Grades: the right answer first, in all its forms, then the wrong models, else nothing is said."""

from collections.abc import Mapping
from dataclasses import dataclass
from typing import Any

from gelenk.errors import InvalidField, listed, quoted
from gelenk.exercises.answer_field import AnswerField, Unreadable
from gelenk.exercises.exercise import Variant
from gelenk.exercises.fields import SetField
from gelenk.exercises.mistakes.catalogue import Mistake, mistake


@dataclass(frozen=True, slots=True)
class FieldGrade:
    """What a field earns, and the mistake that explains its answer, if one does."""

    name: str
    points: float
    correct: bool
    mistake: Mistake | None = None


@dataclass(frozen=True, slots=True)
class Grade:
    """The grade of all fields."""

    max_points: float
    fields: tuple[FieldGrade, ...]

    @property
    def points(self) -> float:
        """Points of all fields together."""
        return sum(one.points for one in self.fields)


def graded(variant: Variant[Any], answers: Mapping[str, Any]) -> Grade:
    """Grade the answers to a variant; a field without one earns nothing. Raises InvalidField for an unknown field."""
    names = tuple(one.name for one in variant.fields)
    if unknown := [name for name in answers if name not in names]:
        raise InvalidField(f"answers/{unknown[0]}", f"there is no field {quoted(unknown[0])}; it has {listed(names)}")
    grades = tuple(_graded(variant, one, answers.get(one.name)) for one in variant.fields)
    return Grade(sum(one.points for one in variant.fields), grades)


def _graded(variant: Variant[Any], one: AnswerField, given: Any) -> FieldGrade:
    if given is None or given == "":
        return FieldGrade(one.name, 0.0, False, mistake("missing"))
    try:
        answer = one.read(given)
    except Unreadable as error:
        return FieldGrade(one.name, 0.0, False, error.mistake)
    right = variant.answers[one.name]
    share = one.share(answer, right)
    if share == 1.0:
        return FieldGrade(one.name, one.points, True)
    wrong = variant.wrong_answers(one)
    for code, other in wrong.items():
        if one.distance(answer, other) <= 1.0 and variant.is_clear(one, code, wrong):
            return FieldGrade(one.name, share * one.points, False, mistake(code))
    incomplete = one.incomplete(answer, right) if isinstance(one, SetField) else None
    return FieldGrade(one.name, share * one.points, False, incomplete)
