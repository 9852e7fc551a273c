"""Compiled choice of the figures that count: those of the joint that comes nearest to its limit, a row for each check.

A row holds the ratio to the limit, the value, the joint's index and the time, [s]. Without a limit the ratio is -1.
"""

import math
from typing import NamedTuple

import numpy as np

from gelenk.robot.arrays import Array
from gelenk.robot.compilation import compiled, inlined
from gelenk.trajectory.audit.joints import JointFigures, joint_figures
from gelenk.trajectory.audit.pieces import scaled_pieces

STATED, JUMPS, MARGIN, ENDS, ROWS = 3, 4, 8, 9, 15
"""The rows of velocity, acceleration and jerk come first, then jerk against what is stated, the jumps of four
derivatives, the distance to joint limits with 1 for a lower one in place of its ratio, and the errors of three
derivatives at the start and at the end."""


class JointDemands(NamedTuple):
    """What is demanded of the joints.

    Attributes:
        limits: Of velocity, acceleration and jerk, and the stated ones of jerk; infinite for none; shape (4, n).
        lower, upper: Limits of the position; shape (n,).
        ends: Positions at the start and the end, shape (2, n), or (0, n) if both are open.
        rates: Velocities, and accelerations if they count, at the start and the end, shape (2, 1 or 2, n), or
            (0, 1, n) for velocities of zero.
    """

    limits: Array
    lower: Array
    upper: Array
    ends: Array
    rates: Array


@compiled
def joint_rows(joints: JointFigures, at_ends: Array, demands: JointDemands) -> Array:
    """Return all rows of what at least one joint does; `at_ends` is what `joint_ends` returns."""
    rows, n, (count, rates, _) = np.zeros((ROWS, 4)), at_ends.shape[2], demands.rates.shape
    off, none = np.empty(n), np.full(n, np.inf)
    for k in range(STATED + 1):
        order = min(k, STATED - 1) + 2
        _store(rows[k], worst(joints.extremes[order], joints.times[order], demands.limits[k]))
    _store_jumps(joints, none, rows[JUMPS:])
    _store(rows[MARGIN], _margin(joints, demands.lower, demands.upper))
    for end in range(2):
        for order in range(3):
            for j in range(n):
                wanted = 0.0
                if order == 0 and len(demands.ends):
                    wanted = demands.ends[end, j]
                elif count and 0 < order <= rates:
                    wanted = demands.rates[end, order - 1, j]
                off[j] = abs(at_ends[end, order, j] - wanted)
            _store(rows[ENDS + 3 * end + order], worst(off, off, none))
    return rows


@inlined
def _store(row: Array, found: tuple[float, float, float, float]) -> None:
    row[0], row[1], row[2], row[3] = found


@compiled
def _store_jumps(joints: JointFigures, none: Array, rows: Array) -> None:
    for order in range(len(joints.jumps)):
        _store(rows[order], worst(joints.jumps[order], joints.jump_times[order], none))


@compiled
def jumps_of(breaks: Array, coefficients: Array) -> Array:
    """Return the rows of the jumps of a motion of at least one joint; shape (4, 4)."""
    rows = np.empty((4, 4))
    _store_jumps(joint_figures(scaled_pieces(breaks, coefficients)), np.full(coefficients.shape[2], np.inf), rows)
    return rows


@compiled
def worst(values: Array, times: Array, limits: Array) -> tuple[float, float, float, float]:
    """Return the row of the joint nearest to its limit, or of the largest value if none is limited; shape (n,) each.

    What is not a number is the largest; a limit of 0 allows nothing else.
    """
    is_limited, joint, found, most = False, 0, -1.0, -np.inf
    for limit in limits:
        is_limited |= limit < np.inf
    for j in range(len(values)):
        ratio = size = abs(values[j])
        if is_limited:
            ratio = size / limits[j] if limits[j] > 0.0 else 0.0 if size == 0.0 else np.inf
        rank = np.inf if math.isnan(ratio) else ratio
        if rank > most:
            joint, found, most = j, ratio, rank
    return found if is_limited else -1.0, values[joint], float(joint), times[joint]


@compiled
def _margin(joints: JointFigures, lower: Array, upper: Array) -> tuple[float, float, float, float]:
    joint, bound, found, least = 0, 0, np.inf, np.inf
    for side in range(2):
        for j in range(len(lower)):
            # 0 - 0 is 0, and the opposite of 0 is -0.
            distance = 0.0 - joints.extremes[0, j] - lower[j] if side else upper[j] - joints.extremes[1, j]
            rank = -np.inf if math.isnan(distance) else distance
            if rank < least:
                joint, bound, found, least = j, side, distance, rank
    return float(bound), found, float(joint), joints.times[1 - bound, joint]
