"""Picture of a DH table: its frames with their common normals, offsets and angles, and the table itself below.

Everything about an x axis (a, α) has one colour, everything about a z axis (d, ϑ) the other. The direction of view is
the one, among a few, in which names cover least and no axis points at the reader.
"""

import math
from collections.abc import Iterator, Sequence
from itertools import pairwise
from typing import Any

import numpy as np
from matplotlib.axes import Axes
from matplotlib.figure import Figure
from matplotlib.patches import FancyArrowPatch, Polygon
from matplotlib.patheffects import withStroke

from gelenk.language import number, number_list, separator, translated as _
from gelenk.plots import figure as style
from gelenk.plots.dh_scene import DhScene, DrawnJoint, Kind, Stroke, dh_scene
from gelenk.plots.labels import Wanted, placed
from gelenk.robot.arrays import Array
from gelenk.robot.dh import DhTable

_WIDTH, _HEIGHT, _HEAD = 7.2, 5.6, 0.75
"""Width of the picture, height of the frames, height of the title; [inch]."""
_VIEWS = [(azimuth, elevation) for elevation in (22.0, 32.0) for azimuth in (-60.0, -42.0, -22.0, 35.0, 55.0)]
_SIZE = 10.5
_COLOR: dict[Kind, str] = {
    "x": style.FORCE, "a": style.FORCE, "alpha": style.FORCE,
    "z": style.VELOCITY, "d": style.VELOCITY, "theta": style.VELOCITY,
    "link": style.RULE, "help": style.QUIET, "axis": style.LINK,
}  # fmt: skip
_LINES: dict[Kind, dict[str, Any]] = {
    "link": {"linewidth": 8.0, "solid_capstyle": "round", "zorder": 1.0},
    "axis": {"linewidth": 0.8, "linestyle": (0.0, (9.0, 3.0, 1.5, 3.0)), "zorder": 1.2},
    "help": {"linewidth": 0.9, "linestyle": (0.0, (3.0, 2.5)), "zorder": 2.0},
    "a": {"linewidth": 2.0, "zorder": 2.2},
    "d": {"linewidth": 2.0, "zorder": 2.2},
}
_EVERY = 2.5
"""Distance of the points by which lines keep names away, [pt]."""
_FORESHORTENED = 0.5
_ALIKE = 0.3
_POOR = 60.0
"""An arrow that appears shorter than this part of its length makes a view worse, and so do two whose angle appears to
have a smaller sine than this; the cost of the worst such arrow."""
_ARROWS = ("x", "z", "help")
_RADIUS, _LENGTH = 0.13, 0.36
"""Size of a joint, in lengths of an arrow."""


def dh_picture(table: DhTable, q: Sequence[float], kind: style.PictureFormat) -> bytes:
    """Draw the frames of a table at a configuration, [rad or m], and the table below them."""
    figure = style.new_figure(_WIDTH, _HEAD + _HEIGHT + _table_height(table))
    _draw_frames(figure, _table_height(table), table, q)
    _write_head(figure, table, q)
    _write_table(figure, table)
    return style.as_bytes(figure, kind)


def frames_figure(table: DhTable, q: Sequence[float]) -> Figure:
    """Draw the frames of a table at a configuration, [rad or m], alone."""
    figure = style.new_figure(_WIDTH, _HEIGHT)
    _draw_frames(figure, 0.0, table, q)
    return figure


def _draw_frames(figure: Figure, below: float, table: DhTable, q: Sequence[float]) -> None:
    """Draw the frames, with room below them, [inch]."""
    scene, height = dh_scene(table, q), figure.get_figheight()
    axes = figure.add_axes((0.02, below / height, 0.96, _HEIGHT / height))
    axes.set_axis_off()
    views = [_View(scene, *angles) for angles in (_VIEWS if len(table.joints) <= 8 else _VIEWS[:2])]
    _draw(axes, scene, min(views, key=lambda view: view.cost))


class _View:
    """The scene from a direction of view, [deg]; coordinates in points of the page."""

    def __init__(self, scene: DhScene, azimuth: float, elevation: float) -> None:
        az, el = math.radians(azimuth), math.radians(elevation)
        c, s = math.cos(az), math.sin(az)
        right, up = np.array([-s, c, 0.0]), np.array([-math.sin(el) * c, -math.sin(el) * s, math.cos(el)])
        self.toward = np.array([math.cos(el) * c, math.cos(el) * s, math.sin(el)])
        plane = np.array([right, up])
        flat = np.concatenate([stroke.points for stroke in scene.strokes]) @ plane.T
        low, high = flat.min(axis=0), flat.max(axis=0)
        room = np.array([0.96 * _WIDTH, _HEIGHT]) * 72.0
        self.scale = float(((room - 60.0) / np.maximum(high - low, 1e-9 * scene.arrow)).min())
        self._plane, self._middle, self._center = plane, 0.5 * (low + high), 0.5 * room
        self.names, self.cost = self._names(scene)
        self.cost += self._flatness(np.array([one.points for one in scene.strokes if one.kind in _ARROWS]))

    def _flatness(self, arrows: Array) -> float:
        """Return the cost of arrows (m, 2, 3) that point at the reader, or that look like one at a common origin."""
        spans = arrows[:, 1] - arrows[:, 0]
        size = float(np.linalg.norm(spans[0]))
        seen = spans @ self._plane.T
        lengths = np.linalg.norm(seen, axis=1)
        units = seen / np.maximum(lengths, 1e-9 * size)[:, None]
        apart = np.abs(units[:, None, 0] * units[None, :, 1] - units[:, None, 1] * units[None, :, 0])
        differ = np.linalg.norm(np.cross(spans[:, None], spans[None]), axis=2) > 0.3 * size**2
        meet = np.linalg.norm(arrows[:, None, 0] - arrows[None, :, 0], axis=2) < 0.2 * size
        alike = np.clip(1.0 - apart / _ALIKE, 0.0, 1.0)[differ & meet]
        return float(_POOR * (alike.sum() + np.clip(1.0 - lengths / (_FORESHORTENED * size), 0.0, 1.0).sum()))

    def flat(self, points: Array) -> Array:
        """Return points (m, 3) on the page, (m, 2)."""
        on_page: Array = (points @ self._plane.T - self._middle) * self.scale + self._center
        return on_page

    def ends(self, body: DrawnJoint, arrow: float) -> list[Array]:
        """Return the two ends of a joint on the page, the nearer one last."""
        turns = np.arange(4) * 0.5 * math.pi + 0.25 * math.pi if body.slides else np.linspace(0.0, 2.0 * math.pi, 40)
        ring = _RADIUS * arrow * np.column_stack((np.cos(turns), np.sin(turns), np.zeros(len(turns))))
        half = np.array([0.0, 0.0, 0.5 * _LENGTH * arrow])
        signs = (1.0, -1.0) if body.T[:3, 2] @ self.toward < 0.0 else (-1.0, 1.0)
        return [self.flat((ring + sign * half) @ body.T[:3, :3].T + body.T[:3, 3]) for sign in signs]

    def _names(self, scene: DhScene) -> tuple[list[Array], float]:
        lines = [self.flat(stroke.points) for stroke in scene.strokes]
        lines += [end for body in scene.bodies for end in self.ends(body, scene.arrow)]
        obstacles = np.concatenate([_dense(points) for points in lines])
        order = {"a": 0, "d": 0, "theta": 1, "alpha": 1, "x": 2, "z": 2}
        ranks = sorted(range(len(scene.names)), key=lambda i: order[scene.names[i].kind])
        wanted = [Wanted(_size(scene.names[i].text), self.flat(scene.names[i].places)) for i in ranks]
        found, cost = placed(wanted, obstacles)
        return [center for _, center in sorted(zip(ranks, found, strict=True), key=lambda pair: pair[0])], cost


def _dense(points: Array) -> Array:
    """Return points of a line so near to each other that no name fits between them."""
    pieces = [points[-1:]]
    for start, end in pairwise(points):
        count = max(1, int(np.linalg.norm(end - start) / _EVERY))
        pieces.append(start + np.linspace(0.0, 1.0, count, endpoint=False)[:, None] * (end - start))
    return np.concatenate(pieces)


def _size(text: str) -> Array:
    """Return the size of a name such as $x_{1}$, or of several, [pt]."""
    parts = text.count("_")
    digits = sum(character.isdigit() or character in "BE" for character in text)
    return np.array([parts * 0.62 + digits * 0.45 + (parts - 1) * 0.5, 1.25]) * _SIZE


def _draw(axes: Axes, scene: DhScene, view: _View) -> None:
    axes.set_xlim(0.0, 0.96 * _WIDTH * 72.0)
    axes.set_ylim(0.0, _HEIGHT * 72.0)
    for stroke in scene.strokes:
        _draw_stroke(axes, stroke, view.flat(stroke.points))
    for body in sorted(scene.bodies, key=lambda body: float(view.toward @ body.T[:3, 3])):
        _draw_body(axes, view.ends(body, scene.arrow))
    halo = [withStroke(linewidth=2.5, foreground="white")]
    for name, center in zip(scene.names, view.names, strict=True):
        look: dict[str, Any] = {"ha": "center", "va": "center", "path_effects": halo, "zorder": 6.0}
        x, y = center.tolist()
        axes.text(x, y, name.text, color=_COLOR[name.kind], fontproperties=style.font(_SIZE), **look)


def _draw_stroke(axes: Axes, stroke: Stroke, points: Array) -> None:
    color = _COLOR[stroke.kind]
    if stroke.kind in _LINES:
        axes.plot(*points.T, color=color, **_LINES[stroke.kind])
        return
    is_arc = stroke.kind in ("theta", "alpha")
    if is_arc:
        axes.plot(*points.T, color=color, linewidth=1.1, zorder=3.0)
    head: dict[str, Any] = {"arrowstyle": "-|>", "color": color, "shrinkA": 0.0, "shrinkB": 0.0}
    width, size = (0.0, 7.0) if is_arc else (1.5, 10.0)
    start, end = (points[-4], points[-1]) if is_arc else points
    axes.add_patch(FancyArrowPatch(start, end, linewidth=width, mutation_scale=size, zorder=4.0, **head))


def _draw_body(axes: Axes, ends: Sequence[Array]) -> None:
    """Draw a joint: a cylinder about its axis, or a box along it where it slides; the nearer end is lighter."""
    look: dict[str, Any] = {"edgecolor": style.INK, "linewidth": 0.8, "alpha": 0.92}
    for outline, color in ((_hull(np.concatenate(ends)), "#c9d1d8"), (ends[1], "#eef1f4")):
        axes.add_patch(Polygon(outline, closed=True, facecolor=color, zorder=2.6, **look))


def _hull(points: Array) -> Array:
    """Return the convex hull of points (m, 2), in order."""
    rows = sorted({(round(x, 6), round(y, 6)) for x, y in points.tolist()})

    def half(ordered: Sequence[tuple[float, float]]) -> list[tuple[float, float]]:
        found: list[tuple[float, float]] = []
        for x, y in ordered:
            while len(found) > 1:
                (ax, ay), (bx, by) = found[-2:]
                if (bx - ax) * (y - ay) - (by - ay) * (x - ax) > 0.0:
                    break
                found.pop()
            found.append((x, y))
        return found[:-1]

    return np.array([*half(rows), *half(rows[::-1])])


# Words


def _write_head(figure: Figure, table: DhTable, q: Sequence[float]) -> None:
    height = figure.get_figheight()
    titles = {
        "standard": _("Denavit-Hartenberg frames, standard convention"),
        "modified": _("Denavit-Hartenberg frames, modified convention"),
    }
    style.write(figure, 0.06, 1.0 - 0.19 / height, [titles[table.convention]], size=style.TITLE)
    shown = number_list(q[:12], ".4g") + (separator() + "…") * (len(q) > 12)
    style.write(figure, 0.06, 1.0 - 0.46 / height, [f"q = ({shown})"], color=style.QUIET)


def _table_height(table: DhTable) -> float:
    return (len(table.joints) + 1) * style.LINE + 0.35


def _write_table(figure: Figure, table: DhTable) -> None:
    """Write the rows below the picture: angles in degrees, and the variable where there is one."""
    height = figure.get_figheight()
    top = _table_height(table) - 0.1
    link = "i" if table.convention == "standard" else "i-1"
    heads = ("$i$", rf"$a_{{{link}}}$ / m", rf"$\alpha_{{{link}}}$ / °", "$d_i$ / m", r"$\vartheta_i$ / °")
    for line, cells in enumerate([heads, *_cells(table)]):
        y = (top - line * style.LINE) / height
        for x, cell in zip((0.08, 0.2, 0.38, 0.56, 0.76), cells, strict=True):
            color = style.QUIET if line == 0 else style.INK
            figure.text(x, y, cell, fontproperties=style.font(), color=color, va="top")


def _cells(table: DhTable) -> Iterator[tuple[str, ...]]:
    for i, row in enumerate(table.joints, start=1):
        numbers = (row.a, math.degrees(row.alpha), row.d, math.degrees(row.theta))
        a, alpha, d, theta = (number(round(value, 9) + 0.0, ".6g") for value in numbers)
        if row.type == "revolute":
            theta = _with_variable(i, theta)
        else:
            d = _with_variable(i, d)
        yield str(i), a, alpha, d, theta


def _with_variable(i: int, constant: str) -> str:
    sign, size = (" - ", constant[1:]) if constant.startswith("-") else (" + ", constant)
    return rf"$q_{{{i}}}$" + ("" if constant == "0" else sign + size)
