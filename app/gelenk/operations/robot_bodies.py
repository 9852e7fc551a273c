"""The bodies of a stored robot: found once, in a process that can be killed, because they are read from its meshes."""

import gzip
from typing import Any
from weakref import WeakKeyDictionary

from gelenk.collision.meshes import MAX_BYTES
from gelenk.collision.robot_bodies import RobotBodies, find_bodies
from gelenk.operations.warm_up import WarmUp
from gelenk.robot.robot import RobotModel
from gelenk.store.records import LoadedRobot, mesh_file

_KNOWN: WeakKeyDictionary[RobotModel, RobotBodies] = WeakKeyDictionary()


def bodies_of(loaded: LoadedRobot) -> RobotBodies:
    """Return the bodies of a robot and its pairs of links; raises InvalidMesh for a mesh that cannot be read."""
    known = _KNOWN.get(loaded.robot)
    if known is None:
        known = _KNOWN[loaded.robot] = _found(loaded)
    return known


def _found(loaded: LoadedRobot) -> RobotBodies:
    return find_bodies(loaded.robot.description, lambda mesh: _content(loaded, mesh), has_own=loaded.table is None)


def _content(loaded: LoadedRobot, mesh: str) -> bytes | None:
    """Return a mesh's bytes, at most one more than are allowed; None if the file is missing."""
    path = loaded.meshes.get(mesh)
    file = None if path is None else mesh_file(loaded, path)
    if file is None:
        return None
    with gzip.open(file) if file.suffix == ".gz" else file.open("rb") as content:
        return content.read(MAX_BYTES + 1)


def _keep(loaded: LoadedRobot, _: object, bodies: RobotBodies) -> None:
    _KNOWN[loaded.robot] = bodies


WARM_UP: WarmUp[Any] = WarmUp(
    is_known=lambda loaded, _: loaded.robot in _KNOWN, find=lambda loaded, _: bodies_of(loaded), keep=_keep
)
"""For operations that need the bodies."""
