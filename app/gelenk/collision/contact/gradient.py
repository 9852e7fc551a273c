"""How distances change with the joints.

The nearest points of two pieces may move along their surfaces, which does not change the distance at first order
[Danskin1966]: its derivative is that of two points fixed to the pieces, along the normal between them.
"""

import math

import numpy as np

from gelenk.collision.contact.pair import separation
from gelenk.collision.contact.room import ContactRoom, FlatWorld, ball_bound, box_bound, nearest, place, room_of
from gelenk.kinematics.simd.vectors import Vector, cross, dot, minus
from gelenk.robot.arrays import Array, Indices
from gelenk.robot.compilation import compiled, unmanaged

_REACH = 20.0
"""Distances by so many widths above the smallest do not count: each would change the soft minimum by 2e-9 widths."""


@compiled
def pair_gradients(world: FlatWorld, qs: Array, pairs: Indices) -> Array:
    """Return the gradient of one pair's distance at each configuration, in contact of minus the depth; 0 for pair -1.

    Of configurations (N, n) and pairs (N,): (N, n), [m/rad or 1]. Where several nearest pairs of points are equally
    near, as between parallel faces, it is that of one of these.
    """
    room, gradients, points = room_of(world), np.zeros(qs.shape), np.empty(6)
    for i in range(len(qs)):
        if pairs[i] >= 0:
            place(world, qs[i], room)
            _, normal = _separation(world, pairs[i], math.inf, room, points)
            _add_gradient(world, pairs[i], 1.0, normal, points, room, gradients[i])
    return gradients


@compiled
def soft_clearances(world: FlatWorld, qs: Array, width: float) -> tuple[Array, Array]:
    """Return -w log Σ exp(-d/w) over the distances d of all pairs less their margins, and its gradient.

    It is at most the smallest distance, and near to it where the others are larger by more than `width`, [m]; unlike
    that, it changes smoothly from one nearest pair to another. Of configurations (N, n): (N,) [m], infinite without
    pairs, and (N, n) [m/rad or 1].
    """
    room, values, gradients = room_of(world), np.empty(len(qs)), np.zeros(qs.shape)
    bounds, points = np.empty(len(world.pairs)), np.empty(6)
    for i in range(len(qs)):
        place(world, qs[i], room)
        least, _ = nearest(world, room, bounds, points, points)
        values[i] = _soft_minimum(world, least, width, room, points, gradients[i])
    return values, gradients


@unmanaged
def _soft_minimum(
    world: FlatWorld, least: float, width: float, room: ContactRoom, points: Array, gradient: Array
) -> float:
    most, total = least + _REACH * width, 0.0
    for k in range(len(world.pairs)):
        a, b, margin = world.pairs[k, 0], world.pairs[k, 1], world.margins[k]
        if ball_bound(world.bodies, a, b, room) - margin > most or box_bound(world.bodies, a, b, room) - margin > most:
            continue
        distance, normal = _separation(world, k, most + margin, room, points)
        if distance - margin <= most:
            weight = math.exp((least - distance + margin) / width)
            total += weight
            _add_gradient(world, k, weight, normal, points, room, gradient)
    if total > 0.0:
        gradient /= total
        least -= width * math.log(total)
    return least


@unmanaged
def _separation(world: FlatWorld, k: int, far: float, room: ContactRoom, points: Array) -> tuple[float, Vector]:
    a, b = world.pairs[k, 0], world.pairs[k, 1]
    return separation(world.bodies, a, b, room.poses, far, room.T, room.work, room.polytope, points)


@unmanaged
def _add_gradient(
    world: FlatWorld, k: int, weight: float, normal: Vector, points: Array, room: ContactRoom, gradient: Array
) -> None:
    """Add n · (∂p_a/∂q - ∂p_b/∂q), weighted; the normal points from B to A."""
    for side in range(2):
        point = points[3 * side], points[3 * side + 1], points[3 * side + 2]
        node, sign = world.bodies.nodes[world.pairs[k, side]], weight if side == 0 else -weight
        while node > 0:
            pose = room.nodes[node]
            axis, joint = (pose[2], pose[5], pose[8]), node - 1
            moved = axis if world.joints[joint, 0] else cross(axis, minus(point, (pose[9], pose[10], pose[11])))
            gradient[world.joints[joint, 1]] += sign * world.drives[joint, 0] * dot(normal, moved)
            node = world.parents[joint]
