"""Durable writing of folders: complete and on disk, or not there at all.

Everything is written beside, synced, and then made visible by one rename, so that a kill at any moment leaves the
old state or the new. Writers of one root take turns by a file lock, which the system releases when a process dies;
readers need none.
"""

import fcntl
import os
import shutil
import uuid
from collections.abc import Iterator, Mapping
from contextlib import contextmanager
from pathlib import Path

_NEW = ".new-"
_OLD = ".old-"
_LOCK = ".lock"


@contextmanager
def exclusive(root: Path) -> Iterator[None]:
    """Hold the right to write below `root`, which is made if missing, against every other process and thread."""
    root.mkdir(parents=True, exist_ok=True)
    with (root / _LOCK).open("w") as lock:
        fcntl.flock(lock, fcntl.LOCK_EX)
        yield


def sweep(root: Path) -> None:
    """Remove what interrupted writers have left below `root`; to be called while holding `exclusive`."""
    for pattern in (_NEW + "*", _OLD + "*", f"*/{_NEW}*"):
        for orphan in root.glob(pattern):
            shutil.rmtree(orphan, ignore_errors=True)


def write_tree(folder: Path, files: Mapping[str, bytes | Path]) -> None:
    """Write files below a folder and sync each of them, and every folder on the way.

    Args:
        folder: Made if missing.
        files: Content, or a file to copy, by relative path.
    """
    folder.mkdir(exist_ok=True)
    for name, content in files.items():
        path = folder / name
        path.parent.mkdir(parents=True, exist_ok=True)
        with path.open("wb") as target:
            if isinstance(content, Path):
                with content.open("rb") as source:
                    shutil.copyfileobj(source, target, 1024 * 1024)
            else:
                target.write(content)
            target.flush()
            os.fsync(target.fileno())
    for parent in sorted({folder, *(path for path in folder.rglob("*") if path.is_dir())}):
        sync_folder(parent)


def create_folder(root: Path, name: str, files: Mapping[str, bytes | Path]) -> None:
    """Make `root/name` with these files, all at once; the name must be free."""
    staging = root / f"{_NEW}{uuid.uuid4().hex}"
    write_tree(staging, files)
    staging.rename(root / name)
    sync_folder(root)


def replace_file(folder: Path, name: str, content: bytes) -> None:
    """Put a file in the place of the one of the same name, all at once."""
    staging = folder / f"{_NEW}{uuid.uuid4().hex}"
    write_tree(staging, {name: content})
    (staging / name).replace(folder / name)
    sync_folder(folder)
    staging.rmdir()


def remove_folder(root: Path, name: str) -> None:
    """Remove `root/name`, all at once."""
    old = root / f"{_OLD}{uuid.uuid4().hex}"
    (root / name).rename(old)
    sync_folder(root)
    shutil.rmtree(old, ignore_errors=True)


def sync_folder(folder: Path) -> None:
    """Make the names in a folder durable."""
    descriptor = os.open(folder, os.O_RDONLY | os.O_DIRECTORY)
    try:
        os.fsync(descriptor)
    finally:
        os.close(descriptor)


def remove_others(folder: Path, keep: set[str]) -> None:
    """Remove what stands in a folder beside the names to keep."""
    for path in folder.iterdir():
        if path.name not in keep:
            if path.is_dir() and not path.is_symlink():
                shutil.rmtree(path, ignore_errors=True)
            else:
                path.unlink(missing_ok=True)
