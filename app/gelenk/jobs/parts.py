"""The finished parts of a job, beside its request in its folder: what it need not do again after a restart.

A part is one file, whose name has a digest of the request: a process that still computes one of a job that was removed
leaves it to no other job of that name. It has a digest before its content, written beside and renamed: a kill at any
moment leaves all of it or nothing. It is not synced, which would cost more than many a part; where the machine itself
has lost one, or a half of it, the digest tells, and the part is computed again.
"""

import hashlib
import uuid
from collections.abc import Callable, Iterator
from io import BytesIO
from pathlib import Path
from typing import Any

import numpy as np
from numpy.typing import NDArray

from gelenk.errors import TooLarge, UnknownJob
from gelenk.store import folders

_PREFIX = "part-"
_BESIDE = ".part-"
_DIGEST = 32
_KEY = 16
"""Of the digest of a request, in the names of its parts."""


class Parts:
    """Parts by name; each to be written to by one thread or process at a time.

    Args:
        folder: The job's.
        digest: Of its request.
        most_bytes: How much all of them may take.

    Attributes:
        bytes: How much they take: those that were there, and those that are counted since.
    """

    def __init__(self, folder: Path, digest: str, most_bytes: int) -> None:
        self.folder, self._most_bytes = folder, most_bytes
        self._prefix = f"{_PREFIX}{digest[:_KEY]}-"
        for orphan in folder.glob(f"{_BESIDE}*"):
            orphan.unlink(missing_ok=True)
        self.bytes = sum(path.stat().st_size for path in folder.glob(f"{_PREFIX}*"))

    def read(self, name: str) -> bytes | None:
        """A part; None where it is not there as a whole."""
        try:
            content = folders.read_plain(self.folder / f"{self._prefix}{name}")
        except FileNotFoundError:
            return None
        digest, content = content[:_DIGEST], content[_DIGEST:]
        return content if digest == _digest(content) else None

    def of(self, stage: str, count: int) -> Iterator[bytes]:
        """The parts of a stage in their order, all of which have been kept.

        Raises:
            FileNotFoundError: One of them no longer exists.
        """
        for k in range(count):
            part = self.read(f"{stage}-{k}")
            if part is None:
                raise FileNotFoundError(f"{stage}-{k}")
            yield part

    def write(self, name: str, content: bytes) -> int:
        """Keep a part.

        Returns:
            How much more they take now, to be added to `bytes` in the process that counts.

        Raises:
            TooLarge: All of them would take too much.
            UnknownJob: The job was removed meanwhile.
            StorageFailed: The disk does not take it.
        """
        if self.bytes + _DIGEST + len(content) > self._most_bytes:
            raise TooLarge("bytes of the parts of a job", self.bytes + len(content), self._most_bytes)
        beside = self.folder / f"{_BESIDE}{uuid.uuid4().hex}"
        with folders.writing():
            try:
                with beside.open("wb") as target:
                    target.write(_digest(content))
                    target.write(content)
                beside.replace(self.folder / f"{self._prefix}{name}")
            except FileNotFoundError:
                raise UnknownJob(self.folder.name) from None
            except OSError:
                beside.unlink(missing_ok=True)
                raise
        return _DIGEST + len(content)

    def clear(self) -> None:
        """Remove all of them."""
        for path in self.folder.glob(f"{_PREFIX}*"):
            path.unlink(missing_ok=True)
        self.bytes = 0


def computed(job: tuple[Callable[[Any], bytes], Any, Parts, str]) -> int:
    """Compute a part by a function and its argument, and keep it under a name; see `Parts.write`."""
    function, argument, parts, name = job
    return parts.write(name, function(argument))


def _digest(content: bytes) -> bytes:
    return hashlib.blake2b(content, digest_size=_DIGEST).digest()


def packed(**arrays: Any) -> bytes:
    """Return numbers and arrays of numbers by their names as bytes that hold no code; None is left out."""
    target = BytesIO()
    np.savez(target, allow_pickle=False, **{name: array for name, array in arrays.items() if array is not None})
    return target.getvalue()


def unpacked(content: bytes) -> dict[str, NDArray[Any]]:
    """Return the arrays that `packed` was given, to the last bit; a number is an array of shape ()."""
    with np.load(BytesIO(content), allow_pickle=False) as arrays:
        return dict(arrays)
