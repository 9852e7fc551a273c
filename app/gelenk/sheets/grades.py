"""What a table of answers earns: CSV in, CSV out, with the same secret as the sheets."""

import csv
import io
from collections.abc import Iterator
from typing import Any

from gelenk.errors import InvalidField, TooLarge, UnknownExercise, listed, quoted
from gelenk.exercises.answer_field import AnswerField
from gelenk.exercises.exercise import exercise
from gelenk.exercises.grading import graded
from gelenk.sheets.bounds import MAX_GRADED, MAX_LABEL, MAX_ROWS
from gelenk.sheets.homework import unprotected, variant_of
from gelenk.sheets.key import written

COLUMNS = ("participant", "exercise", "field", "answer")
GRADED = ("participant", "exercise", "field", "points", "max_points", "mistake", "text")
_MOST_CELL = 2000


def grades_table(answers: str, secret: str) -> str:
    """Grade a table of answers, and return points and mistakes: a row for each field of each exercise in it.

    The columns may be in any order and others may stand between them; commas or semicolons separate them.

    Raises:
        InvalidField: A column is missing, or a row has no participant, exercise or field that exists, or repeats one.
        TooLarge: There are too many rows, or too many exercises to grade.
    """
    answers = answers.removeprefix("\ufeff")
    delimiter = ";" if answers.partition("\n")[0].count(";") >= len(COLUMNS) - 1 else ","
    given: dict[tuple[str, str], dict[str, tuple[int, str]]] = {}
    for number, participant, exercise_id, field, answer in _rows(answers, delimiter):
        fields = given.setdefault((participant, exercise_id), {})
        if field in fields:
            raise InvalidField(f"row {number}", f"{quoted(field)} has an answer in row {fields[field][0]} already")
        fields[field] = (number, answer)
        if len(given) > MAX_GRADED:
            raise TooLarge("exercises to grade", len(given), MAX_GRADED)
    return written(GRADED, (row for who, fields in given.items() for row in _graded(*who, fields, secret)), delimiter)


def _rows(answers: str, delimiter: str) -> Iterator[tuple[int, str, str, str, str]]:
    """Yield the rows with their numbers, the head being row 1; empty ones are skipped."""
    try:
        reader = csv.reader(io.StringIO(answers, newline=""), delimiter=delimiter, strict=True)
        head = [name.strip().lower() for name in next(reader, [])]
        if missing := [name for name in COLUMNS if name not in head]:
            raise InvalidField("row 1", f"there is no column {missing[0]!r}; the columns are {', '.join(COLUMNS)}")
        places = [head.index(name) for name in COLUMNS]
        for number, row in enumerate(reader, 2):
            if number > MAX_ROWS + 1:
                raise TooLarge("rows of the table", number - 1, MAX_ROWS)
            if any(cell.strip() for cell in row):
                participant, exercise_id, field, answer = (row[i] if i < len(row) else "" for i in places)
                yield number, _participant(number, participant), exercise_id.strip(), field.strip(), answer[:_MOST_CELL]
    except csv.Error as error:
        raise InvalidField("csv", f"this is no CSV: {error}") from None


def _participant(number: int, text: str) -> str:
    label = unprotected(text)
    if not 0 < len(label) <= MAX_LABEL or not label.isprintable():
        raise InvalidField(f"row {number}", f"the participant must have 1 to {MAX_LABEL} characters")
    return label


def _graded(
    participant: str, exercise_id: str, fields: dict[str, tuple[int, str]], secret: str
) -> Iterator[tuple[object, ...]]:
    first = next(iter(fields.values()))[0]
    try:
        variant = variant_of(secret, participant, exercise(exercise_id))
    except UnknownExercise as error:
        raise InvalidField(f"row {first}", error.detail) from None
    known = {one.name: one for one in variant.fields}
    for name, (number, _answer) in fields.items():
        if name not in known:
            reason = f"{quoted(exercise_id)} has no field {quoted(name)}; it has {listed(tuple(known))}"
            raise InvalidField(f"row {number}", reason)
    grade = graded(variant, {name: _read(known[name], answer) for name, (_number, answer) in fields.items()})
    for one in grade.fields:
        mistake = ("", "") if one.mistake is None else (one.mistake.code, one.mistake.text)
        yield participant, exercise_id, one.name, one.points, known[one.name].points, *mistake


def _read(one: AnswerField, text: str) -> Any:
    """Return an answer as the grades take it; brackets and commas between numbers are read as well."""
    depth = len(one.shape()) + (one.kind == "set")
    text = unprotected(text)
    if depth == 0 or one.choices() or not text:
        return text
    rows = [_numbers(row) for row in text.strip("[]()").replace("],", ";").replace("),", ";").split(";")]
    if depth == 1:
        return [number for row in rows for number in row]
    return [row for row in rows if row]


def _numbers(text: str) -> list[str]:
    """Return the numbers of a row: separated by spaces, or by commas where there is a point or a space as well."""
    text = text.strip(" []()\t\n")
    return text.replace(", ", " ").split() if " " in text or "." not in text else text.replace(",", " ").split()
