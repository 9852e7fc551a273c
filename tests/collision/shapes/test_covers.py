"""Every point of a piece is in one of its spheres: sampled, on its surface too."""

import numpy as np
import pytest

from gelenk.collision.bodies import PieceKind
from gelenk.collision.shapes.covers import MAX_SPHERES, cover
from gelenk.collision.shapes.hulls import convex_hull
from gelenk.robot.arrays import Array

NOTHING = np.empty((0, 3))
HULL = convex_hull(np.random.default_rng(5).normal(size=(80, 3)) * [0.4, 0.1, 0.02] + [0.3, 0.0, -2.0]).vertices
PIECES: list[tuple[PieceKind, tuple[float, ...], Array]] = [
    ("sphere", (0.2,), NOTHING),
    ("capsule", (0.1, 0.8), NOTHING),
    ("capsule", (0.1, 0.0), NOTHING),
    ("capsule", (0.001, 2.0), NOTHING),
    ("cylinder", (0.1, 0.8), NOTHING),
    ("cylinder", (0.5, 0.01), NOTHING),
    ("box", (1.0, 0.3, 0.02), NOTHING),
    ("box", (2.0, 2.0, 2.0), NOTHING),
    ("convex", (), HULL),
]


def points_of(kind: PieceKind, size: tuple[float, ...], points: Array) -> Array:
    """Sample a piece, half of the points on its surface."""
    random = np.random.default_rng(0)
    shares = random.uniform(-1.0, 1.0, (20_000, 3))
    directions = random.normal(size=(20_000, 3))
    directions /= np.linalg.norm(directions, axis=1, keepdims=True)
    scale = np.where(np.arange(20_000) % 2, 1.0, random.uniform(size=20_000))[:, None]
    if kind == "box":
        shares[np.arange(20_000), random.integers(3, size=20_000)] = np.sign(shares[:, 0])
        return np.asarray(shares * np.array(size) / 2 * scale)
    if kind == "cylinder":
        across = directions[:, :2] / np.linalg.norm(directions[:, :2], axis=1, keepdims=True)
        return np.column_stack((across * size[0] * scale, np.sign(shares[:, 2]) * size[1] / 2 * shares[:, 1:2].T[0]))
    if kind == "convex":
        weights = random.dirichlet(np.full(len(points), 0.02), 20_000)
        return np.concatenate((weights @ points, points))
    axis = np.array([0.0, 0.0, size[1] / 2]) if kind == "capsule" else np.zeros(3)
    return np.asarray(directions * size[0] * scale + shares[:, :1] * axis)


@pytest.mark.parametrize("piece", PIECES, ids=lambda piece: f"{piece[0]} {piece[1]}")
def test_a_cover_holds_every_point_of_its_piece(piece: tuple[PieceKind, tuple[float, ...], Array]) -> None:
    spheres = cover(*piece)
    points = points_of(*piece)
    assert 1 <= len(spheres) <= MAX_SPHERES
    apart = np.linalg.norm(points[:, None] - spheres[:, :3], axis=2) - spheres[:, 3]
    assert apart.min(axis=1).max() <= 1e-12


def test_long_and_flat_pieces_are_covered_by_several_spheres() -> None:
    for piece in (PIECES[1], PIECES[5], PIECES[6], PIECES[8]):
        spheres = cover(*piece)
        around = np.linalg.norm(np.ptp(points_of(*piece), axis=0)) / 2
        assert len(spheres) > 3
        assert spheres[:, 3].max() < 0.75 * around


def test_a_half_space_has_no_cover() -> None:
    assert cover("half_space", (), NOTHING).shape == (0, 4)
