"""The numeric workspace: request, result, operation."""

from typing import Annotated, Literal

from pydantic import Field

from gelenk.collision.contact.words import ContactCertificate
from gelenk.contract.common import Answer, ChainOptions, Payload, optional
from gelenk.contract.endpoint import RobotEndpoint, Scope
from gelenk.contract.jobs import JobInfo, JobName
from gelenk.contract.options import Directions
from gelenk.contract.pose import Vector3
from gelenk.contract.scene import InCell
from gelenk.kinematics.judge.words import WorkspaceCertificate

_Bound = Annotated[float, Field(ge=-1e6, le=1e6)]
JointRange = Annotated[list[_Bound], Field(min_length=2, max_length=2)]


class SlicePlane(Payload):
    """A slice of space to which positions are restricted."""

    origin: Vector3 = Field(description="A point of the plane, in the base frame, [m].")
    normal: Vector3 = Field(description="Normal of the plane, in the base frame; of any length but zero, no unit.")
    thickness: float = Field(
        gt=0, le=1e6, description="Positions within half of it to either side of the plane count, [m]."
    )


class WorkspaceRequest(ChainOptions, InCell):
    """A workspace by samples of the joint space."""

    kind: Literal["cloud", "grid", "dexterity"] = Field(
        default="cloud",
        description="Content of the result's array. `cloud`: each sample's position and measure. `grid`: each "
        "voxel that samples fall into, with their number and the largest measure. `dexterity`: the same, and the share "
        "of the `orientations` that inverse kinematics reaches at its centre.",
    )
    samples: int = Field(default=100_000, ge=1, lt=2**53, description="How many configurations; no unit.")
    sequence: Literal["random", "low_discrepancy"] = Field(
        default="random",
        description="`random`: uniform between the bounds, row i that of `numpy.random.default_rng(random_seed)"
        ".random((samples, n))`. `low_discrepancy`: a scrambled Halton sequence, which leaves smaller gaps.",
    )
    random_seed: int = Field(default=0, ge=0, lt=2**53, description="Random seed of the samples; no unit.")
    voxel_size: float | None = optional(
        "Edge of a voxel, [m], at most how far the arm reaches; if left out a 40th of the longest side of the "
        "workspace, with `dexterity` a 14th. One voxel's centre is the origin of the base frame, or of the plane.",
        gt=0,
        le=1e6,
    )
    task: Directions | None = optional(
        "Which rows of the Jacobian Yoshikawa's measure counts: `x y z` translation and `rx ry rz` rotation, along "
        "the base's axes. If left out the translation, in the directions in which the tip moves at all, so that a "
        "planar arm has a measure too.",
        examples=[["x", "y"]],
    )
    plane: SlicePlane | None = optional(
        "Only positions in a slice; its voxels are squares in its plane. An arm that moves in a plane gets squares in "
        "that plane by default."
    )
    joint_ranges: dict[str, JointRange] = Field(
        default_factory=dict,
        max_length=128,
        description="By joint name, [lower, upper] within the joint's limits, [rad or m]. Others are sampled between "
        "their limits; without limits a turning joint goes once round and a sliding one 1 m to either side.",
    )
    orientations: int = Field(
        default=32,
        ge=1,
        le=1000,
        description="With `dexterity` only: number of orientations tried at each voxel; no unit.",
    )
    orientations_over: Literal["rotations", "approach_directions"] = Field(
        default="rotations",
        description="With `dexterity` only, the set over which these are spread evenly: over all rotations, or over "
        "the directions of the tip's z axis, with any turn about it. Of an arm that turns about one direction only, "
        "as planar arms and SCARAs, they are turns about that one.",
    )
    job_id: JobName | None = Field(default=None)


class BoxInfo(Answer):
    """A box along the base's axes."""

    lower: list[float] = Field(description="Smallest x, y, z, [m].")
    upper: list[float] = Field(description="Largest x, y, z, [m].")


class ReachInfo(Answer):
    """Distances of the tip from the base frame's origin."""

    min: float = Field(description="Smallest, [m].")
    max: float = Field(description="Largest, [m].")


class VoxelsInfo(Answer):
    """The voxels that samples fall into: centres at origin + Σ i_k · size · axes[k]."""

    size: float = Field(description="Edge, [m].")
    dimensions: int = Field(
        description="3 in space, 2 in a plane (squares), 1 on a line, 0 where the tip does not move; no unit."
    )
    origin: list[float] = Field(description="Centre of the voxel 0, 0, 0, [m].")
    axes: list[list[float]] = Field(
        description="Unit vectors along the edges, in the base frame, no unit; the first `dimensions` of them count."
    )
    count: int = Field(description="How many voxels; no unit.")
    inner_count: int = Field(
        description="Those of them that have a neighbour on every side, also across edges and corners; no unit."
    )
    volume: float = Field(
        description="Of all of them, [m³], in a plane [m²], on a line [m]. Those on the workspace's border count "
        "whole, those without a sample not at all. 0 where the tip does not move."
    )
    inner_volume: float = Field(
        description="Of the inner ones, [m³, m² or m]: less than the workspace's where that leaves out nothing thinner "
        "than two voxels."
    )
    volume_bounds: list[float] = Field(
        description="Bounds of the workspace's volume, [m³, m² or m]: that of the inner voxels, and "
        "that of all that it meets, where too few samples met them in voxels of twice the size, and so on. The lower "
        "one holds if the workspace leaves out nothing thinner than two voxels; the upper one allows for voxels that "
        "no sample has met, as many as those met once or twice let expect, and is at most a ball about the base."
    )
    late_share: float | None = Field(
        description="Share of the voxels that only the last tenth of the samples found, no unit: near 0, more samples "
        "would find hardly any more. Null where no sample counts."
    )


class MeasureInfo(Answer):
    """Yoshikawa's measure, the product of the singular values of the Jacobian's rows that count.

    Null where no sample counts. Zero where the directions that count depend on each other at every configuration.
    """

    directions: list[list[float]] = Field(
        description="The rows that count as unit twists in the base frame, linear before angular; no unit."
    )
    min: float | None = Field(description="Smallest; one factor [m or rad] per [rad or m] a direction.")
    mean: float | None = Field(description="Mean of the samples that count, likewise.")
    max: float | None = Field(description="Largest, likewise.")
    position: list[float] | None = Field(description="Position of the tip there, [m]; null if all are zero.")
    joint_positions: list[float] | None = Field(
        description="The configuration there, [rad or m]; null if all are zero."
    )


class DexterityInfo(Answer):
    """How many orientations are reached at the voxels' centres."""

    method: Literal["inverse_kinematics"] = Field(
        description="Each orientation at each voxel's centre is a target of inverse kinematics, whose solutions are "
        "recomputed through Pinocchio. Of a chain without a closed form the shares are lower bounds."
    )
    spread: Literal["rotations", "approach_directions", "turns", "fixed"] = Field(
        description="The set over which the orientations are spread; `fixed` is the single orientation of a tip that "
        "never turns."
    )
    orientations: int = Field(description="Number of orientations per voxel; no unit.")
    mean_share: float | None = Field(description="Mean over the voxels, 0 to 1, no unit.")
    max_share: float | None = Field(description="Largest, 0 to 1, no unit.")
    reached_count: int = Field(description="Voxels at whose centre any is reached; no unit.")
    full_count: int = Field(description="Voxels at whose centre all are reached; no unit.")
    full_volume: float = Field(
        description="Volume of these, [m³], in a plane [m²]: an estimate of the secondary workspace WS₂; 0 where "
        "`excluded` says that it has none."
    )
    full_volume_bounds: list[float] = Field(
        description="Bounds of that volume, [m³ or m²], where neither WS₂ nor what it leaves out is "
        "thinner than a voxel: that of the voxels all of whose neighbours are full too, and that of the full ones with "
        "all their neighbours, or that of the whole workspace."
    )
    excluded: str | None = Field(
        description="Why the chain can take all these orientations at single points at most, and in no region: its tip "
        "has too few independent velocities. The counts are then coincidences. Null if nothing excludes it."
    )


class ArrayInfo(Answer):
    """The result as an npy array."""

    shape: list[int] = Field(description="Rows and columns; no unit.")
    columns: list[str] = Field(description="What each column is; x y z in the base frame, [m].")


class PlaneInfo(Answer):
    """A slice of space."""

    origin: list[float] = Field(description="A point of the plane, in the base frame, [m].")
    normal: list[float] = Field(description="Its unit normal, in the base frame, no unit.")
    thickness: float = Field(description="Positions within half of it to either side of the plane count, [m].")


class WorkspaceAnswer(Answer):
    """A workspace, estimated from samples."""

    robot: str = Field(description="Name of the robot.")
    robot_digest: str | None = optional("As in the job.")
    joint_names: list[str] = Field(description="The chain's joints in the order of a configuration.")
    base_frame: str = Field(description="Frame in which positions are expressed.")
    tip_frame: str = Field(description="Frame whose positions they are.")
    kind: Literal["cloud", "grid", "dexterity"] = Field(description="As requested.")
    samples: int = Field(description="Configurations that were computed; no unit.")
    samples_free: int | None = optional(
        "With `scene` or `min_clearance`: those of them that are not in contact; no unit."
    )
    samples_counted: int = Field(
        description="Those of them whose position counts: all that are not in contact, of these with a plane those in "
        "the slice; no unit."
    )
    plane: PlaneInfo | None = Field(description="The slice that positions are restricted to; null without one.")
    sequence: Literal["random", "low_discrepancy"] = Field(description="How configurations were drawn.")
    random_seed: int = Field(description="Random seed of the samples; no unit.")
    joint_ranges: list[list[float]] = Field(description="Bounds between which each joint was sampled, [rad or m].")
    bounding_box: BoxInfo | None = Field(description="Null where no sample counts.")
    reach: ReachInfo | None = Field(description="Null where no sample counts.")
    voxels: VoxelsInfo
    measure: MeasureInfo
    dexterity: DexterityInfo | None = Field(description="If requested.")
    array: ArrayInfo
    notes: list[str] = Field(description="Assumptions, and what is special about the chain.")
    certificate: WorkspaceCertificate
    contact_certificate: ContactCertificate | None = optional("Of contacts at the same samples, if they matter.")


ENDPOINT = RobotEndpoint(
    name="workspace",
    request=WorkspaceRequest,
    answer=JobInfo,
    is_job=True,
    batch="",
    scope=Scope.WRITE,
    summary="Workspace",
    description="""
    Samples the workspace of any chain within its joint limits, as a job.

    The reply is immediate, with the job's address in `Location`; `GET` that, or its `/events`, until `state` is
    `succeeded`, then get `/result`: as JSON a summary (extent, reach, volume, the largest manipulability, how well
    a sample of it agrees with Pinocchio), as npy the positions or voxels, as SVG, PNG or PDF a picture.

    With `scene` or `min_clearance` only configurations count at which the robot touches neither itself nor what is
    around it; joints off the chain stand where `other_joints` says, or at 0.

    The same request gives the same result, whatever the number of processes. Samples are uniform in joint space:
    regions that few configurations lead to need more of them, and `late_share` shows whether there were enough. For
    planar arms `/v1/course/workspace` gives the exact workspace.
    """,
    example={"kind": "cloud", "samples": 100_000, "tip_frame": "panda_link8", "job_id": "panda-workspace"},
)
