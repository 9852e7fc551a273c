"""Depth of two overlapping cores by the expanding polytope [vandenBergen2001].

The depth is the distance of the origin from the surface of the Minkowski difference A - B. A polytope of points of that
difference grows where its surface is nearest to the origin. The distance of that face is a lower bound, that of the
plane through the support point along its normal an upper one: moved by as much along it, the cores are apart.
"""

import math
from typing import NamedTuple

import numpy as np

from gelenk.collision.contact.flat import SEGMENT, FlatBodies
from gelenk.collision.contact.gjk import furthest, turned_by, vertex
from gelenk.kinematics.simd.vectors import Vector, cross, dot, minus, plus, row, scaled
from gelenk.robot.arrays import Array, Indices
from gelenk.robot.compilation import compiled, inlined, unmanaged

GAP = 1e-9
"""The polytope is complete where the bounds of the depth are as close as this, [m], and relative to the depth."""
_VERTICES = 256
_FACES = 4 * _VERTICES
_IN_PLANE = 1e-13
"""A vertex sees a face if it is beyond its plane by more than this, relative to the depth and a metre."""


class Polytope(NamedTuple):
    """Room for a growing polytope.

    Attributes:
        vertices: Points of A - B, and of A in them; shape (_VERTICES, 6), [m].
        faces: Vertices of each face, counter-clockwise from outside; shape (_FACES, 3).
        planes: Outer unit normal of each face, and distance from the origin, infinite of a removed one; (_FACES, 4).
        edges: Edge of what is removed; shape (3 _FACES, 2).
    """

    vertices: Array
    faces: Indices
    planes: Array
    edges: Indices


@compiled
def empty_polytope() -> Polytope:
    """Return room for a polytope."""
    return Polytope(
        np.empty((_VERTICES, 6)),
        np.empty((_FACES, 3), dtype=np.int64),
        np.empty((_FACES, 4)),
        np.empty((3 * _FACES, 2), dtype=np.int64),
    )


@unmanaged
def core_depth(
    bodies: FlatBodies, a: int, b: int, T: Array, count: int, work: Array, room: Polytope
) -> tuple[float, Vector, Vector]:
    """Return the depth of overlapping cores, the direction in which B leaves A, and the deepest point of A; A's axes.

    `work` has the simplex that GJK found, of `count` vertices. The depth is an upper bound in any case, and exact
    within `GAP` unless there is no room left.
    """
    if max(bodies.kinds[a], bodies.kinds[b]) <= SEGMENT:
        return 0.0, _across(bodies, a, b, T), vertex(work, 0, 3)
    for i in range(count):
        _set_vertex(room, i, vertex(work, i, 0), vertex(work, i, 3))
    _complete(bodies, a, b, T, count, work, room)
    used, points = _first_faces(room), 4
    depth, direction, point = math.inf, (0.0, 0.0, 1.0), (0.0, 0.0, 0.0)
    while True:
        face = _nearest_face(room, used)
        normal, height = row(room.planes, face), room.planes[face, 3]
        w, x = furthest(bodies, a, b, T, normal, work)
        beyond = dot(normal, w)
        if beyond < depth:
            depth, direction, point = beyond, normal, _point_of_face(room, face)
        if depth - height <= GAP * (1.0 + depth) or points == _VERTICES or used == _FACES:
            break
        _set_vertex(room, points, w, x)
        used = _expanded(room, used, points)
        points += 1
    return max(depth, 0.0), direction, point


@inlined
def _set_vertex(room: Polytope, i: int, w: Vector, x: Vector) -> None:
    room.vertices[i, 0], room.vertices[i, 1], room.vertices[i, 2] = w
    room.vertices[i, 3], room.vertices[i, 4], room.vertices[i, 5] = x


@unmanaged
def _across(bodies: FlatBodies, a: int, b: int, T: Array) -> Vector:
    """Return a unit vector across the axes of two cores without volume: any displacement along it takes them apart."""
    first = (0.0, 0.0, 1.0)
    second = turned_by(T, (0.0, 0.0, 1.0))
    if bodies.kinds[a] != SEGMENT:
        first = second
    if bodies.kinds[b] != SEGMENT:
        second = first
    normal = cross(first, second)
    if dot(normal, normal) < 1e-20:
        normal = _perpendicular(first)
    return scaled(1.0 / math.sqrt(dot(normal, normal)), normal)


@inlined
def _perpendicular(v: Vector) -> Vector:
    """Return a vector at right angles to another one."""
    x, y, z = abs(v[0]), abs(v[1]), abs(v[2])
    if x <= y and x <= z:
        return cross(v, (1.0, 0.0, 0.0))
    return cross(v, (0.0, 1.0, 0.0)) if y <= z else cross(v, (0.0, 0.0, 1.0))


@unmanaged
def _complete(bodies: FlatBodies, a: int, b: int, T: Array, count: int, work: Array, room: Polytope) -> None:
    """Add vertices to a simplex with less than four, so that it has volume; turn it so that the last is inside."""
    for have in range(count, 4):
        best, found_w, found_x = -1.0, (0.0, 0.0, 0.0), (0.0, 0.0, 0.0)
        for k in range(6):
            d = _spread(room, have, k)
            w, x = furthest(bodies, a, b, T, d, work)
            extent = abs(dot(minus(w, row(room.vertices, 0)), d)) if have else 1.0
            if extent > best:
                best, found_w, found_x = extent, w, x
        _set_vertex(room, have, found_w, found_x)


@inlined
def _spread(room: Polytope, have: int, k: int) -> Vector:
    """Return the k-th of six unit directions across a point, an edge or a triangle."""
    sign = -1.0 if k % 2 else 1.0
    axis = (sign, 0.0, 0.0) if k < 2 else (0.0, sign, 0.0) if k < 4 else (0.0, 0.0, sign)
    if have < 2:
        return axis
    edge = minus(row(room.vertices, 1), row(room.vertices, 0))
    if have == 3:
        normal = cross(edge, minus(row(room.vertices, 2), row(room.vertices, 0)))
        return scaled(sign / math.sqrt(dot(normal, normal)), normal)
    across = _perpendicular(edge)
    if k >= 2:
        other = cross(edge, across)
        c, s = (0.5, math.sqrt(0.75)) if k < 4 else (0.5, -math.sqrt(0.75))
        lengths = math.sqrt(dot(across, across)), math.sqrt(dot(other, other))
        across = plus(scaled(c / lengths[0], across), s / lengths[1], other)
    return scaled(sign / math.sqrt(dot(across, across)), across)


@unmanaged
def _first_faces(room: Polytope) -> int:
    """Set the faces of the tetrahedron, each seen from outside; return their number."""
    a, b, c, d = row(room.vertices, 0), row(room.vertices, 1), row(room.vertices, 2), row(room.vertices, 3)
    is_inside_out = dot(minus(d, a), cross(minus(b, a), minus(c, a))) > 0.0
    faces = ((0, 1, 2), (0, 3, 1), (1, 3, 2), (2, 3, 0))
    for i in range(4):
        x, y, z = faces[i]
        _set_face(room, i, x, z if is_inside_out else y, y if is_inside_out else z)
    return 4


@inlined
def _set_face(room: Polytope, i: int, x: int, y: int, z: int) -> None:
    room.faces[i, 0], room.faces[i, 1], room.faces[i, 2] = x, y, z
    p = row(room.vertices, x)
    normal = cross(minus(row(room.vertices, y), p), minus(row(room.vertices, z), p))
    length = math.sqrt(dot(normal, normal))
    if length > 0.0:
        normal = scaled(1.0 / length, normal)
    room.planes[i, 0], room.planes[i, 1], room.planes[i, 2] = normal
    # A face without area is never the nearest one, but a neighbour of others.
    room.planes[i, 3] = dot(normal, p) if length > 0.0 else 1e300


@inlined
def _nearest_face(room: Polytope, used: int) -> int:
    nearest = 0
    for i in range(1, used):
        if room.planes[i, 3] < room.planes[nearest, 3]:
            nearest = i
    return nearest


@unmanaged
def _expanded(room: Polytope, used: int, new: int) -> int:
    """Replace the faces that a new vertex sees by those from it to their edge; return the number of places in use."""
    w, edges = row(room.vertices, new), 0
    for i in range(used):
        height = room.planes[i, 3]
        if height == math.inf or not dot(row(room.planes, i), w) > height + _IN_PLANE * (1.0 + abs(height)):
            continue
        room.planes[i, 3] = math.inf
        for k in range(3):
            edges = _toggled(room, edges, room.faces[i, k], room.faces[i, (k + 1) % 3])
    place = 0
    for e in range(edges):
        while place < used and room.planes[place, 3] != math.inf:
            place += 1
        if place == _FACES:
            break
        _set_face(room, place, room.edges[e, 0], room.edges[e, 1], new)
        used = max(used, place + 1)
    return used


@inlined
def _toggled(room: Polytope, edges: int, i: int, j: int) -> int:
    """Add an edge to the list, or remove it if it is there from its other side; return the length."""
    for e in range(edges):
        if room.edges[e, 0] == j and room.edges[e, 1] == i:
            room.edges[e, 0], room.edges[e, 1] = room.edges[edges - 1, 0], room.edges[edges - 1, 1]
            return edges - 1
    room.edges[edges, 0], room.edges[edges, 1] = i, j
    return edges + 1


@unmanaged
def _point_of_face(room: Polytope, face: int) -> Vector:
    """Return the point of A where the perpendicular from the origin meets a face."""
    i, j, k = room.faces[face, 0], room.faces[face, 1], room.faces[face, 2]
    a, b, c = row(room.vertices, i), row(room.vertices, j), row(room.vertices, k)
    normal, height = row(room.planes, face), room.planes[face, 3]
    foot = scaled(height, normal)
    area = dot(cross(minus(b, a), minus(c, a)), normal)
    s = dot(cross(minus(b, foot), minus(c, foot)), normal) / area
    t = dot(cross(minus(c, foot), minus(a, foot)), normal) / area
    parts = _part(room, i), _part(room, j), _part(room, k)
    return plus(plus(scaled(s, parts[0]), t, parts[1]), 1.0 - s - t, parts[2])


@inlined
def _part(room: Polytope, i: int) -> Vector:
    return room.vertices[i, 3], room.vertices[i, 4], room.vertices[i, 5]
