"""Messages between processes: a pickled object, and large buffers that are sent without copying.

A message on the stream socket contains the number of parts (4 bytes), the length of each (8 bytes), both big-endian,
and the parts. The first part is the pickled object; the others are the buffers that it wraps in `pickle.PickleBuffer`.
"""

import asyncio
import pickle
import socket
import struct
from collections.abc import Iterator
from typing import Any

PIECE = 256 * 1024
"""Size of the pieces in which the event loop sends a large response, [bytes]."""

BUFFER = 1024 * 1024
"""Bytes that a socket holds for the other side, as far as the system allows it: the fewer, the more switches."""

_COUNT = struct.Struct("!I")
_SMALL = 64 * 1024
"""Size of the largest message that is sent in one piece, [bytes]."""


def pieces_of(content: bytes) -> list[pickle.PickleBuffer]:
    """Split bytes into pieces of at most `PIECE` bytes, without copying them."""
    view = memoryview(content)
    return [pickle.PickleBuffer(view[i : i + PIECE]) for i in range(0, len(view), PIECE)]


def send(connection: socket.socket, content: Any) -> None:
    """Send an object; block until the socket has accepted it, or raise OSError if the other side has closed it."""
    for part in _parts(content):
        connection.sendall(part)


async def send_async(connection: socket.socket, content: Any) -> None:
    """Send an object over a non-blocking socket in an event loop; other tasks run between the parts."""
    loop = asyncio.get_running_loop()
    for i, part in enumerate(_parts(content)):
        if i:
            await asyncio.sleep(0)
        await loop.sock_sendall(connection, part)


def receive(connection: socket.socket) -> Any:
    """Wait for the next object and return it; EOFError or OSError if the other side has closed the connection."""
    (count,) = _COUNT.unpack(_read(connection, _COUNT.size))
    lengths = struct.unpack(f"!{count}Q", _read(connection, 8 * count))
    parts = [_read(connection, length) for length in lengths]
    return pickle.loads(parts[0], buffers=parts[1:])  # noqa: S301 - from our own process


async def receive_async(connection: socket.socket) -> Any:
    """Receive an object from a non-blocking socket in an event loop; other tasks run between the parts."""
    (count,) = _COUNT.unpack(await _read_async(connection, _COUNT.size))
    lengths = struct.unpack(f"!{count}Q", await _read_async(connection, 8 * count))
    parts: list[bytearray] = []
    for length in lengths:
        if parts:
            await asyncio.sleep(0)
        parts.append(await _read_async(connection, length))
    return pickle.loads(parts[0], buffers=parts[1:])  # noqa: S301 - from our own process


def _parts(content: Any) -> Iterator[bytes | memoryview]:
    buffers: list[pickle.PickleBuffer] = []
    head = pickle.dumps(content, protocol=pickle.HIGHEST_PROTOCOL, buffer_callback=buffers.append)
    parts = [memoryview(head), *(buffer.raw() for buffer in buffers)]
    lengths = struct.pack(f"!I{len(parts)}Q", len(parts), *(part.nbytes for part in parts))
    first = len(parts) if sum(part.nbytes for part in parts) <= _SMALL else 1
    yield b"".join((lengths, *parts[:first]))
    yield from parts[first:]


def _read(connection: socket.socket, size: int) -> bytearray:
    content = bytearray(size)
    view = memoryview(content)
    while view:
        count = connection.recv_into(view)
        if not count:
            raise EOFError
        view = view[count:]
    return content


async def _read_async(connection: socket.socket, size: int) -> bytearray:
    content = bytearray(size)
    view = memoryview(content)
    while view:
        try:  # uvloop waits for a turn of its loop before each read, even if there is data.
            count = connection.recv_into(view)
        except BlockingIOError:
            count = await asyncio.get_running_loop().sock_recv_into(connection, view)
        if not count:
            raise EOFError
        view = view[count:]
        if size > PIECE:  # it can arrive as fast as it is read: other tasks run in between
            await asyncio.sleep(0)
    return content
