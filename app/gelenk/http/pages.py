"""The pages: the studio, for looking at robots, and the documentation, from files on this machine alone.

They work without a network, below any root path, because all of their links are relative. A content security policy
keeps the browser from loading anything from elsewhere. The package fastapi-offline provides the bundles of Swagger UI
and ReDoc; `app/studio` is bundled into the studio's files, of which a browser checks each time whether one has changed.
"""

from pathlib import Path

import fastapi_offline
from fastapi import FastAPI, Request
from starlette.responses import HTMLResponse, Response
from starlette.staticfiles import StaticFiles
from starlette.types import Scope

from gelenk.package_data import studio

STUDIO = studio()
STUDIO_POLICY = (
    "default-src 'none'; script-src 'self'; style-src 'self'; img-src 'self' blob: data:; font-src 'self'; "
    "connect-src 'self' blob:; base-uri 'none'; form-action 'none'; frame-ancestors 'none'"
)
_STUDIO_HEADERS = {
    "Content-Security-Policy": STUDIO_POLICY,
    "Cache-Control": "no-cache",
    "Referrer-Policy": "no-referrer",
    "X-Content-Type-Options": "nosniff",
}
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
<div id="page"></div>
<script src="documentation/bundles/{bundle}"></script>
<script src="documentation/own/{starter}"></script>
</body>
</html>
"""


class _StudioFiles(StaticFiles):
    """The files of the bundle, with the page's own headers."""

    async def get_response(self, path: str, scope: Scope) -> Response:
        response = await super().get_response(path, scope)
        response.headers.update(_STUDIO_HEADERS)
        return response


def install(app: FastAPI) -> None:
    """Serve the studio at `/` and its files below `/studio`; `/docs` to try calls, and `/redoc` to read."""
    files = _StudioFiles(directory=STUDIO)
    app.mount("/documentation/bundles", StaticFiles(directory=_BUNDLES))
    app.mount("/documentation/own", StaticFiles(directory=_OWN))
    app.mount("/studio", files)
    style = '<link rel="stylesheet" href="documentation/bundles/swagger-ui.css">'
    swagger = _PAGE.format(title="try it", style=style, bundle="swagger-ui-bundle.js", starter="swagger.js")
    redoc = _PAGE.format(title="reference", style="", bundle="redoc.standalone.js", starter="redoc.js")

    @app.get("/docs", include_in_schema=False)
    async def docs() -> HTMLResponse:
        return HTMLResponse(swagger, headers={"Content-Security-Policy": _POLICY})

    @app.get("/redoc", include_in_schema=False)
    async def reference() -> HTMLResponse:
        return HTMLResponse(redoc, headers={"Content-Security-Policy": _POLICY})

    @app.get("/", include_in_schema=False)
    async def page(request: Request) -> Response:
        return await files.get_response("index.html", request.scope)
