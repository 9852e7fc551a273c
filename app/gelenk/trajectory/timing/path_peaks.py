"""Largest ratios of a motion along a path to its limits: exact for the joints, from refined samples for the tip."""

from collections.abc import Callable
from dataclasses import dataclass
from typing import TypeAlias, cast

import numpy as np

from gelenk.robot.arrays import Array, Indices
from gelenk.trajectory.motion.extremes import largest_ratio
from gelenk.trajectory.motion.polynomial import PiecewisePolynomial, derivatives
from gelenk.trajectory.paths.path_geometry import (
    JOINTS,
    ORDERS,
    QUANTITIES,
    LimitedPath,
    TipMotion,
    of_order,
    subdivided,
    tip_ratios,
)

Ratios: TypeAlias = Callable[[Indices, Array], Array]
"""Maps pieces and times since their start to the tip's ratios; shape (N,) each → (N, 4)."""

_SAMPLES = 600
_LEAST_SAMPLES = 4
_CANDIDATES = 16
_DOUBT = 1e-2
"""Assumed error of a parabola, as a fraction of the largest sample."""
_ROUNDS = 6
_OFFSETS = np.linspace(0.0, 1.0, 9)


@dataclass(frozen=True, slots=True)
class PathPeaks:
    """Largest ratios of a motion to its limits.

    Attributes:
        ratios: Largest ratio of each of `QUANTITIES`; 0 if it has no limit or is not considered; shape (7,).
        joints: Index of the joint with this ratio, for each of the first three; shape (3,).
    """

    ratios: Array
    joints: Indices

    @property
    def factor(self) -> float:
        """Factor k by which slowing down the motion just reaches some limit; 0 if it stands still."""
        return float(self._factors().max())

    def of_order(self, order: int) -> float:
        """Return the largest ratio of a velocity (1), an acceleration (2) or a jerk (3), of joints and tip."""
        return float(self.ratios[of_order(order)].max())

    def binding(self, geometry: LimitedPath) -> str:
        """Return the limit that is reached first, in words, with its value if it is the same everywhere."""
        i = int(self._factors().argmax())
        tip = geometry.limits.tip
        if i < JOINTS:
            joint = int(self.joints[i])
            whose, value = f"joint {joint + 1}", float(geometry.limits.joints[i, joint])
        else:
            whose = "the tip"
            value = (tip.speed, tip.angular_speed, tip.acceleration, tip.angular_acceleration)[i - JOINTS]
        return f"{whose} reaches its limit of {QUANTITIES[i]}" + ("" if geometry.zones else f", {value:g}")

    def _factors(self) -> Array:
        factors: Array = self.ratios ** (1.0 / ORDERS)
        return factors


def peaks_of(
    geometry: LimitedPath,
    motion: PiecewisePolynomial,
    law: PiecewisePolynomial,
    *,
    with_jerk: bool,
    with_joints: bool = True,
) -> PathPeaks:
    """Compute the largest ratios of a motion q(s(t)), whose breaks include those of the law, to its limits.

    Jerk and the joints are considered if requested, the tip always if it has limits.
    """
    found, joints = np.zeros(len(QUANTITIES)), np.zeros(JOINTS, dtype=np.int64)
    piece = geometry.piece_of(law.at(motion.breaks[:-1] + 0.5 * np.diff(motion.breaks))[:, 0])
    bounds = geometry.joint_bounds(piece)
    for order in range(3 if with_jerk else 2):
        if with_joints:
            found[order], joints[order] = largest_ratio(motion, order + 1, bounds[:, order])
    if geometry.limits_tip:
        found[JOINTS:] = _of_tip(geometry, motion, geometry.tip_bounds(piece))
    return PathPeaks(found, joints)


def _of_tip(geometry: LimitedPath, motion: PiecewisePolynomial, bounds: Array) -> Array:
    widths, tip_motion = np.diff(motion.breaks), cast(TipMotion, geometry.tip_motion)

    def ratios(piece: Indices, local: Array) -> Array:
        rates = derivatives(motion.coefficients[piece], local[:, None], 2)
        return tip_ratios(*tip_motion(*rates), bounds[piece])

    piece, within, steps = subdivided(widths, _SAMPLES, _LEAST_SAMPLES)
    found = ratios(piece, within * widths[piece] / steps)
    largest: Array = found.max(axis=0)
    rows, columns = _promising(found, within, steps)
    if len(rows) == 0:
        return largest
    piece, within, step = piece[rows], within[rows], (widths[piece] / steps)[rows]
    refined = _refined(ratios, piece, columns, (within - 1) * step, (within + 1) * step)
    np.maximum.at(largest, columns, refined)
    return largest


def _refined(ratios: Ratios, piece: Indices, columns: Indices, low: Array, high: Array) -> Array:
    """Find the largest value of a column between two times in a piece, for each of N searches; shape (N,)."""
    each = np.arange(len(piece))
    for _ in range(_ROUNDS):
        local = low[:, None] + (high - low)[:, None] * _OFFSETS
        all_ = ratios(np.repeat(piece, len(_OFFSETS)), local.ravel()).reshape(*local.shape, -1)
        closer = all_[each, :, columns]
        peak = closer.argmax(axis=1)
        low, high = local[each, np.maximum(peak - 1, 0)], local[each, np.minimum(peak + 1, len(_OFFSETS) - 1)]
    result: Array = closer.max(axis=1)
    return result


def _promising(found: Array, within: Indices, steps: Indices) -> tuple[Indices, Indices]:
    """Return rows and columns around which to expect the largest values between samples; shape (N, 4) → (K,) each.

    The parabola through three samples of a piece estimates the maximum between them; one whose vertex is up to one step
    outside counts too, since it may be wrong by that much. If many pieces are at a limit, the samples alone would not
    show which piece exceeds it.
    """
    rows = np.flatnonzero((within > 0) & (within < steps))
    before, at, after = found[rows - 1], found[rows], found[rows + 1]
    slope, bend = 0.5 * (after - before), 2.0 * at - before - after
    rises = (bend > 0.0) & (np.abs(slope) < 2.0 * bend)
    with np.errstate(divide="ignore", invalid="ignore"):
        vertex = np.clip(slope / bend, -1.0, 1.0)
        heights = np.where(rises, at + vertex * (slope - 0.5 * bend * vertex), 0.0)
    chosen = np.argsort(heights, axis=0)[-_CANDIDATES:]
    columns = np.broadcast_to(np.arange(found.shape[1]), chosen.shape)
    is_near = np.take_along_axis(heights, chosen, axis=0) > found.max(axis=0) * (1.0 - _DOUBT)
    return rows[chosen[is_near]], columns[is_near]
