"""Inverse kinematics: request, answer, operation."""

from collections.abc import Sequence
from typing import Annotated, Literal

from pydantic import Field

from gelenk.collision.contact.words import ContactCertificate
from gelenk.contract.collisions import ContactPair
from gelenk.contract.common import Answer, ChainOptions, OnTheWire, optional
from gelenk.contract.endpoint import RobotEndpoint
from gelenk.contract.kinematics import Configuration, Configurations
from gelenk.contract.options import Directions, WithSteps
from gelenk.contract.pose import AnswerFormat, Pose, PoseLike, pose_fields
from gelenk.contract.scene import InCell
from gelenk.course.steps import Step
from gelenk.ik.search.words import (
    BlockingJoint,
    Direction,
    Family,
    Iterate,
    Method,
    SelfMotionObjective,
    Status,
    StopReason,
)
from gelenk.robot.arrays import Array

MAX_TARGETS = 1_000_000
MAX_STEPWISE = 1000
"""Maximum number of targets of a call that follows a method step by step, in Python, or with worked solutions."""

MAX_TRACE = 1000
"""Maximum number of configurations of a trace in the answer; a longer one is thinned evenly."""

MAX_JOB_TARGETS = 4_000_000
MAX_JOB_STEPWISE = 100_000
"""The same limits for a call that a job answers."""

Targets = Annotated[
    Sequence[PoseLike] | Array,
    OnTheWire(Annotated[list[Pose], Field(max_length=MAX_TARGETS, fail_fast=True)], pose_fields),
    Field(
        description="Target poses of `tip_frame` in `base_frame`; a `position` alone suffices where `task` has none of "
        "rx, ry, rz."
    ),
]


class InverseOptions(ChainOptions, InCell, WithSteps):
    """Options of inverse kinematics."""

    method: Method = Field(
        default="auto",
        description="`auto`: the closed form where the chain has one, else many starts of damped least squares, the "
        "first at the seed, the others random. `analytic`: the closed form, or for six joints without one an "
        "elimination or a continuation; 422 if none is known. The course's methods start at "
        "the seed alone: `newton` (the pseudo-inverse where J is not square), `gradient`, `gradient_then_newton`, "
        "`damped_least_squares`.",
    )
    solutions: Literal["one", "all"] = Field(
        default="one",
        description="`all`: every distinct solution, nearest to the seed first; of a redundant arm a sample of its "
        "self-motion, no two nearer than 0.2 rad (or m) in every joint.",
    )
    position_tolerance: float = Field(
        default=1e-6, ge=1e-12, le=1.0, description="Allowed distance of a solution from the target's position, [m]."
    )
    orientation_tolerance: float = Field(
        default=1e-6,
        ge=1e-12,
        le=1.0,
        description="Allowed angle between a solution and the target's orientation, [rad].",
    )
    task: Directions | None = optional(
        "The directions that count; all six if left out. `x y z` along the base's axes, `rx ry rz` about the "
        "target's: with two rotations the tip's axis of the third points as the target's does, so that `x y z rx ry` "
        "is a position and an approach axis.",
        examples=[["x", "y", "z", "rx", "ry"]],
    )
    respect_limits: bool = Field(default=True, description="Whether solutions must be within the joint limits.")
    max_iterations: int | None = optional(
        "Budget for each target: with `auto` a start for every 20 (20000 if left out), not used with `solutions: "
        "all`; else the steps of the one start (if left out 100 with `newton`, 500 with `damped_least_squares`, 5000 "
        "with the two others).",
        ge=1,
        le=1_000_000,
    )
    time_limit: float | None = optional(
        "Time limit of the whole call, [s]; each result that it cuts short has the `stop_reason` `time_limit`. If "
        "left out, each target is searched to the end, so that the answer does not depend on the machine's load; a "
        "call that exceeds the service's time limit returns 504 and can be sent as a job.",
        gt=0,
        le=60,
    )
    random_seed: int = Field(default=0, ge=0, lt=2**53, description="Random seed of the starts.")
    max_solutions: int = Field(
        default=100, ge=1, le=10_000, description="Largest number of solutions of a target with `all`."
    )
    windings: bool = Field(
        default=False,
        description="With `all`: whether solutions that differ by full turns count, where limits allow them.",
    )
    objective: SelfMotionObjective | None = optional(
        "How to use a redundant arm's freedom: to stay near `posture` (the seed if left out) or the middle of the "
        "ranges, to keep away from the limits, to be manipulable (√det JJᵀ), or to have a large `clearance` in a cell. "
        "The nearest minimum along the self-motion from the solution that was found, in a cell without contact on the "
        "way; without freedom it stays as it is."
    )
    step_size: float | None = optional("α of the gradient; if left out, a line search finds it.", gt=0, le=1e6)
    damping: float | None = optional(
        "λ of `damped_least_squares` in Jᵀ(JJᵀ + λI)⁻¹e; if left out it follows the error.", ge=0, le=1e6
    )
    switch_error: float = Field(
        default=1e-2, gt=0, le=1e6, description="‖e‖ at which `gradient_then_newton` changes over, [m and rad]."
    )
    elbow_angle: float | None = optional(
        "With `analytic`, of seven joints with a spherical shoulder and wrist: the angle of the elbow about the line "
        "from shoulder to wrist, from the plane of that line and the first axis, [rad]; if left out that of the seed, "
        "or another where it does not fit into the limits."
    )
    fixed_joints: dict[str, float] | None = optional(
        "Joints of the chain to hold, and their positions, [rad or m]: the answer is about the remaining joints, with "
        "`solutions: all` every branch of these. Seeds and postures still list all joints of the chain; values given "
        "for held joints are ignored. Not with `elbow_angle`.",
        min_length=1,
        examples=[{"panda_joint7": 0.6}],
    )
    trace: bool = Field(
        default=False,
        description="Whether to report each iteration; with `auto` those of the start that counts, and no closed form "
        f"is used then. At most {MAX_TRACE} configurations are reported per target.",
    )
    pose_format: AnswerFormat = "quaternion_xyzw"


class InverseRequest(InverseOptions):
    """Inverse kinematics of a batch of targets."""

    targets: Targets
    seeds: Configurations | None = optional(
        "Where to start, and the configurations that solutions should be near: a list of one configuration for all "
        "targets, or of one each, not necessarily within the limits; if left out `posture`, or the middle of the "
        "ranges."
    )
    posture: Configuration | None = optional("For the objective `posture`, [rad or m].")


_CLEARANCE = optional(
    "In a cell: smallest distance of all pairs, less what an object of the scene demands, [m]. Null if nothing can "
    "touch anything."
)
_PAIR = optional("In a cell: the pair that has it; in contact the deepest, else the nearest one.")


class SolutionInfo(Answer):
    """A configuration that brings the tip to the target."""

    joint_positions: list[float] = Field(description="In the order of `joint_names`, [rad or m].")
    position_error: float = Field(description="Distance to the target in the directions that count, [m].")
    orientation_error: float = Field(description="Angle to the target likewise, [rad].")
    method: str = Field(
        description="What found it: `analytic` (a closed form), `elimination`, `continuation` (all solutions of "
        "six joints followed to the target), or a method of iteration; `interpreted_least_squares` where the kernels "
        "of `auto` are still being compiled, in the first minute after an installation."
    )
    iterations: int = Field(description="Of the start that led there; 0 where many starts did, as with `all`.")
    restarts: int = Field(description="How many starts failed before.")
    branch: dict[str, str | int] | None = Field(
        description="Its branch where a closed form found it, else null: `shoulder` front or back, `elbow` up or down, "
        "`wrist` no_flip or flip, as far as the arm has that choice; `arm` counts the roots where they are those of a "
        "quartic."
    )
    free_joints: list[str] | None = optional(
        "Joints that a singularity leaves free: at the seed's positions if the others can follow, otherwise elsewhere."
    )
    elbow_angle: float | None = optional(
        "Of an arm with a spherical shoulder and wrist: see the field of the request, [rad]."
    )
    in_collision: bool | None = optional("In a cell: whether a pair is in contact; only with `all` it may be.")
    clearance: float | None = _CLEARANCE
    pair: ContactPair | None = _PAIR


class NearestInfo(Answer):
    """The configuration found nearest to a target that is not reached.

    It has the least distance² + angle² found, a metre counting as much as a radian. `auto` goes downhill from
    the best of its starts, which lie apart; a nearer one may exist. With `in_collision` it is a solution: of those
    looked at the one with the largest clearance.
    """

    joint_positions: list[float] = Field(description="In the order of `joint_names`, [rad or m].")
    pose: Pose = Field(description="T_base_tip there.")
    position_error: float = Field(description="Distance to the target in the directions that count, [m].")
    orientation_error: float = Field(description="Angle to the target likewise, [rad].")
    clearance: float | None = _CLEARANCE
    pair: ContactPair | None = _PAIR


class InverseResult(Answer):
    """The result for one target."""

    status: Status = Field(
        description="`unreachable`: by distance alone, or no start came nearer than `nearest` and nothing leads on "
        "from there. `outside_limits`: it would be solved without limits. `singular`: the method stopped where the "
        "Jacobian loses rank. `not_converged`: the budget ran out, or a `time_limit`. `in_collision`: each solution "
        "found is in contact, or nearer to it than `min_clearance`; `reason` says how many, and whether these are all."
    )
    solutions: list[SolutionInfo] = Field(
        description="Nearest to the seed first; empty unless solved. With `all` in a cell every solution, those in "
        "contact behind the others, also with `in_collision`."
    )
    reason: str | None = Field(description="Why it is not solved; or, with `all`, why there may be other solutions.")
    nearest: NearestInfo | None = optional("Of an unsolved target.")
    blocking_joints: list[BlockingJoint] | None = optional("With `outside_limits`.")
    unserved_directions: list[list[float]] | None = optional(
        "Of an unsolved target: unit twists in the base's axes, linear before angular, that the tip cannot follow at "
        "`nearest`."
    )
    complete: bool | None = optional(
        "With `all`: whether these are proved to be all solutions. False for the results of a search, and next to a "
        "singularity, where rounding may lose a solution."
    )
    families: list[Family] | None = optional(
        "With `all`, where there are infinitely many solutions: the families that `solutions` samples. Empty where "
        "none was found; at most 32."
    )
    stop_reason: StopReason | None = optional(
        "If one start was followed: why it stopped (`stagnated`: e lies in ker Jᵀ). `time_limit`: the call's time ran "
        "out before the target was solved, explained or brought to its objective."
    )
    trace: list[Iterate] | None = optional(
        "If requested: every configuration of the iteration; with `auto` from the start that counts, or from the seed "
        "if none does. Joints that turn freely may leave their limits meanwhile; in the solution they are turned back."
    )
    note: str | None = optional("What a long `trace` leaves out.")
    steps: list[Step] | None = optional(
        "If requested: the solution by hand where the arm has one, else how these numbers were found. Steps state only "
        "numbers that agree with `solutions`."
    )


class InverseAnswer(Answer):
    """Verdicts, one entry per target, in order."""

    joint_names: list[str] = Field(description="The chain's joints in the order of a configuration.")
    base_frame: str = Field(description="Frame in which the targets are expressed.")
    tip_frame: str = Field(description="Frame that should reach them.")
    task: list[Direction] = Field(description="The directions that count.")
    closed_form: str | None = Field(
        description="The geometry behind the closed form used, or the other method that solved six joints; null after "
        "a search."
    )
    warnings: list[str] | None = optional(
        "In a cell: what of the robot has no body, or not one meant for this; which objects count as larger than they "
        "are, and by how much."
    )
    certificate: ContactCertificate | None = optional("In a cell: how contacts and clearances were checked.")
    results: list[InverseResult]


ENDPOINT = RobotEndpoint(
    name="ik",
    operation_id="inverse_kinematics",
    request=InverseRequest,
    answer=InverseAnswer,
    summary="Inverse kinematics",
    description="""
    Configurations that bring the tip to each target, within the joint limits.

    `auto` takes the closed form where the geometry of the chain has one (`analytic` takes nothing else): of all
    branches within the limits the one that is nearest to the seed. Where there is none it searches from the seed
    and from a thousand random configurations, and takes the first start that reaches the target; from a seed near
    the target it stays on the seed's branch. Every solution is recomputed through Pinocchio before it is sent, and
    its errors are those of that computation. An unsolved target comes with the reason and the nearest configuration
    found. The same call gives the same answer, unless it has a `time_limit`.

    With `scene` or `min_clearance` only configurations without contact are solutions: of all branches the nearest
    to the seed, or of a redundant arm the nearest that the first successful round of starts finds, first around the
    solution in contact if the seed is near it, then everywhere, until the budget is used up. The robot must not touch
    itself either. A seed may be in contact. Joints off the chain, such as those of a gripper, stand where
    `other_joints` says, or at 0.

    Closed forms: arms whose last three axes meet in a point, or whose first three do (decoupling: the position of the
    wrist first, then the orientation by the spherical wrist; any three joints besides, turning or sliding); six
    joints with three parallel axes; positioning arms of two and three joints, with or without turns at their end
    (planar, SCARA, Cartesian, cylindrical, spherical, anthropomorphic); spherical wrists; seven joints with a
    spherical shoulder and wrist, by the angle of the elbow. Of six joints of any other geometry `analytic`, and
    `auto` where all solutions are wanted, eliminates all joints but one, or follows all solutions of another target
    to this one (continuation).
    """,
    batch="targets",
    options=InverseOptions,
    npy_body="`targets` as an array of shape (N, 7), position and quaternion x y z w, or (N, 4, 4), matrices.",
    npy_answer="One configuration per target as an array of shape (N, n): the solution, or the nearest "
    "configuration found; the header `Gelenk-Unsolved` counts the targets without a solution and "
    "`Gelenk-Unsolved-Rows` gives the first 200 of them.",
    example={
        "targets": [{"position": [0.4, 0.1, 0.5], "rpy": [3.141592653589793, 0.0, 0.0]}],
        "tip_frame": "panda_link8",
    },
    job=f"up to {MAX_JOB_TARGETS:,} targets ({MAX_JOB_STEPWISE:,} of a method in steps, or with `trace` or `steps`) "
    "and as many numbers in the answer as there is room for; `time_limit` is not allowed, as each target is searched "
    "for to the end",
)
