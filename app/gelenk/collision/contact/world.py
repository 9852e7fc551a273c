"""A robot and what is around it, prepared for contacts: where its pieces are carried, and which of them may touch."""

from collections.abc import Iterable, Iterator, Mapping, Sequence
from dataclasses import dataclass

import numpy as np

from gelenk.collision.bodies import Body
from gelenk.collision.contact.flat import Placed, flat_bodies
from gelenk.collision.contact.kernels import FlatWorld
from gelenk.collision.contact.nodes import Nodes, without_free_joints
from gelenk.collision.robot_bodies import RobotBodies
from gelenk.collision.scene import Obstacle, check_scene
from gelenk.robot.chain import Chain
from gelenk.robot.robot import RobotModel


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
    """Prepare a robot and its scene; raises InvalidField for a frame of the scene that the robot does not have.

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
    """Return pieces as arrays; `names` says what each is of, `pairs` which of these may not touch, with margins [m]."""
    placed = [(body, *nodes.of(body.link)) for body in bodies]
    found = list(_piece_pairs(placed, names, pairs))
    return FlatWorld(
        *nodes.flat(),
        flat_bodies(placed),
        np.array([pair[:2] for pair in found], dtype=np.int64).reshape(-1, 2),
        np.array([margin for _, _, margin in found], dtype=float),
    )


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
    for a, b, margin in pairs:
        for i in pieces.get(a, ()):
            for j in pieces.get(b, ()):
                (first, node, _), (second, other, _) = placed[i], placed[j]
                if node != other and {first.kind, second.kind} != {"half_space"}:
                    yield (j, i, margin) if first.kind == "half_space" else (i, j, margin)
