"""Forward kinematics over the placements of Pinocchio's model, by quaternions: the judge of solutions.

A loop over Pinocchio takes some 5 µs of Python a configuration, this takes a tenth. It shares neither code nor numbers
with the kernels that it judges: they multiply matrices of the checked description, this composes quaternions along the
tree that Pinocchio has read. `judge.recomputed_poses` compares it with Pinocchio's own poses.
"""

from functools import lru_cache

import numpy as np
import pinocchio as pin

from gelenk.robot.arrays import Array
from gelenk.robot.compilation import compiled, inlined
from gelenk.robot.robot import RobotModel

_KEPT = 32


@lru_cache(_KEPT)
def walk_to(robot: RobotModel, frame: str) -> Array:
    """Return the joints from the root of Pinocchio's model to a frame; raises UnknownFrame.

    The rows are those of the K joints and of the frame on the last one: translation and quaternion, wxyz, in the joint
    before; axis; 1 if it slides; index in Pinocchio's configuration, -1 for the frame; shape (K + 1, 12).
    """
    model, end = robot.model, robot.model.frames[robot.frame_id(frame)]
    numbers = [number for number in model.supports[end.parentJoint] if number]
    walk = np.zeros((len(numbers) + 1, 12))
    for row, number in zip(walk, numbers, strict=False):
        joint = model.joints[number]
        data = joint.createData()
        joint.calc(data, np.zeros(model.nq), np.ones(model.nv))
        motion = np.ravel(data.S)
        slides = not motion[3:].any()
        row[7:] = [*(motion[:3] if slides else motion[3:]), slides, joint.idx_q]
    walk[-1, 11] = -1
    for row, placement in zip(
        walk, [*(model.jointPlacements[number] for number in numbers), end.placement], strict=True
    ):
        row[:7] = [*placement.translation, *pin.Quaternion(placement.rotation).coeffs()[[3, 0, 1, 2]]]
    return walk


@compiled
def expand(offset: Array, matrix: Array, qs: Array, full_qs: Array) -> None:
    """Map configurations of a chain, (N, n), to Pinocchio's, offset + matrix q, into `full_qs`; shape (N, nq).

    For a few numbers NumPy takes longer to prepare a product of matrices than to compute it, and to return an array
    takes a compiled function longer than to fill one.
    """
    for i in range(len(qs)):
        for j in range(len(offset)):
            value = offset[j]
            for k in range(qs.shape[1]):
                value += matrix[j, k] * qs[i, k]
            full_qs[i, j] = value


@compiled
def relative_poses(base: Array, tip: Array, full_qs: Array) -> tuple[Array, Array]:
    """Compute T_base_tip at Pinocchio's configurations, (N, nq): positions, (N, 3), [m], and rotations, (N, 3, 3)."""
    positions, rotations = np.empty((len(full_qs), 3)), np.empty((len(full_qs), 3, 3))
    for i in range(len(full_qs)):
        p, r = _walked(base, full_qs[i])
        q, s = _walked(tip, full_qs[i])
        back = (r[0], -r[1], -r[2], -r[3])
        x, y, z = _turned(back, q[0] - p[0], q[1] - p[1], q[2] - p[2])
        positions[i, 0], positions[i, 1], positions[i, 2] = x, y, z
        w, a, b, c = _product(back, s)
        rotations[i, 0, 0], rotations[i, 0, 1] = 1.0 - 2.0 * (b * b + c * c), 2.0 * (a * b - w * c)
        rotations[i, 0, 2], rotations[i, 1, 0] = 2.0 * (a * c + w * b), 2.0 * (a * b + w * c)
        rotations[i, 1, 1], rotations[i, 1, 2] = 1.0 - 2.0 * (a * a + c * c), 2.0 * (b * c - w * a)
        rotations[i, 2, 0], rotations[i, 2, 1] = 2.0 * (a * c - w * b), 2.0 * (b * c + w * a)
        rotations[i, 2, 2] = 1.0 - 2.0 * (a * a + b * b)
    return positions, rotations


_Vector = tuple[float, float, float]
_Quaternion = tuple[float, float, float, float]


@inlined
def _walked(walk: Array, q: Array) -> tuple[_Vector, _Quaternion]:
    """Return the position and the quaternion, wxyz, of a frame in the root."""
    x, y, z, r = 0.0, 0.0, 0.0, (1.0, 0.0, 0.0, 0.0)
    for k in range(len(walk)):
        u, v, w = _turned(r, walk[k, 0], walk[k, 1], walk[k, 2])
        x, y, z = x + u, y + v, z + w
        r = _product(r, (walk[k, 3], walk[k, 4], walk[k, 5], walk[k, 6]))
        if walk[k, 11] < 0.0:
            break
        value, a, b, c = q[int(walk[k, 11])], walk[k, 7], walk[k, 8], walk[k, 9]
        if walk[k, 10]:
            u, v, w = _turned(r, value * a, value * b, value * c)
            x, y, z = x + u, y + v, z + w
        else:
            s = np.sin(0.5 * value)
            r = _product(r, (np.cos(0.5 * value), s * a, s * b, s * c))
    return (x, y, z), r


@inlined
def _product(p: _Quaternion, q: _Quaternion) -> _Quaternion:
    return (
        p[0] * q[0] - p[1] * q[1] - p[2] * q[2] - p[3] * q[3],
        p[0] * q[1] + p[1] * q[0] + p[2] * q[3] - p[3] * q[2],
        p[0] * q[2] - p[1] * q[3] + p[2] * q[0] + p[3] * q[1],
        p[0] * q[3] + p[1] * q[2] - p[2] * q[1] + p[3] * q[0],
    )


@inlined
def _turned(r: _Quaternion, x: float, y: float, z: float) -> _Vector:
    """Return a vector turned by a unit quaternion: v + 2 w (u x v) + 2 u x (u x v)."""
    w, a, b, c = r
    u, v, t = 2.0 * (b * z - c * y), 2.0 * (c * x - a * z), 2.0 * (a * y - b * x)
    return x + w * u + b * t - c * v, y + w * v + c * u - a * t, z + w * t + a * v - b * u
