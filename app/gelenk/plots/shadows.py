"""What a picture of an arm shows at its tip: projections of ellipsoids, outlines of polytopes, directions as arrows.

An ellipsoid that has lost an axis, or is seen edge-on, is drawn as a segment; one that is unbounded in some direction
is drawn as a strip. Fills lie below the arm, lines above it. Segments of velocity and force may coincide, so one is
broad, and the other thin and dashed.
"""

from dataclasses import dataclass
from typing import Any

import numpy as np
from matplotlib.axes import Axes
from matplotlib.patches import Ellipse, Polygon
from matplotlib.typing import LineStyleType

from gelenk.language import marked
from gelenk.plots.figure import INK, font
from gelenk.robot.arrays import Array

SOLID: LineStyleType = "-"
DASHED: LineStyleType = (0.0, (5.0, 1.6))
DOTTED: LineStyleType = (0.0, (1.2, 1.4))

THIN = 1.6
_BROAD = 4.5
_FILL = 0.10
_BELOW, _ABOVE, _ON_TOP = 1.0, 4.0, 5.5
_FLAT = 1e-6
"""Width, as a fraction of the extent, up to which a projection is drawn as a segment."""
_TICK = 0.018
"""Half the length of the marks at the ends of a segment, as a fraction of the extent."""
_FAR = 1e3
"""Distance at which an endless strip is cut off, in extents: far outside the picture."""
_FINITE = {0: marked("point"), 1: marked("segment"), 2: marked("ellipse"), 3: marked("ellipsoid")}
_ENDLESS = {
    (1, 1): marked("line"),
    (2, 1): marked("strip"),
    (2, 2): marked("plane"),
    (3, 1): marked("cylinder"),
    (3, 2): marked("slab"),
    (3, 3): marked("space"),
}


@dataclass(frozen=True, slots=True)
class Quantity:
    """An ellipsoid to draw.

    Attributes:
        unit: Unit of the semi-axes.
        axes: Principal axes as unit columns; shape (3, d).
        sizes: Lengths of the semi-axes, ∞ if unbounded; shape (d,).
        scale: Metres as drawn per unit.
    """

    name: str
    unit: str
    color: str
    dashes: LineStyleType
    axes: Array
    sizes: Array
    scale: float

    @property
    def shape(self) -> str:
        """Name of the shape: an ellipse that has lost an axis is a segment, an unbounded one is a strip."""
        endless = int(np.sum(np.isinf(self.sizes)))
        return _ENDLESS[len(self.sizes), endless] if endless else _FINITE[int(np.count_nonzero(self.sizes))]

    @property
    def bounded(self) -> Array:
        """Bounded semi-axes as columns; shape (3, c), [m as drawn]."""
        ends = np.isfinite(self.sizes)
        return np.asarray(self.axes[:, ends] * self.sizes[ends] * self.scale)

    @property
    def unbounded(self) -> Array:
        """Unit vectors along the unbounded semi-axes, as columns; shape (3, d - c)."""
        return np.asarray(self.axes[:, ~np.isfinite(self.sizes)])

    @property
    def halves(self) -> Array:
        """Half extents of its bounded part along x, y and z; shape (3,), [m as drawn]."""
        return np.asarray(np.linalg.norm(self.bounded, axis=1))


@dataclass(frozen=True, slots=True)
class Outline:
    """A polytope in a plane: vertices in order, shape (V, 3), or why there are none; a unit is `scale` metres drawn."""

    name: str
    unit: str
    color: str
    vertices: Array | None
    scale: float
    missing: str

    @property
    def halves(self) -> Array:
        """Half extents along x, y and z; shape (3,), [m as drawn]."""
        if self.vertices is None:
            return np.zeros(3)
        return np.asarray(np.abs(self.vertices).max(axis=0) * self.scale)


@dataclass(frozen=True, slots=True)
class Arrow:
    """A direction for which transmission ratios were requested, and its number in the picture, from 1.

    Attributes:
        direction: Unit vector; shape (3,).
        ends: Colour and distance, [m as drawn], at which a ray along it leaves each ellipsoid that is bounded there.
        words: Text for the legend.
    """

    number: int
    direction: Array
    ends: tuple[tuple[str, float], ...]
    words: str


def draw_quantity(axes: Axes, plane: Array, tip: Array, quantity: Quantity, extent: float) -> None:
    """Draw the projection of an ellipsoid onto a plane of shape (2, 3); nothing if it covers the whole plane."""
    endless, sizes, _ = np.linalg.svd(np.hstack((plane @ quantity.unbounded, np.zeros((2, 2)))))
    ways = int(np.sum(sizes > 1e-6))
    if ways == 2:
        return
    if ways == 1:
        along, across = endless[:, 0], endless[:, 1]
        half = float(np.linalg.norm(across @ plane @ quantity.bounded))
        _draw_strip(axes, tip, _FAR * extent * along, half * across, quantity, extent)
        return
    left, sizes, _ = np.linalg.svd(np.hstack((plane @ quantity.bounded, np.zeros((2, 2)))))
    if sizes[1] <= _FLAT * extent:
        if sizes[0] > _FLAT * extent:
            _draw_segment(axes, tip, sizes[0] * left[:, 0], quantity, extent)
        return
    angle = float(np.degrees(np.arctan2(left[1, 0], left[0, 0])))
    place, width, height = (float(tip[0]), float(tip[1])), 2.0 * sizes[0], 2.0 * sizes[1]
    fill: dict[str, Any] = {"facecolor": (quantity.color, _FILL), "edgecolor": "none", "zorder": _BELOW}
    axes.add_patch(Ellipse(place, width, height, angle=angle, **fill))
    line: dict[str, Any] = {
        "edgecolor": quantity.color,
        "linestyle": quantity.dashes,
        "linewidth": THIN,
        "zorder": _ABOVE,
    }
    axes.add_patch(Ellipse(place, width, height, angle=angle, fill=False, **line))


def _draw_strip(axes: Axes, tip: Array, along: Array, across: Array, quantity: Quantity, extent: float) -> None:
    if float(np.linalg.norm(across)) <= _FLAT * extent:
        _draw_segment(axes, tip, along, quantity, extent)
        return
    corners = np.array([tip + a * along + b * across for a, b in ((1, 1), (-1, 1), (-1, -1), (1, -1))])
    look: dict[str, Any] = {"facecolor": (quantity.color, _FILL), "edgecolor": quantity.color, "zorder": _BELOW}
    axes.add_patch(Polygon(corners, linestyle=quantity.dashes, linewidth=THIN, **look))


def _draw_segment(axes: Axes, tip: Array, half: Array, quantity: Quantity, extent: float) -> None:
    """Draw a segment with a mark at each end; a solid one is broad, to stay visible under a dashed one."""
    broad = quantity.dashes == SOLID
    look: dict[str, Any] = {
        "color": quantity.color,
        "linewidth": _BROAD if broad else THIN,
        "alpha": 0.5 if broad else 1.0,
    }
    ends = np.array([tip - half, tip + half])
    order = _ABOVE if broad else _ABOVE + 0.5
    axes.plot(*ends.T, linestyle=quantity.dashes, solid_capstyle="butt", zorder=order, **look)
    mark = _TICK * extent * np.array([-half[1], half[0]]) / np.linalg.norm(half)
    for end in ends:
        axes.plot(*np.array([end - mark, end + mark]).T, color=quantity.color, linewidth=THIN, zorder=order)


def draw_outline(axes: Axes, plane: Array, tip: Array, outline: Outline) -> None:
    """Draw the outline of a polytope, if it has vertices."""
    if outline.vertices is None:
        return
    corners = tip + outline.scale * outline.vertices @ plane.T
    look: dict[str, Any] = {"edgecolor": outline.color, "linestyle": DOTTED, "linewidth": THIN, "joinstyle": "round"}
    axes.add_patch(Polygon(corners, fill=False, zorder=_ABOVE, **look))


def draw_arrow(axes: Axes, plane: Array, tip: Array, arrow: Arrow, length: float) -> None:
    """Draw a direction from the tip, with its number at the head and a dot where it leaves each ellipsoid."""
    along = plane @ arrow.direction
    if float(np.linalg.norm(along)) <= _FLAT:
        return
    head, beyond = tip + length * along, tip + (length + 0.07 * length / np.linalg.norm(along)) * along
    look: dict[str, Any] = {"arrowstyle": "-|>", "color": INK, "linewidth": 1.0, "shrinkA": 0.0, "shrinkB": 0.0}
    axes.annotate("", tuple(head), tuple(tip), arrowprops=look, zorder=_ON_TOP)
    x, y = beyond.tolist()
    axes.text(x, y, str(arrow.number), fontproperties=font(), color=INK, ha="center", va="center", zorder=_ON_TOP)
    for color, reach in arrow.ends:
        if reach <= _FLAT * length:
            continue
        axes.plot(*(tip + reach * along), marker="o", markersize=5.0, color=color, zorder=_ON_TOP)
