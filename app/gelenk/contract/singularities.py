"""Singularities: request, answer, operation."""

import math

from pydantic import Field

from gelenk.contract.common import Answer, ChainOptions, optional
from gelenk.contract.endpoint import RobotEndpoint
from gelenk.contract.kinematics import AboutChain
from gelenk.contract.options import BatchRequest, Directions, Positive, RankTolerance, WithSteps, WorkedSolutions
from gelenk.ik.search.words import Direction
from gelenk.kinematics.judge.words import Reference, SingularityCertificate
from gelenk.kinematics.velocity.words import SingularityKind

MAX_REPORTS = 2000
"""Maximum number of configurations of a call with whole reports, as JSON."""
MAX_PATH = 1000
"""Maximum number of configurations of a path."""
MAX_PLACES = 500
"""Maximum number of places of a path that are reported."""
MAX_NEAREST = 100
"""Maximum number of configurations of up to seven joints for the nearest singularity; of n joints (7/n)² as many."""


class SingularityOptions(ChainOptions, WithSteps):
    """Options of a singularity report."""

    task: Directions | None = optional(
        "The directions that count, rows of the Jacobian in `reference`; all six if left out. A planar arm loses "
        "nothing in all six: its singularities are those of `x y`.",
        examples=[["x", "y", "z"]],
    )
    reference: Reference = Field(
        default="local_world_aligned",
        description="Axes of the directions in `task`. `local_world_aligned`: along and about the base's axes, at "
        "the tip (the course's). `local`: the tip's axes, which is what an `ik` task that leaves a turn about the "
        "tool free is about. `world`: the base's axes, of the point of the tip's body that passes the base's origin. "
        "Lost directions are always given in the base's axes, at the tip.",
    )
    characteristic_length: Positive | None = optional(
        "Factor of the angular rows that makes them comparable with linear ones, [m]; if left out, metres and radians "
        "are mixed where both count."
    )
    rank_tolerance: RankTolerance = 1e-10
    respect_limits: bool = Field(
        default=False,
        description="Whether a configuration beyond the joint limits is an error, and the nearest singularity must be "
        "within them.",
    )
    nearest: bool = Field(
        default=False,
        description="Whether to search for the nearest singular configuration, about 15 ms each; for at most 100 "
        "configurations of seven joints.",
    )
    search_radius: float = Field(
        default=math.pi, gt=0, le=10, description="How far away the nearest singularity may be, ‖Δq‖, [rad and m]."
    )
    path: bool = Field(
        default=False,
        description="Whether the configurations form a path, straight in joint space from each to the next, whose "
        "singular places to find; at most 1000 of them.",
    )
    path_threshold: float = Field(
        default=0.01,
        gt=0,
        le=1,
        description="A minimum along the path is reported if the smallest singular value is at most this fraction of "
        "the largest; no unit.",
    )


class SingularityRequest(BatchRequest, SingularityOptions):
    """Singularities at a batch of configurations, or along a path of them."""


class LostDirectionInfo(Answer):
    """A direction in which the tip cannot move."""

    twist: list[float] = Field(
        description="Unit vector in the base's axes, linear before angular, [m/s] and [rad/s]: orthogonal to every "
        "possible twist of the tip; with a characteristic length, after multiplying angular parts by it."
    )
    wrench: list[float] = Field(
        description="A force and a moment at the tip, in the base's axes, that need no joint torque; unit vector, [N] "
        "and [N m]. It does no work along any possible motion of the tip."
    )
    lost_here: bool = Field(
        description="Whether the arm has it elsewhere: false if a direction like it is missing at every configuration."
    )


class InternalMotionInfo(Answer):
    """Joint velocities that leave the tip at rest in the directions of the task."""

    joint_velocities: list[float] = Field(description="Unit vector in the order of `joint_names`, [rad/s or m/s].")
    only_here: bool = Field(description="Whether the arm has this motion only here: false for redundancy.")


class ExitInfo(Answer):
    """How the smallest singular value grows."""

    joint: str = Field(description="The joint that has the largest share in `direction`.")
    direction: list[float] = Field(
        description="Joint motion of unit length along which it grows fastest; from a singular configuration it does "
        "so to either side. In the order of `joint_names`, [rad or m]."
    )
    rate: float = Field(description="How fast, in the unit of the singular values per [rad or m].")


class SingularityInfo(Answer):
    """The tip's lost directions and the internal motions at a configuration."""

    singular: bool = Field(description="Whether a direction is lost here that the arm has elsewhere.")
    rank: int = Field(description="Singular values that exceed `rank_tolerance` times the largest.")
    structural_rank: int = Field(description="The rank at random configurations: the most that the arm has anywhere.")
    rank_tolerance: float = Field(description="Relative to the largest singular value; no unit.")
    singular_values: list[float] = Field(
        description="Largest first; [m or rad] per [rad or m] mixed, or [m] with a characteristic length."
    )
    smallest_singular_value: float | None = Field(
        description="The last one that can be other than zero, number `structural_rank`; null where none can. In the "
        "unit of the others."
    )
    lost_directions: list[LostDirectionInfo] = Field(description="Those that are lost here first.")
    internal_motions: list[InternalMotionInfo] = Field(description="Those that exist only here first.")
    dependent_joints: list[str] = Field(
        description="Joints involved in the internal motions that exist only here: their columns of the Jacobian "
        "are dependent. Empty where the configuration is regular."
    )
    kinds: list[SingularityKind] = Field(
        description="Name of the singularity, if the arm's geometry has one: `wrist`, two axes of the "
        "wrist on one line (or the last axis parallel to three that are so); `elbow`, the arm stretched or folded; "
        "`shoulder`, the wrist where the first joint cannot move it out of the plane of the arm, above all over the "
        "first axis. Empty where the arm has no such parts, or the singularity no such name."
    )
    exit: ExitInfo | None = Field(
        description="The motion that leads out of the singularity, or away from it; null if none does to first order, "
        "for example if the smallest singular value is repeated (a relative gap below 1e-6): then one of the two falls."
    )


class NearestSingularityInfo(Answer):
    """The nearest singular configuration found; a nearer one may exist."""

    distance: float = Field(description="‖Δq‖, the norm of `displacement`, [rad and m].")
    joint_positions: list[float] = Field(description="The singular configuration, [rad or m].")
    displacement: list[float] = Field(description="The joint motion that leads there, [rad or m].")
    joints: list[str] = Field(description="The joints that move.")
    within_limits: bool = Field(description="Whether it is within the joint limits.")
    smallest_singular_value: float = Field(
        description="The smallest singular value there: rounding; in the same unit as the others."
    )
    kinds: list[SingularityKind] = Field(description="Name of the singularity, if the arm's geometry has one.")
    dependent_joints: list[str] = Field(description="Joints whose columns of the Jacobian are dependent there.")


class SingularityEntry(SingularityInfo):
    """The report of one configuration."""

    nearest: NearestSingularityInfo | None = optional(
        "If requested; null if none was found, for the reason in `nearest_reason`."
    )
    nearest_reason: str | None = optional("Why there is none.")


class SingularPlaceInfo(Answer):
    """A minimum of the smallest singular value along the path."""

    segment: int = Field(description="It lies between the configurations of this index and the next; no unit.")
    fraction: float = Field(description="Position between these two, 0 to 1; no unit.")
    end: float = Field(
        description="Segment plus fraction; larger than that of the start where the value stays constant for a while."
    )
    joint_positions: list[float] = Field(description="The configuration there, [rad or m].")
    report: SingularityInfo = Field(description="What is lost there.")


class SingularPathInfo(Answer):
    """Singular and nearly singular places on the path, in its order."""

    places: list[SingularPlaceInfo]
    omitted: int = Field(description="Number of further places; the 500 nearest to singular are listed.")


class SingularityAnswer(AboutChain):
    """Singularity reports, one entry per configuration, in order."""

    reference: Reference = Field(description="Whose directions they are.")
    task: list[Direction] = Field(description="The directions that count, in the order as given.")
    rank_tolerance: float = Field(description="Relative to the largest singular value; no unit.")
    characteristic_length: float | None = Field(description="What angular rows were multiplied by, [m].")
    units_mixed: bool = Field(
        description="Whether the rows or the columns of the Jacobian mix metres and radians: then the singular values, "
        "the lost directions and everything called smallest, fastest or nearest depend on the unit of length; whether "
        "the configuration is singular does not."
    )
    singularities: list[SingularityEntry]
    path: SingularPathInfo | None = optional("If requested.")
    steps: WorkedSolutions = None
    certificate: SingularityCertificate


ENDPOINT = RobotEndpoint(
    name="singularities",
    request=SingularityRequest,
    answer=SingularityAnswer,
    summary="Singularities",
    description="""
    The directions that the tip loses at each configuration, the joints responsible, and the internal motions.

    A configuration is singular where the Jacobian's rank is below that at random configurations: directions that an
    arm never has (a planar arm, or one with fewer than six joints) are distinguished from those it has lost here.
    Each lost direction is given as a twist and as the wrench that needs no joint torque; each internal motion as
    joint velocities, with redundancy and singularity distinguished. `nearest` adds the nearest singular
    configuration found by projections from many starts: the distance is an upper bound. With `path` the
    configurations are a path, whose singular and nearly singular places between them are found too. The Jacobians
    are recomputed through Pinocchio before the answer is sent (a sample of a large batch, all of the nearest
    singularities), and `certificate` gives the difference: singular values differ by no more than √(6n) times that.
    Pinocchio's Jacobian is also multiplied by each internal motion and each lost direction; the product must
    vanish.

    `steps` show determinant, rank, lost directions and internal motions at each given configuration, and before that,
    for up to six joints whose Jacobian has a square block, the determinant in symbols, factorised and solved.

    The rows that count are those of the Jacobian in `reference`. What an `ik` task leaves free, such as a turn
    about the tool (`x y z rx ry`), is free about the tip's axes: use `local` for that.

    The lecture notes say that the rank of a planar arm's 6×n Jacobian is between 1 and 2: of two joints it is
    always 2, because the angular row and the linear ones never vanish together; what drops to rank 1 at q₂ = 0 and
    π is the block of `x y`, so ask for that as `task`. They call an arm with many inverse solutions redundant: here
    redundancy is n larger than the rank, with internal motions at every configuration.
    """,
    options=SingularityOptions,
    npy_answer="Singular values as one array, largest first, of shape (N, k), k the lesser of n and the number of "
    "directions that count.",
    example={"joint_positions": [[0.0, 0.0, 0.0, -1.571, 0.0, 1.571, 0.785]], "nearest": True},
)
