"""How far pieces of a robot can move during a stretch of a motion, at most.

A place of a motion is the number of a polynomial piece plus τ. A joint travels no further than the control polygon of
its polynomial; a point of a body no further than the sum of what the joints below it travel, times its distance from
their axes. That distance, too, grows by no more than the joints in between move the body.
"""

import math
from typing import NamedTuple

import numpy as np

from gelenk.collision.contact.flat import HALF_SPACE
from gelenk.collision.contact.room import ContactRoom, FlatWorld
from gelenk.kinematics.simd.vectors import Vector, cross, dot, minus, row
from gelenk.robot.arrays import Array, Indices
from gelenk.robot.compilation import compiled, inlined, unmanaged
from gelenk.trajectory.audit.pieces import Pieces, by_tau


class Travel(NamedTuple):
    """What is known about travels before any place is looked at, and room for those on both sides of one.

    Attributes:
        sums: What the joints travel up to the end of each piece, at most; shape (P + 1, n), [rad or m].
        movers: Bodies that joints move; shape (m,).
        meets: Node at which the ways to the root of the two of a pair meet; shape (M,).
        joints: Of the stretches before and after a place; shape (2, n), [rad or m].
        bodies: Of each body relative to each node on its way to the root, on both sides; shape (2, B, K + 1), [m].
        polygon: For one polynomial.
    """

    sums: Array
    movers: Indices
    meets: Indices
    joints: Array
    bodies: Array
    polygon: Array


@compiled
def travel_of(world: FlatWorld, pieces: Pieces) -> Travel:
    """Prepare the travels of a motion."""
    count, size, n = pieces.scaled.shape
    sums, polygon = np.zeros((count + 1, n)), np.empty(size)
    for piece in range(count):
        for joint in range(n):
            sums[piece + 1, joint] = sums[piece, joint] + _within(pieces, piece, joint, 0.0, 1.0, polygon)
    nodes, meets = world.bodies.nodes, np.empty(len(world.pairs), dtype=np.int64)
    for k in range(len(meets)):
        a, b = nodes[world.pairs[k, 0]], nodes[world.pairs[k, 1]]
        while a != b:  # A node's number is higher than that of the one before it.
            a, b = min(a, b), world.parents[max(a, b) - 1]
        meets[k] = a
    bodies = np.zeros((2, len(nodes), len(world.parents) + 1))
    return Travel(sums, np.flatnonzero(nodes > 0), meets, np.empty((2, n)), bodies, polygon)


@inlined
def split(pieces: Pieces, x: float) -> tuple[int, float]:
    """Return the piece and τ of a place."""
    piece = min(int(x), len(pieces.widths) - 1)
    return piece, x - piece


@inlined
def put_position(pieces: Pieces, x: float, q: Array) -> None:
    """Write the configuration at a place."""
    piece, tau = split(pieces, x)
    for joint in range(len(q)):
        q[joint] = by_tau(pieces, piece, joint, tau, 0)


@unmanaged
def put_travels(
    world: FlatWorld, pieces: Pieces, room: ContactRoom, travel: Travel, begin: float, x: float, end: float
) -> None:
    """Write what joints and bodies travel from `begin` to `x`, where they are placed, and from there to `end`."""
    for joint in range(travel.joints.shape[1]):
        travel.joints[0, joint] = _joint_travel(pieces, travel, joint, begin, x)
        travel.joints[1, joint] = _joint_travel(pieces, travel, joint, x, end)
    bodies = world.bodies
    for i in range(len(travel.movers)):
        body = travel.movers[i]
        node, first, second = bodies.nodes[body], 0.0, 0.0
        while node > 0:
            before, after, reach = _turns(world, room, travel, node - 1, row(room.centres, body))
            reach += bodies.balls[body, 3] if world.joints[node - 1, 0] == 0 else 0.0
            first, second = _moved(world, node - 1, first, before, reach), _moved(world, node - 1, second, after, reach)
            node = world.parents[node - 1]
            travel.bodies[0, body, node], travel.bodies[1, body, node] = first, second


@inlined
def _turns(
    world: FlatWorld, room: ContactRoom, travel: Travel, joint: int, centre: Vector
) -> tuple[float, float, float]:
    """Return what a joint travels on both sides, and how far a point is from its axis."""
    pose, column, drive = room.nodes[joint + 1], world.joints[joint, 1], abs(world.drives[joint, 0])
    aside = cross((pose[2], pose[5], pose[8]), minus(centre, (pose[9], pose[10], pose[11])))
    return drive * travel.joints[0, column], drive * travel.joints[1, column], math.sqrt(dot(aside, aside))


@inlined
def _moved(world: FlatWorld, joint: int, moved: float, turn: float, reach: float) -> float:
    """Return how far a body moves if a joint moves it too, which then is at most `reach` and that from its axis."""
    return moved + turn if world.joints[joint, 0] else moved + turn * (reach + moved)


@unmanaged
def pair_travel(world: FlatWorld, room: ContactRoom, travel: Travel, k: int, side: int) -> float:
    """Return how far the two of a pair move relative to each other on one side of the place, at most, [m]."""
    a, b, meet = world.pairs[k, 0], world.pairs[k, 1], travel.meets[k]
    bodies = world.bodies
    if bodies.kinds[b] != HALF_SPACE or bodies.nodes[b] == meet:
        return float(travel.bodies[side, a, meet] + travel.bodies[side, b, meet])
    # A half-space has no end: what counts is how far the other moves as seen from it.
    total, factor, node = travel.bodies[side, a, meet], 1.0, bodies.nodes[b]
    while node != meet:
        before, after, reach = _turns(world, room, travel, node - 1, row(room.centres, a))
        turn = after if side else before
        if world.joints[node - 1, 0]:
            total += turn
        else:
            total, factor = total + turn * (reach + bodies.balls[a, 3]), factor * (1.0 + turn)
        node = world.parents[node - 1]
    return float(total * factor)


@inlined
def _joint_travel(pieces: Pieces, travel: Travel, joint: int, begin: float, end: float) -> float:
    """Return what a joint travels between two places: of one piece, or both where pieces meet."""
    if end - begin > 1.0:
        return float(travel.sums[int(end), joint] - travel.sums[int(begin), joint])
    piece, tau = split(pieces, begin)
    return _within(pieces, piece, joint, tau, end - piece, travel.polygon)


@unmanaged
def _within(pieces: Pieces, piece: int, joint: int, begin: float, end: float, polygon: Array) -> float:
    """Return the length of a polynomial's control polygon between two τ: that of its derivative, without signs."""
    degree, width = pieces.scaled.shape[1] - 1, end - begin
    for k in range(degree):
        polygon[k] = (k + 1) * pieces.scaled[piece, k + 1, joint]
    for k in range(degree):
        for i in range(degree - 2, k - 1, -1):
            polygon[i] += begin * polygon[i + 1]
    power, binomial = width, 1.0
    for k in range(degree):
        polygon[k] *= power / binomial
        power, binomial = power * width, binomial * (degree - 1.0 - k) / (k + 1.0)
    for k in range(degree):
        for i in range(degree - 1, k, -1):
            polygon[i] += polygon[i - 1]
    total = 0.0
    for k in range(degree):
        total += abs(polygon[k])
    return float(total / max(degree, 1))
