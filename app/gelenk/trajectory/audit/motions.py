"""The audit of a joint motion from rest to rest as a kernel, for batches: the checks of `audit`, in numbers only.

Poses along the motion are recomputed by the caller, through Pinocchio.
"""

import math
from typing import NamedTuple

import numpy as np

from gelenk.ik.search.task import FULL_POSE
from gelenk.robot.arrays import Array, Flags
from gelenk.robot.chain import FlatChain
from gelenk.robot.compilation import compiled
from gelenk.trajectory.audit.pieces import Pieces, extremes_at, largest_jumps, nodes_of, value_at
from gelenk.trajectory.audit.tip import least_singular_value, rate_peaks

TOLERANCE = 1e-9
"""Allowed relative excess over a limit, and the other tolerances of `Demands`."""
TIP_SAMPLES, SIGMA_SAMPLES = 300, 120
"""Samples of the whole motion between which peaks are then searched; the audit of a single motion has more."""
_DIGIT = 10.0
_ROWS = np.arange(len(FULL_POSE))


class MotionLimits(NamedTuple):
    """Limits of a joint motion, ∞ for none.

    Attributes:
        joints: Of velocity, acceleration and jerk; shape (3, n), [rad or m per s, s², s³].
        enforced: Which of these fail the audit; shape (3,).
        lower, upper: Of the position; shape (n,), [rad or m].
        tip: Of the tip's rates, in the order of `RATES`; shape (4,).
        continuous: Order up to which derivatives must not jump.
    """

    joints: Array
    enforced: Flags
    lower: Array
    upper: Array
    tip: Array
    continuous: int


class Sampling(NamedTuple):
    """Where polynomials are sampled, and the factor from samples to a bound, for the position and three derivatives."""

    nodes: tuple[Array, Array, Array, Array]
    factors: tuple[float, float, float, float]


def sampling_of(degree: int) -> Sampling:
    """Return how a motion of a degree is sampled."""
    nodes, factors = zip(*(nodes_of(max(degree - order, 0)) for order in range(4)), strict=True)
    return Sampling(nodes, factors)


class Figures(NamedTuple):
    """What the audit finds.

    Attributes:
        passed: Whether the motion keeps every limit and tolerance.
        ratios: Largest ratio to a joint's limit of velocity, acceleration and jerk; shape (3,).
        margin: Least distance of a joint from its limits, [rad or m]; ∞ without limits.
        tip: Peaks in the order of `RATES`; shape (4,), [m/s, rad/s, m/s², rad/s²].
        sigma: Least singular value of the Jacobian, units mixed.
    """

    passed: bool
    ratios: Array
    margin: float
    tip: Array
    sigma: float


@compiled
def figures(
    flat: FlatChain, pieces: Pieces, start: Array, target: Array, limits: MotionLimits, sampling: Sampling
) -> Figures:
    """Audit a motion that rests at its start and its target, shape (n,) each, [rad or m]."""
    ratios, scales = np.zeros(3), np.ones(4)
    passed = True
    for order in range(3):
        values, _ = extremes_at(pieces, order + 1, True, sampling.nodes[order + 1], sampling.factors[order + 1])
        shares = np.abs(values) / limits.joints[order]
        worst = shares.argmax()
        ratios[order], scales[order + 1] = shares[worst], max(1.0, abs(values[worst]))
        passed &= not limits.enforced[order] or shares[worst] <= 1.0 + TOLERANCE
    for order in range(limits.continuous + 1):
        jumps, _ = largest_jumps(pieces, order)
        passed &= jumps.max() <= _DIGIT**order * TOLERANCE * scales[order]
    margin = _margin(pieces, limits, sampling)
    tip, _ = rate_peaks(flat, pieces, TIP_SAMPLES)
    sigma, _ = least_singular_value(flat, pieces, _ROWS, False, SIGMA_SAMPLES)
    passed &= margin >= -TOLERANCE and _is_at(pieces, start, target, scales[1]) and _slow_enough(tip, limits.tip)
    return Figures(passed, ratios, margin, tip, sigma)


@compiled
def slowdown(flat: FlatChain, pieces: Pieces, limits: Array) -> float:
    """Return in how many times its time the motion keeps limits of the tip, shape (4,); at least 1."""
    peaks, _ = rate_peaks(flat, pieces, TIP_SAMPLES)
    velocity = max(peaks[0] / limits[0], peaks[1] / limits[1])
    factor: float = max(1.0, velocity, math.sqrt(max(peaks[2] / limits[2], peaks[3] / limits[3])))
    return factor


@compiled
def _margin(pieces: Pieces, limits: MotionLimits, sampling: Sampling) -> float:
    nodes, factor = sampling.nodes[0], sampling.factors[0]
    highest, _ = extremes_at(pieces, 0, False, nodes, factor)
    lowest, _ = extremes_at(Pieces(pieces.starts, pieces.widths, -pieces.scaled), 0, False, nodes, factor)
    margin: float = min((limits.upper - highest).min(), (-lowest - limits.lower).min())
    return margin


@compiled
def _is_at(pieces: Pieces, start: Array, target: Array, speed: float) -> bool:
    """Check whether the motion rests at both ends; errors of the velocity are relative to a speed."""
    last, worst = len(pieces.widths) - 1, 0.0
    for j in range(len(start)):
        for piece, tau, wanted in ((0, 0.0, start[j]), (last, 1.0, target[j])):
            worst = max(worst, abs(value_at(pieces, piece, j, tau, 0) - wanted))
            worst = max(worst, abs(value_at(pieces, piece, j, tau, 1)) / speed)
    return worst <= TOLERANCE


@compiled
def _slow_enough(peaks: Array, limits: Array) -> bool:
    return bool((peaks <= limits * (1.0 + TOLERANCE)).all())
