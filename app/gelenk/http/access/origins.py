"""Rules for pages of other origins in a browser: they change nothing, unless their origin is allowed.

Browsers say with `Sec-Fetch-Site`, older ones with `Origin`, whether a page of another origin sent a request; other
clients send neither. The service uses no cookies, and its responses allow no credentials.
"""

from collections.abc import Sequence
from http import HTTPStatus

from starlette.responses import Response

from gelenk.errors import quoted
from gelenk.http.access.request_context import RequestContext
from gelenk.http.messages.problems import problem

_METHODS = b"GET, HEAD, POST, PUT, DELETE"
_REQUEST_HEADERS = b"Authorization, Content-Type, Last-Event-ID, X-Request-Id"
_ANSWER_HEADERS = (
    b"Gelenk-Robot-Digest, Gelenk-Unsolved, Gelenk-Unsolved-Rows, Location, Retry-After, WWW-Authenticate, X-Request-Id"
)
_PREFLIGHT_SECONDS = b"600"


class Origins:
    """Refuses writes from pages of other origins; lets pages of allowed origins write and read the responses.

    Allowed are origins such as `https://lab.example.org`, in lower case; `*` allows all.
    """

    def __init__(self, allowed: Sequence[str]) -> None:
        self._allowed = frozenset(origin.encode() for origin in allowed)

    def __call__(self, exchange: RequestContext) -> Response | None:
        """Return a refusal, the response to a preflight, or None to let the request pass."""
        origin, site = exchange.headers.get(b"origin"), exchange.headers.get(b"sec-fetch-site")
        if self._allowed:
            exchange.answer_headers.append((b"vary", b"Origin"))
        if origin is None and site is None:
            return None
        if origin is not None and (b"*" in self._allowed or origin.lower() in self._allowed):
            return self._admitted(exchange, origin)
        if exchange.is_safe and not _is_preflight(exchange):
            return None
        if _is_same_origin(exchange, origin, site):
            return None
        shown = "of another origin" if origin is None else f"of the origin {quoted(origin.decode('latin-1'))}"
        detail = f"a page {shown} may not do this; GELENK_ALLOWED_ORIGINS adds origins"
        return problem(exchange.request, HTTPStatus.FORBIDDEN, "cross-origin-refused", detail)

    def _admitted(self, exchange: RequestContext, origin: bytes) -> Response | None:
        """Let the page read the response; answer a preflight at once, since a browser sends no key with it."""
        exchange.answer_headers += [
            (b"access-control-allow-origin", origin),
            (b"access-control-expose-headers", _ANSWER_HEADERS),
        ]
        if not _is_preflight(exchange):
            return None
        exchange.answer_headers += [
            (b"access-control-allow-methods", _METHODS),
            (b"access-control-allow-headers", _REQUEST_HEADERS),
            (b"access-control-max-age", _PREFLIGHT_SECONDS),
        ]
        return Response(status_code=HTTPStatus.NO_CONTENT)


def _is_preflight(exchange: RequestContext) -> bool:
    return exchange.scope["method"] == "OPTIONS" and b"access-control-request-method" in exchange.headers


def _is_same_origin(exchange: RequestContext, origin: bytes | None, site: bytes | None) -> bool:
    """Whether the page belongs to the service itself, or the user opened the address directly."""
    if site is not None:
        return site in {b"same-origin", b"none"}
    # Behind a proxy, the scheme here may differ from the one in the browser: compare host and port.
    host = (origin or b"").partition(b"://")[2]
    return host != b"" and host.lower() == exchange.headers.get(b"host", b"").lower()
