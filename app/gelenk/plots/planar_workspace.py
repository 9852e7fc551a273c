"""Picture of the two workspaces of a planar arm: rings around its base, and the arm with its tip at a point."""

from collections.abc import Sequence
from typing import Any

import numpy as np
from matplotlib.axes import Axes
from matplotlib.figure import Figure
from matplotlib.patches import Annulus, Circle, Patch, Rectangle

from gelenk.course.planar import Interval, PlanarWorkspace, orientations, posture, share
from gelenk.language import number_list, translated as _
from gelenk.plots import figure as style

_PRIMARY, _SECONDARY = style.VELOCITY, style.FORCE
_MARGIN = 1.08
_LINE = 1e-9
"""Width up to which a ring is drawn as a circle, as a fraction of its radius."""
_SMALLEST = 1e-6
"""Least half width of the pictured area without its margin, [m]."""


def planar_workspace_picture(arm: PlanarWorkspace, point: Sequence[float] | None, kind: style.PictureFormat) -> bytes:
    """Draw both workspaces of an arm, and the arm with its tip at a point (x, y), [m], if it can reach it."""
    figure = style.new_figure(6.4, 7.6)
    axes = figure.add_axes((0.13, 0.19, 0.83, 0.73))
    style.metric_axes(axes, "x / m", "y / m")
    half = _MARGIN * max(sum(arm.links), _SMALLEST, *(abs(value) for value in point or ()))
    style.look_at(axes, np.zeros(2), np.full(2, half))
    _draw_rings(axes, arm.primary, _PRIMARY, 0.12, 2.0)
    _draw_rings(axes, arm.secondary, _SECONDARY, 0.28, 2.1)
    axes.plot(0.0, 0.0, marker="s", markersize=11, color=style.INK, zorder=3.5)
    if point is not None:
        _draw_arm(axes, arm, point)
    lengths = number_list(arm.links, ".4g")
    style.write(
        figure, 0.06, 0.975, [_("Planar arm with links of {lengths} m").format(lengths=lengths)], size=style.TITLE
    )
    _write_legend(figure, arm, point)
    return style.as_bytes(figure, kind)


def _draw_rings(axes: Axes, rings: Sequence[Interval], color: str, strength: float, order: float) -> None:
    """Draw each ring as a ring, a disc, a circle or a point, depending on its radii."""
    for inner, outer in rings:
        look: dict[str, Any] = {"facecolor": (color, strength), "edgecolor": color, "linewidth": 1.4, "zorder": order}
        if outer == 0.0:
            axes.plot(0.0, 0.0, marker="o", markersize=16, markeredgecolor=color, color="white", zorder=order)
        elif inner == 0.0:
            axes.add_patch(Circle((0.0, 0.0), outer, **look))
        elif outer - inner <= _LINE * outer:
            axes.add_patch(Circle((0.0, 0.0), outer, **{**look, "fill": False}))
        else:
            axes.add_patch(Annulus((0.0, 0.0), outer, outer - inner, **look))


def _draw_arm(axes: Axes, arm: PlanarWorkspace, point: Sequence[float]) -> None:
    """Draw the arm in the middle of its first range of orientations at the point; without one, only the point."""
    found = orientations(arm, *point)
    if found:
        points = posture(arm, point[0], point[1], float(np.mean(found[0])))
        caps: dict[str, Any] = {"solid_capstyle": "round", "solid_joinstyle": "round"}
        axes.plot(points[:, 0], points[:, 1], color=style.LINK, linewidth=5.0, zorder=3, **caps)
        edge: dict[str, Any] = {"color": "white", "markeredgecolor": style.INK, "markeredgewidth": 1.4}
        axes.plot(points[1:-1, 0], points[1:-1, 1], "o", markersize=8.0, zorder=4, **edge)
    axes.plot(*point, marker="o", markersize=5.0, color=style.INK, zorder=5)


def _write_legend(figure: Figure, arm: PlanarWorkspace, point: Sequence[float] | None) -> None:
    line, left, top = style.LINE / figure.get_figheight(), 0.13, 0.115
    swatch = 0.3 / figure.get_figwidth()
    for name, rings, color, strength in (
        (_("WS₁, at least one orientation"), arm.primary, _PRIMARY, 0.12),
        (_("WS₂, all orientations"), arm.secondary, _SECONDARY, 0.28),
    ):
        patch: Patch = Rectangle((left, top - 0.75 * line), swatch, 0.6 * line, facecolor=(color, strength))
        patch.set(edgecolor=color, linewidth=1.2, transform=figure.transFigure)
        figure.add_artist(patch)
        where = _(" and ").join(map(_words, rings)) or _("nowhere")
        style.write(figure, left + 1.4 * swatch, top, [f"{name}: {where}"])
        top -= 1.15 * line
    if point is not None:
        text = _("At ({x:.4g}, {y:.4g}) m: {reached}").format(x=point[0], y=point[1], reached=_reached(arm, point))
        style.write(figure, left + 1.4 * swatch, top, [text])


def _reached(arm: PlanarWorkspace, point: Sequence[float]) -> str:
    found = orientations(arm, *point)
    if part := share(found):
        return _("{percent:.4g} % of all orientations").format(percent=100.0 * part)
    words = {0: _("not reached"), 1: _("one orientation")}
    return words.get(len(found), _("{count} orientations")).format(count=len(found))


def _words(ring: Interval) -> str:
    inner, outer = ring
    if outer == 0.0:
        return _("the base alone")
    text = _("a circle at {outer:.4g} m" if outer - inner <= _LINE * outer else "{inner:.4g} to {outer:.4g} m")
    return text.format(inner=inner, outer=outer)
