"""Poses and the geometric Jacobian of a Denavit-Hartenberg table, straight from the textbook.

Each A_i is a product of four elementary transforms; a column is z × (p - o) over z for a revolute joint, z over 0 for
a prismatic one, with z and o those of frame i-1 (standard) or of frame i (modified, Craig).
"""

from collections.abc import Mapping, Sequence
from dataclasses import dataclass, field
from typing import Any, TypeAlias

import numpy as np
import numpy.typing as npt

Array: TypeAlias = npt.NDArray[np.float64]


@dataclass(frozen=True)
class Table:
    """Rows of (a, α, d, θ), which of them slide, and what stands before and behind."""

    standard: bool
    rows: Sequence[tuple[float, float, float, float]]
    slides: Sequence[bool]
    base: Array = field(default_factory=lambda: np.eye(4))
    tool: Array = field(default_factory=lambda: np.eye(4))

    def frames(self, q: Sequence[float] | Array) -> list[Array]:
        """T_base_0 … T_base_n."""
        Ts = [self.base]
        for (a, alpha, d, theta), slides, value in zip(self.rows, self.slides, q, strict=True):
            about_z = turn(2, theta + value * (not slides)) @ shift(2, d + value * slides)
            about_x = shift(0, a) @ turn(0, alpha)
            Ts.append(Ts[-1] @ about_z @ about_x if self.standard else Ts[-1] @ about_x @ about_z)
        return Ts

    def pose(self, q: Sequence[float] | Array) -> Array:
        """T_base_tool."""
        return np.asarray(self.frames(q)[-1] @ self.tool)

    def jacobian(self, q: Sequence[float] | Array) -> Array:
        """The columns, in the axes of the base, at the tool; shape (6, n)."""
        frames, p = self.frames(q), self.pose(q)[:3, 3]
        axes = frames[:-1] if self.standard else frames[1:]
        columns = [
            (T[:3, 2], np.zeros(3)) if slides else (np.cross(T[:3, 2], p - T[:3, 3]), T[:3, 2])
            for T, slides in zip(axes, self.slides, strict=True)
        ]
        return np.array([np.concatenate(column) for column in columns]).T


def from_json(content: Mapping[str, Any]) -> Table:
    """A table as the catalogue writes it; a tool, where there is one, by position and roll, pitch, yaw."""
    joints = content["joints"]
    return Table(
        content["convention"] == "standard",
        [(joint["a"], joint["alpha"], joint["d"], joint["theta"]) for joint in joints],
        [joint["type"] == "prismatic" for joint in joints],
        *(placement(content.get(key)) for key in ("base", "tool")),
    )


def placement(pose: Mapping[str, Any] | None) -> Array:
    """A homogeneous transform by position and roll, pitch, yaw."""
    if pose is None:
        return np.eye(4)
    (x, y, z), (roll, pitch, yaw) = pose["position"], pose["rpy"]
    return shift(0, x) @ shift(1, y) @ shift(2, z) @ turn(2, yaw) @ turn(1, pitch) @ turn(0, roll)


def turn(axis: int, angle: float) -> Array:
    """Elementary rotation about coordinate axis 0, 1 or 2."""
    T = np.eye(4)
    i, j = (axis + 1) % 3, (axis + 2) % 3
    T[i, i] = T[j, j] = np.cos(angle)
    T[j, i], T[i, j] = np.sin(angle), -np.sin(angle)
    return T


def shift(axis: int, length: float) -> Array:
    """Elementary translation along coordinate axis 0, 1 or 2."""
    T = np.eye(4)
    T[axis, 3] = length
    return T
