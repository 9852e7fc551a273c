"""What the process imports that all others of the service are copies of: everything that a request needs."""

import gc
import importlib
import logging.config
import os

from app.kinematics import warm
from app.logs import configuration
from app.settings import Settings

logging.config.dictConfig(configuration(Settings.from_environment(os.environ).log_level, at_once=True))
logging.captureWarnings(True)

for module in ("app.main", "app.plots.profiles", "sympy"):
    importlib.import_module(module)


def warm_up() -> None:
    """Compute one of everything, so that the kernels are in memory."""
    warm.warm_up()
    freeze()


def freeze() -> None:
    """Keep the collector of garbage from what is here: the copies share it for as long as nobody writes to it."""
    gc.collect()
    gc.freeze()


freeze()
