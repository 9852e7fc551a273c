"""Task rows along a path of the tip: J q' = ξ in the rows that count, and its derivative by s.

For a task that leaves directions free, the rotation rows are along the target's axes, as in inverse kinematics. If a
single rotation counts, its row is a component of the rotation vector ψ from the tip to the target, whose rate is not
the difference of the angular velocities but M(ψ) times it.
"""

from dataclasses import dataclass

import numpy as np

from gelenk.ik.search.linearise import linearise
from gelenk.ik.search.task import FULL_POSE, Task
from gelenk.kinematics.simd.kernels import chain_hessians, chain_jacobians
from gelenk.robot.arrays import Array, cross_matrices
from gelenk.robot.chain import Chain
from gelenk.trajectory.paths.paths import PathSamples

_SMALL = 0.1
"""Angle below which a series is used, [rad]."""
_STEP = 1e-3
STENCIL = np.array([1.0, -8.0, 8.0, -1.0]) / 12.0
PLACES = np.array([-2.0, -1.0, 1.0, 2.0])
"""Places of a central difference of fourth order; its weights are `STENCIL`."""


@dataclass(frozen=True, slots=True)
class CountedRows:
    """The m rows that count at N configurations.

    Attributes:
        errors: e, the remaining motion onto the path; shape (N, m), [m, rad].
        jacobians: J; shape (N, m, n).
        rates: ξ; shape (N, m), [m, rad per unit of s].
    """

    errors: Array
    jacobians: Array
    rates: Array


def task_rows(chain: Chain, task: Task, at: PathSamples, qs: Array) -> CountedRows:
    """Return the rows at configurations of shape (N, n) on or near the path; `at` has one sample for each."""
    qs = np.ascontiguousarray(qs)  # as for all others: a kernel would be compiled for a choice of columns
    if len(task) == len(FULL_POSE):
        errors, Js = linearise(chain, at.poses, qs, task)
        return CountedRows(errors, Js, at.first)
    to_target = at.poses.rotations.transpose(0, 2, 1)
    rates = _turned(to_target, at.first[:, :, None])[:, :, 0]
    rows = np.flatnonzero(task.weights)
    if not _turns_about_one(task):
        errors, Js = linearise(chain, at.poses, qs, task)
        return CountedRows(errors, Js, rates[:, rows])
    errors, Js = linearise(chain, at.poses, qs, FULL_POSE)
    errors, Js = _turned(to_target, errors[:, :, None])[:, :, 0], _turned(to_target, Js)
    M = _rate_matrices(errors[:, 3:])
    return CountedRows(errors[:, rows], _turned(M, Js)[:, rows], _turned(M, rates[:, :, None])[:, rows, 0])


def row_derivatives(chain: Chain, task: Task, at: PathSamples, qs: Array, dqs: Array) -> tuple[Array, Array]:
    """Return dJ/ds, (N, m, n), and dξ/ds, (N, m), along q' of shape (N, n): J q'' = dξ/ds - dJ/ds q'."""
    changes = np.einsum("bkij,bj->bki", chain_hessians(chain.flat, qs), dqs)
    if len(task) == len(FULL_POSE):
        return changes, at.second
    Js = chain_jacobians(chain.flat, qs)[2]
    to_target, omegas = at.poses.rotations.transpose(0, 2, 1), at.first[:, 3:]
    changes[:, 3:] -= np.cross(omegas[:, :, None], Js[:, 3:], axis=1)
    changes = _turned(to_target, changes)
    bends = _turned(to_target, at.second[:, :, None])[:, :, 0]
    rows = np.flatnonzero(task.weights)
    if _turns_about_one(task):
        vectors = _turned(to_target, linearise(chain, at.poses, qs, FULL_POSE)[0][:, :, None])[:, 3:, 0]
        turning, wanted = to_target @ Js[:, 3:], (to_target @ omegas[:, :, None])[:, :, 0]
        M = _rate_matrices(vectors)
        dM = _matrix_changes(vectors, (M @ (wanted - (turning @ dqs[:, :, None])[:, :, 0])[:, :, None])[:, :, 0])
        changes, bends = _turned(M, changes), _turned(M, bends[:, :, None])[:, :, 0]
        changes[:, 3:] += dM @ turning
        bends[:, 3:] += (dM @ wanted[:, :, None])[:, :, 0]
    return np.ascontiguousarray(changes[:, rows]), np.ascontiguousarray(bends[:, rows])


def _turns_about_one(task: Task) -> bool:
    return len(task) - task.positions == 1


def _turned(Rs: Array, blocks: Array) -> Array:
    """Multiply the angular rows of blocks of shape (N, 6, k) by matrices of shape (N, 3, 3)."""
    result = blocks.copy()
    result[:, 3:] = Rs @ blocks[:, 3:]
    return result


def _rate_matrices(vectors: Array) -> Array:
    """Return M(ψ) = I + [ψ]×/2 + c [ψ]×², c = (1 - θ/2 cot θ/2)/θ², the inverse Jacobian of SO(3); shape (N, 3, 3)."""
    angles = np.linalg.norm(vectors, axis=1)
    squares = angles * angles
    series = 1.0 / 12.0 + squares * (1.0 / 720.0 + squares * (1.0 / 30240.0 + squares / 1209600.0))
    safe = np.maximum(angles, _SMALL)
    c = np.where(angles < _SMALL, series, (1.0 - 0.5 * safe / np.tan(0.5 * safe)) / (safe * safe))
    across = cross_matrices(vectors)
    result: Array = np.eye(3) + 0.5 * across + c[:, None, None] * (across @ across)
    return result


def _matrix_changes(vectors: Array, rates: Array) -> Array:
    """Return dM/ds for ψ' = rates, by a difference of fourth order; shape (N, 3, 3)."""
    steps = _STEP / (1.0 + np.linalg.norm(rates, axis=1))[:, None]
    changes = np.zeros((len(vectors), 3, 3))
    for place, weight in zip(PLACES, STENCIL, strict=True):
        changes += weight * _rate_matrices(vectors + place * steps * rates)
    result: Array = changes / steps[:, :, None]
    return result
