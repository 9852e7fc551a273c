"""Cross products as matrices."""

import numpy as np

from gelenk.robot.arrays import Array

_ENTRIES = -np.cross(np.eye(3)[:, None], np.eye(3)[None]).reshape(3, 9)
"""Linear map from v to the entries of [v]×, row by row; shape (3, 9)."""


def cross_matrices(vectors: Array) -> Array:
    """Return [v]×, for which [v]× w = v × w; shape (…, 3) → (…, 3, 3)."""
    return np.asarray((vectors @ _ENTRIES).reshape(*vectors.shape, 3))
