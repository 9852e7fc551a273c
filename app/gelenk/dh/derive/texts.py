"""Input and output of the symbolic part of a worked solution, as plain data for a cache or an answer; rows in LaTeX."""

from collections.abc import Mapping, Sequence
from dataclasses import dataclass, field
from typing import Literal, TypeAlias

from gelenk.course.steps import table
from gelenk.dh.derive.jacobian import Block, Setting
from gelenk.dh.derive.table import TableNumbers
from gelenk.dh.derive.typeset import Formula, MatrixFormula, Style
from gelenk.dh.tables.columns import Column
from gelenk.language import Language, current_language
from gelenk.robot.result import Result

Configuration: TypeAlias = tuple[float, ...]
Grid: TypeAlias = list[list[float]]


@dataclass(frozen=True, slots=True)
class SymbolicRequest:
    """The request as plain data, with style and symbols as for `worked_solution`.

    The formulas are also evaluated at the samples, configurations in [rad or m]. `before` is added to every index. The
    language is that of the texts, so that a cached answer is never in another one.
    """

    table: TableNumbers
    style: Style
    keeps_symbols: bool
    samples: tuple[Configuration, ...]
    before: int = 0
    language: Language = field(default_factory=current_language)


@dataclass(frozen=True, slots=True)
class SymbolEntry(Result):
    """A symbol and its meaning.

    Attributes:
        latex: The symbol in LaTeX.
        plain: The symbol as plain text.
        meaning_latex: Its meaning, in LaTeX.
        meaning: Its meaning, as plain text.
        value: Its value in the table, [m], or a cosine or sine; null for variables.
    """

    latex: str
    plain: str
    meaning_latex: str
    meaning: str
    value: float | None


def symbol_entry(symbol: Formula, meaning: Formula | str, value: float | None = None) -> SymbolEntry:
    """Return the entry of a symbol; a squared unit at the end of words is not text in LaTeX."""
    if isinstance(meaning, str):
        square = "^{2}" if meaning.endswith("^2") else ""
        meaning = Formula(rf"\text{{{meaning.removesuffix('^2')}}}{square}", meaning)
    return SymbolEntry(symbol.latex, symbol.plain, meaning.latex, meaning.plain, value)


@dataclass(frozen=True, slots=True)
class ColumnFormulas(Result):
    """A column of the geometric Jacobian in the axes of the base.

    Attributes:
        joint: The joint whose rate the column is multiplied by.
        axis: z of the joint: z_{i-1} in a standard table, z_i in a modified one.
        arm: p from the joint's frame to the tip; null for a prismatic joint.
        linear: z × p, simplified; z for a prismatic joint.
        angular: z; zero for a prismatic joint.
    """

    joint: str
    axis: MatrixFormula
    arm: MatrixFormula | None
    linear: MatrixFormula
    angular: MatrixFormula


@dataclass(frozen=True, slots=True)
class Values:
    """All matrices at one sample."""

    rows: list[Grid]
    frames: list[Grid | None]
    tip: Grid | None
    jacobian: Grid | None


@dataclass(frozen=True, slots=True)
class Formulas:
    """Transforms and Jacobian as text; `as_read` and `remarks` are those of `Table`.

    Attributes:
        legend: All symbols in order of appearance.
        parameters: a, alpha, d, theta of each row.
        rows: A_1 … A_n; None for one that failed its check.
        frames, tip: T_0_1 … T_0_n and T_base_tool; None for one that is too long.
        chain: Position of the tip in each frame, from n to 0, from right to left; None if one is too long.
        columns: Columns of the Jacobian in the base's axes; None if the tip is too long.
    """

    as_read: TableNumbers
    remarks: tuple[str, ...]
    legend: list[SymbolEntry]
    parameters: list[tuple[Formula, Formula, Formula, Formula]]
    rows: Sequence[MatrixFormula | None]
    frames: Sequence[MatrixFormula | None]
    tip: MatrixFormula | None
    chain: list[MatrixFormula] | None
    position: MatrixFormula | None
    rotation: MatrixFormula | None
    columns: list[ColumnFormulas] | None
    jacobian: MatrixFormula | None
    values: list[Values]


@dataclass(frozen=True, slots=True)
class FormulaCertificate(Result):
    """Comparison of the formulas with numbers from the table's own product of transforms, at random configurations.

    Attributes:
        samples: Configurations at which every formula was evaluated.
        max_error: Largest difference of an entry; [m] or no unit.
        seed: Random seed of the sampling.
    """

    samples: int
    max_error: float
    seed: int


@dataclass(frozen=True, slots=True)
class NumericCertificate(Result):
    """Comparison of the numbers at the given configurations with Pinocchio's.

    Attributes:
        samples: Configurations that were recomputed.
        max_position_error: Largest distance, [m].
        max_orientation_error: Largest angle, [rad].
        max_jacobian_error: Largest difference of an entry of the Jacobian.
    """

    samples: int
    max_position_error: float
    max_orientation_error: float
    max_jacobian_error: float


@dataclass(frozen=True, slots=True)
class NumericColumn(Result):
    """A column of the Jacobian at a configuration.

    Attributes:
        axis: z of the joint.
        arm: From the joint's frame to the tip, [m].
        linear: Its upper three numbers, [m per rad or m].
        angular: Its lower three numbers, [rad per rad or m].
    """

    axis: list[float]
    arm: list[float]
    linear: list[float]
    angular: list[float]


@dataclass(frozen=True, slots=True)
class SingularValue(Result):
    """A value at which a factor vanishes.

    Attributes:
        joints: The joints whose variables, added with `signs`, have the value.
        signs: 1 or -1 for each of these.
        value: [rad] in (-π, π], or [m].
    """

    joints: list[str]
    signs: list[int]
    variable: Formula
    formula: Formula
    value: float


@dataclass(frozen=True, slots=True)
class SingularCondition(Result):
    """A factor of the determinant that some configurations make vanish.

    Attributes:
        kind: Solved for a variable, left as an equation, or without a real solution with these lengths.
        condition: The factor that is zero.
        example: A configuration that fulfils the condition, the other joints drawn at random, [rad or m]; null where
            none was found.
        example_singular_value: Smallest singular value of the block at the example, by the numbers of the table.
    """

    kind: Literal["solved", "equation", "never"]
    condition: Formula
    solutions: list[SingularValue]
    example: list[float] | None
    example_singular_value: float | None


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
        values, sizes: The determinant at each sample, and the sizes of the terms that add up to it.
    """

    block: Block | None = None
    setting: Setting | None = None
    legend: Sequence[SymbolEntry] = ()
    formula: Formula | None = None
    factors: Sequence[Formula] = ()
    conditions: Sequence[SingularCondition] = ()
    values: Sequence[float] = ()
    sizes: Sequence[float] = ()


_HEADS = {"a": "a", "alpha": r"\alpha", "d": "d", "theta": r"\vartheta"}


def array_of(rows: Sequence[Mapping[Column, str]], link: str, columns: Sequence[Column], first: int = 1) -> str:
    """Return a table of cells in LaTeX; `link` is the index of a and α, `first` that of the first row."""
    heads = [rf"{_HEADS[column]}_{{{link if column in ('a', 'alpha') else 'i'}}}" for column in columns]
    lines = ((str(i), *(row[column] for column in columns)) for i, row in enumerate(rows, start=first))
    return table(("i", *heads), lines, "c|cccc")
