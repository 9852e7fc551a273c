"""The audit of a joint motion from rest to rest as a kernel, for batches: the checks of `audit`, in numbers only.

Poses along the motion are recomputed by the caller, through Pinocchio.
"""

import math
from typing import NamedTuple

import numpy as np

from gelenk.robot.arrays import Array, Flags
from gelenk.robot.compilation import compiled
from gelenk.trajectory.audit.joints import JointFigures, joint_figures
from gelenk.trajectory.audit.pieces import Pieces, value_at

TOLERANCE = 1e-9
"""Allowed relative excess over a limit, and the other tolerances of `Demands`."""
TIP_SAMPLES, SIGMA_SAMPLES = 300, 120
"""Samples of the whole motion between which peaks are then searched; the audit of a single motion has more."""
_DIGIT = 10.0


class BatchLimits(NamedTuple):
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


class Figures(NamedTuple):
    """What the audit finds.

    Attributes:
        passed: Whether the motion keeps every limit and tolerance.
        ratios: Largest ratio to a joint's limit of velocity, acceleration and jerk; shape (3,).
        margin: Least distance of a joint from its limits, [rad or m]; ∞ without limits.
    """

    passed: bool
    ratios: Array
    margin: float


@compiled
def figures(pieces: Pieces, start: Array, target: Array, tip: Array, limits: BatchLimits) -> Figures:
    """Audit a motion that rests at its start and its target, (n,) each, [rad or m], from the peaks of the tip, (4,)."""
    joints, ratios, scales = joint_figures(pieces), np.zeros(3), np.ones(4)
    passed = bool((tip <= limits.tip * (1.0 + TOLERANCE)).all())
    for order in range(3):
        values = joints.extremes[order + 2]
        shares = np.abs(values) / limits.joints[order]
        worst = shares.argmax()
        ratios[order], scales[order + 1] = shares[worst], max(1.0, abs(values[worst]))
        passed &= not limits.enforced[order] or shares[worst] <= 1.0 + TOLERANCE
    for order in range(limits.continuous + 1):
        passed &= joints.jumps[order].max() <= _DIGIT**order * TOLERANCE * scales[order]
    margin = _margin(joints, limits)
    return Figures(passed and margin >= -TOLERANCE and _is_at(pieces, start, target, scales[1]), ratios, margin)


@compiled
def slowdown(tip: Array, limits: Array) -> float:
    """Return in how many times its time a motion with these peaks of the tip keeps their limits, at least 1."""
    velocity = max(tip[0] / limits[0], tip[1] / limits[1])
    factor: float = max(1.0, velocity, math.sqrt(max(tip[2] / limits[2], tip[3] / limits[3])))
    return factor


@compiled
def _margin(joints: JointFigures, limits: BatchLimits) -> float:
    lowest, highest = -joints.extremes[0], joints.extremes[1]
    margin: float = min((limits.upper - highest).min(), (lowest - limits.lower).min())
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
