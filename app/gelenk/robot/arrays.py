"""Type aliases for arrays, and vectors as the matrices of their cross products."""

from collections.abc import Mapping, Sequence
from typing import TypeAlias

import numpy as np
import numpy.typing as npt

Array: TypeAlias = npt.NDArray[np.float64]
Indices: TypeAlias = npt.NDArray[np.int64]
Flags: TypeAlias = npt.NDArray[np.bool_]
Configuration: TypeAlias = Sequence[float] | Mapping[str, float] | Array
"""Joint positions in the order of a chain, or by joint name, [rad or m]."""

_ENTRIES = -np.cross(np.eye(3)[:, None], np.eye(3)[None]).reshape(3, 9)
"""Linear map from v to the entries of [v]×, row by row; shape (3, 9)."""


def cross_matrices(vectors: Array) -> Array:
    """Return [v]×, for which [v]× w = v × w; shape (…, 3) → (…, 3, 3)."""
    return np.asarray((vectors @ _ENTRIES).reshape(*vectors.shape, 3))
