"""The columns of a DH table, for the symbolic side too, which does without NumPy."""

from typing import Literal, TypeAlias

Column: TypeAlias = Literal["a", "alpha", "d", "theta"]

COLUMNS: tuple[Column, ...] = ("a", "alpha", "d", "theta")
