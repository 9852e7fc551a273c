"""Refinement of the configuration nearest to an unreachable target, down to a local minimum of the error.

Damped least squares ignores the curvature of the error, so it converges slowly where an error remains. Newton's method
with the full Hessian does not.
"""

import numpy as np

from gelenk.ik.search.descent import blocked
from gelenk.ik.search.problem import TargetProblem
from gelenk.robot.arrays import Array

_STEPS, _HALVINGS = 20, 6
_LONGEST = 0.2
"""Longest step of any joint, [rad or m]."""
_STATIONARY, _GAIN = 1e-7, 1e-12
"""Share of ‖J‖‖e‖ below which the gradient counts as zero, and least share of the error that a step must gain."""
_DIFFERENCE, _FLAT = 1e-5, 1e-9
"""Joint step of the finite differences, [rad or m]; least curvature, as a share of the largest."""


def polished(problem: TargetProblem, i: int, q: Array) -> Array:
    """Descend from the end of a search to a nearby minimum of the error, never to a larger one; shape (n,)."""
    bounds = problem.bounds

    def slopes(qs: Array) -> tuple[Array, Array, Array]:
        """Return ½‖e‖², its gradient -Jᵀe, and ‖J‖‖e‖ to compare that with; shapes (k,), (k, n), (k,)."""
        es, Js = problem.linearised(i, qs)
        sizes = np.linalg.norm(Js, axis=(1, 2)) * np.linalg.norm(es, axis=1)
        return 0.5 * np.sum(es * es, axis=1), -np.einsum("kmn,km->kn", Js, es), sizes

    for _ in range(_STEPS):
        (error,), (slope,), (size,) = slopes(q[None])
        free = ~blocked(-slope, q, bounds)
        if np.linalg.norm(slope[free]) <= _STATIONARY * size:
            break
        ahead, behind = (slopes(q + sign * _DIFFERENCE * np.eye(len(q)))[1] for sign in (1.0, -1.0))
        step = _newton(((ahead - behind) / (2.0 * _DIFFERENCE))[np.ix_(free, free)], slope[free])
        full = np.zeros(len(q))
        full[free] = step * min(1.0, _LONGEST / np.abs(step).max())
        tried = np.clip(q + 0.5 ** np.arange(_HALVINGS)[:, None] * full, bounds[0], bounds[1])
        errors = slopes(tried)[0]
        best = int(np.argmin(errors))
        if not errors[best] < error * (1.0 - _GAIN):
            break
        q = tried[best]
    return q


def _newton(second: Array, slope: Array) -> Array:
    """Newton step by absolute eigenvalues, so that it goes downhill even where the Hessian is indefinite."""
    values, vectors = np.linalg.eigh(0.5 * (second + second.T))
    sizes = np.maximum(np.abs(values), _FLAT * np.abs(values).max())
    return np.asarray(-vectors @ ((vectors.T @ slope) / sizes))
