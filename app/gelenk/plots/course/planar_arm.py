"""A planar arm: its coordinates, the triangle of two links, and the lever arms of a force at its tip."""

from collections.abc import Sequence
from dataclasses import dataclass
from typing import Literal, TypeAlias

import numpy as np
from matplotlib.figure import Figure

from gelenk.language import number, translated as _
from gelenk.plots import figure as style
from gelenk.plots.course.sketch import DASHED, DOTTED, Sketch, arc, direction
from gelenk.robot.arrays import Array

Kind: TypeAlias = Literal["R", "P"]

_ALMOST = 1e-9
_AXES = 0.15
"""Room for the base's axes, as a share of the arm's extent."""


@dataclass(frozen=True, slots=True)
class PlanarJoint:
    """A joint of a planar arm and the link after it.

    Attributes:
        kind: R turns the rest of the arm, P moves it along the link.
        value: Angle to the link before, [rad], or displacement of a P, [m].
        length: Of the link after an R, [m]; what a P adds to its displacement.
    """

    kind: Kind
    value: float
    length: float = 0.0


def arm_points(joints: Sequence[PlanarJoint]) -> tuple[Array, Array]:
    """Return the joints and the tip, shape (n + 1, 2), [m], and the direction of each link, shape (n,), [rad]."""
    points, angles, angle = [np.zeros(2)], [], 0.0
    for joint in joints:
        angle += joint.value if joint.kind == "R" else 0.0
        reach = joint.length + (joint.value if joint.kind == "P" else 0.0)
        angles.append(angle)
        points.append(points[-1] + reach * direction(angle))
    return np.array(points), np.array(angles)


def planar_arm_figure(joints: Sequence[PlanarJoint], *, values: bool = False, tip: str = "$P$") -> Figure:
    """Draw an arm with the names of its lengths and variables, or also their values."""
    points, angles = arm_points(joints)
    axes = points[0] + _AXES * max(float(np.ptp(points, axis=0).max()), _ALMOST) * np.eye(2)
    sketch = _sketch_of(np.concatenate((points, axes)))
    _base_axes(sketch, points[0])
    radius = 0.42 * sketch.unit
    before = 0.0
    for i, joint in enumerate(joints):
        a, b = points[i], points[i + 1]
        side = direction(angles[i] + np.pi / 2.0)
        if joint.kind == "R":
            _angle(sketch, a, before, joint.value, radius, _named(r"\vartheta", i, joint.value, "°", values))
            if joint.length > _ALMOST:
                sketch.label(_named("l", i, joint.length, "m", values), (a + b) / 2.0, side)
        else:
            sketch.label(_named("d", i, joint.value, "m", values), (a + b) / 2.0, side, color=style.VELOCITY)
        before = float(angles[i])
    _draw_arm(sketch, points, angles, [joint.kind for joint in joints])
    sketch.label(tip, points[-1], direction(before))
    return sketch.figure()


def elbows_figure(lengths: tuple[float, float], point: tuple[float, float]) -> Figure:
    """Draw the triangle of two links and their tip, with the elbow on either side; raises ValueError beyond reach."""
    l1, l2 = lengths
    r = float(np.hypot(*point))
    cosine = (r * r - l1 * l1 - l2 * l2) / (2.0 * l1 * l2)
    if abs(cosine) > 1.0 + _ALMOST or r <= _ALMOST:
        raise ValueError("the tip must be within reach, and not at the base")
    bend = float(np.arccos(np.clip(cosine, -1.0, 1.0)))
    gamma, beta = float(np.arctan2(point[1], point[0])), float(np.arctan2(l2 * np.sin(bend), l1 + l2 * np.cos(bend)))
    base, tip = np.zeros(2), np.array(point, dtype=float)
    down, up = l1 * direction(gamma - beta), l1 * direction(gamma + beta)
    sketch = _sketch_of(np.array([base, down, up, tip]))
    _base_axes(sketch, base)
    sketch.line([base, tip], color=style.QUIET, dashes=DASHED)
    sketch.label("$r$", 0.55 * tip, direction(gamma + np.pi / 2.0), color=style.QUIET)
    for elbow, color, side in ((up, style.FORCE, 1.0), (down, style.VELOCITY, -1.0)):
        sketch.line([base, elbow, tip], color=color, width=4.0)
        outward = side * direction(gamma + np.pi / 2.0)
        for name, a, b in (("$l_1$", base, elbow), ("$l_2$", elbow, tip)):
            sketch.label(name, (a + b) / 2.0, outward)
        text = _("elbow up") if side > 0.0 else _("elbow down")
        sketch.label(text, elbow, outward, color=color)
        sketch.hinge(elbow)
    radius = 0.5 * sketch.unit
    for name, start, turn, out in ((r"$\gamma$", 0.0, gamma, 0.75), (r"$\beta$", gamma - beta, beta, 1.3)):
        _angle(sketch, base, start, turn, out * radius, name)
    _inner_angle(sketch, down, base, tip, r"$\alpha$")
    sketch.hinge(base)
    sketch.disc(tip, 0.05 * sketch.unit, face=style.INK)
    sketch.label(r"$p$", tip, direction(gamma))
    return sketch.figure()


def levers_figure(points: Array, force: Sequence[float], torques: Sequence[float], slides: Sequence[bool]) -> Figure:
    """Draw the lever arm of a force at the tip about each joint.

    `points` are the joints and the tip, shape (n + 1, 2), [m]; `force` is in the same plane, [N]; `torques` are of the
    joints, [N m] or [N]; `slides` says which joints are prismatic.
    """
    F = np.asarray(force, dtype=float)
    size = float(np.linalg.norm(F))
    along = F / size if size > 0.0 else np.array([1.0, 0.0])
    feet = points[-1] + ((points[:-1] - points[-1]) @ along)[:, None] * along
    length = 0.45 * max(float(np.ptp(points, axis=0).max()), _ALMOST)
    head = points[-1] + length * along
    sketch = _sketch_of(np.concatenate((points, feet, head[None])), height=5.2)
    _draw_arm(sketch, points, _directions(points), ["P" if slide else "R" for slide in slides])
    if size > 0.0:
        reach = np.concatenate((feet, points[-1:]))
        ends = reach[[np.argmin(reach @ along), np.argmax(reach @ along)]]
        sketch.line(ends, color=style.FORCE, width=0.9, dashes=DOTTED)
        sketch.arrow(points[-1], head, color=style.FORCE, width=2.2)
        sketch.label(rf"$F$ = {number(size)} N", head, along, color=style.FORCE)
    for i, (joint, foot) in enumerate(zip(points[:-1], feet, strict=True)):
        unit = "N" if slides[i] else "N m"
        torque = f"{number(torques[i])} {unit}".replace("-", "−")
        sketch.label(rf"$\tau_{{{i + 1}}}$ = {torque}", joint, joint - points[-1])
        lever = float(np.linalg.norm(foot - joint))
        if not slides[i] and lever > 1e-6 * length and size > 0.0:
            sketch.line([joint, foot], color=style.VELOCITY, dashes=DASHED)
            middle = (joint + foot) / 2.0
            sketch.label(rf"$h_{{{i + 1}}}$ = {number(lever)} m", middle, along, color=style.VELOCITY)
    return sketch.figure()


def _sketch_of(points: Array, width: float = 6.4, height: float = 4.6) -> Sketch:
    """Return a drawing with room for points, and for labels around them."""
    low, high = points.min(axis=0), points.max(axis=0)
    margin = 0.22 * max(float((high - low).max()), 1e-6)
    return Sketch(width, height, (low[0] - margin, high[0] + margin, low[1] - margin, high[1] + margin))


def _base_axes(sketch: Sketch, base: Array) -> None:
    reach = 0.85 * sketch.unit
    for name, end in (("$x$", np.array([reach, 0.0])), ("$y$", np.array([0.0, reach]))):
        sketch.arrow(base, base + end, color=style.QUIET, width=1.0)
        sketch.label(name, base + end, end, color=style.QUIET)


def _draw_arm(sketch: Sketch, points: Array, angles: Array, kinds: Sequence[str]) -> None:
    sketch.line(points, color=style.LINK, width=5.0, order=2.2)
    for i, (point, kind) in enumerate(zip(points[:-1], kinds, strict=True)):
        if i == 0:
            sketch.ground(point)
        if kind == "R":
            sketch.hinge(point)
        else:
            u, v = 0.16 * sketch.unit * direction(angles[i]), 0.09 * sketch.unit * direction(angles[i] + np.pi / 2.0)
            sketch.shape(point + np.array([u + v, v - u, -u - v, u - v]), order=5.0)
    sketch.disc(points[-1], 0.05 * sketch.unit, face=style.INK, order=5.0)


def _directions(points: Array) -> Array:
    steps = np.diff(points, axis=0)
    return np.arctan2(steps[:, 1], steps[:, 0])


def _angle(sketch: Sketch, at: Array, start: float, turn: float, radius: float, name: str) -> None:
    """Draw an angle from a direction, with an arrow in its sense, and its name."""
    reach = at + 1.5 * radius * direction(start)
    if start != 0.0:
        sketch.line([at, reach], color=style.QUIET, width=0.9, dashes=DASHED)
    if abs(turn) > 0.02:
        sketch.arrow(*arc(at, radius, start, start + turn), color=style.VELOCITY, width=1.1)
    middle = start + turn / 2.0
    sketch.label(name, at + radius * direction(middle), direction(middle), color=style.VELOCITY)


def _inner_angle(sketch: Sketch, at: Array, first: Array, second: Array, name: str) -> None:
    a, b = np.arctan2(*(first - at)[::-1]), np.arctan2(*(second - at)[::-1])
    turn = float((b - a + np.pi) % (2.0 * np.pi) - np.pi)
    radius = 0.3 * sketch.unit
    sketch.line(arc(at, radius, a, a + turn), color=style.VELOCITY, width=1.1)
    sketch.label(name, at + radius * direction(a + turn / 2.0), direction(a + turn / 2.0), color=style.VELOCITY)


def _named(letter: str, index: int, value: float, unit: str, values: bool) -> str:
    name = rf"${letter}_{{{index + 1}}}$"
    if not values:
        return name
    text = f"{number(np.degrees(value))}°" if unit == "°" else f"{number(value)} m"
    return f"{name} = {text.replace('-', '−')}"
