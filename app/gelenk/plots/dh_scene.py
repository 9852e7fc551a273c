"""The frames of a DH table in space: axes, common normals, offsets, angles, and where their names belong."""

import math
from collections.abc import Sequence
from dataclasses import dataclass, field
from itertools import pairwise
from typing import Literal, TypeAlias

import numpy as np

from gelenk.robot.arrays import Array
from gelenk.robot.dh import DhTable

Kind: TypeAlias = Literal["x", "z", "a", "d", "link", "help", "axis", "theta", "alpha"]

_ARC, _MORE = 0.5, 0.17
"""Radius of an arc, and how much larger each further one at the same point is, in lengths of an arrow."""
_ARC_POINTS = 40
_NOTHING = 1e-6
"""Lengths relative to the arm, and angles [rad], that are not drawn."""


@dataclass(frozen=True, slots=True)
class Stroke:
    """A line through points of shape (m, 3), [m]."""

    kind: Kind
    points: Array


@dataclass(frozen=True, slots=True)
class Name:
    """A name in mathematical notation, and the points beside which it may stand, best first; shape (m, 3), [m]."""

    text: str
    kind: Kind
    places: Array


@dataclass(frozen=True, slots=True)
class DrawnJoint:
    """A joint at the origin of a frame T, (4, 4), along its z."""

    slides: bool
    T: Array


@dataclass(slots=True)
class DhScene:
    """Everything that is drawn; `arrow` is the length of an axis of a frame, [m]."""

    arrow: float
    strokes: list[Stroke] = field(default_factory=list)
    names: list[Name] = field(default_factory=list)
    bodies: list[DrawnJoint] = field(default_factory=list)
    arcs: list[tuple[Kind, Array]] = field(default_factory=list)

    def line(self, kind: Kind, start: Array, end: Array, name: str = "") -> None:
        """Add a straight line, with a name beside its middle; nothing where it has no length."""
        if np.linalg.norm(end - start) <= _NOTHING * self.arrow:
            return
        self.strokes.append(Stroke(kind, np.array([start, end])))
        if name:
            shares = np.array([0.5, 0.35, 0.65, 0.2, 0.8])[:, None]
            self.names.append(Name(name, kind, start + shares * (end - start)))

    def arc(self, kind: Kind, name: str, center: Array, first: Array, around: Array, angle: float) -> None:
        """Add an arc by an angle [rad] around a unit vector, from the direction `first` on."""
        if abs(angle) <= _NOTHING:
            return
        same = sum(
            other == kind and bool(np.linalg.norm(center - place) < 0.5 * self.arrow) for other, place in self.arcs
        )
        self.arcs.append((kind, center))
        turns = np.linspace(0.0, angle, _ARC_POINTS)[:, None]
        arc = np.cos(turns) * first + np.sin(turns) * np.cross(around, first)
        points = center + (_ARC + _MORE * same) * self.arrow * arc
        self.strokes.append(Stroke(kind, points))
        self.names.append(Name(name, kind, points[[20, 14, 26, 8, 32]]))

    def ray(self, start: Array, direction: Array) -> None:
        """Add a dashed line that shows a direction at another point."""
        self.line("help", start, start + self.arrow * direction)

    def axes(self, frames: Sequence[tuple[str, Array]]) -> None:
        """Add the x and z axes of frames; axes that coincide are drawn once, with all names."""
        found: dict[tuple[str, tuple[float, ...]], tuple[list[str], Array, Array]] = {}
        for index, T in frames:
            for letter, axis in (("x", 0), ("z", 2)):
                place = np.round(np.concatenate((T[:3, 3] / self.arrow, T[:3, axis])), 5) + 0.0
                entry = found.setdefault((letter, tuple(place)), ([], T[:3, 3], T[:3, axis]))
                entry[0].append(index)
        for (letter, _), (indices, origin, direction) in found.items():
            kind: Kind = "x" if letter == "x" else "z"
            tip = origin + self.arrow * direction
            self.strokes.append(Stroke(kind, np.array([origin, tip])))
            text = "$" + ",\\,".join(f"{letter}_{{{index}}}" for index in indices) + "$"
            self.names.append(Name(text, kind, np.array([tip, origin + 0.75 * self.arrow * direction])))


def dh_scene(table: DhTable, q: Sequence[float]) -> DhScene:
    """Return what there is to draw of a table at a configuration [rad or m], in the axes of the base."""
    frames, positions, standard = table.frames(q), table.positions(q), table.convention == "standard"
    corners = [_corner(standard, *pair) for pair in pairwise(frames)]
    tip = frames[-1] @ table.tool
    ends = [np.zeros(3), *(T[:3, 3] for T in frames), *corners, tip[:3, 3]]
    extent = float(np.ptp(ends, axis=0).max()) or 1.0
    different = len({tuple(np.round(T[:3, 3] / extent, 3)) for T in frames})
    scene = DhScene(extent * max(0.15, 0.6 / different))
    named = [(str(i), T) for i, T in enumerate(frames)]
    for name, T, other in (("B", np.eye(4), frames[0]), ("E", tip, frames[-1])):
        if not np.allclose(T, other, rtol=0.0, atol=_NOTHING * extent):
            named.append((name, T))
            scene.line("link", T[:3, 3], other[:3, 3])
    for i, (row, position, corner) in enumerate(zip(table.joints, positions, corners, strict=True)):
        before, after = frames[i], frames[i + 1]
        joint = before if standard else after
        _axis(scene, joint[:3, 2], [joint[:3, 3], corner])
        scene.bodies.append(DrawnJoint(row.type == "prismatic", joint))
        theta = row.theta + (position if row.type == "revolute" else 0.0)
        _row(scene, i + 1, standard, (before, corner, after), (row.alpha, math.remainder(theta, 2.0 * math.pi)))
    scene.axes(named)
    return scene


def _corner(standard: bool, before: Array, after: Array) -> Array:
    """Return the point where the common normal of a row meets the joint's axis, [m]."""
    if standard:
        z: Array = before[:3, 2]
        return before[:3, 3] + (z @ (after[:3, 3] - before[:3, 3])) * z
    x: Array = before[:3, 0]
    return before[:3, 3] + (x @ (after[:3, 3] - before[:3, 3])) * x


def _axis(scene: DhScene, direction: Array, points: Sequence[Array]) -> None:
    heights = [float(direction @ (point - points[0])) for point in points]
    low, high = min(heights) - 0.5 * scene.arrow, max(heights) + 1.3 * scene.arrow
    scene.line("axis", points[0] + low * direction, points[0] + high * direction)


def _row(
    scene: DhScene, i: int, standard: bool, points: tuple[Array, Array, Array], angles: tuple[float, float]
) -> None:
    """Add a row: a and α along and about x, d and ϑ along and about z, with help lines where an arc has no side."""
    before, corner, after = points
    alpha, theta = angles
    start, end = before[:3, 3], after[:3, 3]
    link = i if standard else i - 1
    x, z = (after[:3, 0], before[:3, 2]) if standard else (before[:3, 0], after[:3, 2])
    scene.line("link", start, corner)
    scene.line("link", corner, end)
    along_z, along_x = ((start, corner), (corner, end)) if standard else ((corner, end), (start, corner))
    scene.line("d", *along_z, f"$d_{{{i}}}$")
    scene.line("a", *along_x, f"$a_{{{link}}}$")
    # z turns about x where the common normal ends, x about z where the offset ends.
    at_normal, at_offset = along_x[1], along_z[1]
    for center, axis, angle in ((at_offset, 0, theta), (at_normal, 2, alpha)):
        for T in (before, after):
            if abs(angle) > _NOTHING and np.linalg.norm(center - T[:3, 3]) > _NOTHING * scene.arrow:
                scene.ray(center, T[:3, axis])
    scene.arc("theta", rf"$\vartheta_{{{i}}}$", at_offset, before[:3, 0], z, theta)
    scene.arc("alpha", rf"$\alpha_{{{link}}}$", at_normal, before[:3, 2], x, math.remainder(alpha, 2.0 * math.pi))
