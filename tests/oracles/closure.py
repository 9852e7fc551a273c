"""Mobility of a linkage as it stands, by closing its loops: freedoms of the pairs less the rank of the closures.

Each loop demands that the twists along it add up to nothing. The loops are those that the pairs beyond a spanning tree
close; a twist is found as the derivative of the motion itself.
"""

from collections.abc import Sequence
from typing import Any

import numpy as np
import numpy.typing as npt
from scipy.spatial.transform import Rotation

Array = npt.NDArray[np.float64]
Freedom = tuple[Array, Array | None]
"""A direction, and a point that stays at rest when turning about it; no point when sliding along it."""
Edge = tuple[int, int]


def twist(freedom: Freedom) -> Array:
    """Velocity of what is at the origin, then angular velocity, by central differences of the motion."""
    direction, point = freedom
    if point is None:
        return np.concatenate((direction, np.zeros(3)))
    step = 1e-4
    forth, back = (Rotation.from_rotvec(sign * step * direction) for sign in (1, -1))
    velocity = ((point - forth.apply(point)) - (point - back.apply(point))) / (2 * np.sin(step))
    return np.concatenate((velocity, direction))


def mobility(count: int, edges: Sequence[Edge], freedoms: Sequence[Sequence[Freedom]]) -> int:
    """Freedoms less the rank of the closures; the links must hang together."""
    first = np.cumsum([0, *(len(one) for one in freedoms)])
    rates = int(first[-1])
    path: dict[int, Array] = {0: np.zeros((6, rates))}
    closures: list[Array] = []
    waiting = list(range(len(edges)))
    while waiting:
        number = next(i for i in waiting if edges[i][0] in path or edges[i][1] in path)
        waiting.remove(number)
        a, b = edges[number]
        own = np.zeros((6, rates))
        for i, freedom in enumerate(freedoms[number]):
            own[:, first[number] + i] = twist(freedom)
        if a in path and b in path:
            closures.append(path[a] + own - path[b])
        elif a in path:
            path[b] = path[a] + own
        else:
            path[a] = path[b] - own
    assert len(path) == count
    rank: Any = np.linalg.matrix_rank(np.concatenate(closures), tol=1e-7) if closures else 0
    return rates - int(rank)
