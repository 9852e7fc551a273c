"""The robot of a job, stored with its request, so that later changes to the robot do not affect the job."""

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
    """A robot in the form that is sent to other processes; `ends` are the base and tip frames of its default chain."""

    name: str
    urdf: bytes
    ends: tuple[str, str]


def robot_files(name: str, robot: RobotModel, urdf: str) -> dict[str, bytes]:
    """Return the files, by name, that store a robot in a request."""
    return {_URDF: urdf.encode(*_ENCODING), _ABOUT: orjson.dumps([name, *robot.default_chain])}


def robot_digest(request: Mapping[str, bytes]) -> str | None:
    """Return the SHA-256 of the URDF in a request, to distinguish robots of the same name; None without a robot."""
    return hashlib.sha256(request[_URDF]).hexdigest() if _URDF in request else None


def robot_text(folder: Path) -> RobotText:
    """Return the robot stored in the folder of a request."""
    name, base_frame, tip_frame = orjson.loads(read_plain(folder / _ABOUT))
    return RobotText(name, read_plain(folder / _URDF), (base_frame, tip_frame))


@lru_cache(maxsize=2)
def robot_of(text: RobotText) -> RobotModel:
    """Build the robot; a process builds it once for all its parts of a job."""
    return RobotModel(read_urdf(text.urdf.decode(*_ENCODING)), text.ends)
