"""The first call comes when the service is ready."""

import httpx2
import pytest

from docs.handbook.session import wait_until_ready
from gelenk.client import Client
from gelenk.client.refusals import Refused

READY = httpx2.Response(200, json={"status": "ready"})


def not_ready(failure: str | None, **headers: str) -> httpx2.Response:
    problem = {"type": "urn:gelenk:not-ready", "status": 503, "detail": "not ready", "failure": failure}
    return httpx2.Response(503, json=problem, headers=headers)


def test_the_first_call_waits_until_the_kernels_are_compiled() -> None:
    answers = [
        *(not_ready(None, **{"Retry-After": "0"}) for _ in range(9)),
        httpx2.Response(200, json={"status": "ready"}),
    ]
    with Client(transport=httpx2.MockTransport(lambda _: answers.pop(0))) as client:
        wait_until_ready(client)
    assert answers == []


def test_a_service_that_never_gets_ready_ends_the_build() -> None:
    answers = [not_ready("OSError: no room"), READY]
    with Client(transport=httpx2.MockTransport(lambda _: answers.pop(0))) as client, pytest.raises(Refused):
        wait_until_ready(client)
