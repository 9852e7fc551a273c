"""Trajectories: the answer, with samples, segments and audit."""

from typing import Literal

from pydantic import Field

from gelenk.contract.common import Answer, optional
from gelenk.contract.pose import Pose
from gelenk.course.steps import Step
from gelenk.kinematics.judge.words import PoseCertificate
from gelenk.trajectory.audit.result import Audit
from gelenk.trajectory.audit.words import Law, SegmentType
from gelenk.trajectory.problem.result import Damping, PlanningFailure, SegmentBlend, TimingComparison, ToolChoice

LimitSource = Literal["request", "robot", "assumed"]


class MotionLimitsInfo(Answer):
    """Limits of the joints and the tip, with scales applied; one number per joint, base to tip."""

    joint_velocity: list[float] = Field(description="One number per joint, [rad/s or m/s].")
    joint_acceleration: list[float] = Field(description="One number per joint, [rad/s² or m/s²].")
    joint_jerk: list[float] = Field(description="One number per joint, [rad/s³ or m/s³].")
    joint_torque: list[float | None] | None = optional(
        "One number per joint, [N m or N], null for one without a limit; left out if none has one."
    )
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
    joint_deviation: Damping | None = Field(description="Deviation from the path where joints were damped.")
    limits: MotionLimitsInfo = Field(
        description="Its own, which also hold in the blends at its ends. A slow line does not slow the others."
    )
    notes: list[str] = Field(description="Further remarks.")
    polynomials: PolynomialsInfo | None = optional(
        "If `coefficients` were requested: the pieces that begin in this segment."
    )


class TrajectoryAnswer(Answer):
    """A motion, sampled; samples are k · sample_period and the end."""

    joint_names: list[str] = Field(description="The chain's joints in the order of a configuration.")
    base_frame: str = Field(description="Frame in which poses are expressed.")
    tip_frame: str = Field(description="Frame whose poses they are.")
    duration: float = Field(description="Duration of the completed part of the motion, [s].")
    completed_fraction: float = Field(
        description="Completed fraction of the segments, each weighted equally, 0 to 1; no unit."
    )
    failure: PlanningFailure | None = Field(description="Why it is not 1.")
    times: list[float] = Field(description="Of the samples, [s].")
    joint_positions: list[list[float]] = Field(description="One row per sample, [rad or m].")
    joint_velocities: list[list[float]] = Field(description="One row per sample, [rad/s or m/s].")
    joint_accelerations: list[list[float]] = Field(
        description="One row per sample, [rad/s² or m/s²]; where they jump, those after the jump."
    )
    joint_torques: list[list[float]] | None = optional(
        "If `torques` were requested: those of the motors, one row per sample, [N m or N]."
    )
    tip_poses: list[Pose] | None = Field(description="T_base_tip at each sample; null if not requested.")
    segments: list[TrajectorySegmentInfo] = Field(description="The segments completed, wholly or in part.")
    audit: Audit
    path: ToolChoice | None = optional("If a `path` was requested: turns, branches and configurations at its poses.")
    timing: list[TimingComparison] | None = optional("If `compare_timing` was requested.")
    limits: MotionLimitsInfo = Field(description="Of the trajectory; each segment has its own.")
    limit_sources: LimitSourcesInfo
    steps: list[Step] | None = optional("If requested: path, time law and corners of each segment, with their numbers.")
    notes: list[str] = Field(description="What was assumed.")
    certificate: PoseCertificate | None = Field(
        description="Of `tip_poses`, a sample of them recomputed through Pinocchio; null without them."
    )
