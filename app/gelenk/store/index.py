"""What the list of robots and the quotas need of each uploaded robot, in one file instead of ten thousand.

The folders are what counts, and the file is derived from them. Who writes a robot, or reads one that the file does not
know as it is, appends a line; the last one of a name counts, and what is no line is passed over. Which robots there
are the folder itself says. What was lost with a killed process, or edited by hand, is found when it is examined again.
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

from gelenk.contract.robots import RobotFile
from gelenk.model.errors import KinematicsError, StorageFailed
from gelenk.store import folders
from gelenk.store.records import ROBOT_FILE, Source, Stamp, read_record, stamp_of

NAME = re.compile(r"[A-Za-z0-9][A-Za-z0-9_.-]{0,63}")
_FILE = ".index"
_LOOKED_AT = 2000
"""Robots of which each list looks whether a person has edited them; a look takes some microseconds."""
_SPARE_LINES = 1000
"""Lines that are outdated may be as many as there are robots, and these."""


class Entry(NamedTuple):
    """An uploaded robot as the index tells of it.

    Attributes:
        name: The robot's name.
        stamp: Of its `robot.json`.
        owner: Which client keeps it.
        kept_bytes: Of its files, as they count for the quota.
        summary: As the list of robots has it, in JSON.
    """

    name: str
    stamp: Stamp
    owner: str | None
    kept_bytes: int
    summary: bytes


class Index:
    """The uploaded robots as the list tells of them; safe to use from many threads and processes.

    Args:
        uploads: Their folder.
        reserved: Names that none of them may have.
    """

    def __init__(self, uploads: Path, reserved: Collection[str]) -> None:
        self._uploads, self._reserved = uploads, reserved
        self._lock = threading.Lock()
        self._known: dict[str, Entry] = {}
        self._inode = self._position = self._lines = self._next = 0

    def names(self) -> list[str]:
        """What may be the name of an uploaded robot; a file may have such a name too."""
        try:
            names = os.listdir(self._uploads)  # noqa: PTH208 - there may be thousands
        except (FileNotFoundError, NotADirectoryError):
            return []
        return [name for name in names if NAME.fullmatch(name) and name not in self._reserved]

    def entries(self, looked_at: int | None = _LOOKED_AT) -> tuple[list[Entry], list[tuple[str, RobotFile]]]:
        """The uploaded robots by name, and those that must be loaded to say what the list has of them.

        Folders that are not robots are left out.

        Args:
            looked_at: How many known ones are checked for edits; None for all. The next list
                goes on from there.
        """
        with self._lock:
            # In this order: a robot that is added in between is not listed, and read by the next one.
            names = sorted(self.names())
            self._follow()
            self._known = {name: self._known[name] for name in names if name in self._known}
            self._forget_edited(looked_at)
            read = {name: self._read(name) for name in names if name not in self._known}
            found = {name: entry for name, entry in read.items() if isinstance(entry, Entry)}
            self._append(found.values())
            self._known = {name: entry for name in names if (entry := self._known.get(name) or found.get(name))}
            others = [(name, file) for name, file in read.items() if isinstance(file, RobotFile)]
            return list(self._known.values()), others

    def note(self, name: str, file: RobotFile) -> None:
        """Tell the others of a robot that was just written; to be called while holding `folders.exclusive`."""
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
        """Check the next few known robots for changes since they were read."""
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

    def _read(self, name: str) -> Entry | RobotFile | None:
        try:
            record = read_record(self._uploads / name, "uploaded")
        except (KinematicsError, OSError):
            return None
        if record is None:
            return None
        stamp = record.signature[0]
        return record.file if stamp is None or record.file.default_chain is None else _entry(name, stamp, record.file)

    def _follow(self) -> None:
        """Read what has been appended since the last time; all of it where another file has taken its place."""
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

    def _append(self, entries: Iterable[Entry]) -> None:
        """Add lines; a disk that takes none costs time alone."""
        content = b"".join(map(_as_line, entries))
        if content:
            with suppress(OSError), folders.open_plain(self._uploads / _FILE, "ab") as file:
                file.write(content)


def summary(name: str, source: Source, file: RobotFile) -> dict[str, Any]:
    """A robot in the list of robots; its chain is None where `robot.json` does not name it."""
    chain = None if file.default_chain is None else file.default_chain.model_dump()
    told = {"name": name, "description": file.description, "source": source, "format": file.format}
    return told | {"default_chain": chain}


def _entry(name: str, stamp: Stamp, file: RobotFile) -> Entry:
    return Entry(name, stamp, file.owner, file.kept_bytes, orjson.dumps(summary(name, "uploaded", file)))


def _as_line(entry: Entry) -> bytes:
    """Fields and their checksum between tabs, which JSON has none of; it also ends one before that is torn."""
    stamp = b"%d %d %d" % entry.stamp
    fields = (entry.name.encode(), stamp, orjson.dumps(entry.owner), b"%d" % entry.kept_bytes, entry.summary)
    line = b"\t".join(fields)
    return b"\n%b\t%d\n" % (line, zlib.crc32(line))


def _from_line(line: bytes) -> Entry:
    """Raises ValueError where it is damaged."""
    fields, _, checksum = line.rpartition(b"\t")
    if int(checksum) != zlib.crc32(fields):
        raise ValueError("it is damaged")
    name, stamp, owner, kept_bytes, told = fields.split(b"\t")
    changed, inode, size = map(int, stamp.split())
    known = None if owner == b"null" else orjson.loads(owner)
    return Entry(name.decode(), (changed, inode, size), known, int(kept_bytes), told)
