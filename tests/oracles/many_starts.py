"""All solutions of a Denavit-Hartenberg arm by Levenberg-Marquardt from many random starts at once, in NumPy."""

from collections.abc import Sequence

import numpy as np

from tests.oracles.dh_columns import Array, Table

_ROUNDS = 80


def solutions(
    table: Table, T: Array, bounds: Sequence[tuple[float, float]] | None, starts: int = 1024, seed: int = 0
) -> Array:
    """Distinct configurations that reach a pose, turning joints in ±π or turned into their bounds; shape (k, n).

    Args:
        table: The arm.
        T: The pose; shape (4, 4).
        bounds: Lower and upper limit of each joint; None keeps all solutions.
        starts: How many.
        seed: Of the starts.
    """
    n = len(table.rows)
    qs = np.random.default_rng(seed).uniform(-np.pi, np.pi, (starts, n))
    damping = np.full(starts, 1e-2)
    errors, Js = _linearised(table, T, qs)
    for _ in range(_ROUNDS):
        normal = Js.transpose(0, 2, 1) @ Js + damping[:, None, None] * np.eye(n)
        steps = np.linalg.solve(normal, Js.transpose(0, 2, 1) @ errors[:, :, None])[:, :, 0]
        steps *= np.minimum(1.0, 0.8 / np.maximum(np.abs(steps).max(axis=1), 1e-300))[:, None]
        trial_errors, trial_Js = _linearised(table, T, qs + steps)
        better = np.square(trial_errors).sum(axis=1) < np.square(errors).sum(axis=1)
        qs[better] += steps[better]
        errors[better], Js[better] = trial_errors[better], trial_Js[better]
        damping = np.where(better, 0.2 * damping, np.minimum(4.0 * damping, 1e3)) + 1e-14
    found = qs[np.abs(errors).max(axis=1) < 1e-9]
    turns = ~np.array(table.slides)
    found[:, turns] -= 2 * np.pi * np.rint(found[:, turns] / (2 * np.pi))
    if bounds is not None:
        found = _within(found, turns, bounds)
    return _distinct(found, turns)


def _within(qs: Array, turns: Array, bounds: Sequence[tuple[float, float]]) -> Array:
    """Those that full turns bring within the bounds, brought there."""
    lower, upper = np.array(bounds).T
    for j in np.flatnonzero(turns):
        qs[:, j] += 2 * np.pi * np.ceil((lower[j] - qs[:, j]) / (2 * np.pi) - 1e-9)
    within: Array = qs[((qs >= lower - 1e-8) & (qs <= upper + 1e-8)).all(axis=1)]
    return within


def _distinct(qs: Array, turns: Array) -> Array:
    """One of each cluster."""
    kept: list[Array] = []
    for q in qs:
        differences = np.array(kept).reshape(-1, len(q)) - q
        differences[:, turns] -= 2 * np.pi * np.rint(differences[:, turns] / (2 * np.pi))
        if not (np.abs(differences).max(axis=1, initial=0.0) < 1e-4).any():
            kept.append(q)
    return np.array(kept).reshape(-1, qs.shape[1])


def _linearised(table: Table, T: Array, qs: Array) -> tuple[Array, Array]:
    """Position error over 2 sin(θ/2) times the axis, and the geometric Jacobian; shapes (N, 6) and (N, 6, n)."""
    count, n = qs.shape
    frames = [np.tile(table.base, (count, 1, 1))]
    for i, (a, alpha, d, theta) in enumerate(table.rows):
        angle = theta + qs[:, i] * (not table.slides[i])
        length = d + qs[:, i] * table.slides[i]
        c, s, ca, sa = np.cos(angle), np.sin(angle), np.cos(alpha), np.sin(alpha)
        A = np.zeros((count, 4, 4))
        A[:, 0] = np.stack((c, -s * ca, s * sa, a * c), axis=1)
        A[:, 1] = np.stack((s, c * ca, -c * sa, a * s), axis=1)
        A[:, 2, 1], A[:, 2, 2], A[:, 2, 3], A[:, 3, 3] = sa, ca, length, 1.0
        frames.append(frames[-1] @ A)
    tip = frames[-1] @ table.tool
    Js = np.zeros((count, 6, n))
    for i in range(n):
        z = frames[i][:, :3, 2]
        if table.slides[i]:
            Js[:, :3, i] = z
        else:
            Js[:, :3, i] = np.cross(z, tip[:, :3, 3] - frames[i][:, :3, 3])
            Js[:, 3:, i] = z
    R = T[:3, :3] @ tip[:, :3, :3].transpose(0, 2, 1)
    skew = np.stack((R[:, 2, 1] - R[:, 1, 2], R[:, 0, 2] - R[:, 2, 0], R[:, 1, 0] - R[:, 0, 1]), axis=1)
    half_cosine = np.sqrt(np.maximum(0.25 * (1.0 + np.trace(R, axis1=1, axis2=2)), 1e-8))
    return np.concatenate((T[:3, 3] - tip[:, :3, 3], 0.5 * skew / half_cosine[:, None]), axis=1), Js
