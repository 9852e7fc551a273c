"""Contacts and clearances of many configurations in one compiled call."""

import numpy as np

from gelenk.collision.contact.room import FlatWorld, distance_of, first_contact, nearest, place, room_of, touches
from gelenk.robot.arrays import Array, Flags, Indices
from gelenk.robot.compilation import compiled


@compiled
def first_contacts(world: FlatWorld, qs: Array) -> Indices:
    """Return the number of a pair in contact at each configuration, -1 where there is none; (N, n) → (N,)."""
    room, found, last = room_of(world), np.empty(len(qs), dtype=np.int64), 0
    for i in range(len(qs)):
        place(world, qs[i], room)
        # Neighbouring configurations often touch with the same pair.
        found[i] = last if len(world.pairs) and touches(world, last, room) else first_contact(world, room)
        last = max(found[i], 0)
    return found


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
