"""The joints' limits in zones of a path as constraints αu + βx ≤ 1 for `reachability`, beside those everywhere.

As with the tip's, the terms are replaced by parabolas within each interval.
"""

import numpy as np

from gelenk.robot.arrays import Array
from gelenk.trajectory.motion.polynomial import derivatives
from gelenk.trajectory.paths.path_geometry import LimitedPath
from gelenk.trajectory.timing.time_optimal import Rows
from gelenk.trajectory.timing.tip_constraints import control_points, sampled


def zone_rows(geometry: LimitedPath) -> Rows | None:
    """Return the function from nodes in 0 ≤ s ≤ 1 to α and β on the intervals between them; None without such zones."""
    if all(zone.joints is None for zone in geometry.zones):
        return None
    path, length = geometry.joints, geometry.joints.duration

    def rows(nodes: Array) -> tuple[Array, Array]:
        piece, places, gains = sampled(geometry, nodes)
        each = np.repeat(piece, places.shape[1])
        local = places.reshape(-1, 1) - path.breaks[each, None]
        _, first, second = (one.reshape(*places.shape, -1) for one in derivatives(path.coefficients[each], local, 2))
        velocity, acceleration = np.moveaxis(geometry.joint_bounds(piece)[:, :2, None], 1, 0)
        gain, slope, bend = gains[:, :, None], length * first / acceleration, length**2 * second / acceleration
        squares = (length * first / velocity) ** 2
        along, bend = control_points(slope + gain * bend), control_points(bend)
        alpha = along, -along, control_points(gain * squares)
        beta = bend, -bend, control_points(squares)
        return np.hstack(alpha).reshape(len(piece), -1), np.hstack(beta).reshape(len(piece), -1)

    return rows
