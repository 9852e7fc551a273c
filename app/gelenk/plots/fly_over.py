"""Picture of a corner passed without a stop: the path, and distance, speed and acceleration over time."""

from typing import Any

import numpy as np
from matplotlib.axes import Axes

from gelenk.course.motion.fly_over import Blend
from gelenk.language import translated as _
from gelenk.plots import figure as style
from gelenk.plots.profiles import curve, time_axes
from gelenk.robot.arrays import Array
from gelenk.trajectory.motion.polynomial import PiecewisePolynomial

_POINTS = 200
_MARGIN = 0.12
_LEAST = 0.25
"""Least ratio of the shorter to the longer side of the path's picture, because a straight path is flat."""


def fly_over_picture(blend: Blend, motion: PiecewisePolynomial | None, kind: style.PictureFormat) -> bytes:
    """Draw a fly-over; `motion` is the whole one, or that of the blend, in [m], or None if it takes no time."""
    figure = style.new_figure(6.4, 9.4)
    title = _("Fly-over in {time:.4g} s: d₁ = {before:.4g} m, d₂ = {after:.4g} m")
    title = title.format(time=blend.time, before=blend.distance_before, after=blend.distance_after)
    style.write(figure, 0.06, 0.985, [title], size=style.TITLE)
    _draw_way(figure.add_axes((0.13, 0.53, 0.83, 0.41)), blend)
    labels = r"$\sigma$ / m", _("speed / (m/s)"), _("acceleration / (m/s²)")
    for order, (label, color) in enumerate(zip(labels, (style.INK, style.VELOCITY, style.FORCE), strict=True)):
        part = figure.add_axes((0.13, 0.36 - 0.15 * order, 0.83, 0.11))
        time_axes(part, label, is_last=order == 2)
        if motion is not None:
            part.plot(*_magnitudes(motion, order), color=color, linewidth=1.5)
            part.set_xlim(motion.breaks[0], motion.breaks[-1])
            part.set_ylim(bottom=0.0)
    return style.as_bytes(figure, kind)


def _magnitudes(motion: PiecewisePolynomial, order: int) -> tuple[Array, Array]:
    """Return times and, there, the distance σ covered along the path (order 0), or the size of a derivative."""
    times, values = curve(motion.derivative(max(order, 1)))
    sizes = np.linalg.norm(values, axis=1)
    if order > 0:
        return times, sizes
    return times, np.concatenate(([0.0], np.cumsum(0.5 * (sizes[1:] + sizes[:-1]) * np.diff(times))))


def _draw_way(axes: Axes, blend: Blend) -> None:
    corner = blend.corner
    plane = _plane(blend)
    A, B, C, entry, exit_ = (
        plane(point[None])[0] for point in (corner.start, corner.corner, corner.end, blend.entry, blend.exit)
    )
    is_flat = len(corner.start) == 2
    style.metric_axes(axes, "x / m" if is_flat else _("along AB / m"), "y / m" if is_flat else _("across / m"))
    legs = np.array([A, B, C])
    axes.plot(*legs.T, color=style.LINK, linewidth=1.2, linestyle=(0.0, (4.0, 3.0)))
    times = np.linspace(0.0, blend.time, _POINTS)
    parabola = plane(times[:, None] ** np.arange(3) @ blend.coefficients)
    solid: dict[str, Any] = {"color": style.VELOCITY, "linewidth": 2.0, "solid_capstyle": "round"}
    axes.plot(*np.concatenate((A[None], parabola, C[None])).T, **solid)
    for name, point in (("A", A), ("B", B), ("C", C), ("A'", entry), ("C'", exit_)):
        is_end = name in {"A'", "C'"}
        axes.plot(
            *point, "o", markersize=5.0, color="white" if is_end else style.INK, markeredgecolor=style.INK, zorder=4
        )
        # If the path turns back, the two ends of the blend coincide, and A and C may.
        is_below = name == "C'" or (name == "C" and corner.turn == "reversal")
        offset = (6.0, -14.0) if is_below else (6.0, 6.0)
        axes.annotate(name, point, offset, textcoords="offset points", fontproperties=style.font(), color=style.INK)
    _frame(axes, np.concatenate((legs, parabola)))


def _plane(blend: Blend) -> Any:
    """Return the map of points to the corner's plane: the identity in two dimensions, else origin B and x along AB."""
    corner = blend.corner
    if len(corner.start) == 2:
        return lambda points: points
    along = corner.direction_before
    across = corner.direction_after - (corner.direction_after @ along) * along
    length = np.linalg.norm(across)
    across = across / length if length > 1e-9 else np.zeros_like(across)
    return lambda points: (points - corner.corner) @ np.column_stack((along, across))


def _frame(axes: Axes, points: Array) -> None:
    low, high = points.min(axis=0), points.max(axis=0)
    size = float((high - low).max())
    half = np.maximum(0.5 * (high - low), 0.5 * _LEAST * size) + _MARGIN * size
    style.look_at(axes, 0.5 * (low + high), half)
