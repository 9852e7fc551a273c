"""Bodies for a maker's arm that is a table: a pedestal, a housing around each joint's axis, and arms between these.

A table says where axes are, not what is built around them. So these solids are no robot's shape, but of a plausible
thickness: the housing at the shoulder has a radius that follows from the arm's length and its payload, and those
towards the wrist are thinner. Along a table's lengths an arm has, per joint i, three points in frame `base` at zero:
`foot`, where the common normal of the axis before ends on axis i; `elbow`, where the one to the next axis begins; and
the foot on that next axis.
"""

import math
from collections.abc import Mapping, Sequence
from dataclasses import dataclass, replace
from itertools import accumulate, pairwise

import numpy as np

from gelenk.robot.appearance import Solid
from gelenk.robot.arrays import Array
from gelenk.robot.chain import rotation_to_axis
from gelenk.robot.dh import DhTable, about_z

_PER_LENGTH = 0.03
"""Radius of the shoulder's housing per length of the arm: the part for its own weight."""
_PER_MOMENT = 0.025
"""And per cube root of payload · length [m/(kg m)^⅓]: a tube holds a moment that grows as the cube of its radius."""
_LIMITS = (0.06, 0.12)
"""Least and greatest radius of the shoulder's housing per length of the arm."""
_UNKNOWN = 0.075
"""That of an arm whose payload is unknown."""
_FIRST = 1.08
"""Radius of the housing below the shoulder's, relative to that."""
_TAPER = 0.5
"""By how much thinner the last housing is than the shoulder's."""
_TUBE = 0.74
"""Radius of an arm between two housings, of the smaller one's."""
_CUT = 0.75
"""An arm ends at this share of the next housing's extent, so that it does not touch what comes after it."""
_LAST = 0.6
"""Length of the last housing, of those before it: relative to twice its radius."""
_LEAST = 1e-3
"""Least length of a solid, [m]."""


@dataclass(frozen=True, slots=True)
class _Housing:
    """A cylinder about a joint's axis: centre (3,) and unit axis (3,) in frame `base`, radius and length [m]."""

    centre: Array
    axis: Array
    radius: float
    length: float

    def extent(self, way: Array) -> float:
        """How far it reaches from its centre along a unit vector, [m]."""
        along = abs(float(self.axis @ way))
        return self.radius * math.sqrt(max(0.0, 1.0 - along**2)) + 0.5 * self.length * along

    def solid(self) -> Solid:
        return _cylinder(self.centre, self.axis, self.radius, self.length)


def can_be_housed(table: DhTable) -> bool:
    """Whether a table is one of an arm with at least two joints that all turn, and some length."""
    turns = all(row.type == "revolute" and row.mimic is None for row in table.joints)
    return turns and len(table.joints) > 1 and sum(_ways(_points(table), _tip(table))) > _LEAST


def housed_bodies(table: DhTable, payload: float | None) -> Mapping[str, list[Solid]]:
    """Return the solids of `base` and of each link, in the frame of the link; `payload` [kg] if it is known."""
    frames, points, tip = _frames(table), _points(table), _tip(table)
    housings, pedestal = _housings(points, tip, _radii(_ways(points, tip), payload))
    bodies = {"base": pedestal, "frame_0": []}
    for i, (row, housing) in enumerate(zip(table.joints, housings, strict=True)):
        after = housings[i + 1] if i + 1 < len(housings) else None
        solids = [housing.solid(), *_arms(points[i], housing, after, tip)]
        at = frames[i] @ about_z(row.theta, row.d) if table.convention == "standard" else frames[i + 1]
        back = np.linalg.inv(at).astype(float)
        bodies[f"link_{i + 1}"] = [_moved(solid, back) for solid in solids]
    return bodies


def _frames(table: DhTable) -> list[Array]:
    return table.frames([0.0] * len(table.variables))


def _tip(table: DhTable) -> Array:
    tip: Array = (_frames(table)[-1] @ table.tool)[:3, 3]
    return tip


@dataclass(frozen=True, slots=True)
class _Points:
    """Of one joint: its unit axis, `foot`, `elbow` and the foot on the next axis; each (3,)."""

    axis: Array
    foot: Array
    elbow: Array
    end: Array


def _points(table: DhTable) -> list[_Points]:
    standard, frames = table.convention == "standard", _frames(table)
    feet = [
        before[:3, 3] + (0.0 if standard else row.a) * before[:3, 0]
        for row, before in zip(table.joints, frames, strict=False)
    ]
    found = []
    for i, (row, foot, end) in enumerate(zip(table.joints, feet, [*feet[1:], frames[-1][:3, 3]], strict=True)):
        axis = frames[i if standard else i + 1][:3, 2]
        found.append(_Points(axis, foot, foot + row.d * axis, end))
    return found


def _ways(points: Sequence[_Points], tip: Array) -> list[float]:
    """Length of each link from the shoulder on, along the table's lengths and to the tip, [m]."""
    ways = [float(np.linalg.norm(p.elbow - p.foot) + np.linalg.norm(p.end - p.elbow)) for p in points[1:]]
    return [*ways[:-1], ways[-1] + float(np.linalg.norm(tip - points[-1].end))]


def _radii(ways: Sequence[float], payload: float | None) -> list[float]:
    """Return the radius of each housing, [m]."""
    length = sum(ways)
    share = _UNKNOWN
    if payload is not None:
        share = _PER_LENGTH + _PER_MOMENT * math.cbrt(payload * length) / length
    shoulder = length * min(max(share, _LIMITS[0]), _LIMITS[1])
    passed = accumulate(ways[:-1], initial=0.0)
    return [_FIRST * shoulder, *(shoulder * (1.0 - _TAPER * way / length) for way in passed)]


def _housings(points: Sequence[_Points], tip: Array, radii: Sequence[float]) -> tuple[list[_Housing], list[Solid]]:
    """Return the housings, and the pedestal below the first."""
    first, pedestal = _first(points[0], radii[0], radii[1])
    housings = [first]
    for i, (point, radius) in enumerate(zip(points[1:], radii[1:], strict=True), start=1):
        is_last = i == len(points) - 1
        housing = _Housing(point.foot, point.axis, radius, (_LAST if is_last else 1.0) * 2.0 * radius)
        ahead = float(((tip if is_last else point.elbow) - point.foot) @ point.axis)
        can_be_moved = i > 1 and (abs(ahead) > _LEAST or is_last)
        housings.append(_beyond(housings[-1], housing, math.copysign(1.0, ahead)) if can_be_moved else housing)
    return housings, pedestal


def _beyond(before: _Housing, housing: _Housing, sense: float) -> _Housing:
    """Move a housing along its axis to where the one before ends, if both would be in one place."""
    way = housing.centre - before.centre
    if np.linalg.norm(way) >= 0.8 * (before.radius + housing.radius):
        return housing
    along = sense * housing.axis
    shift = before.extent(along) + 0.5 * housing.length - float(way @ along)
    return replace(housing, centre=housing.centre + max(0.0, shift) * along)


def _first(point: _Points, radius: float, shoulder: float) -> tuple[_Housing, list[Solid]]:
    """Return the first housing, below the shoulder's, and the pedestal below it, from where the axis begins.

    `radius` and `shoulder` are those of both housings. If the shoulder is too low for both, they begin further down.
    """
    rise = float((point.elbow - point.foot) @ point.axis)
    up = point.axis if rise > 0.0 or (rise == 0.0 and point.axis[2] >= 0.0) else -point.axis
    room = abs(rise) - 0.9 * shoulder
    top = min(0.45 * room, room - 0.6 * radius)
    bottom = min(0.0, top - 0.5 * radius)
    height = max(room - top, 0.6 * radius)
    plate = 0.2 * (top - bottom)
    pedestal = [
        _cylinder(point.foot + 0.5 * (top + bottom) * up, point.axis, 0.97 * radius, top - bottom),
        _cylinder(point.foot + (bottom + 0.5 * plate) * up, point.axis, 1.3 * radius, plate),
    ]
    return _Housing(point.foot + (top + 0.5 * height) * up, point.axis, radius, height), pedestal


def _arms(point: _Points, housing: _Housing, after: _Housing | None, tip: Array) -> list[Solid]:
    """Return the arms of a link: along its axis, along the common normal, and on to the next housing or the flange."""
    radius = _TUBE * min(housing.radius, after.radius if after else housing.radius)
    stops, is_cut = [housing.centre, point.elbow, point.end], False
    if after is None:
        stops.append(tip)
    elif (apart := float(np.linalg.norm(after.centre - point.end))) > _LEAST:
        stops.append(after.centre - 0.5 * after.length / apart * (after.centre - point.end))
    else:
        is_cut = True
    legs = [(start, end - start) for start, end in pairwise(stops) if np.linalg.norm(end - start) > _LEAST]
    solids = []
    for i, (start, leg) in enumerate(legs):
        length = float(np.linalg.norm(leg))
        way = leg / length
        if i + 1 < len(legs):
            bends = abs(float(way @ legs[i + 1][1])) < 0.5 * float(np.linalg.norm(legs[i + 1][1]))
            length += radius if bends else 0.0  # fills the corner
        elif is_cut and after is not None:
            length -= _CUT * after.extent(way)
        if length > _LEAST:
            solids.append(_cylinder(start + 0.5 * length * way, way, radius, length))
    if after is None:
        plate = 0.2 * housing.radius
        solids.append(_cylinder(tip - 0.5 * plate * housing.axis, housing.axis, 0.8 * housing.radius, plate))
    return solids


def _cylinder(centre: Array, axis: Array, radius: float, length: float) -> Solid:
    x, y, z = (float(value) for value in axis / np.linalg.norm(axis))
    return Solid("cylinder", (radius, length), centre, rotation_to_axis((x, y, z)))


def _moved(solid: Solid, T: Array) -> Solid:
    return replace(solid, centre=T[:3, :3] @ solid.centre + T[:3, 3], rotation=T[:3, :3] @ solid.rotation)
