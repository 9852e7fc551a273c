"""The time-independent geometry of a path: derivatives by s of the joints and the tip, and their ratios to limits.

With a time law s(t): q̇ = q' ṡ, q̈ = q' s̈ + q'' ṡ², q⃛ = q' s⃛ + 3 q'' ṡ s̈ + q''' ṡ³, and for the tip's twist ξ = ξ_s ṡ,
ξ̇ = ξ_s s̈ + ξ_s' ṡ². Uniform scaling by k divides the ratio of such a quantity to its limit by k, k² or k³.
"""

from collections.abc import Callable, Sequence
from dataclasses import dataclass, replace
from itertools import pairwise
from typing import Final, TypeAlias, cast

import numpy as np

from gelenk.kinematics.simd.kernels import chain_hessians, chain_jacobians
from gelenk.robot.arrays import Array, Flags, Indices
from gelenk.robot.chain import Chain
from gelenk.robot.compilation import compiled
from gelenk.trajectory.audit.demands import TipLimits, Zone
from gelenk.trajectory.audit.torques import TorqueLimits
from gelenk.trajectory.motion.polynomial import PiecewisePolynomial, cut, derivatives
from gelenk.trajectory.paths.paths import Path
from gelenk.trajectory.problem.problem import SegmentLimits

TipMotion: TypeAlias = Callable[[Array, Array, Array], tuple[Array, Array]]
"""Maps q, q̇ and q̈, shape (N, n) each, to the tip's twist and its time derivative, (N, 6) each, [m/s, rad/s], per s."""

QUANTITIES: Final = (
    "velocity",
    "acceleration",
    "jerk",
    "speed",
    "angular speed",
    "acceleration",
    "angular acceleration",
)
"""Limited quantities: three of the joints, four of the tip."""
ORDERS: Final = np.array([1, 2, 3, 1, 1, 2, 2])
"""Power of k by which uniform scaling divides each quantity."""
JOINTS: Final = 3
"""Number of joint quantities, which come first in `QUANTITIES`."""

_SAME = 1e-9
_CORNER = 1e-7
"""Jump of q', as a fraction of the largest |q'|, that requires a stop; the same as in `time_optimal`."""
_BEND = 1e-6
"""Jump of q'', as a fraction of the largest |q''|, up to which it counts as rounding."""
_NO_LENGTH = 1e-13


def tip_through(chain: Chain) -> TipMotion:
    """Return the function from the joints' motion to the tip's: J q̇, and J q̈ + (∂J/∂q q̇) q̇."""

    def motion(q: Array, velocity: Array, acceleration: Array) -> tuple[Array, Array]:
        J = chain_jacobians(chain.flat, q)[2]
        changes = (chain_hessians(chain.flat, q) @ velocity[:, None, :, None])[..., 0]
        twists, rates = J @ velocity[:, :, None], J @ acceleration[:, :, None] + changes @ velocity[:, :, None]
        return twists[..., 0], rates[..., 0]

    return motion


@dataclass(frozen=True, slots=True)
class Slopes:
    """Derivatives by s at N places of a path.

    Attributes:
        first, second, third: q', q'' and q'''; shape (N, n), [rad or m per unit of s, and so on].
        tip: ξ_s and ξ_s'; shape (2, N, 6); None if the tip has no limits.
        joint_bounds, tip_bounds: Limits, in the order of `QUANTITIES`; shape (N, 3, n) and (N, 4).
    """

    first: Array
    second: Array
    third: Array
    tip: Array | None
    joint_bounds: Array
    tip_bounds: Array

    def take(self, rows: Indices) -> "Slopes":
        """Return the derivatives at some of the places."""
        tip = None if self.tip is None else self.tip[:, rows]
        bounds = self.joint_bounds[rows], self.tip_bounds[rows]
        return Slopes(self.first[rows], self.second[rows], self.third[rows], tip, *bounds)


@dataclass(frozen=True, slots=True)
class LimitedPath:
    """A path with its limits.

    Attributes:
        joints: q(s), whose breaks include those of the tip's path.
        tip_motion: Function from the joints' motion to the tip's; None if the tip has no limits.
        zones: Where there are limits besides; each begins and ends at a break.
    """

    joints: PiecewisePolynomial
    limits: SegmentLimits
    tip_motion: TipMotion | None
    zones: tuple[Zone, ...] = ()

    @property
    def ends(self) -> tuple[float, float]:
        """Values of s at both ends."""
        return float(self.joints.breaks[0]), float(self.joints.breaks[-1])

    @property
    def stands_still(self) -> bool:
        """Whether no joint moves."""
        c, lengths = self.joints.coefficients, np.diff(self.joints.breaks)
        powers = lengths[:, None] ** np.arange(1, c.shape[1])
        travels = np.abs(c[:, 1:] * powers[:, :, None]).sum(axis=1)
        return float(travels.max(initial=0.0)) <= _NO_LENGTH

    @property
    def limits_tip(self) -> bool:
        """Whether the tip has a limit."""
        tips = [self.limits.tip, *(zone.tip for zone in self.zones)]
        if self.tip_motion is None or all(tip == TipLimits() for tip in tips):
            return False
        bounds = self.tip_bounds(np.arange(len(self.joints.breaks) - 1))
        return bool(np.isfinite(bounds).any())

    @property
    def limits_torque(self) -> bool:
        """Whether some joint has a limit of torque somewhere."""
        torques = [self.limits.torque, *(zone.torque for zone in self.zones)]
        return any(torque is not None and torque.is_limited for torque in torques)

    def tip_bounds(self, piece: Indices) -> Array:
        """Return the tip's limits in given pieces, in the order of `QUANTITIES`; shape (N,) → (N, 4)."""
        return self._bounds(piece, tip_row(self.limits.tip), [tip_row(zone.tip) for zone in self.zones])

    def joint_bounds(self, piece: Indices) -> Array:
        """Return the limits of velocity, acceleration and jerk in given pieces; shape (N,) → (N, 3, n)."""
        return self._bounds(piece, self.limits.joints, [zone.joints for zone in self.zones])

    def torque_bounds(self, piece: Indices) -> Array:
        """Return the limits of torque in given pieces, which there have to be; shape (N,) → (N, n)."""
        most = [None if zone.torque is None else zone.torque.most for zone in self.zones]
        return self._bounds(piece, cast(TorqueLimits, self.limits.torque).most, most)

    def _bounds(self, piece: Indices, everywhere: Array, in_zones: Sequence[Array | None]) -> Array:
        bounds = np.broadcast_to(everywhere, (len(piece), *everywhere.shape))
        if any(own is not None for own in in_zones):
            bounds = bounds.copy()
            middles = 0.5 * (self.joints.breaks[piece] + self.joints.breaks[piece + 1])
            for zone, own in zip(self.zones, in_zones, strict=True):
                if own is not None:
                    rows = (middles > zone.begin) & (middles < zone.end)
                    bounds[rows] = np.minimum(bounds[rows], own)
        return bounds

    def piece_of(self, s: Array) -> Indices:
        """Return the index of the piece of q(s) at each place, the later one at a break; shape (N,)."""
        last = len(self.joints.breaks) - 2
        return np.clip(np.searchsorted(self.joints.breaks, s, side="right") - 1, 0, last)

    def at(self, piece: Indices, s: Array) -> Slopes:
        """Return the derivatives at places s; the pieces distinguish the two sides of a break; shape (N,) each."""
        local = (s - self.joints.breaks[piece])[:, None]
        _, first, second, third = derivatives(self.joints.coefficients[piece], local)
        tip = self.tip_at(piece, s) if self.limits_tip else None
        return Slopes(first, second, third, tip, self.joint_bounds(piece), self.tip_bounds(piece))

    def tip_at(self, piece: Indices, s: Array) -> Array:
        """Return ξ_s and ξ_s' of a tip with limits; shape (2, N, 6)."""
        local = (s - self.joints.breaks[piece])[:, None]
        motion = cast(TipMotion, self.tip_motion)
        return np.stack(motion(*derivatives(self.joints.coefficients[piece], local, 2)))

    def samples(self, count: int, least: int) -> tuple[Indices, Array]:
        """Sample about `count` places in order, with at least `least` intervals and both ends of each piece.

        Returns indices of the pieces, and s; shape (N,) each.
        """
        lengths = np.diff(self.joints.breaks)
        piece, within, steps = subdivided(lengths, count, least)
        tau = within / steps
        return piece, np.where(
            tau == 1.0, self.joints.breaks[piece + 1], self.joints.breaks[piece] + tau * lengths[piece]
        )

    def bends(self) -> Array:
        """Return the values of s at which q'' jumps; shape (m,)."""
        (jumps, bend), (_, slope) = _jumps(self.joints, 2), _jumps(self.joints, 1)
        scale = max(bend, _BEND * slope / self.joints.duration)
        return self.joints.breaks[1:-1][jumps > _BEND * scale]

    def parts(self) -> tuple["LimitedPath", ...]:
        """Cut the path where q' jumps, because the motion has to stop there."""
        jumps, scale = _jumps(self.joints, 1)
        inner = 1 + np.flatnonzero(jumps > _CORNER * scale)
        ends = [0, *inner.tolist(), len(self.joints.breaks) - 1]
        return tuple(self._part(begin, end) for begin, end in pairwise(ends))

    def _part(self, begin: int, end: int) -> "LimitedPath":
        joints = PiecewisePolynomial(self.joints.breaks[begin : end + 1], self.joints.coefficients[begin:end])
        return replace(self, joints=joints)


def geometry_of(
    path: Path | None,
    joints: PiecewisePolynomial,
    limits: SegmentLimits,
    tip_motion: TipMotion | None = None,
    zones: tuple[Zone, ...] = (),
) -> LimitedPath:
    """Combine limits with a path of the joints, which is also cut at the breaks of the tip's path and of zones."""
    if path is None and not zones:
        return LimitedPath(joints, limits, tip_motion)
    breaks = joints.breaks
    ends = [end for zone in zones for end in (zone.begin, zone.end)]
    extra = np.array([*(() if path is None else path.breaks), *ends])
    nearest = np.abs(extra[:, None] - breaks).min(axis=1) if len(extra) else extra
    extra = extra[(extra > breaks[0]) & (extra < breaks[-1]) & (nearest > _SAME * (breaks[-1] - breaks[0]))]
    if len(extra):
        nodes = np.union1d(breaks, extra)
        joints = PiecewisePolynomial(nodes, cut(joints, nodes))
    return LimitedPath(joints, limits, tip_motion, zones)


def subdivided(lengths: Array, count: int, least: int) -> tuple[Indices, Indices, Indices]:
    """Divide pieces into about `count` steps in all, at least `least` each.

    Returns for each node, both ends included: its piece, its number within it, and the piece's steps; shape (N,).
    """
    counts = np.maximum(np.ceil(lengths / lengths.sum() * count).astype(np.int64), least) + 1
    piece = np.repeat(np.arange(len(counts)), counts)
    within = np.arange(len(piece)) - np.repeat(np.cumsum(counts) - counts, counts)
    return piece, within, (counts - 1)[piece]


def ratios(slopes: Slopes, speeds: Array, accelerations: Array, jerks: Array) -> Array:
    """Return the ratio of each of `QUANTITIES` to its limit at ṡ, s̈ and s⃛ of shape (N,); (N, 7), 0 without limit."""
    v, a, j = speeds[:, None], accelerations[:, None], jerks[:, None]
    found = np.zeros((len(speeds), len(QUANTITIES)))
    velocity = slopes.first * v
    acceleration = slopes.first * a + slopes.second * v**2
    jerk = slopes.first * j + slopes.second * (3.0 * v * a) + slopes.third * v**3
    for column, values in enumerate((velocity, acceleration, jerk)):
        found[:, column] = np.abs(values / slopes.joint_bounds[:, column]).max(axis=1, initial=0.0)
    if slopes.tip is not None:
        first, second = slopes.tip
        found[:, JOINTS:] = tip_ratios(first * v, first * a + second * v**2, slopes.tip_bounds)
    return found


def tip_ratios(twists: Array, changes: Array, bounds: Array) -> Array:
    """Return the ratio of each of the tip's quantities to its limit; shapes (N, 6), (N, 6) and (N, 4) → (N, 4)."""
    parts = (twists[:, :3], twists[:, 3:], changes[:, :3], changes[:, 3:])
    return np.column_stack([np.sqrt(np.einsum("ni,ni->n", part, part)) for part in parts]) / bounds


def of_order(order: int) -> Flags:
    """Return which of `QUANTITIES` are velocities (1), accelerations (2) or jerks (3); shape (7,)."""
    found: Flags = np.equal(ORDERS, order)
    return found


def tip_row(limits: TipLimits) -> Array:
    """Return the limits of the tip in the order of `QUANTITIES`; shape (4,)."""
    return np.array([limits.speed, limits.angular_speed, limits.acceleration, limits.angular_acceleration])


def _jumps(joints: PiecewisePolynomial, order: int) -> tuple[Array, float]:
    """Return the largest jump of a derivative at each inner break, shape (M - 1,), and its largest magnitude."""
    found: tuple[Array, float] = _jumps_of(np.diff(joints.breaks), np.ascontiguousarray(joints.coefficients), order)
    return found


@compiled
def _jumps_of(widths: Array, c: Array, order: int) -> tuple[Array, float]:
    """Return what `_jumps` does, of pieces of shape (M, d + 1, n)."""
    count, size, n = c.shape
    jumps, scale, last = np.zeros(count - 1), 0.0, np.zeros(n)
    for i in range(count):
        for j in range(n):
            start, end = 0.0, 0.0
            for k in range(size - 1, order - 1, -1):
                factor = 1.0
                for m in range(order):
                    factor *= k - m
                start = factor * c[i, k, j]
                end = end * widths[i] + start
            if i > 0:
                jumps[i - 1] = max(jumps[i - 1], abs(last[j] - start))
            scale, last[j] = max(scale, abs(start), abs(end)), end
    return jumps, scale
