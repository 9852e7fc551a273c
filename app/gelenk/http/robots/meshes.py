"""Mesh files as responses: as stored or, for pictures, as small GLB files that a worker has made."""

import asyncio
import gzip
import hashlib
import os
from collections.abc import Sequence
from pathlib import Path
from typing import IO, cast

from starlette.background import BackgroundTask
from starlette.requests import Request
from starlette.responses import Response, StreamingResponse

from gelenk.contract.resources import MESH_TYPES, SMALL_MESH
from gelenk.errors import UnknownMesh
from gelenk.http.encodings import accepts, is_known
from gelenk.http.messages.payloads import preferred_type
from gelenk.http.workers.pool_client import PoolClient
from gelenk.http.workers.task import Context, TaskRequest
from gelenk.operations.display.stored import made, stored_file
from gelenk.store.folders import open_plain
from gelenk.store.library import Library
from gelenk.store.meshes import MESH_SUFFIXES

SANDBOXED = {"Content-Security-Policy": "default-src 'none'; sandbox", "X-Content-Type-Options": "nosniff"}
"""Headers of files from clients: no browser shows them as a page of the service."""
_ASKED_AGAIN = {"Cache-Control": "private, no-cache"}
"""A robot can be replaced at any time: a browser keeps its files, and asks each time whether they have changed."""
_PIECE = 256 * 1024


async def mesh_answer(request: Request, pool_client: PoolClient, library: Library, robot: str, path: str) -> Response:
    """Return a file below a robot's meshes; raises UnknownMesh, or otherwise as `PoolClient.answer`."""
    loaded = await pool_client.resident(request, robot)
    file = await asyncio.to_thread(library.mesh, robot, path)
    suffix = Path(path).suffix.lower()
    offered = [MESH_TYPES[suffix], *([SMALL_MESH] if suffix in MESH_SUFFIXES else [])]
    accept = ",".join(request.headers.getlist("Accept")) or "*/*"
    if _wanted(accept, offered) == SMALL_MESH:
        small = stored_file(loaded, file)
        if not await asyncio.to_thread(_is_there, small):
            packed = await pool_client.content(request, _small, TaskRequest(robot=robot, query=path))
            if packed and not await asyncio.to_thread(_is_there, small):  # as on a full disk
                return Response(gzip.decompress(packed), media_type=SMALL_MESH, headers=_headers(offered))
        if small is not None and await asyncio.to_thread(_has_content, small):
            return await asyncio.to_thread(_file_response, request, small, path, offered, SMALL_MESH)
    return await asyncio.to_thread(_file_response, request, file, path, offered, offered[0])


def _wanted(accept: str, offered: Sequence[str]) -> str:
    """Return the type that a client prefers: the file as it is unless it names the other one."""
    return preferred_type(accept, offered) if SMALL_MESH in accept.lower() else offered[0]


def _small(context: Context, task_request: TaskRequest) -> Response:
    library = context.library
    return Response(made(library.get(task_request.robot), library.mesh(task_request.robot, task_request.query)))


def _is_there(file: Path | None) -> bool:
    return file is not None and file.is_file()


def _has_content(file: Path) -> bool:
    """Return whether a small file shows the mesh; it is empty where only the mesh's own file does."""
    return file.is_file() and file.stat().st_size > 0


def _headers(offered: Sequence[str]) -> dict[str, str]:
    vary = "Accept, Accept-Encoding" if SMALL_MESH in offered else "Accept-Encoding"
    return {**SANDBOXED, **_ASKED_AGAIN, "Vary": vary}


def _file_response(request: Request, file: Path, path: str, offered: Sequence[str], media_type: str) -> Response:
    """Return a file as a response in pieces; raises UnknownMesh if it has been removed.

    Its name ends in `.gz` if it is compressed; a client that does not accept that gets it decompressed.
    """
    try:
        content = open_plain(file)  # once open, it stays readable to its end, even if the robot is replaced
    except FileNotFoundError:
        raise UnknownMesh(path) from None
    status = os.fstat(content.fileno())
    is_packed = file.suffix == ".gz"
    is_sent_packed = is_packed and accepts(",".join(request.headers.getlist("Accept-Encoding")), "gzip")
    stamp = (status.st_mtime_ns, status.st_ino, status.st_size, media_type, is_sent_packed)
    headers = {**_headers(offered), "ETag": f'"{hashlib.sha256(repr(stamp).encode()).hexdigest()[:24]}"'}
    if is_known(headers["ETag"], request.headers.get("If-None-Match", "")):
        content.close()
        return Response(status_code=304, headers=headers)
    if is_sent_packed:
        headers["Content-Encoding"] = "gzip"
    if is_sent_packed or not is_packed:
        headers["Content-Length"] = str(status.st_size)
    is_opened = is_packed and not is_sent_packed
    stream = cast(IO[bytes], gzip.open(content)) if is_opened else content  # noqa: SIM115 (holds nothing but `content`)
    return StreamingResponse(
        iter(lambda: stream.read(_PIECE), b""),
        media_type=media_type,
        headers=headers,
        background=BackgroundTask(content.close),
    )
