"""Calls of the client as commands for a shell."""

from collections.abc import Callable
from typing import Any

import numpy as np
import pytest

from app.calls.call import NPY, Call
from app.client import Client
from docs.handbook.session import curl


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
