"""Forward kinematics over the placements of Pinocchio's model, by quaternions: the judge of large batches.

A loop over Pinocchio takes some 3 µs of Python a configuration, this takes a tenth. It shares neither code nor numbers
with the kernels that it judges: they multiply matrices of the checked description, this composes quaternions along the
tree that Pinocchio has read. `pinocchio_poses` compares a sample of each batch with Pinocchio's own poses.
"""

from typing import NamedTuple

import numpy as np
import pinocchio as pin

from gelenk.robot.arrays import Array, Flags, Indices
from gelenk.robot.compilation import compiled, inlined
from gelenk.robot.robot import RobotModel


class Walk(NamedTuple):
    """The joints from the root of a model to a frame, in order, and after them the frame's place on the last one.

    Attributes:
        translations: Of each placement in the one before, the frame's last; shape (K + 1, 3), [m].
        quaternions: Likewise, wxyz; shape (K + 1, 4).
        axes: Unit vectors in the joints' frames; shape (K, 3).
        slides: Which joints are prismatic; shape (K,).
        rows: Their indices in Pinocchio's configuration; shape (K,).
    """

    translations: Array
    quaternions: Array
    axes: Array
    slides: Flags
    rows: Indices


def walk_to(robot: RobotModel, frame: str) -> Walk:
    """Return the joints from the root to a frame; raises UnknownFrame."""
    model, end = robot.model, robot.model.frames[robot.frame_id(frame)]
    numbers = [number for number in model.supports[end.parentJoint] if number]
    placements = [*(model.jointPlacements[number] for number in numbers), end.placement]
    data = [model.joints[number].createData() for number in numbers]
    motions = np.zeros((len(numbers), 6))
    for k, number in enumerate(numbers):
        joint = model.joints[number]
        joint.calc(data[k], np.zeros(model.nq), np.ones(model.nv))
        motions[k] = np.ravel(data[k].S)
    slides = np.abs(motions[:, 3:]).max(axis=1, initial=0.0) == 0.0
    return Walk(
        np.array([placement.translation for placement in placements]),
        np.array([pin.Quaternion(placement.rotation).coeffs()[[3, 0, 1, 2]] for placement in placements]),
        np.where(slides[:, None], motions[:, :3], motions[:, 3:]),
        slides,
        np.array([model.joints[number].idx_q for number in numbers], dtype=np.int64),
    )


def relative_poses(base: Walk, tip: Walk, full_qs: Array) -> tuple[Array, Array]:
    """Compute T_base_tip at Pinocchio's configurations, (N, nq): positions, (N, 3), [m], and rotations, (N, 3, 3)."""
    return _relative_poses(*base, *tip, np.ascontiguousarray(full_qs))


@compiled
def _relative_poses(
    base_translations: Array,
    base_quaternions: Array,
    base_axes: Array,
    base_slides: Flags,
    base_rows: Indices,
    translations: Array,
    quaternions: Array,
    axes: Array,
    slides: Flags,
    rows: Indices,
    full_qs: Array,
) -> tuple[Array, Array]:
    positions, rotations = np.empty((len(full_qs), 3)), np.empty((len(full_qs), 3, 3))
    for i in range(len(full_qs)):
        p, r = _walked(base_translations, base_quaternions, base_axes, base_slides, base_rows, full_qs[i])
        q, s = _walked(translations, quaternions, axes, slides, rows, full_qs[i])
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
def _walked(
    translations: Array, quaternions: Array, axes: Array, slides: Flags, rows: Indices, q: Array
) -> tuple[_Vector, _Quaternion]:
    """Return the position and the quaternion, wxyz, of a frame in the root."""
    x, y, z, r = 0.0, 0.0, 0.0, (1.0, 0.0, 0.0, 0.0)
    for k in range(len(translations)):
        u, v, w = _turned(r, translations[k, 0], translations[k, 1], translations[k, 2])
        x, y, z = x + u, y + v, z + w
        r = _product(r, (quaternions[k, 0], quaternions[k, 1], quaternions[k, 2], quaternions[k, 3]))
        if k == len(rows):
            break
        value, a, b, c = q[rows[k]], axes[k, 0], axes[k, 1], axes[k, 2]
        if slides[k]:
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
