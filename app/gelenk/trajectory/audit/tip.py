"""Motion of the tip while the joints move: speeds, accelerations, path deviations and nearness to a singularity.

All quantities are sampled, the more densely the further the joints travel, and refined where parabolas through the
samples reach higher. Those that may jump are sampled at both ends of each piece and between.
"""

from collections.abc import Callable
from dataclasses import dataclass
from typing import TypeAlias

import numpy as np

from gelenk.ik.search.task import FULL_POSE, Task
from gelenk.kinematics.simd.kernels import chain_poses
from gelenk.robot.arrays import Array, Indices
from gelenk.robot.chain import Chain, FlatChain
from gelenk.robot.compilation import compiled
from gelenk.robot.poses import Poses
from gelenk.trajectory.audit.deviations import deviations
from gelenk.trajectory.audit.kernels import smallest_singular_values, tip_rates
from gelenk.trajectory.audit.peaks import ROUNDS, highest, narrowed, promising, tried, triples
from gelenk.trajectory.audit.pieces import Pieces, enough, positions_at, rate_bounds, spread_times, travels, values_at
from gelenk.trajectory.audit.result import SmallestSingularValue

PathOfTime: TypeAlias = Callable[[Array], Poses]
"""The demanded pose T_base_tip at times of shape (N,), [s]."""

MIN_SAMPLES = 1500
"""Samples of the whole motion along a path or within torques; more if there are many pieces."""
_RATE_SAMPLES, _SIGMA_SAMPLES = (100, 20.0, 20_000), (60, 10.0, 20_000)
"""Samples of the tip's rates and of σ: of any motion, for each radian that all joints travel together, and at most."""
_ROUNDING = 1e-12
"""Rounding of path deviations, [m] and [rad], and of the tip's rates, in fractions of the joints' rates."""
_THREE = np.array([-1, 0, 1])

RATES = ("speed", "angular_speed", "acceleration", "angular_acceleration")


@dataclass(frozen=True, slots=True)
class Largest:
    """The largest value of a quantity, and its time [s]."""

    value: float
    time: float


@compiled
def grid(pieces: Pieces, least: int) -> tuple[Indices, Array, Indices]:
    """Sample each piece evenly, both ends and the middle included: at least `least` samples in all.

    Returns the piece and τ of each sample, (N,) each, and which samples have neighbours on both sides in their piece.
    """
    counts = np.maximum(np.ceil(pieces.widths * (least / pieces.widths.sum())), 2).astype(np.int64) + 1
    size, i, k = counts.sum(), 0, 0
    piece, tau, inner = np.empty(size, np.int64), np.empty(size), np.empty(size - 2 * len(counts), np.int64)
    for p in range(len(counts)):
        for within in range(counts[p]):
            piece[i], tau[i] = p, within / (counts[p] - 1)
            if 0 < within < counts[p] - 1:
                inner[k] = i
                k += 1
            i += 1
    return piece, tau, inner


def tip_peaks(pieces: Pieces, chain: Chain) -> dict[str, Largest]:
    """Find the largest value of each of `RATES`, [m/s, rad/s, m/s², rad/s²]."""
    return largest_rates(*found_rate_peaks(chain.flat, pieces))


def largest_rates(values: Array, times: Array) -> dict[str, Largest]:
    """Return values and times of `RATES`, shape (4,) each, by name."""
    return {name: Largest(*found) for name, *found in zip(RATES, values.tolist(), times.tolist(), strict=True)}


@compiled
def found_rate_peaks(flat: FlatChain, pieces: Pieces) -> tuple[Array, Array]:
    """Return what `rate_peaks` does, with enough samples."""
    velocity, acceleration = rate_bounds(pieces)
    found: tuple[Array, Array] = rate_peaks(flat, pieces, rate_samples(travels(pieces)), velocity, acceleration)
    return found


@compiled
def rate_samples(travel: Array) -> int:
    """Return how many samples of the tip's rates are enough for what `travels` returns."""
    return enough(travel, *_RATE_SAMPLES)


@compiled
def rate_peaks(
    flat: FlatChain, pieces: Pieces, least: int, velocity: float, acceleration: float
) -> tuple[Array, Array]:
    """Return the largest value of each of `RATES` and its time, [s], by at least some samples; shape (4,) each.

    No joint is faster than `velocity`, or accelerates more than `acceleration`.
    """
    piece, tau, inner = grid(pieces, least)
    rates, later = tip_rates(flat, pieces, piece, tau), max(acceleration, velocity**2)
    # Of a tip that hardly moves while the joints do.
    rounding = _ROUNDING * np.array([velocity, velocity, later, later])
    rows, columns, tops, exact = promising(tau, rates, inner, rounding)
    places, values, best, where = triples(tau, rates, rows, columns)
    for k in range(ROUNDS if len(rows) else 0):
        at = tried(places, values)
        found = tip_rates(flat, pieces, np.repeat(piece[rows], at.shape[1]), at.ravel())
        of_each = np.empty(at.shape)
        for c in range(len(rows)):
            of_each[c] = found[c * at.shape[1] : (c + 1) * at.shape[1], columns[c]]
        # The first parabola can be right at its vertex, and its vertex still beside the peak.
        if narrowed(places, values, at, of_each, best, where, exact[columns]) and k:
            break
    peaks, times = np.empty(len(tops)), np.empty(len(tops))
    for q in range(len(tops)):
        peaks[q], row, place = rates[tops[q], q], tops[q], tau[tops[q]]
        for c in range(len(rows)):
            if columns[c] == q and best[c] > peaks[q]:
                peaks[q], row, place = best[c], rows[c], where[c]
        times[q] = pieces.starts[piece[row]] + place * pieces.widths[piece[row]]
    return peaks, times


def path_peaks(pieces: Pieces, chain: Chain, path: PathOfTime, task: Task = FULL_POSE) -> dict[str, Largest]:
    """Find the largest deviations from a path, `position` [m] and `orientation` [rad], in the task's directions."""

    def off(piece: Indices, tau: Array) -> Array:
        wanted = path(pieces.times(piece, tau))
        if task != FULL_POSE:
            poses = Poses(*chain_poses(chain.flat, values_at(pieces, piece, tau, 0)))
            errors = task.errors(wanted, poses).T
            return np.ascontiguousarray(np.where(np.isnan(errors), np.inf, errors))
        goals = np.ascontiguousarray(wanted.positions), np.ascontiguousarray(wanted.rotations)
        return _off_path(chain.flat, pieces, piece, tau, *goals)

    piece, tau, inner = grid(pieces, MIN_SAMPLES)
    found = between(tau, piece, inner, off, np.full(2, _ROUNDING))
    return {
        name: Largest(value, float(pieces.starts[piece[row]] + at * pieces.widths[piece[row]]))
        for name, (value, row, at) in zip(("position", "orientation"), found, strict=True)
    }


@compiled
def _off_path(flat: FlatChain, pieces: Pieces, piece: Indices, tau: Array, positions: Array, rotations: Array) -> Array:
    """Return distance [m] and angle [rad] of the tip from wanted poses; shape (N, 2)."""
    tips, turned = chain_poses(flat, values_at(pieces, piece, tau, 0))
    found: Array = deviations(tips, turned, positions, rotations)
    return found


def smallest_singular_value(pieces: Pieces, chain: Chain, task: Task = FULL_POSE) -> SmallestSingularValue:
    """Find the smallest σ of the Jacobian's rows that count along the motion; metres and radians are mixed.

    It is the last of min(m, n), with m rows.
    """
    return SmallestSingularValue(*found_singular_value(chain.flat, pieces, *counted_rows(task)))


def counted_rows(task: Task) -> tuple[Indices, bool]:
    """Return the rows of the Jacobian that count in a task, and whether its rotations are about the tip's axes."""
    return np.flatnonzero(task.weights), task != FULL_POSE


@compiled
def found_singular_value(flat: FlatChain, pieces: Pieces, rows: Indices, about_tip: bool) -> tuple[float, float]:
    """Return what `least_singular_value` does, with enough samples."""
    travel = travels(pieces)
    found: tuple[float, float] = least_singular_value(flat, pieces, rows, about_tip, travel, sigma_samples(travel))
    return found


@compiled
def sigma_samples(travel: Array) -> int:
    """Return how many samples of σ are enough for what `travels` returns."""
    return enough(travel, *_SIGMA_SAMPLES)


@compiled
def least_singular_value(
    flat: FlatChain, pieces: Pieces, rows: Indices, about_tip: bool, travel: Array, least: int
) -> tuple[float, float]:
    """Return the smallest σ of these rows, and its time [s]; like the joints, σ is continuous: one function."""
    times = spread_times(pieces, travel, least)
    negative = np.empty((len(times), 1))
    negative[:, 0] = -smallest_singular_values(flat, positions_at(pieces, times), rows, about_tip)
    near, columns, tops, exact = promising(times, negative, np.arange(1, len(times) - 1), np.zeros(1))
    places, values, best, where = triples(times, negative, near, columns)
    for k in range(ROUNDS if len(near) else 0):
        at = tried(places, values)
        found = smallest_singular_values(flat, positions_at(pieces, at.ravel()), rows, about_tip)
        if narrowed(places, values, at, -found.reshape(at.shape), best, where, exact[columns]) and k:
            break
    value, time = negative[tops[0], 0], times[tops[0]]
    for c in range(len(near)):
        if best[c] > value:
            value, time = best[c], where[c]
    return -value, time


def between(
    places: Array, piece: Indices, inner: Indices, quantities: Callable[[Indices, Array], Array], least: Array
) -> list[tuple[float, int, float]]:
    """Find the largest value of each of Q quantities, also between samples: value, nearest sample, and place.

    `inner` are the samples with neighbours in their piece, `quantities` evaluates values in a piece at a place, (M,)
    each → (M, Q), and `least` are differences that do not matter.
    """
    values = quantities(piece, places)
    rows, columns, tops, exact = promising(places, values, inner, least)
    each = np.arange(len(rows))

    def tried_values(tried: Array) -> Array:
        found = quantities(np.repeat(piece[rows], tried.shape[1]), tried.ravel())
        return found.reshape(*tried.shape, -1)[each, :, columns]

    near = rows[:, None] + _THREE
    peaks, where = highest(tried_values, places[near], values[near, columns[:, None]], exact[columns])
    largest = [(float(values[row, q]), int(row), float(places[row])) for q, row in enumerate(tops)]
    for q, *refined in zip(columns.tolist(), peaks.tolist(), rows.tolist(), where.tolist(), strict=True):
        if refined[0] > largest[q][0]:
            largest[q] = (refined[0], refined[1], refined[2])
    return largest
