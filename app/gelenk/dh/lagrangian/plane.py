"""An arm in its plane: every joint turns about the plane's normal or slides within the plane.

All angles are then about parallel axes, and add up: so they do even if a prismatic joint between two revolute ones has
its axis in the plane, as in an RPR arm.
"""

from dataclasses import dataclass

from gelenk.dh.derive.algebra import (
    LENGTH,
    MAX_TERMS,
    ZERO,
    Atom,
    Polynomial,
    TooManyTerms,
    Vector,
    applied,
    column,
    cross,
    dot,
    minus,
    plus,
    reduced,
    reduced_vector,
    scaled,
    symbol,
)
from gelenk.dh.derive.table import LENGTH_TOLERANCE, Table, Transform
from gelenk.dh.derive.transforms import frames_from
from gelenk.dh.lagrangian.bodies import Line, LinkBody, Point, line_of
from gelenk.language import translated as _


class NotPlanar(Exception):
    """The arm does not move in a plane; the message names the joint that leaves it."""


@dataclass(frozen=True, slots=True)
class PlanarArm:
    """The arm, with its centres of mass, in the axes of frame 0.

    `senses` are 1 or -1 for joints that turn about the plane's normal or against it, 0 for those that slide; `lines`
    are those on which centres of mass that are one number are measured.
    """

    senses: tuple[int, ...]
    centers: tuple[Vector, ...]
    lines: tuple[Line, ...]


def one_group(_: int) -> int:
    """Return the one group: in a plane all angles are about parallel axes."""
    return 0


def quantity(atom: Atom, value: float | None, values: dict[Atom, float], zero: float = 0.0) -> Polynomial:
    """Return a given quantity as a symbol, with its value in `values` if it has one; one of zero vanishes."""
    if value is not None and abs(value) <= zero:
        return ZERO
    if value is not None:
        values[atom] = value
    return symbol(atom)


def planar_arm(table: Table, bodies: tuple[LinkBody, ...], values: dict[Atom, float]) -> PlanarArm:
    """Place the arm, with one body per row, in its plane.

    `values` collects the value of each given coordinate of a centre of mass. Raises NotPlanar if the arm moves in no
    plane, by the table's exact angles, and TooManyTerms if a coordinate has too many terms.
    """
    frames = [frame for frame in frames_from(table, 0, MAX_TERMS) if frame is not None]
    if len(frames) <= len(table.rows):
        raise TooManyTerms
    axes = [reduced_vector(column(frames[table.axis_frame(row.index)].rotation, 2), one_group) for row in table.rows]
    senses = _senses(table, axes)
    lines = tuple(line_of(table.as_read.rows, i, table.is_standard) for i in range(len(bodies)))
    centers = []
    for row, body, line in zip(table.rows, bodies, lines, strict=True):
        frame = frames[row.index]
        if isinstance(body.center, tuple):
            center = _point(frame, row.index, body.center, values)
        else:
            length = quantity(Atom(LENGTH, (row.index,), "lc"), body.center, values, LENGTH_TOLERANCE)
            x = column(frame.rotation, 0)
            start = minus(frame.position, scaled(row.a, x)) if line == "x" and table.is_standard else frame.position
            direction = x if line == "x" else axes[row.index if line == "next axis" else row.index - 1]
            center = plus(start, scaled(length, direction))
        centers.append(reduced_vector(center, one_group))
    return PlanarArm(senses, tuple(centers), lines)


def _point(frame: Transform, index: int, given: Point, values: dict[Atom, float]) -> Vector:
    inside = tuple(
        quantity(Atom(LENGTH, (index,), name), value, values, LENGTH_TOLERANCE)
        for name, value in zip(("xc", "yc", "zc"), given, strict=True)
    )
    return plus(frame.position, applied(frame.rotation, inside))


def _senses(table: Table, axes: list[Vector]) -> tuple[int, ...]:
    """Return in which sense each joint turns about the normal of the plane, 0 if it slides within it."""
    senses, turning = [], [axis for row, axis in zip(table.rows, axes, strict=True) if row.is_revolute]
    normal = turning[0] if turning else None
    for row, axis in zip(table.rows, axes, strict=True):
        senses.append((axis == normal) - (tuple(-x for x in axis) == normal) if row.is_revolute else 0)
        if row.is_revolute and not senses[-1]:
            what = _("the axis of joint {joint} is not parallel to those of the revolute joints before it")
            raise NotPlanar(what.format(joint=row.index))
    for row, axis in zip(table.rows, axes, strict=True):
        if normal is not None and not row.is_revolute and reduced(dot(normal, axis), one_group):
            what = _("the axis of the prismatic joint {joint} is not across those of the revolute joints")
            raise NotPlanar(what.format(joint=row.index))
    if normal is None and len(axes) == 3 and reduced(dot(axes[0], cross(axes[1], axes[2])), one_group):
        raise NotPlanar(_("its three prismatic joints slide in three independent directions"))
    return tuple(senses)
