"""Paths of the tip, built from a trajectory's segments: lines, circles, splines, and several blended into one."""

import math
from collections.abc import Sequence
from dataclasses import dataclass, replace
from itertools import pairwise
from typing import cast

import numpy as np

from gelenk.errors import InvalidField
from gelenk.robot.arrays import Array
from gelenk.robot.poses import Poses
from gelenk.trajectory.audit.demands import TipLimits, Zone
from gelenk.trajectory.audit.words import OrientationLaw
from gelenk.trajectory.laws.laws import LAWS
from gelenk.trajectory.motion.splines import cubic_spline
from gelenk.trajectory.paths.corners import blended
from gelenk.trajectory.paths.curves import Arc
from gelenk.trajectory.paths.orientation_paths import AxisAnglePath, OrientationPath, axis_angle
from gelenk.trajectory.paths.path_geometry import tip_row
from gelenk.trajectory.paths.paths import POINT, CurvePath, Path, circle, line, refuse_reversal
from gelenk.trajectory.paths.spline_paths import PolynomialPath, SplineBoundary, spline
from gelenk.trajectory.paths.turned_path import TurnedPath
from gelenk.trajectory.paths.zyz_paths import zyz_turns
from gelenk.trajectory.problem.parts import in_field
from gelenk.trajectory.problem.problem import Segment

_WHOLE = 1.0 + 1e-12
_SHARES = np.linspace(0.0, 1.0, 65)
"""Places of a stretch at which its turning is summed up."""


@dataclass(frozen=True, slots=True)
class BlendedCorner:
    """A blend of two lines or arcs.

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
    """A path of the tip through one segment, or through blended ones.

    Attributes:
        ends: s at the end of each segment: the middle of its blend, and `path.extent` for the last.
        zones: Where there are limits of its own: in blends that set one, on segments and the
            blends beside them, and on the way to waypoints.
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
    ways = segments[0].ways
    knots = cast(PolynomialPath, path).knots.tolist() if ways else []
    zones = tuple(_zone(*ends, way) for ends, way in zip(pairwise(knots), ways, strict=True))
    return SegmentsPath(path, (path.extent,), zones=zones, notes=notes)


def is_blended(segment: Segment) -> bool:
    """Return whether a segment is blended into the next, without a stop."""
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
    return _leg(start, segment), ()


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
    legs, Ts = [], _poses(start, *(cast(Array, segment.pose) for segment in segments)).matrices()
    for i, segment in enumerate(segments):
        with in_field(f"segments.{first + i}"):
            legs.append(_leg(Ts[i], segment))
    blends = _blends(legs, segments, first)
    smooth = [_is_smooth(blend, segments[i : i + 2]) for i, blend in enumerate(blends)]
    path = blended(legs, [blend.radius for blend in blends], smooth)
    spans = [span for part, span in zip(path.parts, pairwise(path.ends.tolist()), strict=True) if _is_corner(part)]
    corners = tuple(replace(blend, begin=begin, end=end) for blend, (begin, end) in zip(blends, spans, strict=True))
    ends = (*(0.5 * (begin + end) for begin, end in spans), path.extent)
    return SegmentsPath(path, ends, corners, _zones(corners, segments, path.extent))


def _leg(start: Array, segment: Segment) -> CurvePath:
    """Return the whole line or arc of a segment from a pose."""
    end = cast(Array, segment.pose)
    if segment.type == "line":
        poses = _poses(start, end)
        return line(start, poses.matrices()[1], _turn(poses.rotations, segment.orientation))
    T_start, T_via, T_end = _poses(start, cast(Array, segment.via), end).matrices()
    return circle(T_start, T_via, T_end, segment.orientation)


def _is_smooth(blend: BlendedCorner, beside: Sequence[Segment]) -> bool:
    """Return whether a corner is smooth: at an arc, or if the law keeps jerk, unless an acceleration is given."""
    has_arc = any(segment.type == "circle" for segment in beside)
    return has_arc or (LAWS[beside[0].law].keeps_jerk and math.isinf(blend.acceleration))


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
    own = [limits.joints.ravel(), tip_row(limits.tip), np.array([np.inf]) if stated is None else stated]
    return np.concatenate(own if limits.torque is None else [*own, limits.torque.most])


def _zone(begin: float, end: float, segment: Segment) -> Zone:
    limits = segment.limits
    return Zone(begin, end, limits.tip, limits.joints, limits.torque, segment.stated_jerk)


def _turn(rotations: Array, law: OrientationLaw) -> OrientationPath:
    """Return the turn from one orientation to another; shape (2, 3, 3)."""
    return axis_angle(*rotations) if law == "axis_angle" else zyz_turns(rotations, [law == "zyz_other"])[0]


def _blends(legs: Sequence[CurvePath], segments: Sequence[Segment], first: int) -> list[BlendedCorner]:
    for i, leg in enumerate(legs):
        if leg.curve.length <= POINT:
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
        pair = legs[i], legs[i + 1]
        directions = pair[0].at(np.array([pair[0].extent])).first[0, :3], pair[1].at(np.zeros(1)).first[0, :3]
        blend = _blend(segment, speed, directions, field)
        refuse_reversal(*directions, field)
        before = blends[-1].radius if blends else 0.0
        for number, leg, taken in ((i, pair[0], (before, blend.radius)), (i + 1, pair[1], (blend.radius, 0.0))):
            try:
                _check_room(leg, *taken)
            except InvalidField as error:
                raise InvalidField(field, f"segment {first + number} {error.reason}") from None
        blends.append(blend)
    return blends


def _check_room(leg: CurvePath, begin: float, end: float) -> None:
    """Refuse blends that take more of both ends of a leg, [m], than there is, or than the corners can follow."""
    length = leg.extent
    if begin + end > length * _WHOLE:
        both = " with the blend before" if begin and end else ""
        raise InvalidField("", f"is {length:g} m long, and the blend{both} would take {begin + end:g} m of it")
    if isinstance(leg.curve, Arc):
        via, quarter = leg.curve.radius * leg.curve.via_angle, 0.5 * math.pi * leg.curve.radius
        for taken, room in ((begin, via), (end, length - via)):
            if taken > min(room, quarter) * _WHOLE:
                bounds = f"{room:g} m to its `via`, and a quarter of its circle is {quarter:g} m"
                raise InvalidField("", f"has {bounds}: the blend would take {taken:g} m")
    if not isinstance(leg.orientation, AxisAnglePath):
        for taken, first in ((begin, 0.0), (end, length - end)):
            rates = leg.at(first + taken * _SHARES).first[:, 3:]
            if float(np.linalg.norm(rates, axis=1).mean()) * taken > math.pi:
                raise InvalidField("", f"turns by more than 180° on the {taken:g} m that the blend would take of it")


def _blend(segment: Segment, speed: float, directions: tuple[Array, Array], field: str) -> BlendedCorner:
    """Blend a line into the next: the course's fly-over, with both lines at the tip's speed limit v.

    d = v ΔT / 2 and a = ‖v K_BC - v K_AB‖ / ΔT, where ΔT or a is given. Under this limit of acceleration, the fastest
    motion through the parabola is that of the course, with constant acceleration and duration ΔT.
    """
    if segment.blend_radius > 0.0:
        return BlendedCorner(segment.blend_radius)
    if not math.isfinite(speed):
        raise InvalidField(field, "the blend depends on the speed along the lines: `limits.tip_velocity` is missing")
    change = speed * math.dist(*directions)
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
