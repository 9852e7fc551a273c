"""Arrays as parts of a JSON answer."""

import numpy as np
import orjson
import pytest

from gelenk.operations.rows import json_rows, objects


@pytest.mark.parametrize("count", [3, 5000])
def test_an_array_in_any_order_is_encoded(count: int) -> None:
    """The encoder takes those alone whose rows follow one another."""
    array = np.arange(4.0 * count).reshape(4, count).T
    assert orjson.loads(orjson.dumps({"a": json_rows(array)}, option=orjson.OPT_SERIALIZE_NUMPY))["a"] == array.tolist()


@pytest.mark.parametrize("count", [0, 1, 5000])
def test_columns_become_objects(count: int) -> None:
    rows, numbers = np.arange(3.0 * count).reshape(count, 3), np.arange(float(count))
    wanted = [{"in": {"a": a, "b": b, "c": None}} for a, b in zip(rows.tolist(), numbers.tolist(), strict=True)]
    assert orjson.loads(objects({"a": rows, "b": numbers, "c": [b"null"] * count}, b'{"in":%b}')) == wanted
