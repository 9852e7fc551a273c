"""Most figures of a motion's audit at once: between two compiled functions, Python takes as long as either."""

from typing import NamedTuple

import numpy as np

from gelenk.ik.search.task import Task
from gelenk.kinematics.simd.kernels import chain_poses
from gelenk.robot.arrays import Array, Indices
from gelenk.robot.chain import Chain, FlatChain
from gelenk.robot.compilation import compiled
from gelenk.robot.poses import Poses
from gelenk.trajectory.audit.joints import JointFigures, joint_figures
from gelenk.trajectory.audit.pieces import Pieces, even_positions, joint_ends, scaled_pieces, travels
from gelenk.trajectory.audit.tip import counted_rows, least_singular_value, rate_peaks, rate_samples, sigma_samples
from gelenk.trajectory.motion.polynomial import PiecewisePolynomial


class Examined(NamedTuple):
    """What a motion does.

    Attributes:
        ends: Position, velocity and acceleration at the start and the end; shape (2, 3, n).
        tip, tip_times: The largest value of each of `RATES`, and when, [s]; shape (4,) each.
        sigma, sigma_time: The smallest singular value, and when, [s]; ∞ without joints.
        qs, poses: Configurations evenly spread in time, shape (N, n), and the tip's poses there.
    """

    pieces: Pieces
    joints: JointFigures
    ends: Array
    tip: Array
    tip_times: Array
    sigma: float
    sigma_time: float
    qs: Array
    poses: Poses


def examined(chain: Chain, motion: PiecewisePolynomial, task: Task, count: int) -> Examined:
    """Examine a motion of finite numbers; `count` configurations are spread along it."""
    c, breaks = np.ascontiguousarray(motion.coefficients), np.ascontiguousarray(motion.breaks)
    pieces, joints, numbers, qs, poses = _examined(chain.flat, breaks, c, *counted_rows(task), count)
    return Examined(Pieces(*pieces), JointFigures(*joints), *numbers, qs, Poses(*poses))


# Of plain tuples: to make another class, compiled code looks it up by its name each time.
_Arrays = tuple[Array, ...]


@compiled
def _examined(
    flat: FlatChain, breaks: Array, coefficients: Array, rows: Indices, about_tip: bool, count: int
) -> tuple[_Arrays, _Arrays, tuple[Array, Array, Array, float, float], Array, _Arrays]:
    pieces = scaled_pieces(breaks, coefficients)
    joints, qs, travel = joint_figures(pieces), even_positions(pieces, count), travels(pieces)
    velocity, acceleration, sigma, sigma_time = 0.0, 0.0, np.inf, breaks[0]
    if coefficients.shape[2]:
        velocity, acceleration = np.abs(joints.extremes[2]).max(), np.abs(joints.extremes[3]).max()
        sigma, sigma_time = least_singular_value(flat, pieces, rows, about_tip, travel, sigma_samples(travel))
    tip, tip_times = rate_peaks(flat, pieces, rate_samples(travel), velocity, acceleration)
    return (
        (pieces.starts, pieces.widths, pieces.scaled),
        (joints.extremes, joints.times, joints.jumps, joints.jump_times),
        (joint_ends(pieces), tip, tip_times, sigma, sigma_time),
        qs,
        chain_poses(flat, qs),
    )
