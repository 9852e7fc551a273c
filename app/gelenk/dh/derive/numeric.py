"""The numbers of a worked solution at one configuration, from the table's own product of transforms."""

from collections.abc import Sequence
from dataclasses import dataclass, replace

import numpy as np

from gelenk.dh.derive.texts import NumericColumn
from gelenk.robot.arrays import Array
from gelenk.robot.dh import DhTable

RANK_TOLERANCE = 1e-10
"""A singular value counts if it exceeds this times the largest."""


@dataclass(frozen=True, slots=True)
class NumericSolution:
    """All quantities at one configuration q; shape (n,), [rad or m].

    Attributes:
        rows, frames: A_1 … A_n and T_0_1 … T_0_n; each of shape (4, 4).
        frames_in_base, tip: T_base_0 … T_base_n and T_base_tool; each of shape (4, 4).
        jacobian: Geometric Jacobian in the axes of the base; shape (6, n).
        singular_values, rank: Singular values, largest first, and how many of them count.
    """

    q: Array
    rows: list[Array]
    frames: list[Array]
    frames_in_base: list[Array]
    tip: Array
    columns: list[NumericColumn]
    jacobian: Array
    singular_values: Array
    rank: int

    def block(self, rows: Sequence[int], frame: int) -> Array:
        """Return some rows of the Jacobian, in the axes of a frame."""
        R = self.frames_in_base[frame][:3, :3].T
        turned: Array = np.vstack((R @ self.jacobian[:3], R @ self.jacobian[3:]))[list(rows)]
        return turned

    def determinant(self, rows: Sequence[int], frame: int) -> float:
        """Return the determinant of a block of rows, in the axes of a frame."""
        return float(np.linalg.det(self.block(rows, frame)))


def numeric_solution(table: DhTable, q: Array) -> NumericSolution:
    """Compute all quantities at a configuration of a table in which every row has a variable of its own."""
    values = [float(value) for value in q]
    rows = [row.transform(value, table.convention) for row, value in zip(table.joints, values, strict=True)]
    frames = replace(table, base=np.eye(4)).frames(values)
    in_base, tip = table.frames(values), table.pose(values)
    axes = in_base[:-1] if table.convention == "standard" else in_base[1:]
    columns = []
    for row, T, point in zip(table.joints, axes, _tips(table, rows), strict=True):
        z, arm = T[:3, 2], T[:3, :3] @ point
        linear, angular = (np.cross(z, arm), z) if row.type == "revolute" else (z, np.zeros(3))
        columns.append(NumericColumn(*(vector.tolist() for vector in (z, arm, linear, angular))))
    J = np.array([[*column.linear, *column.angular] for column in columns]).T
    sigmas = np.linalg.svd(J, compute_uv=False)
    rank = int(np.sum((sigmas > RANK_TOLERANCE * sigmas[0]) & (sigmas > 0.0)))
    return NumericSolution(np.array(values), rows, frames[1:], in_base, tip, columns, J, sigmas, rank)


def _tips(table: DhTable, rows: Sequence[Array]) -> list[Array]:
    """Return the tip in the frame of each joint's axis, [m]; from the tip backwards, which keeps rounding small."""
    points = [table.tool[:3, 3]]
    for A in reversed(rows):
        points.append(A[:3, :3] @ points[-1] + A[:3, 3])
    points.reverse()
    return points[:-1] if table.convention == "standard" else points[1:]
