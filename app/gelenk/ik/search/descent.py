"""The course's methods from one start, step by step, with a trace of the iterations."""

from collections.abc import Callable
from dataclasses import dataclass
from typing import Literal, TypeAlias

import numpy as np

from gelenk.ik.search.kernels import LONGEST_STEP
from gelenk.ik.search.linearise import linearise
from gelenk.ik.search.search import is_over, search_bounds
from gelenk.ik.search.steps import damped_step, error_damping, gradient_step, newton_step
from gelenk.ik.search.task import Task
from gelenk.ik.search.words import StopReason
from gelenk.robot.arrays import Array, Flags
from gelenk.robot.chain import Chain
from gelenk.robot.configuration import MAX_MAGNITUDE
from gelenk.robot.poses import Poses

StepMethod: TypeAlias = Literal["newton", "gradient", "gradient_then_newton", "damped_least_squares"]

DEFAULT_ITERATIONS: dict[StepMethod, int] = {
    "newton": 100,
    "gradient": 5000,
    "gradient_then_newton": 5000,
    "damped_least_squares": 500,
}
"""Iterations if a call sets no bound: the gradient converges linearly and needs hundreds."""

_KERNEL = 1e-8
"""Share of σ_max‖e‖ below which Jᵀe counts as zero: e lies in ker Jᵀ."""
_SINGULAR = 1e-12
"""Share of σ_max below which σ_min counts as zero, and Newton's step as undefined."""


@dataclass(frozen=True, slots=True)
class Iterate:
    """One configuration of an iteration.

    Attributes:
        joint_positions: q; shape (n,), [rad or m].
        error: ‖e‖ in the directions that count, [m and rad mixed].
        min_singular_value: σ_min of J in these directions, [m or rad per rad or m, mixed].
        step_length: ‖Δq‖ of the step taken from here; None at the last configuration.
        method: Method of that step; None at the last configuration.
    """

    joint_positions: Array
    error: float
    min_singular_value: float
    step_length: float | None
    method: str | None


@dataclass(frozen=True, slots=True)
class Descent:
    """The result of one method from one start.

    Attributes:
        joint_positions: The last configuration; shape (n,), [rad or m].
        stop_reason: Why the method stopped.
        trace: All configurations, including the first and the last.
    """

    joint_positions: Array
    stop_reason: StopReason
    trace: list[Iterate]


@dataclass(frozen=True, slots=True)
class DescentRule:
    """A method and its parameters.

    Attributes:
        method: Name of the method.
        step_size: α of the gradient; None for a line search.
        damping: λ of damped least squares; None for an adaptive λ, which starts in proportion to ‖e‖².
        switch_error: ‖e‖ at which `gradient_then_newton` switches to Newton.
        max_iterations: Largest number of steps; None for the method's default.
    """

    method: StepMethod
    step_size: float | None = None
    damping: float | None = None
    switch_error: float = 1e-2
    max_iterations: int | None = None


def descend(
    chain: Chain,
    target: Poses,
    seed: Array,
    rule: DescentRule,
    *,
    task: Task,
    tolerances: tuple[float, float],
    respect_limits: bool = True,
    deadline: float | None = None,
) -> Descent:
    """Run one method from one start.

    With limits, each step is clipped to them, and the damped method excludes joints that it would push further. Joints
    that turn freely may leave their limits on the way, since full turns bring them back.

    Args:
        chain: Base and tip.
        target: The desired T_base_tip; one pose.
        seed: Initial configuration; shape (n,), [rad or m].
        rule: The method and its parameters.
        task: Which directions count.
        tolerances: Of position [m] and orientation [rad].
        respect_limits: Whether to respect joint limits.
        deadline: When to stop, on `gelenk.robot.compilation.clock`, [s].
    """
    bounds = search_bounds(chain, respect_limits)[:2]
    q = np.clip(seed, *bounds)
    trace: list[Iterate] = []
    most = DEFAULT_ITERATIONS[rule.method] if rule.max_iterations is None else rule.max_iterations
    linear = task.positions

    def at(q: Array) -> tuple[Array, Array]:
        es, Js = linearise(chain, target, q[None], task)
        return es[0], Js[0]

    for count in range(most + 1):
        e, J = at(q)
        error = float(np.linalg.norm(e))
        sigmas: Array = np.linalg.svd(J, compute_uv=False).astype(np.float64)
        method = _method(rule, error)
        reason = stop_reason(e, J, sigmas, q, bounds, method, linear, tolerances)
        if reason is None and count == most:
            reason = "iterations"
        if reason is None and is_over(deadline):
            reason = "time_limit"
        smallest = float(sigmas[-1]) if len(sigmas) else 0.0
        if reason is not None:
            trace.append(Iterate(q, error, smallest, None, None))
            return Descent(q, reason, trace)
        step = _step(rule, method, J, e, q, bounds, lambda q: at(q)[0])
        following = np.clip(q + step, *bounds)
        if not np.abs(following).max(initial=0.0) <= MAX_MAGNITUDE:
            trace.append(Iterate(q, error, smallest, None, None))
            return Descent(q, "diverged", trace)
        trace.append(Iterate(q, error, smallest, float(np.linalg.norm(following - q)), method))
        q = following
    raise AssertionError("the last iteration always gives a reason")


def _method(rule: DescentRule, error: float) -> StepMethod:
    if rule.method == "gradient_then_newton":
        return "gradient" if error > rule.switch_error else "newton"
    return rule.method


def stop_reason(
    e: Array,
    J: Array,
    sigmas: Array,
    q: Array,
    bounds: Array,
    method: StepMethod,
    linear: int,
    tolerances: tuple[float, float],
) -> StopReason | None:
    """Return why a method stops here, or None to go on; the first `linear` rows of e belong to the position."""
    if np.linalg.norm(e[:linear]) <= tolerances[0] and np.linalg.norm(e[linear:]) <= tolerances[1]:
        return "converged"
    slope = J.T @ e
    scale = _KERNEL * (float(sigmas[0]) if len(sigmas) else 0.0) * float(np.linalg.norm(e))
    if np.linalg.norm(slope) <= scale:
        return "stagnated"
    if np.linalg.norm(slope[~blocked(slope, q, bounds)]) <= scale:
        return "at_limits"
    if method == "newton" and sigmas[-1] <= _SINGULAR * sigmas[0]:
        return "near_singular"
    return None


def blocked(slope: Array, q: Array, bounds: Array) -> Flags:
    """Flag the joints that are at a bound and that the slope would push further; shape (n,)."""
    outwards: Flags = ((q <= bounds[0]) & (slope < 0.0)) | ((q >= bounds[1]) & (slope > 0.0))
    return outwards


def _step(
    rule: DescentRule,
    method: StepMethod,
    J: Array,
    e: Array,
    q: Array,
    bounds: Array,
    error_at: Callable[[Array], Array],
) -> Array:
    if method == "newton":
        return newton_step(J, e)
    if method == "gradient":
        size = _line_search(J, e, q, bounds, error_at) if rule.step_size is None else rule.step_size
        return gradient_step(J, e, size)
    free = np.where(blocked(J.T @ e, q, bounds), 0.0, 1.0)
    if rule.damping is not None:
        return damped_step(J * free, e, rule.damping)
    return _adaptive_step(J * free, e, q, bounds, error_at)


def _adaptive_step(J: Array, e: Array, q: Array, bounds: Array, error_at: Callable[[Array], Array]) -> Array:
    """Damped step, with the damping raised tenfold until the error falls [Marquardt1963]."""
    damping = error_damping(e)
    step = np.zeros_like(q)
    for _ in range(20):
        step = shortened(damped_step(J, e, damping), LONGEST_STEP)
        if np.linalg.norm(error_at(np.clip(q + step, *bounds))) < np.linalg.norm(e):
            break
        damping *= 10.0
    return step


def shortened(step: Array, most: float) -> Array:
    """Scale a step down so that no joint moves further than `most`; shape (n,)."""
    return step * (most / max(float(np.abs(step).max(initial=0.0)), most))


def _line_search(J: Array, e: Array, q: Array, bounds: Array, error_at: Callable[[Array], Array]) -> float:
    """Find α by halving from the minimum of the linear model until ½‖e‖² falls enough [Nocedal2006, 3.1]."""
    slope = J.T @ e
    along = J @ slope
    size = float(slope @ slope) / max(float(along @ along), 1e-300)
    for _ in range(40):
        trial = np.clip(q + size * slope, *bounds)
        after = error_at(trial)
        if float(after @ after) <= float(e @ e) - 2e-4 * float(slope @ (trial - q)):
            break
        size *= 0.5
    return size
