"""All robots by name: the catalogue, and those that were uploaded or dropped into the data folder.

Every process asks the folder whether a robot has changed, each time it is used; that costs one `stat` and makes an
upload visible to all of them at once. Robots are loaded when first needed and kept within a bound of memory.
"""

import difflib
import hashlib
import re
import threading
import uuid
from collections import OrderedDict
from collections.abc import Mapping
from dataclasses import dataclass, field
from pathlib import Path

from app.model.errors import InvalidName, KinematicsError, ReadOnlyRobot, RobotExists, UnknownMesh, UnknownRobot
from app.model.robot import Robot
from app.schemas.common import ChainEnds
from app.schemas.robots import RobotFile
from app.store import folders
from app.store.records import (
    ROBOT_FILE,
    LoadedRobot,
    Record,
    Signature,
    describe,
    load,
    mesh_file,
    read_record,
    signature_of,
)

_NAME = re.compile(r"[A-Za-z0-9][A-Za-z0-9_.-]{0,63}")
_MEMORY = 512 * 1024 * 1024
"""Estimated bytes of loaded robots kept; Pinocchio's work space grows with the cube of the joints."""
_CATALOGUE_SIGNATURE: Signature = (0,)


@dataclass(frozen=True, slots=True)
class RobotUpload:
    """What someone wants to be kept as a robot.

    Attributes:
        name: The robot's name.
        format: What `model` is.
        model: The bytes of the URDF or of the DH table as JSON.
        description: One sentence for people.
        default_chain: Chain of calls that name none.
        meshes: Mesh files by relative path.
        urdf_folder: Where the URDF stood among them.
    """

    name: str
    format: str
    model: bytes
    description: str = ""
    default_chain: ChainEnds | None = None
    meshes: Mapping[str, Path] = field(default_factory=dict)
    urdf_folder: str = ""


class Library:
    """Robots by name; safe to use from many threads and processes.

    Args:
        catalogue: Folder of the robots that come with the project.
        uploads: Folder of all others; made when first written to.
    """

    def __init__(self, catalogue: Path, uploads: Path) -> None:
        self._uploads = uploads
        self._catalogue: dict[str, Record] = {}
        for folder in sorted(catalogue.iterdir()):
            record = read_record(folder, "catalogue") if folder.is_dir() else None
            if record is not None:
                self._catalogue[folder.name] = record
        self._loaded: OrderedDict[str, tuple[Signature, LoadedRobot]] = OrderedDict()
        self._lock = threading.Lock()

    def prepare(self) -> None:
        """Remove what an interrupted writer may have left."""
        if self._uploads.is_dir():
            with folders.exclusive(self._uploads):
                folders.sweep(self._uploads)

    def records(self) -> list[Record]:
        """All robots, the catalogue's first, each part by name; folders that are no robots are left out."""
        uploaded = []
        if self._uploads.is_dir():
            for folder in sorted(self._uploads.iterdir()):
                if _NAME.fullmatch(folder.name) and folder.name not in self._catalogue:
                    try:
                        record = read_record(folder, "uploaded")
                    except (KinematicsError, OSError):
                        continue
                    if record is not None:
                        uploaded.append(record)
        return [*self._catalogue.values(), *uploaded]

    def loaded(self, name: str) -> LoadedRobot | None:
        """A robot if it is in memory and up to date; quick enough for an event loop."""
        entry = self._loaded.get(name)
        if entry is None or entry[0] != self._signature(name):
            return None
        return entry[1]

    def get(self, name: str) -> LoadedRobot:
        """A robot, loaded if need be.

        Raises:
            UnknownRobot: There is none of this name.
            InvalidInput: A folder dropped in by hand is no robot.
        """
        found = self.loaded(name)
        if found is not None:
            with self._lock:
                if name in self._loaded:
                    self._loaded.move_to_end(name)
            return found
        for _ in range(3):  # the folder may be replaced between two steps
            record = self._record(name)
            try:
                found = load(record)
            except FileNotFoundError:
                continue
            self._keep(name, record.signature, found)
            return found
        raise UnknownRobot(name)

    def mesh(self, name: str, path: str) -> Path:
        """A mesh file of a robot.

        Raises:
            UnknownRobot: There is no such robot.
            UnknownMesh: It has no such file.
        """
        file = mesh_file(self.get(name), path)
        if file is None:
            raise UnknownMesh(path)
        return file

    def add(self, upload: RobotUpload) -> bool:
        """Keep a new robot; when this returns it is on disk, and every process sees it.

        Returns:
            True if it is new, False if the very same was there already.

        Raises:
            InvalidName: The name is none.
            RobotExists: The name stands for something else.
            InvalidInput: It does not describe a robot.
        """
        _check_name(upload.name)
        if upload.name in self._catalogue:
            raise RobotExists(upload.name)
        record, files = _files(upload)
        with folders.exclusive(self._uploads):
            folder = self._uploads / upload.name
            if folder.exists():
                present = read_record(folder, "uploaded")
                if present is None or not _is_same(present.file, RobotFile.model_validate_json(bytes(record))):
                    raise RobotExists(upload.name)
                return False
            folders.create_folder(self._uploads, upload.name, {ROBOT_FILE: record, **files})
        return True

    def replace(self, upload: RobotUpload) -> None:
        """Put another robot in the place of an uploaded one: the old one or the new one is there at any moment.

        Raises:
            UnknownRobot: There is none of this name.
            ReadOnlyRobot: It belongs to the catalogue.
            InvalidInput: It does not describe a robot.
        """
        self._check_writable(upload.name)
        record, files = _files(upload)
        with folders.exclusive(self._uploads):
            folder = self._uploads / upload.name
            if signature_of(folder) is None:
                raise self._unknown(upload.name)
            folders.write_tree(folder, files)
            folders.replace_file(folder, ROBOT_FILE, record)
            folders.remove_others(folder, {ROBOT_FILE, *(path.split("/", 1)[0] for path in files)})

    def remove(self, name: str) -> None:
        """Remove an uploaded robot.

        Raises:
            UnknownRobot: There is none of this name.
            ReadOnlyRobot: It belongs to the catalogue.
        """
        self._check_writable(name)
        with folders.exclusive(self._uploads):
            if signature_of(self._uploads / name) is None:
                raise self._unknown(name)
            folders.remove_folder(self._uploads, name)
        with self._lock:
            self._loaded.pop(name, None)

    def _check_writable(self, name: str) -> None:
        if name in self._catalogue:
            raise ReadOnlyRobot(name)
        if not _NAME.fullmatch(name):
            raise self._unknown(name)

    def _signature(self, name: str) -> Signature | None:
        return _CATALOGUE_SIGNATURE if name in self._catalogue else signature_of(self._uploads / name)

    def _record(self, name: str) -> Record:
        if name in self._catalogue:
            return self._catalogue[name]
        record = read_record(self._uploads / name, "uploaded") if _NAME.fullmatch(name) else None
        if record is None:
            raise self._unknown(name)
        return record

    def _unknown(self, name: str) -> UnknownRobot:
        known = [record.name for record in self.records()]
        return UnknownRobot(name, tuple(difflib.get_close_matches(name[:64], known, n=3)))

    def _keep(self, name: str, signature: Signature, loaded: LoadedRobot) -> None:
        if name in self._catalogue:
            signature = _CATALOGUE_SIGNATURE
        with self._lock:
            self._loaded[name] = (signature, loaded)
            self._loaded.move_to_end(name)
            while len(self._loaded) > 1 and sum(_weight(kept) for _, kept in self._loaded.values()) > _MEMORY:
                self._loaded.popitem(last=False)


def _weight(loaded: LoadedRobot) -> int:
    """Estimated bytes in memory: about 37 MB of Pinocchio's work space at 100 joints."""
    return 500_000 + 37 * int(loaded.robot.model.nv) ** 3


def _check_name(name: str) -> None:
    if not _NAME.fullmatch(name):
        raise InvalidName(name)


def _files(upload: RobotUpload) -> tuple[bytes, dict[str, bytes | Path]]:
    """The `robot.json` of the robot's folder and its other files, after the robot has been built once from them.

    Names carry a version of their own, so that a replacement never touches what the present `robot.json` names.
    """
    description, _, _ = describe(upload.name, upload.format, upload.model)
    ends = upload.default_chain
    robot = Robot(description, (ends.base_frame, ends.tip_frame) if ends else None)
    version = uuid.uuid4().hex[:12]
    model = f"robot-{version}.urdf" if upload.format == "urdf" else f"dh-{version}.json"
    record = RobotFile.model_validate(
        {
            "description": upload.description,
            "format": upload.format,
            "model": model,
            "meshes": f"meshes-{version}" if upload.meshes else None,
            "urdf_folder": upload.urdf_folder,
            "default_chain": dict(zip(("base_frame", "tip_frame"), robot.default_chain, strict=True)),
            "digest": _digest(upload),
        }
    )
    meshes = {f"meshes-{version}/{path}": file for path, file in upload.meshes.items()}
    return record.model_dump_json(indent=2).encode() + b"\n", {model: upload.model, **meshes}


def _digest(upload: RobotUpload) -> str:
    """SHA-256 of the model's bytes and of each mesh's path and bytes."""
    digest = hashlib.sha256(upload.model)
    for path, file in sorted(upload.meshes.items()):
        digest.update(f"\0{path}\0".encode())
        with file.open("rb") as stream:
            digest.update(hashlib.file_digest(stream, "sha256").digest())
    return digest.hexdigest()


def _is_same(present: RobotFile, wanted: RobotFile) -> bool:
    """Whether two records tell of the same robot: the names of files apart, their digests included."""
    apart = {"model", "meshes"}
    return present.digest is not None and present.model_dump(exclude=apart) == wanted.model_dump(exclude=apart)
