"""Polytopes of tip velocities and forces within the joint limits, which ellipsoids only approximate.

Velocities {Jq̇ : |q̇_i| ≤ q̇max_i} form a zonotope, a sum of segments, one per joint. Forces {F : |J_iᵀF| ≤ τmax_i},
whose torques are within the limits, form an intersection of strips. Both are symmetric about zero. All results are
exact, in coordinates of range(J), where J of shape (r, n) has full rank r ≤ 3: each facet of a zonotope is parallel to
r - 1 of its segments, and a linear programme over strips has its optimum where r of them are tight [Ziegler1995].
"""

from itertools import combinations
from typing import cast

import numpy as np

from gelenk.robot.arrays import Array, Flags

_PARALLEL = 1e-12
"""Sine of the angle, or determinant of unit vectors, below which directions count as dependent."""
_NEXT_TO_NOTHING = 1e-14
"""A column shorter than this share of the longest is rounding."""
_ON = 1e-9
"""Tolerance for rounding of a vertex outside a strip, as a share of its half-width."""


def largest_velocities(J: Array, limits: Array, directions: Array) -> Array:
    """Compute the largest speed purely along each direction, where the ray leaves the zonotope; shape (D,).

    Args:
        J: Jacobian in coordinates of its range; shape (r, n), r ≥ 1.
        limits: q̇max > 0; shape (n,).
        directions: Unit vectors in these coordinates; shape (D, r).
    """
    normals = _normals(J)
    offsets = np.abs(normals @ J) @ limits
    slopes = np.abs(directions @ normals.T)
    return np.asarray(np.divide(offsets, slopes, out=np.full_like(slopes, np.inf), where=slopes > 0.0).min(axis=1))


def largest_velocity_components(J: Array, limits: Array, directions: Array) -> Array:
    """Compute the largest velocity component along each direction: the support function Σ q̇max_i |J_iᵀu|; (D,)."""
    return np.asarray(np.abs(directions @ J) @ limits)


def largest_forces(J: Array, limits: Array, directions: Array) -> Array:
    """Compute the largest force purely along each direction, NaN where it loads no joint; shape (D,).

    The arguments are those of `largest_velocities`, with limits τmax > 0.
    """
    torques = np.abs(directions @ J)
    felt = torques > _PARALLEL * np.linalg.norm(J, axis=0)
    forces = np.divide(limits, torques, out=np.full_like(torques, np.inf), where=felt).min(axis=1)
    return np.asarray(np.where(np.isfinite(forces), forces, np.nan))


def largest_force_components(J: Array, limits: Array, directions: Array) -> Array:
    """Compute the largest component along each direction of any force within the limits; shape (D,).

    By duality, max uᵀF over |J_iᵀF| ≤ τmax_i is the smallest Σ τmax_i |λ_i| with Jλ = u, which is attained where all
    but r of the λ_i are zero.
    """
    r, n = J.shape
    best = np.full(len(directions), np.inf)
    chosen = np.array(list(combinations(range(n), r)))
    columns = J.T[chosen].transpose(0, 2, 1)
    sizes = np.linalg.norm(columns, axis=1)
    shares = np.abs(np.linalg.det(columns)) > _PARALLEL * np.prod(sizes, axis=1)
    columns, weights = columns[shares], limits[chosen[shares]]
    for i, direction in enumerate(directions):
        multipliers = np.linalg.solve(columns, np.broadcast_to(direction[:, None], (len(columns), r, 1)))[:, :, 0]
        best[i] = np.min(np.sum(weights * np.abs(multipliers), axis=1))
    return best


def velocity_polygon(J: Array, limits: Array) -> Array:
    """Compute the vertices of the zonotope of a planar J, anticlockwise (its two ends if flat); (2, n) → (V, 2)."""
    segments = (J * limits).T[_felt(J)]
    below = (segments[:, 1] < 0.0) | ((segments[:, 1] == 0.0) & (segments[:, 0] < 0.0))
    segments[below] *= -1.0
    merged: list[Array] = []
    for segment in segments[np.argsort(np.arctan2(segments[:, 1], segments[:, 0]), kind="stable")]:
        if merged and _sine(merged[-1], segment) < _PARALLEL:
            merged[-1] = merged[-1] + segment
        else:
            merged.append(segment)
    # The first and the last segment may be parallel too, at angles 0 and π.
    if len(merged) > 1 and _sine(merged[0], merged[-1]) < _PARALLEL:
        merged[0] = merged[0] - merged.pop()
    if not merged:
        return np.zeros((1, 2))
    half = np.cumsum(2.0 * np.array(merged), axis=0) - np.sum(merged, axis=0)
    return np.concatenate((half, -half))


def force_polygon(J: Array, limits: Array) -> Array:
    """Compute the vertices of the force polytope of a planar J of rank 2, anticlockwise; shape (2, n) → (V, 2)."""
    strips = (J / limits).T[_felt(J)]
    corners = []
    for a, b in combinations(strips, 2):
        if _sine(a, b) < _PARALLEL:
            continue
        for signs in ((1.0, 1.0), (1.0, -1.0)):
            corner = np.linalg.solve(np.array([a, b]), np.array(signs))
            corners += [corner, -corner]
    vertices = np.array(corners)
    vertices = vertices[np.abs(vertices @ strips.T).max(axis=1) <= 1.0 + _ON]
    vertices = vertices[np.argsort(np.arctan2(vertices[:, 1], vertices[:, 0]), kind="stable")]
    apart = np.linalg.norm(vertices - np.roll(vertices, 1, axis=0), axis=1)
    return cast(Array, vertices[apart > _ON * np.linalg.norm(vertices, axis=1)])


def _normals(J: Array) -> Array:
    """Unit normals of the facets of the zonotope, one per parallel pair; shape (F, r)."""
    r = len(J)
    sizes = np.linalg.norm(J, axis=0)
    units = (J[:, sizes > 0.0] / sizes[sizes > 0.0]).T
    if r == 1:
        return np.ones((1, 1))
    if r == 2:
        return np.stack((-units[:, 1], units[:, 0]), axis=1)
    first, second = np.triu_indices(len(units), 1)
    normals = np.cross(units[first], units[second])
    sines = np.linalg.norm(normals, axis=1)
    apart = sines > _PARALLEL
    return cast(Array, normals[apart] / sines[apart, None])


def _felt(J: Array) -> Flags:
    """Which columns of a planar J are more than rounding, compared with the longest; shape (2, n) → (n,)."""
    lengths = np.linalg.norm(J, axis=0)
    return np.asarray(lengths > _NEXT_TO_NOTHING * lengths.max(initial=0.0))


def _sine(a: Array, b: Array) -> float:
    """|sin| of the angle between two plane vectors."""
    return float(abs(a[0] * b[1] - a[1] * b[0]) / (np.linalg.norm(a) * np.linalg.norm(b)))
