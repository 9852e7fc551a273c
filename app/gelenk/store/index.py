"""One file with what the list of robots and the quotas need of each uploaded robot, instead of ten thousand folders.

The folders are authoritative; the file is derived from them. A process appends a line when it writes a robot, or reads
one whose line is missing or outdated; the last line of a name counts, and invalid lines are skipped. The folder decides
which robots exist. Lines lost with a killed process, or outdated by a manual edit, are noticed at the next check.
"""

import os
import re
import threading
import zlib
from collections.abc import Collection, Iterable
from contextlib import suppress
from itertools import islice
from pathlib import Path
from typing import Any, NamedTuple

import orjson

from gelenk.contract.robot_file import RobotFile
from gelenk.errors import StorageFailed
from gelenk.store import folders
from gelenk.store.records import ROBOT_FILE, Source, Stamp, stamp_of, uploaded_record

NAME = re.compile(r"[A-Za-z0-9][A-Za-z0-9_.-]{0,63}")
_FILE = ".index"
_FORM = 1
"""What the checksums of lines begin with: other than that of releases whose lines lack fields of the list."""
_LOOKED_AT = 2000
"""Number of robots that each listing checks for manual edits; a check takes a few microseconds."""
_SPARE_LINES = 1000
"""Number of outdated lines allowed beyond the number of robots before the file is rewritten."""


class IndexEntry(NamedTuple):
    """The index entry of an uploaded robot: the stamp of its `robot.json`, and its JSON in the list of robots.

    `kept_bytes` is the size of its files as counted for the quota of its owner, [bytes].
    """

    name: str
    stamp: Stamp
    owner: str | None
    kept_bytes: int
    summary: bytes


class Index:
    """An index of the uploaded robots, whose names are not `reserved`; safe in many threads and processes."""

    def __init__(self, uploads: Path, reserved: Collection[str]) -> None:
        self._uploads, self._reserved = uploads, reserved
        self._lock = threading.Lock()
        self._known: dict[str, IndexEntry] = {}
        self._inode = self._position = self._lines = self._next = 0

    def names(self) -> list[str]:
        """Return the names in the folder that an uploaded robot may have; some may belong to files."""
        try:
            names = os.listdir(self._uploads)  # noqa: PTH208 - there may be thousands
        except (FileNotFoundError, NotADirectoryError):
            return []
        return [name for name in names if NAME.fullmatch(name) and name not in self._reserved]

    def entries(self, looked_at: int | None = _LOOKED_AT) -> tuple[list[IndexEntry], list[tuple[str, RobotFile]]]:
        """Return the known robots, sorted by name, and those that must be loaded before they can be listed.

        Folders that are not robots are left out. Each call checks the next `looked_at` of the known ones for edits.
        """
        with self._lock:
            # In this order, a robot added in between is left out here and read by the next call.
            names = sorted(self.names())
            self._follow()
            self._known = {name: self._known[name] for name in names if name in self._known}
            self._forget_edited(looked_at)
            read = {name: self._read(name) for name in names if name not in self._known}
            found = {name: entry for name, entry in read.items() if isinstance(entry, IndexEntry)}
            self._append(found.values())
            self._known = {name: entry for name in names if (entry := self._known.get(name) or found.get(name))}
            others = [(name, file) for name, file in read.items() if isinstance(file, RobotFile)]
            return list(self._known.values()), others

    def note(self, name: str, file: RobotFile) -> None:
        """Record a robot that was just written, for all processes; the caller must hold `folders.exclusive`."""
        with self._lock:
            stamp = self._stamp(name)
            if stamp is None:
                return
            self._follow()
            entry = _entry(name, stamp, file)
            if self._lines <= 2 * len(self._known) + _SPARE_LINES:
                self._append([entry])
                return
            content = b"".join(map(_as_line, (self._known | {name: entry}).values()))
            with suppress(OSError, StorageFailed):
                folders.replace_file(self._uploads, _FILE, content, is_durable=False)

    def _forget_edited(self, count: int | None) -> None:
        """Check the next few known robots and drop those that have changed since they were read."""
        turn = list(self._known)
        begin = self._next % len(turn) if turn and count is not None else 0
        self._next = begin + (count or 0)
        for name in islice([*turn[begin:], *turn[:begin]], count):
            if self._known[name].stamp != self._stamp(name):
                del self._known[name]

    def _stamp(self, name: str) -> Stamp | None:
        with suppress(OSError):
            return stamp_of(f"{self._uploads}/{name}/{ROBOT_FILE}")
        return None

    def _read(self, name: str) -> IndexEntry | RobotFile | None:
        record = uploaded_record(self._uploads / name)
        if record is None:
            return None
        stamp = record.signature[0]
        return record.file if stamp is None or record.file.default_chain is None else _entry(name, stamp, record.file)

    def _follow(self) -> None:
        """Read the lines appended since the last call, or the whole file if it has been replaced."""
        try:
            with folders.open_plain(self._uploads / _FILE) as file:
                status = os.fstat(file.fileno())
                if status.st_ino != self._inode or status.st_size < self._position:
                    self._inode, self._position, self._lines = status.st_ino, 0, 0
                file.seek(self._position)
                appended = file.read()
        except OSError:
            return
        whole = appended[: appended.rfind(b"\n") + 1]
        self._position += len(whole)
        lines = [line for line in whole.split(b"\n") if line]
        self._lines += len(lines)
        for line in lines:
            with suppress(ValueError):
                entry = _from_line(line)
                self._known[entry.name] = entry

    def _append(self, entries: Iterable[IndexEntry]) -> None:
        """Append lines; if the disk refuses them, this only costs time later."""
        content = b"".join(map(_as_line, entries))
        if content:
            with suppress(OSError), folders.open_plain(self._uploads / _FILE, "ab") as file:
                file.write(content)


ABOUT = ("description", "maker", "kind", "closed_form")
"""Fields of `robot.json` that the list of robots repeats."""


def summary(name: str, source: Source, file: RobotFile) -> dict[str, Any]:
    """Return a robot's entry in the list of robots; its chain is None if `robot.json` does not name one."""
    chain = None if file.default_chain is None else file.default_chain.model_dump()
    about = {field: getattr(file, field) for field in ABOUT}
    return {"name": name, **about, "source": source, "format": file.format, "default_chain": chain}


def _entry(name: str, stamp: Stamp, file: RobotFile) -> IndexEntry:
    return IndexEntry(name, stamp, file.owner, file.kept_bytes, orjson.dumps(summary(name, "uploaded", file)))


def _as_line(entry: IndexEntry) -> bytes:
    """Join the fields and their checksum by tabs, which JSON never contains; a line break before ends any torn line."""
    stamp = b"%d %d %d" % entry.stamp
    fields = (entry.name.encode(), stamp, orjson.dumps(entry.owner), b"%d" % entry.kept_bytes, entry.summary)
    line = b"\t".join(fields)
    return b"\n%b\t%d\n" % (line, zlib.crc32(line, _FORM))


def _from_line(line: bytes) -> IndexEntry:
    """Parse a line; raises ValueError if it is damaged."""
    fields, _, checksum = line.rpartition(b"\t")
    if int(checksum) != zlib.crc32(fields, _FORM):
        raise ValueError("it is damaged")
    name, stamp, owner, kept_bytes, listed = fields.split(b"\t")
    changed, inode, size = map(int, stamp.split())
    known = None if owner == b"null" else orjson.loads(owner)
    return IndexEntry(name.decode(), (changed, inode, size), known, int(kept_bytes), listed)
