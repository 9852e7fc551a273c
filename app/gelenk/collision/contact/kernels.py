"""Contacts and clearances of many configurations in one compiled call."""

from typing import Any

import numpy as np

from gelenk.collision.contact.gjk import WORK
from gelenk.collision.contact.pair import is_near, relative
from gelenk.collision.contact.room import FlatWorld, distance_of, nearest, parts_of, place, room_of, touches, world_of
from gelenk.collision.contact.spheres import (
    Rake,
    balls_meet,
    empty_rake,
    place_eight,
    place_root,
    put_pose,
    spheres_meet,
)
from gelenk.kinematics.simd.lanes import LANES
from gelenk.robot.arrays import Array, Flags, Indices
from gelenk.robot.compilation import compiled, unmanaged


def first_contacts(world: FlatWorld, qs: Array, *, is_exact: bool = True) -> Indices:
    """Return the number of a pair in contact at each configuration, -1 where there is none; (N, n) → (N,).

    If not `is_exact`, of a pair whose spheres touch: where none do, there is no contact.
    """
    return _first_contacts(parts_of(world), qs, is_exact)


@compiled
def _first_contacts(parts: tuple[Any, ...], qs: Array, is_exact: bool) -> Indices:
    world = world_of(parts)
    rake = empty_rake(len(world.parents) + 1, len(world.bodies.balls), qs.shape[1])
    poses, work, found = np.empty((3, 12)), np.zeros(WORK), np.full(len(qs), -1)
    place_root(world.bodies, rake)
    for first in range(0, len(qs), LANES):
        place_eight(world, qs, first, rake)
        _find_contacts(world, is_exact, rake, poses, work, found[first : first + LANES])
    return found


def first_free(world: FlatWorld, qs: Array, order: Indices, firsts: Indices) -> Indices:
    """Return of some configurations in each group the first that touches nothing, without a look at those behind it.

    Args:
        qs: All configurations; shape (M, n).
        order: Their rows, as the groups have them; shape (K,).
        firsts: Where each group begins there, and K at the end; shape (N + 1,).

    Returns:
        The row of each group, -1 where none is free; shape (N,).
    """
    return _first_free(parts_of(world), qs, order, firsts)


@compiled
def _first_free(parts: tuple[Any, ...], qs: Array, order: Indices, firsts: Indices) -> Indices:
    world = world_of(parts)
    rake = empty_rake(len(world.parents) + 1, len(world.bodies.balls), qs.shape[1])
    poses, work, some = np.empty((3, 12)), np.zeros(WORK), np.empty((LANES, qs.shape[1]))
    owners, rows, found = np.empty(LANES, np.int64), np.empty(LANES, np.int64), np.empty(LANES, np.int64)
    free, following = np.full(len(firsts) - 1, -1), firsts[:-1].copy()
    waiting = np.flatnonzero(firsts[1:] > firsts[:-1])
    place_root(world.bodies, rake)
    left = len(waiting)
    while left:
        # The lanes take one configuration of each group, of the last few groups some more.
        here, each, left = left, max(LANES // left, 1), 0
        for first in range(0, here, LANES // each):
            last, count = min(first + LANES // each, here), 0
            for i in waiting[first:last]:
                for at in range(following[i], min(following[i] + each, firsts[i + 1])):
                    owners[count], rows[count], found[count], some[count] = i, order[at], -1, qs[order[at]]
                    count += 1
            place_eight(world, some[:count], 0, rake)
            _find_contacts(world, True, rake, poses, work, found[:count])
            for lane in range(count):
                i = owners[lane]
                following[i] += 1
                if found[lane] < 0 and free[i] < 0:
                    free[i] = rows[lane]
            for i in waiting[first:last]:
                if free[i] < 0 and following[i] < firsts[i + 1]:
                    waiting[left], left = i, left + 1
    return free


@unmanaged
def _find_contacts(world: FlatWorld, is_exact: bool, rake: Rake, poses: Array, work: Array, found: Indices) -> None:
    """Set a pair in contact at each of up to eight configurations, as `first_contacts` does."""
    free = (1 << len(found)) - 1
    for g in range(len(world.groups)):
        k, end = world.groups[g, 2], world.groups[g, 3]
        near = free & balls_meet(world, world.groups[g, 0], world.groups[g, 1], world.margins[k], rake)
        while near and k < end:
            met = spheres_meet(world, k, near, rake)
            for lane in range(len(found) if met else 0):
                if met >> lane & 1 and (not is_exact or _touches(world, k, lane, rake, poses, work)):
                    found[lane], near, free = k, near ^ 1 << lane, free ^ 1 << lane
            k += 1


@unmanaged
def _touches(world: FlatWorld, k: int, lane: int, rake: Rake, poses: Array, work: Array) -> bool:
    """Whether the k-th pair is in contact at one of eight configurations."""
    a, b = world.pairs[k, 0], world.pairs[k, 1]
    put_pose(world.bodies, a, lane, rake, poses[0])
    put_pose(world.bodies, b, lane, rake, poses[1])
    relative(poses[0], poses[1], poses[2])
    return is_near(world.bodies, a, b, world.margins[k], poses[2], work)


def nearest_pairs(world: FlatWorld, qs: Array) -> tuple[Array, Indices, Array]:
    """Return the smallest distance less its pair's margin at each configuration, the pair, and the nearest points.

    Of configurations (N, n): (N,) [m], negative the depth, infinite without pairs; (N,), -1 without pairs; (N, 6) [m].
    """
    distances, pairs, points = _nearest_pairs(parts_of(world), qs)
    return distances, pairs, points


@compiled
def _nearest_pairs(parts: tuple[Any, ...], qs: Array) -> tuple[Array, Indices, Array]:
    world = world_of(parts)
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
