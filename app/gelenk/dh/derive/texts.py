"""Input and output of the symbolic part of a worked solution: plain data, fit for another process."""

from dataclasses import dataclass
from typing import TypeAlias

from gelenk.dh.derive.jacobian import Block, Setting
from gelenk.dh.derive.singular import Kind
from gelenk.dh.derive.table import TableNumbers
from gelenk.dh.derive.typeset import MatrixText, Style, Text

Configuration: TypeAlias = tuple[float, ...]
Grid: TypeAlias = list[list[float]]


@dataclass(frozen=True, slots=True)
class SymbolicRequest:
    """The request as plain data.

    Attributes:
        table: The table.
        style: `short` for c_{12}, `full` for cos(q_1 + q_2).
        keeps_symbols: Whether lengths stay symbols; otherwise the formulas contain their values.
        samples: Configurations at which the formulas are also evaluated, [rad or m].
    """

    table: TableNumbers
    style: Style
    keeps_symbols: bool
    samples: tuple[Configuration, ...]


@dataclass(frozen=True, slots=True)
class SymbolEntry:
    """A symbol and its meaning: a value, or words."""

    symbol: Text
    meaning: Text
    value: float | None


@dataclass(frozen=True, slots=True)
class ColumnText:
    """A column of the Jacobian, each part with three entries; `arm` is None for a prismatic joint."""

    axis: MatrixText
    arm: MatrixText | None
    linear: MatrixText
    angular: MatrixText


@dataclass(frozen=True, slots=True)
class Values:
    """All matrices at one sample."""

    rows: list[Grid]
    frames: list[Grid | None]
    tip: Grid | None
    jacobian: Grid | None


@dataclass(frozen=True, slots=True)
class Formulas:
    """Transforms and Jacobian as text.

    Attributes:
        as_read: The numbers that the formulas stand for.
        remarks: Notes on numbers that were read as something else.
        legend: All symbols in order of appearance.
        parameters: a, alpha, d, theta of each row.
        rows: A_1 … A_n; None for one that failed its check.
        frames: T_0_1 … T_0_n; None for one that is too long.
        tip: T_base_tool; None if it is too long.
        chain: Position of the tip in each frame, from n to 0, from right to left; None if one is too long.
        position: Position of the tip, three entries.
        rotation: Rotation of the tip.
        columns: Columns of the Jacobian in the base's axes; None if the tip is too long.
        jacobian: All columns as a matrix.
        values: Values at each sample.
    """

    as_read: TableNumbers
    remarks: tuple[str, ...]
    legend: list[SymbolEntry]
    parameters: list[tuple[Text, Text, Text, Text]]
    rows: list[MatrixText | None]
    frames: list[MatrixText | None]
    tip: MatrixText | None
    chain: list[MatrixText] | None
    position: MatrixText | None
    rotation: MatrixText | None
    columns: list[ColumnText] | None
    jacobian: MatrixText | None
    values: list[Values]


@dataclass(frozen=True, slots=True)
class SolutionText:
    """A value of a variable, or of a sum of variables, at which a factor vanishes."""

    variables: tuple[int, ...]
    variable: Text
    formula: Text
    value: float


@dataclass(frozen=True, slots=True)
class ConditionText:
    """A factor that vanishes at singular configurations."""

    kind: Kind
    factor: Text
    solutions: list[SolutionText]
    example: Configuration | None


@dataclass(frozen=True, slots=True)
class Singularities:
    """The determinant of the square block and where it vanishes.

    Attributes:
        block: The block; None if none is square.
        setting: How its determinant was computed; None if it was not.
        legend: Symbols beyond those of the formulas.
        formula: The determinant as a product; None without a block, or if it is too long.
        factors: Factors of the product, besides its number.
        conditions: One per factor that depends on a joint.
        values: Values of the determinant at each sample.
        sizes: Sizes of the terms that add up to these values.
    """

    block: Block | None
    setting: Setting | None
    legend: list[SymbolEntry]
    formula: Text | None
    factors: list[Text]
    conditions: list[ConditionText]
    values: list[float]
    sizes: list[float]
