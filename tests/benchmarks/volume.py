"""Large batches of Panda configurations through `fk`, end to end over HTTP, with the server's peak memory."""

import json
import statistics
import time
import urllib.request
from collections.abc import Callable, Mapping
from io import BytesIO
from pathlib import Path

import numpy as np

from gelenk.kinematics.simd.kernels import chain_poses
from gelenk.operations.pose_arrays import pose_array
from gelenk.robot.arrays import Array
from gelenk.robot.poses import Poses
from gelenk.settings import Settings
from gelenk.store.library import Library
from tests.benchmarks.server import Running, running
from tests.benchmarks.table import Row
from tests.test_serve import HOST

NPY = "application/x-npy"
ROUNDS = 5


def measure() -> list[Row]:
    """100,000 configurations as npy and 10,000 as JSON."""
    qs = np.random.default_rng(1).uniform(-2.0, 2.0, (100_000, 7))
    return [
        row("`fk` of 100,000 configurations as npy, end to end", send_npy, qs, "≤ 40 ms"),
        row("`fk` of 10,000 configurations as JSON, end to end", send_json, qs[:10_000]),
        row("`ik` of 10,000 targets as npy, end to end", send_targets, reachable(10_000), "≤ 40 ms"),
    ]


def reachable(count: int) -> Array:
    """Poses that the Panda reaches, position and quaternion; shape (N, 7)."""
    library = Library(Settings().catalogue_dir, Settings().catalogue_dir / "none")
    chain = library.get("panda").robot.chain(None, None)
    qs = np.random.default_rng(3).uniform(chain.lower, chain.upper, (count, len(chain)))
    return pose_array(Poses(*chain_poses(chain.flat, qs)), "quaternion_xyzw")


def row(what: str, send: Callable[[Running, Array], None], rows: Array, wanted: str = "") -> Row:
    """Median time of some calls, on a server of their own, because a process's peak memory never falls."""
    with running("service", "/readyz") as server:
        idle = peak_memory(server.pid)
        times = []
        for _ in range(ROUNDS):
            started = time.perf_counter()
            send(server, rows)
            times.append(time.perf_counter() - started)
        peak = peak_memory(server.pid)
    memory = f"peak memory {peak / 2**20:.0f} MiB, idle {idle / 2**20:.0f} MiB"
    return Row(what, f"{statistics.median(times) * 1000:.0f} ms", memory, wanted=wanted)


def send_npy(server: Running, qs: Array) -> None:
    """One request, and the answer as an array again."""
    buffer = BytesIO()
    np.save(buffer, qs)
    answer = post(server, "fk", buffer.getvalue(), NPY, NPY)
    assert np.load(BytesIO(answer)).shape == (len(qs), 7)


def send_targets(server: Running, targets: Array) -> None:
    """The same for the inverse; that all are solved is what the header says."""
    buffer = BytesIO()
    np.save(buffer, targets)
    answer = post(server, "ik", buffer.getvalue(), NPY, NPY, {"Gelenk-Unsolved": "0"})
    assert np.load(BytesIO(answer)).shape == (len(targets), 7)


def send_json(server: Running, qs: Array) -> None:
    """One request, and the answer as Python objects again."""
    body = json.dumps({"joint_positions": qs.tolist()}).encode()
    answer = json.loads(post(server, "fk", body, "application/json", "application/json"))
    assert len(answer["poses"]) == len(qs)


def post(
    server: Running,
    operation: str,
    body: bytes,
    content_type: str,
    accept: str,
    headers: Mapping[str, str] | None = None,
) -> bytes:
    """Post to an operation of the Panda; its answer has these headers."""
    url = f"http://{HOST}:{server.port}/v1/robots/panda/{operation}"
    request = urllib.request.Request(url, body, {"Content-Type": content_type, "Accept": accept})
    with urllib.request.urlopen(request, timeout=120) as answer:
        assert all(answer.headers[name] == value for name, value in (headers or {}).items())
        return bytes(answer.read())


def peak_memory(pid: int) -> int:
    """Largest resident set of a process so far, [bytes]."""
    status = Path(f"/proc/{pid}/status").read_text(encoding="ascii")
    line = next(line for line in status.splitlines() if line.startswith("VmHWM"))
    return int(line.split()[1]) * 1024
