"""Durable writing of folders: complete and on disk, or not there at all.

Everything is written beside, synced, and then made visible by one rename, so that a kill at any moment leaves the
old state or the new. Writers of one root take turns by a file lock, which the system releases when a process dies;
readers need none.
"""

import errno
import fcntl
import os
import shutil
import uuid
from collections.abc import Iterator, Mapping
from contextlib import contextmanager, suppress
from dataclasses import dataclass
from pathlib import Path
from tempfile import TemporaryFile
from typing import IO, TypeAlias

from app.model.errors import StorageFailed, StorageFull

_NEW = ".new-"
_OLD = ".old-"
_LOCK = ".lock"
_PIECE = 1024 * 1024
_PROBE = 64 * 1024


@dataclass(frozen=True, slots=True)
class Stretch:
    """A part of an open file.

    Attributes:
        file: Open for reading.
        start: Where in it the part begins, [bytes].
        size: How long it is, [bytes].
    """

    file: IO[bytes]
    start: int
    size: int


Content: TypeAlias = bytes | Stretch
"""What a file is to hold."""


def pieces(content: Content) -> Iterator[bytes]:
    """The bytes of a content, piece by piece."""
    if isinstance(content, bytes):
        yield content
        return
    content.file.seek(content.start)
    left = content.size
    while left and (piece := content.file.read(min(left, _PIECE))):
        left -= len(piece)
        yield piece


@contextmanager
def writing() -> Iterator[None]:
    """Turn the system's refusal to write into one of ours.

    Raises:
        StorageFailed: The disk refuses to be written to; `StorageFull` where it has no room.
    """
    try:
        yield
    except OSError as error:
        kind = StorageFull if error.errno in {errno.ENOSPC, errno.EDQUOT} else StorageFailed
        raise kind(os.strerror(error.errno or 0)) from error


def why_not(root: Path) -> str | None:
    """Why nothing can be written below `root`, which is made if missing; None where something was, and is gone."""
    try:
        with nameless(root) as file:
            file.write(bytes(_PROBE))
            file.flush()
    except StorageFailed as error:
        return error.reason
    return None


@contextmanager
def nameless(root: Path | None) -> Iterator[IO[bytes]]:
    """A file on the disk of `root` for as long as the context lasts: without a name, gone with the process too.

    Where no folder is given, it is on the disk for temporary files.

    Raises:
        StorageFailed: See `writing`.
    """
    with writing():
        if root is not None:
            _make(root)
        with TemporaryFile(prefix=_NEW, dir=root) as file:
            yield file


@contextmanager
def exclusive(root: Path) -> Iterator[None]:
    """Hold the right to write below `root`, which is made if missing, against every other process and thread.

    Raises:
        StorageFailed: See `writing`.
    """
    with writing():
        _make(root)
        with (root / _LOCK).open("w") as lock:
            fcntl.flock(lock, fcntl.LOCK_EX)
            yield


def sweep(folder: Path) -> None:
    """Remove what interrupted writers have left in a folder; to be called while holding `exclusive`.

    Whoever writes does so first: a process that is killed again and again in the middle fills no disk.
    """
    for pattern in (_NEW + "*", _OLD + "*"):
        for orphan in folder.glob(pattern):
            _discard(orphan)


def create_folder(root: Path, name: str, files: Mapping[str, Content]) -> None:
    """Make `root/name` with these files (their content by relative path), all at once."""
    with _staging(root) as staging:
        _write_tree(staging, files)
        staging.rename(root / name)
        _sync(root)


def replace_file(folder: Path, name: str, content: bytes, is_durable: bool = True) -> None:
    """Put a file in the place of the one of the same name, all at once.

    Args:
        folder: Where it is.
        name: Its name.
        content: What it is to hold.
        is_durable: Whether it is on disk when this returns; else that is left to the system.
    """
    with _staging(folder) as staging:
        _write_tree(staging, {name: content}, is_durable)
        (staging / name).replace(folder / name)
        if is_durable:
            _sync(folder)


def remove_folder(root: Path, name: str) -> None:
    """Remove `root/name`, all at once."""
    old = root / f"{_OLD}{uuid.uuid4().hex}"
    (root / name).rename(old)
    _sync(root)
    _discard(old)


def remove_others(folder: Path, keep: set[str]) -> None:
    """Remove what stands in a folder beside the names to keep."""
    for path in folder.iterdir():
        if path.name not in keep:
            _discard(path)


def _discard(path: Path) -> None:
    """Remove a file, a link or a whole folder that nobody needs any more; what resists is left to the next sweep."""
    if path.is_dir() and not path.is_symlink():
        shutil.rmtree(path, ignore_errors=True)
    else:
        with suppress(OSError):
            path.unlink()


@contextmanager
def _staging(parent: Path) -> Iterator[Path]:
    """A folder to write in that is gone afterwards, unless it was renamed."""
    staging = parent / f"{_NEW}{uuid.uuid4().hex}"
    try:
        yield staging
    finally:
        shutil.rmtree(staging, ignore_errors=True)


def _write_tree(folder: Path, files: Mapping[str, Content], is_durable: bool = True) -> None:
    """Write files below a new folder; where wanted sync each of them, and every folder on the way."""
    folder.mkdir()
    for name, content in files.items():
        path = folder / name
        path.parent.mkdir(parents=True, exist_ok=True)
        with path.open("wb") as target:
            for piece in pieces(content):
                target.write(piece)
            if is_durable:
                target.flush()
                os.fsync(target.fileno())
    if not is_durable:
        return
    for parent in (folder, *(path for path in folder.rglob("*") if path.is_dir())):
        _sync(parent)


def _make(folder: Path) -> None:
    """Make a folder and its parents, their names durable."""
    if not folder.is_dir():
        _make(folder.parent)
        folder.mkdir(exist_ok=True)
        _sync(folder.parent)


def _sync(folder: Path) -> None:
    """Make the names in a folder durable."""
    descriptor = os.open(folder, os.O_RDONLY | os.O_DIRECTORY)
    try:
        os.fsync(descriptor)
    finally:
        os.close(descriptor)
