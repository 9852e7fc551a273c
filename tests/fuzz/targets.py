"""What each reader must do with any bytes: refuse them in its own words, or give something sound."""

import resource
import time
import warnings
import zipfile
from collections.abc import Callable
from io import BytesIO
from pathlib import PurePosixPath
from typing import NamedTuple

import numpy as np

from gelenk.contract.robots import NewRobot
from gelenk.dh.tables.convert import describe_dh
from gelenk.errors import KinematicsError
from gelenk.http.messages.npy import npy_response, read_npy
from gelenk.http.messages.payloads import read_json
from gelenk.http.messages.problems import InvalidPayload, status_of
from gelenk.kinematics.judge.tables import certify_table
from gelenk.kinematics.poses.forward import forward_kinematics
from gelenk.robot.description import Description
from gelenk.robot.formats.reading import as_urdf
from gelenk.robot.robot import RobotModel
from gelenk.robot.urdf import read_urdf, write_urdf
from gelenk.store.archive import UnpackedRobot, unpacked
from gelenk.store.folders import pieces
from gelenk.store.meshes import KEPT_SUFFIXES
from gelenk.store.records import describe
from tests.fuzz import seeds
from tests.fuzz.mutation import ArchiveMutator, Mutator
from tests.fuzz.seeds import Seeds

MOST_SECONDS = 2.0
"""Of processor time, for one input."""
MOST_GROWTH = 300 * 1024 * 1024
"""Bytes of memory by which the process may grow, whatever it reads."""
_MOST_UNPACKED = 1024 * 1024
"""Bytes that may come out of an archive here: the check is that of a large one, and sooner done."""
_MOST_JOINTS = 24
"""A robot with more is described, but not built: that takes too long to do it a million times."""
_LONGEST_MESSAGE = 4000


class Unsound(Exception):
    """A reader took something that makes no sense, or refused it in a way that is not its own."""


class Target(NamedTuple):
    """A reader under attack.

    Attributes:
        read: Feeds it; raises whatever goes wrong, and nothing where the input is refused or sound. Tells which.
        seeds: Inputs to start from.
        words: What a mutation may put in: what means something to the reader.
        mutator: Makes mutations.
    """

    read: Callable[[bytes], bool]
    seeds: Seeds
    words: tuple[bytes, ...]
    mutator: type[Mutator] = Mutator

    def mutations(self, seed: int) -> Mutator:
        """The mutations of a seed of chance."""
        return self.mutator(self.seeds, self.words, seed)

    def warm(self) -> None:
        """Have whatever is made for the first input made before time is taken."""
        self.read(self.seeds.good[0])

    def judge(self, data: bytes) -> bool:
        """Whether an input is taken.

        Raises:
            Exception: What it takes is unsound, too much time or memory went by, or whatever the reader lets out.
        """
        started, most = time.process_time(), _most_memory()
        try:
            taken = self.read(data)
        except (KinematicsError, InvalidPayload) as error:
            if isinstance(error, KinematicsError) and status_of(type(error)) >= 500:
                raise
            if not 0 < len(str(error)) < _LONGEST_MESSAGE:
                raise Unsound(f"a message of {len(str(error))} characters") from error
            taken = False
        seconds, growth = time.process_time() - started, _most_memory() - most
        if seconds > MOST_SECONDS or growth > MOST_GROWTH:
            raise Unsound(f"it took {seconds:.1f} s and {growth} bytes")
        return taken


def _most_memory() -> int:
    """Bytes that the process has held at most so far."""
    return resource.getrusage(resource.RUSAGE_SELF).ru_maxrss * 1024


def read_description(data: bytes) -> bool:
    """A URDF, which reads back as it was written, and moves as Pinocchio says."""
    _check_robot(describe("fuzzed", "urdf", data)[0])
    return True


def read_table(data: bytes) -> bool:
    """A body with a DH table, whose robot reads back as it was written, and moves as the table's own product says."""
    new = read_json(NewRobot, data)
    if new.dh is None:
        return False
    table = new.dh.table()
    robot = _check_robot(read_urdf(write_urdf(describe_dh(new.name, table))))
    if robot is not None:
        certify_table(robot, robot.chain(None, None), table)
    return True


def read_array(data: bytes) -> bool:
    """An npy body, which holds what NumPy's own reader finds in it, and comes back when it is written."""
    array = read_npy(data)
    if array.dtype != np.float64 or not array.dtype.isnative or not array.flags.c_contiguous:
        raise Unsound(f"an array of {array.dtype} and {array.flags}")
    with np.errstate(invalid="ignore"), warnings.catch_warnings():  # of signalling NaN, and of Python 2
        warnings.simplefilter("ignore")
        judge = np.lib.format.read_array(BytesIO(data), allow_pickle=False).astype(np.float64)
    again = read_npy(bytes(npy_response(array, {}).body))
    for other in (judge, again):
        if other.shape != array.shape or not np.array_equal(other, array, equal_nan=True):
            raise Unsound("other numbers than NumPy's reader finds, or than were written")
    return True


def read_archive(data: bytes) -> bool:
    """A zip of a robot, whose files lie inside, hold what Python's own reader finds, and can be packed once more."""
    packed = BytesIO()
    with unpacked(BytesIO(data), _MOST_UNPACKED) as robot, zipfile.ZipFile(packed, "w") as archive:
        files = _contents(robot)
        for path, content in files.items():
            if {"", ".", ".."} & set(path.split("/")) or PurePosixPath(path).suffix.lower() not in KEPT_SUFFIXES:
                raise Unsound(f"the path {path!r}")
            archive.writestr(path, content)
        read = as_urdf(robot.model, robot.path, robot.sources)
        archive.writestr("robot.urdf", read.urdf)
    if sum(map(len, files.values())) > _MOST_UNPACKED:
        raise Unsound("more bytes than are allowed")
    with zipfile.ZipFile(BytesIO(data)) as judge:
        if any(judge.read(path) != content for path, content in files.items()):
            raise Unsound("other bytes than Python's reader finds")
    with unpacked(packed, _MOST_UNPACKED) as again:
        if again.model != read.urdf or _contents(again) != files:
            raise Unsound("other bytes than were packed")
    describe("fuzzed", "urdf", read.urdf)
    return True


def _contents(robot: UnpackedRobot) -> dict[str, bytes]:
    return {path: b"".join(pieces(stretch)) for path, stretch in robot.meshes.items()}


def _check_robot(description: Description) -> RobotModel | None:
    """A robot reads back as it was written; its poses are poses, and Pinocchio's: otherwise they are withheld."""
    again = read_urdf(write_urdf(description))
    if (again.links, again.joints) != (description.links, description.joints):
        raise Unsound("the description does not read back as it was written")
    if len(description.movable) > _MOST_JOINTS or len(description.joints) > 2 * _MOST_JOINTS:
        return None
    robot = RobotModel(again)
    chain = robot.chain(None, None)
    poses = forward_kinematics(robot, chain, np.array([np.zeros(len(chain)), np.full(len(chain), 0.7)])).poses
    if not (np.isfinite(poses.positions).all() and np.isfinite(poses.rotations).all()):
        raise Unsound("a pose that is not finite")
    if not np.abs(poses.rotations @ poses.rotations.transpose(0, 2, 1) - np.eye(3)).max(initial=0.0) < 1e-9:
        raise Unsound("a rotation that is none")
    return robot


TARGETS: dict[str, Target] = {
    "urdf": Target(read_description, seeds.descriptions(), seeds.URDF_WORDS),
    "dh": Target(read_table, seeds.tables(), seeds.DH_WORDS),
    "npy": Target(read_array, seeds.arrays(), seeds.NPY_WORDS),
    "zip": Target(read_archive, seeds.archives(), seeds.ZIP_WORDS, ArchiveMutator),
}
