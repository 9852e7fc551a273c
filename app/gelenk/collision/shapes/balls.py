"""Small spheres around points."""

import math

import numpy as np

from gelenk.robot.arrays import Array
from gelenk.robot.compilation import compiled, inlined

_STEPS = 60


@compiled
def ball_around(points: Array) -> Array:
    """Return centre and radius of a sphere around points, (N, 3) → (4,), little larger than the smallest, [m].

    The best of those whose centre steps to the farthest of them (Bădoiu and Clarkson, "Smaller core-sets for balls",
    2003), at first half-way from one end to the other. So it stays in their hull.
    """
    ball = np.array([0.0, 0.0, 0.0, np.inf])
    end = points[_farthest(points, points[0])[0]]
    centre = (end + points[_farthest(points, end)[0]]) / 2.0
    for step in range(2, _STEPS):
        far, most = _farthest(points, centre)
        radius = math.sqrt(most) * (1.0 + 1e-9)
        if radius < ball[3]:
            ball[:3], ball[3] = centre, radius
        for k in range(3):
            centre[k] += (points[far, k] - centre[k]) / step
    return ball


@inlined
def _farthest(points: Array, centre: Array) -> tuple[int, float]:
    """Return which point is farthest, and the square of its distance."""
    far, most = 0, -1.0
    for i in range(len(points)):
        apart = (points[i, 0] - centre[0]) ** 2 + (points[i, 1] - centre[1]) ** 2 + (points[i, 2] - centre[2]) ** 2
        if apart > most:
            far, most = i, apart
    return far, most
