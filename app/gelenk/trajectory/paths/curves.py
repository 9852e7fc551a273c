"""Curves in space by arc length: a straight line, and an arc of a circle through three points.

A curve gives its position p(s), its unit tangent dp/ds, and d²p/ds², whose length is the curvature. It has no time.
"""

import math
from dataclasses import dataclass
from functools import cached_property
from typing import TypeAlias

import numpy as np

from gelenk.errors import InvalidField
from gelenk.robot.arrays import Array
from gelenk.trajectory.paths.sampling import on_line

COLLINEAR = 1e-6
"""Sine of the angle at the via point, or at either end, below which three points count as collinear."""


@dataclass(frozen=True)
class Line:
    """A straight line between points of shape (3,), [m]; with zero length it is a point whose tangent is zero."""

    start: Array
    end: Array

    @cached_property
    def length(self) -> float:
        """‖p_f - p_i‖, [m]."""
        return math.dist(self.start, self.end)

    def at(self, s: Array) -> tuple[Array, Array, Array]:
        """Return position [m], unit tangent and d²p/ds² [1/m] at arc lengths [m]; shape (N,) → three of (N, 3)."""
        return on_line(self.start, self.end, self.length, s)


@dataclass(frozen=True, slots=True)
class Arc:
    """An arc of a circle: p = centre + radius (cos φ x + sin φ y), from φ = 0.

    Attributes:
        centre: Shape (3,), [m].
        x: Unit vector from the centre to the start; shape (3,).
        y: Unit tangent at the start; shape (3,).
        radius: [m].
        angle: Angle of the whole arc, in (0, 2π), [rad].
        via_angle: Angle of the via point, [rad].
    """

    centre: Array
    x: Array
    y: Array
    radius: float
    angle: float
    via_angle: float

    @property
    def length(self) -> float:
        """Radius times angle, [m]."""
        return self.radius * self.angle

    def at(self, s: Array) -> tuple[Array, Array, Array]:
        """See `Line`."""
        cosines, sines = np.cos(s / self.radius)[:, None], np.sin(s / self.radius)[:, None]
        outwards = cosines * self.x + sines * self.y
        return self.centre + self.radius * outwards, cosines * self.y - sines * self.x, -outwards / self.radius


Curve: TypeAlias = Line | Arc


def arc_through(start: Array, via: Array, end: Array) -> Arc:
    """Return the arc through three points, (3,) each, [m]; `InvalidField` if two coincide or all lie on a line."""
    a, b = start - via, end - via
    lengths = math.hypot(*a), math.hypot(*b), math.dist(start, end)
    longest = max(lengths)
    for length, names in zip(lengths, ("start and via", "via and target", "start and target"), strict=True):
        if length <= COLLINEAR * longest or longest == 0.0:
            raise InvalidField("via", f"{names} are the same point: a circle needs three different points")
    normal = np.cross(b, a)
    area = math.hypot(*normal)
    sines = [area / (one * other) for one, other in ((lengths[0], lengths[1]), (lengths[0], lengths[2]))]
    if min(*sines, area / (lengths[1] * lengths[2])) <= COLLINEAR:
        raise InvalidField(
            "via", "start, via and target lie on one line: a circle needs three points that are not collinear"
        )
    normal /= area
    # The circumcentre relative to the via point.
    offset = np.cross(lengths[0] ** 2 * b - lengths[1] ** 2 * a, np.cross(a, b)) / (2.0 * area**2)
    centre = via + offset
    radius = lengths[0] * lengths[1] * lengths[2] / (2.0 * area)
    x = start - centre
    x /= math.hypot(*x)
    y = np.cross(normal, x)
    via_angle, angle = (math.atan2(arm @ y, arm @ x) % (2.0 * math.pi) for arm in (via - centre, end - centre))
    return Arc(centre, x, y, radius, angle, via_angle)
