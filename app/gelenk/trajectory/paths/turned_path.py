"""A path of the tip on which the tip also turns about an axis of its own."""

from dataclasses import dataclass

import numpy as np

from gelenk.robot.arrays import Array
from gelenk.robot.notations import rotations_from_vectors
from gelenk.robot.poses import Poses
from gelenk.trajectory.motion.polynomial import PiecewisePolynomial
from gelenk.trajectory.paths.paths import Path, PathSamples, Unit


@dataclass(frozen=True, slots=True)
class TurnedPath:
    """The poses T(s) R(a, θ(s)) along a path T(s), as far as θ(s) reaches.

    Attributes:
        axis: a in the tip's frame, a unit vector; shape (3,).
        angle: θ(s) from s = 0 on, twice continuously differentiable; one column, [rad].
    """

    path: Path
    axis: Array
    angle: PiecewisePolynomial

    @property
    def unit(self) -> Unit:
        """See `Path`."""
        return self.path.unit

    @property
    def extent(self) -> float:
        """See `Path`."""
        return float(self.angle.breaks[-1])

    @property
    def breaks(self) -> tuple[float, ...]:
        """See `Path`."""
        return tuple(s for s in self.path.breaks if s < self.extent)

    def at(self, s: Array) -> PathSamples:
        """See `Path`; with the axis a in the base, ω_s = ω_T + θ' a and ω_s' = ω_T' + θ'' a + θ' ω_T × a."""
        samples = self.path.at(s)
        angles, rates, bends = self.angle.rates_at(s)
        axes = samples.poses.rotations @ self.axis
        rotations = samples.poses.rotations @ rotations_from_vectors(angles * self.axis)
        first, second = samples.first.copy(), samples.second.copy()
        second[:, 3:] += bends * axes + rates * np.cross(first[:, 3:], axes)
        first[:, 3:] += rates * axes
        return PathSamples(Poses(samples.poses.positions, rotations), first, second)
