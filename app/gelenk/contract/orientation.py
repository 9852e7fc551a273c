"""The calculator of orientations: request, answer, operation."""

from typing import Annotated, Literal

import numpy as np
from pydantic import Field, model_validator

from gelenk.contract.common import Answer, Payload, optional
from gelenk.contract.endpoint import Endpoint
from gelenk.contract.options import InLanguage, Steps
from gelenk.contract.pose import MAX_MAGNITUDE, ORIENTATIONS, Matrix3, Pose, Vector3, Vector4
from gelenk.course.orientation.orientation import Degeneracy
from gelenk.course.orientation.rotations import (
    DEGENERATE,
    FrameMotion,
    Validation,
    about_axis,
    elementary,
    unit_axis,
    validated,
)
from gelenk.errors import InvalidPose
from gelenk.robot.arrays import Array
from gelenk.robot.poses import ROTATION_TOLERANCE, transform

MAX_MOTIONS = 64
MAX_POINTS = 10_000

_NOTATIONS = (*ORIENTATIONS, "axis_angle", "elementary")
_Angle = Annotated[float, Field(ge=-MAX_MAGNITUDE, le=MAX_MAGNITUDE)]


class AxisAnglePayload(Payload):
    """A rotation about an axis through the origin."""

    axis: Vector3 = Field(description="Its direction; of any length but 0, no unit.")
    angle: _Angle = Field(description="Counter-clockwise about it, [rad].")


class ElementaryPayload(Payload):
    """Rx, Ry or Rz."""

    axis: Literal["x", "y", "z"] = Field(description="The coordinate axis.")
    angle: _Angle = Field(description="Counter-clockwise about it, [rad].")


class OrientationPayload(Payload):
    """Exactly one orientation, in the notation of one's choice."""

    quaternion_xyzw: Vector4 | None = optional("Unit quaternion, scalar last.")
    quaternion_wxyz: Vector4 | None = optional("Unit quaternion, scalar first.")
    rpy: Vector3 | None = optional(
        "Roll, pitch, yaw about the fixed axes x, y, z: R = Rz(yaw) Ry(pitch) Rx(roll), [rad]."
    )
    zyz: Vector3 | None = optional("Euler angles φ, θ, ψ: R = Rz(φ) Ry(θ) Rz(ψ), [rad].")
    rotation_vector: Vector3 | None = optional("Axis times angle, [rad].")
    rotation: Matrix3 | None = optional("Rotation matrix, row by row.")
    axis_angle: AxisAnglePayload | None = optional("A rotation about any axis.")
    elementary: ElementaryPayload | None = optional("A rotation about a coordinate axis.")
    project: bool = Field(
        default=False,
        description="Whether to project a `rotation` further than 1e-6 from a rotation matrix onto the nearest one "
        "instead of refusing it.",
    )

    @model_validator(mode="after")
    def _one_notation(self) -> "OrientationPayload":
        given = [name for name in _NOTATIONS if getattr(self, name) is not None]
        if len(given) != 1:
            raise ValueError(f"exactly one orientation of {', '.join(_NOTATIONS)}; {len(given)} are given")
        if self.project and self.rotation is None:
            raise ValueError("`project` is only allowed with `rotation`: other notations are always rotations")
        return self

    def turned(self, place: str = "") -> tuple[Array, Validation | None]:
        """Return R_a_b, shape (3, 3), and how far a given `rotation` was from a rotation matrix.

        Args:
            place: Prefix of its place in the request, with a slash at the end.

        Raises:
            InvalidPose: It is not a rotation.
            InvalidField: An axis has no direction.
        """
        validation = None
        if self.rotation is not None:
            validation, nearest = validated(np.array(self.rotation))
            R = self._accepted(validation, nearest, place)
        elif self.axis_angle is not None:
            R = about_axis(unit_axis(self.axis_angle.axis, f"{place}axis_angle/axis"), self.axis_angle.angle)
        elif self.elementary is not None:
            R = elementary(self.elementary.axis, self.elementary.angle)
        else:
            R = self._as_in_a_pose(place)
        return R, validation

    def written(self) -> tuple[str, list[float], str]:
        """Return the name of the notation, its numbers, and the axis of an elementary rotation, else ""."""
        name = next(name for name in _NOTATIONS if getattr(self, name) is not None)
        if self.axis_angle is not None:
            return name, [*unit_axis(self.axis_angle.axis, "axis_angle/axis").tolist(), self.axis_angle.angle], ""
        if self.elementary is not None:
            return name, [self.elementary.angle], self.elementary.axis
        return name, np.ravel(getattr(self, name)).tolist(), ""

    def _as_in_a_pose(self, place: str) -> Array:
        name = next(name for name in ORIENTATIONS if getattr(self, name) is not None)
        try:
            return Pose.model_construct(**{name: getattr(self, name)}).orientation()
        except InvalidPose as error:
            raise InvalidPose(error.reason, error.distance, place + name) from None

    def _accepted(self, found: Validation, nearest: Array, place: str) -> Array:
        if not found.projected:
            return self._as_in_a_pose(place)
        if self.project and float(np.abs(self.rotation or 0.0).max()) <= DEGENERATE:
            reason = "the matrix is zero: no rotation is nearer to it than any other"
            raise InvalidPose(reason, field=f"{place}rotation")
        if self.project:
            return nearest
        kind = "a reflection" if found.is_reflection else "not a rotation"
        reason = (
            f"the matrix is {kind}: ‖RᵀR - I‖ = {found.orthogonality_error:.6g}, det R = {found.determinant:.6g}; "
            f"the limit is a distance of {ROTATION_TOLERANCE:g} from SO(3), or `project` for the nearest rotation"
        )
        raise InvalidPose(reason, found.distance, f"{place}rotation")


class MotionPayload(OrientationPayload):
    """Exactly one orientation, perhaps with a position."""

    position: Vector3 | None = optional("Of the moved frame's origin, [m]; zero if left out.")

    def read(self, place: str = "") -> tuple[Array, Validation | None]:
        """Return T_a_b, shape (4, 4), and the rest as `turned`."""
        R, validation = self.turned(place)
        return transform(np.array(self.position or [0.0, 0.0, 0.0]), R), validation


class FurtherPayload(MotionPayload):
    """A further motion of a composition."""

    about: Literal["moving", "fixed"] = Field(
        default="moving",
        description="Axes it is expressed in: those of the frame moved so far (R = R1 R2, from the right), or the "
        "fixed ones (R = R2 R1, from the left).",
    )


class OrientationRequest(MotionPayload, InLanguage):
    """An orientation, with optional motions to compose it with and points to move."""

    then: Annotated[list[FurtherPayload], Field(max_length=MAX_MOTIONS)] = Field(
        default_factory=list, description="Further motions, in order; the answer is about the frame they lead to."
    )
    points: Annotated[list[Vector3], Field(max_length=MAX_POINTS, fail_fast=True)] = Field(
        default_factory=list, description="Points in the frame that all motions lead to, [m]."
    )

    def motions(self) -> tuple[Array, list[FrameMotion], list[Validation | None]]:
        """Return the first transform, the further motions, and how far each matrix was from a rotation."""
        first, validation = self.read()
        further: list[FrameMotion] = []
        validations = [validation]
        for i, motion in enumerate(self.then):
            T, validation = motion.read(f"then/{i}/")
            further.append((T, motion.about))
            validations.append(validation)
        return first, further, validations


Triple = Annotated[list[float], Field(min_length=3, max_length=3)]
Quadruple = Annotated[list[float], Field(min_length=4, max_length=4)]
Rows = Annotated[list[Triple], Field(min_length=3, max_length=3)]


class AxisAngleInfo(Answer):
    """An axis and an angle, separately."""

    axis: Triple | None = Field(description="Unit axis, no unit; null at angle 0, where there is none.")
    other_axis: Triple | None = Field(description="At angle π the opposite axis, which does the same; else null.")
    angle: float = Field(description="In [0, π], [rad].")


class FrameInfo(Answer):
    """A frame by its rotation matrix and origin."""

    rotation: Rows = Field(description="R, row by row, no unit.")
    position: Triple = Field(description="Its origin, [m]: the last column of the homogeneous matrix.")


class OrientationCertificate(Answer):
    """Differences of the answer from the same numbers computed another way."""

    max_rotation_error: float = Field(
        description="Largest entry by which R differs from what each of the notations, both branches, gives; no unit."
    )
    max_inverse_error: float = Field(
        description="Largest entry of T T⁻¹ - I, relative to the largest coordinate, no unit."
    )
    max_point_error: float = Field(
        description="Largest difference of the points to those moved step by step, relative likewise, no unit."
    )


class OrientationAnswer(Answer):
    """The orientation in every notation."""

    rotation: Rows = Field(description="R, row by row, no unit.")
    quaternion_xyzw: Quadruple = Field(
        description="Scalar last, no unit; its negative is the same. The scalar is ≥ 0; where it is 0 the first other "
        "part that is not 0 is positive."
    )
    quaternion_wxyz: Quadruple = Field(description="The same, scalar first, no unit.")
    rotation_vector: Triple = Field(description="Axis times angle, [rad].")
    axis_angle: AxisAngleInfo
    zyz: Triple = Field(description="φ, θ, ψ with θ in [0, π], [rad].")
    zyz_solutions: list[Triple] = Field(
        description="Both branches, the second with θ < 0, [rad]; where it degenerates the chosen one alone."
    )
    rpy: Triple = Field(description="Roll, pitch, yaw with pitch in [-π/2, π/2], [rad].")
    rpy_solutions: list[Triple] = Field(
        description="Both branches, the second with |pitch| > π/2, [rad]; where it degenerates the chosen one alone."
    )
    degenerate: list[Degeneracy] = Field(description="Degeneracies; usually empty.")
    degenerate_threshold: float = Field(description="Sines and cosines below it count as zero, no unit.")
    position: Triple = Field(description="Of the frame's origin, [m].")
    inverse: FrameInfo = Field(description="Rᵀ and -Rᵀp.")
    points: list[Triple] = Field(description="The given points, written in the frame that stays: R x + p, [m].")
    frames: list[FrameInfo] = Field(description="The frame after each motion.")
    validations: list[Validation | None] = Field(
        description="Of each motion in order: how far its `rotation` is from one; null for another notation."
    )
    steps: Steps
    warnings: list[str] = Field(description="Near degeneracies, and choices made.")
    certificate: OrientationCertificate


ENDPOINT = Endpoint(
    name="orientation",
    path="v1/course/orientation",
    tag="Course",
    operation_id="convert_orientation",
    request=OrientationRequest,
    answer=OrientationAnswer,
    summary="An orientation in every notation",
    description="""
    Takes an orientation in one notation and gives it in all of them, with both branches of ZYZ and RPY.

    Where a triple degenerates, `degenerate` says what is still determined: of ZYZ φ + ψ at θ = 0 and φ - ψ at
    θ = π (the notes have "only the sum"), of RPY yaw - roll at pitch π/2 and yaw + roll at -π/2. At angle 0 there
    is no axis, at π there are both.

    A `rotation` further than 1e-6 from a rotation matrix is refused, with ‖RᵀR - I‖, det R and its distance; with
    `project` the nearest rotation is taken and all this is in the answer.

    `then` composes further motions, R = R1 R2 about the moved axes or R2 R1 about the fixed ones; `position` makes
    frames of orientations, whose origin is the last column (the notes once say row) of the homogeneous matrix.
    `inverse` is Rᵀ, -Rᵀp, and `points` are moved along. Every notation is converted back into R as a check.
    """,
    example={
        "zyz": [0.3, 0.7, -1.1],
        "then": [{"elementary": {"axis": "x", "angle": 0.4}, "position": [0.0, 0.0, 0.2], "about": "moving"}],
        "points": [[1.0, 2.0, 3.0]],
    },
)
