"""The documentation pages, from files on this machine alone: they work without a network.

The package fastapi-offline provides the bundles of Swagger UI and ReDoc. A strict content security policy keeps the
browser from loading anything from elsewhere.
"""

from pathlib import Path

import fastapi_offline
from fastapi import FastAPI
from starlette.responses import HTMLResponse
from starlette.staticfiles import StaticFiles

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


def install(app: FastAPI) -> None:
    """Serve `/docs` (to try calls) and `/redoc` (to read). Their links are relative, so any root path works."""
    app.mount("/documentation/bundles", StaticFiles(directory=_BUNDLES))
    app.mount("/documentation/own", StaticFiles(directory=_OWN))
    style = '<link rel="stylesheet" href="documentation/bundles/swagger-ui.css">'
    swagger = _PAGE.format(title="try it", style=style, bundle="swagger-ui-bundle.js", starter="swagger.js")
    redoc = _PAGE.format(title="reference", style="", bundle="redoc.standalone.js", starter="redoc.js")

    @app.get("/docs", include_in_schema=False)
    async def docs() -> HTMLResponse:
        return HTMLResponse(swagger, headers={"Content-Security-Policy": _POLICY})

    @app.get("/redoc", include_in_schema=False)
    async def reference() -> HTMLResponse:
        return HTMLResponse(redoc, headers={"Content-Security-Policy": _POLICY})
