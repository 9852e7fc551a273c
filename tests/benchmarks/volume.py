"""Large batches of Panda configurations through `fk`, end to end over HTTP, with the server's peak memory."""

import json
import statistics
import time
import urllib.request
from collections.abc import Callable
from io import BytesIO
from pathlib import Path

import numpy as np

from tests.benchmarks.server import Running, running
from tests.benchmarks.table import Row
from tests.test_serve import HOST

NPY = "application/x-npy"
ROUNDS = 5


def measure() -> list[Row]:
    """100,000 configurations as npy and 10,000 as JSON."""
    qs = np.random.default_rng(1).uniform(-2.0, 2.0, (100_000, 7))
    with running("service", "/readyz") as server:
        idle = peak_memory(server.pid)
        npy_seconds, npy_memory = median_of(lambda: send_npy(server, qs), server)
        json_seconds, json_memory = median_of(lambda: send_json(server, qs[:10_000]), server)
    return [
        Row("`fk` of 100,000 configurations as npy, end to end", seconds(npy_seconds), memory(npy_memory, idle)),
        Row("`fk` of 10,000 configurations as JSON, end to end", seconds(json_seconds), memory(json_memory, idle)),
    ]


def send_npy(server: Running, qs: np.ndarray[tuple[int, ...], np.dtype[np.float64]]) -> None:
    """One request, and the answer as an array again."""
    buffer = BytesIO()
    np.save(buffer, qs)
    answer = post(server, buffer.getvalue(), NPY, NPY)
    assert np.load(BytesIO(answer)).shape == (len(qs), 7)


def send_json(server: Running, qs: np.ndarray[tuple[int, ...], np.dtype[np.float64]]) -> None:
    """One request, and the answer as Python objects again."""
    body = json.dumps({"joint_positions": qs.tolist()}).encode()
    answer = json.loads(post(server, body, "application/json", "application/json"))
    assert len(answer["poses"]) == len(qs)


def post(server: Running, body: bytes, content_type: str, accept: str) -> bytes:
    """Post to `fk` of the Panda."""
    url = f"http://{HOST}:{server.port}/v1/robots/panda/fk"
    request = urllib.request.Request(url, body, {"Content-Type": content_type, "Accept": accept})
    with urllib.request.urlopen(request, timeout=120) as answer:
        return bytes(answer.read())


def median_of(call: Callable[[], None], server: Running) -> tuple[float, int]:
    """Median seconds of some calls, and the server's peak memory in them, [bytes]."""
    times = []
    for _ in range(ROUNDS):
        started = time.perf_counter()
        call()
        times.append(time.perf_counter() - started)
    return statistics.median(times), peak_memory(server.pid)


def peak_memory(pid: int) -> int:
    """Largest resident set of a process so far, [bytes]."""
    status = Path(f"/proc/{pid}/status").read_text(encoding="ascii")
    line = next(line for line in status.splitlines() if line.startswith("VmHWM"))
    return int(line.split()[1]) * 1024


def seconds(value: float) -> str:
    """A time for the table."""
    return f"{value * 1000:.0f} ms"


def memory(value: int, idle: int) -> str:
    """A peak for the table."""
    return f"peak memory {value / 2**20:.0f} MiB, idle {idle / 2**20:.0f} MiB"
