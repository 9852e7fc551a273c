"""All robots by name: the catalogue, and robots uploaded or added by hand to the data folder.

Every process checks whether a robot's folder has changed, each time the robot is used. That costs two `stat` calls and
makes uploads and manual edits visible to all at once. Robots are loaded when first needed, within a memory limit.
"""

import difflib
import hashlib
import logging
import os
import re
import threading
import time
import uuid
from collections import OrderedDict
from collections.abc import Mapping, Sequence
from contextlib import suppress
from dataclasses import dataclass, field, replace
from itertools import count
from pathlib import Path
from typing import Literal

import orjson

from gelenk.contract.collision_pairs import PairChoice
from gelenk.contract.common import ChainEnds
from gelenk.contract.robot_file import RobotFile
from gelenk.errors import (
    InvalidName,
    InvalidRobotFolder,
    KinematicsError,
    ReadOnlyRobot,
    RobotExists,
    StorageFailed,
    UnknownMesh,
    UnknownRobot,
)
from gelenk.robot.robot import RobotModel
from gelenk.store import folders
from gelenk.store.findings import findings
from gelenk.store.folders import Content, FileRange
from gelenk.store.index import NAME, Index, summary
from gelenk.store.meshes import MeshFiles, flat
from gelenk.store.quota import ROBOTS, Quota
from gelenk.store.records import (
    ROBOT_FILE,
    LoadedRobot,
    Record,
    Source,
    describe,
    load,
    mesh_file,
    read_record,
    uploaded_record,
)

_MEMORY = 512 * 1024 * 1024
"""Memory for loaded robots, in estimated bytes; Pinocchio's workspace grows with the cube of the joints."""
_VERSION = re.compile(r"files-[0-9a-f]{12}")
_SRDF_NAME = "robot.srdf"
_MODEL_NAMES = {"urdf": "robot.urdf", "dh": "dh.json"}
_TICK = 2_000_000_000
"""Nanoseconds within which two changes of a folder may have the same time."""
_DERIVED = ".derived"
"""Folder for what is computed once of robots: a name that no robot has."""
_ATTEMPTS = 3
"""Attempts to load a robot, since its folder may be replaced between the reading of its record and of its model."""

logger = logging.getLogger("gelenk")


@dataclass(frozen=True, slots=True)
class RobotUpload:
    """A robot to be stored.

    Attributes:
        model: Bytes of the URDF, or of the DH table as JSON.
        default_chain: Chain of calls that name none.
        srdf: Bytes of the SRDF that came with a URDF.
        meshes, urdf_folder: Contents of mesh files by relative path, and the folder of the URDF among them.
        strict: Whether a URDF with harmless faults is refused; not stored.
        notes: What else there is to say about the description; the robot's warnings include it.
        owner: Client that keeps it; it counts against this client's quota.
    """

    name: str
    format: Literal["urdf", "dh"]
    model: bytes
    description: str = ""
    default_chain: ChainEnds | None = None
    meshes: Mapping[str, Content] = field(default_factory=dict)
    urdf_folder: str = ""
    srdf: bytes | None = None
    strict: bool = False
    owner: str | None = None
    notes: Sequence[str] = ()


class Library:
    """Robots by name; safe to use from many threads and processes.

    The catalogue's robots come with the project; the folder of all others is created when first written to.
    """

    def __init__(self, catalogue: Path, uploads: Path, quota: Quota = ROBOTS) -> None:
        self.uploads, self._quota = uploads, quota
        found = (read_record(folder, "catalogue") for folder in sorted(catalogue.iterdir()) if folder.is_dir())
        self._catalogue = {record.name: record for record in found if record is not None}
        self._index = Index(uploads, self._catalogue)
        self._loaded: OrderedDict[str, LoadedRobot] = OrderedDict()
        self._lock = threading.Lock()

    def prepare(self) -> None:
        """Remove what interrupted writers left, and refresh the index; others can write meanwhile."""
        if not self.uploads.is_dir():
            return
        try:
            with folders.staging(self.uploads) as aside:
                for folder in filter(_may_be_swept, self._folders()):
                    with folders.exclusive(self.uploads), suppress(FileNotFoundError):
                        folders.sweep(folder)
                        self._move_stale_versions(folder, aside)
            self._index.entries(looked_at=None)
        except StorageFailed as error:
            logger.warning("uploaded robots cannot be written: %s", error.reason)

    @property
    def catalogue_names(self) -> list[str]:
        """Names of the robots that come with the project."""
        return list(self._catalogue)

    def summaries(self) -> list[bytes]:
        """Return each robot's JSON in the list: the catalogue first, each part by name, invalid folders left out.

        A robot edited by hand may appear as it was before: each call checks only some of the robots for edits.
        """
        entries, others = self._index.entries()
        ours = (self._summary(record.name, "catalogue", record.file) for record in self._catalogue.values())
        uploaded = {entry.name: entry.summary for entry in entries}
        uploaded |= {name: entry for name, file in others if (entry := self._summary(name, "uploaded", file))}
        return [*filter(None, ours), *(uploaded[name] for name in sorted(uploaded))]

    def _summary(self, name: str, source: Source, file: RobotFile) -> bytes | None:
        """Return a robot's JSON in the list; None if its folder is not a robot (a request by name gives the reason)."""
        entry = summary(name, source, file)
        if entry["default_chain"] is None:
            try:
                base_frame, tip_frame = self.get(name).robot.default_chain
            except (KinematicsError, OSError):
                return None
            entry["default_chain"] = {"base_frame": base_frame, "tip_frame": tip_frame}
        return orjson.dumps(entry)

    def _check_quota(self, new: RobotFile, old: RobotFile | None = None) -> None:
        """Check that the owner's quota has room for a robot; one of the same owner that it replaces does not count."""
        if new.owner is None:
            return
        stored = [entry.kept_bytes for entry in self._index.entries()[0] if entry.owner == new.owner]
        replaced = old.kept_bytes if old is not None and old.owner == new.owner else None
        self._quota.check(new.owner, stored, new.kept_bytes, replaced)

    def state(self) -> int | None:
        """Return a number that changes when a robot is added, replaced or removed; None while it could miss a change.

        It is the time of change of the folder, in which every writer creates and removes a folder.
        """
        try:
            changed = self.uploads.stat().st_mtime_ns
        except OSError:
            return None
        return changed if abs(time.time_ns() - changed) > _TICK else None

    def loaded(self, name: str) -> LoadedRobot | None:
        """Return a robot if it is in memory and up to date, else None; fast enough for an event loop."""
        found = self._loaded.get(name)
        if found is None or not (found.record.source == "catalogue" or found.record.is_current()):
            return None
        with self._lock:
            if name in self._loaded:
                self._loaded.move_to_end(name)
        return found

    def is_ours(self, name: str) -> bool:
        """Return whether a robot comes with the project."""
        return name in self._catalogue

    def get(self, name: str) -> LoadedRobot:
        """Return a robot, and load it if necessary; raises UnknownRobot, or InvalidInput if its folder is no robot."""
        found = self.loaded(name)
        for _ in range(_ATTEMPTS):
            if found is not None:
                return found
            try:
                found = replace(load(self._record(name)), derived=self.uploads / _DERIVED)
            except FileNotFoundError:
                continue
            self._keep(found)
        if found is None:
            raise InvalidRobotFolder("it names a model file that does not exist", f"{name}/{ROBOT_FILE}")
        return found

    def mesh(self, name: str, path: str) -> Path:
        """Return the path of a robot's mesh file; raises UnknownMesh if there is none, otherwise as `get`."""
        file = mesh_file(self.get(name), path)
        if file is None:
            raise UnknownMesh(path)
        return file

    def add(self, upload: RobotUpload) -> bool:
        """Store a new robot, on disk and visible to all processes when this returns; False if it was there before.

        Raises InvalidName, RobotExists if another robot uses the name, InvalidInput if the upload does not describe a
        robot, QuotaExceeded if the owner would have too many robots or bytes, and StorageFailed.
        """
        if not NAME.fullmatch(upload.name):
            raise InvalidName(upload.name)
        file, version, contents = _files(upload)
        if self._stands(upload, file):
            return False
        with folders.staging(self.uploads) as staging:
            new = staging / upload.name
            folders.write_tree(new / version, contents)
            folders.write_tree(new, {ROBOT_FILE: _as_bytes(file)})
            with folders.exclusive(self.uploads):
                if self._stands(upload, file):
                    return False
                self._check_quota(file)
                folders.move(new, self.uploads / upload.name)
                self._index.note(upload.name, file)
        return True

    def _stands(self, upload: RobotUpload, wanted: RobotFile) -> bool:
        """Return whether an identical robot is stored; RobotExists for another one of the name."""
        ours, folder = self._catalogue.get(upload.name), self.uploads / upload.name
        if ours is not None:
            is_same = upload.model == ours.model_path.read_bytes() and not upload.meshes
        elif folder.exists():
            is_same = _is_stored(folder, wanted)
        else:
            return False
        if not is_same:
            raise RobotExists(upload.name, ours is not None, self._free(upload.name))
        return True

    def _free(self, name: str) -> str:
        """Return a name that no robot has: `panda_2` for `panda`, `panda_3` for `panda_2`."""
        known = {*self._catalogue, *self._index.names()}
        stem = re.sub(r"_\d{1,2}$", "", name)
        return next(free for i in count(2) if (free := f"{stem[: 63 - len(str(i))]}_{i}") not in known)

    def replace(self, upload: RobotUpload) -> None:
        """Replace an uploaded robot; at any moment, either the old one or the new one exists.

        Raises UnknownRobot, ReadOnlyRobot for one of the catalogue, or as `add`.
        """
        folder = self._writable(upload.name)
        file, version, contents = _files(upload)
        with folders.staging(self.uploads) as staging:
            folders.write_tree(staging / version, contents)
            with folders.exclusive(self.uploads):
                self._writable(upload.name)
                old = uploaded_record(folder)
                self._check_quota(file, old.file if old else None)
                folders.sweep(folder)
                folders.move(staging / version, folder / version)
                try:
                    folders.replace_file(folder, ROBOT_FILE, _as_bytes(file))
                    self._index.note(upload.name, file)
                finally:
                    self._move_stale_versions(folder, staging)
                for path in folder.iterdir():
                    if path.name not in {ROBOT_FILE, version}:
                        path.rename(staging / uuid.uuid4().hex)

    def choose_pairs(self, name: str, choices: list[PairChoice]) -> None:
        """Store which pairs of an uploaded robot's links differ from those found; raises as `replace`."""
        folder = self._writable(name)
        with folders.exclusive(self.uploads):
            self._writable(name)
            file = self._record(name).file.model_copy(update={"collision_pairs": choices})
            folders.replace_file(folder, ROBOT_FILE, _as_bytes(file))
            self._index.note(name, file)

    def remove(self, name: str) -> None:
        """Remove an uploaded robot; raises as `replace`."""
        self._writable(name)
        with folders.exclusive(self.uploads):
            self._writable(name)
            gone = folders.set_aside(self.uploads, name)
        folders.discard(gone)
        with self._lock:
            self._loaded.pop(name, None)

    def _folders(self) -> list[Path]:
        return [path for name in sorted(self._index.names()) if (path := self.uploads / name).is_dir()]

    def _move_stale_versions(self, folder: Path, aside: Path) -> None:
        """Move versions away that a killed replacement wrote, or had not yet removed."""
        if (record := uploaded_record(folder)) is not None:
            for path in folder.iterdir():
                if _VERSION.fullmatch(path.name) and path != record.model_path.parent:
                    path.rename(aside / uuid.uuid4().hex)

    def _writable(self, name: str) -> Path:
        """Return the folder of an uploaded robot; called before the lock is taken, and again while it is held."""
        if name in self._catalogue:
            raise ReadOnlyRobot(name)
        folder = self.uploads / name
        if not NAME.fullmatch(name) or not folder.is_dir():
            raise self._unknown(name)
        return folder

    def _record(self, name: str) -> Record:
        if name in self._catalogue:
            return self._catalogue[name]
        record = read_record(self.uploads / name, "uploaded") if NAME.fullmatch(name) else None
        if record is None:
            raise self._unknown(name)
        return record

    def _unknown(self, name: str) -> UnknownRobot:
        known = [*self._catalogue, *(folder.name for folder in self._folders())]
        return UnknownRobot(name, tuple(difflib.get_close_matches(name[:64], known, n=3)))

    def _keep(self, loaded: LoadedRobot) -> None:
        with self._lock:
            self._loaded[loaded.record.name] = loaded
            self._loaded.move_to_end(loaded.record.name)
            while len(self._loaded) > 1 and sum(_weight(one) for one in self._loaded.values()) > _MEMORY:
                self._loaded.popitem(last=False)


def _may_be_swept(folder: Path) -> bool:
    """Return whether a robot's folder holds hidden files or more than one version."""
    with suppress(OSError):
        names = os.listdir(folder)  # noqa: PTH208 - of each robot at each start
        return any(name.startswith(".") for name in names) or sum(map(bool, map(_VERSION.fullmatch, names))) > 1
    return False


def _weight(loaded: LoadedRobot) -> int:
    """Estimate the memory of a robot, [bytes]: chains, and about 37 MB of Pinocchio's workspace at 100 joints."""
    return 2_000_000 + 37 * int(loaded.robot.model.nv) ** 3


def _files(upload: RobotUpload) -> tuple[RobotFile, str, dict[str, Content]]:
    """Build an upload's robot once; return its `robot.json`, and the folder and contents of its other files.

    Each version has its own folder, so that a replacement never touches files named in the current `robot.json`. Only
    the meshes that the description uses are kept, without the folders around them.
    """
    description, _, _ = describe(upload.name, upload.format, upload.model, upload.strict)
    ends = upload.default_chain
    robot = RobotModel(description, (ends.base_frame, ends.tip_frame) if ends else None)
    base_frame, tip_frame = robot.default_chain
    version = f"files-{uuid.uuid4().hex[:12]}"
    used = MeshFiles(upload.meshes, upload.urdf_folder).used(description.meshes)
    contents: dict[str, Content] = {_MODEL_NAMES[upload.format]: upload.model}
    contents |= {} if upload.srdf is None else {_SRDF_NAME: upload.srdf}
    contents |= {f"meshes/{flat(path)}": upload.meshes[path] for path in sorted(used)}
    file = RobotFile(
        description=upload.description,
        format=upload.format,
        model=f"{version}/{_MODEL_NAMES[upload.format]}",
        srdf=None if upload.srdf is None else f"{version}/{_SRDF_NAME}",
        meshes=f"{version}/meshes" if used else None,
        findings=[*upload.notes, *findings({path: upload.meshes[path] for path in sorted(used)}, upload.srdf)],
        urdf_folder=upload.urdf_folder,
        digest=_digest(upload),
        owner=upload.owner,
        kept_bytes=sum(
            content.size if isinstance(content, FileRange) else len(content) for content in contents.values()
        ),
        left_out=len(upload.meshes) - len(used),
        default_chain=ChainEnds(base_frame=base_frame, tip_frame=tip_frame),
    )
    return file, version, contents


def _as_bytes(file: RobotFile) -> bytes:
    return file.model_dump_json(indent=2, exclude_none=True).encode() + b"\n"


def _digest(upload: RobotUpload) -> str:
    """Return the SHA-256 of the model's bytes, the SRDF's, and of each mesh's path and bytes."""
    digest = hashlib.sha256(upload.model)
    if upload.srdf is not None:
        digest.update(b"\0\0" + upload.srdf)
    for path in sorted(upload.meshes):
        digest.update(f"\0{path}\0".encode())
        of_mesh = hashlib.sha256()
        for piece in folders.pieces(upload.meshes[path]):
            of_mesh.update(piece)
        digest.update(of_mesh.digest())
    return digest.hexdigest()


def _is_stored(folder: Path, wanted: RobotFile) -> bool:
    """Return whether the folder holds an identical robot, whatever the names of its files."""
    record = uploaded_record(folder)
    apart = {"model", "meshes", "srdf", "owner", "kept_bytes", "left_out", "findings", "collision_pairs"}
    return record is not None and record.file.model_dump(exclude=apart) == wanted.model_dump(exclude=apart)
