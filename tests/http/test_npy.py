"""An npy answer is what NumPy writes itself, byte for byte; and a body is read with as few copies as possible."""

from io import BytesIO

import numpy as np
import pytest

from gelenk.http.messages.npy import npy_response, read_npy


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


def body(array: np.ndarray, pad: int = 0) -> bytearray:
    """The array as a body whose numbers start `pad` bytes later than where NumPy puts them."""
    written = BytesIO()
    np.save(written, array)
    content = written.getvalue()
    start = 10 + int.from_bytes(content[8:10], "little")
    head = content[10 : start - 1] + pad * b" " + b"\n"
    return bytearray(content[:8] + len(head).to_bytes(2, "little") + head + content[start:])


def test_a_body_of_its_own_is_read_in_place() -> None:
    content = body(np.arange(12.0).reshape(3, 4))
    rows = read_npy(content)
    content[-8:] = np.array([99.0]).tobytes()
    assert rows[2, 3] == 99.0
    rows[0, 0] = 1.0


@pytest.mark.parametrize(
    ("array", "pad"),
    [
        (np.arange(12.0).reshape(3, 4), 3),
        (np.asfortranarray(np.arange(12.0).reshape(3, 4)), 0),
        (np.arange(12).reshape(3, 4), 0),
        (np.arange(12.0, dtype=">f8").reshape(3, 4), 0),
        (np.arange(12, dtype="f4").reshape(3, 4), 0),
    ],
    ids=["shifted", "columns first", "integers", "the other byte order", "short"],
)
@pytest.mark.parametrize("kind", [bytes, bytearray])
def test_any_body_becomes_the_array_that_kernels_take(
    array: np.ndarray, pad: int, kind: type[bytes] | type[bytearray]
) -> None:
    rows = read_npy(kind(body(array, pad)))
    assert np.array_equal(rows, np.arange(12.0).reshape(3, 4))
    assert rows.dtype == np.dtype(np.float64)
    assert rows.flags.carray
