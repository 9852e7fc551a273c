"""The robot of a job, kept with its request: whatever becomes of the robot meanwhile, the job goes on with this one."""

from pathlib import Path

import orjson

from app.model.robot import Robot
from app.model.urdf import read_urdf

_URDF, _ABOUT = "robot.urdf", "robot.json"
_ENCODING = "utf-8", "surrogatepass"


def robot_files(name: str, robot: Robot, urdf: str) -> dict[str, bytes]:
    """A robot as files of a request.

    Args:
        name: What it is called.
        robot: The robot.
        urdf: What it was read from.
    """
    return {_URDF: urdf.encode(*_ENCODING), _ABOUT: orjson.dumps([name, *robot.default_chain])}


def robot_of(folder: Path) -> tuple[str, Robot]:
    """The name and the robot that a request was kept with.

    Raises:
        OSError: It cannot be read.
    """
    name, base_frame, tip_frame = orjson.loads((folder / _ABOUT).read_bytes())
    return name, Robot(read_urdf((folder / _URDF).read_bytes().decode(*_ENCODING)), (base_frame, tip_frame))
