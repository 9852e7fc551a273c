"""Paths of the tip, built from a trajectory's segments: lines, circles, splines, and lines blended into one path."""

import math
from collections.abc import Sequence
from dataclasses import astuple, dataclass, replace
from itertools import pairwise
from typing import cast

import numpy as np

from gelenk.errors import InvalidField
from gelenk.robot.arrays import Array
from gelenk.robot.poses import Poses
from gelenk.trajectory.audit.demands import TipLimits, Zone
from gelenk.trajectory.audit.words import Law
from gelenk.trajectory.laws.laws import LAWS
from gelenk.trajectory.motion.splines import cubic_spline
from gelenk.trajectory.paths.curves import PARABOLA, QUARTIC
from gelenk.trajectory.paths.orientation_paths import axis_angle
from gelenk.trajectory.paths.paths import POINT, Path, circle, line, refuse_reversal
from gelenk.trajectory.paths.spline_paths import PolynomialPath, SplineBoundary, Turn, blended_lines, spline
from gelenk.trajectory.paths.turned_path import TurnedPath
from gelenk.trajectory.paths.zyz_paths import zyz_turns
from gelenk.trajectory.problem.parts import in_field
from gelenk.trajectory.problem.problem import Segment


@dataclass(frozen=True, slots=True)
class BlendedCorner:
    """A blend of two lines.

    Attributes:
        radius: Distance from the corner at which the blend begins, [m].
        acceleration: Limit of the tip's acceleration in the blend, ∞ if only the general limits apply, [m/s²].
        begin, end: s at its ends.
    """

    radius: float
    acceleration: float = math.inf
    begin: float = 0.0
    end: float = 0.0


@dataclass(frozen=True, slots=True)
class SegmentsPath:
    """A path of the tip through one segment, or through blended lines.

    Attributes:
        ends: s at the end of each segment: the middle of its blend, and `path.extent` for the last.
        zones: Where there are limits of its own: in blends that set one, and on segments and the blends beside them.
    """

    path: Path
    ends: tuple[float, ...]
    corners: tuple[BlendedCorner, ...] = ()
    zones: tuple[Zone, ...] = ()
    notes: tuple[str, ...] = ()


def path_through(start: Array, segments: Sequence[Segment], first: int) -> SegmentsPath:
    """Build the path of one segment, or of lines each blended into the next, from a T_base_tip of shape (4, 4).

    Refusals, `InvalidField`, count segments from `first`, the index of the first in the trajectory.
    """
    if len(segments) > 1:
        return _blended(start, segments, first)
    with in_field(f"segments.{first}"):
        path, notes = _single(start, segments[0])
    return SegmentsPath(path, (path.extent,), notes=notes)


def is_blended(segment: Segment) -> bool:
    """Return whether a line is blended into the next segment, without a stop."""
    given = (segment.blend_time, segment.blend_acceleration)
    return segment.blend_radius > 0.0 or any(one is not None for one in given)


def _single(start: Array, segment: Segment) -> tuple[Path, tuple[str, ...]]:
    if segment.poses is not None and segment.turn is not None:
        turn = segment.turn
        angle = cubic_spline(turn.places, turn.turns[:, None], "natural").motion
        return TurnedPath(spline(segment.poses), turn.axis, angle), ()
    if segment.poses is not None:
        boundary, notes = _tangent_boundary(segment)
        poses = _poses(start, *segment.poses.matrices())
        return spline(poses, boundary, segment.orientation), notes
    if segment.type == "line":
        poses = _poses(start, cast(Array, segment.pose))
        return line(start, poses.matrices()[1], _turns(poses.rotations, [segment], 0)[0]), ()
    _, via, end = _poses(start, cast(Array, segment.via), cast(Array, segment.pose)).matrices()
    return circle(start, via, end, segment.orientation), ()


def _poses(*Ts: Array) -> Poses:
    """Return poses from matrices of shape (4, 4); one whose orientation is open keeps that of the one before."""
    rotations = [Ts[0][:3, :3]]
    for T in Ts[1:]:
        rotations.append(rotations[-1] if np.isnan(T[0, 0]) else T[:3, :3])
    return Poses(np.array([T[:3, 3] for T in Ts]), np.array(rotations))


def _tangent_boundary(segment: Segment) -> tuple[SplineBoundary, tuple[str, ...]]:
    """Return a boundary condition with tangents at the ends of the path; the time law brings the tip to rest there."""
    if segment.boundary in {"clamped", "assigned"}:
        note = (
            f"boundary {segment.boundary} of a tip spline: the time law brings the tip to rest at its ends; the "
            "path itself is natural there, because a clamped one has no tangent"
        )
        return "natural", (note,)
    return cast(SplineBoundary, segment.boundary), ()


def _blended(start: Array, segments: Sequence[Segment], first: int) -> SegmentsPath:
    poses = _poses(start, *(cast(Array, segment.pose) for segment in segments))
    blends = _blends(np.diff(poses.positions, axis=0), segments, first)
    radii, turns = [blend.radius for blend in blends], _turns(poses.rotations, segments, first)
    path = blended_lines(poses, radii, turns, [_shape(blend, segments[0].law) for blend in blends])
    spans = [span for part, span in zip(path.parts, pairwise(path.ends.tolist()), strict=True) if _is_corner(part)]
    corners = tuple(replace(blend, begin=begin, end=end) for blend, (begin, end) in zip(blends, spans, strict=True))
    ends = (*(0.5 * (begin + end) for begin, end in spans), path.extent)
    return SegmentsPath(path, ends, corners, _zones(corners, segments, path.extent))


def _shape(blend: BlendedCorner, law: Law) -> Array:
    """Return the fly-over's parabola where the blend has an acceleration, or the law lets accelerations jump."""
    return QUARTIC if LAWS[law].keeps_jerk and math.isinf(blend.acceleration) else PARABOLA


def _is_corner(part: Path) -> bool:
    return isinstance(part, PolynomialPath)


def _zones(corners: Sequence[BlendedCorner], segments: Sequence[Segment], extent: float) -> tuple[Zone, ...]:
    own = [
        Zone(corner.begin, corner.end, TipLimits(acceleration=corner.acceleration))
        for corner in corners
        if math.isfinite(corner.acceleration)
    ]
    rows = [_limits_of(segment) for segment in segments]
    if all(np.array_equal(row, rows[0]) for row in rows):
        return tuple(own)
    begins = (0.0, *(corner.begin for corner in corners))
    ends = (*(corner.end for corner in corners), extent)
    lines = zip(begins, ends, segments, strict=True)
    return (*own, *(_zone(*line) for line in lines))


def _limits_of(segment: Segment) -> Array:
    """Return all limits in a row, infinite where there are none."""
    limits, stated = segment.limits, segment.stated_jerk
    own = [limits.joints.ravel(), np.array(astuple(limits.tip)), np.array([np.inf]) if stated is None else stated]
    return np.concatenate(own if limits.torque is None else [*own, limits.torque.most])


def _zone(begin: float, end: float, segment: Segment) -> Zone:
    limits = segment.limits
    return Zone(begin, end, limits.tip, limits.joints, limits.torque, segment.stated_jerk)


def _turns(rotations: Array, segments: Sequence[Segment], first: int) -> Sequence[Turn]:
    """Return the turns from each orientation to the next; `zyz_other` changes the sign of θ."""
    by_axis = [segment.orientation == "axis_angle" for segment in segments]
    if all(by_axis):
        return [axis_angle(*pair) for pair in pairwise(rotations)]
    if any(by_axis):
        reason = "blended lines must all turn by `axis_angle`, or all by ZYZ angles"
        raise InvalidField(f"segments.{first + by_axis.index(not by_axis[0])}.orientation", reason)
    return zyz_turns(rotations, [segment.orientation == "zyz_other" for segment in segments])


def _blends(legs: Array, segments: Sequence[Segment], first: int) -> list[BlendedCorner]:
    lengths = np.linalg.norm(legs, axis=1)
    for i, length in enumerate(lengths):
        if length <= POINT:
            reason = "a line that is blended with another must have a length: its two ends share one position"
            raise InvalidField(f"segments.{first + i}.target", reason)
    speed = min(segment.limits.tip.speed for segment in segments)
    blends: list[BlendedCorner] = []
    for i, segment in enumerate(segments[:-1]):
        given = ("blend_time", "blend_acceleration")
        name = (
            "blend_radius" if segment.blend_radius > 0.0 else next(n for n in given if getattr(segment, n) is not None)
        )
        field = f"segments.{first + i}.{name}"
        blend = _blend(segment, speed, legs[i], legs[i + 1], field)
        refuse_reversal(legs[i], legs[i + 1], field)
        for which, length in ((i, lengths[i]), (i + 1, lengths[i + 1])):
            taken = blend.radius + (blends[-1].radius if blends and which == i else 0.0)
            if taken > length * (1.0 + 1e-12):
                both = " with the blend before" if taken > blend.radius else ""
                reason = (
                    f"segment {first + which} is {length:g} m long, and the blend{both} would take {taken:g} m of it"
                )
                raise InvalidField(field, reason)
        blends.append(blend)
    return blends


def _blend(segment: Segment, speed: float, leg: Array, following: Array, field: str) -> BlendedCorner:
    """Blend a line into the next: the course's fly-over, with both lines at the tip's speed limit v.

    d = v ΔT / 2 and a = ‖v K_BC - v K_AB‖ / ΔT, where ΔT or a is given. Under this limit of acceleration, the fastest
    motion through the parabola is that of the course, with constant acceleration and duration ΔT.
    """
    if segment.blend_radius > 0.0:
        return BlendedCorner(segment.blend_radius)
    if not math.isfinite(speed):
        raise InvalidField(field, "the blend depends on the speed along the lines: `limits.tip_velocity` is missing")
    change = speed * math.hypot(*(following / math.hypot(*following) - leg / math.hypot(*leg)))
    if segment.blend_acceleration is not None:
        acceleration = segment.blend_acceleration
        time = change / acceleration
    else:
        time = cast(float, segment.blend_time)
        acceleration = change / time
    radius = 0.5 * speed * time
    if min(radius, acceleration) <= POINT:
        raise InvalidField(field, f"the blend would be {radius:g} m long: the lines continue straight")
    return BlendedCorner(radius, acceleration)
