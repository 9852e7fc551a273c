"""Array types, and the one decorator for compiled functions."""

from collections.abc import Callable
from typing import Any, TypeAlias, TypeVar, cast

import numba
import numpy as np
import numpy.typing as npt

Array: TypeAlias = npt.NDArray[np.float64]
Indices: TypeAlias = npt.NDArray[np.int64]

_Function = TypeVar("_Function", bound=Callable[..., Any])


def compiled(function: _Function) -> _Function:
    """Compile for the machine at the first call, without the GIL, cached on disk.

    Division follows IEEE 754 as NumPy's does: the functions guard their own denominators. A product and a sum may
    be contracted to one rounding, nothing else is reordered.
    """
    return cast(_Function, numba.njit(cache=True, nogil=True, error_model="numpy", fastmath={"contract"})(function))
