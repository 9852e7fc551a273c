"""Manipulability: request, answer, operation."""

from typing import Annotated, Literal

from pydantic import Field

from gelenk.contract.common import Answer, ChainOptions, Payload, optional
from gelenk.contract.endpoint import RobotEndpoint
from gelenk.contract.kinematics import AboutChain, Configuration
from gelenk.contract.options import (
    BatchRequest,
    Directions,
    Fraction,
    Positive,
    RespectLimits,
    WithSteps,
    WorkedSolutions,
)
from gelenk.ik.search.words import DIRECTIONS, Direction
from gelenk.kinematics.judge.words import EllipsoidCertificate

MAX_DETAILED = 10_000
"""Maximum number of configurations of an answer in JSON; as npy there may be more."""
MAX_WITH_POLYTOPES = 1000
"""Maximum number of configurations of a call that asks for polytopes."""
MAX_DIRECTIONS = 64

Vector = Annotated[list[float], Field(min_length=3, max_length=3)]


class ManipulabilityOptions(ChainOptions, WithSteps):
    """Options of the ellipsoids and polytopes."""

    task: Directions = Field(
        default=list(DIRECTIONS),
        description="The directions of the tip that count, rows of the Jacobian in `reference`; all six if left out.",
        examples=[["x", "y"]],
    )
    reference: Literal["local_world_aligned", "local"] = Field(
        default="local_world_aligned",
        description="Axes of all vectors, including `task` and `directions`. `local_world_aligned`: the "
        "base's (the course's). `local`: the tip's, which is what an `ik` task that leaves a turn about the tool free "
        "is about; an image has the base's only.",
    )
    characteristic_length: Positive | None = optional(
        "Length L that converts radians to metres, [m]: it adds the combined ellipsoid of (v, L ω) and (F, M / L). "
        "Without it translation and rotation are never mixed."
    )
    rank_tolerance: Fraction = Field(
        default=1e-10,
        description="A semi-axis of the velocity ellipsoid vanishes where it is no longer than this times the longest, "
        "or than the rounding of the whole Jacobian; no unit.",
    )
    gradient: bool = Field(default=False, description="Whether to compute the gradient of Yoshikawa's measure.")
    polytopes: bool = Field(
        default=False,
        description="Whether to compute velocities and forces within the limits of each joint too: in the "
        "`directions`, or along x, y and z where none are given.",
    )
    respect_limits: RespectLimits = False


class RateAndEffortLimits(Payload):
    """Limits of the chain's joints instead of those in the robot's description; each number is positive."""

    joint_velocity: Configuration | None = optional("Largest joint velocities, base to tip or by name, [rad/s or m/s].")
    joint_effort: Configuration | None = optional(
        "Largest joint torques or forces, base to tip or by name, [N m or N]."
    )


class ManipulabilityRequest(BatchRequest, ManipulabilityOptions):
    """Manipulability at a batch of configurations."""

    directions: list[Vector] | None = optional(
        "Vectors in the axes of `reference` along which to compute transmission ratios; only the direction counts, "
        "their length has no unit.",
        min_length=1,
        max_length=MAX_DIRECTIONS,
        examples=[[[1.0, 0.0, 0.0]]],
    )
    limits: RateAndEffortLimits | None = optional("For `polytopes`: limits other than the robot's own.")


class SpaceInfo(Answer):
    """The directions of one part in which the chain moves at all, and the units of its numbers."""

    part: Literal["translation", "rotation", "combined"] = Field(
        description="Of the motion that the ellipsoid is about."
    )
    dimension: int = Field(
        description="Axes of its ellipsoids: the rank of these rows of the Jacobian at almost every configuration."
    )
    basis: list[list[float]] = Field(
        description="Orthonormal vectors in the axes of `reference` that span the motion of all configurations "
        "together; two of a planar arm; no unit. More than `dimension` where the tip keeps to a surface that is not "
        "flat. In the combined part: six numbers, (v, L ω)."
    )
    velocity_unit: str = Field(description="Of the semi-axes of velocity ellipsoids.")
    force_unit: str = Field(description="Of the semi-axes of force ellipsoids.")
    measure_unit: str = Field(description="Of measure and volume.")


class EllipsoidInfo(Answer):
    """An ellipsoid by its principal axes."""

    axes: list[list[float]] = Field(
        description="Unit vectors in the axes of `reference`, orthogonal to each other, the largest component of each "
        "positive; no unit. The same for velocity and force. Three numbers each, of the combined part six."
    )
    semi_axes: list[float | None] = Field(
        description="One per axis, in their order; unit: see `spaces`. Velocity: σ_i, largest first, 0 where the "
        "direction is lost. Force: 1/σ_i, null where unbounded, because such a force needs no joint torque."
    )
    unbounded: list[bool] = Field(description="Which semi-axes are unbounded: never those of a velocity.")


class Along(Answer):
    """Something along a direction."""

    direction: list[float] = Field(description="The direction as a unit vector in the axes of `reference`; no unit.")


class Transmission(Along):
    """How far the ellipsoids reach along one direction; null where the direction is not in the task."""

    velocity: float | None = Field(
        description="[uᵀ(JJᵀ)#u]^(-½): the largest velocity along u alone of joint velocities of norm one; 0 where the "
        "tip cannot move along u alone; unit: `velocity_unit`."
    )
    force: float | None = Field(
        description="[uᵀJJᵀu]^(-½): the largest force along u alone that joint torques of norm one balance; null where "
        "unbounded; unit: `force_unit`."
    )
    force_unbounded: bool = Field(description="Whether a force along u needs no joint torque.")


class VelocityLimit(Along):
    """Velocities along one direction with every joint within its velocity limit."""

    alone: float = Field(
        description="Largest velocity along it with no other component of this part: where the ray leaves the "
        "polytope, [m/s or rad/s]."
    )
    component: float = Field(
        description="Largest component along it whatever the others are: the support function, [m/s or rad/s]."
    )


class ForceLimit(Along):
    """Forces along one direction with every joint within its effort limit; null where unbounded."""

    alone: float | None = Field(
        description="Largest force along it with no other component of this part: where the ray leaves the polytope, "
        "[N or N m]."
    )
    component: float | None = Field(
        description="Largest component along it whatever the others are: the support function, [N or N m]."
    )


class VelocityPolytope(Answer):
    """{J q̇ : |q̇_i| ≤ q̇max_i}, a zonotope."""

    along: list[VelocityLimit] = Field(description="One entry per direction in the task.")
    vertices: list[list[float]] | None = Field(
        description="Where all motion lies in one plane: its vertices in order, in the axes of `reference`, "
        "[m/s or rad/s]; else null."
    )


class ForcePolytope(Answer):
    """{F : |J_iᵀF| ≤ τmax_i}: what the joints can bear."""

    along: list[ForceLimit] = Field(description="One entry per direction in the task.")
    vertices: list[list[float]] | None = Field(
        description="Where all motion lies in one plane and the polytope is bounded in it: its vertices in order, in "
        "the axes of `reference`, [N or N m]; else null."
    )


class PartInfo(Answer):
    """Translation or rotation at one configuration, or both combined by a characteristic length."""

    rank: int = Field(description="Number of axes of the velocity ellipsoid that do not vanish.")
    singular: bool = Field(description="Whether one vanishes that the chain has elsewhere.")
    velocity_ellipsoid: EllipsoidInfo = Field(description="vᵀ(JJᵀ)#v = 1.")
    force_ellipsoid: EllipsoidInfo = Field(description="FᵀJJᵀF = 1.")
    measure: float | None = Field(
        description="Yoshikawa's measure, the product of the velocity semi-axes, √det(JJᵀ); unit: `measure_unit`; null "
        "where the chain never moves in this part."
    )
    volume: float | None = Field(
        description="Volume of the velocity ellipsoid, area of an ellipse, length of a segment; unit: `measure_unit`; "
        "null as `measure`."
    )
    condition_number: float | None = Field(
        description="Longest over shortest velocity semi-axis; no unit; null where one vanishes."
    )
    isotropy: float | None = Field(
        description="Shortest over longest velocity semi-axis, 0 where one vanishes; no unit; null where all do."
    )
    gradient: list[float] | None = optional(
        "∂w/∂q_j of `measure`, if requested; `measure_unit` per [rad or m]; null where the measure vanishes: it has a "
        "kink there."
    )
    transmission: list[Transmission] | None = optional("Where `directions` were given.")
    velocity_polytope: VelocityPolytope | None = optional("If requested and all joints have a velocity limit.")
    force_polytope: ForcePolytope | None = optional("If requested and all joints have an effort limit.")


class ManipulabilityInfo(Answer):
    """Manipulability at one configuration, by part; null where the task has no direction of the part."""

    translation: PartInfo | None
    rotation: PartInfo | None
    combined: PartInfo | None = Field(description="Where a characteristic length was given.")


class ManipulabilityAnswer(AboutChain):
    """Manipulability, one entry per configuration, in order."""

    base_frame: str = Field(description="Frame against which the tip moves.")
    tip_frame: str = Field(description="Frame whose motion it is.")
    reference: Literal["local_world_aligned", "local"] = Field(
        description="Axes of all vectors: the base's, or the tip's."
    )
    task: list[Direction] = Field(description="The directions that count, in the order as given.")
    rank_tolerance: float = Field(description="Relative to the longest semi-axis; no unit.")
    characteristic_length: float | None = Field(description="Of the combined part, [m].")
    spaces: list[SpaceInfo] = Field(description="For each part that exists.")
    joints_without_velocity_limit: list[str] | None = optional(
        "If polytopes were requested: joints without a velocity limit; then there is none."
    )
    joints_without_effort_limit: list[str] | None = optional(
        "If polytopes were requested: joints without an effort limit; then there is none."
    )
    results: list[ManipulabilityInfo]
    steps: WorkedSolutions = None
    certificate: EllipsoidCertificate


ENDPOINT = RobotEndpoint(
    name="manipulability",
    request=ManipulabilityRequest,
    answer=ManipulabilityAnswer,
    summary="Manipulability",
    description="""
    The manipulability ellipsoids of the tip at each configuration, of velocity and of force, and their measures.

    Joint velocities of norm one move the tip within the velocity ellipsoid, with semi-axes σ_i of the Jacobian;
    joint torques of norm one balance the forces within the force ellipsoid. The lecture notes call the two
    orthogonal: they have the *same* principal axes, and reciprocal semi-axes σ_i and 1/σ_i, so that the tip is
    strong where it is slow. Translation and rotation are separate, because metres and radians have no common norm,
    unless a `characteristic_length` is given. Where turning and sliding joints are mixed, the norm of the joint
    velocities mixes their units.

    Directions in which the chain never moves do not count: a planar arm has an ellipse, and Yoshikawa's measure
    of two links is l₁ l₂ |sin q₂|. At a singularity a semi-axis of the velocity is 0 and that of the force null:
    it is unbounded.

    `polytopes` replaces the norm by the limits of each joint. With `Accept: image/svg+xml`, `image/png` or
    `application/pdf` one configuration is drawn: the arm and the ellipses of translation at its tip, a planar arm
    in its plane, any other in three projections; of several configurations, the postures along a motion with their
    velocity ellipses, of an arm in space in one projection. `directions` are arrows there, and `polytopes`
    outlines, of a translation in a plane alone. Jacobians are recomputed through Pinocchio before anything is sent
    (a sample of a large batch), and the ellipsoids are put together again and compared with JJᵀ.
    """,
    options=ManipulabilityOptions,
    npy_answer="Semi-axes of the velocity ellipsoids as one array of shape (N, k): those of the translation, "
    "largest first, then those of the rotation, then those of the combined part; as many of each as the chain has "
    "at almost every configuration.",
    picture="The arm at one configuration with the velocity and the force ellipse of its tip's translation; "
    "the scales are beside it. At several: its postures, each with its velocity ellipse.",
    example={
        "joint_positions": [[0.0, -0.785, 0.0, -2.356, 0.0, 1.571, 0.785]],
        "directions": [[1.0, 0.0, 0.0], [0.0, 0.0, 1.0]],
        "polytopes": True,
    },
)
