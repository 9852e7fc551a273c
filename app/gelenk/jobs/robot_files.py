"""The robot of a job, kept with its request: whatever becomes of the robot meanwhile, the job goes on with this one."""

import hashlib
from collections.abc import Mapping
from functools import lru_cache
from pathlib import Path
from typing import NamedTuple

import orjson

from gelenk.robot.robot import RobotModel
from gelenk.robot.urdf import read_urdf
from gelenk.store.folders import read_plain

_URDF, _ABOUT = "robot.urdf", "robot.json"
_ENCODING = "utf-8", "surrogatepass"


class RobotText(NamedTuple):
    """A robot as it travels to other processes.

    Attributes:
        name: What it is called.
        urdf: What it is read from.
        ends: Base and tip of its default chain.
    """

    name: str
    urdf: bytes
    ends: tuple[str, str]


def robot_files(name: str, robot: RobotModel, urdf: str) -> dict[str, bytes]:
    """A robot as files of a request.

    Args:
        name: What it is called.
        robot: The robot.
        urdf: What it was read from.
    """
    return {_URDF: urdf.encode(*_ENCODING), _ABOUT: orjson.dumps([name, *robot.default_chain])}


def robot_digest(request: Mapping[str, bytes]) -> str | None:
    """What tells the robot of a request from others that have had its name: SHA-256 of its URDF."""
    return hashlib.sha256(request[_URDF]).hexdigest() if _URDF in request else None


def robot_text(folder: Path) -> RobotText:
    """The robot that a request was kept with.

    Raises:
        OSError: It cannot be read.
    """
    name, base_frame, tip_frame = orjson.loads(read_plain(folder / _ABOUT))
    return RobotText(name, read_plain(folder / _URDF), (base_frame, tip_frame))


@lru_cache(maxsize=2)
def robot_of(text: RobotText) -> RobotModel:
    """The robot, ready for computation; built once for all parts of a job that a process computes."""
    return RobotModel(read_urdf(text.urdf.decode(*_ENCODING)), text.ends)
