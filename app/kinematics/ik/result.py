"""What inverse kinematics answers with."""

from dataclasses import dataclass, field

from app.kinematics.ik.closed_form import ClosedForm
from app.kinematics.ik.descent import Iterate
from app.kinematics.ik.words import Status, StopReason
from app.model.arrays import Array, Indices


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
        trace: Every configuration on the way, where it was asked for.
    """

    stop_reason: StopReason
    trace: list[Iterate] | None


@dataclass(frozen=True, slots=True)
class SolutionBranches:
    """The branches of M solutions of a closed form.

    Attributes:
        form: The closed form.
        codes: Which roots it took, -1 where it was not used; shape (M,).
        free: Bit j where variable j was free and has kept the seed's value; shape (M,).
    """

    form: ClosedForm
    codes: Indices
    free: Indices


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
        complete: Whether these are all solutions, of each target; None where one was asked for.
        paths: Of each target, where a single method was followed or a trace was asked for.
        branches: Of each solution, where a closed form was used.
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
    paths: list[Path] | None = None
    branches: SolutionBranches | None = None

    def __len__(self) -> int:
        return len(self.statuses)
