"""An arm in its plane: every joint turns about the plane's normal or slides within the plane.

A frame is stored as R = Rn(φ) · K with the normal n, the sum φ of all angles so far and a constant K: so angles of all
revolute joints add up, even if a prismatic joint between them has its axis in the plane, as in an RPR arm.
"""

from dataclasses import dataclass, field

from gelenk.dh.derive.algebra import (
    LENGTH,
    ZERO,
    Angle,
    Atom,
    Matrix,
    Polynomial,
    Vector,
    angle_sum,
    applied,
    column,
    cosine,
    cross,
    dot,
    minus,
    plus,
    product,
    reduced,
    reduced_matrix,
    reduced_vector,
    scaled,
    sine,
    symbol,
)
from gelenk.dh.derive.table import IDENTITY, LENGTH_TOLERANCE, Row, Table, Twist
from gelenk.dh.derive.transforms import rotation_x, rotation_z
from gelenk.dh.lagrangian.bodies import Line, LinkBody, line_of


class NotPlanar(Exception):
    """The arm does not move in a plane; the message names the joint that leaves it."""


@dataclass(frozen=True, slots=True)
class PlanarArm:
    """The arm in the axes of frame 0.

    Attributes:
        normal: Normal of the plane, about which angles count; None if no joint turns.
        senses: For each joint 1 or -1 if it turns about the normal or against it, 0 if it slides.
        centers: Centres of mass.
        lines: Line on which each centre of mass is measured if it is one number.
    """

    normal: Vector | None
    senses: tuple[int, ...]
    centers: tuple[Vector, ...]
    lines: tuple[Line, ...]


def one_group(_: int) -> int:
    """Return the one group: in a plane all angles are about parallel axes."""
    return 0


def shortened(vector: Vector) -> Vector:
    """Return a vector with each entry reduced."""
    return reduced_vector(vector, one_group)


def quantity(atom: Atom, value: float | None, values: dict[Atom, float], zero: float = 0.0) -> Polynomial:
    """Return a given quantity as a symbol, with its value in `values` if it has one; one of zero vanishes."""
    if value is not None and abs(value) <= zero:
        return ZERO
    if value is not None:
        values[atom] = value
    return symbol(atom)


@dataclass(slots=True)
class _Walk:
    """A frame that moves along the chain."""

    normal: Vector | None = None
    angle: Angle = ()
    fixed: Matrix = IDENTITY
    position: Vector = (ZERO, ZERO, ZERO)
    senses: list[int] = field(default_factory=list)
    slides: list[Vector] = field(default_factory=list)

    def seen(self, vector: Vector) -> Vector:
        """Return Rn(φ) times a vector: n (n·v) + cos φ (v - n (n·v)) + sin φ n × v."""
        if self.normal is None or not self.angle:
            return vector
        along = scaled(dot(self.normal, vector), self.normal)
        across = scaled(cosine(self.angle), minus(vector, along))
        return shortened(plus(plus(along, across), scaled(sine(self.angle), cross(self.normal, vector))))

    def move(self, length: Polynomial, vector: Vector) -> None:
        """Move by a length along a vector that turns with the frame."""
        if length:
            self.position = shortened(plus(self.position, scaled(length, self.seen(vector))))

    def about_x(self, a: Polynomial, twist: Twist) -> None:
        """Multiply by Tx(a) Rx(α)."""
        self.move(a, column(self.fixed, 0))
        self.turn(rotation_x(twist))

    def about_z(self, row: Row) -> None:
        """Multiply by Rz(θ) Tz(d) of a joint."""
        z, angle = column(self.fixed, 2), row.angle
        if row.is_revolute:
            sense = self._sense(z, row.index)
            self.angle, angle = angle_sum(self.angle, angle, sense), ()
        else:
            sense = 0
            self.slides.append(z)
        self.senses.append(sense)
        self.turn(rotation_z(angle, row.quarters))
        self.move(row.d, z)

    def turn(self, rotation: Matrix) -> None:
        """Multiply by a constant rotation."""
        self.fixed = reduced_matrix(product(self.fixed, rotation), one_group)

    def _sense(self, z: Vector, index: int) -> int:
        if self.normal is None:
            self.normal = z
        for sense, axis in ((1, z), (-1, (-z[0], -z[1], -z[2]))):
            if axis == self.normal:
                return sense
        raise NotPlanar(f"the axis of joint {index} is not parallel to those of the revolute joints before it")


def planar_arm(table: Table, bodies: tuple[LinkBody, ...], values: dict[Atom, float]) -> PlanarArm:
    """Place the arm in its plane.

    Args:
        table: Table in exact terms.
        bodies: One per row.
        values: Collects the value of each given coordinate of a centre of mass.

    Raises:
        NotPlanar: It moves in no plane, by the table's exact angles.
        TooManyTerms: A coordinate has too many terms.
    """
    walk, centers, lines = _Walk(), list[Vector](), list[Line]()
    for i, row in enumerate(table.rows):
        if not table.is_standard:
            walk.about_x(row.a, row.twist)
        axis = column(walk.fixed, 2)
        walk.about_z(row)
        foot, across = walk.position, column(walk.fixed, 0)
        if table.is_standard:
            walk.about_x(row.a, row.twist)
        line = line_of(table.as_read.rows, i, table.is_standard)
        ahead = walk.fixed
        if line == "next axis" and not table.is_standard:
            ahead = reduced_matrix(product(ahead, rotation_x(table.rows[i + 1].twist)), one_group)
        directions = {"x": across, "own axis": axis, "next axis": column(ahead, 2)}
        start = foot if line == "x" else walk.position
        centers.append(_center(walk, row.index, bodies[i].center, start, directions[line], values))
        lines.append(line)
    _demand_plane(walk)
    return PlanarArm(walk.normal, tuple(walk.senses), tuple(centers), tuple(lines))


def _center(
    walk: _Walk,
    index: int,
    given: float | tuple[float, float, float] | None,
    start: Vector,
    direction: Vector,
    values: dict[Atom, float],
) -> Vector:
    """Return a centre of mass, given along the link's line or by its coordinates in the link's frame."""
    if not isinstance(given, tuple):
        return shortened(
            plus(
                start,
                scaled(quantity(Atom(LENGTH, (index,), "lc"), given, values, LENGTH_TOLERANCE), walk.seen(direction)),
            )
        )
    inside = tuple(
        quantity(Atom(LENGTH, (index,), name), value, values, LENGTH_TOLERANCE)
        for name, value in zip(("xc", "yc", "zc"), given, strict=True)
    )
    return shortened(plus(walk.position, walk.seen(shortened(applied(walk.fixed, inside)))))


def _demand_plane(walk: _Walk) -> None:
    """Check that all prismatic joints slide within the plane."""
    slides = walk.slides
    if walk.normal is not None:
        numbers = (i for i, sense in enumerate(walk.senses, start=1) if not sense)
        for number, axis in zip(numbers, slides, strict=True):
            if reduced(dot(walk.normal, axis), one_group):
                raise NotPlanar(f"the axis of the prismatic joint {number} is not across those of the revolute joints")
    elif len(slides) == 3 and reduced(dot(slides[0], cross(slides[1], slides[2])), one_group):
        raise NotPlanar("its three prismatic joints slide in three independent directions")
