"""A_i and T_0_i in symbols.

A frame is stored as R = G · Rz(φ): turns about parallel axes only add to φ, and G is multiplied only when the next
axis points elsewhere. So a sum of angles appears as one sine and cosine, and products of those of parallel axes never
occur: the result is what a textbook prints.
"""

from collections.abc import Callable, Sequence
from dataclasses import dataclass
from typing import Literal, TypeAlias

from gelenk.dh.derive.algebra import (
    ZERO,
    Angle,
    Group,
    Matrix,
    Polynomial,
    TooManyTerms,
    Vector,
    angle_sum,
    applied,
    column,
    cosine,
    minus,
    number,
    plus,
    product,
    reduced,
    scaled,
    sine,
)
from gelenk.dh.derive.table import IDENTITY, ExactPose, Row, Table, Twist

MAX_ENTRY_TERMS = 64
"""Maximum number of terms of an entry: beyond that a matrix stays numeric."""


@dataclass(frozen=True, slots=True)
class Transform:
    """A pose in symbols."""

    rotation: Matrix
    position: Vector

    @property
    def rows(self) -> list[list[Polynomial]]:
        """Homogeneous matrix, (4, 4)."""
        upper = [[*row, p] for row, p in zip(self.rotation, self.position, strict=True)]
        return [*upper, [ZERO, ZERO, ZERO, number(1)]]

    @property
    def largest(self) -> int:
        """Number of terms of the largest entry."""
        return max(len(entry) for row in self.rows for entry in row)


@dataclass(frozen=True, slots=True)
class Moving:
    """A frame that moves along a chain: R = turned · Rz(angle + quarters · π/2)."""

    turned: Matrix = IDENTITY
    angle: Angle = ()
    quarters: int = 0
    position: Vector = (ZERO, ZERO, ZERO)

    def turn_z(self, angle: Angle, quarters: int, sign: Literal[1, -1]) -> "Moving":
        """Multiply by Rz(± angle)."""
        return Moving(
            self.turned, angle_sum(self.angle, angle, sign), (self.quarters + sign * quarters) % 4, self.position
        )

    def slide_z(self, d: Polynomial) -> "Moving":
        """Multiply by Tz(d)."""
        moved = plus(self.position, scaled(d, column(self.turned, 2))) if d else self.position
        return Moving(self.turned, self.angle, self.quarters, moved)

    def slide_x(self, a: Polynomial) -> "Moving":
        """Multiply by Tx(a)."""
        if not a:
            return self
        c, s = cosine(self.angle, self.quarters), sine(self.angle, self.quarters)
        along = plus(scaled(a * c, column(self.turned, 0)), scaled(a * s, column(self.turned, 1)))
        return Moving(self.turned, self.angle, self.quarters, plus(self.position, along))

    def turn_x(self, twist: Twist, sign: Literal[1, -1]) -> "Moving":
        """Multiply by Rx(± α); half a turn only changes the sign of the angles, and nothing is multiplied out."""
        if twist.quarters == 0:
            return self
        if twist.quarters == 2:
            turned = product(self.turned, ((number(1), ZERO, ZERO), (ZERO, number(-1), ZERO), (ZERO, ZERO, number(-1))))
            return Moving(turned, angle_sum((), self.angle, -1), -self.quarters % 4, self.position)
        c, s = twist.cosine, twist.sine if sign == 1 else -twist.sine
        about_x: Matrix = ((number(1), ZERO, ZERO), (ZERO, c, -s), (ZERO, s, c))
        return Moving(product(self.rotation, about_x), (), 0, self.position)

    @property
    def rotation(self) -> Matrix:
        """Rotation matrix R."""
        c, s = cosine(self.angle, self.quarters), sine(self.angle, self.quarters)
        return product(self.turned, ((c, -s, ZERO), (s, c, ZERO), (ZERO, ZERO, number(1))))

    def along(self, row: Row, standard: bool) -> "Moving":
        """Multiply by A_i."""
        if standard:
            about_z = self.turn_z(row.angle, row.quarters, 1).slide_z(row.d)
            return about_z.slide_x(row.a).turn_x(row.twist, 1)
        return self.turn_x(row.twist, 1).slide_x(row.a).turn_z(row.angle, row.quarters, 1).slide_z(row.d)

    def back(self, row: Row, standard: bool) -> "Moving":
        """Multiply by the inverse of A_i."""
        if standard:
            about_x = self.turn_x(row.twist, -1).slide_x(-row.a)
            return about_x.slide_z(-row.d).turn_z(row.angle, row.quarters, -1)
        return self.slide_z(-row.d).turn_z(row.angle, row.quarters, -1).slide_x(-row.a).turn_x(row.twist, -1)

    def transform(self, group: Group) -> Transform:
        """Return the pose so far."""
        return Transform(_reduced_matrix(self.rotation, group), _reduced_vector(self.position, group))


Step: TypeAlias = Callable[[Moving, Row, bool], Moving]


def row_transforms(table: Table) -> list[Transform]:
    """Return A_1 … A_n."""
    return [Moving().along(row, table.is_standard).transform(table.group) for row in table.rows]


def frames_from(table: Table, start: int, most: int = MAX_ENTRY_TERMS) -> list[Transform | None]:
    """Return T_start_0 … T_start_n; None where an entry has more than `most` terms, and beyond."""
    forward = _journey(table, table.rows[start:], Moving.along, most)
    backward = _journey(table, tuple(reversed(table.rows[:start])), Moving.back, most)
    return [*reversed(backward), Moving().transform(table.group), *forward]


def _journey(table: Table, rows: Sequence[Row], step: Step, most: int) -> list[Transform | None]:
    moving, found = Moving(), list[Transform | None]()
    for row in rows:
        try:
            moving = step(moving, row, table.is_standard)
            transform = moving.transform(table.group)
        except TooManyTerms:
            break
        if transform.largest > most:
            break
        found.append(transform)
    return [*found, *[None] * (len(rows) - len(found))]


def before(pose: ExactPose, transform: Transform, group: Group) -> Transform:
    """Return pose · transform."""
    rotation = product(pose.rotation, transform.rotation)
    position = plus(pose.position, applied(pose.rotation, transform.position))
    return Transform(_reduced_matrix(rotation, group), _reduced_vector(position, group))


def behind(transform: Transform, pose: ExactPose, group: Group) -> Transform:
    """Return transform · pose."""
    rotation = product(transform.rotation, pose.rotation)
    position = plus(transform.position, applied(transform.rotation, pose.position))
    return Transform(_reduced_matrix(rotation, group), _reduced_vector(position, group))


def difference(left: Vector, right: Vector, group: Group) -> Vector:
    """Return left - right, reduced."""
    return _reduced_vector(minus(left, right), group)


def _reduced_vector(vector: Vector, group: Group) -> Vector:
    return reduced(vector[0], group), reduced(vector[1], group), reduced(vector[2], group)


def _reduced_matrix(matrix: Matrix, group: Group) -> Matrix:
    first, second, third = (_reduced_vector(row, group) for row in matrix)
    return first, second, third
