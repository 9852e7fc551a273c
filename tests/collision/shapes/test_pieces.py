"""Pieces of meshes: all of each triangle is in one, and concave meshes fill few."""

import math

import numpy as np
import pytest
from scipy.sparse import coo_matrix
from scipy.sparse.csgraph import connected_components
from scipy.spatial import ConvexHull

from gelenk.collision.shapes import planes, surfaces
from gelenk.collision.shapes.pieces import MAX_PIECES, _Chunk, pieces_of
from gelenk.collision.shapes.planes import best_plane
from gelenk.collision.shapes.surfaces import Surface, cut, enclosed_volume, parts_of, surface_of
from gelenk.robot.arrays import Array
from gelenk.robot.notations import rotations_from_vectors

TURN = rotations_from_vectors(np.array([[0.3, -1.0, 0.5]]))[0]


def triangles_of(points: Array) -> Array:
    """The hull's triangles, seen from outside in one sense of rotation."""
    hull = ConvexHull(points)
    found = points[hull.simplices]
    out = (np.cross(found[:, 1] - found[:, 0], found[:, 2] - found[:, 0]) * hull.equations[:, :3]).sum(axis=1) > 0
    found[~out] = found[~out][:, ::-1]
    return np.asarray(found)


def box(low: tuple[float, float, float], high: tuple[float, float, float]) -> Array:
    return triangles_of(np.array(np.meshgrid(*zip(low, high, strict=True))).reshape(3, -1).T)


def prism(outline: Array, height: float) -> Array:
    """A closed prism above an outline, seen counter-clockwise, whose first corner sees all others."""
    count = len(outline)
    low, high = (np.column_stack((outline, np.full(count, z))) for z in (0.0, height))
    following = np.roll(np.arange(count), -1)
    fans = [(0, k, k + 1) for k in range(1, count - 1)]
    sides = [np.stack((low, low[following], high[following]), 1), np.stack((low, high[following], high), 1)]
    return np.concatenate([*sides, high[fans], low[fans][:, ::-1]])


BRACKET = prism(np.array([[0.1, 0.1], [0.1, 0.4], [0.0, 0.4], [0.0, 0.0], [0.4, 0.0], [0.4, 0.1]]), 0.1)


def ring(count: int = 24) -> Array:
    """A torus of radius 1 m and thickness 0.2 m."""
    u, v = np.meshgrid(*[2 * np.pi * np.arange(n) / n for n in (count, 8)], indexing="ij")
    points = np.stack(((1 + 0.1 * np.cos(v)) * np.cos(u), (1 + 0.1 * np.cos(v)) * np.sin(u), 0.1 * np.sin(v)), -1)
    beside, above = np.roll(points, -1, 0), np.roll(points, -1, 1)
    both = np.roll(beside, -1, 1)
    quads = [np.stack(corners, -2).reshape(-1, 3, 3) for corners in ((points, beside, both), (points, both, above))]
    return np.concatenate(quads)


def outside(triangles: Array, pieces: list[tuple[Array, float]]) -> float:
    """How far the worst of points drawn on the triangles, and of their corners, is from all pieces."""
    random = np.random.default_rng(0)
    weights = np.concatenate(
        (random.dirichlet(np.ones(3), (200, len(triangles))), np.eye(3)[:, None].repeat(len(triangles), 1))
    )
    points = np.einsum("sfk,fkd->sfd", weights, triangles).reshape(-1, 3)
    hulls = [ConvexHull(vertices).equations for vertices, _ in pieces]
    return float(np.min([(points @ planes[:, :3].T + planes[:, 3]).max(axis=1) for planes in hulls], axis=0).max())


MESHES = {"bracket": BRACKET, "turned": BRACKET @ TURN.T + [5.0, 0.0, 1.0], "ring": ring(), "open": ring()[:-24]}


@pytest.mark.parametrize("name", MESHES)
def test_all_of_a_mesh_is_in_its_pieces(name: str) -> None:
    pieces = pieces_of(MESHES[name])
    assert 2 <= len(pieces) <= MAX_PIECES
    assert outside(MESHES[name], pieces) <= 1e-9
    hull = ConvexHull(MESHES[name].reshape(-1, 3)).volume
    assert sum(ConvexHull(vertices).volume for vertices, _ in pieces) < 0.75 * hull


def test_pieces_do_not_depend_on_how_a_mesh_is_turned() -> None:
    plain, turned = (np.sort([excess for _, excess in pieces_of(MESHES[name])]) for name in ("bracket", "turned"))
    np.testing.assert_allclose(plain, turned, atol=1e-6)
    assert plain.max() < 0.15


def test_a_convex_mesh_is_one_piece_and_has_no_excess() -> None:
    ((vertices, excess),) = pieces_of(box((0, 0, 0), (1, 2, 3)))
    assert len(vertices) == 8
    assert excess == pytest.approx(0.0, abs=1e-9)


def test_the_excess_is_that_of_all_pieces_of_a_part() -> None:
    pieces = pieces_of(np.concatenate((ring(), box((5, 5, 5), (5.5, 5.5, 5.5)))))
    found = [(ConvexHull(vertices).volume, excess) for vertices, excess in pieces]
    (of_box,) = (volume for volume, excess in found if excess < 1e-9)
    assert of_box == pytest.approx(0.125)
    others = [(volume, excess) for volume, excess in found if excess >= 1e-9]
    expected = sum(volume for volume, _ in others) / enclosed_volume(surface_of(ring())) - 1.0
    assert [excess for _, excess in others] == pytest.approx([expected] * (len(pieces) - 1), rel=1e-6)


def test_parts_share_no_corner() -> None:
    boxes = np.concatenate([box((0, 0, 3 * i), (1, 1, 3 * i + 1)) for i in range(4)])
    parts = parts_of(surface_of(boxes[np.random.default_rng(0).permutation(48)]))
    assert [(len(part.points), len(part.faces)) for part in parts] == [(8, 12)] * 4
    assert [enclosed_volume(part) for part in parts] == pytest.approx([1.0] * 4)


def test_corners_of_chains_of_triangles_are_one_part() -> None:
    faces = np.random.default_rng(2).permutation(600)[:540].reshape(-1, 3)
    faces[:60, 1] = faces[60:120, 2]
    edges = np.concatenate((faces[:, :2], faces[:, 1:]))
    graph = coo_matrix((np.ones(len(edges)), edges.T), shape=(600, 600))
    expected = connected_components(graph)[1][faces[:, 0]]
    found = parts_of(Surface(np.arange(1800.0).reshape(-1, 3), faces))
    assert sorted(len(part.faces) for part in found) == sorted(np.unique(expected, return_counts=True)[1])


def test_a_plane_parts_a_bracket_at_its_corner() -> None:
    axis, offset = best_plane(surface_of(BRACKET), np.eye(3))
    assert axis in {0, 1}
    assert offset == pytest.approx(0.1, abs=1e-5)


def test_reaches_are_those_of_both_sides_of_a_plane() -> None:
    surface, offsets = surface_of(ring() @ TURN.T), np.array([-0.5, 0.1, 0.4])
    along, heights = surface.points[:, 0].copy(), surface.points @ TURN
    within, cuts = planes._reaches(along, np.searchsorted(offsets, along), heights, surface.faces, offsets)
    for k, offset in enumerate(offsets):
        for side, own in zip(cut(surface, np.eye(3)[0], offset), (within[: k + 1], within[k + 1 :]), strict=True):
            np.testing.assert_allclose(np.maximum(own.max(axis=0), cuts[k]), (side.points @ TURN).max(axis=0))


def test_what_cuts_can_save_is_what_is_outside_of_a_closed_part() -> None:
    whole = _Chunk(0, surface_of(ring()), TURN.T, np.zeros((3, 2), dtype=bool))
    sides = [part for half in whole.middles for part in half.halves]
    within = [part.hull.volume - part.could_save for part in (whole, *sides)]
    assert within[0] == pytest.approx(enclosed_volume(surface_of(ring())))
    assert within[0] == pytest.approx(sum(within[1:]))
    assert all(part.saved <= part.could_save for part in (whole, *sides))


def test_many_parts_are_cut_as_one() -> None:
    corners = [(3 * max(i - 8, 0), 3 * min(i, 8), 0) for i in range(MAX_PIECES + 1)]
    boxes = np.concatenate([box((x, y, z), (x + 1, y + 1, z + 1)) for x, y, z in corners])
    pieces = pieces_of(boxes)
    assert 2 <= len(pieces) <= MAX_PIECES
    assert outside(boxes, pieces) <= 1e-9
    assert sum(ConvexHull(vertices).volume for vertices, _ in pieces) < 0.8 * ConvexHull(boxes.reshape(-1, 3)).volume


@pytest.mark.parametrize("flatness", [(1.0, 1.0, 0.0), (1.0, 0.0, 0.0), (0.0, 0.0, 0.0), (1.0, 1e-12, 1e-3)])
def test_flat_meshes_have_pieces_around_them(flatness: tuple[float, float, float]) -> None:
    triangles = ring(12) * flatness
    pieces = pieces_of(triangles)
    assert outside(triangles * 1e3, [(vertices * 1e3, excess) for vertices, excess in pieces]) <= 1e-9


def test_the_volume_of_an_open_or_turned_mesh_is_unknown() -> None:
    closed = ring()
    volume = enclosed_volume(surface_of(closed))
    area = 8 / 2 * math.sin(2 * math.pi / 8) * 0.1**2
    assert volume == pytest.approx(area * 24 * math.sin(2 * math.pi / 24), rel=1e-2)
    assert math.isnan(enclosed_volume(surface_of(closed[1:])))
    closed[0] = closed[0, ::-1]
    assert math.isnan(enclosed_volume(surface_of(closed)))
    assert all(math.isnan(excess) for _, excess in pieces_of(closed))


def test_both_sides_of_a_plane_make_up_a_surface() -> None:
    surface, normal, offset = surface_of(ring()), TURN[0], 0.1
    below, above = cut(surface, normal, offset)
    assert (below.points @ normal).max() == pytest.approx(offset, abs=1e-12)
    assert (above.points @ normal).min() == pytest.approx(offset, abs=1e-12)
    areas = [
        np.linalg.norm(np.cross(*np.diff(one.points[one.faces], axis=1).swapaxes(0, 1)), axis=1).sum()
        for one in (surface, below, above)
    ]
    assert areas[1] + areas[2] == pytest.approx(areas[0])
    assert min(areas[1:]) > 0.2 * areas[0]


def test_a_plane_beside_a_surface_leaves_it_whole() -> None:
    surface = surface_of(BRACKET)
    below, above = cut(surface, np.array([0.0, 0.0, 1.0]), 0.1)
    assert (len(below.faces), len(above.faces)) == (len(surface.faces), 0)


def test_corners_with_the_same_key_stay_apart(monkeypatch: pytest.MonkeyPatch) -> None:
    monkeypatch.setattr(surfaces, "_HASH", np.zeros(3, dtype=np.uint64))
    assert len(surface_of(BRACKET).points) == 12
