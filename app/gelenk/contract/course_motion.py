"""Payloads that all calculators of motions in time share."""

from typing import Annotated, Any

from pydantic import AfterValidator, BeforeValidator, Field

from gelenk.contract.common import Answer, Payload, optional
from gelenk.contract.options import InLanguage
from gelenk.course.motion.check import MotionCertificate

MAX_JOINTS = 32
MAX_KNOTS = 1000
MAX_SAMPLES = 10_000
MAX_SAMPLED_NUMBERS = 100_000
"""Maximum of samples times joints."""

_LARGEST = 1e6
_NEXT_TO_NOTHING = 1e-30


def one_joint(value: Any) -> Any:
    """Turn a number alone into a list of one."""
    return [value] if isinstance(value, int | float) and not isinstance(value, bool) else value


def _no_underflow(value: float) -> float:
    """Replace numbers whose squares would vanish by 0."""
    return value if abs(value) > _NEXT_TO_NOTHING else 0.0


Coordinate = Annotated[float, Field(ge=-_LARGEST, le=_LARGEST), AfterValidator(_no_underflow)]
_CoordinateList = Annotated[list[Coordinate], Field(min_length=1, max_length=MAX_JOINTS, fail_fast=True)]
Coordinates = Annotated[
    _CoordinateList, BeforeValidator(one_joint, json_schema_input_type=Coordinate | _CoordinateList)
]
"""One number per joint; a number alone stands for a list of one."""

Bound = Annotated[float, Field(ge=1e-9, le=1e9)]
_BoundList = Annotated[list[Bound], Field(min_length=1, max_length=MAX_JOINTS, fail_fast=True)]
Bounds = Annotated[_BoundList, BeforeValidator(one_joint, json_schema_input_type=Bound | _BoundList)]
Time = Annotated[float, Field(ge=-1e6, le=1e6), AfterValidator(_no_underflow)]
Duration = Annotated[float, Field(ge=1e-6, le=1e6)]

Waypoints = Annotated[list[Coordinates], Field(min_length=2, max_length=MAX_KNOTS, fail_fast=True)]
Times = Annotated[list[Time], Field(min_length=2, max_length=MAX_KNOTS, fail_fast=True)]
SampleTimes = Annotated[list[Time], Field(min_length=1, max_length=MAX_SAMPLES, fail_fast=True)]
SampleCount = Annotated[int, Field(ge=2, le=MAX_SAMPLES)]


class MotionLimits(Payload):
    """Limits of each joint; a single number applies to all joints."""

    joint_velocity: Bounds | None = optional("|q̇|, > 0, [rad/s or m/s].")
    joint_acceleration: Bounds | None = optional("|q̈|, > 0, [rad/s² or m/s²].")
    joint_jerk: Bounds | None = optional("|q⃛|, > 0, [rad/s³ or m/s³].")


class SampleTimesRequest(InLanguage):
    """When a motion is sampled."""

    samples: SampleCount = Field(
        default=101, description="Number of samples, evenly spaced from start to end, both included; no unit."
    )
    sample_times: SampleTimes | None = optional("Instead of `samples`: the times, none outside the motion, [s].")


class SampledRequest(SampleTimesRequest):
    """Sample times of a motion, and limits to compare it with."""

    limits: MotionLimits | None = optional(
        "Limits of each joint: peaks are given as ratios to them, and pictures show them."
    )


class SegmentInfo(Answer):
    """A piece of the motion, q(t) = Σ c_k (t - start_time)^k."""

    start_time: float = Field(description="When it begins, [s].")
    end_time: float = Field(description="When it ends, [s].")
    coefficients: list[list[float]] = Field(
        description="One row per joint, lowest power first: c_0 is the position where the piece begins, "
        "[rad or m per sᵏ]. The lecture lists them the other way round."
    )


class PeakInfo(Answer):
    """Peak of a joint: the value furthest from zero."""

    value: float = Field(description="Signed peak, [rad or m per s, s² or s³].")
    time: float = Field(description="The first time at which it is so large, [s].")
    limit: float | None = Field(description="Of this joint, in the unit of the value; null without one.")
    ratio: float | None = Field(description="|value| / limit, no unit; null without a limit.")


class PeaksInfo(Answer):
    """Exact peaks, one per joint: from the roots of the next derivative and the ends of the pieces."""

    velocity: list[PeakInfo]
    acceleration: list[PeakInfo]
    jerk: list[PeakInfo] = Field(description="Of the pieces: jumps of the acceleration between them do not count.")


class MotionAnswer(Answer):
    """A motion: its pieces, its peaks, its samples."""

    duration: float = Field(description="Of the whole, [s].")
    switching_times: list[float] = Field(description="Where the pieces begin and end, [s].")
    segments: list[SegmentInfo]
    peaks: PeaksInfo
    times: list[float] = Field(description="Of the samples, [s].")
    joint_positions: list[list[float]] = Field(description="One row per sample, [rad or m].")
    joint_velocities: list[list[float]] = Field(description="One row per sample, [rad/s or m/s].")
    joint_accelerations: list[list[float]] = Field(
        description="One row per sample, [rad/s² or m/s²]; where they jump, those after the jump."
    )
    joint_jerks: list[list[float]] = Field(description="One row per sample, [rad/s³ or m/s³].")
    certificate: MotionCertificate


_Length = Annotated[float, Field(ge=1e-6, le=1e6)]
_Angle = Annotated[float, Field(ge=-1e3, le=1e3)]


class PlanarLinePayload(Payload):
    """A straight line of the tip of a planar arm with two revolute joints."""

    lengths: Annotated[list[_Length], Field(min_length=2, max_length=2)] = Field(description="l₁ and l₂, > 0, [m].")
    start: Annotated[list[_Angle], Field(min_length=2, max_length=2)] = Field(
        description="q₁ and q₂ where the line begins, neither stretched nor folded, [rad]. The sign of sin q₂ is kept: "
        "one branch of the inverse kinematics."
    )
    target: Annotated[list[Coordinate], Field(min_length=2, max_length=2)] = Field(
        description="p_f: x and y of the tip where the line ends, [m]."
    )
