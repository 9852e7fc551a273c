"""Tests of repaired tables on a chain: a repair that makes the table describe the chain is a diagnosis.

Wrong numbers are also looked for beside another mistake, including the numbers of a missing row. The parts of a table
before and after a wrong number each agree with the chain. So only links between two such parts are searched, and least
squares finds the number together with the base, from several starting values of each angle.
"""

import itertools
from collections.abc import Iterator, Sequence
from dataclasses import dataclass, replace
from typing import NamedTuple

import numpy as np

from gelenk.dh.compare.alignment import Freedom
from gelenk.dh.compare.invariants import Invariants
from gelenk.dh.compare.numbers import MISFIT, Difference, explained, in_words, is_absorbed, misfits, wrapped
from gelenk.dh.compare.placement import Placement, Subject, placed, unknowns_of
from gelenk.dh.compare.repairs import Repairs, Undone
from gelenk.dh.compare.screws import (
    BASE_DIRECTIONS,
    PARAMETERS,
    Tables,
    fit,
    geometry,
    numbers_of,
    parameters_of,
    polished,
)
from gelenk.dh.compare.words import LOOKS, Mistake
from gelenk.robot.arrays import Array, Flags
from gelenk.robot.dh import Convention, DhJoint, DhTable

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


_MOST_JOBS = 160
_MOST_STARTS = 1600
_MOST_FOUND = 12
_FIRST_STEPS = 4
"""Number of steps after which only the best starts are continued."""
_KEPT = 64


class _Job(NamedTuple):
    """Places of the numbers to find in a repaired table, those of a missing row first."""

    repair: int
    missing: tuple[int, ...]
    wrong: tuple[int, ...]


def with_numbers(on: Subject, table: DhTable, freedom: Freedom, repairs: Repairs, count: int) -> list[Diagnosis]:
    """Find repairs that, with `count` numbers corrected besides missing rows, make a table describe a chain."""
    invariants = Invariants(on, freedom)
    found: list[Diagnosis] = []
    for some in by_convention(on, table, repairs):
        rows, convention = parameters(table, some), some.convention(table)
        axes = invariants.axes(convention, rows, some.senses * on.senses, table)
        open_links = [invariants.straddles[misfit] for misfit in invariants.misfits(axes)]
        jobs = _jobs(convention, freedom, some, open_links, count)
        for _, same in itertools.groupby(sorted(itertools.islice(jobs, _MOST_JOBS), key=_size), key=_size):
            found += _found(on, table, freedom, some, rows, list(same))
    return sorted(found, key=lambda diagnosis: "number" in diagnosis.mistakes)


def _size(job: _Job) -> int:
    return len(job.missing) + len(job.wrong)


def _jobs(
    convention: Convention, freedom: Freedom, repairs: Repairs, open_links: Sequence[Flags], count: int
) -> Iterator[_Job]:
    """Jobs for the numbers between parts that agree; of each repair the links that each violated invariant spans."""
    n = repairs.rows.shape[1]
    places = [p for p in range(4 * n) if not is_absorbed(convention, n, freedom, *divmod(p, 4))]
    # Craig's a and α lead to the joint of their row, all other numbers to the next one.
    links = {p: p // 4 + (0 if convention == "modified" and p % 4 < 2 else 1) for p in range(4 * n)}
    for c, (row, left) in enumerate(zip(repairs.rows.tolist(), open_links, strict=True)):
        missing = tuple(p for p in places if row[p // 4] < 0)
        bridged = {links[p] for p in range(4 * n) if row[p // 4] < 0}
        if bridged:
            left = left[~left[:, sorted(bridged)].any(axis=1)]  # noqa: PLW2901
        for wrong_links in itertools.combinations_with_replacement(range(n + 1), count):
            if left[:, list(wrong_links)].any(axis=1).all():
                among = [[p for p in places if links[p] == link and p not in missing] for link in wrong_links]
                for wrong in itertools.product(*among):
                    if all(p < q for p, q in itertools.pairwise(wrong)):
                        yield _Job(c, missing, wrong)


def _found(
    on: Subject, table: DhTable, freedom: Freedom, repairs: Repairs, rows: Array, jobs: Sequence[_Job]
) -> list[Diagnosis]:
    """Diagnoses from the jobs that succeed, at most `_MOST_FOUND`."""
    origins, starts = [], []
    for k, job in enumerate(jobs):
        for start in _starts(rows[job.repair], (*job.missing, *job.wrong)):
            origins.append(k)
            starts.append(start)
    origins, starts = origins[:_MOST_STARTS], starts[:_MOST_STARTS]
    held = freedom._replace(signs=False)
    of = np.array(origins)
    repair = np.array([job.repair for job in jobs])[of]
    senses = repairs.senses[repair] * on.senses
    bases = np.repeat((np.eye(4) if freedom.base else table.base)[None], len(of), axis=0)
    tables = Tables(repairs.convention(table), on.target.slides, senses, np.array(starts), bases, table.tool)
    if freedom.base:
        tables = tables._replace(bases=_bases(on, tables))
    common = unknowns_of(on.target, tables, held)
    own = np.array([[BASE_DIRECTIONS + p for p in (*job.missing, *job.wrong)] for job in jobs], dtype=np.int64)[of]
    kept = ~np.isin(own, common).any(axis=1)
    tables, of, own = tables.only(np.flatnonzero(kept)), of[kept], own[kept]
    if not len(of):
        return []
    unknowns = np.column_stack((np.tile(common, (len(own), 1)), own))
    with_tip = not freedom.tool
    tables, costs = fit(on.target, tables, unknowns, with_tip, _FIRST_STEPS)
    leading = np.argsort(costs, kind="stable")[:_KEPT]
    of, unknowns = of[leading], unknowns[leading]
    tables, costs = fit(on.target, tables.only(leading), unknowns, with_tip)
    fits = misfits(on, tables, with_tip) <= MISFIT
    found: dict[int, Diagnosis] = {}
    for c in sorted(np.flatnonzero(fits).tolist(), key=lambda c: (of[c], costs[c])):
        if of[c] not in found and len(found) < _MOST_FOUND:
            nearest = polished(on.target, tables.only(np.array([c])), unknowns[[c]], with_tip).rows[0]
            job = jobs[of[c]]
            diagnosis = _diagnosis(on, table, freedom, repairs.only(np.array([job.repair])), job, nearest)
            if diagnosis is not None:
                found[of[c]] = diagnosis
    return list(found.values())


def _starts(rows: Array, places: Sequence[int]) -> Iterator[Array]:
    """Starting tables, with the angles among some places over a full turn."""
    angles = [p for p in places if p % 4 in {1, 3}]
    turns = {0: 1, 1: 8, 2: 6}.get(len(angles), 4)
    for steps in itertools.product(range(turns), repeat=len(angles)):
        start = rows.flatten()
        start[angles] += 2.0 * np.pi / turns * np.array(steps)
        yield start.reshape(rows.shape)


def _bases(on: Subject, tables: Tables) -> Array:
    """Bases that rotate the axes of tables towards a chain's; shape (C, 4, 4)."""
    twists = geometry(tables).twists
    directions = np.where(tables.slides[:, None], twists[..., :3], twists[..., 3:])
    U, _, Vt = np.linalg.svd(np.einsum("ni,cnj->cij", on.target.directions, directions))
    U[..., 2] *= np.linalg.det(U @ Vt)[:, None]
    bases = np.repeat(np.eye(4)[None], len(twists), axis=0)
    bases[:, :3, :3] = U @ Vt
    return bases


def _diagnosis(
    on: Subject, table: DhTable, freedom: Freedom, repair: Repairs, job: _Job, rows: Array
) -> Diagnosis | None:
    before = table_of(on, table, repair, repair.numbers(numbers_of(table))[0])
    numbers, further = numbers_of(before), []
    for place in (*job.missing, *job.wrong):
        number = explained(on, before, place, float(rows.ravel()[place]))
        numbers[divmod(place, 4)] = number.difference.expected
        if place in job.wrong:
            further.append(in_words(number))
    repaired = table_of(on, table, repair, numbers)
    diagnosis = judged(on, table, freedom, repair, repaired, further)
    if diagnosis is None:
        return None
    # Numbers of a missing row that base or tool compensate are unknown.
    known = [
        each
        for each in diagnosis.differences
        if each.joint is not None
        or each.parameter == "joints"
        or 4 * ((each.row or 0) - 1) + PARAMETERS.index(each.parameter) in job.missing
    ]
    return replace(diagnosis, differences=tuple(known))
