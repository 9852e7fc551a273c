"""Motion of the tip while the joints move: speeds, accelerations, path deviations and nearness to a singularity.

All quantities are sampled densely, including both ends of each piece, and refined where parabolas through the samples
reach higher. The acceleration J q̈ + J̇ q̇ takes J̇ q̇ from differences of J along the motion.
"""

from collections.abc import Callable
from dataclasses import dataclass
from typing import TypeAlias, cast

import numpy as np

from gelenk.ik.search.task import FULL_POSE, Task
from gelenk.kinematics.simd.kernels import chain_jacobians, chain_poses
from gelenk.robot.arrays import Array, Indices
from gelenk.robot.chain import Chain
from gelenk.robot.poses import Poses
from gelenk.trajectory.audit.peaks import highest, promising
from gelenk.trajectory.audit.pieces import Pieces
from gelenk.trajectory.audit.result import SmallestSingularValue

PathOfTime: TypeAlias = Callable[[Array], Poses]
"""The demanded pose T_base_tip at times of shape (N,), [s]."""

MIN_SAMPLES = 1500
"""Samples of the whole motion; more if there are many pieces."""
_SIGMA_SAMPLES = 400
_CHUNK = 1024
_STEP = 1e-3
"""Motion of the fastest joint in one difference of the Jacobian, [rad or m]."""
_PLACES = (-2.0, -1.0, 1.0, 2.0)
_STENCIL = np.array([1.0, -8.0, 8.0, -1.0]) / 12.0
"""Weights of a central difference of fourth order at `_PLACES`."""

_EXACT = 1e-12
"""Relative accuracy of a peak."""
_ROUNDING = 1e-12
"""Rounding of path deviations, [m] and [rad], and of the tip's rates, in fractions of the joints' rates."""

_ENDS = np.array([0.0, 0.5, 1.0])

QUANTITIES = ("speed", "angular_speed", "acceleration", "angular_acceleration", "position", "orientation")


@dataclass(frozen=True, slots=True)
class Largest:
    """The largest value of a quantity, and its time [s]."""

    value: float
    time: float


def grid(pieces: Pieces, least: int = MIN_SAMPLES, intervals: int = 2) -> tuple[Indices, Array, Indices]:
    """Sample each piece evenly, ends included: at least `least` samples in all, and `intervals` intervals per piece.

    Returns the piece and τ of each sample, (N,) each, and which samples have neighbours on both sides in their piece.
    """
    shares = pieces.widths / pieces.widths.sum()
    counts = np.maximum(np.ceil(shares * least).astype(np.int64), intervals) + 1
    piece = np.repeat(np.arange(len(counts)), counts)
    within = np.arange(len(piece)) - np.repeat(np.cumsum(counts) - counts, counts)
    last = (counts - 1)[piece]
    return piece, within / last, np.flatnonzero((within > 0) & (within < last))


def tip_peaks(
    pieces: Pieces, chain: Chain, path: PathOfTime | None, task: Task = FULL_POSE, least: int = MIN_SAMPLES
) -> dict[str, Largest]:
    """Find the largest value of each of `QUANTITIES`, the last two only with a path; [m/s, rad/s, …, m, rad].

    Only the task's directions count for the path; at least `least` samples are examined.
    """
    names = QUANTITIES if path is not None else QUANTITIES[:4]

    def quantities(piece: Indices, tau: Array) -> Array:
        qs, velocities, accelerations = pieces.rates(piece, tau)
        positions, rotations, Js = chain_jacobians(chain.flat, qs)
        columns = _tip_motion(chain, qs, velocities, accelerations, Js)
        if path is not None:
            columns += _deviations(Poses(positions, rotations), path(pieces.times(piece, tau)), task)
        # Where the path has no pose, the deviation is infinite.
        return np.nan_to_num(np.column_stack(columns), nan=np.inf)

    piece, taus, inner = grid(pieces, least)
    values = np.concatenate([quantities(piece[rows], taus[rows]) for rows in _chunks(len(taus))])
    found = _between(taus, values, inner, piece, quantities, _rounding(pieces)[: len(names)])
    return {
        name: Largest(value, float(pieces.times(piece[[row]], np.array([tau]))[0]))
        for name, (value, row, tau) in zip(names, found, strict=True)
    }


def smallest_singular_value(pieces: Pieces, chain: Chain, task: Task = FULL_POSE) -> SmallestSingularValue:
    """Find the smallest σ of the Jacobian's rows that count along the motion; metres and radians are mixed.

    It is the last of min(m, n), with m rows. Eigenvalues of J Jᵀ (or Jᵀ J if smaller) locate it, an SVD of J gives it.
    """
    rows = np.flatnonzero(task.weights)

    def jacobians(times: Array) -> Array:
        _, rotations, Js = chain_jacobians(chain.flat, pieces.positions(times))
        if task == FULL_POSE:
            return Js
        # The task's rotations are about the tip's axes.
        turned = np.concatenate((Js[:, :3], rotations.transpose(0, 2, 1) @ Js[:, 3:]), axis=1)
        return turned[:, rows]

    def exact(_: Indices, times: Array) -> Array:
        return cast(Array, -np.linalg.svd(jacobians(times), compute_uv=False)[:, -1:])

    def estimate(times: Array) -> Array:
        Js = jacobians(times)
        squares = Js @ Js.transpose(0, 2, 1) if len(chain) >= len(rows) else Js.transpose(0, 2, 1) @ Js
        return cast(Array, -np.sqrt(np.maximum(np.linalg.eigvalsh(squares)[:, :1], 0.0)))

    # Like the joints, σ is continuous: it is one function from start to end.
    times = np.unique(pieces.times(*grid(pieces, _SIGMA_SAMPLES, 1)[:2]))
    values = np.concatenate([estimate(times[some]) for some in _chunks(len(times))])
    nearest = int(values.argmax())
    values[nearest] = exact(np.zeros(1, dtype=np.int64), times[[nearest]])
    value, _, time = _between(
        times, values, np.arange(1, len(times) - 1), np.zeros(len(times), dtype=np.int64), exact, np.zeros(1)
    )[0]
    return SmallestSingularValue(-value, time)


def _chunks(count: int) -> list[slice]:
    return [slice(first, first + _CHUNK) for first in range(0, count, _CHUNK)]


def poses_at(pieces: Pieces, chain: Chain, count: int) -> tuple[Array, Poses]:
    """Return configurations, shape (count, n), and poses at evenly spread samples, for an independent check."""
    piece, taus, _ = grid(pieces, count)
    rows = np.unique(np.linspace(0, len(taus) - 1, count).round().astype(np.int64))
    qs = pieces.at(piece[rows], taus[rows], 0)
    return qs, Poses(*chain_poses(chain.flat, qs))


def _rounding(pieces: Pieces) -> Array:
    """Return the rounding of each of `QUANTITIES`, for a tip that hardly moves while the joints do."""
    velocity, acceleration = (float(np.abs(pieces.on(_ENDS, order)).max(initial=0.0)) for order in (1, 2))
    rates = np.repeat([velocity, max(acceleration, velocity**2), 1.0], 2)
    return _ROUNDING * rates


def _tip_motion(chain: Chain, qs: Array, velocities: Array, accelerations: Array, Js: Array) -> list[Array]:
    """Return ‖ṗ‖, ‖ω‖, ‖p̈‖, ‖ω̇‖; shape (N,) each."""
    twists = _times(Js, velocities)
    paces = np.maximum(np.abs(velocities).max(axis=1, initial=0.0), 1e-9)
    step = (_STEP / paces)[:, None]
    # J̇ q̇ is the derivative of J q̇ along q̇, with q̇ constant.
    moved = [_times(chain_jacobians(chain.flat, qs + place * step * velocities)[2], velocities) for place in _PLACES]
    changes = _times(Js, accelerations) + np.tensordot(_STENCIL, moved, 1) / step
    parts = [rows[:, part] for rows in (twists, changes) for part in (slice(3), slice(3, 6))]
    return [np.sqrt(np.einsum("ni,ni->n", part, part)) for part in parts]


def _times(Js: Array, rates: Array) -> Array:
    return cast(Array, np.einsum("nij,nj->ni", Js, rates))


def _deviations(poses: Poses, wanted: Poses, task: Task) -> list[Array]:
    """Return distance [m] and angle [rad] between pairs of poses; shape (N,) each."""
    if task != FULL_POSE:
        return list(task.errors(wanted, poses))
    distances = np.linalg.norm(poses.positions - wanted.positions, axis=1)
    chords = np.sqrt(np.sum((poses.rotations - wanted.rotations) ** 2, axis=(1, 2)) / 8.0)
    return [distances, 2.0 * np.arcsin(np.minimum(chords, 1.0))]


def _between(
    places: Array,
    values: Array,
    inner: Indices,
    piece: Indices,
    quantities: Callable[[Indices, Array], Array],
    least: Array,
) -> list[tuple[float, int, float]]:
    """Find the largest value of each of Q columns, also between samples: the value, the sample next to it, its place.

    The values have the shape (N, Q); `inner` are the samples with neighbours in their piece, `quantities` evaluates
    values in a piece at a place, (M,) each → (M, Q), and `least` are differences that do not matter.
    """
    exact = np.maximum(_EXACT * np.abs(values).max(axis=0), least)
    rows, columns = promising(places, values, inner, exact)
    each = np.arange(len(rows))

    def values_at(tried: Array) -> Array:
        found = quantities(np.repeat(piece[rows], tried.shape[1]), tried.ravel())
        return found.reshape(*tried.shape, -1)[each, :, columns]

    near = rows[:, None] + np.arange(-1, 2)
    peaks, where = highest(values_at, places[near], values[near, columns[:, None]], exact[columns])
    largest = []
    for column, row in enumerate(values.argmax(axis=0)):
        best = float(values[row, column]), int(row), float(places[row])
        refined = ((float(peaks[i]), int(rows[i]), float(where[i])) for i in np.flatnonzero(columns == column))
        largest.append(max((best, *refined), key=lambda one: one[0]))
    return largest
