"""The shortest way up a ladder: one configuration of each rung, each a bounded step of the joints from the one before.

A dynamic programme: the least cost to each configuration is the least, over all of the rung before, of the cost to
there plus that of the step, √Σ (w_j Δq_j)². No choice of one configuration on each rung costs less. Each rung is sorted
by one joint, so that only those near in it are compared, eight at a time.
"""

from typing import Any, NamedTuple

import numpy as np

from gelenk.kinematics.simd.lanes import LANES, abs_lanes, lanes, load, rint_lanes, sqrt_lanes, store, where
from gelenk.robot.arrays import Array, Flags, Indices
from gelenk.robot.compilation import compiled, unmanaged

_TURN = 2.0 * np.pi
_SAMPLE = 64
"""Configurations that are compared to find the joint that tells most apart."""
_ROUNDING = 1e-9
"""By how much more than the longest step is searched, because whole turns are rounded, [rad]."""


class Rungs(NamedTuple):
    """Configurations of N rungs in one table: rows firsts[i] up to, but not including, firsts[i + 1] are on rung i.

    Attributes:
        qs: Shape (M, n), [rad or m].
        firsts: First row of each rung, and M at the end; shape (N + 1,).
    """

    qs: Array
    firsts: Indices


class Metric(NamedTuple):
    """How steps of the joints are measured; shape (n,) each.

    Attributes:
        weights: w, cost per [rad or m].
        longest: Longest step of each joint between two rungs, [rad or m].
        turning: Whether whole turns of a joint make no difference.
    """

    weights: Array
    longest: Array
    turning: Flags


def way_up(rungs: Rungs, metric: Metric, first_costs: Array) -> tuple[Indices, float]:
    """Return the rows of the cheapest way as far up as there is one, and its cost; no rows if all begin at infinity.

    `first_costs` are the costs of the configurations on the first rung, infinite where none may begin.
    """
    weights, longest, turning = metric
    costs, before = _climbed(*rungs, weights, longest, turning, first_costs, _key(rungs, metric))
    owners = np.repeat(np.arange(len(rungs.firsts) - 1), np.diff(rungs.firsts))
    reached = np.flatnonzero(np.isfinite(costs))
    if len(reached) == 0:
        return np.empty(0, dtype=np.int64), 0.0
    top = reached[owners[reached] == owners[reached[-1]]]
    row = int(top[costs[top].argmin()])
    rows, cost = [row], float(costs[row])
    while before[rows[-1]] >= 0:
        rows.append(int(before[rows[-1]]))
    return np.array(rows[::-1]), cost


def _key(rungs: Rungs, metric: Metric) -> int:
    """Return the joint by which sorting separates most: in which the fewest of a sample of the widest rung are near."""
    widest = int(np.diff(rungs.firsts).argmax())
    qs = rungs.qs[rungs.firsts[widest] : rungs.firsts[widest + 1]]
    sample = np.random.default_rng(0).permutation(qs)[:_SAMPLE]
    steps = sample[:, None] - sample
    steps -= np.where(metric.turning, _TURN * np.rint(steps / _TURN), 0.0)
    return int((np.abs(steps) <= metric.longest).sum(axis=(0, 1)).argmin())


@compiled
def _climbed(
    qs: Array, firsts: Indices, weights: Array, longest: Array, turning: Flags, first_costs: Array, key: int
) -> tuple[Array, Indices]:
    """Return the least cost to each configuration, infinite if there is no way, and the row before it, -1 for none."""
    costs, before = np.full(len(qs), np.inf), np.full(len(qs), -1)
    costs[: firsts[1]] = first_costs
    measures, reach, found = (weights, longest, turning), longest[key] + _ROUNDING, np.empty(2 * LANES)
    for rung in range(1, len(firsts) - 1):
        rows = firsts[rung - 1] + np.flatnonzero(costs[firsts[rung - 1] : firsts[rung]] < np.inf)
        if len(rows) == 0:
            break
        rows, keys = _sorted(rows, _unturned(qs[rows, key], turning[key]), reach, turning[key])
        below = _in_eights(qs, costs, rows)
        for row in range(firsts[rung], firsts[rung + 1]):
            at = _unturned(qs[row, key], turning[key])
            first, last = np.searchsorted(keys, at - reach), np.searchsorted(keys, at + reach)
            best, costs[row] = _cheapest(below, qs[row], measures, first // LANES, -(-last // LANES), found)
            before[row] = rows[best] if best >= 0 else -1
    return costs, before


@compiled
def _unturned(q: Any, turning: bool) -> Any:
    """Return values of a joint, from -π to π if it turns."""
    return q - _TURN * np.rint(q / _TURN) if turning else q


@compiled
def _sorted(rows: Indices, keys: Array, reach: float, turning: bool) -> tuple[Indices, Array]:
    """Sort rows by their keys; if these turn, those near to one end are also behind the other."""
    if turning:
        rows, keys = np.concatenate((rows, rows, rows)), np.concatenate((keys - _TURN, keys, keys + _TURN))
        near = np.abs(keys) <= np.pi + reach
        rows, keys = rows[near], keys[near]
    order = np.argsort(keys)
    return rows[order], keys[order]


@compiled
def _in_eights(qs: Array, costs: Array, rows: Indices) -> Array:
    """Return rows as lanes: of each eight all joints, then the costs; what fills up the last eight is infinite."""
    n = qs.shape[1]
    stack = np.full((-(-len(rows) // LANES), n + 1, LANES), np.inf)
    for k, row in enumerate(rows):
        for j in range(n):
            stack[k // LANES, j, k % LANES] = qs[row, j]
        stack[k // LANES, n, k % LANES] = costs[row]
    return stack.ravel()


@unmanaged
def _cheapest(
    below: Array, q: Array, measures: tuple[Array, Array, Flags], first: int, last: int, found: Array
) -> tuple[int, float]:
    """Return the place among some eights of `below` from which a step to q costs least, -1 for none, and the cost."""
    weights, longest, turning = measures
    n, least, place = len(q), lanes(np.inf), lanes(-1.0)
    for eight in range(first, last):
        square = lanes(0.0)
        for j in range(n):
            step = load(below, (n + 1) * eight + j) - q[j]
            if turning[j]:
                step = step - _TURN * rint_lanes(step * (1.0 / _TURN))
            square = square + where(abs_lanes(step) <= longest[j], (weights[j] * step) * (weights[j] * step), np.inf)
        total = load(below, (n + 1) * eight + n) + sqrt_lanes(square)
        better = total < least
        least, place = where(better, total, least), where(better, eight, place)
    store(found, 0, least)
    store(found, 1, place)
    lane = 0
    for other in range(1, LANES):
        if found[other] < found[lane]:
            lane = other
    return LANES * int(found[LANES + lane]) + lane if found[lane] < np.inf else -1, found[lane]
