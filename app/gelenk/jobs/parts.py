"""The finished parts of a job, in its folder, so that the job does not compute them again after a restart.

A part is one file. Its name contains a digest of the request, so that a part of a removed job, computed too late, does
not end up in a new job of the same name. The file is written beside its target and renamed: a kill at any moment leaves
all of it or nothing. It is not synced, which would take longer than computing many a part. Instead it starts with a
digest of its content, which reveals what a crash of the machine has damaged; such a part is computed again.
"""

import hashlib
import math
import uuid
from collections.abc import Callable, Iterator
from pathlib import Path
from typing import Any

import numpy as np
import orjson
from numpy.typing import NDArray

from gelenk.errors import TooLarge, UnknownJob
from gelenk.store import folders

_PREFIX = "part-"
_FORM = "2-"
"""Follows the prefix in the names of parts that `packed` makes in its present form: others are computed again."""
_BESIDE = ".part-"
_DIGEST = 32
_KEY = 16
"""Number of characters of the request's digest in the names of its parts."""
_ALIGNED = 16
"""Where packed arrays begin, in multiples of this, [bytes]."""


class Parts:
    """The finished parts of a job by name; only one thread or process at a time may write the same part.

    `bytes` is the size of all, [bytes]: of those found at first, and those that the caller has added since.
    """

    def __init__(self, folder: Path, digest: str, most_bytes: int) -> None:
        self.folder, self._most_bytes = folder, most_bytes
        self._prefix = f"{_PREFIX}{_FORM}{digest[:_KEY]}-"
        for orphan in folder.glob(f"{_BESIDE}*"):
            orphan.unlink(missing_ok=True)
        self.bytes = sum(path.stat().st_size for path in folder.glob(f"{_PREFIX}*"))

    def read(self, name: str) -> bytes | None:
        """Return the content of a part; None if it is missing or damaged."""
        try:
            content = folders.read_plain(self.folder / f"{self._prefix}{name}")
        except FileNotFoundError:
            return None
        digest, content = content[:_DIGEST], content[_DIGEST:]
        return content if digest == _digest(content) else None

    def of(self, stage: str, count: int) -> Iterator[bytes]:
        """Yield the parts of a finished stage in order; raises FileNotFoundError if one is missing or damaged."""
        for k in range(count):
            part = self.read(f"{stage}-{k}")
            if part is None:
                raise FileNotFoundError(f"{stage}-{k}")
            yield part

    def write(self, name: str, content: bytes) -> int:
        """Write a part; return the size of its file, [bytes], which the process that counts must add to `bytes`.

        Raises TooLarge beyond `most_bytes`, UnknownJob if the job has been removed, and StorageFailed.
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
        """Remove all parts."""
        for path in self.folder.glob(f"{_PREFIX}*"):
            path.unlink(missing_ok=True)
        self.bytes = 0


def computed(job: tuple[Callable[[Any], bytes], Any, Parts, str]) -> int:
    """Compute a part, given as (function, argument, parts, name), and write it; see `Parts.write`."""
    function, argument, parts, name = job
    return parts.write(name, function(argument))


def _digest(content: bytes) -> bytes:
    return hashlib.sha256(content).digest()  # for which processors have instructions


def packed(**arrays: Any) -> bytes:
    """Pack named numbers and arrays of numbers, except None, into bytes that cannot contain code.

    They begin with a list of names, types and shapes as JSON, after its length; the arrays follow, each aligned. Unlike
    an npz file they need no second copy and no checksum: what stores them has its own.
    """
    given = {name: np.asarray(array, order="C") for name, array in arrays.items() if array is not None}
    if any(array.dtype.hasobject for array in given.values()):
        raise ValueError("only numbers can be packed")
    head = orjson.dumps([(name, array.dtype.str, array.shape) for name, array in given.items()])
    pieces: list[Any] = [len(head).to_bytes(_ALIGNED, "little"), head]
    for array in given.values():
        pieces += [bytes(-len(pieces[-1]) % _ALIGNED), array.reshape(-1).view(np.uint8).data]
    return b"".join(pieces)


def unpacked(content: bytes, *wanted: str) -> dict[str, NDArray[Any]]:
    """Return the arrays packed by `packed`, or those of these names, bit for bit; a number has the shape ()."""
    start = _ALIGNED + int.from_bytes(content[:_ALIGNED], "little")
    arrays = {}
    for name, kind, shape in orjson.loads(content[_ALIGNED:start]):
        start += -start % _ALIGNED
        array = np.frombuffer(content, kind, math.prod(shape), start).reshape(shape)
        start += array.nbytes
        if not wanted or name in wanted:
            # A copy, because arrays over bytes are read-only: kernels would be compiled for that type as well.
            arrays[name] = array.copy()
    return arrays
