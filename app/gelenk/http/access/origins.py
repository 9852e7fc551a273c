"""Rules for hosts and origins: pages of other origins in a browser change nothing, unless their origin is allowed.

Browsers say with `Sec-Fetch-Site`, older ones with `Origin`, whether a page of another origin sent a request; other
clients send neither. The service uses no cookies, and its responses allow no credentials.

A host that a request names is refused if it is another name that resolves to this machine. The address at which a
connection arrived is always accepted: DNS rebinding uses a name that resolves to it, never the address itself.
"""

import re
from collections.abc import Sequence
from functools import lru_cache
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


LOCAL = ("localhost", "127.0.0.1", "[::1]")
ONCE = frozenset(
    b"authorization content-type origin sec-fetch-site access-control-request-method last-event-id".split()
)
"""Header fields that affect handling and hold a single value."""
_HOST = re.compile(rb"([\w.-]+|\[[0-9a-f:.]+\])(:\d{0,5})?", re.IGNORECASE)


def repeated(exchange: RequestContext) -> Response | None:
    """Refuse a request that repeats a single-valued header field: a proxy may have acted on the other value."""
    if exchange.has_single_fields:
        return None
    names = [name for name, _ in exchange.scope["headers"] if name in ONCE]
    if len(names) == len(set(names)):
        return None
    name = next(name.decode() for name in names if names.count(name) > 1)
    detail = f"a request has the header field `{name}` once at most"
    return problem(exchange.request, HTTPStatus.BAD_REQUEST, "repeated-header", detail)


class TrustedHosts:
    """Refuses requests for hosts not in `names`, in lower case: `*.lab` accepts all below `lab`, `*` every host."""

    def __init__(self, names: Sequence[str]) -> None:
        self._any = "*" in names
        self._names = {*names, *LOCAL}
        self._endings = tuple(name[1:] for name in names if name.startswith("*."))
        self._is_ours = lru_cache(64)(self._names_us)

    def __call__(self, exchange: RequestContext) -> Response | None:
        """Return the refusal, or None to let the request pass."""
        given = exchange.values(b"host")
        if len(given) == 1 and self._is_ours(given[0]):
            return None
        if len(given) != 1 or not _HOST.fullmatch(given[0]):
            detail = "a request names the host that it is for, once: a name or an address, and a port where it has one"
            return problem(exchange.request, HTTPStatus.BAD_REQUEST, "invalid-host", detail)
        name = _without_port(given[0].decode("latin-1").lower())
        if name == _bracketed(exchange.scope.get("server")):
            return None
        detail = f"the service does not answer for the host {quoted(name)}; GELENK_TRUSTED_HOSTS adds names"
        return problem(exchange.request, HTTPStatus.MISDIRECTED_REQUEST, "unknown-host", detail)

    def _names_us(self, host: bytes) -> bool:
        if not _HOST.fullmatch(host):
            return False
        name = _without_port(host.decode("latin-1").lower())
        return self._any or name in self._names or name.endswith(self._endings)


def _without_port(host: str) -> str:
    """Strip the port: `name:8000` → `name`, `[::1]:8000` → `[::1]`."""
    name, colon, port = host.rpartition(":")
    return name if colon and port.isdecimal() else host


def _bracketed(server: tuple[str, int | None] | None) -> str | None:
    """Return the address of a socket as written in a `Host` header."""
    if server is None:
        return None
    return f"[{server[0]}]" if ":" in server[0] else server[0]
