"""Solutions that touch nothing: of an arm's branches the nearest to the seed, of a self-motion the nearest found."""

from collections.abc import Callable
from dataclasses import replace
from typing import TypeAlias

import numpy as np

from gelenk.collision.cell import Cell
from gelenk.collision.contact.gradient import soft_clearances
from gelenk.ik.analytic import joined
from gelenk.ik.search.bounds import target_rows
from gelenk.ik.search.null_space import settled
from gelenk.ik.search.problem import TargetProblem
from gelenk.ik.search.restarts import NEAR, solutions_around
from gelenk.ik.search.search import ITERATIONS_PER_START, MAX_ITERATIONS, chunk_of, in_pieces
from gelenk.ik.verdict.fixed import narrowed, widened
from gelenk.ik.verdict.judge import assembled, judged
from gelenk.ik.verdict.result import InverseKinematics, UnsolvedTarget, firsts_of
from gelenk.robot.arrays import Array, Flags, Indices

_GROWTH = 3
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
    options = problem.options
    found = answered(replace(problem, options=replace(options, objective=None)))
    touching = _touching(problem, cell, found.qs)
    if options.every:
        return _told_apart(problem, cell, found, touching)
    left = found.owners[touching]
    if len(left):
        rest = _others(problem.taken(left), cell, found.qs[touching], answered)
        found = _merged(_with_rows(found, ~touching), left, rest)
    if options.objective is not None:
        found = _settled(problem, cell, found)
    return replace(found, touching=np.zeros(len(found.qs), dtype=bool))


def _touching(problem: TargetProblem, cell: Cell, qs: Array) -> Flags:
    touching = np.empty(len(qs), dtype=bool)

    def judge(part: slice) -> None:
        touching[part] = cell.touching(widened(problem.chain, qs[part])[1])

    in_pieces(judge, len(qs), _PIECE, small=False)
    return touching


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
    free = np.flatnonzero(~_touching(problem, cell, every.qs))
    picked = np.zeros(len(every.qs), dtype=bool)
    picked[free[np.unique(every.owners[free], return_index=True)[1]]] = True
    tried = [some if len(some) else q[None] for some, q in zip(np.split(every.qs, every.firsts[1:-1]), qs, strict=True)]
    one = replace(_with_rows(every, picked), failures={}, every=False, doubts={})
    return _explained(problem, cell, one, tried, every.complete)


def _of_self_motion(problem: TargetProblem, cell: Cell, qs: Array) -> InverseKinematics:
    """Return the nearest free solution to the seed that the first successful round of starts leads to; see `_others`.

    The first round starts around `qs`, each other one all over the ranges of the joints.
    """
    best, found, starts = qs.copy(), np.zeros(len(qs), dtype=bool), np.zeros(len(qs), dtype=np.int64)
    tried = [[q[None]] for q in qs]
    most = (problem.options.max_iterations or MAX_ITERATIONS) // ITERATIONS_PER_START

    def solve(part: slice) -> None:
        left, first = np.arange(part.start, part.stop), 1
        while len(left) and first < most and not problem.is_over:
            own, last = problem.taken(left), min(max(NEAR + 1, _GROWTH * first), most)
            starting = target_rows(own.targets), qs[left], own.seeds, first
            some, counts = solutions_around(own.chain.flat, own.goal(last), *starting)
            owners = np.repeat(np.arange(len(left)), counts)
            solved, rows = _nearest_free(own, owners, some, _touching(own, cell, some))
            best[left[solved]], found[left[solved]], starts[left[solved]] = some[rows], True, first
            each = np.split(some, np.cumsum(counts)[:-1])
            for k in set(range(len(left))).difference(solved.tolist()):
                tried[left[k]].append(each[k])
            left, first = np.delete(left, solved), last

    in_pieces(solve, len(qs), chunk_of(problem.chain), problem.deadline is not None)
    one = assembled(len(qs), np.arange(len(qs)), best, judged(problem, best, found), {"restarts": starts})
    return _explained(problem, cell, one, [np.concatenate(some) for some in tried])


def _nearest_free(problem: TargetProblem, owners: Indices, qs: Array, touching: Flags) -> tuple[Indices, Indices]:
    """Return the targets with a free one among their solutions, and the row of that nearest to the seed."""
    seeds = problem.seeds[owners] if len(problem.seeds) > 1 else problem.seeds
    distances, free = np.square(qs - seeds).sum(axis=1), np.flatnonzero(~touching)
    free = free[np.lexsort((distances[free], owners[free]))]
    targets, rows = np.unique(owners[free], return_index=True)
    return targets, free[rows]


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
            rest = _explained(own, cell, _nothing(own, qs), tried, proofs)
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
    tried: list[Array],
    proofs: list[bool] | None = None,
) -> InverseKinematics:
    """Add the verdict on targets without a free solution.

    Args:
        tried: Solutions in contact of each target, at least one; shape (k, n) each.
        proofs: Whether these are proved to be all there are.
    """
    left = np.flatnonzero(np.diff(answer.firsts) == 0)
    if not len(left):
        return answer
    qs = np.concatenate([tried[i][:_LOOKED_AT] for i in left])
    owners = np.repeat(np.arange(len(left)), [len(tried[i][:_LOOKED_AT]) for i in left])
    nearest = cell.nearest(widened(problem.chain, qs)[1])
    order = np.lexsort((-nearest.clearances, owners))
    rows = order[np.unique(owners[order], return_index=True)[1]]
    _, *errors = judged(problem.taken(left), qs[rows])
    failures = {}
    for k, i in enumerate(left.tolist()):
        row, is_all = int(rows[k]), proofs is not None and proofs[i]
        reason = f"{_count(len(tried[i]), is_all)}: {cell.contact(int(nearest.pairs[row]), nearest.distances[row])}"
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
