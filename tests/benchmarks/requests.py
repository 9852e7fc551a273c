"""Requests per second of one `fk` of one Panda configuration, against an empty endpoint, and of one `ik` against it.

The `ik` goes through the poses of random configurations within the limits. A client of our own keeps a few connections
busy with prepared bytes; all are measured in turn, again and again, and the medians compared, because the machine is
shared.
"""

import json
import socket
import statistics
import time
from itertools import cycle
from typing import cast

import numpy as np

from gelenk.kinematics.simd.kernels import chain_poses
from gelenk.operations.pose_arrays import pose_list
from gelenk.robot.poses import Poses
from gelenk.settings import Settings
from gelenk.store.library import Library
from tests.benchmarks.server import running
from tests.benchmarks.table import Row
from tests.test_serve import HOST

CONNECTIONS = 4
ROUNDS = 9
SECONDS = 1.0
TARGETS = 500
POSITIONS = [0.0, -0.785, 0.0, -2.356, 0.0, 1.571, 0.785]


def measure() -> list[Row]:
    """Compare `fk` with the empty endpoint of the same server, and with that of a bare FastAPI application."""
    fk = [post("fk", {"joint_positions": [POSITIONS]})]
    ik = [post("ik", {"targets": [target]}) for target in targets()]
    empty = [f"GET /empty HTTP/1.1\r\nHost: {HOST}\r\n\r\n".encode()]
    rates: dict[str, list[float]] = {"fk": [], "ik": [], "same": [], "bare": []}
    with running("service", "/readyz") as service, running("bare", "/empty") as bare:
        for _ in range(ROUNDS):
            rates["fk"].append(requests_per_second(service.port, fk))
            rates["ik"].append(requests_per_second(service.port, ik))
            rates["same"].append(requests_per_second(service.port, empty))
            rates["bare"].append(requests_per_second(bare.port, empty))
    median = {name: statistics.median(values) for name, values in rates.items()}
    return [
        Row(
            "one `fk` over HTTP",
            f"{median['fk']:.0f} requests/s",
            f"empty endpoint {where}, {median[name]:.0f} requests/s",
            median["fk"] / median[name],
            wanted,
        )
        for name, where, wanted in (
            ("same", "of the same server", "≥ 0.8"),
            ("bare", "of a FastAPI application with nothing else in it", "≥ 1"),
        )
    ] + [
        Row(
            "one `ik` over HTTP, its cost in `fk`",
            f"{median['ik']:.0f} requests/s",
            f"one `fk`, {median['fk']:.0f} requests/s",
            median["fk"] / median["ik"],
            "≤ 1.2",
        )
    ]


def targets() -> list[dict[str, list[float]]]:
    """Poses that the Panda reaches, as they travel."""
    library = Library(Settings().catalogue_dir, Settings().catalogue_dir / "none")
    chain = library.get("panda").robot.chain(None, None)
    qs = np.random.default_rng(2).uniform(chain.lower, chain.upper, (TARGETS, len(chain)))
    poses = pose_list(Poses(*chain_poses(chain.flat, qs)), "quaternion_xyzw")
    return cast(list[dict[str, list[float]]], poses)


def post(operation: str, content: object) -> bytes:
    """A whole request."""
    body = json.dumps(content).encode()
    head = f"POST /v1/robots/panda/{operation} HTTP/1.1\r\nHost: {HOST}\r\nContent-Type: application/json\r\n"
    return f"{head}Content-Length: {len(body)}\r\n\r\n".encode() + body


def requests_per_second(port: int, requests: list[bytes]) -> float:
    """Requests answered per second over a few connections, each with one request on its way."""
    following = cycle(requests)
    connections = [socket.create_connection((HOST, port), timeout=10) for _ in range(CONNECTIONS)]
    try:
        for connection in connections:
            connection.setsockopt(socket.IPPROTO_TCP, socket.TCP_NODELAY, 1)
            connection.sendall(next(following))
        count = 0
        started = time.perf_counter()
        while time.perf_counter() - started < SECONDS:
            for connection in connections:
                receive_answer(connection)
                connection.sendall(next(following))
                count += 1
        return count / (time.perf_counter() - started)
    finally:
        for connection in connections:
            connection.close()


def receive_answer(connection: socket.socket) -> None:
    """Take one whole answer off a connection."""
    answer = connection.recv(65536)
    assert answer.startswith(b"HTTP/1.1 200"), answer[:200]
    while (end := answer.find(b"\r\n\r\n")) < 0:
        answer += connection.recv(65536)
    start = answer.index(b"content-length: ") + len(b"content-length: ")
    size = end + 4 + int(answer[start : answer.index(b"\r\n", start)])
    while len(answer) < size:
        answer += connection.recv(65536)
