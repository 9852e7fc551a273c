"""Search for a single wrong number in a table, and its correct value.

A number is wrong if changing it alone makes the table describe the chain. Least squares tries all numbers side by side,
from several starting values: an angle may be off by half a turn, a length by its sign or its unit. If several numbers
qualify (only the sum of the d of parallel axes matters), the likeliest slip comes first.
"""

import math
from collections.abc import Sequence
from dataclasses import dataclass, replace
from typing import Any, Literal, NamedTuple, TypeAlias

import numpy as np

from gelenk.dh.compare.alignment import Freedom
from gelenk.dh.compare.placement import Placement, Subject, placed, started, unknowns_of
from gelenk.dh.compare.repairs import Undone, power_of_ten
from gelenk.dh.compare.screws import (
    BASE_DIRECTIONS,
    PARAMETERS,
    ChainScrews,
    Tables,
    fit,
    geometry,
    parameters_of,
    polished,
    residuals,
)
from gelenk.dh.compare.words import LOOKS, Mistake
from gelenk.robot.arrays import Array
from gelenk.robot.dh import Convention, DhTable

_ANGLES = 8
"""Number of starting values per angle, over a full turn."""
MISFIT = 5.0
"""Number of tolerances by which the screws of a fitting table may be off."""
MOST_POWERS = 6
"""Highest power of ten reported as the error of a length."""
_TELLING = 10.0
"""Number of tolerances that a length must exceed for its power of ten to be significant."""

Slip: TypeAlias = Literal["sign", "degrees"] | int
"""How a number went wrong; an integer is the power of ten by which a length is off."""
_WINDOW = 8
"""Number of rows searched for a wrong number; a shorter table is searched in full."""
_ZERO = 1e-12


@dataclass(frozen=True, slots=True)
class Difference:
    """A difference between a table and what the chain needs; `value` and `expected` are in [rad or m].

    Attributes:
        row: The row, from 1 as in textbooks: d₁ is in row 1; None if no row is concerned.
        parameter: One of a, alpha, d, theta; or sign, type, mimic, joints (their number), base, tool.
    """

    row: int | None
    joint: str | None
    parameter: str
    value: float | str | None
    expected: float | str | None

    @property
    def difference(self) -> float | None:
        """`value` - `expected`, [rad or m]; None unless both are numbers."""
        if isinstance(self.value, str | None) or isinstance(self.expected, str | None):
            return None
        return self.value - self.expected


class Candidate(NamedTuple):
    """A corrected number found by least squares, and the likely slip; None if the number suggests none."""

    difference: Difference
    slip: Slip | None


def wrong_numbers(on: Subject, table: DhTable, freedom: Freedom, signs: Array) -> list[tuple[Candidate, Placement]]:
    """Find every number whose correction alone makes a table describe a chain, with the fit; the likeliest first.

    The rows match the chain's joints in number and type; `signs` (n,) are the senses of the joints during the search.
    """
    n, first = len(on.target), 0
    if n > _WINDOW:
        # The wrong number cannot come after the first joint that is off; far before it, an earlier joint would be off.
        first = max(0, _first_misfit(on, table, freedom, signs) - _WINDOW)
    found = []
    for number in _candidates(on, table, freedom, signs, n, first):
        placement = placed(on.fewer(LOOKS), repaired(table, [number.difference]), freedom, strict=True)
        if placement is not None:
            found.append((number, placement))
    return found


def first_wrong_row(on: Subject, table: DhTable, freedom: Freedom, signs: Array) -> list[Difference]:
    """Find what is wrong where a table first departs from a chain, seen from the base, if no single number explains it.

    Only the first joints are compared, as few as show a difference: one number is corrected, or else all four of the
    row (Craig: of the link) that leads to the last of them. Base or tool is returned if no row can account for the
    difference.
    """
    count = _first_misfit(on, table, freedom, signs)
    if count > len(on.target):
        return _link(on, table, freedom, signs, count) or [_place("tool")]
    part, loose = _first_joints(on, count), freedom._replace(tool=True)
    single = _candidates(part, table, loose, signs, count, max(0, count - _WINDOW))
    if single:
        return [single[0].difference]
    return _link(part, table, loose, signs, count) or [_place("base")]


def _first_misfit(on: Subject, table: DhTable, freedom: Freedom, signs: Array) -> int:
    """First joint, from 1, at which a table departs from a chain, by bisection; n + 1 if only the tip is off."""
    fits, fails = 0, len(on.target) + 1
    while fails - fits > 1:
        count = (fits + fails) // 2
        part = _first_joints(on, count)
        misfit = misfits(part, _start(part, table, freedom, signs), with_tip=False)[0]
        fits, fails = (count, fails) if misfit <= MISFIT else (fits, count)
    return fails


def repaired(table: DhTable, differences: Sequence[Difference]) -> DhTable:
    """Return a table with its numbers corrected."""
    joints = list(table.joints)
    for each in differences:
        if each.row is not None and each.parameter in PARAMETERS:
            number: dict[str, Any] = {each.parameter: each.expected}
            joints[each.row - 1] = replace(joints[each.row - 1], **number)
    return replace(table, joints=tuple(joints))


def _place(name: str) -> Difference:
    return Difference(None, None, name, None, None)


def _candidates(on: Subject, table: DhTable, freedom: Freedom, signs: Array, count: int, first: int) -> list[Candidate]:
    """Corrections of single numbers in a few rows that make the first joints' screws agree; the likeliest first."""
    rows, places = _trials(table, freedom, count, range(first, first + _WINDOW))
    if not places:
        return []
    tables = _started(on, table, rows, freedom, signs)
    common = unknowns_of(on.target, tables, freedom)
    own = np.array([BASE_DIRECTIONS + place for place in places])
    kept = np.flatnonzero(~np.isin(own, common))
    own = own[kept]
    unknowns = np.column_stack((np.tile(common, (len(own), 1)), own))
    with_tip = not freedom.tool
    tables, _ = fit(on.target, tables.only(kept), unknowns, with_tip)
    best: dict[int, Candidate] = {}
    for c in np.flatnonzero(misfits(on, tables, with_tip) <= MISFIT):
        place = int(own[c]) - BASE_DIRECTIONS
        nearest = polished(on.target, tables.only(np.array([c])), unknowns[[c]], with_tip)
        number = explained(on, table, place, float(nearest.rows[0].ravel()[place]))
        if place not in best or _likelihood(number) < _likelihood(best[place]):
            best[place] = number
    return sorted(best.values(), key=_likelihood)


def _trials(table: DhTable, freedom: Freedom, count: int, among: range) -> tuple[Array, list[int]]:
    """Tables with one number changed, and its place; numbers that a free base or tool compensates are omitted."""
    start = parameters_of(table)
    rows, places = [], []
    for place in range(4 * len(start)):
        row, column = divmod(place, 4)
        if (
            row not in among
            or is_absorbed(table.convention, len(start), freedom, row, column)
            or not _counts(table, row, column, count, freedom)
        ):
            continue
        value = start[row, column]
        if column in {1, 3}:
            values = [value + k * 2.0 * math.pi / _ANGLES for k in range(_ANGLES)]
            values += [math.radians(value)] if abs(value) > math.pi else []
        else:
            values = list(dict.fromkeys((value, -value, 0.0, value / 1000.0)))
        for other in values:
            changed = start.copy()
            changed[row, column] = other
            rows.append(changed)
            places.append(place)
    return np.array(rows), places


def is_absorbed(convention: Convention, count: int, freedom: Freedom, row: int, column: int) -> bool:
    """Return whether a free base or tool directly compensates a number in a table of `count` rows."""
    before_motion = column >= 2 or convention == "modified"
    if freedom.base and row == 0 and before_motion:
        return True
    behind_motion = column >= 2 or convention == "standard"
    return freedom.tool and row == count - 1 and behind_motion


def _counts(table: DhTable, row: int, column: int, count: int, freedom: Freedom) -> bool:
    """Whether a number comes before the last of the first `count` joints, or before a tip that counts."""
    if count == len(table.joints) and not freedom.tool:
        return True
    return row < count - 1 or (row == count - 1 and column < 2 and table.convention == "modified")


def _started(on: Subject, table: DhTable, rows: Array, freedom: Freedom, signs: Array) -> Tables:
    """Align the first joints of tables with numbers of their own, their senses held."""
    count = len(on.target)
    return started(replace(on, senses=signs[:count]), table, rows[:, :count], freedom._replace(signs=False))


def _first_joints(on: Subject, count: int) -> Subject:
    target = on.target
    return replace(on, target=ChainScrews(target.twists[:count], target.slides[:count], target.tip))


def _start(on: Subject, table: DhTable, freedom: Freedom, signs: Array) -> Tables:
    """The first joints of a table fitted to those of a chain, without the tip."""
    loose = freedom._replace(tool=True, signs=False)
    tables = _started(on, table, parameters_of(table)[None], loose, signs)
    return fit(on.target, tables, unknowns_of(on.target, tables, loose)[None], with_tip=False)[0]


def misfits(on: Subject, tables: Tables, with_tip: bool) -> Array:
    """Compute the largest error of each table's screws, in tolerances; shape (C,)."""
    r = np.abs(residuals(on.target, geometry(tables), with_tip)).reshape(len(tables.rows), -1, 2, 3)
    worst: Array = (r.max(axis=(1, 3)) / on.tolerances).max(axis=1)
    return worst


def _link(on: Subject, table: DhTable, freedom: Freedom, signs: Array, count: int) -> list[Difference]:
    """Numbers that change when all those of the link before a joint (from 1; n + 1 is the tip) are corrected."""
    places = _places_of_link(table, count)
    if not places:
        return []
    start = parameters_of(table)[: len(on.target)]
    rows = np.repeat(start[None], _ANGLES**2, axis=0)
    for place in places:
        row, column = divmod(place, 4)
        turns = np.arange(_ANGLES**2) % _ANGLES if column == 1 else np.arange(_ANGLES**2) // _ANGLES
        if column in {1, 3}:
            rows[:, row, column] += turns * 2.0 * math.pi / _ANGLES
    tables = _started(on, table, rows, freedom, signs)
    common = unknowns_of(on.target, tables, freedom)
    own = np.array([BASE_DIRECTIONS + place for place in places if BASE_DIRECTIONS + place not in common])
    with_tip = not freedom.tool
    unknowns = np.tile(np.concatenate((common, own)), (len(rows), 1))
    tables, _ = fit(on.target, tables, unknowns, with_tip)
    answers = []
    for c in np.flatnonzero(misfits(on, tables, with_tip) <= MISFIT):
        values = tables.rows[c].ravel()[places].tolist()
        numbers = [explained(on, table, *each).difference for each in zip(places, values, strict=True)]
        answers.append([each for each in numbers if _differs(on, each)])
    return min(answers, key=lambda found: (len(found), sum(abs(each.difference or 0.0) for each in found)), default=[])


def _places_of_link(table: DhTable, count: int) -> list[int]:
    """Places of the numbers between a joint (from 1; n + 1 is the tip) and the one before it, row by row."""
    n = len(table.joints)
    if table.convention == "standard":
        row = count - 2
        return [4 * row + column for column in range(4)] if row >= 0 else []
    behind = [4 * (count - 2) + column for column in (2, 3)] if count >= 2 else []
    return behind + ([4 * (count - 1) + column for column in (0, 1)] if count <= n else [])


def _differs(on: Subject, each: Difference) -> bool:
    tolerance = on.tolerances[1] if each.parameter in {"alpha", "theta"} else on.tolerances[0]
    return each.difference is not None and abs(each.difference) > tolerance


def explained(on: Subject, table: DhTable, place: int, found: float) -> Candidate:
    """Return a number found to fit, instead of the one in its place, with the likely slip."""
    row, column = divmod(place, 4)
    joint, parameter = table.joints[row], PARAMETERS[column]
    value = float(getattr(joint, parameter))
    # A mimic row's offset is not part of its written number.
    expected = found - float(parameters_of(table)[row, column] - value)
    is_angle = column in {1, 3}
    if is_angle:
        turns = wrapped(expected - value)
        expected = value + turns if abs(value) <= 2.0 * math.pi else wrapped(expected)
    tolerance = 3.0 * on.tolerances[1 if is_angle else 0]
    slip = _slip(value, expected, is_angle, tolerance)
    if slip == "degrees":
        expected = math.radians(value) + wrapped(expected - math.radians(value))
    elif slip == "sign":
        expected = -value + (wrapped(expected + value) if is_angle else expected + value)
    return Candidate(Difference(row + 1, joint.name, parameter, value, expected), slip)


def _slip(value: float, expected: float, is_angle: bool, tolerance: float) -> Slip | None:
    if abs(value) <= _ZERO:
        return None
    away = wrapped if is_angle else float
    if abs(away(value + expected)) <= tolerance and abs(away(value - expected)) > tolerance:
        return "sign"
    if is_angle:
        in_degrees = abs(value) > 1.0 and abs(wrapped(math.radians(value) - expected)) <= tolerance
        return "degrees" if in_degrees else None
    if value * expected <= 0.0 or abs(expected) <= _TELLING * tolerance:
        return None
    power = round(math.log10(value / expected))
    fits = abs(value / 10.0**power - expected) <= tolerance
    return power if fits and 0 < abs(power) <= MOST_POWERS else None


def in_words(number: Candidate) -> Undone:
    """Describe a wrong number."""
    each = number.difference
    where, should_be = f"{each.parameter} in row {each.row}", f": it should be {each.expected:.9g}"
    if number.slip == "sign":
        return Undone("sign", f"the sign of {where} is wrong{should_be}")
    mistake: Mistake = "degrees" if number.slip else "number"
    words = "in degrees" if number.slip else "wrong"
    if isinstance(number.slip, int):
        mistake, words = power_of_ten(number.slip)
    return Undone(mistake, f"{where} is {words}{should_be}")


def _likelihood(number: Candidate) -> tuple[bool, bool, int, int]:
    """Sort key, the likelier first: a known slip, then a nonzero number, then the earlier row."""
    difference = number.difference
    value = 0.0 if isinstance(difference.value, str | None) else difference.value
    return number.slip is None, abs(value) <= _ZERO, difference.row or 0, PARAMETERS.index(difference.parameter)


def wrapped(angle: float) -> float:
    """Wrap an angle to within half a turn of zero, [rad]."""
    return math.remainder(angle, 2.0 * math.pi)
