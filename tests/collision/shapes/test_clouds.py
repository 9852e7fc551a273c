"""Pieces of clouds contain the sphere around every point, and reach no further beyond them than is said."""

import numpy as np
import pytest
from scipy.spatial import cKDTree

from gelenk.collision.bodies import Body
from gelenk.collision.shapes.clouds import MAX_PIECES, cloud_bodies
from gelenk.robot.arrays import Array
from gelenk.robot.notations import placement

T = placement((0.3, -0.2, 0.5), (0.4, -1.0, 2.0))
RADIUS = 0.004


def scan(count: int) -> Array:
    """Points on a wavy table and a ball."""
    random = np.random.default_rng(1)
    table = random.uniform(-0.5, 0.5, (count // 2, 3))
    table[:, 2] = 0.01 * np.sin(9.0 * table[:, 0])
    ball = random.normal(size=(count - len(table), 3))
    return np.concatenate((table, 0.1 * ball / np.linalg.norm(ball, axis=1, keepdims=True)))


def boxes_of(bodies: list[Body]) -> tuple[Array, Array]:
    """Centres in the cloud's frame, and half sizes."""
    centres = np.array([(np.linalg.inv(T) @ body.T_link_body)[:3, 3] for body in bodies])
    return centres, np.array([body.size for body in bodies]) / 2


def test_each_of_a_few_points_is_a_sphere() -> None:
    points = scan(500)
    bodies, excess = cloud_bodies("scan", "base", points, RADIUS, T)
    assert ({body.kind for body in bodies}, {body.size for body in bodies}, excess) == ({"sphere"}, {(RADIUS,)}, 0.0)
    np.testing.assert_allclose([body.T_link_body[:3, 3] for body in bodies], points @ T[:3, :3].T + T[:3, 3])


@pytest.mark.slow
def test_many_points_are_in_boxes_that_reach_no_further_than_is_said() -> None:
    points = scan(40_000)
    bodies, excess = cloud_bodies("scan", "base", points, RADIUS, T)
    assert 1000 < len(bodies) <= MAX_PIECES
    centres, halves = boxes_of(bodies)
    _, near = cKDTree(centres).query(points, k=40)
    outside = (np.abs(points[:, None] - centres[near]) + RADIUS - halves[near]).max(axis=2).min(axis=1)
    assert outside.max() <= 1e-12
    shares = np.random.default_rng(2).choice((-1.0, 1.0, 0.3), (8, len(bodies), 3))
    beyond = cKDTree(points).query((centres + shares * halves).reshape(-1, 3))[0] - RADIUS
    assert 0.3 * excess < beyond.max() <= excess < 0.05
    for body in bodies[::100]:
        corners = np.array(np.meshgrid(*[(-size / 2, size / 2) for size in body.size])).reshape(3, -1)
        placed = (body.T_link_body[:3, :3] @ corners).T + body.T_link_body[:3, 3]
        assert np.linalg.norm(placed - body.spheres[0, :3], axis=1).max() <= body.spheres[0, 3]


@pytest.mark.parametrize("spread", [0.0, 1e-9, 1e6])
def test_points_in_one_place_or_far_apart(spread: float) -> None:
    points = np.full((MAX_PIECES + 1, 3), 7.0)
    points[-1] += spread
    bodies, _ = cloud_bodies("scan", "base", points, RADIUS, T)
    assert len(bodies) == (2 if spread else 1)
    assert min(min(body.size) for body in bodies) >= 2 * RADIUS - 1e-9
