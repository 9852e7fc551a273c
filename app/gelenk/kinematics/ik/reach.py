"""What distance alone tells: how near to its first joint a chain can bring its tip or wrist, and how far."""

from dataclasses import dataclass
from functools import lru_cache

import numpy as np

from gelenk.kinematics.ik.task import Task
from gelenk.model.arrays import Array
from gelenk.model.chain import Chain
from gelenk.model.poses import Poses


@dataclass(frozen=True, slots=True)
class Reach:
    """The shell around the first joint outside which no target lies that can be reached.

    Where a direction of the position is free, distances are taken along the others: none is longer than the whole.

    Attributes:
        center: A point on the first joint's axis, in the base; shape (3,), [m].
        offset: The point that is measured, in the tip: where the last joint stands if the whole orientation counts,
            else the tip itself; shape (3,), [m].
        weights: 1 for each direction of the position that counts, else 0; shape (3,).
        nearest: Radius of the hole, [m]; 0 where a direction is free.
        farthest: Radius of the whole, [m]; infinite with a sliding joint without limits.
    """

    center: Array
    offset: Array
    weights: Array
    nearest: float
    farthest: float

    def excess(self, targets: Poses) -> Array:
        """How far each target is outside the shell, negative inside; shape (N,), [m]."""
        distances = self.distances(targets)
        excess: Array = np.maximum(distances - self.farthest, self.nearest - distances)
        return excess

    def distances(self, targets: Poses) -> Array:
        """How far the measured point of each target is from the center; shape (N,), [m]."""
        points = targets.positions + targets.rotations @ self.offset
        distances: Array = np.sqrt(np.square((points - self.center) * self.weights).sum(axis=1))
        return distances

    def describe(self, target: Poses) -> str:
        """Why distance alone rules a single target out."""
        distance = float(self.distances(target)[0])
        what = "the last joint" if self.offset.any() else "the tip"
        far = distance > self.farthest
        bound = f"at most {self.farthest:.6g} m" if far else f"at least {self.nearest:.6g} m"
        return (
            f"beyond reach: {what} would be {distance:.6g} m from the first joint, "
            f"{float(self.excess(target)[0]):.3g} m {'more' if far else 'less'} than the links allow ({bound})"
        )


@lru_cache(maxsize=256)
def reach_of(chain: Chain, task: Task, respect_limits: bool) -> Reach | None:
    """The shell of a chain for a task; None where no position counts or no joint moves.

    Between the first and the last joint lie links of constant length; a sliding joint makes its link as short or long
    as its limits allow. By the triangle inequality the farthest is their sum, and the nearest what the longest has
    over the sum of the others.
    """
    weights = task.weights[:3]
    if not weights.any() or len(chain.flat.joints) == 0:
        return None
    last = chain.flat.placements[-1]
    whole = bool(task.weights.all())
    links = _link_lengths(chain, respect_limits, with_last=not whole)
    shortest, longest = links[:, 0], links[:, 1]
    total = float(longest.sum())
    nearest = 0.0
    if np.isfinite(total) and weights.all():
        nearest = max(0.0, float((shortest - (total - longest)).max()))
    offset = -(last[:9].reshape(3, 3).T @ last[9:]) if whole else np.zeros(3)
    return Reach(chain.flat.placements[0, 9:], offset, weights, nearest, total)


def _link_lengths(chain: Chain, respect_limits: bool, *, with_last: bool) -> Array:
    """Shortest and longest distance from each joint to the next, and from the last to the tip; shape (m, 2), [m]."""
    flat = chain.flat
    lengths = []
    for i, (prismatic, variable) in enumerate(flat.joints):
        t = flat.placements[i + 1, 9:] if with_last or i + 1 < len(flat.joints) else np.zeros(3)
        if not prismatic:
            lengths.append((float(np.linalg.norm(t)),) * 2)
            continue
        multiplier, offset = flat.drives[i]
        ends = [-np.inf, np.inf]
        if respect_limits:
            ends = sorted((multiplier * chain.lower[variable] + offset, multiplier * chain.upper[variable] + offset))
        # The slide goes along z before the link does: its length is that of (t_x, t_y, t_z + d).
        aside = float(np.hypot(t[0], t[1]))
        along = float(np.clip(0.0, t[2] + ends[0], t[2] + ends[1]))
        lengths.append((float(np.hypot(aside, along)), float(np.hypot(aside, max(abs(t[2] + end) for end in ends)))))
    return np.array(lengths)
