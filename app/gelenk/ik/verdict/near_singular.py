"""Search for solutions next to a singularity, from configurations near them.

Near a singularity, all equations but one or two hold along a narrow valley of joint space, on which the solutions lie.
They come in pairs: where the tip's path along the valley folds back, it passes the target twice within a short step.
"""

import numpy as np

from gelenk.ik.search.bounds import free_variables, whole_turns_removed
from gelenk.ik.search.problem import TargetProblem
from gelenk.ik.search.words import DIRECTIONS
from gelenk.ik.verdict.branches import thin_out, wound_near
from gelenk.kinematics.simd.kernels import chain_hessians, chain_jacobians
from gelenk.robot.arrays import Array, Indices

_STEPS, _CORRECTIONS, _LONGEST, _SHORTEST_SHARE = 30, 4, 0.5, 1e-3
"""Refinement: steps, corrections after each, the longest step [rad or m], and the share of a step at which it ends."""
_SINGULAR, _WEAK = 1e-15, 1e-3
"""Shares of the largest singular value below which one is rounding, and below which it belongs to a valley."""
_PERFECT = 1e-15
"""Error that needs no refinement, [m, rad]."""
_SAME, _NEAR, _BETWEEN = 1e-7, 1e-3, 2e-14
"""Distance up to which two solutions are the same [rad or m]; distance up to which they are if the error halfway
between them, on the valley, is rounding; and the bound on that error [m, rad]."""
_FURTHEST = 0.7
"""Largest distance at which the curvature predicts a partner, [rad or m]."""
_MOST = 64
"""Most solutions of a target."""
_LANES, _LANES_APART, _NARROW = 8, 0.3, 1e-6
"""Walks along valleys: how many, how far apart they begin [rad], and the singular value below which one begins."""
_WALK, _STRIDE = 16, 0.3
"""Number of configurations on a walk, and length of a step, [rad]."""


def refined(problem: TargetProblem, i: int, qs: Array, least: float) -> Array:
    """Refine configurations for target i by Newton's method; return those with small enough errors, best first; (k, n).

    Each configuration is corrected back onto the valley first, and again after each step before its error is compared,
    as in `branch_kernels`: off the valley, the remaining equation means nothing. `least` is the largest error of a
    solution, [m, rad].
    """
    chain, limits = problem.chain, problem.limits

    def stepped(qs: Array, weak: float, shares: Array) -> Array:
        steps = _steps(*problem.linearised(i, qs), weak)
        shares = shares * np.minimum(1.0, _LONGEST / np.maximum(np.abs(steps).max(axis=1, initial=0.0), _LONGEST))
        return np.asarray(np.clip(qs + shares[:, None] * steps, *limits))

    def corrected(qs: Array) -> Array:
        for _ in range(_CORRECTIONS):
            qs = stepped(qs, _WEAK, np.ones(len(qs)))
        return qs

    def misses(qs: Array) -> Array:
        return np.asarray(np.linalg.norm(problem.linearised(i, qs)[0], axis=1))

    qs = corrected(wound_near(chain, qs, problem.seed(i), *limits))
    errors, shares = misses(qs), np.ones(len(qs))
    for _ in range(_STEPS):
        rows = np.flatnonzero((errors > _PERFECT) & (shares > _SHORTEST_SHARE))
        if not len(rows):
            break
        moved = corrected(stepped(qs[rows], _SINGULAR, shares[rows]))
        after = misses(moved)
        better = after < errors[rows]
        qs[rows[better]], errors[rows[better]] = moved[better], after[better]
        shares[rows] = np.where(better, np.minimum(2.0 * shares[rows], 1.0), 0.25 * shares[rows])
    order = np.argsort(errors, kind="stable")[: np.count_nonzero(errors <= least)]
    return wound_near(chain, qs[order], problem.seed(i), *limits)


def _steps(es: Array, Js: Array, weak: float) -> Array:
    """Newton steps without directions whose singular value is below the share `weak` of the largest; shape (N, n)."""
    return np.asarray(np.einsum("kij,kj->ki", np.linalg.pinv(Js, rcond=weak), es))


def with_partners(problem: TargetProblem, i: int, qs: Array, least: float) -> Array:
    """Refine configurations and add the solutions that pair with them, without duplicates; see `refined`; (k, n)."""
    found = refined(problem, i, qs, least)
    for look in (_further, _partners):
        found = found[distinct(problem, i, found)]
        found = np.concatenate((found, refined(problem, i, look(problem, i, found), least)))
    return found[distinct(problem, i, found)]


def distinct(problem: TargetProblem, i: int, qs: Array) -> Indices:
    """Select distinct solutions of a target: the first of each group that differs only by rounding; indices, (k,)."""
    chosen: list[int] = []
    for k in thin_out(qs, free_variables(problem.chain), _SAME, len(qs)).tolist():
        apart = whole_turns_removed(problem.chain, qs[chosen] - qs[k])
        near = apart[np.abs(apart).max(axis=1, initial=0.0) <= _NEAR]
        if len(near):
            halfway = qs[k] + 0.5 * near
            for _ in range(2):
                halfway = halfway + _steps(*problem.linearised(i, halfway), _WEAK)
            if np.linalg.norm(problem.linearised(i, halfway)[0], axis=1).min() <= _BETWEEN:
                continue
        chosen.append(k)
    return np.array(chosen[:_MOST], dtype=np.int64)


def _further(problem: TargetProblem, i: int, qs: Array) -> Array:
    """Configurations along some valleys where the remaining error changes its sign or is smallest; shape (k, n)."""
    if not _is_square(problem) or not len(qs):
        return qs[:0]
    qs = qs[thin_out(qs, free_variables(problem.chain), _LANES_APART, _LANES)]
    narrow = np.linalg.svd(chain_jacobians(problem.chain.flat, qs)[2], compute_uv=False)[:, -1] < _NARROW
    if not narrow.any():
        return qs[:0]
    path, levels = _walk(problem, i, np.repeat(qs[narrow], 2, axis=0))
    sizes, turns = np.abs(levels), (levels[:-1] > 0.0) != (levels[1:] > 0.0)
    picked = np.zeros(levels.shape, dtype=bool)
    picked[:-1] |= turns
    picked[1:] |= turns
    picked[1:-1] |= (sizes[1:-1] <= sizes[:-2]) & (sizes[1:-1] <= sizes[2:])
    # If the error is rounding all along, the whole valley consists of solutions.
    return np.asarray(path[picked & (sizes.max(axis=0) > _BETWEEN)])


def _walk(problem: TargetProblem, i: int, qs: Array) -> tuple[Array, Array]:
    """Walk along valleys from solutions, each given twice for the two directions of its valley.

    Return configurations, shape (k, N, n), and the errors in the remaining direction, shape (k, N).
    """
    path, levels = np.empty((_WALK, *qs.shape)), np.empty((_WALK, len(qs)))
    ahead, beside = np.zeros(qs.shape), np.zeros(qs.shape)
    for k in range(_WALK):
        for _ in range(_CORRECTIONS if k else 0):
            qs = qs + _steps(*problem.linearised(i, qs), _WEAK)
        es, Js = problem.linearised(i, qs)
        Us, _, Vs = np.linalg.svd(Js)
        u, v = Us[:, :, -1], Vs[:, -1]
        if k == 0:
            ahead, beside = np.where(np.arange(len(qs)) % 2, 1.0, -1.0)[:, None] * v, u
        # A singular vector's sign is arbitrary: keep it the same along the walk.
        beside = u * np.where((u * beside).sum(axis=1) < 0.0, -1.0, 1.0)[:, None]
        ahead = v * np.where((v * ahead).sum(axis=1) < 0.0, -1.0, 1.0)[:, None]
        path[k], levels[k] = qs, (beside * es).sum(axis=1)
        qs = qs + _STRIDE * ahead
    return path, levels


def _is_square(problem: TargetProblem) -> bool:
    return len(problem.chain) == len(DIRECTIONS) == len(problem.task)


def _partners(problem: TargetProblem, _: int, qs: Array) -> Array:
    """Predict the partners of solutions along one of the two weakest directions, or along both; shape (k, n).

    At distance y along the right singular vector v of a singular value σ, the error's part along u is
    -σ y - ½ uᵀH(v, v) y². It vanishes again at y = -2σ / uᵀH(v, v): the fold of a Lyapunov-Schmidt reduction.
    """
    chain = problem.chain
    if not _is_square(problem) or not len(qs):
        return qs[:0]
    Us, sizes, Vs = np.linalg.svd(chain_jacobians(chain.flat, qs)[2])
    Hs = chain_hessians(chain.flat, qs)
    steps = []
    for k in (-1, -2):
        v = Vs[:, k]
        bends = np.einsum("na,naij,ni,nj->n", Us[:, :, k], Hs, v, v)
        near = 2.0 * sizes[:, k] < _FURTHEST * np.abs(bends)
        lengths = np.where(near, -2.0 * sizes[:, k] / np.where(near, bends, 1.0), 0.0)
        steps.append(lengths[:, None] * v)
    moves = np.concatenate((steps[0], steps[1], steps[0] + steps[1]))
    return np.asarray((np.tile(qs, (3, 1)) + moves)[np.abs(moves).max(axis=1) > _SAME])
