"""Twenty minutes of everything: a few clients who call each operation with the example of its documentation.

Besides, whole batches, and robots that are added, replaced and removed. What is told is how far the memory of all
processes of the service has drifted since they have answered everything a few times.
"""

import json
import random
import statistics
import threading
import time
from collections import Counter
from collections.abc import Sequence
from http.client import HTTPConnection, HTTPException
from typing import Any, NamedTuple
from urllib.parse import urlsplit
from urllib.request import urlopen

from tests.benchmarks.load import FK, memory, serving
from tests.benchmarks.table import Row
from tests.openapi import example_of

CLIENTS = 4
PAUSE_SECONDS = 0.02
SAMPLE_SECONDS = 2.0
ROBOT = "panda"
FINE = {200, 201, 202, 204}
EXPECTED = FINE | {404, 409, 429}
"""A client may remove the robot that another one replaces, and jobs have their limits."""


class Asked(NamedTuple):
    """One request: method, path, JSON body."""

    method: str
    path: str
    body: bytes | None


class Times(NamedTuple):
    """How long it goes on once there are as many answers as if each client had asked everything, [s].

    What comes first is not measured, then what it is measured against, and its end.
    """

    warm_up: float = 240.0
    measured: float = 1200.0
    plateau: float = 120.0


def measure() -> list[Row]:
    """All of it: 24 minutes."""
    return measured(Times())


def measured(times: Times) -> list[Row]:
    """The row of the table."""
    with serving() as (url, pid):
        requests, answers, stop = requests_of(url), Counter[int](), threading.Event()
        clients = [threading.Thread(target=ask, args=(url, requests, seed, answers, stop)) for seed in range(CLIENTS)]
        for client in clients:
            client.start()
        try:
            while answers.total() < CLIENTS * len(requests) and all(client.is_alive() for client in clients):
                stop.wait(1.0)
            stop.wait(times.warm_up)
            sizes = sampled(pid, times.measured)
        finally:
            stop.set()
            for client in clients:
                client.join()
    count = max(1, round(times.plateau / SAMPLE_SECONDS))
    first, last = statistics.median(sizes[:count]), statistics.median(sizes[-count:])
    other = {status: number for status, number in answers.items() if status not in EXPECTED}
    return [
        Row(
            f"{times.measured / 60:.0f} minutes, {len(requests)} operations, {CLIENTS} clients",
            f"{answers.total()} answers, unexpected {other or 'none'}; memory {last / 2**20:.0f} MiB",
            f"{first / 2**20:.0f} MiB after {times.warm_up / 60:.0f} minutes",
            last / first,
            "< 1.03",
        )
    ]


def sampled(pid: int, seconds: float) -> list[float]:
    """The memory of the service, [bytes], every few seconds."""
    sizes, until = [], time.monotonic() + seconds
    while time.monotonic() < until:
        sizes.append(memory(pid))
        time.sleep(SAMPLE_SECONDS)
    return sizes


def requests_of(url: str) -> list[Asked]:
    """Every operation that has an example, those that need none, and some of the author's own."""
    with urlopen(f"{url}/openapi.json", timeout=120) as answer:
        paths = json.load(answer)["paths"]
    found = [Asked("DELETE", "/v1/robots/my_arm", None), large_batch()]
    for path, methods in paths.items():
        for method, operation in methods.items():
            content = operation.get("requestBody", {}).get("content", {}).get("application/json", {})
            given = [one for one in operation.get("parameters", []) if one["in"] == "path"]
            names = {one["name"]: next(iter(one["examples"].values()))["value"] for one in given}
            place = path.format_map({**names, "robot": "my_arm" if method == "put" else ROBOT})
            if (example := example_of(content)) is not None:
                found.append(Asked(method.upper(), place, json.dumps(example).encode()))
            elif method == "get" and not {"{job}", "{path}"} & set(path.split("/")):
                found.append(Asked("GET", place, None))
    return found


def large_batch() -> Asked:
    """Two thousand configurations."""
    path, body = FK
    many: dict[str, Any] = {**body, "joint_positions": body["joint_positions"] * 2000}
    return Asked("POST", f"/v1/robots/{path}", json.dumps(many).encode())


def ask(url: str, requests: Sequence[Asked], seed: int, answers: Counter[int], stop: threading.Event) -> None:
    """What a client does: all requests, each time in another order of its own; 0 stands for a broken connection."""
    address, draw, left = urlsplit(url), random.Random(seed), list[Asked]()
    connection = HTTPConnection(address.hostname or "", address.port, timeout=90)
    while not stop.is_set():
        left = left or draw.sample(requests, len(requests))
        method, path, body = left.pop()
        try:
            connection.request(method, path, body, {"Content-Type": "application/json"} if body else {})
            answer = connection.getresponse()
            answer.read()
            answers[answer.status] += 1
        except (OSError, HTTPException):
            answers[0] += 1
            connection.close()
        stop.wait(PAUSE_SECONDS)
    connection.close()
