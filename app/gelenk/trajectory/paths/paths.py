"""Paths of the tip through space as functions of the path coordinate s, in metres, or in radians if it only turns.

A path contains no timing. With a time law s(t), the tip's twist is ξ = ξ_s ṡ and its acceleration ξ̇ = ξ_s s̈ + ξ_s' ṡ².
(The lecture's formula for p̈ has the wrong factor at the first derivative: p̈ = d²p/ds² ṡ² + dp/ds s̈.) Position and
orientation are planned separately, both as functions of s.

- `line`, `circle`: the orientation advances in proportion to the distance travelled.
- `blended_lines` (`spline_paths`): a polyline whose corners are replaced by parabolas.
- `spline` (`spline_paths`): a smooth curve through any number of poses.
"""

import math
from collections.abc import Sequence
from dataclasses import dataclass
from functools import cached_property
from typing import Literal, Protocol, TypeAlias

import numpy as np

from gelenk.errors import InvalidField
from gelenk.robot.arrays import Array
from gelenk.robot.poses import Poses
from gelenk.trajectory.paths.curves import Curve, Line, arc_through
from gelenk.trajectory.paths.orientation_paths import OrientationPath, axis_angle, through
from gelenk.trajectory.paths.rotation_splines import rotation_spline
from gelenk.trajectory.paths.zyz_paths import zyz_spline

Unit: TypeAlias = Literal["m", "rad"]
ViaOrientation: TypeAlias = Literal["smooth", "slerp", "zyz", "zyz_other"]

POINT = 1e-9
"""Length below which a path is a turn on the spot, [m]."""


@dataclass(frozen=True, slots=True)
class PathSamples:
    """Poses and derivatives at N places of a path.

    Attributes:
        poses: Poses at the places.
        first: ξ_s = (dp/ds; ω/ṡ), in the base frame; shape (N, 6), [m, rad per m or rad].
        second: dξ_s/ds; shape (N, 6), [m, rad per m² or rad²].
    """

    poses: Poses
    first: Array
    second: Array

    @property
    def tangents(self) -> Array:
        """Unit tangents of the position, zero where it does not move; shape (N, 3)."""
        norms = np.linalg.norm(self.first[:, :3], axis=1)[:, None]
        tangents: Array = np.where(norms > 0.5, self.first[:, :3], 0.0)
        return tangents

    @property
    def curvatures(self) -> Array:
        """Curvatures ‖d²p/ds²‖; shape (N,), [1/m]."""
        curvatures: Array = np.linalg.norm(self.second[:, :3], axis=1)
        return curvatures

    @property
    def angular_rates(self) -> Array:
        """Angular rates ‖ω‖ / ṡ; shape (N,), [rad/m]; 1 for a turn on the spot about one axis."""
        rates: Array = np.linalg.norm(self.first[:, 3:], axis=1)
        return rates

    def twists(self, speeds: Array) -> Array:
        """Return (ṗ; ω) at ṡ of shape (N,), [m/s or rad/s]; shape (N, 6), [m/s, rad/s]."""
        twists: Array = self.first * speeds[:, None]
        return twists

    def accelerations(self, speeds: Array, accelerations: Array) -> Array:
        """Return (p̈; ω̇) at ṡ and s̈ of shape (N,) each; shape (N, 6), [m/s², rad/s²]."""
        total: Array = self.first * accelerations[:, None] + self.second * speeds[:, None] ** 2
        return total


class Path(Protocol):
    """A path of the tip through space."""

    @property
    def unit(self) -> Unit:
        """Unit of s: metres, or radians for a turn on the spot."""

    @property
    def extent(self) -> float:
        """Value of s at the end, [m or rad]; it is 0 at the start."""

    @property
    def length(self) -> float:
        """Length of the position's path, [m]."""

    @property
    def angle(self) -> float:
        """Angle travelled by the orientation, [rad]."""

    @property
    def breaks(self) -> tuple[float, ...]:
        """Values of s inside the path at which ξ_s or dξ_s/ds jumps."""

    def at(self, s: Array) -> PathSamples:
        """Return poses and derivatives at places s of shape (N,), [m or rad]."""


@dataclass(frozen=True, slots=True)
class CurvePath:
    """A curve with an orientation that advances in proportion to its length; of zero length, a turn on the spot.

    Attributes:
        curve: Path of the position.
        orientation: Path of the orientation from the start to the end of the curve.
    """

    curve: Curve
    orientation: OrientationPath

    @property
    def unit(self) -> Unit:
        """See `Path`."""
        return "rad" if self.curve.length <= POINT else "m"

    @property
    def extent(self) -> float:
        """See `Path`."""
        return self.orientation.angle if self.unit == "rad" else self.curve.length

    @property
    def length(self) -> float:
        """See `Path`."""
        return self.curve.length

    @property
    def angle(self) -> float:
        """See `Path`."""
        return self.orientation.angle

    @property
    def breaks(self) -> tuple[float, ...]:
        """See `Path`."""
        return tuple(x * self.extent for x in self.orientation.breaks)

    def at(self, s: Array) -> PathSamples:
        """See `Path`."""
        extent = self.extent
        per_s = 1.0 / extent if extent > 0.0 else 0.0
        x, length = s * per_s, self.curve.length
        stretch = length * per_s
        positions, tangents, bends = self.curve.at(x * length if self.unit == "rad" else s)
        rotations, rates, changes = self.orientation.at(x)
        first = np.hstack((tangents * stretch, rates * per_s))
        second = np.hstack((bends * stretch**2, changes * per_s**2))
        return PathSamples(Poses(positions, rotations), first, second)


def line(start: Array, end: Array, orientation: OrientationPath | None = None) -> CurvePath:
    """Return the straight line from pose to pose; a turn on the spot if only the orientations differ.

    Args:
        start: T_base_tip at the start; shape (4, 4).
        end: T_base_tip at the end; shape (4, 4).
        orientation: Path between the two orientations; by default about one axis.
    """
    turn = axis_angle(start[:3, :3], end[:3, :3]) if orientation is None else orientation
    return CurvePath(Line(start[:3, 3].copy(), end[:3, 3].copy()), turn)


def circle(start: Array, via: Array, end: Array, orientation: ViaOrientation = "smooth") -> CurvePath:
    """Return the circular arc from a pose through a second to a third.

    Args:
        start: T_base_tip at the start; shape (4, 4).
        via: T_base_tip in between, whose orientation is reached together with its position; shape (4, 4).
        end: T_base_tip at the end; shape (4, 4).
        orientation: See `through_orientations`.

    Raises:
        InvalidField: Two of the positions coincide, or all three lie on a line.
    """
    arc = arc_through(*(T[:3, 3] for T in (start, via, end)))
    rotations = np.ascontiguousarray(np.array([start, via, end])[:, :3, :3])
    knots = np.array([0.0, arc.via_angle / arc.angle, 1.0])
    return CurvePath(arc, through_orientations(rotations, knots, orientation))


def through_orientations(rotations: Array, knots: Array, law: ViaOrientation) -> OrientationPath:
    """Return a path through several orientations.

    Args:
        rotations: At least two orientations; shape (M + 1, 3, 3).
        knots: Values of x at the orientations, increasing from 0 to 1; shape (M + 1,).
        law: `smooth`: a spline with continuous angular acceleration. `slerp`: about one axis from each to the next; the
            angular rate jumps at the inner knots, listed in `breaks`. `zyz`: a spline of the Euler angles; `zyz_other`
            uses the other triple of every orientation after the start.
    """
    if law == "smooth":
        return rotation_spline(rotations, knots)
    if law == "slerp":
        return through(rotations, knots)
    return zyz_spline(rotations, knots, [law == "zyz_other", *[False] * (len(rotations) - 2)])


@dataclass(frozen=True)
class PathSequence:
    """Paths joined one after the other, each beginning where the previous one ends.

    Attributes:
        parts: At least one path; all have the same unit of s.
    """

    parts: tuple[Path, ...]

    @property
    def unit(self) -> Unit:
        """See `Path`."""
        return self.parts[0].unit

    @property
    def extent(self) -> float:
        """See `Path`."""
        return float(self._ends[-1])

    @property
    def length(self) -> float:
        """See `Path`."""
        return sum(part.length for part in self.parts)

    @property
    def angle(self) -> float:
        """See `Path`."""
        return sum(part.angle for part in self.parts)

    @property
    def breaks(self) -> tuple[float, ...]:
        """See `Path`: the junctions of the parts, and the breaks inside them."""
        ends = self._ends
        inner = (ends[i] + one for i, part in enumerate(self.parts) for one in part.breaks)
        return tuple(sorted({float(s) for s in (*ends[1:-1], *inner)}))

    def at(self, s: Array) -> PathSamples:
        """See `Path`; at a junction, the later part counts."""
        ends, count = self._ends, len(s)
        place = np.searchsorted(ends[1:-1], s, side="right")
        if count > 0 and place.min() == place.max():
            part: Path = self.parts[int(place[0])]
            return part.at(s - ends[place[0]])
        poses = Poses(np.empty((count, 3)), np.empty((count, 3, 3)))
        first, second = np.empty((count, 6)), np.empty((count, 6))
        for i in np.unique(place):
            rows = place == i
            samples = self.parts[i].at(s[rows] - ends[i])
            poses.positions[rows], poses.rotations[rows] = samples.poses.positions, samples.poses.rotations
            first[rows], second[rows] = samples.first, samples.second
        return PathSamples(poses, first, second)

    @cached_property
    def _ends(self) -> Array:
        return np.concatenate(([0.0], np.cumsum([part.extent for part in self.parts])))


def sequence(parts: Sequence[Path]) -> PathSequence:
    """Join paths one after the other.

    Raises:
        ValueError: There are no paths, or their units of s differ.
    """
    if len({part.unit for part in parts}) != 1:
        raise ValueError("paths in a sequence have one unit of s, and there is at least one")
    return PathSequence(tuple(parts))


def refuse_reversal(a: Array, b: Array, field: str) -> None:
    """Refuse a corner between directions `a` and `b`, of any length, at which the path turns back along itself.

    Raises:
        InvalidField: The path turns back.
    """
    if math.hypot(*(a / math.hypot(*a) + b / math.hypot(*b))) <= 1e-6:
        raise InvalidField(field, "the next leg turns back along the previous one: such a corner requires a stop")
