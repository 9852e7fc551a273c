"""Nodes of a robot: what moves together at the configurations of some joints, and the joints between."""

from collections.abc import Mapping, Sequence
from dataclasses import replace
from typing import TypeAlias

import numpy as np

from gelenk.robot.arrays import Array, Indices
from gelenk.robot.chain import build_chain, crossed_joints
from gelenk.robot.description import Description, Drive
from gelenk.robot.notations import placement

_Row: TypeAlias = tuple[int, Array, tuple[int, int], tuple[float, float]]
"""Node before, T_node_joint, slides and column, multiplier and offset."""


def without_free_joints(description: Description) -> Description:
    """Return the description with its floating and planar joints fixed, as Pinocchio's model has them."""
    free = {"floating", "planar"}
    joints = tuple(replace(joint, type="fixed") if joint.type in free else joint for joint in description.joints)
    return replace(description, joints=joints)


def joint_position(drive: Drive, others: Mapping[str, float]) -> float:
    """Return the position of a joint that the chain does not move; independent ones stand at 0 unless it is given."""
    return drive.multiplier * others.get(drive.leader, 0.0) + drive.offset


def _moved(slides: bool, value: float) -> Array:
    """Return the pose of a motion along or about z, (4, 4)."""
    return placement((0.0, 0.0, value), (0.0, 0.0, 0.0)) if slides else placement((0.0, 0.0, 0.0), (0.0, 0.0, value))


class Nodes:
    """The joints that those named `moving` move, found one after another on the ways from the root to links."""

    def __init__(self, description: Description, moving: Sequence[str], others: Mapping[str, float]) -> None:
        self._description, self._moving, self._others = description, moving, others
        self._numbers: dict[str, int] = {}
        self._rows: list[_Row] = []
        self._found: dict[str, tuple[int, Array]] = {}

    def of(self, link: str) -> tuple[int, Array]:
        """Return the number of the node that carries a link, and T_node_link."""
        if link not in self._found:
            self._found[link] = self._way_to(link)
        return self._found[link]

    def _way_to(self, link: str) -> tuple[int, Array]:
        way = build_chain(self._description, self._description.root, link)
        node, T = 0, way.flat.placement(0)
        for i, joint in enumerate(crossed_joints(self._description, way)):
            drive = self._description.drives[joint.name]
            if drive.leader in self._moving:
                column = self._moving.index(drive.leader)
                row = node, T, (int(joint.type == "prismatic"), column), (drive.multiplier, drive.offset)
                node, T = self._number(joint.name, row), np.eye(4)
            else:
                T = T @ _moved(joint.type == "prismatic", joint_position(drive, self._others))
            T = T @ way.flat.placement(i + 1)
        return node, T

    def _number(self, joint: str, row: _Row) -> int:
        if joint not in self._numbers:
            self._rows.append(row)
            self._numbers[joint] = len(self._rows)
        return self._numbers[joint]

    def flat(self) -> tuple[Indices, Array, Indices, Array]:
        """Return parents, placements, joints and drives as those of `FlatWorld`."""
        return (
            np.array([node for node, *_ in self._rows], dtype=np.int64),
            np.array([np.append(T[:3, :3], T[:3, 3]) for _, T, *_ in self._rows]).reshape(-1, 12),
            np.array([joint for _, _, joint, _ in self._rows], dtype=np.int64).reshape(-1, 2),
            np.array([drive for *_, drive in self._rows], dtype=float).reshape(-1, 2),
        )
