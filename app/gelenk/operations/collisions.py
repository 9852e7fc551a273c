"""Contacts of a robot with itself and a scene."""

from functools import lru_cache
from typing import Any

import numpy as np

from gelenk.collision.contact.judge import certify_clearances, certify_contacts
from gelenk.collision.contact.kernels import all_contacts, first_contacts, nearest_pairs, pair_distances
from gelenk.collision.contact.world import World, build_world
from gelenk.collision.robot_bodies import RobotBodies
from gelenk.collision.scene import Obstacle
from gelenk.contract.collisions import CollisionRequest
from gelenk.errors import InvalidField, listed, quoted
from gelenk.operations.chains import check_numbers, head
from gelenk.operations.outcome import Limits, Outcome
from gelenk.operations.robot_bodies import WARM_UP, bodies_of
from gelenk.operations.scene_objects import obstacles_of
from gelenk.robot.arrays import Array
from gelenk.robot.chain import Chain
from gelenk.robot.configuration import configurations
from gelenk.robot.robot import RobotModel
from gelenk.store.records import LoadedRobot

__all__ = ["WARM_UP", "is_heavy", "run"]
_NUMBERS = 9
"""Numbers of a result with one pair."""


def run(loaded: LoadedRobot, call: CollisionRequest, limits: Limits) -> Outcome:
    """Find contacts, and the nearest pair, at each configuration."""
    chain = loaded.robot.chain(call.base_frame, call.tip_frame)
    qs = configurations(chain, call.joint_positions)
    check_numbers(len(qs) * _NUMBERS, limits)
    own, obstacles = bodies_of(loaded), obstacles_of(call.scene, loaded.robot.description.root)
    world = _world(loaded.robot, chain, own, obstacles, _others(loaded.robot, chain, call.other_joints or {}))
    warnings = [*own.warnings, *(one.note for one in obstacles if one.note)]
    if call.clearance:
        slacks, pairs, points = nearest_pairs(world.flat, qs)
        touching, certificate = slacks <= 0.0, certify_clearances(world, qs, slacks, pairs, points)
    else:
        pairs = first_contacts(world.flat, qs)
        slacks, touching = np.full(len(qs), np.nan), pairs >= 0
        certificate = certify_contacts(world, qs, touching)

    def content() -> dict[str, Any]:
        results: list[dict[str, Any]] = [{"in_collision": one} for one in touching.tolist()]
        if call.clearance:
            for result, slack in zip(results, slacks.tolist(), strict=True):
                result["clearance"] = slack if slack < np.inf else None
        if call.pairs != "none":
            found = _every_pair(world, qs) if call.pairs == "all" else _one_pair(world, qs, pairs)
            for result, some in zip(results, found, strict=True):
                result["pairs"] = some
        about = {"root_frame": loaded.robot.description.root, "warnings": warnings, "certificate": certificate}
        return head(chain) | about | {"results": results}

    return Outcome(content, lambda: (np.column_stack((touching, slacks)), {}))


def is_heavy(call: CollisionRequest) -> bool:
    """Check whether a request takes the event loop more than about a millisecond."""
    return len(call.joint_positions) > 1 or call.scene is not None


@lru_cache(32)
def _world(
    robot: RobotModel,
    chain: Chain,
    own: RobotBodies,
    obstacles: tuple[Obstacle, ...],
    others: tuple[tuple[str, float], ...],
) -> World:
    return build_world(robot, chain, own, obstacles, dict(others))


def _others(robot: RobotModel, chain: Chain, given: dict[str, float]) -> tuple[tuple[str, float], ...]:
    """Return the positions of joints off the chain; raises InvalidField for a joint that is not one."""
    allowed = tuple(joint.name for joint in robot.description.movable if joint.name not in chain.joint_names)
    for name in given:
        if name not in allowed:
            reason = f"{quoted(name)} is no independent joint off the chain; those are {listed(allowed)}"
            raise InvalidField("other_joints", reason)
    return tuple(given.items())


def _one_pair(world: World, qs: Array, pairs: Any) -> list[list[dict[str, Any]]]:
    distances, points = pair_distances(world.flat, qs, pairs)
    return [
        [_pair(world, int(pair), float(distance), row)] if pair >= 0 else []
        for pair, distance, row in zip(pairs, distances, points, strict=True)
    ]


def _every_pair(world: World, qs: Array) -> list[list[dict[str, Any]]]:
    """Return the contacts at each configuration, the deepest pieces of each pair of names, the deepest pair first."""
    found = []
    for q in qs:
        distances, points = all_contacts(world.flat, q)
        pairs: dict[tuple[str, str], dict[str, Any]] = {}
        for k in np.argsort(distances)[: np.isfinite(distances).sum()]:
            pair = _pair(world, int(k), float(distances[k]), points[k])
            pairs.setdefault((pair["a"], pair["b"]), pair)
        found.append(list(pairs.values()))
    return found


def _pair(world: World, k: int, distance: float, points: Array) -> dict[str, Any]:
    a, b = (world.names[i] for i in world.flat.pairs[k])
    return {"a": a, "b": b, "distance": distance, "point_a": points[:3].tolist(), "point_b": points[3:].tolist()}
