"""Conversion of poses between payloads and arrays; kept out of the contract, which does without compiled code."""

from collections.abc import Sequence

import numpy as np

from gelenk.contract.pose import MAX_MAGNITUDE, WHOLE, PoseFormat, PoseLike, check_pose_shape, pose_of
from gelenk.errors import InvalidField, InvalidPose
from gelenk.robot.arrays import Array
from gelenk.robot.notations import (
    quaternions_xyzw_from_rotations,
    rotations_from_quaternions_xyzw,
    rpy_from_rotations,
    turn_by_quaternions_xyzw,
    vectors_from_rotations,
    zyz_from_rotations,
)
from gelenk.robot.poses import ROTATION_TOLERANCE, Poses, unit_quaternion


def poses_from(given: Sequence[PoseLike] | Array, field: str, unless_given: Array | None = None) -> Poses:
    """Return a batch of poses from payloads, or an array (N, 7), position and quaternion x y z w, or (N, 4, 4).

    `unless_given` is the orientation of a position alone; if it is None, there must be one.

    Raises InvalidPose if an orientation is not a rotation, or the last row of a matrix is not 0 0 0 1; InvalidArray for
    another shape; InvalidField for a number that is not finite, or too large.
    """
    if isinstance(given, np.ndarray):
        return _poses_from_array(given, field)
    poses, i = [pose_of(pose) for pose in given], 0
    positions = np.array([pose.position for pose in poses], dtype=float).reshape(-1, 3)
    rotations, quaternions = np.empty((len(poses), 3, 3)), [pose.quaternion_xyzw for pose in poses]
    try:
        if quaternions and None not in quaternions:
            # All together they take half as long.
            for i, quaternion in enumerate(quaternions):
                quaternions[i] = unit_quaternion(quaternion or ())
            turn_by_quaternions_xyzw(np.array(quaternions), rotations)
        else:
            for i, pose in enumerate(poses):
                rotations[i] = pose.orientation(unless_given)
    except InvalidPose as error:
        raise InvalidPose(error.reason, error.distance, field, i) from None
    return Poses(positions, rotations)


def _poses_from_array(array: Array, field: str) -> Poses:
    check_pose_shape(array, field)
    bad = ~(np.abs(array) <= MAX_MAGNITUDE)
    if bad.any():
        row = int(np.argwhere(bad)[0][0])
        raise InvalidField(field, f"entry {row}: numbers must be finite and of magnitude ≤ {MAX_MAGNITUDE:g}")
    if array.ndim == 2:
        norms = np.linalg.norm(array[:, 3:], axis=1)
        _refuse(np.abs(norms - 1.0), "the quaternion's length differs from 1", field)
        unit = np.ascontiguousarray(array[:, 3:] / norms[:, None])
        return Poses(np.ascontiguousarray(array[:, :3]), rotations_from_quaternions_xyzw(unit))
    wrong = (array[:, 3] != [0.0, 0.0, 0.0, 1.0]).any(axis=1)
    if wrong.any():
        raise InvalidPose("the last row of a homogeneous matrix is 0 0 0 1", None, field, int(np.argmax(wrong)))
    Rs = np.ascontiguousarray(array[:, :3, :3])
    deviations = np.linalg.norm(Rs.transpose(0, 2, 1) @ Rs - np.eye(3), axis=(1, 2))
    # A reflection is as orthogonal as a rotation.
    deviations = np.where(np.linalg.det(Rs) > 0.0, 0.5 * deviations, 2.0)
    _refuse(deviations, "the matrix is not a rotation", field)
    for _ in range(2):
        # Newton's step to the nearest rotation [Higham2008, 8.3]: from 1e-6 to 1e-12 and on to rounding.
        Rs = 0.5 * Rs @ (3.0 * np.eye(3) - Rs.transpose(0, 2, 1) @ Rs)
    return Poses(np.ascontiguousarray(array[:, :3, 3]), np.ascontiguousarray(Rs))


def _refuse(deviations: Array, what: str, field: str) -> None:
    far = deviations > ROTATION_TOLERANCE
    if far.any():
        row = int(np.argmax(far))
        reason = f"{what}; the limit is a distance of {ROTATION_TOLERANCE:g} from SO(3)"
        raise InvalidPose(reason, float(deviations[row]), field, row)


def orientations(poses: Poses, pose_format: PoseFormat) -> Array:
    """Return orientations in a notation; shape (N, 3), (N, 4), (N, 3, 3), or (N, 4, 4) with the positions.

    Those of a pendant, (N, 6) or (N, 7), have the positions too.
    """
    Rs = poses.rotations
    match pose_format:
        case "quaternion_xyzw":
            return quaternions_xyzw_from_rotations(Rs)
        case "quaternion_wxyz":
            return np.roll(quaternions_xyzw_from_rotations(Rs), 1, axis=1)
        case "rpy":
            return rpy_from_rotations(Rs)
        case "zyz":
            return zyz_from_rotations(Rs)
        case "rotation_vector":
            return vectors_from_rotations(Rs)
        case "rotation":
            return Rs
        case "matrix":
            return poses.matrices()
        case "ur":
            return np.hstack((poses.positions, vectors_from_rotations(Rs)))
        case "abb":
            return np.hstack((1000.0 * poses.positions, orientations(poses, "quaternion_wxyz")))
        case "kuka_abc":
            return np.hstack((1000.0 * poses.positions, np.degrees(rpy_from_rotations(Rs))[:, ::-1]))
        case "fanuc_wpr":
            return np.hstack((1000.0 * poses.positions, np.degrees(rpy_from_rotations(Rs))))


def pose_list(poses: Poses, pose_format: PoseFormat) -> list[dict[str, object]]:
    """Return poses as JSON content; each is a valid `Pose`."""
    columns = pose_columns(poses, pose_format)
    rows = zip(*[values.tolist() for values in columns.values()], strict=True)
    return [dict(zip(columns, row, strict=True)) for row in rows]


def pose_columns(poses: Poses, pose_format: PoseFormat) -> dict[str, Array]:
    """Return the fields of poses as arrays; shape (N, …) each."""
    values: dict[str, Array] = {pose_format: orientations(poses, pose_format)}
    return values if pose_format in WHOLE else {"position": poses.positions, **values}


def pose_array(poses: Poses, pose_format: PoseFormat) -> Array:
    """Return poses as one array: (N, 4, 4) for `rotation` and `matrix`, else position and orientation side by side."""
    if pose_format == "rotation":
        return poses.matrices()
    if pose_format in WHOLE:
        return orientations(poses, pose_format)
    return np.hstack((poses.positions, orientations(poses, pose_format)))
