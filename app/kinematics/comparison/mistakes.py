"""What people get wrong in a DH table, each mistake made good and the table tried again.

Beside single numbers: the other convention, units, columns or rows exchanged, signs throughout, a joint's sense, a
shifted zero, a base or tool that is not as given. What makes the table describe the chain is a diagnosis.
"""

import math
from collections.abc import Iterator
from dataclasses import dataclass, replace
from typing import NamedTuple

import numpy as np

from app.kinematics.comparison.alignment import Freedom
from app.kinematics.comparison.numbers import Difference, WrongNumber, wrapped, wrong_numbers
from app.kinematics.comparison.placement import Placement, Subject, placed
from app.kinematics.comparison.screws import PARAMETERS
from app.kinematics.comparison.words import Mistake
from app.model.arrays import Array
from app.model.dh import Convention, DhTable
from app.model.errors import quoted

_LOOKS = 24
_ROWS_WITH_TRIALS = 16
"""Longest table of which each row's slips are tried."""


@dataclass(frozen=True, slots=True)
class Diagnosis:
    """A mistake that explains everything.

    Attributes:
        mistake: Of what kind.
        detail: One sentence.
        differences: The numbers that differ, in the order of the table.
        placement: The table with the mistake made good, on the chain.
    """

    mistake: Mistake
    detail: str
    differences: tuple[Difference, ...]
    placement: Placement


class _Trial(NamedTuple):
    """A table with a mistake made good."""

    mistake: Mistake
    detail: str
    table: DhTable


def diagnoses(on: Subject, table: DhTable, freedom: Freedom, signs: Array) -> list[Diagnosis]:
    """Every single mistake that explains why a table does not describe a chain, the likeliest first.

    Args:
        on: The chain.
        table: Its rows are the chain's joints in number and type.
        freedom: What may be found.
        signs: Senses of the joints while single numbers are looked for; shape (n,).
    """
    numbers = [_of_number(number) for number in wrong_numbers(on, table, freedom, signs)]
    slips = [each for each in numbers if each.mistake != "number"]
    others = [each for each in numbers if each.mistake == "number"]
    structural = list(_explaining(on, table, freedom, _trials(table)))
    if not (numbers or structural):
        structural = list(_explaining(on, table, freedom, _double_trials(table)))
    senses = [] if freedom.signs else _relaxed(on, table, freedom, freedom._replace(signs=True))
    shifted = [] if freedom.offsets or numbers else _relaxed(on, table, freedom, freedom._replace(offsets=True))
    return [*slips, *structural, *senses, *others, *shifted, *_misplaced(on, table, freedom)]


_SLIPS: dict[str | None, tuple[Mistake, str]] = {
    None: ("number", "{} is wrong"),
    "sign": ("sign", "the sign of {} is wrong"),
    "degrees": ("degrees", "{} is in degrees"),
    "millimetres": ("millimetres", "{} is in millimetres"),
}


def _of_number(number: WrongNumber) -> Diagnosis:
    each = number.difference
    mistake, words = _SLIPS[number.slip]
    detail = f"{words.format(f'{each.parameter} in row {each.row}')}: it should be {each.expected:.9g}"
    return Diagnosis(mistake, detail, (each,), number.placement)


def _explaining(on: Subject, table: DhTable, freedom: Freedom, trials: Iterator[_Trial]) -> Iterator[Diagnosis]:
    """The trials that describe the chain, each table once; those that change one number alone are a wrong number's."""
    tried = set()
    for trial in trials:
        types = [row.type == "prismatic" for row in trial.table.joints]
        changes = np.count_nonzero(_numbers(trial.table) != _numbers(table))
        is_news = trial.table.convention != table.convention or changes > 1
        if types != on.target.slides.tolist() or not is_news or _key(trial.table) in tried:
            continue
        tried.add(_key(trial.table))
        placement = placed(on.fewer(_LOOKS), trial.table, freedom, strict=True)
        if placement is not None:
            yield Diagnosis(trial.mistake, trial.detail, _between(table, trial.table), placement)


def _trials(table: DhTable) -> Iterator[_Trial]:
    """Single mistakes beside wrong numbers."""
    yield _other_convention(table)
    yield from _units(table)
    yield from _exchanges(table)
    for column, name in enumerate(PARAMETERS):
        numbers = _numbers(table)
        numbers[:, column] *= -1.0
        if np.count_nonzero(numbers[:, column]) > 1:
            yield _Trial("sign", f"the sign of {name} is wrong in all rows", _renumbered(table, numbers))
    if len(table.joints) > 1:
        backwards = replace(table, joints=table.joints[::-1])
        yield _Trial("rows", "the rows stand in reverse order, tip to base", backwards)
    if len(table.joints) <= _ROWS_WITH_TRIALS:
        for i in range(len(table.joints) - 1):
            joints = list(table.joints)
            joints[i : i + 2] = joints[i + 1], joints[i]
            detail = f"rows {i + 1} and {i + 2} are exchanged"
            yield _Trial("rows", detail, replace(table, joints=tuple(joints)))


def _double_trials(table: DhTable) -> Iterator[_Trial]:
    """The other convention together with other units."""
    for trial in _units(table):
        other = _other_convention(trial.table)
        yield _Trial(trial.mistake, f"{trial.detail}, and {other.detail}", other.table)


def _other_convention(table: DhTable) -> _Trial:
    other: Convention = "modified" if table.convention == "standard" else "standard"
    names = {"standard": "standard", "modified": "modified (Craig)"}
    detail = f"the numbers are those of a {names[other]} table, read as {names[table.convention]}"
    return _Trial("convention", detail, replace(table, convention=other))


def _units(table: DhTable) -> Iterator[_Trial]:
    factor = math.pi / 180.0
    for columns, what in (([1, 3], "all angles are"), ([1], "all alpha are"), ([3], "all theta are")):
        yield _scaled(table, columns, factor, "degrees", f"{what} in degrees")
    for columns, what in (([0, 2], "all lengths are"), ([0], "all a are"), ([2], "all d are")):
        yield _scaled(table, columns, 1e-3, "millimetres", f"{what} in millimetres")
    numbers = _numbers(table) * [1e-3, factor, 1e-3, factor]
    detail = "all angles are in degrees and all lengths in millimetres"
    yield _Trial("degrees", detail, _renumbered(table, numbers))


def _scaled(table: DhTable, columns: list[int], factor: float, mistake: Mistake, detail: str) -> _Trial:
    numbers = _numbers(table)
    numbers[:, columns] *= factor
    return _Trial(mistake, detail, _renumbered(table, numbers))


def _exchanges(table: DhTable) -> Iterator[_Trial]:
    numbers = _numbers(table)
    for first, second in ((0, 2), (1, 3)):
        names = f"{PARAMETERS[first]} and {PARAMETERS[second]}"
        order = np.arange(4)
        order[[first, second]] = second, first
        yield _Trial("columns", f"{names} are exchanged in all rows", _renumbered(table, numbers[:, order]))
        if len(numbers) > _ROWS_WITH_TRIALS:
            continue
        for i, row in enumerate(numbers):
            if row[first] != row[second]:
                changed = numbers.copy()
                changed[i] = row[order]
                detail = f"{names} are exchanged in row {i + 1}"
                yield _Trial("columns", detail, _renumbered(table, changed))


def _relaxed(on: Subject, table: DhTable, freedom: Freedom, wider: Freedom) -> list[Diagnosis]:
    """A joint's sense or zero that is not the chain's."""
    if len(on.chain) != len(on.target):
        return []
    placement = placed(on.fewer(_LOOKS), table, wider, strict=True)
    if placement is None:
        return []
    if wider.signs and not freedom.signs:
        rows = np.flatnonzero(placement.signs < 0.0).tolist()
        differences = [_difference(table, i, "sign", 1.0, -1.0) for i in rows]
        joints = ", ".join(quoted(table.joints[i].name) for i in rows)
        detail = f"the joint turns or slides the other way: {joints}; `find` signs to allow for it"
        return [Diagnosis("joint_sense", detail, tuple(differences), placement)]
    rows = np.flatnonzero(np.abs(placement.offsets) > min(on.tolerances)).tolist()
    differences = []
    for i in rows:
        parameter = "theta" if table.joints[i].type == "revolute" else "d"
        value = float(getattr(table.joints[i], parameter))
        differences.append(_difference(table, i, parameter, value, value + float(placement.offsets[i])))
    joints = ", ".join(quoted(table.joints[i].name) for i in rows)
    detail = f"the zero lies elsewhere, of the joints {joints}; `find` offsets to allow for it"
    return [Diagnosis("joint_zero", detail, tuple(differences), placement)]


def _misplaced(on: Subject, table: DhTable, freedom: Freedom) -> list[Diagnosis]:
    """A base or tool that was to be as given, and is not."""
    for places in (("base",), ("tool",), ("base", "tool")):
        if any(getattr(freedom, place) for place in places):
            continue
        wider = freedom._replace(**dict.fromkeys(places, True))
        placement = placed(on.fewer(_LOOKS), table, wider, strict=True)
        if placement is not None:
            which = " and ".join(places)
            detail = f"the rows are right, the {which} would have to be another; `find` {which} to allow for it"
            differences = tuple(Difference(None, None, place, None, None) for place in places)
            return [Diagnosis("base" if "base" in places else "tool", detail, differences, placement)]
    return []


def _between(table: DhTable, repaired: DhTable) -> tuple[Difference, ...]:
    """The numbers in which two tables differ; those of the other convention are first written in this one's."""
    expected = _numbers(repaired)
    if repaired.convention != table.convention:
        expected = _shifted(expected, towards_standard=table.convention == "standard")
    differences = []
    for i, (row, other) in enumerate(zip(_numbers(table), expected, strict=True)):
        for name, value, wanted in zip(PARAMETERS, row.tolist(), other.tolist(), strict=True):
            apart = wrapped(value - wanted) if name in {"alpha", "theta"} else value - wanted
            if abs(apart) > 1e-12:
                differences.append(_difference(table, i, name, value, wanted))
    return tuple(differences)


def _shifted(numbers: Array, towards_standard: bool) -> Array:
    """A table in the other convention, base and tool apart: a and α belong to the link behind, or before, a joint."""
    shifted = numbers.copy()
    shifted[:, :2] = 0.0
    if towards_standard:
        shifted[:-1, :2] = numbers[1:, :2]
    else:
        shifted[1:, :2] = numbers[:-1, :2]
    return shifted


def _difference(table: DhTable, i: int, parameter: str, value: float, expected: float) -> Difference:
    return Difference(i + 1, table.joints[i].name, parameter, value, expected)


def _key(table: DhTable) -> tuple[str, bytes]:
    """What tells two tables of the same joints apart, but for signs of zero."""
    return table.convention, (_numbers(table) + 0.0).tobytes()


def _numbers(table: DhTable) -> Array:
    """a, α, d, θ as they are written; shape (n, 4)."""
    return np.array([[row.a, row.alpha, row.d, row.theta] for row in table.joints])


def _renumbered(table: DhTable, numbers: Array) -> DhTable:
    joints = tuple(
        replace(joint, **dict(zip(PARAMETERS, row, strict=True)))
        for joint, row in zip(table.joints, numbers.tolist(), strict=True)
    )
    return replace(table, joints=joints)
