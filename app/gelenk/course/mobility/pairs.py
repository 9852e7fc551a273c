"""Kinematic pairs: the constraints of each kind, in the plane and in space.

Of the λ freedoms of a free body, λ = 3 in the plane and 6 in space, a pair of two links leaves f and removes c = λ - f.
Its order is low if the links touch in a surface, and high if they touch in a line or a point.
"""

from collections.abc import Sequence
from dataclasses import dataclass
from typing import Literal, TypeAlias

Space: TypeAlias = Literal["planar", "spatial"]
Order: TypeAlias = Literal["low", "high"]

FREEDOMS: dict[Space, int] = {"planar": 3, "spatial": 6}
"""Number of freedoms of a free body, λ."""


@dataclass(frozen=True, slots=True)
class PairKind:
    """A kind of kinematic pair: its order, and c in the plane and in space, or None where there is no such pair."""

    order: Order
    planar: int | None
    spatial: int | None

    def constraints(self, space: Space) -> int | None:
        """Return c in a space; None if it has no such pair."""
        return self.planar if space == "planar" else self.spatial


@dataclass(frozen=True, slots=True)
class PairGeometry:
    """Position of a pair at one posture, in the axes of the ground; None for what its kind does not need.

    Attributes:
        point: Point on its axis, its centre, or its point of contact, [m].
        axis: Unit vector: axis of rotation, direction of sliding, or normal of the touching surfaces.
        second_axis: Second axis of a universal joint; unit vector.
        pitch: Pitch of a screw, [m/rad].
    """

    point: Sequence[float] | None = None
    axis: Sequence[float] | None = None
    second_axis: Sequence[float] | None = None
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
"""The course's table. `rolling` is without slip, a universal joint is one pair, `fixed` makes two links one."""

LETTERS = {
    "R": "revolute",
    "P": "prismatic",
    "H": "screw",
    "U": "universal",
    "C": "cylindrical",
    "S": "spherical",
    "E": "planar",
}
"""Letters in the names of mechanisms, as in 6-UPS."""


def allowed_kinds(space: Space) -> tuple[str, ...]:
    """Return the kinds of pairs that exist in a space."""
    return tuple(name for name, kind in KINDS.items() if kind.constraints(space) is not None)
