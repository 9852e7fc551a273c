"""Imports of the process that all other processes of the service are copied from."""

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

    Scanning it repeatedly would take a fifth of the time, and copies share only memory that is never written.
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
    from gelenk.kinematics import warm_up as warm
    from gelenk.robot import compilation

    importlib.import_module("gelenk.main")


def is_compiled() -> bool:
    """Check whether nothing is left to other processes: the kernels are stored, or there is no store for them."""
    return compilation.STORE is None or compilation.is_stored()


def _part(compute: Callable[[], None]) -> None:
    compilation.expect_others(False)
    compute()


PARTS = tuple(partial(_part, compute) for compute in warm.PARTS)
"""Functions that compile kernels; separate processes may run them in parallel, after `basics`."""


@kept()
def basics() -> None:
    """Compute once what most requests need, to compile it; other processes compile the rest meanwhile."""
    warm.basics()


@kept()
def warm_up() -> None:
    """Compute everything once, so that the kernels are in memory."""
    compilation.expect_others(False)
    warm.warm_up()


@kept()
def load(module: str) -> None:
    """Import a module."""
    importlib.import_module(module)


# All copies of this process leave compiling to the compilers, even those made before anything is compiled.
compilation.expect_others(not is_compiled())
