"""Pictures of the arm with the velocity and the force ellipse at its tip: in its plane, or in three projections.

Velocities, forces and lengths have no common scale: each ellipse is scaled to suit the arm, and the legend states how
many metres of the picture stand for one unit. An unbounded force is drawn as an endless strip.
"""

from collections.abc import Sequence
from dataclasses import dataclass
from typing import Any, TypeAlias

import numpy as np
from matplotlib.axes import Axes
from matplotlib.figure import Figure

from gelenk.kinematics.ellipsoids.limited_motion import LimitedMotion
from gelenk.kinematics.ellipsoids.manipulability import Ellipsoids, is_within_task, space_of, transmission_ratios
from gelenk.language import number, number_list, translated as _
from gelenk.plots import figure as style
from gelenk.plots.arm import arm_line
from gelenk.plots.legend import LegendRow, configuration_lines, legend, legend_height, write_head, write_legend
from gelenk.plots.shadows import DASHED, SOLID, Arrow, Outline, Quantity, draw_arrow, draw_outline, draw_quantity
from gelenk.robot.arrays import Array, Flags
from gelenk.robot.chain import Chain

View: TypeAlias = tuple[Array, str, str]
"""Two unit vectors of a projection plane as rows, shape (2, 3), and the labels of its axes."""

_LARGEST = 0.38
"""Upper limit of the longest semi-axis of an ellipse, as a fraction of the arm's extent."""
_ARROW = 0.46
"""Length of an arrow, as a fraction of the arm's extent."""
_MARGIN = 0.08
_TITLE_HEIGHT, _AXES_WIDTH, _AXES_HEIGHT, _LABELS_HEIGHT = 0.55, 5.3, 4.8, 0.65
"""Sizes of the layout, [inch]."""


@dataclass(frozen=True, slots=True)
class Overlay:
    """What a picture shows in addition to the ellipsoids.

    Attributes:
        directions: Unit vectors drawn as arrows; shape (D, 3).
        tolerance: Tolerance within which the force along a direction is unbounded; see `transmission_ratios`.
        limited: Velocities and forces within the joint limits; None if no polytopes were requested.
    """

    directions: Array
    tolerance: float
    limited: LimitedMotion | None


NOTHING_MORE = Overlay(np.zeros((0, 3)), 0.0, None)


@dataclass(frozen=True, slots=True)
class EllipsoidScene:
    """Everything that is drawn.

    Attributes:
        points: Base, a point on each joint, and tip; shape (m + 2, 3), [m].
        slides: Whether each joint is prismatic; shape (m,).
        extent: Size of the arm, [m].
        quantities, outlines, arrows: Ellipsoids, polytopes and directions at the tip.
    """

    points: Array
    slides: Flags
    extent: float
    quantities: tuple[Quantity, ...]
    outlines: tuple[Outline, ...]
    arrows: tuple[Arrow, ...]

    @property
    def halves(self) -> list[Array]:
        """Half extents along x, y and z of everything at the tip; shape (3,) each, [m as drawn]."""
        arrows: list[Array] = [np.abs(arrow.direction) * 1.1 * _ARROW * self.extent for arrow in self.arrows]
        return [*(one.halves for one in self.quantities), *(one.halves for one in self.outlines), *arrows]


def manipulability_picture(
    name: str,
    chain: Chain,
    q: Array,
    translation: Ellipsoids | None,
    kind: style.PictureFormat,
    overlay: Overlay = NOTHING_MORE,
) -> bytes:
    """Draw the arm with its ellipsoids at q alone, in the base frame; `translation` is None for a task without one."""
    points, slides = arm_line(chain, q)
    extent = max(float(np.ptp(points, axis=0).max()), float(np.linalg.norm(points[-1])), 1e-3)
    quantities = () if translation is None else _quantities(chain, translation, extent)
    outlines = () if translation is None or overlay.limited is None else _outlines(translation, overlay.limited, extent)
    plane = plane_of(chain, translation)
    arrows = _arrows(translation, quantities, overlay)
    scene = EllipsoidScene(points, slides, extent, quantities, outlines, arrows)
    entries = legend(quantities, outlines, arrows, translation)
    title = f"{style.plain(name)}: {style.plain(chain.base_frame)} → {style.plain(chain.tip_frame)}"
    captions = (title, chain, q, entries)
    figure = _in_projections(scene, *captions) if plane is None else _in_plane(scene, plane, *captions)
    return style.as_bytes(figure, kind)


def plane_of(chain: Chain, translation: Ellipsoids | None) -> Array | None:
    """Return two unit vectors of the picture's plane, that of all motion or else of the task; shape (2, 3), or None."""
    spaces = [space_of(chain, (0, 1, 2)), *([] if translation is None else [translation.space])]
    return next((space.spread(space.basis.T) for space in spaces if space.is_plane), None)


def _units(chain: Chain) -> tuple[str, str]:
    """Return the units of joint velocities and joint forces, or plain names if joints of both kinds are mixed."""
    kinds = frozenset(chain.flat.joints[:, 0].tolist())
    named = {frozenset({0}): ("rad/s", "N m"), frozenset({1}): ("m/s", "N")}
    return named.get(kinds, (_("joint velocity"), _("joint effort")))


def _quantities(chain: Chain, translation: Ellipsoids, extent: float) -> tuple[Quantity, ...]:
    """Return the velocity and the force ellipsoid; nothing if the tip cannot translate."""
    sigmas = translation.sigmas[0]
    if not len(sigmas):
        return ()
    axes = translation.space.spread(translation.axes[0].T).T
    velocity, force = _units(chain)
    inverses = np.divide(1.0, sigmas, out=np.full_like(sigmas, np.inf), where=sigmas > 0.0)
    return (
        Quantity(
            _("Velocity"),
            _("m/s per {unit}").format(unit=velocity),
            style.VELOCITY,
            SOLID,
            axes,
            sigmas,
            drawn_scale(sigmas, extent),
        ),
        Quantity(
            _("Force"),
            _("N per {unit}").format(unit=force),
            style.FORCE,
            DASHED,
            axes,
            inverses,
            drawn_scale(inverses, extent),
        ),
    )


def _outlines(translation: Ellipsoids, limited: LimitedMotion, extent: float) -> tuple[Outline, ...]:
    found = []
    for name, unit, color, unlimited, numbers, vertices in (
        (
            _("Velocity"),
            "m/s",
            style.VELOCITY,
            _("not every joint has a velocity limit"),
            limited.velocities,
            limited.velocity_vertices,
        ),
        (
            _("Force"),
            "N",
            style.FORCE,
            _("not every joint has an effort limit"),
            limited.forces,
            limited.force_vertices,
        ),
    ):
        missing = unlimited if numbers is None else _("unbounded")
        scale = 1.0 if vertices is None else drawn_scale(np.linalg.norm(vertices, axis=1), extent)
        corners = None if vertices is None else translation.space.spread(vertices)
        found.append(Outline(name, unit, color, corners, scale, missing))
    return tuple(found)


def _arrows(translation: Ellipsoids | None, quantities: Sequence[Quantity], overlay: Overlay) -> tuple[Arrow, ...]:
    """Return the directions as arrows; the legend shows their components."""
    directions = overlay.directions
    inside, ratios = np.zeros(len(directions), dtype=bool), np.full((2, len(directions)), np.nan)
    if translation is not None and quantities and len(directions):
        inside = is_within_task(translation.space, directions)
        ratios = np.array(transmission_ratios(translation, directions, overlay.tolerance)).reshape(2, -1)
    arrows = []
    for i, direction in enumerate(directions):
        words = f"({number_list(np.round(direction, 9) + 0.0, '.3g')}): "
        if not inside[i]:
            arrows.append(Arrow(i + 1, direction, (), words + _("not in the task")))
            continue
        values = ratios[:, i].tolist()
        texts = [number(value) if np.isfinite(value) else _("unbounded") for value in values]
        reached = zip(quantities, values, strict=True)
        ends = tuple((one.color, value * one.scale) for one, value in reached if np.isfinite(value))
        arrows.append(Arrow(i + 1, direction, ends, f"{words}v {texts[0]}, F {texts[1]}"))
    return tuple(arrows)


def drawn_scale(sizes: Array, extent: float) -> float:
    """Return the metres as drawn per unit, a power of ten times 1, 2 or 5, that fit the largest size in the picture."""
    largest = float(sizes[np.isfinite(sizes)].max(initial=0.0))
    if not largest > 0.0:
        return 1.0
    wanted = _LARGEST * extent / largest
    decade = 10.0 ** np.floor(np.log10(wanted))
    return float(max(step * decade for step in (1.0, 2.0, 5.0) if step * decade <= wanted))


def _in_plane(
    scene: EllipsoidScene, plane: Array, title: str, chain: Chain, q: Array, entries: Sequence[LegendRow]
) -> Figure:
    width = 6.4
    lines = configuration_lines(chain, q, width)
    top, bottom = _TITLE_HEIGHT + len(lines) * style.LINE, _LABELS_HEIGHT + legend_height(entries)
    height = top + _AXES_HEIGHT + bottom
    figure = style.new_figure(width, height)
    axes = figure.add_axes((0.13, bottom / height, _AXES_WIDTH / width, _AXES_HEIGHT / height))
    view = (plane, f"{style.axis_name(plane[0], 1)} / m", f"{style.axis_name(plane[1], 2)} / m")
    halves = [np.abs(plane) @ half for half in scene.halves]
    middle, half = _box(scene.points @ plane.T, halves, scene.extent)
    _draw(axes, view, scene)
    # Widen the narrower range, so that the axes fill their space.
    across, upwards = axes.bbox.size
    style.look_at(axes, middle, np.maximum(half, half[::-1] * (across / upwards) ** np.array([1.0, -1.0])))
    write_head(figure, title, lines)
    write_legend(figure, (0.06, (bottom - _LABELS_HEIGHT) / height), entries)
    return figure


def _in_projections(scene: EllipsoidScene, title: str, chain: Chain, q: Array, entries: Sequence[LegendRow]) -> Figure:
    """Draw front and side views above, and the top view below the front, all on one scale."""
    width, side = 9.0, 3.6
    lines = configuration_lines(chain, q, width)
    height = _TITLE_HEIGHT + len(lines) * style.LINE + 2.0 * (side + _LABELS_HEIGHT)
    figure = style.new_figure(width, height)
    names, e = ("x / m", "y / m", "z / m"), np.eye(3)
    middle, half = _box(scene.points, scene.halves, scene.extent)
    upper = side + 2.0 * _LABELS_HEIGHT
    for (i, j), left, bottom in (((0, 2), 0.72, upper), ((1, 2), 5.13, upper), ((0, 1), 0.72, _LABELS_HEIGHT)):
        axes = figure.add_axes((left / width, bottom / height, side / width, side / height))
        _draw(axes, (e[[i, j]], names[i], names[j]), scene)
        style.look_at(axes, middle[[i, j]], np.full(2, half.max()))
    write_head(figure, title, lines)
    write_legend(figure, (5.13 / width, (side + 0.35) / height), entries)
    return figure


def _box(points: Array, halves: Sequence[Array], extent: float) -> tuple[Array, Array]:
    """Return centre and half size of a box around the arm and everything at its tip."""
    everything = np.concatenate([points, *(points[-1:] + sign * half for half in halves for sign in (1.0, -1.0))])
    lower, upper = everything.min(axis=0), everything.max(axis=0)
    return (lower + upper) / 2.0, (upper - lower) / 2.0 + _MARGIN * extent


def _draw(axes: Axes, view: View, scene: EllipsoidScene) -> None:
    plane, x_label, y_label = view
    style.metric_axes(axes, x_label, y_label)
    points = scene.points @ plane.T
    tip = points[-1]
    for quantity in scene.quantities:
        draw_quantity(axes, plane, tip, quantity, scene.extent)
    for outline in scene.outlines:
        draw_outline(axes, plane, tip, outline)
    _draw_arm(axes, points, scene.slides)
    for arrow in scene.arrows:
        draw_arrow(axes, plane, tip, arrow, _ARROW * scene.extent)


def _draw_arm(axes: Axes, points: Array, slides: Flags) -> None:
    caps: dict[str, Any] = {"solid_capstyle": "round", "solid_joinstyle": "round"}
    axes.plot(points[:, 0], points[:, 1], color=style.LINK, linewidth=5.0, zorder=2, **caps)
    axes.plot(*points[0], marker="s", markersize=11, color=style.INK, zorder=2.5)
    edge: dict[str, Any] = {"color": "white", "markeredgecolor": style.INK, "markeredgewidth": 1.4, "zorder": 3}
    for rows, marker, size in ((~slides, "o", 8.0), (slides, "s", 7.5)):
        some = points[1:-1][rows]
        axes.plot(some[:, 0], some[:, 1], marker, markersize=size, **edge)
    axes.plot(*points[-1], marker="o", markersize=5.0, color=style.INK, zorder=5)
