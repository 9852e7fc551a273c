"""Rows of numbers as JSON and CSV, encoded piece by piece so that other threads get their turn."""

import csv
import math
from collections.abc import Iterable, Mapping, Sequence
from io import StringIO

import numpy as np
import orjson

from gelenk.robot.arrays import Array

_PIECE = 4096
"""Numbers encoded at once, in a tenth of a millisecond; no other thread runs meanwhile."""
_FEW = 2 * _PIECE
"""Numbers of an array that is encoded with its answer: pieces would be copied several times."""
_LINE_END = "\r\n"


def json_rows(array: Array) -> orjson.Fragment | Array:
    """Encode a large array as a part of a JSON answer, and let other threads run in between; return a small one."""
    return np.ascontiguousarray(array) if array.size <= _FEW else json_list(_encoded(array))


def json_list(pieces: Iterable[bytes]) -> orjson.Fragment:
    """Join lists that are JSON already into one list."""
    return orjson.Fragment(b"[" + b",".join(piece[1:-1] for piece in pieces) + b"]")


def json_objects(columns: Mapping[str, Array]) -> orjson.Fragment:
    """Encode the rows of arrays of equal length as a list of objects, each with a field for every array."""
    return orjson.Fragment(objects(columns))


def objects(columns: Mapping[str, Array | list[bytes]], around: bytes = b"%b") -> bytes:
    """Encode as `json_objects`; a column may be JSON already, and each object takes the place of `%b` in `around`.

    The numbers are encoded as lists that are then cut apart, without a Python object for each number.
    """
    fields, pieces = [], []
    for name, column in columns.items():
        depth = 0 if isinstance(column, list) else column.ndim - 1
        fields.append(b'"%b":%b%%b%b' % (name.encode(), b"[" * depth, b"]" * depth))
        pieces.append(column if isinstance(column, list) else _pieces(column))
    template = around.replace(b"%b", b"{%b}" % b",".join(fields))
    return b"[%b]" % _filled(template.split(b"%b"), pieces)


def _filled(literals: list[bytes], columns: list[list[bytes]]) -> bytes:
    """Write the literals with entries of the columns between them for each row, and commas between rows.

    One list of all pieces is joined, which takes a third of the time of a format for each row.
    """
    count, step = len(columns[0]), 2 * len(columns) + 1
    row = [b""] * (step * count)
    for i, literal in enumerate([*literals[:-1], literals[-1] + b","]):
        row[2 * i :: step] = [literal] * count
    for i, column in enumerate(columns):
        row[2 * i + 1 :: step] = column
    return b"".join(row)[:-1]


def _pieces(array: Array) -> list[bytes]:
    """Encode each row of an array, without the brackets around it."""
    depth = array.ndim - 1
    between = b"]" * depth + b"," + b"[" * depth
    return [row for piece in _encoded(array) for row in piece[depth + 1 : -depth - 1].split(between)]


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
