"""Paths whose position is a polynomial of a parameter u, reparametrised by arc length: splines; `corners` has more.

The arc length s(u) = ∫ ‖dp/du‖ du is computed by Gauss quadrature on panels that are halved until the sum no longer
changes, and inverted by Newton's method within a panel (`arc_length`). Derivatives by s follow exactly from those by u.
"""

from dataclasses import dataclass
from functools import cached_property
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
from gelenk.trajectory.paths.orientation_paths import OrientationPath
from gelenk.trajectory.paths.paths import POINT, PathSamples, Unit, through_orientations
from gelenk.trajectory.paths.rotation_splines import RotationVectorPath, sizes
from gelenk.trajectory.paths.sampling import by_arc_length
from gelenk.trajectory.paths.tracks import Curve, on_curve

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
        if (curve := self.flat()) is not None:
            return PathSamples.of(on_curve(curve, np.ascontiguousarray(s)))
        u = self._parameters(s)
        width = self.position.duration
        x = np.minimum(np.maximum((u - self.position.breaks[0]) / width, 0.0), 1.0)
        positions, velocities, bends = self.position.rates_at(u)
        rotations, turns, changes = self.orientation.at(x)
        first, second = by_arc_length(velocities, bends, turns, changes, width)
        return PathSamples(Poses(positions, rotations), first, second)

    def flat(self) -> Curve | None:
        """Return the path as kernels take it; None with an orientation that is not given by rotation vectors."""
        return self._curve

    @cached_property
    def _curve(self) -> Curve | None:
        position, turn = self.position, self.orientation
        if not isinstance(turn, RotationVectorPath):
            return None
        vectors, starts = turn.vectors, np.ascontiguousarray(turn.starts)
        curve = np.ascontiguousarray(position.breaks), np.ascontiguousarray(position.coefficients)
        turns = np.ascontiguousarray(vectors.breaks), np.ascontiguousarray(vectors.coefficients)
        return Curve(*curve, *self._table, self._inverse.coefficients, starts, *turns)

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
