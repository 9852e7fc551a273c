"""The bodies, joints and pairs of a robot and its scene as flat arrays for the kernels."""

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
        kinds, nodes: Kind of the core, and number of the node; shape (B,).
        cores: Half sizes of the core along its x, y, z, and the radius around it, [m]; shape (B, 4).
        poses: T_node_body: rotation row by row, then translation, [m]; shape (B, 12).
        vertices: Vertices of all hulls in blocks of `BLOCK` numbers; the last vertex fills a block up.
        blocks: Number of the first block of each piece, and of the end; shape (B + 1,).
        balls: Centre in the node, and radius, of a sphere around the whole piece; shape (B, 4), [m].
        boxes: Centre and half sizes of a box around it, along its own axes; shape (B, 6), [m].
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


def flat_bodies(bodies: list[Placed]) -> FlatBodies:
    """Flatten pieces with their places."""
    placed = [T_node_link @ body.T_link_body for body, _, T_node_link in bodies]
    boxes = [_box(body) for body, _, _ in bodies]
    blocks = [_vertex_blocks(body.points) for body, _, _ in bodies]
    covers = [_moved_spheres(body.spheres, T_node_link) for body, _, T_node_link in bodies]
    return FlatBodies(
        np.array([_CORES[body.kind] for body, _, _ in bodies], dtype=np.int64),
        np.array([node for _, node, _ in bodies], dtype=np.int64),
        np.array([_core(body) for body, _, _ in bodies]).reshape(-1, 4),
        np.array([np.append(T[:3, :3], T[:3, 3]) for T in placed]).reshape(-1, 12),
        np.concatenate([np.zeros(0), *blocks]),
        _starts([len(one) // BLOCK for one in blocks]),
        np.array([_ball(box, T, body) for box, T, (body, _, _) in zip(boxes, placed, bodies, strict=True)]).reshape(
            -1, 4
        ),
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
    """Centre and half sizes of the box around a piece."""
    if body.kind == "convex":
        low, high = body.points.min(axis=0), body.points.max(axis=0)
        return np.concatenate((0.5 * (low + high), 0.5 * (high - low)))
    x, y, z, r = _core(body)
    return np.array([0.0, 0.0, 0.0, x + r, y + r, z + r])


def _ball(box: Array, T_node_body: Array, body: Body) -> Array:
    """Centre in the node, and radius, of a sphere around a piece; the radius of a half-space is infinite."""
    centre = T_node_body[:3, :3] @ box[:3] + T_node_body[:3, 3]
    match body.kind:
        case "convex":
            radius = float(np.linalg.norm(body.points - box[:3], axis=1).max())
        case "half_space":
            radius = np.inf
        case "box":
            radius = float(np.linalg.norm(box[3:]))
        case "cylinder":
            radius = float(np.hypot(box[3], box[5]))
        case _:
            radius = float(box[5])
    return np.append(centre, radius)


def _vertex_blocks(points: Array) -> Array:
    if not len(points):
        return np.zeros(0)
    filled = np.concatenate((points, np.repeat(points[-1:], -len(points) % LANES, axis=0)))
    return np.ascontiguousarray(filled.reshape(-1, LANES, 3).transpose(0, 2, 1)).ravel()


def _moved_spheres(spheres: Array, T_node_link: Array) -> Array:
    centres = spheres[:, :3] @ T_node_link[:3, :3].T + T_node_link[:3, 3]
    return np.column_stack((centres, spheres[:, 3]))
