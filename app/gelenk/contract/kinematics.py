"""Requests and answers of forward kinematics and the Jacobian."""

from collections.abc import Sequence
from typing import Annotated, Any, Literal, TypeAlias

from pydantic import Discriminator, Field, Tag, model_validator

from gelenk.contract.common import Answer, ChainOptions, FrameName, OnTheWire
from gelenk.contract.pose import Pose, PoseFormat
from gelenk.model.arrays import Array
from gelenk.model.arrays import Configuration as GivenConfiguration


def _kind(value: Any) -> str | None:
    return "<object>" if isinstance(value, dict) else "<list>" if isinstance(value, list) else None


MAX_CONFIGURATIONS = 1_000_000

ByOrder: TypeAlias = Annotated[list[float], Field(max_length=128, fail_fast=True)]
ByName: TypeAlias = Annotated[dict[str, float], Field(max_length=128)]
_Configuration = Annotated[
    Annotated[ByOrder, Tag("<list>")] | Annotated[ByName, Tag("<object>")],
    Discriminator(
        _kind,
        custom_error_type="configuration",
        custom_error_message="a configuration is a list of one number per joint, or an object of values by joint name",
    ),
]
"""Tags in angle brackets never show in a pointer."""

Configuration = Annotated[GivenConfiguration, OnTheWire(_Configuration)]
"""One number per joint, base to tip, or a value by joint name."""

Configurations = Annotated[
    Sequence[GivenConfiguration] | Array,
    OnTheWire(Annotated[list[_Configuration], Field(max_length=MAX_CONFIGURATIONS, fail_fast=True)]),
    Field(
        description="Configurations: each one number per joint of the chain, base to tip, or an object of values by "
        "joint name; [rad] for revolute and continuous joints, [m] for prismatic ones.",
        examples=[[[0.0, -0.5, 0.0, -2.0, 0.0, 1.5, 0.8]]],
    ),
]


class ForwardOptions(ChainOptions):
    """Options of forward kinematics."""

    list_fields = frozenset({"frames"})

    pose_format: PoseFormat = Field(default="quaternion_xyzw", description="Notation of the poses in the answer.")
    frames: list[FrameName] | Literal["all"] | None = Field(
        default=None, description='Further frames that the chain moves, by name, or "all" of them.'
    )
    respect_limits: bool = Field(
        default=False, description="Whether a configuration beyond the joint limits is an error."
    )


class ForwardRequest(ForwardOptions):
    """Forward kinematics of a batch of configurations."""

    joint_positions: Configurations


class CertificateInfo(Answer):
    """Differences of these poses from those computed through Pinocchio."""

    samples: int = Field(description="Configurations that were recomputed: all of a small batch.")
    max_position_error: float = Field(description="Largest distance, [m].")
    max_orientation_error: float = Field(description="Largest angle, [rad].")
    seed: int = Field(description="Random seed of the sampling.")


class ForwardAnswer(Answer):
    """Poses, one entry per configuration, in order."""

    joint_names: list[str] = Field(description="The chain's joints in the order of a configuration.")
    base_frame: str = Field(description="Frame in which the poses are expressed.")
    tip_frame: str = Field(description="Frame whose poses they are.")
    poses: list[Pose] = Field(description="T_base_tip at each configuration.")
    frames: list[dict[str, Pose]] | None = Field(
        default=None, description="If frames were requested: T_base_frame by name, one entry per configuration."
    )
    certificate: CertificateInfo


class JacobianOptions(ChainOptions):
    """Reference, representation and derivatives of a Jacobian."""

    list_fields = frozenset({"derivatives"})

    reference: Literal["local_world_aligned", "local", "world"] = Field(
        default="local_world_aligned",
        description="`local_world_aligned`: base axes, at the tip (the course's geometric Jacobian). `local`: tip "
        "axes, at the tip. `world`: the spatial twist, base axes, at the base origin.",
    )
    representation: Literal["geometric", "zyz", "rpy"] = Field(
        default="geometric",
        description="`geometric`: angular rows give the angular velocity. `zyz`, `rpy`: they give the rates of these "
        "angles (analytic Jacobian), with reference `local_world_aligned` only.",
    )
    derivatives: list[Literal["time_variation", "hessian"]] = Field(
        default_factory=list,
        description="`time_variation`: dJ/dt at `joint_velocities`. `hessian`: ∂J/∂q.",
        max_length=2,
    )
    rank_tolerance: float = Field(
        default=1e-10, gt=0, lt=1, description="A singular value counts where it exceeds this times the largest."
    )
    respect_limits: bool = Field(
        default=False, description="Whether a configuration beyond the joint limits is an error."
    )

    @model_validator(mode="after")
    def _analytic_in_base_axes(self) -> "JacobianOptions":
        if self.representation != "geometric" and self.reference != "local_world_aligned":
            raise ValueError("`reference`: an analytic Jacobian requires `local_world_aligned`")
        return self


class JacobianRequest(JacobianOptions):
    """Jacobians of a batch of configurations."""

    joint_positions: Configurations
    joint_velocities: Configurations | None = Field(
        default=None, description="For `time_variation`: one entry per configuration, [rad/s or m/s]."
    )


class JacobianCertificateInfo(Answer):
    """Differences of these Jacobians from those computed through Pinocchio."""

    samples: int = Field(description="Configurations that were recomputed: all of a small batch.")
    max_error: float = Field(
        description="Largest difference of an entry, of the geometric Jacobian and of the one that is sent, "
        "[m or rad] per [rad or m]."
    )
    max_time_variation_error: float | None = Field(
        description="Largest difference of an entry of the geometric dJ/dt at random joint velocities, "
        "[m or rad] per [rad or m] and second; null if no derivative was requested."
    )
    seed: int = Field(description="Random seed of the sampling.")


Matrix = list[list[float]]


class JacobianAnswer(Answer):
    """Jacobians, one entry per configuration; rows linear (x, y, z), then angular; columns as joint_names."""

    joint_names: list[str] = Field(description="The chain's joints: the columns.")
    base_frame: str = Field(description="Where the chain begins.")
    tip_frame: str = Field(description="Where the chain ends.")
    reference: Literal["local_world_aligned", "local", "world"] = Field(description="As requested.")
    representation: Literal["geometric", "zyz", "rpy"] = Field(description="As requested.")
    jacobians: list[Matrix] = Field(description="6 rows, n columns: [m or rad] per [rad or m].")
    ranks: list[int] = Field(description="Singular values that count, see `rank_tolerance`.")
    singular_values: list[list[float]] = Field(description="Largest first, [m or rad] per [rad or m]: units are mixed.")
    condition_numbers: list[float | None] = Field(
        description="Largest over smallest singular value; no unit; null if the Jacobian does not have full rank."
    )
    rank_tolerance: float = Field(description="Relative to the largest singular value.")
    time_variations: list[Matrix] | None = Field(
        default=None, description="dJ/dt, 6 rows, n columns: [m or rad] per [rad or m] and second."
    )
    hessians: list[list[Matrix]] | None = Field(
        default=None, description="∂J/∂q: entry [k][i][j] is ∂J[k][i]/∂q_j, [m or rad] per [rad or m] squared."
    )
    certificate: JacobianCertificateInfo
