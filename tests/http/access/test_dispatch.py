"""Operations run without FastAPI's routing, which takes longer than most of them."""

import pytest
from fastapi import FastAPI

from gelenk.contract.endpoints import ENDPOINTS
from tests.http.access.asking import application, ask

APP = application()
BY_KIND = {"robot" in endpoint.path: f"/{endpoint.path.format(robot='panda')}" for endpoint in ENDPOINTS}
"""Of a robot, and of no robot."""


@pytest.mark.parametrize("path", BY_KIND.values())
def test_an_operation_is_called_without_fastapi(path: str, monkeypatch: pytest.MonkeyPatch) -> None:
    async def refused(*_: object) -> None:
        raise AssertionError

    monkeypatch.setattr(FastAPI, "__call__", refused)
    assert ask(APP, path, "POST").status == 415
    with pytest.raises(AssertionError):
        ask(APP, path)
