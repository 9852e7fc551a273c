"""Result types of inverse kinematics."""

from dataclasses import dataclass, field
from functools import lru_cache
from typing import Any

import numpy as np

from gelenk.ik.closed.closed_form import ClosedForm
from gelenk.ik.search.words import BlockingJoint, Family, IterationPath, Status
from gelenk.robot.arrays import Array, Flags, Indices

COUNTED = -2
"""Branch code of a solution that continuation found instead of a closed form."""


@dataclass(frozen=True, slots=True)
class UnsolvedTarget:
    """The reason why a target is unsolved, and the nearest configuration found.

    Attributes:
        nearest: Nearest configuration, within the limits if they count; shape (n,), [rad or m].
        position_error, orientation_error: Distance [m] and angle [rad] of its pose to the target.
        blocking_joints: For `outside_limits`, the joints beyond their limits.
        unserved_directions: Unit twists in the base's axes, linear before angular, that the tip cannot follow there;
            shape (k, 6).
        is_late: Whether time ran out before the target was solved or explained.
    """

    status: Status
    reason: str
    nearest: Array
    position_error: float
    orientation_error: float
    blocking_joints: tuple[BlockingJoint, ...] = ()
    unserved_directions: Array | None = None
    is_late: bool = False


@dataclass(slots=True)  # not frozen: each request makes one, and freezing triples its cost
class InverseKinematics:
    """Solutions of N targets in one table: rows firsts[i] up to, but not including, firsts[i + 1] belong to target i.

    Attributes:
        qs: Solutions; shape (M, n), [rad or m].
        position_errors, orientation_errors: Errors of the poses recomputed with Pinocchio; shape (M,), [m] and [rad].
        iterations, restarts: Of the start that led to each solution, and starts failed before it; shape (M,) each.
        codes: Bits of the roots chosen in the closed form; `COUNTED` for a solution from continuation, -1 from a
            search; shape (M,).
        free: Bit mask: bit j is set if variable j was free and kept the seed's value; shape (M,).
        firsts: First row of each target's solutions, and M at the end; shape (N + 1,).
        method: Name of the iterative method.
        failures, doubts, families: By a target's index, why it is unsolved, why it may have other solutions, and its
            families of infinitely many, if all were requested.
        paths: Path of each target, if a single method was run or a trace requested.
        is_counted: Whether continuation was used for six joints without a closed form.
        touching: Whether each solution is in contact, of a problem in a cell; shape (M,). Other solutions of its target
            are before it.
    """

    qs: Array
    position_errors: Array
    orientation_errors: Array
    iterations: Indices
    restarts: Indices
    codes: Indices
    free: Indices
    firsts: Indices
    method: str = "damped_least_squares"
    failures: dict[int, UnsolvedTarget] = field(default_factory=dict)
    every: bool = False
    doubts: dict[int, str] = field(default_factory=dict)
    paths: list[IterationPath] | None = None
    form: ClosedForm | None = None
    is_counted: bool = False
    families: dict[int, tuple[Family, ...]] = field(default_factory=dict)
    touching: Flags | None = None

    def __len__(self) -> int:
        return len(self.firsts) - 1

    @property
    def owners(self) -> Indices:
        """Target of each solution; shape (M,)."""
        return np.repeat(np.arange(len(self)), np.diff(self.firsts))

    @property
    def verdicts(self) -> dict[str, int]:
        """Number of targets with each verdict."""
        found: dict[str, int] = {}
        if solved := len(self) - len(self.failures):
            found["solved"] = solved
        for failure in self.failures.values():
            found[failure.status] = found.get(failure.status, 0) + 1
        return found

    @property
    def statuses(self) -> list[Status]:
        """Verdict on each target; N of them."""
        statuses: list[Status] = ["solved"] * len(self)
        for i, failure in self.failures.items():
            statuses[i] = failure.status
        return statuses

    @property
    def complete(self) -> list[bool] | None:
        """Whether each target's solutions are all there are; None if one was requested."""
        if not self.every:
            return None
        unsolved = {i for i, failure in self.failures.items() if failure.status != "in_collision"}
        return [i not in self.doubts and i not in unsolved for i in range(len(self))]

    @property
    def closed_form(self) -> str | None:
        """Name of the closed form, or of the method for six joints without one; None if neither was used."""
        if self.form:
            return self.form.name
        return "six joints, by continuation" if self.is_counted else None

    def rows(self, rows: Indices | slice) -> dict[str, Any]:
        """Return some rows of the table, by column."""
        return {name: getattr(self, name)[rows] for name in COLUMNS}


COLUMNS = ("qs", "position_errors", "orientation_errors", "iterations", "restarts", "codes", "free")
"""The fields of `InverseKinematics` with a row for each solution."""


@lru_cache(maxsize=16)
def by_search(count: int) -> tuple[Indices, Indices, Indices]:
    """Return the codes, bit masks and first rows of one solution by search for each of a few targets; read-only."""
    columns = np.full(count, -1), np.zeros(count, dtype=np.int64), np.arange(count + 1)
    for column in columns:
        column.flags.writeable = False
    return columns


def firsts_of(owners: Indices, count: int) -> Indices:
    """Return the first row of each of a number of targets, and the end, from the ascending targets of the rows."""
    return owners.searchsorted(np.arange(count + 1))
