"""The shortest way up a ladder: one configuration of each rung, each a bounded step of the joints from the one before.

A dynamic programme: the least cost to each configuration is the least, over all of the rung before, of the cost to
there plus that of the step, √Σ (w_j Δq_j)². No choice of one configuration on each rung costs less.
"""

from typing import NamedTuple

import numpy as np

from gelenk.robot.arrays import Array, Flags, Indices
from gelenk.robot.compilation import compiled

_TURN = 2.0 * np.pi


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
    costs, before = _climbed(rungs.qs, rungs.firsts, metric.weights, metric.longest, metric.turning, first_costs)
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


@compiled
def _climbed(
    qs: Array, firsts: Indices, weights: Array, longest: Array, turning: Flags, first_costs: Array
) -> tuple[Array, Indices]:
    """Return the least cost to each configuration, infinite if there is no way, and the row before it, -1 for none."""
    n = qs.shape[1]
    costs, before = np.full(len(qs), np.inf), np.full(len(qs), -1)
    costs[: firsts[1]] = first_costs
    most = np.diff(firsts).max()
    below, totals, squares = np.empty((n, most)), np.empty(most), np.empty(most)
    rows = np.empty(most, np.int64)
    for rung in range(1, len(firsts) - 1):
        count = 0
        for row in range(firsts[rung - 1], firsts[rung]):
            if costs[row] < np.inf:
                rows[count], totals[count], below[:, count] = row, costs[row], qs[row]
                count += 1
        if count == 0:
            break
        for row in range(firsts[rung], firsts[rung + 1]):
            squares[:count] = 0.0
            for j in range(n):
                _add_steps(below[j], qs[row, j], weights[j], longest[j], turning[j], count, squares)
            best, least = -1, np.inf
            for k in range(count):
                squares[k] = totals[k] + np.sqrt(squares[k])
            for k in range(count):
                if squares[k] < least:
                    best, least = k, squares[k]
            if best >= 0:
                costs[row], before[row] = least, rows[best]
    return costs, before


@compiled
def _add_steps(
    below: Array, q: float, weight: float, longest: float, turning: bool, count: int, squares: Array
) -> None:
    """Add the weighted squares of one joint's steps to a value; a step that is too long makes them infinite."""
    for k in range(count):
        step = below[k] - q
        if turning:
            step -= _TURN * np.rint(step / _TURN)
        squares[k] += (weight * step) ** 2 if abs(step) <= longest else np.inf
