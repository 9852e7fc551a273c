"""Share of a set of orientations that a chain can reach at a position, by inverse kinematics.

The set is fixed and evenly distributed: over all rotations, over all directions of the tip's z axis, or, for a planar
arm or a SCARA, over the rotations about its single axis.
"""

import math
from dataclasses import dataclass
from typing import Literal, TypeAlias

import numpy as np

from gelenk.collision.cell import Cell
from gelenk.ik.search.bounds import mid_range
from gelenk.ik.search.problem import Options, TargetProblem
from gelenk.ik.search.task import FULL_POSE, Task
from gelenk.ik.solve import solve
from gelenk.kinematics.simd.kernels import chain_poses
from gelenk.kinematics.workspace.tip_motion import TipReach
from gelenk.robot.arrays import Array
from gelenk.robot.chain import Chain, rotation_to_axis
from gelenk.robot.notations import rotations_from_quaternions_xyzw, rotations_from_vectors
from gelenk.robot.poses import Poses
from gelenk.robot.robot import RobotModel

Over: TypeAlias = Literal["rotations", "approach_directions"]
Spread: TypeAlias = Literal["rotations", "approach_directions", "turns", "fixed"]

_SECOND_RATIO = 1.533751168755204288118041
"""The second ratio of the spiral: the root of ψ⁴ = ψ + 4."""
_ITERATIONS = 1280
"""Iteration budget per orientation: 64 starts, besides the configuration that reached the cell."""


@dataclass(frozen=True, slots=True)
class Orientations:
    """A set of orientations to reach, K of them, shape (K, 3, 3); its spread is `fixed` if the tip never rotates."""

    spread: Spread
    rotations: Array
    task: Task


def orientations(chain: Chain, motion: TipReach, over: Over, count: int) -> Orientations:
    """Return `count` orientations for a chain; one if the tip never rotates.

    If the tip rotates about one direction only, they are rotations about that direction; else the requested set.
    """
    axes, rank = motion.turning
    own = chain_poses(chain.flat, mid_range(chain)[None])[1]
    if rank == 0:
        return Orientations("fixed", own, FULL_POSE)
    if rank == 1:
        angles = np.linspace(0.0, 2.0 * math.pi, count, endpoint=False)
        angles = np.where(angles > math.pi, angles - 2.0 * math.pi, angles)
        turns = rotations_from_vectors(np.ascontiguousarray(angles[:, None] * axes[:, 0]))
        return Orientations("turns", np.ascontiguousarray(turns @ own[0]), FULL_POSE)
    if over == "approach_directions":
        rotations = np.array([rotation_to_axis(tuple(axis)) for axis in sphere_spiral(count).tolist()])
        return Orientations(over, rotations, Task(("x", "y", "z", "rx", "ry")))
    return Orientations(over, rotations_from_quaternions_xyzw(rotation_spiral(count)), FULL_POSE)


def excluded(motion: TipReach, dimensions: int, spread: Spread) -> str | None:
    """Explain why a chain cannot reach all orientations in any region of positions; None if it may.

    A region with all its orientations has as many dimensions as both together; the set of poses that a chain reaches
    has at most as many dimensions as its tip has independent velocities. The region's are those of the grid: fewer in
    a slice than in the workspace.
    """
    turns = ("fixed", "turns", "approach_directions", "rotations").index(spread)
    moves, both = motion.ranks(spread == "approach_directions")
    moves = min(moves, dimensions)
    if both >= moves + turns:
        return None
    reason = (
        f"these orientations cannot all be reached in any region: {moves + turns} independent velocities of the "
        f"tip are needed, {moves} to move it and {turns} to turn it, and the chain has {both}; where some are reached, "
        "the voxel's centre and the orientation happen to match"
    )
    if spread == "rotations" and motion.ranks(True)[1] >= moves + 2:
        reason += "; `approach_directions` needs only the tip's z axis, for which the chain has enough"
    return reason


def sphere_spiral(count: int) -> Array:
    """Return unit vectors on a spiral with equal steps in height and in angle, the golden angle; shape (count, 3)."""
    heights = 1.0 - (2.0 * np.arange(count) + 1.0) / count
    angles = np.arange(count) * math.pi * (3.0 - math.sqrt(5.0))
    radii = np.sqrt(1.0 - heights**2)
    return np.column_stack((radii * np.cos(angles), radii * np.sin(angles), heights))


def rotation_spiral(count: int) -> Array:
    """Return unit quaternions x y z w on a spiral of two ratios over all rotations [Alexa2022]; shape (count, 4)."""
    steps = np.arange(count) + 0.5
    inner, outer = np.sqrt(steps / count), np.sqrt(1.0 - steps / count)
    alphas, betas = 2.0 * math.pi * steps / math.sqrt(2.0), 2.0 * math.pi * steps / _SECOND_RATIO
    return np.column_stack(
        (inner * np.sin(alphas), inner * np.cos(alphas), outer * np.sin(betas), outer * np.cos(betas))
    )


def shares(
    robot: RobotModel, chain: Chain, positions: Array, seeds: Array, asked: Orientations, cell: Cell | None = None
) -> Array:
    """Compute the share, 0 to 1, of orientations that a chain reaches at each position within its limits; (M,).

    Every configuration that counts is recomputed through Pinocchio. A search may miss a solution: for a chain without
    a closed form the share is a lower bound.

    Args:
        positions, seeds: Of the tip in the base frame, shape (M, 3), [m], and start configurations, shape (M, n).
        cell: In which configurations in contact do not count.
    """
    count = len(asked.rotations)
    targets = Poses(np.repeat(positions, count, axis=0), np.tile(asked.rotations, (len(positions), 1, 1)))
    options = Options(task=asked.task, max_iterations=_ITERATIONS)
    found = solve(TargetProblem(robot, chain, targets, np.repeat(seeds, count, axis=0), options), cell)
    return np.asarray((np.diff(found.firsts) > 0).reshape(len(positions), count).mean(axis=1))
