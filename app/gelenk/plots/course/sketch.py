"""A line drawing without axes, whose labels find places clear of the lines and of each other.

A label names a point and the side on which it should stand. When the drawing is finished, each label tries places
around its point, the wanted side first, and takes the first that covers neither a line nor another text.
"""

from collections.abc import Sequence
from dataclasses import dataclass
from itertools import pairwise
from typing import Any, TypeAlias

import numpy as np
from matplotlib.backends.backend_agg import FigureCanvasAgg
from matplotlib.figure import Figure
from matplotlib.patches import Polygon
from matplotlib.text import Text

from gelenk.plots import figure as style
from gelenk.robot.arrays import Array

Point: TypeAlias = Sequence[float] | Array
Box: TypeAlias = tuple[float, float, float, float]
"""Left, bottom, right and top edge, [pixel]."""

SOLID, DASHED, DOTTED = (0.0, ()), (0.0, (5.0, 3.0)), (0.0, (1.0, 2.0))

_SPACING = 1.5
"""Distance of the points that stand for a line, [pixel]."""
_PAD = 2.0
_TURNS = np.radians([0, 30, -30, 60, -60, 90, -90, 120, -120, 150, -150, 180])
_DISTANCES = (7.0, 10.0, 15.0, 22.0, 30.0, 42.0)
"""Distances of a label from its point that are tried in turn, [pixel]."""


@dataclass(frozen=True, slots=True)
class _Label:
    text: Text
    at: Array
    toward: Array


class Sketch:
    """A drawing of a given size, [inch], of what is in view: left, right, bottom and top, in units of its own."""

    def __init__(self, width: float, height: float, view: tuple[float, float, float, float] | None = None) -> None:
        left, right, bottom, top = view or (0.0, width, 0.0, height)
        self._figure = style.new_figure(width, height)
        self.axes = self._figure.add_axes((0.0, 0.0, 1.0, 1.0))
        self.axes.set_axis_off()
        unit = max((right - left) / width, (top - bottom) / height)
        middle = np.array([left + right, bottom + top]) / 2.0
        style.look_at(self.axes, middle, unit * np.array([width, height]) / 2.0)
        self.unit = unit
        """How much of the drawing is one inch of paper."""
        self._lines: list[Array] = []
        self._fixed: list[Text] = []
        self._labels: list[_Label] = []

    def line(
        self, points: Sequence[Point] | Array, *, color: str = style.INK, width: float = 1.4, dashes: Any = SOLID,
        order: float = 2.0,
    ) -> None:  # fmt: skip
        """Draw a line through points."""
        corners = np.asarray(points, dtype=float)
        caps: dict[str, Any] = {"solid_capstyle": "round", "solid_joinstyle": "round", "dash_capstyle": "butt"}
        self.axes.plot(*corners.T, color=color, linewidth=width, linestyle=dashes, zorder=order, **caps)
        self._lines.append(corners)

    def shape(
        self, points: Sequence[Point] | Array, *, face: Any = "white", edge: str = style.INK, width: float = 1.4,
        order: float = 3.0,
    ) -> None:  # fmt: skip
        """Draw a filled polygon."""
        corners = np.asarray(points, dtype=float)
        look: dict[str, Any] = {"facecolor": face, "edgecolor": edge, "linewidth": width, "joinstyle": "round"}
        self.axes.add_patch(Polygon(corners, closed=True, zorder=order, **look))
        self._lines.append(np.concatenate((corners, corners[:1])))

    def disc(self, at: Point, radius: float, **look: Any) -> None:
        """Draw a filled circle."""
        self.shape(arc(at, radius, 0.0, 2.0 * np.pi)[:-1], **look)
        self._lines.append(np.array([at, at], dtype=float))

    def arrow(self, *points: Point, color: str = style.INK, width: float = 1.4, both: bool = False) -> None:
        """Draw a line through points with a head at its end, or at both ends."""
        corners = np.asarray(points, dtype=float)
        self.line(corners, color=color, width=width)
        for tip, before in ((corners[-1], corners[-2]), (corners[0], corners[1]))[: 2 if both else 1]:
            head = {"arrowstyle": "-|>", "color": color, "linewidth": width, "shrinkA": 0.0, "shrinkB": 0.0}
            back = tip + (before - tip) * min(1.0, 0.05 * self.unit / max(float(np.linalg.norm(before - tip)), 1e-12))
            self.axes.annotate("", tuple(tip), tuple(back), arrowprops={**head, "mutation_scale": 9.0}, zorder=4)

    def hinge(self, at: Point, *, is_ground: bool = False) -> None:
        """Draw a revolute joint, perhaps on the ground."""
        if is_ground:
            self.ground(at)
        self.disc(at, 0.065 * self.unit, order=5.0)

    def ground(self, at: Point) -> None:
        """Draw a support, hatched below, whose top is at a point."""
        x, y = at
        wide, deep = 0.16 * self.unit, 0.2 * self.unit
        self.shape([(x, y), (x - wide, y - deep), (x + wide, y - deep)], face=style.RULE, order=1.5)
        self.hatch((x - 1.5 * wide, y - deep), (x + 1.5 * wide, y - deep))

    def hatch(self, start: Point, end: Point) -> None:
        """Draw the surface of the ground, hatched on the right of its direction."""
        a, b = np.asarray(start, dtype=float), np.asarray(end, dtype=float)
        along = (b - a) / np.linalg.norm(b - a)
        step = 0.09 * self.unit
        down = step * (np.array([along[1], -along[0]]) - along)
        self.line([a, b])
        for foot in np.linspace(a, b, max(2, round(float(np.linalg.norm(b - a)) / step) + 1))[1:]:
            self.line([foot, foot + down], width=0.8)

    def write(
        self, text: str, at: Point, *, color: str = style.INK, size: float = style.TEXT, ha: str = "center",
        bold: bool = False, math: bool = True,
    ) -> None:  # fmt: skip
        """Write a text at a fixed place, centred in height."""
        self._fixed.append(self._text(text, at, color, size, ha, bold, math))

    def label(
        self, text: str, at: Point, toward: Point = (0.0, 1.0), *, color: str = style.INK, math: bool = True
    ) -> None:
        """Write a text near a point, if there is space on the side that `toward` points to."""
        direction = np.asarray(toward, dtype=float)
        length = float(np.linalg.norm(direction))
        unit = direction / length if length > 0.0 else np.array([0.0, 1.0])
        written = self._text(text, at, color, style.TEXT, "center", False, math)
        self._labels.append(_Label(written, np.asarray(at, dtype=float), unit))

    def figure(self) -> Figure:
        """Place the labels and return the figure."""
        with style.drawing:
            renderer: Any = FigureCanvasAgg(self._figure).get_renderer()  # type: ignore[no-untyped-call]
            taken = [_extent(text, renderer) for text in self._fixed]
            ink = self._ink()
            for label in self._labels:
                taken.append(self._placed(label, _extent(label.text, renderer), ink, taken))
        return self._figure

    def _text(self, text: str, at: Point, color: str, size: float, ha: str, bold: bool, math: bool) -> Text:
        x, y = (float(value) for value in at)
        font = style.font(size, bold=bold)
        look: dict[str, Any] = {"ha": ha, "va": "center", "parse_math": math, "zorder": 6, "linespacing": 1.5}
        return self.axes.text(x, y, text, fontproperties=font, color=color, **look)

    def _ink(self) -> Array:
        """Return points along all lines, [pixel]."""
        points = [np.zeros((0, 2))]
        for line in self._lines:
            corners = self.axes.transData.transform(line)
            for a, b in pairwise(corners):
                count = max(2, int(np.linalg.norm(b - a) / _SPACING) + 1)
                points.append(np.linspace(a, b, count))
        return np.concatenate(points)

    def _placed(self, label: _Label, extent: Box, ink: Array, taken: Sequence[Box]) -> Box:
        """Move a label to the best of its places, and return the box that it covers there."""
        half = np.array([extent[2] - extent[0], extent[3] - extent[1]]) / 2.0
        anchor = self.axes.transData.transform(label.at)
        best, least = np.zeros(2), np.inf
        for distance in _DISTANCES:
            for turn in _TURNS:
                c, s = np.cos(turn), np.sin(turn)
                u = np.array([c * label.toward[0] - s * label.toward[1], s * label.toward[0] + c * label.toward[1]])
                middle = anchor + (distance + np.abs(u) @ half) * u
                cost = self._covered((*(middle - half), *(middle + half)), ink, taken)
                if cost < least:
                    best, least = middle, cost
            if least == 0.0:
                break
        label.text.set_position(tuple(self.axes.transData.inverted().transform(best)))
        low, high = best - half, best + half
        return float(low[0]), float(low[1]), float(high[0]), float(high[1])

    def _covered(self, box: Box, ink: Array, taken: Sequence[Box]) -> float:
        """Return how much a text would cover: points of lines, other texts, and the edge of the paper."""
        left, bottom, right, top = np.array(box) + _PAD * np.array([-1.0, -1.0, 1.0, 1.0])
        width, height = self._figure.bbox.size
        inside = (ink[:, 0] > left) & (ink[:, 0] < right) & (ink[:, 1] > bottom) & (ink[:, 1] < top)
        texts = sum(left < b[2] and b[0] < right and bottom < b[3] and b[1] < top for b in taken)
        beyond = bool(left < 0.0 or bottom < 0.0 or right > width or top > height)
        return float(np.count_nonzero(inside) + 1e3 * texts + 1e6 * beyond)


def _extent(text: Text, renderer: Any) -> Box:
    box = text.get_window_extent(renderer)
    return float(box.x0), float(box.y0), float(box.x1), float(box.y1)


def arc(at: Point, radius: float, start: float, end: float) -> Array:
    """Return points of an arc from one angle to another, [rad]; shape (N, 2)."""
    angles = np.linspace(start, end, max(8, round(abs(end - start) * 20.0)))
    return np.asarray(at, dtype=float) + radius * np.column_stack((np.cos(angles), np.sin(angles)))


def direction(angle: float) -> Array:
    """Return the unit vector of an angle, [rad]; shape (2,)."""
    return np.array([np.cos(angle), np.sin(angle)])
