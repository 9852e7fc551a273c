"""The tip's limits as constraints αu + βx ≤ 1 on u = s̈ and x = ṡ² on each interval of a path, for `reachability`.

Speed limits have this form already. An acceleration limit ‖ξ_s u + ξ_s' x‖ ≤ a is a circle in the plane of ξ_s and
ξ_s', of which half suffices because x ≥ 0. It is replaced by an inscribed polygon with corners at ±ξ_s, which costs
nothing on a straight line; at a right angle to ξ_s, which costs nothing in uniform motion on a circle; and at `_SIDES`
- 2 places between. Its sides cut off up to 1 - cos(π / 2 _SIDES) of the acceleration, 0.5 %, which is 0.25 % in time.

Within an interval, the terms are replaced by the parabolas through their values at both ends and in the middle.
"""

from collections.abc import Callable

import numpy as np

from gelenk.robot.arrays import Array, Indices
from gelenk.trajectory.paths.path_geometry import LimitedPath

_PLACES = np.array([0.0, 0.5, 1.0])
_SIDES = 16
_ANGLES = np.pi * (np.arange(_SIDES) + 0.5) / _SIDES
_WITHIN = np.cos(0.5 * np.pi / _SIDES)


def tip_rows(geometry: LimitedPath) -> Callable[[Array], tuple[Array, Array]] | None:
    """Return the function from nodes in 0 ≤ s ≤ 1 to α and β on the intervals between them; None without tip limits."""
    if not geometry.limits_tip:
        return None
    length = geometry.joints.duration

    def rows(nodes: Array) -> tuple[Array, Array]:
        piece, places, gains = sampled(geometry, nodes)
        tip = geometry.tip_at(np.repeat(piece, len(_PLACES)), places.ravel()).reshape(2, *places.shape, 6)
        first, second = tip[0] * length, tip[1] * length**2
        return _rows(first + gains[:, :, None] * second, second, first, gains, geometry.tip_bounds(piece))

    return rows


def sampled(geometry: LimitedPath, nodes: Array) -> tuple[Indices, Array, Array]:
    """Return the piece of each interval, (N,), and its three places s and the coefficients of u in ṡ² there, (N, 3)."""
    s = geometry.ends[0] + geometry.joints.duration * nodes
    piece = geometry.piece_of(0.5 * (s[:-1] + s[1:]))
    places = s[:-1, None] + np.diff(s)[:, None] * _PLACES
    places[:, -1] = s[1:]
    return piece, places, 2.0 * np.diff(nodes)[:, None] * _PLACES


def _rows(along: Array, bend: Array, slope: Array, gains: Array, bounds: Array) -> tuple[Array, Array]:
    """Compute the rows for the three places of each interval.

    Args:
        along, bend: Coefficients of u and x in the tip's acceleration; shape (N, 3, 6).
        slope: ξ_s; shape (N, 3, 6).
        gains: Coefficient of u in ṡ² = x + gain u at each place; shape (N, 3).
        bounds: Limits of the tip, infinite for none; shape (N, 4).
    """
    alphas, betas = [], []
    speeds, angular_speeds, accelerations, angular_accelerations = bounds.T[:, :, None]
    for part, speed, acceleration in (
        (slice(3), speeds, accelerations),
        (slice(3, 6), angular_speeds, angular_accelerations),
    ):
        if np.isfinite(speed).any():
            squares = np.einsum("nki,nki->nk", slope[:, :, part], slope[:, :, part]) / speed**2
            alphas.append(control_points(gains * squares))
            betas.append(control_points(squares))
        if np.isfinite(acceleration).any():
            limit = acceleration[:, :, None]
            points = ((control_points(values[:, :, part]) / limit).reshape(-1, 3) for values in (along, bend))
            alpha, beta = _polygon(*points)
            alphas.append(alpha.reshape(len(along), -1))
            betas.append(beta.reshape(len(along), -1))
    return np.hstack(alphas), np.hstack(betas)


def control_points(values: Array) -> Array:
    """Return the control points of the parabolas through three values each; their bounds hold for whole parabolas."""
    points = values.copy()
    points[:, 1] = 2.0 * values[:, 1] - 0.5 * (values[:, 0] + values[:, 2])
    return points


def _polygon(along: Array, bend: Array) -> tuple[Array, Array]:
    """Return rows that imply ‖along u + bend x‖ ≤ 1; shape (N, 3) each → (N, `_SIDES`) each."""
    size = np.linalg.norm(along, axis=1)[:, None]
    direction = along / np.maximum(size, np.finfo(float).tiny)
    with_it = np.einsum("ni,ni->n", direction, bend)[:, None]
    across = np.linalg.norm(bend - with_it * direction, axis=1)[:, None]
    cosines, sines = np.cos(_ANGLES) / _WITHIN, np.sin(_ANGLES) / _WITHIN
    return size * cosines, with_it * cosines + across * sines
