"""A robot beside the store, of a file of one's own or of none: where its meshes are."""

import os
from pathlib import Path

from gelenk.contract.robot_file import RobotFile
from gelenk.robot.dh import DhTable
from gelenk.robot.robot import RobotModel
from gelenk.store.records import LoadedRobot, Record


def local_robot(robot: RobotModel, file: Path | None = None, table: DhTable | None = None) -> LoadedRobot:
    """Return a robot with what the store knows of its own ones.

    Args:
        robot: The robot.
        file: URDF that describes it. Names of meshes count from its folder, as `file://` from the root of all, as
            `package://` from the nearest folder around it of the package's name. Without one it has no meshes.
        table: The DH table that describes it, if one does.
    """
    name, meshes = robot.description.name, robot.description.meshes
    kind = RobotFile(format="urdf" if table is None else "dh", model=name)
    here = Path() if file is None else file.resolve()
    root = None if file is None else Path(here.anchor)
    record = Record(name, "uploaded", kind, here, here, root, (None, None))
    found = {mesh: [] if root is None else [str(_place(here.parent, mesh).relative_to(root))] for mesh in meshes}
    return LoadedRobot(record, robot, "", table, found)


def _place(folder: Path, mesh: str) -> Path:
    """Return where a mesh would be that a description in a folder names, whether it is there or not."""
    scheme, is_address, rest = mesh.partition("://")
    if not is_address:
        return Path(os.path.normpath(folder / mesh))
    if scheme == "file":
        return Path(os.path.normpath(Path(folder.anchor) / rest))
    package, _, path = rest.partition("/")
    around = next((one for one in (folder, *folder.parents) if one.name == package), folder)
    return Path(os.path.normpath(around / path))
