"""Poses on the wire: one position, one orientation, in the notation that the caller likes."""

from typing import Annotated, Any, Literal, TypeAlias

import numpy as np
from pydantic import ConfigDict, Field, SerializerFunctionWrapHandler, model_serializer, model_validator

from app.model.arrays import Array
from app.model.errors import InvalidPose
from app.model.poses import (
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
from app.schemas.common import Payload

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

    position: Vector3 | None = Field(None, description="Origin, [m].")
    quaternion_xyzw: Vector4 | None = Field(None, description="Unit quaternion, scalar last.")
    quaternion_wxyz: Vector4 | None = Field(None, description="Unit quaternion, scalar first.")
    rpy: Vector3 | None = Field(
        None, description="Roll, pitch, yaw about the fixed axes x, y, z (URDF): R = Rz(yaw) Ry(pitch) Rx(roll), [rad]."
    )
    zyz: Vector3 | None = Field(None, description="Euler angles φ, θ, ψ: R = Rz(φ) Ry(θ) Rz(ψ), [rad].")
    rotation_vector: Vector3 | None = Field(None, description="Axis times angle, [rad].")
    rotation: Matrix3 | None = Field(None, description="Rotation matrix, row by row.")
    matrix: Matrix4 | None = Field(None, description="Homogeneous transform, row by row; translation in [m].")

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

    def transform(self) -> Array:
        """T_a_b; shape (4, 4).

        Raises:
            InvalidPose: The orientation is no rotation, or the last row of the matrix is not 0 0 0 1.
        """
        if self.matrix is not None:
            T = np.array(self.matrix)
            if not np.array_equal(T[3], [0.0, 0.0, 0.0, 1.0]):
                raise InvalidPose("the last row of a homogeneous matrix is 0 0 0 1")
            return transform(T[:3, 3], nearest_rotation(T[:3, :3]))
        return transform(np.array(self.position), self._rotation())

    def _rotation(self) -> Array:
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
