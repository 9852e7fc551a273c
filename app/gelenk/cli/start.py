"""The command's first module: from here on Ctrl-C ends it with a code and no traceback.

It ends at once, also while modules load, as long as nothing needs closing; `raised_interrupts` is for when something
does.
"""

import sys

_INTERRUPTED = 130
try:
    import os
    import signal
    from collections.abc import Iterator
    from contextlib import contextmanager
    from types import FrameType
except KeyboardInterrupt:
    sys.exit(_INTERRUPTED)

_MOMENT = 0.01
"""How long a library's callback that has swallowed an interrupt may take to return, [s]; or it comes once more."""


def main() -> None:
    """Run the command; see `gelenk.cli.main`."""
    if signal.getsignal(signal.SIGINT) is signal.default_int_handler:
        signal.signal(signal.SIGINT, _end)
    from gelenk.cli.main import main as run  # noqa: PLC0415 - takes a third of a second

    try:
        run()
    except KeyboardInterrupt:
        sys.exit(_INTERRUPTED)


@contextmanager
def raised_interrupts() -> Iterator[None]:
    """Let Ctrl-C raise KeyboardInterrupt, so that what is open is closed, such as jobs; for a command of `main`."""
    if signal.getsignal(signal.SIGINT) is not _end:
        yield
        return
    signal.signal(signal.SIGINT, signal.default_int_handler)
    if hasattr(signal, "pthread_kill"):
        sys.unraisablehook = _interrupt_again
    try:
        yield
    finally:
        signal.signal(signal.SIGINT, _end)


def _end(_: int, __: FrameType | None) -> None:
    os._exit(_INTERRUPTED)


def _interrupt_again(lost: "sys.UnraisableHookArgs") -> None:
    """Interrupt again soon what a callback, where nothing can be raised, has kept from the code that called it."""
    if issubclass(lost.exc_type, KeyboardInterrupt):
        from threading import Timer, get_ident  # noqa: PLC0415 - rare

        Timer(_MOMENT, signal.pthread_kill, (get_ident(), signal.SIGINT)).start()  # it may wait by then
    else:
        sys.__unraisablehook__(lost)
