"""Contacts and clearances of many configurations in one compiled call."""

import numpy as np

from gelenk.collision.contact.pair import is_near
from gelenk.collision.contact.room import (
    ContactRoom,
    FlatWorld,
    distance_of,
    nearest,
    place,
    place_body,
    room_of,
    touches,
)
from gelenk.collision.contact.spheres import Rake, balls_meet, place_eight, rake_of, spheres_meet
from gelenk.kinematics.simd.lanes import LANES
from gelenk.robot.arrays import Array, Flags, Indices
from gelenk.robot.compilation import compiled, unmanaged


@compiled
def first_contacts(world: FlatWorld, qs: Array) -> Indices:
    """Return the number of a pair in contact at each configuration, -1 where there is none; (N, n) → (N,)."""
    room, rake, found = room_of(world), rake_of(world, qs.shape[1]), np.full(len(qs), -1)
    for first in range(0, len(qs), LANES):
        place_eight(world, qs, first, rake)
        _find_contacts(world, True, rake, room, found[first : first + LANES])
    return found


@compiled
def first_spheres(world: FlatWorld, qs: Array) -> Indices:
    """Return the number of a pair whose spheres touch at each configuration, -1 where none do: there is no contact."""
    room, rake, found = room_of(world), rake_of(world, qs.shape[1]), np.full(len(qs), -1)
    for first in range(0, len(qs), LANES):
        place_eight(world, qs, first, rake)
        _find_contacts(world, False, rake, room, found[first : first + LANES])
    return found


@unmanaged
def _find_contacts(world: FlatWorld, is_exact: bool, rake: Rake, room: ContactRoom, found: Indices) -> None:
    """Set a pair in contact at each of up to eight configurations, as `first_contacts` or `first_spheres` do."""
    free = (1 << len(found)) - 1
    for g in range(len(world.groups)):
        k, end = world.groups[g, 2], world.groups[g, 3]
        near = free & balls_meet(world, world.groups[g, 0], world.groups[g, 1], world.margins[k], rake)
        while near and k < end:
            met = spheres_meet(world, k, near, rake)
            for lane in range(len(found) if met else 0):
                if met >> lane & 1 and (not is_exact or _touches(world, k, lane, rake, room)):
                    found[lane], near, free = k, near ^ 1 << lane, free ^ 1 << lane
            k += 1


@unmanaged
def _touches(world: FlatWorld, k: int, lane: int, rake: Rake, room: ContactRoom) -> bool:
    """Whether the k-th pair is in contact at one of eight configurations."""
    a, b, bodies = world.pairs[k, 0], world.pairs[k, 1], world.bodies
    for i in (a, b):
        if bodies.nodes[i] > 0:
            for j in range(12):
                room.nodes[bodies.nodes[i], j] = rake.nodes[(12 * bodies.nodes[i] + j) * LANES + lane]
            place_body(bodies, i, room)
    return is_near(bodies, a, b, room.poses, world.margins[k], room.T, room.work)


@compiled
def nearest_pairs(world: FlatWorld, qs: Array) -> tuple[Array, Indices, Array]:
    """Return the smallest distance less its pair's margin at each configuration, the pair, and the nearest points.

    Of configurations (N, n): (N,) [m], negative the depth, infinite without pairs; (N,), -1 without pairs; (N, 6) [m].
    """
    room, count = room_of(world), len(qs)
    distances, pairs, points = np.empty(count), np.empty(count, dtype=np.int64), np.zeros((count, 6))
    bounds, trial = np.empty(len(world.pairs)), np.empty(6)
    for i in range(count):
        place(world, qs[i], room)
        distances[i], pairs[i] = nearest(world, room, bounds, trial, points[i])
    return distances, pairs, points


@compiled
def pair_distances(world: FlatWorld, qs: Array, pairs: Indices) -> tuple[Array, Array]:
    """Return the distance of one pair at each configuration, and its nearest points; zeros for pair -1.

    Of configurations (N, n) and pairs (N,): (N,), [m], negative the depth, and (N, 6), [m].
    """
    room, distances, points = room_of(world), np.zeros(len(qs)), np.zeros((len(qs), 6))
    for i in range(len(qs)):
        if pairs[i] >= 0:
            place(world, qs[i], room)
            distances[i] = distance_of(world, pairs[i], np.inf, room, points[i])
    return distances, points


@compiled
def all_contacts(world: FlatWorld, q: Array) -> tuple[Array, Array]:
    """Return distances of all pairs at one configuration, infinite if not in contact, and their deepest points.

    Of a configuration (n,): (M,), [m], and (M, 6), [m].
    """
    room, distances, points = room_of(world), np.full(len(world.pairs), np.inf), np.zeros((len(world.pairs), 6))
    place(world, q, room)
    for k in range(len(world.pairs)):
        if touches(world, k, room):
            distances[k] = distance_of(world, k, np.inf, room, points[k])
    return distances, points


@compiled
def always_in_contact(world: FlatWorld, qs: Array, groups: Indices, count: int) -> Flags:
    """Check which groups of pairs have one in contact at each of the configurations; (N, n) → (`count`,).

    `groups` has the number of each pair's group, shape (M,). A group found apart is not looked at again.
    """
    room, always, touching = room_of(world), np.ones(count, dtype=np.bool_), np.empty(count, dtype=np.bool_)
    for i in range(len(qs)):
        if not always.any():
            break
        place(world, qs[i], room)
        touching[:] = False
        for k in range(len(world.pairs)):
            group = groups[k]
            if always[group] and not touching[group]:
                touching[group] = touches(world, k, room)
        always &= touching
    return always
