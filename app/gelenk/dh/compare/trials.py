"""Tests of repaired tables on a chain: a repair that makes the table describe the chain is a diagnosis."""

from collections.abc import Iterator, Sequence
from dataclasses import dataclass, replace

import numpy as np

from gelenk.dh.compare.alignment import Freedom
from gelenk.dh.compare.invariants import Invariants
from gelenk.dh.compare.numbers import Difference, wrapped
from gelenk.dh.compare.placement import Placement, Subject, placed
from gelenk.dh.compare.repairs import Repairs, Undone
from gelenk.dh.compare.screws import PARAMETERS, numbers_of, parameters_of
from gelenk.dh.compare.words import LOOKS, Mistake
from gelenk.robot.arrays import Array
from gelenk.robot.dh import DhJoint, DhTable

_MOST_LOOKS = 24
"""Largest number of repaired tables tested among those whose axes agree."""


@dataclass(frozen=True, slots=True)
class Diagnosis:
    """Mistakes, usually one or two, whose correction makes the table describe the chain, as `placement` shows.

    `detail` describes them in one sentence; `differences` are in the order of the table.
    """

    mistakes: tuple[Mistake, ...]
    detail: str
    differences: tuple[Difference, ...]
    placement: Placement


def by_convention(on: Subject, table: DhTable, repairs: Repairs) -> Iterator[Repairs]:
    """Group by convention the repairs whose rows match the chain's joint types."""
    slides = np.array([row.type == "prismatic" for row in table.joints])
    rows = repairs.rows
    fits = ((slides[rows] == on.target.slides) | (rows < 0)).all(axis=1)
    for switched in (False, True):
        chosen = np.flatnonzero(fits & (repairs.switched == switched))
        if len(chosen):
            yield repairs.only(chosen)


def parameters(table: DhTable, repairs: Repairs) -> Array:
    """Compute the numbers of repaired tables, including the offsets of mimic rows; shape (N, m, 4)."""
    numbers = repairs.numbers(numbers_of(table))
    added = parameters_of(table) - numbers_of(table)
    return numbers + added if added.any() else numbers


def explaining(on: Subject, table: DhTable, freedom: Freedom, repairs: Repairs) -> list[Diagnosis]:
    """Find the repairs that make a table describe a chain, in order, without duplicate tables."""
    if not len(repairs.undone):
        return []
    invariants = Invariants(on, freedom)
    found: list[Diagnosis] = []
    tried: set[tuple[str, bytes, bytes]] = set()
    for some in by_convention(on, table, repairs):
        axes = invariants.axes(some.convention(table), parameters(table, some), some.senses * on.senses, table)
        for one in invariants.agreeing(axes).tolist():
            repair = some.only(np.array([one]))
            numbers = repair.numbers(numbers_of(table))[0]
            key = some.convention(table), (np.round(numbers, 9) + 0.0).tobytes(), repair.senses.tobytes()
            if key in tried or len(tried) >= _MOST_LOOKS:
                continue
            tried.add(key)
            diagnosis = judged(on, table, freedom, repair, table_of(on, table, repair, numbers))
            found += [] if diagnosis is None else [diagnosis]
    return found


def judged(
    on: Subject, table: DhTable, freedom: Freedom, repair: Repairs, repaired: DhTable, further: Sequence[Undone] = ()
) -> Diagnosis | None:
    """Return the diagnosis if the repaired table describes the chain; `further` names other mistakes it corrects."""
    placement = placed(on.fewer(LOOKS), repaired, freedom, strict=True, senses=repair.senses[0])
    if placement is None:
        return None
    undone = [*repair.undone[0], *further]
    detail = ", and ".join(each.detail for each in undone)
    differences = between(table, repaired, repair.rows[0].tolist(), repair.senses[0])
    return Diagnosis(tuple(each.mistake for each in undone), detail, differences, placement)


def table_of(on: Subject, table: DhTable, repair: Repairs, numbers: Array) -> DhTable:
    """Create a repaired table with the given numbers; shape (m, 4)."""
    joints = []
    for i, (source, row) in enumerate(zip(repair.rows[0].tolist(), numbers.tolist(), strict=True)):
        missing = DhJoint(f"missing row {i + 1}", "prismatic" if on.target.slides[i] else "revolute", *row)
        joint = missing if source < 0 else table.joints[source]
        joints.append(replace(joint, **dict(zip(PARAMETERS, row, strict=True))))
    return replace(table, convention=repair.convention(table), joints=tuple(joints))


def between(table: DhTable, repaired: DhTable, rows: Sequence[int], senses: Array) -> tuple[Difference, ...]:
    """List the differences between a table and its repair, after converting the repair to the table's convention.

    `rows` has the row of the given table that each repaired row comes from, -1 if missing there; `senses` are -1 where
    a joint of the repaired table is reversed.
    """
    expected = numbers_of(repaired)
    if repaired.convention != table.convention:
        expected = _shifted(expected, towards_standard=table.convention == "standard")
    given = numbers_of(table)
    same_count = len(given) == len(expected) and -1 not in rows
    counts = float(len(given)), float(len(expected))
    left_out = [] if same_count else sorted(set(range(len(given))) - set(rows))
    differences = [Difference(i + 1, table.joints[i].name, "joints", *counts) for i in left_out]
    for i, (source, wanted) in enumerate(zip(rows, expected.tolist(), strict=True)):
        if source < 0:
            differences.append(Difference(i + 1, None, "joints", *counts))
            differences += [Difference(i + 1, None, *each) for each in zip(PARAMETERS, [None] * 4, wanted, strict=True)]
            continue
        place = i if same_count else source
        joint = table.joints[place].name
        for name, value, number in zip(PARAMETERS, given[place].tolist(), wanted, strict=True):
            apart = wrapped(value - number) if name in {"alpha", "theta"} else value - number
            if abs(apart) > 1e-12:
                differences.append(Difference(place + 1, joint, name, value, number))
        if senses[i] < 0.0:
            differences.append(Difference(place + 1, joint, "sign", 1.0, -1.0))
    return tuple(differences)


def _shifted(numbers: Array, towards_standard: bool) -> Array:
    """The numbers in the other convention, without base and tool: a and α move to the row before or after."""
    shifted = numbers.copy()
    shifted[:, :2] = 0.0
    if towards_standard:
        shifted[:-1, :2] = numbers[1:, :2]
    else:
        shifted[1:, :2] = numbers[:-1, :2]
    return shifted
