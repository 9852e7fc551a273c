"""Joint space and task space: n joints against the m numbers that a task sets.

Solutions of the inverse problem need n ≥ m. Two notions are kept apart that the notes mix: a robot with n = m has
finitely many solutions, its branches; only n > m is redundancy, with infinitely many and an internal motion of n - m
dimensions (at a singular posture of more).
"""

from dataclasses import dataclass
from typing import Literal, TypeAlias

TaskName: TypeAlias = Literal["xy", "xy_phi", "xyz", "pose"]
Solutions: TypeAlias = Literal["none", "finite", "infinite"]

DIMENSIONS: dict[TaskName, int] = {"xy": 2, "xy_phi": 3, "xyz": 3, "pose": 6}
"""m: a position in the plane, with its angle, a position in space, a pose."""


@dataclass(frozen=True, slots=True)
class Task:
    """A kind of task for a chain.

    Attributes:
        task: Which.
        dimension: m.
        redundancy: n - m.
        solutions: How many there are for a task at random, by the counts alone.
    """

    task: TaskName
    dimension: int
    redundancy: int
    solutions: Solutions


def tasks(n: int) -> tuple[Task, ...]:
    """Every kind of task, for a chain of n joints."""
    return tuple(Task(name, m, n - m, _solutions(n - m)) for name, m in DIMENSIONS.items())


def _solutions(redundancy: int) -> Solutions:
    if redundancy == 0:
        return "finite"
    return "none" if redundancy < 0 else "infinite"
