"""The picture of a DH table: its frames as numbers, and drawn."""

from typing import Any

import numpy as np

from gelenk.contract.dh_picture import DhPictureRequest
from gelenk.dh.tables.convert import BASE_FRAME, TOOL_FRAME, describe_dh
from gelenk.errors import InvalidDhTable, counted
from gelenk.kinematics.judge.judge import certify_poses
from gelenk.operations.outcome import Outcome, PictureFormat, always
from gelenk.robot.arrays import Array
from gelenk.robot.chain import Chain
from gelenk.robot.configuration import configurations
from gelenk.robot.dh import DhTable
from gelenk.robot.poses import Poses
from gelenk.robot.robot import RobotModel
from gelenk.robot.urdf import read_urdf, write_urdf

MAX_ROWS = 16
"""Largest number of rows of a picture whose names can still be read."""
_TURN, _SLIDE = 0.5, 0.5
"""Where joints are if no configuration is given: turned by this, [rad], slid by this part of the longest length."""


def run(call: DhPictureRequest) -> Outcome:
    """Compute the frames of a table, and draw them."""
    return Outcome(lambda: _frames(call), picture=lambda kind: _picture(call, kind))


is_heavy = always  # building a robot takes milliseconds


def _table_and_positions(call: DhPictureRequest) -> tuple[DhTable, list[float]]:
    """Return the table and the configuration to draw; the tip's pose has been compared with Pinocchio's."""
    table = call.dh.table()
    if len(table.joints) > MAX_ROWS:
        raise InvalidDhTable(f"the table has {counted(len(table.joints), 'row')}; a picture shows at most {MAX_ROWS}")
    robot = RobotModel(read_urdf(write_urdf(describe_dh("table", table))), (BASE_FRAME, TOOL_FRAME))
    chain = robot.chain(None, None)
    qs = configurations(chain, call.joint_positions) if call.joint_positions else _moved(table, chain)
    q: list[float] = qs[0].tolist()
    tip = table.pose(q)
    certify_poses(robot, chain, qs, {TOOL_FRAME: Poses(tip[None, :3, 3], tip[None, :3, :3])})
    return table, q


def _moved(table: DhTable, chain: Chain) -> Array:
    longest = max(abs(length) for row in table.joints for length in (row.a, row.d)) or 1.0
    wanted = np.full(len(chain), _TURN)
    for prismatic, variable in chain.flat.joints.tolist():
        if prismatic:
            wanted[variable] = _SLIDE * longest
    moved: Array = np.clip(wanted, chain.lower, chain.upper)
    return moved[None]


def _frames(call: DhPictureRequest) -> dict[str, Any]:
    table, q = _table_and_positions(call)
    frames = table.frames(q)
    named = [(str(i), T) for i, T in enumerate(frames)]
    for name, T, other in (("B", np.eye(4), frames[0]), ("E", frames[-1] @ table.tool, frames[-1])):
        if not np.array_equal(T, other):
            named.append((name, T))
    return {
        "joint_names": table.variables,
        "joint_positions": q,
        "frames": [
            {"name": name, "origin": T[:3, 3].tolist(), "x_axis": T[:3, 0].tolist(), "z_axis": T[:3, 2].tolist()}
            for name, T in named
        ],
    }


def _picture(call: DhPictureRequest, kind: PictureFormat) -> bytes:
    from gelenk.plots.dh_frames import dh_picture  # noqa: PLC0415

    return dh_picture(*_table_and_positions(call), kind)
