"""Paths of the tip through space as functions of the path coordinate s, in metres, or in radians if it only turns.

A path contains no timing. With a time law s(t), the tip's twist is ξ = ξ_s ṡ and its acceleration ξ̇ = ξ_s s̈ + ξ_s' ṡ².
(The lecture's formula for p̈ has the wrong factor at the first derivative: p̈ = d²p/ds² ṡ² + dp/ds s̈.) Position and
orientation are planned separately, both as functions of s.

`line`, `circle`: the orientation advances in proportion to the distance travelled. `spline_paths` has the others.
"""

import math
from collections.abc import Sequence
from dataclasses import dataclass
from functools import cached_property
from itertools import pairwise
from typing import Literal, Protocol, TypeAlias

import numpy as np

from gelenk.errors import InvalidField
from gelenk.robot.arrays import Array, Indices
from gelenk.robot.poses import Poses
from gelenk.trajectory.audit.words import OrientationLaw
from gelenk.trajectory.paths.curves import Curve, Line, arc_through
from gelenk.trajectory.paths.orientation_paths import AxisAnglePath, OrientationPath, axis_angle
from gelenk.trajectory.paths.rotation_splines import rotation_spline
from gelenk.trajectory.paths.sampling import in_proportion, turning_line
from gelenk.trajectory.paths.tracks import Samples, Straight, Track, along, track_of
from gelenk.trajectory.paths.zyz_paths import zyz_spline

Unit: TypeAlias = Literal["m", "rad"]

POINT = 1e-9
"""Length below which a path is a turn on the spot, [m]."""


@dataclass(frozen=True, slots=True)
class PathSamples:
    """Poses and derivatives at N places of a path.

    Attributes:
        first: ξ_s = (dp/ds; ω/ṡ), in the base frame; shape (N, 6), [m, rad per m or rad].
        second: dξ_s/ds; shape (N, 6), [m, rad per m² or rad²].
    """

    poses: Poses
    first: Array
    second: Array

    @classmethod
    def of(cls, samples: Samples) -> "PathSamples":
        """Return the samples of a kernel."""
        return cls(Poses(samples[0], samples[1]), samples[2], samples[3])


class Path(Protocol):
    """A path of the tip through space."""

    @property
    def unit(self) -> Unit:
        """Unit of s: metres, or radians for a turn on the spot."""

    @property
    def extent(self) -> float:
        """Value of s at the end, [m or rad]; it is 0 at the start."""

    @property
    def breaks(self) -> tuple[float, ...]:
        """Values of s inside the path at which ξ_s or dξ_s/ds jumps."""

    def at(self, s: Array) -> PathSamples:
        """Return poses and derivatives at places s of shape (N,), [m or rad]."""


@dataclass(frozen=True, slots=True)
class CurvePath:
    """A curve with an orientation that advances in proportion to its length; of zero length, a turn on the spot."""

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
    def breaks(self) -> tuple[float, ...]:
        """Always empty: curve and orientation are smooth."""
        return ()

    def at(self, s: Array) -> PathSamples:
        """See `Path`."""
        curve, turn, length = self.curve, self.orientation, self.curve.length
        if (straight := self.flat()) is not None:
            return PathSamples.of(turning_line(*straight[:5], s))
        is_turn = length <= POINT
        extent = turn.angle if is_turn else length
        per_s = 1.0 / extent if extent > 0.0 else 0.0
        x = s * per_s
        positions, tangents, bends = curve.at(x * length if is_turn else s)
        rotations, rates, changes = turn.at(x)
        first, second = in_proportion(tangents, bends, rates, changes, length * per_s, per_s)
        return PathSamples(Poses(positions, rotations), first, second)

    def flat(self, begin: float = 0.0) -> Straight | None:
        """Return a line that turns about one axis, from a place on, as kernels take it; None for other paths."""
        curve, turn = self.curve, self.orientation
        if not isinstance(curve, Line) or not isinstance(turn, AxisAnglePath) or curve.length <= POINT:
            return None
        return Straight(curve.start, curve.end, *turn.as_vector, curve.length, begin)


def line(start: Array, end: Array, orientation: OrientationPath | None = None) -> CurvePath:
    """Return the straight line between poses of shape (4, 4); a turn on the spot if only the orientations differ.

    The path between the two orientations is by default about one axis.
    """
    turn = axis_angle(start[:3, :3], end[:3, :3]) if orientation is None else orientation
    return CurvePath(Line(start[:3, 3].copy(), end[:3, 3].copy()), turn)


def circle(start: Array, via: Array, end: Array, orientation: OrientationLaw = "axis_angle") -> CurvePath:
    """Return the circular arc from a pose through a second to a third.

    The orientation of the second, a T_base_tip of shape (4, 4) like the others, is reached together with its position.
    The law of orientations is that of `through_orientations`. `InvalidField` if two of the positions coincide, or all
    three lie on a line.
    """
    arc = arc_through(*(T[:3, 3] for T in (start, via, end)))
    rotations = np.ascontiguousarray(np.array([start, via, end])[:, :3, :3])
    knots = np.array([0.0, arc.via_angle / arc.angle, 1.0])
    return CurvePath(arc, through_orientations(rotations, knots, orientation))


def through_orientations(rotations: Array, knots: Array, law: OrientationLaw) -> OrientationPath:
    """Return a smooth path through several orientations, by which the angular acceleration is continuous.

    Args:
        rotations: At least two orientations; shape (M + 1, 3, 3).
        knots: Values of x at the orientations, increasing from 0 to 1; shape (M + 1,).
        law: `axis_angle`: a rotation spline. `zyz`: a spline of the Euler angles; `zyz_other` uses the other triple of
            every orientation after the start.
    """
    if law == "axis_angle":
        return rotation_spline(rotations, knots)
    return zyz_spline(rotations, knots, [law == "zyz_other", *[False] * (len(rotations) - 2)])


@dataclass(frozen=True)
class PathSequence:
    """Paths, at least one, each without breaks and beginning where the previous one ends, with one unit of s."""

    parts: tuple[Path, ...]

    @property
    def unit(self) -> Unit:
        """See `Path`."""
        return self.parts[0].unit

    @property
    def extent(self) -> float:
        """See `Path`."""
        return float(self.ends[-1])

    @property
    def breaks(self) -> tuple[float, ...]:
        """See `Path`: the junctions of the parts."""
        return tuple(self.ends[1:-1].tolist())

    def at(self, s: Array) -> PathSamples:
        """See `Path`; at a junction, the later part counts."""
        if self._track is not None:
            return PathSamples.of(along(self._track, np.ascontiguousarray(s)))
        ends = self.ends
        order = np.argsort(s, kind="stable")
        cuts = [0, *np.searchsorted(s[order], ends[1:-1]).tolist(), len(s)]
        spans = [(i, begin, end) for i, (begin, end) in enumerate(pairwise(cuts)) if begin < end]
        if len(spans) < 2:
            i = spans[0][0] if spans else 0
            return self.parts[i].at(s - ends[i])
        return _in_order([self.parts[i].at(s[order[begin:end]] - ends[i]) for i, begin, end in spans], order)

    @cached_property
    def _track(self) -> Track | None:
        """The sequence as kernels take it, if it is made of lines and curves; they say so by a method `flat`."""
        flat = [part.flat() if hasattr(part, "flat") else None for part in self.parts]
        return track_of(flat, self.ends)

    @cached_property
    def ends(self) -> Array:
        """Values of s at the start and at the end of each part; shape (M + 1,), [m or rad]."""
        return np.concatenate(([0.0], np.cumsum([part.extent for part in self.parts])))


def _in_order(samples: Sequence[PathSamples], order: Indices) -> PathSamples:
    """Join samples, and undo the order in which they were taken."""
    parts = [(one.poses.positions, one.poses.rotations, one.first, one.second) for one in samples]
    columns = [np.concatenate(part) for part in zip(*parts, strict=True)]
    if (np.diff(order) < 0).any():
        back = np.argsort(order)
        columns = [column[back] for column in columns]
    positions, rotations, first, second = columns
    return PathSamples(Poses(positions, rotations), first, second)


def refuse_reversal(a: Array, b: Array, field: str) -> None:
    """Refuse a corner between directions, of any length, where the path turns back on itself, with `InvalidField`."""
    if math.hypot(*(a / math.hypot(*a) + b / math.hypot(*b))) <= 1e-6:
        raise InvalidField(field, "the next leg turns back along the previous one: such a corner requires a stop")
