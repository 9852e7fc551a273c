"""Statics: request, answer, operation; and what dynamics shares with them: wrenches, gravity, payload."""

from typing import Annotated, Any

from pydantic import Discriminator, Field, Tag

from gelenk.contract.common import Answer, ChainOptions, FrameName, OnTheWire, Payload, Vectors, optional
from gelenk.contract.endpoint import RobotEndpoint
from gelenk.contract.kinematics import MAX_CONFIGURATIONS, AboutChain, Configurations, Matrix
from gelenk.contract.options import BatchRequest, Directions, Fraction, RespectLimits, WithSteps, WorkedSolutions
from gelenk.ik.search.words import Direction
from gelenk.kinematics.judge.words import Reference, StaticsCertificate

MAX_TESTS = 100
MAX_WRENCH = 1e6

_Acceleration = Annotated[float, Field(ge=-1e3, le=1e3)]
_Length = Annotated[float, Field(ge=-1e3, le=1e3)]
_Moment = Annotated[float, Field(ge=-1e9, le=1e9)]
_Component = Annotated[float, Field(ge=-MAX_WRENCH, le=MAX_WRENCH)]


def _kind(value: Any) -> str:
    return "<list>" if isinstance(value, list | tuple) else "<switch>"


Gravity = Annotated[
    Annotated[bool, Tag("<switch>")] | Annotated[list[_Acceleration], Field(min_length=3, max_length=3), Tag("<list>")],
    Discriminator(_kind),
]
"""A switch for 9.81 m/s² along -z of the root, or the vector."""

Wrenches = Annotated[
    Vectors,
    OnTheWire(
        Annotated[
            list[Annotated[list[_Component], Field(min_length=1, max_length=6)]],
            Field(max_length=MAX_CONFIGURATIONS, fail_fast=True),
        ]
    ),
]
_Vectors = Annotated[
    Vectors,
    OnTheWire(
        Annotated[list[Annotated[list[_Component], Field(max_length=128, fail_fast=True)]], Field(max_length=MAX_TESTS)]
    ),
]


_Center = Annotated[list[_Length], Field(min_length=3, max_length=3)]


class LoadInfo(Payload):
    """A rigid body on the tip, without the place of its centre of mass."""

    mass: float = Field(gt=0, le=1e6, description="Of the load, [kg].")
    inertia: Annotated[list[_Moment], Field(min_length=6, max_length=6)] | None = optional(
        "ixx, ixy, ixz, iyy, iyz, izz about the centre of mass in the tip's axes, [kg m²]; left out, the mass is a "
        "point."
    )


class PayloadInfo(LoadInfo):
    """A rigid body on the tip."""

    center_of_mass: _Center = Field(default=[0.0, 0.0, 0.0], description="In the tip frame, [m].")

    @property
    def center(self) -> list[float]:
        """The name that a motion has for it."""
        return self.center_of_mass


class CarriedLoad(LoadInfo):
    """A rigid body on the tip during a motion."""

    center: _Center = Field(default=[0.0, 0.0, 0.0], description="Of mass, in the tip frame, [m].")


class WrenchOptions(ChainOptions):
    """Axes and point of a wrench."""

    reference: Reference = Field(
        default="local_world_aligned",
        description="`local_world_aligned`: base axes, at the tip. `local`: tip axes, at the tip. `world`: base axes, "
        "at the base origin.",
    )
    expressed_in: FrameName | None = optional(
        "Frame whose axes are taken instead of those of `reference`: any of the robot, with joints outside the chain "
        "at zero."
    )
    point_frame: FrameName | None = optional("Frame of `point`, any of the robot likewise; the tip if left out.")
    respect_limits: RespectLimits = False


class WrenchRequest(WrenchOptions):
    """The axes and the point in which a wrench is expressed."""

    point: Annotated[list[_Component], Field(min_length=3, max_length=3)] | None = optional(
        "Where the force acts, and the moment is about, instead of where `reference` says: coordinates in "
        "`point_frame`, [m]."
    )
    payload: PayloadInfo | None = optional("A load carried by the tip.")


class StaticsOptions(WrenchOptions, WithSteps):
    """Axes, task, gravity and subspaces of a call of statics."""

    task: Directions | None = optional(
        "The components of twists and wrenches that count, along the axes that they are expressed in; all six if left "
        "out. A wrench then has one number for each, and none in the others.",
        examples=[["x", "y"]],
    )
    gravity: Gravity = Field(
        default=False,
        description="Whether the motors also hold the robot's weight: true for 9.81 m/s² along -z of the root link, or "
        "the gravity in the axes of the root link, [m/s²]. Links on branches count where the chain's joints carry "
        "them; joints outside the chain are at zero.",
        examples=[[0.0, 0.0, -9.81]],
    )
    subspaces: bool = Field(default=False, description="Whether to compute the four subspaces of the Jacobian.")
    rank_tolerance: Fraction = Field(
        default=1e-10, description="A singular value counts where it exceeds this times the largest; no unit."
    )
    membership_tolerance: Fraction = Field(
        default=1e-9,
        description="A vector lies in a subspace if its remainder is at most this times its length; no unit.",
    )


class StaticsRequest(BatchRequest, StaticsOptions, WrenchRequest):
    """Statics of a batch of configurations."""

    wrenches: Wrenches | None = optional(
        "γ, exerted by the tip on its surroundings, force before moment, [N] and [N m]: a list of one for all "
        "configurations or of one each.",
        examples=[[[10.0, 0.0, -5.0, 0.0, 0.0, 0.0]]],
    )
    torques: Configurations | None = optional(
        "τ of the motors, [N m] or [N] of a sliding joint, instead of `wrenches`: one for all configurations or one "
        "for each."
    )
    test_twists: _Vectors | None = optional("Tip velocities to be split into range(J) and ker(Jᵀ), [m/s] and [rad/s].")
    test_wrenches: _Vectors | None = optional("Wrenches to be split into range(J) and ker(Jᵀ), [N] and [N m].")
    test_torques: _Vectors | None = optional("Joint torques to be split into range(Jᵀ) and ker(J), [N m or N].")
    test_joint_velocities: _Vectors | None = optional(
        "Joint velocities to be split into range(Jᵀ) and ker(J), [rad/s or m/s]."
    )


class SplitInfo(Answer):
    """A vector as the sum of two in subspaces that are each other's orthogonal complement."""

    components: dict[str, list[float]] = Field(description="By subspace, in the unit of the vector.")
    member_of: list[str] = Field(description="The subspaces that it lies in: of a zero vector both.")


class SubspacesInfo(Answer):
    """range(J) ⊕ ker(Jᵀ) = Rᵐ and range(Jᵀ) ⊕ ker(J) = Rⁿ, each pair orthogonal.

    Bases are orthonormal, one vector per row.
    """

    rank: int = Field(description="ρ, the number of singular values that count.")
    singular_values: list[float] = Field(description="Largest first, [m or rad] per [rad or m]: units are mixed.")
    dimensions: dict[str, int] = Field(description="ρ, m - ρ, ρ and n - ρ, by subspace.")
    range: Matrix = Field(description="range(J): tip velocities that the joints can make, [m] and [rad] mixed.")
    left_kernel: Matrix = Field(
        description="ker(Jᵀ): wrenches that need no torque, and tip velocities that are lost, [m] and [rad] mixed."
    )
    row_space: Matrix = Field(description="range(Jᵀ): torques that a wrench balances, [N m or N] mixed.")
    kernel: Matrix = Field(description="ker(J): joint velocities that leave the tip at rest, [rad or m] mixed.")
    twists: list[SplitInfo] | None = optional("Of `test_twists`.")
    wrenches: list[SplitInfo] | None = optional("Of `test_wrenches`.")
    torques: list[SplitInfo] | None = optional("Of `test_torques`.")
    joint_velocities: list[SplitInfo] | None = optional("Of `test_joint_velocities`.")


class BalanceInfo(Answer):
    """What the torques determine about the wrench."""

    is_balanced: list[bool] = Field(description="Whether a wrench explains the torques, by `membership_tolerance`.")
    is_unique: list[bool] = Field(description="Whether that wrench is unique: ker(Jᵀ) is empty.")
    residual_torques: list[list[float]] = Field(
        description="τ - g - Jᵀγ, in ker(J): no wrench balances it, the robot would move; [N m or N]."
    )
    free_wrenches: list[Matrix] = Field(
        description="Orthonormal basis of ker(Jᵀ), one wrench per row, [N] and [N m]: any sum of them may be added to "
        "γ, which is the one of least norm (metres count as radians)."
    )


class StaticsAnswer(AboutChain):
    """Forces at rest, one entry per configuration, in order."""

    root_frame: str = Field(description="The root link, in whose axes gravity is given.")
    gravity: list[float] | None = Field(description="In the axes of the root link, [m/s²]; null where left out.")
    task: list[Direction] = Field(description="The components of a wrench.")
    rank_tolerance: float = Field(description="By which singular values counted, relative to the largest; no unit.")
    membership_tolerance: float = Field(description="By which vectors lay in subspaces, relative to them; no unit.")
    wrenches: list[list[float]] | None = Field(
        description="γ, exerted by the tip on its surroundings, as given or as found from the torques, [N] and [N m]; "
        "null where there is none."
    )
    torques: list[list[float]] = Field(
        description="τ = Jᵀγ + g(q), the motor torques, [N m], or [N] of a sliding joint; or as they were given."
    )
    gravity_torques: list[list[float]] | None = optional(
        "g(q), the part of `torques` that holds the weight, [N m or N]."
    )
    balance: BalanceInfo | None = optional("Where `torques` were given.")
    overloaded_joints: list[list[str]] = Field(
        description="Joints whose torque is beyond the effort limit of the description."
    )
    subspaces: list[SubspacesInfo] | None = optional("If requested.")
    notes: list[str] = Field(description="What the numbers leave out, such as links without mass, or assume.")
    steps: WorkedSolutions = None
    certificate: StaticsCertificate


ENDPOINT = RobotEndpoint(
    name="statics",
    request=StaticsRequest,
    answer=StaticsAnswer,
    summary="Statics: wrenches and joint torques",
    description="""
    Joint torques that hold a wrench at the tip, or the wrench behind joint torques; the subspaces of both.

    τ = Jᵀγ + g(q): the torques that the motors give while the tip exerts γ on its surroundings and the robot is at
    rest (the surroundings act on the tip with -γ). Without `gravity` that is the course's τ = Jᵀγ, by virtual work:
    dW = F dx (the notes have dF dx), so τᵀq̇ = γᵀJq̇ for every q̇, which `certificate` checks with twists of
    Pinocchio's. The surroundings are at rest in `base_frame`: where the chain's joints move the base too, it takes
    the reaction, as a hand does that presses against another.

    `torques` instead of `wrenches` asks for γ = J⁻ᵀ(τ - g), or for a Jacobian that is singular or not square the
    nearest wrench, of least norm; `balance` holds the remaining torques and the wrenches that may be added. With
    neither, `torques` are those of the weight alone, if `gravity` asks for it. A DH table gives no masses: its
    robot gets the masses of the bodies drawn for it, and `notes` says so.

    Kinetostatic duality: `subspaces` (implied by any of the `test_…` vectors): range(J) ⊕ ker(Jᵀ) = Rᵐ and range(Jᵀ)
    ⊕ ker(J) = Rⁿ. Both sums are direct and orthogonal (the notes write +). They mix metres and radians: `task`
    selects rows of one unit.

    With `Accept: image/svg+xml`, `image/png` or `application/pdf` the lever arms of a force on a planar arm are drawn.
    """,
    options=StaticsOptions,
    picture="A planar arm at one configuration, the force at its tip, and its lever arm about each joint.",
    npy_answer="Torques as one array of shape (N, n), or wrenches of shape (N, m) if torques were given.",
    example={
        "joint_positions": [[0.0, -0.785, 0.0, -2.356, 0.0, 1.571, 0.785]],
        "wrenches": [[0.0, 0.0, -10.0, 0.0, 0.0, 0.0]],
        "gravity": True,
        "payload": {"mass": 0.5, "center_of_mass": [0.0, 0.0, 0.05]},
    },
)
