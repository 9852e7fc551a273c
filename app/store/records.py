"""A robot's folder, read: what it is, where its files are, and the robot that they describe.

A folder holds one URDF or one `dh.json`, and a `robot.json` about it. A folder dropped in by hand may do without
the `robot.json`: then its one `*.urdf` or its `dh.json` is the robot.
"""

import importlib.metadata
import os
from dataclasses import dataclass
from pathlib import Path, PurePosixPath
from typing import Literal, TypeAlias

from pydantic import ValidationError

from app.model.convert import describe_dh
from app.model.description import Description
from app.model.dh import DhTable
from app.model.errors import InvalidArchive, InvalidUrdf, TooLarge
from app.model.robot import Robot
from app.model.urdf import read_urdf, write_urdf
from app.model.xml import MAX_BYTES
from app.schemas.dh import DhTablePayload
from app.schemas.robots import RobotFile
from app.store.archive import MESH_SUFFIXES

Source: TypeAlias = Literal["catalogue", "uploaded"]
Signature: TypeAlias = tuple[int, ...]

ROBOT_FILE = "robot.json"


@dataclass(frozen=True, slots=True)
class Record:
    """A folder as its `robot.json` tells of it.

    Attributes:
        name: The robot's name: the folder's.
        source: Which of the two roots the folder is in.
        file: The contents of `robot.json`.
        model_path: The URDF or DH file.
        mesh_root: Where mesh files are looked up, if anywhere.
        signature: Changes whenever the folder's robot does.
    """

    name: str
    source: Source
    file: RobotFile
    model_path: Path
    mesh_root: Path | None
    signature: Signature


@dataclass(frozen=True, slots=True)
class LoadedRobot:
    """A record with the robot that it describes.

    Attributes:
        record: Where it came from.
        robot: Ready for computation.
        urdf: The description as text: as uploaded, or as written from the DH table.
        table: The DH table, where the robot is one.
        meshes: The mesh file of each mesh that the description names, where there is one, below `mesh_root`.
    """

    record: Record
    robot: Robot
    urdf: str
    table: DhTable | None
    meshes: dict[str, str | None]

    @property
    def warnings(self) -> tuple[str, ...]:
        """What is odd about the description, and which meshes are missing."""
        missing = [mesh for mesh, path in self.meshes.items() if path is None]
        return self.robot.description.warnings + tuple(f"mesh '{mesh}' is missing" for mesh in missing)


def signature_of(folder: Path) -> Signature | None:
    """A number tuple that changes with the folder's robot; None where there is no such folder."""
    try:
        status = os.stat(folder / ROBOT_FILE)  # noqa: PTH116 - on the path of every call
    except (FileNotFoundError, NotADirectoryError):
        try:
            model = _only_model(folder)
        except OSError:
            return None
        if model is None:
            return None
        status = model.stat()
    return status.st_mtime_ns, status.st_ino, status.st_size


def read_record(folder: Path, source: Source) -> Record | None:
    """Read a folder's record; None where there is no such folder.

    Raises:
        InvalidArchive: Its `robot.json` is not one, or names a file that is not there.
    """
    signature = signature_of(folder)
    if signature is None:
        return None
    file = _robot_file(folder)
    if not isinstance(file.model, str):
        if source != "catalogue":
            raise InvalidArchive("only the catalogue refers to packages", ROBOT_FILE)
        root = package_data()
        return Record(folder.name, source, file, root / file.model.path, root.parent, signature)
    for path in filter(None, (file.model, file.meshes)):
        if not (folder / path).resolve().is_relative_to(folder.resolve()):
            raise InvalidArchive(f"the path {path!r} leads out of the folder", ROBOT_FILE)
    return Record(
        folder.name, source, file, folder / file.model, folder / file.meshes if file.meshes else None, signature
    )


def load(record: Record) -> LoadedRobot:
    """The robot that a record describes.

    Raises:
        FileNotFoundError: The record has been replaced meanwhile.
        InvalidInput: The file does not describe a robot.
        UnknownFrame: The default chain names a frame that the robot does not have.
    """
    size = record.model_path.stat().st_size
    if size > MAX_BYTES:
        raise TooLarge(f"bytes of {record.model_path.name}", size, MAX_BYTES)
    description, urdf, table = describe(record.name, record.file.format, record.model_path.read_bytes())
    ends = record.file.default_chain
    robot = Robot(description, (ends.base_frame, ends.tip_frame) if ends else None)
    meshes = {mesh: _mesh_path(record, mesh) for mesh in description.meshes}
    return LoadedRobot(record, robot, urdf, table, meshes)


def describe(name: str, format_: str, content: bytes) -> tuple[Description, str, DhTable | None]:
    """The description that a model file holds, as text too, and the table where it is one.

    A table is written as URDF and read like any other: one path for all robots.

    Raises:
        InvalidInput: The file does not describe a robot.
    """
    if format_ == "urdf":
        try:
            text = content.decode("utf-8")
        except UnicodeDecodeError as error:
            line = content.count(b"\n", 0, error.start) + 1
            raise InvalidUrdf("the text is not UTF-8", None, line) from error
        return read_urdf(text), text, None
    try:
        table = DhTablePayload.model_validate_json(content).table()
    except ValidationError as error:
        raise InvalidArchive(f"not a DH table: {error.errors(include_url=False)[0]['msg']}", "dh.json") from error
    described = describe_dh(name, table)
    text = write_urdf(described)
    read = read_urdf(text)
    return Description(read.name, read.links, read.joints, described.warnings), text, table


def mesh_file(loaded: LoadedRobot, path: str) -> Path | None:
    """The file below the robot's mesh root, where it is one that may be served."""
    root = loaded.record.mesh_root
    if root is None or PurePosixPath(path).suffix.lower() not in MESH_SUFFIXES or "\0" in path:
        return None
    file = (root / path).resolve()
    return file if file.is_relative_to(root.resolve()) and file.is_file() else None


def package_data() -> Path:
    """The robots of example-robot-data, where the package is installed."""
    distribution = importlib.metadata.distribution("example-robot-data")
    return Path(str(distribution.locate_file("cmeel.prefix/share/example-robot-data")))


def _robot_file(folder: Path) -> RobotFile:
    try:
        return RobotFile.model_validate_json((folder / ROBOT_FILE).read_bytes())
    except ValidationError as error:
        first = error.errors(include_url=False)[0]
        where = ".".join(str(part) for part in first["loc"])
        raise InvalidArchive(f"{where}: {first['msg']}", f"{folder.name}/{ROBOT_FILE}") from error
    except FileNotFoundError:
        model = _only_model(folder)
        if model is None:
            raise
        return RobotFile(format="dh" if model.suffix == ".json" else "urdf", model=model.name, meshes=".")


def _only_model(folder: Path) -> Path | None:
    """The one URDF of a folder without a record, or its `dh.json`."""
    models = [*folder.glob("*.urdf"), *folder.glob("dh.json")]
    return models[0] if len(models) == 1 else None


def _mesh_path(record: Record, reference: str) -> str | None:
    """Where below the mesh root the file of a reference is.

    Nobody knows from which folder on a package was packed: of a `package://name/folder/file` the longest end that is
    there counts. A relative path starts at the URDF's folder.
    """
    if record.mesh_root is None:
        return None
    if reference.startswith("package://"):
        parts = reference.removeprefix("package://").split("/")
        candidates = ["/".join(parts[start:]) for start in range(len(parts))]
    else:
        relative = os.path.normpath(f"{record.file.urdf_folder}/{reference}" if record.file.urdf_folder else reference)
        candidates = [relative]
    for candidate in candidates:
        if candidate.startswith(("/", "..")) or ":" in candidate:
            continue
        file = (record.mesh_root / candidate).resolve()
        if file.is_relative_to(record.mesh_root.resolve()) and file.is_file():
            return candidate
    return None
