"""Paths of lines and arcs whose corners are replaced by polynomials of a parameter.

A smooth corner is the quintic that continues position, tangent and curvature of both legs, and their angular rate with
its derivative; between lines it is of fourth degree. The course's fly-over is a parabola instead: at a constant rate of
the parameter its acceleration is constant.
"""

from collections.abc import Sequence
from dataclasses import dataclass
from itertools import pairwise

import numpy as np

from gelenk.errors import InvalidField
from gelenk.robot.arrays import Array
from gelenk.robot.poses import Poses
from gelenk.trajectory.motion.polynomial import PiecewisePolynomial
from gelenk.trajectory.motion.time_laws import between
from gelenk.trajectory.paths.orientation_paths import AxisAnglePath
from gelenk.trajectory.paths.paths import POINT, CurvePath, Path, PathSamples, PathSequence, Unit, line, refuse_reversal
from gelenk.trajectory.paths.rotation_splines import RotationVectorPath, vector_motion
from gelenk.trajectory.paths.spline_paths import PolynomialPath
from gelenk.trajectory.paths.tracks import Straight


@dataclass(frozen=True, slots=True)
class Stretch:
    """A part of a line or an arc, from a place on it, [m], of a length, [m]."""

    path: CurvePath
    begin: float
    extent: float

    @property
    def unit(self) -> Unit:
        """Always metres."""
        return "m"

    @property
    def breaks(self) -> tuple[float, ...]:
        """Always empty."""
        return ()

    def at(self, s: Array) -> PathSamples:
        """See `Path`."""
        return self.path.at(s + self.begin)

    def flat(self) -> Straight | None:
        """See `CurvePath`."""
        return self.path.flat(self.begin)


def blended_lines(poses: Poses, radii: Sequence[float], *, smooth: bool = False) -> PathSequence:
    """Return a polyline through poses with its corners replaced, turning about one axis on each leg; see `blended`."""
    return blended([line(*Ts) for Ts in pairwise(poses.matrices())], radii, [smooth] * len(radii))


def blended(legs: Sequence[CurvePath], radii: Sequence[float], smooth: Sequence[bool]) -> PathSequence:
    """Return lines and arcs, each beginning where the one before ends, with their corners replaced.

    Position and orientation have continuous first derivatives by s, at smooth corners also second ones. There the path
    passes a corner of lines at three quarters of the parabola's distance.

    Args:
        legs: At least one; each has a length.
        radii: Distance along both legs from each corner at which its polynomial begins and ends, > 0, [m].
        smooth: Of each corner; one with an arc has to be.

    Raises:
        InvalidField: A leg is shorter than the sum of the radii at its ends, or turns back along the previous one.
    """
    cuts = [0.0, *radii, 0.0]
    parts: list[Path] = []
    for i, leg in enumerate(legs):
        taken = cuts[i] + cuts[i + 1]
        if taken > leg.extent * (1.0 + 1e-12) or leg.extent <= POINT:
            reason = f"leg {i} is {leg.extent:g} m long, and its blends take {taken:g} m of it"
            raise InvalidField("blend_radius", reason)
        if i > 0:
            parts.append(_corner(legs[i - 1], leg, cuts[i], smooth=smooth[i - 1]))
        if leg.extent - taken > 1e-12 * leg.extent:
            parts.append(Stretch(leg, cuts[i], leg.extent - taken))
    return PathSequence(tuple(parts))


def _corner(before: CurvePath, after: CurvePath, radius: float, *, smooth: bool) -> PolynomialPath:
    entry, end = (before.at(np.array([s])) for s in (before.extent - radius, before.extent))
    corner, leaving = (after.at(np.array([s])) for s in (0.0, radius))
    refuse_reversal(end.first[0, :3], corner.first[0, :3], "blend_radius")
    place, rotation = corner.poses.positions[0], corner.poses.rotations[0]
    begin, finish = (_by_parameter(one, rotation, 2.0 * radius) for one in (entry, leaving))
    position = between(begin[:, :3], finish[:, :3], 1.0) if smooth else _parabola(begin[0, :3], finish[0, :3], place)
    if not smooth and all(isinstance(leg.orientation, AxisAnglePath) for leg in (before, after)):
        turn = _parabola(begin[0, 3:], finish[0, 3:], np.zeros(3))
    else:
        turn = between(begin[:, 3:], finish[:, 3:], 1.0)
    return PolynomialPath(position, RotationVectorPath(rotation[None], turn))


def _by_parameter(at: PathSamples, rotation: Array, rate: float) -> Array:
    """Return position and rotation vector from an orientation, with two derivatives by u, at ds/du = `rate`; (3, 6)."""
    R, first, second = at.poses.rotations[0], rate * at.first[0], rate**2 * at.second[0]
    turns = vector_motion((rotation.T @ R)[None], (first[3:] @ R)[None], (second[3:] @ R)[None])
    return np.hstack((np.array([at.poses.positions[0], first[:3], second[:3]]), np.concatenate(turns)))


def _parabola(begin: Array, finish: Array, corner: Array) -> PiecewisePolynomial:
    """Return the parabola from one point to another whose tangents at both meet in the corner; shape (3,) each."""
    c = np.array([begin, 2.0 * (corner - begin), begin - 2.0 * corner + finish])
    return PiecewisePolynomial(np.array([0.0, 1.0]), c[None])
