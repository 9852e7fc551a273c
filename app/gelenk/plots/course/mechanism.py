"""Links and pairs: a planar mechanism in its posture, if each pair says where it is, else its graph."""

from collections import Counter, defaultdict
from collections.abc import Sequence

import numpy as np
from matplotlib.figure import Figure

from gelenk.course.mobility.mechanism import Mechanism, Pair
from gelenk.course.mobility.pairs import KINDS, LETTERS
from gelenk.language import translated as _
from gelenk.plots import figure as style
from gelenk.plots.course.sketch import DASHED, SOLID, Point, Sketch, direction
from gelenk.robot.arrays import Array

MOST_LINKS = 40

_WIDTH, _AREA, _HEAD = 7.2, 4.2, 0.75
_COLUMNS = 3
_ROW = 0.44
"""Height for a link of a graph, [inch]."""
_MOST_TEXT = 24
"""Number of characters of a name that fit into a column."""
_SAME = 1e-9


def mechanism_figure(found: Mechanism) -> Figure:
    """Draw at most `MOST_LINKS` links with their pairs; the ground is dark, pairs of a coincident joint are orange."""
    rows = -(-len(found.links) // _COLUMNS) + len(found.splits)
    bottom = 0.3 + style.LINE * rows
    points = _points(found)
    if points is None:
        places = _in_a_ring(found) if found.topology.loops else _as_a_tree(found)
        height = max(_AREA, _ROW * len(set(places[:, 1].tolist())))
        half = np.array([_WIDTH / 2.0 - 0.5, height / 2.0 - 0.35])
        sketch = Sketch(_WIDTH, bottom + height + _HEAD)
        middle = np.array([_WIDTH / 2.0, bottom + height / 2.0])
        _draw_graph(sketch, found, middle, places * (half.min() if found.topology.loops else half))
    else:
        sketch = _around(points, bottom)
        _draw_posture(sketch, found, points)
    _write_legend(sketch, found, bottom)
    return sketch.figure()


def _points(found: Mechanism) -> Array | None:
    """Return where each pair is, shape (j, 2), or None if not all pairs of a planar mechanism say so."""
    points = [None if one is None else one.point for one in found.geometries]
    if found.space != "planar" or not points or any(point is None for point in points):
        return None
    return np.array(points)[:, :2]


def _write_legend(sketch: Sketch, found: Mechanism, bottom: float) -> None:
    """Write what the numbers of the links mean, below the drawing; places are in inches of paper."""
    left, low = sketch.axes.get_xlim()[0], sketch.axes.get_ylim()[0]
    top = low + sketch.axes.bbox.height / sketch.axes.figure.dpi * sketch.unit

    def write(text: str, x: float, y: float, size: float = style.TEXT, color: str = style.INK) -> None:
        sketch.write(text, (left + x * sketch.unit, y), size=size, color=color, ha="left", math=False)

    title = _("n = {n} links with the ground, j = {j} pairs").format(n=len(found.links), j=len(found.pairs))
    write(title, 0.2, top - 0.25 * sketch.unit, style.TITLE)
    y = low + (bottom - 0.15) * sketch.unit
    for i, name in enumerate(found.links):
        row, column = divmod(i, _COLUMNS)
        more = f" ({_('ground')})" if i == found.ground else ""
        most = _MOST_TEXT - len(more)
        text = f"{i + 1}  {style.plain(name if len(name) <= most else name[: most - 1] + '…')}{more}"
        write(text, 0.2 + 2.3 * column, y - row * style.LINE * sketch.unit)
    y -= -(-len(found.links) // _COLUMNS) * style.LINE * sketch.unit
    for row, split in enumerate(found.splits):
        text = _("Joint {name}: k = {k} links meet, k − 1 = {n}")
        text = text.format(name=style.plain(split.joint), k=split.links, n=split.pairs)
        write(text, 0.2, y - row * style.LINE * sketch.unit, color=style.FORCE)


def _color(found: Mechanism, pair: Pair) -> str:
    return style.FORCE if pair.joint in {split.joint for split in found.splits} else style.INK


def _letter(pair: Pair) -> str:
    letter = next((letter for letter, kind in LETTERS.items() if kind == pair.type), "")
    return letter or (KINDS[pair.type].name if pair.type in KINDS else "")


def _draw_graph(sketch: Sketch, found: Mechanism, middle: Array, places: Array) -> None:
    """Draw the links as discs at places around the middle, shape (n, 2), [inch], and the pairs as lines."""
    nodes = middle + places
    totals, seen = Counter(frozenset(ends) for ends in found.ends), Counter[frozenset[int]]()
    for pair, ends in zip(found.pairs, found.ends, strict=True):
        a, b = nodes[list(ends)]
        key = frozenset(ends)
        bow = 0.9 * (seen[key] - (totals[key] - 1) / 2.0) * (1.0 if ends[0] < ends[1] else -1.0)
        seen[key] += 1
        s = np.linspace(0.0, 1.0, 2 if bow == 0.0 else 24)[:, None]
        normal = np.array([a[1] - b[1], b[0] - a[0]]) / np.linalg.norm(b - a)
        curve = a + s * (b - a) + 4.0 * bow * s * (1.0 - s) * normal
        sketch.line(curve, color=_color(found, pair), dashes=DASHED if pair.added else SOLID)
        toward = normal if bow > 0.0 or (bow == 0.0 and normal @ ((a + b) / 2.0 - middle) >= 0.0) else -normal
        # In a tree the lines are further apart at the far end.
        along = 0.5 if found.topology.loops else 0.8 if b[0] > a[0] else 0.2
        sketch.label(_letter(pair), a + along * (b - a) + bow * normal, toward, color=style.VELOCITY, math=False)
    for i, node in enumerate(nodes):
        is_ground = i == found.ground
        sketch.disc(node, 0.15, face=style.INK if is_ground else "white")
        sketch.write(str(i + 1), node, color="white" if is_ground else style.INK)


def _in_a_ring(found: Mechanism) -> Array:
    """Place the links on a circle, in the order of a walk from the ground, which is at the bottom."""
    order, count = list(_walk(found)), len(found.links)
    angles = -np.pi / 2.0 - 2.0 * np.pi * np.argsort(order) / count
    return np.column_stack((np.cos(angles), np.sin(angles)))


def _as_a_tree(found: Mechanism) -> Array:
    """Place the links from left to right by their distance from the ground, each leaf on its own row; in [-1, 1]²."""
    walk = _walk(found)
    children = defaultdict[int, list[int]](list)
    for link, (parent, _depth) in walk.items():
        children[parent].append(link)
    heights, row = dict[int, float](), 0
    for link in reversed(walk):
        below = [heights[child] for child in children[link]]
        heights[link] = float(np.mean(below)) if below else float(row)
        row += not below
    places = np.array([(walk[i][1], heights[i]) for i in range(len(found.links))], dtype=float)
    span = np.maximum(places.max(axis=0), 1e-12)
    return np.where(places.max(axis=0) > 0.0, 2.0 * places / span - 1.0, 0.0)


def _walk(found: Mechanism) -> dict[int, tuple[int, int]]:
    """Return the links in the order of a depth-first walk from the ground, each with its parent and its depth."""
    neighbours = defaultdict[int, list[int]](list)
    for a, b in found.ends:
        neighbours[a].append(b)
        neighbours[b].append(a)
    walk: dict[int, tuple[int, int]] = {}
    for root in (found.ground, *range(len(found.links))):
        stack = [(root, -1, 0)]
        while stack:
            link, parent, depth = stack.pop()
            if link not in walk:
                walk[link] = parent, depth
                stack += [(other, link, depth + 1) for other in reversed(neighbours[link])]
    return walk


def _around(points: Array, bottom: float) -> Sketch:
    """Return a drawing whose upper part has room for points, and its lower part for a legend."""
    low, high = points.min(axis=0), points.max(axis=0)
    unit = float(np.max(np.maximum(high - low, 1e-9) / np.array([_WIDTH - 1.6, _AREA - 1.2])))
    middle, half = (low + high) / 2.0, unit * np.array([_WIDTH, _AREA]) / 2.0
    view = (middle[0] - half[0], middle[0] + half[0], middle[1] - half[1] - bottom * unit,
            middle[1] + half[1] + _HEAD * unit)  # fmt: skip
    return Sketch(_WIDTH, bottom + _AREA + _HEAD, view)


def _draw_posture(sketch: Sketch, found: Mechanism, points: Array) -> None:
    for link in range(len(found.links)):
        corners = _corners([points[i] for i, ends in enumerate(found.ends) if link in ends])
        if link == found.ground:
            continue
        if len(corners) > 2:
            sketch.shape(corners, face=style.RULE, edge=style.LINK, width=3.0, order=2.1)
        elif len(corners) == 2:
            sketch.line(corners, color=style.LINK, width=5.0, order=2.2)
        middle = corners.mean(axis=0)
        away = middle - points.mean(axis=0)
        sketch.label(str(link + 1), middle, away, math=False)
    for pair, ends, point, geometry in zip(found.pairs, found.ends, points, found.geometries, strict=True):
        axis = None if geometry is None else geometry.axis
        _draw_pair(sketch, pair, point, axis, found.ground in ends)


def _corners(points: Sequence[Array]) -> Array:
    """Return the different points among some, in order around their middle; shape (k, 2)."""
    different: list[Array] = []
    for point in points:
        if all(np.linalg.norm(point - other) > _SAME for other in different):
            different.append(point)
    corners = np.array(different).reshape(-1, 2)
    around = corners - corners.mean(axis=0)
    return corners[np.argsort(np.arctan2(around[:, 1], around[:, 0]), kind="stable")]


def _draw_pair(sketch: Sketch, pair: Pair, point: Array, axis: Point | None, is_ground: bool) -> None:
    if pair.type == "revolute":
        sketch.hinge(point, is_ground=is_ground)
        return
    if pair.type == "prismatic" and axis is not None:
        u = 0.22 * sketch.unit * direction(float(np.arctan2(axis[1], axis[0])))
        v = 0.6 * np.array([-u[1], u[0]])
        if is_ground:
            sketch.hatch(point - 2.5 * u - v, point + 2.5 * u - v)
        sketch.shape(point + np.array([u + v, v - u, -u - v, u - v]), order=2.8)
        return
    if is_ground:
        sketch.ground(point)
    sketch.disc(point, 0.05 * sketch.unit, face=style.FORCE, order=5.0)
    sketch.label(_letter(pair), point, color=style.VELOCITY, math=False)
