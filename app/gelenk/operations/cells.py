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
from gelenk.contract.scene import InCell
from gelenk.operations.robot_bodies import bodies_of, read_bodies, read_body
from gelenk.operations.scene_objects import obstacles_of
from gelenk.robot.chain import Chain
from gelenk.robot.robot import RobotModel
from gelenk.store.records import LoadedRobot


@dataclass(frozen=True, slots=True)
class CellBodies:
    """The bodies of a robot, and the objects around it, which a job takes along."""

    own: RobotBodies
    obstacles: tuple[Obstacle, ...]

    @property
    def warnings(self) -> list[str]:
        """What has no body, or a larger one than it is."""
        return [*self.own.warnings, *(one.note for one in self.obstacles if one.note)]

    def cell(self, robot: RobotModel, chain: Chain, min_clearance: float | None) -> Cell:
        """Return the cell of a chain, joints off it at 0; raises InvalidField and TooLarge as `build_world` does."""
        return _cell(world_of(robot, chain, self.own, self.obstacles, ()), min_clearance or 0.0)

    def to_bytes(self) -> bytes:
        """Return what `read_cell_bodies` reads."""
        return orjson.dumps(self, default=lambda one: one.tolist() if isinstance(one, np.ndarray) else sorted(one))


def cell_of(loaded: LoadedRobot, chain: Chain, call: InCell) -> tuple[Cell, list[str]] | None:
    """Return the cell of a request with what its users should know of it; None if it asks for none.

    The same request gets the same cell while that is cached. Joints off the chain stand at 0. Raises InvalidMesh,
    InvalidPose, InvalidField or TooLarge, as a scene is what it should not be.
    """
    found = cell_bodies(loaded, call)
    return None if found is None else (found.cell(loaded.robot, chain, call.min_clearance), found.warnings)


def has_cell(call: InCell) -> bool:
    """Whether contacts count in a request."""
    return call.scene is not None or call.min_clearance is not None


def cell_bodies(loaded: LoadedRobot, call: InCell) -> CellBodies | None:
    """Return the bodies that a request is about; raises as `cell_of` does."""
    if not has_cell(call):
        return None
    return CellBodies(bodies_of(loaded), obstacles_of(call.scene, loaded.robot.description.root))


@lru_cache(4)
def read_cell_bodies(content: bytes) -> CellBodies:
    """Return the bodies that another process has found; the same ones for the same content."""
    stored = orjson.loads(content)
    return CellBodies(read_bodies(stored["own"]), tuple(map(_obstacle, stored["obstacles"])))


def _obstacle(stored: Mapping[str, Any]) -> Obstacle:
    bodies = tuple(map(read_body, stored["bodies"]))
    return Obstacle(**{**stored, "bodies": bodies, "touch_links": frozenset(stored["touch_links"])})


@lru_cache(32)
def world_of(
    robot: RobotModel,
    chain: Chain,
    own: RobotBodies,
    obstacles: tuple[Obstacle, ...],
    others: tuple[tuple[str, float], ...],
) -> World:
    """Return a robot in its scene, see `build_world`; the same one for the same arguments."""
    return build_world(robot, chain, own, obstacles, dict(others))


_cell = lru_cache(32)(cell_in)
