"""Seconds from `./dev serve` to `/readyz`, the environment installed and the kernels' cache warm, and of a command."""

import os
import shlex
import statistics
import subprocess
import sys
import tempfile
import time

from tests.benchmarks.server import wait_for
from tests.benchmarks.table import Row
from tests.test_serve import HOST, free_port

ROUNDS = 5


def measure() -> list[Row]:
    """The whole start, and the share of `./dev` in it."""
    seconds_to_ready()
    whole = statistics.median(seconds_to_ready() for _ in range(ROUNDS))
    share = statistics.median(seconds_of_dev() for _ in range(ROUNDS))
    return [
        Row("`./dev serve` to `/readyz`, warm cache", f"{whole:.2f} s", wanted="≤ 3 s"),
        Row("share of `./dev` itself", f"{share:.2f} s", wanted="< 0.5 s"),
        *of_commands(),
    ]


COMMANDS = {"--help": 0.2, "fk panda -q '0 0 0 0 0 0 0'": 1.0}
"""Commands, and the most that each may take, [s]."""


def of_commands() -> list[Row]:
    """What a command takes from start to end, as a multiple of what loading Pinocchio takes in the same run."""
    words = {command: [sys.executable, "-m", "gelenk", *shlex.split(command)] for command in COMMANDS}
    peer = [sys.executable, "-c", "import pinocchio"]
    rounds = [{command: seconds_of(line) for command, line in {**words, "": peer}.items()} for _ in range(ROUNDS + 1)]
    median = {command: statistics.median(one[command] for one in rounds[1:]) for command in rounds[0]}
    peer_seconds = median[""]
    against = f"{peer_seconds:.2f} s: `import pinocchio`"
    return [
        Row(f"`gelenk {command}`", f"{median[command]:.2f} s", against, median[command] / peer_seconds, f"≤ {most} s")
        for command, most in COMMANDS.items()
    ]


def seconds_of(line: list[str]) -> float:
    """What a process takes, start and end included."""
    started = time.perf_counter()
    subprocess.run(line, check=True, stdout=subprocess.DEVNULL)
    return time.perf_counter() - started


def seconds_to_ready() -> float:
    """Start the service, wait until it is ready, stop it."""
    port = free_port()
    with tempfile.TemporaryDirectory() as data_dir:
        environment = {**os.environ, "GELENK_DATA_DIR": data_dir}
        started = time.perf_counter()
        with subprocess.Popen([sys.executable, "dev", "serve", "--port", str(port)], env=environment) as process:
            try:
                wait_for(f"http://{HOST}:{port}/readyz")
                return time.perf_counter() - started
            finally:
                process.terminate()
                process.wait(timeout=20)


def seconds_of_dev() -> float:
    """What `./dev` does before the service's own process image: a call for help through it and without it."""
    started = time.perf_counter()
    subprocess.run([sys.executable, "dev", "serve", "--help"], check=True, stdout=subprocess.DEVNULL)
    with_dev = time.perf_counter() - started
    started = time.perf_counter()
    subprocess.run([sys.executable, "-m", "gelenk.serve", "--help"], check=True, stdout=subprocess.DEVNULL)
    return max(0.0, with_dev - (time.perf_counter() - started))
