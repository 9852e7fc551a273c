"""Fewer triangles for the same shape: edges are collapsed, the cheapest first (quadric error metrics).

Garland and Heckbert, "Surface simplification using quadric error metrics", SIGGRAPH 1997. Each round collapses many
edges at once, none of which share a point, so that NumPy does the work.
"""

import numpy as np

from gelenk.robot.arrays import Array, Indices

_MOST_ROUNDS = 40
_WORTHWHILE = 0.01
"""Smallest share of the points that a round must remove."""
_FEWEST = 64
_LEAST_COSINE = 0.5
"""No triangle is turned further than by the angle with this cosine."""
_RIDGE = 1e-3
"""Share of a quadric's trace that draws the best point to the middle of its edge where the quadric leaves it open."""
_I, _J = np.triu_indices(4)
_TWICE = np.where(_I == _J, 1.0, 2.0)


def simplified(points: Array, triangles: Indices, tolerance: float) -> tuple[Array, Indices]:
    """Return points (N, 3) and triangles (F, 3) of nearly the same surface with fewer of both.

    No collapse moves a point further than `tolerance` from the planes of the triangles that it stands for, as the root
    of the mean square weighted by their areas. Points on open borders stay, as another part may begin there. Each
    triangle must have three corners.
    """
    quadrics = _quadrics(points, triangles)
    for _ in range(_MOST_ROUNDS):
        if len(triangles) <= _FEWEST:
            break
        edges, places, ranks = _candidates(points, triangles, quadrics, tolerance)
        taken = _independent(edges, ranks, len(points))
        moved, after, taken = _collapsed(points, triangles, edges, places, taken)
        if taken.sum() <= _WORTHWHILE * len(points):
            break
        a, b = edges[taken].T
        quadrics[a] += quadrics[b]
        points, triangles, used = _tidied(moved, after)
        quadrics = quadrics[used]
    return points, triangles


def _candidates(points: Array, triangles: Indices, quadrics: Array, tolerance: float) -> tuple[Indices, Array, Indices]:
    """Return the edges (E, 2) that may go, the point that each becomes (E, 3), and their order by cost (E,)."""
    edges, are_open = _edges(triangles, len(points))
    is_fixed = np.zeros(len(points), dtype=bool)
    is_fixed[edges[are_open]] = True
    edges = edges[~is_fixed[edges].any(axis=1)]
    a, b = edges.T
    quadric = quadrics[a] + quadrics[b]
    middle = (points[a] + points[b]) / 2
    choices = np.stack([middle, points[a], points[b], _nearest_to_all(quadric, middle)])
    costs = np.stack([_costs(quadric, choice) for choice in choices])
    which, rows = costs.argmin(axis=0), np.arange(len(edges))
    cost = costs[which, rows] / np.maximum(quadric[:, 10], np.finfo(float).tiny)
    some = np.flatnonzero(cost <= tolerance**2)
    length = ((points[a] - points[b]) ** 2).sum(axis=1)
    ranks = np.empty(len(some), dtype=np.int64)
    ranks[np.lexsort((length[some], cost[some]))] = np.arange(len(some))
    return edges[some], choices[which, rows][some], ranks


def _independent(edges: Indices, ranks: Indices, count: int) -> Array:
    """Return which edges are the first by rank at both of their ends, shape (E,)."""
    first = np.full(count, len(edges))
    np.minimum.at(first, edges[:, 0], ranks)
    np.minimum.at(first, edges[:, 1], ranks)
    return np.asarray((first[edges] == ranks[:, None]).all(axis=1))


def _collapsed(
    points: Array, triangles: Indices, edges: Indices, places: Array, taken: Array
) -> tuple[Array, Indices, Array]:
    """Return points and triangles after the collapses, and which of them turn no triangle over, shape (E,)."""
    before = _crosses(points, triangles)
    while True:
        a, b = edges[taken].T
        moved, to = points.copy(), np.arange(len(points))
        moved[a], to[b] = places[taken], a
        after = to[triangles]
        stay = (after != np.roll(after, 1, axis=1)).all(axis=1)
        crosses = _crosses(moved, after)
        sizes = np.linalg.norm(before, axis=1) * np.linalg.norm(crosses, axis=1)
        turned = stay & ((before * crosses).sum(axis=1) < _LEAST_COSINE * sizes)
        wrong = np.zeros(len(points), dtype=bool)
        wrong[after[turned]] = True
        still = taken & ~wrong[edges[:, 0]]
        if (still == taken).all():
            return moved, after[stay], taken
        taken = still


def _tidied(points: Array, triangles: Indices) -> tuple[Array, Indices, Indices]:
    """Return the points that are used, the triangles without doubles, and where those points were, shape (N,)."""
    corners = np.sort(triangles, axis=1)
    _, first = np.unique(corners @ np.array([len(points) ** 2, len(points), 1]), return_index=True)
    used, numbers = np.unique(triangles[np.sort(first)], return_inverse=True)
    return points[used], numbers.reshape(-1, 3), used


def _edges(triangles: Indices, count: int) -> tuple[Indices, Array]:
    """Return each edge once, shape (E, 2), and whether only one triangle has it, shape (E,)."""
    sides = np.sort(np.concatenate([triangles[:, [0, 1]], triangles[:, [1, 2]], triangles[:, [2, 0]]]), axis=1)
    keys, times = np.unique(sides @ np.array([count, 1]), return_counts=True)
    return np.column_stack([keys // count, keys % count]), times == 1


def _crosses(points: Array, triangles: Indices) -> Array:
    """Return a normal of each triangle, shape (F, 3), twice as long as its area."""
    p, q, r = (points[triangles[:, corner]] for corner in range(3))
    return np.cross(q - p, r - p)


def _quadrics(points: Array, triangles: Indices) -> Array:
    """Return the quadric of the planes at each point and their weight, shape (N, 11)."""
    crosses = _crosses(points, triangles)
    weights = np.linalg.norm(crosses, axis=1)
    unit = crosses / np.maximum(weights, np.finfo(float).tiny)[:, None]
    planes = np.column_stack([unit, -(unit * points[triangles[:, 0]]).sum(axis=1)])
    terms = np.column_stack([planes[:, _I] * planes[:, _J] * weights[:, None], weights])
    found = np.zeros((len(points), 11))
    for corner in triangles.T:
        np.add.at(found, corner, terms)
    return found


def _costs(quadrics: Array, points: Array) -> Array:
    """Return the weighted sum of squared distances of each point (E, 3) from its planes, shape (E,)."""
    homogeneous = np.column_stack([points, np.ones(len(points))])
    terms = quadrics[:, :10] * homogeneous[:, _I] * homogeneous[:, _J]
    return np.abs(terms @ _TWICE)


def _nearest_to_all(quadrics: Array, middles: Array) -> Array:
    """Return the points of least cost, shape (E, 3); along directions of no cost near the middles."""
    A = quadrics[:, [0, 1, 2, 1, 4, 5, 2, 5, 7]].reshape(-1, 3, 3)
    ridge = _RIDGE * np.trace(A, axis1=1, axis2=2) + np.finfo(float).tiny
    right = ridge[:, None] * middles - quadrics[:, [3, 6, 8]]
    solved = np.linalg.solve(A + ridge[:, None, None] * np.eye(3), right[:, :, None])
    return np.asarray(solved[:, :, 0])
