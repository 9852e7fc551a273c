"""Answers of trajectories: the samples, what came of each segment, and the judgement of the whole."""

from typing import Literal

from pydantic import Field

from app.schemas.common import Answer
from app.schemas.kinematics import CertificateInfo
from app.schemas.pose import Pose
from app.trajectory.words import Check, Law, SegmentType, StopReason

LimitSource = Literal["request", "robot", "assumed"]


class MotionLimitsInfo(Answer):
    """What joints and tip may do, scales applied; one number a joint, base to tip."""

    joint_velocity: list[float] = Field(description="One number a joint, [rad/s or m/s].")
    joint_acceleration: list[float] = Field(description="One number a joint, [rad/s² or m/s²].")
    joint_jerk: list[float] = Field(description="One number a joint, [rad/s³ or m/s³].")
    tip_velocity: float | None = Field(description="[m/s]; null without one.")
    tip_acceleration: float | None = Field(description="[m/s²]; null without one.")
    tip_angular_velocity: float | None = Field(description="[rad/s]; null without one.")
    tip_angular_acceleration: float | None = Field(description="[rad/s²]; null without one.")


class LimitSourcesInfo(Answer):
    """Where each joint's limits are from: the request, the robot's description, or assumed for want of both."""

    joint_velocity: list[LimitSource] = Field(description="One entry a joint.")
    joint_acceleration: list[LimitSource] = Field(description="One entry a joint.")
    joint_jerk: list[LimitSource] = Field(description="One entry a joint.")


class PolynomialsInfo(Answer):
    """q(t) = Σ_k coefficients[i][k] (t - breaks[i])^k between breaks[i] and breaks[i + 1]."""

    breaks: list[float] = Field(description="Where the pieces begin, and where the last one ends, [s].")
    coefficients: list[list[list[float]]] = Field(
        description="Of each piece, lowest power first, one number a joint: [rad or m per sᵏ]."
    )


class DampingInfo(Answer):
    """How far the tip left its way because its joints were damped."""

    distance: float = Field(description="At most, [m].")
    angle: float = Field(description="At most, [rad].")


class SegmentBlend(Answer):
    """How a line went over into the next."""

    radius: float = Field(description="Distance from the corner at which the line is left, [m].")
    start_time: float = Field(description="When it begins, [s].")
    end_time: float = Field(description="When it ends, [s].")
    acceleration: float | None = Field(
        description="Limit of the tip's in it, [m/s²]; null where `blend_radius` was given, and only the limits of the "
        "lines count."
    )


class TrajectorySegmentInfo(Answer):
    """What came of a segment, as far as it was done."""

    index: int = Field(description="Which, from 0.")
    type: SegmentType = Field(description="What moves.")
    law: Law = Field(description="As it was asked for.")
    start_time: float = Field(description="When it begins, [s].")
    end_time: float = Field(description="When it ends, [s].")
    length: float | None = Field(description="Of the tip's way, [m]; null of a joint motion.")
    angle: float | None = Field(description="By which the tip turns on it, [rad]; null of a joint motion.")
    blended: bool = Field(description="Whether it is left for the next without a stop.")
    blend: SegmentBlend | None = Field(description="How; null also where the motion does not get that far.")
    joint_deviation: DampingInfo | None = Field(description="From the way, where joints were damped.")
    limits: MotionLimitsInfo = Field(description="Its own; of lines that are blended the tightest of all count.")
    notes: list[str] = Field(description="What else is to be known.")
    polynomials: PolynomialsInfo | None = Field(
        default=None, description="Where `coefficients` were asked for: the pieces that begin in this segment."
    )


class FailureInfo(Answer):
    """Why a trajectory ends before its time."""

    reason: StopReason = Field(description="Why the motion ends before its goal.")
    segment: int = Field(description="Which one could not be done, from 0.")
    time: float = Field(description="Where the motion ends, [s].")
    position: list[float] = Field(description="Of the tip, in the base frame, where it could not go on, [m].")
    joint: str | None = Field(description="Which one is at its limit.")
    detail: str = Field(description="The same in a sentence with numbers.")


class TrajectoryPeakInfo(Answer):
    """The largest of something."""

    ratio: float | None = Field(description="To its limit or tolerance, no unit; null without one.")
    value: float = Field(
        description="With its sign: of a joint [rad or m per sᵏ]; of the tip [m or rad], [m/s or rad/s], "
        "[m/s² or rad/s²]."
    )
    joint: str | None = Field(description="Which joint; null for the tip.")
    time: float = Field(description="When, [s].")


class JumpInfo(Answer):
    """The largest jump of a quantity where pieces meet."""

    value: float = Field(description="How far it jumps, [rad or m per sᵏ].")
    joint: str | None = Field(description="That jumps furthest; null where none does.")
    time: float = Field(description="When, [s].")


class ContinuityInfo(Answer):
    """Jumps where pieces meet; without joints null."""

    position: JumpInfo | None
    velocity: JumpInfo | None
    acceleration: JumpInfo | None
    jerk: JumpInfo | None


class MarginInfo(Answer):
    """How near the joints come to their limits."""

    value: float = Field(description="Smallest distance to a limit, negative beyond, [rad or m].")
    joint: str = Field(description="The joint that comes nearest to a limit.")
    bound: Literal["lower", "upper"] = Field(description="Which of its limits.")
    time: float = Field(description="When, [s].")


class SmallestInfo(Answer):
    """The smallest singular value of the Jacobian along the way."""

    value: float = Field(description="Its own, [m or rad] per [rad or m]: units are mixed.")
    time: float = Field(description="When, [s].")


class TipPeaksInfo(Answer):
    """What the tip does at most; each `ratio` is the largest to the limit that holds where it is."""

    speed: TrajectoryPeakInfo
    angular_speed: TrajectoryPeakInfo
    acceleration: TrajectoryPeakInfo
    angular_acceleration: TrajectoryPeakInfo


class ReasonInfo(Answer):
    """Why a motion does not pass."""

    check: Check = Field(description="What is not kept.")
    detail: str = Field(description="By how much, in a sentence.")
    joint: str | None = Field(description="Whose doing it is; null where it is no single joint's.")
    time: float = Field(description="When, [s].")


class AuditInfo(Answer):
    """The judgement of the motion, by code that shares nothing with what planned it: between samples too.

    A ratio is that to the limit in force at the time.
    """

    passed: bool = Field(description="Whether it keeps all that was promised of it; one that does not is not sent.")
    velocity: TrajectoryPeakInfo | None = Field(description="Of the joint nearest to its limit; null without joints.")
    acceleration: TrajectoryPeakInfo | None
    jerk: TrajectoryPeakInfo | None = Field(
        description="Of the pieces: where the acceleration jumps it is infinite, which `continuity` tells. Its "
        "limits are kept by `quintic`, `septic` and `jerk_limited`; another law is only compared with them, and "
        "`notes` of its segment say where it goes beyond."
    )
    path_deviation: TrajectoryPeakInfo | None = Field(description="Distance from the way of the tip; null without one.")
    orientation_deviation: TrajectoryPeakInfo | None = Field(description="Angle from it; null without one.")
    continuity: ContinuityInfo
    min_singular_value: SmallestInfo | None = Field(description="Null without joints.")
    limit_margin: MarginInfo | None = Field(description="Null where no joint has limits.")
    ends: dict[str, float] = Field(
        description="By name, how far a position, velocity or acceleration at the start or the end is from what it is "
        "to be, [rad or m per sᵏ]."
    )
    tip: TipPeaksInfo
    certificate: CertificateInfo = Field(description="Of poses along the motion, recomputed through Pinocchio.")
    reasons: list[ReasonInfo] = Field(description="Why it does not pass.")


class TimingInfo(Answer):
    """One way at two timings."""

    segments: list[int] = Field(description="Which, from 0; several where they are blended.")
    law: Law = Field(description="That is scaled uniformly.")
    uniform_duration: float = Field(description="The law, scaled so that some limit is just reached, [s].")
    velocity_factor: float = Field(
        description="k_vel, the largest ratio of a velocity to its limit if the law lasts 1 s; no unit."
    )
    acceleration_factor: float = Field(
        description="k_acc, likewise of accelerations; no unit. The law's duration is the larger one of k_vel and "
        "√k_acc in seconds, longer where the limits of jerk ask for it."
    )
    time_optimal_duration: float = Field(description="Of the quickest motion along the same way, [s].")


class TrajectoryAnswer(Answer):
    """A motion, sampled; samples are k · sample_period and the end."""

    joint_names: list[str] = Field(description="The chain's joints in the order of a configuration.")
    base_frame: str = Field(description="Frame in which poses are expressed.")
    tip_frame: str = Field(description="Frame whose poses they are.")
    duration: float = Field(description="Of the motion, of what was done of it, [s].")
    completed_fraction: float = Field(description="Of the segments, each counting alike, 0 to 1; no unit.")
    failure: FailureInfo | None = Field(description="Why it is not 1.")
    times: list[float] = Field(description="Of the samples, [s].")
    joint_positions: list[list[float]] = Field(description="A row a sample, [rad or m].")
    joint_velocities: list[list[float]] = Field(description="A row a sample, [rad/s or m/s].")
    joint_accelerations: list[list[float]] = Field(
        description="A row a sample, [rad/s² or m/s²]; where they jump, those after the jump."
    )
    tip_poses: list[Pose] | None = Field(description="T_base_tip at each sample; null where not asked for.")
    segments: list[TrajectorySegmentInfo] = Field(description="Those that were done, wholly or in part.")
    audit: AuditInfo
    timing: list[TimingInfo] | None = Field(default=None, description="Where `compare_timing` was asked for.")
    limits: MotionLimitsInfo = Field(description="Of the trajectory; each segment has its own.")
    limit_sources: LimitSourcesInfo
    notes: list[str] = Field(description="What was assumed.")
    certificate: CertificateInfo | None = Field(
        description="Of `tip_poses`, a sample of them recomputed through Pinocchio; null without them."
    )
