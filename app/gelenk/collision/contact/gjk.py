"""Distance of two convex cores by the algorithm of Gilbert, Johnson and Keerthi [Gilbert1988].

The cores are apart by the distance of the origin from their Minkowski difference A - B. A simplex of points of that
difference comes nearer to the origin step by step. Each step proves two bounds: the simplex contains a point of the
difference, and a plane through its support point leaves all of the difference beyond. So rounding can widen the gap
between the bounds, but not make a wrong answer of it.
"""

import math
from typing import TypeAlias

from gelenk.collision.contact.flat import BLOCK, BOX, CYLINDER, HULL, SEGMENT, FlatBodies
from gelenk.kinematics.simd.lanes import LANES, load, store, where
from gelenk.kinematics.simd.vectors import Vector, cross, dot, minus, plus, scaled
from gelenk.robot.arrays import Array
from gelenk.robot.compilation import inlined, unmanaged

Bounds: TypeAlias = tuple[int, float, float]

VERTEX = 7
"""Numbers of a vertex of the simplex: a point of A - B, the point of A in it, and its weight."""
NEAREST = 4 * VERTEX
"""Where the nearest points are: the vector from B's to A's, and A's, both in A's axes."""
_REGISTERS = 5
"""Row of lanes in which the best vertices of a hull are; the simplex and the nearest points are before it."""
WORK = (_REGISTERS + 2) * LANES
"""Length of the work array."""
GAP, RELATIVE_GAP = 1e-9, 1e-9
"""The search ends where the bounds are as close as this, [m], and relative to the distance."""
TINY = 1e-13
"""Nearer to the origin than this no direction can be found, [m]: the cores touch."""
_MOST_STEPS = 128
_FLAT = 1e-13
"""A tetrahedron with less than this height, relative to its extent, has no inside."""


@inlined
def _core_point(bodies: FlatBodies, i: int, d: Vector, work: Array) -> Vector:
    """Return the point of a core that is furthest along a direction; both in the body's frame."""
    kind, core = bodies.kinds[i], bodies.cores[i]
    if kind == BOX:
        return math.copysign(core[0], d[0]), math.copysign(core[1], d[1]), math.copysign(core[2], d[2])
    if kind == HULL:
        return _hull_point(bodies.vertices, bodies.blocks[i], bodies.blocks[i + 1], d, work)
    if kind == CYLINDER:
        length = math.sqrt(d[0] * d[0] + d[1] * d[1])
        factor = core[0] / length if length > 0.0 else 0.0
        return factor * d[0], factor * d[1], math.copysign(core[2], d[2])
    return 0.0, 0.0, math.copysign(core[2], d[2]) if kind == SEGMENT else 0.0


@unmanaged
def _hull_point(vertices: Array, start: int, end: int, d: Vector, work: Array) -> Vector:
    """Return the vertex that is furthest along a direction, of eight at a time."""
    best = (
        load(vertices, 3 * start) * d[0] + load(vertices, 3 * start + 1) * d[1] + load(vertices, 3 * start + 2) * d[2]
    )
    place = best - best
    for block in range(1, end - start):
        row = 3 * (start + block)
        value = load(vertices, row) * d[0] + load(vertices, row + 1) * d[1] + load(vertices, row + 2) * d[2]
        further = value > best
        best, place = where(further, value, best), where(further, float(block), place)
    store(work, _REGISTERS, best)
    store(work, _REGISTERS + 1, place)
    lane = 0
    for k in range(1, LANES):
        if work[_REGISTERS * LANES + k] > work[_REGISTERS * LANES + lane]:
            lane = k
    first = (start + int(work[(_REGISTERS + 1) * LANES + lane])) * BLOCK + lane
    return vertices[first], vertices[first + LANES], vertices[first + 2 * LANES]


@inlined
def turned_by(T: Array, v: Vector) -> Vector:
    """Return R v of a pose of twelve numbers."""
    return (
        T[0] * v[0] + T[1] * v[1] + T[2] * v[2],
        T[3] * v[0] + T[4] * v[1] + T[5] * v[2],
        T[6] * v[0] + T[7] * v[1] + T[8] * v[2],
    )


@inlined
def turned_back_by(T: Array, v: Vector) -> Vector:
    """Return Rᵀ v of a pose of twelve numbers."""
    return (
        T[0] * v[0] + T[3] * v[1] + T[6] * v[2],
        T[1] * v[0] + T[4] * v[1] + T[7] * v[2],
        T[2] * v[0] + T[5] * v[1] + T[8] * v[2],
    )


@unmanaged
def furthest(bodies: FlatBodies, a: int, b: int, T: Array, d: Vector, work: Array) -> tuple[Vector, Vector]:
    """Return the point of A - B that is furthest along a direction, and the point of A in it; in A's axes.

    `T` is T_a_b, the pose of B's frame in A's, as twelve numbers.
    """
    x = _core_point(bodies, a, d, work)
    y = _core_point(bodies, b, turned_back_by(T, scaled(-1.0, d)), work)
    u = turned_by(T, y)
    return (x[0] - u[0] - T[9], x[1] - u[1] - T[10], x[2] - u[2] - T[11]), x


@unmanaged
def core_distance(bodies: FlatBodies, a: int, b: int, T: Array, near: float, far: float, work: Array) -> Bounds:
    """Return the number of vertices of the last simplex, and a lower and an upper bound of the cores' distance, [m].

    The search ends early once the distance is above `far`, or at most `near`. Four vertices contain the origin: the
    cores overlap. `work` then has the simplex and the nearest points; its length is `WORK`.
    """
    v, count, lower, upper = _between_middles(bodies.boxes[a], bodies.boxes[b], T), 0, 0.0, math.inf
    if dot(v, v) <= TINY * TINY:
        v = (1.0, 0.0, 0.0)
    for _ in range(_MOST_STEPS):
        length = math.sqrt(dot(v, v))
        w, x = furthest(bodies, a, b, T, scaled(-1.0, v), work)
        lower = max(lower, dot(v, w) / length)
        if lower > far or upper - lower <= GAP + RELATIVE_GAP * lower:
            break
        _put(work, count, w, x)
        reduced = _reduce(work, count + 1)
        if reduced == 4:
            return 4, 0.0, 0.0
        nearer, point = _weighted(work, reduced, 0), _weighted(work, reduced, 3)
        square = dot(nearer, nearer)
        if square >= upper * upper:
            break
        v, upper, count = nearer, math.sqrt(square), reduced
        _put_nearest(work, v, point)
        if upper <= near or upper <= TINY:
            break
    return count, min(lower, upper), upper


@inlined
def _between_middles(A: Array, B: Array, T: Array) -> Vector:
    """Return the way from the middle of B's box to that of A's, in A's axes."""
    u = turned_by(T, (B[0] + B[3], B[1] + B[4], B[2] + B[5]))
    return (
        0.5 * (A[0] + A[3] - u[0]) - T[9],
        0.5 * (A[1] + A[4] - u[1]) - T[10],
        0.5 * (A[2] + A[5] - u[2]) - T[11],
    )


@inlined
def _put(work: Array, i: int, w: Vector, x: Vector) -> None:
    k = VERTEX * i
    work[k], work[k + 1], work[k + 2] = w
    work[k + 3], work[k + 4], work[k + 5] = x
    work[k + 6] = 0.0


@inlined
def _put_nearest(work: Array, v: Vector, point: Vector) -> None:
    work[NEAREST], work[NEAREST + 1], work[NEAREST + 2] = v
    work[NEAREST + 3], work[NEAREST + 4], work[NEAREST + 5] = point


@inlined
def vertex(work: Array, i: int, part: int) -> Vector:
    """Return the point of A - B of a vertex (part 0), or that of A (part 3)."""
    k = VERTEX * i + part
    return work[k], work[k + 1], work[k + 2]


@inlined
def _weighted(work: Array, count: int, part: int) -> Vector:
    """Return the sum of the vertices by their weights."""
    total = (0.0, 0.0, 0.0)
    for i in range(count):
        total = plus(total, work[VERTEX * i + 6], vertex(work, i, part))
    return total


@unmanaged
def _reduce(work: Array, count: int) -> int:
    """Weight the vertices so that they give the point nearest to the origin; drop those of weight 0, return the others.

    Four remain where the tetrahedron contains the origin.
    """
    if count == 1:
        work[6] = 1.0
        return 1
    if count == 2:
        _, s, t = _on_segment(vertex(work, 0, 0), vertex(work, 1, 0))
        work[6], work[VERTEX + 6] = s, t
    elif count == 3:
        _, s, t, u = _on_triangle(vertex(work, 0, 0), vertex(work, 1, 0), vertex(work, 2, 0))
        work[6], work[VERTEX + 6], work[2 * VERTEX + 6] = s, t, u
    elif _reduce_tetrahedron(work):
        return 4
    kept = 0
    for i in range(count):
        if work[VERTEX * i + 6] > 0.0:
            for k in range(VERTEX):
                work[VERTEX * kept + k] = work[VERTEX * i + k]
            kept += 1
    return kept


@inlined
def _reduce_tetrahedron(work: Array) -> bool:
    """Weight the vertices by the nearest point of the faces that the origin is beyond; whether it is beyond none."""
    best = math.inf
    for opposite in range(4):
        i, j, k = (opposite + 1) % 4, (opposite + 2) % 4, (opposite + 3) % 4
        a, b, c = vertex(work, i, 0), vertex(work, j, 0), vertex(work, k, 0)
        if not _is_beyond(a, b, c, vertex(work, opposite, 0)):
            continue
        square, s, t, u = _on_triangle(a, b, c)
        if square < best:
            best = square
            work[VERTEX * i + 6], work[VERTEX * j + 6], work[VERTEX * k + 6] = s, t, u
            work[VERTEX * opposite + 6] = 0.0
    return best == math.inf


@inlined
def _is_beyond(a: Vector, b: Vector, c: Vector, d: Vector) -> bool:
    """Whether the origin and vertex d are on different sides of a face; also where the four lie in one plane."""
    normal = cross(minus(b, a), minus(c, a))
    height, other = dot(minus(d, a), normal), -dot(a, normal)
    extent = abs(d[0] - a[0]) + abs(d[1] - a[1]) + abs(d[2] - a[2])
    flat = height * height <= _FLAT * _FLAT * extent * extent * dot(normal, normal)
    return flat or height * other <= 0.0


@inlined
def _on_segment(a: Vector, b: Vector) -> tuple[float, float, float]:
    """Return the squared distance of the nearest point of a segment, and its weights."""
    along = minus(b, a)
    length = dot(along, along)
    t = min(1.0, max(0.0, -dot(a, along) / length)) if length > 0.0 else 0.0
    p = plus(a, t, along)
    return dot(p, p), 1.0 - t, t


@unmanaged
def _on_triangle(a: Vector, b: Vector, c: Vector) -> tuple[float, float, float, float]:
    """Return the squared distance of the nearest point of a triangle, and its weights."""
    ab, ac = minus(b, a), minus(c, a)
    normal = cross(ab, ac)
    square = dot(normal, normal)
    # Weights of the projection: areas of the three parts [Ericson2004, 3.4].
    u, v = dot(cross(b, c), normal), dot(cross(c, a), normal)
    w = square - u - v
    if square > 0.0 and u > 0.0 and v > 0.0 and w > 0.0:
        s, t = u / square, v / square
        r = 1.0 - s - t
        p = plus(plus(scaled(s, a), t, b), r, c)
        return dot(p, p), s, t, r
    best, s, t = _on_segment(a, b)
    r = 0.0
    other, x, y = _on_segment(b, c)
    if other < best:
        best, s, t, r = other, 0.0, x, y
    other, x, y = _on_segment(c, a)
    if other < best:
        best, s, t, r = other, y, 0.0, x
    return best, s, t, r
