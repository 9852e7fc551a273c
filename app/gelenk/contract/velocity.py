"""Velocity kinematics, forward and inverse: request, answer, operation."""

from typing import Annotated, Any, Literal

from pydantic import Discriminator, Field, Tag, model_validator

from gelenk.collision.contact.words import GradientCertificate
from gelenk.contract.collisions import ContactPair
from gelenk.contract.common import Answer, ChainOptions, OnTheWire, Payload, Vectors, optional
from gelenk.contract.endpoint import RobotEndpoint
from gelenk.contract.kinematics import MAX_CONFIGURATIONS, AboutChain, Configuration, Configurations, Matrix
from gelenk.contract.options import (
    BatchRequest,
    Directions,
    Positive,
    RankTolerance,
    RespectLimits,
    WithSteps,
    WorkedSolutions,
)
from gelenk.contract.scene import InCell
from gelenk.contract.singularities import SingularityInfo
from gelenk.course.velocity.inverses import Derivation
from gelenk.ik.search.words import Direction, SelfMotionObjective
from gelenk.kinematics.judge.words import Reference, TipMotionCertificate
from gelenk.kinematics.velocity.words import ExceededLimit, InverseName, InverseStatus

MAX_MAGNITUDE = 1e6
"""Largest entry of a twist, or of a derivative of one."""
MAX_REPORTS = 1000
"""Maximum number of whole singularity reports in an answer."""


def _kind(value: Any) -> str:
    """Distinguish a word from a number: a query has words alone, some of them numbers."""
    return "<word>" if isinstance(value, str) and not value.strip("-+").startswith(tuple("0123456789.")) else "<number>"


_Entry = Annotated[float, Field(ge=-MAX_MAGNITUDE, le=MAX_MAGNITUDE)]
_Vectors = Annotated[
    Vectors,
    OnTheWire(
        Annotated[
            list[Annotated[list[_Entry], Field(min_length=1, max_length=6, fail_fast=True)]],
            Field(max_length=MAX_CONFIGURATIONS, fail_fast=True),
        ]
    ),
]
Damping = Annotated[
    Annotated[Annotated[float, Field(ge=0, le=1e6)], Tag("<number>")] | Annotated[Literal["adaptive"], Tag("<word>")],
    Discriminator(_kind),
]

_SIX = "Each as many numbers as `task` names directions, in its order, or six, linear before angular."


class NullSpace(Payload):
    """A motion of the joints whose part that leaves the tip at rest, (I - J#J) ξ, is added."""

    joint_velocities: Configurations | None = optional(
        "ξ, with `twists`: a list of one configuration for all entries, or of one each; [rad/s or m/s]."
    )
    joint_accelerations: Configurations | None = optional("ξ, with `tip_accelerations`, likewise; [rad/s² or m/s²].")
    objective: SelfMotionObjective | None = optional(
        "With `twists`: ξ is `gain` times the direction in which an objective improves fastest: to come nearer to "
        "`posture` (the objective is ½‖q - posture‖²) or mid-range (½Σ((q - mid)/range)²), to keep away from limits "
        "(¼Σ range²/((upper - q)(q - lower)), pushing no harder in the last twentieth of a range), to be more "
        "manipulable (the logarithm of √det JJᵀ of the directions that count), or to get away from what is nearest "
        "(`clearance`, with a `scene` or `min_clearance`: the distance of the nearest pair)."
    )
    gain: float = Field(default=1.0, gt=0, le=1000, description="Of the objective's gradient, [1/s].")
    posture: Configuration | None = optional("For the objective `posture`, [rad or m].")

    @model_validator(mode="after")
    def _one_motion(self) -> "NullSpace":
        given = [self.joint_velocities, self.joint_accelerations, self.objective]
        if sum(motion is not None for motion in given) != 1:
            raise ValueError("exactly one of `joint_velocities`, `joint_accelerations` and `objective`")
        if self.objective is None and "gain" in self.model_fields_set:
            raise ValueError("`gain`: only allowed with an `objective`")
        if (self.posture is not None) != (self.objective == "posture"):
            raise ValueError("`posture` and the objective of that name need each other")
        return self


class VelocityOptions(ChainOptions, WithSteps):
    """Options of velocity kinematics."""

    reference: Reference = Field(
        default="local_world_aligned",
        description="Of all vectors of the tip. `local_world_aligned`: derivatives of the tip's position, and of its "
        "angular velocity, along the base's axes (the course's). `local`: the same vectors along the tip's axes. "
        "`world`: along the base's axes, the linear part that of the point of the tip's body that passes the base's "
        "origin (the spatial twist).",
    )
    task: Directions | None = optional(
        "The directions that count, rows of the Jacobian in `reference`, in the order as given; all six if left out. "
        "An arm with fewer joints than directions leaves a residual.",
        examples=[["x", "y"]],
    )
    inverse: InverseName = Field(
        default="pseudo_inverse",
        description="`exact`: J⁻¹, of as many joints as directions. `pseudo_inverse`: the smallest joint velocities of "
        "those with the smallest residual. `damped`: λ q̇ᵀWq̇ + ‖Jq̇ - v‖² is minimal.",
    )
    damping: Damping | None = optional(
        "λ of `damped`, q̇ = Jᵀ(JJᵀ + λI)⁻¹v, where others write λ²; no unit of its own, metres and radians are mixed. "
        "`adaptive`, the default: max(0, σ₀² - σ_min²), σ₀ being `damping_threshold`, and of `twists` so much more "
        "that no joint exceeds its velocity limit."
    )
    damping_threshold: float | None = optional(
        "σ₀ of the adaptive damping, [m or rad] per [rad or m]: where the smallest singular value is less, damping "
        "sets in, and no gain exceeds 1/σ₀; 0.05 if left out.",
        gt=0,
        le=1e3,
    )
    rank_tolerance: RankTolerance = 1e-10
    characteristic_length: Positive | None = optional(
        "Length that a radian counts as, [m]: angular rows are multiplied by it before inversion. If left out, metres "
        "and radians are mixed: what the least residual is and what is near to a singularity depends on the unit of "
        "length."
    )
    jacobian_derivatives: bool = Field(
        default=False, description="Whether to include J and as many of J̇, J̈, J⃛ as the given rates determine."
    )
    singularity_reports: bool = Field(
        default=False,
        description="Whether each entry also has the whole report of what is lost, which joints are dependent and "
        f"which motions are internal; of at most {MAX_REPORTS} configurations. It is of the same rows.",
    )
    respect_limits: RespectLimits = False


class VelocityRequest(BatchRequest, VelocityOptions, InCell):
    """Motion of the tip (`joint_velocities` given), or of the joints (`twists`, `tip_accelerations`, `tip_jerks`)."""

    joint_velocities: Configurations | None = optional("q̇, one entry per configuration, [rad/s or m/s].")
    joint_accelerations: Configurations | None = optional("q̈, beside `joint_velocities`, [rad/s² or m/s²].")
    joint_jerks: Configurations | None = optional("Third derivative of q, beside those before it, [rad/s³ or m/s³].")
    joint_snaps: Configurations | None = optional("Fourth derivative of q, beside those before it, [rad/s⁴ or m/s⁴].")
    twists: _Vectors | None = Field(
        default=None, description=f"v, to be inverted: one entry per configuration, [m/s, rad/s]. {_SIX}"
    )
    tip_accelerations: _Vectors | None = Field(
        default=None,
        description="Classical accelerations (p̈; ω̇), to be inverted at given `joint_velocities`: "
        f"q̈ = J#(r̈ - J̇q̇), [m/s², rad/s²]. {_SIX}",
    )
    tip_jerks: _Vectors | None = Field(
        default=None,
        description="Jerks, to be inverted at given `joint_velocities` and `joint_accelerations`: "
        f"J#(jerk - 2J̇q̈ - J̈q̇), [m/s³, rad/s³]. {_SIX}",
    )
    weights: Configuration | None = optional(
        "Diagonal of W, one positive number per joint, between 1e-6 and 1e6, no unit: a joint of larger weight moves "
        "less. The pseudo-inverse is W⁻¹Jᵀ(JW⁻¹Jᵀ)⁻¹."
    )
    null_space: NullSpace | None = optional("How to use a redundant arm's freedom; with `pseudo_inverse` and `damped`.")


class VelocitySingularity(Answer):
    """Nearness to a singularity, in the directions that count.

    Everything refers to the matrix that is inverted: angular rows are multiplied by `characteristic_length`, columns
    divided by √weights.
    """

    singular: bool = Field(description="Whether the rank is less than at random configurations.")
    rank: int = Field(description="Singular values that count, see `rank_tolerance`.")
    structural_rank: int = Field(description="The same at random configurations.")
    singular_values: list[float] = Field(
        description="Largest first, [m or rad] per [rad or m]; units are mixed without a length."
    )
    condition_number: float | None = Field(
        description="Largest over smallest singular value; no unit; null where the rank is less than both numbers of "
        "rows and of columns."
    )
    lost_directions: list[list[float]] = Field(
        description="Unit vectors, in the directions that count, along which the tip cannot move here; linear entries "
        "are [m/s], angular ones [rad/s]."
    )


class ClearanceRate(Answer):
    """How near the robot is to itself and its surroundings, and how its joints change that."""

    value: float | None = Field(
        description="Smallest distance of all pairs, less the clearance that an object demands, [m]; in contact "
        "negative. Null if nothing can touch anything."
    )
    in_collision: bool = Field(description="Whether it is at most `min_clearance`.")
    pair: ContactPair | None = Field(description="The nearest pair, in contact the deepest; null if there is none.")
    gradient: list[float] = Field(
        description="Of the clearance by each joint, nᵀ(J_a - J_b), [m/rad] or no unit: n is the unit vector from b "
        "to a, J_a and J_b are the Jacobians of the nearest points. One of several where several pairs of points are "
        "equally near."
    )
    rate: float = Field(description="Of the clearance at these joint velocities, [m/s]: negative if it falls.")


class VelocityResult(Answer):
    """The result at one configuration."""

    status: InverseStatus | None = optional(
        "Of an inversion. `solved`: the residual vanishes. `approximate`: it does not. `singular`: `exact` was "
        "requested and the Jacobian has no inverse, so there is no answer."
    )
    reason: str | None = optional("Why it is not solved.")
    residual: list[float] | None = optional(
        "Requested motion minus the tip's motion, v - Jq̇, in the directions that count; [m/s, rad/s], of "
        "accelerations [m/s², rad/s²], of jerks [m/s³, rad/s³]."
    )
    residual_linear: float | None = optional("Its length, linear part, [m/s], [m/s²] or [m/s³].")
    residual_angular: float | None = optional("Its length, angular part, [rad/s], [rad/s²] or [rad/s³].")
    damping: float | None = optional("λ that was used; 0 without damping; metres and radians mixed.")
    null_space_share: float | None = optional(
        "With `null_space`: fraction of that motion that fits within the velocity limits, which the adaptive damping "
        "keeps; from 0 to 1, no unit."
    )
    velocity_limits_exceeded: list[ExceededLimit] = Field(
        description="Joints whose velocity, given or found, exceeds the limit of the description."
    )
    clearance: ClearanceRate | None = optional("With `scene` or `min_clearance`.")
    singularity: VelocitySingularity
    singularity_report: SingularityInfo | None = optional("If requested.")
    derivation: Derivation | None = optional("With `steps`, of an inversion: the matrices that the steps arrive at.")


_Rows = list[list[float]]
_Solutions = list[list[float] | None]


class VelocityAnswer(AboutChain):
    """The requested motion, one entry per configuration, in order; what was not requested is left out."""

    reference: Reference = Field(description="As requested.")
    task: list[Direction] = Field(description="The directions that count, in the order of a residual.")
    rank_tolerance: float = Field(description="Relative to the largest singular value; no unit.")
    twists: _Rows | None = optional("Jq̇, (ṗ; ω), [m/s, rad/s].")
    accelerations: _Rows | None = optional("Classical: Jq̈ + J̇q̇ = (p̈; ω̇), p the tip's position, [m/s², rad/s²].")
    spatial_accelerations: _Rows | None = optional(
        "Pinocchio's: the derivative of the twist's coordinates in the tip's axes, turned to `reference`; in "
        "`local_world_aligned` (p̈ - ω × ṗ; ω̇), [m/s², rad/s²]."
    )
    jerks: _Rows | None = optional(
        "J q⃛ + 2 J̇ q̈ + J̈ q̇: third derivative of the tip's position, second of ω, [m/s³, rad/s³]."
    )
    snaps: _Rows | None = optional(
        "J q⁗ + 3 J̇ q⃛ + 3 J̈ q̈ + J⃛ q̇: fourth derivative of the tip's position, third of ω, [m/s⁴, rad/s⁴]."
    )
    joint_velocities: _Solutions | None = optional("Of `twists`, [rad/s or m/s]; null where `exact` has no answer.")
    joint_accelerations: _Solutions | None = optional("Of `tip_accelerations`, likewise, [rad/s² or m/s²].")
    joint_jerks: _Solutions | None = optional("Of `tip_jerks`, likewise, [rad/s³ or m/s³].")
    jacobian_derivatives: list[list[Matrix]] | None = optional(
        "If requested: J, J̇, J̈, J⃛ of `local_world_aligned`, 6 rows and n columns each, one fewer than rates are "
        "given or found; [m or rad] per [rad or m], and per s, s², s³."
    )
    results: list[VelocityResult]
    steps: WorkedSolutions = None
    root_frame: str | None = optional("With `scene` or `min_clearance`: frame of the scene and of points of pairs.")
    warnings: list[str] | None = optional(
        "Likewise: what has no body, or one not meant for this, and what counts as larger than it is, by how much."
    )
    clearance_certificate: GradientCertificate | None = optional("Likewise, of the clearances.")
    certificate: TipMotionCertificate


ENDPOINT = RobotEndpoint(
    name="velocity",
    request=VelocityRequest,
    answer=VelocityAnswer,
    summary="Velocity kinematics",
    description="""
    How the tip moves when the joints do, and how the joints must move for the tip.

    **Forward**, `joint_velocities` given: the twist v = J q̇; with `joint_accelerations` the acceleration
    J q̈ + J̇ q̇, both the classical one (p̈; ω̇) and Pinocchio's spatial one; with `joint_jerks` and `joint_snaps`
    the jerk J q⃛ + 2 J̇ q̈ + J̈ q̇ and the snap J q⁗ + 3 J̇ q⃛ + 3 J̈ q̈ + J⃛ q̇, with exact J̇, J̈, J⃛. The
    lecture notes have the jerk without the factor 2, which is an error; so is d²s/ds² for d²p/ds² in their p̈ =
    d²p/ds² ṡ² + dp/ds s̈. They say that the planar arm's 6×2 Jacobian has a rank between 1 and 2: it is 2 always,
    and the 2×2 block of v_x, v_y loses rank at q₂ = 0 and π, which `"task": ["x", "y"]` shows.

    **Inverse**, `twists` given: q̇ = J⁻¹v, the Moore-Penrose pseudo-inverse J#v by singular values, or damped least
    squares min λ‖q̇‖² + ‖Jq̇ - v‖² with fixed λ (the course's λ, elsewhere written λ²) or one that follows the
    smallest singular value and the velocity limits; joints weighted on request, and a motion (I - J#J) ξ in the null
    space added. `tip_accelerations` and `tip_jerks` are inverted likewise, less what the given rates already make.
    Each entry has its residual, the joints that are too fast, and how near the configuration is to a singularity;
    with a `scene` or `min_clearance` also the clearance, its gradient, and how fast it changes, joints off the chain
    being where `other_joints` says.
    Where metres and radians are mixed, J#, damping and condition number depend on the unit of length: choose a `task`
    of one kind, or give a `characteristic_length`.

    The tip's motion is recomputed through Pinocchio before it is sent (a sample of a large batch), of an inversion
    that which the found rates make.
    """,
    options=VelocityOptions,
    npy_holds_more=True,
    npy_body="Forward: an array of shape (N, k, n) with 2 ≤ k ≤ 5, of each configuration the joint positions, "
    "velocities, accelerations, jerks and snaps, as far as k goes.",
    npy_answer="Forward: twists as an array of shape (N, 6), or with higher derivatives (N, k, 6). Inverse: the "
    "joint velocities (accelerations, jerks) as an array of shape (N, n), rows without an answer zero; the header "
    "`Gelenk-Unsolved` counts those and `Gelenk-Unsolved-Rows` gives the first 200 of them.",
    example={
        "joint_positions": [[0.0, -0.785, 0.0, -2.356, 0.0, 1.571, 0.785]],
        "twists": [[0.1, 0.0, -0.05, 0.0, 0.0, 0.2]],
        "inverse": "damped",
        "damping": "adaptive",
        "null_space": {"objective": "mid_range", "gain": 0.5},
    },
)
