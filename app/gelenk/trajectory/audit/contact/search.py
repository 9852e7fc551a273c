"""The smallest clearance of a whole motion, and up to when it provably touches nothing.

Between two places of a motion a distance changes by no more than the two pieces travel. A stretch in which no pair can
come below what matters is done; else it is halved, the earlier half first, with the pairs that are left.
"""

import math
from typing import NamedTuple

import numpy as np

from gelenk.collision.contact.room import (
    ContactRoom,
    FlatWorld,
    ball_bound,
    box_bound,
    distance_of,
    nearest,
    place,
    room_of,
)
from gelenk.robot.arrays import Array
from gelenk.robot.compilation import compiled, inlined, unmanaged
from gelenk.trajectory.audit.contact.travel import Travel, pair_travel, put_position, put_travels, travel_of
from gelenk.trajectory.audit.pieces import Pieces

_FIRST = 9
"""Places that are looked at in any motion."""
_SETTLED = 1e-6
"""Least travel within which a contact is no longer looked for, but taken for one, [m]."""
_DEPTH = 512
"""Most stretches that wait: halving ends at the last digit of a time."""
_PAIR, _BEFORE, _AFTER, _BOUND = range(4)
"""What is known of a pair in a stretch: its number, its slack at both ends, and a lower bound within, [m]."""
_HERE = 4
"""Likewise its slack in the middle; then come the bounds within both halves."""


class Least(NamedTuple):
    """The least slack of a motion: distance of a pair less its margin.

    Attributes:
        slack: The smallest that was found, [m]; at no time is it less than this by more than the resolution.
        place, pair: Where and of which pair; -1 without pairs.
        free_until: Place up to which no pair is in contact; ∞ if none is at any time.
        looks: At how many places the robot was placed.
    """

    slack: float
    place: float
    pair: int
    free_until: float
    looks: int


@compiled
def least_slack(world: FlatWorld, pieces: Pieces, resolution: float) -> Least:
    """Find the least slack of a motion, [m], to within a resolution, and when a pair first comes to 0."""
    room, travel, q = room_of(world), travel_of(world, pieces), np.empty(pieces.scaled.shape[2])
    slack, where, pair = _sampled(world, pieces, room, q)
    free_until, looks = math.inf, _FIRST
    spans, firsts, depth = np.empty((_DEPTH, 3)), np.zeros(_DEPTH, dtype=np.int64), 1
    spans[0, 0], spans[0, 1], spans[0, 2] = 0.0, len(pieces.widths), math.inf
    waiting, count = _all_pairs(len(world.pairs)), len(world.pairs)
    own, trial = np.empty((len(world.pairs), _HERE + 3)), np.empty(6)
    while depth:
        depth -= 1
        begin, end, first = spans[depth, 0], spans[depth, 1], firsts[depth]
        matters = _matters(slack, free_until, resolution)
        left, count = _left(waiting, first, count, matters, own), first
        if left == 0:
            continue
        x = _middle(pieces, begin, end)
        if spans[depth, 2] <= _SETTLED or not begin < x < end:
            free_until = min(free_until, begin)
            continue
        looks += 1
        put_position(pieces, x, q)
        place(world, q, room)
        put_travels(world, pieces, room, travel, begin, x, end)
        least, nearest_pair, before, after = _look(world, room, travel, own[:left], matters, trial)
        if least < slack:
            slack, where, pair = least, x, nearest_pair
        if count + 2 * left > len(waiting):
            waiting = np.concatenate((waiting, np.empty((len(waiting) + 2 * left, 4))))
        matters = _matters(slack, free_until, resolution)
        for side in (1, 0):
            spans[depth, 0], spans[depth, 1], spans[depth, 2] = (x, end, after) if side else (begin, x, before)
            firsts[depth], count = count, _wait(own[:left], side, matters, waiting, count)
            depth += count > firsts[depth]
    return Least(slack, where, pair, free_until, looks)


@compiled
def _all_pairs(count: int) -> Array:
    waiting = np.full((count, 4), -math.inf)
    waiting[:, _PAIR] = np.arange(count)
    return waiting


@compiled
def _sampled(world: FlatWorld, pieces: Pieces, room: ContactRoom, q: Array) -> tuple[float, float, int]:
    """Return the least slack at a few times, both ends among them, with its place and pair."""
    bounds, trial, points = np.empty(len(world.pairs)), np.empty(6), np.empty(6)
    least, where, pair = math.inf, 0.0, -1
    for time in np.linspace(pieces.starts[0], pieces.starts[-1] + pieces.widths[-1], _FIRST):
        piece = np.searchsorted(pieces.starts, time, side="right") - 1
        x = piece + min((time - pieces.starts[piece]) / pieces.widths[piece], 1.0)
        put_position(pieces, x, q)
        place(world, q, room)
        slack, nearest_pair = nearest(world, room, bounds, trial, points)
        if slack < least:
            least, where, pair = slack, x, nearest_pair
    return least, where, pair


@inlined
def _matters(least: float, free_until: float, resolution: float) -> float:
    """Return the slack above which a pair does not matter: it changes neither the least nor the first contact."""
    return max(least - resolution, 0.0) if free_until == math.inf else least - resolution


@unmanaged
def _left(waiting: Array, first: int, end: int, matters: float, own: Array) -> int:
    """Copy the pairs of a stretch that still matter; return their number."""
    left = 0
    for i in range(first, end):
        if waiting[i, _BOUND] <= matters:
            for what in (_PAIR, _BEFORE, _AFTER):
                own[left, what] = waiting[i, what]
            left += 1
    return left


@unmanaged
def _middle(pieces: Pieces, begin: float, end: float) -> float:
    """Return where to halve: in time at the end of a piece, or in the middle of one."""
    if end - begin <= 1.0:
        return 0.5 * (begin + end)
    last, low, high = int(end) - 1, int(begin) + 1, int(end) - 1
    half = 0.5 * (pieces.starts[int(begin)] + pieces.starts[last] + pieces.widths[last])
    while low < high:
        middle = (low + high) // 2
        low, high = (low, middle) if pieces.starts[middle] >= half else (middle + 1, high)
    return float(low)


@unmanaged
def _look(
    world: FlatWorld, room: ContactRoom, travel: Travel, own: Array, matters: float, trial: Array
) -> tuple[float, int, float, float]:
    """Look at pairs where they are placed: write their slacks there, and the bounds on both sides.

    Returns the least slack and its pair, and the largest travel on both sides.
    """
    least, nearest_pair, longest = math.inf, -1, (0.0, 0.0)
    for i in range(len(own)):
        k = int(own[i, _PAIR])
        before, after = pair_travel(world, room, travel, k, 0), pair_travel(world, room, travel, k, 1)
        enough = max(_enough(own[i, _BEFORE], before, matters), _enough(own[i, _AFTER], after, matters))
        slack, is_exact = _slack(world, room, k, enough, trial)
        if is_exact and slack < least:
            least, nearest_pair = slack, k
        own[i, _HERE] = slack
        own[i, _HERE + 1], own[i, _HERE + 2] = (
            _within(own[i, _BEFORE], slack, before),
            _within(own[i, _AFTER], slack, after),
        )
        longest = max(longest[0], before), max(longest[1], after)
    return least, nearest_pair, longest[0], longest[1]


@inlined
def _within(end: float, slack: float, travel: float) -> float:
    """Return a lower bound of a slack that changes from one end of a stretch to the other, of which one is known."""
    return max(slack - travel, 0.5 * (end + slack - travel))


@inlined
def _enough(end: float, travel: float, matters: float) -> float:
    """Return the slack at the other end of a stretch from which on the pair does not matter in it."""
    return matters + min(travel, matters + travel - end)


@inlined
def _slack(world: FlatWorld, room: ContactRoom, k: int, enough: float, trial: Array) -> tuple[float, bool]:
    """Return a slack and whether it is exact; if not, a lower bound that is enough."""
    a, b, margin = world.pairs[k, 0], world.pairs[k, 1], world.margins[k]
    bound = ball_bound(world.bodies, a, b, room) - margin
    if bound > enough:
        return bound, False
    bound = box_bound(world.bodies, a, b, room) - margin
    if bound > enough:
        return bound, False
    slack = distance_of(world, k, enough + margin, room, trial) - margin
    return slack, slack <= enough


@unmanaged
def _wait(own: Array, side: int, matters: float, waiting: Array, count: int) -> int:
    """Let the pairs that matter on one side of the place wait with it; return the number of all that wait."""
    for i in range(len(own)):
        bound = own[i, _HERE + 1 + side]
        if bound <= matters:
            waiting[count, _PAIR], waiting[count, _BOUND] = own[i, _PAIR], bound
            waiting[count, _BEFORE] = own[i, _HERE] if side else own[i, _BEFORE]
            waiting[count, _AFTER] = own[i, _AFTER] if side else own[i, _HERE]
            count += 1
    return count
