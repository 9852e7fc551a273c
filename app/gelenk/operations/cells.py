"""The robot of a request in the scene of that request."""

from collections.abc import Mapping
from dataclasses import dataclass
from functools import lru_cache
from typing import Any

import numpy as np
import orjson

from gelenk.collision.cell import Cell, cell_in
from gelenk.collision.contact.world import World, build_world
from gelenk.collision.robot_bodies import RobotBodies
from gelenk.collision.scene import Obstacle
from gelenk.contract.collisions import CollisionRequest
from gelenk.contract.scene import InCell
from gelenk.errors import InvalidField, listed, quoted
from gelenk.operations.robot_bodies import array_text, bodies_of, read_bodies, read_body
from gelenk.operations.scene_objects import obstacles_of
from gelenk.robot.chain import Chain
from gelenk.robot.robot import RobotModel
from gelenk.store.records import LoadedRobot

IN_BODIES = {"scene": None, "other_joints": None}
"""Fields of a request of which `CellBodies` has all that matters: a job leaves them out."""


@dataclass(frozen=True, slots=True)
class CellBodies:
    """The bodies of a robot, where its joints off the chain stand, and the objects around it; a job takes them along.

    Attributes:
        others: Positions of these joints as requested, by name, [rad or m]; the others stand at 0.
    """

    own: RobotBodies
    obstacles: tuple[Obstacle, ...]
    others: tuple[tuple[str, float], ...] = ()

    @property
    def warnings(self) -> list[str]:
        """What has no body, or a larger one than it is."""
        return [*self.own.warnings, *(one.note for one in self.obstacles if one.note)]

    def cell(self, robot: RobotModel, chain: Chain, min_clearance: float | None) -> Cell:
        """Return the cell of a chain; raises as `world` does."""
        return _cell(self.world(robot, chain), min_clearance or 0.0)

    def world(self, robot: RobotModel, chain: Chain) -> World:
        """Return the robot among the objects, the same for the same chain; raises InvalidField and TooLarge.

        `other_joints` is refused if one of them is no joint off the chain, an object as `build_world` says.
        """
        allowed = tuple(joint.name for joint in robot.description.movable if joint.name not in chain.joint_names)
        for name, _ in self.others:
            if name not in allowed:
                reason = f"{quoted(name)} is no independent joint off the chain; those are {listed(allowed)}"
                raise InvalidField("other_joints", reason)
        return _world(robot, chain, self.own, self.obstacles, self.others)

    def to_bytes(self) -> bytes:
        """Return what `read_cell_bodies` reads."""
        return orjson.dumps(self, default=lambda one: array_text(one) if isinstance(one, np.ndarray) else sorted(one))


def cell_of(loaded: LoadedRobot, chain: Chain, call: InCell) -> tuple[Cell, list[str]] | None:
    """Return the cell of a request with what its users should know of it; None if it asks for none.

    The same request gets the same cell while that is cached. Raises InvalidMesh, InvalidPose, InvalidField or TooLarge,
    as a scene is what it should not be.
    """
    found = cell_bodies(loaded, call)
    return None if found is None else (found.cell(loaded.robot, chain, call.min_clearance), found.warnings)


def has_cell(call: InCell) -> bool:
    """Whether contacts count in a request."""
    return call.scene is not None or call.min_clearance is not None


def cell_bodies(loaded: LoadedRobot, call: InCell) -> CellBodies | None:
    """Return the bodies that a request is about; raises as `cell_of` does."""
    return bodies_in(loaded, call) if has_cell(call) else None


def bodies_in(loaded: LoadedRobot, call: InCell | CollisionRequest) -> CellBodies:
    """Return the bodies of a robot and those around it; raises as `cell_of` does."""
    obstacles = obstacles_of(call.scene, loaded.robot.description.root)
    return CellBodies(bodies_of(loaded), obstacles, tuple((call.other_joints or {}).items()))


@lru_cache(4)
def read_cell_bodies(content: bytes) -> CellBodies:
    """Return the bodies that another process has found; the same ones for the same content."""
    stored = orjson.loads(content)
    others = tuple((name, position) for name, position in stored["others"])
    return CellBodies(read_bodies(stored["own"]), tuple(map(_obstacle, stored["obstacles"])), others)


def _obstacle(stored: Mapping[str, Any]) -> Obstacle:
    bodies = tuple(map(read_body, stored["bodies"]))
    return Obstacle(**{**stored, "bodies": bodies, "touch_links": frozenset(stored["touch_links"])})


@lru_cache(32)
def _world(
    robot: RobotModel,
    chain: Chain,
    own: RobotBodies,
    obstacles: tuple[Obstacle, ...],
    others: tuple[tuple[str, float], ...],
) -> World:
    return build_world(robot, chain, own, obstacles, dict(others))


_cell = lru_cache(32)(cell_in)
