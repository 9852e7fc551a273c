"""Paths whose position is a polynomial of a parameter u, reparametrised by arc length: splines and blended corners.

The arc length s(u) = ∫ ‖dp/du‖ du is computed by Gauss quadrature on panels that are halved until the sum no longer
changes, and inverted by Newton's method within a panel (`arc_length`). Derivatives by s follow exactly from those by u.
"""

from collections.abc import Sequence
from dataclasses import dataclass
from functools import cached_property
from itertools import pairwise
from typing import Literal, TypeAlias

import numpy as np

from gelenk.errors import InvalidField
from gelenk.robot.arrays import Array
from gelenk.robot.poses import Poses
from gelenk.trajectory.audit.words import OrientationLaw
from gelenk.trajectory.motion.polynomial import PiecewisePolynomial
from gelenk.trajectory.motion.splines import cubic_spline
from gelenk.trajectory.motion.time_laws import hermite_pieces
from gelenk.trajectory.paths.arc_length import arc_lengths, parameters
from gelenk.trajectory.paths.curves import PARABOLA, Line
from gelenk.trajectory.paths.orientation_paths import AxisAnglePath, OrientationPath, axis_angle
from gelenk.trajectory.paths.paths import (
    POINT,
    CurvePath,
    Path,
    PathSamples,
    PathSequence,
    Unit,
    line,
    refuse_reversal,
    through_orientations,
)
from gelenk.trajectory.paths.rotation_splines import rotation_corner, sizes
from gelenk.trajectory.paths.zyz_paths import ZyzPath, zyz_corner

Turn: TypeAlias = AxisAnglePath | ZyzPath
SplineBoundary: TypeAlias = Literal["natural", "not_a_knot", "periodic"]

_FINEST = 256
"""Number of panels per piece at which halving stops."""
_LENGTH_TOLERANCE = 1e-13
_SLOWEST = 1e-12
"""Fraction of the mean speed below which dp/du counts as zero: a cusp, which has no tangent."""


@dataclass(frozen=True)
class PolynomialPath:
    """A path with p(u), [m], a polynomial on each piece; its orientation's x runs from 0 to 1 over the range of u."""

    position: PiecewisePolynomial
    orientation: OrientationPath

    @property
    def unit(self) -> Unit:
        """Always metres."""
        return "m"

    @property
    def extent(self) -> float:
        """See `Path`."""
        return float(self._table[1][-1])

    @property
    def breaks(self) -> tuple[float, ...]:
        """Always empty: position and orientation have to be smooth in u."""
        return ()

    @property
    def knots(self) -> Array:
        """Values of s at the breaks of the position; shape (M + 1,), [m]."""
        edges, lengths = self._table
        return lengths[np.searchsorted(edges, self.position.breaks)]

    def at(self, s: Array) -> PathSamples:
        """See `Path`."""
        u = self._parameters(s)
        width = self.position.duration
        x = np.minimum(np.maximum((u - self.position.breaks[0]) / width, 0.0), 1.0)
        positions, first, second = self.position.rates_at(u)
        rotations, rates, changes = self.orientation.at(x)
        rates, changes = rates / width, changes / width**2
        speeds = sizes(first)[:, None]
        tangents = first / np.maximum(speeds, np.finfo(float).tiny)
        growth = np.einsum("ij,ij->i", tangents, second)[:, None]
        by_s = np.hstack((tangents, rates / speeds))
        bends = np.hstack((second - growth * tangents, changes - growth * rates / speeds)) / speeds**2
        return PathSamples(Poses(positions, rotations), by_s, bends)

    @cached_property
    def _table(self) -> tuple[Array, Array]:
        """Edges of the panels in u, and the arc length up to each edge; shape (P + 1,) each."""
        panels, before = 8, np.inf
        while True:
            shares = np.linspace(0.0, 1.0, panels, endpoint=False)
            breaks = self.position.breaks
            edges = np.append((breaks[:-1, None] + shares * np.diff(breaks)[:, None]).ravel(), breaks[-1])
            lengths = self._lengths(edges[:-1], edges[1:])
            total = float(lengths.sum())
            if abs(total - before) <= _LENGTH_TOLERANCE * total or panels >= _FINEST:
                return edges, np.concatenate(([0.0], np.cumsum(lengths)))
            panels, before = 2 * panels, total

    def _lengths(self, begin: Array, finish: Array) -> Array:
        """Return the arc lengths between pairs of u that are close together; shape (N,), [m]."""
        return arc_lengths(*self._slopes, begin, finish)

    @cached_property
    def _slopes(self) -> tuple[Array, Array]:
        """Breaks and coefficients of dp/du, as kernels take them."""
        return np.ascontiguousarray(self._velocity.breaks), np.ascontiguousarray(self._velocity.coefficients)

    @cached_property
    def _velocity(self) -> PiecewisePolynomial:
        return self.position.derivative()

    def _speeds(self, u: Array) -> Array:
        return sizes(self._velocity.at(u))

    @cached_property
    def _inverse(self) -> PiecewisePolynomial:
        """Approximation of u(s): quintics with its value and two derivatives at the edges of the panels."""
        edges, lengths = self._table
        _, first, second = self.position.rates_at(edges)
        slopes = 1.0 / np.maximum(sizes(first), np.finfo(float).tiny)
        bends = -np.einsum("ij,ij->i", first, second) * slopes**4
        ends = np.stack((edges, slopes, bends))[:, :, None]
        return PiecewisePolynomial(lengths, hermite_pieces(ends[:, :-1], ends[:, 1:], np.diff(lengths)))

    def _parameters(self, s: Array) -> Array:
        s = np.ascontiguousarray(s)
        return parameters(*self._slopes, *self._table, s, self._inverse.at(s)[:, 0].copy())


def spline(
    waypoints: Poses, boundary: SplineBoundary = "natural", orientation: OrientationLaw = "axis_angle"
) -> PolynomialPath:
    """Return a smooth path through poses: C² in position and in orientation, parametrised by chord length.

    The boundary condition is that of the cubic spline of positions; a clamped one would have no tangent at its ends.
    With `periodic` the positions close smoothly, but the orientations do not. The law of orientations is that of
    `through_orientations`.

    Raises:
        InvalidField: There are fewer than two poses, successive ones share a position, the ends of a periodic path
            differ, or the path has a cusp.
    """
    if len(waypoints) < 2:
        raise InvalidField("waypoints", "a spline needs at least two poses, including the start")
    chords = np.linalg.norm(np.diff(waypoints.positions, axis=0), axis=1)
    if (chords <= POINT).any():
        first = int(np.argmin(chords > POINT))
        reason = f"poses {first} and {first + 1} share one position: a spline does not stop to turn; a line does"
        raise InvalidField("waypoints", reason)
    knots = np.concatenate(([0.0], np.cumsum(chords)))
    curve = cubic_spline(knots, waypoints.positions, boundary).motion
    path = PolynomialPath(curve, through_orientations(waypoints.rotations, knots / knots[-1], orientation))
    speeds = path._speeds(path._table[0])
    if speeds.min() <= _SLOWEST * speeds.mean():
        raise InvalidField("waypoints", "the spline turns back on the spot at a waypoint, where it has no tangent")
    return path


def blended_lines(
    poses: Poses,
    radii: Sequence[float],
    turns: Sequence[Turn] | None = None,
    shapes: Sequence[Array] | None = None,
) -> PathSequence:
    """Return a polyline through poses whose corners are replaced by polynomials of a parameter.

    If the parameter of a parabola advances at a constant rate, it is the fly-over with equal speeds. Position and
    orientation have continuous first derivatives by s; second derivatives jump where a parabola begins or ends, and are
    continuous with a quartic, which passes the corner at three quarters of the parabola's distance.
    `InvalidField` if a leg is shorter than the sum of the radii at its ends, or turns back along the previous one.

    Args:
        poses: At least two poses; successive ones differ in position.
        radii: Distance from each inner pose at which its parabola begins and ends, > 0, [m].
        turns: Turns from each pose to the next, each beginning where the previous one ends, all about axes or all by
            ZYZ angles; by default each about one axis.
        shapes: Of each corner, `PARABOLA` or `QUARTIC`; parabolas by default.
    """
    Ts = poses.matrices()
    if turns is None:
        turns = [axis_angle(*pair) for pair in pairwise(poses.rotations)]
    legs = [line(Ts[i], Ts[i + 1], turn) for i, turn in enumerate(turns)]
    cuts = [0.0, *radii, 0.0]
    parts: list[Path] = []
    for i, leg in enumerate(legs):
        taken = cuts[i] + cuts[i + 1]
        if taken > leg.curve.length * (1.0 + 1e-12) or leg.curve.length <= POINT:
            raise InvalidField(
                "blend_radius", f"leg {i} is {leg.curve.length:g} m long, and its blends take {taken:g} m of it"
            )
        if i > 0:
            a, b = (legs[k].curve.at(np.zeros(1))[1][0] for k in (i - 1, i))
            refuse_reversal(a, b, "blend_radius")
            shape = PARABOLA if shapes is None else shapes[i - 1]
            parts.append(_corner(legs[i - 1 : i + 1], turns[i - 1 : i + 1], cuts[i], shape))
        begin, finish = cuts[i] / leg.curve.length, 1.0 - cuts[i + 1] / leg.curve.length
        if finish - begin > 1e-12:
            ends = leg.curve.at(np.array([begin, finish]) * leg.curve.length)[0]
            parts.append(CurvePath(Line(ends[0], ends[1]), turns[i].part(begin, finish)))
    return PathSequence(tuple(parts))


def _corner(legs: Sequence[CurvePath], turns: Sequence[Turn], radius: float, weights: Array) -> PolynomialPath:
    """Return the corner between two legs, p(u) = p_B - A(u) a + B(u) b, with the orientation blended likewise."""
    before, after = legs
    a = radius * before.curve.at(np.array([before.curve.length]))[1][0]
    corner, directions, _ = after.curve.at(np.array([0.0]))
    c = weights.T @ np.array([-a, radius * directions[0]])
    c[0] += corner[0]
    turn = _turn_over(turns, 1.0 - radius / before.curve.length, radius / after.curve.length, weights)
    return PolynomialPath(PiecewisePolynomial(np.array([0.0, 1.0]), c[None]), turn)


def _turn_over(turns: Sequence[Turn], entry: float, leaving: float, weights: Array) -> OrientationPath:
    """Return the turn over the corner of two turns, from x = `entry` on the first to x = `leaving` on the second."""
    before, after = turns
    if isinstance(before, ZyzPath) and isinstance(after, ZyzPath):
        return zyz_corner(before.triple_at(entry), after.triple_at(0.0), after.triple_at(leaving), weights)
    at_entry, (at_corner, at_leaving) = before.at(np.array([entry]))[0][0], after.at(np.array([0.0, leaving]))[0]
    return rotation_corner(at_entry, at_corner, at_leaving, weights)
