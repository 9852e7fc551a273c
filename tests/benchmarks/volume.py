"""Large batches of Panda configurations through `fk`, end to end over HTTP, with the server's peak memory."""

import json
import statistics
import time
import urllib.request
from collections.abc import Callable
from io import BytesIO
from pathlib import Path

import numpy as np

from app.model.arrays import Array
from tests.benchmarks.server import Running, running
from tests.benchmarks.table import Row
from tests.test_serve import HOST

NPY = "application/x-npy"
ROUNDS = 5


def measure() -> list[Row]:
    """100,000 configurations as npy and 10,000 as JSON."""
    qs = np.random.default_rng(1).uniform(-2.0, 2.0, (100_000, 7))
    return [
        row("`fk` of 100,000 configurations as npy, end to end", send_npy, qs),
        row("`fk` of 10,000 configurations as JSON, end to end", send_json, qs[:10_000]),
    ]


def row(what: str, send: Callable[[Running, Array], None], qs: Array) -> Row:
    """Median time of some calls, on a server of their own, because a process's peak memory never falls."""
    with running("service", "/readyz") as server:
        idle = peak_memory(server.pid)
        times = []
        for _ in range(ROUNDS):
            started = time.perf_counter()
            send(server, qs)
            times.append(time.perf_counter() - started)
        peak = peak_memory(server.pid)
    memory = f"peak memory {peak / 2**20:.0f} MiB, idle {idle / 2**20:.0f} MiB"
    return Row(what, f"{statistics.median(times) * 1000:.0f} ms", memory)


def send_npy(server: Running, qs: Array) -> None:
    """One request, and the answer as an array again."""
    buffer = BytesIO()
    np.save(buffer, qs)
    answer = post(server, buffer.getvalue(), NPY, NPY)
    assert np.load(BytesIO(answer)).shape == (len(qs), 7)


def send_json(server: Running, qs: Array) -> None:
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


def peak_memory(pid: int) -> int:
    """Largest resident set of a process so far, [bytes]."""
    status = Path(f"/proc/{pid}/status").read_text(encoding="ascii")
    line = next(line for line in status.splitlines() if line.startswith("VmHWM"))
    return int(line.split()[1]) * 1024
