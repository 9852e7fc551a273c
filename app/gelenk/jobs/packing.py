"""Arrays as bytes, and back to the last bit: how parts of jobs travel and are kept. Nothing in them is code."""

from io import BytesIO
from typing import Any

import numpy as np
from numpy.typing import NDArray


def packed(**arrays: Any) -> bytes:
    """Numbers and arrays of numbers by their names; what is None is left out."""
    target = BytesIO()
    np.savez(target, allow_pickle=False, **{name: array for name, array in arrays.items() if array is not None})
    return target.getvalue()


def unpacked(content: bytes) -> dict[str, NDArray[Any]]:
    """What `packed` has made; a number is an array of shape ()."""
    with np.load(BytesIO(content), allow_pickle=False) as arrays:
        return dict(arrays)
