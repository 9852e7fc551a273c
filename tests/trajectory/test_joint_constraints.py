"""The joints' constraints on an interval are the Bernstein coefficients of what they limit, as SciPy evaluates them."""

import numpy as np
import pytest
from scipy.interpolate import BPoly, PPoly

from gelenk.trajectory.timing.joint_constraints import joint_rows


@pytest.mark.parametrize("degree", [1, 3, 5])
def test_rows_are_bernstein_coefficients_of_acceleration_and_squared_speed(degree: int) -> None:
    rng = np.random.default_rng(degree)
    pieces, lengths, limits = (
        rng.normal(size=(4, degree + 1, 3)),
        rng.uniform(0.1, 0.7, 4),
        rng.uniform(1.0, 3.0, (2, 3)),
    )
    u, x = 1.3, 0.8
    alpha, beta = joint_rows(pieces, lengths, limits)
    rows = (alpha * u + beta * x).reshape(4, 3, 4 * degree)
    taus = np.linspace(0.0, 1.0, 7)
    for i, length in enumerate(lengths):
        path = PPoly(pieces[i][::-1, None], np.array([0.0, length]))
        first, second = path(taus * length, 1), path(taus * length, 2)
        square = (x + 2.0 * taus * length * u)[:, None]
        acceleration = (slice(0, degree), first * u + second * square, limits[1])
        for part, true, limit in (acceleration, (slice(2 * degree, None), first**2 * square, limits[0] ** 2)):
            np.testing.assert_allclose(BPoly(rows[i, :, part].T[:, None], [0.0, 1.0])(taus), true / limit, atol=1e-12)
        np.testing.assert_array_equal(rows[i, :, degree : 2 * degree], -rows[i, :, :degree])
