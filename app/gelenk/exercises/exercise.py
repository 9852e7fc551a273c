"""An exercise: one small declaration, from which variants, solutions and grades are made.

All of them, in the order of the course: those of each module in `lectures` and in the folders below it.
"""

import pkgutil
from collections.abc import Callable, Mapping, Sequence
from dataclasses import dataclass, field
from functools import cache, cached_property, lru_cache
from importlib import import_module
from typing import TYPE_CHECKING, Any, Generic, TypeAlias, TypeVar

from gelenk.course.steps import Step
from gelenk.errors import UnknownExercise
from gelenk.exercises import lectures
from gelenk.exercises.answer_field import AnswerField
from gelenk.exercises.draw import Draw
from gelenk.language import Language, current_language

if TYPE_CHECKING:
    from matplotlib.figure import Figure


N = TypeVar("N")
Answers: TypeAlias = Mapping[str, Any]

_MOST_DRAWS = 1000
_FROM_RIGHT, _FROM_OTHERS = 3.0, 2.0
"""Distances in tolerances up to which a wrong answer might be taken for the right one, and for another wrong one."""


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
        wrong: Wrong models by the code of the mistake: each returns its answer to those fields that it affects, or the
            numbers that are solved in place of the right ones.
        picture: Draws the task, if it has a picture.
        sketch: Draws what is the same for all variants in a language; it is drawn once.
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
    wrong: Mapping[str, Callable[[N], Answers | N]] = field(default_factory=dict)
    picture: "Callable[[N], Figure] | None" = None
    sketch: "Callable[[], Figure] | None" = None

    @property
    def is_drawn(self) -> bool:
        """Whether it has a picture."""
        return self.picture is not None or self.sketch is not None

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
    def steps(self) -> tuple[Step, ...]:
        """The worked solution."""
        return tuple(self.exercise.steps(self.numbers))

    @cached_property
    def svg(self) -> bytes | None:
        """The picture of the task, if it has one."""
        if self.exercise.sketch is not None:
            return _sketched(self.exercise.sketch, current_language())
        return None if self.exercise.picture is None else _as_svg(self.exercise.picture(self.numbers))

    @cached_property
    def wrong(self) -> dict[str, Answers]:
        """Answers of the wrong models, those left out that do not exist for these numbers."""
        found = {}
        for code, model in self.exercise.wrong.items():
            try:
                answers = model(self.numbers)
                found[code] = answers if isinstance(answers, Mapping) else self.exercise.solve(answers)
            except (ArithmeticError, ValueError):
                continue
        return found

    def wrong_answers(self, one: AnswerField) -> dict[str, Any]:
        """Return what all mistakes answer to a field, by code: the exercise's own, then general ones."""
        special = {code: answers[one.name] for code, answers in self.wrong.items() if one.name in answers}
        return special | {code: answer for code, answer in one.slips(self.answers[one.name]) if code not in special}

    def models(self, one: AnswerField, answer: Any) -> dict[str, float]:
        """Return the wrong models that lead to a wrong answer, each with its distance from it in tolerances.

        A model whose answer might be taken for the right one is none. The exercise's own models come first: if one of
        them leads to the answer, the general ones do not count, which may have the same cause.
        """
        apart = ((code, other, one.distance(answer, other)) for code, other in self.wrong_answers(one).items())
        near = {code: distance for code, other, distance in apart if distance <= 1.0 and self._is_wrong(one, other)}
        return {code: distance for code, distance in near.items() if code in self.exercise.wrong} or near

    def _is_wrong(self, one: AnswerField, answer: Any) -> bool:
        return _distance(one, answer, self.answers[one.name]) > _FROM_RIGHT

    def _is_clear(self, one: AnswerField, code: str, wrong: Mapping[str, Any]) -> bool:
        own = self.exercise.wrong
        others = [answer for name, answer in wrong.items() if name != code and (name in own or code not in own)]
        is_alone = all(_distance(one, wrong[code], other) > _FROM_OTHERS for other in others)
        return is_alone and self._is_wrong(one, wrong[code])

    def mistakes(self, one: AnswerField) -> dict[str, Any]:
        """Return the wrong answers to a field that can be told from the right one and from all others, by code."""
        wrong = self.wrong_answers(one)
        return {code: answer for code, answer in wrong.items() if self._is_clear(one, code, wrong)}


@lru_cache(maxsize=64)
def _sketched(sketch: "Callable[[], Figure]", _language: Language) -> bytes:
    return _as_svg(sketch())


def _as_svg(figure: "Figure") -> bytes:
    from gelenk.plots.figure import as_bytes  # noqa: PLC0415

    return as_bytes(figure, "svg")


def _distance(one: AnswerField, answer: Any, other: Any) -> float:
    return min(one.distance(answer, other), one.distance(other, answer))


LECTURES = (
    "mobility",
    "actuators",
    "poses",
    "dh_tables",
    "inverse_kinematics",
    "velocities",
    "statics",
    "manipulability",
    "trajectories",
    "workspaces",
    "dynamics",
)
"""The course; a lecture of one's own follows these."""


@cache
def exercises() -> dict[str, Exercise[Any]]:
    """Return all exercises by id, by lectures in the order of the course, the easier ones first."""
    names = (module.name for module in pkgutil.walk_packages(lectures.__path__, f"{lectures.__name__}."))
    found = [one for name in names for one in vars(import_module(name)).values() if isinstance(one, Exercise)]
    return {one.id: one for one in sorted(found, key=_place)}


def _place(one: Exercise[Any]) -> tuple[int, str, int, str]:
    known = LECTURES.index(one.lecture) if one.lecture in LECTURES else len(LECTURES)
    return known, one.lecture, one.difficulty, one.id


def exercise(name: str) -> Exercise[Any]:
    """Return an exercise by its id; raises UnknownExercise."""
    found = exercises().get(name)
    if found is None:
        raise UnknownExercise(name, tuple(exercises()))
    return found
