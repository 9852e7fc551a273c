"""Inverse kinematics by a closed form, in batches: the branch nearest to the seed, or all of them."""

from collections.abc import Iterable
from dataclasses import replace
from typing import Any

import numpy as np

from gelenk.ik.closed.branch_kernels import BranchTable
from gelenk.ik.closed.closed_form import ClosedForm
from gelenk.ik.closed.subproblem_chains import GENERAL, MOST
from gelenk.ik.count.continuation import system_of, within_limits
from gelenk.ik.search.bounds import free_variables
from gelenk.ik.search.problem import TargetProblem
from gelenk.ik.search.search import in_pieces
from gelenk.ik.search.words import DIRECTIONS
from gelenk.ik.verdict.branches import SEARCHED, SPACING, all_branches, by_distance, thin_out, wound
from gelenk.ik.verdict.judge import assembled, judged
from gelenk.ik.verdict.near_singular import distinct, refined, with_partners
from gelenk.ik.verdict.result import COUNTED, InverseKinematics, UnsolvedTarget, firsts_of
from gelenk.kinematics.simd.kernels import chain_jacobians, chain_poses
from gelenk.robot.arrays import Array, Flags, Indices
from gelenk.robot.notations import rotations_from_vectors
from gelenk.robot.poses import Poses

_PIECE = 1024
"""Targets that one thread solves between two checks of the clock, in some milliseconds."""
_APART = 1e-6
"""Distance beyond which solutions from two methods are different, [rad or m]."""
_BESIDE = 1e-6
"""Shift of a target along each axis at which its branches are counted again, [m]: where two links fold onto each
other, rounding costs branches within some 1e-8 m."""
_NEIGHBOURS, _NEIGHBOURS_EACH = (1e-6, 1e-7, 1e-8), 8
"""Distances of the targets solved around a doubtful one, [m, rad], and the number at each distance."""
_ROUNDED = 1e-9
"""Deviation from a form's geometry that counts as rounding of the arm's description, [m, rad]."""
_EXACT, _ROUNDING = 1e-11, 1e-14
"""Largest errors of refined solutions, [m, rad]: of an arm that deviates from its form's geometry, and of an arm next
to a singularity."""
_FREE_SAMPLED = 24
"""Number of positions sampled of joints that a singularity leaves free."""
_ELBOWS_TRIED, _ELBOWS_SAMPLED = 24, 96
"""Number of elbow angles: tried if the seed's does not fit the limits, and sampled for all solutions."""


def nearest(problem: TargetProblem, form: ClosedForm) -> InverseKinematics:
    """Find the branch of each target that is nearest to the seed, if there is one within the limits.

    Unless an angle is desired, a free elbow stays at the seed's, or where the nearest solution has it if that does not
    fit the limits.
    """
    count, elbow_angle = len(problem), problem.options.elbow_angle
    qs, labels = np.empty((count, len(problem.chain))), np.full((2, count), -1, dtype=np.int64)

    def solve(part: slice) -> None:
        if not problem.is_over:
            table = _solved(problem.taken(part), form, most=1)
            rows = part.start + np.flatnonzero(np.diff(table.firsts))
            qs[rows], labels[0, rows], labels[1, rows] = table.qs, table.codes, table.free

    in_pieces(solve, count, _PIECE, problem.deadline is not None)
    if form.has_free_elbow and elbow_angle is None:
        for i in np.flatnonzero(labels[0] < 0).tolist():
            if problem.is_over:
                break
            table = _around(problem, form, i, _ELBOWS_TRIED, 1)
            if len(table.qs):
                best = by_distance(table.qs, problem.seed(i))[0]
                qs[i], labels[0, i], labels[1, i] = table.qs[best], table.codes[best], table.free[best]
    found = labels[0] >= 0
    if elbow_angle is None:
        rows, seeds = _seeds_that_solve(problem)
        lacking = ~found[rows] | (np.abs(qs[rows] - seeds).max(axis=1, initial=0.0) > _APART)
        rows, seeds = rows[lacking], seeds[lacking]
        qs[rows], labels[0, rows], labels[1, rows], found[rows] = seeds, -1, 0, True
    firsts = np.concatenate(([0], np.cumsum(found)))
    return _answer(problem, form, BranchTable(qs[found], labels[0, found], labels[1, found], firsts))


def _seeds_that_solve(problem: TargetProblem) -> tuple[Indices, Array]:
    """Find targets that their seeds solve, and these seeds: at a double singularity a form may lack that branch."""
    poses = Poses(*chain_poses(problem.chain.flat, problem.seeds))
    rows = np.flatnonzero(np.abs(problem.targets.positions - poses.positions).max(axis=1) <= _EXACT)
    near, own = problem.taken(rows), rows if len(problem.seeds) > 1 else np.zeros_like(rows)
    seeds, (lower, upper) = problem.seeds[own], problem.limits
    errors = problem.task.errors(near.targets, Poses(poses.positions[own], poses.rotations[own]))
    solve = errors.max(axis=0) <= min(_EXACT, *problem.tolerances)
    solve &= ((lower <= seeds) & (seeds <= upper)).all(axis=1)
    return rows[solve], seeds[solve]


def every(problem: TargetProblem, form: ClosedForm) -> InverseKinematics:
    """Find all branches of each target within the limits, nearest to the seed first.

    Without a desired angle, those of a free elbow are a sample of the full circle. With the method `auto`, also
    positions other than the seed's are sampled of joints that a singularity leaves free.
    """
    tables: list[BranchTable] = [_nothing(problem, 0)]
    complete: list[bool] = []
    for first in range(0, len(problem), _PIECE):
        part = problem.taken(slice(first, min(first + _PIECE, len(problem))))
        if form.has_free_elbow and problem.options.elbow_angle is None:
            found = [(_sampled(part, form, i), False) for i in range(len(part))]
        else:
            found = _piece(part, form)
        for table, whole in found:
            tables.append(table)
            complete += [whole] * (len(table.firsts) - 1)
    together = _together(tables)
    answer, counts = _answer(problem, form, together), np.diff(together.firsts)
    lacking = (counts > 0) & ~(np.array(complete, dtype=bool) & (np.diff(answer.firsts) == counts))
    doubts = {i: _doubt(answer, form, i, problem.options.most) for i in np.flatnonzero(lacking).tolist()}
    return replace(answer, every=True, doubts=doubts)


def _doubt(answer: InverseKinematics, form: ClosedForm, i: int, most: int) -> str:
    free = answer.free[answer.firsts[i] : answer.firsts[i + 1]]
    if len(free) >= most:
        return "the requested number of solutions is reached; there may be others"
    if form.has_free_elbow or free.any():
        return "infinitely many solutions, of which these are a sample"
    return "next to a singularity, where rounding may have cost a solution"


def _piece(problem: TargetProblem, form: ClosedForm) -> list[tuple[BranchTable, bool]]:
    """Return the branches of some targets and whether these are all; one table, or one for each if any is special."""
    options, count = problem.options, len(problem)
    if problem.is_over:
        return [(_nothing(problem, count), False)]
    anywhere = _solved(problem, form, respect_limits=False)
    table = _solved(problem, form) if options.respect_limits else anywhere
    unsteady = _unsteady(problem, form, anywhere)
    doubtful = unsteady | _doubtful(problem, form, anywhere)
    # Only a count shows whether rounding, or the arm's deviation from the form's geometry, has cost a root.
    is_counted = form.plan.kind == GENERAL or bool(form.tolerance > _ROUNDED and system_of(problem))
    special = options.windings or is_counted or anywhere.free.any() or doubtful.any()
    if not (special or np.diff(table.firsts).max(initial=0) > options.most):
        return [(table, True)]
    found: list[tuple[BranchTable, bool]] = []
    for i in range(count):
        if problem.is_over:
            return [*found, (_nothing(problem, count - i), False)]
        own, free = _row(table, i), _row(anywhere, i).free
        whole = len(own.qs) <= options.most and not free.any()
        if free.any() and (options.method == "auto" or not own.free.any()):
            # If the seed's position of a free joint is outside the limits, others may be inside.
            own = _spread(problem, form, i, own, np.unique(free[free > 0]))
        if is_counted or doubtful[i]:
            counted, places = _counted(problem, i, own) if not free.any() else (None, own.qs[:0])
            whole = counted is not None and len(counted.qs) <= options.most
            is_steady = bool(free.any() or not unsteady[i])
            own = counted or _extended(problem, form, i, own, places, bool(doubtful[i]), is_steady)
        if options.windings and len(own.qs):
            own, whole = _turned(problem, i, own, whole)
        found.append((_picked(own, slice(options.most)), whole))
    return found


def _extended(
    problem: TargetProblem,
    form: ClosedForm,
    i: int,
    table: BranchTable,
    places: Array,
    is_doubtful: bool,
    is_steady: bool,
) -> BranchTable:
    """Add other solutions to the branches of one target that no count proves complete."""
    if not is_doubtful:
        return _joined(problem, i, table, refined(problem, i, places, _ROUNDING))
    if not form.is_exact:
        return _completed(problem, i, table, places)
    if form.plan.kind == GENERAL or form.has_double_roots or not is_steady:
        return _from_neighbours(problem, form, i, table, np.concatenate((table.qs, places)))
    return table


def _doubtful(problem: TargetProblem, form: ClosedForm, table: BranchTable) -> Flags:
    """Flag targets next to a singularity, where the closed form may lack solutions; shape (N,).

    Rounding may cost solutions there, and an arm that deviates from the form's geometry may have other solutions.
    """
    count = len(problem)
    owners = np.repeat(np.arange(count), np.diff(table.firsts))
    near = _near_singular(chain_jacobians(problem.chain.flat, table.qs)[2], len(problem.task), form.doubt)
    flags: Flags = (np.bincount(owners, near, minlength=count) > 0) | (table.doubtful > 0)
    return flags if form.is_exact else flags | (np.diff(table.firsts) == 0)


def _unsteady(problem: TargetProblem, form: ClosedForm, table: BranchTable) -> Flags:
    """Flag targets next to which the number of branches differs: where two meet, rounding may cost one; (N,)."""
    unsteady = np.zeros(len(problem), dtype=bool)
    if len(problem.chain) < len(DIRECTIONS):
        return unsteady
    # An arm that deviates from the form's geometry loses branches at places shifted by that much.
    shift = max(_BESIDE, 10.0 * form.tolerance)
    for by in (shift, -shift):
        shifted = Poses(problem.targets.positions + by, problem.targets.rotations)
        beside = _solved(replace(problem, targets=shifted), form, respect_limits=False)
        unsteady |= np.diff(beside.firsts) != np.diff(table.firsts)
    return unsteady


def _near_singular(Js: Array, directions: int, least: float) -> Flags:
    rows = np.arange(len(Js))
    if Js.shape[1] == Js.shape[2]:
        # A bound on the product of the other singular values clears most by the determinant, without an SVD.
        others = np.square(Js).sum(axis=(1, 2)) / (Js.shape[1] - 1)
        rows = np.flatnonzero(np.abs(np.linalg.det(Js)) < least * others ** (0.5 * (Js.shape[1] - 1)))
    near = np.zeros(len(Js), dtype=bool)
    sizes = np.linalg.svd(Js[rows], compute_uv=False)
    near[rows] = sizes[:, min(Js.shape[2], directions) - 1] < least
    return near


def _completed(problem: TargetProblem, i: int, table: BranchTable, places: Array) -> BranchTable:
    """Add what a search and a refinement of `places` find to the branches of one target."""
    found = all_branches(replace(problem, options=replace(problem.options, random_seed=0)), i)
    more = with_partners(problem, i, np.concatenate((found.qs, places)), _EXACT)
    together, most = _with(table, more), problem.options.most
    return _sorted(problem, i, _picked(together, thin_out(together.qs, free_variables(problem.chain), _APART, most)))


def _counted(problem: TargetProblem, i: int, table: BranchTable) -> tuple[BranchTable | None, Array]:
    """Complete branches by continuation, None without a proof; also return its solutions or places near them."""
    system = system_of(problem)
    qs, doubt = system.solve(problem.target(i)) if system else (table.qs[:0], SEARCHED)
    if doubt:
        return None, qs
    qs = within_limits(problem, i, qs)
    apart = np.abs(qs[:, None] - table.qs).max(axis=2).min(axis=1, initial=np.inf)
    if len(qs) != len(table.qs) or apart.max(initial=0.0) > _APART:
        together = _with(table, qs, COUNTED)
        table = _sorted(problem, i, _picked(together, distinct(problem, i, together.qs)))
    return table if len(table.qs) == len(qs) else None, qs


def _from_neighbours(
    problem: TargetProblem, form: ClosedForm, i: int, table: BranchTable, places: Array
) -> BranchTable:
    """Add solutions refined from `places` and from the branches of neighbouring targets to those of one target.

    Where two roots nearly meet, rounding may lose both, or leave a place far from the solution.
    """
    target, rng = problem.target(i), np.random.default_rng(0)
    sizes = np.repeat(_NEIGHBOURS, _NEIGHBOURS_EACH)[:, None]
    shifts, turns = sizes * rng.normal(size=(2, len(sizes), 3))
    beside = Poses(target.positions + shifts, rotations_from_vectors(turns) @ target.rotations[0])
    found = _solved(replace(problem, targets=beside, seeds=problem.seed(i)[None]), form, elbow_angles=None)
    return _joined(problem, i, table, with_partners(problem, i, np.concatenate((places, found.qs)), _ROUNDING))


def _sampled(problem: TargetProblem, form: ClosedForm, i: int) -> BranchTable:
    """Sample the self-motion of a free elbow, nearest to the seed first."""
    if problem.is_over:
        return _nothing(problem, 1)
    table = _thinned(problem, i, _around(problem, form, i, _ELBOWS_SAMPLED, MOST))
    if problem.options.windings and len(table.qs):
        table, _ = _turned(problem, i, table, whole=False)
    return _picked(table, slice(problem.options.most))


def joined(found: InverseKinematics, left: Indices, rest: InverseKinematics) -> InverseKinematics:
    """Insert the answer of a search for the targets `left`, shape (k,), into that of a closed form, which lacks it."""
    owners = np.concatenate((found.owners, left[rest.owners]))
    order = np.argsort(owners, kind="stable")
    ours, others = found.rows(slice(None)), rest.rows(slice(None))
    columns: dict[str, Any] = {name: np.concatenate((ours[name], others[name]))[order] for name in ours}
    left_doubts = {int(left[k]): doubt for k, doubt in rest.doubts.items()}
    by_form = set(range(len(found))) - set(left.tolist())
    return replace(
        found,
        **columns,
        firsts=firsts_of(owners[order], len(found)),
        failures={int(left[k]): failure for k, failure in rest.failures.items()},
        doubts={i: doubt for i, doubt in found.doubts.items() if i in by_form} | left_doubts,
    )


def unmet(rest: InverseKinematics, elbow_angle: float | None) -> InverseKinematics:
    """Turn solutions of a search into failures: they are on no branch, or the elbow is not at the requested angle."""
    failures = dict(rest.failures)
    for i in np.flatnonzero(np.diff(rest.firsts)).tolist():
        q, *errors = (column[rest.firsts[i]] for column in (rest.qs, rest.position_errors, rest.orientation_errors))
        if elbow_angle is None:
            reason = "no branch of the closed form meets the request; `nearest` is the result of a search"
            failures[i] = UnsolvedTarget("not_converged", reason, q, float(errors[0]), float(errors[1]))
        else:
            reason = "no branch with the elbow at this angle meets the request; a branch at another elbow angle does"
            failures[i] = UnsolvedTarget("outside_limits", reason, q, float(errors[0]), float(errors[1]))
    return replace(rest, **rest.rows(slice(0)), firsts=np.zeros_like(rest.firsts), failures=failures)


def first_of_each(found: InverseKinematics) -> InverseKinematics:
    """Reduce an answer with all solutions to the first one of each target."""
    solved = np.diff(found.firsts) > 0
    firsts = np.concatenate(([0], np.cumsum(solved)))
    return replace(found, **found.rows(found.firsts[:-1][solved]), firsts=firsts, every=False, doubts={})


def _answer(problem: TargetProblem, form: ClosedForm, table: BranchTable) -> InverseKinematics:
    counts = np.diff(table.firsts)
    owners = np.repeat(np.arange(len(counts)), counts)
    judgement = judged(problem if (counts == 1).all() else problem.taken(owners), table.qs)
    return assembled(len(problem), owners, table.qs, judgement, {"codes": table.codes, "free": table.free}, form=form)


def _solved(problem: TargetProblem, form: ClosedForm, **changes: Any) -> BranchTable:
    options = problem.options
    asked = {"respect_limits": options.respect_limits, "elbow_angles": options.elbow_angle, **changes}
    return form.solve(problem.targets, problem.seeds, tolerances=problem.tolerances, **asked)


def _around(problem: TargetProblem, form: ClosedForm, i: int, count: int, most: int) -> BranchTable:
    """Solve one target with the elbow at angles all around the circle, the seed's first."""
    seed = problem.seed(i)[None]
    angles = form.elbow_angles(seed)[0] + np.arange(count) * (2.0 * np.pi / count)
    return _solved(replace(problem.taken(np.full(count, i)), seeds=seed), form, elbow_angles=angles, most=most)


def _thinned(problem: TargetProblem, i: int, table: BranchTable) -> BranchTable:
    """Thin a sample of a continuum out, from the nearest to the seed outwards."""
    table = _sorted(problem, i, table)
    return _picked(table, thin_out(table.qs, free_variables(problem.chain), SPACING, problem.options.most))


def _spread(problem: TargetProblem, form: ClosedForm, i: int, table: BranchTable, masks: Indices) -> BranchTable:
    """Add a sample of the continuum that joints form which a singularity leaves free, given by their bit masks."""
    seed, rng, seeds = problem.seed(i), np.random.default_rng(0), []
    for mask in masks.tolist():
        free = [j for j in range(len(seed)) if mask >> j & 1]
        around = np.tile(seed, (_FREE_SAMPLED, 1))
        around[:, free] += rng.uniform(-np.pi, np.pi, (_FREE_SAMPLED, len(free)))
        if len(free) == 1:
            around[:, free[0]] = seed[free[0]] + np.linspace(-np.pi, np.pi, _FREE_SAMPLED, endpoint=False)
        seeds.append(around)
    own = problem.taken(np.full(len(masks) * _FREE_SAMPLED, i))
    others = _solved(replace(own, seeds=np.concatenate(seeds)), form)
    return _thinned(problem, i, _together((table, _picked(others, others.free > 0))))


def _turned(problem: TargetProblem, i: int, table: BranchTable, whole: bool) -> tuple[BranchTable, bool]:
    qs, owners, whole = wound(problem, i, table.qs, whole)
    return _picked(table, owners)._replace(qs=qs), whole


def _joined(problem: TargetProblem, i: int, table: BranchTable, more: Array) -> BranchTable:
    """Merge the branches of one target with other solutions, without duplicates, nearest to the seed first."""
    together = _with(table, more)
    # The form's branches come first, so that of two duplicates the named one stays.
    order = distinct(problem, i, together.qs)[: problem.options.most]
    return _sorted(problem, i, _picked(together, order))


def _with(table: BranchTable, qs: Array, code: int = -1) -> BranchTable:
    """Append solutions of another method to the branches of one target."""
    codes, free = np.full(len(qs), code, dtype=np.int64), np.zeros(len(qs), dtype=np.int64)
    return _together((table, BranchTable(qs, codes, free, np.array([0, len(qs)]))))


def _sorted(problem: TargetProblem, i: int, table: BranchTable) -> BranchTable:
    return _picked(table, by_distance(table.qs, problem.seed(i)))


def _row(table: BranchTable, i: int) -> BranchTable:
    return _picked(table, slice(table.firsts[i], table.firsts[i + 1]))


def _picked(table: BranchTable, rows: Indices | Flags | slice) -> BranchTable:
    """Return some branches as those of one target."""
    qs = table.qs[rows]
    return BranchTable(qs, table.codes[rows], table.free[rows], np.array([0, len(qs)], dtype=np.int64))


def _together(tables: Iterable[BranchTable]) -> BranchTable:
    """Append the targets of several tables; as those of one target, its first and last row count."""
    qs, codes, free, firsts, _ = zip(*tables, strict=True)
    counts = np.concatenate([np.diff(each) for each in firsts])
    ends = np.concatenate(([0], np.cumsum(counts)))
    return BranchTable(np.concatenate(qs), np.concatenate(codes), np.concatenate(free), ends)


def _nothing(problem: TargetProblem, count: int) -> BranchTable:
    none = np.zeros(0, dtype=np.int64)
    return BranchTable(np.empty((0, len(problem.chain))), none, none, np.zeros(count + 1, dtype=np.int64))
