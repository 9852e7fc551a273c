"""Type aliases for arrays."""

from collections.abc import Mapping, Sequence
from typing import TypeAlias

import numpy as np
import numpy.typing as npt

Array: TypeAlias = npt.NDArray[np.float64]
Indices: TypeAlias = npt.NDArray[np.int64]
Flags: TypeAlias = npt.NDArray[np.bool_]
Configuration: TypeAlias = Sequence[float] | Mapping[str, float] | Array
"""Joint positions in the order of a chain, or by joint name, [rad or m]."""
