"""The bodies, joints and pairs of a robot and its scene as flat arrays for the kernels."""

from collections.abc import Sequence
from typing import NamedTuple, TypeAlias

import numpy as np

from gelenk.collision.bodies import Body
from gelenk.kinematics.simd.lanes import LANES
from gelenk.robot.arrays import Array, Indices

POINT, SEGMENT, CYLINDER, BOX, HULL, HALF_SPACE = range(6)
"""Kinds of cores: a piece is its core, and all within a radius around it."""
_CORES = {
    "sphere": POINT,
    "capsule": SEGMENT,
    "cylinder": CYLINDER,
    "box": BOX,
    "convex": HULL,
    "half_space": HALF_SPACE,
}
BLOCK = 3 * LANES
"""Numbers of a block of vertices: x, then y, then z, of as many as a register holds."""

Placed: TypeAlias = tuple[Body, int, Array]
"""A piece, the number of the node that carries it, and T_node_link."""


class FlatBodies(NamedTuple):
    """B pieces, each in the frame of the node that carries it; node 0 is the robot's root.

    Attributes:
        kinds: Kind of the core; shape (B,).
        nodes: Number of the node of each piece, then of each link or object; shape (B + L,).
        cores: Half sizes of the core along its x, y, z, and the radius around it, [m]; shape (B, 4).
        poses: T_node_body: rotation row by row, then translation, [m]; shape (B, 12).
        vertices: Vertices of all hulls in blocks of `BLOCK` numbers; the last vertex fills a block up.
        blocks: Number of the first block of each piece, and of the end; shape (B + 1,).
        balls: Centre in the node, and radius, of a sphere around each whole piece, then around all pieces of each link
            or object; shape (B + L, 4), [m].
        boxes: Lowest and highest corner of a box around each piece, along its own axes; shape (B, 6), [m].
        covers: Spheres whose union contains a piece: centres in the node, and radii; shape (S, 4), [m].
        covered: Number of the first sphere of each piece, and of the end; shape (B + 1,).
    """

    kinds: Indices
    nodes: Indices
    cores: Array
    poses: Array
    vertices: Array
    blocks: Indices
    balls: Array
    boxes: Array
    covers: Array
    covered: Indices


def flat_bodies(bodies: list[Placed], parts: Sequence[Sequence[int]] = ()) -> FlatBodies:
    """Flatten pieces with their places; `parts` are the numbers of those of each link or object, all on one node."""
    placed = [T_node_link @ body.T_link_body for body, _, T_node_link in bodies]
    boxes = [_box(body) for body, _, _ in bodies]
    balls = [_ball(box, T, body) for box, T, (body, _, _) in zip(boxes, placed, bodies, strict=True)]
    blocks = [_vertex_blocks(body.points) for body, _, _ in bodies]
    covers = [_moved_spheres(body.spheres, T_node_link) for body, _, T_node_link in bodies]
    return FlatBodies(
        np.array([_CORES[body.kind] for body, _, _ in bodies], dtype=np.int64),
        np.array([bodies[i][1] for i in [*range(len(bodies)), *(some[0] for some in parts)]], dtype=np.int64),
        np.array([_core(body) for body, _, _ in bodies]).reshape(-1, 4),
        np.array([np.append(T[:3, :3], T[:3, 3]) for T in placed]).reshape(-1, 12),
        np.concatenate([np.zeros(0), *blocks]),
        _starts([len(one) // BLOCK for one in blocks]),
        np.array(balls + [_around([balls[i] for i in some]) for some in parts]).reshape(-1, 4),
        np.array(boxes).reshape(-1, 6),
        np.concatenate([np.zeros((0, 4)), *covers]),
        _starts([len(one) for one in covers]),
    )


def _starts(lengths: list[int]) -> Indices:
    return np.concatenate([[0], np.cumsum(lengths)]).astype(np.int64)


def _core(body: Body) -> tuple[float, float, float, float]:
    """Half sizes of the core, and the radius around it."""
    match body.kind, body.size:
        case "sphere", (r,):
            return 0.0, 0.0, 0.0, r
        case "capsule", (r, length):
            return 0.0, 0.0, 0.5 * length, r
        case "cylinder", (r, length):
            return r, r, 0.5 * length, 0.0
        case "box", (x, y, z):
            return 0.5 * x, 0.5 * y, 0.5 * z, 0.0
        case _:
            return 0.0, 0.0, 0.0, 0.0


def _box(body: Body) -> Array:
    """Lowest and highest corner of the box around a piece."""
    if body.kind == "convex":
        return np.concatenate((body.points.min(axis=0), body.points.max(axis=0)))
    if body.kind == "half_space":
        return np.array([-np.inf, -np.inf, -np.inf, np.inf, np.inf, 0.0])
    x, y, z, r = _core(body)
    return np.array([-x - r, -y - r, -z - r, x + r, y + r, z + r])


def _ball(box: Array, T_node_body: Array, body: Body) -> Array:
    """Centre in the node, and radius, of a sphere around a piece; the radius of a half-space is infinite."""
    if body.kind == "half_space":
        return np.append(T_node_body[:3, 3], np.inf)
    middle = 0.5 * (box[:3] + box[3:])
    match body.kind:
        case "convex":
            radius = float(np.linalg.norm(body.points - middle, axis=1).max())
        case "box":
            radius = float(np.linalg.norm(box[3:]))
        case "cylinder":
            radius = float(np.hypot(box[3], box[5]))
        case _:
            radius = float(box[5])
    return np.append(T_node_body[:3, :3] @ middle + T_node_body[:3, 3], radius)


def _around(balls: list[Array]) -> Array:
    """Centre and radius of a ball around others."""
    if len(balls) == 1:
        return balls[0]
    centres, radii = np.array(balls)[:, :3], np.array(balls)[:, 3:]
    middle = 0.5 * ((centres - radii).min(axis=0) + (centres + radii).max(axis=0))
    return np.append(middle, (1.0 + 1e-9) * (np.linalg.norm(centres - middle, axis=1) + radii[:, 0]).max())


def _vertex_blocks(points: Array) -> Array:
    if not len(points):
        return np.zeros(0)
    filled = np.concatenate((points, np.repeat(points[-1:], -len(points) % LANES, axis=0)))
    return np.ascontiguousarray(filled.reshape(-1, LANES, 3).transpose(0, 2, 1)).ravel()


def _moved_spheres(spheres: Array, T_node_link: Array) -> Array:
    centres = spheres[:, :3] @ T_node_link[:3, :3].T + T_node_link[:3, 3]
    return np.column_stack((centres, spheres[:, 3]))
