"""Dynamics: request, answer, operation."""

from typing import Annotated, get_args

from pydantic import Field

from gelenk.contract.common import optional
from gelenk.contract.endpoint import RobotEndpoint
from gelenk.contract.kinematics import AboutChain, Configurations, Matrix
from gelenk.contract.options import BatchRequest, WithSteps, WorkedSolutions
from gelenk.contract.statics import Gravity, Wrenches, WrenchOptions, WrenchRequest
from gelenk.kinematics.judge.words import DynamicsCertificate, Term


class DynamicsOptions(WrenchOptions, WithSteps):
    """Axes, point, gravity and terms of a call of dynamics."""

    gravity: Gravity = Field(
        default=True,
        description="True for 9.81 m/s² along -z of the root link, false for none, or the gravity in the axes of the "
        "root link, [m/s²].",
        examples=[[0.0, 0.0, -9.81]],
    )
    terms: Annotated[list[Term], Field(max_length=5)] = Field(
        default=list(get_args(Term)),
        description="Terms to compute in addition to what `joint_accelerations` or `torques` ask for.",
    )


class DynamicsRequest(BatchRequest, DynamicsOptions, WrenchRequest):
    """Dynamics of a batch of configurations."""

    joint_velocities: Configurations | None = optional("One entry per configuration, [rad/s or m/s]; zero if left out.")
    joint_accelerations: Configurations | None = optional(
        "For inverse dynamics: one entry per configuration, [rad/s² or m/s²]."
    )
    torques: Configurations | None = optional(
        "For forward dynamics: τ of the motors, one entry per configuration, [N m], or [N] for sliding."
    )
    wrenches: Wrenches | None = optional(
        "γ, exerted by the tip on its surroundings, force before moment, six numbers, [N] and [N m]: a list of one for "
        "all configurations or of one each."
    )


class DynamicsAnswer(AboutChain):
    """M q̈ + C q̇ + g + Jᵀγ = τ, one entry per configuration, in order; rows and columns as `joint_names`."""

    root_frame: str = Field(description="The root link, which is fixed and in whose axes gravity is given.")
    gravity: list[float] = Field(description="In the axes of the root link, [m/s²].")
    mass_matrices: list[Matrix] | None = optional(
        "M(q): [kg m²] for two turning joints, [kg m] for one, [kg] for none."
    )
    coriolis_matrices: list[Matrix] | None = optional(
        "C(q, q̇): of the many matrices with this C q̇ the one for which dM/dt - 2C is skew, [kg m², kg m or kg] per "
        "second."
    )
    coriolis_torques: list[list[float]] | None = optional("C q̇, Coriolis and centrifugal torques, [N m or N].")
    gravity_torques: list[list[float]] | None = optional("g(q), the motor torques that hold the weight, [N m or N].")
    kinetic_energies: list[float] | None = optional("½ q̇ᵀM q̇, [J].")
    potential_energies: list[float] | None = optional(
        "Of all that the chain's joints move, [J]: zero where its centre of mass is level with the origin of the root "
        "link."
    )
    wrench_torques: list[list[float]] | None = optional("Jᵀγ, where wrenches were given, [N m or N].")
    torques: list[list[float]] | None = optional(
        "By inverse dynamics, where `joint_accelerations` were given, [N m or N]."
    )
    joint_accelerations: list[list[float]] | None = optional(
        "By forward dynamics, where `torques` were given, [rad/s² or m/s²]."
    )
    overloaded_joints: list[list[str]] | None = optional(
        "By inverse dynamics: joints whose torque is beyond the effort limit of the description."
    )
    notes: list[str] = Field(description="What the numbers leave out, such as links without mass, or assume.")
    steps: WorkedSolutions = None
    certificate: DynamicsCertificate


ENDPOINT = RobotEndpoint(
    name="dynamics",
    request=DynamicsRequest,
    answer=DynamicsAnswer,
    summary="Dynamics: M, C, g, inverse and forward",
    description="""
    Mass matrix, Coriolis and gravity terms, energies, inverse and forward dynamics.

    M(q) q̈ + C(q, q̇) q̇ + g(q) + Jᵀγ = τ, which Lagrange's equations make of T = ½ q̇ᵀM q̇ and U: τ are the
    torques of the motors, γ the wrench that the tip exerts on its surroundings (these act on the tip with -γ; as in
    `statics` they are at rest in `base_frame`). `joint_accelerations` ask for the torques (recursive Newton-Euler),
    `torques` for the accelerations (articulated bodies; M⁻¹ where mimic joints follow).

    The robot's root link is fixed. Joints outside the chain are locked at zero, and their links
    count where the chain's joints carry them. A mimic joint moves with its leader and adds to its inertia. Friction
    and damping that a description gives are not applied, and rotors have no inertia. A DH table gives no masses:
    its robot gets the masses of the bodies drawn for it, and `notes` says so.

    Terms come from Pinocchio; `certificate` compares them with sums over the bodies through our own Jacobians. `steps`
    show these sums with their numbers, C by Christoffel's symbols, and the equation solved; for a planar arm of up to
    two joints, without a payload, the equations in symbols come first.
    """,
    options=DynamicsOptions,
    npy_answer="The requested torques or accelerations as one array of shape (N, n), otherwise the first of "
    "`terms`: a matrix (N, n, n), torques (N, n), or both energies (N, 2).",
    example={
        "joint_positions": [[0.0, -0.785, 0.0, -2.356, 0.0, 1.571, 0.785]],
        "joint_velocities": [[0.1, 0.0, 0.0, 0.2, 0.0, 0.0, 0.0]],
        "joint_accelerations": [[0.0, 0.5, 0.0, 0.0, 0.0, 0.0, 0.0]],
        "payload": {"mass": 0.5, "center_of_mass": [0.0, 0.0, 0.05]},
    },
)
