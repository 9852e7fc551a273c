"""The symbolic part of a worked solution: formulas of one table, and their values at samples.

Both functions take and return plain data, so that they can run in another process, and both cache their last results.
The values at the samples come from the very polynomials that are written out: the caller compares them with the
numbers of the table itself.
"""

import math
from collections.abc import Iterable, Sequence
from fractions import Fraction
from functools import lru_cache

from gelenk.dh.derive.algebra import (
    TRIGONOMETRIC,
    Atom,
    Polynomial,
    TooManyTerms,
    Vector,
    applied,
    plus,
    reduced,
)
from gelenk.dh.derive.factors import factorised, without_multiples
from gelenk.dh.derive.jacobian import (
    Column,
    Setting,
    ZeroPattern,
    best_setting,
    columns,
    determinant,
    relative_jacobian,
    square_block,
)
from gelenk.dh.derive.legend import legend
from gelenk.dh.derive.singular import Condition, condition
from gelenk.dh.derive.table import Table, read_table
from gelenk.dh.derive.texts import (
    ColumnText,
    ConditionText,
    Configuration,
    Formulas,
    Grid,
    Singularities,
    SolutionText,
    SymbolicRequest,
    Values,
)
from gelenk.dh.derive.transforms import MAX_ENTRY_TERMS, Transform, before, behind, frames_from, row_transforms
from gelenk.dh.derive.typeset import MatrixText, Notation, Text, decimal, joined, multiple_of_pi

MAX_FACTOR_TERMS = 40
"""Maximum number of terms of a factor of a determinant: a longer one is not written out."""


@lru_cache(maxsize=16)
def formulas(question: SymbolicRequest) -> Formulas:
    """Return transforms and Jacobian of a table in symbols."""
    table = read_table(question.table)
    notation = _notation(question, table)
    rows, frames = row_transforms(table), frames_from(table, 0)[1:]
    tip = None if frames[-1] is None else _shown(behind(frames[-1], table.tool, table.group))
    base_tip = None if tip is None else _shown(before(table.base, tip, table.group))
    found = None if tip is None or base_tip is None else _columns(table, tip)
    shown = [*rows, *(frame for frame in (*frames, base_tip) if frame is not None)]
    entries = [entry for transform in shown for row in transform.rows for entry in row]
    entries += [entry for column in found or [] for entry in _entries(column)]
    return Formulas(
        table.as_read,
        table.remarks,
        legend(entries, table, notation),
        _parameters(table, notation),
        [notation.matrix(row.rows) for row in rows],
        [None if frame is None else notation.matrix(frame.rows) for frame in frames],
        None if base_tip is None else notation.matrix(base_tip.rows),
        None if tip is None else _chain(table, tip, notation),
        None if base_tip is None else notation.vector(base_tip.position),
        None if base_tip is None else notation.matrix(base_tip.rotation),
        None if found is None else [_column_text(column, notation) for column in found],
        None if found is None else notation.matrix(_grid(found)),
        [_values(table, q, rows, frames, base_tip, found) for q in question.samples],
    )


@lru_cache(maxsize=16)
def singularities(question: SymbolicRequest) -> Singularities:
    """Return the determinant of a table's square block, and the configurations at which it vanishes."""
    table = read_table(question.table)
    notation = _notation(question, table)
    frames = [frame for frame in frames_from(table, 0) if frame is not None]
    if len(frames) <= len(table.rows):
        return Singularities(None, None, [], None, [], [], [], [])
    structure = ZeroPattern(table, frames, behind(frames[-1], table.tool, table.group).position)
    block = square_block(table, structure)
    if block is None:
        return Singularities(None, None, [], None, [], [], [], [])
    setting = best_setting(structure, block, len(table.rows))
    try:
        factor, factors = _product(table, setting) if setting else (Fraction(0), [])
    except TooManyTerms:
        return Singularities(block, setting, [], None, [], [], [], [])
    conditions = [condition(part, table, notation) for part in dict.fromkeys(factors)]
    atoms = {atom for part in factors for atom in part.atoms}
    values, sizes = list[float](), list[float]()
    for q in question.samples:
        known = table.atom_values(q, atoms)
        values.append(float(factor) * math.prod(part.value(known) for part in factors))
        sizes.append(abs(float(factor)) * math.prod(part.size(known) for part in factors))
    return Singularities(
        block,
        setting,
        legend(factors, table, notation),
        notation.factors(factor, factors),
        [notation.text(part) for part in dict.fromkeys(factors)],
        [_condition_text(item, notation) for item in conditions if item is not None],
        values,
        sizes,
    )


def _notation(question: SymbolicRequest, table: Table) -> Notation:
    offset = {row.index for row in table.rows if row.angle and (row.offset or not row.is_revolute)}
    numbers = {} if question.keeps_symbols else table.values
    return Notation(question.style, table.group, offset, numbers, len(table.rows) >= 10)


def _product(table: Table, setting: Setting) -> tuple[Fraction, list[Polynomial]]:
    """Return the determinant as a number and factors; zero without factors if it vanishes identically.

    Raises:
        TooManyTerms: The determinant, or one of its factors, is too long.
    """
    matrix = relative_jacobian(table, setting)
    number_before, found = Fraction(setting.sign), list[Polynomial]()
    for part in setting.parts:
        polynomial = determinant(matrix, part, table)
        if not polynomial:
            return Fraction(0), []
        factor, factors = factorised(polynomial, table.group)
        number_before *= factor
        found += factors
    written = []
    for factor_polynomial in found:
        scale, short = without_multiples(factor_polynomial)
        if len(short) > MAX_FACTOR_TERMS:
            raise TooManyTerms
        number_before *= scale
        written.append(short)
    return number_before, sorted(written, key=_order)


def _order(factor: Polynomial) -> tuple[bool, bool, list[Atom]]:
    """Return the sort key of a factor: lengths, then variables and single sines and cosines, then sums."""
    atoms = sorted(factor.atoms)
    return len(factor) > 1, any(atom.kind == TRIGONOMETRIC for atom in atoms), atoms


def _shown(transform: Transform) -> Transform | None:
    return transform if transform.largest <= MAX_ENTRY_TERMS else None


def _columns(table: Table, tip: Transform) -> list[Column] | None:
    """Return the Jacobian's columns in the axes of the base; None if they are too long."""
    frames = [frame for frame in frames_from(table, 0) if frame is not None]
    try:
        found = columns(table, frames, tip.position)
        return found if table.base.is_identity else [_turned(column, table) for column in found]
    except TooManyTerms:
        return None


def _chain(table: Table, tip: Transform, notation: Notation) -> list[MatrixText] | None:
    """Return A_1 (A_2 ( … (A_n p))): the tip's position in each frame from the last to the first, one matrix at a time.

    Raises:
        ArithmeticError: The result differs from the product of matrices from left to right, which never happens.
    """
    point, found = table.tool.position, [notation.vector(table.tool.position)]
    try:
        for row in reversed(row_transforms(table)):
            turned = plus(applied(row.rotation, point), row.position)
            point = (reduced(turned[0], table.group), reduced(turned[1], table.group), reduced(turned[2], table.group))
            found.append(notation.vector(point))
    except TooManyTerms:
        return None
    if any(reduced(x - y, table.group) for x, y in zip(point, tip.position, strict=True)):
        raise ArithmeticError("the products from the right and from the left differ")
    return found if max(len(entry) for entry in point) <= MAX_ENTRY_TERMS else None


def _parameters(table: Table, notation: Notation) -> list[tuple[Text, Text, Text, Text]]:
    """Return a, alpha, d and theta of each row as the formulas read them."""
    found = []
    for row, numbers in zip(table.rows, table.as_read.rows, strict=True):
        link = row.index if table.is_standard else row.index - 1
        symbol = Text(rf"\alpha_{{{link}}}", f"alpha{link}") if not notation.numbers else decimal(numbers.alpha)
        constant = multiple_of_pi(numbers.theta) or decimal(numbers.theta)
        variable = Text(f"q_{{{row.index}}}", f"q{row.index}")
        theta = joined(variable, constant) if row.is_revolute else constant
        found.append((notation.text(row.a), multiple_of_pi(numbers.alpha) or symbol, notation.text(row.d), theta))
    return found


def _turned(column: Column, table: Table) -> Column:
    def turn(vector: Vector) -> Vector:
        x, y, z = applied(table.base.rotation, vector)
        return reduced(x, table.group), reduced(y, table.group), reduced(z, table.group)

    return Column(
        turn(column.axis),
        None if column.arm is None else turn(column.arm),
        turn(column.linear),
        turn(column.angular),
    )


def _entries(column: Column) -> list[Polynomial]:
    return [*column.axis, *(column.arm or ()), *column.linear, *column.angular]


def _grid(found: Sequence[Column]) -> list[list[Polynomial]]:
    stacked = [[*column.linear, *column.angular] for column in found]
    return [[column[i] for column in stacked] for i in range(6)]


def _column_text(column: Column, notation: Notation) -> ColumnText:
    return ColumnText(
        notation.vector(column.axis),
        None if column.arm is None else notation.vector(column.arm),
        notation.vector(column.linear),
        notation.vector(column.angular),
    )


def _condition_text(item: Condition, notation: Notation) -> ConditionText:
    solutions = [
        SolutionText(solution.variables, notation.variables(solution.variables), solution.formula, solution.value)
        for solution in item.solutions
    ]
    return ConditionText(item.kind, notation.text(item.factor), solutions, item.example)


def _values(
    table: Table,
    q: Configuration,
    rows: Sequence[Transform],
    frames: Sequence[Transform | None],
    tip: Transform | None,
    found: Sequence[Column] | None,
) -> Values:
    transforms = [*rows, *(frame for frame in (*frames, tip) if frame is not None)]
    atoms = {atom for transform in transforms for row in transform.rows for entry in row for atom in entry.atoms}
    atoms |= {atom for column in found or [] for entry in _entries(column) for atom in entry.atoms}
    known = table.atom_values(q, atoms)

    def grid(rows: Iterable[Iterable[Polynomial]]) -> Grid:
        return [[entry.value(known) for entry in row] for row in rows]

    return Values(
        [grid(row.rows) for row in rows],
        [None if frame is None else grid(frame.rows) for frame in frames],
        None if tip is None else grid(tip.rows),
        None if found is None else grid(_grid(found)),
    )
