"""The bodies of an arm and gravity as given; None for a quantity that stays a symbol without a value.

A centre of mass that is given as one number lies on the line of its link. After a revolute joint this line is x of the
link's frame, measured from the joint's axis, as the course draws it; only if the link has no length along x and a
prismatic joint comes next is it that joint's axis (an RP arm). After a prismatic joint it is that joint's axis,
measured from the origin of the link's frame.
"""

import math
from collections.abc import Sequence
from dataclasses import dataclass
from typing import TYPE_CHECKING, Literal, TypeAlias

from gelenk.dh.derive.table import LENGTH_TOLERANCE, RowNumbers

if TYPE_CHECKING:  # the symbolic part shares nothing with the numeric one, not even types
    from gelenk.robot.arrays import Array, Configuration
    from gelenk.robot.dh import DhJoint

Row: TypeAlias = "RowNumbers | DhJoint"
Line: TypeAlias = Literal["x", "next axis", "own axis"]
Point: TypeAlias = tuple[float, float, float]

STANDARD_GRAVITY = 9.81
"""Default of g_0, [m/s²]."""


@dataclass(frozen=True, slots=True)
class LinkBody:
    """A link of the arm: mass [kg], and inertia [kg m²] about the centre of mass, the axis normal to the plane.

    The centre of mass is on the line of the link or a point in frame i, [m].
    """

    mass: float | None = None
    center: float | Point | None = None
    inertia: float | None = None


@dataclass(frozen=True, slots=True)
class Gravity:
    """Acceleration of free fall: its magnitude, [m/s²], and a unit vector; the magnitude is 0 without gravity."""

    size: float
    direction: Point

    @property
    def vector(self) -> Point:
        """Acceleration of free fall as a vector, [m/s²]."""
        x, y, z = self.direction
        return self.size * x, self.size * y, self.size * z


def line_of(rows: Sequence[Row], i: int, standard: bool) -> Line:
    """Return the line on which the centre of mass of link i (from 0) is measured."""
    if rows[i].type == "prismatic":
        return "own axis"
    if i + 1 == len(rows) or rows[i + 1].type == "revolute":
        return "x"
    return "next axis" if abs(rows[i if standard else i + 1].a) <= LENGTH_TOLERANCE else "x"


def center_in_frame(rows: Sequence[Row], i: int, standard: bool, center: float | Point) -> Point:
    """Return the centre of mass of link i (from 0) in frame i, [m]."""
    if isinstance(center, tuple):
        return center
    line = line_of(rows, i, standard)
    if line == "x":
        return (center - rows[i].a if standard else center), 0.0, 0.0
    if standard and line == "own axis":
        return 0.0, center * math.sin(rows[i].alpha), center * math.cos(rows[i].alpha)
    if standard or line == "own axis":
        return 0.0, 0.0, center
    alpha = rows[i + 1].alpha
    return 0.0, -center * math.sin(alpha), center * math.cos(alpha)


@dataclass(frozen=True, slots=True)
class MassProperties:
    """Masses, gravity in the base, and velocities, as far as they are given.

    There is one body per row, or none. Velocities have an entry per configuration, in order or by name, [rad/s or m/s].
    """

    bodies: tuple[LinkBody, ...]
    gravity: Gravity
    velocities: "Sequence[Configuration] | Array | None" = None
