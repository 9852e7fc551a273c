"""Calls of the client as commands for a shell; and the first call comes when the service is ready."""

from collections.abc import Callable
from typing import Any

import httpx2
import numpy as np
import pytest

from app.calls.call import NPY, Call
from app.calls.refusals import Refused
from app.client import Client
from docs.handbook.session import curl, wait_until_ready

READY = httpx2.Response(200, json={"status": "ready"})


class Noting(Client):
    """Sends nothing, and keeps what it was to send."""

    def __init__(self) -> None:
        super().__init__()
        self.noted: list[Call[Any]] = []

    def send(self, call: Call[Any]) -> Any:
        self.noted.append(call)


def command(ask: Callable[[Any], object]) -> str:
    with Noting() as client:
        ask(client)
        (call,) = client.noted
        return curl(call)


@pytest.mark.parametrize(
    ("ask", "expected"),
    [
        (lambda gelenk: gelenk.robots(), "curl -s http://127.0.0.1:8000/v1/robots"),
        (
            lambda gelenk: gelenk.dh_table("ur5", convention="modified"),
            "curl -s 'http://127.0.0.1:8000/v1/robots/ur5/dh?convention=modified'",
        ),
        (
            lambda gelenk: gelenk.fk("scara", joint_positions=[[0, 0, 0, 0]]),
            "curl -s http://127.0.0.1:8000/v1/robots/scara/fk -H 'Content-Type: application/json' -d '{body}'".format(
                body='{"joint_positions":[[0,0,0,0]]}'
            ),
        ),
        (
            lambda gelenk: gelenk.picture("v1/jobs/a/result", "png"),
            "curl -s http://127.0.0.1:8000/v1/jobs/a/result -H 'Accept: image/png' -o picture.png",
        ),
        (lambda gelenk: gelenk.remove_robot("mine"), "curl -X DELETE -s http://127.0.0.1:8000/v1/robots/mine"),
        (
            lambda gelenk: gelenk.add_archive("mine", b"PK"),
            "curl -s http://127.0.0.1:8000/v1/robots -F name=mine -F description= -F archive=@FILE",
        ),
    ],
)
def test_a_call_is_the_same_in_a_shell(ask: Callable[[Any], object], expected: str) -> None:
    assert command(ask) == expected


def test_an_array_goes_as_a_file() -> None:
    shown = command(lambda gelenk: gelenk.fk("planar_2r", joint_positions=np.zeros((5, 2))))
    assert f"-H 'Content-Type: {NPY}' --data-binary @array.npy" in shown


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


def test_what_nobody_would_read_goes_as_a_file() -> None:
    shown = command(lambda gelenk: gelenk.fk("planar_2r", joint_positions=[[0.25, 0.75]] * 500))
    assert shown.endswith("-H 'Content-Type: application/json' -d @request.json")
