"""Durable writing of folders: complete and on disk, or not there at all.

Everything is written beside its target, synced, and made visible by one rename, so a kill at any moment leaves the old
state or the new one. Writers of one root take turns by a file lock, which the system releases when a process dies;
readers need no lock. Slow work, such as writing or removing much data, happens in a `staging` folder without that lock.
"""

import errno
import fcntl
import os
import shutil
import stat
import uuid
from collections.abc import Iterator, Mapping
from contextlib import ExitStack, contextmanager, suppress
from dataclasses import dataclass
from pathlib import Path
from tempfile import TemporaryFile
from typing import IO, Any, TypeAlias

from gelenk.errors import StorageFailed, StorageFull

_NEW = ".new-"
_OLD = ".old-"
_LOCK = ".lock"
_PIECE = 1024 * 1024
_PROBE = 64 * 1024


@dataclass(frozen=True, slots=True)
class FileRange:
    """A part of a file that is open for reading: its start and size in the file, [bytes]."""

    file: IO[bytes]
    start: int
    size: int


Content: TypeAlias = bytes | FileRange
"""Content to write to a file."""


def pieces(content: Content) -> Iterator[bytes]:
    """Yield the bytes of a content in pieces."""
    if isinstance(content, bytes):
        yield content
        return
    content.file.seek(content.start)
    left = content.size
    while left and (piece := content.file.read(min(left, _PIECE))):
        left -= len(piece)
        yield piece


def open_plain(path: Path, mode: str = "rb") -> IO[Any]:
    """Open a regular file of the data folder, not blocking on a pipe; raises FileNotFoundError for anything else."""
    try:
        file = open(path, mode, opener=lambda name, flags: os.open(name, flags | os.O_NONBLOCK, 0o666))  # noqa: SIM115
    except OSError as error:
        if error.errno in {errno.ENXIO, errno.EISDIR}:  # a socket, or a pipe without a reader; a folder
            raise FileNotFoundError(errno.ENOENT, "it is not a plain file", str(path)) from error
        raise
    if stat.S_ISREG(os.fstat(file.fileno()).st_mode):
        return file
    file.close()
    raise FileNotFoundError(errno.ENOENT, "it is not a plain file", str(path))


def read_plain(path: Path) -> bytes:
    """Return the content of a file of the data folder; raises the errors of `open_plain`."""
    with open_plain(path) as file:
        content: bytes = file.read()
    return content


@contextmanager
def writing() -> Iterator[None]:
    """Turn the system's errors of writing into `StorageFailed`, or `StorageFull` if the disk has no room."""
    try:
        yield
    except OSError as error:
        kind = StorageFull if error.errno in {errno.ENOSPC, errno.EDQUOT} else StorageFailed
        raise kind(os.strerror(error.errno or 0)) from error


def why_not(root: Path) -> str | None:
    """Return why nothing can be written below `root`, which is created if missing; None if a test write succeeds."""
    try:
        probe(root)
    except StorageFailed as error:
        return error.reason
    return None


def probe(root: Path) -> None:
    """Write a file below `root` that is gone when this returns; raises as `writing`."""
    with nameless(root) as file:
        file.write(bytes(_PROBE))
        file.flush()


@contextmanager
def nameless(root: Path | None) -> Iterator[IO[bytes]]:
    """Open an unnamed file on the disk of `root` for the duration of the context; it disappears with the process too.

    If no folder is given, the file is on the disk for temporary files. Raises as `writing`.
    """
    with writing():
        if root is not None:
            _make(root)
        with TemporaryFile(prefix=_NEW, dir=root) as file:
            yield file


@contextmanager
def exclusive(root: Path) -> Iterator[None]:
    """Lock writing below `root`, created if missing, against all other processes and threads; raises as `writing`."""
    with writing():
        _make(root)
        with open_plain(root / _LOCK, "w") as lock:
            fcntl.flock(lock, fcntl.LOCK_EX)
            yield


@contextmanager
def staging(root: Path) -> Iterator[Path]:
    """Create a folder for new files, or for those to be removed; the context removes it with its content.

    It first removes what interrupted writers left in `root`, so that a process killed again and again while writing
    does not fill the disk. Only while moving that away it holds `exclusive`, which the caller must not hold. Raises as
    `writing`.
    """
    folder = root / f"{_NEW}{uuid.uuid4().hex}"
    with ExitStack() as stack:
        with exclusive(root):
            folder.mkdir()
            stack.callback(discard, folder)
            # Locked as long as it is in use: see `_orphans`.
            lock = stack.enter_context((folder / _LOCK).open("w"))
            fcntl.flock(lock, fcntl.LOCK_EX)
            orphans = []
            for orphan in _orphans(root):
                with suppress(FileNotFoundError):  # its writer is about to remove it
                    orphans.append(orphan.rename(folder / orphan.name))
        for orphan in orphans:
            discard(orphan)
        yield folder


def sweep(folder: Path) -> None:
    """Remove what interrupted writers left in a folder; the caller must hold `exclusive`."""
    for orphan in _orphans(folder):
        discard(orphan)


def create_folder(root: Path, name: str, files: Mapping[str, Content]) -> None:
    """Create `root/name` atomically, with files given by relative path; the caller must hold `exclusive`."""
    with _beside(root) as new:
        write_tree(new, files)
        move(new, root / name)


def replace_file(folder: Path, name: str, content: bytes, is_durable: bool = True) -> None:
    """Replace a file, or create it, atomically; unless durable, the system decides when to write it to disk."""
    with _beside(folder) as new:
        write_tree(new, {name: content}, is_durable)
        (new / name).replace(folder / name)
        if is_durable:
            sync(folder)


def remove_folder(root: Path, name: str) -> None:
    """Remove `root/name` atomically."""
    discard(set_aside(root, name))


def set_aside(root: Path, name: str) -> Path:
    """Rename `root/name` to an invisible path, which works on a full disk too; return that path for `discard`."""
    old = root / f"{_OLD}{uuid.uuid4().hex}"
    move(root / name, old)
    return old


def move(source: Path, target: Path) -> None:
    """Rename a folder below the same root; the new name is on disk when this returns."""
    source.rename(target)
    sync(target.parent)


def discard(path: Path) -> None:
    """Remove an unused file, link or whole folder; what cannot be removed is left to the next sweep."""
    if path.is_dir() and not path.is_symlink():
        shutil.rmtree(path, ignore_errors=True)
    else:
        with suppress(OSError):
            path.unlink()


def write_tree(folder: Path, files: Mapping[str, Content], is_durable: bool = True) -> None:
    """Write files below a new folder, and then sync files and folders if durable; raises as `writing`."""
    paths = [folder / name for name in files]
    parents = sorted({folder, *(path.parent for path in paths)})
    with writing():
        for parent in parents:
            parent.mkdir(parents=True, exist_ok=True)
        for path, content in zip(paths, files.values(), strict=True):
            with path.open("wb") as target:
                target.writelines(pieces(content))
        for path in (*paths, *parents) if is_durable else ():
            sync(path)


@contextmanager
def _beside(parent: Path) -> Iterator[Path]:
    """Yield the path of a folder to write in; it is removed afterwards, unless it was renamed."""
    new = parent / f"{_NEW}{uuid.uuid4().hex}"
    try:
        yield new
    finally:
        discard(new)


def _orphans(folder: Path) -> list[Path]:
    left = [folder / name for name in os.listdir(folder) if name.startswith((_OLD, _NEW))]  # noqa: PTH208 - of thousands
    return [path for path in left if path.name.startswith(_OLD) or not is_locked(path / _LOCK)]


def is_locked(file: Path) -> bool:
    """Return whether a process holds the lock of a file; False if the file is missing or not a plain one."""
    try:
        with open_plain(file) as lock:
            fcntl.flock(lock, fcntl.LOCK_SH | fcntl.LOCK_NB)
    except BlockingIOError:
        return True
    except OSError:
        return False
    return False


def _make(folder: Path) -> None:
    if not folder.is_dir():
        _make(folder.parent)
        folder.mkdir(exist_ok=True)
        sync(folder.parent)


def sync(path: Path) -> None:
    """Flush the bytes of a file, or the names in a folder, to disk."""
    descriptor = os.open(path, os.O_RDONLY)
    try:
        os.fsync(descriptor)
    finally:
        os.close(descriptor)
