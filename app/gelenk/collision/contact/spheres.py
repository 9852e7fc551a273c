"""Contacts of the spheres around pieces, at eight configurations side by side [Thomason2024].

What these do not touch, no piece touches. First are the spheres around whole links and objects, then those around
pieces, at last those that cover the smaller piece of a pair, against the box around the other.
"""

from typing import NamedTuple

import numpy as np

from gelenk.collision.contact.flat import FlatBodies
from gelenk.collision.contact.room import FlatWorld
from gelenk.kinematics.simd.kernels import Frame, gather_rows, moved, placed
from gelenk.kinematics.simd.lanes import LANES, Lanes, bits, lanes, load, max_lanes, store
from gelenk.robot.arrays import Array
from gelenk.robot.compilation import compiled, inlined, unmanaged


class Rake(NamedTuple):
    """Work arrays of eight configurations, in rows of lanes.

    Attributes:
        values: A row for each column of a configuration.
        nodes: Pose of each node in the root, twelve rows each.
        centres: Centre in the root of each of the balls of `FlatBodies`, three rows each.
    """

    values: Array
    nodes: Array
    centres: Array


@compiled
def empty_rake(nodes: int, balls: int, n: int) -> Rake:
    """Return work arrays for so many nodes and balls, and configurations of `n` columns."""
    return Rake(np.empty(max(n, 1) * LANES), np.zeros(12 * nodes * LANES), np.empty(3 * balls * LANES))


@unmanaged
def place_root(bodies: FlatBodies, rake: Rake) -> None:
    """Put in place what no joint moves."""
    for k in range(0, 12, 4):
        store(rake.nodes, k, lanes(1.0))
    for i in range(len(bodies.balls)):
        if bodies.nodes[i] == 0:
            _place_ball(bodies, i, rake)


@unmanaged
def place_eight(world: FlatWorld, qs: Array, first: int, rake: Rake) -> None:
    """Compute the poses of nodes and the centres of balls at eight configurations from row `first` on."""
    gather_rows(qs, first, rake.values)
    for k in range(len(world.parents)):
        parent = _node(rake.nodes, world.parents[k])
        frame = placed(parent, world, k)  # type: ignore[arg-type]  # whose placements are as those of a chain
        value = world.drives[k, 0] * load(rake.values, world.joints[k, 1]) + world.drives[k, 1]
        frame = moved(frame, world.joints[k, 0], value)
        for i in range(12):
            store(rake.nodes, 12 * (k + 1) + i, frame[i])
    for i in range(len(world.bodies.balls)):
        if world.bodies.nodes[i] > 0:
            _place_ball(world.bodies, i, rake)


@inlined
def _node(nodes: Array, i: int) -> Frame:
    row = 12 * i
    return (
        load(nodes, row), load(nodes, row + 1), load(nodes, row + 2), load(nodes, row + 3),
        load(nodes, row + 4), load(nodes, row + 5), load(nodes, row + 6), load(nodes, row + 7),
        load(nodes, row + 8), load(nodes, row + 9), load(nodes, row + 10), load(nodes, row + 11),
    )  # fmt: skip


@inlined
def _point(frame: Frame, x: float, y: float, z: float) -> tuple[Lanes, Lanes, Lanes]:
    r00, r01, r02, r10, r11, r12, r20, r21, r22, p0, p1, p2 = frame
    return p0 + r00 * x + r01 * y + r02 * z, p1 + r10 * x + r11 * y + r12 * z, p2 + r20 * x + r21 * y + r22 * z


@inlined
def _place_ball(bodies: FlatBodies, i: int, rake: Rake) -> None:
    ball = bodies.balls[i]
    x, y, z = _point(_node(rake.nodes, bodies.nodes[i]), ball[0], ball[1], ball[2])
    store(rake.centres, 3 * i, x)
    store(rake.centres, 3 * i + 1, y)
    store(rake.centres, 3 * i + 2, z)


@inlined
def put_pose(bodies: FlatBodies, i: int, lane: int, rake: Rake, pose: Array) -> None:
    """Write the pose of a piece in the root at one of eight configurations; shape (12,)."""
    local, first = bodies.poses[i], 12 * LANES * bodies.nodes[i] + lane
    for row in range(3):
        at = first + 3 * LANES * row
        x, y, z = rake.nodes[at], rake.nodes[at + LANES], rake.nodes[at + 2 * LANES]
        for j in range(3):
            pose[3 * row + j] = x * local[j] + y * local[3 + j] + z * local[6 + j]
        pose[9 + row] = rake.nodes[first + (9 + row) * LANES] + x * local[9] + y * local[10] + z * local[11]


@inlined
def balls_meet(world: FlatWorld, a: int, b: int, margin: float, rake: Rake) -> int:
    """Return in which lanes two balls are at most so far apart, as bits."""
    x = load(rake.centres, 3 * a) - load(rake.centres, 3 * b)
    y = load(rake.centres, 3 * a + 1) - load(rake.centres, 3 * b + 1)
    z = load(rake.centres, 3 * a + 2) - load(rake.centres, 3 * b + 2)
    reach = world.bodies.balls[a, 3] + world.bodies.balls[b, 3] + margin
    return int(bits(x * x + y * y + z * z <= reach * reach))


@unmanaged
def spheres_meet(world: FlatWorld, k: int, some: int, rake: Rake) -> int:
    """Return in which of some lanes the spheres of the k-th pair are within its margin, as bits."""
    a, b, margin = world.pairs[k, 0], world.pairs[k, 1], world.margins[k]
    near = some & balls_meet(world, a, b, margin, rake)
    return _covers_meet(world.bodies, a, b, margin, near, rake) if near else 0


@unmanaged
def _covers_meet(bodies: FlatBodies, a: int, b: int, margin: float, near: int, rake: Rake) -> int:
    """Return in which of some lanes the spheres of the smaller piece reach the box around the larger."""
    if bodies.balls[a, 3] > bodies.balls[b, 3]:
        a, b = b, a
    box, frame = bodies.boxes[b], _piece(bodies, b, rake)
    ball = load(rake.centres, 3 * a), load(rake.centres, 3 * a + 1), load(rake.centres, 3 * a + 2)
    near &= _reaches(frame, box, ball, bodies.balls[a, 3] + margin)
    node, met = _node(rake.nodes, bodies.nodes[a]), 0
    for s in range(bodies.covered[a], bodies.covered[a + 1]):
        if met == near:
            break
        sphere = bodies.covers[s]
        met |= near & _reaches(frame, box, _point(node, sphere[0], sphere[1], sphere[2]), sphere[3] + margin)
    return met


@inlined
def _piece(bodies: FlatBodies, i: int, rake: Rake) -> Frame:
    """Return the pose of a piece in the root."""
    r00, r01, r02, r10, r11, r12, r20, r21, r22, p0, p1, p2 = _node(rake.nodes, bodies.nodes[i])
    A = bodies.poses[i]
    a00, a01, a02, a10, a11, a12, a20, a21, a22 = A[0], A[1], A[2], A[3], A[4], A[5], A[6], A[7], A[8]
    t0, t1, t2 = A[9], A[10], A[11]
    return (
        r00 * a00 + r01 * a10 + r02 * a20, r00 * a01 + r01 * a11 + r02 * a21, r00 * a02 + r01 * a12 + r02 * a22,
        r10 * a00 + r11 * a10 + r12 * a20, r10 * a01 + r11 * a11 + r12 * a21, r10 * a02 + r11 * a12 + r12 * a22,
        r20 * a00 + r21 * a10 + r22 * a20, r20 * a01 + r21 * a11 + r22 * a21, r20 * a02 + r21 * a12 + r22 * a22,
        p0 + r00 * t0 + r01 * t1 + r02 * t2, p1 + r10 * t0 + r11 * t1 + r12 * t2, p2 + r20 * t0 + r21 * t1 + r22 * t2,
    )  # fmt: skip


@inlined
def _reaches(frame: Frame, box: Array, centre: tuple[Lanes, Lanes, Lanes], radius: float) -> int:
    """Return in which lanes a sphere reaches a box, as bits."""
    r00, r01, r02, r10, r11, r12, r20, r21, r22, p0, p1, p2 = frame
    x, y, z = centre[0] - p0, centre[1] - p1, centre[2] - p2
    u = _outside(r00 * x + r10 * y + r20 * z, box[0], box[3])
    v = _outside(r01 * x + r11 * y + r21 * z, box[1], box[4])
    w = _outside(r02 * x + r12 * y + r22 * z, box[2], box[5])
    return int(bits(u * u + v * v + w * w <= radius * radius))


@inlined
def _outside(x: Lanes, low: float, high: float) -> Lanes:
    return max_lanes(max_lanes(x - high, low - x), 0.0)
