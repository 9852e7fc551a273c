"""The finished parts of a job, beside its request in its folder: what it need not do again after a restart.

A part is one file with a digest before its content, written beside and renamed: a kill at any moment leaves all of it
or nothing. It is not synced, which would cost more than many a part; where the machine itself has lost one, or a half
of it, the digest tells, and the part is computed again.
"""

import hashlib
import uuid
from pathlib import Path

from app.model.errors import TooLarge, UnknownJob
from app.store import folders

_PREFIX = "part-"
_BESIDE = ".part-"
_DIGEST = 32


class Parts:
    """Parts by name; to be written to by one thread at a time.

    Args:
        folder: The job's.
        most_bytes: How much all of them may take.
    """

    def __init__(self, folder: Path, most_bytes: int) -> None:
        self._folder, self._most_bytes = folder, most_bytes
        for orphan in folder.glob(f"{_BESIDE}*"):
            orphan.unlink(missing_ok=True)
        self._bytes = sum(path.stat().st_size for path in folder.glob(f"{_PREFIX}*"))

    def read(self, name: str) -> bytes | None:
        """A part; None where it is not there as a whole."""
        try:
            content = folders.read_plain(self._folder / f"{_PREFIX}{name}")
        except FileNotFoundError:
            return None
        digest, content = content[:_DIGEST], content[_DIGEST:]
        return content if digest == _digest(content) else None

    def write(self, name: str, content: bytes) -> None:
        """Keep a part.

        Raises:
            TooLarge: All of them would take too much.
            UnknownJob: The job was removed meanwhile.
            StorageFailed: The disk does not take it.
        """
        if self._bytes + len(content) > self._most_bytes:
            raise TooLarge("bytes of the parts of a job", self._bytes + len(content), self._most_bytes)
        beside = self._folder / f"{_BESIDE}{uuid.uuid4().hex}"
        with folders.writing():
            try:
                with beside.open("wb") as target:
                    target.write(_digest(content))
                    target.write(content)
                beside.replace(self._folder / f"{_PREFIX}{name}")
            except FileNotFoundError:
                raise UnknownJob(self._folder.name) from None
            except OSError:
                beside.unlink(missing_ok=True)
                raise
        self._bytes += len(content)

    def clear(self) -> None:
        """Remove all of them."""
        for path in self._folder.glob(f"{_PREFIX}*"):
            path.unlink(missing_ok=True)
        self._bytes = 0


def _digest(content: bytes) -> bytes:
    return hashlib.blake2b(content, digest_size=_DIGEST).digest()
