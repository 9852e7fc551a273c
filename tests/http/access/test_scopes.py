"""Every route of the application needs a key, or is known to need none; each key opens what its scopes say."""

import re

import pytest
from fastapi import FastAPI
from fastapi.routing import RouteContext, iter_route_contexts

from tests.http.access.asking import HOST, Answer, application, ask, bearer, keys_for

OPEN = {"/", "/studio", "/docs", "/redoc", "/documentation/bundles", "/documentation/own", "/openapi.json"}
OPEN |= {"/embed", "/handbook", "/handbook/"}
OPEN |= {"/healthz", "/readyz"}
WRITING = {
    ("POST", "/v1/robots"),
    ("PUT", "/v1/robots/{robot}"),
    ("DELETE", "/v1/robots/{robot}"),
    ("PUT", "/v1/robots/{robot}/collision-pairs"),
    ("POST", "/v1/scenes"),
    ("PUT", "/v1/scenes/{scene}"),
    ("DELETE", "/v1/scenes/{scene}"),
    ("POST", "/v1/robots/{robot}/workspace"),
    ("DELETE", "/v1/jobs/{job}"),
}
ADMINISTERING = {("GET", "/metrics")}
TEACHING = {
    ("POST", "/v1/course/exercises/{exercise}/solution"),
    ("POST", "/v1/course/sheets"),
    ("POST", "/v1/course/sheets/grade"),
}

ENTRIES, KEYS = keys_for(
    *("read", "write", "teach", "admin", "read+write", "write+teach+admin", "read+teach+admin", "read+write+teach"),
    *("read+write+admin", "read+write+teach+admin"),
)
OTHERS = {
    "read": "write+teach+admin",
    "write": "read+teach+admin",
    "teach": "read+write+admin",
    "admin": "read+write+teach",
}
APP = application(api_keys=ENTRIES)
ROUTES = [(method, route) for route in iter_route_contexts(APP.routes) for method in sorted(route.methods or {"GET"})]


def expected(method: str, path: str) -> str | None:
    """The scope, said a second time."""
    if path in OPEN:
        return None
    if (method, path) in ADMINISTERING:
        return "admin"
    if (method, path) in TEACHING:
        return "teach"
    return "write" if (method, path) in WRITING else "read"


def filled(route: RouteContext) -> str:
    """A path that the route matches; a route without methods is a folder of files."""
    return re.sub(r"\{[^}]*\}", "nobody", route.path or "") + ("" if route.methods else "/nothing")


def asked(app: FastAPI, method: str, path: str, token: str | None) -> Answer:
    return ask(app, path, method, (HOST, *([] if token is None else [bearer(token)])))


@pytest.mark.quick(1)
@pytest.mark.parametrize(("method", "route"), ROUTES, ids=[f"{m} {r.path}" for m, r in ROUTES])
def test_each_route_has_its_scope(method: str, route: RouteContext) -> None:
    path, scope = filled(route), expected(method, route.path or "")
    if scope is None:
        assert asked(APP, method, path, None).status not in {401, 403}
        return
    refused = asked(APP, method, path, None)
    assert refused.status == 401
    assert refused.problem["type"] == "urn:gelenk:key-needed"
    assert refused.header("www-authenticate") == 'Bearer realm="gelenk"'
    refused = asked(APP, method, path, KEYS[OTHERS[scope]])
    assert refused.status == 403
    assert refused.problem["missing_scope"] == scope
    assert f"`{scope}`" in refused.problem["detail"]
    assert f'scope="{scope}"' in (refused.header("www-authenticate") or "")
    for name, token in KEYS.items():
        if scope in name.split("+"):
            assert asked(APP, method, path, token).status not in {401, 403}


def test_there_is_something_to_walk() -> None:
    assert len(ROUTES) > 45
    assert {expected(method, route.path or "") for method, route in ROUTES} == {None, "read", "write", "teach", "admin"}


@pytest.mark.parametrize(
    "path",
    [
        "",
        "//",
        "/v1",
        "/v1/",
        "/v1/robots/",
        "//v1/robots",
        "/v1//robots",
        "/v1/robots\n",
        "/v1/robots/panda/fk\n",
        "/v1/robots/panda/fk/",
        "/V1/ROBOTS",
        "/healthz/",
        "/healthz\n/v1/robots",
        "/healthz/../v1/robots",
        "/docs/v1/robots",
        "/studio",
        "/studio2",
        "/openapi.json/",
        "/nothing",
        "/metrics/",
        "/metrics2",
    ],
)
@pytest.mark.parametrize("method", ["GET", "HEAD", "POST", "PUT", "DELETE", "PATCH", "OPTIONS", "TRACE", "BREW"])
def test_what_is_no_operation_still_needs_a_key(path: str, method: str) -> None:
    assert asked(APP, method, path, None).status == 401
    assert asked(APP, method, path, KEYS["admin"]).status in {403, 404, 405}


@pytest.mark.parametrize(
    "path", ["/studio/../../main.py", "/studio/../index.html", "/documentation/own/../../problems.py"]
)
def test_open_folders_lead_nowhere_else(path: str) -> None:
    assert asked(APP, "GET", path, None).status == 404


@pytest.mark.parametrize("path", sorted(OPEN))
def test_other_methods_on_an_open_path_need_a_key(path: str) -> None:
    assert asked(APP, "POST", path, None).status == 401


def test_head_is_guarded_as_get() -> None:
    assert asked(APP, "HEAD", "/v1/robots", None).status == 401
    assert asked(APP, "HEAD", "/v1/robots", KEYS["write"]).status == 403
    assert asked(APP, "HEAD", "/v1/robots", KEYS["read"]).status == 200
    assert asked(APP, "HEAD", "/healthz", None).status == 200


def test_the_prefix_of_a_proxy_opens_nothing() -> None:
    app = application(api_keys=ENTRIES, root_path="/gelenk")
    for path in ("/v1/robots", "/gelenk/v1/robots", "/gelenk/v1/robots/panda/fk", "/gelenk/healthz/v1/robots"):
        assert asked(app, "POST", path, None).status == 401
    assert asked(app, "GET", "/gelenk/v1/robots", KEYS["write"]).status == 403
    assert asked(app, "GET", "/gelenk/v1/robots", KEYS["read"]).status == 200
    assert asked(app, "GET", "/gelenk/healthz", None).status == 200
    assert (asked(app, "GET", "/gelenk", None).status, asked(app, "GET", "/gelenk/", None).status) == (307, 200)
    assert asked(app, "GET", "/gelenkish", None).status == 401


@pytest.mark.slow
def test_without_keys_nothing_needs_one() -> None:
    app = application()
    for method, route in ROUTES:
        assert asked(app, method, filled(route), None).status not in {401, 403}, route.path


@pytest.mark.slow
def test_the_schema_says_which_scope_an_operation_needs() -> None:
    with_keys, without = APP.openapi(), application().openapi()
    assert with_keys["components"]["securitySchemes"]["key"]["scheme"] == "bearer"
    for path, operations in with_keys["paths"].items():
        for method, operation in operations.items():
            scope = expected(method.upper(), path)
            security = [] if scope is None else [{"key": [scope]}]
            assert operation.get("security", []) == security
            assert without["paths"][path][method].get("security", []) == ([{}, *security] if security else [])
            assert ("401" in operation["responses"]) == (scope is not None)
            assert {"403", "421"} <= set(operation["responses"])
