"""Reads a robot's folder: its record, its files, and the robot that they describe.

A folder holds one URDF or one `dh.json`, and a `robot.json` about it. A folder added by hand may lack the `robot.json`:
then its only `*.urdf` or its `dh.json` is the robot.
"""

import importlib.metadata
import os
import stat
from contextlib import suppress
from dataclasses import dataclass
from itertools import islice
from pathlib import Path, PurePosixPath
from typing import Literal, TypeAlias

from pydantic import ValidationError

from gelenk.contract.dh import DhTablePayload
from gelenk.contract.robot_file import PackagedFile, RobotFile
from gelenk.dh.tables.convert import describe_dh
from gelenk.dh.tables.housings import can_be_housed, housed_bodies
from gelenk.errors import InvalidRobotFolder, InvalidUrdf, KinematicsError, TooLarge, counted, quoted
from gelenk.robot.description import Description
from gelenk.robot.dh import DhTable
from gelenk.robot.robot import RobotModel
from gelenk.robot.urdf import read_urdf, write_urdf
from gelenk.robot.xml import MAX_BYTES
from gelenk.store.folders import read_plain
from gelenk.store.meshes import KEPT_SUFFIXES, MeshFiles, ends, flat, mesh_warnings

Source: TypeAlias = Literal["catalogue", "uploaded"]
Stamp: TypeAlias = tuple[int, int, int]
Signature: TypeAlias = tuple[Stamp | None, Stamp | None]

ROBOT_FILE = "robot.json"
BUILT_KINDS = frozenset({"collaborative arm", "industrial arm"})
"""Kinds of robots that are drawn as built arms if they are tables; the studio has the same in `view/figure.ts`."""


@dataclass(frozen=True, slots=True)
class Record:
    """A robot's folder as its `robot.json` describes it.

    Attributes:
        name: Name of the robot, and of the folder.
        source: Which of the two roots contains the folder.
        file, file_path: Contents and path of `robot.json`, even if that is missing.
        model_path: Path of the URDF or DH file.
        mesh_root: Folder to search for mesh files, if any.
        signature: Stamps of both files when they were read.
    """

    name: str
    source: Source
    file: RobotFile
    file_path: Path
    model_path: Path
    mesh_root: Path | None
    signature: Signature

    @property
    def srdf_path(self) -> Path | None:
        """Path of the SRDF; None without one."""
        if isinstance(self.file.srdf, PackagedFile):
            return package_data() / self.file.srdf.path
        return None if self.file.srdf is None else self.file_path.parent / self.file.srdf

    def is_current(self) -> bool:
        """Return whether both files are unchanged; two `stat` calls, fast enough for an event loop."""
        return self.signature == (stamp_of(self.file_path), stamp_of(self.model_path))


@dataclass(frozen=True, slots=True)
class LoadedRobot:
    """A record with the robot that it describes.

    Attributes:
        urdf: The description as URDF text: as uploaded, or as written from the DH table.
        table: The DH table; None for a URDF.
        found: Files below `mesh_root` that each mesh name of the description may refer to.
        derived: Folder for what is computed once of a robot; None without one.
    """

    record: Record
    robot: RobotModel
    urdf: str
    table: DhTable | None
    found: dict[str, list[str]]
    derived: Path | None = None

    @property
    def meshes(self) -> dict[str, str | None]:
        """File of each mesh of the description, below `mesh_root`; None if it is missing or ambiguous."""
        return {mesh: paths[0] if len(paths) == 1 else None for mesh, paths in self.found.items()}

    @property
    def warnings(self) -> tuple[str, ...]:
        """Oddities of the description, missing meshes, and the number of an archive's files that were not stored."""
        left_out = self.record.file.left_out
        unused = (
            f"{counted(left_out, 'file')} of the archive, meshes or pictures that nothing refers to, were not stored"
        )
        found = (*mesh_warnings(self.found), *self.record.file.findings)
        return (*self.robot.description.warnings, *found, *([unused] if left_out else ()))


def read_record(folder: Path, source: Source) -> Record | None:
    """Read a folder's record; return None if the folder is missing or holds nothing that could be a robot.

    Raises InvalidRobotFolder if it leads out of the folder or cannot be read, and FileNotFoundError if the model file
    is missing; also while the folder is being replaced.
    """
    try:
        return _read_record(folder, source)
    except FileNotFoundError:
        raise
    except (OSError, ValueError) as error:  # ValueError: a path with a NUL
        reason = error.strerror if isinstance(error, OSError) else str(error)
        raise InvalidRobotFolder(f"it cannot be read: {reason}", folder.name) from error


def uploaded_record(folder: Path) -> Record | None:
    """Return the record of an uploaded robot; None if it is missing or cannot be read."""
    with suppress(KinematicsError, OSError):
        return read_record(folder, "uploaded")
    return None


def _read_record(folder: Path, source: Source) -> Record | None:
    path = folder / ROBOT_FILE
    stamp = stamp_of(path)
    file = _robot_file(path) if stamp else _without_robot_file(folder)
    if file is None:
        return None
    if PackagedFile in {type(file.model), type(file.srdf)} and source != "catalogue":
        raise InvalidRobotFolder("only robots of the catalogue may refer to packages", f"{folder.name}/{ROBOT_FILE}")
    if isinstance(file.model, PackagedFile):
        root = package_data()
        model = root / file.model.path
        return Record(folder.name, source, file, path, model, root.parent, (stamp, stamp_of(model)))
    inside = folder.resolve()
    for name in (file.model, file.meshes, file.srdf):
        if isinstance(name, str) and not (folder / name).resolve().is_relative_to(inside):
            raise InvalidRobotFolder(f"the path {quoted(name)} leads out of the folder", f"{folder.name}/{ROBOT_FILE}")
    model = folder / file.model
    if (model_stamp := stamp_of(model)) is None:
        raise FileNotFoundError(file.model)
    meshes = folder / file.meshes if file.meshes else None
    return Record(folder.name, source, file, path, model, meshes, (stamp, model_stamp))


def load(record: Record) -> LoadedRobot:
    """Load the robot that a record describes; raises FileNotFoundError if it has been replaced in the meantime."""
    size = record.model_path.stat().st_size
    if size > MAX_BYTES:
        raise TooLarge(f"bytes of {record.model_path.name}", size, MAX_BYTES)
    content = read_plain(record.model_path)
    description, urdf, table = describe(record.name, record.file.format, content, about=record.file)
    ends = record.file.default_chain
    robot = RobotModel(description, (ends.base_frame, ends.tip_frame) if ends else None)
    return LoadedRobot(record, robot, urdf, table, _found_meshes(record, description.meshes))


def describe(
    name: str, format_: str, content: bytes, strict: bool = False, about: RobotFile | None = None
) -> tuple[Description, str, DhTable | None]:
    """Return the description in a model file, the same as URDF text, and the DH table if the file holds one.

    A table is written as URDF and read like any other, so all robots use one code path; see `read_urdf` for `strict`.
    If `about` says that the table is one of an arm that is built, its bodies are housings.
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
        raise InvalidRobotFolder(f"not a DH table: {_first_fault(error)}", "dh.json") from error
    is_built = about is not None and about.kind in BUILT_KINDS and can_be_housed(table)
    described = describe_dh(name, table, housed_bodies(table, about.payload) if about and is_built else None)
    text = write_urdf(described)
    read = read_urdf(text)
    return Description(read.name, read.links, read.joints, described.warnings), text, table


def mesh_file(loaded: LoadedRobot, path: str) -> Path | None:
    """Return the robot's file at a path below its meshes: as listed, or `name/folder/file` of a `package://` name.

    The file is compressed if its name ends in `.gz` and the path does not.
    """
    root = loaded.record.mesh_root
    if root is None:
        return None
    candidates = [*loaded.found.get(f"package://{path}", ()), *ends(path)]
    return next(filter(None, (_file_below(root, candidate) for candidate in candidates)), None)


def package_data() -> Path:
    """Return the folder of robots in the installed package example-robot-data."""
    distribution = importlib.metadata.distribution("example-robot-data")
    return Path(str(distribution.locate_file("cmeel.prefix/share/example-robot-data")))


def stamp_of(path: Path | str) -> Stamp | None:
    """Return values that change with a file: time [ns], inode and size [bytes]; None if it is not a regular file."""
    try:
        status = os.stat(path)  # noqa: PTH116 - on the path of every call
    except (FileNotFoundError, NotADirectoryError):
        return None
    if not stat.S_ISREG(status.st_mode):
        return None
    return status.st_mtime_ns, status.st_ino, status.st_size


def _robot_file(path: Path) -> RobotFile:
    try:
        return RobotFile.model_validate_json(read_plain(path))
    except ValidationError as error:
        raise InvalidRobotFolder(_first_fault(error), f"{path.parent.name}/{ROBOT_FILE}") from error


def _first_fault(error: ValidationError) -> str:
    first = error.errors(include_url=False)[0]
    return f"{'.'.join(map(str, first['loc']))}: {first['msg']}"


def _without_robot_file(folder: Path) -> RobotFile | None:
    """Infer the contents of `robot.json` from a folder's URDF or `dh.json`; None unless it holds exactly one."""
    models = [path for path in (*folder.glob("*.urdf"), *folder.glob("dh.json")) if path.is_file()]
    if len(models) != 1:
        return None
    return RobotFile(format="dh" if models[0].suffix == ".json" else "urdf", model=models[0].name, meshes=".")


def _found_meshes(record: Record, references: tuple[str, ...]) -> dict[str, list[str]]:
    root, urdf_folder = record.mesh_root, record.file.urdf_folder
    if root is None:
        return {reference: [] for reference in references}
    if record.source == "uploaded":
        files = MeshFiles(_files_below(root), urdf_folder)
        return {mesh: [path for path in files.find(mesh) if _file_below(root, path)] for mesh in references}
    # A package holds the meshes of many robots at the paths that their names give, so only these are checked.
    found = {}
    for mesh in references:
        _, is_address, name = mesh.partition("://")
        candidates = ends(name) if is_address else [os.path.normpath(PurePosixPath(urdf_folder) / mesh)]
        found[mesh] = list(islice((path for path in candidates if _file_below(root, path)), 1))
    return found


def _files_below(root: Path) -> list[str]:
    """Return the archive paths of all meshes, materials and images below a folder, compressed or not."""
    names = (os.path.relpath(os.path.join(folder, name), root) for folder, _, names in os.walk(root) for name in names)  # noqa: PTH118
    found = {name.removesuffix(".gz") for name in names}
    return [path.replace(":", "/") for path in found if PurePosixPath(path).suffix.lower() in KEPT_SUFFIXES]


def _file_below(root: Path, path: str) -> Path | None:
    """Return the mesh, material or image at a path below a folder; None if it is missing or outside the folder."""
    if PurePosixPath(path).suffix.lower() not in KEPT_SUFFIXES:
        return None
    try:
        candidates = root / path, root / flat(path), root / f"{path}.gz"
        file = next(filter(Path.is_file, candidates), root).resolve()
        return file if file.is_relative_to(root.resolve()) and file.is_file() else None
    except (OSError, ValueError):  # not a valid file name
        return None
