"""The torques' limits along a path: as constraints αu + βx ≤ 1 for `reachability`, and as a factor on the time.

With u = s̈ and x = ṡ² the torques on a path q(s) are τ = (M q') u + (M q'' + C q') x + g, linear in (u, x), and where
the limit exceeds the weight's share g, u = x = 0 satisfies it. In `factor` times the time, M q̈ + C q̇ is divided by
`factor`², and g stays.

Within an interval, the terms are replaced by the parabolas through their values at both ends and in the middle.
"""

import numpy as np

from gelenk.errors import InvalidField
from gelenk.robot.arrays import Array
from gelenk.trajectory.audit.torques import TorqueLimits
from gelenk.trajectory.motion.polynomial import PiecewisePolynomial, cut, derivatives
from gelenk.trajectory.paths.path_geometry import LimitedPath, subdivided
from gelenk.trajectory.timing.time_optimal import INTERVALS, Rows, Slower, TimeOptimal, time_optimal
from gelenk.trajectory.timing.tip_constraints import control_points, tip_rows
from gelenk.trajectory.timing.zone_constraints import zone_rows

FIELD = "limits.joint_torque"
MARGIN = 1e-4
"""Fraction of each limit that is reserved for what lies between the places that are examined."""
_PLACES = np.array([0.0, 0.5, 1.0])
_LEAST, _EACH = 800, 4
"""Least number of intervals between examined places in a motion, and in each of its pieces."""


def optimal_within(geometry: LimitedPath, slower: Slower | None = None) -> TimeOptimal:
    """Plan the fastest motion along a path under all of its limits but those of jerk.

    With limits of torque the intervals are half as long: torques bend more than accelerations.
    """
    limits, torques = geometry.limits, torque_rows(geometry)
    every = [rows for rows in (tip_rows(geometry), zone_rows(geometry), torques) if rows is not None]

    def together(nodes: Array) -> tuple[Array, Array]:
        alphas, betas = zip(*(rows(nodes) for rows in every), strict=True)
        return np.hstack(alphas), np.hstack(betas)

    intervals = INTERVALS if torques is None else 2 * INTERVALS
    rows = together if every else None
    bounds = limits.velocity, limits.acceleration
    return time_optimal(geometry.joints, *bounds, intervals=intervals, further=rows, slower=slower)


def torque_rows(geometry: LimitedPath) -> Rows | None:
    """Return the function from nodes in 0 ≤ s ≤ 1 to α and β on the intervals between them; None without limits.

    It raises `InvalidField` where the weight alone asks for more than a limit.
    """
    limits, path = geometry.limits.torque, geometry.joints
    if limits is None or not geometry.limits_torque:
        return None
    length = path.duration

    def rows(nodes: Array) -> tuple[Array, Array]:
        s = path.breaks[0] + length * nodes
        places = np.diff(s)[:, None] * _PLACES
        pieces = np.repeat(cut(path, s), len(_PLACES), axis=0)
        q, first, second = derivatives(pieces, places.reshape(-1, 1), 2)
        along = limits.parts(q, np.zeros_like(q), first * length)[0]
        bend, weight = limits.parts(q, first * length, second * length**2)
        most = geometry.torque_bounds(geometry.piece_of(0.5 * (s[:-1] + s[1:])))
        above, below = _rooms(limits, np.repeat(most, len(_PLACES), axis=0), weight)
        shape = len(s) - 1, len(_PLACES), -1
        gains = 2.0 * np.diff(nodes)[:, None, None] * _PLACES[:, None]
        beta = np.hstack((bend / above, -bend / below)).reshape(shape)
        alpha = np.hstack((along / above, -along / below)).reshape(shape) + gains * beta
        return control_points(alpha).reshape(shape[0], -1), control_points(beta).reshape(shape[0], -1)

    return rows


def torque_factor(motion: PiecewisePolynomial, torque: TorqueLimits) -> float:
    """Return by what the time of a motion is multiplied for its torques to keep their limits, at least 1.

    `InvalidField` where the weight alone asks for more than a limit.
    """
    if not torque.is_limited:
        return 1.0
    widths = np.diff(motion.breaks)
    piece, within, steps = subdivided(widths, _LEAST, _EACH)
    states = derivatives(motion.coefficients[piece], (within * widths[piece] / steps)[:, None], 2)
    inertial, weight = torque.parts(*states)
    above, below = _rooms(torque, torque.most, weight)
    return float(np.sqrt(max(1.0, (inertial / above).max(initial=0.0), (-inertial / below).max(initial=0.0))))


def _rooms(torque: TorqueLimits, limits: Array, weight: Array) -> tuple[Array, Array]:
    """Return what the weight leaves of each limit above and below it, less the margin; shape (N, n) → (N, n) each."""
    most = np.broadcast_to(limits * (1.0 - MARGIN), weight.shape)
    excess = np.abs(weight) - most
    if (excess >= 0.0).any():
        row, joint = np.unravel_index(excess.argmax(), excess.shape)
        needed, limit = abs(weight[row, joint]), np.broadcast_to(limits, weight.shape)[row, joint]
        raise InvalidField(
            FIELD,
            f"the weight alone asks joint {torque.names[joint]} for {needed:.6g} {torque.units[joint]} on the way, and "
            f"its limit is {limit:.6g} {torque.units[joint]}: lighten the payload, or lead the motion "
            "where the arm reaches less far",
        )
    return most - weight, most + weight
