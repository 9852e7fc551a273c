"""Check that a request has a key with the scope of its operation: `Authorization: Bearer gelenk.…`."""

from dataclasses import dataclass
from http import HTTPStatus

from starlette.responses import Response

from gelenk.contract.endpoint import Scope
from gelenk.http.access.keyring import Keyring
from gelenk.http.access.request_context import RequestContext
from gelenk.http.access.route_table import UNKNOWN
from gelenk.http.messages.problems import problem

_REALM = 'Bearer realm="gelenk"'


@dataclass(frozen=True, slots=True)
class KeyCheck:
    """Refuses a request whose operation needs a key, unless it carries one of the keyring with the right scope."""

    keyring: Keyring

    def __call__(self, exchange: RequestContext) -> Response | None:
        """Return the refusal, or None to let the request pass."""
        operation = exchange.operation
        if operation.scope is None and operation is not UNKNOWN:
            return None
        self.keyring.refresh_if_due()
        scheme, _, token = exchange.headers.get(b"authorization", b"").decode("latin-1").partition(" ")
        if scheme.lower() != "bearer":
            return _unauthorised(exchange, "this needs a key: send it as `Authorization: Bearer gelenk.…`", _REALM)
        key = self.keyring.find(token.strip())
        if key is None:
            return _unauthorised(
                exchange, "the key is unknown to this service or has been revoked", f'{_REALM}, error="invalid_token"'
            )
        exchange.key = exchange.scope["gelenk.key"] = key.name
        if operation.scope is not None and operation.scope not in key.scopes:
            return _forbidden(exchange, operation.scope, key.scopes)
        return None


def _unauthorised(exchange: RequestContext, detail: str, challenge: str) -> Response:
    response = problem(exchange.request, HTTPStatus.UNAUTHORIZED, "key-needed", detail)
    response.headers["WWW-Authenticate"] = challenge
    return response


def _forbidden(exchange: RequestContext, needed: Scope, given: frozenset[Scope]) -> Response:
    facts = {"missing_scope": needed, "scopes": sorted(given)}
    detail = f"this needs the scope `{needed}`, which the key lacks"
    response = problem(exchange.request, HTTPStatus.FORBIDDEN, "missing-scope", detail, facts)
    response.headers["WWW-Authenticate"] = f'{_REALM}, error="insufficient_scope", scope="{needed}"'
    return response
