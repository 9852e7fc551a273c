"""NumPy's npy format, written and strictly read: only what NumPy's own reader accepts, with bounded work."""

import math
import re
from functools import lru_cache
from io import BytesIO
from typing import Any, Literal

import numpy as np
from starlette.responses import Response

from gelenk.errors import InvalidArray, quoted
from gelenk.http.messages.payloads import NPY
from gelenk.robot.arrays import Array

_VERSIONS = {(1, 0), (2, 0), (3, 0)}
_LONGEST_HEADER = 10_000
_QUOTES = "'\""
_KEYS = {"descr", "fortran_order", "shape"}
_ORDERS = {"True", "False"}


def _pattern(pattern: str) -> re.Pattern[str]:
    """Compile the pattern of a part of an npy header as NumPy writes or reads it; B stands for blanks."""
    return re.compile(pattern.replace("B", r"[ \t\r\n\f]*"), re.ASCII)


_ENTRY = _pattern(r"""('\w+'|"\w+")B:B(\[[^\]]*\]|\([^()]*\)|'[^']*'|"[^"]*"|\w+)B""")
_HEADER = _pattern(r"\{B(?:E(?:,BE)*(?:,B)?)?\} *\n?".replace("E", _ENTRY.pattern))
_SIZE = _pattern(r"0|[1-9]\d{0,18}")
_SHAPE = _pattern(r"\(B(?:SB,B(?:SB(?:,BSB)*(?:,B)?)?)?\)".replace("S", f"(?:{_SIZE.pattern})L?"))
"""One number in parentheses is not a tuple: it needs a comma."""
_NUMBERS = re.compile(r"""['"]([<>=|]?(?:f[248]|[iu][1248]))['"]""", re.ASCII)


def npy_response(array: Array, headers: dict[str, str]) -> Response:
    """Return an array as an npy response."""
    rows = np.ascontiguousarray(array)
    return Response(b"".join((_head(rows.dtype, rows.shape), rows.data)), headers=headers, media_type=NPY)


@lru_cache
def _head(dtype: np.dtype[Any], shape: tuple[int, ...]) -> bytes:
    """Return what stands before the numbers; NumPy takes as long to write it as to copy a hundred kilobytes."""
    head = BytesIO()
    content = {"descr": np.lib.format.dtype_to_descr(dtype), "fortran_order": False, "shape": shape}
    np.lib.format.write_array_header_1_0(head, content)
    return head.getvalue()


def read_npy(body: bytes | bytearray) -> Array:
    """Return the array in an npy body, as native float64; raises InvalidArray for any other body.

    The header is checked against the actual bytes before anything is allocated, and no object is unpickled. The array
    is over the body itself where that may be written to: a `bytearray` that nobody else needs.
    """
    header, start = _header(body)
    kind = _NUMBERS.fullmatch(header["descr"])
    if kind is None:
        held = quoted(header["descr"].strip(_QUOTES))
        raise InvalidArray(f"the array holds {held}; allowed: integers and floats of up to 64 bits")
    dtype = np.dtype(kind[1])
    shape = tuple(int(size) for size in _SIZE.findall(header["shape"]))
    if not shape:
        raise InvalidArray("the array is a single number; its first dimension counts the entries")
    if len(shape) > 4 or any(size > len(body) for size in shape):
        raise InvalidArray("the array's shape does not match the size of the body")
    count = math.prod(shape)
    if len(body) - start != count * dtype.itemsize:
        raise InvalidArray(f"the array of shape {shape} needs {count * dtype.itemsize} bytes, no more, no fewer")
    flat = np.frombuffer(body, dtype, count, start)
    order: Literal["C", "F"] = "F" if header["fortran_order"] == "True" else "C"
    with np.errstate(invalid="ignore"):  # NumPy warns of a signalling NaN; no field accepts any
        # Writable, because kernels would be compiled for read-only arrays as well: of `bytes` this is a copy.
        return np.require(flat.reshape(shape, order=order), np.float64, ["C", "A", "W"])


def _header(body: bytes | bytearray) -> tuple[dict[str, str], int]:
    """Return the entries of an npy header, word for word, and the offset of the data.

    NumPy parses a header as Python, whose compiler would write warnings about a client's text to the service's log.
    """
    magic, version = body[:6], tuple(body[6:8])
    if magic != b"\x93NUMPY" or len(body) < 12:
        raise InvalidArray("the body is not npy: its first bytes differ")
    if version not in _VERSIONS:
        raise InvalidArray("the version of the npy body is not 1.0, 2.0 or 3.0")
    start = 10 if version == (1, 0) else 12
    end = start + int.from_bytes(body[8:start], "little")
    if end > min(len(body), _LONGEST_HEADER):
        raise InvalidArray(f"the header of the npy body must end before byte {_LONGEST_HEADER}, and before the body")
    text = body[start:end].decode("latin-1")
    entries = _ENTRY.findall(text) if _HEADER.fullmatch(text) else []
    header = {key[1:-1]: value for key, value in entries}
    if (
        set(header) != _KEYS
        or len(entries) > len(header)
        or not _SHAPE.fullmatch(header["shape"])
        or header["fortran_order"] not in _ORDERS
    ):
        raise InvalidArray("the header of the npy body is not a dictionary of descr, fortran_order and shape")
    return header, end
