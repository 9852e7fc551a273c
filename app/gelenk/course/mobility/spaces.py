"""Joint space and task space: n joints and the m numbers that a task prescribes.

Solutions of the inverse problem need n ≥ m, and more: J must have rank m somewhere, which a planar arm of any number of
joints never has for a pose in space. Where it has, almost every target that the tip reaches is one at which J has rank
m (Sard), and its solutions form a surface of n - m dimensions: finitely many, as joints and poses are algebraic, where
n = m. Two notions that the notes mix are kept apart: n = m has finitely many solutions, its branches; only n > m is
redundancy, with infinitely many solutions and an internal motion of n - m dimensions (more at a singular posture).
"""

from collections.abc import Mapping
from dataclasses import dataclass
from typing import Literal, TypeAlias

from gelenk.course.steps import Step, step
from gelenk.language import marked, translated as _
from gelenk.robot.result import Result

TaskName: TypeAlias = Literal["xy", "xy_phi", "xyz", "pose"]
Solutions: TypeAlias = Literal["none", "finite", "infinite"]

_WORDS: dict[Solutions, str] = {
    "none": marked(
        "the tip never has all these directions (rank < m), so that a target at random is out of its reach."
    ),
    "finite": marked("of almost every target in reach there are finitely many solutions, the branches (rank = m = n)."),
    "infinite": marked(
        "of almost every target in reach there are infinitely many solutions: redundancy (rank = m < n)."
    ),
}
_TASKS: dict[TaskName, str] = {
    "xy": marked("Position in the plane"),
    "xy_phi": marked("Position in the plane with its angle"),
    "xyz": marked("Position in space"),
    "pose": marked("Pose in space"),
}


@dataclass(frozen=True, slots=True)
class TaskKind(Result):
    """A task, and what solutions of it a chain has.

    Attributes:
        task: The kind of task: a position in the plane x y or in space, without or with an orientation.
        dimension: m: numbers that a task of this kind sets.
        rank: Of the Jacobian's rows of the task, at random configurations: how many of its directions the tip has.
        redundancy: n - m: its degree, where ≥ 0; negative if joints are missing.
        solutions: Of the inverse problem. None for a target at random, where the rank is below m: too few joints, or a
            planar arm in space. Else, for almost every target in reach, finitely many branches (n = m), or infinitely
            many (n > m), which is redundancy; branches are not.
    """

    task: TaskName
    dimension: int
    rank: int
    redundancy: int
    solutions: Solutions


DIMENSIONS: dict[TaskName, int] = {"xy": 2, "xy_phi": 3, "xyz": 3, "pose": 6}
"""Dimension m of each task."""


def tasks(n: int, ranks: Mapping[TaskName, int]) -> tuple[TaskKind, ...]:
    """Return every kind of task, for a chain of n joints whose Jacobian has these ranks."""

    def solutions(m: int, rank: int) -> Solutions:
        return "none" if rank < m else "finite" if n == m else "infinite"

    return tuple(TaskKind(name, m, ranks[name], n - m, solutions(m, ranks[name])) for name, m in DIMENSIONS.items())


def spaces_step(n: int, found: tuple[TaskKind, ...]) -> Step:
    """Return the comparison of joint space and task spaces."""
    lines = [rf"n = {n},\quad m \le n,\quad \mathrm{{rank}}\, J \le \min(m, n)"]
    texts = [_("Joint space has n dimensions, task space m.")]
    for one in found:
        lines.append(rf"m = {one.dimension},\quad \mathrm{{rank}}\, J = {one.rank},\quad n - m = {one.redundancy}")
        texts.append(f"{_(_TASKS[one.task])}: {_(_WORDS[one.solutions])}")
    return step(_("Kinematic spaces"), " ".join(texts), *lines)
