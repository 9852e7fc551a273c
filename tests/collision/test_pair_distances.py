"""Distances and depths of two pieces against Coal, plain geometry and hard cases."""

import numpy as np
import pytest
from scipy.optimize import linprog

from gelenk.collision.bodies import Body, PieceKind
from gelenk.robot.arrays import Array
from tests.collision.pairs import faults, measured, near, random_pair


def _piece(kind: PieceKind, *size: float, points: Array | None = None) -> Body:
    return Body(kind, "link", kind, size, np.zeros((0, 3)) if points is None else points, np.eye(4), np.zeros((0, 4)))


def _poses(*translation: float) -> Array:
    poses = np.zeros((2, 12))
    poses[:, [0, 4, 8]] = 1.0
    poses[1, 9:] = translation
    return poses


BOX, BALL, ROD, POST = (
    _piece("box", 2.0, 2.0, 2.0),
    _piece("sphere", 0.5),
    _piece("capsule", 0.25, 1.0),
    _piece("cylinder", 1.0, 2.0),
)
FLOOR = _piece("half_space")


@pytest.mark.parametrize(
    ("a", "b", "translation", "distance"),
    [
        (BOX, BALL, (3.0, 0.0, 0.0), 1.5),
        (BOX, BALL, (4.0, 5.0, 1.0), 4.5),
        (BOX, BALL, (1.2, 0.1, 0.0), -0.3),
        (BOX, BALL, (0.7, 0.1, 0.2), -0.8),
        (BOX, BOX, (1.5, 0.2, 0.1), -0.5),
        (BALL, BALL, (0.0, 0.0, 0.0), -1.0),
        (ROD, ROD, (0.0, 0.0, 0.0), -0.5),
        (ROD, BALL, (0.0, 0.0, 2.0), 0.75),
        (POST, POST, (2.5, 0.0, 1.0), 0.5),
        (POST, BOX, (0.0, 0.3, 1.9), -0.1),
        (BALL, FLOOR, (0.3, 0.2, -2.0), 1.5),
        (BOX, FLOOR, (0.3, 0.2, -0.4), -0.6),
        (POST, FLOOR, (0.0, 0.0, 0.25), -1.25),
    ],
)
def test_a_distance_is_that_of_plain_geometry(
    a: Body, b: Body, translation: tuple[float, ...], distance: float
) -> None:
    pair = measured(a, b, _poses(*translation))
    assert pair.distance == pytest.approx(distance, abs=1e-8)
    assert np.linalg.norm(pair.points[:3] - pair.points[3:]) == pytest.approx(abs(distance), abs=1e-8)
    assert pair.is_contact == (distance < 0.0)


@pytest.mark.parametrize("scale", [1e-4, 1.0, 100.0])
def test_pieces_that_touch_are_in_contact_at_any_size(scale: float) -> None:
    box, ball = _piece("box", *(3 * [2.0 * scale])), _piece("sphere", 0.5 * scale)
    for other, away in ((ball, 1.5), (box, 2.0)):
        pair = measured(box, other, _poses(away * scale, 0.0, 0.0))
        assert abs(pair.distance) <= 1e-9
        assert measured(box, other, _poses(away * scale - 2e-9, 0.0, 0.0)).is_contact
        assert not measured(box, other, _poses(away * scale + 1e-6, 0.0, 0.0)).is_contact


@pytest.mark.parametrize("beside", [1e-13, 1e-11, 1e-9, 1e-7])
@pytest.mark.parametrize("along", [0.0, 0.25])
def test_a_ball_beside_the_axes_of_a_box_is_as_deep_as_on_them(beside: float, along: float) -> None:
    rng = np.random.default_rng(0)
    for shift in beside * rng.normal(size=(40, 3)):
        pair = measured(BOX, BALL, _poses(along + shift[0], shift[1], shift[2]))
        assert pair.distance == pytest.approx(along - 1.5, abs=1e-6)
        assert np.linalg.norm(pair.points[:3] - pair.points[3:]) == pytest.approx(1.5 - along, abs=1e-6)


def test_random_pairs_are_as_coal_says() -> None:
    rng = np.random.default_rng(1)
    pairs = [random_pair(rng) for _ in range(150)]
    assert {pair.is_contact for pair in pairs} == {True, False}
    assert [found for pair in pairs for found in faults(pair)] == []


def test_a_hull_is_near_a_box_just_from_its_distance_on() -> None:
    rng, seen = np.random.default_rng(4), {"a vertex inside": 0, "beyond a face": 0, "neither": 0}
    while min(seen.values()) < 20:
        pair = random_pair(rng)
        if (pair.a.kind, pair.b.kind) != ("convex", "box") or abs(pair.distance) < 1e-6:
            continue
        (A, p), (B, q) = ((pose[:9].reshape(3, 3), pose[9:]) for pose in pair.poses)
        local, half = (pair.a.points @ A.T + p - q) @ B, 0.5 * np.array(pair.b.size)
        inside = (np.abs(local) <= half).all(axis=1).any()
        outside = ((local > half).all(axis=0) | (local < -half).all(axis=0)).any()
        seen["a vertex inside" if inside else "beyond a face" if outside else "neither"] += 1
        assert near(pair.a, pair.b, pair.poses, 1.001 * max(pair.distance, 0.0))
        if pair.distance > 0.0:
            assert not near(pair.a, pair.b, pair.poses, 0.999 * pair.distance)


@pytest.mark.slow
def test_many_random_pairs_are_as_coal_says() -> None:
    rng = np.random.default_rng(2)
    assert [found for _ in range(5000) for found in faults(random_pair(rng))] == []


def test_nearest_points_of_hulls_are_in_them() -> None:
    rng, seen = np.random.default_rng(3), 0
    while seen < 20:
        pair = random_pair(rng)
        for piece, pose, point in ((pair.a, pair.poses[0], pair.points[:3]), (pair.b, pair.poses[1], pair.points[3:])):
            if piece.kind != "convex" or pair.distance < 0.0:
                continue
            local = pose[:9].reshape(3, 3).T @ (point - pose[9:])
            rows, values = np.vstack((piece.points.T, np.ones(len(piece.points)))), np.append(local, 1.0)
            slack = np.hstack((rows, np.eye(4), -np.eye(4)))
            cost = np.append(np.zeros(len(piece.points)), np.ones(8))
            assert linprog(cost, A_eq=slack, b_eq=values).fun < 1e-6 * max(1.0, np.abs(piece.points).max())
            seen += 1
