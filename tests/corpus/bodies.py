"""Requests that are none, with their verdict, made from one that is: `of_json`, for any operation that takes JSON.

`mentions` are lower-case words that the lower-cased problem has to contain to be of use.
"""

import gzip
import json
from collections.abc import Iterator
from typing import Any, NamedTuple

from tests.corpus.npy import GOOD
from tests.corpus.zips import good as good_zip

JSON = ("content-type", "application/json")
DIGITS = "9" * 400


class Call(NamedTuple):
    """A request, and the statuses that are right for it."""

    name: str
    method: str
    path: str
    statuses: tuple[int, ...]
    mentions: tuple[str, ...] = ()
    body: bytes = b""
    headers: tuple[tuple[str, str], ...] = ()


Place = tuple[str | int, ...]


def of_json(method: str, path: str, example: dict[str, Any]) -> Iterator[Call]:
    """The example of an operation with one thing changed, each change one that no operation takes."""
    for name, body in _not_json(written(example)):
        yield Call(name, method, path, (400,), ("json",), body, (JSON,))
    for place in _ends(list(_numbers(example))):
        for name, token, statuses in _TOKENS:
            body = _with_token(example, place, token)
            yield Call(f"{name} at {_spelt(place)}", method, path, statuses, (), body, (JSON,))
    for name, body in _bad_shapes(example):
        statuses = (202, 422) if not body.strip(b"{}") else (400, 422)  # all fields of a workspace have a default
        yield Call(name, method, path, statuses, (), body, (JSON,))
    for key in _DUPLICABLE & set(example):
        body = written(example)[:-1] + f', "{key}": '.encode() + written(example[key]) + b"}"
        yield Call(f"{key} twice", method, path, (400, 422), (), body, (JSON,))
    for name, headers, statuses in _MEDIA:
        yield Call(name, method, path, statuses, (), written(example), headers)
    announced = (JSON, ("content-length", str(10**12)))
    yield Call("a terabyte announced", method, path, (413,), ("67108864",), written(example), announced)
    squeezed = (JSON, ("content-encoding", "gzip"))
    yield Call("compressed", method, path, (400, 415), (), gzip.compress(written(example)), squeezed)


_DUPLICABLE = {"joint_positions", "dh", "urdf", "targets", "segments", "start", "links", "ratio", "law", "kind"}

_TOKENS: tuple[tuple[str, str, tuple[int, ...]], ...] = (
    *((name, name, (400, 422)) for name in ("NaN", "Infinity", "-Infinity", "1e400", "-1e400")),
    ("400 digits", DIGITS, (400, 422)),
    ("400 digits below zero", "-" + DIGITS, (400, 422)),
    *((f"the token {name}", name, (400,)) for name in ("0x10", "+1", "01", "1.", ".5", "1e", "--1", "1_0", "")),
    ("a text", '"1.5"', (422,)),
    ("true", "true", (422,)),
    ("an object", "{}", (422,)),
    ("an object within lists", "[[[[{}]]]]", (422,)),
    ("a lone surrogate", '"\\ud800"', (400, 422)),
    ("a text of a megabyte", f'"{"x" * 1_000_000}"', (422,)),
)
"""In the place of a number."""

_MEDIA = (
    ("no media type", (), (415,)),
    ("media type empty", (("content-type", ""),), (415,)),
    ("media type text/plain", (("content-type", "text/plain"),), (415,)),
    ("media type of a form", (("content-type", "application/x-www-form-urlencoded"),), (415,)),
    ("media type nearly right", (("content-type", "application/jsonx"),), (415,)),
    ("two media types", (("content-type", "application/json, text/plain"),), (415,)),
    ("media type of 10,000 characters", (("content-type", "x/" + "y" * 10_000),), (415,)),
    ("media type outside ASCII", (("content-type", "application/jsön"),), (415,)),
    ("media type with an escape sequence", (("content-type", "\x1b[31mapplication/json"),), (415,)),
)


def _not_json(good: bytes) -> Iterator[tuple[str, bytes]]:
    """Not JSON in UTF-8, or nested deeper than a recursive parser has stack."""
    text = good.decode()
    yield "no body", b""
    yield "blanks", b" \r\n\t" * 1000
    yield "cut", good[:-1]
    yield "cut in its middle", good[: len(good) // 2]
    yield "text behind it", good + b"}"
    yield "itself behind it", good + good
    yield "NUL behind it", good + b"\0"
    yield "NUL before it", b"\0" + good
    yield "a trailing comma", good[:-1] + b",}"
    yield "a comment", b"/* call */" + good
    yield "single quotes", good.replace(b'"', b"'")
    yield "a raw NUL in a key", good.replace(b'"', b'"\0', 1)
    yield "a raw newline in a key", good.replace(b'"', b'"\n', 1)
    yield "a raw escape sequence in a key", good.replace(b'"', b'"\x1b[31m', 1)
    yield "a broken escape in a key", good.replace(b'"', b'"\\uzz', 1)
    yield "an unknown escape in a key", good.replace(b'"', b'"\\x41', 1)
    yield "invalid UTF-8 in a key", good.replace(b'"', b'"\xff', 1)
    yield "overlong UTF-8 in a key", good.replace(b'"', b'"\xc0\xaf', 1)
    yield "a surrogate as UTF-8 in a key", good.replace(b'"', b'"\xed\xa0\x80', 1)
    yield "a mark of UTF-8", b"\xef\xbb\xbf" + good
    yield "UTF-16", text.encode("utf-16")
    yield "UTF-16 without a mark", text.encode("utf-16-le")
    yield "UTF-32", text.encode("utf-32")
    yield "UTF-7", b"+AHs-" + good[1:]
    yield "compressed without a word", gzip.compress(good)
    yield "an array of NumPy", GOOD
    yield "a zip", good_zip()
    yield "XML", b"<robot/>"
    yield "a form", b"joint_positions=0&joint_positions=1"
    yield "100,000 open brackets", b"[" * 100_000
    yield "100,000 brackets", b"[" * 100_000 + b"]" * 100_000
    yield "100,000 braces", b'{"a":' * 100_000 + b"1" + b"}" * 100_000
    yield "100,000 brackets in a field", good[:-1] + b', "deep": ' + b"[" * 100_000 + b"]" * 100_000 + b"}"


def _bad_shapes(example: dict[str, Any]) -> Iterator[tuple[str, bytes]]:
    """JSON, but not this request."""
    good = written(example)
    yield "null", b"null"
    yield "true", b"true"
    yield "a number", b"17"
    yield "a text", written(good.decode())
    yield "a list", b"[" + good + b"]"
    yield "a list of a million zeros", b"[" + b"0," * 999_999 + b"0]"
    yield "nothing in it", b"{}"
    yield "an unknown field", written({**example, "gripper_force": 1})
    yield "a field in capitals", written({key.upper(): value for key, value in example.items()})
    yield "a field of no name", written({**example, "": 1})
    yield "a field with a lone surrogate", written({**example, "\ud800": 1})
    yield "a field with an escape sequence", written({**example, "\x1b[31m\r\n\0": 1})
    yield "a field of 100,000 characters", written({**example, "k" * 100_000: 1})
    yield "100,000 unknown fields", written({**example, **{f"key{i}": i for i in range(100_000)}})
    yield "an unknown field of ten thousand lists", good[:-1] + b', "deep": [' + b"[]," * 9_999 + b"[]]}"
    yield "a field of Python's", written({**example, "__class__": "x", "__init__": {"a": 1}})
    yield "all of it null", written(dict.fromkeys(example))
    yield "all of it text", written(dict.fromkeys(example, "x" * 2000))
    yield "all of it empty objects", written({key: {} for key in example})


def written(value: Any) -> bytes:
    """JSON in plain ASCII: what lies outside is escaped, lone surrogates too."""
    return json.dumps(value).encode("ascii")


def _numbers(value: Any, place: Place = ()) -> Iterator[Place]:
    """Where there are numbers."""
    children = value.items() if isinstance(value, dict) else enumerate(value) if isinstance(value, list) else ()
    for key, child in children:
        yield from _numbers(child, (*place, key))
    if isinstance(value, int | float) and not isinstance(value, bool):
        yield place


def _ends(places: list[Place]) -> list[Place]:
    """The first and the last of them."""
    return list(dict.fromkeys([*places[:1], *places[-1:]]))


def replaced(value: Any, place: Place, by: Any) -> Any:
    """A copy with something else in a place."""
    if not place:
        return by
    if isinstance(value, dict):
        return {key: replaced(child, place[1:], by) if key == place[0] else child for key, child in value.items()}
    return [replaced(child, place[1:], by) if i == place[0] else child for i, child in enumerate(value)]


def _with_token(example: Any, place: Place, token: str) -> bytes:
    return written(replaced(example, place, "<TOKEN>")).replace(b'"<TOKEN>"', token.encode())


def _spelt(place: Place) -> str:
    return ".".join(map(str, place))
