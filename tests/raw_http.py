"""HTTP to the last byte, and what a running service costs, read from outside."""

import contextlib
import os
import socket
from collections.abc import Iterator
from dataclasses import dataclass
from http.client import HTTPException, HTTPResponse
from pathlib import Path

TICKS = os.sysconf("SC_CLK_TCK")


@dataclass(frozen=True, slots=True)
class RawAnswer:
    """Status, media type and body."""

    status: int
    media_type: str | None
    body: bytes


def send(
    address: tuple[str, int], method: str, target: str, headers: tuple[tuple[str, str], ...], body: bytes
) -> RawAnswer:
    """One request on a connection of its own, with these headers and no further check.

    Raises:
        HTTPException: There is no answer.
    """
    lines = [f"{method} {target} HTTP/1.1", f"Host: {address[0]}:{address[1]}", "Connection: close"]
    lines += [f"{name}: {value}" for name, value in headers]
    if not any(name == "content-length" for name, _ in headers):
        lines.append(f"Content-Length: {len(body)}")
    head = "\r\n".join([*lines, "", ""]).encode("utf-8")
    with socket.create_connection(address, timeout=60) as connection:
        with contextlib.suppress(BrokenPipeError, ConnectionResetError):
            connection.sendall(head + body)
        response = HTTPResponse(connection, method=method)
        try:
            response.begin()
            return RawAnswer(response.status, response.getheader("content-type"), response.read())
        except OSError as error:
            raise HTTPException(str(error)) from error


def processes(pid: int) -> Iterator[int]:
    """A process and all below it."""
    yield pid
    for tasks in Path(f"/proc/{pid}/task").glob("*/children"):
        with contextlib.suppress(OSError):
            for child in tasks.read_text().split():
                yield from processes(int(child))


def processor_seconds(pid: int) -> float:
    """Processor time of a process and all below it, those that have ended included, [s]."""
    ticks = 0
    for one in processes(pid):
        with contextlib.suppress(OSError):
            fields = Path(f"/proc/{one}/stat").read_text().rpartition(")")[2].split()
            ticks += sum(map(int, fields[11:15]))
    return ticks / TICKS


def memory_bytes(pid: int) -> int:
    """Memory of a process and all below it, what they share counted once."""
    kilobytes = 0
    for one in processes(pid):
        with contextlib.suppress(OSError):
            lines = Path(f"/proc/{one}/smaps_rollup").read_text().splitlines()
            kilobytes += sum(int(line.split()[1]) for line in lines if line.startswith("Pss:"))
    return kilobytes * 1024
