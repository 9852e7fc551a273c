"""The robot of a request in the scene of that request."""

from functools import lru_cache

from gelenk.collision.cell import Cell, cell_in
from gelenk.collision.contact.world import World, build_world
from gelenk.collision.robot_bodies import RobotBodies
from gelenk.collision.scene import Obstacle
from gelenk.contract.scene import InCell
from gelenk.operations.robot_bodies import bodies_of
from gelenk.operations.scene_objects import obstacles_of
from gelenk.robot.chain import Chain
from gelenk.robot.robot import RobotModel
from gelenk.store.records import LoadedRobot


def cell_of(loaded: LoadedRobot, chain: Chain, call: InCell) -> tuple[Cell, list[str]] | None:
    """Return the cell of a request with what its users should know of it; None if it asks for none.

    The same request gets the same cell while that is cached. Joints off the chain stand at 0. Raises InvalidMesh,
    InvalidPose, InvalidField or TooLarge, as a scene is what it should not be.
    """
    if call.scene is None and call.min_clearance is None:
        return None
    own, obstacles = bodies_of(loaded), obstacles_of(call.scene, loaded.robot.description.root)
    warnings = [*own.warnings, *(one.note for one in obstacles if one.note)]
    return _cell(world_of(loaded.robot, chain, own, obstacles, ()), call.min_clearance or 0.0), warnings


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
