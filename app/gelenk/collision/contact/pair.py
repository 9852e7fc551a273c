"""Distance of two pieces: of their cores, less the radii around these; negative is the depth."""

from gelenk.collision.contact.flat import HALF_SPACE, FlatBodies
from gelenk.collision.contact.gjk import NEAREST, TINY, core_distance, furthest, turned_by
from gelenk.collision.contact.penetration import Polytope, core_depth
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
    relative(poses, a, b, T)
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
def relative(poses: Array, a: int, b: int, T: Array) -> None:
    """Write T_a_b of two poses in the root."""
    A, B = poses[a], poses[b]
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
def is_near(bodies: FlatBodies, a: int, b: int, poses: Array, most: float, T: Array, work: Array) -> bool:
    """Whether two pieces are at most so far apart, [m]; the search ends once a bound decides it."""
    relative(poses, a, b, T)
    if bodies.kinds[b] == HALF_SPACE:
        return _above_half_space(bodies, a, b, T, work)[0] <= most
    limit = most + bodies.cores[a, 3] + bodies.cores[b, 3]
    return core_distance(bodies, a, b, T, limit, limit, work)[1] <= float(limit)
