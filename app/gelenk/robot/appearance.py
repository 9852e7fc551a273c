"""Bodies for the links of a DH table, and stand-in bodies for links without visible shapes: simple solids.

A DH table does not describe bodies. To display its robot and simulate its motion, each link gets thin cylinders along
its d (the joint's axis) and its a (the common normal), a shorter, thicker cylinder at a revolute joint and a box at a
prismatic one. Zero lengths get no cylinder. The inertia is that of these solids, so it is physically possible: positive
definite and within the triangle inequality.
"""

import math
from collections.abc import Container, Iterable, Sequence
from dataclasses import dataclass

import numpy as np

from gelenk.language import translated as _
from gelenk.robot.arrays import Array
from gelenk.robot.chain import rotation_to_axis
from gelenk.robot.description import MOVABLE, Description, Inertial, Joint, Link, Origin, Shape, Triple
from gelenk.robot.notations import origin_of

MASS_PER_LENGTH = 3.0
"""Mass per length of a solid, [kg/m]: about that of an aluminium tube 80 mm wide with a 5 mm wall."""

_SKELETON_THICKNESS = 0.06
"""Relative radius of a skeleton's rod, half a DH table's, so that it is not taken for the robot's own shape."""
_Z: Triple = (0.0, 0.0, 1.0)
_SMALLEST_RADIUS = 1e-4
"""Minimum radius of a thin cylinder, [m], so that no solid is massless."""
_SLENDEREST = 1e-3
"""Minimum ratio of a cylinder's radius to its length: below it, rounding would swamp the moment about its axis."""
_LONGEST_WAY = 100.0
"""Limit of a prismatic joint's drawn travel to either side, in radii of a thin cylinder."""
_DEFAULT_LENGTH = 0.1
"""Typical length assumed for a table whose lengths are all zero, [m]."""
_SHORT = 1e-9
"""A cylinder shorter than this fraction of its radius is omitted."""
_MOST_INERTIA = 1e12
"""Largest moment of inertia [kg m²]: that of a link of 1000 km would exceed the limit of a description."""


def invented_masses() -> str:
    """Return a note on the masses of a robot that is a DH table."""
    text = _(
        "a DH table says nothing of masses: those of the links are invented, {density:g} kg for each metre of the "
        "simple bodies drawn for it"
    )
    return text.format(density=MASS_PER_LENGTH)


@dataclass(frozen=True, slots=True)
class Solid:
    """A homogeneous cylinder (radius, length; along z) or box (x, y, z); sizes in [m].

    `centre` (3,) is its centre of mass, [m], and `rotation` (3, 3) has its axes as columns, both in a link's frame.
    """

    kind: str
    size: tuple[float, ...]
    centre: Array
    rotation: Array

    @property
    def mass(self) -> float:
        """Mass, proportional to the length along z, [kg]."""
        return MASS_PER_LENGTH * self.size[-1]

    def inertia(self) -> Array:
        """Return the inertia about the centre of mass, in the link's axes; shape (3, 3), [kg m²]."""
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
        """Return the solid as a visual shape of a link."""
        T = np.eye(4)
        T[:3, :3], T[:3, 3] = self.rotation, self.centre
        return Shape("visual", origin_of(T), "box" if self.kind == "box" else "cylinder", self.size)


class Stock:
    """Creates the solids of an arm's links, all with the same thickness.

    The radius of a thin cylinder is `thickness` times the median of the lengths between joints [m] that are not zero.
    """

    def __init__(self, lengths: Iterable[float], thickness: float = 0.12) -> None:
        some = [abs(length) for length in lengths if length]
        typical = float(np.median(some)) if some else _DEFAULT_LENGTH
        self.radius = max(thickness * typical, _SMALLEST_RADIUS)

    def rod(self, start: Sequence[float] | Array, end: Sequence[float] | Array) -> list[Solid]:
        """Return a thin cylinder between two points of a link, or none if they coincide; a very long one is thicker."""
        way = np.asarray(end, dtype=float) - np.asarray(start, dtype=float)
        length = math.hypot(*way)
        if length <= _SHORT * self.radius:
            return []
        x, y, z = (way / length).tolist()
        radius = max(self.radius, _SLENDEREST * length)
        return [Solid("cylinder", (radius, length), np.asarray(start) + way / 2, rotation_to_axis((x, y, z)))]

    def hub(self, z: float = 0.0, axis: Triple = _Z) -> Solid:
        """Return the body of a revolute joint, centred on its axis at height z [m]."""
        return Solid("cylinder", (2.2 * self.radius, 5.0 * self.radius), z * np.array(axis), _along(axis))

    def travel(self, lower: float, upper: float) -> tuple[float, float]:
        """Clip a prismatic joint's limits [m] to the range that is drawn, because they may be infinite or very far."""
        most = _LONGEST_WAY * self.radius
        return max(lower, -most), min(upper, most)

    def slide(self, lower: float, upper: float, axis: Triple = _Z) -> list[Solid]:
        """Return a box at the link's origin for a prismatic joint, and a rod along its axis that spans the travel."""
        box = Solid("box", (4.0 * self.radius,) * 2 + (5.0 * self.radius,), np.zeros(3), _along(axis))
        lower, upper = self.travel(lower, upper)
        return [box, *self.rod(min(-upper, 0.0) * np.array(axis), max(-lower, 0.0) * np.array(axis))]


def _along(axis: Triple) -> Array:
    return np.eye(3) if axis == _Z else rotation_to_axis(axis)


def inertial_of(solids: Sequence[Solid]) -> Inertial:
    """Combine solids (at least one) into a single body with their mass, centre of mass and inertia."""
    masses = np.array([solid.mass for solid in solids])
    mass = float(masses.sum())
    centre = masses @ np.array([solid.centre for solid in solids]) / mass
    inertia = np.zeros((3, 3))
    for solid in solids:
        r = solid.centre - centre
        inertia += solid.inertia() + solid.mass * (r @ r * np.eye(3) - np.outer(r, r))
    # A link many kilometres long gets a lower density, so that its inertia stays within the limit.
    lightness = min(1.0, _MOST_INERTIA / float(inertia.max()))
    ixx, ixy, ixz, iyy, iyz, izz = (lightness * float(inertia[i, j]) + 0.0 for i in range(3) for j in range(i, 3))
    x, y, z = (float(value) + 0.0 for value in centre)
    place: Triple = (x, y, z)
    return Inertial(Origin(place), lightness * mass, (ixx, ixy, ixz, iyy, iyz, izz))


def skeleton(description: Description, without: Container[str]) -> dict[str, list[Solid]]:
    """Create solids for the links that show nothing themselves, by link name, each in its link's frame.

    A link gets a rod to each joint below, and a body for the joint above if that moves. If other links show something,
    one with neither a shape nor a movable joint is a mere frame and gets none; links with none are left out. `without`
    names the meshes whose files are missing.
    """
    stock = Stock((math.hypot(*joint.origin.xyz) for joint in description.joints), _SKELETON_THICKNESS)
    bare = [link for link in description.links if not _shows(link, without)]
    found = {}
    for link in bare:
        above, below = description.joint_above.get(link.name), description.joints_below[link.name]
        moves = any(joint.type in MOVABLE for joint in (above, *below) if joint)
        if moves or link.shapes or len(bare) == len(description.links):
            found[link.name] = _solids(stock, above, below)
    return {name: solids for name, solids in found.items() if solids}


def _shows(link: Link, without: Container[str]) -> bool:
    return any(shape.role == "visual" and shape.mesh not in without for shape in link.shapes)


def _solids(stock: Stock, above: Joint | None, below: tuple[Joint, ...]) -> list[Solid]:
    solids = [rod for joint in below for rod in stock.rod((0.0, 0.0, 0.0), joint.origin.xyz)]
    if above is None or above.type not in MOVABLE:
        return solids
    if above.type == "prismatic":
        return solids + stock.slide(above.limits.lower or 0.0, above.limits.upper or 0.0, above.axis)
    return [*solids, stock.hub(axis=above.axis)]
