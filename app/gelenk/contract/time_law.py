"""Time laws: request, answer, operation."""

from typing import Annotated, Literal, TypeAlias

from pydantic import BeforeValidator, Field

from gelenk.contract.common import Answer, optional
from gelenk.contract.course_motion import (
    MAX_KNOTS,
    Coordinates,
    Duration,
    MotionAnswer,
    SampledRequest,
    Times,
    Waypoints,
    one_joint,
)
from gelenk.contract.endpoint import Endpoint
from gelenk.contract.options import Steps, Warnings
from gelenk.trajectory.audit.words import PolynomialLaw

Law: TypeAlias = Literal[PolynomialLaw, "4-3-4", "trapezoidal", "parabolic_blends"]

_BlendTimeList = Annotated[list[Duration], Field(min_length=1, max_length=MAX_KNOTS, fail_fast=True)]
BlendTimes = Annotated[_BlendTimeList, BeforeValidator(one_joint, json_schema_input_type=Duration | _BlendTimeList)]


class TimeLawRequest(SampledRequest):
    """A time law and its inputs.

    Positions and their derivatives have one number per joint; a single number means one joint.
    """

    law: Law = Field(
        description="`cubic`, `quintic`, `septic`: from `start` to `target` in `duration`. `4-3-4`: through four "
        "`waypoints` at `times`. `trapezoidal`: bang-coast-bang from `start` to `target` within "
        "`limits.joint_velocity` and `limits.joint_acceleration`, in the shortest time or in `duration`. "
        "`parabolic_blends`: straight segments through `waypoints` at `times`, rounded by `blend_time` or "
        "`limits.joint_acceleration`."
    )
    start: Coordinates | None = optional("q at the start, [rad or m].")
    target: Coordinates | None = optional("q at the end, [rad or m].")
    start_velocity: Coordinates | None = optional("0 if left out, [rad/s or m/s].")
    end_velocity: Coordinates | None = optional("0 if left out, [rad/s or m/s].")
    start_acceleration: Coordinates | None = optional(
        "Of a quintic, a septic or 4-3-4; 0 if left out, [rad/s² or m/s²]."
    )
    end_acceleration: Coordinates | None = optional("The same at the end, [rad/s² or m/s²].")
    start_jerk: Coordinates | None = optional("Of a septic; 0 if left out, [rad/s³ or m/s³].")
    end_jerk: Coordinates | None = optional("The same at the end, [rad/s³ or m/s³].")
    duration: Duration | None = optional("T, [s]. Of a trapezoid: longer than the shortest; the shortest if left out.")
    waypoints: Waypoints | None = optional("Positions at `times`, one row per point, [rad or m].")
    times: Times | None = optional("Of the waypoints, increasing, [s].")
    blend_time: BlendTimes | None = optional(
        "Duration of the blend at each waypoint, [s]; a single number applies to all of them."
    )
    may_reverse: bool = Field(
        default=False,
        description="Whether a trapezoid may turn back where its end velocities carry it too far or away from the "
        "target; without it, that is refused.",
    )


class ProfileInfo(Answer):
    """The trapezoid of a joint's velocity."""

    peak_velocity: float = Field(description="v_p at which it coasts, with its sign, [rad/s or m/s].")
    acceleration: float = Field(description="Size of the acceleration in the first and last phase, [rad/s² or m/s²].")
    acceleration_time: float = Field(description="Of the first phase, from the start velocity to v_p, [s].")
    coast_time: float = Field(description="[s]; 0 without a coast.")
    deceleration_time: float = Field(description="Of the last phase, from v_p to the end velocity, [s].")
    own_duration: float = Field(description="T_j, the time that the joint alone would need, [s].")
    factor: float | None = Field(
        description="k = T/T_j by which it was slowed uniformly, v/k and a/k²; 1 where it was not; null where it keeps "
        "its acceleration and coasts more slowly. No unit."
    )
    reverses: bool = Field(description="Whether the joint reverses during the motion.")


class BlendsInfo(Answer):
    """Straight segments and blends; one row per joint."""

    velocities: list[list[float]] = Field(description="On each straight segment, [rad/s or m/s].")
    accelerations: list[list[float]] = Field(description="In each blend, [rad/s² or m/s²].")
    blend_times: list[list[float]] = Field(description="Duration of each blend, [s].")
    deviations: list[list[float]] = Field(
        description="Distance by which each waypoint is passed at its time, |Δv| t_b / 8, [rad or m]."
    )


class TimeLawAnswer(MotionAnswer):
    """A motion by a time law."""

    law: Law = Field(description="As requested.")
    normalised: list[list[float] | None] | None = Field(
        description="Of a cubic, quintic or septic: the lecture's a, b, c, … of q = q0 + Δq (a λⁿ + b λⁿ⁻¹ + …) in "
        "λ = t/T, highest power first, one list per joint, no unit; null for a joint with Δq = 0, which has none."
    )
    profiles: list[ProfileInfo] | None = Field(description="Of a trapezoid, one per joint.")
    blends: BlendsInfo | None = Field(description="Of `parabolic_blends`.")
    steps: Steps
    warnings: Warnings


ENDPOINT = Endpoint(
    name="time_law",
    path="v1/course/time-law",
    tag="Course",
    request=TimeLawRequest,
    answer=TimeLawAnswer,
    summary="Time laws: cubic, quintic, septic, 4-3-4, trapezoid",
    description="""
    A motion by a time law: its pieces, peaks, samples, and the worked solution.

    Cubic, quintic and septic have velocity, acceleration and jerk given at both ends, one more each. The lecture
    normalises by Δq = q₁ - q₀, which is not possible where q₁ = q₀: here the general form is computed, and the
    normalised coefficients are given for the joints that have them.

    Trapezoid (bang-coast-bang): T_s = v/a and T = (La + v²)/(av) where L > v²/a, else T_s = √(L/a) and T = 2 T_s (a T
    = √(L/2a) that circulates is wrong). With end velocities v_p = min(v, √(aL + (v_i² + v_f²)/2)); |v_i² - v_f²| >
    2aL is refused, and the message says what would be feasible, unless `may_reverse`. The slowest of several joints
    sets the time; the others are slowed by k = T/T_j, those with end velocities and those in a given `duration` coast
    more slowly.

    As a picture of the profiles with `Accept: image/svg+xml`, `image/png` or `application/pdf`.
    """,
    picture="Position, velocity, acceleration and jerk over time, with the limits.",
    example={
        "law": "cubic",
        "start": 0.2,
        "target": 1.4,
        "start_velocity": 0.5,
        "end_velocity": -0.3,
        "duration": 2.0,
        "samples": 5,
    },
)
