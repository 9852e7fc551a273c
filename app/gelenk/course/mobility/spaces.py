"""Joint space and task space: n joints and the m numbers that a task prescribes.

Solutions of the inverse problem need n ≥ m. Two notions that the notes mix are kept apart: a robot with n = m has
finitely many solutions, its branches; only n > m is redundancy, with infinitely many solutions and an internal motion
of n - m dimensions (more at a singular posture).
"""

from dataclasses import dataclass
from typing import Literal, TypeAlias

from gelenk.robot.result import Result

TaskName: TypeAlias = Literal["xy", "xy_phi", "xyz", "pose"]
Solutions: TypeAlias = Literal["none", "finite", "infinite"]

DIMENSIONS: dict[TaskName, int] = {"xy": 2, "xy_phi": 3, "xyz": 3, "pose": 6}
"""Dimension m of each task: a position in the plane, the same with its angle, a position in space, a pose."""


@dataclass(frozen=True, slots=True)
class TaskKind(Result):
    """A task, and whether a chain has enough joints for it.

    Attributes:
        task: The kind of task: a position in the plane or in space, without or with an orientation.
        dimension: m: numbers that a task of this kind sets.
        redundancy: n - m: its degree, where ≥ 0; negative if joints are missing.
        solutions: Of the inverse problem, by the counts alone: none for a task at random (n < m), finitely many
            branches (n = m), or infinitely many (n > m), which is redundancy; branches are not.
    """

    task: TaskName
    dimension: int
    redundancy: int
    solutions: Solutions


def tasks(n: int) -> tuple[TaskKind, ...]:
    """Return every kind of task, for a chain of n joints."""
    return tuple(
        TaskKind(name, m, n - m, "finite" if n == m else "none" if n < m else "infinite")
        for name, m in DIMENSIONS.items()
    )
