"""Search for wrong numbers in addition to another mistake, including the numbers of a missing row.

The parts of a table before and after a wrong number each agree with the chain. So only links between two such parts
are searched, and least squares finds the number together with the base, from several starting values of each angle.
"""

import itertools
from collections.abc import Iterator, Sequence
from dataclasses import replace
from typing import NamedTuple

import numpy as np

from gelenk.dh.compare.alignment import Freedom
from gelenk.dh.compare.invariants import Invariants
from gelenk.dh.compare.numbers import MISFIT, explained, in_words, is_absorbed, misfits
from gelenk.dh.compare.placement import Subject, unknowns_of
from gelenk.dh.compare.repairs import Repairs
from gelenk.dh.compare.screws import BASE_DIRECTIONS, PARAMETERS, Tables, fit, geometry, numbers_of, polished
from gelenk.dh.compare.trials import Diagnosis, by_convention, judged, parameters, table_of
from gelenk.robot.arrays import Array, Flags
from gelenk.robot.dh import Convention, DhTable

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
