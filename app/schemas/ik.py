"""Requests and answers of inverse kinematics."""

from collections.abc import Sequence
from typing import Annotated, Literal

from pydantic import Field

from app.kinematics.ik.words import Direction, ObjectiveName, Status, StopReason
from app.model.arrays import Array
from app.schemas.common import Answer, ChainOptions, OnTheWire
from app.schemas.kinematics import Configuration, Configurations
from app.schemas.pose import Pose, PoseFormat, pose_fields

MAX_TARGETS = 1_000_000
MAX_STEPWISE = 1000
"""Targets of a call that follows a method step by step, in Python."""

MAX_TRACE = 1000
"""Configurations of a trace that are told; of a longer one some, evenly."""

MAX_JOB_TARGETS = 4_000_000
MAX_JOB_STEPWISE = 100_000
"""The same of a call that is answered by a job."""

Targets = Annotated[
    Sequence[Pose] | Array,
    OnTheWire(Annotated[list[Pose], Field(max_length=MAX_TARGETS, fail_fast=True)], pose_fields),
    Field(description="Poses of `tip_frame` in `base_frame` that are to be reached."),
]

Method = Literal["auto", "analytic", "newton", "gradient", "gradient_then_newton", "damped_least_squares"]


class InverseOptions(ChainOptions):
    """How inverse kinematics are wanted."""

    list_fields = frozenset({"task"})

    method: Method = Field(
        default="auto",
        description="`auto`: the closed form where the chain has one, else many starts of damped least squares, the "
        "first at the seed, the others random. `analytic`: the closed form, or for six turning joints without one an "
        "elimination; 422 where neither is known. The "
        "course's methods start at the seed alone: `newton` (the pseudo-inverse where J is not square), `gradient`, "
        "`gradient_then_newton`, `damped_least_squares`.",
    )
    solutions: Literal["one", "all"] = Field(
        default="one",
        description="`all`: every distinct solution, nearest to the seed first; of a redundant arm a sample of its "
        "self-motion, no two nearer than 0.2 rad (or m) in every joint.",
    )
    position_tolerance: float = Field(
        default=1e-6, ge=1e-12, le=1.0, description="How far a solution may be from the target's position, [m]."
    )
    orientation_tolerance: float = Field(
        default=1e-6,
        ge=1e-12,
        le=1.0,
        description="By what angle a solution may be turned from the target's orientation, [rad].",
    )
    task: list[Direction] | None = Field(
        default=None,
        min_length=1,
        max_length=6,
        description="The directions that count; all six if left out. `x y z` along the base's axes, `rx ry rz` about "
        "the target's: with two rotations the tip's axis of the third points as the target's does, so that "
        "`x y z rx ry` is a position and an approach axis.",
        examples=[["x", "y", "z", "rx", "ry"]],
    )
    respect_limits: bool = Field(default=True, description="Whether solutions are to be within the joint limits.")
    max_iterations: int | None = Field(
        default=None,
        ge=1,
        le=1_000_000,
        description="Budget for each target: with `auto` a start for every 20 (20000 if left out), not used with "
        "`solutions: all`; else the steps of the one start (if left out 100 with `newton`, 500 with "
        "`damped_least_squares`, 5000 with the two others).",
    )
    time_limit: float | None = Field(
        default=None,
        gt=0,
        le=60,
        description="For the whole call, [s]; each result that it has cut short has the `stop_reason` `time_limit`. If "
        "left out each target is looked for to the end, so that the answer does not depend on how busy the machine "
        "is; a call that outlasts what any request may take is a 504, and may be asked for as a job.",
    )
    random_seed: int = Field(default=0, ge=0, lt=2**53, description="Of the starts.")
    max_solutions: int = Field(
        default=100, ge=1, le=10_000, description="Largest number of solutions of a target with `all`."
    )
    windings: bool = Field(
        default=False,
        description="With `all`: whether solutions that differ by full turns count, where limits allow them.",
    )
    objective: ObjectiveName | None = Field(
        default=None,
        description="What a redundant arm's freedom is for: to be near to `posture` (the seed if left out) or to the "
        "middle of the ranges, to keep away from the limits, or to be manipulable (√det JJᵀ). The "
        "nearest minimum along the self-motion from the solution that was found; without freedom it stays as it is.",
    )
    step_size: float | None = Field(
        default=None, gt=0, le=1e6, description="α of the gradient; if left out it is found by a line search."
    )
    damping: float | None = Field(
        default=None,
        ge=0,
        le=1e6,
        description="λ of `damped_least_squares` in Jᵀ(JJᵀ + λI)⁻¹e; if left out it follows the error.",
    )
    switch_error: float = Field(
        default=1e-2, gt=0, le=1e6, description="‖e‖ at which `gradient_then_newton` changes over, [m and rad]."
    )
    elbow_angle: float | None = Field(
        default=None,
        description="With `analytic`, of seven joints with a spherical shoulder and wrist: the angle of the elbow "
        "about the line from shoulder to wrist, from the plane of that line and the first axis, [rad]; if left out "
        "that of the seed, or another where it does not fit into the limits.",
    )
    trace: bool = Field(
        default=False,
        description="Whether each iteration is told; of `auto` those of the start that counts, and no closed form is "
        f"used then. At most {MAX_TRACE} configurations a target are told.",
    )
    pose_format: PoseFormat = Field(default="quaternion_xyzw", description="Notation of the poses in the answer.")


class InverseRequest(InverseOptions):
    """Inverse kinematics of a batch of targets."""

    targets: Targets
    seeds: Configurations | None = Field(
        default=None,
        description="Where to start, and what solutions are to be near to: a list of one configuration for all "
        "targets, or of one each, not necessarily within the limits; if left out `posture`, or the middle of the "
        "ranges.",
    )
    posture: Configuration | None = Field(default=None, description="For the objective `posture`, [rad or m].")


class SolutionInfo(Answer):
    """A configuration that brings the tip to the target."""

    joint_positions: list[float] = Field(description="In the order of `joint_names`, [rad or m].")
    position_error: float = Field(description="Distance to the target in the directions that count, [m].")
    orientation_error: float = Field(description="Angle to the target likewise, [rad].")
    method: str = Field(
        description="What found it: `analytic` (a closed form), `elimination`, or a method of iteration."
    )
    iterations: int = Field(description="Of the start that led there; 0 where many starts did, as with `all`.")
    restarts: int = Field(description="How many starts failed before.")
    branch: dict[str, str | int] | None = Field(
        description="Its branch where a closed form found it, else null: `shoulder` front or back, `elbow` up or down, "
        "`wrist` no_flip or flip, as far as the arm has that choice; `arm` counts the roots where they are those of a "
        "quartic."
    )
    free_joints: list[str] | None = Field(
        default=None,
        description="Joints that a singularity leaves free: at the seed's positions where the others can follow, else "
        "at others.",
    )
    elbow_angle: float | None = Field(
        default=None, description="Of an arm with a spherical shoulder and wrist: see the field of the request, [rad]."
    )


class NearestInfo(Answer):
    """What comes nearest to a target that is not reached.

    The best that was come by, where a metre counts as much as a radian; of `auto` from its nearest starts downhill.
    """

    joint_positions: list[float] = Field(description="In the order of `joint_names`, [rad or m].")
    pose: Pose = Field(description="T_base_tip there.")
    position_error: float = Field(description="Distance to the target in the directions that count, [m].")
    orientation_error: float = Field(description="Angle to the target likewise, [rad].")


class BlockingJointInfo(Answer):
    """A joint whose limit is in the way."""

    name: str = Field(description="Of the joint.")
    position: float = Field(description="Where it would have to be, [rad or m].")
    lower: float = Field(description="Lower limit, [rad or m].")
    upper: float = Field(description="Upper limit, [rad or m].")
    excess: float = Field(description="How far beyond the limit that is, [rad or m].")


class IterationInfo(Answer):
    """One configuration on the way of a method."""

    error: float = Field(description="‖e‖ of the directions that count: distance [m] and rotation vector [rad] mixed.")
    min_singular_value: float = Field(description="Smallest singular value of J in these directions, mixed likewise.")
    step_length: float | None = Field(description="‖Δq‖ of the step from here, [rad or m]; null at the last.")
    method: str | None = Field(description="Which step that was; null at the last.")
    joint_positions: list[float] = Field(description="The configuration itself, [rad or m].")


class InverseResult(Answer):
    """What became of one target."""

    status: Status = Field(
        description="`unreachable`: by distance alone, or none of the starts came nearer than `nearest` and nothing "
        "leads on from there. `outside_limits`: it would be solved without limits. `singular`: the method came to a "
        "halt where the Jacobian loses rank. `not_converged`: the budget ran out, or a `time_limit`."
    )
    solutions: list[SolutionInfo] = Field(description="Nearest to the seed first; empty unless solved.")
    reason: str | None = Field(description="Why it is not solved.")
    nearest: NearestInfo | None = Field(default=None, description="Of an unsolved target.")
    blocking_joints: list[BlockingJointInfo] | None = Field(default=None, description="With `outside_limits`.")
    unserved_directions: list[list[float]] | None = Field(
        default=None,
        description="Of an unsolved target: unit twists in the base's axes, linear before angular, that the tip cannot "
        "follow at `nearest`.",
    )
    complete: bool | None = Field(
        default=None,
        description="With `all`: whether these are all solutions; false next to a singularity too, where rounding may "
        "cost one.",
    )
    stop_reason: StopReason | None = Field(
        default=None,
        description="Where one start was followed: why it went no further (`stagnated`: e lies in ker Jᵀ). "
        "`time_limit`: the call's ended it, before it was solved, explained or brought to its objective.",
    )
    trace: list[IterationInfo] | None = Field(
        default=None,
        description="Where asked for: every configuration on the way; of `auto` from the start that counts, or "
        "from the seed if none does. Joints that turn freely may leave their limits on the way; in the solution they "
        "are turned back.",
    )
    note: str | None = Field(default=None, description="What a long `trace` leaves out.")


class InverseAnswer(Answer):
    """Verdicts, one entry a target, in order."""

    joint_names: list[str] = Field(description="The chain's joints in the order of a configuration.")
    base_frame: str = Field(description="Frame in which the targets are expressed.")
    tip_frame: str = Field(description="Frame that is to reach them.")
    task: list[Direction] = Field(description="The directions that count.")
    closed_form: str | None = Field(description="What makes the closed form that was used; null where none was.")
    results: list[InverseResult]
