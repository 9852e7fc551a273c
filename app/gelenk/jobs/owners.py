"""Which processes of the service are alive: each locks its own file, and the system releases the lock when it ends."""

import fcntl
import uuid
from pathlib import Path
from typing import IO

from gelenk.store.folders import open_plain


class Owners:
    """This process of the service among all of them, on any machine that sees the folder.

    Args:
        folder: Of the locked files; made when first needed.
    """

    def __init__(self, folder: Path) -> None:
        self._folder = folder
        self._lock: IO[str] | None = None
        self.own_name = uuid.uuid4().hex

    def say_alive(self) -> None:
        """Hold a lock from now on; to be called before anything is this process's."""
        if self._lock is None:
            self._folder.mkdir(exist_ok=True)
            self._lock = open_plain(self._folder / self.own_name, "w")
            fcntl.flock(self._lock, fcntl.LOCK_EX)

    def lives(self, name: str) -> bool:
        """Whether a process is there."""
        if name == self.own_name:
            return self._lock is not None
        try:
            with open_plain(self._folder / name) as lock:
                fcntl.flock(lock, fcntl.LOCK_SH | fcntl.LOCK_NB)
        except BlockingIOError:
            return True
        except OSError:
            return False
        return False

    def sweep(self) -> None:
        """Remove the files of processes that are gone."""
        for lock in self._folder.glob("*"):
            if not self.lives(lock.name):
                lock.unlink(missing_ok=True)

    def close(self) -> None:
        """Let go of the lock."""
        if self._lock is not None:
            self._lock.close()
            (self._folder / self.own_name).unlink(missing_ok=True)
            self._lock = None
