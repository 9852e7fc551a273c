"""Check of DH tables and screws: the product of their own transforms against Pinocchio's poses."""

import numpy as np

from gelenk.dh.tables.convert import BASE_FRAME, TOOL_FRAME, describe_dh
from gelenk.dh.tables.screws import ScrewTable
from gelenk.kinematics.judge.judge import Differences, agreed, largest, pinocchio_poses
from gelenk.kinematics.judge.words import PoseCertificate
from gelenk.robot.arrays import Array
from gelenk.robot.chain import Chain
from gelenk.robot.dh import DhTable
from gelenk.robot.notations import pose_errors
from gelenk.robot.poses import Poses
from gelenk.robot.robot import RobotModel

TABLE_SAMPLES = 100
"""Number of configurations at which a table is compared with a robot."""
_REACH = 10.0
"""Largest distance of a sample from the allowed position nearest zero, [rad or m]: 1e6 m stands for no limit."""


def certify_table(
    robot: RobotModel, chain: Chain, table: DhTable, *, exact: bool = True, seed: int = 0
) -> PoseCertificate:
    """Compare the product of a table's own transforms with Pinocchio's poses of a robot's chain.

    Args:
        chain: A chain of this robot; its variables are the table's, in the same order.
        exact: Whether to refuse more than rounding, at the scale of the table's longest length; a table that was
            simplified on purpose may differ by more, but not by NaN.
    """
    qs = table_configurations(chain, TABLE_SAMPLES, seed)
    Ts = np.array([table.pose(q) for q in qs.tolist()])
    ours = Poses(np.ascontiguousarray(Ts[:, :3, 3]), np.ascontiguousarray(Ts[:, :3, :3]))
    judge = pinocchio_poses(robot, chain, chain.tip_frame, qs, range(len(qs)))
    return _certificate(ours, judge, table, exact, seed)


def certify_conversion(table: DhTable, other: DhTable, seed: int = 0) -> PoseCertificate:
    """Compare two tables of the same variables, each as a robot in Pinocchio; raises if they differ beyond rounding."""
    robots = [RobotModel(describe_dh("table", described)) for described in (table, other)]
    chains = [robot.chain(BASE_FRAME, TOOL_FRAME) for robot in robots]
    qs = table_configurations(chains[0], TABLE_SAMPLES, seed)
    ours, judge = (
        pinocchio_poses(robot, chain, TOOL_FRAME, qs, range(len(qs)))
        for robot, chain in zip(robots, chains, strict=True)
    )
    return _certificate(ours, judge, table, True, seed)


def certify_screws(robot: RobotModel, chain: Chain, screws: ScrewTable, seed: int = 0) -> PoseCertificate:
    """Compare both products of exponentials with Pinocchio's poses of a chain; raises if one differs beyond rounding.

    The configurations are those of a table, and the variables those of the chain.
    """
    qs = table_configurations(chain, TABLE_SAMPLES, seed)
    judge = pinocchio_poses(robot, chain, chain.tip_frame, qs, range(len(qs)))
    worst = Differences(max_position_error=0.0, max_orientation_error=0.0)
    for Ts in (screws.poses(qs), screws.poses(qs, in_body=True)):
        positions, rotations = np.ascontiguousarray(Ts[:, :3, 3]), np.ascontiguousarray(Ts[:, :3, :3])
        distance, angle, extent = pose_errors(positions, rotations, judge.positions, judge.rotations)
        scale = max(extent, largest(screws.space[:, 3:]), largest(screws.body[:, 3:]))
        worst.add("max_position_error", "a position", distance, scale)
        worst.add("max_orientation_error", "an orientation", angle, 1.0 + len(screws.space))
    return PoseCertificate(samples=len(judge), seed=seed, **worst)


def table_configurations(chain: Chain, count: int, seed: int = 0) -> Array:
    """Draw random configurations (count, n), half within the limits, half with revolute joints over a full turn.

    Both are uniform: `numpy.random.default_rng(seed)` gives one number in [0, 1) per entry, row by row, which is scaled
    to the bounds. A limit more than 10 rad or m from the allowed position nearest zero is replaced by that distance.
    """
    next_to_zero = np.clip(0.0, chain.lower, chain.upper)
    lower = np.tile(np.maximum(chain.lower, next_to_zero - _REACH), (count, 1))
    upper = np.tile(np.minimum(chain.upper, next_to_zero + _REACH), (count, 1))
    slides = {int(variable) for prismatic, variable in chain.flat.joints if prismatic}
    turns = [j for j in range(len(chain)) if j not in slides]
    lower[count // 2 :, turns], upper[count // 2 :, turns] = -np.pi, np.pi
    return np.asarray(lower + np.random.default_rng(seed).random((count, len(chain))) * (upper - lower))


def _certificate(ours: Poses, judge: Poses, table: DhTable, exact: bool, seed: int) -> PoseCertificate:
    distance, angle, extent = pose_errors(ours.positions, ours.rotations, judge.positions, judge.rotations)
    longest = max(abs(length) for row in table.joints for length in (row.a, row.d))
    scale = max(extent, longest, largest(table.base[:3, 3]), largest(table.tool[:3, 3]))
    return PoseCertificate(
        len(judge),
        agreed("a position", distance, scale if exact else np.inf),
        agreed("an orientation", angle, len(table.joints) if exact else np.inf),
        seed,
    )
