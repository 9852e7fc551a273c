"""Kinematic pairs: the constraints of each kind, in the plane and in space.

Of the λ freedoms of a free body, λ = 3 in the plane and 6 in space, a pair of two links leaves f and removes c = λ - f.
Its order is low if the links touch in a surface, and high if they touch in a line or a point.
"""

from collections.abc import Sequence
from dataclasses import dataclass
from typing import Literal, TypeAlias

from gelenk.language import marked, translated as _

Space: TypeAlias = Literal["planar", "spatial"]
Order: TypeAlias = Literal["low", "high"]

FREEDOMS: dict[Space, int] = {"planar": 3, "spatial": 6}
"""Number of freedoms of a free body, λ."""


@dataclass(frozen=True, slots=True)
class PairKind:
    """A kind of kinematic pair: its name in English, its order, and c in both spaces, None where there is none."""

    title: str
    order: Order
    planar: int | None
    spatial: int | None

    @property
    def name(self) -> str:
        """Name of the kind in the current language."""
        return _(self.title)

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
    "revolute": PairKind(marked("revolute"), "low", 2, 5),
    "prismatic": PairKind(marked("prismatic"), "low", 2, 5),
    "rolling": PairKind(marked("rolling"), "high", 2, None),
    "pin_in_slot": PairKind(marked("pin in slot"), "high", 1, None),
    "cam": PairKind(marked("cam"), "high", 1, None),
    "gear": PairKind(marked("gear"), "high", 1, None),
    "screw": PairKind(marked("screw"), "low", None, 5),
    "universal": PairKind(marked("universal"), "low", None, 4),
    "cylindrical": PairKind(marked("cylindrical"), "low", None, 4),
    "spherical": PairKind(marked("spherical"), "low", None, 3),
    "planar": PairKind(marked("planar"), "low", None, 3),
    "sphere_in_groove": PairKind(marked("sphere in groove"), "high", None, 2),
    "point_contact": PairKind(marked("point contact"), "high", None, 1),
    "fixed": PairKind(marked("fixed"), "low", 3, 6),
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
