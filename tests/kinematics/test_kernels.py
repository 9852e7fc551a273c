"""Kernels whose results no other test looks at by themselves."""

import numpy as np
import pytest

from gelenk.kinematics.simd.kernels import chain_jacobians, chain_measures, chain_poses
from tests.oracles import catalogue
from tests.robots import robot


@pytest.mark.parametrize("name", ["panda", "ur5", "scara", "stanford", "allegro_left_hand"])
@pytest.mark.parametrize("rows", [(0, 1, 2), (3, 4, 5), (0, 1), (0, 1, 2, 3, 4, 5), ()])
def test_measures_are_products_of_singular_values(name: str, rows: tuple[int, ...]) -> None:
    chain = robot(name).chain(None, None)
    qs = np.random.default_rng(1).uniform(-2.0, 2.0, (101, len(chain)))
    positions, rotations, measures = chain_measures(chain.flat, qs, np.array(rows, dtype=np.int64))
    Js = chain_jacobians(chain.flat, qs)[2][:, rows]
    np.testing.assert_allclose(measures, np.linalg.svd(Js, compute_uv=False).prod(axis=1), atol=1e-14)
    for ours, poses in zip((positions, rotations), chain_poses(chain.flat, qs), strict=True):
        np.testing.assert_allclose(ours, poses, atol=1e-15)


def test_the_measure_vanishes_where_a_direction_is_lost() -> None:
    assert "ur5" in catalogue.NAMES
    chain = robot("ur5").chain(None, None)
    q = np.array([[0.3, -1.2, 0.0, 0.4, 0.9, 0.1], [0.3, -1.2, 0.5, 0.4, 0.0, 0.1]])
    assert chain_measures(chain.flat, q, np.arange(6))[2].max() < 1e-15
