"""Kinematic pairs: what each kind takes away, in the plane and in space.

A pair of two links leaves f freedoms of the λ that a free body has, λ = 3 in the plane and 6 in space, and takes
c = λ - f. It is of low order where the links touch in a surface and of high order where they touch in a line or a
point. The number c belongs to the pair: the i-th pair has c_i.
"""

from dataclasses import dataclass
from typing import Literal, TypeAlias

Space: TypeAlias = Literal["planar", "spatial"]
Order: TypeAlias = Literal["low", "high"]

FREEDOMS: dict[Space, int] = {"planar": 3, "spatial": 6}
"""λ: the freedoms of a free body."""


@dataclass(frozen=True, slots=True)
class PairKind:
    """A kind of pair.

    Attributes:
        order: Whether the links touch in a surface (low) or in a line or point (high).
        planar: c with λ = 3, where the plane has such a pair.
        spatial: c with λ = 6, where space has it.
    """

    order: Order
    planar: int | None
    spatial: int | None

    def constraints(self, space: Space) -> int | None:
        """c; None where this space has no such pair."""
        return self.planar if space == "planar" else self.spatial


@dataclass(frozen=True, slots=True)
class Geometry:
    """Where a pair is at one posture, in the axes of the ground; what its kind does not need is None.

    Attributes:
        point: On its axis, its centre or the place of contact, [m].
        axis: Unit vector: to turn about, to slide along, or normal to the surfaces that touch.
        second_axis: Unit vector, of a universal joint.
        pitch: Of a screw, [m/rad].
    """

    point: tuple[float, float, float] | None = None
    axis: tuple[float, float, float] | None = None
    second_axis: tuple[float, float, float] | None = None
    pitch: float | None = None


KINDS: dict[str, PairKind] = {
    "revolute": PairKind("low", 2, 5),
    "prismatic": PairKind("low", 2, 5),
    "rolling": PairKind("high", 2, None),
    "pin_in_slot": PairKind("high", 1, None),
    "cam": PairKind("high", 1, None),
    "gear": PairKind("high", 1, None),
    "screw": PairKind("low", None, 5),
    "universal": PairKind("low", None, 4),
    "cylindrical": PairKind("low", None, 4),
    "spherical": PairKind("low", None, 3),
    "planar": PairKind("low", None, 3),
    "sphere_in_groove": PairKind("high", None, 2),
    "point_contact": PairKind("high", None, 1),
    "fixed": PairKind("low", 3, 6),
}
"""The course's table. `rolling` is without slip, a universal joint counts as one pair, `fixed` makes two links one."""

LETTERS = {
    "R": "revolute",
    "P": "prismatic",
    "H": "screw",
    "U": "universal",
    "C": "cylindrical",
    "S": "spherical",
    "E": "planar",
}
"""The letters by which mechanisms are called, as in 6-UPS."""


def allowed_kinds(space: Space) -> tuple[str, ...]:
    """The kinds of pairs that a space has."""
    return tuple(name for name, kind in KINDS.items() if kind.constraints(space) is not None)
