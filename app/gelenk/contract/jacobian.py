"""Jacobians: request, answer, operation."""

from typing import Literal

from pydantic import Field, model_validator

from gelenk.contract.common import Answer, ChainOptions
from gelenk.contract.endpoint import RobotEndpoint
from gelenk.contract.kinematics import Configurations, Matrix
from gelenk.kinematics.judge.words import JacobianCertificate


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
    certificate: JacobianCertificate


ENDPOINT = RobotEndpoint(
    name="jacobian",
    request=JacobianRequest,
    answer=JacobianAnswer,
    summary="Jacobian",
    description="""
    Jacobian of the tip at each configuration, with rank, singular values and condition number.

    Rows are linear before angular. `local_world_aligned` is the course's geometric Jacobian; `zyz` and `rpy`
    give the analytic one, which does not exist where its angles degenerate. Every answer is recomputed through
    Pinocchio before it is sent (a sample of a large batch).
    """,
    batch="joint_positions",
    options=JacobianOptions,
    npy_body="`joint_positions` as an array of shape (N, n).",
    npy_answer="Jacobians as one array of shape (N, 6, n).",
    example={"joint_positions": [[0.0, -0.785, 0.0, -2.356, 0.0, 1.571, 0.785]], "reference": "local_world_aligned"},
)
