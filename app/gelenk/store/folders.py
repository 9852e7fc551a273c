"""Durable writing of folders: complete and on disk, or not there at all.

Everything is written beside, synced, and then made visible by one rename, so that a kill at any moment leaves the
old state or the new. Writers of one root take turns by a file lock, which the system releases when a process dies;
readers need none. What takes long, to write much or to remove it, happens in a `staging` folder without that lock.
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

from gelenk.model.errors import StorageFailed, StorageFull

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


def open_plain(path: Path, mode: str = "rb") -> IO[Any]:
    """Open a file of the data folder, where a pipe in its place is not waited for.

    Raises:
        FileNotFoundError: There is none, or a pipe, a device, a socket or a folder instead.
        OSError: It cannot be opened.
    """
    try:
        file = open(path, mode, opener=lambda name, flags: os.open(name, flags | os.O_NONBLOCK, 0o666))  # noqa: SIM115
    except OSError as error:
        if error.errno in {errno.ENXIO, errno.EISDIR}:  # a socket, or a pipe that nobody reads; a folder
            raise FileNotFoundError(errno.ENOENT, "it is not a plain file", str(path)) from error
        raise
    if stat.S_ISREG(os.fstat(file.fileno()).st_mode):
        return file
    file.close()
    raise FileNotFoundError(errno.ENOENT, "it is not a plain file", str(path))


def read_plain(path: Path) -> bytes:
    """The content of a file of the data folder; raises as `open_plain` does."""
    with open_plain(path) as file:
        content: bytes = file.read()
    return content


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
        with open_plain(root / _LOCK, "w") as lock:
            fcntl.flock(lock, fcntl.LOCK_EX)
            yield


@contextmanager
def staging(root: Path) -> Iterator[Path]:
    """A folder to write in, or to move there what is to go; it and what is in it are gone after the context.

    First it removes what interrupted writers have left in `root`: a process that is killed again and again in the
    middle fills no disk. `exclusive`, which must not be held before, is only held while that is moved into the folder.

    Raises:
        StorageFailed: See `writing`.
    """
    folder = root / f"{_NEW}{uuid.uuid4().hex}"
    with ExitStack() as stack:
        with exclusive(root):
            folder.mkdir()
            stack.callback(discard, folder)
            # Locked as long as it is in use: see `_is_in_use`.
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
    """Remove what interrupted writers have left in a folder; to be called while holding `exclusive`."""
    for orphan in _orphans(folder):
        discard(orphan)


def create_folder(root: Path, name: str, files: Mapping[str, Content]) -> None:
    """Make `root/name` with these files (their content by relative path), all at once, while holding `exclusive`."""
    with _beside(root) as new:
        write_tree(new, files)
        move(new, root / name)


def replace_file(folder: Path, name: str, content: bytes, is_durable: bool = True) -> None:
    """Put a file in the place of the one of the same name, all at once.

    Args:
        folder: Where it is.
        name: Its name.
        content: What it is to hold.
        is_durable: Whether it is on disk when this returns; else that is left to the system.
    """
    with _beside(folder) as new:
        write_tree(new, {name: content}, is_durable)
        (new / name).replace(folder / name)
        if is_durable:
            _sync(folder)


def remove_folder(root: Path, name: str) -> None:
    """Remove `root/name`, all at once."""
    discard(set_aside(root, name))


def set_aside(root: Path, name: str) -> Path:
    """Make `root/name` invisible at once, which a full disk allows too; the path is there to be discarded."""
    old = root / f"{_OLD}{uuid.uuid4().hex}"
    move(root / name, old)
    return old


def move(source: Path, target: Path) -> None:
    """Give a folder another name below the same root, on disk when this returns."""
    source.rename(target)
    _sync(target.parent)


def discard(path: Path) -> None:
    """Remove an unused file, link or whole folder; what cannot be removed is left to the next sweep."""
    if path.is_dir() and not path.is_symlink():
        shutil.rmtree(path, ignore_errors=True)
    else:
        with suppress(OSError):
            path.unlink()


def write_tree(folder: Path, files: Mapping[str, Content], is_durable: bool = True) -> None:
    """Write files below a new folder, and where wanted sync them and the folders: when all are written, it is quicker.

    Raises:
        StorageFailed: See `writing`.
    """
    paths = [folder / name for name in files]
    parents = sorted({folder, *(path.parent for path in paths)})
    with writing():
        for parent in parents:
            parent.mkdir(parents=True, exist_ok=True)
        for path, content in zip(paths, files.values(), strict=True):
            with path.open("wb") as target:
                target.writelines(pieces(content))
        for path in (*paths, *parents) if is_durable else ():
            _sync(path)


@contextmanager
def _beside(parent: Path) -> Iterator[Path]:
    """A name of a folder to write in that is gone afterwards, unless it was renamed."""
    new = parent / f"{_NEW}{uuid.uuid4().hex}"
    try:
        yield new
    finally:
        discard(new)


def _orphans(folder: Path) -> list[Path]:
    """What interrupted writers have left in a folder."""
    left = [folder / name for name in os.listdir(folder) if name.startswith((_OLD, _NEW))]  # noqa: PTH208 - of thousands
    return [path for path in left if path.name.startswith(_OLD) or not _is_in_use(path)]


def _is_in_use(new: Path) -> bool:
    """Whether a process holds the lock in a folder of `staging`."""
    try:
        with open_plain(new / _LOCK) as lock:
            fcntl.flock(lock, fcntl.LOCK_SH | fcntl.LOCK_NB)
    except BlockingIOError:
        return True
    except OSError:
        return False
    return False


def _make(folder: Path) -> None:
    """Make a folder and its parents, their names durable."""
    if not folder.is_dir():
        _make(folder.parent)
        folder.mkdir(exist_ok=True)
        _sync(folder.parent)


def _sync(path: Path) -> None:
    """Make the bytes of a file, or the names in a folder, durable."""
    descriptor = os.open(path, os.O_RDONLY)
    try:
        os.fsync(descriptor)
    finally:
        os.close(descriptor)
