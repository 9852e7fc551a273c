"""The service under load, and beyond what it can bear: wrk as the crowd, and beside it clients that keep to the rules.

The crowd sends its next request as soon as it has an answer, also where that was a refusal with `Retry-After`. What is
told of latency is that of the polite clients, who wait as long as they are asked to, and of one who watches /healthz.
Everything runs on this machine: the crowd takes what the service leaves of the processors.
"""

import asyncio
import contextlib
import json
import os
import shutil
import signal
import socket
import subprocess
import sys
import tempfile
import time
from collections.abc import AsyncGenerator, Iterator
from contextlib import contextmanager
from dataclasses import dataclass, field
from pathlib import Path
from random import uniform
from typing import Any, NamedTuple

from tests.benchmarks.server import wait_for
from tests.benchmarks.table import Row
from tests.test_serve import HOST, free_port

WORKERS = 2
CROWD_A_POLITE = 10
"""Clients of the crowd beside each polite one."""
PATIENCE = 0.005
"""What one of them in all waits before it asks again, [s]: many of them ask no more often than a few."""
HEALTH_PERIOD = 0.05
CROWD_NICENESS = 5
"""The crowd stands for other machines: the service and those who watch it go first."""
FIRST, WARM_UP_SECONDS = 20, 60.0
SETTLING_SECONDS = 25.0
"""Until processes that began before everything was loaded make room for those that share it."""
FK = ("panda/fk", {"joint_positions": [[0.0, -0.785, 0.0, -2.356, 0.0, 1.571, 0.785]]})
TRAJECTORY = (
    "panda/trajectory",
    {
        "start": [0.0, -0.785, 0.0, -2.356, 0.0, 1.571, 0.785],
        "segments": [{"type": "joint", "target": [0.3, -0.5, 0.1, -2.2, 0.05, 1.8, 0.9]}],
    },
)
_SCRIPT = """
wrk.method = "POST"
wrk.body = [==[%s]==]
wrk.headers["Content-Type"] = "application/json"
done = function(summary, latency, requests)
  local e = summary.errors
  io.write(string.format('RESULT {"requests": %%d, "refused": %%d, "broken": %%d, "timeouts": %%d, "p99": %%f}\\n',
    summary.requests, e.status, e.connect + e.read + e.write, e.timeout, latency:percentile(99.0) / 1e6))
end
"""


class Call(NamedTuple):
    """What is asked: the end of its path, and its body."""

    path: str
    body: dict[str, Any]


@dataclass(frozen=True)
class Scale:
    """How much of it.

    Attributes:
        seconds: Of each part.
        clients: That the service is to bear without an error.
        times: How many times that is too much.
        slow_sockets: That send nothing whole.
    """

    seconds: float = 60.0
    clients: int = 200
    times: int = 10
    slow_sockets: int = 3000


class Crowd(NamedTuple):
    """What the crowd saw: answers, of these refused, connections broken, answers late, 99 % answered within [s]."""

    requests: int
    refused: int
    broken: int
    timeouts: int
    p99: float


@dataclass
class Seen:
    """What polite clients and the watcher saw; latencies in seconds."""

    accepted: list[float] = field(default_factory=list)
    refused: list[float] = field(default_factory=list)
    healthy: list[float] = field(default_factory=list)
    other: list[int] = field(default_factory=list)


def measure() -> list[Row]:
    """All of it at full length: about five minutes."""
    return measured(Scale())


def measured(scale: Scale) -> list[Row]:
    """The rows of the table."""
    if shutil.which("wrk") is None:
        sys.exit("wrk is needed to load the service: apt-get install wrk")
    with serving() as (url, pid):
        rows = []
        for name, call in (("`fk`", Call(*FK)), ("`trajectory`", Call(*TRAJECTORY))):
            few, seen_by_few, growth = loaded(url, pid, call, scale.clients, scale.seconds)
            many, seen_by_many, _ = loaded(url, pid, call, scale.clients * scale.times, scale.seconds)
            rows += [
                row_of_few(name, scale, few, growth),
                *rows_of_many(name, scale, many, seen_by_few, seen_by_many),
            ]
        before, _, _ = loaded(url, pid, Call(*FK), scale.clients, scale.seconds / 4)
        with slow_sockets(url, scale.slow_sockets):
            during, _, _ = loaded(url, pid, Call(*FK), scale.clients, scale.seconds / 4)
        rows.append(row_of_slow(scale, before, during))
    return rows


def row_of_few(name: str, scale: Scale, few: Crowd, growth: float) -> Row:
    """That as many as it is to bear get their answers."""
    rate = few.requests / scale.seconds
    errors = few.refused + few.broken + few.timeouts
    told = f"{rate:.0f} requests/s, 99 % within {1e3 * few.p99:.0f} ms, {errors} errors, memory {growth:+.1%}"
    return Row(f"{scale.clients} clients of {name} on {WORKERS} workers", told, wanted="no error, memory < 3 %")


def rows_of_many(name: str, scale: Scale, many: Crowd, before: Seen, seen: Seen) -> list[Row]:
    """That too many are refused, and harm neither who is not nor who watches."""
    clients = scale.clients * scale.times
    accepted, usual = p99(seen.accepted), p99(before.accepted)
    share = many.refused / max(1, many.requests)
    return [
        Row(
            f"{clients} clients of {name}: 99 % of those accepted",
            f"{1e3 * accepted:.0f} ms",
            f"with {scale.clients}, {1e3 * usual:.0f} ms",
            accepted / usual,
            "≤ 2",
        ),
        Row(
            f"{clients} clients of {name}: 99 % of those refused",
            f"503 within {1e3 * p99(seen.refused):.0f} ms; {share:.0%} of the crowd's requests, "
            f"{many.broken + many.timeouts} broken or late, {len(seen.other)} other answers",
            wanted="at once",
        ),
        Row(f"{clients} clients of {name}: `/healthz`", f"99 % within {1e3 * p99(seen.healthy):.0f} ms", wanted="< 50"),
    ]


def row_of_slow(scale: Scale, before: Crowd, during: Crowd) -> Row:
    """That sockets which send nothing whole change nothing."""
    return Row(
        f"{scale.clients} clients of `fk` beside {scale.slow_sockets} slow sockets",
        f"{during.requests / scale.seconds * 4:.0f} requests/s, 99 % within {1e3 * during.p99:.0f} ms, "
        f"{during.refused + during.broken + during.timeouts} errors",
        f"without, {before.requests / scale.seconds * 4:.0f} requests/s, {1e3 * before.p99:.0f} ms",
        during.requests / max(1, before.requests),
        "≈ 1, no error",
    )


def p99(latencies: list[float]) -> float:
    """What 99 % are within, [s]; nothing where there are none."""
    return sorted(latencies)[int(0.99 * (len(latencies) - 1))] if latencies else float("nan")


@contextmanager
def serving(workers: int = WORKERS, token: str = "", **settings: str) -> Iterator[tuple[str, int]]:
    """The service, warm: its address, and its process."""
    port = free_port()
    with tempfile.TemporaryDirectory() as data_dir:
        command = [sys.executable, "-m", "gelenk.serve", "--port", str(port), "--workers", str(workers)]
        environment = {**os.environ, "GELENK_DATA_DIR": data_dir, **settings}
        with subprocess.Popen(command, env=environment, stdout=subprocess.DEVNULL) as process:
            try:
                url = f"http://{HOST}:{port}"
                wait_for(f"{url}/readyz")
                asyncio.run(warm_up(url, token))
                time.sleep(SETTLING_SECONDS)
                asyncio.run(warm_up(url, token))
                yield url, process.pid
            finally:
                process.terminate()
                with contextlib.suppress(subprocess.TimeoutExpired):
                    process.wait(timeout=20)
                process.kill()


async def warm_up(url: str, token: str) -> None:
    """Have all processes answer once: those for what takes longer start when the service is ready for the rest."""
    until = time.perf_counter() + WARM_UP_SECONDS
    for call in (Call(*FK), Call(*TRAJECTORY)):
        await asyncio.gather(*(let_in(url, request_of(call, token), until) for _ in range(FIRST)))


async def let_in(url: str, request: bytes, until: float) -> None:
    """Ask until there is an answer."""
    async with contextlib.aclosing(asked(url, request, until)) as answers:
        async for answer in answers:
            if answer.status == 200:
                return
            await asyncio.sleep(answer.retry_after)
    raise TimeoutError(request[:80])


def loaded(url: str, pid: int, call: Call, clients: int, seconds: float) -> tuple[Crowd, Seen, float]:
    """What a crowd saw, what polite clients saw meanwhile, and by what share the service's memory has grown."""
    with begun_crowd(url, call, clients, seconds) as process:
        time.sleep(min(2.0, seconds / 5))
        at_first = memory(pid)
        seen = asyncio.run(watched(url, call, clients // CROWD_A_POLITE, 0.7 * seconds - min(2.0, seconds / 5)))
        at_last = memory(pid)
        found = told_by(process, seconds)
    time.sleep(0.5)
    return found, seen, at_last / at_first - 1.0


def crowd(url: str, call: Call, clients: int, seconds: float) -> Crowd:
    """What a crowd of clients saw."""
    with begun_crowd(url, call, clients, seconds) as process:
        return told_by(process, seconds)


@contextmanager
def begun_crowd(url: str, call: Call, clients: int, seconds: float) -> "Iterator[subprocess.Popen[str]]":
    """Wrk at work; ended by its own process where it does not end by itself."""
    threads = min(2, clients)
    with tempfile.NamedTemporaryFile("w", suffix=".lua") as script:
        script.write(_SCRIPT % json.dumps(call.body))
        script.flush()
        command = ["nice", "-n", str(CROWD_NICENESS), "wrk", f"-t{threads}", f"-c{clients}"]
        command += [f"-d{max(1, round(seconds))}s", "--timeout", "30s"]
        command += ["-s", script.name, f"{url}/v1/robots/{call.path}"]
        with subprocess.Popen(command, stdout=subprocess.PIPE, text=True) as process:
            try:
                yield process
            finally:
                if process.poll() is None:
                    process.send_signal(signal.SIGKILL)


def told_by(process: "subprocess.Popen[str]", seconds: float) -> Crowd:
    """What wrk tells at its end."""
    text, _ = process.communicate(timeout=seconds + 60)
    line = next(line for line in text.splitlines() if line.startswith("RESULT "))
    return Crowd(**json.loads(line.removeprefix("RESULT ")))


async def watched(url: str, call: Call, count: int, seconds: float) -> Seen:
    """What so many polite clients and a watcher see for some time."""
    seen, until = Seen(), time.perf_counter() + seconds
    clients = (polite(url, call, seen, until, PATIENCE * count) for _ in range(count))
    await asyncio.gather(watcher(url, seen, until), *clients)
    return seen


async def polite(url: str, call: Call, seen: Seen, until: float, patience: float) -> None:
    """A client who asks again after so long, or when it is told to."""
    async for answer in asked(url, request_of(call), until):
        if answer.status == 200:
            seen.accepted.append(answer.latency)
        elif answer.status == 503:
            seen.refused.append(answer.latency)
        else:
            seen.other.append(answer.status)
        pause = answer.retry_after if answer.status == 503 else patience
        await asyncio.sleep(pause * uniform(1.0, 1.5))  # or they would come back all at once


async def watcher(url: str, seen: Seen, until: float) -> None:
    """Whoever wants to know whether the process lives."""
    async for answer in asked(url, f"GET /healthz HTTP/1.1\r\nHost: {HOST}\r\n\r\n".encode(), until):
        (seen.healthy if answer.status == 200 else seen.refused).append(answer.latency)
        await asyncio.sleep(HEALTH_PERIOD)


def request_of(call: Call, token: str = "") -> bytes:
    """A call as it goes over the wire, with a key where there is one."""
    body = json.dumps(call.body).encode()
    head = f"POST /v1/robots/{call.path} HTTP/1.1\r\nHost: {HOST}\r\nContent-Type: application/json\r\n"
    head += f"Authorization: Bearer {token}\r\n" if token else ""
    return f"{head}Content-Length: {len(body)}\r\n\r\n".encode() + body


class Answer(NamedTuple):
    """What is told of an answer: its status, 0 where the connection broke, when to ask again and its latency, [s]."""

    status: int
    retry_after: float
    latency: float


async def asked(url: str, request: bytes, until: float) -> AsyncGenerator[Answer]:
    """The answers to one request after the other, on one connection for as long as the service leaves it open."""
    port, reader, writer = int(url.rsplit(":", 1)[1]), None, None
    try:
        while time.perf_counter() < until:
            began = time.perf_counter()
            try:
                if reader is None or writer is None or reader.at_eof():
                    await closed(writer)
                    reader, writer = await asyncio.open_connection(HOST, port)
                writer.write(request)
                status, retry_after, stays = await head_of_answer(reader)
            except (OSError, asyncio.IncompleteReadError):
                status, retry_after, stays = 0, PATIENCE, False
            if not stays:
                await closed(writer)
                writer = None
            yield Answer(status, retry_after, time.perf_counter() - began)
    finally:
        await closed(writer)


async def head_of_answer(reader: asyncio.StreamReader) -> tuple[int, float, bool]:
    """Status of an answer that is read to its end, when to ask again, [s], and whether the connection stays."""
    lines = (await reader.readuntil(b"\r\n\r\n")).lower().splitlines()
    fields = dict(line.split(b": ", 1) for line in lines[1:] if line)
    await reader.readexactly(int(fields[b"content-length"]))
    status, retry_after = int(lines[0].split()[1]), float(fields.get(b"retry-after", PATIENCE))
    return status, retry_after, fields.get(b"connection") != b"close"


async def closed(writer: asyncio.StreamWriter | None) -> None:
    """Close a connection, whatever state it is in."""
    if writer is not None:
        writer.close()
        with contextlib.suppress(OSError):
            await writer.wait_closed()


@contextmanager
def slow_sockets(url: str, count: int) -> Iterator[None]:
    """Connections that have sent the beginning of a request, a third of them the half of a body."""
    port, sockets = int(url.rsplit(":", 1)[1]), []
    half = f"POST /v1/robots/panda/fk HTTP/1.1\r\nHost: {HOST}\r\nContent-Length: 1000\r\n\r\n{{".encode()
    try:
        for i in range(count):
            connection = socket.create_connection((HOST, port), timeout=20)
            connection.sendall((b"", b"GET / HTTP/1.1\r\nHost: ", half)[i % 3])
            sockets.append(connection)
        yield
    finally:
        for connection in sockets:
            connection.close()


def memory(pid: int) -> float:
    """Bytes of a process and of all that come from it, what they share counted once.

    Without those of files: a library that others on the machine load too counts less for as long as they do.
    """
    return sum(_proportional(one) for one in _tree(pid))


def _tree(pid: int) -> Iterator[int]:
    yield pid
    with contextlib.suppress(FileNotFoundError, ProcessLookupError):
        for task in Path(f"/proc/{pid}/task").iterdir():
            for child in (task / "children").read_text().split():
                yield from _tree(int(child))


def _proportional(pid: int) -> float:
    with contextlib.suppress(OSError):
        lines = Path(f"/proc/{pid}/smaps_rollup").read_text().splitlines()
        return 1024.0 * sum(int(line.split()[1]) for line in lines if line.startswith(("Pss_Anon:", "Pss_Shmem:")))
    return 0.0
