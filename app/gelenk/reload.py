"""Restart the service whenever one of its files changes: `gelenk serve --reload`, for development."""

import signal
import subprocess
import sys
import time
from collections.abc import Sequence
from pathlib import Path
from types import FrameType

from gelenk.package_data import catalogue

_LOOK_SECONDS, _END_SECONDS = 0.5, 10.0
_WATCHED = frozenset({".json", ".py", ".urdf"})

States = dict[Path, int]


def serve_again(arguments: Sequence[str]) -> None:
    """Run the service until SIGINT or SIGTERM, and restart it on each change; after a failure, wait for a change."""
    signal.signal(signal.SIGTERM, _interrupt)
    command = [sys.executable, "-m", "gelenk.serve", *arguments]
    service = None
    try:
        while True:
            seen = states()
            service = subprocess.Popen(command)  # noqa: S603 - the arguments are those of whoever starts it
            while not (changed := _changed(seen, states())):
                time.sleep(_LOOK_SECONDS)
            print(f"{changed} has changed: starting again", flush=True)
            _end(service)
    except KeyboardInterrupt:
        if service is not None:
            _end(service)


def states() -> States:
    """Return when each file of the package and of the catalogue was last changed, [ns]."""
    found = {}
    for folder in (Path(__file__).parent, catalogue()):
        for path in folder.rglob("*"):
            if path.suffix in _WATCHED:
                try:
                    found[path] = path.stat().st_mtime_ns
                except FileNotFoundError:  # an editor is just replacing it
                    continue
    return found


def _changed(before: States, now: States) -> Path | None:
    return next((path for path in sorted({*before, *now}) if before.get(path) != now.get(path)), None)


def _end(service: "subprocess.Popen[bytes]") -> None:
    service.terminate()
    try:
        service.wait(_END_SECONDS)
    except subprocess.TimeoutExpired:
        service.kill()
        service.wait()


def _interrupt(_: int, __: FrameType | None) -> None:
    raise KeyboardInterrupt
