"""Picture of an arm's postures along a motion, each with the velocity ellipse at its tip."""

from typing import Any

import numpy as np

from gelenk.kinematics.ellipsoids.manipulability import Ellipsoids
from gelenk.language import number, translated as _
from gelenk.plots import figure as style
from gelenk.plots.arm import arm_line
from gelenk.plots.ellipsoids import drawn_scale, plane_of
from gelenk.plots.shadows import SOLID, Quantity, draw_quantity
from gelenk.robot.arrays import Array
from gelenk.robot.chain import Chain

_MOST = 12
"""Largest number of postures that are drawn; of more, as many spread evenly."""
_MARGIN = 0.08
_SMALLER = 0.5
"""Size of the largest ellipse, as a fraction of that in the picture of one configuration."""


def postures_picture(name: str, chain: Chain, qs: Array, translation: Ellipsoids, kind: style.PictureFormat) -> bytes:
    """Draw the arm at several configurations, (N, n), at least one, on one scale, and the way of its tip.

    An arm in space is projected along the axis of the base in which it extends least; so are its ellipsoids.
    """
    points = np.array([arm_line(chain, q)[0] for q in qs])
    plane = plane_of(chain, translation)
    if plane is None:
        plane = np.delete(np.eye(3), np.ptp(points.reshape(-1, 3), axis=0).argmin(), axis=0)
    lines = points @ plane.T
    extent = max(float(np.ptp(lines.reshape(-1, 2), axis=0).max()), 1e-3)
    scale = drawn_scale(translation.sigmas.ravel(), _SMALLER * extent)
    figure = style.new_figure(6.4, 6.9)
    axes = figure.add_axes((0.13, 0.15, 0.83, 0.77))
    style.metric_axes(axes, f"{style.axis_name(plane[0], 1)} / m", f"{style.axis_name(plane[1], 2)} / m")
    caps: dict[str, Any] = {"solid_capstyle": "round", "solid_joinstyle": "round"}
    tips, halves = lines[:, -1], [np.zeros(2)]
    axes.plot(*tips.T, color=style.FORCE, linewidth=1.4, zorder=4.5)
    for i in np.unique(np.linspace(0, len(qs) - 1, min(len(qs), _MOST)).round().astype(int)).tolist():
        axes.plot(*lines[i].T, color=style.LINK, linewidth=2.4, alpha=0.7, zorder=2, **caps)
        axes.plot(*lines[i][1:-1].T, "o", markersize=5.0, color="white", markeredgecolor=style.LINK, zorder=3)
        vectors = translation.space.spread(translation.axes[i].T).T
        ellipse = Quantity("Velocity", "", style.VELOCITY, SOLID, vectors, translation.sigmas[i], scale)
        draw_quantity(axes, plane, tips[i], ellipse, extent)
        axes.plot(*tips[i], marker="o", markersize=4.0, color=style.INK, zorder=6)
        halves.append(np.abs(plane) @ ellipse.halves)
    axes.plot(*lines[0][0], marker="s", markersize=10, color=style.INK, zorder=3.5)
    _look(axes, lines.reshape(-1, 2), np.max(halves, axis=0))
    title = _("{name}: {count} configurations").format(name=style.plain(name), count=len(qs))
    style.write(figure, 0.06, 0.975, [title], size=style.TITLE)
    measures = translation.measures
    numbers = {"scale": number(scale, "g"), "least": number(measures.min()), "most": number(measures.max())}
    scales = _("Velocity ellipses at the tip; a semi-axis of 1 is drawn as {scale} m").format(**numbers)
    range_of_measure = _("Yoshikawa's measure: {least} to {most}").format(**numbers)
    style.write(figure, 0.13, 0.07, [scales, range_of_measure])
    return style.as_bytes(figure, kind)


def _look(axes: Any, points: Array, room: Array) -> None:
    low, high = points.min(axis=0) - room, points.max(axis=0) + room
    style.look_at(axes, 0.5 * (low + high), np.full(2, (0.5 + _MARGIN) * float((high - low).max())))
