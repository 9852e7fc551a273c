"""Random pairs of pieces, their distance by the kernels, and what is wrong with it."""

import math
from dataclasses import dataclass

import numpy as np
from scipy.spatial.transform import Rotation

from gelenk.collision.bodies import Body
from gelenk.collision.contact.flat import flat_bodies
from gelenk.collision.contact.gjk import WORK
from gelenk.collision.contact.pair import is_near, pair_distance, relative
from gelenk.collision.contact.penetration import empty_polytope
from gelenk.robot.arrays import Array
from tests.collision.arms import random_piece
from tests.collision.coal_peer import coal_distance

_ROOM, _WORK = empty_polytope(), np.zeros(WORK)


@dataclass(frozen=True)
class Measured:
    """Two pieces at poses of twelve numbers, (2, 12), and what the kernels say of them."""

    a: Body
    b: Body
    poses: Array
    distance: float
    is_contact: bool
    points: Array


def measured(a: Body, b: Body, poses: Array) -> Measured:
    """Return what the kernels say of two pieces."""
    bodies, T, points = flat_bodies([(a, 0, np.eye(4)), (b, 0, np.eye(4))]), np.empty(12), np.empty(6)
    distance = pair_distance(bodies, 0, 1, poses, math.inf, T, _WORK, _ROOM, points)
    return Measured(a, b, poses, distance, near(a, b, poses, 0.0), points)


def near(a: Body, b: Body, poses: Array, most: float) -> bool:
    """Return whether the kernels find two pieces at most so far apart, [m]."""
    bodies, T = flat_bodies([(a, 0, np.eye(4)), (b, 0, np.eye(4))]), np.empty(12)
    relative(poses[0], poses[1], T)
    return is_near(bodies, 0, 1, most, T, _WORK)


def random_pair(rng: np.random.Generator) -> Measured:
    """Return two pieces of 1 mm to 30 m, of up to ten times different size, apart, overlapping or concentric."""
    scale = 10.0 ** rng.uniform(-2.0, 1.5)
    a, b = random_piece(rng, scale), random_piece(rng, scale * 10.0 ** rng.uniform(-1.0, 1.0))
    return measured(a, b, np.array([_random_pose(rng, scale) for _ in range(2)]))


def _random_pose(rng: np.random.Generator, scale: float) -> Array:
    R = Rotation.random(random_state=rng).as_matrix() if rng.random() < 0.8 else np.eye(3)
    return np.append(R, scale * rng.choice([0.0, 0.3, 1.0, 2.0]) * rng.normal(size=3))


def faults(pair: Measured) -> list[str]:
    """Return what Coal, or geometry, contradicts."""
    found, tolerance = [], 1e-6 * max(1.0, float(np.abs(pair.poses[:, 9:]).max()))
    peer = coal_distance(pair.a, pair.b, pair.poses)
    if peer > tolerance and abs(pair.distance - peer) > tolerance:
        found.append(f"{pair.distance} is not Coal's {peer}")
    if abs(peer) > tolerance and pair.is_contact != (peer <= 0.0):
        found.append(f"the verdict {pair.is_contact} is not Coal's, {peer} m")
    if pair.is_contact != (pair.distance <= 0.0) and abs(pair.distance) > tolerance:
        found.append(f"the verdict {pair.is_contact} contradicts the distance {pair.distance}")
    apart = pair.points[:3] - pair.points[3:]
    if abs(np.linalg.norm(apart) - abs(pair.distance)) > tolerance:
        found.append("the points are not as far apart as the distance says")
    if pair.distance < -2.0 * tolerance:
        moved = pair.poses.copy()
        moved[1, 9:] += apart * (1.0 + 2.0 * tolerance / -pair.distance)
        if coal_distance(pair.a, pair.b, moved) <= 0.0:
            found.append("the displacement does not take the pieces apart")
    return found
