"""The course's methods from one start, step by step, with a trace of the iterations.

The steps are pure functions of the m rows of J (m, n) and e (m,) that count, in [m] and [rad]; Δq (n,) is in
[rad or m].
"""

from collections.abc import Callable

import numpy as np

from gelenk.ik.search.kernels import DAMPING, FLOOR, LONGEST_STEP
from gelenk.ik.search.problem import DescentRule, TargetProblem
from gelenk.ik.search.words import Iterate, IterationPath, StepMethod, StopReason
from gelenk.robot.arrays import Array, Flags
from gelenk.robot.configuration import MAX_MAGNITUDE

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

_LOST = 1e-14
"""Share of the trace of JJᵀ below which rounding swallows the damping."""


def descend(problem: TargetProblem, i: int, start: Array, rule: DescentRule) -> IterationPath:
    """Run one method from one initial configuration, shape (n,), to target i.

    With limits, each step is clipped to them, and the damped method excludes joints that it would push further. Joints
    that turn freely may leave their limits on the way, since full turns bring them back.
    """
    bounds = problem.bounds[:2]
    q = np.clip(start, *bounds)
    trace: list[Iterate] = []
    most = problem.options.max_iterations or DEFAULT_ITERATIONS[rule.method]

    def at(q: Array) -> tuple[Array, Array]:
        es, Js = problem.linearised(i, q[None])
        return es[0], Js[0]

    for count in range(most + 1):
        e, J = at(q)
        error = float(np.linalg.norm(e))
        sigmas: Array = np.linalg.svd(J, compute_uv=False).astype(np.float64)
        method = rule.method
        if method == "gradient_then_newton":
            method = "gradient" if error > rule.switch_error else "newton"
        reason = stop_reason(e, J, sigmas, q, bounds, method, problem)
        if reason is None and count == most:
            reason = "iterations"
        if reason is None and problem.is_over:
            reason = "time_limit"
        following = q
        if reason is None:
            step = _step(rule, method, J, e, q, bounds, lambda q: at(q)[0])
            following = np.clip(q + step, *bounds)
            if not np.abs(following).max(initial=0.0) <= MAX_MAGNITUDE:
                reason = "diverged"
        trace.append(iterate(error, sigmas, q, None if reason else following, method))
        if reason is not None:
            return IterationPath(reason, trace)
        q = following
    raise AssertionError("the last iteration always gives a reason")


def iterate(error: float, sigmas: Array, q: Array, following: Array | None, method: StepMethod) -> Iterate:
    """Describe a configuration, its singular values and the step to the following one; None after the last."""
    smallest = float(sigmas[-1]) if len(sigmas) else 0.0
    if following is None:
        return Iterate(error, smallest, None, None, q.tolist())
    return Iterate(error, smallest, float(np.linalg.norm(following - q)), method, q.tolist())


def stop_reason(
    e: Array, J: Array, sigmas: Array, q: Array, bounds: Array, method: StepMethod, problem: TargetProblem
) -> StopReason | None:
    """Return why a method stops at a configuration with this error, or None to go on."""
    linear, tolerances = problem.task.positions, problem.tolerances
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


def newton_step(J: Array, e: Array) -> Array:
    """Newton step Δq = J⁻¹e, or J⁺e if J is not square [Siciliano2009, 3.7.1].

    Close to a singularity it grows like 1/σ_min: a weakness of Newton's method, not an error.
    """
    return np.asarray(np.linalg.pinv(J, rcond=1e-14) @ e)


def gradient_step(J: Array, e: Array, step_size: float) -> Array:
    """Gradient step Δq = α Jᵀe, downhill on H = ½‖e‖² [Siciliano2009, 3.7.2].

    Converges locally for 0 < α < 2/σ²_max(J), and stops wherever e lies in ker Jᵀ.
    """
    return np.asarray(step_size * (J.T @ e))


def damped_step(J: Array, e: Array, damping: float) -> Array:
    """Damped step Δq = Jᵀ(JJᵀ + λI)⁻¹e, which minimises ‖JΔq - e‖² + λ‖Δq‖² [Nakamura1986].

    λ ≥ 0 is `damping`, not its square root; zero, or so little that rounding swallows it, gives the pseudo-inverse.
    """
    gram = J @ J.T
    if damping <= _LOST * float(np.trace(gram)):
        return newton_step(J, e)
    return np.asarray(J.T @ np.linalg.solve(gram + damping * np.eye(len(J)), e))


def error_damping(e: Array) -> float:
    """Return λ proportional to ‖e‖², so that the damping fades near the target [Sugihara2011]."""
    return DAMPING * float(e @ e) + FLOOR
