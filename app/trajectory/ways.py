"""Ways of the tip from the segments of a trajectory: lines, circles, splines, and lines blended into one way."""

import math
from collections.abc import Sequence
from dataclasses import dataclass
from typing import cast

import numpy as np

from app.model.arrays import Array
from app.model.errors import InvalidField
from app.model.poses import Poses
from app.trajectory.orientation_paths import OrientationPath, zyz_paths
from app.trajectory.paths import POINT, Path, PathSequence, circle, line, refuse_reversal
from app.trajectory.problem import Segment
from app.trajectory.spline_paths import PolynomialPath, SplineBoundary, blended_lines, spline


@dataclass(frozen=True, slots=True)
class Way:
    """A way of the tip.

    Attributes:
        path: The way.
        ends: s at which each of its segments ends, in the middle of the blend where there is one; the last is
            `path.extent`.
        notes: What else is to be known.
    """

    path: Path
    ends: tuple[float, ...]
    notes: tuple[str, ...] = ()


def way_of(start: Array, segments: Sequence[Segment], first: int) -> Way:
    """The way of one segment, or of lines that are blended.

    Args:
        start: T_base_tip at its beginning; shape (4, 4).
        segments: One, or lines all but the last of which are blended into the next.
        first: Number of the first in the trajectory, for refusals.

    Raises:
        InvalidField: There is no such way.
    """
    if len(segments) > 1:
        return _blended(start, segments, first)
    try:
        path, notes = _single(start, segments[0])
    except InvalidField as error:
        raise InvalidField(f"segments.{first}.{error.field}", error.reason) from error
    return Way(path, (path.extent,), notes)


def is_blended(segment: Segment) -> bool:
    """Whether a line is left for the next one without a stop."""
    given = (segment.blend_time, segment.blend_acceleration)
    return segment.blend_radius > 0.0 or any(one is not None for one in given)


def _single(start: Array, segment: Segment) -> tuple[Path, tuple[str, ...]]:
    if segment.type == "line":
        end = _pose(segment)
        return line(start, end, _orientation(start, end, segment)), ()
    if segment.type == "circle":
        return circle(start, cast(Array, segment.via), _pose(segment)), ()
    boundary, notes = _tangent_boundary(segment)
    poses = _with_start(start, cast(Poses, segment.poses))
    return spline(poses, boundary), notes


def _tangent_boundary(segment: Segment) -> tuple[SplineBoundary, tuple[str, ...]]:
    """A way has a tangent at its ends; that the tip rests there is up to the law of time."""
    if segment.boundary in {"clamped", "assigned"}:
        note = (
            f"boundary {segment.boundary} of a tip's spline: the law of time brings the tip to rest at its ends; the "
            "way itself is natural there, since one that is clamped has no tangent"
        )
        return "natural", (note,)
    return cast(SplineBoundary, segment.boundary), ()


def _orientation(start: Array, end: Array, segment: Segment) -> OrientationPath | None:
    if segment.orientation == "axis_angle":
        return None
    regular, flipped = zyz_paths(start[:3, :3], end[:3, :3])
    return regular if segment.orientation == "zyz" else flipped


def _blended(start: Array, segments: Sequence[Segment], first: int) -> Way:
    for i, segment in enumerate(segments):
        if segment.orientation != "axis_angle":
            reason = "lines that are blended turn about one axis each: `axis_angle`"
            raise InvalidField(f"segments.{first + i}.orientation", reason)
    poses = Poses(
        np.array([start[:3, 3], *(_pose(segment)[:3, 3] for segment in segments)]),
        np.array([start[:3, :3], *(_pose(segment)[:3, :3] for segment in segments)]),
    )
    legs = np.diff(poses.positions, axis=0)
    radii = _radii(legs, segments, first)
    path = blended_lines(poses, radii)
    return Way(path, _middles(path))


def _middles(path: PathSequence) -> tuple[float, ...]:
    """Where one leg becomes the next: the middle of each blend, and the end of the way."""
    ends, s = [], 0.0
    for part in path.parts:
        if isinstance(part, PolynomialPath):
            ends.append(s + 0.5 * part.extent)
        s += part.extent
    return (*ends, path.extent)


def _radii(legs: Array, segments: Sequence[Segment], first: int) -> list[float]:
    """How far from its end each line but the last is left, [m]."""
    lengths = np.linalg.norm(legs, axis=1)
    for i, length in enumerate(lengths):
        if length <= POINT:
            reason = "a line that is blended with another has to lead somewhere: its two ends share one position"
            raise InvalidField(f"segments.{first + i}.target", reason)
    radii: list[float] = []
    for i, segment in enumerate(segments[:-1]):
        name, radius = _radius(segment, legs[i], legs[i + 1], f"segments.{first + i}")
        refuse_reversal(legs[i], legs[i + 1], name)
        for which, length in ((i, lengths[i]), (i + 1, lengths[i + 1])):
            taken = radius + (radii[-1] if radii and which == i else 0.0)
            if taken > length * (1.0 + 1e-12):
                both = " with the blend before" if taken > radius else ""
                reason = (
                    f"segment {first + which} is {length:g} m long, and the blend{both} would take {taken:g} m of it"
                )
                raise InvalidField(name, reason)
        radii.append(radius)
    return radii


def _radius(segment: Segment, leg: Array, following: Array, field: str) -> tuple[str, float]:
    """The field that tells of a blend, and its radius: that of the course's fly-over at the tip's greatest speed.

    d = v ΔT / 2, with ΔT = ‖v K_BC - v K_AB‖ / a where the acceleration is given.
    """
    if segment.blend_radius > 0.0:
        return f"{field}.blend_radius", segment.blend_radius
    name = "blend_time" if segment.blend_time is not None else "blend_acceleration"
    speed = segment.limits.tip.speed
    if not math.isfinite(speed):
        reason = "the blend depends on the speed that the lines are run at: `limits.tip_velocity` is missing"
        raise InvalidField(f"{field}.{name}", reason)
    turn = following / math.hypot(*following) - leg / math.hypot(*leg)
    if segment.blend_acceleration is not None:
        time = speed * math.hypot(*turn) / segment.blend_acceleration
    else:
        time = cast(float, segment.blend_time)
    radius = 0.5 * speed * time
    if radius <= POINT:
        raise InvalidField(f"{field}.{name}", f"the blend would be {radius:g} m long: the lines go straight on")
    return f"{field}.{name}", radius


def _pose(segment: Segment) -> Array:
    return cast(Array, segment.pose)


def _with_start(start: Array, poses: Poses) -> Poses:
    return Poses(
        np.concatenate((start[None, :3, 3], poses.positions)), np.concatenate((start[None, :3, :3], poses.rotations))
    )
