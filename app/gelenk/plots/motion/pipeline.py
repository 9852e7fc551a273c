"""Picture of a planar arm along a line: postures with velocity ellipses, the tip's path, joints and deviation."""

from typing import Any

import numpy as np
from matplotlib.axes import Axes
from matplotlib.patches import Ellipse

from gelenk.course.cartesian.pipeline import Pipeline
from gelenk.language import translated as _
from gelenk.plots import figure as style
from gelenk.robot.arrays import Array

_POINTS = 600
_MOST_POSTURES = 9
_LARGEST = 0.16
"""Longest semi-axis of an ellipse as drawn, as a fraction of the arm's length."""
_MARGIN = 0.12


def pipeline_picture(found: Pipeline, kind: style.PictureFormat) -> bytes:
    """Draw what was planned; without a spline the samples that are reached, alone."""
    width = 5.2 if found.spline is None else 9.0
    figure = style.new_figure(width, 5.2)
    axes = figure.add_axes((0.63 / width, 0.1, 4.5 / width, 0.78))
    style.metric_axes(axes, "x / m", "y / m")
    is_reached = ~np.isnan(found.configurations[:, 0])
    rows = np.flatnonzero(is_reached)
    chosen = rows[np.unique(np.linspace(0, len(rows) - 1, min(len(rows), _MOST_POSTURES)).round().astype(int))]
    _draw_postures(axes, found, found.configurations[chosen])
    _draw_path(axes, found)
    if found.spline is not None:
        title = _("N = {count}, along {length:.4g} m: at most {off:.4g} m off the line")
        _draw_profiles(figure, found)
    else:
        title = _("N = {count}, along {length:.4g} m: {missing} out of reach")
    off = 0.0 if found.spline is None else abs(found.largest_deviation().value)
    count, missing = len(found.times), int((~is_reached).sum())
    title = title.format(count=count, length=found.line.length, off=off, missing=missing)
    style.write(figure, 0.04, 0.975, [title], size=style.TITLE)
    return style.as_bytes(figure, kind)


def _draw_postures(axes: Axes, found: Pipeline, qs: Array) -> None:
    l1, l2 = found.line.lengths
    jacobians = [_jacobian(l1, l2, q) for q in qs]
    scale = _LARGEST * (l1 + l2) / max((float(np.linalg.norm(J, 2)) for J in jacobians), default=1.0)
    caps: dict[str, Any] = {"solid_capstyle": "round", "solid_joinstyle": "round"}
    everything = [np.zeros(2)]
    for q, J in zip(qs, jacobians, strict=True):
        elbow = l1 * np.array([np.cos(q[0]), np.sin(q[0])])
        tip = elbow + l2 * np.array([np.cos(q.sum()), np.sin(q.sum())])
        axes.plot(*np.array([np.zeros(2), elbow, tip]).T, color=style.LINK, linewidth=2.4, alpha=0.7, zorder=2, **caps)
        axes.plot(*elbow, "o", markersize=5.0, color="white", markeredgecolor=style.LINK, zorder=2.5)
        U, sigma = np.linalg.svd(J)[:2]
        angle = np.degrees(np.arctan2(U[1, 0], U[0, 0]))
        look: dict[str, Any] = {"facecolor": (style.VELOCITY, 0.12), "edgecolor": style.VELOCITY, "linewidth": 1.0}
        axes.add_patch(Ellipse((tip[0], tip[1]), *(2.0 * scale * sigma), angle=float(angle), zorder=3, **look))
        reach = scale * np.hypot(*(U * sigma).T)
        everything += [elbow, tip - reach, tip + reach]
    axes.plot(0.0, 0.0, marker="s", markersize=9, color=style.INK, zorder=3)
    points = np.array([*everything, *([p.real, p.imag] for p in (found.line.start, found.line.target))])
    low, high = points.min(axis=0), points.max(axis=0)
    style.look_at(axes, 0.5 * (low + high), np.full(2, (0.5 + 0.5 * _MARGIN) * float((high - low).max())))


def _jacobian(l1: float, l2: float, q: Array) -> Array:
    (s1, s12), (c1, c12) = np.sin(np.cumsum(q)), np.cos(np.cumsum(q))
    return np.array([[-l1 * s1 - l2 * s12, -l2 * s12], [l1 * c1 + l2 * c12, l2 * c12]])


def _draw_path(axes: Axes, found: Pipeline) -> None:
    line = found.line
    ends = np.array([line.start, line.target])
    axes.plot(ends.real, ends.imag, color=style.INK, linewidth=1.2, linestyle=(0.0, (4.0, 3.0)), zorder=4)
    if found.spline is not None:
        q = found.motion.at(np.linspace(0.0, found.times[-1], _POINTS))
        tip = line.lengths[0] * np.exp(1j * q[:, 0]) + line.lengths[1] * np.exp(1j * q.sum(axis=1))
        axes.plot(tip.real, tip.imag, color=style.FORCE, linewidth=1.8, zorder=5)
    points = line.points(found.shares)
    missing = np.isnan(found.configurations[:, 0])
    edge: dict[str, Any] = {"markeredgecolor": style.INK, "zorder": 6}
    axes.plot(points[~missing].real, points[~missing].imag, "o", markersize=4.5, color="white", **edge)
    axes.plot(points[missing].real, points[missing].imag, "x", markersize=6.0, **edge)


def _draw_profiles(figure: Any, found: Pipeline) -> None:
    times = np.linspace(0.0, found.times[-1], _POINTS)
    q = found.motion.at(times)
    rows = (("q₁ / rad", q[:, 0], style.VELOCITY), ("q₂ / rad", q[:, 1], style.VELOCITY))
    for k, (label, values, color) in enumerate(
        (*rows, (_("off the line / mm"), 1e3 * found.deviations(q), style.FORCE))
    ):
        axes = figure.add_axes((0.67, 0.64 - 0.27 * k, 0.31, 0.24))
        style.light_axes(axes, "t / s" if k == 2 else None, label, size=8.0)
        axes.yaxis.set_label_coords(-0.16, 0.5)
        axes.plot(times, values, color=color, linewidth=1.5, zorder=3)
        knots = found.configurations[:, k] if k < 2 else np.zeros(len(found.times))
        edge: dict[str, Any] = {"markeredgecolor": style.INK, "zorder": 4, "clip_on": False}
        axes.plot(found.times, knots, "o", markersize=4.0, color="white", **edge)
        axes.set_xlim(0.0, times[-1])
