"""Picture of a workspace seen along the axes, coloured by the manipulability or the dexterity of the arm there.

Each picture element shows the largest value behind it. An SVG of a million single points would be useless, so the
elements form one image, whatever the number of samples; everything else is lines.
"""

from dataclasses import dataclass
from typing import TypeAlias

import numpy as np
from matplotlib.axes import Axes
from matplotlib.cm import ScalarMappable
from matplotlib.colors import Normalize
from matplotlib.figure import Figure

from gelenk.plots import figure as style
from gelenk.robot.arrays import Array

View: TypeAlias = tuple[Array, Array, str, str]
"""Unit vectors to the right and up, shape (3,) each, and the names of these axes."""

_MOST_ELEMENTS, _FEWEST_ELEMENTS = 160, 24
"""Largest and smallest number of picture elements along the longest side of a cloud."""
_MOST_VOXELS = 400
"""Largest number along that of a grid; with more voxels, several share an element."""
_MARGIN = 0.06
_TITLE_LENGTH = 66
"""Number of characters of a title that fit on one line."""
_ROUNDING = 1e-12
_COLORS = "viridis"


@dataclass(frozen=True, slots=True)
class Picture:
    """Data of a workspace's picture.

    Attributes:
        rows: Positions and values; shape (N, k), the first three columns being x, y, z, [m].
        ends: Names of base and tip frame.
        notes: Lines of text beside the picture.
        origin: Centre of a voxel; shape (3,), [m].
        axes: Unit vectors as columns, first those along which the workspace extends; shape (3, 3).
        dimensions: Number of directions along which the workspace extends.
        cell: Edge length of a voxel, if the rows are voxels, [m].
    """

    rows: Array
    columns: tuple[str, ...]
    robot: str
    ends: tuple[str, str]
    notes: tuple[str, ...]
    origin: Array
    axes: Array
    dimensions: int
    cell: float

    @property
    def element(self) -> float:
        """Edge length of a picture element, [m]: one or more voxels, or so that most cover several samples."""
        longest = float(np.ptp(self.rows[:, :3], axis=0).max()) if len(self.rows) else 1.0
        if _is_one_place(self.rows[:, :3]):
            lower, upper = _corners(self.rows[:, :3])
            return float((upper - lower).max()) / _FEWEST_ELEMENTS
        if "measure" not in self.columns:  # voxels, not samples
            return self.cell * max(1.0, float(np.ceil(longest / (self.cell * _MOST_VOXELS))))
        count = np.clip(np.sqrt(len(self.rows)) / 2.0, _FEWEST_ELEMENTS, _MOST_ELEMENTS)
        return longest / float(count)

    @property
    def values(self) -> Array:
        """Values that the colours show; shape (N,)."""
        return np.asarray(self.rows[:, self.columns.index(self._value)])

    @property
    def _value(self) -> str:
        names = ("dexterity", "best_measure", "measure")
        return next(name for name in names if name in self.columns)

    @property
    def label(self) -> str:
        """Name of the quantity that the colours show."""
        what = "Share of the orientations reached" if self._value == "dexterity" else "Manipulability measure"
        return what if self.is_flat else f"{what},\nthe largest along the line of sight"

    @property
    def is_flat(self) -> bool:
        """Whether the workspace is planar, and so drawn in its plane."""
        return self.dimensions == 2


def picture_bytes(picture: Picture, kind: style.PictureFormat) -> bytes:
    """Draw a workspace: in its plane if it is flat, else from the front, the side and above."""
    values = picture.values
    largest = float(values.max(initial=0.0))
    ends = Normalize(0.0, 1.0 if picture.columns[-1] == "dexterity" else largest or 1.0)
    figure = _in_its_plane(picture, ends) if picture.is_flat else _in_projections(picture, ends)
    base_frame, tip_frame = picture.ends
    robot, chain = f"Workspace of {style.plain(picture.robot)}", f"{style.plain(base_frame)} → {style.plain(tip_frame)}"
    if len(robot) + len(chain) < _TITLE_LENGTH:
        style.write(figure, 0.06, 0.975, [f"{robot}: {chain}"], size=style.TITLE)
    else:
        style.write(figure, 0.06, 0.99, [robot, chain], size=style.TITLE)
    return style.as_bytes(figure, kind)


def _in_its_plane(picture: Picture, ends: Normalize) -> Figure:
    figure = style.new_figure(7.0, 8.6)
    right, up = picture.axes[:, 0], picture.axes[:, 1]
    axes = figure.add_axes((0.11, 0.26, 0.84, 0.68))
    _draw(axes, picture, (right, up, style.axis_name(right, 1), style.axis_name(up, 2)), ends)
    _colour_bar(figure, (0.11, 0.155, 0.84, 0.014), picture, ends)
    style.write(figure, 0.11, 0.115, picture.notes, color=style.QUIET)
    return figure


def _in_projections(picture: Picture, ends: Normalize) -> Figure:
    """Draw front and side views above, and the top view below the front, all on one scale."""
    figure = style.new_figure(9.0, 9.0)
    e, names = np.eye(3), ("x", "y", "z")
    places = {(0, 2): (0.08, 0.54, 0.40, 0.39), (1, 2): (0.57, 0.54, 0.40, 0.39), (0, 1): (0.08, 0.06, 0.40, 0.39)}
    for (i, j), place in places.items():
        _draw(figure.add_axes(place), picture, (e[i], e[j], names[i], names[j]), ends)
    _colour_bar(figure, (0.57, 0.38, 0.40, 0.014), picture, ends)
    style.write(figure, 0.57, 0.38 - 2.2 * style.LINE / 9.0, picture.notes, color=style.QUIET)
    return figure


def _draw(axes: Axes, picture: Picture, view: View, ends: Normalize) -> None:
    """Draw a view on a square around the centre, which has the same size in every view."""
    right, up, right_name, up_name = view
    style.metric_axes(axes, f"{right_name} / m", f"{up_name} / m")
    points = np.asarray(picture.rows[:, :3])
    middle, half = _box(points, picture.element)
    places, centre = points @ np.column_stack((right, up)), np.array((right @ middle, up @ middle))
    count = int(np.ceil(2.0 * half / picture.element))
    # Align elements with the centres of voxels, so that none covers halves of two rows of voxels.
    zero = np.array((right @ picture.origin, up @ picture.origin))
    first = np.rint((centre - half - zero) / picture.element)
    image = elements(np.rint((places - zero) / picture.element) - first, picture.values, count)
    lower = zero + (first - 0.5) * picture.element
    extent = (lower[0], lower[0] + count * picture.element, lower[1], lower[1] + count * picture.element)
    axes.imshow(image, cmap=_COLORS, norm=ends, extent=extent, origin="lower", interpolation="nearest", zorder=2)
    style.look_at(axes, centre, np.full(2, half))
    axes.locator_params(nbins=6)
    axes.plot(0.0, 0.0, marker="+", markersize=10, color=style.INK, markeredgewidth=1.4, zorder=3)


def _box(points: Array, element: float) -> tuple[Array, float]:
    """Return centre and half edge of a cube that contains all points, and the base unless it is far away."""
    lower, upper = _corners(points)
    half = 0.5 * float((upper - lower).max()) * (1.0 + 2.0 * _MARGIN) + element
    return 0.5 * (lower + upper), half


def _corners(points: Array) -> tuple[Array, Array]:
    """Return smallest and largest coordinates, including the base if it is near or the points alone give no scale."""
    if not len(points):
        return np.full(3, -0.5), np.full(3, 0.5)
    lower, upper = points.min(axis=0), points.max(axis=0)
    longest = float((upper - lower).max())
    near = np.clip(0.0, lower - 0.5 * longest, upper + 0.5 * longest) == 0.0
    if near.all() or _is_one_place(points):
        lower, upper = np.minimum(lower, 0.0), np.maximum(upper, 0.0)
    if not (upper > lower).any():
        lower, upper = lower - 0.5, upper + 0.5
    return lower, upper


def _is_one_place(points: Array) -> bool:
    if not len(points):
        return False
    return bool(np.ptp(points, axis=0).max() <= _ROUNDING * np.abs(points).max())


def elements(places: Array, values: Array, count: int) -> Array:
    """Return a square image, by row and column, of the largest value in each element; NaN for an empty one.

    `places`, of shape (N, 2), holds column and row of each value; `count` elements lie along an edge.
    """
    columns, rows = places.astype(np.int64).T
    inside = (columns >= 0) & (columns < count) & (rows >= 0) & (rows < count)
    image = np.full(count * count, -np.inf)
    np.maximum.at(image, rows[inside] * count + columns[inside], values[inside])
    image[np.isneginf(image)] = np.nan
    return image.reshape(count, count)


def _colour_bar(figure: Figure, place: tuple[float, float, float, float], picture: Picture, ends: Normalize) -> None:
    axes = figure.add_axes(place)
    bar = figure.colorbar(ScalarMappable(ends, _COLORS), cax=axes, orientation="horizontal")
    bar.outline.set_visible(False)
    axes.tick_params(colors=style.QUIET, labelsize=style.TEXT, length=3, width=0.8)
    axes.set_title(picture.label, fontproperties=style.font(), color=style.INK, loc="left", pad=6.0)
