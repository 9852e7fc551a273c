"""The secret that decides the numbers of homework, made when it is first needed."""

import contextlib
import os
import secrets
from pathlib import Path

from gelenk.errors import StorageFailed

_NAME = "course-secret"


def kept_secret(folder: Path) -> str:
    """Return the secret in the data folder, the same for all processes; raises StorageFailed if none can be made."""
    place = folder / _NAME
    try:
        if not place.exists():
            _make(place)
        return place.read_text(encoding="ascii")
    except OSError as error:
        raise StorageFailed(error.strerror or str(error)) from None


def _make(place: Path) -> None:
    """Put a new secret in place, unless another process has done so first."""
    place.parent.mkdir(parents=True, exist_ok=True)
    new = place.with_name(f"{_NAME}.{os.getpid()}.{secrets.token_hex(4)}")
    file = os.open(new, os.O_WRONLY | os.O_CREAT | os.O_EXCL, 0o600)
    try:
        with os.fdopen(file, "w", encoding="ascii") as stream:
            stream.write(secrets.token_hex(32))
            stream.flush()
            os.fsync(stream.fileno())
        with contextlib.suppress(FileExistsError):
            os.link(new, place)
    finally:
        new.unlink()
