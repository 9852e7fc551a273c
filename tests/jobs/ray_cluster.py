"""A Ray cluster of this machine alone, for tests and benchmarks: no dashboard, nothing reported to anyone."""

import os
import signal
import subprocess
import sys
import tempfile
from collections.abc import Iterator
from contextlib import contextmanager, suppress
from pathlib import Path

from tests.test_serve import free_port

_MEMORY = 200_000_000
"""Bytes of the store that results pass through."""


@contextmanager
def cluster(processors: int = 2) -> Iterator[str]:
    """The address of a cluster that is there meanwhile; none of its processes is left."""
    with tempfile.TemporaryDirectory(prefix="ray-") as folder, head(folder, processors) as (_, address):
        yield address


@contextmanager
def head(folder: str, processors: int) -> Iterator[tuple[subprocess.Popen[str], str]]:
    """The head of a cluster, and its address; its files are below a folder."""
    options = ["--head", f"--port={free_port()}", "--include-dashboard=false", f"--temp-dir={folder}"]
    with _started(folder, processors, *options) as (process, said):
        yield process, said.partition("--address='")[2].partition("'")[0]


@contextmanager
def node(folder: str, address: str, processors: int) -> Iterator[subprocess.Popen[str]]:
    """One more machine of a cluster."""
    with _started(folder, processors, f"--address={address}") as (process, _):
        yield process


def signalled(process: subprocess.Popen[str], number: signal.Signals) -> None:
    """Send a signal to a head or a machine: to all its processes."""
    found = [process.pid]
    for pid in found:
        with suppress(OSError):
            found += map(int, Path(f"/proc/{pid}/task/{pid}/children").read_text().split())
    for pid in found:
        with suppress(ProcessLookupError):
            os.kill(pid, number)


@contextmanager
def _started(folder: str, processors: int, *options: str) -> Iterator[tuple[subprocess.Popen[str], str]]:
    """Processes of Ray, and what was said at their start."""
    command = [str(Path(sys.executable).with_name("ray")), "start", "--block", "--disable-usage-stats", *options]
    command += [f"--num-cpus={processors}", f"--object-store-memory={_MEMORY}"]
    # From a folder without the code: its processes are to find that by the way that the service has gone.
    environment = {name: value for name, value in os.environ.items() if name != "PYTHONPATH"}
    with subprocess.Popen(
        command, cwd=folder, env=environment, stdout=subprocess.PIPE, stderr=subprocess.STDOUT, text=True
    ) as process:
        try:
            said = ""
            for line in process.stdout or ():
                said += line
                if "--block" in line:
                    break
            assert "started" in said, said
            yield process, said
        finally:
            signalled(process, signal.SIGCONT)
            process.send_signal(signal.SIGTERM)
            process.communicate(timeout=60)
