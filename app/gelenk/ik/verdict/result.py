"""Result types of inverse kinematics."""

from dataclasses import dataclass, field

from gelenk.ik.closed.closed_form import ClosedForm
from gelenk.ik.search.descent import Iterate
from gelenk.ik.search.words import Status, StopReason
from gelenk.robot.arrays import Array, Indices

COUNTED = -2
"""Branch code of a solution that continuation found instead of a closed form."""


@dataclass(frozen=True, slots=True)
class BlockingJoint:
    """A joint whose limit keeps a target from being reached.

    Attributes:
        name: Joint name.
        position: Position that the target requires, [rad or m].
        lower: Lower limit, [rad or m].
        upper: Upper limit, [rad or m].
        excess: Distance of the position beyond the limit, [rad or m].
    """

    name: str
    position: float
    lower: float
    upper: float
    excess: float


@dataclass(frozen=True, slots=True)
class UnsolvedTarget:
    """The reason why a target is unsolved, and the nearest configuration found.

    Attributes:
        reason: Explanation in words.
        nearest: Nearest configuration, within the limits if they count; shape (n,), [rad or m].
        position_error: Distance of its pose from the target, [m].
        orientation_error: Angle of its pose to the target, [rad].
        blocking_joints: For `outside_limits`, the joints beyond their limits.
        unserved_directions: Unit twists in the base's axes, linear before angular, that the tip cannot follow there;
            shape (k, 6).
        is_late: Whether time ran out before the target was solved or explained.
    """

    reason: str
    nearest: Array
    position_error: float
    orientation_error: float
    blocking_joints: tuple[BlockingJoint, ...] = ()
    unserved_directions: Array | None = None
    is_late: bool = False


@dataclass(frozen=True, slots=True)
class IterationPath:
    """The path of one iterative method to where it stopped.

    Attributes:
        stop_reason: Why the method stopped.
        trace: Every configuration of the iteration, if requested.
    """

    stop_reason: StopReason
    trace: list[Iterate] | None


@dataclass(frozen=True, slots=True)
class SolutionBranches:
    """Branch labels of M solutions, from a closed form or from continuation of six joints.

    Attributes:
        form: The closed form; None for six joints without one.
        codes: Bits of the roots chosen; `COUNTED` for a solution from continuation, -1 from a search; shape (M,).
        free: Bit mask: bit j is set if variable j was free and kept the seed's value; shape (M,).
    """

    form: ClosedForm | None
    codes: Indices
    free: Indices

    @property
    def name(self) -> str:
        """Name of the method that found the branches, in words."""
        return self.form.name if self.form else "six joints, by continuation"


@dataclass(frozen=True, slots=True)
class Family:
    """A continuum of solutions, connected by a motion of some joints while the others stay still.

    Attributes:
        free_joints: Names of the joints that move, base to tip.
        relation: Sums of these joints that stay constant, q_k being the chain's k-th joint; None if there are none.
        text: Description of the motion in words.
        sweep: Sample configurations in the order of the motion; shape (k, n), [rad or m].
    """

    free_joints: tuple[str, ...]
    relation: str | None
    text: str
    sweep: Array


@dataclass(frozen=True, slots=True)
class InverseKinematics:
    """Solutions of N targets in one table: rows firsts[i] up to, but not including, firsts[i + 1] belong to target i.

    Attributes:
        qs: Solutions; shape (M, n), [rad or m].
        position_errors: Errors of the poses recomputed with Pinocchio; shape (M,), [m].
        orientation_errors: Likewise; shape (M,), [rad].
        iterations: Iterations of the start that led to each solution; shape (M,).
        restarts: Number of starts that failed before it; shape (M,).
        method: Name of the iterative method.
        firsts: First row of each target's solutions, and M at the end; shape (N + 1,).
        statuses: Verdict on each target; N of them.
        failures: Failure of each unsolved target, by its index.
        complete: Whether each target's solutions are all there are; None if one was requested.
        doubts: Why a solved target may have other solutions, by its index.
        paths: Path of each target, if a single method was run or a trace requested.
        branches: Branch labels, if a closed form or continuation was used.
        families: Families of targets with infinitely many solutions, by index, if all were requested.
    """

    qs: Array
    position_errors: Array
    orientation_errors: Array
    iterations: Indices
    restarts: Indices
    method: str
    firsts: Indices
    statuses: list[Status]
    failures: dict[int, UnsolvedTarget] = field(default_factory=dict)
    complete: list[bool] | None = None
    doubts: dict[int, str] = field(default_factory=dict)
    paths: list[IterationPath] | None = None
    branches: SolutionBranches | None = None
    families: dict[int, tuple[Family, ...]] = field(default_factory=dict)

    def __len__(self) -> int:
        return len(self.statuses)
