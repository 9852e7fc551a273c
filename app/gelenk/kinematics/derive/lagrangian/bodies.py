"""The bodies of an arm and gravity as they were given; None for what stays a symbol without a value.

Where the centre of mass is one number, it lies on the line of its link. A link behind a revolute joint has x of its
frame for a line, measured from the joint's axis, as the course draws it; only where it has no length along x and a
sliding joint comes next, that joint's axis is its line (an RP arm). A link behind a prismatic joint has that joint's
axis, measured from the origin of its frame.
"""

import math
from collections.abc import Sequence
from dataclasses import dataclass
from typing import TYPE_CHECKING, Literal, TypeAlias

from gelenk.kinematics.derive.table import LENGTH_TOLERANCE, RowNumbers

if TYPE_CHECKING:  # symbols share nothing with numbers, not even their types
    from gelenk.model.arrays import Configuration

Line: TypeAlias = Literal["x", "next axis", "own axis"]
Point: TypeAlias = tuple[float, float, float]

STANDARD_GRAVITY = 9.81
"""What g_0 is where it is not given, [m/s²]."""


@dataclass(frozen=True, slots=True)
class Body:
    """A link of the arm.

    Attributes:
        mass: [kg]
        center: Centre of mass, on the line of the link or as a point in frame i, [m].
        inertia: About the centre of mass, the axis normal to the plane, [kg m²].
    """

    mass: float | None = None
    center: float | Point | None = None
    inertia: float | None = None


@dataclass(frozen=True, slots=True)
class Gravity:
    """Free fall: its size, [m/s²], and a unit vector; no size where there is none."""

    size: float
    direction: Point

    @property
    def vector(self) -> Point:
        """The acceleration, [m/s²]."""
        x, y, z = self.direction
        return self.size * x, self.size * y, self.size * z


def line_of(rows: Sequence[RowNumbers], i: int, standard: bool) -> Line:
    """On which line the centre of mass of link i (from 0) is measured."""
    if not rows[i].is_revolute:
        return "own axis"
    if i + 1 == len(rows) or rows[i + 1].is_revolute:
        return "x"
    return "next axis" if abs(rows[i if standard else i + 1].a) <= LENGTH_TOLERANCE else "x"


def center_in_frame(rows: Sequence[RowNumbers], i: int, standard: bool, center: float | Point) -> Point:
    """Where the centre of mass of link i (from 0) is in frame i, [m]."""
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
class Dynamics:
    """What is known of the masses.

    Attributes:
        bodies: One a row; empty where nothing is known.
        gravity: In the base.
        velocities: One a configuration, in order or by name, [rad/s or m/s]; None where none are given.
    """

    bodies: tuple[Body, ...]
    gravity: Gravity
    velocities: Sequence["Configuration"] | None = None
