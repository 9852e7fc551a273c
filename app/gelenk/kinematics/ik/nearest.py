"""What comes nearest to a target out of reach, brought to the bottom of its valley.

Damped least squares leaves the curvature of the error out, and so creeps where an error stays: Newton's method with the
whole second derivative does not.
"""

import numpy as np

from gelenk.kinematics.ik.descent import blocked
from gelenk.kinematics.ik.linearise import linearise
from gelenk.kinematics.ik.search import search_bounds
from gelenk.kinematics.ik.verdict import Question
from gelenk.model.arrays import Array

_STEPS, _HALVINGS = 20, 6
_LONGEST = 0.2
"""Of a step in any joint, [rad or m]."""
_STATIONARY, _GAIN = 1e-7, 1e-12
"""Shares of σ_max‖e‖ below which a slope counts as none, and of the error that a step gains at least."""
_DIFFERENCE, _FLAT = 1e-5, 1e-9
"""Of a joint, for the second derivatives, [rad or m]; and the share of the largest of these that all are raised to."""


def polished(question: Question, i: int, q: Array) -> Array:
    """The least error near a configuration, which is as near to the target or nearer; shape (n,).

    Args:
        question: The targets.
        i: Which of them.
        q: Where a search ended; shape (n,), [rad or m].
    """
    chain, target = question.chain, question.taken(np.array([i]))
    bounds = search_bounds(chain, question.respect_limits)

    def slopes(qs: Array) -> tuple[Array, Array, Array]:
        """½‖e‖², its slope -Jᵀe and σ_max‖e‖, which it is small beside; shapes (k,), (k, n), (k,)."""
        es, Js = linearise(chain, target.taken(np.zeros(len(qs), dtype=np.int64)).targets, qs, question.task)
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
    """Newton's step, downhill also where the second derivative is not positive: there its size counts."""
    values, vectors = np.linalg.eigh(0.5 * (second + second.T))
    sizes = np.maximum(np.abs(values), _FLAT * np.abs(values).max())
    step: Array = -vectors @ ((vectors.T @ slope) / sizes)
    return step
