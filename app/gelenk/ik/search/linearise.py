"""Error to a target and its Jacobian, in the directions that count."""

import numpy as np

from gelenk.ik.search.iteration import AXIS, FULL
from gelenk.ik.search.task import Task
from gelenk.ik.search.words import DIRECTIONS
from gelenk.kinematics.simd.kernels import chain_jacobians
from gelenk.robot.arrays import Array
from gelenk.robot.chain import Chain
from gelenk.robot.notations import vectors_from_rotations
from gelenk.robot.poses import Poses


def linearise(chain: Chain, targets: Poses, qs: Array, task: Task, *, chords: bool = False) -> tuple[Array, Array]:
    """Errors e, (N, m) [m and rad], and Jacobians J, (N, m, n), in the rows that count: e(q + Δq) ≈ e(q) - J Δq.

    e points from tip to target: the position difference in the base's axes, and the rotation vector, in the base's
    axes for a full pose, else in the target's. J is the geometric Jacobian in the same axes. If one axis is to be
    aligned, the rotation is the shortest one that aligns it. `chords` scales rotation errors to length 2 sin(θ/2),
    as the kernels do, instead of θ.
    """
    positions, Rs, Js = chain_jacobians(chain.flat, qs)
    errors = np.empty((len(qs), 6))
    errors[:, :3] = targets.positions - positions
    if task.kind == AXIS:
        errors[:, 3:] = _swings(Rs[:, :, task.axis], targets.rotations[:, :, task.axis])
    else:
        errors[:, 3:] = vectors_from_rotations(np.ascontiguousarray(targets.rotations @ Rs.transpose(0, 2, 1)))
    if chords:
        angles = np.linalg.norm(errors[:, 3:], axis=1)
        errors[:, 3:] *= np.sinc(0.5 * angles / np.pi)[:, None]
    if task.kind == FULL:
        return errors, Js
    to_target = targets.rotations.transpose(0, 2, 1)
    errors[:, 3:] = (to_target @ errors[:, 3:, None])[:, :, 0]
    Js[:, 3:] = to_target @ Js[:, 3:]
    rows = [i for i, direction in enumerate(DIRECTIONS) if direction in task.directions]
    return np.ascontiguousarray(errors[:, rows]), np.ascontiguousarray(Js[:, rows])


def _swings(axes: Array, goals: Array) -> Array:
    """Rotation vectors of the shortest rotation from each axis to its goal; shape (N, 3), [rad]."""
    normals = np.cross(axes, goals)
    sines = np.linalg.norm(normals, axis=1)
    cosines = np.sum(axes * goals, axis=1)
    # Opposite axes have no unique shortest rotation: any perpendicular axis will do.
    opposite = (sines < 1e-12) & (cosines < 0.0)
    spare = np.cross(axes, np.eye(3)[np.argmin(np.abs(axes), axis=1)])
    normals = np.where(opposite[:, None], spare, normals)
    lengths = np.linalg.norm(normals, axis=1)
    scales = np.where(lengths > 0.0, np.arctan2(sines, cosines) / np.where(lengths > 0.0, lengths, 1.0), 0.0)
    return normals * scales[:, None]
