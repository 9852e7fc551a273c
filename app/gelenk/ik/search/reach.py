"""Bounds on reach by distance alone: how near to and far from its first joint a chain can bring its tip or wrist."""

from dataclasses import dataclass
from functools import lru_cache

import numpy as np

from gelenk.ik.search.task import Task
from gelenk.robot.arrays import Array
from gelenk.robot.chain import Chain
from gelenk.robot.poses import Poses


@dataclass(frozen=True, slots=True)
class Reach:
    """A spherical shell around the first joint that contains all reachable targets.

    If a position direction is free, distances are measured along the others, which never makes them longer.

    Attributes:
        center: A point on the first joint's axis, in the base frame; shape (3,), [m].
        offset: The measured point in the tip frame: the last joint's origin if the whole pose counts, else the tip's;
            shape (3,), [m].
        weights: 1 for each position direction that counts, else 0; shape (3,).
        nearest: Inner radius, [m]; 0 if a position direction is free.
        farthest: Outer radius, [m]; infinite for a prismatic joint without limits.
    """

    center: Array
    offset: Array
    weights: Array
    nearest: float
    farthest: float

    def excess(self, targets: Poses) -> Array:
        """Distance of each target from the shell, positive outside and negative inside; shape (N,), [m]."""
        distances = self.distances(targets)
        excess: Array = np.maximum(distances - self.farthest, self.nearest - distances)
        return excess

    def distances(self, targets: Poses) -> Array:
        """Distance of each target's measured point from the center; shape (N,), [m]."""
        # One product of a matrix with a vector takes a fraction of the time of one for each target.
        offsets = (targets.rotations.reshape(-1, 3) @ self.offset).reshape(-1, 3)
        distances: Array = np.sqrt(np.square(targets.positions + offsets - self.center) @ self.weights)
        return distances

    def describe(self, target: Poses) -> str:
        """Explain why a single target is out of reach by distance alone."""
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
    """Compute the shell of a chain for a task; None if no position direction counts or no joint moves.

    Links of constant length connect the first joint to the last; a prismatic joint varies its link's length within its
    limits. By the triangle inequality the outer radius is the sum of the longest lengths, and the inner radius the
    largest excess of one link's shortest length over the longest lengths of all others.
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
        # The joint slides along z before the link: the total length is that of (t_x, t_y, t_z + d).
        aside = float(np.hypot(t[0], t[1]))
        along = float(np.clip(0.0, t[2] + ends[0], t[2] + ends[1]))
        lengths.append((float(np.hypot(aside, along)), float(np.hypot(aside, max(abs(t[2] + end) for end in ends)))))
    return np.array(lengths)
