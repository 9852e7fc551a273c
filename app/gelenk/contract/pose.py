"""Poses as payloads: one position and one orientation, in the notation that the caller chooses."""

from typing import Annotated, Any, Literal, TypeAlias

import numpy as np
import numpy.typing as npt
from pydantic import ConfigDict, Field, SerializerFunctionWrapHandler, model_serializer, model_validator

from gelenk.contract.common import Payload, as_lists, optional
from gelenk.errors import InvalidArray, InvalidPose
from gelenk.robot.arrays import Array
from gelenk.robot.poses import nearest_rotation, transform, unit_quaternion

PoseFormat: TypeAlias = Literal[
    "quaternion_xyzw", "quaternion_wxyz", "rpy", "zyz", "rotation_vector", "rotation", "matrix"
]
AnswerFormat = Annotated[PoseFormat, Field(description="Notation of the poses in the answer.")]
ORIENTATIONS = ("quaternion_xyzw", "quaternion_wxyz", "rpy", "zyz", "rotation_vector", "rotation")
_NO_ORIENTATION = (
    f"a pose has exactly one orientation of {', '.join(ORIENTATIONS)}; none is given. A `position` alone is a target "
    "where the request leaves the orientation out: its `task` has none of rx, ry, rz"
)

MAX_MAGNITUDE = 1e6
"""Largest coordinate, [m], and angle, [rad]: beyond it a double no longer resolves a nanometre."""

_Number = Annotated[float, Field(ge=-MAX_MAGNITUDE, le=MAX_MAGNITUDE)]
Vector3 = Annotated[list[_Number], Field(min_length=3, max_length=3)]
Vector4 = Annotated[list[_Number], Field(min_length=4, max_length=4)]
Matrix3 = Annotated[list[Vector3], Field(min_length=3, max_length=3)]
Matrix4 = Annotated[list[Vector4], Field(min_length=4, max_length=4)]


class Pose(Payload):
    """A pose: `position` with exactly one orientation, or `matrix` alone.

    A target may be a `position` alone where the request's `task` has none of rx, ry, rz.
    An orientation further than 1e-6 from a rotation is refused; a nearer one is projected onto a rotation.
    """

    model_config = ConfigDict(
        json_schema_extra={"examples": [{"position": [0.3, 0.0, 0.6], "quaternion_xyzw": [0.0, 0.0, 0.0, 1.0]}]}
    )

    position: Vector3 | None = optional("Origin, [m].")
    quaternion_xyzw: Vector4 | None = optional("Unit quaternion, scalar last.")
    quaternion_wxyz: Vector4 | None = optional("Unit quaternion, scalar first.")
    rpy: Vector3 | None = optional(
        "Roll, pitch, yaw about the fixed axes x, y, z (URDF): R = Rz(yaw) Ry(pitch) Rx(roll), [rad]."
    )
    zyz: Vector3 | None = optional("Euler angles φ, θ, ψ: R = Rz(φ) Ry(θ) Rz(ψ), [rad].")
    rotation_vector: Vector3 | None = optional("Axis times angle, [rad].")
    rotation: Matrix3 | None = optional("Rotation matrix, row by row.")
    matrix: Matrix4 | None = optional("Homogeneous transform, row by row; translation in [m].")

    @model_validator(mode="after")
    def _one_notation(self) -> "Pose":
        given = [name for name in ORIENTATIONS if getattr(self, name) is not None]
        if self.matrix is not None:
            if given or self.position is not None:
                raise ValueError("`matrix` must be given alone, without a position or another orientation")
        elif self.position is None:
            raise ValueError("a pose has a `position`, or a `matrix` alone")
        elif len(given) > 1:
            raise ValueError(f"a pose has exactly one orientation of {', '.join(ORIENTATIONS)}; {len(given)} are given")
        return self

    @model_serializer(mode="wrap")
    def _given_alone(self, handler: SerializerFunctionWrapHandler) -> dict[str, Any]:
        return {name: value for name, value in handler(self).items() if value is not None}

    def __array__(self, dtype: npt.DTypeLike | None = None, copy: bool | None = None) -> Array:
        """Return `transform`, so that `np.array(answer.poses)` is a batch of shape (N, 4, 4)."""
        return self.transform().astype(dtype or np.float64)

    def transform(self, unless_given: Array | None = None) -> Array:
        """Return T_a_b; shape (4, 4); parameter and errors as for `orientation`."""
        return transform(np.array(self.origin()), self.orientation(unless_given))

    def origin(self) -> list[float]:
        """Return the position, [m]."""
        if self.matrix is not None:
            return [row[3] for row in self.matrix[:3]]
        return self.position or []

    def orientation(self, unless_given: Array | None = None) -> Array:
        """Return the rotation matrix; shape (3, 3).

        Args:
            unless_given: What it is of a position alone; None if there must be an orientation.

        Raises:
            InvalidPose: It is not a rotation, it is missing, or the last row of the matrix is not 0 0 0 1.
        """
        if self.matrix is not None:
            if self.matrix[3] != [0.0, 0.0, 0.0, 1.0]:
                raise InvalidPose("the last row of a homogeneous matrix is 0 0 0 1")
            return nearest_rotation(np.array(self.matrix)[:3, :3])
        if self.rotation is not None:
            return nearest_rotation(np.array(self.rotation))
        # Compiled code: a client, which passes poses on without reading them, need not load it.
        from gelenk.robot.notations import (  # noqa: PLC0415
            rotations_from_quaternions_xyzw,
            rotations_from_rpy,
            rotations_from_vectors,
            rotations_from_zyz,
        )

        for angles, rotations in (
            (self.rpy, rotations_from_rpy),
            (self.zyz, rotations_from_zyz),
            (self.rotation_vector, rotations_from_vectors),
        ):
            if angles is not None:
                return np.asarray(rotations(np.array([angles]))[0])
        if self.quaternion_xyzw is None and self.quaternion_wxyz is None:
            if unless_given is None:
                raise InvalidPose(_NO_ORIENTATION)
            return unless_given
        quaternion = self.quaternion_xyzw or np.roll(self.quaternion_wxyz or [], -1)
        return np.asarray(rotations_from_quaternions_xyzw(unit_quaternion(np.array(quaternion))[None])[0])


def pose_fields(given: Any, field: str = "targets") -> Any:
    """Return poses in JSON's form; an array has shape (N, 7), position and quaternion x y z w, or (N, 4, 4).

    Raises:
        InvalidArray: The array has another shape.
    """
    if not isinstance(given, np.ndarray):
        return as_lists(given)
    check_pose_shape(given, field)
    if given.ndim == 2:
        return [{"position": row[:3], "quaternion_xyzw": row[3:]} for row in given.tolist()]
    return [{"matrix": matrix} for matrix in given.tolist()]


def check_pose_shape(array: Array, field: str) -> None:
    """Refuse an array that cannot hold poses; raises as `pose_fields` does."""
    if array.shape[1:] not in {(7,), (4, 4)}:
        raise InvalidArray(f"{field} form an array of shape (N, 7) or (N, 4, 4); this one has the shape {array.shape}")
