"""What goes into the symbolic part of a worked solution and comes out of it: plain data, fit for another process."""

from dataclasses import dataclass
from typing import TypeAlias

from gelenk.kinematics.derive.jacobian import Block, Setting
from gelenk.kinematics.derive.singular import Kind
from gelenk.kinematics.derive.table import TableNumbers
from gelenk.kinematics.derive.typeset import MatrixText, Style, Text

Configuration: TypeAlias = tuple[float, ...]
Grid: TypeAlias = list[list[float]]


@dataclass(frozen=True, slots=True)
class Question:
    """The request as plain data.

    Attributes:
        table: The table.
        style: `short` for c_{12}, `full` for cos(q_1 + q_2).
        keeps_symbols: Whether lengths stay symbols; else their values stand in the formulas.
        samples: Configurations at which the formulas are evaluated as well, [rad or m].
    """

    table: TableNumbers
    style: Style
    keeps_symbols: bool
    samples: tuple[Configuration, ...]


@dataclass(frozen=True, slots=True)
class Entry:
    """A symbol and what it stands for: a value, or words."""

    symbol: Text
    meaning: Text
    value: float | None


@dataclass(frozen=True, slots=True)
class ColumnText:
    """A column of the Jacobian, each part three entries; `arm` is None for a prismatic joint."""

    axis: MatrixText
    arm: MatrixText | None
    linear: MatrixText
    angular: MatrixText


@dataclass(frozen=True, slots=True)
class Values:
    """Everything at one sample."""

    rows: list[Grid]
    frames: list[Grid | None]
    tip: Grid | None
    jacobian: Grid | None


@dataclass(frozen=True, slots=True)
class Formulas:
    """Transforms and Jacobian.

    Attributes:
        as_read: The numbers that the formulas stand for.
        remarks: What was read as something else.
        legend: All symbols in order of appearance.
        parameters: a, alpha, d, theta of each row.
        rows: A_1 … A_n; None where one failed its check.
        frames: T_0_1 … T_0_n; None where one is too long.
        tip: T_base_tool likewise.
        chain: What the tip's position is in each frame, from n to 0, right to left; None where one is too long.
        position: Of the tip, three entries.
        rotation: Of the tip.
        columns: Of the Jacobian in the base's axes; None where the tip is too long.
        jacobian: All columns as a matrix.
        values: At each sample.
    """

    as_read: TableNumbers
    remarks: tuple[str, ...]
    legend: list[Entry]
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
        block: Which block; None where none is square.
        setting: Where it was worked out; None where it was not.
        legend: Symbols beyond those of the formulas.
        formula: As a product; None where there is no block or it is too long.
        factors: Of the product, beside its number.
        conditions: One each factor that depends on a joint.
        values: At each sample.
        sizes: How large the terms are that add up to these.
    """

    block: Block | None
    setting: Setting | None
    legend: list[Entry]
    formula: Text | None
    factors: list[Text]
    conditions: list[ConditionText]
    values: list[float]
    sizes: list[float]
