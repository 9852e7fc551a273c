"""Paths of the tip, built from a trajectory's segments: lines, circles, splines, and lines blended into one path."""

import math
from collections.abc import Sequence
from dataclasses import dataclass
from itertools import pairwise
from typing import cast

import numpy as np

from gelenk.errors import InvalidField
from gelenk.robot.arrays import Array
from gelenk.robot.poses import Poses
from gelenk.trajectory.audit.demands import TipLimits
from gelenk.trajectory.paths.orientation_paths import OrientationPath, Turn, axis_angle
from gelenk.trajectory.paths.path_geometry import Zone
from gelenk.trajectory.paths.paths import POINT, Path, PathSequence, ViaOrientation, circle, line, refuse_reversal
from gelenk.trajectory.paths.spline_paths import PolynomialPath, SplineBoundary, blended_lines, spline
from gelenk.trajectory.paths.zyz_paths import zyz_paths, zyz_turns
from gelenk.trajectory.problem.problem import Segment


@dataclass(frozen=True, slots=True)
class BlendedCorner:
    """A blend of two lines.

    Attributes:
        begin: s at its beginning.
        end: s at its end.
        radius: Distance from the corner at which the blend begins, [m].
        acceleration: Limit of the tip's acceleration in the blend, ∞ if only the general limits apply, [m/s²].
    """

    begin: float
    end: float
    radius: float
    acceleration: float


@dataclass(frozen=True, slots=True)
class SegmentsPath:
    """A path of the tip through one segment, or through blended lines.

    Attributes:
        path: Path through all segments.
        ends: s at the end of each segment: the middle of its blend, and `path.extent` for the last.
        corners: Blends of the lines.
        notes: Further remarks for the user.
    """

    path: Path
    ends: tuple[float, ...]
    corners: tuple[BlendedCorner, ...] = ()
    notes: tuple[str, ...] = ()

    @property
    def edges(self) -> tuple[tuple[float, float], ...]:
        """Values of s at the beginning and the end of each blend."""
        return tuple((corner.begin, corner.end) for corner in self.corners)

    def zones(self, segments: Sequence[Segment]) -> tuple[Zone, ...]:
        """Return where the tip has its own limits: in blends that set one, and on lines and the blends beside them.

        Args:
            segments: Segments of the path.
        """
        own = [
            Zone(corner.begin, corner.end, TipLimits(acceleration=corner.acceleration))
            for corner in self.corners
            if math.isfinite(corner.acceleration)
        ]
        if len({segment.limits.tip for segment in segments}) == 1:
            return tuple(own)
        begins = [0.0, *(corner.begin for corner in self.corners)]
        ends = [*(corner.end for corner in self.corners), self.path.extent]
        lines = zip(begins, ends, segments, strict=True)
        return (*own, *(Zone(begin, end, one.limits.tip) for begin, end, one in lines if one.limits.tip != TipLimits()))


def path_through(start: Array, segments: Sequence[Segment], first: int) -> SegmentsPath:
    """Build the path of one segment, or of blended lines.

    Args:
        start: T_base_tip at the start; shape (4, 4).
        segments: One segment, or lines that are each blended into the next.
        first: Index of the first segment in the trajectory, for refusals.

    Raises:
        InvalidField: The path is impossible.
    """
    if len(segments) > 1:
        return _blended(start, segments, first)
    try:
        path, notes = _single(start, segments[0])
    except InvalidField as error:
        raise InvalidField(f"segments.{first}.{error.field}", error.reason) from error
    return SegmentsPath(path, (path.extent,), notes=notes)


def is_blended(segment: Segment) -> bool:
    """Return whether a line is blended into the next segment, without a stop."""
    given = (segment.blend_time, segment.blend_acceleration)
    return segment.blend_radius > 0.0 or any(one is not None for one in given)


def _single(start: Array, segment: Segment) -> tuple[Path, tuple[str, ...]]:
    if segment.type == "line":
        end = _pose(segment)
        return line(start, end, _orientation(start, end, segment)), ()
    if segment.type == "circle":
        return circle(start, cast(Array, segment.via), _pose(segment), _via(segment)), ()
    boundary, notes = _tangent_boundary(segment)
    poses = _with_start(start, cast(Poses, segment.poses))
    return spline(poses, boundary, _via(segment)), notes


def _tangent_boundary(segment: Segment) -> tuple[SplineBoundary, tuple[str, ...]]:
    """Return a boundary condition with tangents at the ends of the path; the time law brings the tip to rest there."""
    if segment.boundary in {"clamped", "assigned"}:
        note = (
            f"boundary {segment.boundary} of a tip spline: the time law brings the tip to rest at its ends; the "
            "path itself is natural there, because a clamped one has no tangent"
        )
        return "natural", (note,)
    return cast(SplineBoundary, segment.boundary), ()


def _via(segment: Segment) -> ViaOrientation:
    """Return how a path through several orientations turns."""
    return "smooth" if segment.orientation == "axis_angle" else segment.orientation


def _orientation(start: Array, end: Array, segment: Segment) -> OrientationPath | None:
    if segment.orientation == "axis_angle":
        return None
    regular, flipped = zyz_paths(start[:3, :3], end[:3, :3])
    return regular if segment.orientation == "zyz" else flipped


def _blended(start: Array, segments: Sequence[Segment], first: int) -> SegmentsPath:
    poses = Poses(
        np.array([start[:3, 3], *(_pose(segment)[:3, 3] for segment in segments)]),
        np.array([start[:3, :3], *(_pose(segment)[:3, :3] for segment in segments)]),
    )
    legs = np.diff(poses.positions, axis=0)
    blends = _blends(legs, segments, first)
    path = blended_lines(poses, [blend.radius for blend in blends], turns=_turns(poses.rotations, segments, first))
    ends = _corner_ends(path)
    corners = tuple(
        BlendedCorner(*pair, blend.radius, blend.acceleration) for pair, blend in zip(ends, blends, strict=True)
    )
    return SegmentsPath(path, (*(0.5 * (begin + end) for begin, end in ends), path.extent), corners)


def _turns(rotations: Array, segments: Sequence[Segment], first: int) -> Sequence[Turn]:
    """Return the turns from each orientation to the next; `zyz_other` changes the sign of θ.

    Raises:
        InvalidField: Some lines turn about an axis and others by ZYZ angles, which leaves no turn over the corner.
    """
    by_axis = [segment.orientation == "axis_angle" for segment in segments]
    if all(by_axis):
        return [axis_angle(*pair) for pair in pairwise(rotations)]
    if any(by_axis):
        reason = "blended lines must all turn by `axis_angle`, or all by ZYZ angles"
        raise InvalidField(f"segments.{first + by_axis.index(not by_axis[0])}.orientation", reason)
    return zyz_turns(rotations, [segment.orientation == "zyz_other" for segment in segments])


def _corner_ends(path: PathSequence) -> list[tuple[float, float]]:
    """Return s at the beginning and the end of each blend."""
    ends, s = [], 0.0
    for part in path.parts:
        if isinstance(part, PolynomialPath):
            ends.append((s, s + part.extent))
        s += part.extent
    return ends


@dataclass(frozen=True, slots=True)
class _Blend:
    """How a corner is blended.

    Attributes:
        field: Request field that determines the blend.
        radius: Distance from the corner at which the blend begins, [m].
        acceleration: Limit of the tip's acceleration in the blend, ∞ if the field sets none, [m/s²].
    """

    field: str
    radius: float
    acceleration: float = math.inf


def _blends(legs: Array, segments: Sequence[Segment], first: int) -> list[_Blend]:
    """Return how each corner is blended."""
    lengths = np.linalg.norm(legs, axis=1)
    for i, length in enumerate(lengths):
        if length <= POINT:
            reason = "a line that is blended with another must have a length: its two ends share one position"
            raise InvalidField(f"segments.{first + i}.target", reason)
    speed = min(segment.limits.tip.speed for segment in segments)
    blends: list[_Blend] = []
    for i, segment in enumerate(segments[:-1]):
        blend = _blend(segment, speed, legs[i], legs[i + 1], f"segments.{first + i}")
        refuse_reversal(legs[i], legs[i + 1], blend.field)
        for which, length in ((i, lengths[i]), (i + 1, lengths[i + 1])):
            taken = blend.radius + (blends[-1].radius if blends and which == i else 0.0)
            if taken > length * (1.0 + 1e-12):
                both = " with the blend before" if taken > blend.radius else ""
                reason = (
                    f"segment {first + which} is {length:g} m long, and the blend{both} would take {taken:g} m of it"
                )
                raise InvalidField(blend.field, reason)
        blends.append(blend)
    return blends


def _blend(segment: Segment, speed: float, leg: Array, following: Array, field: str) -> _Blend:
    """Return how a line is blended into the next: the course's fly-over, with both lines at the tip's speed limit v.

    d = v ΔT / 2 and a = ‖v K_BC - v K_AB‖ / ΔT, where ΔT or a is given. Under this limit of acceleration, the fastest
    motion through the parabola is that of the course, with constant acceleration and duration ΔT.
    """
    if segment.blend_radius > 0.0:
        return _Blend(f"{field}.blend_radius", segment.blend_radius)
    name = "blend_time" if segment.blend_time is not None else "blend_acceleration"
    if not math.isfinite(speed):
        reason = "the blend depends on the speed along the lines: `limits.tip_velocity` is missing"
        raise InvalidField(f"{field}.{name}", reason)
    change = speed * math.hypot(*(following / math.hypot(*following) - leg / math.hypot(*leg)))
    if segment.blend_acceleration is not None:
        acceleration = segment.blend_acceleration
        time = change / acceleration
    else:
        time = cast(float, segment.blend_time)
        acceleration = change / time
    radius = 0.5 * speed * time
    if min(radius, acceleration) <= POINT:
        raise InvalidField(f"{field}.{name}", f"the blend would be {radius:g} m long: the lines continue straight")
    return _Blend(f"{field}.{name}", radius, acceleration)


def _pose(segment: Segment) -> Array:
    return cast(Array, segment.pose)


def _with_start(start: Array, poses: Poses) -> Poses:
    return Poses(
        np.concatenate((start[None, :3, 3], poses.positions)), np.concatenate((start[None, :3, :3], poses.rotations))
    )
