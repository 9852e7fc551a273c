"""The course's steps: how an error becomes a change of the joints. Pure functions of the Jacobian and the error.

Each takes the m rows that count, of J (m, n) and of e (m,), in [m] and [rad], and gives Δq (n,) in [rad or m].
"""

import numpy as np

from gelenk.kinematics.ik.kernels import DAMPING, FLOOR
from gelenk.model.arrays import Array

_LOST = 1e-14
"""Share of the trace of JJᵀ below which a damping is lost in rounding."""


def newton_step(J: Array, e: Array) -> Array:
    """Δq = J⁻¹e, and J⁺e where J is not square [Siciliano2009, 3.7.1].

    Close to a singularity it is as large as 1/σ_min makes it: that is Newton's weakness, not an error.
    """
    step: Array = np.linalg.pinv(J, rcond=1e-14) @ e
    return step


def gradient_step(J: Array, e: Array, step_size: float) -> Array:
    """Δq = α Jᵀe, down the gradient of H = ½‖e‖² [Siciliano2009, 3.7.2].

    Converges locally where 0 < α < 2/σ²_max(J), and stands still wherever e lies in ker Jᵀ.
    """
    step: Array = step_size * (J.T @ e)
    return step


def damped_step(J: Array, e: Array, damping: float) -> Array:
    """Δq = Jᵀ(JJᵀ + λI)⁻¹e, which minimises ‖JΔq - e‖² + λ‖Δq‖² [Nakamura1986].

    Args:
        J: The rows that count; shape (m, n).
        e: The error; shape (m,).
        damping: λ ≥ 0 itself, not its root; zero, or what rounding makes of it, gives the pseudo-inverse.
    """
    gram = J @ J.T
    if damping <= _LOST * float(np.trace(gram)):
        return newton_step(J, e)
    step: Array = J.T @ np.linalg.solve(gram + damping * np.eye(len(J)), e)
    return step


def error_damping(e: Array) -> float:
    """λ in proportion to the squared error, so that damping fades as the target comes near [Sugihara2011]."""
    return DAMPING * float(e @ e) + FLOOR
