"""The key of a homework: the right answer to each field of each participant."""

from typing import Any

import numpy as np

from gelenk.sheets.homework import Homework
from gelenk.sheets.table import written

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
