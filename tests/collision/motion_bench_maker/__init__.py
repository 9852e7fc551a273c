"""Problems of MotionBenchMaker for the Panda; `README.md` says where they come from."""

import json
from dataclasses import dataclass
from functools import cache
from pathlib import Path
from typing import Any

import numpy as np

from gelenk.collision.scene import Obstacle
from gelenk.collision.shapes.covers import covered_body
from gelenk.robot.arrays import Array
from gelenk.robot.notations import rotations_from_quaternions_xyzw
from gelenk.robot.poses import transform

SETS = ("bookshelf_small", "bookshelf_tall", "bookshelf_thin", "cage")
ROOT = "panda_link0"
START = np.array([0.0, -0.785, 0.0, -2.356, 0.0, 1.571, 0.785])
FINGERS = {"panda_finger_joint1": 0.065, "panda_finger_joint2": 0.065}


@dataclass(frozen=True, slots=True, eq=False)
class Problem:
    """A goal configuration, shape (7,), [rad], and what is around the robot."""

    name: str
    goal: Array
    obstacles: tuple[Obstacle, ...]


@cache
def _stored() -> dict[str, list[dict[str, Any]]]:
    return json.loads((Path(__file__).parent / "problems.json").read_text(encoding="utf-8"))  # type: ignore[no-any-return]


def problems(name: str) -> list[Problem]:
    """Return the problems of a set."""
    return [
        Problem(f"{name} {one['number']}", np.array(one["goal"]), tuple(map(_obstacle, one["objects"])))
        for one in _stored()[name]
    ]


def _obstacle(stored: Any) -> Obstacle:
    name, kind, size, position, quaternion = stored
    T = transform(np.array(position), rotations_from_quaternions_xyzw(np.array([quaternion]))[0])
    size = size if kind == "box" else size[::-1]
    return Obstacle(name, (covered_body(name, ROOT, kind, tuple(size), T),))
