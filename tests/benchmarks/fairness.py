"""What a client with light requests sees beside one that sends the most expensive requests it may.

Both have a key of their own. The light one asks one request after the other, of a kind that the event loop answers and
of one that takes a process; the heavy one keeps a dozen connections busy. What is told is the light one's latency, as a
multiple of what it is when nobody else is there.
"""

import asyncio
import contextlib
import multiprocessing
import os
import time
from collections.abc import Iterator, Mapping
from contextlib import contextmanager
from pathlib import Path
from tempfile import TemporaryDirectory

import numpy as np

from gelenk.contract.endpoint import Scope
from gelenk.http.access.keyring import new_key
from tests.benchmarks.load import CROWD_NICENESS, FK, Call, asked, p99, request_of, serving
from tests.benchmarks.table import Row

CONNECTIONS = 12
SECONDS, LEAD_SECONDS = 20.0, 3.0
"""How long the light client is watched, and how long the heavy one is there before."""
PAUSE = 0.01
WANTED = 5.0

HOME = [0.0, -0.785, 0.0, -2.356, 0.0, 1.571, 0.785]
BOX = ([0.3, -0.4, 0.2], [0.6, 0.4, 0.6])
TARGETS = [
    {"position": position, "rpy": [3.0, 0.2, 0.4]}
    for position in np.random.default_rng(0).uniform(*BOX, (1000, 3)).tolist()
]
FAR = {"position": [9.0, 0.0, 0.0], "rpy": [0.0, 0.0, 0.0]}
ROWS = [[round(0.1 * (i % 7), 3)] * 7 for i in range(1_500_000)]

LIGHT = {
    "`fk` of one, on the event loop": Call(*FK),
    "`ik` of 1,000, in a process": Call("panda/ik", {"targets": TARGETS, "tip_frame": "panda_link8"}),
}
HEAVY = {
    "every solution of 2,000 targets": Call(
        "panda/ik", {"targets": [FAR] * 2000, "solutions": "all", "time_limit": 60.0, "max_solutions": 500}
    ),
    "100 nearest singularities": Call("panda/singularities", {"joint_positions": [HOME] * 100, "nearest": True}),
    "a body of 60 MB": Call("panda/fk", {"joint_positions": ROWS}),
    "an answer of 100 MB": Call("panda/fk", {"joint_positions": ROWS[:60_000], "frames": "all"}),
    "four jobs": Call("panda/workspace", {"kind": "cloud", "samples": 3_000_000}),
}


def measure() -> list[Row]:
    """The rows: about five minutes."""
    tokens, keys = zip(*(new_key(name, list(Scope)) for name in ("light", "heavy")), strict=True)
    with TemporaryDirectory() as folder:
        file = Path(folder, "keys")
        file.write_text("".join(f"{key.entry()}\n" for key in keys))
        with serving(1, tokens[0], GELENK_API_KEYS=str(file)) as (url, _):
            requests = {what: request_of(call, tokens[0]) for what, call in LIGHT.items()}
            asyncio.run(watched(url, requests, SECONDS / 4))
            quiet, rows = asyncio.run(watched(url, requests, SECONDS)), []
            for load, call in HEAVY.items():
                with crowd(url, request_of(call, tokens[1])):
                    time.sleep(LEAD_SECONDS)
                    beside = asyncio.run(watched(url, requests, SECONDS))
                rows += [row(what, load, quiet[what], beside[what]) for what in LIGHT]
            return rows


def row(what: str, load: str, quiet: list[float], beside: list[float]) -> Row:
    """One of the table."""
    ratio = p99(beside) / p99(quiet)
    return Row(f"{what}, beside {load}", told(beside), f"quiet, {told(quiet)}", ratio, f"≤ {WANTED:g}")


def told(latencies: list[float]) -> str:
    """Median and 99 % of latencies."""
    median = sorted(latencies)[len(latencies) // 2]
    return f"{1e3 * median:.1f} ms, 99 % within {1e3 * p99(latencies):.1f} ms of {len(latencies)}"


async def watched(url: str, requests: Mapping[str, bytes], seconds: float) -> dict[str, list[float]]:
    """How long each kind of request takes, one after the other, [s]; what has no answer by the end took until then."""
    return {what: await _latencies(url, request, seconds / len(requests)) for what, request in requests.items()}


async def _latencies(url: str, request: bytes, seconds: float) -> list[float]:
    found: list[float] = []
    began = time.perf_counter()
    with contextlib.suppress(TimeoutError):
        async with asyncio.timeout(seconds), contextlib.aclosing(asked(url, request, began + seconds)) as answers:
            async for answer in answers:
                if answer.status != 200:
                    raise RuntimeError(f"a light request was answered by {answer.status}")
                found.append(answer.latency)
                await asyncio.sleep(PAUSE)
                began = time.perf_counter()
        return found
    return [*found, time.perf_counter() - began]


@contextmanager
def crowd(url: str, request: bytes) -> Iterator[None]:
    """The heavy client at work, in a process of its own that stands for another machine."""
    process = multiprocessing.get_context("spawn").Process(target=_keep_busy, args=(url, request), daemon=True)
    process.start()
    try:
        yield
    finally:
        process.kill()
        process.join()
        time.sleep(1.0)


def _keep_busy(url: str, request: bytes) -> None:
    os.nice(CROWD_NICENESS)

    async def one() -> None:
        async for answer in asked(url, request, float("inf")):
            await asyncio.sleep(answer.retry_after)

    async def run() -> None:
        await asyncio.gather(*(one() for _ in range(CONNECTIONS)))

    asyncio.run(run())
