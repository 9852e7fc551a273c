"""All distinct solutions of a target by search: starts spread over joint space, duplicates removed."""

import math
from dataclasses import dataclass
from itertools import product

import numpy as np

from gelenk.ik.search.bounds import free_variables, make_goal, target_rows, whole_turns_removed
from gelenk.ik.search.null_space import settle
from gelenk.ik.search.problem import Objective, TargetProblem
from gelenk.ik.search.restarts import solutions_from
from gelenk.kinematics.simd.kernels import chain_poses
from gelenk.robot.arrays import Array, Flags, Indices
from gelenk.robot.chain import Chain
from gelenk.robot.compilation import compiled
from gelenk.robot.poses import Poses

STARTS = 2048
"""Starts of one target; half of them ignore the limits, since their solutions may still be within."""

_TIGHT = 1e-10
"""Tolerances of the search, [m] and [rad]."""
_SAME = 1e-4
"""Distance in every joint up to which two solutions are the same, [rad or m]."""
SPACING = 0.2
"""Spacing in some joint of the sample of a continuum of solutions, [rad or m]."""
_NEIGHBOURS = 0.02
"""Distance up to which two solutions are the same if the midpoint is a solution too, [rad or m]."""
_MOST_DISTINCT = 256
"""Most solutions examined for a continuum."""
_MOST_ISOLATED = 32
"""More solutions than this form a continuum: a 6R arm has at most 16 isolated ones [Raghavan1993]."""
_MOST_WINDINGS = 100_000
"""Most combinations of solutions and full turns examined."""
_ROUNDING = 1e-9
"""Distance beyond a limit that still counts as at it, [rad or m]."""
_TURN = 2.0 * np.pi
SEARCHED = "these are the results of a search from many starts; there may be others"
TRUNCATED = "the requested number of solutions is reached; there are others"


@dataclass(frozen=True, slots=True)
class Branches:
    """Solutions of one target, nearest to the seed first.

    Attributes:
        qs: Solutions; shape (k, n), [rad or m].
        doubt: Why these may not be all; a search never proves that they are.
        code: Their branch code, see `InverseKinematics.codes`.
    """

    qs: Array
    doubt: str
    code: int = -1


def all_branches(problem: TargetProblem, i: int, *, windings: bool = False) -> Branches:
    """Search for all distinct solutions of target i, modulo full turns unless `windings` is set.

    A redundant arm, or an arm at a singularity where a joint moves without effect, has infinitely many. The result is
    then a sample, no two within 0.2 rad or m in every joint, chosen from the nearest to the seed outwards.
    """
    candidates, seed = _converged(problem, i), problem.seed(i)
    free, most = free_variables(problem.chain), problem.options.most
    isolated = candidates[:0]
    continuum = len(problem.chain) > len(problem.task)
    if not continuum:
        distinct = sorted_by_distance(candidates[thin_out(candidates, free, _SAME, _MOST_DISTINCT)], seed)
        isolated = _without_doubles(problem, i, distinct)
        continuum = len(isolated) > _MOST_ISOLATED
    if continuum:
        candidates = sorted_by_distance(candidates, seed)
        # Of infinitely many solutions the nearest is not among those found, but close to the first.
        own = problem.taken(slice(i, i + 1))
        candidates = np.concatenate((settle(own, candidates[:1], Objective("posture", seed)), candidates))
        isolated = candidates[thin_out(candidates, free, SPACING, most)]
    qs = isolated[:most]
    if windings and len(qs):
        qs, _, _ = wound(problem, i, qs, False)
    return Branches(qs, "infinitely many solutions, of which these are a sample" if continuum else SEARCHED)


def _without_doubles(problem: TargetProblem, i: int, qs: Array) -> Array:
    """Drop solutions whose midpoint to an earlier one is a solution too, as at a singularity; shape (k, n)."""
    kept: list[int] = []
    for k in range(len(qs)):
        differences = whole_turns_removed(problem.chain, qs[kept] - qs[k])
        near = differences[np.abs(differences).max(axis=1, initial=0.0) <= _NEIGHBOURS]
        middles = Poses(*chain_poses(problem.chain.flat, qs[k] + 0.5 * near))
        errors = problem.task.errors(problem.taken(np.full(len(near), i)).targets, middles)
        if not (problem.tolerances >= errors.T).all(axis=1).any():
            kept.append(k)
    return qs[kept]


def _converged(problem: TargetProblem, i: int) -> Array:
    """Converged starts, within the limits and as near to the seed as full turns allow; shape (k, n)."""
    chain, seed, options = problem.chain, problem.seed(i), problem.options
    found = []
    choices = (True, False) if options.respect_limits else (False,)
    for limited in choices:
        # Search to rounding, so that a double solution is found once; if that fails, to the given tolerances.
        for most in (_TIGHT, np.inf):
            tolerances = min(most, options.position_tolerance), min(most, options.orientation_tolerance)
            starts = STARTS // len(choices)
            goal = make_goal(chain, problem.task, tolerances, limited, starts, options.random_seed + limited)
            qs, _ = solutions_from(chain.flat, goal, target_rows(problem.target(i)), seed[None])
            if len(qs):
                found.append(qs)
                break
    if not found:
        return np.empty((0, len(chain)))
    lower, upper = problem.limits
    qs = wound_near(chain, np.concatenate(found), seed, lower, upper)
    # A solution at a limit may miss it by rounding.
    within = ((qs >= lower - _ROUNDING) & (qs <= upper + _ROUNDING)).all(axis=1)
    return np.asarray(np.clip(qs[within], lower, upper))


def wound_near(chain: Chain, qs: Array, seed: Array, lower: Array, upper: Array) -> Array:
    """Turn free variables by full turns into the limits, as near to the seed as possible; shape (N, n).

    A variable that fits nowhere within its limits ends as near to them as full turns bring it; one that rounding has
    carried over a limit is put back on it.
    """
    wound = qs.copy()
    for j in np.flatnonzero(free_variables(chain)):
        # Count full turns first and add them once: adding and subtracting would round.
        turns = np.rint((seed[j] - qs[:, j]) / _TURN)
        if np.isfinite(upper[j]):
            turns -= np.maximum(0.0, np.ceil((qs[:, j] + _TURN * turns - upper[j] - _ROUNDING) / _TURN))
        if np.isfinite(lower[j]):
            raised = turns + np.maximum(0.0, np.ceil((lower[j] - qs[:, j] - _TURN * turns - _ROUNDING) / _TURN))
            # If neither is within, take the nearer of the two.
            above, below = qs[:, j] + _TURN * raised - upper[j], lower[j] - qs[:, j] - _TURN * turns
            turns = np.where((above > _ROUNDING) & (above > below), turns, raised)
        wound[:, j] = np.where(turns == 0.0, qs[:, j], qs[:, j] + _TURN * turns)
    inside = np.clip(wound, lower, upper)
    return np.where(np.abs(wound - inside) <= _ROUNDING, inside, wound)


def by_distance(qs: Array, seed: Array) -> Indices:
    """Return the order of configurations by their distance to the seed, the nearest first; shape (N,)."""
    return np.argsort(np.square(qs - seed).sum(axis=1), kind="stable")


def sorted_by_distance(qs: Array, seed: Array) -> Array:
    """Sort configurations by their distance to the seed, the nearest first; shape (N, n)."""
    return qs[by_distance(qs, seed)]


@compiled
def thin_out(qs: Array, free: Flags, spacing: float, most: int) -> Indices:
    """Select rows of (N, n) in order that differ from all selected before by more than `spacing` in some variable.

    Free variables count modulo full turns. Return the indices of at most `most` rows; shape (k,).
    """
    chosen = np.empty(min(most, len(qs)), np.int64)
    count = 0
    for i in range(len(qs)):
        if count == most:
            break
        distinct = True
        for c in range(count):
            largest = 0.0
            for j in range(qs.shape[1]):
                difference = qs[i, j] - qs[chosen[c], j]
                if free[j]:
                    difference -= 2.0 * np.pi * np.rint(difference / (2.0 * np.pi))
                largest = max(largest, abs(difference))
            if largest <= spacing:
                distinct = False
                break
        if distinct:
            chosen[count] = i
            count += 1
    return chosen[:count]


def wound(problem: TargetProblem, i: int, qs: Array, complete: bool) -> tuple[Array, Indices, bool]:
    """Expand each solution to all combinations of full turns that the limits allow, nearest to the seed first.

    A joint without limits keeps its value; without respect for limits nothing is turned. The options give the largest
    number of configurations; `complete` says whether `qs`, shape (k, n), are all solutions modulo full turns.

    Returns:
        Configurations, shape (m, n); the index in `qs` of each, shape (m,); and whether these are all solutions.
    """
    chain, most, respect_limits = problem.chain, problem.options.most, problem.options.respect_limits
    free = free_variables(chain)
    results: list[tuple[float, ...]] = []
    owners: list[int] = []
    for k, q in enumerate(qs):
        ranges = [_turns(chain, j, value, respect_limits and bool(free[j])) for j, value in enumerate(q)]
        count = math.prod(len(turns) for turns in ranges)
        if len(results) + count > _MOST_WINDINGS:
            ranges = [range(1)] * len(q)
            count, complete = 1, False
        results.extend(product(*([value + _TURN * t for t in turns] for value, turns in zip(q, ranges, strict=True))))
        owners.extend([k] * count)
    table = np.array(results)
    if respect_limits:
        table = np.clip(table, chain.lower, chain.upper)
    order = by_distance(table, problem.seed(i))[:most]
    return table[order], np.array(owners, dtype=np.int64)[order], complete and len(table) <= most


def _turns(chain: Chain, j: int, value: float, turning: bool) -> range:
    lower, upper = chain.lower[j], chain.upper[j]
    if not (turning and np.isfinite(lower) and np.isfinite(upper)):
        return range(1)
    return range(math.ceil((lower - value) / _TURN - 1e-10), math.floor((upper - value) / _TURN + 1e-10) + 1)
