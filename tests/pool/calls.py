"""Calls that do what real ones do not."""

import importlib
import logging
import os
import signal
import time
import warnings
from pathlib import Path
from pickle import PickleBuffer

import numpy as np

from gelenk.processes.wire import pieces_of


def double(value: int) -> int:
    return 2 * value


def own_pid(_: object) -> int:
    return os.getpid()


def sleep(seconds: float) -> float:
    time.sleep(seconds)
    return seconds


def wait(mark: str) -> None:
    """Take as long as a file is not there."""
    while not Path(mark).exists():
        time.sleep(0.01)


def die(how: signal.Signals) -> None:
    os.kill(os.getpid(), how)
    time.sleep(60)


def leave(code: int) -> None:
    os._exit(code)


def fail(text: str) -> None:
    raise ValueError(text)


class Unsendable(Exception):
    def __init__(self, one: int, two: int) -> None:
        super().__init__(f"{one} and {two}")


def fail_unsendably(_: object) -> None:
    raise Unsendable(1, 2)


def take(megabytes: int) -> int:
    return int(np.ones(megabytes * 125_000).sum())


def keep(megabytes: int) -> int:
    KEPT.append(np.ones(megabytes * 125_000))
    return os.getpid()


KEPT: list[object] = []


def reversed_bytes(pieces: list[PickleBuffer]) -> list[PickleBuffer]:
    return pieces_of(b"".join(pieces)[::-1])


def load(module: str) -> None:
    importlib.import_module(module)


def loaded_modules(_: object) -> set[str]:
    import sys

    return {"gelenk.main", "numba", "pinocchio", "sympy", "matplotlib.figure"} & set(sys.modules)


def log(text: str) -> None:
    """Say something, as a warning of Python too."""
    logging.getLogger("gelenk").warning("%s", text)
    warnings.warn(f"beware {text}", stacklevel=1)
