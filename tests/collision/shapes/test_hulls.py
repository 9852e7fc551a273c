"""Hulls against scipy's, and always around all of a mesh."""

import numpy as np
import pytest
from scipy.spatial import ConvexHull

from gelenk.collision.shapes.hulls import MAX_VERTICES, convex_hull, few_vertices
from gelenk.collision.shapes.quickhull import quickhull
from gelenk.robot.arrays import Array


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


def test_a_hull_of_few_vertices_stays_as_it_is() -> None:
    hull = convex_hull(cloud(40))
    assert len(hull.vertices) == 40
    assert few_vertices(hull) is hull


@pytest.mark.quick(1)
@pytest.mark.parametrize("seed", range(3))
def test_a_hull_of_many_vertices_gets_few_and_still_contains_all_points(seed: int) -> None:
    points = cloud(3000, seed)
    hull = few_vertices(convex_hull(points))
    assert len(hull.vertices) <= MAX_VERTICES
    assert largest_distance_outside(hull.vertices, points) <= 1e-11
    around = ConvexHull(hull.vertices).volume
    assert hull.volume == pytest.approx(around, rel=1e-6)
    assert 1.0 < around / ConvexHull(points).volume < 1.08


@pytest.mark.parametrize("flatness", [[1.0, 1.0, 0.0], [1.0, 0.0, 0.0], [0.0, 0.0, 0.0], [1.0, 1e-9, 1e-3]])
def test_flat_thin_and_single_points_have_a_hull_around_them(flatness: list[float]) -> None:
    points = np.random.default_rng(2).normal(size=(60, 3)) * flatness
    hull = convex_hull(points)
    assert hull.volume > 0.0
    assert largest_distance_outside(hull.vertices * 1e3, points * 1e3) <= 1e-9
    assert np.ptp(hull.vertices, axis=0).max() <= np.ptp(points, axis=0).max() * (1.0 + 1e-5) + 1e-8


def test_a_finely_drawn_disc_has_a_hull_of_few_vertices() -> None:
    angles = np.linspace(0.0, 2 * np.pi, 600, endpoint=False)
    points = np.array([(np.cos(a), 0.2 * np.sin(a), z) for a in angles for z in (0.0, 0.05)])
    hull = few_vertices(convex_hull(points))
    around = ConvexHull(hull.vertices)
    assert (points @ around.equations[:, :3].T + around.equations[:, 3]).max() < 1e-9
    assert 1.0 <= hull.volume / (0.2 * np.pi * 0.05) < 1.06
    assert len(hull.vertices) <= MAX_VERTICES


def test_points_nearly_on_a_line_do_no_harm() -> None:
    """Quickhull warns of these corners, and cuts of the edges between them: Coal's way to it crashes there."""
    points = np.array(ON_EDGES)
    hull = points[np.unique(quickhull(points))]
    assert 6 <= len(hull) <= len(points)
    assert largest_distance_outside(hull, points) <= 1e-12


def test_points_without_a_hull_are_refused() -> None:
    with pytest.raises(ValueError, match="the points are flat"):
        quickhull(np.eye(3))


ON_EDGES = [
    (-0.38556011943561946, -0.5000000000000004, 0.3530437398009706),
    (-0.24564647051562732, -0.22237945111476842, -0.49693523053314215),
    (-0.22466137350527252, -0.32571284250128024, -0.4995505419582189),
    (-0.22437351217753257, -0.3267475448934607, -0.49957486014469277),
    (-0.22274774451528725, -0.3325733055930929, -0.4997116603332275),
    (-0.2192853223240023, -0.34488096745011243, -0.5000000000000018),
    (0.5000000000000001, -0.07788015627480395, -0.4261695670622035),
    (0.4992776898202502, -0.07150858514751174, -0.4744634990293664),
    (0.49958910716302357, -0.07284981434176857, -0.4744965058779666),
    (0.43736920233098425, 0.19512226480237596, -0.4679018732194868),
    (0.36681871516798414, 0.4989729502178585, -0.4604242895109529),
]
