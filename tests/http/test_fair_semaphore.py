"""Places of an event loop: as many as there are, in turn, and given back by whoever leaves."""

import asyncio

import pytest
from starlette.testclient import TestClient

from gelenk.http.workers.fair_semaphore import FairSemaphore
from gelenk.http.workers.pool_client import PARSED_HERE_BYTES


def test_turns_go_round_the_clients_and_who_leaves_takes_no_place() -> None:
    order: list[str] = []

    async def run() -> None:
        places, gate = FairSemaphore(1), asyncio.Event()

        async def ask(client: str) -> None:
            async with places.taken(client):
                order.append(client)
                await gate.wait()

        tasks = [asyncio.create_task(ask(client)) for client in ("heavy", "heavy", "heavy", "light", "other")]
        await asyncio.sleep(0)
        assert order == ["heavy", "light"], "who has none gets one beyond their number"
        tasks[1].cancel()
        tasks[3].cancel()
        gate.set()
        await asyncio.gather(*tasks, return_exceptions=True)
        assert order == ["heavy", "light", "other", "heavy"]
        async with asyncio.timeout(5.0), places.taken("last"):
            pass

    asyncio.run(run())


@pytest.mark.parametrize("path", ["dh/derive", "robots/panda/workspace"])
def test_a_large_body_is_not_parsed_beside_the_event_loop(client: TestClient, path: str) -> None:
    body = b"{" + b" " * PARSED_HERE_BYTES + b"}"
    answer = client.post(f"/v1/{path}", content=body, headers={"content-type": "application/json"})
    assert (answer.status_code, answer.json()["allowed"]) == (413, PARSED_HERE_BYTES)
