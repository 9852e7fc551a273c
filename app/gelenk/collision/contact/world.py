"""A robot and what is around it, prepared for contacts: where its pieces are carried, and which of them may touch."""

from collections.abc import Iterable, Iterator, Mapping, Sequence
from dataclasses import dataclass
from itertools import islice, product

import numpy as np

from gelenk.collision.bodies import Body
from gelenk.collision.contact.flat import Placed, flat_bodies
from gelenk.collision.contact.nodes import Nodes, without_free_joints
from gelenk.collision.contact.room import FlatWorld
from gelenk.collision.robot_bodies import RobotBodies
from gelenk.collision.scene import Obstacle, check_scene
from gelenk.errors import TooLarge
from gelenk.robot.arrays import Indices
from gelenk.robot.chain import Chain
from gelenk.robot.robot import RobotModel

MAX_PAIRS = 1_000_000
"""Pairs of pieces that are compared at most: their list takes memory and seconds."""


@dataclass(frozen=True, slots=True, eq=False)
class World:
    """A robot in a scene, for configurations of one chain.

    Attributes:
        bodies: Pieces of links and objects.
        names: Link or object that each piece is of.
        others: Positions of independent joints that the chain does not move, by name, [rad or m]; 0 of those left out.
    """

    robot: RobotModel
    chain: Chain
    others: Mapping[str, float]
    bodies: tuple[Body, ...]
    names: tuple[str, ...]
    flat: FlatWorld


def build_world(
    robot: RobotModel,
    chain: Chain,
    own: RobotBodies,
    obstacles: tuple[Obstacle, ...] = (),
    others: Mapping[str, float] | None = None,
) -> World:
    """Prepare a robot and its scene; raises InvalidField for a frame that the robot does not have, and TooLarge.

    Joints off the chain stand at 0 unless `others` says where; floating and planar ones are taken for fixed.
    """
    description = without_free_joints(robot.description)
    check_scene(description, obstacles)
    bodies = (*own.bodies, *(body for one in obstacles for body in one.bodies))
    names = (*(body.link for body in own.bodies), *(one.name for one in obstacles for _ in one.bodies))
    flat = flat_world(Nodes(description, chain.joint_names, others or {}), bodies, names, _pairs(own, obstacles))
    return World(robot, chain, others or {}, bodies, names, flat)


def flat_world(
    nodes: Nodes, bodies: Sequence[Body], names: Sequence[str], pairs: Iterable[tuple[str, str, float]]
) -> FlatWorld:
    """Return pieces as arrays; `names` says what each is of, `pairs` which of these may not touch, with margins [m].

    Raises TooLarge.
    """
    placed = [(body, *nodes.of(body.link)) for body in bodies]
    found = list(islice(_piece_pairs(placed, names, pairs), MAX_PAIRS + 1))
    if len(found) > MAX_PAIRS:
        raise TooLarge("pairs of pieces of links and objects", len(found), MAX_PAIRS)
    numbers = {name: i for i, name in enumerate(dict.fromkeys(names))}
    owners = np.array([numbers[name] for name in names], dtype=np.int64)
    together = np.array([pair[:2] for pair in found], dtype=np.int64).reshape(-1, 2)
    return FlatWorld(
        *nodes.flat(),
        flat_bodies(placed, [np.flatnonzero(owners == i).tolist() for i in numbers.values()]),
        together,
        np.array([margin for _, _, margin in found], dtype=float),
        _groups(len(bodies) + owners[together]),
    )


def _groups(owners: Indices) -> Indices:
    """Return `FlatWorld.groups` of the links or objects of each pair, shape (M, 2)."""
    changes = np.any(owners[1:] != owners[:-1], axis=1)
    starts = np.flatnonzero(np.append(True, changes)[: len(owners)])
    return np.column_stack((owners[starts], starts, np.append(starts[1:], len(owners))[: len(starts)]))


def _pairs(own: RobotBodies, obstacles: tuple[Obstacle, ...]) -> Iterator[tuple[str, str, float]]:
    """Yield the names of links and objects that may not touch, and the distance that counts as contact."""
    for pair in own.pairs:
        if pair.active:
            yield pair.a, pair.b, 0.0
    links = dict.fromkeys(body.link for body in own.bodies)
    for i, one in enumerate(obstacles):
        for link in links:
            if link not in one.touch_links:
                yield link, one.name, one.clearance
        for other in obstacles[:i]:
            yield other.name, one.name, max(one.clearance, other.clearance)


def _piece_pairs(
    placed: list[Placed], names: Sequence[str], pairs: Iterable[tuple[str, str, float]]
) -> Iterator[tuple[int, int, float]]:
    """Yield the pairs of pieces, a half-space always the second.

    Left out are two half-spaces, and pieces of one node: no joint moves them relative to each other.
    """
    pieces: dict[str, list[int]] = {}
    for i, name in enumerate(names):
        pieces.setdefault(name, []).append(i)
    nodes = {name: placed[some[0]][1] for name, some in pieces.items()}  # All pieces of a name are on one.
    for a, b, margin in pairs:
        if nodes.get(a) == nodes.get(b):
            continue
        for i, j in product(pieces.get(a, ()), pieces.get(b, ())):
            first, second = placed[i][0].kind, placed[j][0].kind
            if not first == second == "half_space":
                yield (j, i, margin) if first == "half_space" else (i, j, margin)
