"""Trajectories: the answer, with samples, segments and audit."""

from typing import Literal

from pydantic import Field

from gelenk.contract.common import Answer
from gelenk.contract.pose import Pose
from gelenk.kinematics.judge.words import PoseCertificate
from gelenk.trajectory.audit.words import Check, Law, SegmentType, StopReason

LimitSource = Literal["request", "robot", "assumed"]


class MotionLimitsInfo(Answer):
    """Limits of the joints and the tip, with scales applied; one number per joint, base to tip."""

    joint_velocity: list[float] = Field(description="One number per joint, [rad/s or m/s].")
    joint_acceleration: list[float] = Field(description="One number per joint, [rad/s² or m/s²].")
    joint_jerk: list[float] = Field(description="One number per joint, [rad/s³ or m/s³].")
    tip_velocity: float | None = Field(description="[m/s]; null without one.")
    tip_acceleration: float | None = Field(description="[m/s²]; null without one.")
    tip_angular_velocity: float | None = Field(description="[rad/s]; null without one.")
    tip_angular_acceleration: float | None = Field(description="[rad/s²]; null without one.")


class LimitSourcesInfo(Answer):
    """Source of each joint's limits: the request, the robot's description, or an assumption if neither has them."""

    joint_velocity: list[LimitSource] = Field(description="One entry per joint.")
    joint_acceleration: list[LimitSource] = Field(description="One entry per joint.")
    joint_jerk: list[LimitSource] = Field(description="One entry per joint.")


class PolynomialsInfo(Answer):
    """q(t) = Σ_k coefficients[i][k] (t - breaks[i])^k between breaks[i] and breaks[i + 1]."""

    breaks: list[float] = Field(description="Where the pieces begin, and where the last one ends, [s].")
    coefficients: list[list[list[float]]] = Field(
        description="Of each piece, lowest power first, one number per joint: [rad or m per sᵏ]."
    )


class DampingInfo(Answer):
    """How far the tip left its path because its joints were damped."""

    distance: float = Field(description="At most, [m].")
    angle: float = Field(description="At most, [rad].")


class SegmentBlend(Answer):
    """How a line was blended into the next."""

    radius: float = Field(description="Distance from the corner at which the motion leaves the line, [m].")
    start_time: float = Field(description="When it begins, [s].")
    end_time: float = Field(description="When it ends, [s].")
    acceleration: float | None = Field(
        description="Limit of the tip's in it, [m/s²]; null where `blend_radius` was given, and only the limits of the "
        "lines count."
    )


class TrajectorySegmentInfo(Answer):
    """The completed part of a segment."""

    index: int = Field(description="Index of the segment, from 0.")
    type: SegmentType = Field(description="Kind of segment.")
    law: Law = Field(description="The time law used.")
    start_time: float = Field(description="When it begins, [s].")
    end_time: float = Field(description="When it ends, [s].")
    length: float | None = Field(description="Length of the tip's path, [m]; null for a joint motion.")
    angle: float | None = Field(description="Angle by which the tip turns along it, [rad]; null for a joint motion.")
    blended: bool = Field(description="Whether it is blended into the next without a stop.")
    blend: SegmentBlend | None = Field(description="The blend; null also if the motion does not get that far.")
    joint_deviation: DampingInfo | None = Field(description="Deviation from the path where joints were damped.")
    limits: MotionLimitsInfo = Field(
        description="Its own. Of lines that are blended each keeps its own limits of the tip; of those of joints, and "
        "so of `velocity_scale` and `acceleration_scale`, the tightest of all hold on each. A slow line does not slow "
        "the others."
    )
    notes: list[str] = Field(description="Further remarks.")
    polynomials: PolynomialsInfo | None = Field(
        default=None, description="If `coefficients` were requested: the pieces that begin in this segment."
    )


class FailureInfo(Answer):
    """Why a trajectory ends early."""

    reason: StopReason = Field(description="Why the motion ends before its goal.")
    segment: int = Field(description="Index of the segment that could not be completed, from 0.")
    time: float = Field(description="Where the motion ends, [s].")
    position: list[float] = Field(description="Tip position in the base frame where it could not go on, [m].")
    joint: str | None = Field(description="The joint at its limit.")
    detail: str = Field(description="An explanation in one sentence, with numbers.")


class TrajectoryPeakInfo(Answer):
    """The largest value of a quantity, with its place and limit."""

    ratio: float | None = Field(description="To its limit or tolerance, no unit; null without one.")
    value: float = Field(
        description="With its sign: of a joint [rad or m per sᵏ]; of the tip [m or rad], [m/s or rad/s], "
        "[m/s² or rad/s²]."
    )
    joint: str | None = Field(description="Which joint; null for the tip.")
    time: float = Field(description="Time of the peak, [s].")


class JumpInfo(Answer):
    """The largest jump of a quantity where pieces meet."""

    value: float = Field(description="Size of the jump, [rad or m per sᵏ].")
    joint: str | None = Field(description="The joint that jumps furthest; null if none does.")
    time: float = Field(description="Time of the peak, [s].")


class ContinuityInfo(Answer):
    """Jumps where pieces meet; without joints null."""

    position: JumpInfo | None
    velocity: JumpInfo | None
    acceleration: JumpInfo | None
    jerk: JumpInfo | None


class MarginInfo(Answer):
    """Distance of the joints from their limits."""

    value: float = Field(description="Smallest distance to a limit, negative beyond, [rad or m].")
    joint: str = Field(description="The joint that comes nearest to a limit.")
    bound: Literal["lower", "upper"] = Field(description="Which of its limits.")
    time: float = Field(description="Time of the peak, [s].")


class SmallestInfo(Answer):
    """The smallest singular value of the Jacobian along the path."""

    value: float = Field(description="Its own, [m or rad] per [rad or m]: units are mixed.")
    time: float = Field(description="Time of the peak, [s].")


class TipPeaksInfo(Answer):
    """Peaks of the tip; each `ratio` is the largest relative to the limit in force there."""

    speed: TrajectoryPeakInfo
    angular_speed: TrajectoryPeakInfo
    acceleration: TrajectoryPeakInfo
    angular_acceleration: TrajectoryPeakInfo


class ReasonInfo(Answer):
    """Why a motion fails."""

    check: Check = Field(description="The limit or tolerance that is violated.")
    detail: str = Field(description="By how much, in one sentence.")
    joint: str | None = Field(description="The joint responsible; null if no single joint is.")
    time: float = Field(description="Time of the peak, [s].")


class WayErrorInfo(Answer):
    """Difference of the joints' peak ratios from those of the exact tip path with the same time law.

    Each may be larger or smaller by at most this; null where it is unknown: where joints are damped and leave the path,
    and in singularities. The k of `timing` has the same accuracy.
    """

    velocity: float | None = Field(description="Of `velocity`'s ratio, no unit.")
    acceleration: float | None = Field(description="Of `acceleration`'s ratio.")
    jerk: float | None = Field(description="Of `jerk`'s ratio.")


class AuditInfo(Answer):
    """The check of the motion, also between samples, by code independent of the planner.

    A ratio is relative to the limit in force at the time.
    """

    passed: bool = Field(
        description="Whether the motion keeps every limit and tolerance; one that does not is not sent."
    )
    velocity: TrajectoryPeakInfo | None = Field(description="Of the joint nearest to its limit; null without joints.")
    acceleration: TrajectoryPeakInfo | None
    jerk: TrajectoryPeakInfo | None = Field(
        description="Of the pieces: where the acceleration jumps it is infinite, as `continuity` reports. Its limits "
        "are kept by `quintic`, `septic` and `jerk_limited`; another law is only compared with them, and `notes` of "
        "its segment say where it goes beyond."
    )
    way_error: WayErrorInfo | None = Field(
        description="Difference of these three from those of the exact tip path; null without one."
    )
    path_deviation: TrajectoryPeakInfo | None = Field(
        description="Distance from the tip's path, [m]; null without one."
    )
    orientation_deviation: TrajectoryPeakInfo | None = Field(
        description="Angle from the tip's path, [rad]; null without one."
    )
    continuity: ContinuityInfo
    min_singular_value: SmallestInfo | None = Field(description="Null without joints.")
    limit_margin: MarginInfo | None = Field(description="Null where no joint has limits.")
    ends: dict[str, float] = Field(
        description="By name, how far a position, velocity or acceleration at the start or the end is from its "
        "required value, [rad or m per sᵏ]."
    )
    tip: TipPeaksInfo
    certificate: PoseCertificate = Field(description="Of poses along the motion, recomputed through Pinocchio.")
    reasons: list[ReasonInfo] = Field(description="Why the motion fails the audit.")


class TimingInfo(Answer):
    """Two timings of one path."""

    segments: list[int] = Field(description="Indices of the segments, from 0; several if they are blended.")
    law: Law = Field(description="The law that is scaled uniformly.")
    uniform_duration: float = Field(description="The law, scaled so that some limit is just reached, [s].")
    velocity_factor: float = Field(
        description="k_vel, the largest ratio of a velocity to its limit if the law lasts 1 s; no unit."
    )
    acceleration_factor: float = Field(
        description="k_acc, likewise of accelerations; no unit. The law's duration is the larger one of k_vel and "
        "√k_acc in seconds, longer where the limits of jerk ask for it."
    )
    time_optimal_duration: float = Field(description="Of the fastest motion along the same path, [s].")


class TrajectoryAnswer(Answer):
    """A motion, sampled; samples are k · sample_period and the end."""

    joint_names: list[str] = Field(description="The chain's joints in the order of a configuration.")
    base_frame: str = Field(description="Frame in which poses are expressed.")
    tip_frame: str = Field(description="Frame whose poses they are.")
    duration: float = Field(description="Duration of the completed part of the motion, [s].")
    completed_fraction: float = Field(
        description="Completed fraction of the segments, each weighted equally, 0 to 1; no unit."
    )
    failure: FailureInfo | None = Field(description="Why it is not 1.")
    times: list[float] = Field(description="Of the samples, [s].")
    joint_positions: list[list[float]] = Field(description="One row per sample, [rad or m].")
    joint_velocities: list[list[float]] = Field(description="One row per sample, [rad/s or m/s].")
    joint_accelerations: list[list[float]] = Field(
        description="One row per sample, [rad/s² or m/s²]; where they jump, those after the jump."
    )
    tip_poses: list[Pose] | None = Field(description="T_base_tip at each sample; null if not requested.")
    segments: list[TrajectorySegmentInfo] = Field(description="The segments completed, wholly or in part.")
    audit: AuditInfo
    timing: list[TimingInfo] | None = Field(default=None, description="If `compare_timing` was requested.")
    limits: MotionLimitsInfo = Field(description="Of the trajectory; each segment has its own.")
    limit_sources: LimitSourcesInfo
    notes: list[str] = Field(description="What was assumed.")
    certificate: PoseCertificate | None = Field(
        description="Of `tip_poses`, a sample of them recomputed through Pinocchio; null without them."
    )
