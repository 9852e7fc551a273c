"""Work arrays of one thread, the places of all pieces at a configuration, and distances there.

A pair of pieces passes through bounds of rising cost, from spheres around the pieces to the exact distance, and leaves
at the first that decides it.
"""

import math
from typing import Any, NamedTuple

import numpy as np

from gelenk.collision.contact.flat import HALF_SPACE, FlatBodies
from gelenk.collision.contact.gjk import WORK, turned_back_by, turned_by
from gelenk.collision.contact.pair import is_near, pair_distance, relative
from gelenk.collision.contact.penetration import Polytope, empty_polytope
from gelenk.kinematics.simd.vectors import Vector, dot, minus, row
from gelenk.robot.arrays import Array, Indices
from gelenk.robot.compilation import compiled, inlined, unmanaged


class FlatWorld(NamedTuple):
    """A robot and what is around it. Node 0 is the root, node k + 1 moves with joint k of K.

    Attributes:
        parents: Node before each joint, shape (K,); parents come first.
        placements: T_parent_joint, the joint's axis along z: rotation row by row, then translation, [m]; shape (K, 12).
        joints: For each joint, 1 if it slides, else 0, and the column of a configuration that moves it; shape (K, 2).
        drives: Multiplier and offset of joint position = multiplier · column + offset; shape (K, 2), [rad or m].
        bodies: All pieces.
        pairs: Pieces that may not touch, a half-space always the second; shape (M, 2).
        margins: Distance up to which each pair counts as in contact; shape (M,), [m].
        groups: For the pairs of two links or objects, which follow each other: the balls around these, the first pair
            and that after the last; shape (G, 4).
    """

    parents: Indices
    placements: Array
    joints: Indices
    drives: Array
    bodies: FlatBodies
    pairs: Indices
    margins: Array
    groups: Indices


def parts_of(world: FlatWorld) -> tuple[Any, ...]:
    """Return a world as plain tuples: passing a named one to a compiled function costs some microseconds."""
    return (*world[:4], tuple(world.bodies), *world[5:])


@compiled
def world_of(parts: tuple[Any, ...]) -> FlatWorld:
    """Return the world of which these are the parts."""
    parents, placements, joints, drives, bodies, pairs, margins, groups = parts
    return FlatWorld(parents, placements, joints, drives, FlatBodies(*bodies), pairs, margins, groups)


class ContactRoom(NamedTuple):
    """Work arrays: poses of nodes and pieces in the root, centres of the pieces' balls, and those of GJK and EPA."""

    nodes: Array
    poses: Array
    centres: Array
    T: Array
    work: Array
    polytope: Polytope


@compiled
def room_of(world: FlatWorld) -> ContactRoom:
    """Return work arrays for a world, with the pieces that no joint moves in place."""
    bodies = world.bodies
    room = ContactRoom(
        np.zeros((len(world.parents) + 1, 12)),
        np.empty((len(bodies.kinds), 12)),
        np.empty((len(bodies.kinds), 3)),
        np.empty(12),
        np.zeros(WORK),
        empty_polytope(),
    )
    room.nodes[0, 0] = room.nodes[0, 4] = room.nodes[0, 8] = 1.0
    for i in range(len(bodies.kinds)):
        if bodies.nodes[i] == 0:
            place_body(bodies, i, room)
    return room


@unmanaged
def place(world: FlatWorld, q: Array, room: ContactRoom) -> None:
    """Compute the poses of all nodes and pieces at a configuration."""
    for k in range(len(world.parents)):
        parent, pose = room.nodes[world.parents[k]], room.nodes[k + 1]
        _product(parent, world.placements[k], pose)
        value = world.drives[k, 0] * q[world.joints[k, 1]] + world.drives[k, 1]
        if world.joints[k, 0]:
            for i in range(3):
                pose[9 + i] += value * pose[3 * i + 2]
        else:
            c, s = math.cos(value), math.sin(value)
            for i in range(3):
                x, y = pose[3 * i], pose[3 * i + 1]
                pose[3 * i], pose[3 * i + 1] = c * x + s * y, c * y - s * x
    for i in range(len(world.bodies.kinds)):
        if world.bodies.nodes[i] > 0:
            place_body(world.bodies, i, room)


@inlined
def place_body(bodies: FlatBodies, i: int, room: ContactRoom) -> None:
    """Compute the pose of a piece, and the centre of its ball, where its node is."""
    node = room.nodes[bodies.nodes[i]]
    _product(node, bodies.poses[i], room.poses[i])
    centre = turned_by(node, row(bodies.balls, i))
    for k in range(3):
        room.centres[i, k] = centre[k] + node[9 + k]


@inlined
def _product(A: Array, B: Array, C: Array) -> None:
    """Write the product of two poses of twelve numbers to a third."""
    for i in range(3):
        for j in range(3):
            C[3 * i + j] = A[3 * i] * B[j] + A[3 * i + 1] * B[3 + j] + A[3 * i + 2] * B[6 + j]
        C[9 + i] = A[9 + i] + A[3 * i] * B[9] + A[3 * i + 1] * B[10] + A[3 * i + 2] * B[11]


@inlined
def touches(world: FlatWorld, k: int, room: ContactRoom) -> bool:
    """Whether the k-th pair is in contact."""
    a, b, margin = world.pairs[k, 0], world.pairs[k, 1], world.margins[k]
    if ball_bound(world.bodies, a, b, room) > margin:
        return False
    if box_bound(world.bodies, a, b, room) > margin:
        return False
    relative(room.poses[a], room.poses[b], room.T)
    return is_near(world.bodies, a, b, margin, room.T, room.work)


@inlined
def ball_bound(bodies: FlatBodies, a: int, b: int, room: ContactRoom) -> float:
    """Return a lower bound of the distance: of the spheres around two pieces."""
    if bodies.kinds[b] == HALF_SPACE:
        B = room.poses[b]
        up = B[2], B[5], B[8]
        height = dot(up, minus(row(room.centres, a), (B[9], B[10], B[11])))
        return height - float(bodies.balls[a, 3])
    apart = minus(row(room.centres, a), row(room.centres, b))
    return math.sqrt(dot(apart, apart)) - float(bodies.balls[a, 3] + bodies.balls[b, 3])


@unmanaged
def box_bound(bodies: FlatBodies, a: int, b: int, room: ContactRoom) -> float:
    """Return a lower bound of the distance: of the spheres that cover the one piece from the box around the other.

    It says nothing of pieces that may overlap.
    """
    if bodies.balls[a, 3] > bodies.balls[b, 3]:
        a, b = b, a
    centre = row(room.centres, a)
    bound = _outside_box(bodies.boxes[b], room.poses[b], centre) - bodies.balls[a, 3]
    if bound > 0.0 or bodies.covered[a] == bodies.covered[a + 1]:
        return bound if bound > 0.0 else -math.inf
    node, bound = room.nodes[bodies.nodes[a]], math.inf
    for k in range(bodies.covered[a], bodies.covered[a + 1]):
        turned = turned_by(node, row(bodies.covers, k))
        centre = turned[0] + node[9], turned[1] + node[10], turned[2] + node[11]
        bound = min(bound, _outside_box(bodies.boxes[b], room.poses[b], centre) - bodies.covers[k, 3])
    return bound if bound > 0.0 else -math.inf


@inlined
def _outside_box(box: Array, pose: Array, point: Vector) -> float:
    """Return the distance of a point in the root from the box around a piece; 0 inside."""
    local = turned_back_by(pose, minus(point, (pose[9], pose[10], pose[11])))
    x = max(local[0] - box[3], box[0] - local[0], 0.0)
    y = max(local[1] - box[4], box[1] - local[1], 0.0)
    z = max(local[2] - box[5], box[2] - local[2], 0.0)
    return math.sqrt(x * x + y * y + z * z)


@inlined
def distance_of(world: FlatWorld, k: int, far: float, room: ContactRoom, points: Array) -> float:
    """Return the distance of the k-th pair, as `pair_distance` does."""
    a, b = world.pairs[k, 0], world.pairs[k, 1]
    return pair_distance(world.bodies, a, b, room.poses, far, room.T, room.work, room.polytope, points)


@unmanaged
def nearest(world: FlatWorld, room: ContactRoom, bounds: Array, trial: Array, points: Array) -> tuple[float, int]:
    """Return the smallest distance less the margin, and its pair; write the nearest points."""
    best, found = math.inf, -1
    for k in range(len(world.pairs)):
        bounds[k] = ball_bound(world.bodies, world.pairs[k, 0], world.pairs[k, 1], room) - world.margins[k]
    for _ in range(len(world.pairs)):
        k = _least(bounds)
        if bounds[k] >= best:
            break
        bounds[k] = math.inf
        margin = world.margins[k]
        if best == math.inf or box_bound(world.bodies, world.pairs[k, 0], world.pairs[k, 1], room) - margin < best:
            distance = distance_of(world, k, best + margin, room, trial) - margin
            if distance < best:
                best, found = distance, k
                for i in range(6):
                    points[i] = trial[i]
    return best, found


@inlined
def _least(values: Array) -> int:
    least = 0
    for k in range(1, len(values)):
        if values[k] < values[least]:
            least = k
    return least
