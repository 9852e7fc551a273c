"""Picture of triangles with the names of their corners, sides and angles, and the numbers below."""

import math

import numpy as np
from matplotlib.axes import Axes
from matplotlib.patches import Arc, Polygon

from gelenk.course.triangle.triangle import ANGLES, SIDES, SolvedTriangle, Triangle
from gelenk.language import number, separator
from gelenk.plots import figure as style
from gelenk.robot.arrays import Array

_SIGNS = ("α", "β", "γ")
_WIDTH, _HEIGHT = 4.4, 4.2
"""Of one triangle, [inch]."""
_LEAST_ANGLE = 0.12
"""Angle below which its arc is too narrow to be seen, [rad]."""
_MARGIN = 0.16
_ROOM = 0.06
"""Distance of two sides beside the sign of their angle, relative to the picture."""


def triangle_picture(found: SolvedTriangle, kind: style.PictureFormat) -> bytes:
    """Draw one or two triangles side by side, at the same scale."""
    count = len(found.triangles)
    figure = style.new_figure(_WIDTH * count, _HEIGHT)
    size = max(float(np.ptp(triangle.corners, axis=0).max()) for triangle in found.triangles)
    for k, triangle in enumerate(found.triangles):
        axes = figure.add_axes(((k + 0.04) / count, 0.24, 0.92 / count, 0.72))
        axes.set_axis_off()
        axes.set_aspect("equal", adjustable="box")
        _draw(axes, triangle, found.given, size)
        sides = separator().join(f"{name} = {number(side)} m" for name, side in zip(SIDES, triangle.sides, strict=True))
        degrees = (math.degrees(angle) for angle in triangle.angles)
        angles = separator().join(f"{sign} = {number(angle)}°" for sign, angle in zip(_SIGNS, degrees, strict=True))
        style.write(figure, (k + 0.08) / count, 0.19, [sides, angles])
    return style.as_bytes(figure, kind)


def _draw(axes: Axes, triangle: Triangle, given: frozenset[str], size: float) -> None:
    corners, middle = triangle.corners, triangle.corners.mean(axis=0)
    axes.add_patch(Polygon(corners, facecolor=(style.LINK, 0.18), edgecolor="none"))
    for i, name in enumerate(SIDES):
        ends = corners[[(i + 1) % 3, (i + 2) % 3]]
        color = style.VELOCITY if name in given else style.INK
        axes.plot(*ends.T, color=color, linewidth=2.0, solid_capstyle="round")
        _label(axes, ends.mean(axis=0), _outward(ends, middle), name, color, 12.0)
    for i, name in enumerate("ABC"):
        away = corners[i] - middle
        if triangle.is_flat and triangle.angles[i] > 0.0:
            away = np.array([0.0, -1.0])
        _label(axes, corners[i], away / max(1e-12, float(np.hypot(*away))), name, style.INK, 12.0)
        _draw_angle(axes, triangle, i, style.VELOCITY if ANGLES[i] in given else style.QUIET, size)
    half = np.full(2, (0.5 + _MARGIN) * size)
    style.look_at(axes, 0.5 * (corners.min(axis=0) + corners.max(axis=0)), half)


def _outward(ends: Array, middle: Array) -> Array:
    """Return the unit normal of a side that points away from the middle of the triangle."""
    along = ends[1] - ends[0]
    normal = np.array([-along[1], along[0]]) / max(1e-12, float(np.hypot(*along)))
    return normal if normal @ (ends[0] - middle) >= 0.0 else -normal


def _label(axes: Axes, point: Array, direction: Array, text: str, color: str, distance: float) -> None:
    offset = (distance * direction[0], distance * direction[1])
    axes.annotate(text, (point[0], point[1]), offset, textcoords="offset points", ha="center", va="center",
                  fontproperties=style.font(style.TITLE), color=color)  # fmt: skip


def _draw_angle(axes: Axes, triangle: Triangle, i: int, color: str, size: float) -> None:
    """Draw the arc of an angle with its sign on the bisector, where there is room for it."""
    angle, corners = triangle.angles[i], triangle.corners
    shorter = min(side for j, side in enumerate(triangle.sides) if j != i)
    height = 2.0 * triangle.area / triangle.sides[i]
    radius = min(0.16 * size, 0.28 * shorter, 0.7 * height)
    if not _LEAST_ANGLE < angle < math.pi - _LEAST_ANGLE:
        return
    u, v = (corners[j % 3] - corners[i] for j in (i + 1, i + 2))
    start = math.degrees(math.atan2(u[1], u[0]))
    axes.add_patch(Arc(corners[i], 2.0 * radius, 2.0 * radius, angle=start, theta1=0.0, theta2=math.degrees(angle),
                       color=color, linewidth=1.2))  # fmt: skip
    # The sign stands within a wide angle's arc, and beyond a narrow one's, where the sides are further apart.
    reach = 0.6 if angle > 0.9 else 1.45
    bisector = u / np.hypot(*u) + v / np.hypot(*v)
    bisector /= max(1e-12, float(np.hypot(*bisector)))
    if 2.0 * reach * radius * math.tan(0.5 * min(angle, 1.5)) < _ROOM * size:
        return
    x, y = corners[i] + reach * radius * bisector
    axes.text(x, y, _SIGNS[i], ha="center", va="center",
              fontproperties=style.font(), color=color)  # fmt: skip
