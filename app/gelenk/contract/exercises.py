"""Exercises of the course: their list, variants, solutions and grades; the list of its pictures."""

import sys
from typing import Annotated, Any

from pydantic import Field, JsonValue, model_validator

from gelenk.contract.common import Answer
from gelenk.contract.options import InLanguage
from gelenk.course.steps import Step
from gelenk.errors import InvalidField

MAX_SEED = 2**53 - 1
MAX_ANSWERS = 64

FieldName = Annotated[str, Field(min_length=1, max_length=64)]


class ExerciseInfo(Answer):
    """An exercise as the list shows it."""

    id: str = Field(description="Its name in paths: `lecture.name`.")
    lecture: str = Field(description="The lecture that it belongs to.")
    title: str = Field(description="In the requested language.")
    difficulty: int = Field(ge=1, le=5, description="From 1, a single formula, to 5, an exam; no unit.")
    version: int = Field(description="Raised when a seed gives another variant than before; no unit.")


class ExerciseList(Answer):
    """The exercises of the course."""

    exercises: list[ExerciseInfo]


class ExerciseRequest(InLanguage):
    """Chooses a variant of an exercise."""

    seed: int = Field(ge=0, le=MAX_SEED, description="Number of the variant; no unit.")


class ExerciseChoice(Answer):
    """A word to choose."""

    value: str = Field(description="The word to answer.")
    text: str = Field(description="What it means, in the requested language.")


class ExerciseField(Answer):
    """An answer that the exercise wants."""

    name: str = Field(description="Its name in `answers`.")
    kind: str = Field(
        description="`number`, `vector`, `matrix`, `choice`, `set` of solutions, `dh_table`, or `basis` of a space, a "
        "matrix with its vectors as columns."
    )
    label: str = Field(description="What it asks for, in the requested language.")
    unit: str | None = Field(description="Of its numbers; null without one.")
    tolerance: float = Field(description="How far an answer may be from the right one, in its unit, or as a share.")
    is_relative: bool = Field(description="Whether the tolerance is a share of the right answer's largest number.")
    points: float = Field(description="What it is worth; no unit.")
    shape: list[int] = Field(description="Of an array, or of each solution of a set; empty for anything else.")
    choices: list[ExerciseChoice] = Field(description="The words to choose from; empty for anything else.")


class ExerciseVariant(Answer):
    """An exercise with its numbers."""

    id: str = Field(description="Of the exercise.")
    version: int = Field(description="Of the exercise; no unit.")
    text: str = Field(description="The task, in plain text; an empty line ends a paragraph.")
    picture: str | None = Field(description="An SVG, or null.")
    fields: list[ExerciseField]
    hints: list[str] = Field(description="What the worked solution does, step by step, without its numbers.")


class ExerciseSolution(Answer):
    """The right answers to a variant."""

    id: str = Field(description="Of the exercise.")
    version: int = Field(description="Of the exercise; no unit.")
    answers: dict[str, Any] = Field(description="By field: a number, a word, a list or a table, as in a request.")
    steps: list[Step] = Field(description="The worked solution.")


class ExerciseGradeRequest(ExerciseRequest):
    """Answers to a variant."""

    answers: Annotated[dict[FieldName, JsonValue], Field(max_length=MAX_ANSWERS)] = Field(
        description="By field; a field that is left out earns nothing. Numbers may be strings too, with a decimal "
        "point or comma."
    )

    @model_validator(mode="after")
    def _finite(self) -> "ExerciseGradeRequest":
        """Refuse what is not a number by its name; a text that is none only earns nothing."""
        for name, answer in self.answers.items():
            if not _is_finite(answer):
                raise InvalidField(f"answers/{name}", "its numbers must be finite")
        return self


def _is_finite(value: JsonValue) -> bool:
    if isinstance(value, int | float):
        return abs(value) <= sys.float_info.max
    inner = value.values() if isinstance(value, dict) else value if isinstance(value, list) else ()
    return all(map(_is_finite, inner))


class MistakeInfo(Answer):
    """A recognized mistake."""

    code: str = Field(description="The same in all languages.")
    text: str = Field(description="What is wrong, in the requested language.")


class ExerciseFieldGrade(Answer):
    """What the answer to one field earns."""

    name: str = Field(description="Of the field.")
    correct: bool = Field(description="Whether the whole answer is right, in whatever form.")
    points: float = Field(description="What the answer earns; a set of solutions may earn a part. No unit.")
    mistake: MistakeInfo | None = Field(description="The mistake that leads to this answer; null if none is known.")


class ExerciseGrade(Answer):
    """The grade of all answers."""

    id: str = Field(description="Of the exercise.")
    version: int = Field(description="Of the exercise; no unit.")
    points: float = Field(description="Of all fields together; no unit.")
    max_points: float = Field(description="What they are worth; no unit.")
    fields: list[ExerciseFieldGrade]


class CoursePicture(Answer):
    """A picture that explains something of the course."""

    name: str = Field(description="In the path of the picture.")
    title: str = Field(description="In the language asked for.")


class CoursePictures(Answer):
    """All pictures of the course."""

    pictures: list[CoursePicture] = Field(description="By name.")
