"""The studio, a page for looking at robots: the files that `app/studio` is bundled into, and nothing else.

Its content security policy allows no inline script, no inline style and no other host. All links of the page are
relative, so any root path works. A browser checks each time whether a file has changed, and gets 304 if not.
"""

from fastapi import FastAPI, Request
from starlette.responses import Response
from starlette.staticfiles import StaticFiles
from starlette.types import Scope

from gelenk.package_data import studio

FILES = studio()

POLICY = (
    "default-src 'none'; script-src 'self'; style-src 'self'; img-src 'self' blob: data:; font-src 'self'; "
    "connect-src 'self' blob:; base-uri 'none'; form-action 'none'; frame-ancestors 'none'"
)
_HEADERS = {
    "Content-Security-Policy": POLICY,
    "Cache-Control": "no-cache",
    "Referrer-Policy": "no-referrer",
    "X-Content-Type-Options": "nosniff",
}


class _StudioFiles(StaticFiles):
    """The files of the bundle, with the page's own headers."""

    async def get_response(self, path: str, scope: Scope) -> Response:
        response = await super().get_response(path, scope)
        response.headers.update(_HEADERS)
        return response


def install(app: FastAPI) -> None:
    """Serve the page at `/` and its files below `/studio`."""
    files = _StudioFiles(directory=FILES)

    @app.get("/", include_in_schema=False)
    async def page(request: Request) -> Response:
        return await files.get_response("index.html", request.scope)

    app.mount("/studio", files)
