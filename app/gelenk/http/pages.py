"""The pages: the studio, for looking at robots, the documentation and the handbook, from this machine's files alone.

They work without a network, below any root path, because all of their links are relative. A content security policy
keeps the browser from loading anything from elsewhere. The package fastapi-offline provides the bundles of Swagger UI
and ReDoc; the studio's files come from `app/studio`, the handbook's from `docs`, and of both a browser checks each time
whether one has changed, unless its name changes with its content.
"""

import asyncio
import gzip
import re
from collections.abc import Sequence
from functools import lru_cache
from pathlib import Path
from typing import cast

import fastapi_offline
from fastapi import FastAPI, Request
from starlette.datastructures import Headers
from starlette.responses import FileResponse, HTMLResponse, RedirectResponse, Response
from starlette.staticfiles import StaticFiles
from starlette.types import Scope

from gelenk.http.encodings import accepts
from gelenk.package_data import handbook, studio

STUDIO = studio()
STUDIO_POLICY = (
    "default-src 'none'; script-src 'self'; style-src 'self'; img-src 'self' blob: data:; font-src 'self'; "
    "connect-src 'self' blob:; base-uri 'none'; form-action 'none'; frame-ancestors 'none'"
)


def embed_policy(ancestors: Sequence[str]) -> str:
    """Return the studio's policy for its page in a frame, which pages of these origins may have."""
    return STUDIO_POLICY.replace("ancestors 'none'", f"ancestors {' '.join(ancestors)}") if ancestors else STUDIO_POLICY


HANDBOOK_POLICY = (
    "default-src 'none'; script-src 'self' 'sha256-ySvT2PEZeueHGC1y2crNuNTfphBynFPP7i+U21fEgX0='; "
    "style-src 'self' 'unsafe-inline'; img-src 'self' data:; font-src 'self'; connect-src 'self'; base-uri 'none'; "
    "form-action 'self'; frame-ancestors 'none'"
)
"""The one script within its pages is the theme's (Furo), which reads whether the reader wants them dark."""
_KEPT = {
    "Cache-Control": "no-cache",
    "Referrer-Policy": "no-referrer",
    "X-Content-Type-Options": "nosniff",
}
_FOREVER = "public, max-age=31536000, immutable"
_NAMED_BY_CONTENT = re.compile(r"(?:chunks|fonts|thumbnails)/.+-[A-Z0-9]{8}\.[a-z0-9]+")
_OF_WHOLE_FILES = frozenset({"accept-ranges", "content-length", "etag"})
_COMPRESSED = frozenset({".css", ".html", ".js", ".json", ".svg", ".txt", ".xml"})
_BUNDLES = Path(fastapi_offline.__file__).parent / "static"
_OWN = Path(__file__).parent / "static"
_POLICY = (
    "default-src 'self'; img-src 'self' data:; style-src 'self' 'unsafe-inline'; script-src 'self'; "
    "worker-src blob:; frame-ancestors 'none'; base-uri 'none'; form-action 'none'"
)
_PAGE = """<!doctype html>
<html lang="en">
<head>
<meta charset="utf-8">
<meta name="viewport" content="width=device-width, initial-scale=1">
<title>Gelenk: {title}</title>
<link rel="icon" href="documentation/bundles/favicon.png">
{style}
</head>
<body style="margin: 0">
<nav style="font-family: sans-serif; padding: 0.8em 20px">
<a href=".">Studio</a> · <a href="handbook/">Handbook</a> · <a href="docs">Try calls</a> · <a href="redoc">Reference</a>
</nav>
<div id="page"></div>
<script src="documentation/bundles/{bundle}"></script>
<script src="documentation/own/{starter}"></script>
</body>
</html>
"""

_NO_EMPTY_BAR = """
<style>
.swagger-ui .scheme-container:not(:has(.auth-wrapper)) { display: none }
</style>"""
"""Swagger UI leaves one where no key is set."""
_NO_HANDBOOK = """<!doctype html>
<html lang="en">
<meta charset="utf-8">
<title>Gelenk handbook</title>
<p>The handbook is not built here: <code>./dev handbook</code> in a checkout builds it.
Then start the service again.</p>
</html>
"""


class _PageFiles(StaticFiles):
    """The files of a bundle, with a policy of their own; with `html` a folder's address is that of its `index.html`."""

    def __init__(self, folder: Path, policy: str, *, html: bool = False) -> None:
        super().__init__(directory=folder, html=html)
        self._headers = {"Content-Security-Policy": policy, **_KEPT}

    async def get_response(self, path: str, scope: Scope) -> Response:
        response = await super().get_response(path, scope)
        response.headers.update(self._headers)
        if _NAMED_BY_CONTENT.fullmatch(path):
            response.headers["Cache-Control"] = _FOREVER
        if Path(path).suffix not in _COMPRESSED and not response.headers.get("content-type", "").startswith("text/"):
            return response
        response.headers["Vary"] = "Accept-Encoding"
        asked = Headers(scope=scope)
        is_whole = isinstance(response, FileResponse) and response.status_code == 200 and "range" not in asked
        if is_whole:
            accepted = ",".join(asked.getlist("accept-encoding"))
            return await asyncio.to_thread(_compressed, cast(FileResponse, response), accepted)
        return response


def _compressed(response: FileResponse, accepted: str) -> Response:
    """Return the same file compressed as the client takes it; the tag becomes a weak one, which names all forms."""
    tag = response.headers["etag"]
    for coding in ("br", "gzip"):
        packed = _packed(str(response.path), coding, tag) if accepts(accepted, coding) else None
        if packed is not None:
            kept = {name: value for name, value in response.headers.items() if name not in _OF_WHOLE_FILES}
            return Response(packed, headers={**kept, "content-encoding": coding, "etag": f"W/{tag}"})
    return response


@lru_cache(maxsize=256)
def _packed(path: str, coding: str, tag: str) -> bytes | None:  # noqa: ARG001 - a file that has changed has another one
    """Return a file by gzip, or as the studio's build left it beside the file by Brotli; None where there is none."""
    if coding == "gzip":
        return gzip.compress(Path(path).read_bytes(), mtime=0)
    built = Path(f"{path}.br")
    return built.read_bytes() if built.is_file() else None


def install(app: FastAPI, frame_ancestors: Sequence[str] = ()) -> None:
    """Serve the studio at `/` and its files below `/studio`; `/docs` to try calls, `/redoc` and `/handbook` to read.

    `/embed` is the studio's picture alone, for frames in pages of `frame_ancestors`.
    """
    files = _PageFiles(STUDIO, STUDIO_POLICY)
    app.mount("/documentation/bundles", StaticFiles(directory=_BUNDLES))
    app.mount("/documentation/own", StaticFiles(directory=_OWN))
    app.mount("/studio", files)
    style = '<link rel="stylesheet" href="documentation/bundles/swagger-ui.css">' + _NO_EMPTY_BAR
    swagger = _PAGE.format(title="try it", style=style, bundle="swagger-ui-bundle.js", starter="swagger.js")
    redoc = _PAGE.format(title="reference", style="", bundle="redoc.standalone.js", starter="redoc.js")

    @app.get("/docs", include_in_schema=False)
    async def docs() -> HTMLResponse:
        return HTMLResponse(swagger, headers={"Content-Security-Policy": _POLICY})

    @app.get("/redoc", include_in_schema=False)
    async def reference() -> HTMLResponse:
        return HTMLResponse(redoc, headers={"Content-Security-Policy": _POLICY})

    _install_handbook(app)

    @app.get("/", include_in_schema=False)
    async def page(request: Request) -> Response:
        return await files.get_response("index.html", request.scope)

    framed = {"Content-Security-Policy": embed_policy(frame_ancestors)}

    @app.get("/embed", include_in_schema=False)
    async def embed(request: Request) -> Response:
        response = await files.get_response("index.html", request.scope)
        response.headers.update(framed)
        return response


def _install_handbook(app: FastAPI) -> None:
    """Serve the handbook, or in its place how to build it."""

    @app.get("/handbook", include_in_schema=False)
    async def with_slash() -> Response:
        return RedirectResponse("handbook/")  # all of its links are relative to its folder

    if (handbook() / "index.html").is_file():
        app.mount("/handbook", _PageFiles(handbook(), HANDBOOK_POLICY, html=True))
        return

    @app.get("/handbook/", include_in_schema=False)
    async def how_to_build() -> HTMLResponse:
        return HTMLResponse(_NO_HANDBOOK)
