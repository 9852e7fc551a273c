"""Joint steps of the course's methods, as pure functions of the Jacobian and the error.

Each takes the m rows of J (m, n) and e (m,) that count, in [m] and [rad], and returns Δq (n,) in [rad or m].
"""

import numpy as np

from gelenk.ik.search.kernels import DAMPING, FLOOR
from gelenk.robot.arrays import Array

_LOST = 1e-14
"""Share of the trace of JJᵀ below which rounding swallows the damping."""


def newton_step(J: Array, e: Array) -> Array:
    """Newton step Δq = J⁻¹e, or J⁺e if J is not square [Siciliano2009, 3.7.1].

    Close to a singularity it grows like 1/σ_min: a weakness of Newton's method, not an error.
    """
    step: Array = np.linalg.pinv(J, rcond=1e-14) @ e
    return step


def gradient_step(J: Array, e: Array, step_size: float) -> Array:
    """Gradient step Δq = α Jᵀe, downhill on H = ½‖e‖² [Siciliano2009, 3.7.2].

    Converges locally for 0 < α < 2/σ²_max(J), and stops wherever e lies in ker Jᵀ.
    """
    step: Array = step_size * (J.T @ e)
    return step


def damped_step(J: Array, e: Array, damping: float) -> Array:
    """Damped step Δq = Jᵀ(JJᵀ + λI)⁻¹e, which minimises ‖JΔq - e‖² + λ‖Δq‖² [Nakamura1986].

    Args:
        J: Jacobian rows that count; shape (m, n).
        e: The error; shape (m,).
        damping: λ ≥ 0, not its square root; zero, or so little that rounding swallows it, gives the pseudo-inverse.
    """
    gram = J @ J.T
    if damping <= _LOST * float(np.trace(gram)):
        return newton_step(J, e)
    step: Array = J.T @ np.linalg.solve(gram + damping * np.eye(len(J)), e)
    return step


def error_damping(e: Array) -> float:
    """Return λ proportional to ‖e‖², so that the damping fades near the target [Sugihara2011]."""
    return DAMPING * float(e @ e) + FLOOR
