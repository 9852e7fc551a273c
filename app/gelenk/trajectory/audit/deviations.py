"""Compiled distances between poses on a motion and those demanded."""

import math

import numpy as np

from gelenk.robot.arrays import Array
from gelenk.robot.compilation import compiled


@compiled
def deviations(positions: Array, rotations: Array, wanted: Array, wanted_rotations: Array) -> Array:
    """Return distance [m] and angle [rad] between pairs of poses, infinite where one is not a number; shape (N, 2).

    The angle comes from the Frobenius norm of the difference of the rotations, which stays accurate near zero.
    """
    found = np.empty((len(positions), 2))
    for i in range(len(positions)):
        square, chord = 0.0, 0.0
        for k in range(3):
            square += (positions[i, k] - wanted[i, k]) ** 2
            for j in range(3):
                chord += (rotations[i, k, j] - wanted_rotations[i, k, j]) ** 2
        found[i, 0], found[i, 1] = math.sqrt(square), 2.0 * math.asin(min(math.sqrt(chord / 8.0), 1.0))
        for k in range(2):
            found[i, k] = np.inf if math.isnan(square + chord) else found[i, k]
    return found
