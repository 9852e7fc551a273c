"""Jacobians: request, answer, operation."""

from typing import Literal

from pydantic import Field, model_validator

from gelenk.contract.common import ChainOptions, optional
from gelenk.contract.endpoint import RobotEndpoint
from gelenk.contract.kinematics import AboutChain, Configurations, Matrix
from gelenk.contract.options import BatchRequest, Fraction, RespectLimits, WithSteps, WorkedSolutions
from gelenk.kinematics.judge.words import JacobianCertificate, Reference, Screws


class JacobianOptions(ChainOptions, WithSteps):
    """Reference, representation and derivatives of a Jacobian."""

    reference: Reference | Screws = Field(
        default="local_world_aligned",
        description="`local_world_aligned`: base axes, at the tip (the course's geometric Jacobian). `local`: tip "
        "axes, at the tip. `world`: the spatial twist, base axes, at the base origin. `space_screws` and "
        "`body_screws`: `world` and `local` with the angular rows first, as for the product of exponentials.",
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
    rank_tolerance: Fraction = Field(
        default=1e-10, description="A singular value counts where it exceeds this times the largest."
    )
    respect_limits: RespectLimits = False

    @model_validator(mode="after")
    def _analytic_in_base_axes(self) -> "JacobianOptions":
        if self.representation != "geometric" and self.reference != "local_world_aligned":
            raise ValueError("`reference`: an analytic Jacobian requires `local_world_aligned`")
        return self


class JacobianRequest(BatchRequest, JacobianOptions):
    """Jacobians of a batch of configurations."""

    joint_velocities: Configurations | None = optional(
        "For `time_variation`: one entry per configuration, [rad/s or m/s]."
    )


class JacobianAnswer(AboutChain):
    """Jacobians, one entry per configuration; rows linear (x, y, z), then angular; columns as joint_names.

    The rows of `space_screws` and `body_screws` are angular, then linear.
    """

    joint_names: list[str] = Field(description="The chain's joints: the columns.")
    reference: Reference | Screws = Field(description="As requested.")
    representation: Literal["geometric", "zyz", "rpy"] = Field(description="As requested.")
    jacobians: list[Matrix] = Field(description="6 rows, n columns: [m or rad] per [rad or m].")
    ranks: list[int] = Field(description="Singular values that count, see `rank_tolerance`.")
    singular_values: list[list[float]] = Field(description="Largest first, [m or rad] per [rad or m]: units are mixed.")
    condition_numbers: list[float | None] = Field(
        description="Largest over smallest singular value; no unit; null if the Jacobian does not have full rank."
    )
    rank_tolerance: float = Field(description="Relative to the largest singular value.")
    time_variations: list[Matrix] | None = optional("dJ/dt, 6 rows, n columns: [m or rad] per [rad or m] and second.")
    hessians: list[list[Matrix]] | None = optional(
        "∂J/∂q: entry [k][i][j] is ∂J[k][i]/∂q_j, [m or rad] per [rad or m] squared."
    )
    steps: WorkedSolutions = None
    certificate: JacobianCertificate


ENDPOINT = RobotEndpoint(
    name="jacobian",
    request=JacobianRequest,
    answer=JacobianAnswer,
    summary="Jacobian",
    description="""
    Jacobian of the tip at each configuration, with rank, singular values and condition number.

    Rows are linear before angular. `local_world_aligned` is the course's geometric Jacobian; `zyz` and `rpy`
    give the analytic Jacobian, which does not exist where its angles degenerate. Every answer is recomputed through
    Pinocchio before it is sent (a sample of a large batch).
    """,
    options=JacobianOptions,
    npy_answer="Jacobians as one array of shape (N, 6, n).",
    example={"joint_positions": [[0.0, -0.785, 0.0, -2.356, 0.0, 1.571, 0.785]], "reference": "local_world_aligned"},
)
