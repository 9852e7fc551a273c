"""The rows of a DH table in LaTeX, with the columns in any order."""

from collections.abc import Mapping, Sequence
from typing import Literal, TypeAlias

from gelenk.course.steps import table

Column: TypeAlias = Literal["a", "alpha", "d", "theta"]

COLUMNS: tuple[Column, ...] = ("a", "alpha", "d", "theta")
_HEADS = {"a": "a", "alpha": r"\alpha", "d": "d", "theta": r"\vartheta"}


def array_of(rows: Sequence[Mapping[Column, str]], link: str, columns: Sequence[Column], first: int = 1) -> str:
    """Return a table of cells in LaTeX; `link` is the index of a and α, `first` that of the first row."""
    heads = [rf"{_HEADS[column]}_{{{link if column in ('a', 'alpha') else 'i'}}}" for column in columns]
    lines = ((str(i), *(row[column] for column in columns)) for i, row in enumerate(rows, start=first))
    return table(("i", *heads), lines, "c|cccc")
