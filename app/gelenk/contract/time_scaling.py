"""Uniform time scaling: request, answer, operation."""

from typing import Annotated, Literal

from pydantic import Field

from gelenk.contract.common import optional
from gelenk.contract.course_motion import (
    Coordinates,
    Duration,
    MotionAnswer,
    MotionLimits,
    PlanarLinePayload,
    SampledRequest,
    Times,
    Waypoints,
)
from gelenk.contract.endpoint import Endpoint
from gelenk.contract.options import Steps, Warnings
from gelenk.trajectory.audit.words import PolynomialLaw
from gelenk.trajectory.laws.time_scaling import Bound
from gelenk.trajectory.motion.splines import Boundary


class TimeScalingRequest(SampledRequest):
    """A motion by a time law (`displacement` or `line`, `duration`), or through samples (`times`, `waypoints`)."""

    limits: MotionLimits = Field(description="Limits; at least one of them.")
    law: PolynomialLaw = Field(
        default="cubic", description="From rest to rest; of a motion by `displacement`, or of s on a `line`."
    )
    displacement: Coordinates | None = optional("Δq of each joint, [rad or m].")
    line: PlanarLinePayload | None = optional(
        "A straight line of a planar arm's tip, instead of `displacement`: its joints move by q(s(t)), the law on s."
    )
    duration: Duration | None = optional("T of this motion, [s].")
    times: Times | None = optional("Of the waypoints, increasing, [s].")
    waypoints: Waypoints | None = optional(
        "Positions, one row per time, [rad or m]. Alone, a cubic spline is laid through them."
    )
    boundary: Boundary = Field(
        default="not_a_knot", description="Of that spline; `clamped` and `assigned` are at rest at both ends."
    )
    velocities: Waypoints | None = optional("At the waypoints, instead of a spline: cubic pieces, [rad/s or m/s].")
    accelerations: Waypoints | None = optional(
        "At the waypoints, beside `velocities`: quintic pieces, [rad/s² or m/s²]."
    )
    scaling: Literal["course", "unclipped"] = Field(
        default="course", description="The k that scales the motion in the answer: `course` never speeds up."
    )
    factor: Annotated[float, Field(ge=1e-6, le=1e6)] | None = optional(
        "A custom k for the motion in the answer, no unit; it need not respect the limits."
    )


class TimeScalingAnswer(MotionAnswer):
    """The factor k with which a motion keeps its limits, and the motion scaled by it."""

    course_factor: float = Field(
        description='k = max{1, k_vel, √k_acc} of the notes, no unit: it only slows down, though the notes say "or '
        'speed up".'
    )
    unclipped_factor: float | None = Field(
        description="k = max{k_vel, √k_acc}, no unit: with it a limit is just reached, also by speeding up; null where "
        "nothing moves."
    )
    applied_factor: float = Field(description="The k of the motion in this answer, no unit.")
    k_vel: float | None = Field(description="max{1, …} of the velocity ratios, as in the notes; no unit.")
    k_acc: float | None = Field(description="max{1, …} of the acceleration ratios, as in the notes; no unit.")
    bounds: list[Bound] = Field(description="One per limited quantity.")
    binding: Bound = Field(description="The one that requires the largest k.")
    original_duration: float = Field(description="T of the motion as given, [s].")
    steps: Steps
    warnings: Warnings


ENDPOINT = Endpoint(
    name="time_scaling",
    path="v1/course/time-scaling",
    tag="Course",
    request=TimeScalingRequest,
    answer=TimeScalingAnswer,
    summary="Uniform time scaling to the limits",
    description="""
    The factor k that scales the time of a motion so that velocities, accelerations and jerks keep limits.

    T → kT divides velocities by k, accelerations by k², jerks by k³. The notes take k = max{1, k_vel, √k_acc} "to
    slow down or speed up"; that maximum only slows down. `unclipped_factor` is the same without the 1: some limit
    is just reached with it, also by speeding up. Peaks are exact, and the answer names the joint that sets k and
    when.

    The motion is a law over `displacement` and `duration`, or along a straight `line` of a planar arm's tip, or goes
    through `waypoints` at `times`: as a cubic spline, or with `velocities` (and `accelerations`) as sampled from any
    motion. The answer holds it scaled, from t = 0 on.

    As a picture of the scaled profiles with `Accept: image/svg+xml`, `image/png` or `application/pdf`.
    """,
    picture="Position, velocity, acceleration and jerk over time, with the limits.",
    example={
        "displacement": [1.0, -2.0],
        "duration": 1.0,
        "law": "cubic",
        "limits": {"joint_velocity": [1.0, 2.0], "joint_acceleration": [8.0, 8.0]},
        "samples": 5,
    },
)
