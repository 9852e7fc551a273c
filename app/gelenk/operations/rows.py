"""Rows of numbers as JSON and CSV, encoded piece by piece so that other threads get their turn."""

import csv
import math
from collections.abc import Iterable, Sequence
from io import StringIO

import numpy as np
import orjson

from gelenk.robot.arrays import Array

_PIECE = 4096
"""Numbers encoded at once, in a third of a millisecond; no other thread runs meanwhile."""
_LINE_END = "\r\n"


def json_rows(array: Array) -> orjson.Fragment:
    """Encode a large array as a part of a JSON answer; other threads run in between."""
    return json_list(_encoded(array))


def json_list(pieces: Iterable[bytes]) -> orjson.Fragment:
    """Join lists that are JSON already into one list."""
    return orjson.Fragment(b"[" + b",".join(piece[1:-1] for piece in pieces) + b"]")


def csv_head(columns: Sequence[str]) -> bytes:
    """Return the row of names."""
    names = StringIO()
    csv.writer(names, lineterminator=_LINE_END).writerow(columns)
    # A lone surrogate in a joint's name cannot be encoded.
    return names.getvalue().encode(errors="replace")


def csv_rows(array: Array) -> Iterable[bytes]:
    """Return the other rows, in pieces; the array has shape (N, columns)."""
    end = _LINE_END.encode()
    return (piece[2:-2].replace(b"],[", end) + end for piece in _encoded(array))


def _encoded(array: Array) -> Iterable[bytes]:
    """Yield the rows of an array as JSON lists, some at a time."""
    step = max(1, _PIECE // max(1, math.prod(array.shape[1:])))
    for i in range(0, len(array), step):
        yield orjson.dumps(np.ascontiguousarray(array[i : i + step]), option=orjson.OPT_SERIALIZE_NUMPY)
