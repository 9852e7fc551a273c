"""Arrays in requests and replies: npy bodies, with all other fields in the query."""

from collections.abc import Mapping
from io import BytesIO
from typing import Any

import numpy as np

from gelenk.client.call import Reply
from gelenk.errors import InvalidArray, quoted
from gelenk.robot.arrays import Array


def numbers(array: Array) -> Array:
    """Return an array that can be sent; integers and short floats keep their type.

    Raises:
        InvalidArray: It holds something else, or masked entries, which NumPy would send as numbers.
    """
    array = np.asanyarray(array)
    if array.dtype.kind not in "iuf" or np.ma.is_masked(array):
        what = "masked entries" if np.ma.is_masked(array) else quoted(str(array.dtype))
        raise InvalidArray(f"the array holds {what}; allowed: integers and floats of up to 64 bits")
    is_plain = array.dtype.isnative and array.dtype.itemsize <= 8
    return np.ascontiguousarray(array, dtype=array.dtype if is_plain else np.float64)


def packed(array: Array) -> bytes:
    """Encode numbers in NumPy's npy format; raises as `numbers` does."""
    stream = BytesIO()
    np.save(stream, numbers(array), allow_pickle=False)
    return stream.getvalue()


def unpacked(reply: Reply) -> Array:
    """Decode the array in a reply."""
    array: Array = np.load(BytesIO(reply.body), allow_pickle=False)
    return array


def fits_query(fields: Mapping[str, Any]) -> bool:
    """Check whether fields fit into a query: numbers, words, and lists of words."""
    return all(_is_plain(value) or _is_words(value) for value in fields.values())


def query_of(fields: Mapping[str, Any]) -> dict[str, Any]:
    """Return fields as query parameters; those that are None are left out, and the service decides."""
    return {name: _parameter(value) for name, value in fields.items() if value is not None}


def _is_plain(value: Any) -> bool:
    return value is None or isinstance(value, bool | int | float | str)


def _is_words(value: Any) -> bool:
    return isinstance(value, list | tuple) and all(isinstance(item, str) for item in value)


def _parameter(value: Any) -> Any:
    if isinstance(value, bool):
        return "true" if value else "false"
    return [str(item) for item in value] if isinstance(value, list | tuple) else str(value)
