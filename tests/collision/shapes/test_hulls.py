"""Hulls against scipy's, and always around all of a mesh."""

import math

import numpy as np
import pytest
from scipy.spatial import ConvexHull

from gelenk.collision.shapes.hulls import MAX_VERTICES, convex_hull, enclosed_volume, hull_of, parts_of
from gelenk.robot.arrays import Array


def triangles_of(points: Array) -> Array:
    hull = ConvexHull(points)
    found = points[hull.simplices]
    out = (np.cross(found[:, 1] - found[:, 0], found[:, 2] - found[:, 0]) * hull.equations[:, :3]).sum(axis=1) > 0
    found[~out] = found[~out][:, ::-1]
    return np.asarray(found)


def cloud(count: int, seed: int = 0) -> Array:
    directions = np.random.default_rng(seed).normal(size=(count, 3))
    directions /= np.linalg.norm(directions, axis=1, keepdims=True)
    return np.asarray(directions * [0.3, 0.1, 0.05] + [1.0, -2.0, 0.5])


def largest_distance_outside(vertices: Array, points: Array) -> float:
    equations = ConvexHull(vertices).equations
    return float((points @ equations[:, :3].T + equations[:, 3]).max())


def test_a_hull_is_scipys() -> None:
    points = np.random.default_rng(1).normal(size=(500, 3)) * [1.0, 1e-2, 1e-3]
    ours, theirs = convex_hull(points), ConvexHull(points)
    assert len(ours.vertices) == len(theirs.vertices)
    assert ours.volume == pytest.approx(theirs.volume, rel=1e-9)


def test_a_hull_of_few_vertices_has_no_excess() -> None:
    vertices, excess = hull_of(triangles_of(cloud(40)))
    assert len(vertices) == 40
    assert excess == pytest.approx(0.0, abs=1e-9)


@pytest.mark.quick(1)
@pytest.mark.parametrize("seed", range(3))
def test_a_hull_of_many_vertices_gets_few_and_still_contains_all_points(seed: int) -> None:
    points = cloud(3000, seed)
    vertices, excess = hull_of(triangles_of(points))
    assert len(vertices) <= MAX_VERTICES
    assert largest_distance_outside(vertices, points) <= 1e-12
    assert excess == pytest.approx(ConvexHull(vertices).volume / ConvexHull(points).volume - 1.0, rel=1e-6)
    assert 0.0 < excess < 0.08


@pytest.mark.parametrize("flatness", [[1.0, 1.0, 0.0], [1.0, 0.0, 0.0], [0.0, 0.0, 0.0], [1.0, 1e-9, 1e-3]])
def test_flat_thin_and_single_points_have_a_hull_around_them(flatness: list[float]) -> None:
    points = np.random.default_rng(2).normal(size=(60, 3)) * flatness
    hull = convex_hull(points)
    assert hull.volume > 0.0
    assert largest_distance_outside(hull.vertices * 1e3, points * 1e3) <= 1e-9
    assert np.ptp(hull.vertices, axis=0).max() <= np.ptp(points, axis=0).max() * (1.0 + 1e-5) + 1e-8


def test_a_finely_drawn_disc_gets_a_hull_slightly_larger() -> None:
    """Quickhull refuses vertices with more than 255 edges."""
    angles = np.linspace(0.0, 2 * np.pi, 600, endpoint=False)
    points = np.array([(np.cos(a), 0.2 * np.sin(a), z) for a in angles for z in (0.0, 0.05)])
    hull = convex_hull(points)
    around = ConvexHull(hull.vertices)
    assert (points @ around.equations[:, :3].T + around.equations[:, 3]).max() < 1e-9
    assert 1.0 <= hull.volume / (0.2 * np.pi * 0.05) < 1.06
    assert len(hull.vertices) < 400


def test_parts_share_no_corner() -> None:
    boxes = [triangles_of(np.array(np.meshgrid([0, 1], [0, 1], [3 * i, 3 * i + 1])).reshape(3, -1).T) for i in range(4)]
    parts = parts_of(np.concatenate(boxes)[np.random.default_rng(0).permutation(48)])
    assert sorted(len(part) for part in parts) == [12] * 4
    assert [hull_of(part)[1] for part in parts] == pytest.approx([0.0] * 4, abs=1e-9)


def test_a_mesh_of_too_many_parts_is_one() -> None:
    lone = np.eye(3) + 5.0 * np.arange(17)[:, None, None]
    assert [len(part) for part in parts_of(lone)] == [17]


def test_the_volume_of_an_open_or_turned_mesh_is_unknown() -> None:
    closed = triangles_of(cloud(50))
    assert enclosed_volume(closed) == pytest.approx(ConvexHull(cloud(50)).volume, rel=1e-9)
    assert math.isnan(enclosed_volume(closed[1:]))
    closed[0] = closed[0, ::-1]
    assert math.isnan(enclosed_volume(closed))
    assert math.isnan(hull_of(closed)[1])
