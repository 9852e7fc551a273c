"""Corrections of mistakes, thousands side by side: each repaired number is one of the given table times a factor.

So a mistake is a selection of numbers with factors, and a pair of mistakes is a selection from a selection: all pairs
take two lookups.
"""

from collections.abc import Iterator
from dataclasses import dataclass
from typing import Any, NamedTuple

import numpy as np
from numpy.typing import NDArray

from gelenk.dh.compare.screws import PARAMETERS, numbers_of
from gelenk.dh.compare.words import Mistake
from gelenk.errors import quoted
from gelenk.robot.arrays import Array, Flags, Indices
from gelenk.robot.dh import Convention, DhTable

OTHER: dict[Convention, Convention] = {"standard": "modified", "modified": "standard"}
_CONVENTIONS: dict[Convention, str] = {"standard": "standard", "modified": "modified (Craig)"}
_DEGREE = np.pi / 180.0
_DEGREES: list[tuple[Mistake, str, float]] = [("degrees", "in degrees", _DEGREE)]
_NOWHERE = -1
"""Place of a number that the given table does not have, and row of such numbers."""


@dataclass(frozen=True, slots=True)
class Undone:
    """A corrected mistake and its description."""

    mistake: Mistake
    detail: str


class Repairs(NamedTuple):
    """N repairs of a table of n rows into tables of m rows.

    Attributes:
        undone: The mistakes that each repair corrects, `Undone`; shape (N, k), k from 0 to 2.
        sources: Places of the numbers in the given table, row by row; -1 in a missing row; shape (N, 4 m).
        factors: Factors of these numbers; shape (N, 4 m).
        senses: -1 where a joint is reversed, else 1; shape (N, m).
        switched: Whether the table is read in the other convention; shape (N,).
        alone: Whether only one number is multiplied; shape (N,).
    """

    undone: NDArray[Any]
    sources: Indices
    factors: Array
    senses: Array
    switched: Flags
    alone: Flags

    def only(self, chosen: Indices | Flags) -> "Repairs":
        """Select some repairs."""
        return Repairs._make(values[chosen] for values in self)

    def numbers(self, table: Array) -> Array:
        """Compute the repaired tables, with zeros in missing rows; shape (n, 4) → (N, m, 4)."""
        repaired: Array = np.append(table.ravel(), 0.0)[self.sources] * self.factors
        return repaired.reshape(len(repaired), -1, 4)

    @property
    def rows(self) -> Indices:
        """Row of the given table that each row comes from, -1 if missing; shape (N, m)."""
        return self.sources[:, ::4] // 4

    def convention(self, table: DhTable) -> Convention:
        """Return the convention of the repaired tables, the same for all."""
        return OTHER[table.convention] if self.switched[0] else table.convention

    def then(self, others: "Repairs") -> "Repairs":
        """Combine each repair with each of the others; two that each change a single number in one order only."""
        i, j = np.indices((len(self.undone), len(others.undone))).reshape(2, -1)
        kept = (i < j) | ~(self.alone[i] & others.alone[j])
        i, j = i[kept], j[kept]
        places, rows = others.sources[j], others.rows[j]
        return Repairs(
            np.concatenate((self.undone[i], others.undone[j]), axis=1),
            _behind(self.sources, _NOWHERE)[i[:, None], places],
            _behind(self.factors, 1.0)[i[:, None], places] * others.factors[j],
            _behind(self.senses, 1.0)[i[:, None], rows] * others.senses[j],
            self.switched[i] ^ others.switched[j],
            np.zeros(len(i), dtype=bool),
        )


def unchanged(n: int) -> Repairs:
    """Return the repair that changes nothing."""
    return _stacked(n, [_Repair("number", "")]).only(np.ones(1, dtype=bool))._replace(undone=np.empty((1, 0), object))


def of_rows(table: DhTable, powers: int, *, reorder: bool, turn: bool) -> Repairs:
    """Return repairs of single mistakes that keep the number of rows; those of a single number come last.

    Lengths may be off by powers of ten up to `powers`, rows exchanged if `reorder`, a joint reversed if `turn`.
    """
    n, numbers = len(table.joints), numbers_of(table)
    other, own = _CONVENTIONS[OTHER[table.convention]], _CONVENTIONS[table.convention]
    detail = f"the numbers are those of a {other} table, read as {own}"
    found = [_Repair("convention", detail, switched=True), *_throughout(powers), *(_reordered(n) if reorder else ())]
    found += _in_rows(n, powers)
    if turn:
        for i, row in enumerate(table.joints):
            detail = f"the joint moves in the opposite direction: {quoted(row.name)}"
            found.append(_Repair("joint_sense", detail, turned=i))
    every = _stacked(n, [*found, *_in_cells(n, powers)])
    changes = np.count_nonzero(every.numbers(numbers) != numbers, axis=(1, 2))
    # A factor of a row or column may change only one number, and such a repair is already among the single numbers.
    news = every.switched | (every.senses < 0.0).any(axis=1) | np.where(every.alone, changes == 1, changes > 1)
    return every.only(news)


def without_a_row(table: Array) -> Repairs:
    """Return repairs that remove a row: doubled rows first, then extra ones."""
    n = len(table)
    found = []
    for i in range(n):
        doubled = i > 0 and bool((table[i] == table[i - 1]).all())
        detail = f"row {i + 1} is row {i} doubled" if doubled else f"row {i + 1} is extra"
        order = np.delete(np.arange(n), i)
        found.append(_Repair("row_doubled" if doubled else "row_extra", detail, rows=order))
    return _stacked(n, sorted(found, key=lambda each: each.mistake))


def with_a_row(n: int) -> Repairs:
    """Return repairs that insert a missing row."""
    rows = [np.insert(np.arange(n), i, _NOWHERE) for i in range(n + 1)]
    return _stacked(n, [_Repair("row_missing", f"row {i + 1} is missing", rows=order) for i, order in enumerate(rows)])


def power_of_ten(power: int) -> tuple[Mistake, str]:
    """Name and describe the mistake that lengths are too large by a power of ten."""
    if power == 3:
        return "millimetres", "in millimetres"
    if power == 2:
        return "centimetres", "in centimetres"
    return "power_of_ten", f"{10.0 ** abs(power):g} times too {'large' if power > 0 else 'small'}"


class _Repair(NamedTuple):
    """One repair: selection and order of rows and columns, then factors of some rows and columns."""

    mistake: Mistake
    detail: str
    rows: Indices | None = None
    columns: tuple[int, ...] = (0, 1, 2, 3)
    among: tuple[int, ...] | None = None
    factors: tuple[float, ...] = (1.0, 1.0, 1.0, 1.0)
    turned: int | None = None
    switched: bool = False
    alone: bool = False


def _stacked(n: int, found: list[_Repair]) -> Repairs:
    undone = np.empty((len(found), 1), dtype=object)
    m = n if found[0].rows is None else len(found[0].rows)
    sources = np.tile(np.arange(4 * m), (len(found), 1)).reshape(-1, m, 4)
    factors, senses = np.ones((len(found), m, 4)), np.ones((len(found), m))
    for i, each in enumerate(found):
        undone[i, 0] = Undone(each.mistake, each.detail)
        if each.rows is not None:
            sources[i] = 4 * each.rows[:, None] + np.arange(4)
            sources[i][each.rows == _NOWHERE] = _NOWHERE
        among = list(range(m) if each.among is None else each.among)
        sources[i, among] = sources[i, among][:, each.columns]
        factors[i, among] = each.factors
        if each.turned is not None:
            senses[i, each.turned] = -1.0
    flags = np.array([(each.switched, each.alone) for each in found])
    return Repairs(
        undone, sources.reshape(-1, 4 * m), factors.reshape(-1, 4 * m), senses, flags[:, 0].copy(), flags[:, 1].copy()
    )


def _behind(values: NDArray[Any], last: float) -> NDArray[Any]:
    """Append a value to each row, for the place -1."""
    return np.concatenate((values, np.full((len(values), 1), last, dtype=values.dtype)), axis=1)


def _powers(highest: int) -> list[int]:
    return sorted(
        (sign * power for power in range(1, highest + 1) for sign in (1, -1)), key=lambda p: (abs(p - 2.5), p)
    )


def _in_units(
    which: str, what: str, powers: int, among: tuple[int, ...] | None = None, alone: bool = False
) -> Iterator[_Repair]:
    """Repairs of lengths in another unit, or of angles in degrees, in some columns."""
    units = [(*power_of_ten(power), 10.0**-power) for power in _powers(powers)]
    for mistake, words, factor in units if which in {"a", "d", "a d"} else _DEGREES:
        yield _Repair(mistake, f"{what} {words}", among=among, factors=_factors(which, factor), alone=alone)


def _throughout(powers: int) -> Iterator[_Repair]:
    """Repairs of whole columns."""
    for which, what in (("alpha theta", "angles"), ("alpha", "alpha"), ("theta", "theta")):
        yield from _in_units(which, f"all {what} are", powers)
    for which, what in (("a d", "lengths"), ("a", "a"), ("d", "d")):
        yield from _in_units(which, f"all {what} are", powers)
    for power in _powers(powers):
        length = 10.0**-power
        words = f"all angles are in degrees and all lengths {power_of_ten(power)[1]}"
        yield _Repair("degrees", words, factors=(length, _DEGREE, length, _DEGREE))
    for columns, names in _EXCHANGES:
        yield _Repair("columns", f"{names} are exchanged in all rows", columns=columns)
    for name in PARAMETERS:
        yield _Repair("sign", f"the sign of {name} is wrong in all rows", factors=_factors(name, -1.0))


_EXCHANGES = (((2, 1, 0, 3), "a and d"), ((0, 3, 2, 1), "alpha and theta"))


def _reordered(n: int) -> Iterator[_Repair]:
    if n > 1:
        yield _Repair("rows", "the rows are in reverse order, tip to base", rows=np.arange(n)[::-1])
    for i in range(n - 1):
        order = np.arange(n)
        order[[i, i + 1]] = i + 1, i
        yield _Repair("rows", f"rows {i + 1} and {i + 2} are exchanged", rows=order)


def _in_rows(n: int, powers: int) -> Iterator[_Repair]:
    """Repairs of two numbers in a row."""
    for i in range(n):
        for columns, names in _EXCHANGES:
            yield _Repair("columns", f"{names} are exchanged in row {i + 1}", columns=columns, among=(i,))
        yield from _in_units("a d", f"a and d in row {i + 1} are", powers, (i,))
        yield from _in_units("alpha theta", f"alpha and theta in row {i + 1} are", powers, (i,))


def _in_cells(n: int, powers: int) -> Iterator[_Repair]:
    for i in range(n):
        for name in PARAMETERS:
            where = f"{name} in row {i + 1}"
            factors = _factors(name, -1.0)
            yield _Repair("sign", f"the sign of {where} is wrong", among=(i,), factors=factors, alone=True)
            yield from _in_units(name, f"{where} is", powers, (i,), alone=True)


def _factors(which: str, factor: float) -> tuple[float, ...]:
    names = which.split()
    return tuple(factor if name in names else 1.0 for name in PARAMETERS)
