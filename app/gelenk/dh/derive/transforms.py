"""A_i and T_0_i in symbols.

A frame is stored as R = G · Rz(φ): turns about parallel axes only add to φ, and G is multiplied only when the next
axis points elsewhere. So a sum of angles appears as one sine and cosine, and products of those of parallel axes never
occur: the result is what a textbook prints.
"""

from collections.abc import Callable, Sequence
from dataclasses import dataclass, replace
from typing import Literal, TypeAlias

from gelenk.dh.derive.algebra import (
    ONE,
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
    plus,
    product,
    reduced_matrix,
    reduced_vector,
    scaled,
    sine,
)
from gelenk.dh.derive.table import IDENTITY, Row, Table, Transform, Twist

MAX_ENTRY_TERMS = 64
"""Maximum number of terms of an entry: beyond that a matrix stays numeric."""


@dataclass(frozen=True, slots=True)
class Moving:
    """A frame that moves along a chain: R = turned · Rz(angle + quarters · π/2)."""

    turned: Matrix = IDENTITY
    angle: Angle = ()
    quarters: int = 0
    position: Vector = (ZERO, ZERO, ZERO)

    def turn_z(self, angle: Angle, quarters: int, sign: Literal[1, -1]) -> "Moving":
        """Multiply by Rz(± angle)."""
        return replace(self, angle=angle_sum(self.angle, angle, sign), quarters=(self.quarters + sign * quarters) % 4)

    def slide_z(self, d: Polynomial) -> "Moving":
        """Multiply by Tz(d)."""
        return replace(self, position=plus(self.position, scaled(d, column(self.turned, 2)))) if d else self

    def slide_x(self, a: Polynomial) -> "Moving":
        """Multiply by Tx(a)."""
        if not a:
            return self
        c, s = cosine(self.angle, self.quarters), sine(self.angle, self.quarters)
        along = plus(scaled(a * c, column(self.turned, 0)), scaled(a * s, column(self.turned, 1)))
        return replace(self, position=plus(self.position, along))

    def turn_x(self, twist: Twist, sign: Literal[1, -1]) -> "Moving":
        """Multiply by Rx(± α); half a turn only changes the sign of the angles, and nothing is multiplied out."""
        if twist.quarters == 0:
            return self
        if twist.quarters == 2:
            turned = product(self.turned, rotation_x(twist))
            return Moving(turned, angle_sum((), self.angle, -1), -self.quarters % 4, self.position)
        return Moving(product(self.rotation, rotation_x(twist, sign)), (), 0, self.position)

    @property
    def rotation(self) -> Matrix:
        """Rotation matrix R."""
        return product(self.turned, rotation_z(self.angle, self.quarters))

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
        return Transform(reduced_matrix(self.rotation, group), reduced_vector(self.position, group))


def rotation_x(twist: Twist, sign: Literal[1, -1] = 1) -> Matrix:
    """Return Rx(± α)."""
    c, s = twist.cosine, twist.sine if sign == 1 else -twist.sine
    return (ONE, ZERO, ZERO), (ZERO, c, -s), (ZERO, s, c)


def rotation_z(angle: Angle, quarters: int) -> Matrix:
    """Return Rz(angle + quarters · π/2)."""
    c, s = cosine(angle, quarters), sine(angle, quarters)
    return (c, -s, ZERO), (s, c, ZERO), (ZERO, ZERO, ONE)


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


def composed(left: Transform, right: Transform, group: Group) -> Transform:
    """Return left · right."""
    rotation = product(left.rotation, right.rotation)
    position = plus(left.position, applied(left.rotation, right.position))
    return Transform(reduced_matrix(rotation, group), reduced_vector(position, group))
