"""What inverse kinematics answers with."""

from dataclasses import dataclass, field

from gelenk.kinematics.ik.closed_form import ClosedForm
from gelenk.kinematics.ik.descent import Iterate
from gelenk.kinematics.ik.words import Status, StopReason
from gelenk.model.arrays import Array, Indices

COUNTED = -2
"""The code of a solution that no closed form, but following all solutions of six joints has found."""


@dataclass(frozen=True, slots=True)
class BlockingJoint:
    """A joint whose limit keeps a target from being reached.

    Attributes:
        name: Of the joint.
        position: Where it would have to be, [rad or m].
        lower: Its lower limit.
        upper: Its upper limit.
        excess: How far beyond the limit that is.
    """

    name: str
    position: float
    lower: float
    upper: float
    excess: float


@dataclass(frozen=True, slots=True)
class Failure:
    """Why a target is not solved, and what comes nearest.

    Attributes:
        reason: In a sentence.
        nearest: The configuration that comes nearest, within the limits where they count; shape (n,).
        position_error: Its distance from the target, [m].
        orientation_error: Its angle from the target, [rad].
        blocking_joints: With `outside_limits`, the joints and by how much.
        unserved_directions: Unit twists in the base's axes, linear before angular, that the tip cannot follow there;
            shape (k, 6).
        is_late: Whether time ran out before it was solved or explained.
    """

    reason: str
    nearest: Array
    position_error: float
    orientation_error: float
    blocking_joints: tuple[BlockingJoint, ...] = ()
    unserved_directions: Array | None = None
    is_late: bool = False


@dataclass(frozen=True, slots=True)
class Path:
    """How a single method got to where it stopped.

    Attributes:
        stop_reason: Why it went no further.
        trace: Every configuration of the iteration, if requested.
    """

    stop_reason: StopReason
    trace: list[Iterate] | None


@dataclass(frozen=True, slots=True)
class SolutionBranches:
    """The branches of M solutions of a closed form, or of all of six joints.

    Attributes:
        form: The closed form; None of six joints without one.
        codes: Which roots it took; `COUNTED` where continuation has found the solution, -1 where a search has;
            shape (M,).
        free: Bit j where variable j was free and has kept the seed's value; shape (M,).
    """

    form: ClosedForm | None
    codes: Indices
    free: Indices

    @property
    def name(self) -> str:
        """How they are found, in words."""
        return self.form.name if self.form else "six joints, by continuation"


@dataclass(frozen=True, slots=True)
class Family:
    """Solutions that are joined by a motion of some joints, the others standing still.

    Attributes:
        free_joints: Names of the joints that move, base to tip.
        relation: Which sums of them stay, q_k being the chain's k-th joint; None where there is none.
        text: The same in words.
        sweep: Some of the configurations, in the order of the motion; shape (k, n), [rad or m].
    """

    free_joints: tuple[str, ...]
    relation: str | None
    text: str
    sweep: Array


@dataclass(frozen=True, slots=True)
class InverseKinematics:
    """Solutions of N targets, all of them in one table: those of target i are its rows firsts[i] to firsts[i + 1].

    Attributes:
        qs: Solutions; shape (M, n), [rad or m].
        position_errors: Recomputed through Pinocchio; shape (M,), [m].
        orientation_errors: Likewise; shape (M,), [rad].
        iterations: Of the start that led there; shape (M,).
        restarts: How many starts had failed before; shape (M,).
        method: What found them.
        firsts: Where each target's solutions begin; shape (N + 1,).
        statuses: The verdict on each target; N.
        failures: Of each unsolved target, by its number.
        complete: Whether these are all solutions, of each target; None where one was requested.
        doubts: Of targets that are solved, by their number, why these may not be all solutions.
        paths: Of each target, where a single method was followed or a trace was requested.
        branches: Of each solution, where a closed form was used.
        families: Of targets with infinitely many solutions, by their number, where all were requested.
    """

    qs: Array
    position_errors: Array
    orientation_errors: Array
    iterations: Indices
    restarts: Indices
    method: str
    firsts: Indices
    statuses: list[Status]
    failures: dict[int, Failure] = field(default_factory=dict)
    complete: list[bool] | None = None
    doubts: dict[int, str] = field(default_factory=dict)
    paths: list[Path] | None = None
    branches: SolutionBranches | None = None
    families: dict[int, tuple[Family, ...]] = field(default_factory=dict)

    def __len__(self) -> int:
        return len(self.statuses)
