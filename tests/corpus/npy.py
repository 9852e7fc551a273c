"""Bodies in NumPy's own format: `REFUSED_NPY` with their verdict, `GOOD_NPY` with the numbers that they hold.

Each is the good array, two configurations of an arm with two joints, with one thing changed. `mentions` are lower-case
words that the lower-cased message has to contain to be of use.
"""

import struct
from io import BytesIO
from typing import NamedTuple

import numpy as np

from gelenk.robot.arrays import Array

VALUES = np.array([[0.25, -0.5], [1.0, 0.125]])
"""Two configurations of two joints; exact in every format of numbers that is allowed, integers apart."""
WHOLE = np.array([[1, -2], [0, 3]])
"""The same for integers."""


class RefusedNpy(NamedTuple):
    """A body that is no array, or not one that a chain of two joints takes."""

    name: str
    body: bytes
    mentions: tuple[str, ...]
    status: int = 422


class GoodNpy(NamedTuple):
    """A body to be accepted, and the configurations that it stands for."""

    name: str
    body: bytes
    values: Array


def saved(array: np.ndarray, version: tuple[int, int] | None = None) -> bytes:
    """The bytes that NumPy itself would write."""
    buffer = BytesIO()
    np.lib.format.write_array(buffer, array, version=version, allow_pickle=True)
    return buffer.getvalue()


def npy(header: str | bytes, data: bytes = b"", version: tuple[int, int] = (1, 0)) -> bytes:
    """Any header before any data."""
    text = header if isinstance(header, bytes) else header.encode()
    length = struct.pack("<H" if version == (1, 0) else "<I", len(text))
    return b"\x93NUMPY" + bytes(version) + length + text + data


def described(descr: str = "'<f8'", fortran: str = "False", shape: str = "(2, 2)", more: str = "") -> str:
    """A header of these parts, each as Python would write it."""
    return f"{{'descr': {descr}, 'fortran_order': {fortran}, 'shape': {shape}, {more}}}\n"


DATA = VALUES.tobytes()
GOOD = saved(VALUES)

NO_ARRAY = (
    RefusedNpy("empty", b"", ("npy",)),
    RefusedNpy("magic alone", GOOD[:6], ("npy",)),
    RefusedNpy("no magic", b"PK\x03\x04" + GOOD[4:], ("npy",)),
    RefusedNpy("JSON", b"[[0.25, -0.5], [1.0, 0.125]]", ("npy",)),
    RefusedNpy("a byte before it", b"\0" + GOOD, ("npy",)),
    RefusedNpy("npz", b"PK\x03\x04" + bytes(100), ("npy",)),
    *(
        RefusedNpy(f"version {major}.{minor}", npy(described(), DATA, (major, minor)), ("version",))
        for major, minor in ((0, 0), (0, 1), (1, 1), (2, 1), (4, 0), (255, 255))
    ),
    RefusedNpy("cut in the magic", GOOD[:7], ("npy",)),
    RefusedNpy("cut in the length of the header", GOOD[:9], ("npy",)),
    RefusedNpy("cut in the header", GOOD[:40], ("npy",)),
    RefusedNpy("header of 4 GB", b"\x93NUMPY\x02\x00\xff\xff\xff\xff" + bytes(100), ("npy",)),
    RefusedNpy("header of 64 kB of blanks", npy(described() + " " * 60_000, DATA), ("npy",)),
)
"""Not npy, or of a version that nobody writes."""

BAD_HEADERS = tuple(
    RefusedNpy(f"header {name}", npy(header, DATA), ("npy",))
    for name, header in (
        ("empty", ""),
        ("a number", "1"),
        ("a list", "[]"),
        ("of NUL", bytes(64)),
        ("open", "{'descr': '<f8'"),
        ("without descr", "{'fortran_order': False, 'shape': (2, 2)}"),
        ("without shape", "{'descr': '<f8', 'fortran_order': False}"),
        ("without fortran_order", "{'descr': '<f8', 'shape': (2, 2)}"),
        ("with a further key", described(more="'more': 1")),
        ("with a key twice", described(more="'shape': (4,)")),
        ("with fortran_order a text", described(fortran="'no'")),
        ("with fortran_order a number", described(fortran="0")),
        ("with a key between two kinds of quotes", described().replace("'shape'", "'shape\"")),
        ("with a shape in a list", described(shape="[2, 2]")),
        ("with a number for a shape", described(shape="(4)")),
        ("with a shape of texts", described(shape="('2', '2')")),
        ("with a shape of floats", described(shape="(2.0, 2.0)")),
        ("with a shape of a number with a zero before it", described(shape="(2, 02)")),
        ("with a shape of nothing", described(shape="None")),
        ("that calls", described(shape="tuple(2, 2)")),
        ("that imports", described(shape="__import__('os').getcwd()")),
        ("that repeats itself", described(shape="(2,) * 2")),
        ("a comprehension", described(shape="tuple(2 for _ in range(2))")),
        ("with an f-string", described(descr="f'<f8'")),
        ("with 3,000 brackets", "(" * 3000 + ")" * 3000),
        ("with 3,000 open brackets", "(" * 3000),
        ("with 4,000 minus signs", described(shape="(" + "-" * 4000 + "2, 2)")),
        ("with an escape sequence", described(more="'\x1b[31m': 1")),
        ("with a backslash that escapes nothing", described(more="'\\\x1b': 1")),
        ("with NUL", described() + "\0"),
        ("with a vertical tab", described() + "\v"),
        ("with a second line", described() + " "),
        ("with a number of 5,000 digits", described(shape="(" + "9" * 5000 + ", 2)")),
        ("with numbers as Python 2 wrote them and no end", "{'descr': '<f8', 'shape': (2L, 2L)"),
    )
)
"""A dictionary of three keys is asked for; the format has it read as Python."""

BAD_KINDS = (
    *(
        RefusedNpy(f"holds {name}", npy(described(descr=descr), bytes(count)), ("integers and floats",))
        for name, descr, count in (
            ("texts", "'<U2'", 32),
            ("bytes", "'|S8'", 32),
            ("truth values", "'|b1'", 4),
            ("complex numbers", "'<c16'", 64),
            ("moments", "'<M8[s]'", 32),
            ("spans of time", "'<m8[s]'", 32),
            ("raw bytes", "'|V8'", 32),
            ("quadruple precision", "'<f16'", 64),
            ("records", "[('a', '<f8'), ('b', '<f8')]", 64),
            ("one field", "[('a', '<f8')]", 32),
            ("rows as a subarray", "[('a', '<f8', (2,))]", 64),
            ("nothing", "'|V0'", 0),
            ("objects", "'|O'", 32),
            ("numbers of ²² bytes", "'<f\xb2'", 32),
            ("a comma in the dtype", "',,,'", 32),
            ("an empty dtype", "''", 32),
            ("a dtype that is a number", "8", 32),
            ("an unknown dtype", "'<q9'", 32),
        )
    ),
    RefusedNpy("pickled objects", saved(np.array([[1, 2], [3, {}]], dtype=object)), ("integers and floats",)),
    RefusedNpy("objects in records", npy(described(descr="[('a', '|O')]"), bytes(32)), ("integers and floats",)),
)
"""Numbers alone are taken; an object would have to be unpickled, which runs code."""

BAD_SHAPES = (
    RefusedNpy("shape of nothing", npy(described(shape="()"), bytes(8)), ("first dimension",)),
    *(
        RefusedNpy(f"shape {shape}", npy(described(shape=shape), DATA), ("shape",))
        for shape in (
            "(-2, 2)",
            "(-2, -2)",
            "(2, 3)",
            "(1, 2)",
            "(4, 2)",
            "(9223372036854775807, 2)",
            "(18446744073709551616, 2)",
            "(4294967296, 4294967296)",
            "(1000000000, 1000000000)",
            "(1, 1, 1, 1, 4)",
            "(2, 2, 0)",
            "(0, 9223372036854775807)",
        )
    ),
    RefusedNpy("65 dimensions", npy(described(shape="(" + "1, " * 65 + ")"), bytes(8)), ("shape",)),
    RefusedNpy("a byte short", GOOD[:-1], ("bytes",)),
    RefusedNpy("data missing", GOOD[: -len(DATA)], ("bytes",)),
    RefusedNpy("a byte too many", GOOD + b"\0", ("bytes",)),
    RefusedNpy("another array behind it", GOOD + GOOD, ("bytes",)),
)
"""The shape and the bytes behind the header tell the same."""

WRONG_FOR_THE_CHAIN = (
    RefusedNpy("a list", saved(VALUES[0]), ("shape",)),
    RefusedNpy("a stack of matrices", saved(VALUES[None]), ("shape",)),
    RefusedNpy("one joint", saved(VALUES[:, :1]), ("2 joints",)),
    RefusedNpy("three joints", saved(np.ones((2, 3))), ("2 joints",)),
    RefusedNpy("no joints", saved(np.ones((2, 0))), ("2 joints",)),
    *(
        RefusedNpy(f"{name} in it", saved(np.array([[0.0, 0.0], [0.0, value]])), ("finite",))
        for name, value in (("NaN", np.nan), ("infinity", np.inf), ("minus infinity", -np.inf))
    ),
    RefusedNpy("NaN in half precision", saved(np.array([[np.nan, 0.0]], dtype=np.float16)), ("finite",)),
    RefusedNpy(
        "a signalling NaN of 32 bits", npy(described("'<f4'", shape="(1, 2)"), b"\1\0\x80\x7f" * 2), ("finite",)
    ),
    RefusedNpy("a signalling NaN", npy(described(shape="(1, 2)"), b"\x01\0\0\0\0\0\xf0\x7f" * 2), ("finite",)),
)
"""An array, but no configurations of two joints."""

REFUSED_NPY: tuple[RefusedNpy, ...] = (*NO_ARRAY, *BAD_HEADERS, *BAD_KINDS, *BAD_SHAPES, *WRONG_FOR_THE_CHAIN)

GOOD_NPY: tuple[GoodNpy, ...] = (
    GoodNpy("as NumPy writes it", GOOD, VALUES),
    GoodNpy("version 2", saved(VALUES, (2, 0)), VALUES),
    GoodNpy("version 3", saved(VALUES, (3, 0)), VALUES),
    GoodNpy("big-endian", saved(VALUES.astype(">f8")), VALUES),
    GoodNpy("column by column", saved(np.asfortranarray(VALUES)), VALUES),
    GoodNpy("column by column and big-endian", saved(np.asfortranarray(VALUES.astype(">f8"))), VALUES),
    GoodNpy("single precision", saved(VALUES.astype(np.float32)), VALUES),
    GoodNpy("half precision", saved(VALUES.astype(np.float16)), VALUES),
    *(GoodNpy(f"integers {code}", saved(WHOLE.astype(code)), WHOLE) for code in ("i1", "<i2", ">i4", "<i8")),
    GoodNpy("unsigned integers", saved(np.abs(WHOLE).astype(np.uint8)), np.abs(WHOLE)),
    GoodNpy("subnormal numbers", saved(np.full((1, 2), 5e-324)), np.full((1, 2), 5e-324)),
    GoodNpy("no entries", saved(np.ones((0, 2))), np.ones((0, 2))),
    GoodNpy("keys in another order", npy("{'shape':(2,2),'fortran_order':False,'descr':'<f8'}", DATA), VALUES),
    GoodNpy("long numbers of Python 2", npy(described(shape="(2L, 2L)"), DATA), VALUES),
    GoodNpy("double quotes", npy(described().replace("'", '"'), DATA), VALUES),
)
"""All that NumPy and others write."""
