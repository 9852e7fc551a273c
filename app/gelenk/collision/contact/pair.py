"""Distance of two pieces: of their cores, less the radii around these; negative is the depth."""

import math

from gelenk.collision.contact.flat import BOX, HALF_SPACE, HULL, FlatBodies
from gelenk.collision.contact.gjk import NEAREST, TINY, core_distance, furthest, turned_by
from gelenk.collision.contact.penetration import Polytope, core_depth
from gelenk.kinematics.simd.lanes import LANES, abs_lanes, bits, lanes, load, max_lanes, min_lanes
from gelenk.kinematics.simd.vectors import Vector, dot, plus, scaled
from gelenk.robot.arrays import Array
from gelenk.robot.compilation import inlined, unmanaged


@inlined
def pair_distance(
    bodies: FlatBodies, a: int, b: int, poses: Array, far: float, T: Array, work: Array, room: Polytope, points: Array
) -> float:
    """Return the signed distance of two pieces, [m], as `separation` does."""
    return separation(bodies, a, b, poses, far, T, work, room, points)[0]


@unmanaged
def separation(
    bodies: FlatBodies, a: int, b: int, poses: Array, far: float, T: Array, work: Array, room: Polytope, points: Array
) -> tuple[float, Vector]:
    """Return the signed distance of two pieces, [m], and the unit vector in the root along which A moves away from B.

    Where the distance is more than `far`, it is a lower bound that is more, and the vector is zero.

    Args:
        poses: Poses of all pieces in the root, shape (B, 12).
        T, work, room: Work arrays; T has shape (12,), work that of `gjk.WORK`.
        points: The nearest or deepest points of both pieces in the root are written here; shape (6,), [m].
    """
    relative(poses[a], poses[b], T)
    if bodies.kinds[b] == HALF_SPACE:
        distance, normal, x = _above_half_space(bodies, a, b, T, work)
    else:
        radii = bodies.cores[a, 3] + bodies.cores[b, 3]
        # Cores that overlap have a depth, of which this search says nothing.
        limit = max(far + radii, 0.0)
        count, lower, upper = core_distance(bodies, a, b, T, -1.0, limit, work)
        if lower > limit:
            return lower - float(radii), (0.0, 0.0, 0.0)
        # Beside an edge or a face of the simplex the search can stall without a proof that the cores are apart.
        if count == 4 or lower <= 0.0 or upper <= TINY:
            depth, normal, x = core_depth(bodies, a, b, T, count, work, room)
            normal, distance = scaled(-1.0, normal), -depth - radii
        else:
            v = work[NEAREST], work[NEAREST + 1], work[NEAREST + 2]
            normal, distance = scaled(1.0 / upper, v), upper - radii
            x = work[NEAREST + 3], work[NEAREST + 4], work[NEAREST + 5]
    surface = plus(x, -bodies.cores[a, 3], normal)
    _put_point(points, 0, poses[a], surface)
    _put_point(points, 3, poses[a], plus(surface, -distance, normal))
    return distance, turned_by(poses[a], normal)


@inlined
def relative(A: Array, B: Array, T: Array) -> None:
    """Write T_a_b of two poses in the root."""
    for i in range(3):
        for j in range(3):
            T[3 * i + j] = A[i] * B[j] + A[3 + i] * B[3 + j] + A[6 + i] * B[6 + j]
        T[9 + i] = A[i] * (B[9] - A[9]) + A[3 + i] * (B[10] - A[10]) + A[6 + i] * (B[11] - A[11])


@unmanaged
def _above_half_space(bodies: FlatBodies, a: int, b: int, T: Array, work: Array) -> tuple[float, Vector, Vector]:
    """Return the height of A's lowest point above a half-space, the way up, and that point of the core; A's axes."""
    up = turned_by(T, (0.0, 0.0, 1.0))
    # The core of the half-space is the origin of its frame, on its surface.
    w, x = furthest(bodies, a, b, T, scaled(-1.0, up), work)
    return dot(w, up) - bodies.cores[a, 3], up, x


@inlined
def _put_point(points: Array, at: int, pose: Array, x: Vector) -> None:
    turned = turned_by(pose, x)
    points[at], points[at + 1], points[at + 2] = turned[0] + pose[9], turned[1] + pose[10], turned[2] + pose[11]


@unmanaged
def is_near(bodies: FlatBodies, a: int, b: int, most: float, T: Array, work: Array) -> bool:
    """Whether two pieces, T_a_b apart, are at most so far from each other, [m]; ends once a bound decides it."""
    if bodies.kinds[b] == HALF_SPACE:
        return _above_half_space(bodies, a, b, T, work)[0] <= most
    if bodies.kinds[a] == HULL and bodies.kinds[b] == BOX:
        decided = _by_faces(bodies, a, b, most, T)
        if decided:
            return decided > 0
    limit = most + bodies.cores[a, 3] + bodies.cores[b, 3]
    return core_distance(bodies, a, b, T, limit, limit, work)[1] <= float(limit)


@unmanaged
def _by_faces(bodies: FlatBodies, a: int, b: int, most: float, T: Array) -> int:
    """Return 1 if a vertex of hull A is in box B, -1 if all are further than `most` beyond one of its faces, else 0."""
    x, y, z = bodies.cores[b, 0], bodies.cores[b, 1], bodies.cores[b, 2]
    low, high = lanes(math.inf), lanes(-math.inf)
    low_u, low_v, low_w, high_u, high_v, high_w = low, low, low, high, high, high
    for block in range(bodies.blocks[a], bodies.blocks[a + 1]):
        p = load(bodies.vertices, 3 * block) - T[9]
        q = load(bodies.vertices, 3 * block + 1) - T[10]
        r = load(bodies.vertices, 3 * block + 2) - T[11]
        u, v, w = T[0] * p + T[3] * q + T[6] * r, T[1] * p + T[4] * q + T[7] * r, T[2] * p + T[5] * q + T[8] * r
        if bits((abs_lanes(u) <= x) & (abs_lanes(v) <= y) & (abs_lanes(w) <= z)):
            return 1
        low_u, low_v, low_w = min_lanes(u, low_u), min_lanes(v, low_v), min_lanes(w, low_w)
        high_u, high_v, high_w = max_lanes(u, high_u), max_lanes(v, high_v), max_lanes(w, high_w)
    beyond = max(bits(low_u > x + most), bits(low_v > y + most), bits(low_w > z + most))
    below = max(bits(high_u < -x - most), bits(high_v < -y - most), bits(high_w < -z - most))
    return -1 if max(beyond, below) == (1 << LANES) - 1 else 0
