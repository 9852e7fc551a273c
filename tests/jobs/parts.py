"""Parts of jobs that do what real ones do not: quick to load in a process of its own."""

import json
import os
import signal
import time
from pathlib import Path
from typing import Any

from gelenk.jobs.run import Files, Run
from gelenk.jobs.runner import Work


def double(value: int) -> int:
    return 2 * value


def echo(value: Any) -> Any:
    return value


def own_pid(_: int) -> int:
    return os.getpid()


def sleep(seconds: float) -> float:
    time.sleep(seconds)
    return seconds


def die(code: int) -> int:
    os._exit(code)


def killed(call: tuple[str, int]) -> int:
    """What is killed the first few times, as by the system where memory runs out; each time leaves a byte in a file."""
    path, times = call
    with Path(path).open("ab", buffering=0) as file:
        file.write(b".")
        if file.tell() <= times:
            os.kill(os.getpid(), signal.SIGKILL)
    return 1


def fail(text: str) -> int:
    raise ValueError(text)


def note(line: str) -> str:
    """Leave a line in a file, the part before the colon; wait while the number in `gate` beside it is not above it."""
    path, _, text = line.partition(":")
    while int(text) >= int(Path(path).with_name("gate").read_text()):
        time.sleep(0.01)
    with Path(path).open("a") as file:
        file.write(f"{text}\n")
    return text


def mark(folder: str) -> int:
    """Leave the number of this process in a folder, and take a while."""
    (Path(folder) / str(os.getpid())).touch()
    time.sleep(0.3)
    return 7


def linger(folder: str) -> int:
    """The same for very long."""
    mark(folder)
    time.sleep(60.0)
    return 7


def gone(pid: int) -> bool:
    return not Path(f"/proc/{pid}").exists()


def told(argument: tuple[str, Any]) -> bytes:
    """What one of these functions returns, as a part of a job is told."""
    name, value = argument
    return repr(globals()[name](value)).encode()


def made_by(name: str, values: list[Any]) -> dict[str, bytes]:
    """The request of a job whose parts are one of these functions of each of some values."""
    return {"call.json": json.dumps([name, values]).encode()}


def fatal(_: Path) -> Work:
    """The kind of jobs that bring their process of the service down."""

    def work(run: Run) -> Files:
        run.map("all", told, lambda k: ("double", k), 2)
        os.kill(os.getpid(), signal.SIGKILL)
        return {}

    return work


def of_parts(folder: Path) -> Work:
    """The kind of such jobs: what comes out is the list of what the functions return."""
    name, values = json.loads((folder / "call.json").read_text())

    def work(run: Run) -> Files:
        run.map("all", told, lambda k: (name, values[k]), len(values))
        results = b", ".join(run.parts.of("all", len(values)))
        return {"result.txt": lambda target: target.write(b"[" + results + b"]")}

    return work
