"""What the links of a table look like and weigh: simple solids along its lengths, each of some kilograms a metre.

A table says nothing about bodies. So that its robot can be seen and moved by a simulator, each link gets thin
cylinders along its d (the joint's axis) and its a (the common normal), a thicker short one where a joint turns and a
box where one slides. Lengths that are zero leave nothing. The inertia is that of these solids, which is therefore one
that a body can have: positive definite, and within the triangle inequality.
"""

import math
from collections.abc import Iterable, Sequence
from dataclasses import dataclass

import numpy as np

from gelenk.model.arrays import Array
from gelenk.model.chain import rotation_to_axis
from gelenk.model.description import Inertial, Origin, Shape, Triple
from gelenk.model.origins import origin_of

MASS_PER_LENGTH = 3.0
"""Of a solid, [kg/m]: about that of an aluminium tube 80 mm wide with a wall of 5 mm."""
INVENTED_MASSES = (
    f"a DH table says nothing of masses: those of the links are invented, {MASS_PER_LENGTH:g} kg for each metre of the "
    "simple bodies drawn for it"
)

_Z: Triple = (0.0, 0.0, 1.0)
_SMALLEST_RADIUS = 1e-4
"""Of a thin cylinder, [m]: nothing is without mass."""
_SLENDEREST = 1e-3
"""Smallest radius of a cylinder for its length: with less, the moment about its axis would drown in rounding."""
_LONGEST_WAY = 100.0
"""How far from zero a sliding joint's rod reaches, in radii of a thin cylinder."""
_DEFAULT_LENGTH = 0.1
"""The typical length of a table all of whose lengths are zero, [m]."""
_SHORT = 1e-9
"""A cylinder shorter than this part of its radius is left out."""
_MOST_INERTIA = 1e12
"""Largest moment of inertia [kg m²]: that of a link of 1000 km would be beyond what a description may say."""


@dataclass(frozen=True, slots=True)
class Solid:
    """A homogeneous cylinder (radius, length; along z) or box (x, y, z) somewhere in a link; sizes in [m].

    Attributes:
        kind: Which of the two.
        size: Its numbers.
        centre: Of mass, in the link; shape (3,), [m].
        rotation: Its axes in the link, as columns; shape (3, 3).
    """

    kind: str
    size: tuple[float, ...]
    centre: Array
    rotation: Array

    @property
    def mass(self) -> float:
        """By its length along z, [kg]."""
        return MASS_PER_LENGTH * self.size[-1]

    def inertia(self) -> Array:
        """About its centre, in the link's axes; shape (3, 3), [kg m²]."""
        if self.kind == "box":
            x, y, z = (side**2 / 12 for side in self.size)
            moments = np.array([y + z, x + z, x + y])
        else:
            radius, length = self.size
            across = radius**2 / 4 + length**2 / 12
            moments = np.array([across, across, radius**2 / 2])
        inertia: Array = self.mass * (self.rotation * moments) @ self.rotation.T
        return inertia

    def shape(self) -> Shape:
        """For display."""
        T = np.eye(4)
        T[:3, :3], T[:3, 3] = self.rotation, self.centre
        return Shape("visual", origin_of(T), "box" if self.kind == "box" else "cylinder", self.size)


class Stock:
    """The solids that an arm's links are made of, all of one thickness.

    Args:
        lengths: Those between its joints, [m]; they set the thickness.
        thickness: Radius of a thin cylinder, in typical lengths.
    """

    def __init__(self, lengths: Iterable[float], thickness: float = 0.12) -> None:
        some = [abs(length) for length in lengths if length]
        typical = float(np.median(some)) if some else _DEFAULT_LENGTH
        self.radius = max(thickness * typical, _SMALLEST_RADIUS)

    def rod(self, start: Sequence[float] | Array, end: Sequence[float] | Array) -> list[Solid]:
        """A thin cylinder between two points of a link; none where they are one. A long one is no wire."""
        way = np.asarray(end, dtype=float) - np.asarray(start, dtype=float)
        length = math.hypot(*way)
        if length <= _SHORT * self.radius:
            return []
        x, y, z = (way / length).tolist()
        radius = max(self.radius, _SLENDEREST * length)
        return [Solid("cylinder", (radius, length), np.asarray(start) + way / 2, rotation_to_axis((x, y, z)))]

    def hub(self, z: float = 0.0, axis: Triple = _Z) -> Solid:
        """The body of a turning joint, on its axis at a height."""
        return Solid("cylinder", (2.2 * self.radius, 5.0 * self.radius), z * np.array(axis), _along(axis))

    def travel(self, lower: float, upper: float) -> tuple[float, float]:
        """Lower and upper end of what is shown of a sliding joint's way: not all of one that has no end."""
        most = _LONGEST_WAY * self.radius
        return max(lower, -most), min(upper, most)

    def slide(self, lower: float, upper: float, axis: Triple = _Z) -> list[Solid]:
        """The body of a sliding joint at the link's origin, and its rod, which reaches where its travel begins."""
        box = Solid("box", (4.0 * self.radius,) * 2 + (5.0 * self.radius,), np.zeros(3), _along(axis))
        lower, upper = self.travel(lower, upper)
        return [box, *self.rod(min(-upper, 0.0) * np.array(axis), max(-lower, 0.0) * np.array(axis))]


def _along(axis: Triple) -> Array:
    return np.eye(3) if axis == _Z else rotation_to_axis(axis)


def inertial_of(solids: Sequence[Solid]) -> Inertial:
    """Mass, centre of mass and inertia of solids joined to one body; at least one."""
    masses = np.array([solid.mass for solid in solids])
    mass = float(masses.sum())
    centre = masses @ np.array([solid.centre for solid in solids]) / mass
    inertia = np.zeros((3, 3))
    for solid in solids:
        r = solid.centre - centre
        inertia += solid.inertia() + solid.mass * (r @ r * np.eye(3) - np.outer(r, r))
    # A link of many kilometres is made of something lighter.
    lightness = min(1.0, _MOST_INERTIA / float(inertia.max()))
    ixx, ixy, ixz, iyy, iyz, izz = (lightness * float(inertia[i, j]) + 0.0 for i in range(3) for j in range(i, 3))
    x, y, z = (float(value) + 0.0 for value in centre)
    place: Triple = (x, y, z)
    return Inertial(Origin(place), lightness * mass, (ixx, ixy, ixz, iyy, iyz, izz))
