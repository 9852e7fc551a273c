"""Most figures of a motion's audit at once: between two compiled functions, Python takes as long as either."""

from typing import NamedTuple

import numpy as np

from gelenk.ik.search.task import FULL_POSE, Task
from gelenk.kinematics.simd.kernels import chain_poses
from gelenk.robot.arrays import Array, Indices
from gelenk.robot.chain import Chain, FlatChain
from gelenk.robot.compilation import compiled
from gelenk.robot.poses import Poses
from gelenk.trajectory.audit.joints import joint_figures
from gelenk.trajectory.audit.pieces import are_pieces, even_positions, joint_ends, scaled_pieces, travels
from gelenk.trajectory.audit.tip import counted_rows, least_singular_value, rate_peaks, rate_samples, sigma_samples
from gelenk.trajectory.audit.worst import ROWS, JointDemands, joint_rows
from gelenk.trajectory.motion.polynomial import PiecewisePolynomial


class Examined(NamedTuple):
    """What a motion does.

    Attributes:
        joints: The rows of `worst`; shape (`ROWS`, 4); zeros without joints.
        tip: The largest value of each of `RATES`, and when, [s]; shape (2, 4).
        sigma, sigma_time: The smallest singular value, and when, [s]; ∞ without joints.
        qs, poses: Configurations evenly spread in time, shape (N, n), and the tip's poses there.
    """

    joints: Array
    tip: Array
    sigma: float
    sigma_time: float
    qs: Array
    poses: Poses


_ALL_ROWS = counted_rows(FULL_POSE)


def examined(
    chain: Chain, motion: PiecewisePolynomial, demands: JointDemands, task: Task, count: int
) -> Examined | None:
    """Examine a motion, with `count` configurations spread along it; None if it is none, as `are_pieces` says."""
    c, breaks = np.ascontiguousarray(motion.coefficients), np.ascontiguousarray(motion.breaks)
    rows = _ALL_ROWS if task is FULL_POSE else counted_rows(task)
    numbers, qs, positions, rotations = _examined(chain.flat, breaks, c, demands, *rows, count)
    return Examined(*numbers, qs, Poses(positions, rotations)) if len(qs) else None


@compiled
def _examined(
    flat: FlatChain,
    breaks: Array,
    coefficients: Array,
    demands: JointDemands,
    rows: Indices,
    about_tip: bool,
    count: int,
) -> tuple[tuple[Array, Array, float, float], Array, Array, Array]:
    of_joints, tip = np.zeros((ROWS, 4)), np.empty((2, 4))
    if not are_pieces(breaks, coefficients):
        return (of_joints, tip, 0.0, 0.0), np.empty((0, 0)), np.empty((0, 3)), np.empty((0, 3, 3))
    pieces = scaled_pieces(breaks, coefficients)
    joints, qs, travel = joint_figures(pieces), even_positions(pieces, count), travels(pieces)
    velocity, acceleration, sigma, sigma_time = 0.0, 0.0, np.inf, breaks[0]
    if coefficients.shape[2]:
        velocity, acceleration = np.abs(joints.extremes[2]).max(), np.abs(joints.extremes[3]).max()
        sigma, sigma_time = least_singular_value(flat, pieces, rows, about_tip, travel, sigma_samples(travel))
        of_joints = joint_rows(joints, joint_ends(pieces), demands)
    tip[0], tip[1] = rate_peaks(flat, pieces, rate_samples(travel), velocity, acceleration)
    positions, rotations = chain_poses(flat, qs)
    return (of_joints, tip, sigma, sigma_time), qs, positions, rotations
