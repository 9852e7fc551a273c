"""Solutions that touch nothing: of an arm's branches the nearest to the seed, of a self-motion the nearest found."""

from collections.abc import Callable, Mapping, Sequence
from dataclasses import replace
from typing import TypeAlias

import numpy as np

from gelenk.collision.cell import Cell
from gelenk.collision.contact.gradient import soft_clearances
from gelenk.ik.analytic import joined
from gelenk.ik.search.bounds import target_rows
from gelenk.ik.search.null_space import settled
from gelenk.ik.search.problem import TargetProblem
from gelenk.ik.search.restarts import solutions_by_distance
from gelenk.ik.search.search import ITERATIONS_PER_START, MAX_ITERATIONS, chunk_of, in_pieces
from gelenk.ik.verdict.fixed import narrowed, widened
from gelenk.ik.verdict.judge import assembled, certify, judged
from gelenk.ik.verdict.result import COLUMNS, InverseKinematics, UnsolvedTarget, firsts_of
from gelenk.robot.arrays import Array, Flags, Indices

NEAR = 8
"""Starts around a solution in contact; the others are all over the ranges of the joints."""
_NEAR_SEED = 1.0
"""Distance of a solution from its seed in each joint up to which others around it come first, [rad or m]."""
_GROWTH = 2
"""Each round of starts ends at so many times the number at which the last did."""
_PIECE = 1024
"""Configurations that one thread judges at a time, in some milliseconds."""
_LOOKED_AT = 32
"""Solutions in contact, of a target that has no others, among which the best is looked for."""

_WIDTH = 1e-3
"""Pairs about as far apart as this all count in the objective `clearance`, [m]: it changes smoothly between them."""

Answered: TypeAlias = Callable[[TargetProblem], InverseKinematics]
"""Solves a problem without a look at contacts."""


def clear_answer(problem: TargetProblem, cell: Cell, answered: Answered) -> InverseKinematics:
    """Solve a problem by solutions that touch nothing; where all are requested, tell those in contact apart instead."""
    problem = replace(problem, is_draft=True)
    objective = problem.options.objective
    plain = problem if objective is None else replace(problem, options=replace(problem.options, objective=None))
    found = answered(plain)
    touching = _touching(problem, cell, found.qs)
    if problem.options.every:
        found = _told_apart(problem, cell, found, touching)
    else:
        if (rows := np.flatnonzero(touching)).size:
            rest = _others(problem.taken(found.owners[rows]), cell, found.qs[rows], answered)
            found = _put(found, rows, rest)
        if objective is not None:
            found = _settled(problem, cell, found)
        found.touching = np.zeros(len(found.qs), dtype=bool)
    certify(problem, found)
    return found


def _touching(problem: TargetProblem, cell: Cell, qs: Array) -> Flags:
    touching = np.empty(len(qs), dtype=bool)

    def judge(part: slice) -> None:
        touching[part] = cell.touching(widened(problem.chain, qs[part])[1])

    in_pieces(judge, len(qs), _PIECE, small=False)
    return touching


def _put(found: InverseKinematics, rows: Indices, rest: InverseKinematics) -> InverseKinematics:
    """Put other solutions into some rows of an answer with one for each target, without the rows of those unsolved."""
    is_solved = np.diff(rest.firsts) > 0
    for name in COLUMNS:
        column = getattr(found, name).copy()
        column[rows[is_solved]] = getattr(rest, name)
        setattr(found, name, column)
    found.form, found.is_counted = found.form or rest.form, found.is_counted or rest.is_counted
    if is_solved.all():
        return found
    left, keep = found.owners[rows], np.ones(len(found.qs), dtype=bool)
    keep[rows[~is_solved]] = False
    failures = {int(left[k]): failure for k, failure in rest.failures.items()}
    return replace(_with_rows(found, keep), failures=dict(sorted({**found.failures, **failures}.items())))


def _with_rows(found: InverseKinematics, rows: Flags) -> InverseKinematics:
    """Return the answer with some rows of its table only."""
    return replace(found, **found.rows(np.flatnonzero(rows)), firsts=firsts_of(found.owners[rows], len(found)))


def _others(problem: TargetProblem, cell: Cell, qs: Array, answered: Answered) -> InverseKinematics:
    """Look for free solutions of targets of which one each is in contact; shape (N, n), [rad or m]."""
    options = problem.options
    if options.method not in {"auto", "analytic"} or options.trace:
        # One start is followed, and no other.
        return _explained(problem, cell, _nothing(problem, qs), [q[None] for q in qs])
    if options.method == "analytic" or len(problem.chain) <= len(problem.task):
        return _of_branches(problem, cell, qs, answered)
    return _of_self_motion(problem, cell, qs)


def _nothing(problem: TargetProblem, qs: Array) -> InverseKinematics:
    none = np.zeros(len(qs), dtype=bool)
    return assembled(len(qs), np.arange(len(qs)), qs, judged(problem, qs, none), {})


def _of_branches(problem: TargetProblem, cell: Cell, qs: Array, answered: Answered) -> InverseKinematics:
    """Return the nearest free one to the seed of all branches of each target; see `_others`."""
    every = answered(replace(problem, options=replace(problem.options, every=True)))
    free = cell.first_free(widened(problem.chain, every.qs)[1], np.arange(len(every.qs)), every.firsts)
    picked = np.zeros(len(every.qs), dtype=bool)
    picked[free[free >= 0]] = True
    tried = [some if len(some) else q[None] for some, q in zip(np.split(every.qs, every.firsts[1:-1]), qs, strict=True)]
    one = replace(_with_rows(every, picked), failures={}, every=False, doubts={})
    return _explained(problem, cell, one, tried, proofs=every.complete)


def _of_self_motion(problem: TargetProblem, cell: Cell, qs: Array) -> InverseKinematics:
    """Return the nearest free solution to the seed that the first successful round of starts leads to; see `_others`.

    The first round starts around those of `qs` that are near their seed, each other one all over the joints' ranges.
    """
    chain, targets, seeds = problem.chain, target_rows(problem.targets), problem.seeds
    best, found, starts = qs.copy(), np.zeros(len(qs), dtype=bool), np.zeros(len(qs), dtype=np.int64)
    tried, counts = dict[int, list[Array]](), np.ones(len(qs), dtype=np.int64)
    is_near = np.abs(qs - seeds).max(axis=1) <= _NEAR_SEED
    most = NEAR + (problem.options.max_iterations or MAX_ITERATIONS) // ITERATIONS_PER_START

    def look(left: Indices, first: int, last: int) -> None:
        starting = targets[left], qs[left], seeds[left] if len(seeds) > 1 else seeds, first, NEAR
        ends, order, firsts = solutions_by_distance(chain.flat, problem.goal(last), *starting)
        rows = cell.first_free(widened(chain, ends)[1], order, firsts)
        is_free = rows >= 0
        solved = left[is_free]
        best[solved], found[solved], starts[solved] = ends[rows[is_free]], True, first
        for k in np.flatnonzero(~is_free).tolist():
            i, own = int(left[k]), order[firsts[k] : firsts[k + 1]]
            if counts[i] < _LOOKED_AT:
                tried.setdefault(i, [qs[i : i + 1]]).append(ends[own[:_LOOKED_AT]])
            counts[i] += len(own)

    def solve(part: slice) -> None:
        targets = np.arange(part.start, part.stop)
        left, first, last = targets[is_near[part]], 1, NEAR + 1
        while first < most and not problem.is_over and not found[part].all():
            if len(left):
                look(left, first, last)
            left, first, last = targets[~found[part]], last, min(_GROWTH * last, most)

    in_pieces(solve, len(qs), chunk_of(chain), problem.deadline is not None)
    one = assembled(len(qs), np.arange(len(qs)), best, judged(problem, best, found), {"restarts": starts})
    some = {i: np.concatenate(tried.get(i, [qs[i : i + 1]])) for i in _unsolved(one)}
    return _explained(problem, cell, one, some, counts) if some else one


def _unsolved(answer: InverseKinematics) -> list[int]:
    return np.flatnonzero(answer.firsts[1:] == answer.firsts[:-1]).tolist()


def _told_apart(problem: TargetProblem, cell: Cell, found: InverseKinematics, touching: Flags) -> InverseKinematics:
    """Flag the solutions in contact, and put them behind the others of their target."""
    has_free = np.bincount(found.owners, ~touching, minlength=len(found)) > 0
    left = np.flatnonzero((np.diff(found.firsts) > 0) & ~has_free)
    if len(left):
        own, qs = problem.taken(left), found.qs[found.firsts[left]]
        if problem.options.method == "auto" and len(problem.chain) > len(problem.task):
            rest = _of_self_motion(own, cell, qs)
        else:
            tried = [found.qs[found.firsts[i] : found.firsts[i + 1]] for i in left.tolist()]
            proofs = found.complete and [found.complete[i] for i in left.tolist()]
            rest = _explained(own, cell, _nothing(own, qs), tried, proofs=proofs)
        found = _merged(found, left, rest)
        touching = _touching(problem, cell, found.qs)
    order = np.lexsort((touching, found.owners))
    order = order[np.arange(len(order)) - found.firsts[found.owners] < problem.options.most]
    owners = found.owners[order]
    return replace(found, **found.rows(order), firsts=firsts_of(owners, len(found)), touching=touching[order])


def _merged(found: InverseKinematics, left: Indices, rest: InverseKinematics) -> InverseKinematics:
    """Insert solutions and failures of the targets `left`, shape (k,), into an answer."""
    both = joined(found, left, rest)
    failures = dict(sorted({**found.failures, **both.failures}.items()))
    is_counted = found.is_counted or rest.is_counted
    return replace(both, failures=failures, doubts=found.doubts, form=found.form or rest.form, is_counted=is_counted)


def _settled(problem: TargetProblem, cell: Cell, found: InverseKinematics) -> InverseKinematics:
    """Move the solutions along their self-motion to a nearby minimum of the objective, past no contact."""
    own, objective = problem.taken(found.owners), problem.options.objective
    if objective is not None and objective.name == "clearance":
        objective = replace(objective, clearance=lambda qs: _soft_clearances(own, cell, qs))
        own.options = replace(own.options, objective=objective)
    qs = settled(own, found.qs, np.ones(len(found.qs), dtype=bool), lambda qs: _touching(own, cell, qs))
    solved, *errors = judged(own, qs)
    before = found.qs, found.position_errors, found.orientation_errors
    qs, positions, orientations = (
        np.where(solved.reshape(-1, *[1] * (new.ndim - 1)), new, old)
        for new, old in zip((qs, *errors), before, strict=True)
    )
    none = np.zeros_like(found.free)
    return replace(
        found,
        qs=qs,
        position_errors=positions,
        orientation_errors=orientations,
        codes=none - 1,
        free=none,
        form=None,
    )


def _soft_clearances(problem: TargetProblem, cell: Cell, qs: Array) -> tuple[Array, Array]:
    clearances, gradients = soft_clearances(cell.world.flat, widened(problem.chain, qs)[1], _WIDTH)
    return clearances, narrowed(problem.chain, gradients)


def _explained(
    problem: TargetProblem,
    cell: Cell,
    answer: InverseKinematics,
    tried: Sequence[Array] | Mapping[int, Array],
    counts: Indices | None = None,
    proofs: list[bool] | None = None,
) -> InverseKinematics:
    """Add the verdict on targets without a free solution.

    Args:
        tried: Solutions in contact of each such target, at least one; shape (k, n) each.
        counts: How many there are, if `tried` has only some of them; shape (N,).
        proofs: Whether these are proved to be all there are.
    """
    left = _unsolved(answer)
    if not left:
        return answer
    qs = np.concatenate([tried[i][:_LOOKED_AT] for i in left])
    owners = np.repeat(np.arange(len(left)), [len(tried[i][:_LOOKED_AT]) for i in left])
    nearest = cell.nearest(widened(problem.chain, qs)[1])
    order = np.lexsort((-nearest.clearances, owners))
    rows = order[np.unique(owners[order], return_index=True)[1]]
    _, *errors = judged(problem.taken(np.array(left)), qs[rows])
    failures = {}
    for k, i in enumerate(left):
        row, is_all = int(rows[k]), proofs is not None and proofs[i]
        number = len(tried[i]) if counts is None else int(counts[i])
        reason = f"{_count(number, is_all)}: {cell.contact(int(nearest.pairs[row]), nearest.distances[row])}"
        late = problem.is_over and not is_all
        failures[i] = UnsolvedTarget(
            "in_collision", reason, qs[row], float(errors[0][k]), float(errors[1][k]), is_late=late
        )
    return replace(answer, failures=failures)


def _count(tried: int, is_all: bool) -> str:
    if tried == 1:
        return "the only solution is in contact" if is_all else "the solution found is in contact"
    which = "all" if is_all else "all the"
    return f"{which} {tried} solutions{'' if is_all else ' found'} are in contact, the best of them like this"
