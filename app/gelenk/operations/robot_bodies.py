"""The bodies of a stored robot: found once, in a process that can be killed, and then read from disk."""

import base64
import gzip
import hashlib
import math
from collections.abc import Mapping
from contextlib import suppress
from dataclasses import replace
from functools import cache
from pathlib import Path
from typing import Any
from weakref import WeakKeyDictionary

import numpy as np
import orjson

from gelenk import collision
from gelenk.collision.bodies import Body
from gelenk.collision.contact.always import without_lasting_contacts
from gelenk.collision.link_pairs import disabled_pairs
from gelenk.collision.pairs import LinkPair, edited
from gelenk.collision.robot_bodies import RobotBodies, find_bodies
from gelenk.collision.shapes.meshes import MAX_BYTES
from gelenk.errors import InvalidUrdf
from gelenk.robot.arrays import Array
from gelenk.robot.robot import RobotModel
from gelenk.store import derived, folders
from gelenk.store.records import LoadedRobot, mesh_file, stamp_of

_KEPT = 500
"""Number of robots whose bodies stay on disk, the last found ones."""
_known: WeakKeyDictionary[RobotModel, RobotBodies] = WeakKeyDictionary()


def bodies_of(loaded: LoadedRobot) -> RobotBodies:
    """Return the bodies of a robot, and its pairs of links as found or as a person chose them.

    The first time this may take seconds, unless they are on disk. Raises InvalidMesh for a mesh that cannot be read.
    """
    known = _known.get(loaded.robot)
    if known is None:
        found = stored_or_found(loaded)
        choices = ((pair.a, pair.b, pair.active) for pair in loaded.record.file.collision_pairs)
        known = _known[loaded.robot] = replace(found, pairs=edited(found.pairs, choices))
    return known


def stored_or_found(loaded: LoadedRobot) -> RobotBodies:
    """Return the bodies of a robot and its pairs as found: from disk, or put there for the next time."""
    file = None if loaded.derived is None else loaded.derived / f"{_digest(loaded)}.json"
    if file is not None:
        with suppress(OSError, ValueError, TypeError, KeyError):
            return read_bodies(orjson.loads(folders.read_plain(file)))
    found = _found(loaded)
    if file is not None:
        derived.keep(file, orjson.dumps(found, default=array_text), "*.json", _KEPT)
    return found


def _found(loaded: LoadedRobot) -> RobotBodies:
    description, srdf = loaded.robot.description, loaded.record.srdf_path
    disabled: list[tuple[str, str]] = []
    with suppress(InvalidUrdf, FileNotFoundError):  # The robot's warnings tell of a broken one.
        disabled = [] if srdf is None else disabled_pairs(folders.read_plain(srdf))
    found = find_bodies(description, lambda mesh: _content(loaded, mesh), disabled, loaded.table is None)
    return without_lasting_contacts(description, found)


def _content(loaded: LoadedRobot, mesh: str) -> bytes | None:
    """Return a mesh's bytes, at most one more than are allowed; None if the file is missing."""
    file = _mesh_file(loaded, mesh)
    if file is None:
        return None
    with gzip.open(file) if file.suffix == ".gz" else file.open("rb") as content:
        return content.read(MAX_BYTES + 1)


def _mesh_file(loaded: LoadedRobot, mesh: str) -> Path | None:
    path = loaded.meshes.get(mesh)
    return None if path is None else mesh_file(loaded, path)


def _digest(loaded: LoadedRobot) -> str:
    """Return what changes with the description, its SRDF, its meshes, and the code that makes bodies of them."""
    files = [_mesh_file(loaded, mesh) for mesh in loaded.meshes]
    stamps = [stamp_of(file) for file in [*files, loaded.record.srdf_path] if file]
    return hashlib.sha256(repr((_code(), loaded.urdf, loaded.table is None, stamps)).encode()).hexdigest()


@cache
def _code() -> str:
    return derived.code_digest(Path(next(iter(collision.__path__))).rglob("*.py"))


def array_text(array: Array) -> str:
    """Return the bytes of an array's doubles as text, which is read at once; numbers would be parsed one by one."""
    return base64.b64encode(array.astype("<f8").tobytes()).decode()


def _array(text: str) -> Array:
    return np.frombuffer(base64.b64decode(text, validate=True), dtype="<f8").copy()


def read_bodies(stored: Mapping[str, Any]) -> RobotBodies:
    """Return bodies that were stored as JSON; raises ValueError, TypeError or KeyError if they are damaged."""
    bodies = tuple(map(read_body, stored["bodies"]))
    return RobotBodies(bodies, tuple(LinkPair(**pair) for pair in stored["pairs"]), tuple(stored["warnings"]))


def read_body(stored: Mapping[str, Any]) -> Body:
    """Return a body that was stored as JSON; raises as `read_bodies` does."""
    arrays = {"points": (-1, 3), "T_link_body": (4, 4), "spheres": (-1, 4)}
    read = {name: _array(stored[name]).reshape(shape) for name, shape in arrays.items()}
    unknown = {name: math.nan for name in ("excess", "cover_excess", "protrusion") if stored[name] is None}
    return Body(**{**stored, **read, **unknown, "size": tuple(stored["size"])})
