"""Requests and answers as JSON, and as arrays: npy bodies with all other fields in the query."""

import gc
import inspect
import math
from collections.abc import Callable, Mapping
from io import BytesIO
from typing import Any, ParamSpec, TypeVar
from urllib.parse import quote

import numpy as np
import orjson
from httpx2 import Response
from pydantic import BaseModel

from gelenk.client.call import Call, documented
from gelenk.contract.common import Answer, as_lists
from gelenk.errors import InvalidArray, InvalidField, quoted
from gelenk.robot.arrays import Array

P = ParamSpec("P")
A = TypeVar("A", bound=Answer)

_LARGE = 1_000_000
"""Size of an answer that counts as large, in bytes."""


def json_call(method: str, path: str, fields: Mapping[str, Any], answer: type[A], **details: Any) -> Call[A]:
    """Describe a call with JSON in both directions."""
    return Call(method, path, reader(answer), body=encoded(fields), **details)


def encoded(fields: Mapping[str, Any]) -> bytes:
    """Encode the fields of a request as JSON; arrays and models are sent as their content.

    Raises InvalidArray for an array of something other than numbers, and InvalidField for a number that is not finite,
    which JSON cannot express.
    """
    plain = {name: _finite(name, value) if isinstance(value, np.ndarray) else value for name, value in fields.items()}
    content = orjson.dumps(plain, option=orjson.OPT_SERIALIZE_NUMPY, default=_plain)
    if b"null" in content:  # what JSON has for None, and orjson for a number that is not finite
        for name, value in fields.items():
            _check_finite(value, name, "")
    return content


def _check_finite(value: Any, field: str, place: str) -> None:
    """Raise InvalidField if a number in lists and dicts is not finite."""
    if isinstance(value, float) and not math.isfinite(value):
        raise InvalidField(field, f"the number{place and f' at {place[1:]}'} is not finite")
    if isinstance(value, dict | list | tuple):
        for key, part in value.items() if isinstance(value, dict) else enumerate(value):
            _check_finite(part, field, f"{place}/{key}")


def _finite(field: str, array: Array) -> Array:
    array = numbers(array)
    if not np.isfinite(array).all():
        where = np.argwhere(~np.isfinite(array))[0].tolist()
        raise InvalidField(field, f"the number at {where} of the array is not finite")
    return array


def _plain(value: Any) -> Any:
    if isinstance(value, BaseModel):
        return value.model_dump(exclude_unset=True)
    plain = as_lists(value)  # for arrays that are not contiguous, ranges, deques
    if plain is value:
        raise TypeError(f"a {type(value).__name__} cannot be sent as JSON")
    return plain


def reader(answer: type[A]) -> Callable[[Response], A]:
    """Return a function that reads an answer; further fields of a newer service are left out."""

    def read(response: Response) -> A:
        # Of a hundred thousand new poses none is garbage: scanning them takes a good part of the time to read them.
        is_paused = len(response.content) > _LARGE and gc.isenabled()
        if is_paused:
            gc.disable()
        try:
            return answer.model_validate_json(response.content, extra="ignore")
        finally:
            if is_paused:
                gc.enable()

    return read


def numbers(array: Array) -> Array:
    """Return an array that can be sent; integers and short floats keep their type.

    Raises InvalidArray for anything else, and for masked entries, which NumPy would send as numbers.
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


def unpacked(response: Response) -> Array:
    """Decode the array in a response."""
    array: Array = np.load(BytesIO(response.content), allow_pickle=False)
    return array


def fits_query(fields: Mapping[str, Any]) -> bool:
    """Check whether fields fit into a query: numbers, words, and lists of words."""
    return all(
        value is None
        or isinstance(value, bool | int | float | str)
        or (isinstance(value, list | tuple) and all(isinstance(item, str) for item in value))
        for value in fields.values()
    )


def query_of(fields: Mapping[str, Any]) -> dict[str, Any]:
    """Return fields as query parameters; those that are None are left out, and the service decides."""
    return {name: value for name, value in fields.items() if value is not None}


def segment(name: str) -> str:
    """Quote a name as a segment of a path."""
    if not isinstance(name, str):
        raise TypeError(f"a robot, a scene or a job is given by its name, a string, not by {name!r:.80}")
    return quote(name, safe="")


def described_by(
    describe: Callable[P, Call[A]], request: Callable[..., BaseModel], answer: type[A], *before: inspect.Parameter
) -> Callable[P, Call[A]]:
    """Give a description the docstrings of its models."""
    sentences = f"{inspect.getdoc(request)}\n\nReturns:\n    {answer.__name__}: {inspect.getdoc(answer)}"
    return documented(describe, request, sentences, *before)
