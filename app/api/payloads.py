"""Bodies in, answers out: JSON and NumPy's npy, strictly."""

from collections.abc import AsyncGenerator
from io import BytesIO
from typing import Any, TypeVar

import numpy as np
import orjson
from starlette.requests import ClientDisconnect, Request
from starlette.responses import Response
from starlette.types import Receive, Scope, Send

from app.model.arrays import Array
from app.model.errors import InvalidArray, TooLarge
from app.schemas.common import Payload

JSON = "application/json"
NPY = "application/x-npy"

_Model = TypeVar("_Model", bound=Payload)


class BoundedRequest(Request):
    """A request whose body is read no further than allowed, whoever reads it.

    It does its own reading of headers and body, both plainer than Starlette's, because every call pays for them.
    """

    def __init__(self, scope: Scope, receive: Receive, send: Send, max_bytes: int) -> None:
        super().__init__(scope, receive, send)
        self._max_bytes = max_bytes
        self._fields: dict[bytes, bytes] = dict(scope["headers"])

    @property
    def media_type(self) -> str:
        """The media type of the body, lower case, without parameters; "" where none is given."""
        return self._fields.get(b"content-type", b"").partition(b";")[0].strip().lower().decode("latin-1")

    @property
    def wants_npy(self) -> bool:
        """Whether the caller asks for the answer as npy."""
        return NPY.encode() in self._fields.get(b"accept", b"").lower()

    async def stream(self) -> AsyncGenerator[bytes, None]:
        """The body in pieces.

        Raises:
            TooLarge: It is larger than allowed, or says so.
            ClientDisconnect: The caller has left.
        """
        announced = self._fields.get(b"content-length", b"0")
        self._check(int(announced) if announced.isdigit() else 0)
        count, more = 0, True
        while more:
            message = await self.receive()
            if message["type"] == "http.disconnect":
                raise ClientDisconnect
            chunk = message.get("body", b"")
            count += len(chunk)
            self._check(count)
            more = message.get("more_body", False)
            yield chunk

    def _check(self, count: int) -> None:
        if count > self._max_bytes:
            raise TooLarge("bytes in the body", count, self._max_bytes)


def json_response(content: Any, status: int = 200, headers: dict[str, str] | None = None) -> Response:
    """Python objects and NumPy arrays as JSON, numbers at full double precision."""
    body = orjson.dumps(content, option=orjson.OPT_SERIALIZE_NUMPY)
    return Response(body, status, headers, JSON)


def npy_response(array: Array) -> Response:
    """An array as npy."""
    buffer = BytesIO()
    np.lib.format.write_array(buffer, np.ascontiguousarray(array), allow_pickle=False)
    return Response(buffer.getvalue(), media_type=NPY)


def read_npy(body: bytes) -> Array:
    """The array in an npy body, as native float64.

    The header is checked against the bytes that are there before anything is allocated, and no object is unpickled.

    Raises:
        InvalidArray: Not npy, not numbers, or not as many bytes as its header says.
    """
    stream = BytesIO(body)
    try:
        version = np.lib.format.read_magic(stream)
        if version == (1, 0):
            shape, fortran_order, dtype = np.lib.format.read_array_header_1_0(stream)
        else:
            shape, fortran_order, dtype = np.lib.format.read_array_header_2_0(stream)
    except (ValueError, SyntaxError, TypeError, RecursionError, MemoryError) as error:
        raise InvalidArray("the body is not an npy array of version 1 or 2") from error
    if dtype.kind not in "fiu" or dtype.itemsize > 8 or dtype.hasobject:
        raise InvalidArray(f"the array holds {dtype.str}; allowed are integers and floats of up to 64 bits")
    if any(size < 0 for size in shape) or len(shape) > 4:
        raise InvalidArray("the array's shape is not one: at most 4 dimensions, none negative")
    count = 1
    for size in shape:
        count *= size
    if len(body) - stream.tell() != count * dtype.itemsize:
        raise InvalidArray(
            f"the array of shape {shape} needs {count * dtype.itemsize} bytes of data, no more, no fewer"
        )
    flat = np.frombuffer(body, dtype, count, stream.tell())
    shaped = flat.reshape(shape, order="F" if fortran_order else "C")
    return np.ascontiguousarray(shaped, dtype=np.float64)


def from_query(model: type[_Model], request: Request) -> _Model:
    """A model from the query string, where the body is an array; repeated keys make a list.

    Raises:
        ValidationError: A value is not what the model asks for.
    """
    values: dict[str, Any] = {}
    for key in request.query_params:
        items = request.query_params.getlist(key)
        values[key] = items if len(items) > 1 else items[0]
    return model.model_validate_strings(values)
