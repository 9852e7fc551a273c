"""The arm with the velocity and the force ellipse of its tip: in its plane, or in three projections.

Velocities, forces and lengths have no common scale: each ellipse is drawn as large as suits the arm, and the legend
says how many metres of paper stand for one unit. A force that is unbounded is a strip without ends.
"""

from collections.abc import Sequence
from dataclasses import dataclass
from typing import Any, TypeAlias

import numpy as np
from matplotlib.axes import Axes
from matplotlib.figure import Figure
from matplotlib.lines import Line2D
from matplotlib.patches import Ellipse, Polygon
from matplotlib.typing import LineStyleType

from app.kinematics.manipulability import Ellipsoids
from app.model.arrays import Array
from app.model.chain import Chain
from app.plots.arm import ArmLine, arm_line
from app.plots.figure import (
    FORCE,
    INK,
    LINE,
    LINK,
    QUIET,
    TITLE,
    VELOCITY,
    PictureFormat,
    as_bytes,
    metric_axes,
    new_figure,
    plain,
    write,
)

View: TypeAlias = tuple[Array, str, str]
"""Two unit vectors of a plane of projection as rows, shape (2, 3), and what its axes are called."""

_SOLID: LineStyleType = "-"
_DASHED: LineStyleType = (0.0, (5.0, 1.6))

_DIGITS = {1: 4, 2: 4, 3: 3}
_SHAPES = {1: "segment", 2: "ellipse", 3: "ellipsoid"}

_LARGEST = 0.38
"""Semi-axis of the larger extent of an ellipse, in fractions of the arm's extent."""
_NARROWEST = 0.004
"""A semi-axis is drawn no narrower than this fraction of the extent: a vanishing one is a line then."""
_MARGIN = 0.08
_FAR = 1e3
"""Where a strip without ends is cut off, in extents: far outside the picture."""


@dataclass(frozen=True, slots=True)
class Quantity:
    """An ellipsoid to be drawn.

    Attributes:
        name: Of what.
        unit: Of its semi-axes.
        color: Of its line.
        dashes: Of its line.
        axes: Principal axes as unit columns; shape (3, d).
        sizes: Semi-axes, infinite where unbounded; shape (d,).
        scale: Metres of paper a unit.
    """

    name: str
    unit: str
    color: str
    dashes: LineStyleType
    axes: Array
    sizes: Array
    scale: float

    @property
    def bounded(self) -> Array:
        """Drawn semi-axes as columns, those that have an end; shape (3, c), [m of paper]."""
        ends = np.isfinite(self.sizes)
        return np.asarray(self.axes[:, ends] * self.sizes[ends] * self.scale)

    @property
    def unbounded(self) -> Array:
        """Directions without an end, as columns."""
        return np.asarray(self.axes[:, ~np.isfinite(self.sizes)])

    @property
    def halves(self) -> Array:
        """Half its extent along x, y and z, as far as it has an end; shape (3,), [m of paper]."""
        return np.asarray(np.linalg.norm(self.bounded, axis=1))


def manipulability_picture(
    name: str, chain: Chain, q: Array, translation: Ellipsoids | None, kind: PictureFormat
) -> bytes:
    """The picture.

    Args:
        name: Of the robot.
        chain: Base and tip.
        q: One configuration; shape (n,), [rad or m].
        translation: Ellipsoids of translation at this configuration alone; None where the task has no direction of it.
        kind: What the bytes are.
    """
    arm = arm_line(chain, q)
    extent = max(float(np.ptp(arm.points, axis=0).max()), float(np.linalg.norm(arm.points[-1])), 1e-3)
    quantities = [] if translation is None else _quantities(chain, translation, extent)
    in_plane = translation is not None and translation.space.is_plane and len(translation.space.rows) > 1
    if translation is not None and in_plane:
        figure = _in_its_plane(arm, quantities, translation.space.spread(translation.space.basis.T), extent)
    else:
        figure = _in_projections(arm, quantities, extent)
    title = f"{plain(name)}: {plain(chain.base_frame)} → {plain(chain.tip_frame)}"
    write(figure, 0.06, 0.975, [title], size=TITLE)
    _write_legend(figure, (0.06, 0.205) if in_plane else (0.57, 0.42), quantities, translation)
    return as_bytes(figure, kind)


def _quantities(chain: Chain, translation: Ellipsoids, extent: float) -> list[Quantity]:
    """The velocity and the force ellipsoid; none where the tip has no translation."""
    sigmas = translation.sigmas[0]
    if not len(sigmas):
        return []
    axes = translation.space.spread(translation.axes[0].T).T
    kinds = set(chain.flat.joints[:, 0].tolist())
    joint_velocity, joint_force = {frozenset({0}): ("rad/s", "N m"), frozenset({1}): ("m/s", "N")}.get(
        frozenset(kinds), ("joint velocity", "joint effort")
    )
    inverses = np.divide(1.0, sigmas, out=np.full_like(sigmas, np.inf), where=sigmas > 0.0)
    return [
        Quantity("Velocity", f"m/s per {joint_velocity}", VELOCITY, _SOLID, axes, sigmas, _scale(sigmas, extent)),
        Quantity("Force", f"N per {joint_force}", FORCE, _DASHED, axes, inverses, _scale(inverses, extent)),
    ]


def _scale(sizes: Array, extent: float) -> float:
    """Metres of paper a unit, one significant digit of 1, 2 or 5, so that the largest end stays within the picture."""
    largest = float(sizes[np.isfinite(sizes)].max(initial=0.0))
    if not largest > 0.0:
        return 1.0
    wanted = _LARGEST * extent / largest
    decade = 10.0 ** np.floor(np.log10(wanted))
    return float(max(step * decade for step in (1.0, 2.0, 5.0) if step * decade <= wanted))


def _in_its_plane(arm: ArmLine, quantities: Sequence[Quantity], plane: Array, extent: float) -> Figure:
    figure = new_figure(6.4, 7.6)
    axes = figure.add_axes((0.13, 0.29, 0.83, 0.63))
    view = (plane, f"{_axis_name(plane[0], 1)} / m", f"{_axis_name(plane[1], 2)} / m")
    points = arm.points @ plane.T
    halves = [np.linalg.norm(plane @ quantity.bounded, axis=1) for quantity in quantities]
    middle, half = _box(points, halves, extent)
    _draw(axes, view, arm, quantities, extent)
    # The narrower of the two is widened, so that the axes fill their place.
    _look_at(axes, middle, np.maximum(half, half[::-1] * _shape(axes) ** np.array([1.0, -1.0])))
    return figure


def _in_projections(arm: ArmLine, quantities: Sequence[Quantity], extent: float) -> Figure:
    """Front and side above, the view from above below the front, on one scale."""
    figure = new_figure(9.0, 9.0)
    names, e = ("x / m", "y / m", "z / m"), np.eye(3)
    middle, half = _box(arm.points, [quantity.halves for quantity in quantities], extent)
    places = {(0, 2): (0.08, 0.53, 0.40, 0.40), (1, 2): (0.57, 0.53, 0.40, 0.40), (0, 1): (0.08, 0.06, 0.40, 0.40)}
    for (i, j), place in places.items():
        axes = figure.add_axes(place)
        _draw(axes, (e[[i, j]], names[i], names[j]), arm, quantities, extent)
        _look_at(axes, middle[[i, j]], np.full(2, half.max()))
    return figure


def _axis_name(direction: Array, number: int) -> str:
    """x, y or z where the direction is one of these."""
    for name, unit in zip("xyz", np.eye(3), strict=True):
        if np.abs(direction - unit).max() < 1e-9:
            return name
    return f"in-plane direction {number}"


def _box(points: Array, halves: Sequence[Array], extent: float) -> tuple[Array, Array]:
    """Middle and half the size of what holds the arm and the ellipses at its tip."""
    everything = np.concatenate([points, *(points[-1:] + sign * half for half in halves for sign in (1.0, -1.0))])
    lower, upper = everything.min(axis=0), everything.max(axis=0)
    return (lower + upper) / 2.0, (upper - lower) / 2.0 + _MARGIN * extent


def _shape(axes: Axes) -> float:
    """Width over height."""
    width, height = axes.bbox.size
    return float(width / height)


def _look_at(axes: Axes, middle: Array, half: Array) -> None:
    axes.set_xlim(middle[0] - half[0], middle[0] + half[0])
    axes.set_ylim(middle[1] - half[1], middle[1] + half[1])


def _draw(axes: Axes, view: View, arm: ArmLine, quantities: Sequence[Quantity], extent: float) -> None:
    plane, x_label, y_label = view
    metric_axes(axes, x_label, y_label)
    points = arm.points @ plane.T
    for quantity in quantities:
        _draw_quantity(axes, plane, points[-1], quantity, extent)
    _draw_arm(axes, points, arm)


def _draw_quantity(axes: Axes, plane: Array, tip: Array, quantity: Quantity, extent: float) -> None:
    """The shadow of an ellipsoid, or of what is left of it without ends."""
    look: dict[str, Any] = {
        "facecolor": (quantity.color, 0.10),
        "edgecolor": quantity.color,
        "linestyle": quantity.dashes,
        "linewidth": 1.6,
        "joinstyle": "round",
        "zorder": 4,
    }
    endless, sizes, _ = np.linalg.svd(np.hstack((plane @ quantity.unbounded, np.zeros((2, 2)))))
    ways = int(np.sum(sizes > 1e-6))
    if ways == 2:
        return
    if ways == 1:
        along, across = endless[:, 0], endless[:, 1]
        half = max(float(np.linalg.norm(across @ plane @ quantity.bounded)), _NARROWEST * extent)
        corners = [tip + _FAR * extent * a * along + half * b * across for a, b in ((1, 1), (-1, 1), (-1, -1), (1, -1))]
        axes.add_patch(Polygon(np.array(corners), **look))
        return
    left, sizes, _ = np.linalg.svd(np.hstack((plane @ quantity.bounded, np.zeros((2, 2)))))
    width, height = 2.0 * np.maximum(sizes[:2], _NARROWEST * extent)
    angle = float(np.degrees(np.arctan2(left[1, 0], left[0, 0])))
    axes.add_patch(Ellipse((float(tip[0]), float(tip[1])), width, height, angle=angle, **look))


def _draw_arm(axes: Axes, points: Array, arm: ArmLine) -> None:
    caps: dict[str, Any] = {"solid_capstyle": "round", "solid_joinstyle": "round"}
    axes.plot(points[:, 0], points[:, 1], color=LINK, linewidth=5.0, zorder=2, **caps)
    axes.plot(*points[0], marker="s", markersize=11, color=INK, zorder=2.5)
    edge: dict[str, Any] = {"color": "white", "markeredgecolor": INK, "markeredgewidth": 1.4, "zorder": 3}
    for slides, marker, size in ((False, "o", 8.0), (True, "s", 7.5)):
        some = points[1:-1][arm.slides == slides]
        axes.plot(some[:, 0], some[:, 1], marker, markersize=size, **edge)
    axes.plot(*points[-1], marker="o", markersize=5.0, color=INK, zorder=5)


def _write_legend(
    figure: Figure, place: tuple[float, float], quantities: Sequence[Quantity], translation: Ellipsoids | None
) -> None:
    left, top = place
    line, swatch = LINE / figure.get_figheight(), 0.36 / figure.get_figwidth()
    if translation is None or not quantities:
        write(figure, left, top, ["The tip has no translation here."], color=QUIET)
        return
    sigmas, d = translation.sigmas[0], translation.space.dimension
    for quantity in quantities:
        ends = ", ".join("unbounded" if np.isinf(size) else f"{size:.{_DIGITS[d]}g}" for size in quantity.sizes)
        across, up = [left, left + swatch], [top - line / 2.0] * 2
        figure.add_artist(Line2D(across, up, color=quantity.color, linewidth=1.6, linestyle=quantity.dashes))
        name = f"{quantity.name} {_SHAPES[d]}"
        lines = [f"{name}, semi-axes {ends}", f"1 {quantity.unit} is drawn as {quantity.scale:g} m"]
        write(figure, left + 1.35 * swatch, top, lines)
        top -= 2.35 * line
    isotropy = sigmas[-1] / sigmas[0] if sigmas[0] > 0.0 else 0.0
    lines = [
        f"Yoshikawa's measure {translation.measures[0]:.4g}, isotropy {isotropy:.3g}",
        f"Rank {translation.ranks[0]} of {d}",
    ]
    write(figure, left + 1.35 * swatch, top, lines)
