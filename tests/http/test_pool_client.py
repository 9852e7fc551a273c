"""Heavy requests of one client leave room for those of others; whose a request is."""

import asyncio
import threading
import time
from concurrent.futures import ThreadPoolExecutor
from pathlib import Path
from types import SimpleNamespace
from typing import Any, cast

import pytest
from starlette.requests import Request
from starlette.testclient import TestClient

from gelenk.contract.endpoint import Scope
from gelenk.http.access.keyring import new_key
from gelenk.http.workers.pool_client import PoolClient, client_of
from gelenk.main import create_app
from gelenk.settings import Settings

SLOW = {"targets": [{"position": [9.0, 0.0, 0.0], "rotation_vector": [0, 0, 0]}] * 10_000, "solutions": "all"}


def scope(**more: Any) -> Request:
    return Request({"type": "http", "headers": [], **more})


@pytest.mark.parametrize(
    ("more", "client"),
    [
        ({"client": ("10.0.0.7", 1)}, "10.0.0.7"),
        ({"client": ("127.0.0.1", 1)}, ""),
        ({"client": ("::1", 1)}, ""),
        ({"client": None}, ""),
        ({"client": ("127.0.0.1", 1), "gelenk.key": "lab"}, "key lab"),
        ({"client": ("10.0.0.7", 1), "gelenk.key": "lab"}, "key lab"),
    ],
)
def test_a_client_is_its_key_or_its_address(more: dict[str, Any], client: str) -> None:
    assert client_of(scope(**more)) == client


def test_in_a_turn_of_the_event_loop_one_long_answer_is_computed_there() -> None:
    async def turns() -> list[bool]:
        pool_client = PoolClient(
            cast(Any, SimpleNamespace(is_starting=False)), cast(Any, None), cast(Any, None), 1.0, 1
        )
        may = []
        for seconds in (0.0, 2e-3):
            assert pool_client.note_computation(seconds) == (seconds > 0.0)
            may.append(pool_client.may_compute_here)
        await asyncio.sleep(0)
        return [*may, pool_client.may_compute_here]

    assert asyncio.run(turns()) == [True, False, True]


@pytest.mark.slow
def test_a_client_with_its_share_at_work_is_told_so(tmp_path: Path) -> None:
    settings = Settings(data_dir=tmp_path, client_requests=1, crew_processes=2)
    answers: list[Any] = []
    with TestClient(create_app(settings), client=("10.0.0.7", 50000)) as one:
        slow = threading.Thread(
            target=lambda: answers.append(one.post("/v1/robots/panda/ik", json={**SLOW, "time_limit": 6.0}))
        )
        slow.start()
        until = time.monotonic() + 60
        while not one.app.state.pool.requests.busy:  # type: ignore[attr-defined]
            assert time.monotonic() < until
            time.sleep(0.01)
        refused = one.post("/v1/robots/panda/ik", json={**SLOW, "time_limit": 0.1})
        assert refused.status_code == 429, refused.text
        assert refused.json()["type"] == "urn:gelenk:too-many-requests"
        assert refused.json()["limit"] == "client"
        assert int(refused.headers["retry-after"]) >= 1
        assert one.get("/healthz").status_code == 200
        slow.join(60)
        assert answers[0].status_code == 200
        assert one.post("/v1/robots/panda/ik", json={**SLOW, "time_limit": 0.1}).status_code == 200


@pytest.mark.slow
def test_a_key_with_slow_requests_does_not_hold_up_another(tmp_path: Path) -> None:
    """Not even where they have all processes and many more wait; nor with its jobs."""
    tokens, keys = zip(*(new_key(name, list(Scope)) for name in ("heavy", "light")), strict=True)
    heavy, light = ({"Authorization": f"Bearer {token}"} for token in tokens)
    settings = Settings(
        data_dir=tmp_path, crew_processes=2, unfinished_jobs=4, api_keys="\n".join(key.entry() for key in keys)
    )
    with ThreadPoolExecutor(4) as pool, TestClient(create_app(settings)) as client:

        def ask(seconds: float, headers: dict[str, str]) -> int:
            call = {**SLOW, "time_limit": seconds}
            return int(client.post("/v1/robots/panda/ik", json=call, headers=headers).status_code)

        slow = [pool.submit(ask, 15.0, heavy) for _ in range(4)]  # a job of the same key waits for them
        until = time.monotonic() + 60
        while len(client.app.state.pool.requests.turns) < 2:  # type: ignore[attr-defined]
            assert time.monotonic() < until
            time.sleep(0.01)
        for _ in range(3):
            assert ask(0.1, light) == 200
        assert not any(task.done() for task in slow), "none of them has had to end for it"
        job = {"kind": "grid", "samples": 10_000_000}
        statuses = [client.post("/v1/robots/panda/workspace", json=job, headers=heavy) for _ in range(5)]
        assert [answer.status_code for answer in statuses] == [202] * 4 + [429]
        assert (statuses[-1].json()["limit"], statuses[-1].json()["allowed"]) == ("client", 4)
        small = client.post("/v1/robots/panda/workspace", json={**job, "samples": 1000}, headers=light)
        assert small.status_code == 202
        until = time.monotonic() + 240  # it shares the processes with four jobs that take all of them
        while client.get(small.headers["location"], headers=light).json()["state"] != "succeeded":
            assert time.monotonic() < until
            time.sleep(0.05)
        for answer in statuses[:4]:
            assert client.delete(answer.headers["location"], headers=heavy).json()["state"] == "cancelled"
