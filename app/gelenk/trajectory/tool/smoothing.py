"""Turns of the tool between those that were tried: the most even motion of the joints next to the best sequence.

With q(θ) linearised about each configuration, ∂q/∂θ = J⁻¹ (0; a), the sum of the squared joint rates along the path is
quadratic in the changes of all θ; its minimum solves a tridiagonal system. Closed forms give the exact configurations.
"""

from dataclasses import dataclass, replace

import numpy as np

from gelenk.ik.closed.closed_form import ClosedForm
from gelenk.kinematics.simd.kernels import chain_jacobians
from gelenk.robot.arrays import Array, Flags
from gelenk.robot.notations import rotations_from_vectors
from gelenk.robot.poses import Poses
from gelenk.trajectory.motion.tridiagonal import Tridiagonal, solution
from gelenk.trajectory.tool.candidates import Clear, solved_near

_ROUNDS = 20
_FARTHEST = 0.3
"""Largest change of a turn in a round, [rad]: as far as q(θ) is nearly linear."""
_SETTLED = 1e-4
"""Relative decrease of the sum below which rounds end."""
_LARGEST = 0.5
"""Largest change of a joint in a round, [rad or m]: beyond it the nearest solution is on another branch."""
_DAMPING = 1e-9
"""Share of the largest diagonal entry that is added to all."""


@dataclass(frozen=True, slots=True)
class TurnedRungs:
    """Poses of the tip with the turns chosen and the configurations, one of each rung.

    Attributes:
        places: s of each rung; shape (R,), [m].
        turns: Shape (R,), [rad].
        qs: Shape (R, n), [rad or m].
    """

    poses: Poses
    places: Array
    turns: Array
    qs: Array

    def effort(self, weights: Array) -> float:
        """Return the sum that is minimised: of the squared joint rates along s."""
        rates = weights * np.diff(self.qs, axis=0)
        return float((np.square(rates).sum(axis=1) / np.diff(self.places)).sum())


def smoothed(form: ClosedForm, rungs: TurnedRungs, axis: Array, weights: Array, clear: Clear) -> TurnedRungs:
    """Return the rungs with the turns of the most even joint motion next to theirs.

    Turns that would lead beyond a limit, or where the arm is not clear, stay.
    """
    free, before = np.ones(len(rungs.turns), dtype=bool), rungs.effort(weights)
    for _ in range(_ROUNDS):
        change = _changes(form, rungs, axis, weights, free)
        change *= min(1.0, _FARTHEST / max(float(np.abs(change).max()), 1e-300))
        tried, solved = _turned(form, rungs, axis, change, clear)
        free &= solved
        after = tried.effort(weights)
        if not after < before:
            break
        rungs, settled, before = tried, after > (1.0 - _SETTLED) * before, after
        if settled:
            break
    return rungs


def _changes(form: ClosedForm, rungs: TurnedRungs, axis: Array, weights: Array, free: Flags) -> Array:
    """Return the changes of the turns that minimise the linearised sum, zero where not free; shape (R,), [rad]."""
    _, rotations, Js = chain_jacobians(form.chain.flat, rungs.qs)
    twists = np.concatenate((np.zeros((len(Js), 3)), rotations @ axis), axis=1)
    rates = weights * np.linalg.solve(Js, twists[:, :, None])[:, :, 0] * free[:, None]
    per_s = 1.0 / np.diff(rungs.places)
    steps = weights * np.diff(rungs.qs, axis=0) * per_s[:, None]
    pulls = np.zeros(len(rates))
    pulls[:-1] += (rates[:-1] * steps).sum(axis=1)
    pulls[1:] -= (rates[1:] * steps).sum(axis=1)
    squares, beside = np.square(rates).sum(axis=1), -(rates[:-1] * rates[1:]).sum(axis=1) * per_s
    diagonal = squares * (np.append(per_s, 0.0) + np.append(0.0, per_s))
    diagonal = np.where(free, diagonal + _DAMPING * diagonal.max(), 1.0)
    A = Tridiagonal(np.append(0.0, beside), diagonal, np.append(beside, 0.0))
    return solution(A, pulls[:, None])[:, 0]


def _turned(
    form: ClosedForm, rungs: TurnedRungs, axis: Array, change: Array, clear: Clear
) -> tuple[TurnedRungs, Flags]:
    """Return the rungs with changed turns where there is a configuration on the same branch, and where there is."""
    turns = rungs.turns + change
    rotations = rungs.poses.rotations @ rotations_from_vectors(turns[:, None] * axis)
    table, solved = solved_near(form, Poses(rungs.poses.positions, rotations), rungs.qs)
    qs = rungs.qs.copy()
    qs[solved] = table.qs
    predicted = np.abs(qs - rungs.qs).max(axis=1) <= _LARGEST
    solved &= predicted & clear.flags(form, qs)
    keep = solved[:, None]
    return replace(rungs, turns=np.where(solved, turns, rungs.turns), qs=np.where(keep, qs, rungs.qs)), solved
