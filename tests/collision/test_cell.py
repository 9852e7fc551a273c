"""A cell: contacts within a distance, against the distances themselves, and what the judge withholds."""

import numpy as np
import pytest

from gelenk.collision.cell import cell_in
from gelenk.errors import CertificationFailed
from tests.collision.arms import world

QS = np.random.default_rng(0).uniform(-3.0, 3.0, (32, 4))


@pytest.mark.parametrize("min_clearance", [0.0, 0.08])
def test_what_is_nearer_than_the_clearance_is_in_contact(min_clearance: float) -> None:
    wide, own = cell_in(world(), min_clearance), cell_in(world())
    touching, nearest = wide.touching(QS), wide.nearest(QS)
    np.testing.assert_array_equal(touching, own.nearest(QS).clearances <= min_clearance)
    np.testing.assert_allclose(nearest.clearances, own.nearest(QS).clearances, atol=1e-9)
    assert 4 < touching.sum() < 32
    assert wide.certified(QS[:16], touching[:16]).samples == 16
    assert wide.certified_nearest(QS, nearest).max_distance_error <= 1e-6
    with pytest.raises(CertificationFailed, match="a contact"):
        wide.certified(QS[:4], ~touching[:4])
