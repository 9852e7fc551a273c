"""Bounds of a chain's variables, and the input of the kernels."""

from functools import lru_cache

import numpy as np

from gelenk.ik.search.iteration import SOME, Goal
from gelenk.ik.search.task import Task
from gelenk.robot.arrays import Array, Flags
from gelenk.robot.chain import Chain
from gelenk.robot.poses import Poses

_TURN = 2.0 * np.pi


@lru_cache(maxsize=256)
def mid_range(chain: Chain) -> Array:
    """Middle of the joint limits; the value nearest to 0 if a limit is missing; shape (n,), [rad or m]."""
    lower, upper = chain.lower, chain.upper
    middle = np.zeros(len(chain))
    bounded = np.isfinite(lower) & np.isfinite(upper)
    middle[bounded] = 0.5 * (lower[bounded] + upper[bounded])
    middle = np.where(np.isfinite(lower) & ~bounded, np.maximum(lower, 0.0), middle)
    return np.where(np.isfinite(upper) & ~bounded, np.minimum(upper, 0.0), middle)


@lru_cache(maxsize=256)
def limits_of(chain: Chain, respect_limits: bool) -> Array:
    """Lower and upper limits of the variables, infinite if they are not respected; shape (2, n), [rad or m]."""
    if respect_limits:
        return np.stack((chain.lower, chain.upper))
    return np.repeat([[-np.inf], [np.inf]], len(chain), axis=1)


@lru_cache(maxsize=256)
def free_variables(chain: Chain) -> Flags:
    """Flag the variables whose full turn leaves the pose unchanged: revolute, with integer gear ratios; shape (n,)."""
    free = np.ones(len(chain), dtype=bool)
    for (prismatic, variable), (multiplier, _) in zip(chain.flat.joints, chain.flat.drives, strict=True):
        if prismatic or multiplier != np.rint(multiplier):
            free[variable] = False
    return free


def whole_turns_removed(chain: Chain, differences: Array) -> Array:
    """Reduce differences of configurations by full turns of the free variables; shape (N, n)."""
    return differences - np.where(free_variables(chain), _TURN * np.rint(differences / _TURN), 0.0)


@lru_cache(maxsize=256)
def search_bounds(chain: Chain, respect_limits: bool) -> Array:
    """Compute `Goal.bounds`; shape (6, n), [rad or m].

    A joint whose limits are a full turn or more apart turns freely, and is wound back into them at the end.
    """
    n = len(chain)
    lower, upper = limits_of(chain, respect_limits)
    free = free_variables(chain) & (upper - lower >= _TURN)
    spread = _spreads(chain)
    middle = mid_range(chain)
    bounds = np.empty((6, n))
    bounds[0], bounds[1] = np.where(free, -np.inf, lower), np.where(free, np.inf, upper)
    bounds[2] = np.where(free, -np.pi, np.where(np.isfinite(lower), lower, middle - spread))
    bounds[3] = np.where(free, np.pi, np.where(np.isfinite(upper), upper, middle + spread))
    bounds[4], bounds[5] = np.where(free, lower, np.nan), np.where(free, upper, np.nan)
    return bounds


def _spreads(chain: Chain) -> Array:
    """Half-width of the interval from which starts of a variable without limits are drawn; shape (n,), [rad or m].

    Half a turn of the slowest joint it drives, or the total length of the chain's constant parts, at least a metre.
    """
    length = max(1.0, float(np.linalg.norm(chain.flat.placements[:, 9:], axis=1).sum()))
    spreads = np.zeros(len(chain))
    for (prismatic, variable), (multiplier, _) in zip(chain.flat.joints, chain.flat.drives, strict=True):
        spread = (length if prismatic else np.pi) / max(abs(multiplier), 1e-3)
        spreads[variable] = max(spreads[variable], spread)
    return spreads


@lru_cache(maxsize=1024)
def make_goal(
    chain: Chain,
    task: Task,
    tolerances: tuple[float, float],
    respect_limits: bool,
    starts: int,
    random_seed: int = 0,
    slack: float = 0.0,
) -> Goal:
    """Create the kernels' input: tolerances of position [m] and orientation [rad]; for the others see `Goal`."""
    bounds, chord = search_bounds(chain, respect_limits), _chord(tolerances[1], task)
    return Goal(bounds, task.weights, task.kind, task.axis, tolerances[0], chord, slack, starts, random_seed)


def _chord(tolerance: float, task: Task) -> float:
    """Convert an angle θ [rad] to the kernels' chord 2 sin(θ/2); components of it may be as small as 2/π of θ."""
    if task.kind == SOME:
        return tolerance * 2.0 / np.pi
    return float(2.0 * np.sin(0.5 * min(tolerance, np.pi)))


def target_rows(targets: Poses) -> Array:
    """Convert poses to the kernels' rows: rotation row by row, then position [m]; shape (N, 12)."""
    rows = np.empty((len(targets), 12))
    rows[:, :9] = targets.rotations.reshape(-1, 9)
    rows[:, 9:] = targets.positions
    return rows
