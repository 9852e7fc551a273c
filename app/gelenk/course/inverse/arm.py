"""The DH table of an arm with its axes turned as the lecture has them, and what a solution by hand consists of.

Turning a frame by π about its x axis changes nothing but signs: α of the row before it by π, and of the next row α by
π, and the sign of its angle and of d. So parallel axes point the same way, and a wrist has α = -π/2 and π/2.
"""

import math
from collections.abc import Mapping
from dataclasses import dataclass, replace

import numpy as np

from gelenk.course.steps import Step
from gelenk.course.writing import theta
from gelenk.robot.arrays import Array
from gelenk.robot.dh import DhTable, about_x, about_z

STRAIGHT = 1e-10
"""Sine [no unit] or length [m] that counts as zero: descriptions round π/2."""


@dataclass(frozen=True, slots=True)
class ArmRow:
    """A row of the table; the variable, ϑ or d, is `sign` times the joint's position, plus `offset`; [m, rad]."""

    a: float
    alpha: float
    d: float
    theta: float
    slides: bool
    sign: int = 1

    @property
    def offset(self) -> float:
        """What the table adds to the joint's position, [rad or m]."""
        return self.d if self.slides else self.theta

    def transform(self, value: float) -> Array:
        """Return A_i at a value of the variable, ϑ or d, [rad or m]; shape (4, 4)."""
        turn = about_z(self.theta, value) if self.slides else about_z(value, self.d)
        return turn @ about_x(self.alpha, self.a)

    @property
    def is_parallel(self) -> bool:
        """Whether the next axis is parallel."""
        return abs(math.sin(self.alpha)) < STRAIGHT

    @property
    def is_square(self) -> bool:
        """Whether the next axis is perpendicular."""
        return abs(math.cos(self.alpha)) < STRAIGHT


@dataclass(frozen=True, slots=True)
class HandArm:
    """An arm as a table between base and tool, T_base_0 and T_n_tool, shape (4, 4) each."""

    rows: tuple[ArmRow, ...]
    base: Array
    tool: Array

    @property
    def slides(self) -> tuple[bool, ...]:
        """Which joints slide."""
        return tuple(row.slides for row in self.rows)

    def values(self, q: Array) -> Array:
        """Return the variables of the table, ϑ or d, at a configuration (n,), [rad or m]."""
        return np.array([row.sign * x + row.offset for row, x in zip(self.rows, q, strict=True)])

    def positions(self, values: Array) -> Array:
        """Return the configuration (n,) of given variables, [rad or m]."""
        return np.array([row.sign * (x - row.offset) for row, x in zip(self.rows, values, strict=True)])

    def frame(self, values: Array, count: int) -> Array:
        """Return T_0_count at some variables; shape (4, 4)."""
        T = np.eye(4)
        for row, value in zip(self.rows[:count], values, strict=False):
            T = T @ row.transform(float(value))
        return T

    def pose(self, values: Array) -> Array:
        """Return T_base_tool at some variables; shape (4, 4)."""
        return np.asarray(self.base @ self.frame(values, len(self.rows)) @ self.tool)

    def tail(self) -> Array:
        """Return what follows the last rotation, ϑ_n: the end of its row, and the tool; shape (4, 4)."""
        last = self.rows[-1]
        return np.asarray(about_z(0.0, last.d) @ about_x(last.alpha, last.a) @ self.tool)

    def turned(self, alphas: Mapping[int, float]) -> "HandArm":
        """Turn frames so that some rows, counted from 0, have the given α, from which theirs may differ by π."""
        rows = list(self.rows)
        for i in sorted(alphas):
            if math.cos(rows[i].alpha - alphas[i]) < 0.0:
                rows[i] = replace(rows[i], alpha=_half_turn(rows[i].alpha))
                after = rows[i + 1]
                mirrored = replace(after, d=-after.d, alpha=_half_turn(after.alpha), sign=-after.sign)
                rows[i + 1] = replace(mirrored, theta=-after.theta)
        return replace(self, rows=tuple(rows))

    def relations(self) -> list[str]:
        """Return the formulas that relate the variables to the positions, for joints where the two differ."""
        lines = []
        for i, row in enumerate(self.rows):
            if row.sign < 0 or abs(row.offset) > STRAIGHT:
                name = f"d_{{{i + 1}}}" if row.slides else theta(i)
                shift = f" {'-' if row.offset < 0.0 else '+'} {abs(row.offset):.10g}" if row.offset else ""
                lines.append(f"{name} = {'-' if row.sign < 0 else ''}q_{{{i + 1}}}{shift}")
        return lines


def hand_arm(table: DhTable) -> HandArm:
    """Return a standard table as an arm whose axes can be turned."""
    rows = (ArmRow(row.a, row.alpha, row.d, row.theta, row.type == "prismatic") for row in table.joints)
    return HandArm(tuple(rows), table.base, table.tool)


def _half_turn(alpha: float) -> float:
    turned = math.remainder(alpha + math.pi, 2.0 * math.pi)
    return 0.0 if abs(turned) < STRAIGHT else turned


@dataclass(frozen=True, slots=True)
class HandSolution:
    """One branch: the table's variables, NaN where a joint is free.

    Attributes:
        values: ϑ or d of each row; shape (n,), [rad or m].
        pair: Two joints, a sign s, and the value of ϑ_i + s ϑ_j, [rad], which is all that is known of the two.
    """

    values: Array
    pair: tuple[int, int, int, float] | None = None

    def filled(self, guess: Array) -> Array:
        """Return the variables with the free ones taken from a guess (n,), so that the pair's sum is right."""
        values = np.where(np.isnan(self.values), guess, self.values)
        if self.pair is not None:
            i, j, sign, total = self.pair
            values[j] = sign * (total - values[i])
        return np.asarray(values)


@dataclass(frozen=True, slots=True)
class ByHand:
    """The steps, and all branches that they lead to; none if the target is out of reach.

    Attributes:
        is_family: Whether there are infinitely many, of which these are some.
    """

    steps: list[Step]
    solutions: list[HandSolution]
    is_family: bool = False


@dataclass(frozen=True, slots=True)
class HandTarget:
    """A target in the frames of the table: T_0_n of shape (4, 4), which directions count, and values for free joints.

    Attributes:
        guess: Variables of a solution that was sent, else zeros; shape (n,), [rad or m].
    """

    pose: Array
    directions: frozenset[str]
    guess: Array
