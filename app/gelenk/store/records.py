"""Reads a robot's folder: its record, its files, and the robot that they describe.

A folder holds one URDF or one `dh.json`, and a `robot.json` about it. A folder dropped in by hand may do without
the `robot.json`: then its one `*.urdf` or its `dh.json` is the robot.
"""

import importlib.metadata
import os
import stat
from dataclasses import dataclass
from itertools import islice
from pathlib import Path, PurePosixPath
from typing import Literal, TypeAlias

from pydantic import ValidationError

from gelenk.contract.dh import DhTablePayload
from gelenk.contract.robots import RobotFile
from gelenk.model.convert import describe_dh
from gelenk.model.description import Description
from gelenk.model.dh import DhTable
from gelenk.model.errors import InvalidRobotFolder, InvalidUrdf, TooLarge, counted, quoted
from gelenk.model.robot import Robot
from gelenk.model.urdf import read_urdf, write_urdf
from gelenk.model.xml import MAX_BYTES
from gelenk.store.folders import read_plain
from gelenk.store.meshes import KEPT_SUFFIXES, MeshFiles, ends, flat, mesh_warnings

Source: TypeAlias = Literal["catalogue", "uploaded"]
Stamp: TypeAlias = tuple[int, int, int]
Signature: TypeAlias = tuple[Stamp | None, Stamp | None]

ROBOT_FILE = "robot.json"


@dataclass(frozen=True, slots=True)
class Record:
    """A folder as its `robot.json` tells of it.

    Attributes:
        name: The robot's name: the folder's.
        source: Which of the two roots the folder is in.
        file: The contents of `robot.json`.
        file_path: Where that is, or would be.
        model_path: The URDF or DH file.
        mesh_root: Where mesh files are looked up, if anywhere.
        signature: Of both files, when they were read.
    """

    name: str
    source: Source
    file: RobotFile
    file_path: Path
    model_path: Path
    mesh_root: Path | None
    signature: Signature

    def is_current(self) -> bool:
        """Whether neither file has changed since; two `stat` calls, quick enough for an event loop."""
        return self.signature == _signature(self.file_path, self.model_path)


@dataclass(frozen=True, slots=True)
class LoadedRobot:
    """A record with the robot that it describes.

    Attributes:
        record: Where it came from.
        robot: Ready for computation.
        urdf: The description as text: as uploaded, or as written from the DH table.
        table: The DH table, where the robot is one.
        found: Of each mesh that the description names the files below `mesh_root` that it may mean.
    """

    record: Record
    robot: Robot
    urdf: str
    table: DhTable | None
    found: dict[str, list[str]]

    @property
    def meshes(self) -> dict[str, str | None]:
        """The mesh file of each mesh that the description names, below `mesh_root`; None where it is not clear."""
        return {mesh: paths[0] if len(paths) == 1 else None for mesh, paths in self.found.items()}

    @property
    def warnings(self) -> tuple[str, ...]:
        """What is odd about the description, which meshes are missing, and what was not kept of an archive."""
        left_out = self.record.file.left_out
        unused = (
            f"{counted(left_out, 'file')} of the archive, meshes or pictures that nothing refers to, were not stored"
        )
        return (*self.robot.description.warnings, *mesh_warnings(self.found), *([unused] if left_out else ()))


def read_record(folder: Path, source: Source) -> Record | None:
    """Read a folder's record; None where there is no such folder, or nothing in it that could be a robot.

    Raises:
        InvalidRobotFolder: Its `robot.json` is not one, leads out of the folder, or nothing here can be read.
        FileNotFoundError: The model file is missing; also while the folder is being replaced.
    """
    try:
        return _read_record(folder, source)
    except FileNotFoundError:
        raise
    except (OSError, ValueError) as error:  # ValueError: a path with a NUL
        reason = error.strerror if isinstance(error, OSError) else str(error)
        raise InvalidRobotFolder(f"it cannot be read: {reason}", folder.name) from error


def _read_record(folder: Path, source: Source) -> Record | None:
    path = folder / ROBOT_FILE
    stamp = stamp_of(path)
    file = _robot_file(path) if stamp else _without_robot_file(folder)
    if file is None:
        return None
    if not isinstance(file.model, str):
        if source != "catalogue":
            raise InvalidRobotFolder(
                "only robots of the catalogue may refer to packages", f"{folder.name}/{ROBOT_FILE}"
            )
        root = package_data()
        model = root / file.model.path
        return Record(folder.name, source, file, path, model, root.parent, (stamp, stamp_of(model)))
    inside = folder.resolve()
    for name in filter(None, (file.model, file.meshes)):
        if not (folder / name).resolve().is_relative_to(inside):
            raise InvalidRobotFolder(f"the path {quoted(name)} leads out of the folder", f"{folder.name}/{ROBOT_FILE}")
    model = folder / file.model
    meshes = folder / file.meshes if file.meshes else None
    signature = (stamp, stamp_of(model))
    if signature[1] is None:
        raise FileNotFoundError(file.model)
    return Record(folder.name, source, file, path, model, meshes, signature)


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
    description, urdf, table = describe(record.name, record.file.format, read_plain(record.model_path))
    ends = record.file.default_chain
    robot = Robot(description, (ends.base_frame, ends.tip_frame) if ends else None)
    return LoadedRobot(record, robot, urdf, table, _found_meshes(record, description.meshes))


def describe(name: str, format_: str, content: bytes, strict: bool = False) -> tuple[Description, str, DhTable | None]:
    """The description that a model file holds, as text too, and the table where it is one.

    A table is written as URDF and read like any other: one path for all robots. `strict` is that of `read_urdf`.

    Raises:
        InvalidInput: The file does not describe a robot.
    """
    if format_ == "urdf":
        try:
            text = content.decode("utf-8")
        except UnicodeDecodeError as error:
            line = content.count(b"\n", 0, error.start) + 1
            raise InvalidUrdf("the text is not UTF-8", None, line) from error
        return read_urdf(text, strict), text, None
    try:
        table = DhTablePayload.model_validate_json(content).table()
    except ValidationError as error:
        first = error.errors(include_url=False)[0]
        where = ".".join(str(part) for part in first["loc"])
        raise InvalidRobotFolder(f"not a DH table: {where}: {first['msg']}", "dh.json") from error
    described = describe_dh(name, table)
    text = write_urdf(described)
    read = read_urdf(text)
    return Description(read.name, read.links, read.joints, described.warnings), text, table


def mesh_file(loaded: LoadedRobot, path: str) -> Path | None:
    """The file of the robot at a path below its meshes: that of the list, or `name/folder/file` of a `package://`.

    It is compressed where its name ends in `.gz` and the path does not.
    """
    root = loaded.record.mesh_root
    if root is None:
        return None
    candidates = [*loaded.found.get(f"package://{path}", ()), *ends(path)]
    return next(filter(None, (_file_below(root, candidate) for candidate in candidates)), None)


def package_data() -> Path:
    """The robots of example-robot-data, where the package is installed."""
    distribution = importlib.metadata.distribution("example-robot-data")
    return Path(str(distribution.locate_file("cmeel.prefix/share/example-robot-data")))


def stamp_of(path: Path | str) -> Stamp | None:
    """What changes with a file; None where there is no such file, or something that is none."""
    try:
        status = os.stat(path)  # noqa: PTH116 - on the path of every call
    except (FileNotFoundError, NotADirectoryError):
        return None
    if not stat.S_ISREG(status.st_mode):
        return None
    return status.st_mtime_ns, status.st_ino, status.st_size


def _signature(file_path: Path, model_path: Path) -> Signature:
    return stamp_of(file_path), stamp_of(model_path)


def _robot_file(path: Path) -> RobotFile:
    try:
        return RobotFile.model_validate_json(read_plain(path))
    except ValidationError as error:
        first = error.errors(include_url=False)[0]
        where = ".".join(str(part) for part in first["loc"])
        raise InvalidRobotFolder(f"{where}: {first['msg']}", f"{path.parent.name}/{ROBOT_FILE}") from error


def _without_robot_file(folder: Path) -> RobotFile | None:
    """What a folder tells of itself by its one URDF or its `dh.json`."""
    models = [path for path in (*folder.glob("*.urdf"), *folder.glob("dh.json")) if path.is_file()]
    if len(models) != 1:
        return None
    return RobotFile(format="dh" if models[0].suffix == ".json" else "urdf", model=models[0].name, meshes=".")


def _found_meshes(record: Record, references: tuple[str, ...]) -> dict[str, list[str]]:
    """The files below the mesh root that each of the meshes may mean."""
    root, urdf_folder = record.mesh_root, record.file.urdf_folder
    if root is None:
        return {reference: [] for reference in references}
    if record.source == "uploaded":
        files = MeshFiles(_files_below(root), urdf_folder)
        return {mesh: [path for path in files.find(mesh) if _file_below(root, path)] for mesh in references}
    # A package holds the meshes of many robots, all where their names say: only these are looked for.
    found = {}
    for mesh in references:
        _, is_address, name = mesh.partition("://")
        candidates = ends(name) if is_address else [os.path.normpath(PurePosixPath(urdf_folder) / mesh)]
        found[mesh] = list(islice((path for path in candidates if _file_below(root, path)), 1))
    return found


def _files_below(root: Path) -> list[str]:
    """The paths of all meshes, materials and pictures below a folder, compressed or not, as an archive has them."""
    names = (os.path.relpath(os.path.join(folder, name), root) for folder, _, names in os.walk(root) for name in names)  # noqa: PTH118
    found = {name.removesuffix(".gz") for name in names}
    return [path.replace(":", "/") for path in found if PurePosixPath(path).suffix.lower() in KEPT_SUFFIXES]


def _file_below(root: Path, path: str) -> Path | None:
    """The mesh, material or picture at a path that stays below a folder, if there is one."""
    if PurePosixPath(path).suffix.lower() not in KEPT_SUFFIXES:
        return None
    try:
        candidates = root / path, root / flat(path), root / f"{path}.gz"
        file = next(filter(Path.is_file, candidates), root).resolve()
        return file if file.is_relative_to(root.resolve()) and file.is_file() else None
    except (OSError, ValueError):  # a name that no file system takes
        return None
