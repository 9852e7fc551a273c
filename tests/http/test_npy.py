"""An npy answer is what NumPy writes itself, byte for byte."""

from io import BytesIO

import numpy as np
import pytest

from gelenk.http.messages.npy import npy_response


@pytest.mark.parametrize(
    "array",
    [
        np.arange(12.0).reshape(3, 4),
        np.arange(12.0).reshape(3, 4).T,
        np.arange(12.0).reshape(3, 4)[:, ::2],
        np.arange(6),
        np.zeros((0, 7)),
        np.ones((1, 4, 4), dtype=bool),
    ],
    ids=["rows", "columns", "every other", "integers", "empty", "flags"],
)
def test_answers_with_the_bytes_of_numpy(array: np.ndarray) -> None:
    written = BytesIO()
    np.save(written, np.ascontiguousarray(array))
    assert npy_response(array, {}).body == written.getvalue()
