"""The course's pictures that depend on nothing, by name; `titles` lists them."""

from collections.abc import Callable
from functools import partial

import numpy as np
from matplotlib.figure import Figure

from gelenk.errors import UnknownPicture
from gelenk.language import translated as _
from gelenk.plots import figure as style
from gelenk.plots.course.encoders import disc_figure, tracks_figure
from gelenk.plots.course.motor import circuit_figure
from gelenk.plots.course.pairs import pairs_figure
from gelenk.plots.course.sketch import DASHED, Sketch, direction
from gelenk.plots.course.titles import TITLES
from gelenk.robot.arrays import Array


def gallery_figure(name: str) -> Figure:
    """Draw a picture of the gallery; raises UnknownPicture for another name."""
    if name not in _GALLERY:
        raise UnknownPicture(name, tuple(TITLES))
    return _GALLERY[name]()


def coincident_figure(counts: tuple[int, ...] = (2, 3, 4)) -> Figure:
    """Draw joints at which 2 to 5 links meet, and below each the pairs that it consists of."""
    cell, height = 2.3, 3.7
    sketch = Sketch(max(cell * len(counts), 4.6), height)
    sketch.write(_(TITLES["coincident-joints"]), (0.2, 3.45), size=style.TITLE, ha="left")
    for i, count in enumerate(counts):
        middle = np.array([(i + 0.5) * cell, 2.35])
        for link in range(count):
            end = middle + 0.72 * direction(np.pi / 2.0 + 2.0 * np.pi * (link + 0.5) / count)
            sketch.line([middle, end], color=style.LINK, width=6.0)
            sketch.label(str(link + 1), end, end - middle)
        sketch.hinge(middle)
        _pairs_in_a_row(sketch, middle - (0.0, 1.4), count)
        sketch.write(_("k = {k} links, k − 1 = {n}").format(k=count, n=count - 1), (middle[0], 0.3))
    return sketch.figure()


def _pairs_in_a_row(sketch: Sketch, middle: Array, count: int) -> None:
    xs = middle[0] + 0.52 * (np.arange(count) - (count - 1) / 2.0)
    sketch.line([(xs[0], middle[1]), (xs[-1], middle[1])])
    for link, x in enumerate(xs):
        sketch.disc((x, middle[1]), 0.13)
        sketch.write(str(link + 1), (x, middle[1]))
    for x in (xs[:-1] + xs[1:]) / 2.0:
        sketch.label("R", (x, middle[1]), (0.0, 1.0), color=style.VELOCITY)


def spaces_figure() -> Figure:
    """Draw the three spaces of a robot, and the maps between them for positions, velocities and forces."""
    sketch = Sketch(8.4, 3.5)
    sketch.write(_(TITLES["kinematic-spaces"]), (0.2, 3.25), size=style.TITLE, ha="left")
    spaces = (
        (1.15, _("actuator space"), r"$\vartheta_m,\ \tau_m \in \mathrm{R}^n$", _("motors")),
        (4.2, _("joint space"), r"$q,\ \tau \in \mathrm{R}^n$", _("configurations")),
        (7.25, _("task space"), r"$r,\ \gamma \in \mathrm{R}^m$", _("poses of the tip")),
    )
    for x, name, symbols, elements in spaces:
        sketch.shape(np.array([x, 1.6]) + [[-0.85, -0.5], [0.85, -0.5], [0.85, 0.5], [-0.85, 0.5]], face="#f4f6f8")
        sketch.write(name, (x, 1.87), bold=True)
        sketch.write(symbols, (x, 1.6))
        sketch.write(elements, (x, 1.33), color=style.QUIET)
    maps = (
        (2.0, 3.35, _("gears"), r"$\dot q = N^{-1} \dot\vartheta_m$", r"$\tau_m = N^{-T} \tau$"),
        (5.05, 6.4, _("direct kinematics"), r"$r = f(q),\ \dot r = J\,\dot q$", r"$\tau = J^T \gamma$"),
    )
    for left, right, name, onwards, back in maps:
        middle = (left + right) / 2.0
        sketch.arrow((left + 0.05, 1.75), (right - 0.05, 1.75), color=style.VELOCITY)
        sketch.arrow((right - 0.05, 1.45), (left + 0.05, 1.45), color=style.FORCE)
        sketch.write(name, (middle, 2.6))
        sketch.write(onwards, (middle, 2.33), color=style.VELOCITY)
        sketch.write(back, (middle, 0.9), color=style.FORCE)
    text = _("n ≥ m is necessary for solutions to exist; n − m is the degree of redundancy")
    sketch.write(text, (4.2, 0.35), color=style.QUIET)
    return sketch.figure()


def wrist_figure() -> Figure:
    """Draw a spherical wrist: its axes, its angles, its centre, and the tool beyond it."""
    sketch = Sketch(6.6, 4.5)
    sketch.write(_(TITLES["spherical-wrist"]), (0.2, 4.25), size=style.TITLE, ha="left")
    centre, tip = np.array([2.9, 1.9]), np.array([4.0, 3.15])
    approach = (tip - centre) / np.linalg.norm(tip - centre)
    up, across = direction(np.pi / 2.0), direction(np.radians(-25.0))
    origin = np.array([0.6, 0.9])
    sketch.line([centre - 1.15 * up, centre], color=style.LINK, width=8.0)
    sketch.line([centre, tip], color=style.LINK, width=8.0)
    for k, axis, length, radius in ((4, up, 1.75, 1.3), (5, across, 1.3, 0.85), (6, approach, 2.45, 2.05)):
        end = centre + length * axis
        sketch.line([centre - 0.35 * axis, end - 0.1 * axis], width=0.9, dashes=DASHED)
        sketch.arrow(end - 0.15 * axis, end)
        sketch.label(rf"$z_{k - 1}$", end, axis)
        normal = np.array([-axis[1], axis[0]])
        s = np.linspace(-0.35, 4.1, 40)[:, None]
        turn = centre + radius * axis + 0.22 * np.cos(s) * normal + 0.075 * np.sin(s) * axis
        sketch.arrow(*turn, color=style.VELOCITY, width=1.2)
        sketch.label(rf"$\vartheta_{k}$", turn[0], turn[0] - centre - radius * axis, color=style.VELOCITY)
    sketch.disc(centre, 0.12, order=5.0)
    sketch.disc(tip, 0.06, face=style.INK, order=5.0)
    for name, end, where in ((r"$p_w$", centre, 0.55), ("$p$", tip, 0.75)):
        sketch.arrow(origin, end, color=style.FORCE, width=1.2)
        sketch.label(name, origin + where * (end - origin), (-0.4, 1.0), color=style.FORCE)
    beside = 0.24 * np.array([approach[1], -approach[0]])
    sketch.arrow(centre + beside, tip + beside, both=True, width=1.0)
    sketch.label("$d_6$", (centre + tip) / 2.0 + beside, beside)
    sketch.disc(origin, 0.05, face=style.INK)
    sketch.write(r"$p_w = p - d_6\,R\,e_z$", (5.2, 0.85), color=style.FORCE)
    sketch.write(r"$R^3_6 = (R^0_3)^T R$", (5.2, 0.5))
    return sketch.figure()


_GALLERY: dict[str, Callable[[], Figure]] = {
    "coincident-joints": coincident_figure,
    "dc-motor": circuit_figure,
    "gray-disc": partial(disc_figure, 4),
    "joint-pairs": pairs_figure,
    "kinematic-spaces": spaces_figure,
    "quadrature": tracks_figure,
    "spherical-wrist": wrist_figure,
}
