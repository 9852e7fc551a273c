"""Formulas as payloads, in LaTeX and in plain text."""

from pydantic import Field

from gelenk.contract.common import Answer

Grid = list[list[float]]


class FormulaInfo(Answer):
    """A formula in both notations."""

    latex: str = Field(description="For KaTeX or LaTeX with amsmath.")
    plain: str = Field(description="An expression of Python and of most computer algebra systems.")


class MatrixInfo(Answer):
    """A matrix; null if an entry has too many terms to write out."""

    name: str = Field(description="Such as `T_base_tool`.")
    latex: str | None = Field(description="The whole matrix, for KaTeX or for LaTeX with amsmath.")
    plain: list[list[str]] | None = Field(description="Entry by entry, row by row.")
