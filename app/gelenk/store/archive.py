"""Unpacks an untrusted zip of a description, its meshes and its SRDF, and checks names, counts and actual sizes.

The sizes stated in a zip are not trusted: bytes are counted while they are unpacked. A mesh is parsed only
where a description leaves a mass to it: kinematics does not need meshes, and the browser gets them unchanged.
"""

import os
import re
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

from gelenk.collision.shapes.hulls import hull_triangles
from gelenk.collision.shapes.meshes import read_triangles
from gelenk.errors import InvalidArchive, InvalidMesh, TooLarge, counted, quoted
from gelenk.robot.arrays import Array
from gelenk.robot.formats.reading import is_robot
from gelenk.robot.formats.sources import MAX_READ, Sources, folder_of
from gelenk.robot.xml import MAX_BYTES
from gelenk.store.folders import FileRange, nameless
from gelenk.store.meshes import KEPT_SUFFIXES, MeshFiles

MAX_ENTRIES = 2000
MAX_UNPACKED = 256 * 1024 * 1024
MAX_PATH_BYTES = 200
MAX_DIRECTORY = 1024 * 1024
"""Largest size of the list of entries at the end of a zip, [bytes]: 2,000 entries need a quarter of it."""
MAX_FOLDERS = 16
"""Largest number of folders above an entry; widely used packages have about ten at most."""
MAX_CANDIDATES = 200
"""Largest number of xacro and XML files that are read to find out which of them is the robot."""
MAX_MESH_BYTES = 16 * 1024 * 1024
"""Largest size of a mesh from which a description's masses are computed."""
MAX_INDICES = 32
"""Largest number of folders from which files have been looked for and whose index is kept."""
_NAMED = re.compile(rb"(?<=[/\\\"'])[^/\\\"'<>]{4,200}+(?=[\"'])")
"""The last part of a path in quotes, with a suffix of at least four bytes."""
_CHUNK = 1024 * 1024
_DESCRIPTIONS = (".urdf", ".xacro", ".xml")
_END_RECORD = struct.Struct("<4s4H2LH")


@dataclass(frozen=True, slots=True)
class UnpackedRobot:
    """Contents of an archive: a description and its path, mesh files by path, and an SRDF if it has one.

    The meshes are parts of an unnamed file that disappears when the context of `unpacked` or the process ends; that
    also ends `sources`, the files that the description may include.
    """

    model: bytes
    path: str
    sources: Sources
    meshes: dict[str, FileRange]
    srdf: bytes | None = None

    @property
    def folder(self) -> str:
        """Folder of the description, "" at the top."""
        return folder_of(self.path)


@contextmanager
def unpacked(
    file: BinaryIO, max_unpacked: int = MAX_UNPACKED, root: Path | None = None, wanted: str | None = None
) -> Iterator[UnpackedRobot]:
    """Unpack an archive for the duration of the context, on the disk of `root`, else that of temporary files.

    `wanted` is the path in the archive of the description that is meant; it may be left out if there is only one.

    Raises InvalidArchive if it is no zip, has no such description, several and none is named, or an entry that is not
    allowed, TooLarge with more entries than allowed or more than `max_unpacked` bytes, and StorageFailed without room
    on disk.
    """
    _check_directory(file)
    try:
        archive = zipfile.ZipFile(file)
    except (zipfile.BadZipFile, ValueError, NotImplementedError, OSError) as error:
        raise InvalidArchive("the file is not a zip archive") from error
    with archive, nameless(root) as store:
        yield _unpack(archive, store, max_unpacked, wanted)


def _unpack(archive: zipfile.ZipFile, store: IO[bytes], max_unpacked: int, wanted: str | None) -> UnpackedRobot:
    if (count := len(archive.infolist())) > MAX_ENTRIES:  # the number in the end record may be false
        raise TooLarge("entries in the archive", count, MAX_ENTRIES)
    entries = [entry for entry in archive.infolist() if not entry.filename.endswith("/")]
    _check_overlap(entries, archive.start_dir)
    for entry in entries:
        _check_entry(entry)
    _check_names([entry.filename.lower() for entry in entries])
    sources = _sources(archive, entries)
    path = _description(sources, [entry.filename for entry in entries], wanted)
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
    srdf = sources.read(srdfs[0].filename) if srdfs else None
    return UnpackedRobot(sources.read(path), path, sources, meshes, srdf)


def _sources(archive: zipfile.ZipFile, entries: list[zipfile.ZipInfo]) -> Sources:
    """Return the files of an archive; each is read when it is needed."""
    known = {entry.filename: entry for entry in entries}
    by_folder: dict[str, MeshFiles] = {}

    def find(name: str, folder: str) -> list[str]:
        if folder not in by_folder:
            if len(by_folder) == MAX_INDICES:
                by_folder.clear()
            by_folder[folder] = MeshFiles(known, folder)
        return by_folder[folder].find(name)

    def read(path: str) -> bytes:
        content = BytesIO()
        _copy(archive, known[path], content, MAX_BYTES, MAX_BYTES)
        return content.getvalue()

    def triangles(path: str) -> Array:
        if known[path].file_size > MAX_MESH_BYTES:
            raise InvalidMesh(f"it has more than {MAX_MESH_BYTES} bytes", path)
        content = BytesIO()
        _copy(archive, known[path], content, MAX_MESH_BYTES, MAX_MESH_BYTES)
        return read_triangles(path, content.getvalue())

    return Sources(find, read, triangles, hull_triangles)


def _description(sources: Sources, paths: list[str], wanted: str | None) -> str:
    """Return the path of the description that is wanted; of the only one if none is named: a URDF before a xacro."""
    by_kind = [sorted(path for path in paths if path.lower().endswith(kind)) for kind in _DESCRIPTIONS]
    urdfs, others = by_kind[0], by_kind[1] + by_kind[2]
    if wanted is not None and wanted in urdfs + others:
        return wanted
    files = tuple(urdfs or _robots(sources, others))
    if not files:
        raise InvalidArchive("the archive holds no description: a URDF, xacro or MJCF file")
    if wanted is not None:
        raise InvalidArchive("`file` must be one of the archive's descriptions", files=files)
    if len(files) > 1:
        raise InvalidArchive(
            f"the archive holds {counted(len(files), 'description')}; name one of them in `file`", files=files
        )
    return files[0]


def _robots(sources: Sources, paths: list[str]) -> list[str]:
    """Return those of the paths whose files describe a robot and are not a part that another one of them includes."""
    if len(paths) > MAX_CANDIDATES:
        raise InvalidArchive(f"the archive holds {len(paths)} xacro and XML files; name the robot's in `file`")
    found: dict[str, bytes] = {}
    for path in paths:
        found[path] = sources.read(path)
        if (size := sum(map(len, found.values()))) > MAX_READ:
            raise TooLarge("bytes of xacro and XML files in the archive", size, MAX_READ)
    robots = [path for path in paths if is_robot(found[path])]
    names = {path: PurePosixPath(path).name.encode() for path in robots}
    mentioned = {path: set(_NAMED.findall(found[path])) for path in robots}
    parts = {path for path in robots if any(names[path] in mentioned[other] for other in robots if other != path)}
    return [path for path in robots if path not in parts] or robots


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
