"""A chart of the kinematic pairs: a symbol of each, its letter, its freedoms and its constraints."""

from collections.abc import Callable

import numpy as np
from matplotlib.figure import Figure

from gelenk.course.mobility.pairs import KINDS, LETTERS
from gelenk.language import translated as _
from gelenk.plots import figure as style
from gelenk.plots.course.sketch import DASHED, Point, Sketch, arc, direction
from gelenk.plots.course.titles import TITLES
from gelenk.robot.arrays import Array

_COLUMNS = 5
_WIDTH, _HEIGHT = 1.75, 2.05
"""Size of a cell, [inch]."""
_HEAD = 0.75


def pairs_figure() -> Figure:
    """Draw all kinds of pairs of the course's table."""
    rows = -(-len(KINDS) // _COLUMNS)
    height = rows * _HEIGHT + _HEAD
    sketch = Sketch(_COLUMNS * _WIDTH, height)
    sketch.write(_(TITLES["joint-pairs"]), (0.2, height - 0.25), size=style.TITLE, ha="left")
    text = _("f freedoms are left and c = λ − f removed; λ = 3 in the plane, 6 in space")
    sketch.write(text, (0.2, height - 0.5), color=style.QUIET, ha="left")
    for i, (name, kind) in enumerate(KINDS.items()):
        middle = np.array([(i % _COLUMNS + 0.5) * _WIDTH, height - _HEAD - (i // _COLUMNS + 0.36) * _HEIGHT])
        _SYMBOLS[name](sketch, middle)
        letter = next((f" ({letter})" for letter, its in LETTERS.items() if its == name), "")
        sketch.write(kind.name + letter, middle - (0.0, 0.66), bold=True)
        where = ((_("plane"), 3, kind.planar), (_("space"), 6, kind.spatial))
        lines = [f"{space}: c = {c}, f = {freedoms - c}" for space, freedoms, c in where if c is not None]
        lines.append(_("lower pair") if kind.order == "low" else _("higher pair"))
        for row, line in enumerate(lines):
            sketch.write(line, middle - (0.0, 0.85 + 0.17 * row), color=style.QUIET, size=8.0)
    return sketch.figure()


def _turn(sketch: Sketch, at: Point, radius: float, start: float, end: float) -> None:
    points = arc(at, radius, np.radians(start), np.radians(end))
    sketch.arrow(*points, color=style.VELOCITY, both=True, width=1.2)


def _slide(sketch: Sketch, at: Array, half: Point) -> None:
    sketch.arrow(at - half, at + half, color=style.VELOCITY, both=True, width=1.2)


def _box(sketch: Sketch, at: Array, wide: float, high: float, face: str = "white", order: float = 3.0) -> None:
    corners = np.array([[-wide, -high], [wide, -high], [wide, high], [-wide, high]])
    sketch.shape(at + corners, face=face, order=order)


def _revolute(sketch: Sketch, at: Array) -> None:
    for angle in (200.0, 40.0):
        sketch.line([at, at + 0.6 * direction(np.radians(angle))], color=style.LINK, width=6.0)
    sketch.hinge(at)
    _turn(sketch, at, 0.42, 50.0, 130.0)


def _prismatic(sketch: Sketch, at: Array) -> None:
    sketch.line([at - (0.65, 0.0), at + (0.65, 0.0)], color=style.LINK, width=6.0)
    _box(sketch, at, 0.24, 0.13)
    _slide(sketch, at + (0.0, 0.3), (0.35, 0.0))


def _rolling(sketch: Sketch, at: Array) -> None:
    sketch.hatch(at - (0.6, 0.35), at + (0.6, -0.35))
    sketch.disc(at - (0.0, 0.03), 0.32, face=style.RULE)
    _turn(sketch, at - (0.0, 0.03), 0.46, 50.0, 130.0)


def _pin_in_slot(sketch: Sketch, at: Array) -> None:
    quarter = np.pi / 2.0
    right, left = arc(at + (0.4, 0.0), 0.13, -quarter, quarter), arc(at - (0.4, 0.0), 0.13, quarter, 3.0 * quarter)
    sketch.shape(np.concatenate((right, left)))
    sketch.disc(at + (0.1, 0.0), 0.13, face=style.LINK)
    _slide(sketch, at - (0.0, 0.3), (0.35, 0.0))
    _turn(sketch, at + (0.1, 0.0), 0.32, 50.0, 130.0)


def _cam(sketch: Sketch, at: Array) -> None:
    middle = at - (0.0, 0.2)
    angles = np.linspace(0.0, 2.0 * np.pi, 60)
    radii = 0.24 + 0.16 * np.exp(-2.0 * (1.0 - np.cos(angles - np.radians(60.0))))
    points = middle + radii[:, None] * np.column_stack((np.cos(angles), np.sin(angles)))
    sketch.shape(points, face=style.RULE)
    sketch.hinge(middle)
    top = float(points[:, 1].max())
    _box(sketch, np.array([at[0] + 0.12, top + 0.04]), 0.3, 0.04)
    sketch.line([(at[0] + 0.12, top + 0.08), (at[0] + 0.12, top + 0.35)], color=style.LINK, width=6.0)


def _gear(sketch: Sketch, at: Array) -> None:
    for x, radius, teeth, turned in ((-0.27, 0.33, 14, 0.0), (0.32, 0.25, 10, np.pi / 10.0)):
        angles = np.linspace(0.0, 2.0 * np.pi, 8 * teeth, endpoint=False)
        radii = radius + 0.045 * np.tanh(4.0 * np.cos(teeth * (angles - turned)))
        middle = at + (x, 0.0)
        sketch.shape(middle + radii[:, None] * np.column_stack((np.cos(angles), np.sin(angles))), face=style.RULE)
        sketch.hinge(middle)


def _screw(sketch: Sketch, at: Array) -> None:
    _box(sketch, at, 0.65, 0.1, style.RULE, 2.5)
    for x in np.arange(-0.6, 0.56, 0.1):
        sketch.line([at + (x, -0.1), at + (x + 0.06, 0.1)], width=0.9, order=2.6)
    _box(sketch, at, 0.2, 0.22)
    _slide(sketch, at + (0.0, 0.4), (0.35, 0.0))


def _universal(sketch: Sketch, at: Array) -> None:
    for sign in (-1.0, 1.0):
        fork = np.array([[0.68, 0.0], [0.34, 0.0], [0.34, 0.24], [0.0, 0.24]])
        across = np.array([[0.34, 0.0], [0.34, -0.24], [0.0, -0.24]])
        flip = np.array([sign, 1.0]) if sign > 0.0 else np.array([sign, 0.55])
        sketch.line(at + fork * flip, color=style.LINK, width=5.0)
        sketch.line(at + across * flip, color=style.LINK, width=5.0)
    sketch.line([at - (0.0, 0.3), at + (0.0, 0.3)], width=2.0, order=4.0)
    sketch.line([at - (0.13, 0.1), at + (0.13, 0.1)], width=2.0, order=4.0)
    _turn(sketch, at, 0.45, 60.0, 120.0)


def _cylindrical(sketch: Sketch, at: Array) -> None:
    sketch.line([at - (0.65, 0.0), at + (0.65, 0.0)], color=style.LINK, width=6.0)
    ellipse = np.column_stack((0.07 * np.cos(t := np.linspace(0.0, 2.0 * np.pi, 40)), 0.18 * np.sin(t)))
    left, right = ellipse - (0.26, 0.0), ellipse + (0.26, 0.0)
    sketch.shape(at + np.concatenate((right[30:], right[:11], left[10:31])))
    sketch.shape(at + right)
    sketch.line([at + (0.26, 0.0), at + (0.65, 0.0)], color=style.LINK, width=6.0, order=4.0)
    _slide(sketch, at + (0.0, 0.36), (0.35, 0.0))
    turn = at + (0.52, 0.0) + np.column_stack((0.09 * np.cos(s := np.linspace(-2.2, 1.6, 30)), 0.24 * np.sin(s)))
    sketch.arrow(*turn, color=style.VELOCITY, width=1.2)


def _spherical(sketch: Sketch, at: Array) -> None:
    sketch.line([at, at + (0.5, 0.38)], color=style.LINK, width=6.0)
    sketch.disc(at, 0.2, face=style.RULE)
    sketch.line(arc(at, 0.27, np.radians(95.0), np.radians(340.0)), color=style.INK, width=3.0)
    sketch.line([at - (0.27, 0.0), at - (0.65, 0.0)], color=style.LINK, width=6.0, order=1.5)


def _planar(sketch: Sketch, at: Array) -> None:
    plate = np.array([[-0.62, -0.3], [0.3, -0.3], [0.62, 0.1], [-0.3, 0.1]])
    sketch.shape(at + plate, face=style.RULE)
    middle = at + (0.0, -0.02)
    sketch.shape(middle + 0.45 * plate + (0.0, 0.02), order=3.5)
    _slide(sketch, at + (0.0, 0.26), (0.4, 0.0))
    _slide(sketch, at + (0.5, 0.3), (0.1, 0.12))
    turn = middle + np.column_stack((0.17 * np.cos(s := np.linspace(-0.4, 4.2, 30)), 0.07 * np.sin(s)))
    sketch.arrow(*turn, color=style.VELOCITY, width=1.2)


def _sphere_in_groove(sketch: Sketch, at: Array) -> None:
    groove = [(-0.6, 0.0), (-0.3, 0.0), (0.0, -0.3), (0.3, 0.0), (0.6, 0.0), (0.6, -0.4), (-0.6, -0.4)]
    sketch.shape(at + np.array(groove), face=style.RULE)
    sketch.disc(at + (0.0, 0.03), 0.235)


def _point_contact(sketch: Sketch, at: Array) -> None:
    sketch.hatch(at - (0.6, 0.3), at + (0.6, -0.3))
    sketch.disc(at, 0.29)
    sketch.line([at - (0.0, 0.3), at + (0.0, 0.48)], width=0.9, dashes=DASHED, color=style.QUIET, order=4.0)


def _fixed(sketch: Sketch, at: Array) -> None:
    sketch.line([at - (0.6, 0.0), at + (0.6, 0.0)], color=style.LINK, width=6.0)
    sketch.line([at, at + (0.0, 0.45)], color=style.LINK, width=6.0)
    sketch.shape(at + np.array([[-0.2, 0.0], [0.2, 0.0], [0.0, 0.2]]), face=style.INK)


_SYMBOLS: dict[str, Callable[[Sketch, Array], None]] = {
    "revolute": _revolute,
    "prismatic": _prismatic,
    "rolling": _rolling,
    "pin_in_slot": _pin_in_slot,
    "cam": _cam,
    "gear": _gear,
    "screw": _screw,
    "universal": _universal,
    "cylindrical": _cylindrical,
    "spherical": _spherical,
    "planar": _planar,
    "sphere_in_groove": _sphere_in_groove,
    "point_contact": _point_contact,
    "fixed": _fixed,
}
