"""What the process imports that all others of the service are copies of: what requests need."""

import gc
import importlib
import logging.config
import os
from collections.abc import Iterator
from contextlib import contextmanager


@contextmanager
def kept() -> Iterator[None]:
    """Keep the collector of garbage from what is loaded here.

    It would look through all of it again and again, for a fifth of the time that it takes; and the copies share what
    nobody writes to.
    """
    gc.disable()
    try:
        yield
    finally:
        gc.freeze()
        gc.enable()


with kept():
    from app.logs import configuration
    from app.settings import Settings

    logging.config.dictConfig(configuration(Settings.from_environment(os.environ).log_level, at_once=True))
    logging.captureWarnings(True)
    from app.kinematics import warm
    from app.model import compilation

    importlib.import_module("app.main")


def is_compiled() -> bool:
    """Whether `warm_up` will find the kernels compiled, or has to compile them where they stay."""
    return compilation.STORE is None or compilation.is_stored()


@kept()
def warm_up() -> None:
    """Compute one of everything, so that the kernels are in memory."""
    warm.warm_up()


@kept()
def load(module: str) -> None:
    """Import it."""
    importlib.import_module(module)
