"""Mesh files as responses: compressed as stored, or decompressed for clients that do not accept gzip."""

import gzip
import os
import re
from pathlib import Path
from typing import IO, cast

from starlette.background import BackgroundTask
from starlette.responses import Response, StreamingResponse

from gelenk.contract.resources import MESH_TYPES
from gelenk.errors import UnknownMesh
from gelenk.store.folders import open_plain

SANDBOXED = {"Content-Security-Policy": "default-src 'none'; sandbox", "X-Content-Type-Options": "nosniff"}
"""Headers of files from clients: no browser shows them as a page of the service."""
_PIECE = 256 * 1024


def mesh_response(file: Path, path: str, accepted: str) -> Response:
    """Return a mesh, a material or a picture as a response in pieces; raises UnknownMesh if it has been removed.

    The file's name ends in `.gz` if it is compressed; the path is the requested one, `accepted` the `Accept-Encoding`.
    """
    try:
        content = open_plain(file)  # once open, it stays readable to its end, even if the robot is replaced
    except FileNotFoundError:
        raise UnknownMesh(path) from None
    headers = {**SANDBOXED, "Content-Length": str(os.fstat(content.fileno()).st_size)}
    stream = content
    if file.suffix == ".gz":
        headers["Vary"] = "Accept-Encoding"
        if accepts_gzip(accepted):
            headers["Content-Encoding"] = "gzip"
        else:
            del headers["Content-Length"]
            stream = cast(IO[bytes], gzip.open(content))  # noqa: SIM115 (holds nothing but `content`)
    return StreamingResponse(
        iter(lambda: stream.read(_PIECE), b""),
        media_type=MESH_TYPES[Path(path).suffix.lower()],
        headers=headers,
        background=BackgroundTask(content.close),
    )


def accepts_gzip(accepted: str) -> bool:
    """Whether an `Accept-Encoding` names gzip, with a weight above zero (RFC 9110)."""
    return re.search(r"(^|,)gzip(;q=(?!0(\.0*)?(,|$))|,|$)", re.sub(r"\s", "", accepted.lower())) is not None
