"""Which processes of the service are alive: each locks its own file, which the system unlocks when the process ends."""

import fcntl
import uuid
from pathlib import Path
from typing import IO

from gelenk.store.folders import is_locked, open_plain


class Owners:
    """The processes of the service that own jobs, as seen by one of them; `register` creates their folder."""

    def __init__(self, folder: Path) -> None:
        self._folder = folder
        self._lock: IO[str] | None = None
        self.own_name = uuid.uuid4().hex

    def register(self) -> None:
        """Lock the file of this process; call this before the process owns a job."""
        if self._lock is None:
            self._folder.mkdir(exist_ok=True)
            self._lock = open_plain(self._folder / self.own_name, "w")
            fcntl.flock(self._lock, fcntl.LOCK_EX)

    def is_alive(self, name: str) -> bool:
        """Return whether the process with a name is alive."""
        return self._lock is not None if name == self.own_name else is_locked(self._folder / name)

    def sweep(self) -> None:
        """Remove the files of processes that have ended."""
        for lock in self._folder.glob("*"):
            if not self.is_alive(lock.name):
                lock.unlink(missing_ok=True)

    def release(self) -> None:
        """Release the lock of this process and remove its file."""
        if self._lock is not None:
            self._lock.close()
            (self._folder / self.own_name).unlink(missing_ok=True)
            self._lock = None
