"""Arrays as parts of a JSON answer."""

import numpy as np
import orjson
import pytest

from gelenk.operations.rows import json_rows


@pytest.mark.parametrize("count", [3, 5000])
def test_an_array_in_any_order_is_encoded(count: int) -> None:
    """The encoder takes those alone whose rows follow one another."""
    array = np.arange(4.0 * count).reshape(4, count).T
    assert orjson.loads(orjson.dumps({"a": json_rows(array)}, option=orjson.OPT_SERIALIZE_NUMPY))["a"] == array.tolist()
