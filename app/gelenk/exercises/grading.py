"""Grades: the right answer first, in all its forms, then the wrong models, else nothing is said.

If several models lead to an answer, the one counts that explains most of the other answers as well.
"""

from collections import Counter
from collections.abc import Mapping
from dataclasses import dataclass
from typing import Any

from gelenk.errors import InvalidField, listed, quoted
from gelenk.exercises.answer_field import AnswerField, Unreadable
from gelenk.exercises.exercise import Variant
from gelenk.exercises.fields import SetField
from gelenk.exercises.mistakes.catalogue import Mistake, mistake

_NEARER = 0.25
"""Tolerances by which a wrong model must be nearer to an answer than another one."""


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
    given = {one.name: _read(one, answers.get(one.name)) for one in variant.fields}
    models = {
        one.name: {} if isinstance(answer, Mistake) else variant.models(one, answer)
        for one, answer in zip(variant.fields, given.values(), strict=True)
    }
    explained = Counter(code for found in models.values() for code in found)
    grades = (_graded(variant, one, given[one.name], _likeliest(models[one.name], explained)) for one in variant.fields)
    return Grade(sum(one.points for one in variant.fields), tuple(grades))


def _read(one: AnswerField, given: Any) -> Any:
    """Return an answer, or what is wrong about its form."""
    if given is None or given == "":
        return mistake("missing")
    try:
        return one.read(given)
    except Unreadable as error:
        return error.mistake


def _likeliest(models: Mapping[str, float], explained: Mapping[str, int]) -> str | None:
    """Return the model that explains the most fields and then is the nearest; None if two are as good."""
    ranked = sorted((-explained[code], distance, code) for code, distance in models.items())
    if not ranked or (len(ranked) > 1 and ranked[1][0] == ranked[0][0] and ranked[1][1] - ranked[0][1] < _NEARER):
        return None
    return ranked[0][2]


def _graded(variant: Variant[Any], one: AnswerField, answer: Any, code: str | None) -> FieldGrade:
    if isinstance(answer, Mistake):
        return FieldGrade(one.name, 0.0, False, answer)
    right = variant.answers[one.name]
    share = one.share(answer, right)
    if share == 1.0:
        return FieldGrade(one.name, one.points, True)
    if code is not None:
        return FieldGrade(one.name, share * one.points, False, mistake(code))
    incomplete = one.incomplete(answer, right) if isinstance(one, SetField) else None
    return FieldGrade(one.name, share * one.points, False, incomplete)
