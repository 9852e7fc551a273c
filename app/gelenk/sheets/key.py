"""The key of a homework: the right answer to each field of each participant, as CSV; in it no cell is a formula."""

import csv
import io
import math
from collections.abc import Iterable, Sequence
from typing import Any

import numpy as np

from gelenk.sheets.homework import FORMULA_SIGNS, Homework


def written(columns: Sequence[str], rows: Iterable[Sequence[object]], delimiter: str = ",") -> str:
    """Return a table (RFC 4180); a text that a spreadsheet would compute begins with an apostrophe."""
    file = io.StringIO()
    writer = csv.writer(file, delimiter=delimiter)
    writer.writerow(columns)
    writer.writerows([_safe(cell) for cell in row] for row in rows)
    return file.getvalue()


def _safe(cell: object) -> str:
    text = f"{cell:.12g}" if isinstance(cell, float) else str(cell)
    return f"'{text}" if text.startswith(FORMULA_SIGNS) and not _is_number(text) else text


def _is_number(text: str) -> bool:
    try:
        return math.isfinite(float(text))
    except ValueError:
        return False


COLUMNS = ("participant", "exercise", "version", "field", "answer", "unit")


def key_table(homework: Homework) -> str:
    """Return the right answers as CSV, written as grading reads them."""
    rows = (
        (
            sheet.participant,
            one.exercise.id,
            one.exercise.version,
            field.name,
            cell(one.answers[field.name]),
            field.unit,
        )
        for sheet in homework.sheets
        for one in sheet.variants
        for field in one.fields
    )
    return written(COLUMNS, rows)


def cell(answer: Any) -> str:
    """Return an answer in one cell: numbers separated by spaces, rows and solutions by semicolons."""
    if isinstance(answer, str):
        return answer
    if np.ndim(answer) == 0:
        return f"{float(answer):.12g}"
    return ("; " if np.ndim(answer[0]) else " ").join(cell(one) for one in answer)
