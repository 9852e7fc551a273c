"""The service answers for its own names alone, and pages of other origins can change nothing."""

import pytest
from fastapi import FastAPI

from gelenk.http.access.origins import ONCE
from tests.http.access.asking import HOST, Answer, application, ask, bearer, keys_for

ELSEWHERE = b"https://page.example"


APP = application()
LAB = application(trusted_hosts=("lab.example.org", "*.example.net"), allowed_origins=("https://lab.example.org:8443",))


def status(app: FastAPI, host: bytes) -> int:
    return ask(app, "/healthz", headers=[(b"host", host)]).status


@pytest.mark.parametrize(
    "host",
    [b"localhost", b"LOCALHOST:8000", b"127.0.0.1", b"127.0.0.1:80", b"[::1]:8000", b"192.0.2.1:8000", b"192.0.2.1"],
)
def test_own_hosts(host: bytes) -> None:
    assert status(APP, host) == 200


@pytest.mark.parametrize(
    "host",
    [
        *(b"lab.example.org", b"localhost.page.example", b"page.example:8000", b"127.0.0.2", b"192.0.2.10", b"[::2]"),
        *(b"localhost:", b"local_host", b"x" * 60_000),
    ],
)
def test_other_hosts_are_refused(host: bytes) -> None:
    for _ in range(2):
        answer = ask(APP, "/v1/robots", headers=[(b"host", host)])
        assert answer.status == 421
        assert answer.problem["type"] == "urn:gelenk:unknown-host"
        assert len(answer.body) < 1024


@pytest.mark.parametrize("headers", [[], [(b"host", b"")], [HOST, HOST], [HOST, (b"host", b"page.example")]])
def test_a_request_names_one_host(headers: list[tuple[bytes, bytes]]) -> None:
    status(APP, HOST[1])
    answer = ask(APP, "/healthz", headers=headers)
    assert (answer.status, answer.problem["type"]) == (400, "urn:gelenk:invalid-host")


@pytest.mark.quick(1)
@pytest.mark.parametrize(
    "host",
    [
        *("a/b", "user@a", "a b", "a ", "a\t", "a\x00b", "<a>", "\xff", "*", "a,b", "a?b", "a#b", "a\\b"),
        *("[::1", "::1", "a:b", "a:1:2", "a:123456", ""),
    ],
)
@pytest.mark.parametrize("trusted", ["*", "*.example.org"])
def test_what_is_no_host_is_none_whatever_it_ends_with(host: str, trusted: str) -> None:
    app = application(trusted_hosts=(trusted,))
    for given in (host, f"localhost, {host}.example.org", f"{host}/.example.org"):
        answer = ask(app, "/healthz", headers=[(b"host", given.encode("latin-1"))])
        assert (answer.status, answer.problem["type"]) == (400, "urn:gelenk:invalid-host")


@pytest.mark.parametrize("name", sorted(ONCE))
def test_what_a_request_may_say_once_it_does_not_say_twice(name: bytes) -> None:
    for values in ((b"a", b"a"), (b"a", b"b"), (b"", b"a")):
        answer = ask(APP, "/healthz", headers=[HOST, *((name, value) for value in values)])
        assert (answer.status, answer.problem["type"]) == (400, "urn:gelenk:repeated-header")
        assert name.decode() in answer.problem["detail"]
    assert status(APP, HOST[1]) == 200


@pytest.mark.parametrize("name", [b"accept", b"prefer", b"x-forwarded-for", b"cache-control", b"cookie", b"x-other"])
def test_lists_may_come_in_several_fields(name: bytes) -> None:
    assert ask(APP, "/healthz", headers=[HOST, (name, b"a"), (name, b"b")]).status == 200


def test_of_two_keys_neither_counts() -> None:
    text, keys = keys_for("read", "write")
    app = application(api_keys=text)
    for one, two in (("read", "write"), ("write", "read"), ("read", "read")):
        assert ask(app, "/v1/robots", headers=(HOST, bearer(keys[one]), bearer(keys[two]))).status == 400


def test_names_that_the_operator_adds() -> None:
    for host, expected in (
        (b"lab.example.org:8443", 200),
        (b"Lab.Example.Org", 200),
        (b"arm.example.net", 200),
        (b"a.b.example.net:1", 200),
        (b"example.net", 421),
        (b"badexample.net", 421),
        (b"x.lab.example.org", 421),
    ):
        assert status(LAB, host) == expected, host
    assert status(application(trusted_hosts=("*",)), b"whatever.example") == 200


def test_hosts_that_were_seen_are_remembered_within_bounds() -> None:
    app = application(trusted_hosts=("*",))
    for i in range(200):
        assert status(app, b"host%d.example" % i) == 200
    assert status(app, b"host150.example") == 200


def crossing(app: FastAPI, method: str, *headers: tuple[bytes, bytes], path: str = "/v1/robots") -> Answer:
    return ask(app, path, method, (HOST, *headers))


@pytest.mark.parametrize("method", ["POST", "PUT", "DELETE", "PATCH"])
@pytest.mark.parametrize(
    "headers",
    [
        [(b"origin", ELSEWHERE)],
        [(b"origin", b"null")],
        [(b"origin", b"http://127.0.0.1:9000")],
        [(b"origin", b"")],
        [(b"sec-fetch-site", b"cross-site")],
        [(b"sec-fetch-site", b"same-site"), (b"origin", b"http://127.0.0.1:8000")],
        [(b"sec-fetch-site", b"cross-site"), (b"origin", ELSEWHERE)],
    ],
)
def test_a_page_of_another_origin_cannot_write(method: str, headers: list[tuple[bytes, bytes]]) -> None:
    for path in ("/v1/robots", "/v1/robots/panda/fk", "/v1/course/gear", "/nothing"):
        answer = crossing(APP, method, *headers, path=path)
        assert (answer.status, answer.problem["type"]) == (403, "urn:gelenk:cross-origin-refused")
        assert answer.all("access-control-allow-origin") == []


@pytest.mark.parametrize(
    "headers",
    [
        [],
        [(b"origin", b"http://127.0.0.1:8000")],
        [(b"origin", b"https://127.0.0.1:8000")],
        [(b"sec-fetch-site", b"same-origin"), (b"origin", b"http://127.0.0.1:8000")],
        [(b"sec-fetch-site", b"none")],
    ],
)
def test_own_pages_and_other_clients_can(headers: list[tuple[bytes, bytes]]) -> None:
    assert crossing(APP, "POST", *headers).status == 415


def test_what_only_reads_is_answered_without_a_word_that_lets_another_page_see_it() -> None:
    answer = crossing(APP, "GET", (b"origin", ELSEWHERE), (b"sec-fetch-site", b"cross-site"))
    assert answer.status == 200
    assert not [name for name, _ in answer.headers if name.startswith("access-control")]
    assert answer.header("cross-origin-resource-policy") == "same-origin"


def test_a_preflight_is_refused_unless_its_origin_is_allowed() -> None:
    wish = (b"access-control-request-method", b"POST"), (b"access-control-request-headers", b"authorization")
    for app in (APP, LAB):
        answer = crossing(app, "OPTIONS", (b"origin", ELSEWHERE), *wish)
        assert answer.status == 403
        assert not [name for name, _ in answer.headers if name.startswith("access-control")]
    answer = crossing(LAB, "OPTIONS", (b"origin", b"https://lab.example.org:8443"), *wish)
    assert (answer.status, answer.body) == (204, b"")
    assert answer.header("access-control-allow-origin") == "https://lab.example.org:8443"
    assert "Authorization" in (answer.header("access-control-allow-headers") or "")
    assert "PUT" in (answer.header("access-control-allow-methods") or "")


def test_a_page_of_an_allowed_origin_can_ask_and_see() -> None:
    for method, expected in (("GET", 200), ("POST", 415)):
        answer = crossing(LAB, method, (b"origin", b"https://lab.example.org:8443"), (b"sec-fetch-site", b"cross-site"))
        assert answer.status == expected
        assert answer.header("access-control-allow-origin") == "https://lab.example.org:8443"
        assert answer.all("access-control-allow-credentials") == []
        assert answer.header("vary") == "Origin"
    assert crossing(LAB, "GET").header("vary") == "Origin"
    assert crossing(LAB, "POST", (b"origin", b"https://lab.example.org")).status == 403
    assert crossing(application(allowed_origins=("*",)), "POST", (b"origin", ELSEWHERE)).status == 415
