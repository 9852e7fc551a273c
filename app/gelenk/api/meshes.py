"""Mesh files as answers: as they are kept, or decompressed for clients that do not take gzip."""

import gzip
import os
import re
from pathlib import Path
from typing import IO, cast

from starlette.background import BackgroundTask
from starlette.responses import Response, StreamingResponse

from gelenk.model.errors import UnknownMesh
from gelenk.store.folders import open_plain

SANDBOXED = {"Content-Security-Policy": "default-src 'none'; sandbox", "X-Content-Type-Options": "nosniff"}
"""Files that came from outside: shown by no browser as a page of ours."""
MEDIA_TYPES = {
    ".stl": "model/stl",
    ".obj": "model/obj",
    ".dae": "model/vnd.collada+xml",
    ".mtl": "model/mtl",
    ".png": "image/png",
    ".jpg": "image/jpeg",
    ".jpeg": "image/jpeg",
}
_PIECE = 256 * 1024


def mesh_response(file: Path, path: str, accepted: str) -> Response:
    """Send a mesh, a material or a picture, piece by piece.

    Args:
        file: On disk, with `.gz` at the end of its name where it is compressed.
        path: As the client named it.
        accepted: The request's `Accept-Encoding`.

    Raises:
        UnknownMesh: It has been removed.
    """
    try:
        kept = open_plain(file)  # once open, it is there to its end, whoever replaces the robot meanwhile
    except FileNotFoundError:
        raise UnknownMesh(path) from None
    headers = {**SANDBOXED, "Content-Length": str(os.fstat(kept.fileno()).st_size)}
    stream = kept
    if file.suffix == ".gz":
        headers["Vary"] = "Accept-Encoding"
        if accepts_gzip(accepted):
            headers["Content-Encoding"] = "gzip"
        else:
            del headers["Content-Length"]
            stream = cast(IO[bytes], gzip.open(kept))  # noqa: SIM115 (holds nothing but `kept`)
    return StreamingResponse(
        iter(lambda: stream.read(_PIECE), b""),
        media_type=MEDIA_TYPES[Path(path).suffix.lower()],
        headers=headers,
        background=BackgroundTask(kept.close),
    )


def accepts_gzip(accepted: str) -> bool:
    """Whether an `Accept-Encoding` names gzip, with a weight above zero (RFC 9110)."""
    return re.search(r"(^|,)gzip(;q=(?!0(\.0*)?(,|$))|,|$)", re.sub(r"\s", "", accepted.lower())) is not None
