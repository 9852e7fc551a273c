"""Inverse kinematics by a closed form, in batches: the branch nearest to the seed, or all of them."""

from collections.abc import Callable
from dataclasses import replace
from typing import TypeVar

import numpy as np
import numpy.typing as npt

from gelenk.ik.closed.branch_kernels import BranchTable
from gelenk.ik.closed.closed_form import ClosedForm
from gelenk.ik.closed.subproblem_chains import GENERAL, MOST
from gelenk.ik.count.continuation import Continuation, continuation, within_limits
from gelenk.ik.search.search import free_variables, is_over, limits_of, pieces, processors, shared, target_rows
from gelenk.ik.search.words import DIRECTIONS, Status
from gelenk.ik.verdict.branches import SEARCHED, SPACING, all_branches, thin_out, wound
from gelenk.ik.verdict.judge import judged
from gelenk.ik.verdict.near_singular import distinct, refined, with_partners
from gelenk.ik.verdict.result import COUNTED, InverseKinematics, SolutionBranches, UnsolvedTarget
from gelenk.ik.verdict.verdict import TargetProblem
from gelenk.kinematics.simd.kernels import chain_jacobians, chain_poses
from gelenk.robot.arrays import Array, Flags, Indices
from gelenk.robot.notations import rotations_from_vectors
from gelenk.robot.poses import Poses

_Number = TypeVar("_Number", np.float64, np.int64)

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


def nearest(
    question: TargetProblem, form: ClosedForm, elbow_angle: float | None, deadline: float | None
) -> InverseKinematics:
    """Find the branch of each target that is nearest to the seed, if there is one within the limits.

    Args:
        question: The problem.
        form: The closed form of the chain.
        elbow_angle: Desired angle of a free elbow, [rad]; by default the seed's, or the nearest solution's if that
            does not fit the limits.
        deadline: When to stop, on `gelenk.robot.compilation.clock`, [s].
    """
    count, n = len(question), len(question.chain)
    qs, labels = np.empty((count, n)), np.full((2, count), -1, dtype=np.int64)

    def solve(part: slice) -> None:
        if is_over(deadline):
            return
        targets, seeds = question.part(part)
        table = form.solve(
            targets,
            seeds,
            tolerances=question.tolerances,
            respect_limits=question.respect_limits,
            elbow_angles=elbow_angle,
            most=1,
        )
        rows = part.start + np.flatnonzero(np.diff(table.firsts))
        qs[rows], labels[0, rows], labels[1, rows] = table.qs, table.codes, table.free

    if count <= _PIECE:
        solve(slice(0, count))
    else:
        shared(solve, pieces(count, processors(), _PIECE, deadline is not None), processors())
    if form.has_free_elbow and elbow_angle is None:
        for i in np.flatnonzero(labels[0] < 0).tolist():
            if is_over(deadline):
                break
            table = _around(question, form, i, _ELBOWS_TRIED, 1)
            if len(table.qs):
                best = int(np.argmin(np.square(table.qs - question.seed(i)).sum(axis=1)))
                qs[i], labels[0, i], labels[1, i] = table.qs[best], table.codes[best], table.free[best]
    found = labels[0] >= 0
    if elbow_angle is None:
        rows, seeds = _seeds_that_solve(question)
        lacking = ~found[rows] | (np.abs(qs[rows] - seeds).max(axis=1, initial=0.0) > _APART)
        rows, seeds = rows[lacking], seeds[lacking]
        qs[rows], labels[0, rows], labels[1, rows], found[rows] = seeds, -1, 0, True
    if found.all():
        return _answer(question, form, BranchTable(qs, labels[0], labels[1], np.arange(count + 1)))
    firsts = np.concatenate(([0], np.cumsum(found)))
    return _answer(question, form, BranchTable(qs[found], labels[0, found], labels[1, found], firsts))


def _seeds_that_solve(question: TargetProblem) -> tuple[Indices, Array]:
    """Find targets that their seeds solve, and these seeds: at a double singularity a form may lack that branch."""
    targets, seeds = question.targets, question.seeds
    poses = Poses(*chain_poses(question.chain.flat, seeds))
    rows = np.flatnonzero(np.abs(targets.positions - poses.positions).max(axis=1) <= _EXACT)
    own = rows if len(seeds) > 1 else np.zeros_like(rows)
    seeds = seeds[own]
    errors = question.task.errors(
        Poses(targets.positions[rows], targets.rotations[rows]), Poses(poses.positions[own], poses.rotations[own])
    )
    lower, upper = limits_of(question.chain, question.respect_limits)
    solve = (errors.max(axis=0) <= min(_EXACT, *question.tolerances)) & ((lower <= seeds) & (seeds <= upper)).all(
        axis=1
    )
    return rows[solve], seeds[solve]


def every(
    question: TargetProblem,
    form: ClosedForm,
    most: int,
    windings: bool,
    elbow_angle: float | None,
    deadline: float | None,
    *,
    sample: bool,
) -> InverseKinematics:
    """Find all branches of each target within the limits, nearest to the seed first.

    Args:
        question: The problem.
        form: The closed form of the chain.
        most: Largest number of solutions of a target.
        windings: Whether solutions that differ by full turns count as different, where limits allow them.
        elbow_angle: Desired angle of a free elbow, [rad]; by default a sample of the full circle.
        deadline: When to stop, on `gelenk.robot.compilation.clock`, [s].
        sample: Whether to also sample positions other than the seed's of joints that a singularity leaves free.
    """
    tables: list[BranchTable] = []
    complete: list[bool] = []
    for first in range(0, len(question), _PIECE):
        part = slice(first, min(first + _PIECE, len(question)))
        if form.has_free_elbow and elbow_angle is None:
            found = [_sampled(question, form, i, most, windings, deadline) for i in range(part.start, part.stop)]
        else:
            found = _piece(question, form, part, most, windings, elbow_angle, deadline, sample=sample)
        for table, whole in found:
            tables.append(table)
            complete += [whole] * (len(table.firsts) - 1)
    counts = np.concatenate([np.zeros(0, dtype=np.int64), *(np.diff(table.firsts) for table in tables)])
    empty = _nothing(len(question.chain))
    together = BranchTable(
        np.concatenate([*(table.qs for table in tables), empty.qs]),
        np.concatenate([*(table.codes for table in tables), empty.codes]),
        np.concatenate([*(table.free for table in tables), empty.free]),
        np.concatenate(([0], np.cumsum(counts))),
    )
    answer = _answer(question, form, together)
    kept = np.diff(answer.firsts) == counts
    complete = [bool(a and b) for a, b in zip(complete, kept, strict=True)]
    doubts = {i: _doubt(answer, i, most) for i, whole in enumerate(complete) if not whole and counts[i]}
    return replace(answer, complete=complete, doubts=doubts)


def _doubt(answer: InverseKinematics, i: int, most: int) -> str:
    """Return why a target may have other solutions."""
    rows = slice(answer.firsts[i], answer.firsts[i + 1])
    if rows.stop - rows.start >= most:
        return "the requested number of solutions is reached; there may be others"
    form = answer.branches and answer.branches.form
    if answer.branches and ((form and form.has_free_elbow) or answer.branches.free[rows].any()):
        return "infinitely many solutions, of which these are a sample"
    return "next to a singularity, where rounding may have cost a solution"


def _piece(
    question: TargetProblem,
    form: ClosedForm,
    part: slice,
    most: int,
    windings: bool,
    elbow_angle: float | None,
    deadline: float | None,
    *,
    sample: bool,
) -> list[tuple[BranchTable, bool]]:
    """Return the branches of some targets, and whether they are all, see `every`.

    The result has one table for all targets if none of them is special, else a table for each.
    """
    count, n = part.stop - part.start, len(question.chain)
    if is_over(deadline):
        return [(_nothing(n, count), False)]
    anywhere = _solved(question, form, part, elbow_angle, respect_limits=False)
    table = _solved(question, form, part, elbow_angle, respect_limits=True) if question.respect_limits else anywhere
    unsteady = _unsteady(question, form, part, elbow_angle, anywhere)
    doubtful = unsteady | _doubtful(question, form, anywhere)
    # Only a count shows whether rounding, or the arm's deviation from the form's geometry, has cost a root.
    is_counted = form.plan.kind == GENERAL or bool(form.tolerance > _ROUNDED and _system(question))
    special = windings or is_counted or anywhere.free.any() or doubtful.any()
    if not (special or np.diff(table.firsts).max(initial=0) > most):
        return [(table, True)]
    found: list[tuple[BranchTable, bool]] = []
    for k in range(count):
        if is_over(deadline):
            return [*found, (_nothing(n, count - k), False)]
        i, own, free = part.start + k, _row(table, k), _row(anywhere, k).free
        whole = len(own.qs) <= most and not free.any()
        if free.any() and (sample or not own.free.any()):
            # If the seed's position of a free joint is outside the limits, others may be inside.
            own = _spread(question, form, i, own, np.unique(free[free > 0]), most, elbow_angle)
        if is_counted or doubtful[k]:
            counted, places = _counted(question, i, own) if not free.any() else (None, own.qs[:0])
            whole = counted is not None and len(counted.qs) <= most
            is_steady = bool(free.any() or not unsteady[k])
            own = counted or _extended(question, form, i, own, most, places, bool(doubtful[k]), is_steady)
        if windings and len(own.qs):
            own, whole = _turned(question, i, own, most, whole)
        found.append((_first(own, most), whole))
    return found


def _extended(
    question: TargetProblem,
    form: ClosedForm,
    i: int,
    table: BranchTable,
    most: int,
    places: Array,
    is_doubtful: bool,
    is_steady: bool,
) -> BranchTable:
    """Add other solutions to the branches of one target that no count proves complete."""
    if not is_doubtful:
        return _joined(question, i, table, refined(question, i, places, _ROUNDING), most)
    if not form.is_exact:
        return _completed(question, i, table, most, places)
    if form.plan.kind == GENERAL or form.has_double_roots or not is_steady:
        return _from_neighbours(question, form, i, table, most, np.concatenate((table.qs, places)))
    return table


def _doubtful(question: TargetProblem, form: ClosedForm, table: BranchTable) -> Flags:
    """Flag targets next to a singularity, where the closed form may lack solutions; shape (N,).

    Rounding may cost solutions there, and an arm that deviates from the form's geometry may have other solutions.
    """
    count = len(table.firsts) - 1
    owners = np.repeat(np.arange(count), np.diff(table.firsts))
    near = _near_singular(chain_jacobians(question.chain.flat, table.qs)[2], len(question.task), form.doubt)
    flags: Flags = (np.bincount(owners, near, minlength=count) > 0) | (table.doubtful > 0)
    return flags if form.is_exact else flags | (np.diff(table.firsts) == 0)


def _unsteady(
    question: TargetProblem, form: ClosedForm, part: slice, elbow_angle: float | None, table: BranchTable
) -> Flags:
    """Flag targets next to which the number of branches differs: where two meet, rounding may cost one; (N,)."""
    if len(question.chain) < len(DIRECTIONS):
        return np.zeros(part.stop - part.start, dtype=bool)
    targets, seeds = question.part(part)
    # An arm that deviates from the form's geometry loses branches at places shifted by that much.
    shift = max(_BESIDE, 10.0 * form.tolerance)
    unsteady = np.zeros(len(targets), dtype=bool)
    for by in (shift, -shift):
        beside = form.solve(
            Poses(targets.positions + by, targets.rotations),
            seeds,
            tolerances=question.tolerances,
            respect_limits=False,
            elbow_angles=elbow_angle,
        )
        unsteady |= np.diff(beside.firsts) != np.diff(table.firsts)
    return unsteady


def _near_singular(Js: Array, directions: int, least: float) -> Flags:
    """Flag Jacobians whose smallest singular value is below a bound; shape (N,)."""
    rows = np.arange(len(Js))
    if Js.shape[1] == Js.shape[2]:
        # A bound on the product of the other singular values clears most by the determinant, without an SVD.
        others = np.square(Js).sum(axis=(1, 2)) / (Js.shape[1] - 1)
        rows = np.flatnonzero(np.abs(np.linalg.det(Js)) < least * others ** (0.5 * (Js.shape[1] - 1)))
    near = np.zeros(len(Js), dtype=bool)
    sizes = np.linalg.svd(Js[rows], compute_uv=False)
    near[rows] = sizes[:, min(Js.shape[2], directions) - 1] < least
    return near


def _completed(question: TargetProblem, i: int, table: BranchTable, most: int, places: Array) -> BranchTable:
    """Add what a search and a refinement of `places` find to the branches of one target, with code -1."""
    found = all_branches(
        question.chain,
        target_rows(question.target(i))[0],
        question.seed(i),
        task=question.task,
        tolerances=question.tolerances,
        respect_limits=question.respect_limits,
        random_seed=0,
        most=most,
        windings=False,
    )
    free = free_variables(question.chain)
    more = with_partners(question, i, np.concatenate((found.qs, places)), _EXACT)
    return _joined(question, i, table, more, most, pick=lambda qs: thin_out(qs, free, _APART, most))


def _system(question: TargetProblem) -> Continuation | None:
    """Return the continuation that counts the solutions; None if the chain or the task has none."""
    return continuation(question.chain) if len(question.task) == len(DIRECTIONS) else None


def _counted(question: TargetProblem, i: int, table: BranchTable) -> tuple[BranchTable | None, Array]:
    """Complete branches by continuation, None without a proof; also return its solutions or places near them."""
    system = _system(question)
    qs, doubt = system.solve(question.target(i)) if system else (table.qs[:0], SEARCHED)
    if doubt:
        return None, qs
    qs = within_limits(question, i, qs)
    apart = np.abs(qs[:, None] - table.qs).max(axis=2).min(axis=1, initial=np.inf)
    if len(qs) != len(table.qs) or apart.max(initial=0.0) > _APART:
        table = _joined(question, i, table, qs, len(table.qs) + len(qs), COUNTED)
    return table if len(table.qs) == len(qs) else None, qs


def _from_neighbours(
    question: TargetProblem, form: ClosedForm, i: int, table: BranchTable, most: int, places: Array
) -> BranchTable:
    """Add solutions refined from `places` and from the branches of neighbouring targets to those of one target.

    Where two roots nearly meet, rounding may lose both, or leave a place far from the solution.
    """
    target, rng = question.target(i), np.random.default_rng(0)
    sizes = np.repeat(_NEIGHBOURS, _NEIGHBOURS_EACH)[:, None]
    shifts, turns = sizes * rng.normal(size=(2, len(sizes), 3))
    found = form.solve(
        Poses(target.positions + shifts, rotations_from_vectors(turns) @ target.rotations[0]),
        question.seed(i)[None],
        tolerances=question.tolerances,
        respect_limits=question.respect_limits,
    )
    more = with_partners(question, i, np.concatenate((places, found.qs)), _ROUNDING)
    return _joined(question, i, table, more, most)


def _joined(
    question: TargetProblem,
    i: int,
    table: BranchTable,
    more: Array,
    most: int,
    code: int = -1,
    pick: Callable[[Array], Indices] | None = None,
) -> BranchTable:
    """Merge the branches of one target with other solutions, without duplicates, nearest to the seed first."""
    qs = np.concatenate((table.qs, more))
    codes = np.concatenate((table.codes, np.full(len(more), code, dtype=np.int64)))
    free = np.concatenate((table.free, np.zeros(len(more), dtype=np.int64)))
    # The form's branches come first, so that of two duplicates the named one stays.
    order = (pick(qs) if pick else distinct(question, i, qs))[:most]
    order = order[np.argsort(np.square(qs[order] - question.seed(i)).sum(axis=1), kind="stable")]
    return BranchTable(qs[order], codes[order], free[order], _firsts_of_one(len(order)))


def _sampled(
    question: TargetProblem, form: ClosedForm, i: int, most: int, windings: bool, deadline: float | None
) -> tuple[BranchTable, bool]:
    """Sample the self-motion of a free elbow; the flag is False, as a sample is never complete."""
    if is_over(deadline):
        return _nothing(len(question.chain), 1), False
    table = _thinned(question, form, i, most)
    if windings and len(table.qs):
        table, _ = _turned(question, i, table, most, whole=False)
    return _first(table, most), False


def joined(found: InverseKinematics, left: Indices, rest: InverseKinematics) -> InverseKinematics:
    """Insert the results of a search into the answer of a closed form.

    Args:
        found: The answer of the closed form.
        left: Indices of the targets that it left unsolved; shape (k,).
        rest: The answer of the search for these.
    """
    by_form = np.ones(len(found), dtype=bool)
    by_form[left] = False
    counts = np.diff(found.firsts)
    kept = np.repeat(by_form, counts)
    counts[left] = np.diff(rest.firsts)
    ours = np.repeat(by_form, counts)
    statuses, complete = list(found.statuses), found.complete and list(found.complete)
    for k, i in enumerate(left.tolist()):
        statuses[i] = rest.statuses[k]
        if complete:
            complete[i] = rest.complete[k] if rest.complete else False
    branches = found.branches
    return replace(
        found,
        qs=_woven(ours, found.qs[kept], rest.qs),
        position_errors=_woven(ours, found.position_errors[kept], rest.position_errors),
        orientation_errors=_woven(ours, found.orientation_errors[kept], rest.orientation_errors),
        iterations=_woven(ours, found.iterations[kept], rest.iterations),
        restarts=_woven(ours, found.restarts[kept], rest.restarts),
        firsts=np.concatenate(([0], np.cumsum(counts))),
        statuses=statuses,
        failures={int(left[k]): failure for k, failure in rest.failures.items()},
        complete=complete,
        doubts={
            **{i: doubt for i, doubt in found.doubts.items() if by_form[i]},
            **{int(left[k]): doubt for k, doubt in rest.doubts.items()},
        },
        branches=branches
        and SolutionBranches(
            branches.form,
            _woven(ours, branches.codes[kept], rest.branches.codes if rest.branches else np.full(len(rest.qs), -1)),
            _woven(ours, branches.free[kept], np.zeros(len(rest.qs), dtype=np.int64)),
        ),
    )


def unmet(rest: InverseKinematics, elbow_angle: float | None) -> InverseKinematics:
    """Turn solutions of a search into failures, because they do not meet the request.

    Args:
        rest: The answer of the search.
        elbow_angle: The requested angle of the elbow, [rad]; None if only a closed form was requested.
    """
    failures, statuses = dict(rest.failures), list(rest.statuses)
    reason = "no branch with the elbow at this angle meets the request; a branch at another elbow angle does"
    if elbow_angle is None:
        reason = "no branch of the closed form meets the request; `nearest` is the result of a search"
    for i in np.flatnonzero(np.diff(rest.firsts)).tolist():
        k = int(rest.firsts[i])
        errors = float(rest.position_errors[k]), float(rest.orientation_errors[k])
        statuses[i] = "not_converged" if elbow_angle is None else "outside_limits"
        failures[i] = UnsolvedTarget(reason, rest.qs[k], *errors)
    nothing = np.zeros(0, dtype=np.int64)
    return replace(
        rest,
        qs=rest.qs[:0],
        position_errors=rest.position_errors[:0],
        orientation_errors=rest.orientation_errors[:0],
        iterations=nothing,
        restarts=nothing,
        firsts=np.zeros_like(rest.firsts),
        statuses=statuses,
        failures=failures,
        complete=None,
        branches=None,
    )


def first_of_each(found: InverseKinematics) -> InverseKinematics:
    """Reduce an answer with all solutions to the first one of each target."""
    solved = np.diff(found.firsts) > 0
    rows, branches = found.firsts[:-1][solved], found.branches
    return replace(
        found,
        qs=found.qs[rows],
        position_errors=found.position_errors[rows],
        orientation_errors=found.orientation_errors[rows],
        iterations=found.iterations[rows],
        restarts=found.restarts[rows],
        firsts=np.concatenate(([0], np.cumsum(solved))),
        complete=None,
        doubts={},
        branches=branches and SolutionBranches(branches.form, branches.codes[rows], branches.free[rows]),
    )


def _woven(ours: Flags, a: npt.NDArray[_Number], b: npt.NDArray[_Number]) -> npt.NDArray[_Number]:
    """Interleave rows: from `a` where the flag is set, else from `b`, each in order."""
    table = np.empty((len(ours), *a.shape[1:]), dtype=a.dtype)
    table[ours], table[~ours] = a, b
    return table


def _answer(question: TargetProblem, form: ClosedForm, table: BranchTable) -> InverseKinematics:
    """Build the answer from the branches that Pinocchio confirms as solutions."""
    counts = np.diff(table.firsts)
    owners = np.repeat(np.arange(len(counts)), counts)
    asked = question if (counts == 1).all() else question.taken(owners)
    good, *errors = judged(asked, table.qs, np.ones(len(owners), dtype=np.bool_))
    statuses: list[Status] = ["solved"] * len(question)
    if not good.all():
        table = BranchTable(table.qs[good], table.codes[good], table.free[good], table.firsts)
        errors = [error[good] for error in errors]
        counts = np.bincount(owners[good], minlength=len(counts))
    zeros = np.zeros(len(table.qs), dtype=np.int64)
    return InverseKinematics(
        table.qs,
        errors[0],
        errors[1],
        zeros,
        zeros,
        "damped_least_squares",
        np.concatenate(([0], np.cumsum(counts))),
        statuses,
        branches=SolutionBranches(form, table.codes, table.free),
    )


def _solved(
    question: TargetProblem, form: ClosedForm, part: slice, elbow_angle: float | None, *, respect_limits: bool
) -> BranchTable:
    targets, seeds = question.part(part)
    return form.solve(
        targets,
        seeds,
        tolerances=question.tolerances,
        respect_limits=respect_limits,
        elbow_angles=elbow_angle,
    )


def _row(table: BranchTable, k: int) -> BranchTable:
    """Return the branches of one target of a table."""
    rows = slice(table.firsts[k], table.firsts[k + 1])
    return BranchTable(table.qs[rows], table.codes[rows], table.free[rows], _firsts_of_one(rows.stop - rows.start))


def _firsts_of_one(count: int) -> Indices:
    return np.array([0, count], dtype=np.int64)


def _around(question: TargetProblem, form: ClosedForm, i: int, count: int, most: int) -> BranchTable:
    """Solve one target with the elbow at angles all around the circle, the seed's first."""
    target, seed = question.target(i), question.seed(i)[None]
    steps = np.arange(count) * (2.0 * np.pi / count)
    rows = np.zeros(count, dtype=np.int64)
    return form.solve(
        Poses(target.positions[rows], target.rotations[rows]),
        seed,
        tolerances=question.tolerances,
        respect_limits=question.respect_limits,
        elbow_angles=form.elbow_angles(seed)[0] + steps,
        most=most,
    )


def _thinned(question: TargetProblem, form: ClosedForm, i: int, most: int) -> BranchTable:
    """Sample the self-motion of a free elbow, nearest to the seed first."""
    table = _around(question, form, i, _ELBOWS_SAMPLED, MOST)
    order = np.argsort(np.square(table.qs - question.seed(i)).sum(axis=1), kind="stable")
    order = order[thin_out(table.qs[order], free_variables(question.chain), SPACING, most)]
    return BranchTable(table.qs[order], table.codes[order], table.free[order], _firsts_of_one(len(order)))


def _spread(
    question: TargetProblem,
    form: ClosedForm,
    i: int,
    table: BranchTable,
    masks: Indices,
    most: int,
    elbow_angle: float | None,
) -> BranchTable:
    """Add a sample of the continuum that free joints form at a singularity to the branches of one target.

    Args:
        question: The problem.
        form: The closed form.
        i: Index of the target.
        table: Its branches.
        masks: Bit masks of joints that are free together.
        most: Largest number of solutions.
        elbow_angle: Desired angle of a free elbow, [rad].
    """
    target, seed = question.target(i), question.seed(i)
    rng, seeds = np.random.default_rng(0), []
    for mask in masks.tolist():
        free = [j for j in range(len(seed)) if mask >> j & 1]
        around = np.tile(seed, (_FREE_SAMPLED, 1))
        around[:, free] += rng.uniform(-np.pi, np.pi, (_FREE_SAMPLED, len(free)))
        if len(free) == 1:
            around[:, free[0]] = seed[free[0]] + np.linspace(-np.pi, np.pi, _FREE_SAMPLED, endpoint=False)
        seeds.append(around)
    rows = np.zeros(sum(len(part) for part in seeds), dtype=np.int64)
    others = form.solve(
        Poses(target.positions[rows], target.rotations[rows]),
        np.concatenate(seeds),
        tolerances=question.tolerances,
        respect_limits=question.respect_limits,
        elbow_angles=elbow_angle,
    )
    loose = others.free > 0
    qs = np.concatenate((table.qs, others.qs[loose]))
    order = np.argsort(np.square(qs - seed).sum(axis=1), kind="stable")
    order = order[thin_out(qs[order], free_variables(question.chain), SPACING, most)]
    codes = np.concatenate((table.codes, others.codes[loose]))[order]
    free_ = np.concatenate((table.free, others.free[loose]))[order]
    return BranchTable(qs[order], codes, free_, _firsts_of_one(len(order)))


def _turned(question: TargetProblem, i: int, table: BranchTable, most: int, whole: bool) -> tuple[BranchTable, bool]:
    """Expand each branch to all full turns that the limits allow."""
    qs, owners, whole = wound(question.chain, table.qs, question.seed(i), most, whole, question.respect_limits)
    return BranchTable(qs, table.codes[owners], table.free[owners], _firsts_of_one(len(qs))), whole


def _first(table: BranchTable, most: int) -> BranchTable:
    """Return the first `most` solutions of one target."""
    return BranchTable(table.qs[:most], table.codes[:most], table.free[:most], _firsts_of_one(min(len(table.qs), most)))


def _nothing(n: int, count: int = 1) -> BranchTable:
    """Create a table without solutions for a number of targets."""
    none = np.zeros(0, dtype=np.int64)
    return BranchTable(np.empty((0, n)), none, none, np.zeros(count + 1, dtype=np.int64))
