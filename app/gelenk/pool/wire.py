"""Messages between the service and a process of its pool: an object, and large bytes beside it that are not copied.

On a stream socket, big-endian: the count of parts, the length of each, the parts. The first one is the pickled object;
the others are the buffers that it wraps in `pickle.PickleBuffer`.
"""

import asyncio
import pickle
import socket
import struct
from collections.abc import Iterator
from typing import Any

PIECE = 256 * 1024
"""Bytes of a large answer that the event loop sends at once."""

_COUNT = struct.Struct("!I")
_SMALL = 64 * 1024
"""A shorter message is sent in one piece."""


def pieces_of(content: bytes) -> list[pickle.PickleBuffer]:
    """Large bytes in pieces."""
    view = memoryview(content)
    return [pickle.PickleBuffer(view[i : i + PIECE]) for i in range(0, len(view), PIECE)]


def send(connection: socket.socket, content: Any) -> None:
    """Send an object; waits until the other side has room for it.

    Raises:
        OSError: The other side is gone.
    """
    for part in _parts(content):
        connection.sendall(part)


async def send_soon(connection: socket.socket, content: Any) -> None:
    """The same from an event loop, on a socket that does not block; between two parts other tasks run."""
    loop = asyncio.get_running_loop()
    for i, part in enumerate(_parts(content)):
        if i:
            await asyncio.sleep(0)
        await loop.sock_sendall(connection, part)


def receive(connection: socket.socket) -> Any:
    """The next object; waits for it.

    Raises:
        EOFError: The other side is gone.
        OSError: The same, in the middle of something.
    """
    (count,) = _COUNT.unpack(_taken(connection, _COUNT.size))
    lengths = struct.unpack(f"!{count}Q", _taken(connection, 8 * count))
    parts = [_taken(connection, length) for length in lengths]
    return pickle.loads(parts[0], buffers=parts[1:])  # noqa: S301 - from a process of ours


async def receive_soon(connection: socket.socket) -> Any:
    """The same from an event loop, on a socket that does not block; between two parts other tasks run."""
    (count,) = _COUNT.unpack(await _taken_soon(connection, _COUNT.size))
    lengths = struct.unpack(f"!{count}Q", await _taken_soon(connection, 8 * count))
    parts: list[bytearray] = []
    for length in lengths:
        if parts:
            await asyncio.sleep(0)
        parts.append(await _taken_soon(connection, length))
    return pickle.loads(parts[0], buffers=parts[1:])  # noqa: S301 - from a process of ours


def _parts(content: Any) -> Iterator[bytes | memoryview]:
    buffers: list[pickle.PickleBuffer] = []
    head = pickle.dumps(content, protocol=pickle.HIGHEST_PROTOCOL, buffer_callback=buffers.append)
    parts = [memoryview(head), *(buffer.raw() for buffer in buffers)]
    lengths = struct.pack(f"!I{len(parts)}Q", len(parts), *(part.nbytes for part in parts))
    if sum(part.nbytes for part in parts) <= _SMALL:
        yield b"".join((lengths, *parts))
        return
    yield lengths
    yield from parts


def _taken(connection: socket.socket, size: int) -> bytearray:
    content = bytearray(size)
    view = memoryview(content)
    while view:
        count = connection.recv_into(view)
        if not count:
            raise EOFError
        view = view[count:]
    return content


async def _taken_soon(connection: socket.socket, size: int) -> bytearray:
    loop = asyncio.get_running_loop()
    content = bytearray(size)
    view = memoryview(content)
    while view:
        count = await loop.sock_recv_into(connection, view)
        if not count:
            raise EOFError
        view = view[count:]
    return content
