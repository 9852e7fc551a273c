"""Unpacks an untrusted zip of a URDF, its meshes and its SRDF, and checks names, counts and actual sizes.

The sizes stated in a zip are not trusted: bytes are counted while they are unpacked. Nothing here parses a mesh:
kinematics does not need meshes, and the browser gets them unchanged.
"""

import os
import stat
import struct
import zipfile
import zlib
from collections.abc import Iterator
from contextlib import contextmanager
from dataclasses import dataclass
from io import BytesIO
from pathlib import Path, PurePosixPath
from typing import IO, BinaryIO

from gelenk.errors import InvalidArchive, TooLarge, quoted
from gelenk.robot.xml import MAX_BYTES
from gelenk.store.folders import FileRange, nameless
from gelenk.store.meshes import KEPT_SUFFIXES

MAX_ENTRIES = 2000
MAX_UNPACKED = 256 * 1024 * 1024
MAX_PATH_BYTES = 200
MAX_DIRECTORY = 1024 * 1024
"""Largest size of the list of entries at the end of a zip, [bytes]: 2,000 entries need a quarter of it."""
MAX_FOLDERS = 16
"""Largest number of folders above an entry; widely used packages have about ten at most."""
_CHUNK = 1024 * 1024
_END_RECORD = struct.Struct("<4s4H2LH")


@dataclass(frozen=True, slots=True)
class UnpackedRobot:
    """Contents of an archive: a URDF and its folder, "" at the top, mesh files by path, and an SRDF if it has one.

    The meshes are parts of an unnamed file that disappears when the context of `unpacked` or the process ends.
    """

    urdf: bytes
    urdf_folder: str
    meshes: dict[str, FileRange]
    srdf: bytes | None = None


@contextmanager
def unpacked(
    file: BinaryIO, max_unpacked: int = MAX_UNPACKED, root: Path | None = None, urdf: str | None = None
) -> Iterator[UnpackedRobot]:
    """Unpack an archive for the duration of the context, on the disk of `root`, else that of temporary files.

    `urdf` is the path in the archive of the URDF that is meant; it may be left out if there is only one.

    Raises InvalidArchive if it is no zip, has no such URDF, several and none is named, or an entry that is not allowed,
    TooLarge with more entries than allowed or more than `max_unpacked` bytes, and StorageFailed without room on disk.
    """
    _check_directory(file)
    try:
        archive = zipfile.ZipFile(file)
    except (zipfile.BadZipFile, ValueError, NotImplementedError, OSError) as error:
        raise InvalidArchive("the file is not a zip archive") from error
    with archive, nameless(root) as store:
        yield _unpack(archive, store, max_unpacked, urdf)


def _unpack(archive: zipfile.ZipFile, store: IO[bytes], max_unpacked: int, wanted: str | None) -> UnpackedRobot:
    if (count := len(archive.infolist())) > MAX_ENTRIES:  # the number in the end record may be false
        raise TooLarge("entries in the archive", count, MAX_ENTRIES)
    entries = [entry for entry in archive.infolist() if not entry.filename.endswith("/")]
    _check_overlap(entries, archive.start_dir)
    for entry in entries:
        _check_entry(entry)
    _check_names([entry.filename.lower() for entry in entries])
    description = _description(entries, wanted)
    srdfs = [entry for entry in entries if entry.filename.lower().endswith(".srdf")]
    if len(srdfs) > 1:
        raise InvalidArchive(f"the archive holds {len(srdfs)} SRDF files; it may hold one")
    meshes: dict[str, FileRange] = {}
    used = 0
    for entry in entries:
        if PurePosixPath(entry.filename).suffix.lower() not in KEPT_SUFFIXES:
            continue
        size = _copy(archive, entry, store, max_unpacked - used, max_unpacked)
        meshes[entry.filename] = FileRange(store, used, size)
        used += size
    urdf, srdf = BytesIO(), BytesIO()
    for entry, text in zip((description, *srdfs), (urdf, srdf), strict=False):
        _copy(archive, entry, text, MAX_BYTES, MAX_BYTES)
    parent = PurePosixPath(description.filename).parent
    folder = "" if str(parent) == "." else str(parent)
    return UnpackedRobot(urdf.getvalue(), folder, meshes, srdf.getvalue() if srdfs else None)


def _description(entries: list[zipfile.ZipInfo], wanted: str | None) -> zipfile.ZipInfo:
    """Return the URDF that is wanted; the only one if none is named."""
    found = {entry.filename: entry for entry in entries if entry.filename.lower().endswith(".urdf")}
    if not found:
        raise InvalidArchive("the archive holds no URDF file; it must hold at least one")
    files = tuple(sorted(found))
    if wanted is None and len(files) > 1:
        raise InvalidArchive(f"the archive holds {len(files)} URDF files; name one of them in `file`", files=files)
    if wanted is not None and wanted not in found:
        raise InvalidArchive("`file` must be one of the archive's URDF files", files=files)
    return found[wanted or files[0]]


def _check_directory(file: BinaryIO) -> None:
    """Refuse an overlong list of entries before reading it: the end record of the zip states its length."""
    size = file.seek(0, os.SEEK_END)
    file.seek(max(0, size - _END_RECORD.size - 0xFFFF))
    tail = file.read()
    file.seek(0)
    start = tail.rfind(b"PK\5\6")
    if start < 0 or len(tail) - start < _END_RECORD.size:
        raise InvalidArchive("the file is not a zip archive")
    _, _, _, _, count, directory, _, _ = _END_RECORD.unpack_from(tail, start)
    if tail[max(0, start - 20) : start].startswith(b"PK\6\7"):
        raise InvalidArchive("the zip is in the format for archives beyond 4 GB")
    if count > MAX_ENTRIES:
        raise TooLarge("entries in the archive", count, MAX_ENTRIES)
    if directory > MAX_DIRECTORY:
        raise TooLarge("bytes in the archive's list of entries", directory, MAX_DIRECTORY)


def _check_entry(entry: zipfile.ZipInfo) -> None:
    name = entry.filename
    parts = name.split("/")
    if name.startswith("/") or "\\" in name or ":" in name or any(part in {"", ".", ".."} for part in parts):
        raise InvalidArchive("its path must stay inside the archive", name)
    if len(name.encode()) > MAX_PATH_BYTES or not name.isprintable():
        raise InvalidArchive(f"its path must be at most {MAX_PATH_BYTES} bytes of printable characters", name)
    if len(parts) > MAX_FOLDERS + 1:
        raise InvalidArchive(f"it is {len(parts) - 1} folders deep; at most {MAX_FOLDERS} are allowed", name)
    mode = entry.external_attr >> 16
    if stat.S_ISLNK(mode):
        raise InvalidArchive("links are not allowed", name)
    if stat.S_IFMT(mode) not in {0, stat.S_IFREG}:
        raise InvalidArchive("it must be a plain file", name)
    if entry.compress_type not in {zipfile.ZIP_STORED, zipfile.ZIP_DEFLATED}:
        raise InvalidArchive("its compression is not known: stored or deflated", name)
    if entry.flag_bits & 0x1:
        raise InvalidArchive("encrypted entries are not allowed", name)


def _check_names(names: list[str]) -> None:
    seen = {name[:end] for name in names for end, letter in enumerate(name) if letter == "/"}
    for name in names:
        if name in seen:
            raise InvalidArchive("it is in the archive twice, or as a folder too", name)
        seen.add(name)


def _check_overlap(entries: list[zipfile.ZipInfo], directory: int) -> None:
    """Refuse entries that overlap the list of entries, or share bytes, which is how a small zip becomes a huge one."""
    end = -1
    for entry in sorted(entries, key=lambda entry: entry.header_offset):
        if entry.header_offset < end:
            raise InvalidArchive("it overlaps another entry", entry.filename)
        end = entry.header_offset + entry.compress_size
        if end > directory:
            raise InvalidArchive("it overlaps the list of entries", entry.filename)


def _copy(archive: zipfile.ZipFile, entry: zipfile.ZipInfo, sink: IO[bytes], left: int, allowed: int) -> int:
    """Append an unpacked entry to a file, counting; return its number of bytes."""
    count = 0
    for chunk in _chunks(archive, entry):
        count += len(chunk)
        if count > left:
            raise TooLarge(f"bytes unpacked up to {quoted(entry.filename)}", allowed - left + count, allowed)
        sink.write(chunk)
    return count


def _chunks(archive: zipfile.ZipFile, entry: zipfile.ZipInfo) -> Iterator[bytes]:
    try:
        with archive.open(entry) as source:
            while chunk := source.read(_CHUNK):
                yield chunk
    except (zipfile.BadZipFile, zlib.error, EOFError, ValueError, NotImplementedError, RuntimeError) as error:
        raise InvalidArchive("it cannot be unpacked", entry.filename) from error
