"""The symbolic part of a worked solution: formulas of one table, and their values at samples.

Both functions take and return plain data, so that they can run in another process, and both cache their last results.
The values at the samples come from the very polynomials that are written out: the caller compares them with the
numbers of the table itself.
"""

import math
from collections.abc import Iterable, Mapping, Sequence
from fractions import Fraction
from functools import lru_cache, partial
from typing import Any

from gelenk.dh.derive.algebra import (
    CONSTANT,
    LENGTH,
    ROOT,
    TRIGONOMETRIC,
    Atom,
    Group,
    Polynomial,
    TooManyTerms,
    Vector,
    applied,
    plus,
    reduced,
    reduced_vector,
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
from gelenk.dh.derive.singular import singular_condition
from gelenk.dh.derive.table import Table, Transform, read_table
from gelenk.dh.derive.texts import (
    ColumnFormulas,
    Formulas,
    Grid,
    Singularities,
    SymbolEntry,
    SymbolicRequest,
    Values,
    symbol_entry,
)
from gelenk.dh.derive.transforms import MAX_ENTRY_TERMS, composed, frames_from, row_transforms
from gelenk.dh.derive.typeset import (
    Formula,
    MatrixFormula,
    Notation,
    decimal,
    function_of,
    indexed,
    multiple_of_pi,
    summed,
)
from gelenk.language import translated as _

MAX_FACTOR_TERMS = 40
"""Maximum number of terms of a factor of a determinant: a longer one is not written out."""


@lru_cache(maxsize=16)
def formulas(question: SymbolicRequest) -> Formulas:
    """Return transforms and Jacobian of a table in symbols."""
    table = read_table(question.table)
    notation = notation_of(table, table.group, question, table.values)
    rows, frames, before = row_transforms(table), frames_from(table, 0)[1:], question.before
    tip = None if frames[-1] is None else _shown(composed(frames[-1], table.tool, table.group))
    base_tip = None if tip is None else _shown(composed(table.base, tip, table.group))
    found = None if tip is None or base_tip is None else _columns(table, tip)
    shown = [*rows, *(frame for frame in (*frames, base_tip) if frame is not None)]
    entries = [entry for transform in shown for row in transform.rows for entry in row]
    entries += [entry for column in found or [] for part in column if part is not None for entry in part]
    atoms = {atom for entry in entries for atom in entry.atoms}
    return Formulas(
        table.as_read,
        table.remarks,
        legend(atoms, table, notation),
        _parameters(table, notation),
        [notation.matrix(f"A_{i}", row.rows) for i, row in enumerate(rows, start=before + 1)],
        [
            None if T is None else notation.matrix(f"T_{before}_{i}", T.rows)
            for i, T in enumerate(frames, start=before + 1)
        ],
        None if base_tip is None else notation.matrix("T_base_tool", base_tip.rows),
        None if tip is None else _chain(table, tip, notation),
        None if base_tip is None else notation.vector("p", base_tip.position),
        None if base_tip is None else notation.matrix("R", base_tip.rotation),
        None if found is None else [_column(i, column, table, notation) for i, column in enumerate(found, start=1)],
        None if found is None else notation.matrix("J", _grid(found)),
        [_values(table.atom_values(q, atoms), rows, frames, base_tip, found) for q in question.samples],
    )


@lru_cache(maxsize=16)
def singularities(question: SymbolicRequest) -> Singularities:
    """Return the determinant of a table's square block, and the configurations at which it vanishes."""
    table = read_table(question.table)
    notation = notation_of(table, table.group, question, table.values)
    frames = [frame for frame in frames_from(table, 0) if frame is not None]
    if len(frames) <= len(table.rows):
        return Singularities()
    structure = ZeroPattern(table, frames, composed(frames[-1], table.tool, table.group).position)
    block = square_block(table, structure)
    if block is None:
        return Singularities()
    setting = best_setting(structure, block, len(table.rows))
    try:
        factor, factors = _product(table, setting) if setting else (Fraction(0), [])
    except TooManyTerms:
        return Singularities(block, setting)
    different = list(dict.fromkeys(factors))
    conditions = [singular_condition(part, table, notation) for part in different]
    atoms = {atom for part in factors for atom in part.atoms}
    known = [table.atom_values(q, atoms) for q in question.samples]
    return Singularities(
        block,
        setting,
        legend(atoms, table, notation),
        notation.factors(factor, factors),
        [notation.text(part) for part in different],
        [condition for condition in conditions if condition is not None],
        [float(factor) * math.prod(part.value(values) for part in factors) for values in known],
        [abs(float(factor)) * math.prod(part.size(values) for part in factors) for values in known],
    )


def notation_of(table: Table, group: Group, question: SymbolicRequest, values: Mapping[Atom, float]) -> Notation:
    """Return the notation of a table's formulas as requested, with the values of its symbols; see `Notation`."""
    before, numbers = question.before, {} if question.keeps_symbols else values
    offset = {row.index for row in table.rows if row.angle and (row.offset or not row.is_revolute)}
    return Notation(question.style, group, offset, numbers, len(table.rows) + before >= 10, before)


def _product(table: Table, setting: Setting) -> tuple[Fraction, list[Polynomial]]:
    """Return the determinant as a number and factors; zero without factors if it vanishes identically."""
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
    except TooManyTerms:
        return None
    if table.base.is_identity:
        return found
    return [Column(*map(partial(_in_base, table), column)) for column in found]


def _chain(table: Table, tip: Transform, notation: Notation) -> list[MatrixFormula] | None:
    """Return A_1 (A_2 ( … (A_n p))): the tip's position in each frame, from the last to the first."""
    point, found = table.tool.position, [notation.vector("p", table.tool.position)]
    try:
        for row in reversed(row_transforms(table)):
            point = reduced_vector(plus(applied(row.rotation, point), row.position), table.group)
            found.append(notation.vector("p", point))
    except TooManyTerms:
        return None
    if any(reduced(x - y, table.group) for x, y in zip(point, tip.position, strict=True)):
        raise ArithmeticError("the products from the right and from the left differ")
    return found if max(len(entry) for entry in point) <= MAX_ENTRY_TERMS else None


def _parameters(table: Table, notation: Notation) -> list[tuple[Formula, Formula, Formula, Formula]]:
    found = []
    for row, numbers in zip(table.rows, table.as_read.rows, strict=True):
        index = row.index + notation.before
        link = index if table.is_standard else index - 1
        alpha = decimal(numbers.alpha) if notation.numbers else indexed(r"\alpha", "alpha", link)
        theta = multiple_of_pi(numbers.theta) or decimal(numbers.theta)
        if row.is_revolute:
            theta = summed((indexed("q", "q", index), theta))
        found.append((notation.text(row.a), multiple_of_pi(numbers.alpha) or alpha, notation.text(row.d), theta))
    return found


def _in_base(table: Table, vector: Vector | None) -> Any:
    return None if vector is None else reduced_vector(applied(table.base.rotation, vector), table.group)


def _grid(found: Sequence[Column]) -> list[list[Polynomial]]:
    stacked = [[*column.linear, *column.angular] for column in found]
    return [[column[i] for column in stacked] for i in range(6)]


def _column(i: int, column: Column, table: Table, notation: Notation) -> ColumnFormulas:
    return ColumnFormulas(
        table.as_read.rows[i - 1].name,
        notation.vector("z", column.axis),
        None if column.arm is None else notation.vector("p", column.arm),
        notation.vector(f"J_v_{i + notation.before}", column.linear),
        notation.vector(f"J_omega_{i + notation.before}", column.angular),
    )


def _values(
    known: Mapping[Atom, float],
    rows: Sequence[Transform],
    frames: Sequence[Transform | None],
    tip: Transform | None,
    found: Sequence[Column] | None,
) -> Values:
    return Values(
        [grid_of(row.rows, known) for row in rows],
        [None if frame is None else grid_of(frame.rows, known) for frame in frames],
        None if tip is None else grid_of(tip.rows, known),
        None if found is None else grid_of(_grid(found), known),
    )


def grid_of(rows: Iterable[Iterable[Polynomial]], known: Mapping[Atom, float]) -> Grid:
    """Evaluate polynomials row by row."""
    return [[entry.value(known) for entry in row] for row in rows]


def legend(atoms: Iterable[Atom], table: Table, notation: Notation) -> list[SymbolEntry]:
    """Return an entry for every symbol: parameters, then variables, then sines and cosines."""
    atoms, found, known = sorted(atoms), list[SymbolEntry](), set[tuple[object, ...]]()
    for atom in atoms:
        if atom in notation.numbers or atom.kind == ROOT:
            continue
        key = (atom.kind, atom.indices, atom.kind in {LENGTH, CONSTANT} and atom.name.replace("ca", "sa"))
        if key not in known:
            known.add(key)
            found += _entries(atom, table, notation)
    angles = {abs(index) for atom in atoms if atom.kind == TRIGONOMETRIC for index in atom.indices}
    for index in sorted(angles & set(notation.offset_angles)):
        row = table.rows[index - 1]
        own = decimal(row.offset)
        meaning = summed((indexed("q", "q", index + notation.before), own)) if row.is_revolute else own
        found.append(symbol_entry(notation.angle_name(index), meaning))
    return found


def _entries(atom: Atom, table: Table, notation: Notation) -> list[SymbolEntry]:
    """Return the entry of a symbol, or both entries of an angle."""
    if atom.kind == TRIGONOMETRIC:
        if notation.style == "full" or len(set(atom.indices)) < len(atom.indices):
            return []
        angle, names = notation.angle(atom.indices), ("c", "s")
    elif atom.name in {"ca", "sa"}:
        index = atom.indices[0]
        angle, names = indexed(r"\alpha", "alpha", index + notation.before), ("ca", "sa")
        if notation.style == "full":
            row = index if table.is_standard else index + 1
            words = _("twist alpha of row {row}, in rad").format(row=row + notation.before)
            return [symbol_entry(angle, words, table.as_read.rows[row - 1].alpha)]
    else:
        return [symbol_entry(notation.atom(atom), _words(atom, table, notation.before), table.values.get(atom))]
    both = [atom._replace(name=name) for name in names]
    return [symbol_entry(notation.atom(one), function_of(one.name, angle), table.values.get(one)) for one in both]


def _words(atom: Atom, table: Table, before: int) -> str:
    index = atom.indices[0] + before
    row = index if table.is_standard or atom.name != "a" else index + 1
    named = {
        "a": _("length a of row {row}, in m"),
        "d": _("length d of row {row}, in m"),
        "q": _("variable of the prismatic joint {row}, in m"),
        "pb": _("position of frame 0 in the base, in m"),
        "pt": _("position of the tool in the last frame, in m"),
        "rb": _("entry of the base's rotation matrix"),
        "rt": _("entry of the tool's rotation matrix"),
    }
    return named[atom.name].format(row=row)
