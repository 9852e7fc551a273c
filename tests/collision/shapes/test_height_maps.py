"""Boxes of height maps contain all between base and surface, and reach no higher than is said."""

import numpy as np
import pytest
from scipy.interpolate import RegularGridInterpolator

from gelenk.collision.shapes.height_maps import MAX_PIECES, height_map_bodies
from gelenk.robot.arrays import Array
from gelenk.robot.notations import placement

T = placement((0.3, -0.2, 0.5), (0.4, -1.0, 2.0))
SIZE, BASE = (2.0, 1.0), -0.3


def waves(rows: int, columns: int) -> Array:
    """Heights of a hill with waves, rough at one corner."""
    y, x = np.mgrid[-1.0 : 1.0 : rows * 1j, -1.0 : 1.0 : columns * 1j]
    return np.asarray(0.2 * np.exp(-3.0 * (x * x + y * y)) + 0.02 * np.sin(9.0 * x) + 0.05 * (x * y > 0.5))


@pytest.mark.parametrize("shape", [(2, 2), (3, 7), (60, 90), (200, 300)])
def test_what_is_below_the_surface_is_in_a_box_and_what_is_above_the_excess_in_none(shape: tuple[int, int]) -> None:
    heights = waves(*shape)
    bodies, excess = height_map_bodies("hill", "base", heights, SIZE, BASE, T)
    assert 1 <= len(bodies) <= MAX_PIECES
    random = np.random.default_rng(1)
    points = random.uniform(-0.5, 0.5, (2000, 2)) * SIZE
    xs, ys = (extent * np.linspace(-0.5, 0.5, count) for extent, count in zip(SIZE, shape[::-1], strict=True))
    surface = RegularGridInterpolator((ys, xs), heights)(points[:, ::-1])
    below = np.column_stack((points, random.uniform(BASE, surface)))
    above = np.column_stack((points, surface + excess + 1e-9))
    centres = np.array([(np.linalg.inv(T) @ body.T_link_body)[:3, 3] for body in bodies])
    halves = np.array([body.size for body in bodies]) / 2

    def in_boxes(points: Array) -> Array:
        return np.asarray((np.abs(points[:, None] - centres) <= halves + 1e-12).all(axis=2).any(axis=1))

    assert in_boxes(below).all()
    assert not in_boxes(above).any()


def test_a_plain_is_one_box_without_excess() -> None:
    (body,), excess = height_map_bodies("plain", "base", np.full((50, 40), 0.1), SIZE, BASE, T)
    assert (body.kind, excess) == ("box", 0.0)
    np.testing.assert_allclose(body.size, (2.0, 1.0, 0.4))
