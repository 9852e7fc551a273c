"""Poses on the wire: one position, one orientation, in the notation that the caller likes."""

from collections.abc import Sequence
from typing import Annotated, Any, Literal, TypeAlias

import numpy as np
import numpy.typing as npt
from pydantic import ConfigDict, Field, SerializerFunctionWrapHandler, model_serializer, model_validator

from app.model.arrays import Array
from app.model.errors import InvalidArray, InvalidField, InvalidPose
from app.model.poses import (
    ROTATION_TOLERANCE,
    Poses,
    nearest_rotation,
    quaternions_xyzw_from_rotations,
    rotations_from_quaternions_xyzw,
    rotations_from_rpy,
    rotations_from_vectors,
    rotations_from_zyz,
    rpy_from_rotations,
    transform,
    unit_quaternion,
    vectors_from_rotations,
    zyz_from_rotations,
)
from app.schemas.common import Payload, as_lists

PoseFormat: TypeAlias = Literal[
    "quaternion_xyzw", "quaternion_wxyz", "rpy", "zyz", "rotation_vector", "rotation", "matrix"
]
ORIENTATIONS = ("quaternion_xyzw", "quaternion_wxyz", "rpy", "zyz", "rotation_vector", "rotation")

MAX_MAGNITUDE = 1e6
"""Largest coordinate, [m], and angle, [rad]: beyond it a double no longer resolves a nanometre."""

_Number = Annotated[float, Field(ge=-MAX_MAGNITUDE, le=MAX_MAGNITUDE)]
Vector3 = Annotated[list[_Number], Field(min_length=3, max_length=3)]
Vector4 = Annotated[list[_Number], Field(min_length=4, max_length=4)]
Matrix3 = Annotated[list[Vector3], Field(min_length=3, max_length=3)]
Matrix4 = Annotated[list[Vector4], Field(min_length=4, max_length=4)]


class Pose(Payload):
    """A pose: `position` with exactly one orientation, or `matrix` alone.

    An orientation further than 1e-6 from a rotation is refused, within that it is projected.
    """

    model_config = ConfigDict(
        json_schema_extra={"examples": [{"position": [0.3, 0.0, 0.6], "quaternion_xyzw": [0.0, 0.0, 0.0, 1.0]}]}
    )

    position: Vector3 | None = Field(default=None, description="Origin, [m].")
    quaternion_xyzw: Vector4 | None = Field(default=None, description="Unit quaternion, scalar last.")
    quaternion_wxyz: Vector4 | None = Field(default=None, description="Unit quaternion, scalar first.")
    rpy: Vector3 | None = Field(
        default=None,
        description="Roll, pitch, yaw about the fixed axes x, y, z (URDF): R = Rz(yaw) Ry(pitch) Rx(roll), [rad].",
    )
    zyz: Vector3 | None = Field(default=None, description="Euler angles φ, θ, ψ: R = Rz(φ) Ry(θ) Rz(ψ), [rad].")
    rotation_vector: Vector3 | None = Field(default=None, description="Axis times angle, [rad].")
    rotation: Matrix3 | None = Field(default=None, description="Rotation matrix, row by row.")
    matrix: Matrix4 | None = Field(default=None, description="Homogeneous transform, row by row; translation in [m].")

    @model_validator(mode="after")
    def _one_notation(self) -> "Pose":
        given = [name for name in ORIENTATIONS if getattr(self, name) is not None]
        if self.matrix is not None:
            if given or self.position is not None:
                raise ValueError("`matrix` stands alone, without a position or another orientation")
        elif self.position is None:
            raise ValueError("a pose has a `position`, or a `matrix` alone")
        elif len(given) != 1:
            raise ValueError(f"a pose has exactly one orientation of {', '.join(ORIENTATIONS)}; {len(given)} are given")
        return self

    @model_serializer(mode="wrap")
    def _given_alone(self, handler: SerializerFunctionWrapHandler) -> dict[str, Any]:
        return {name: value for name, value in handler(self).items() if value is not None}

    def __array__(self, dtype: npt.DTypeLike | None = None, copy: bool | None = None) -> Array:
        """As `transform`, so that `np.array(answer.poses)` is a batch of shape (N, 4, 4)."""
        return self.transform().astype(dtype or np.float64)

    def transform(self) -> Array:
        """T_a_b; shape (4, 4).

        Raises:
            InvalidPose: The orientation is no rotation, or the last row of the matrix is not 0 0 0 1.
        """
        return transform(np.array(self.origin()), self.orientation())

    def origin(self) -> list[float]:
        """The position, [m]."""
        if self.matrix is not None:
            return [row[3] for row in self.matrix[:3]]
        return self.position or []

    def orientation(self) -> Array:
        """The rotation; shape (3, 3).

        Raises:
            InvalidPose: It is no rotation, or the last row of the matrix is not 0 0 0 1.
        """
        if self.matrix is not None:
            if self.matrix[3] != [0.0, 0.0, 0.0, 1.0]:
                raise InvalidPose("the last row of a homogeneous matrix is 0 0 0 1")
            return nearest_rotation(np.array(self.matrix)[:3, :3])
        if self.rotation is not None:
            return nearest_rotation(np.array(self.rotation))
        Rs: Array
        if self.rpy is not None:
            Rs = rotations_from_rpy(np.array([self.rpy]))
        elif self.zyz is not None:
            Rs = rotations_from_zyz(np.array([self.zyz]))
        elif self.rotation_vector is not None:
            Rs = rotations_from_vectors(np.array([self.rotation_vector]))
        else:
            quaternion = np.array(self.quaternion_xyzw or self.quaternion_wxyz)
            if self.quaternion_wxyz is not None:
                quaternion = np.roll(quaternion, -1)
            Rs = rotations_from_quaternions_xyzw(unit_quaternion(quaternion)[None])
        rotation: Array = Rs[0]
        return rotation


def poses_from(given: Sequence[Pose] | Array, field: str) -> Poses:
    """A batch of poses as it came: payloads, or an array of (N, 7), position and quaternion x y z w, or (N, 4, 4).

    Raises:
        InvalidPose: An orientation is no rotation, or the last row of a matrix is not 0 0 0 1.
        InvalidArray: The array has another shape.
        InvalidField: A number of the array is not finite, or too large.
    """
    if isinstance(given, np.ndarray):
        return _poses_from_array(given, field)
    positions, rotations = np.empty((len(given), 3)), np.empty((len(given), 3, 3))
    for i, pose in enumerate(given):
        try:
            positions[i], rotations[i] = pose.origin(), pose.orientation()
        except InvalidPose as error:
            raise InvalidPose(error.reason, error.distance, field, i) from None
    return Poses(positions, rotations)


def pose_fields(given: Any, field: str = "targets") -> Any:
    """A batch of poses as JSON has it; arrays are of the same shapes.

    Raises:
        InvalidArray: The array has another shape.
    """
    if not isinstance(given, np.ndarray):
        return as_lists(given)
    _check_shape(given, field)
    if given.ndim == 2:
        return [{"position": row[:3], "quaternion_xyzw": row[3:]} for row in given.tolist()]
    return [{"matrix": matrix} for matrix in given.tolist()]


def _check_shape(array: Array, field: str) -> None:
    if array.shape[1:] not in {(7,), (4, 4)}:
        raise InvalidArray(f"{field} form an array of shape (N, 7) or (N, 4, 4); this one has the shape {array.shape}")


def _poses_from_array(array: Array, field: str) -> Poses:
    _check_shape(array, field)
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
        reason = f"{what}; allowed is a distance of {ROTATION_TOLERANCE:g} from SO(3)"
        raise InvalidPose(reason, float(deviations[row]), field, row)


def orientations(poses: Poses, pose_format: PoseFormat) -> Array:
    """The orientations of poses in a notation; shape (N, 3), (N, 4), (N, 3, 3), or (N, 4, 4) with the positions."""
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


def pose_list(poses: Poses, pose_format: PoseFormat) -> list[dict[str, object]]:
    """Poses as they travel: each is a valid `Pose`."""
    values = orientations(poses, pose_format).tolist()
    if pose_format == "matrix":
        return [{"matrix": value} for value in values]
    positions = poses.positions.tolist()
    return [{"position": position, pose_format: value} for position, value in zip(positions, values, strict=True)]


def pose_array(poses: Poses, pose_format: PoseFormat) -> Array:
    """Poses as one array: (N, 4, 4) for `rotation` and `matrix`, else position and orientation side by side."""
    if pose_format in {"rotation", "matrix"}:
        return poses.matrices()
    return np.hstack((poses.positions, orientations(poses, pose_format)))
