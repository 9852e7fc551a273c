"""Tables of texts as CSV, in which no cell is a formula to a spreadsheet."""

import csv
import io
import math
from collections.abc import Iterable, Sequence

from gelenk.sheets.homework import FORMULA_SIGNS


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
