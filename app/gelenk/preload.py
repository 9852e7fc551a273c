"""Imports of the process that all others of the service are copied from."""

import gc
import importlib
import logging.config
import os
from collections.abc import Callable, Iterator
from contextlib import contextmanager
from functools import partial


@contextmanager
def kept() -> Iterator[None]:
    """Exempt everything loaded so far from garbage collection.

    Scanning it again and again would take a fifth of the time; and the copies share only memory that is never written.
    """
    gc.disable()
    try:
        yield
    finally:
        gc.freeze()
        gc.enable()


with kept():
    from gelenk.logs import configuration
    from gelenk.settings import Settings

    logging.config.dictConfig(configuration(Settings.from_environment(os.environ).log_level, at_once=True))
    logging.captureWarnings(True)
    from gelenk.kinematics import warm
    from gelenk.model import compilation

    importlib.import_module("gelenk.main")


def is_compiled() -> bool:
    """Whether `warm_up` finds the kernels compiled, or must compile them in this process."""
    return compilation.STORE is None or compilation.is_stored()


def _part(compute: Callable[[], None]) -> None:
    compilation.expect_others(False)
    compute()


PARTS = tuple(partial(_part, compute) for compute in warm.PARTS)
"""Kernels that separate processes may compile in parallel, after `basics`."""


@kept()
def basics() -> None:
    """Compute what most requests need; other processes compile the rest meanwhile."""
    warm.basics()


@kept()
def warm_up() -> None:
    """Compute one of everything, so that the kernels are in memory."""
    compilation.expect_others(False)
    warm.warm_up()


@kept()
def load(module: str) -> None:
    """Import it."""
    importlib.import_module(module)


# All copies of this process leave it to the compilers, those too that are made before anything is compiled.
compilation.expect_others(not is_compiled())
