"""The same jobs by the processes of this machine and by a Ray cluster on it with as many processors.

From the request to the result on this side; the results of both are compared byte for byte.
"""

import hashlib
import http.client
import json
import time
from collections.abc import Iterator
from http import HTTPStatus
from io import BytesIO
from pathlib import Path
from typing import NamedTuple
from urllib.parse import urlencode

import numpy as np

from gelenk.kinematics.workspace.workspace import PART
from tests.benchmarks.server import Running, running
from tests.benchmarks.table import Row
from tests.benchmarks.volume import peak_memory
from tests.jobs.ray_cluster import cluster
from tests.test_serve import HOST

TIP = "panda_link8"
NPY = "application/x-npy"
SAMPLES, TARGETS = 1_000_000, 1_000_000
PROCESSES = 2
ROUNDS = 3


class Ask(NamedTuple):
    """A job.

    Attributes:
        what: For the table.
        unit: What it has many of.
        many: How many of them.
        path: The call with its query.
        body: Of the request.
        headers: Likewise.
    """

    what: str
    unit: str
    many: int
    path: str
    body: bytes
    headers: dict[str, str]


class Result(NamedTuple):
    """How a job went.

    Attributes:
        seconds: From the request to the result.
        digest: Of both forms of the result.
        poses: Orientations at voxels, of a map of dexterity.
        peak: Of the service's own memory meanwhile, [MiB].
    """

    seconds: float
    digest: str
    poses: int
    peak: float


def measure() -> list[Row]:
    """Each job in both places by turns, the best of some rounds after one that starts what is needed."""
    asks = [million_samples(), dexterity(), million_targets()]
    with (
        cluster(PROCESSES) as address,
        running("service", "/readyz", GELENK_JOB_PROCESSES=str(PROCESSES)) as here,
        running("service", "/readyz", GELENK_RAY_ADDRESS=address) as there,
    ):
        return [row for ask in asks for row in compared(ask, here, there)]


def compared(ask: Ask, here: Running, there: Running) -> Iterator[Row]:
    """What came of a job in both places."""
    rounds = [(done(here, ask), done(there, ask)) for _ in range(1 + ROUNDS)]
    if len({result.digest for both in rounds for result in both}) > 1:
        raise AssertionError(f"{ask.what}: the results differ")
    own, ray = (min(results, key=lambda result: result.seconds) for results in zip(*rounds[1:], strict=True))
    many = own.poses or ask.many
    rates = [f"{many / one.seconds:,.0f} {ask.unit}/s ({one.seconds:.2f} s)" for one in (own, ray)]
    peer = f"Ray with {PROCESSES} processors, {rates[1]}"
    yield Row(f"{ask.what}, {PROCESSES} processes, over HTTP", rates[0], peer, ray.seconds / own.seconds)
    digest, peaks = own.digest[:16], [f"{one.peak:.0f} MiB" for one in (own, ray)]
    yield Row(f"{ask.what}: SHA-256 of the results", f"{digest}…", f"Ray, {digest}…", None, "equal")
    yield Row(f"{ask.what}: peak memory of the service's process", peaks[0], f"Ray, {peaks[1]}")


def million_samples() -> Ask:
    """A cloud, in parts of 65,536 samples."""
    call = {"samples": SAMPLES, "tip_frame": TIP}
    what = f"job: cloud of {SAMPLES:,} samples in {-(-SAMPLES // PART)} parts"
    return Ask(what, "samples", SAMPLES, "workspace", json.dumps(call).encode(), {"Content-Type": "application/json"})


def dexterity() -> Ask:
    """A map of which orientations are reached where."""
    call = {"kind": "dexterity", "samples": 200_000, "voxel_size": 0.12, "orientations": 20, "tip_frame": TIP}
    what = "job: map of dexterity, orientations at voxels"
    return Ask(what, "poses", 0, "workspace", json.dumps(call).encode(), {"Content-Type": "application/json"})


def million_targets() -> Ask:
    """Poses of random configurations, most within the limits of the joints."""
    rng = np.random.default_rng(7)
    # Near the arm's middle, where all of these can be reached.
    quaternions = np.tile([1.0, 0.0, 0.0, 0.0], (TARGETS, 1)) + 0.2 * rng.normal(size=(TARGETS, 4))
    quaternions /= np.linalg.norm(quaternions, axis=1, keepdims=True)
    positions = rng.uniform([0.35, -0.2, 0.3], [0.55, 0.2, 0.6], (TARGETS, 3))
    body = BytesIO()
    np.save(body, np.column_stack((positions, quaternions)))
    query = urlencode({"tip_frame": TIP, "max_iterations": 2000})
    headers = {"Content-Type": NPY, "Prefer": "respond-async"}
    return Ask(f"job: ik of {TARGETS:,} targets", "targets", TARGETS, f"ik?{query}", body.getvalue(), headers)


def done(server: Running, ask: Ask) -> Result:
    """One job: posted, watched by its events, fetched in both forms; and removed, so that each begins anew."""
    forget_peak(server.pid)
    started = time.perf_counter()
    connection = http.client.HTTPConnection(HOST, server.port, timeout=600)
    job = json.loads(answered(connection, "POST", f"/v1/robots/panda/{ask.path}", ask.body, ask.headers))
    path = f"/v1/jobs/{job['id']}"
    answered(connection, "GET", f"{path}/events")
    array = answered(connection, "GET", f"{path}/result", headers={"Accept": NPY})
    seconds = time.perf_counter() - started
    told = answered(connection, "GET", f"{path}/result")
    answered(connection, "DELETE", f"{path}?finished=remove")
    connection.close()
    return Result(seconds, hashlib.sha256(array + told).hexdigest(), asked_poses(told), peak_memory(server.pid) / 2**20)


def asked_poses(told: bytes) -> int:
    """How many orientations a map of dexterity has asked for; 0 of another job."""
    summary = json.loads(told) if len(told) < 1_000_000 else {}
    found = summary.get("dexterity")
    return 0 if found is None else int(found["orientations"] * summary["voxels"]["count"])


def answered(
    connection: http.client.HTTPConnection,
    method: str,
    path: str,
    body: bytes | None = None,
    headers: dict[str, str] | None = None,
) -> bytes:
    """What a call answers with, which is no refusal."""
    connection.request(method, path, body, headers or {})
    answer = connection.getresponse()
    content = answer.read()
    if answer.status >= HTTPStatus.BAD_REQUEST:
        raise AssertionError(content.decode())
    return content


def forget_peak(pid: int) -> None:
    """Have the system measure a process's peak memory anew."""
    Path(f"/proc/{pid}/clear_refs").write_text("5")
