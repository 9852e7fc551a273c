"""What of a path does not depend on time: the joints' derivatives by s, the tip's, and how near to limits they come.

With a time law s(t): q̇ = q' ṡ, q̈ = q' s̈ + q'' ṡ², q⃛ = q' s⃛ + 3 q'' ṡ s̈ + q''' ṡ³, and of the tip's twist ξ = ξ_s ṡ,
ξ̇ = ξ_s s̈ + ξ_s' ṡ². All in fractions of their limits: uniform scaling by k divides a ratio by k, k² or k³.
"""

from collections.abc import Callable
from dataclasses import dataclass, replace
from itertools import pairwise
from typing import Final, TypeAlias

import numpy as np

from gelenk.kinematics.kernels import chain_hessians, chain_jacobians
from gelenk.model.arrays import Array, Flags, Indices
from gelenk.model.chain import Chain
from gelenk.trajectory.audit_demands import TipLimits
from gelenk.trajectory.composition import derivatives
from gelenk.trajectory.intervals import cut
from gelenk.trajectory.paths import Path
from gelenk.trajectory.polynomial import PiecewisePolynomial
from gelenk.trajectory.problem import MotionLimits

TipMotion: TypeAlias = Callable[[Array, Array, Array], tuple[Array, Array]]
"""Twist and its derivative in time from q, q̇ and q̈, each of shape (N, n); shape (N, 6) both, [m/s, rad/s], per s."""

QUANTITIES: Final = (
    "velocity",
    "acceleration",
    "jerk",
    "speed",
    "angular speed",
    "acceleration",
    "angular acceleration",
)
"""Three of the joints, four of the tip."""
ORDERS: Final = np.array([1, 2, 3, 1, 1, 2, 2])
"""By which power of k each is divided."""
JOINTS: Final = 3
"""How many of them are the joints'."""
ACCELERATION: Final = 2
"""Which of the tip's is its linear acceleration."""

_INSIDE = 1e-9
"""How far inside of a piece its ends are examined where the path may jump, in fractions of the piece."""
_SAME = 1e-9
_CORNER = 1e-7
"""The jump of q', in fractions of the largest, that takes a stop; as for `time_optimal`."""
_BEND = 1e-6
"""The jump of q'', in fractions of the largest, that is no rounding any more."""
_NO_LENGTH = 1e-13


def tip_through(chain: Chain) -> TipMotion:
    """The tip's motion from that of the joints: J q̇, and J q̈ + (∂J/∂q q̇) q̇."""

    def motion(q: Array, velocity: Array, acceleration: Array) -> tuple[Array, Array]:
        J = chain_jacobians(chain.flat, q)[2]
        changes = (chain_hessians(chain.flat, q) @ velocity[:, None, :, None])[..., 0]
        twists, rates = J @ velocity[:, :, None], J @ acceleration[:, :, None] + changes @ velocity[:, :, None]
        return twists[..., 0], rates[..., 0]

    return motion


@dataclass(frozen=True, slots=True)
class Zone:
    """A part of a path on which the tip has limits of its own, beside those that hold everywhere.

    Attributes:
        begin: s at which it begins.
        end: s at which it ends.
        tip: The limits.
    """

    begin: float
    end: float
    tip: TipLimits


@dataclass(frozen=True, slots=True)
class Slopes:
    """Derivatives by s at N places of a path.

    Attributes:
        first: q'; shape (N, n), [rad or m per unit of s].
        second: q''.
        third: q'''.
        tip: ξ_s and ξ_s', None where the tip has no limits; shape (2, N, 6).
        bounds: The tip's limits there, in the order of `QUANTITIES`; shape (N, 4).
    """

    first: Array
    second: Array
    third: Array
    tip: Array | None
    bounds: Array

    def take(self, rows: Indices) -> "Slopes":
        """Some of the places."""
        tip = None if self.tip is None else self.tip[:, rows]
        return Slopes(self.first[rows], self.second[rows], self.third[rows], tip, self.bounds[rows])


@dataclass(frozen=True, slots=True)
class Geometry:
    """A path with its limits.

    Attributes:
        joints: q(s), whose breaks are also those of the path.
        limits: That hold on it.
        path: Of the tip; None where there is none.
        tip_motion: Of the tip through the joints, instead of that along the path; None for the path's.
        zones: Parts of the path where the tip has limits of its own; each begins and ends at a break.
        corners: Where blends of lines begin and end, which are breaks too.
    """

    joints: PiecewisePolynomial
    limits: MotionLimits
    path: Path | None
    tip_motion: TipMotion | None
    zones: tuple[Zone, ...] = ()
    corners: tuple[tuple[float, float], ...] = ()

    @property
    def ends(self) -> tuple[float, float]:
        """The ends of s."""
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
        """Whether the tip has a limit that can be computed."""
        known = self.path is not None or self.tip_motion is not None
        return known and bool(np.isfinite(self.tip_bounds(np.arange(len(self.joints.breaks) - 1))).any())

    def tip_bounds(self, piece: Indices) -> Array:
        """The tip's limits in given pieces, in the order of `QUANTITIES`; shape (N,) → (N, 4)."""
        bounds = np.tile(_of_tip(self.limits.tip), (len(piece), 1))
        middles = 0.5 * (self.joints.breaks[piece] + self.joints.breaks[piece + 1])
        for zone in self.zones:
            rows = (middles > zone.begin) & (middles < zone.end)
            bounds[rows] = np.minimum(bounds[rows], _of_tip(zone.tip))
        return bounds

    def piece_of(self, s: Array) -> Indices:
        """The piece of q(s) that each place is in, the later one at a break; shape (N,)."""
        last = len(self.joints.breaks) - 2
        found: Indices = np.clip(np.searchsorted(self.joints.breaks, s, side="right") - 1, 0, last)
        return found

    def at(self, piece: Indices, s: Array) -> Slopes:
        """The derivatives at places within given pieces, which tell the two sides of a break apart; shape (N,) each."""
        local = (s - self.joints.breaks[piece])[:, None]
        _, first, second, third = derivatives(self.joints.coefficients[piece], local)
        tip = self.tip_at(piece, s) if self.limits_tip else None
        return Slopes(first, second, third, tip, self.tip_bounds(piece))

    def tip_at(self, piece: Indices, s: Array) -> Array:
        """ξ_s and ξ_s', zero where nothing is known of the tip; shape (2, N, 6)."""
        if self.tip_motion is not None:
            local = (s - self.joints.breaks[piece])[:, None]
            return np.stack(self.tip_motion(*derivatives(self.joints.coefficients[piece], local)[:3]))
        return np.zeros((2, len(s), 6)) if self.path is None else np.stack(self.along(self.path, piece, s))

    def along(self, path: Path, piece: Indices, s: Array) -> tuple[Array, Array]:
        """ξ_s and ξ_s' of a path, at the ends of a piece those within it; shape (N, 6) both."""
        begin, end = self.joints.breaks[piece], self.joints.breaks[piece + 1]
        inside = _INSIDE * (end - begin)
        samples = path.at(np.clip(s, begin + inside, end - inside))
        return samples.first, samples.second

    def samples(self, count: int, least: int) -> tuple[Indices, Array]:
        """Places in order, about `count` in all and at least some intervals in each piece, both of its ends among them.

        Returns:
            Pieces and s; shape (N,) each.
        """
        lengths = np.diff(self.joints.breaks)
        counts = np.maximum(np.ceil(lengths / lengths.sum() * count).astype(np.int64), least) + 1
        piece = np.repeat(np.arange(len(counts)), counts)
        within = np.arange(len(piece)) - np.repeat(np.cumsum(counts) - counts, counts)
        tau = within / (counts - 1)[piece]
        return piece, np.where(
            tau == 1.0, self.joints.breaks[piece + 1], self.joints.breaks[piece] + tau * lengths[piece]
        )

    def bends(self) -> Array:
        """The places where q'' jumps; shape (m,)."""
        (jumps, bend), (_, slope) = _jumps(self.joints, 2), _jumps(self.joints, 1)
        scale = max(bend, _BEND * slope / self.joints.duration)
        found: Array = self.joints.breaks[1:-1][jumps > _BEND * scale]
        return found

    def parts(self) -> tuple["Geometry", ...]:
        """The path cut where q' jumps: there it has to stop."""
        jumps, scale = _jumps(self.joints, 1)
        inner = 1 + np.flatnonzero(jumps > _CORNER * scale)
        ends = [0, *inner.tolist(), len(self.joints.breaks) - 1]
        return tuple(self._part(begin, end) for begin, end in pairwise(ends))

    def _part(self, begin: int, end: int) -> "Geometry":
        joints = PiecewisePolynomial(self.joints.breaks[begin : end + 1], self.joints.coefficients[begin:end])
        return replace(self, joints=joints)


def geometry_of(
    path: Path | None,
    joints: PiecewisePolynomial,
    limits: MotionLimits,
    tip_motion: TipMotion | None,
    zones: tuple[Zone, ...] = (),
    corners: tuple[tuple[float, float], ...] = (),
) -> Geometry:
    """A path of the joints that has the breaks of the tip's path too."""
    breaks = joints.breaks
    extra = np.array([] if path is None else path.breaks)
    nearest = np.abs(extra[:, None] - breaks).min(axis=1) if len(extra) else extra
    extra = extra[(extra > breaks[0]) & (extra < breaks[-1]) & (nearest > _SAME * (breaks[-1] - breaks[0]))]
    if len(extra):
        nodes = np.union1d(breaks, extra)
        joints = PiecewisePolynomial(nodes, cut(joints, nodes))
    return Geometry(joints, limits, path, tip_motion, zones, corners)


def ratios(slopes: Slopes, limits: MotionLimits, speeds: Array, accelerations: Array, jerks: Array) -> Array:
    """How near to its limit each of `QUANTITIES` comes at ṡ, s̈ and s⃛ of shape (N,); shape (N, 7), 0 without limit."""
    v, a, j = speeds[:, None], accelerations[:, None], jerks[:, None]
    found = np.zeros((len(speeds), len(QUANTITIES)))
    velocity = slopes.first * v
    acceleration = slopes.first * a + slopes.second * v**2
    jerk = slopes.first * j + slopes.second * (3.0 * v * a) + slopes.third * v**3
    each = zip((velocity, acceleration, jerk), (limits.velocity, limits.acceleration, limits.jerk), strict=True)
    for column, (values, limit) in enumerate(each):
        found[:, column] = np.abs(values / limit).max(axis=1, initial=0.0)
    if slopes.tip is not None:
        first, second = slopes.tip
        found[:, JOINTS:] = tip_ratios(first * v, first * a + second * v**2, slopes.bounds)
    return found


def tip_ratios(twists: Array, changes: Array, bounds: Array) -> Array:
    """How near to its limit each of the tip's quantities comes; shapes (N, 6), (N, 6) and (N, 4) → (N, 4)."""
    parts = (twists[:, :3], twists[:, 3:], changes[:, :3], changes[:, 3:])
    return np.column_stack([np.sqrt(np.einsum("ni,ni->n", part, part)) for part in parts]) / bounds


def of_order(order: int) -> Flags:
    """Which of `QUANTITIES` are velocities (1), accelerations (2) or jerks (3)."""
    found: Flags = np.equal(ORDERS, order)
    return found


def _of_tip(limits: TipLimits) -> Array:
    return np.array([limits.speed, limits.angular_speed, limits.acceleration, limits.angular_acceleration])


def _jumps(joints: PiecewisePolynomial, order: int) -> tuple[Array, float]:
    """The largest jump of a derivative at each inner break, shape (M - 1,), and the derivative's size."""
    c, lengths = joints.coefficients, np.diff(joints.breaks)[:, None]
    before, after = (derivatives(c, local)[order] for local in (lengths, np.zeros_like(lengths)))
    scale = max(float(np.abs(values).max(initial=0.0)) for values in (before, after))
    return np.abs(before[:-1] - after[1:]).max(axis=1, initial=0.0), scale
