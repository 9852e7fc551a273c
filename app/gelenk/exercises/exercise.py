"""An exercise: one small declaration, from which variants, solutions and grades are made."""

from collections.abc import Callable, Mapping, Sequence
from dataclasses import dataclass, field
from functools import cached_property
from typing import Any, Generic, TypeAlias, TypeVar

from matplotlib.figure import Figure

from gelenk.course.steps import Step
from gelenk.exercises.answer_field import AnswerField
from gelenk.exercises.draw import Draw

N = TypeVar("N")
Answers: TypeAlias = Mapping[str, Any]

_MOST_DRAWS = 1000
_APART = 10.0
"""Distance between answers, in tolerances, up to which one might be taken for the other."""


@dataclass(frozen=True, slots=True, kw_only=True)
class Exercise(Generic[N]):
    """What a lecturer writes.

    The functions take the numbers of a variant, and return texts in the current language.

    Attributes:
        id: `lecture.name`.
        version: To be raised when the same seed would give other numbers or other answers than before.
        title: Marked for translation.
        difficulty: From 1, a single formula, to 5, an exam.
        draw: Returns the numbers of a variant.
        is_degenerate: Whether numbers are of no use, so that others are drawn.
        text: Returns the task, with all numbers that the solution needs.
        fields: Returns what is asked for.
        solve: Returns the right answer to each field, computed by the core.
        steps: Returns the worked solution.
        wrong: Wrong models by the code of the mistake: each returns its answer to those fields that it affects.
        picture: Draws the task, if it has a picture.
    """

    id: str
    version: int = 1
    title: str
    difficulty: int
    draw: Callable[[Draw], N]
    is_degenerate: Callable[[N], bool] = lambda _: False
    text: Callable[[N], str]
    fields: Callable[[N], Sequence[AnswerField]]
    solve: Callable[[N], Answers]
    steps: Callable[[N], Sequence[Step]]
    wrong: Mapping[str, Callable[[N], Answers]] = field(default_factory=dict)
    picture: Callable[[N], Figure] | None = None

    @property
    def lecture(self) -> str:
        """The lecture that it belongs to."""
        return self.id.partition(".")[0]

    def variant(self, seed: int) -> "Variant[N]":
        """Return the variant of a seed, the same for ever; degenerate numbers are drawn again."""
        source = Draw(f"{self.id}:{self.version}:{seed}")
        numbers = next(one for _ in range(_MOST_DRAWS) if not self.is_degenerate(one := self.draw(source)))
        return Variant(self, numbers)


@dataclass(frozen=True)
class Variant(Generic[N]):
    """An exercise with its numbers."""

    exercise: Exercise[N]
    numbers: N

    @cached_property
    def answers(self) -> Answers:
        """Right answer to each field."""
        return self.exercise.solve(self.numbers)

    @cached_property
    def fields(self) -> tuple[AnswerField, ...]:
        """What is asked for."""
        return tuple(self.exercise.fields(self.numbers))

    @cached_property
    def wrong(self) -> dict[str, Answers]:
        """Answers of the wrong models, those left out that do not exist for these numbers."""
        found = {}
        for code, model in self.exercise.wrong.items():
            try:
                found[code] = model(self.numbers)
            except (ArithmeticError, ValueError):
                continue
        return found

    def mistakes(self, one: AnswerField) -> dict[str, Any]:
        """Return the wrong answers to a field that can be told from the right one and from each other, by code.

        The exercise's own models come first: a general one that gives the same answer as one of them is left out.
        """
        right = self.answers[one.name]
        special = {code: answers[one.name] for code, answers in self.wrong.items() if one.name in answers}
        general = {code: answer for code, answer in one.slips(right) if code not in special}
        return {
            **_distinct(one, special, [right]),
            **_distinct(one, general, [right, *special.values()]),
        }


def _distinct(one: AnswerField, wrong: Mapping[str, Any], others: Sequence[Any]) -> dict[str, Any]:
    """Return the answers that are far from all others, and from each other."""
    return {
        code: answer
        for code, answer in wrong.items()
        if all(_are_apart(one, answer, other) for other in others)
        and all(_are_apart(one, answer, other) for name, other in wrong.items() if name != code)
    }


def _are_apart(one: AnswerField, answer: Any, other: Any) -> bool:
    return min(one.distance(answer, other), one.distance(other, answer)) > _APART
