"""Which cases of a sweep run at every turn; collecting them quickly; hearing interrupts; the same draws each time."""

import gc
import signal
import sys
import zlib
from collections import defaultdict

import pytest

if signal.getsignal(signal.SIGINT) is signal.SIG_IGN:
    # As a shell starts what runs in the background; what tests start would inherit it and hear no Ctrl-C.
    signal.signal(signal.SIGINT, signal.default_int_handler)


def pytest_collection() -> None:
    """Collect no garbage while tests are collected: next to nothing of what that makes is garbage."""
    gc.disable()


def pytest_collection_finish() -> None:
    """From here on it counts, but for what is there already. Hypothesis is loaded by now, if any test needs it."""
    gc.freeze()
    gc.enable()
    if (providers := sys.modules.get("hypothesis.internal.conjecture.providers")) is not None:
        # It would also draw the numbers and texts in modules of ours that are loaded: what an earlier test imports
        # would change the draws of all later ones.
        nothing = providers.Constants()
        vars(providers)["_get_local_constants"] = lambda: nothing


@pytest.hookimpl(tryfirst=True)
def pytest_collection_modifyitems(items: list[pytest.Item]) -> None:
    """Of a test marked `quick(n)`, leave n of its cases in the quick set, and mark the others `slow`.

    They are chosen by a hash of their names: always the same ones, and of each parameter several values.
    """
    sweeps: dict[tuple[str, int], list[pytest.Item]] = defaultdict(list)
    for item in items:
        if (marker := item.get_closest_marker("quick")) is not None:
            sweeps[item.nodeid.partition("[")[0], marker.args[0]].append(item)
    for (_, kept), cases in sweeps.items():
        cases.sort(key=lambda item: (item.get_closest_marker("slow") is not None, zlib.crc32(item.nodeid.encode())))
        for item in cases[kept:]:
            item.add_marker(pytest.mark.slow)
