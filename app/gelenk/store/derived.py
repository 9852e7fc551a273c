"""Files that are computed from a robot once and read from then on: any of them may be lost, and is made again."""

import hashlib
from collections.abc import Iterable
from contextlib import suppress
from pathlib import Path

from gelenk.errors import StorageFailed
from gelenk.store import folders


def keep(file: Path, content: bytes, pattern: str, most: int) -> None:
    """Store a file, and remove the oldest of its kind beyond so many; a full disk only costs time later.

    Args:
        file: Where it goes; the folder is made.
        content: What it holds.
        pattern: Names of the files of its kind, such as `*.json`.
        most: Number of these that stay.
    """
    with suppress(StorageFailed, OSError):
        file.parent.mkdir(parents=True, exist_ok=True)
        folders.replace_file(file.parent, file.name, content, is_durable=False)
        for old in sorted(file.parent.glob(pattern), key=lambda path: path.stat().st_mtime)[:-most]:
            old.unlink(missing_ok=True)


def code_digest(sources: Iterable[Path]) -> str:
    """Return what changes with the content of source files."""
    return hashlib.sha256(b"".join(source.read_bytes() for source in sorted(sources))).hexdigest()
