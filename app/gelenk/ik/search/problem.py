"""A problem of inverse kinematics: targets for a chain, and how they are to be solved."""

import math
from collections.abc import Callable, Mapping
from dataclasses import dataclass, field
from typing import TYPE_CHECKING

import numpy as np

from gelenk.ik.search.bounds import limits_of, make_goal, search_bounds
from gelenk.ik.search.iteration import Goal
from gelenk.ik.search.linearise import linearise
from gelenk.ik.search.reach import Reach, reach_of
from gelenk.ik.search.task import FULL_POSE, Task
from gelenk.ik.search.words import Method, SelfMotionObjective, StepMethod
from gelenk.robot.arrays import Array, Flags, Indices
from gelenk.robot.chain import Chain
from gelenk.robot.compilation import clock
from gelenk.robot.poses import Poses

if TYPE_CHECKING:
    from gelenk.robot.robot import RobotModel


@dataclass(frozen=True, slots=True)
class Objective:
    """A function to minimise along the self-motion.

    Attributes:
        name: `posture`: ½‖q - posture‖². `mid_range`: ½ Σ ((q - middle) / range)² of the joints with limits. `limits`:
            Σ range² / (4 (upper - q)(q - lower)), which grows without bound at the limits. `manipulability`: -log of
            Yoshikawa's measure √det JJᵀ of the directions that count, metres and radians mixed. `clearance`: minus the
            clearance.
        posture: Target of `posture`; shape (n,), or (N, n) for one per solution, [rad or m].
        clearance: Returns clearances (N,), [m], and their gradients (N, n) at configurations of the chain.
    """

    name: SelfMotionObjective
    posture: Array | None = None
    clearance: Callable[[Array], tuple[Array, Array]] | None = None


@dataclass(frozen=True, slots=True)
class DescentRule:
    """A method and its parameters.

    Attributes:
        step_size: α of the gradient; None for a line search.
        damping: λ of damped least squares; None for an adaptive λ, which starts in proportion to ‖e‖².
        switch_error: ‖e‖ at which `gradient_then_newton` switches to Newton.
    """

    method: StepMethod
    step_size: float | None = None
    damping: float | None = None
    switch_error: float = 1e-2


@dataclass(slots=True)  # not frozen: each request makes one, and freezing triples its cost
class Options:
    """Options of an inverse kinematics call.

    Attributes:
        position_tolerance, orientation_tolerance: Largest errors, [m] and [rad].
        every: Whether to find all solutions.
        most: Largest number of solutions of one target.
        windings: Whether solutions that differ by full turns count as different, where limits allow them.
        method: `auto`; `analytic`, a closed form, an elimination or a continuation; or one of the course's methods,
            which start from the seed alone.
        max_iterations: Budget for a target; None for the method's default.
        time_limit: Time for all targets without compilation, [s].
        elbow_angle: Desired angle of a free elbow, [rad]; only for a closed form that has one.
        fixed_joints: Values of the held variables by name, [rad or m].
    """

    task: Task = FULL_POSE
    position_tolerance: float = 1e-6
    orientation_tolerance: float = 1e-6
    respect_limits: bool = True
    every: bool = False
    most: int = 100
    windings: bool = False
    method: Method = "auto"
    rule: DescentRule | None = None
    max_iterations: int | None = None
    time_limit: float | None = None
    random_seed: int = 0
    objective: Objective | None = None
    elbow_angle: float | None = None
    trace: bool = False
    fixed_joints: Mapping[str, float] = field(default_factory=dict)


@dataclass(slots=True)  # not frozen: each request makes one, and freezing triples its cost
class TargetProblem:
    """Targets for a chain, and how they are to be solved.

    Attributes:
        targets: Desired T_base_tip; N of them.
        seeds: One configuration for all targets or one each; shape (1 or N, n), [rad or m].
        deadline: When to stop, on `gelenk.robot.compilation.clock`, [s]; None for no limit.
        is_draft: Whether the answer is one stage of another, which is compared with Pinocchio's own poses at its end.
    """

    robot: "RobotModel"
    chain: Chain
    targets: Poses
    seeds: Array
    options: Options
    deadline: float | None = None
    is_draft: bool = False

    def __len__(self) -> int:
        return len(self.targets)

    @property
    def task(self) -> Task:
        """Which directions count."""
        return self.options.task

    @property
    def tolerances(self) -> tuple[float, float]:
        """Tolerances of position [m] and orientation [rad]."""
        return self.options.position_tolerance, self.options.orientation_tolerance

    @property
    def limits(self) -> Array:
        """Lower and upper limits of the variables, infinite if they do not count; shape (2, n), [rad or m]."""
        return limits_of(self.chain, self.options.respect_limits)

    @property
    def bounds(self) -> Array:
        """Bounds of a search, see `Goal.bounds`; shape (6, n), [rad or m]."""
        return search_bounds(self.chain, self.options.respect_limits)

    @property
    def is_over(self) -> bool:
        """Whether the deadline has passed."""
        return self.deadline is not None and clock() > self.deadline

    @property
    def reach(self) -> Reach | None:
        """The bounds on reach by distance alone; None if there are none."""
        return reach_of(self.chain, self.task, self.options.respect_limits)

    def too_far(self) -> Flags:
        """Flag the targets beyond reach by distance alone; shape (N,)."""
        reach = self.reach
        if reach is None:
            return np.zeros(len(self), dtype=bool)
        # The orientation tolerance lets the wrist move, and the sums of lengths are rounded.
        room = self.tolerances[0] + self.tolerances[1] * math.hypot(*reach.offset) + 1e-9
        return reach.excess(self.targets) > room

    def goal(self, starts: int, slack: float = 0.0) -> Goal:
        """Return the input of the kernels for a number of starts; for the slack see `Goal`."""
        options = self.options
        return make_goal(
            self.chain, self.task, self.tolerances, options.respect_limits, starts, options.random_seed, slack
        )

    def seed(self, i: int) -> Array:
        """Return the seed of one target; shape (n,)."""
        return np.asarray(self.seeds[i if len(self.seeds) > 1 else 0])

    def target(self, i: int) -> Poses:
        """Return one of the targets, as poses of length 1."""
        return Poses(self.targets.positions[i : i + 1], self.targets.rotations[i : i + 1])

    def taken(self, rows: Flags | Indices | slice) -> "TargetProblem":
        """Return the problem for some of the targets only."""
        targets = Poses(self.targets.positions[rows], self.targets.rotations[rows])
        seeds = self.seeds[rows] if len(self.seeds) > 1 else self.seeds
        return TargetProblem(self.robot, self.chain, targets, seeds, self.options, self.deadline, self.is_draft)

    def linearised(self, i: int, qs: Array) -> tuple[Array, Array]:
        """Errors of configurations to one target, shape (N, m), and their Jacobians (N, m, n), see `linearise`."""
        return linearise(self.chain, self.target(i), qs, self.task)
