"""Poses as payloads: one position and one orientation, in the notation that the caller chooses.

A pendant's notation is the whole pose in one list, as the controllers of UR, KUKA, ABB and FANUC show it.
"""

import math
from collections.abc import Iterator, Sequence
from typing import Annotated, Any, Literal, NotRequired, TypeAlias, TypedDict

import numpy as np
import numpy.typing as npt
from pydantic import ConfigDict, Field, SerializerFunctionWrapHandler, model_serializer, model_validator

from gelenk.contract.common import OnTheWire, Payload, Vectors, as_lists, optional
from gelenk.errors import InvalidArray, InvalidPose
from gelenk.robot.arrays import Array
from gelenk.robot.poses import nearest_rotation, transform, unit_quaternion

PoseFormat: TypeAlias = Literal[
    "quaternion_xyzw",
    "quaternion_wxyz",
    "rpy",
    "zyz",
    "rotation_vector",
    "rotation",
    "matrix",
    "ur",
    "kuka_abc",
    "abb",
    "fanuc_wpr",
]
AnswerFormat = Annotated[PoseFormat, Field(description="Notation of the poses in the answer.")]
PENDANTS = ("ur", "kuka_abc", "abb", "fanuc_wpr")
"""Notations of a whole pose: lengths in millimetres and angles in degrees, but of UR in metres and radians."""
WHOLE = frozenset({"matrix", *PENDANTS})
"""Notations that include the position."""
_ALONE = sorted(WHOLE)
ORIENTATIONS = ("quaternion_xyzw", "quaternion_wxyz", "rpy", "zyz", "rotation_vector", "rotation")
_NO_ORIENTATION = (
    f"a pose has exactly one orientation of {', '.join(ORIENTATIONS)}; none is given. A `position` alone is a target "
    "where the request leaves the orientation out: its `task` has none of rx, ry, rz"
)

MAX_MAGNITUDE = 1e6
"""Largest coordinate, [m], and angle, [rad]: beyond it a double no longer resolves a nanometre."""
_SHOWN_TO = 1e-4
"""Deviation from length 1 up to which a pendant's quaternion counts as rounded: it shows five decimals."""

_Number = Annotated[float, Field(ge=-MAX_MAGNITUDE, le=MAX_MAGNITUDE)]
Vector3 = Annotated[list[_Number], Field(min_length=3, max_length=3)]
Vector4 = Annotated[list[_Number], Field(min_length=4, max_length=4)]
_Vector6 = Annotated[list[_Number], Field(min_length=6, max_length=6)]
_Vector7 = Annotated[list[_Number], Field(min_length=7, max_length=7)]
Matrix3 = Annotated[list[Vector3], Field(min_length=3, max_length=3)]
Matrix4 = Annotated[list[Vector4], Field(min_length=4, max_length=4)]


class Pose(Payload):
    """A pose: `position` with exactly one orientation; or `matrix` alone, or the numbers of one pendant alone.

    A target may be a `position` alone where the request's `task` has none of rx, ry, rz.
    An orientation further than 1e-6 from a rotation is refused; a nearer one is projected onto a rotation.
    """

    model_config = ConfigDict(
        json_schema_extra={"examples": [{"position": [0.3, 0.0, 0.6], "quaternion_xyzw": [0.0, 0.0, 0.0, 1.0]}]}
    )

    position: Annotated[Vector3, OnTheWire(Vector3 | None)] = optional("Origin, [m].")
    """In Python always there, also of a matrix or a pendant's notation, with which it is not sent."""
    quaternion_xyzw: Vector4 | None = optional("Unit quaternion, scalar last.")
    quaternion_wxyz: Vector4 | None = optional("Unit quaternion, scalar first.")
    rpy: Vector3 | None = optional(
        "Roll, pitch, yaw about the fixed axes x, y, z (URDF): R = Rz(yaw) Ry(pitch) Rx(roll), [rad]."
    )
    zyz: Vector3 | None = optional("Euler angles φ, θ, ψ: R = Rz(φ) Ry(θ) Rz(ψ), [rad].")
    rotation_vector: Vector3 | None = optional("Axis times angle, [rad].")
    rotation: Matrix3 | None = optional("Rotation matrix, row by row.")
    matrix: Matrix4 | None = optional("Homogeneous transform, row by row; translation in [m].")
    ur: _Vector6 | None = optional("As UR: x, y, z, [m], and the rotation vector rx, ry, rz, [rad].")
    kuka_abc: _Vector6 | None = optional("As KUKA: X, Y, Z, [mm], and A, B, C: R = Rz(A) Ry(B) Rx(C), [degrees].")
    abb: _Vector7 | None = optional(
        "As ABB: x, y, z, [mm], and the quaternion q1 to q4, scalar first; within 1e-4 of length 1, and normalised."
    )
    fanuc_wpr: _Vector6 | None = optional(
        "As FANUC: X, Y, Z, [mm], and W, P, R about the fixed axes x, y, z: R = Rz(R) Ry(P) Rx(W), [degrees]."
    )

    @model_validator(mode="after")
    def _one_notation(self) -> "Pose":
        fields = self.__dict__
        if fields["position"] and fields["quaternion_xyzw"] and len(self.__pydantic_fields_set__) == 2:
            return self  # as most poses are, and what follows takes as long as the rest of their validation
        given = [name for name in ORIENTATIONS if fields[name] is not None]
        alone = [name for name in _ALONE if fields[name] is not None]
        if alone:
            if given or self.position is not None or len(alone) > 1:
                raise ValueError(f"`{alone[0]}` must be given alone, without a position or another orientation")
        elif self.position is None:
            raise ValueError(f"a pose has a `position`, or alone a `matrix` or one of {', '.join(PENDANTS)}")
        elif len(given) > 1:
            raise ValueError(f"a pose has exactly one orientation of {', '.join(ORIENTATIONS)}; {len(given)} are given")
        if alone:
            fields["position"] = self._own_origin()
        return self

    @model_serializer(mode="wrap")
    def _given_alone(self, handler: SerializerFunctionWrapHandler) -> dict[str, Any]:
        return {name: value for name, value in handler(self).items() if self._is_given(name, value)}

    def __repr_args__(self) -> Iterator[tuple[str | None, Any]]:
        """Yield what is sent."""
        return (pair for pair in super().__repr_args__() if self._is_given(*pair))

    def _is_given(self, name: str | None, value: Any) -> bool:
        is_derived = name == "position" and any(getattr(self, whole) is not None for whole in WHOLE)
        return value is not None and not is_derived

    def __array__(self, dtype: npt.DTypeLike | None = None, copy: bool | None = None) -> Array:
        """Return `transform`, so that `np.array(answer.poses)` is a batch of shape (N, 4, 4)."""
        return self.transform().astype(dtype or np.float64)

    def transform(self, unless_given: Array | None = None) -> Array:
        """Return T_a_b; shape (4, 4); parameter and errors as for `orientation`."""
        return transform(np.array(self.position), self.orientation(unless_given))

    def _own_origin(self) -> list[float]:
        """Return the position that a notation of the whole pose includes, [m]."""
        if self.matrix is not None:
            return [row[3] for row in self.matrix[:3]]
        plain = self._off_pendant()
        return self.position if plain is None else plain.position

    def _off_pendant(self) -> "Pose | None":
        """Return the pose in metres and radians; None if it is not in a pendant's notation."""
        if self.ur is not None:
            return Pose(position=self.ur[:3], rotation_vector=self.ur[3:])
        if (numbers := self.kuka_abc or self.abb or self.fanuc_wpr) is None:
            return None
        place, turn = [x / 1000.0 for x in numbers[:3]], numbers[3:]
        if self.abb is not None:
            length = math.hypot(*turn)
            near = abs(length - 1.0) <= _SHOWN_TO
            return Pose(position=place, quaternion_wxyz=[x / length for x in turn] if near else turn)
        angles = [math.radians(x) for x in turn]
        return Pose(position=place, rpy=angles if self.fanuc_wpr is not None else angles[::-1])

    def orientation(self, unless_given: Array | None = None) -> Array:
        """Return the rotation matrix; shape (3, 3).

        Args:
            unless_given: What it is of a position alone; None if there must be an orientation.

        Raises:
            InvalidPose: It is not a rotation, it is missing, or the last row of the matrix is not 0 0 0 1.
        """
        # Compiled code: a client, which passes poses on without reading them, need not load it.
        if self.quaternion_xyzw is not None or self.quaternion_wxyz is not None:
            from gelenk.robot.notations import rotations_from_quaternions_xyzw  # noqa: PLC0415

            w, xyz = (self.quaternion_wxyz or [])[:1], (self.quaternion_wxyz or [])[1:]
            quaternion = unit_quaternion(self.quaternion_xyzw or [*xyz, *w])
            return np.asarray(rotations_from_quaternions_xyzw(np.array([quaternion]))[0])
        if self.matrix is not None:
            if self.matrix[3] != [0.0, 0.0, 0.0, 1.0]:
                raise InvalidPose("the last row of a homogeneous matrix is 0 0 0 1")
            return nearest_rotation(np.array(self.matrix)[:3, :3])
        if (plain := self._off_pendant()) is not None:
            return plain.orientation()
        if self.rotation is not None:
            return nearest_rotation(np.array(self.rotation))
        from gelenk.robot.notations import rotations_from_rpy, rotations_from_vectors, rotations_from_zyz  # noqa: PLC0415

        for angles, rotations in (
            (self.rpy, rotations_from_rpy),
            (self.zyz, rotations_from_zyz),
            (self.rotation_vector, rotations_from_vectors),
        ):
            if angles is not None:
                return np.asarray(rotations(np.array([angles]))[0])
        if unless_given is None:
            raise InvalidPose(_NO_ORIENTATION)
        return unless_given


_Numbers: TypeAlias = Sequence[float] | Array


class _InPlace(TypedDict):
    # Of one class for each notation, checkers would keep that of a position alone: the others are narrower.
    position: _Numbers
    quaternion_xyzw: NotRequired[_Numbers]
    quaternion_wxyz: NotRequired[_Numbers]
    rpy: NotRequired[_Numbers]
    zyz: NotRequired[_Numbers]
    rotation_vector: NotRequired[_Numbers]
    rotation: NotRequired[Vectors]


class _Matrix(TypedDict):
    matrix: Vectors


class _Ur(TypedDict):
    ur: _Numbers


class _KukaAbc(TypedDict):
    kuka_abc: _Numbers


class _Abb(TypedDict):
    abb: _Numbers


class _FanucWpr(TypedDict):
    fanuc_wpr: _Numbers


PoseLike: TypeAlias = Pose | _InPlace | _Matrix | _Ur | _KukaAbc | _Abb | _FanucWpr
"""A pose as Python code may pass it: a model, or a dict with the fields of one notation."""


def pose_of(given: PoseLike) -> Pose:
    """Return the model of a pose; raises pydantic's ValidationError."""
    return given if isinstance(given, Pose) else Pose.model_validate(as_lists(given))


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
