"""A Ray cluster of this machine alone, for tests and benchmarks: no dashboard, nothing reported to anyone."""

import os
import signal
import subprocess
import sys
import tempfile
from collections.abc import Iterator
from contextlib import contextmanager
from pathlib import Path

from tests.test_serve import free_port

_MEMORY = 200_000_000
"""Bytes of the store that results pass through."""


@contextmanager
def cluster(processors: int = 2) -> Iterator[str]:
    """The address of a cluster that is there meanwhile; none of its processes is left."""
    with tempfile.TemporaryDirectory(prefix="ray-") as folder:
        port, options = free_port(), ["--include-dashboard=false", "--disable-usage-stats", f"--temp-dir={folder}"]
        command = [str(Path(sys.executable).with_name("ray")), "start", "--head", "--block", f"--port={port}", *options]
        command += [f"--num-cpus={processors}", f"--object-store-memory={_MEMORY}"]
        # From a folder without the code: its processes are to find that by the way that the service has gone.
        environment = {name: value for name, value in os.environ.items() if name != "PYTHONPATH"}
        with subprocess.Popen(
            command, cwd=folder, env=environment, stdout=subprocess.PIPE, stderr=subprocess.STDOUT, text=True
        ) as head:
            address = ""
            try:
                for line in head.stdout or ():
                    if "--address='" in line:
                        address = line.partition("--address='")[2].partition("'")[0]
                    if "will now block" in line or "--block" in line:
                        break
                assert address, "the cluster has not started"
                yield address
            finally:
                head.send_signal(signal.SIGTERM)
                head.communicate(timeout=60)
