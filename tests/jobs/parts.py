"""Parts of jobs that do what real ones do not: quick to load in a process of its own."""

import os
import time
from pathlib import Path


def double(value: int) -> int:
    return 2 * value


def own_pid(_: int) -> int:
    return os.getpid()


def sleep(seconds: float) -> float:
    time.sleep(seconds)
    return seconds


def die(code: int) -> int:
    os._exit(code)


def die_once(mark: str) -> int:
    """Die, but not the second time."""
    path = Path(mark)
    if path.exists():
        return 1
    path.touch()
    os._exit(9)


def fail(text: str) -> int:
    raise ValueError(text)


def gone(pid: int) -> bool:
    return not Path(f"/proc/{pid}").exists()
