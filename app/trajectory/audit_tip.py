"""What the tip does while the joints move: speeds, accelerations, distance from the path, nearness to a singularity.

Everything is sampled densely, both ends of each piece among the samples, and around the largest samples once more and
again. The acceleration J q̈ + J̇ q̇ takes J̇ q̇ from differences of J along the motion.
"""

from collections.abc import Callable
from dataclasses import dataclass
from typing import TypeAlias, cast

import numpy as np

from app.kinematics.ik.task import FULL_POSE, Task
from app.kinematics.kernels import chain_jacobians, chain_poses
from app.model.arrays import Array, Indices
from app.model.chain import Chain
from app.model.poses import Poses
from app.trajectory.audit_pieces import Pieces

PathOfTime: TypeAlias = Callable[[Array], Poses]
"""The pose T_base_tip that is wanted at times of shape (N,), [s]."""

MIN_SAMPLES = 1500
"""Of the whole motion; more where there are many pieces."""
_SIGMA_SAMPLES = 400
_CHUNK = 4096
_CANDIDATES = 6
_ROUNDS = 7
_OFFSETS = np.linspace(0.0, 1.0, 9)
_STEP = 1e-3
"""By how much the fastest joint moves for a difference of the Jacobian, [rad or m]."""

QUANTITIES = ("speed", "angular_speed", "acceleration", "angular_acceleration", "position", "orientation")


@dataclass(frozen=True, slots=True)
class Grid:
    """Samples, each with the neighbours between which its peak lies.

    Attributes:
        piece: Shape (N,).
        tau: Within the piece; shape (N,).
        low: τ of the sample before it in the piece; shape (N,).
        high: τ of the one after it; shape (N,).
    """

    piece: Indices
    tau: Array
    low: Array
    high: Array


@dataclass(frozen=True, slots=True)
class Largest:
    """The largest value of a quantity, and when."""

    value: float
    time: float


def grid(pieces: Pieces, least: int = MIN_SAMPLES, intervals: int = 2) -> Grid:
    """Evenly spaced samples of each piece, both ends among them: `least` over all, some intervals in each at least."""
    shares = pieces.widths / pieces.widths.sum()
    counts = np.maximum(np.ceil(shares * least).astype(np.int64), intervals) + 1
    piece = np.repeat(np.arange(len(counts)), counts)
    within = np.arange(len(piece)) - np.repeat(np.cumsum(counts) - counts, counts)
    last = (counts - 1)[piece]
    return Grid(piece, within / last, np.maximum(within - 1, 0) / last, np.minimum(within + 1, last) / last)


def tip_peaks(pieces: Pieces, chain: Chain, path: PathOfTime | None, task: Task = FULL_POSE) -> dict[str, Largest]:
    """The largest of `QUANTITIES`, the last two where there is a path to compare with; [m/s, rad/s, …, m, rad].

    Of the path only the directions of the task count.
    """
    names = QUANTITIES if path is not None else QUANTITIES[:4]

    def quantities(piece: Indices, tau: Array) -> Array:
        qs, velocities, accelerations = (pieces.at(piece, tau, order) for order in range(3))
        positions, rotations, Js = chain_jacobians(chain.flat, qs)
        columns = _tip_motion(chain, qs, velocities, accelerations, Js)
        if path is not None:
            columns += _deviations(Poses(positions, rotations), path(pieces.times(piece, tau)), task)
        # A path that has no pose somewhere is as far away as can be.
        return np.nan_to_num(np.column_stack(columns), nan=np.inf)

    samples = grid(pieces)
    values = np.concatenate([quantities(samples.piece[rows], samples.tau[rows]) for rows in _chunks(len(samples.tau))])
    return dict(zip(names, _refined(pieces, samples, values, quantities), strict=True))


def smallest_singular_value(pieces: Pieces, chain: Chain, task: Task = FULL_POSE) -> Largest:
    """The smallest σ of the geometric Jacobian along the way, of its rows that count or of n; metres and radians mixed.

    Eigenvalues of J Jᵀ (Jᵀ J where it is smaller) say where; the decomposition of J itself how much.
    """
    rows = np.flatnonzero(task.weights)

    def jacobians(piece: Indices, tau: Array) -> Array:
        _, rotations, Js = chain_jacobians(chain.flat, pieces.at(piece, tau, 0))
        if task == FULL_POSE:
            return Js
        # Directions of rotation are those of the tip's axes.
        turned = np.concatenate((Js[:, :3], rotations.transpose(0, 2, 1) @ Js[:, 3:]), axis=1)
        return turned[:, rows]

    def exact(piece: Indices, tau: Array) -> Array:
        return cast(Array, -np.linalg.svd(jacobians(piece, tau), compute_uv=False)[:, -1:])

    def estimate(piece: Indices, tau: Array) -> Array:
        Js = jacobians(piece, tau)
        squares = Js @ Js.transpose(0, 2, 1) if len(chain) >= len(rows) else Js.transpose(0, 2, 1) @ Js
        return cast(Array, -np.sqrt(np.maximum(np.linalg.eigvalsh(squares)[:, :1], 0.0)))

    samples = _thinned(grid(pieces, _SIGMA_SAMPLES, 1))
    values = np.concatenate([estimate(samples.piece[some], samples.tau[some]) for some in _chunks(len(samples.tau))])
    found = _refined(pieces, samples, values, exact)[0]
    return Largest(-found.value, found.time)


def _chunks(count: int) -> list[slice]:
    """Rows that are worked on at a time."""
    return [slice(first, first + _CHUNK) for first in range(0, count, _CHUNK)]


def poses_at(pieces: Pieces, chain: Chain, count: int) -> tuple[Array, Poses]:
    """Configurations and poses at evenly spread samples, for another judge; shape (count, n)."""
    samples = grid(pieces, count)
    rows = np.unique(np.linspace(0, len(samples.tau) - 1, count).round().astype(np.int64))
    qs = pieces.at(samples.piece[rows], samples.tau[rows], 0)
    return qs, Poses(*chain_poses(chain.flat, qs))


def _thinned(samples: Grid) -> Grid:
    """Without the first sample of each piece but the first: its configuration is the last one of the piece before."""
    keep = (samples.tau > 0.0) | (samples.piece == 0)
    return Grid(samples.piece[keep], samples.tau[keep], samples.low[keep], samples.high[keep])


def _tip_motion(chain: Chain, qs: Array, velocities: Array, accelerations: Array, Js: Array) -> list[Array]:
    """‖ṗ‖, ‖ω‖, ‖p̈‖, ‖ω̇‖; shape (N,) each."""
    twists = np.einsum("nij,nj->ni", Js, velocities)
    paces = np.maximum(np.abs(velocities).max(axis=1, initial=0.0), 1e-9)
    step = (_STEP / paces)[:, None]
    near, far = (_difference(chain, qs, k * step * velocities) for k in (1, 2))
    # Of the fourth order: (8 (J(h) - J(-h)) - (J(2h) - J(-2h))) / 12h.
    rates = (8.0 * near - far) / (12.0 * step[:, :, None])
    changes = np.einsum("nij,nj->ni", Js, accelerations) + np.einsum("nij,nj->ni", rates, velocities)
    return [np.linalg.norm(rows[:, part], axis=1) for rows in (twists, changes) for part in (slice(3), slice(3, 6))]


def _difference(chain: Chain, qs: Array, steps: Array) -> Array:
    """J(q + Δq) - J(q - Δq); shape (N, 6, n)."""
    after, before = (chain_jacobians(chain.flat, shifted)[2] for shifted in (qs + steps, qs - steps))
    difference: Array = after - before
    return difference


def _deviations(poses: Poses, wanted: Poses, task: Task) -> list[Array]:
    """Distance [m] and angle [rad] between poses, pair by pair; shape (N,) each."""
    if task != FULL_POSE:
        return list(task.errors(wanted, poses))
    distances = np.linalg.norm(poses.positions - wanted.positions, axis=1)
    chords = np.sqrt(np.sum((poses.rotations - wanted.rotations) ** 2, axis=(1, 2)) / 8.0)
    return [distances, 2.0 * np.arcsin(np.minimum(chords, 1.0))]


def _refined(
    pieces: Pieces, samples: Grid, values: Array, quantities: Callable[[Indices, Array], Array]
) -> list[Largest]:
    """The largest of each column, looked at ever more closely around its largest samples; shape (N, Q)."""
    rows = _candidates(values)
    column = np.repeat(np.arange(values.shape[1]), [len(some) for some in rows])
    chosen = np.concatenate(rows)
    piece, low, high = samples.piece[chosen], samples.low[chosen], samples.high[chosen]
    each, points = np.arange(len(chosen)), len(_OFFSETS)
    for _ in range(_ROUNDS):
        tau = low[:, None] + (high - low)[:, None] * _OFFSETS
        all_ = quantities(np.repeat(piece, points), tau.ravel()).reshape(len(chosen), points, -1)
        closer = all_[each, :, column]
        peak = closer.argmax(axis=1)
        low, high = tau[each, np.maximum(peak - 1, 0)], tau[each, np.minimum(peak + 1, points - 1)]
    best, times = closer[each, peak], pieces.times(piece, tau[each, peak])
    firsts = [np.flatnonzero(column == q)[best[column == q].argmax()] for q in range(values.shape[1])]
    return [Largest(float(best[i]), float(times[i])) for i in firsts]


def _candidates(values: Array) -> list[Indices]:
    """For each column the rows of its largest local maxima; shape (N, Q)."""
    padded = np.pad(values, ((1, 1), (0, 0)), constant_values=-np.inf)
    local = (values >= padded[:-2]) & (values >= padded[2:])
    rows = []
    for q in range(values.shape[1]):
        candidates = np.flatnonzero(local[:, q])
        order = np.argsort(values[candidates, q], kind="stable")[-_CANDIDATES:]
        rows.append(candidates[order])
    return rows
