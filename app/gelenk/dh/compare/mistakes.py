"""Search for common mistakes in a DH table: each is corrected and the table tested again, then pairs of mistakes.

Besides single numbers: the other convention, units, exchanged columns or rows, a missing or doubled row, wrong signs
throughout, a joint's sense, a shifted zero, a wrong base or tool. A correction that makes the table describe the chain
is a diagnosis.
"""

import itertools

import numpy as np

from gelenk.dh.compare import repairs
from gelenk.dh.compare.alignment import Freedom
from gelenk.dh.compare.numbers import MOST_POWERS, Difference, in_words, wrong_numbers
from gelenk.dh.compare.placement import Subject, placed
from gelenk.dh.compare.repairs import Repairs
from gelenk.dh.compare.screws import numbers_of
from gelenk.dh.compare.trials import Diagnosis, explaining, with_numbers
from gelenk.dh.compare.words import LOOKS, Mistake
from gelenk.errors import quoted
from gelenk.robot.arrays import Array
from gelenk.robot.dh import DhTable

_ROWS_WITH_TRIALS = 16
"""Largest number of rows for which mistakes in single rows are tried."""
ROWS_WITH_PAIRS = 8
"""Largest number of rows for which pairs of mistakes are tried."""
_POWERS_IN_PAIRS = 3
_WEAK = {"joint_zero", "joint_sense", "base", "tool"}
"""Mistakes that may mask two others, which are then reported too."""


def diagnoses(on: Subject, table: DhTable, freedom: Freedom, signs: Array) -> list[Diagnosis]:
    """Find single mistakes, or else pairs, that explain why a table does not describe a chain; the likeliest first.

    The rows match the chain's joints in number and type; `signs` (n,) are the senses in the search for single numbers.
    """
    numbers = _wrong_numbers(on, table, freedom, signs)
    slips = [each for each in numbers if each.mistakes != ("number",)]
    others = [each for each in numbers if each.mistakes == ("number",)]
    single = _repairs(on, table, freedom, MOST_POWERS)
    structural = explaining(on, table, freedom, single.only(~single.alone))
    loosened = [(wider, _loosened(on, table, freedom, wider)) for wider in _wider(on, freedom, 1)]
    senses = [each for wider, some in loosened if wider.signs != freedom.signs for each in some]
    zeros = [each for wider, some in loosened if wider.offsets != freedom.offsets and not numbers for each in some]
    moved = [each for wider, some in loosened if wider[2:] == freedom[2:] for each in some][:1]
    found = [*slips, *structural, *senses, *others, *zeros, *moved]
    if all(_WEAK.issuperset(each.mistakes) for each in found) and len(table.joints) <= ROWS_WITH_PAIRS:
        found += _pairs(on, table, freedom, signs, loosely=not found)
    return found


def diagnoses_of_rows(on: Subject, table: DhTable, freedom: Freedom) -> list[Diagnosis]:
    """Find mistakes in a table whose rows do not match the chain's joints in number or type."""
    n, excess = len(table.joints), len(table.joints) - len(on.target)
    if abs(excess) > 2 or max(n, len(on.target)) > _ROWS_WITH_TRIALS:
        return []
    numbers = numbers_of(table)
    one = repairs.without_a_row(numbers) if excess > 0 else repairs.with_a_row(n)
    single = _repairs(on, table, freedom, _POWERS_IN_PAIRS)
    found = []
    if abs(excess) < 2:
        found = _counted(on, table, freedom, one if excess else single)
    if found or len(on.target) > ROWS_WITH_PAIRS:
        return found
    if excess == 0:
        return _two(on, table, freedom, single)
    if abs(excess) == 1:
        return _counted(on, table, freedom, single.then(one)) or with_numbers(on, table, freedom, one, 1)
    for i in range(len(one.undone)):
        first = one.only(np.array([i]))
        left = first.numbers(numbers)[0]
        second = repairs.without_a_row(left) if excess > 0 else repairs.with_a_row(n + 1)
        found += _counted(on, table, freedom, first.then(second))
    return found


def _wrong_numbers(on: Subject, table: DhTable, freedom: Freedom, signs: Array) -> list[Diagnosis]:
    found = []
    for number, placement in wrong_numbers(on, table, freedom, signs):
        undone = in_words(number)
        found.append(Diagnosis((undone.mistake,), undone.detail, (number.difference,), placement))
    return found


def _repairs(on: Subject, table: DhTable, freedom: Freedom, powers: int) -> Repairs:
    # Mimic rows depend on the order of rows through the names of their leaders.
    plain = len(on.chain) == len(on.target) and all(row.mimic is None for row in table.joints)
    return repairs.of_rows(table, powers, reorder=plain, turn=plain and not freedom.signs)


def _pairs(on: Subject, table: DhTable, freedom: Freedom, signs: Array, loosely: bool) -> list[Diagnosis]:
    """Pairs of mistakes; if `loosely` and no pair in the rows is found, also with zeros, senses, base or tool free."""
    single = _repairs(on, table, freedom, _POWERS_IN_PAIRS)
    found = _two(on, table, freedom, single)
    if found or not loosely:
        return found
    for wider in _wider(on, freedom, 2):
        found += _loosened(on, table, freedom, wider)
    for wider in _wider(on, freedom, 1):
        found += [_and_loose(on, each, freedom, wider) for each in explaining(on, table, wider, single)]
        # One joint's sense or zero with a wrong number was tried before: here several joints would be affected.
        placed_only = wider[2:] == freedom[2:] and not (
            wider.base and wider.tool and not (freedom.base or freedom.tool)
        )
        numbers = _wrong_numbers(on, table, wider, signs) if placed_only and not found else []
        found += [_and_loose(on, each, freedom, wider) for each in numbers]
    return found


def _two(on: Subject, table: DhTable, freedom: Freedom, single: Repairs) -> list[Diagnosis]:
    found = explaining(on, table, freedom, single.then(single))
    if found or len(on.chain) != len(on.target):
        return found
    n = len(table.joints)
    once = repairs.without_a_row(numbers_of(table))
    # Replacing an arbitrary row would invent four numbers.
    once = once.only(np.array([each.mistake == "row_doubled" for each in once.undone[:, 0]]))
    swapped = once.then(repairs.with_a_row(n - 1))
    return [
        *with_numbers(on, table, freedom, single, 1),
        *with_numbers(on, table, freedom, repairs.unchanged(n), 2),
        *with_numbers(on, table, freedom, swapped, 0),
    ]


def _counted(on: Subject, table: DhTable, freedom: Freedom, some: Repairs) -> list[Diagnosis]:
    """Diagnoses from repairs that change the number of rows; the numbers of missing rows are found."""
    return with_numbers(on, table, freedom, some, 0) if (some.rows < 0).any() else explaining(on, table, freedom, some)


def _wider(on: Subject, freedom: Freedom, count: int) -> list[Freedom]:
    """Freedoms with `count` more free quantities, senses first, then zeros, base and tool."""
    names = ["signs", "offsets"] if len(on.chain) == len(on.target) <= _ROWS_WITH_TRIALS else []
    held = [name for name in (*names, "base", "tool") if not getattr(freedom, name)]
    wider = [freedom._replace(**dict.fromkeys(some, True)) for some in itertools.combinations(held, count)]
    if count == 1 and {"base", "tool"}.issubset(held):
        wider.append(freedom._replace(base=True, tool=True))
    return wider


def _loosened(on: Subject, table: DhTable, freedom: Freedom, wider: Freedom) -> list[Diagnosis]:
    """Diagnosis that senses, zeros, base or tool are wrong, if more freedom makes the table fit."""
    placement = placed(on.fewer(LOOKS), table, wider, strict=True)
    return [] if placement is None else [_and_loose(on, Diagnosis((), "", (), placement), freedom, wider)]


def _and_loose(on: Subject, diagnosis: Diagnosis, freedom: Freedom, wider: Freedom) -> Diagnosis:
    """A diagnosis extended by the quantities found with more freedom."""
    placement = diagnosis.placement
    joints = placement.table.joints
    mistakes, details, differences = list(diagnosis.mistakes), [diagnosis.detail], list(diagnosis.differences)
    if wider.signs and not freedom.signs:
        rows = np.flatnonzero(placement.signs < 0.0).tolist()
        differences += [Difference(i + 1, joints[i].name, "sign", 1.0, -1.0) for i in rows]
        mistakes.append("joint_sense")
        names = ", ".join(quoted(joints[i].name) for i in rows)
        details.append(f"the joint moves in the opposite direction: {names}; `find` signs to allow for it")
    if wider.offsets and not freedom.offsets:
        rows = np.flatnonzero(np.abs(placement.offsets) > min(on.tolerances)).tolist()
        for i in rows:
            parameter = "theta" if joints[i].type == "revolute" else "d"
            value = float(getattr(joints[i], parameter))
            wanted = value + float(placement.offsets[i])
            differences.append(Difference(i + 1, joints[i].name, parameter, value, wanted))
        mistakes.append("joint_zero")
        names = ", ".join(quoted(joints[i].name) for i in rows)
        details.append(f"the zero is shifted for the joints {names}; `find` offsets to allow for it")
    places: list[Mistake] = [place for place in _PLACES if getattr(wider, place) and not getattr(freedom, place)]
    if places:
        which = " and ".join(places)
        rest = "" if diagnosis.mistakes else "the rows are right, "
        details.append(f"{rest}the {which} must be different; `find` {which} to allow for it")
        differences += [Difference(None, None, place, None, None) for place in places]
    return Diagnosis((*mistakes, *places), ", and ".join(filter(None, details)), tuple(differences), placement)


_PLACES: tuple[Mistake, ...] = ("base", "tool")
