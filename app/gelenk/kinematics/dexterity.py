"""How many of a set of orientations a chain can take at a position, by inverse kinematics.

The set is spread evenly and always the same: over all rotations, over all directions of the tip's z axis, or over the
turns about the one axis that a planar arm or a SCARA has.
"""

import math
from dataclasses import dataclass
from typing import Literal, TypeAlias

import numpy as np

from gelenk.kinematics.ik.search import mid_range
from gelenk.kinematics.ik.solve import Options, inverse_kinematics
from gelenk.kinematics.ik.task import FULL_POSE, Task
from gelenk.kinematics.kernels import chain_poses
from gelenk.kinematics.tip_motion import Motion
from gelenk.model.arrays import Array
from gelenk.model.chain import Chain, rotation_to_axis
from gelenk.model.notations import rotations_from_quaternions_xyzw, rotations_from_vectors
from gelenk.model.poses import Poses
from gelenk.model.robot import Robot

Over: TypeAlias = Literal["rotations", "approach_directions"]
Spread: TypeAlias = Literal["rotations", "approach_directions", "turns", "fixed"]

_SECOND_RATIO = 1.533751168755204288118041
"""ψ⁴ = ψ + 4, the second ratio of the spiral."""
_ITERATIONS = 1280
"""Budget of a search for each orientation: 64 starts, beside the configuration that came to the cell."""


@dataclass(frozen=True, slots=True)
class Orientations:
    """The requested orientations.

    Attributes:
        spread: Over what they are spread; `fixed` where the tip never turns.
        rotations: Shape (K, 3, 3).
        task: What of a pose counts.
    """

    spread: Spread
    rotations: Array
    task: Task


def orientations(chain: Chain, motion: Motion, over: Over, count: int) -> Orientations:
    """As many orientations for a chain as requested; one where the tip never turns.

    Of a chain that turns about one direction only, these turns of the tip; else the requested set.
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


def excluded(motion: Motion, dimensions: int, spread: Spread) -> str | None:
    """Why the chain can take all orientations nowhere but in a set without volume; None where nothing excludes more.

    Positions with all their orientations are a set of as many dimensions as both together have, and what a chain
    reaches has no more dimensions than its tip has independent velocities.

    Args:
        motion: Of its tip.
        dimensions: Of the grid: in a slice they are fewer than those of the workspace.
        spread: Over what the orientations are spread.
    """
    turns = ("fixed", "turns", "approach_directions", "rotations").index(spread)
    moves, both = motion.ranks(spread == "approach_directions")
    moves = min(moves, dimensions)
    if both >= moves + turns:
        return None
    reason = (
        f"all these orientations are possible in no region: {moves + turns} independent velocities of the tip are "
        f"needed for that, {moves} to move it and {turns} to turn it, and the chain has {both}; where some are reached "
        "all the same, the middle of the voxel and the orientation happen to agree"
    )
    if spread == "rotations" and motion.ranks(True)[1] >= moves + 2:
        reason += "; `approach_directions` asks for the tip's z axis alone, for which they suffice"
    return reason


def sphere_spiral(count: int) -> Array:
    """Unit vectors at equal steps of height and of the golden angle; shape (count, 3)."""
    heights = 1.0 - (2.0 * np.arange(count) + 1.0) / count
    angles = np.arange(count) * math.pi * (3.0 - math.sqrt(5.0))
    radii = np.sqrt(1.0 - heights**2)
    return np.column_stack((radii * np.cos(angles), radii * np.sin(angles), heights))


def rotation_spiral(count: int) -> Array:
    """Unit quaternions x y z w spread over all rotations along a spiral of two ratios [Alexa2022]; shape (count, 4)."""
    steps = np.arange(count) + 0.5
    inner, outer = np.sqrt(steps / count), np.sqrt(1.0 - steps / count)
    alphas, betas = 2.0 * math.pi * steps / math.sqrt(2.0), 2.0 * math.pi * steps / _SECOND_RATIO
    return np.column_stack(
        (inner * np.sin(alphas), inner * np.cos(alphas), outer * np.sin(betas), outer * np.cos(betas))
    )


def shares(robot: Robot, chain: Chain, positions: Array, seeds: Array, asked: Orientations) -> Array:
    """Of each position the share of the orientations that the chain can take there, within its limits.

    Every configuration that counts has been recomputed through Pinocchio. What a search does not find may still be
    there: of a chain without a closed form the share is a lower bound.

    Args:
        robot: The robot.
        chain: The chain.
        positions: Of the tip, in the base; shape (M, 3), [m].
        seeds: For each a configuration to begin from; shape (M, n), [rad or m].
        asked: The requested orientations.

    Returns:
        Shape (M,), from 0 to 1.
    """
    count = len(asked.rotations)
    targets = Poses(np.repeat(positions, count, axis=0), np.tile(asked.rotations, (len(positions), 1, 1)))
    options = Options(task=asked.task, max_iterations=_ITERATIONS)
    found = inverse_kinematics(robot, chain, targets, np.repeat(seeds, count, axis=0), options)
    solved: Array = (np.diff(found.firsts) > 0).reshape(len(positions), count).mean(axis=1)
    return solved
